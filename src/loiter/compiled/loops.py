"""The kernel's functions, unchanged, compiled into the inner loops of NumPy ufuncs: still air.

The loop copies a block of states into buffers on the stack, works on these with loops that LLVM vectorises, and copies
the results out: it allocates no other memory, and its speed does not depend on the strides. `branchless` and a fused
multiply-add replace what would not vectorise.
"""

from math import nan
from typing import Any, NamedTuple

from loiter.compiled import branchless
from loiter.compiled.intrinsics import (
    BLOCK,
    FLAGS,
    LOOP,
    block_buffer,
    clear_flags,
    doubles,
    fma,
    inlined,
    load,
    module_of,
    state_count,
    store,
    store_bytes,
)
from loiter.compiled.rebinding import rebound
from loiter.kernel import motion
from loiter.kernel.statuses import Status
from loiter.kernel.synthesis import (
    Entry,
    first_control,
    is_faster,
    is_solvable,
    least_time,
    miss,
    optimum_on_side,
    rounded_radius,
    rounding,
    side_or_near,
    status_of,
)
from loiter.kernel.words import Side

OK = int(Status.OK)
CW, CCW, EITHER = int(Side.CW), int(Side.CCW), int(Side.EITHER)


def _two_product(a, b):
    """`exact.two_product` by fused multiply-add, equal to the last bit."""
    p = a * b
    return p, fma(a, b, -p)


_NAMES = {
    name: rebound(getattr(branchless, name), finish=inlined) for name in ("atan2", "sin", "cos", "hypot", "select")
}
_NAMES["two_product"] = inlined(_two_product)


def _compiled(function: Any) -> Any:
    """A kernel function and the kernel functions that it calls, compiled with the replacements `_NAMES`."""
    return rebound(function, _NAMES, inlined)


_least_time, _optimum_on_side, _side_or_near = map(_compiled, (least_time, optimum_on_side, side_or_near))
_status_of, _rounded_radius, _rounding, _miss = map(_compiled, (status_of, rounded_radius, rounding, miss))
_first_control, _is_faster, _is_solvable = map(_compiled, (first_control, is_faster, is_solvable))
_reduce = _compiled(motion.reduce)

# The operands of `min_time`, `control` and `solve` by number: five inputs, and the results of each.
X, Y, RADIUS, SIDE, TOLERANCE = range(5)
MIN_TIME = CONTROL = 5
# `solve` has a sixth input, only for the number 3 of durations. After the strides of all operands come those along the
# axis of length 3, of the sixth input and of the durations.
_, TIME, WORD, DURATIONS, STATUS, SIDE_HELD, MISS, _, NEXT_DURATION = range(5, 14)
# The operands of `reduce`.
EAST, NORTH, COSINE, SINE, REDUCED_X, REDUCED_Y = range(6)


class StateBlock(NamedTuple):
    """Buffers of the inputs of a block of states."""

    x: Any
    y: Any
    R: Any
    side: Any
    tolerance: Any


class EntryBlock(NamedTuple):
    """Buffers of the maneuvers of a block of states."""

    side: Any
    word: Any
    t1: Any
    t2: Any
    t3: Any


@inlined
def _state_block():
    return StateBlock(block_buffer(), block_buffer(), block_buffer(), block_buffer(), block_buffer())


@inlined
def _entry_block():
    return EntryBlock(block_buffer(), block_buffer(), block_buffer(), block_buffer(), block_buffer())


@inlined
def _store_durations(entries, args, steps, start, count):
    target, stride, next_one = doubles(args[DURATIONS]), steps[DURATIONS] // 8, steps[NEXT_DURATION] // 8
    t1, t2, t3 = entries.t1, entries.t2, entries.t3
    for i in range(count):
        place = (start + i) * stride
        target[place], target[place + next_one], target[place + 2 * next_one] = t1[i], t2[i], t3[i]


@inlined
def _is_constant(args, steps, operand, value):
    """Whether an operand is one number for all states, and equals this value."""
    return steps[operand] == 0 and doubles(args[operand])[0] == value


@inlined
def _is_exact(args, steps):
    """Whether no state has a tolerance."""
    return _is_constant(args, steps, TOLERANCE, 0.0)


@inlined
def _passes(args, steps):
    """The number of passes: 2 where a tolerance may make the far side of *either* the faster one, otherwise 1."""
    one_side = _is_constant(args, steps, SIDE, CW) or _is_constant(args, steps, SIDE, CCW)
    return 1 if _is_exact(args, steps) or one_side else 2


