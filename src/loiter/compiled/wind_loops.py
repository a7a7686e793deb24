"""The search in wind, `kernel.wind_search`, unchanged, compiled to functions without memory of their own.

Sines, cosines and arctangents are those of the C library, which Python's `math` calls too, and no two operations are
contracted into one: the results are those of plain Python to the last bit.
"""

from typing import Any

from loiter.compiled.intrinsics import DOUBLES, INTEGER, NOTHING, called, inlined, module_of, stack_buffer
from loiter.compiled.rebinding import rebinding
from loiter.kernel import wind_search
from loiter.kernel.wind_search import WindProblem

# The numbers of a `WindProblem`, and of a `WindEntry`.
FIELDS = 8

SAMPLES = wind_search.SAMPLES

_sample_buffer = stack_buffer(SAMPLES)

_compiled = rebinding(finish=called)
_fastest, _scene_of = _compiled(wind_search.fastest), _compiled(wind_search.scene_of)
_sampled_times, _is_local_minimum = _compiled(wind_search.sampled_times), _compiled(wind_search.is_local_minimum)
_entry_near_sample = _compiled(wind_search.entry_near_sample)


@inlined
def _problem_at(problems, row):
    first = FIELDS * row
    x, y, c, s = problems[first], problems[first + 1], problems[first + 2], problems[first + 3]
    R, side, wx, wy = problems[first + 4], problems[first + 5], problems[first + 6], problems[first + 7]
    return WindProblem(x, y, c, s, R, int(side), wx, wy)


@inlined
def _store_entry(entries, row, entry):
    first = FIELDS * row
    entries[first], entries[first + 1], entries[first + 2] = entry.status, entry.side, entry.word
    entries[first + 3], entries[first + 4], entries[first + 5] = entry.t1, entry.t2, entry.t3
    entries[first + 6], entries[first + 7] = entry.azimuth, entry.miss


def fastest(problems, entries, count):
    """`wind_search.fastest` of the rows of one array, written to the rows of another."""
    for i in range(count):
        _store_entry(entries, i, _fastest(_problem_at(problems, i)))


def local_minima(problem, entries):
    """`wind_search.local_minima`, written to the rows of an array; returns their number."""
    one, times, count = _problem_at(problem, 0), _sample_buffer(), 0
    scene = _scene_of(one)
    _sampled_times(one.side, scene, times)
    for i in range(SAMPLES):
        if _is_local_minimum(times, i):
            _store_entry(entries, count, _entry_near_sample(i, one.side, scene))
            count += 1
    return count


def build() -> Any:
    """The functions as one LLVM module, each under its own name."""
    return module_of({fastest: NOTHING(DOUBLES, DOUBLES, INTEGER), local_minima: INTEGER(DOUBLES, DOUBLES)})
