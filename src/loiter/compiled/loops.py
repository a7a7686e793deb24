"""The kernel's functions, unchanged, compiled by Numba into the inner loops of NumPy ufuncs. The only file with Numba.

An inner loop is handed pointers and strides (NumPy's PyUFuncGenericFunction). It copies a block of states into buffers
on the stack, works on these with loops that LLVM vectorises, and copies the results out: no other memory is asked for,
and any strides run at the same speed. `branchless` and a fused multiply-add stand in for what would not vectorise.
"""

from math import nan
from typing import Any

import llvmlite.binding as llvm
import numba
from llvmlite import ir
from numba import extending
from numba.core import cgutils, types

from loiter.compiled import branchless
from loiter.compiled.rebinding import rebound
from loiter.kernel import motion, wind_search
from loiter.kernel.codes import Side, Status
from loiter.kernel.synthesis import (
    Entry,
    asked_side,
    first_control,
    held_radius,
    least_time,
    miss,
    one_sided,
    rounding,
    solvable,
    sooner,
    status_of,
)

# Numba's decorators take and give what their types do not tell.
_intrinsic: Any = extending.intrinsic
_njit: Any = numba.njit

BLOCK = 256  # states; their buffers of 2 KiB each stay in the first-level cache

DOUBLES = types.CPointer(types.float64)
BYTES = types.CPointer(types.int8)
LOOP = types.void(types.CPointer(types.voidptr), types.CPointer(types.intp), types.CPointer(types.intp), types.voidptr)

OK = int(Status.OK)
CW, CCW, EITHER = int(Side.CW), int(Side.CCW), int(Side.EITHER)

# All flags of <fenv.h>. Compiled code works out branches that it then leaves; NumPy must not warn of those.
FLAGS = 0x3F
_clear_flags = types.ExternalFunction("feclearexcept", types.int32(types.int32))


@_intrinsic
def _fma(context: Any, a: Any, b: Any, c: Any) -> Any:
    """The product a b plus c, rounded once."""
    return types.float64(a, b, c), lambda context, builder, signature, args: builder.fma(*args)


