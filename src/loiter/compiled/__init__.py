"""The kernel's functions as machine code: compiled once per machine, kept on disk, loaded as NumPy ufuncs."""

from typing import Any


def ufunc(name: str) -> Any:
    """The ufunc `name` of `ufuncs`; the first call loads them, and compiles them if necessary."""
    from loiter.compiled import ufuncs

    return getattr(ufuncs, name)
