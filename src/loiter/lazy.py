"""Modules that are imported when a name of theirs is first used."""

from collections.abc import Callable
from importlib import import_module
from types import ModuleType
from typing import Any


class LazyModule(ModuleType):
    """A module by its name, imported at the first use of one of its names.

    It is for types of heavy packages: annotations are evaluated only where something asks for them, such as
    `typing.get_type_hints`, and a class is needed only where one is made or compared.
    """

    def __getattr__(self, name: str) -> Any:
        """A name of the module."""
        return getattr(import_module(self.__name__), name)


def lazy_names(package: str, modules: dict[str, str]) -> Callable[[str], Any]:
    """A `__getattr__` for a package: each name, by the module of the package that has it, imported at its first use."""

    def get(name: str) -> Any:
        if name in modules:
            return getattr(import_module(f"{package}.{modules[name]}"), name)
        raise AttributeError(f"module {package!r} has no attribute {name!r}")

    return get
