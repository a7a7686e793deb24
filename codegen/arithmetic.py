"""The arithmetics for which C is generated: the types of numbers, the functions of `math`, and constants by digits.

A constant that depends on the number of digits, or on the range of exponents, is written in the kernel for doubles. It
stands in `CONSTANTS` again as a formula, from which every arithmetic takes its own value; a test compares those for
double with the kernel's.
"""

from collections.abc import Callable
from typing import Any, NamedTuple

from loiter.compiled import branchless


class Arithmetic(NamedTuple):
    """Types and functions of C for one kind of numbers.

    `digits` counts the binary digits of a number, `exponents` is the size of its least normal exponent. `functions`
    maps those of Python's `math` to C. `storage` stands before each function. `replaced` maps names of the kernel to
    other functions of Python. `faster` has bodies in C for processors with a fused multiply-add.
    """

    real: str
    integer: str
    suffix: str
    digits: int
    exponents: int
    storage: str
    functions: dict[str, str]
    replaced: dict[str, Any]
    faster: dict[str, str]


FUNCTIONS = (
    *("sqrt", "atan2", "sin", "cos", "tan", "acos", "atan", "exp", "log"),
    *("fabs", "fmod", "ceil", "floor", "copysign", "fma"),
)

INLINE = "static inline"
ALWAYS = "static inline LOITER_ALWAYS_INLINE"

# Double precision, with the functions of the C library, which Python's `math` calls too: the answers are those of plain
# Python to the last bit.
DOUBLE = Arithmetic("double", "int64_t", "", 53, 1022, INLINE, {name: name for name in FUNCTIONS}, {}, {})

# Double precision without branches, for loops that a compiler vectorises. Integers have 32 bits, since a vector of
# doubles is converted to 64 bits on few processors.
VECTOR = DOUBLE._replace(
    integer="int32_t",
    storage=ALWAYS,
    replaced={name: getattr(branchless, name) for name in ("atan2", "sin", "cos", "select")},
    faster={"two_product": "return (real_2){a * b, fma(a, b, -(a * b))};"},
)

# The kernel's constants that belong to an arithmetic, by module and name, from its digits and exponents.
CONSTANTS: dict[tuple[str, str], Callable[[Arithmetic], float]] = {
    ("angles", "TINY"): lambda a: 2.0 ** -(300 * a.exponents // 1022),
    ("exact", "SPLITTER"): lambda a: 2.0 ** ((a.digits + 1) // 2) + 1.0,
    ("extremals", "SMALLEST_SCALE"): lambda a: 2.0 ** -(300 * a.exponents // 1022),
    ("hold", "NEGLIGIBLE_WIND"): lambda a: 2.0 ** -(400 * a.exponents // 1022),
    ("minimum", "WORTH"): lambda a: 2.0**a.digits,
    ("moving_target", "NO_STEP"): lambda a: 2.0 ** -(a.digits + 5),
    ("synthesis", "REACH"): lambda a: 2.0 ** (a.digits - 1),
    ("synthesis", "ROUNDING"): lambda a: 64.0 * 2.0 ** -(a.digits - 1),
}
