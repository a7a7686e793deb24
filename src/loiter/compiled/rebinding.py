"""A second arithmetic for the same source: copies of the kernel's functions with other globals."""

from collections.abc import Callable, Mapping
from types import FunctionType
from typing import Any

Function = Callable[..., Any]

# Packages of scalar functions, whose callees are copied too.
SCALAR = ("loiter.kernel.", "loiter.compiled.")


def rebound(
    function: Function,
    names: Mapping[str, object] | None = None,
    finish: Callable[[Function], Function] = lambda copy: copy,
) -> Function:
    """A copy of a kernel function, and of the kernel functions it calls, that sees `names` in place of its globals.

    `rebound(fly, {"sin": numpy.sin, "cos": numpy.cos})` flies arrays; `rebound(optimum, finish=numba.njit)` compiles,
    since `finish` is applied to each copy. The source stays the only place where the formula stands.
    """
    copies: dict[Function, Function] = {}

    def copied(original: Any) -> Function:
        if original not in copies:
            seen = dict(original.__globals__)
            for name in original.__code__.co_names:
                if isinstance(seen.get(name), FunctionType) and seen[name].__module__.startswith(SCALAR):
                    seen[name] = copied(seen[name])
            seen.update(names or {})
            copy = FunctionType(original.__code__, seen, original.__name__, original.__defaults__)
            copies[original] = finish(copy)
        return copies[original]

    return copied(function)
