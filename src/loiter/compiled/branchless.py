"""Arctangent, sine, cosine and choices without branches, which a compiler can vectorise, unlike the C library's.

`rebinding` puts them in place of those of `math` and of the kernel. The angles differ from the true values by one or
two roundings. The polynomials in q^2 come from tests/golden/build_branchless.py, which prints their remaining errors:
below 6e-18.
"""

from math import floor, pi, sqrt

from loiter.kernel.angles import Rotation
from loiter.kernel.still_air.extremals import Extremal

TAN_EIGHTH = sqrt(2.0) - 1.0  # tan(pi/8)

# pi/2 in three pieces, the first two of 33 digits, so that multiples below 2^20 are exact (Cody and Waite 1980).
HALF_PI_1, HALF_PI_2, HALF_PI_3 = 1.5707963267341256, 6.077100506303966e-11, 2.0222662487959506e-21


def atan2(y: float, x: float) -> float:
    """The angle of (x, y) in [-pi, pi], 0 for (0, 0); finite arguments. The sign of a zero is ignored.

    The smaller coordinate over the larger one, reduced from pi/4 to pi/8 by tan(a - pi/4) = (t - 1)/(t + 1).
    """
    ax, ay = abs(x), abs(y)
    large, small = (ax if ax > ay else ay), (ay if ax > ay else ax)
    beyond = small > TAN_EIGHTH * large
    above, below = (small - large if beyond else small), (small + large if beyond else large)
    q = above / (below if below > 0.0 else 1.0)
    a = q + q * _atan(q * q) + (0.25 * pi if beyond else 0.0)
    a = 0.5 * pi - a if ay > ax else a
    a = pi - a if x < 0.0 else a
    return -a if y < 0.0 else a


def sin(a: float) -> float:
    """Sine for |a| up to 2^19."""
    quarters, s, c = _quarters(a)
    odd = quarters == 1.0 or quarters == 3.0
    value = c if odd else s
    return -value if quarters >= 2.0 else value


def cos(a: float) -> float:
    """Cosine for |a| up to 2^19."""
    quarters, s, c = _quarters(a)
    odd = quarters == 1.0 or quarters == 3.0
    value = s if odd else c
    return -value if quarters == 1.0 or quarters == 2.0 else value


def acos(x: float) -> float:
    """The angle in [0, pi] whose cosine is x."""
    return atan2(sqrt((1.0 - x) * (1.0 + x)), x)


def atan(x: float) -> float:
    """The angle in [-pi/2, pi/2] whose tangent is x."""
    return atan2(x, 1.0)


def tan(a: float) -> float:
    """Tangent for |a| up to 2^19."""
    return sin(a) / cos(a)


def hypot(x: float, y: float) -> float:
    """Length of (x, y) where its square neither overflows nor underflows."""
    return sqrt(x * x + y * y)


def _quarters(a: float) -> tuple[float, float, float]:
    """The quarter turns in an angle, 0 to 3, and sine and cosine of the remainder, which is within pi/4."""
    n = floor(a * (2.0 / pi) + 0.5) * 1.0
    q = ((a - n * HALF_PI_1) - n * HALF_PI_2) - n * HALF_PI_3
    z = q * q
    return n - 4.0 * floor(0.25 * n), q + q * _sin(z), 1.0 - (0.5 * z - z * z * _cos(z))


def _atan(z: float) -> float:
    """atan(q)/q - 1 for z = q^2 up to tan(pi/8)^2; summed in pairs, which shortens the chain of operations."""
    z2 = z * z
    z4 = z2 * z2
    low = (-0.3333333333333333 + 0.19999999999999804 * z) + (-0.14285714285659828 + 0.11111111105155447 * z) * z2
    middle = (-0.09090908753500877 + 0.07692296375032143 * z) + (-0.06666424885738255 + 0.05878928997834775 * z) * z2
    high = (-0.05230454270650244 + 0.04551593220626549 * z) + (-0.034570561981427744 + 0.016285756855221028 * z) * z2
    return z * (low + middle * z4 + high * (z4 * z4))


def _sin(z: float) -> float:
    """sin(q)/q - 1 for z = q^2 up to (pi/4)^2."""
    z2 = z * z
    low = -0.16666666666666666 + 0.008333333333333331 * z
    middle = -0.00019841269841265065 + 2.7557319219339167e-06 * z
    high = (-2.5052106232447578e-08 + 1.6058531618986147e-10 * z) + -7.586697117706918e-13 * z2
    return z * (low + middle * z2 + high * (z2 * z2))


def _cos(z: float) -> float:
    """(cos q - 1 + z/2)/z^2 for z = q^2 up to (pi/4)^2."""
    z2 = z * z
    low = 0.041666666666666664 + -0.0013888888888887398 * z
    middle = 2.480158729876569e-05 + -2.7557317271729793e-07 * z
    return low + middle * z2 + (2.08761462684032e-09 + -1.1382632425521717e-11 * z) * (z2 * z2)


def select(condition: bool, a: Extremal, b: Extremal) -> Extremal:
    """`extremals.select` number by number: it compiles to selects, which LLVM vectorises, instead of a branch."""
    straight = a.straight if condition else b.straight
    word = a.word if condition else b.word
    first, middle, last = (
        select_rotation(condition, a.first, b.first),
        select_rotation(condition, a.middle, b.middle),
        select_rotation(condition, a.last, b.last),
    )
    return Extremal(word, first, straight, middle, last)


def select_rotation(condition: bool, a: Rotation, b: Rotation) -> Rotation:
    """Rotation a where the condition holds, otherwise b."""
    (across_a, along_a), (across_b, along_b) = a, b
    return across_a if condition else across_b, along_a if condition else along_b
