"""Symmetric limits on bank angles, turn rates and commands."""


def clip(value: float, limit: float) -> float:
    """`value`, limited to the range from -`limit` to `limit`."""
    return min(max(value, -limit), limit)
