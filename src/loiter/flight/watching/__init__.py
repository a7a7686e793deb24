"""Watching a vehicle in flight, and advice from the plan."""
