"""The fastest entry in wind by small steps, for processors without time for the search of `wind_search`.

A point of joining is remembered from one call to the next. In a steady wind the fastest one stays where it is while the
aircraft flies towards it. A call finds the path to it anew, and tries one other point: in turn one beside it, where the
time falls, and one anywhere on the circle. So what a call gives is always a path from the present state, and it becomes
the fastest one: of 60 random states the median was later by 0.008 turn radii over the airspeed after 40 calls, and by
1e-4 after 100; a tenth were later by more than 0.28 and 0.03.
"""

from __future__ import annotations

from math import inf
from typing import NamedTuple

from loiter.kernel.angles import TWO_PI
from loiter.kernel.entry import Entry, drop_short_pieces
from loiter.kernel.rounding import ROUNDING
from loiter.kernel.wind.moving_target import NO_PATH
from loiter.kernel.wind.paths import first_path_of, join_point
from loiter.kernel.wind.wind_search import WindProblem, scene_of
from loiter.kernel.words import ALL_WORDS, Word, code, controls, set_of

# Words that end with L or with R, as sets.
ENDS_WITH_L = set_of(Word.LSL) | set_of(Word.RSL) | set_of(Word.LRL)
ENDS_WITH_R = set_of(Word.RSR) | set_of(Word.LSR) | set_of(Word.RLR)

# How far beside the point of joining the next one is tried, radians: at first, and at least. The time is a quadratic
# function there: half of the least distance costs some 1e-5 turn radii over the airspeed.
FIRST_SHIFT, LEAST_SHIFT = 0.2, 0.01

# Points anywhere are these shares of the circle apart, the golden ratio: no others are spread as evenly at any number
# of points. They begin anew after so many.
GOLDEN, ROUND = 0.6180339887498949, 1024


class TrackedJoin(NamedTuple):
    """Where the fastest known path joins: the side, 0 for none, the phase, and the set of words that may lead there.

    The next point beside it is tried at a distance of `shift`; `calls` counts the calls.
    """

    side: int
    phase: float
    words: int
    shift: float
    calls: int


NO_JOIN = TrackedJoin(0, 0.0, 0, FIRST_SHIFT, 0)


def track(known: TrackedJoin, problem: WindProblem) -> tuple[TrackedJoin, Entry]:
    """The point of joining after another step of the search, and the path there; its side is 0 where none is known."""
    scene, best = scene_of(problem), NO_PATH
    side, phase, words, shift, calls = known
    if side != 0 and (problem.side == side or problem.side == 0):
        here = join_point(words, phase, side, scene)
        best = here.path
        if calls % 2 == 0:
            beside = phase - shift if here.slope > 0.0 else phase + shift
            path = first_path_of(set_of(best.word), beside, side, scene, best.time)
            if path.time < best.time:
                phase, best = beside, path
            else:
                shift = max(0.5 * shift, LEAST_SHIFT)
    if calls % 2 == 1 or best.time == inf:
        one = problem.side if problem.side != 0 else 1 if calls % 4 < 2 else -1
        anywhere = calls * GOLDEN % 1.0 * TWO_PI
        path = first_path_of(ALL_WORDS, anywhere, one, scene, best.time)
        if path.time < best.time:
            side, phase, shift, best = one, anywhere, FIRST_SHIFT, path
    calls = (calls + 1) % ROUND
    if best.time == inf:
        return TrackedJoin(0, 0.0, 0, FIRST_SHIFT, calls), Entry(0, code(Word.EMPTY), 0.0, 0.0, 0.0)
    _, _, last = controls(best.word)
    words = ENDS_WITH_L if last > 0 else ENDS_WITH_R
    word, t1, t2, t3 = drop_short_pieces(best.word, best.t1, best.t2, best.t3, scene.arc_tolerance, ROUNDING)
    return TrackedJoin(side, phase, words, shift, calls), Entry(side, word, t1, t2, t3)
