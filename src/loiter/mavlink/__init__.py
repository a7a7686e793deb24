"""Missions over a MAVLink connection: sent, read back, watched."""