@inlined
def _load_states(states, args, steps, start, count):
    load(states.x, args, steps, X, start, count)
    load(states.y, args, steps, Y, start, count)
    load(states.R, args, steps, RADIUS, start, count)
    load(states.side, args, steps, SIDE, start, count)
    load(states.tolerance, args, steps, TOLERANCE, start, count)


@inlined
def _choose_sides(states, chosen, far, count):
    """The side of each state; for *either* the near one or, where `far` and there is a tolerance, the far one."""
    y, side, tolerance = states.y, states.side, states.tolerance
    for i in range(count):
        near = _side_or_near(y[i], int(side[i]))
        chosen[i] = -near if far and side[i] == EITHER and tolerance[i] > 0.0 else near


@inlined
def _tight_times(states, time, count):
    """T for R = 1, *either*, no tolerance: the compiler precomputes whatever depends only on these."""
    x, y = states.x, states.y
    for i in range(count):
        T = _least_time(x[i], abs(y[i]), 1.0, CW, 0.0)
        time[i] = T if _is_solvable(x[i], y[i], 1.0, 0.0) else nan


@inlined
def _times(states, chosen, time, count):
    x, y, R, tolerance = states.x, states.y, states.R, states.tolerance
    for i in range(count):
        T = _least_time(x[i], y[i], _rounded_radius(R[i]), int(chosen[i]), tolerance[i])
        time[i] = T if _is_solvable(x[i], y[i], R[i], tolerance[i]) else nan


@inlined
def _exact_times(states, chosen, time, count):
    """`_times` without a tolerance: the compiler leaves out the words that compete only beside a circle."""
    x, y, R = states.x, states.y, states.R
    for i in range(count):
        T = _least_time(x[i], y[i], _rounded_radius(R[i]), int(chosen[i]), 0.0)
        time[i] = T if _is_solvable(x[i], y[i], R[i], 0.0) else nan


@inlined
def _keep_least(time, other, far, count):
    """Keep the times of the first pass, or those of the second where they are less."""
    for i in range(count):
        time[i] = other[i] if not far or other[i] < time[i] else time[i]


def min_time(args, dimensions, steps, data):
    """T, or nan where the status is not OK."""
    states, chosen, time, other = _state_block(), block_buffer(), block_buffer(), block_buffer()
    n, exact, passes = state_count(dimensions), _is_exact(args, steps), _passes(args, steps)
    tight = exact and _is_constant(args, steps, RADIUS, 1.0) and _is_constant(args, steps, SIDE, EITHER)
    for start in range(0, n, BLOCK):
        count = min(BLOCK, n - start)
        if tight:
            load(states.x, args, steps, X, start, count)
            load(states.y, args, steps, Y, start, count)
            _tight_times(states, time, count)
        else:
            _load_states(states, args, steps, start, count)
            for far in range(passes):
                _choose_sides(states, chosen, far, count)
                if exact:
                    _exact_times(states, chosen, other, count)
                else:
                    _times(states, chosen, other, count)
                _keep_least(time, other, far, count)
        store(time, args, steps, MIN_TIME, start, count)
    clear_flags(FLAGS)


@inlined
def _optima(states, entries, count):
    """The optimum of each state on the side in `entries`."""
    x, y, R, tolerance = states.x, states.y, states.R, states.tolerance
    side, word, t1, t2, t3 = entries
    for i in range(count):
        _, word[i], t1[i], t2[i], t3[i] = _optimum_on_side(
            x[i], y[i], _rounded_radius(R[i]), int(side[i]), tolerance[i]
        )


@inlined
def _exact_optima(states, entries, count):
    """`_optima` without a tolerance; see `_exact_times`."""
    x, y, R = states.x, states.y, states.R
    side, word, t1, t2, t3 = entries
    for i in range(count):
        _, word[i], t1[i], t2[i], t3[i] = _optimum_on_side(x[i], y[i], _rounded_radius(R[i]), int(side[i]), 0.0)


@inlined
def _entry_at(entries, i):
    return Entry(int(entries.side[i]), int(entries.word[i]), entries.t1[i], entries.t2[i], entries.t3[i])


@inlined
def _keep_faster(states, entries, others, far, count):
    """Keep the maneuvers of the first pass, or those of the second where they are faster."""
    x, y, R = states.x, states.y, states.R
    side, word, t1, t2, t3 = entries
    side_, word_, t1_, t2_, t3_ = others
    for i in range(count):
        faster = _is_faster(_entry_at(others, i), _entry_at(entries, i), _rounding(x[i], y[i], R[i]))
        better = not far or faster
        side[i], word[i] = side_[i] if better else side[i], word_[i] if better else word[i]
        t1[i], t2[i], t3[i] = t1_[i] if better else t1[i], t2_[i] if better else t2[i], t3_[i] if better else t3[i]


