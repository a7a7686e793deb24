"""Flights of guidance laws in simulators: simulated aircraft, rival laws, trials, and their pictures."""
