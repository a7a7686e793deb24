"""The closed-loop law that flies the fastest entry, its rivals, and simulators to fly them in."""
