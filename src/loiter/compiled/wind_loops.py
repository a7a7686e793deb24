"""The search in wind, `kernel.wind_search`, unchanged, compiled to functions without memory of their own.

Two of them solve single scenes, two are the inner loops of NumPy ufuncs. Sines, cosines and arctangents are those of
the C library, which Python's `math` calls too, and no two operations are contracted into one: the results are those of
plain Python to the last bit.
"""

from typing import Any

from loiter.compiled.intrinsics import (
    DOUBLES,
    FLAGS,
    INTEGER,
    LOOP,
    NOTHING,
    called,
    clear_flags,
    doubles,
    inlined,
    module_of,
    number_at,
    put_code,
    put_number,
    stack_buffer,
    state_count,
)
from loiter.compiled.rebinding import rebinding
from loiter.kernel import wind_search
from loiter.kernel.wind_search import WindProblem

# The numbers of a `WindEntry`.
ENTRY_FIELDS = 8

SAMPLES = wind_search.SAMPLES

_sample_buffer = stack_buffer(SAMPLES)

_compiled = rebinding(finish=called)
_fastest, _scene_of = _compiled(wind_search.fastest), _compiled(wind_search.scene_of)
_sampled_times, _is_local_minimum = _compiled(wind_search.sampled_times), _compiled(wind_search.is_local_minimum)
_entry_near_sample = _compiled(wind_search.entry_near_sample)

# The operands of the ufuncs by number: the numbers of a `WindProblem`, and the results of each ufunc.
X, Y, COSINE, SINE, RADIUS, SIDE, WIND_X, WIND_Y, TOLERANCE = range(9)
MIN_TIME = 9
# `solve_in_wind` has one more input, only for the number 3 of durations. After the strides of all operands come those
# along the axis of length 3, of that input and of the durations.
_, TIME, WORD, DURATIONS, STATUS, SIDE_HELD, AZIMUTH, MISS, _, NEXT_DURATION = range(9, 19)


@inlined
def _stored_problem(problem):
    x, y, c, s, R = problem[0], problem[1], problem[2], problem[3], problem[4]
    side, wx, wy, tolerance = problem[5], problem[6], problem[7], problem[8]
    return WindProblem(x, y, c, s, R, int(side), wx, wy, tolerance)


@inlined
def _store_entry(entries, row, entry):
    first = ENTRY_FIELDS * row
    entries[first], entries[first + 1], entries[first + 2] = entry.status, entry.side, entry.word
    entries[first + 3], entries[first + 4], entries[first + 5] = entry.t1, entry.t2, entry.t3
    entries[first + 6], entries[first + 7] = entry.azimuth, entry.miss


def fastest(problem, entry):
    """`wind_search.fastest` of the numbers of a `WindProblem`; writes those of a `WindEntry`."""
    _store_entry(entry, 0, _fastest(_stored_problem(problem)))


def local_minima(problem, entries):
    """`wind_search.local_minima`, written to the rows of an array; returns their number."""
    one, times, count = _stored_problem(problem), _sample_buffer(), 0
    scene = _scene_of(one)
    _sampled_times(one.side, scene, times)
    for i in range(SAMPLES):
        if _is_local_minimum(times, i):
            _store_entry(entries, count, _entry_near_sample(i, one.side, scene))
            count += 1
    return count


@inlined
def _entry_of_state(args, steps, i):
    """The fastest entry of state i."""
    x, y = number_at(args, steps, X, i), number_at(args, steps, Y, i)
    c, s = number_at(args, steps, COSINE, i), number_at(args, steps, SINE, i)
    R, side = number_at(args, steps, RADIUS, i), number_at(args, steps, SIDE, i)
    wx, wy = number_at(args, steps, WIND_X, i), number_at(args, steps, WIND_Y, i)
    return _fastest(WindProblem(x, y, c, s, R, int(side), wx, wy, number_at(args, steps, TOLERANCE, i)))


def min_time_in_wind(args, dimensions, steps, data):
    """T, or nan where the status is not OK."""
    for i in range(state_count(dimensions)):
        entry = _entry_of_state(args, steps, i)
        put_number(args, steps, MIN_TIME, i, entry.t1 + entry.t2 + entry.t3)
    clear_flags(FLAGS)


def solve_in_wind(args, dimensions, steps, data):
    """Time, word, the three durations, status, side, azimuth and miss."""
    durations, next_one = doubles(args[DURATIONS]), steps[NEXT_DURATION] // 8
    for i in range(state_count(dimensions)):
        entry = _entry_of_state(args, steps, i)
        place = i * (steps[DURATIONS] // 8)
        put_number(args, steps, TIME, i, entry.t1 + entry.t2 + entry.t3)
        put_code(args, steps, WORD, i, entry.word)
        durations[place], durations[place + next_one], durations[place + 2 * next_one] = entry.t1, entry.t2, entry.t3
        put_code(args, steps, STATUS, i, entry.status)
        put_code(args, steps, SIDE_HELD, i, entry.side)
        put_number(args, steps, AZIMUTH, i, entry.azimuth)
        put_number(args, steps, MISS, i, entry.miss)
    clear_flags(FLAGS)


def build() -> Any:
    """The functions as one LLVM module, each under its own name."""
    single = {fastest: NOTHING(DOUBLES, DOUBLES), local_minima: INTEGER(DOUBLES, DOUBLES)}
    return module_of({**single, min_time_in_wind: LOOP, solve_in_wind: LOOP})
