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

    A number stands between `prefix` and `suffix`, and `made` is how a structure is made. Where C is for two arithmetics
    of which a macro chooses one, `single` is the other one. `in_place` says that rings are changed where they are.
    Structures of at least `large` numbers are passed by address; with 0 none is. A function whose first parameter and
    whose result are one kind of at least `UPDATED` numbers then changes it where it is.
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
    prefix: str = ""
    made: str = "({})"
    single: Any = None
    in_place: bool = False
    large: int = 0


UPDATED = 32

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

# Double precision, or single where the macro LOITER_FLOAT is defined, in C that is C++ too.
ONBOARD = DOUBLE._replace(
    prefix="REAL(",
    suffix=")",
    functions={**{name: f"real_{name}" for name in FUNCTIONS}, "nan": "REAL_NAN", "inf": "REAL_INFINITY"},
    made="MAKE({})",
    single=DOUBLE._replace(real="float", integer="int32_t", digits=24, exponents=126),
    in_place=True,
    large=6,
)


def bits(a: Arithmetic) -> int:
    """The bits of an integer."""
    return 32 if a.integer == "int32_t" else 64


# The kernel's constants that belong to an arithmetic, by module and name, from its digits and exponents.
CONSTANTS: dict[tuple[str, str], Callable[[Arithmetic], float]] = {
    ("angles", "TINY"): lambda a: 2.0 ** -(300 * a.exponents // 1022),
    ("entry", "WIND_TIE_TOLERANCE"): lambda a: 1e-12 * 2.0 ** (53 - a.digits),
    ("exact", "SPLITTER"): lambda a: 2.0 ** ((a.digits + 1) // 2) + 1.0,
    ("extremals", "SMALLEST_SCALE"): lambda a: 2.0 ** -(300 * a.exponents // 1022),
    ("fits", "SHORT"): lambda a: 1e-4 * 2.0 ** ((53 - a.digits) / 4),
    ("hold", "NEGLIGIBLE_WIND"): lambda a: 2.0 ** -(400 * a.exponents // 1022),
    ("plan", "ROUNDING_S"): lambda a: 1e-9 * 2.0 ** ((53 - a.digits) * 17 / 29),
    ("minimum", "AT_CORNER"): lambda a: 1e-12 * 2.0 ** (53 - a.digits),
    ("minimum", "BESIDE"): lambda a: 1e-7 * 2.0 ** ((53 - a.digits) / 2),
    ("minimum", "WORTH"): lambda a: 2.0**a.digits,
    ("moving_target", "ALMOST"): lambda a: 1e-6 * 2.0 ** ((53 - a.digits) / 3),
    ("moving_target", "NO_STEP"): lambda a: 2.0 ** -(a.digits + 5),
    ("rounding", "REACH"): lambda a: 2.0 ** (a.digits - 1),
    ("rounding", "ROUNDING"): lambda a: 64.0 * 2.0 ** -(a.digits - 1),
    ("vehicle", "SMALLEST_TURN"): lambda a: 2.0 ** -(a.digits + 1),
    ("wind_search", "LAST"): lambda a: a.digits - 9,
    ("wind_search", "NARROWED"): lambda a: bits(a) // 6 - 2,
}
