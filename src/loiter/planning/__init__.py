"""Planning in SI: the problem, its solution by the kernel, and the maneuver that answers it."""