@_intrinsic
def _buffer(context: Any) -> Any:
    """Room for a block of doubles on the stack."""

    def generate(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        room = cgutils.alloca_once(builder, ir.ArrayType(ir.DoubleType(), BLOCK))
        return builder.bitcast(room, ir.DoubleType().as_pointer())

    return DOUBLES(), generate


@_intrinsic
def _doubles(context: Any, pointer: Any) -> Any:
    """A pointer to doubles."""
    return DOUBLES(pointer), lambda context, builder, signature, args: builder.bitcast(
        args[0], ir.DoubleType().as_pointer()
    )


@_intrinsic
def _bytes(context: Any, pointer: Any) -> Any:
    """A pointer to bytes."""
    return BYTES(pointer), lambda context, builder, signature, args: builder.bitcast(
        args[0], ir.IntType(8).as_pointer()
    )


def _inlined(function: Any) -> Any:
    """Compiled, to be folded into its callers; no other door to it is wanted."""
    return _njit(forceinline=True, error_model="numpy", no_cpython_wrapper=True, no_cfunc_wrapper=True)(function)


def _two_product(a, b):
    """`exact.two_product` by fused multiply-add, to the same last bit."""
    p = a * b
    return p, _fma(a, b, -p)


_NAMES = {name: rebound(getattr(branchless, name), finish=_inlined) for name in ("atan2", "sin", "cos", "hypot")}
_NAMES["two_product"] = _inlined(_two_product)


def _compiled(function: Any) -> Any:
    return rebound(function, _NAMES, _inlined)


_least_time, _one_sided, _asked_side, _sooner = map(_compiled, (least_time, one_sided, asked_side, sooner))
_status_of, _held_radius, _rounding = map(_compiled, (status_of, held_radius, rounding))
_reduce = _compiled(motion.reduce)
_first_control, _miss, _solvable = map(_compiled, (first_control, miss, solvable))


@_inlined
def _load(buffer, operand, step, start, count):
    source, stride = _doubles(operand), step // 8
    for i in range(count):
        buffer[i] = source[(start + i) * stride]


@_inlined
def _store(buffer, operand, step, start, count):
    target, stride = _doubles(operand), step // 8
    for i in range(count):
        target[(start + i) * stride] = buffer[i]


@_inlined
def _store_bytes(buffer, operand, step, start, count):
    target = _bytes(operand)
    for i in range(count):
        target[(start + i) * step] = types.int8(buffer[i])


@_inlined
def _store_triples(first, second, third, operand, step, inner, start, count):
    target, stride, next_one = _doubles(operand), step // 8, inner // 8
    for i in range(count):
        place = (start + i) * stride
        target[place], target[place + next_one], target[place + 2 * next_one] = first[i], second[i], third[i]


@_inlined
def _constant(operand, step, value):
    """Whether an operand is one number, and this one."""
    return step == 0 and _doubles(operand)[0] == value


@_inlined
def _exact(args, steps):
    """Whether no state has a tolerance."""
    return _constant(args[4], steps[4], 0.0)


@_inlined
def _passes(args, steps):
    """2 where a tolerance may make the far side of *either* the sooner one, else 1."""
    sided = _constant(args[3], steps[3], CW) or _constant(args[3], steps[3], CCW)
    return 1 if _exact(args, steps) or sided else 2


@_inlined
def _inputs(args, steps, start, count, x, y, R, side, tolerance):
    _load(x, args[0], steps[0], start, count)
    _load(y, args[1], steps[1], start, count)
    _load(R, args[2], steps[2], start, count)
    _load(side, args[3], steps[3], start, count)
    _load(tolerance, args[4], steps[4], start, count)


@_inlined
def _asked(y, side, tolerance, asked, far, count):
    """The side asked for; for *either* the near one, or, where `far` and there is a tolerance, the other."""
    for i in range(count):
        near = _asked_side(y[i], int(side[i]))
        asked[i] = -near if far and side[i] == EITHER and tolerance[i] > 0.0 else near


@_inlined
def _tight_times(x, y, time, count):
    """T for R = 1, *either*, no tolerance: all that depends on these alone is worked out by the compiler."""
    for i in range(count):
        T = _least_time(x[i], abs(y[i]), 1.0, CW, 0.0)
        time[i] = T if _solvable(x[i], y[i], 1.0, 0.0) else nan


@_inlined
def _times(x, y, R, asked, tolerance, time, count):
    for i in range(count):
        T = _least_time(x[i], y[i], _held_radius(R[i]), int(asked[i]), tolerance[i])
        time[i] = T if _solvable(x[i], y[i], R[i], tolerance[i]) else nan


@_inlined
def _exact_times(x, y, R, asked, time, count):
    """`_times` without a tolerance: the compiler leaves out the words that compete only beside a circle."""
    for i in range(count):
        T = _least_time(x[i], y[i], _held_radius(R[i]), int(asked[i]), 0.0)
        time[i] = T if _solvable(x[i], y[i], R[i], 0.0) else nan


@_inlined
def _least(time, other, far, count):
    """The times of the first pass, or those of the second that are sooner."""
    for i in range(count):
        time[i] = other[i] if not far or other[i] < time[i] else time[i]


def min_time(args, dimensions, steps, data):
    """T, or nan where the status is not OK."""
    x, y, R, side, tolerance = _buffer(), _buffer(), _buffer(), _buffer(), _buffer()
    asked, time, other = _buffer(), _buffer(), _buffer()
    exact, passes = _exact(args, steps), _passes(args, steps)
    tight = exact and _constant(args[2], steps[2], 1.0) and _constant(args[3], steps[3], EITHER)
    for start in range(0, dimensions[0], BLOCK):
        count = min(BLOCK, dimensions[0] - start)
        if tight:
            _load(x, args[0], steps[0], start, count)
            _load(y, args[1], steps[1], start, count)
            _tight_times(x, y, time, count)
        else:
            _inputs(args, steps, start, count, x, y, R, side, tolerance)
            for far in range(passes):
                _asked(y, side, tolerance, asked, far, count)
                if exact:
                    _exact_times(x, y, R, asked, other, count)
                else:
                    _times(x, y, R, asked, tolerance, other, count)
                _least(time, other, far, count)
        _store(time, args[5], steps[5], start, count)
    _clear_flags(FLAGS)


@_inlined
def _optima(x, y, R, asked, tolerance, word, t1, t2, t3, count):
    for i in range(count):
        _, word[i], t1[i], t2[i], t3[i] = _one_sided(x[i], y[i], _held_radius(R[i]), int(asked[i]), tolerance[i])


@_inlined
def _exact_optima(x, y, R, asked, word, t1, t2, t3, count):
    """`_optima` without a tolerance; see `_exact_times`."""
    for i in range(count):
        _, word[i], t1[i], t2[i], t3[i] = _one_sided(x[i], y[i], _held_radius(R[i]), int(asked[i]), 0.0)


@_inlined
def _sooner_ones(x, y, R, held, word, t1, t2, t3, asked, word_, t1_, t2_, t3_, far, count):
    """The maneuvers of the first pass, or those of the second that are sooner."""
    for i in range(count):
        maneuver = Entry(int(held[i]), int(word[i]), t1[i], t2[i], t3[i])
        other = Entry(int(asked[i]), int(word_[i]), t1_[i], t2_[i], t3_[i])
        better = not far or _sooner(other, maneuver, _rounding(x[i], y[i], R[i]))
        held[i], word[i] = asked[i] if better else held[i], word_[i] if better else word[i]
        t1[i], t2[i], t3[i] = t1_[i] if better else t1[i], t2_[i] if better else t2[i], t3_[i] if better else t3[i]


@_inlined
def _solved(args, steps, start, count, x, y, R, tolerance, held, word, t1, t2, t3):
    """Load a block of states and solve it, both sides of *either* where a tolerance asks for it."""
    side, asked = _buffer(), _buffer()
    word_, t1_, t2_, t3_ = _buffer(), _buffer(), _buffer(), _buffer()
    _inputs(args, steps, start, count, x, y, R, side, tolerance)
    for far in range(_passes(args, steps)):
        _asked(y, side, tolerance, asked, far, count)
        if _exact(args, steps):
            _exact_optima(x, y, R, asked, word_, t1_, t2_, t3_, count)
        else:
            _optima(x, y, R, asked, tolerance, word_, t1_, t2_, t3_, count)
        _sooner_ones(x, y, R, held, word, t1, t2, t3, asked, word_, t1_, t2_, t3_, far, count)


@_inlined
def _controls(x, y, R, tolerance, held, word, u, count):
    for i in range(count):
        first = _first_control(_held_radius(R[i]), Entry(int(held[i]), int(word[i]), 0.0, 0.0, 0.0))
        u[i] = first if _solvable(x[i], y[i], R[i], tolerance[i]) else nan


def control(args, dimensions, steps, data):
    """The first control of the optimum, or nan where the status is not OK."""
    x, y, R, tolerance = _buffer(), _buffer(), _buffer(), _buffer()
    held, word, t1, t2, t3 = _buffer(), _buffer(), _buffer(), _buffer(), _buffer()
    for start in range(0, dimensions[0], BLOCK):
        count = min(BLOCK, dimensions[0] - start)
        _solved(args, steps, start, count, x, y, R, tolerance, held, word, t1, t2, t3)
        _controls(x, y, R, tolerance, held, word, t1, count)
        _store(t1, args[5], steps[5], start, count)
    _clear_flags(FLAGS)


@_inlined
def _misses(x, y, R, held, word, t1, t2, t3, missed, count):
    for i in range(count):
        missed[i] = _miss(x[i], y[i], _held_radius(R[i]), Entry(int(held[i]), int(word[i]), t1[i], t2[i], t3[i]))


@_inlined
def _checked(x, y, R, tolerance, time, word, t1, t2, t3, held, missed, status, count):
    """Status, and the whole time; nan and 0 where it is not OK."""
    for i in range(count):
        status[i] = _status_of(x[i], y[i], R[i], tolerance[i]) + 0
        good = status[i] == OK
        t1[i], t2[i], t3[i] = t1[i] if good else nan, t2[i] if good else nan, t3[i] if good else nan
        time[i], missed[i] = t1[i] + t2[i] + t3[i], missed[i] if good else nan
        word[i], held[i] = word[i] if good else 0.0, held[i] if good else 0.0


def solve(args, dimensions, steps, data):
    """Time, word, the three durations, status, side held and miss; the sixth operand only gives the three their number.

    After the strides of the twelve operands come those along that number, of the sixth operand and of the durations.
    """
    x, y, R, tolerance = _buffer(), _buffer(), _buffer(), _buffer()
    held, word, t1, t2, t3 = _buffer(), _buffer(), _buffer(), _buffer(), _buffer()
    time, status, missed = _buffer(), _buffer(), _buffer()
    for start in range(0, dimensions[0], BLOCK):
        count = min(BLOCK, dimensions[0] - start)
        _solved(args, steps, start, count, x, y, R, tolerance, held, word, t1, t2, t3)
        _misses(x, y, R, held, word, t1, t2, t3, missed, count)
        _checked(x, y, R, tolerance, time, word, t1, t2, t3, held, missed, status, count)
        _store(time, args[6], steps[6], start, count)
        _store_bytes(word, args[7], steps[7], start, count)
        _store_triples(t1, t2, t3, args[8], steps[8], steps[13], start, count)
        _store_bytes(status, args[9], steps[9], start, count)
        _store_bytes(held, args[10], steps[10], start, count)
        _store(missed, args[11], steps[11], start, count)
    _clear_flags(FLAGS)


@_inlined
def _reduced(x, y, c, s, count):
    for i in range(count):
        x[i], y[i] = _reduce(x[i], y[i], c[i], s[i])


def reduce(args, dimensions, steps, data):
    """The reduced state (2)."""
    x, y, c, s = _buffer(), _buffer(), _buffer(), _buffer()
    for start in range(0, dimensions[0], BLOCK):
        count = min(BLOCK, dimensions[0] - start)
        _load(x, args[0], steps[0], start, count)
        _load(y, args[1], steps[1], start, count)
        _load(c, args[2], steps[2], start, count)
        _load(s, args[3], steps[3], start, count)
        _reduced(x, y, c, s, count)
        _store(x, args[4], steps[4], start, count)
        _store(y, args[5], steps[5], start, count)


def build() -> Any:
    """The loops as one LLVM module, each under its own name."""
    whole = llvm.parse_assembly("")
    for loop in (min_time, control, solve, reduce):
        compiled = numba.cfunc(LOOP, error_model="numpy")(loop)
        module = llvm.parse_assembly(compiled.inspect_llvm())
        module.get_function(compiled.native_name).name = loop.__name__
        whole.link_in(module)
    return whole


def in_wind() -> Any:
    """`wind_search.fastest` over the rows of arrays: eight numbers each in, and out what it gives.

    It keeps lists, whose memory Numba's own runtime manages, so that it cannot stand in an object file: every process
    compiles it anew, which takes some ten seconds.
    """
    compiled = _njit(nogil=True, error_model="numpy")
    fastest = rebound(wind_search.fastest, finish=compiled)

    def each(states, answers):
        for i in range(len(states)):
            x, y, c, s, R, side, wx, wy = states[i]
            answer = fastest(x, y, c, s, R, int(side), wx, wy)
            answers[i, 0], answers[i, 1], answers[i, 2] = answer[0], answer[1], answer[2]
            answers[i, 3], answers[i, 4], answers[i, 5] = answer[3], answer[4], answer[5]
            answers[i, 6], answers[i, 7] = answer[6], answer[7]

    return compiled(each)
