"""The page and its service: the plan as one drags the aircraft."""
