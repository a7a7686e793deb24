"""A vehicle in flight, watched: telemetry, dead reckoning and the plan from where it is."""
