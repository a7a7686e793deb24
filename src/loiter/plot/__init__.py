"""Pictures of maneuvers. Only this package imports matplotlib."""
