"""Witnesses that do not believe the kernel."""
