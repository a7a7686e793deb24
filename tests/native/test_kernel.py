"""The generated C beside the Python it comes from: the same bits, and the same path through the search."""

from collections import Counter
from math import nan
from random import Random

import pytest

from compiled.windy import BAD, drawn
from golden.wind_scenes import CORNERS, SLOW, VALLEYS
from kernel.test_wind_tolerance import beside_last_arc
from loiter.kernel.entry import Entry, miss
from loiter.kernel.rebinding import rebinding
from loiter.kernel.rounding import rounded_radius
from loiter.kernel.statuses import Status
from loiter.kernel.still_air import synthesis
from loiter.kernel.wind import wind_search
from native import states
from native.library import COUNTED, build, counting, needs_compiler

pytestmark = needs_compiler


@pytest.fixture(scope="module")
def library(tmp_path_factory):
    """The library, which counts calls."""
    return build(tmp_path_factory.mktemp("native"), counting)


def text(value):
    """All digits and signs, and nan equal to itself."""
    return repr(value)


def solved(x, y, R, side, tolerance):
    """What `Library.optimum` returns, in plain Python."""
    status = synthesis.status_of(x, y, R, tolerance)
    if status != Status.OK:
        return int(status), None, None
    R = rounded_radius(R)
    entry = synthesis.optimum(x, y, R, side, tolerance)
    return 0, Entry(*entry), miss(x, y, R, entry)


def least_time(x, y, R, side, tolerance):
    """What `Library.least_time` returns, in plain Python."""
    if not synthesis.is_solvable(x, y, R, tolerance):
        return nan
    R, near = rounded_radius(R), synthesis.side_or_near(y, side)
    sides = (near,) if side != 0 or tolerance == 0.0 else (near, -near)
    return min(synthesis.least_time(x, y, R, one, tolerance) for one in sides)


def check_still_air(library, rows):
    """Compare maneuvers, misses and least times of states."""
    for row in rows:
        assert text(library.optimum(*row)) == text(solved(*row)), row
        assert text(library.least_time(*row)) == text(least_time(*row)), row


def check_in_wind(library, problems):
    """Compare maneuvers, and how often the functions of `COUNTED` are called.

    The counts differ where a decision does that happens to leave the answer as it is.
    """
    calls = Counter()

    def counted(function):
        def count(*arguments):
            calls[function.__name__] += 1
            return function(*arguments)

        return count if function.__name__ in COUNTED else function

    fastest = rebinding(finish=counted)(wind_search.fastest)
    for problem in problems:
        calls.clear()
        before = library.calls()
        assert text(library.fastest(problem)) == text(wind_search.WindEntry(*fastest(problem))), problem
        counts = [after - earlier for after, earlier in zip(library.calls(), before, strict=True)]
        assert counts == [calls[name] for name in COUNTED], problem


@pytest.mark.parametrize(
    "rows", [states.drawn(10_000, 0), states.drawn(5_000, 1, nearest=-17.0), states.SPECIAL[::7]], ids=len
)
def test_a_state_in_still_air_has_the_same_bits(library, rows):
    check_still_air(library, rows)


def scenes():
    """Problems in wind: drawn, bad, slow, and some with a tolerance, also beside a last arc; and some on a last arc."""
    random = Random(3)
    beside = [beside_last_arc(random, 0.01, random.uniform(-0.9, 0.9))[0] for _ in range(20)]
    beside += [beside_last_arc(random, 0.0, 0.0)[0] for _ in range(20)]
    some = [*drawn(160, 1), *drawn(80, 2, 0.95)]
    tolerant = [problem._replace(tolerance=10.0 ** (-1.0 - i % 6)) for i, problem in enumerate(drawn(40, 5))]
    return [*some, *BAD, *SLOW, *(problem for problem, _ in (*VALLEYS, *CORNERS)), *tolerant, *beside]


def test_the_search_in_wind_has_the_same_bits_after_the_same_steps(library):
    check_in_wind(library, scenes())


def one_sided(library):
    """Problems on one side each, for local minima."""
    problems = [problem._replace(side=problem.side or 1) for problem in drawn(16, 3)]
    return [problem for problem in problems if library.fastest(problem).status == Status.OK]


def test_the_local_minima_in_wind_have_the_same_bits(library):
    for problem in one_sided(library):
        assert text(library.local_minima(problem)) == text(wind_search.local_minima(problem)), problem
