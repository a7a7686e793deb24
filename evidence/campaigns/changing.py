"""Functions of a module with a part of their source replaced, to see that a check notices."""

import inspect
import textwrap
from collections.abc import Callable
from types import ModuleType
from typing import Any


def changed(module: ModuleType, function: str, *texts: str) -> Callable[..., Any]:
    """A function of a module with parts of its source replaced, each of which is there once: texts, in pairs."""
    source = textwrap.dedent(inspect.getsource(getattr(module, function)))
    for text, replacement in zip(texts[::2], texts[1::2], strict=True):
        assert source.count(text) == 1, (function, text, source.count(text))
        source = source.replace(text, replacement)
    names = module.__dict__
    kept = names[function]
    exec(compile(source, module.__file__, "exec"), names)
    names[function], new = kept, names[function]
    result: Callable[..., Any] = new
    return result
