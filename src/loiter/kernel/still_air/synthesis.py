"""Which extremal is the fastest in still air: the optimum, and every extremal in order."""

from math import cbrt, inf, isfinite

from loiter.kernel.entry import Entry, drop_short_pieces, duration, is_faster, is_same, is_tie, time_apart
from loiter.kernel.rounding import REACH, ROUNDING, arc_tolerance_of, rounded_radius, rounding
from loiter.kernel.statuses import Status
from loiter.kernel.still_air.extremals import Extremal, durations, extremals, fastest
from loiter.kernel.words import Side, code, mirrored


def is_solvable(x: float, y: float, R: float, tolerance: float) -> bool:
    """Whether `status_of` is OK: state and circle are within REACH, and the circle can be held."""
    near = abs(x) <= REACH and abs(y) <= REACH and 0.0 <= tolerance <= REACH
    return near and 1.0 - ROUNDING <= R <= REACH


def status_of(x: float, y: float, R: float, tolerance: float) -> Status:
    """`Status.OK`, or why there is nothing to solve."""
    if is_solvable(x, y, R, tolerance):
        return Status.OK
    if not (isfinite(x) and isfinite(y) and isfinite(R)):
        return Status.NOT_FINITE
    if rounded_radius(R) < 1.0:
        return Status.RADIUS_TOO_SMALL
    if abs(x) > REACH or abs(y) > REACH or R > REACH:
        return Status.OUT_OF_RANGE
    return Status.BAD_TOLERANCE


def flown_entry(extremal: Extremal, length_tolerance: float, side: int) -> Entry:
    """An extremal of the clockwise circle as the maneuver flown onto the circle of the given side.

    Leaving out a piece, or an almost full turn, moves the end by at most a third of `length_tolerance`, since the
    radius of an arc is no more than 1 + |x| + |y| + R. So three pieces together miss the target by no more than
    `length_tolerance`.
    """
    t1, t2, t3 = durations(extremal)
    word, t1, t2, t3 = drop_short_pieces(code(extremal.word), t1, t2, t3, length_tolerance / 3.0, ROUNDING / 3.0)
    return Entry(side, mirrored(word) if side < 0 else word, t1, t2, t3)


def near_side(y: float) -> int:
    """The side that is never slower: T_either(x, y) = T_cw(x, |y|) (paper, section 5); clockwise on y = 0."""
    return -1 if y < 0.0 else 1


def optimum(x: float, y: float, R: float, side: int, tolerance: float) -> Entry:
    """The fastest maneuver onto the circle from the reduced state (x, y); to be called only where `status_of` is OK.

    For *either*, the far side can be faster than the near one only within a tolerance; only then are both solved.
    """
    near = optimum_on_side(x, y, R, side_or_near(y, side), tolerance)
    if side != Side.EITHER or tolerance == 0.0:
        return near
    far = optimum_on_side(x, y, R, -near_side(y), tolerance)
    return far if is_faster(far, near, rounding(x, y, R)) else near


def side_or_near(y: float, side: int) -> int:
    """The side itself; for *either*, the near side."""
    return code(side) if side != Side.EITHER else near_side(y)


def optimum_on_side(x: float, y: float, R: float, side: int, tolerance: float) -> Entry:
    """The fastest maneuver onto the circle held on one side."""
    _, best = fastest(x, side * y, R, arc_tolerance_of(x, y, R, tolerance), tolerance == 0.0)
    return flown_entry(best, rounding(x, y, R), side)


def least_time(x: float, y: float, R: float, side: int, tolerance: float) -> float:
    """T of `optimum_on_side`, without its pieces; a piece that is too short to be flown may be included."""
    time, _ = fastest(x, side * y, R, arc_tolerance_of(x, y, R, tolerance), tolerance == 0.0)
    return time


def ranked(x: float, y: float, R: float, side: int, tolerance: float) -> list[Entry]:
    """Every extremal that reaches the circle, each once, fastest first; for *either*, those of both sides.

    Extremals that are faster than the optimum are left out: they end beside the target, within a tolerance.
    """
    length_tolerance = rounding(x, y, R)
    least = duration(optimum(x, y, R, side, tolerance)) - length_tolerance
    sides = [near_side(y), -near_side(y)] if side == Side.EITHER else [side]
    maneuvers: list[Entry] = []
    for s in sides:
        for extremal in extremals(x, s * y, R, arc_tolerance_of(x, y, R, tolerance)):
            maneuver = flown_entry(extremal, length_tolerance, s)
            known = any(is_same(maneuver, other, length_tolerance) for other in maneuvers)
            time = duration(maneuver)
            if least <= time < inf and not known:
                maneuvers.append(maneuver)
    return sorted(maneuvers, key=duration)


def optima(x: float, y: float, R: float, side: int, tolerance: float) -> list[Entry]:
    """Every optimal maneuver: those of `ranked` that tie with the fastest up to rounding, and differ by more than that.

    Where a straight piece of length s vanishes, the words with and without it differ in T by s^3/24 only (where an arc
    vanishes at a switching curve: by s^2). So both tie for s up to the cube root of rounding: they count as one.
    """
    maneuvers = ranked(x, y, R, side, tolerance)
    length_tolerance = rounding(x, y, R)
    least = min(map(duration, maneuvers), default=inf)
    one_maneuver = 2.0 * cbrt(24.0 * length_tolerance)
    distinct: list[Entry] = []
    for maneuver in maneuvers:
        ties = is_tie(duration(maneuver), least, length_tolerance)
        if ties and all(maneuver.side != m.side or time_apart(maneuver, m) > one_maneuver for m in distinct):
            distinct.append(maneuver)
    return distinct
