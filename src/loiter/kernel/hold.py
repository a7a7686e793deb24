"""Holding a circle in wind: the wind triangle round it (docs/wind.md, section 2).

All is relative to the circle: the air moves with w = (wx, wy), |w| < 1, so that the vehicle, heading along a unit
vector e, moves with e + w. A point of the circle is told by its phase: the angle flown along the hold since it headed
against the wind, whichever way round; side +1 is clockwise, -1 counter-clockwise, as in `codes.Side`.
"""

from math import cos, hypot, sin, sqrt

from loiter.kernel.angles import angle, turned_by

# A pose on the circle: position, heading as a unit vector, ground speed.
Pose = tuple[float, float, float, float, float]


def tightest_held(wx: float, wy: float) -> float:
    """The least R that can be held all round: the rate of turn is largest downwind, (1 + |w|)^2 / R."""
    return (1.0 + hypot(wx, wy)) ** 2


def downwind(wx: float, wy: float) -> tuple[float, float]:
    """The direction of the wind; any in still air."""
    wind = hypot(wx, wy)
    return (wx / wind, wy / wind) if wind > 0.0 else (1.0, 0.0)


def held(phase: float, side: int, R: float, wx: float, wy: float) -> Pose:
    """The pose on the circle at a phase, (1) and (2): heading and wind add up to a velocity along the circle."""
    dx, dy = downwind(wx, wy)
    a, b = -cos(phase), side * sin(phase)
    tx, ty = a * dx - b * dy, a * dy + b * dx
    nx, ny = -side * ty, side * tx
    out = wx * nx + wy * ny
    crab = sqrt((1.0 - out) * (1.0 + out))
    return R * nx, R * ny, crab * tx - out * nx, crab * ty - out * ny, crab + wx * tx + wy * ty


def phase_of(x: float, y: float, side: int, wx: float, wy: float) -> float:
    """The phase of the point of the circle next to (x, y)."""
    dx, dy = downwind(wx, wy)
    return angle(turned_by(-side, -dx, -dy, side * y, -side * x))


def hold_rate(phase: float, side: int, R: float, wx: float, wy: float) -> float:
    """The size of the rate of turn that holds the circle at a phase: g^2 / (R cos(crab)), (3)."""
    _, _, c, s, g = held(phase, side, R, wx, wy)
    return g * g / (R * (g - (wx * (c + wx) + wy * (s + wy)) / g))


def hold_time(phase: float, width: float, side: int, R: float, wx: float, wy: float) -> float:
    """A bound on the time that the hold takes from `phase` - `width`, not before the headwind, to `phase`.

    The ground speed rises from the headwind to the tailwind and falls from there on: it is least at an end.
    """
    return R * width / min(held(phase - width, side, R, wx, wy)[4], held(phase, side, R, wx, wy)[4])
