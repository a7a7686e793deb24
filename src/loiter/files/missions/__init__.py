"""Missions and parameters of autopilots as files: .plan, .waypoints, .param."""
