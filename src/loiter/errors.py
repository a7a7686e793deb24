"""Public exceptions, each with one sentence that a user can act on, and checks of arguments."""

import os
import sys
from importlib.util import find_spec
from math import ceil, floor, inf, isfinite, nan
from numbers import Real
from typing import Any, NoReturn, Self


class LoiterError(ValueError):
    """Base class of all errors that this package raises on purpose."""


class InvalidArgument(LoiterError):
    """An argument that cannot be used. `argument` is its name, `problem` the rest of the sentence."""

    def __init__(self, argument: str, problem: str) -> None:
        super().__init__(f"{argument} {problem}")
        self.argument = argument
        self.problem = problem

    def __reduce__(self) -> tuple[type, tuple[str, str]]:
        """How to pickle it, for other processes."""
        return type(self), (self.argument, self.problem)


class RadiusTooSmall(LoiterError):
    """The circle is tighter than the aircraft can turn, or than it can hold in this wind.

    `fitted_radius_m` is the least radius that it can hold, metres, as for `Orbit.fitted`.
    """

    def __init__(self, sentence: str, fitted_radius_m: float) -> None:
        super().__init__(sentence, fitted_radius_m)
        self.fitted_radius_m = fitted_radius_m

    def __str__(self) -> str:
        sentence, _ = self.args
        return str(sentence)


class WindTooStrong(LoiterError):
    """The wind relative to the circle is as fast as the aircraft, or faster."""


class NotConverged(LoiterError):
    """No maneuver was found that ends on the circle when flown."""


class ImpossibleTime(LoiterError):
    """No path arrives at a place on the circle at exactly the time asked for.

    `next_s` is the next time at which one does, seconds from the start, inf where none is found, and `last_s` the last
    one before, nan where there is none.
    """

    def __init__(self, bearing_deg: float, time_s: float, last_s: float, next_s: float) -> None:
        super().__init__(bearing_deg, time_s, last_s, next_s)
        self.last_s, self.next_s = last_s, next_s

    def __str__(self) -> str:
        bearing_deg, time_s, last_s, next_s = self.args
        # Rounded into the times that are possible.
        later = (
            f"the next possible time is {ceil(next_s * 1e3) / 1e3:.10g} s"
            if isfinite(next_s)
            else "no later one is found"
        )
        earlier = f"the last one before is {floor(last_s * 1e3) / 1e3:.10g} s" if isfinite(last_s) else "none is sooner"
        return (
            f"no path arrives at bearing {bearing_deg:g} deg of the circle exactly {time_s:.10g} s from the start: "
            f"{later}, {earlier}"
        )


class OutOfRange(LoiterError):
    """The scene is too large for double precision."""


class Unfinished(LoiterError):
    """A batch job stopped before its end; the sentence says which results are kept."""


class MissingPackage(LoiterError):
    """An optional package is missing; the sentence says how to install it."""

    @classmethod
    def of_extra(cls, needs: str, package: str | None, extra: str) -> Self:
        """The error where a package is missing that an extra installs; `needs` begins the sentence: "MAVLink needs"."""
        return cls(
            f'{needs} {package}: pip install "loiter[{extra}]" brings it (in a checkout: pip install ".[{extra}]")'
        )


def check_installed(module: str, needs: str, package: str, extra: str) -> None:
    """Raise `MissingPackage.of_extra(needs, package, extra)` where a module cannot be imported."""
    if find_spec(module) is None:
        raise MissingPackage.of_extra(needs, package, extra)


class LinkFailed(LoiterError):
    """A vehicle was not reached, refused a request, or stored something other than what was sent.

    The sentence says what the vehicle has now.
    """


# Numbers of any unit, and lengths and speeds above zero, are refused beyond these: of others squares and cubes, and
# their quotients, overflow or are 0. The first is far below any length, the last far above the universe.
LEAST_SIZE, LARGEST_SIZE = 1e-50, 1e50


def number(argument: str, value: object, unit: str) -> float:
    """`value` as a finite float, in `unit` where it is a quantity of pint."""
    x = as_float(in_unit(value, unit))
    if not abs(x) <= LARGEST_SIZE:
        _refuse(argument, value, f"a finite number of {unit}{_range(x)}")
    return x


