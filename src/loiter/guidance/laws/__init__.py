"""Guidance laws: `LoiterEntry`, which flies the fastest entry, and the laws that it is compared with."""
