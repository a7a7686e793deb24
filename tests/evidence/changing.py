"""Functions of a module with a part of their source replaced, to see that a check notices."""

import inspect
import textwrap
from collections.abc import Callable
from types import ModuleType
from typing import Any


def changed(module: ModuleType, function: str, text: str, replacement: str) -> Callable[..., Any]:
    """A function of a module with a part of its source replaced, which must be there once."""
    source = textwrap.dedent(inspect.getsource(getattr(module, function)))
    assert source.count(text) == 1, (function, text, source.count(text))
    names = module.__dict__
    kept = names[function]
    exec(compile(source.replace(text, replacement), module.__file__, "exec"), names)
    names[function], new = kept, names[function]
    result: Callable[..., Any] = new
    return result
