"""The kernel's functions, unchanged, as NumPy ufuncs of float64. Importing this module loads or compiles them.

`min_time(x, y, R, side, tolerance)` and `control(...)` return one array, `reduce(x, y, c, s)` two. `solve(x, y, R,
side, tolerance, three)` returns time, word, durations (..., 3), status, side and miss; `three` is any array of length
3, which NumPy needs to know the number of durations. Words, statuses and sides are the int8 codes of `words` and
`codes`. The ufuncs broadcast, take `out=`, release the interpreter's lock, and allocate nothing beyond the results.
"""

import ctypes
from importlib import import_module
from typing import Any

import numpy as np

from loiter.compiled.objects import addresses, kernel_sources

# Index of PyUFunc_FromFuncAndDataAndSignature in NumPy's table of functions (numpy/__ufunc_api.h), part of its ABI.
FROM_FUNCTIONS = 31
NO_IDENTITY = -1  # PyUFunc_None

# Inputs and outputs, d for float64 and b for int8; the signature of a generalised ufunc.
TYPES = {
    "min_time": ("ddddd", "d", None),
    "control": ("ddddd", "d", None),
    "reduce": ("dddd", "dd", None),
    "solve": ("dddddd", "dbdbbd", "(),(),(),(),(),(n)->(),(),(n),(),(),()"),
}


def _build() -> Any:
    from loiter.compiled.loops import build

    return build()


def _constructor() -> Any:
    """NumPy's own constructor of a ufunc from an inner loop."""
    pointer = ctypes.pythonapi.PyCapsule_GetPointer
    pointer.restype, pointer.argtypes = ctypes.c_void_p, [ctypes.py_object, ctypes.c_char_p]
    capsule = import_module("numpy._core._multiarray_umath")._UFUNC_API
    table = ctypes.cast(pointer(capsule, None), ctypes.POINTER(ctypes.c_void_p))
    void, text, number = ctypes.c_void_p, ctypes.c_char_p, ctypes.c_int
    kind = ctypes.PYFUNCTYPE(ctypes.py_object, void, void, text, *[number] * 4, text, text, number, text)
    return kind(table[FROM_FUNCTIONS])


def _ufunc(name: str, address: int) -> Any:
    inputs, outputs, signature = TYPES[name]
    loops, data = (ctypes.c_void_p * 1)(address), (ctypes.c_void_p * 1)(None)
    types = bytes(np.dtype(code).num for code in inputs + outputs)
    title, shapes = name.encode(), signature.encode() if signature else None
    # NumPy stores only pointers to these.
    _REFERENCED.append((loops, data, types, title, shapes))
    return _constructor()(loops, data, types, 1, len(inputs), len(outputs), NO_IDENTITY, title, None, 0, shapes)


_REFERENCED: list[Any] = []

min_time, control, reduce, solve = map(_ufunc, TYPES, addresses(tuple(TYPES), kernel_sources(), _build))
