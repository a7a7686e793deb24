"""Pictures of maneuvers. Matplotlib is imported here and nowhere else."""
