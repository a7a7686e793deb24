"""The kernel's functions as machine code: compiled once per machine, kept on disk, loaded as NumPy ufuncs."""

from collections.abc import Callable
from importlib import import_module
from typing import Any


def ufunc(name: str) -> Any:
    """The ufunc `name` of `ufuncs` or `wind_ufuncs`; the first call loads them, and compiles them if necessary."""
    module = "wind_ufuncs" if name.endswith("_in_wind") else "ufuncs"
    return getattr(import_module(f"{__name__}.{module}"), name)


def announce_with(listener: Callable[[str], object]) -> None:
    """Call `listener` with a sentence before each compilation, which takes many seconds; by default nothing is said."""
    _LISTENERS[:] = [listener]


def announce(sentence: str) -> None:
    """Tell the listener that a compilation begins."""
    for listener in _LISTENERS:
        listener(sentence)


_LISTENERS: list[Callable[[str], object]] = []
