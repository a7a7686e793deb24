"""Guiding a vehicle in flight onto its circle by bank commands, and handing it over to its own hold."""
