"""Guidance laws that the fastest entry is compared with."""
