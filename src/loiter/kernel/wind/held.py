"""The time that holding a circle in wind takes, exactly (docs/legs.md, section 2).

At a phase p (`hold`) the ground speed is g(p) = sqrt(1 - w^2 sin(p)^2) - w cos(p), and 1/g = (sqrt(1 - w^2 sin(p)^2) +
w cos(p)) / (1 - w^2). So the time from one phase to another is that between two values of
R (E(p | w^2) + w sin(p)) / (1 - w^2), with Legendre's incomplete elliptic integral of the second kind.
"""

from math import atan, cos, floor, pi, sin, sqrt, tan

from loiter.kernel.angles import length

# Each step squares the difference of the two means: seven reach rounding from any wind that a double can tell from 1.
MEANS = 7

# Halvings after which an interval of phases is as short as rounding.
HALVINGS = 60


def elliptic(p: float, w: float) -> float:
    """E(p | w^2) for any p and 0 <= w < 1, by arithmetic and geometric means (Abramowitz and Stegun, 17.6)."""
    a, b, c = 1.0, sqrt((1.0 - w) * (1.0 + w)), w
    squares, sines, power = 0.5 * c * c, 0.0, 1.0
    for _ in range(MEANS):
        # The arctangent's branch follows p, so that p doubles with each step. It is that of the rounded tangent, whose
        # sign is either one where p is an odd multiple of pi/2.
        slope = tan(p)
        p = p + atan(b / a * slope) + pi * floor((p - atan(slope)) / pi + 0.5)
        a, b, c = 0.5 * (a + b), sqrt(a * b), 0.5 * (a - b)
        power = 2.0 * power
        squares, sines = squares + 0.5 * power * c * c, sines + c * sin(p)
    return p / (power * a) * (1.0 - squares) + sines


def time_held(phase: float, width: float, R: float, wx: float, wy: float) -> float:
    """The time to hold the circle from `phase` - `width` (zero or more) to `phase`."""
    wind = length(wx, wy)
    before = phase - width
    if wind == 0.0:
        return R * width
    along = 2.0 * wind * cos(0.5 * (phase + before)) * sin(0.5 * width)
    return R * (elliptic(phase, wind) - elliptic(before, wind) + along) / ((1.0 - wind) * (1.0 + wind))


def width_held(phase: float, time: float, R: float, wx: float, wy: float) -> float:
    """The angle of the circle that is held for a time before `phase`: `time_held` of it is at least that time."""
    wind = length(wx, wy)
    # The ground speed lies between 1 - w and 1 + w.
    least, most = (1.0 - wind) * time / R, (1.0 + wind) * time / R
    for _ in range(HALVINGS):
        middle = 0.5 * (least + most)
        if time_held(phase, middle, R, wx, wy) < time:
            least = middle
        else:
            most = middle
    return most
