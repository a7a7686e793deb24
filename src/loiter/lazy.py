"""Modules that are imported when a name of theirs is first used."""

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