def positive(argument: str, value: object, unit: str) -> float:
    """`value` as a finite float above zero, in `unit` where it is a quantity of pint."""
    x = as_float(in_unit(value, unit))
    least, largest = (LEAST_SIZE, LARGEST_SIZE) if unit[:6] == "metres" else (0.0, inf)
    if not (0.0 < x < inf and least <= x <= largest):
        _refuse(argument, value, f"a positive, finite number of {unit}{_range(x)}")
    return x


def not_negative(argument: str, value: object, unit: str) -> float:
    """`value` as a finite float, zero or above, in `unit` where it is a quantity of pint."""
    x = as_float(in_unit(value, unit))
    return x if 0.0 <= x < inf else _refuse(argument, value, f"zero or a positive, finite number of {unit}")


def share(argument: str, value: float) -> float:
    """`value` where it is a share that is at least 0 and below 1."""
    if not 0.0 <= value < 1.0:
        raise InvalidArgument(argument, f"is {value}: it must be at least 0 and below 1")
    return value


def in_unit(value: Any, unit: str) -> Any:
    """The magnitude in `unit` of a quantity of pint, a number or an array; any other value as it is.

    A quantity of another dimension is returned as it is too, so that the checks of numbers refuse it.
    """
    # pint is not imported: only its quantities have this method.
    magnitude_in = None if type(value) is float else getattr(value, "m_as", None)
    if magnitude_in is None:
        return value
    # The units of errors say more than pint reads: "metres above home".
    plain_unit, _, _ = unit.partition(" above ")
    try:
        return magnitude_in(PINT_UNITS.get(plain_unit, plain_unit))
    except (TypeError, ValueError, AttributeError):
        return value


# Longer values are not shown in error messages.
MOST_LETTERS = 160

# Units that pint calls by other names.
PINT_UNITS = {"degrees Celsius": "degC"}


def clause(sentence: str) -> str:
    """A sentence as a part of another: it begins small, and has no full stop."""
    return sentence[0].lower() + sentence[1:].rstrip(".")


def instance(argument: str, value: object, kind: type) -> None:
    """Raise `InvalidArgument` for a value that is not of a class of this package, such as a tuple for a pose."""
    if not isinstance(value, kind):
        raise InvalidArgument(argument, f"{_shown(value)}: it must be a {_public_name(kind)}")


def file_path(argument: str, value: object) -> str:
    """A path as text; raises `InvalidArgument` for what is neither text nor a path."""
    if not isinstance(value, str | os.PathLike) or not isinstance(path := os.fspath(value), str):
        raise InvalidArgument(argument, f"{_shown(value)}: it must be the path of a file, as text or a pathlib.Path")
    return path


def _shown(value: object) -> str:
    """What a value of another class is: itself where it is short, otherwise its class."""
    text = repr(value)
    return f"is {text}" if len(text) <= MOST_LETTERS and "\n" not in text else f"is of type {type(value).__name__}"


def _public_name(kind: type) -> str:
    """The name by which a user imports a class: "loiter.Pose", "loiter.geo.LocalFrame"."""
    package = ".".join(kind.__module__.split(".")[:2])
    public = (name for name in ("loiter", package) if getattr(sys.modules.get(name), kind.__name__, None) is kind)
    return f"{next(public, kind.__module__)}.{kind.__name__}"


def as_float(value: object) -> float:
    """A real number as a float; nan for anything else, so that every comparison with it is false."""
    # Nearly every value is a float: a check of its type takes a fifth of the time of a check for a real number.
    if type(value) is float:
        return value
    if isinstance(value, bool) or not isinstance(value, Real):
        return nan
    try:
        return float(value)
    except OverflowError:
        return nan


def _range(x: float) -> str:
    """What a finite number that is refused for its size must be; empty for another."""
    if not isfinite(x) or x == 0.0 or LEAST_SIZE <= abs(x) <= LARGEST_SIZE:
        return ""
    return f", from {LEAST_SIZE:g} to {LARGEST_SIZE:g} in size: this is too {'small' if abs(x) < 1.0 else 'large'}"


def _refuse(argument: str, value: object, need: str) -> NoReturn:
    shown = f"is {value}" if isinstance(value, Real) or hasattr(value, "m_as") else _shown(value)
    raise InvalidArgument(argument, f"{shown}: it must be {need}")
