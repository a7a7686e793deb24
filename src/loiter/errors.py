"""What the doors raise, each with one sentence that a user can act on, and the checks that raise it."""

from math import isfinite, nan
from numbers import Real


class LoiterError(ValueError):
    """Base of every error that this package raises on purpose."""


class InvalidArgument(LoiterError):
    """An argument that cannot be used. `argument` is its name, `problem` the rest of the sentence."""

    def __init__(self, argument: str, problem: str) -> None:
        super().__init__(f"{argument} {problem}")
        self.argument = argument
        self.problem = problem


class RadiusTooSmall(LoiterError):
    """The circle is tighter than the aircraft can turn, or than it can hold in this wind."""


class WindTooStrong(LoiterError):
    """The air passes the circle as fast as the aircraft flies, or faster."""


class NotConverged(LoiterError):
    """No maneuver was found that ends on the circle when flown."""


class OutOfRange(LoiterError):
    """The scene is too large for double precision."""


class Unfinished(LoiterError):
    """A batch job stopped half way; the sentence says what is kept of it."""


class MissingPackage(LoiterError):
    """An optional package is needed for what was asked; the sentence says how to install it."""


class LinkFailed(LoiterError):
    """A vehicle was not reached, refused, or keeps something else than it was sent; the sentence says what is left."""


def number(argument: str, value: object, unit: str) -> float:
    """`value` as a finite float."""
    return _checked(argument, value, f"a finite number of {unit}", isfinite(as_float(value)))


def positive(argument: str, value: object, unit: str) -> float:
    """`value` as a finite float above zero."""
    x = as_float(value)
    return _checked(argument, value, f"a positive, finite number of {unit}", isfinite(x) and x > 0.0)


def not_negative(argument: str, value: object, unit: str) -> float:
    """`value` as a finite float, zero or above."""
    x = as_float(value)
    return _checked(argument, value, f"zero or a positive, finite number of {unit}", isfinite(x) and x >= 0.0)


def as_float(value: object) -> float:
    """A real number as a float; nan for whatever is not one, so that a comparison refuses it."""
    if isinstance(value, bool) or not isinstance(value, Real):
        return nan
    try:
        return float(value)
    except OverflowError:
        return nan


def _checked(argument: str, value: object, need: str, good: bool) -> float:
    if not good:
        shown = value if isinstance(value, Real) else repr(value)
        raise InvalidArgument(argument, f"is {shown}: it must be {need}")
    return as_float(value)
