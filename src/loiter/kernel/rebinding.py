"""Copies of the kernel's functions with other globals: the same source with another arithmetic."""

from collections.abc import Callable, Mapping
from types import FunctionType
from typing import Any

Function = Callable[..., Any]

# Packages of scalar functions: their functions are copied too where they are called.
SCALAR = ("loiter.kernel.", "loiter.compiled.")


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

    def copied(original: Any) -> Function:
        if original not in copies:
            module = dict(original.__globals__)
            for name in original.__code__.co_names:
                if isinstance(module.get(name), FunctionType) and module[name].__module__.startswith(SCALAR):
                    module[name] = copied(module[name])
            module.update(names or {})
            copy = FunctionType(original.__code__, module, original.__name__, original.__defaults__)
            copies[original] = finish(copy)
        return copies[original]

    return copied
