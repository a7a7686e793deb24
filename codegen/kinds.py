"""Kinds of values in C: real numbers, integers, truth values, structures, rings of structures, arrays of numbers."""

from __future__ import annotations

from enum import IntEnum
from types import FunctionType, GenericAlias
from typing import Annotated, Any, NamedTuple, get_args, get_origin, get_type_hints


class NotTranslated(Exception):
    """Something outside the subset of Python that is translated; its text is one sentence."""


class Kind(NamedTuple):
    """A kind of value: its name in C, and the fields where it is a structure.

    `length` is that of a ring, -1 for a list, otherwise 0. With `by_address` it is that of a parameter: a pointer to
    the value; with `is_changed` the function changes the value there, in place of a result.
    """

    name: str
    fields: tuple[tuple[str, Kind], ...] = ()
    is_tuple: bool = False
    length: int = 0
    by_address: bool = False
    is_changed: bool = False

    @property
    def value(self) -> Kind:
        """The kind of the value itself."""
        return self._replace(by_address=False, is_changed=False)

    def size(self, in_place: bool) -> int:
        """The numbers in a value of this kind; a ring in place, which is elsewhere, counts as one."""
        if not self.fields or (self.length and in_place):
            return 1
        return max(self.length, 1) * sum(inner.size(in_place) for _, inner in self.fields)


REAL, INTEGER, TRUTH, NOTHING, REALS = Kind("real"), Kind("integer"), Kind("bool"), Kind("void"), Kind("real *")


def tuple_of(kinds: tuple[Kind, ...]) -> Kind:
    """The structure for a tuple without a name: `real_2`, `integer_real_3`; its fields are `a0`, `a1`, ..."""
    runs: list[tuple[Kind, int]] = []
    for kind in kinds:
        if runs and runs[-1][0] == kind:
            runs[-1] = kind, runs[-1][1] + 1
        else:
            runs.append((kind, 1))
    name = "_".join(kind.name if count == 1 else f"{kind.name}_{count}" for kind, count in runs)
    return Kind(name, tuple((f"a{i}", kind) for i, kind in enumerate(kinds)), is_tuple=True)


def ring_of(element: Kind, length: int) -> Kind:
    """The structure of a ring, a tuple of many structures: an array of fixed length, which is passed by value."""
    return Kind(f"{element.name}_ring_{length}", (("at", element),), length=length)


def list_of(element: Kind) -> Kind:
    """A list, of which only JavaScript knows more than those of real numbers."""
    return Kind(f"{element.name}[]", (("at", element),), length=-1)


def kind_of_type(hint: Any, place: str) -> Kind:
    """The kind for a type of Python."""
    if hint is type(None):
        return NOTHING
    if get_origin(hint) is Annotated:
        ring, length = get_args(hint)
        return ring_of(kind_of_type(get_args(ring)[0], place), length)
    if get_origin(hint) is tuple and Ellipsis not in get_args(hint):
        return tuple_of(tuple(kind_of_type(one, place) for one in get_args(hint)))
    if isinstance(hint, GenericAlias) and hint == list[float]:
        return REALS
    if get_origin(hint) is list:
        return list_of(kind_of_type(get_args(hint)[0], place))
    if isinstance(hint, type):
        if issubclass(hint, bool):
            return TRUTH
        if issubclass(hint, IntEnum | int):
            return INTEGER
        if issubclass(hint, float):
            return REAL
        if issubclass(hint, tuple) and hasattr(hint, "_fields"):
            hints = get_type_hints(hint, include_extras=True)
            return Kind(hint.__name__, tuple((safe(name), kind_of_type(hints[name], place)) for name in hint._fields))
    raise NotTranslated(f"{place}: the type {hint} is not part of the kernel's subset of Python")


def kind_of_value(value: Any, place: str) -> Kind:
    """The kind of a constant."""
    if isinstance(value, tuple) and not hasattr(value, "_fields"):
        return tuple_of(tuple(kind_of_value(one, place) for one in value))
    return kind_of_type(type(value), place)


def signature(function: FunctionType, place: str) -> tuple[dict[str, Kind], Kind]:
    """The kinds of the parameters of a function, and that of its result."""
    hints = get_type_hints(function, include_extras=True)
    result = kind_of_type(hints.pop("return", None), place)
    names = function.__code__.co_varnames[: function.__code__.co_argcount]
    if missing := [name for name in names if name not in hints]:
        raise NotTranslated(f"{place}: the parameter {missing[0]!r} of {function.__name__} has no annotation")
    return {name: kind_of_type(hints[name], place) for name in names}, result


# Words of C, of JavaScript or of Lua that are names in Python.
RESERVED = {"short", "long", "double", "float", "int", "register", "union", "auto", "const", "restrict", "default"}
RESERVED |= {"new", "var", "let", "function", "this", "delete", "void", "typeof", "switch", "case", "arguments"}
RESERVED |= {"end", "repeat", "until", "local", "then", "elseif", "nil", "goto"}


def safe(name: str) -> str:
    """A name that is no word of C, JavaScript or Lua."""
    return f"{name}_" if name in RESERVED else name
