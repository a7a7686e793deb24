"""Reduction of the state (2) and the exact flow of (1) and (7) under a constant control u in {-1, 0, +1}."""

from math import cos, sin


def reduce(x: float, y: float, c: float, s: float) -> tuple[float, float]:
    """The reduced state (2) of a vehicle at (x, y), relative to the circle's centre, with the unit heading (c, s)."""
    return x * c + y * s, y * c - x * s


def fly(x: float, y: float, c: float, s: float, u: int, t: float) -> tuple[float, float, float, float]:
    """Position (x, y) and unit velocity (c, s) after a time t with control u: the exact flow of (1).

    The displacement is the chord of the arc, 2 sin(t/2) long, along the velocity at half time. This avoids the
    difference of two nearly equal sines for short arcs.
    """
    half = 0.5 * u * t
    ch, sh = cos(half), sin(half)
    chord = 2.0 * sin(0.5 * t) if u else t
    ce, se = cos(u * t), sin(u * t)
    return x + chord * (c * ch - s * sh), y + chord * (s * ch + c * sh), c * ce - s * se, s * ce + c * se


def flow(x: float, y: float, u: int, t: float) -> tuple[float, float]:
    """The state after a time t with control u, by (7): turned about (0, -u), or shifted along x for u = 0."""
    if u == 0:
        return x + t, y
    w = u * y + 1.0
    ce, se = cos(t), sin(t)
    return x * ce + w * se, u * (w * ce - x * se - 1.0)
