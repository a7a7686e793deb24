"""Maneuvers as plain values, and as drawings for notebooks."""
