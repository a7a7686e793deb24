"""The kernel's functions as machine code: compiled once per machine, kept on disk, loaded as NumPy ufuncs."""

from importlib import import_module
from typing import Any


def ufunc(name: str) -> Any:
    """The ufunc `name` of `ufuncs` or `wind_ufuncs`; the first call loads them, and compiles them if necessary."""
    module = "wind_ufuncs" if name.endswith("_in_wind") else "ufuncs"
    return getattr(import_module(f"{__name__}.{module}"), name)
