"""NumPy ufuncs from compiled inner loops, made by NumPy's own C function."""

import ctypes
from importlib import import_module
from typing import Any, NamedTuple

import numpy as np

# Index of PyUFunc_FromFuncAndDataAndSignature in NumPy's table of functions (numpy/__ufunc_api.h), part of its ABI.
FROM_FUNCTIONS = 31
NO_IDENTITY = -1  # PyUFunc_None


class Operands(NamedTuple):
    """The operands of a ufunc: inputs and outputs, d for float64 and b for int8; the signature of a generalised one."""

    inputs: str
    outputs: str
    signature: str | None = None


def new_ufunc(name: str, operands: Operands, address: int) -> Any:
    """A ufunc whose inner loop, for float64, is at an address in memory.

    It is pickled by its name, so the module that keeps it must have a variable of that name.
    """
    inputs, outputs, signature = operands
    loops, data = (ctypes.c_void_p * 1)(address), (ctypes.c_void_p * 1)(None)
    types = bytes(np.dtype(code).num for code in inputs + outputs)
    title, shapes = name.encode(), signature.encode() if signature else None
    # NumPy stores only pointers to these.
    _REFERENCED.append((loops, data, types, title, shapes))
    return _constructor()(loops, data, types, 1, len(inputs), len(outputs), NO_IDENTITY, title, None, 0, shapes)


def _constructor() -> Any:
    """NumPy's own constructor of a ufunc from an inner loop."""
    pointer = ctypes.pythonapi.PyCapsule_GetPointer
    pointer.restype, pointer.argtypes = ctypes.c_void_p, [ctypes.py_object, ctypes.c_char_p]
    capsule = import_module("numpy._core._multiarray_umath")._UFUNC_API
    table = ctypes.cast(pointer(capsule, None), ctypes.POINTER(ctypes.c_void_p))
    void, text, number = ctypes.c_void_p, ctypes.c_char_p, ctypes.c_int
    kind = ctypes.PYFUNCTYPE(ctypes.py_object, void, void, text, *[number] * 4, text, text, number, text)
    return kind(table[FROM_FUNCTIONS])


_REFERENCED: list[Any] = []
