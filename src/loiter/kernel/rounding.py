"""How exact lengths are: the tolerance that rounding alone demands, and the largest scenes."""

# Rounding error of a length of order one: the reduction (2) costs 2 roundings a coordinate, a difference of squares 6,
# the angle and the flight of each of three pieces about 10; 64 units of 2**-52 is the next power of two above the sum.
ROUNDING = 64.0 * 2.0**-52


# Beyond this many turn radii neighbouring doubles are a turn radius apart.
REACH = 2.0**52


def rounding(x: float, y: float, R: float) -> float:
    """The length tolerance: the rounding error of lengths for a state and a circle of this size."""
    return ROUNDING * (1.0 + abs(x) + abs(y) + R)


def rounded_radius(R: float) -> float:
    """R, or 1 where R is less than 1 by rounding only: a circle as tight as the aircraft can turn."""
    return 1.0 if 1.0 - ROUNDING <= R < 1.0 else R


def arc_tolerance_of(x: float, y: float, R: float, tolerance: float) -> float:
    """The share of the end-point tolerance that each of at most three pieces may use up."""
    return max(tolerance, rounding(x, y, R)) / 3.0