@inlined
def _load_and_solve(states, entries, args, steps, start, count):
    """Load a block of states and solve it, both sides of *either* where a tolerance requires it."""
    others = _entry_block()
    _load_states(states, args, steps, start, count)
    for far in range(_passes(args, steps)):
        _choose_sides(states, others.side, far, count)
        if _is_exact(args, steps):
            _exact_optima(states, others, count)
        else:
            _optima(states, others, count)
        _keep_faster(states, entries, others, far, count)


@inlined
def _controls(states, entries, u, count):
    x, y, R, tolerance = states.x, states.y, states.R, states.tolerance
    side, word = entries.side, entries.word
    for i in range(count):
        first = _first_control(_rounded_radius(R[i]), Entry(int(side[i]), int(word[i]), 0.0, 0.0, 0.0))
        u[i] = first if _is_solvable(x[i], y[i], R[i], tolerance[i]) else nan


def control(args, dimensions, steps, data):
    """The first control of the optimum, or nan where the status is not OK."""
    states, entries, u = _state_block(), _entry_block(), block_buffer()
    n = state_count(dimensions)
    for start in range(0, n, BLOCK):
        count = min(BLOCK, n - start)
        _load_and_solve(states, entries, args, steps, start, count)
        _controls(states, entries, u, count)
        store(u, args, steps, CONTROL, start, count)
    clear_flags(FLAGS)


@inlined
def _misses(states, entries, distance, count):
    x, y, R = states.x, states.y, states.R
    for i in range(count):
        distance[i] = _miss(x[i], y[i], _rounded_radius(R[i]), _entry_at(entries, i))


@inlined
def _check(states, entries, time, distance, status, count):
    """Set status and T; the results are nan and 0 where the status is not OK."""
    x, y, R, tolerance = states.x, states.y, states.R, states.tolerance
    side, word, t1, t2, t3 = entries
    for i in range(count):
        status[i] = _status_of(x[i], y[i], R[i], tolerance[i]) + 0
        good = status[i] == OK
        t1[i], t2[i], t3[i] = t1[i] if good else nan, t2[i] if good else nan, t3[i] if good else nan
        time[i], distance[i] = t1[i] + t2[i] + t3[i], distance[i] if good else nan
        word[i], side[i] = word[i] if good else 0.0, side[i] if good else 0.0


def solve(args, dimensions, steps, data):
    """Time, word, the three durations, status, side and miss."""
    states, entries = _state_block(), _entry_block()
    time, status, distance = block_buffer(), block_buffer(), block_buffer()
    n = state_count(dimensions)
    for start in range(0, n, BLOCK):
        count = min(BLOCK, n - start)
        _load_and_solve(states, entries, args, steps, start, count)
        _misses(states, entries, distance, count)
        _check(states, entries, time, distance, status, count)
        store(time, args, steps, TIME, start, count)
        store_bytes(entries.word, args, steps, WORD, start, count)
        _store_durations(entries, args, steps, start, count)
        store_bytes(status, args, steps, STATUS, start, count)
        store_bytes(entries.side, args, steps, SIDE_HELD, start, count)
        store(distance, args, steps, MISS, start, count)
    clear_flags(FLAGS)


@inlined
def _reduce_all(x, y, c, s, count):
    for i in range(count):
        x[i], y[i] = _reduce(x[i], y[i], c[i], s[i])


def reduce(args, dimensions, steps, data):
    """The reduced state (2)."""
    x, y, c, s = block_buffer(), block_buffer(), block_buffer(), block_buffer()
    n = state_count(dimensions)
    for start in range(0, n, BLOCK):
        count = min(BLOCK, n - start)
        load(x, args, steps, EAST, start, count)
        load(y, args, steps, NORTH, start, count)
        load(c, args, steps, COSINE, start, count)
        load(s, args, steps, SINE, start, count)
        _reduce_all(x, y, c, s, count)
        store(x, args, steps, REDUCED_X, start, count)
        store(y, args, steps, REDUCED_Y, start, count)


def build() -> Any:
    """The loops as one LLVM module, each under its own name."""
    return module_of(dict.fromkeys((min_time, control, solve, reduce), LOOP))
