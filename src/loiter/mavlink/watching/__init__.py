"""Watching a vehicle in flight: telemetry, dead reckoning, and advice from the plan."""
