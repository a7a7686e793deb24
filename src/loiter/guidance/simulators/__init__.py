"""Simulated aircraft, gusts and sensors, to fly guidance laws in."""
