"""An aircraft and difficult starts for the tests of the law."""

from math import cos, pi, sin, sqrt

from loiter import Aircraft, Pose

UAV = Aircraft(18.0, max_bank_deg=35.0)
r = UAV.turn_radius_m


def reduced(x, y):
    """A pose with the reduced state (x, y) for a circle about the origin: it heads east."""
    return Pose(r * x, r * y, 90.0)


def hard_starts(R):
    """Names and poses, for a clockwise circle of R turn radii: jump of T, switching curve, ties, opposite direction."""
    yield "at the centre", reduced(0.0, 0.0)
    yield "away along a tie line", reduced(3.0, 0.0)
    yield "towards the centre along a tie line", reduced(-8.0, 0.0)
    yield "on the circle the other way", reduced(0.0, -R)
    for degrees_left in (20, 60, 120, 170):
        # On the last arc, of radius R + 1 about (0, -1), and just inside it, where the least time jumps or is steep.
        s, c = sin(pi * degrees_left / 180), cos(pi * degrees_left / 180)
        yield f"on the jump, {degrees_left} deg left", reduced(-(R + 1.0) * s, -1.0 + (R + 1.0) * c)
        yield f"inside the jump, {degrees_left} deg left", reduced(-(R + 0.98) * s, -1.0 + (R + 0.98) * c)
    y, K = 0.5, R * (R + 2.0)
    # docs/theory.md, section 4: the switching curve.
    square = -y * y + 3.0 * y + K / 2.0 - sqrt(y * y + 3.0 * K * y + K * K / 4.0)
    if square > 0.0:
        yield "on the switching curve", reduced(sqrt(square), y)
