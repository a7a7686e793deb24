"""Missions sent to a vehicle, read back and started."""
