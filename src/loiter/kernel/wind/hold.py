"""Holding a circle in wind: heading, ground speed and rate of turn around it (docs/wind.md, section 2).

Everything is relative to the circle: the air moves with w = (wx, wy), |w| < 1, so a vehicle that heads along the unit
vector e moves with e + w. A point of the circle is given by its phase: the angle flown along the circle, in the
direction of the hold, since the heading was against the wind; side +1 is clockwise, -1 counter-clockwise, as in
`words.Side`.
"""

from math import cos, sin, sqrt

from loiter.kernel.angles import angle, arc_rotation, length

# Position (x, y), heading as a unit vector (c, s) and ground speed of a vehicle that holds the circle. A plain tuple:
# one is made for each point of joining that is tried, and plain Python makes a tuple of named fields half as fast.
HoldPose = tuple[float, float, float, float, float]


# A slower wind displaces no point within REACH by as much as rounding, and its square would be subnormal.
NEGLIGIBLE_WIND = 2.0**-400


def tightest_radius(wx: float, wy: float) -> float:
    """The least R of a circle that can be held all round: the rate of turn is largest downwind, (1 + |w|)^2 / R."""
    fastest = 1.0 + length(wx, wy)
    return fastest * fastest


def downwind(wx: float, wy: float) -> tuple[float, float]:
    """The direction of the wind as a unit vector; (1, 0) in still air, and in a wind too light to have one."""
    wind = length(wx, wy)
    return (wx / wind, wy / wind) if wind >= NEGLIGIBLE_WIND else (1.0, 0.0)


def hold_pose(phase: float, side: int, R: float, wx: float, wy: float) -> HoldPose:
    """The pose on the circle at a phase, (1) and (2): heading and wind add up to a velocity along the circle."""
    dx, dy = downwind(wx, wy)
    a, b = -cos(phase), side * sin(phase)
    tx, ty = a * dx - b * dy, a * dy + b * dx
    nx, ny = -side * ty, side * tx
    out = wx * nx + wy * ny
    crab = sqrt((1.0 - out) * (1.0 + out))
    return R * nx, R * ny, crab * tx - out * nx, crab * ty - out * ny, crab + wx * tx + wy * ty


def phase_of(x: float, y: float, side: int, wx: float, wy: float) -> float:
    """The phase of the point of the circle that is nearest to (x, y)."""
    dx, dy = downwind(wx, wy)
    return angle(arc_rotation(-side, -dx, -dy, side * y, -side * x))


def hold_rate(phase: float, side: int, R: float, wx: float, wy: float) -> float:
    """The size of the rate of turn that holds the circle at a phase: g^2 / (R cos(crab)), (3)."""
    _, _, c, s, g = hold_pose(phase, side, R, wx, wy)
    return g * g / (R * (g - (wx * (c + wx) + wy * (s + wy)) / g))


def hold_time(phase: float, width: float, side: int, R: float, wx: float, wy: float) -> float:
    """An upper bound on the time to hold the circle from `phase` - `width` (zero or more) to `phase`.

    The ground speed rises from the headwind to the tailwind and then falls: it is least at one of the two ends.
    """
    _, _, _, _, speed_before = hold_pose(phase - width, side, R, wx, wy)
    _, _, _, _, speed_after = hold_pose(phase, side, R, wx, wy)
    return R * width / min(speed_before, speed_after)
