"""Flights of guidance laws in simulators: one flight, campaigns of many, and how they are measured."""
