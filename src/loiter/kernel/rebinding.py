"""Copies of the kernel's functions with other globals: the same source with another arithmetic."""

from collections.abc import Callable, Iterator, Mapping
from types import CodeType, FunctionType
from typing import Any

Function = Callable[..., Any]

# Packages of scalar functions: their functions are copied too where they are called.
SCALAR = ("loiter.kernel.", "loiter.compiled.")


def names_used(code: CodeType) -> Iterator[str]:
    """The names that a function uses, also inside its comprehensions."""
    yield from code.co_names
    for inner in code.co_consts:
        if isinstance(inner, CodeType):
            yield from names_used(inner)


def rebound(
    function: Function,
    names: Mapping[str, object] | None = None,
    finish: Callable[[Function], Function] = lambda copy: copy,
) -> Function:
    """A copy of a kernel function, and of the kernel functions it calls, with `names` in place of its globals.

    `rebound(fly, {"sin": numpy.sin, "cos": numpy.cos})` takes arrays, so each formula is written only once. `finish` is
    applied to each copy.
    """
    return rebinding(names, finish)(function)


def rebinding(
    names: Mapping[str, object] | None = None,
    finish: Callable[[Function], Function] = lambda copy: copy,
) -> Callable[[Function], Function]:
    """`rebound` for several functions: what they share is copied once."""
    copies: dict[Function, Function] = {}
    given = names or {}

    def copied(original: Any) -> Function:
        if original not in copies:
            module = dict(original.__globals__)
            for name in names_used(original.__code__):
                value = None if name in given else module.get(name)
                if isinstance(value, FunctionType) and value.__module__.startswith(SCALAR):
                    module[name] = copied(value)
            module.update(given)
            copy = FunctionType(original.__code__, module, original.__name__, original.__defaults__)
            copies[original] = finish(copy)
        return copies[original]

    return copied
