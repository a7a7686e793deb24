"""What compiled loops are made of: pointers, buffers on the stack, operands. The only file that imports Numba.

NumPy calls an inner loop (PyUFuncGenericFunction) with pointers to the operands and their strides.
"""

from collections.abc import Callable, Mapping
from typing import Any

import llvmlite.binding as llvm
import numba
from llvmlite import ir
from numba import extending
from numba.core import cgutils, types

# Numba has no types for its decorators.
_intrinsic: Any = extending.intrinsic
_njit: Any = numba.njit

NOTHING, INTEGER = types.void, types.intp
DOUBLES = types.CPointer(types.float64)
BYTES = types.CPointer(types.int8)
LOOP = types.void(types.CPointer(types.voidptr), types.CPointer(types.intp), types.CPointer(types.intp), types.voidptr)

BLOCK = 256  # states; their buffers of 2 KiB each stay in the first-level cache

# All flags of <fenv.h>. Compiled code evaluates both sides of a branch; NumPy must not warn about the unused one.
FLAGS = 0x3F
clear_flags = types.ExternalFunction("feclearexcept", types.int32(types.int32))


@_intrinsic
def fma(context: Any, a: Any, b: Any, c: Any) -> Any:
    """The product a b plus c, rounded once."""
    return types.float64(a, b, c), lambda context, builder, signature, args: builder.fma(*args)


def stack_buffer(size: int) -> Any:
    """A function without arguments that returns a buffer on the stack of its caller, for `size` doubles."""

    @_intrinsic
    def reserve(context: Any) -> Any:
        def generate(context: Any, builder: Any, signature: Any, args: Any) -> Any:
            buffer = cgutils.alloca_once(builder, ir.ArrayType(ir.DoubleType(), size))
            return builder.bitcast(buffer, ir.DoubleType().as_pointer())

        return DOUBLES(), generate

    return reserve


block_buffer = stack_buffer(BLOCK)


@_intrinsic
def doubles(context: Any, pointer: Any) -> Any:
    """A pointer to doubles."""

    def generate(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        (untyped,) = args
        return builder.bitcast(untyped, ir.DoubleType().as_pointer())

    return DOUBLES(pointer), generate


@_intrinsic
def octets(context: Any, pointer: Any) -> Any:
    """A pointer to bytes."""

    def generate(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        (untyped,) = args
        return builder.bitcast(untyped, ir.IntType(8).as_pointer())

    return BYTES(pointer), generate


def inlined(function: Any) -> Any:
    """The function compiled, to be inlined into its callers only."""
    return _njit(forceinline=True, error_model="numpy", no_cpython_wrapper=True, no_cfunc_wrapper=True)(function)


def called(function: Any) -> Any:
    """The function compiled, to be called by compiled functions only."""
    return _njit(error_model="numpy", no_cpython_wrapper=True, no_cfunc_wrapper=True)(function)


@inlined
def state_count(dimensions):
    """The number of states."""
    return dimensions[0]


@inlined
def load(buffer, args, steps, operand, start, count):
    """Copy a block of an operand to a buffer."""
    source, stride = doubles(args[operand]), steps[operand] // 8
    for i in range(count):
        buffer[i] = source[(start + i) * stride]


@inlined
def store(buffer, args, steps, operand, start, count):
    """Copy a buffer to a block of a result."""
    target, stride = doubles(args[operand]), steps[operand] // 8
    for i in range(count):
        target[(start + i) * stride] = buffer[i]


@inlined
def store_bytes(buffer, args, steps, operand, start, count):
    """Copy a buffer of whole numbers to a block of a result of bytes."""
    target, stride = octets(args[operand]), steps[operand]
    for i in range(count):
        target[(start + i) * stride] = types.int8(buffer[i])


@inlined
def number_at(args, steps, operand, i):
    """The number of an operand for state i."""
    return doubles(args[operand])[i * (steps[operand] // 8)]


@inlined
def put_number(args, steps, operand, i, value):
    """Store a number in a result for state i."""
    doubles(args[operand])[i * (steps[operand] // 8)] = value


@inlined
def put_code(args, steps, operand, i, code):
    """Store a code in a result of bytes for state i."""
    octets(args[operand])[i * steps[operand]] = types.int8(code)


def module_of(functions: Mapping[Callable[..., Any], Any]) -> Any:
    """The functions, compiled with their signatures, as one LLVM module, each under its own name."""
    whole = llvm.parse_assembly("")
    for function, signature in functions.items():
        compiled: Any = numba.cfunc(signature, error_model="numpy")(function)
        module = llvm.parse_assembly(compiled.inspect_llvm())
        module.get_function(compiled.native_name).name = function.__name__
        whole.link_in(module)
    return whole
