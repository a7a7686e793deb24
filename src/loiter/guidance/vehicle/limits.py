"""Limits, of bank, of rates of turn and of demands, alike on both sides."""


def clipped(value: float, limit: float) -> float:
    """`value`, but no further from 0 than `limit`."""
    return min(max(value, -limit), limit)
