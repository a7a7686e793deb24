"""Which extremal is the fastest: the optimum, every extremal in order, the feedback law."""

from math import cbrt, inf, isfinite
from typing import NamedTuple

from loiter.kernel.angles import length
from loiter.kernel.extremals import Extremal, durations, extremals, fastest
from loiter.kernel.motion import flow
from loiter.kernel.statuses import Status
from loiter.kernel.words import ABSENT, Side, controls, encode, mirrored, rest


class Entry(NamedTuple):
    """A maneuver: the side of its circle, its word as flown, and the durations of its pieces (0 past the last)."""

    side: int
    word: int
    t1: float
    t2: float
    t3: float


# Rounding error of a length of order one: the reduction (2) costs 2 roundings a coordinate, a difference of squares 6,
# the angle and the flight of each of three pieces about 10; 64 units of 2**-52 is the next power of two above the sum.
ROUNDING = 64.0 * 2.0**-52

# Beyond this many turn radii neighbouring doubles are a turn radius apart.
REACH = 2.0**52


def rounding(x: float, y: float, R: float) -> float:
    """The length tolerance: the rounding error of lengths for a state and a circle of this size."""
    return ROUNDING * (1.0 + abs(x) + abs(y) + R)


def rounded_radius(R: float) -> float:
    """R, or 1 where R is less than 1 by rounding only: a circle as tight as the aircraft can turn."""
    return 1.0 if 1.0 - ROUNDING <= R < 1.0 else R


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


def drop_short_pieces(
    word: int, t1: float, t2: float, t3: float, short: float, no_angle: float
) -> tuple[int, float, float, float]:
    """The word as flown: without a straight piece up to `short` and arcs up to `no_angle`; equal arcs are joined."""
    first, _, last = controls(word)
    if last != ABSENT and t2 <= short:
        if first == last:
            word, t1, t2, t3 = encode(first), t1 + t3, 0.0, 0.0
        else:
            word, t2, t3 = encode(first, last), t3, 0.0
    first, second, third = controls(word)
    if second != ABSENT and third == ABSENT and t2 <= no_angle:
        word, t2 = encode(first), 0.0
    if t1 <= no_angle:
        word, t1, t2, t3 = rest(word), t2, t3, 0.0
    return word, t1, t2, t3


def arc_tolerance_of(x: float, y: float, R: float, tolerance: float) -> float:
    """The share of the end-point tolerance that each of at most three pieces may use up."""
    return max(tolerance, rounding(x, y, R)) / 3.0


def flown_entry(extremal: Extremal, length_tolerance: float, side: int) -> Entry:
    """An extremal of the clockwise circle as the maneuver flown onto the circle of the given side.

    Leaving out a piece, or an almost full turn, moves the end by at most a third of `length_tolerance`, since the
    radius of an arc is no more than 1 + |x| + |y| + R. So three pieces together miss the target by no more than
    `length_tolerance`.
    """
    t1, t2, t3 = durations(extremal)
    word, t1, t2, t3 = drop_short_pieces(extremal.word + 0, t1, t2, t3, length_tolerance / 3.0, ROUNDING / 3.0)
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
    return side + 0 if side != Side.EITHER else near_side(y)


def is_faster(maneuver: Entry, other: Entry, length_tolerance: float) -> bool:
    """Whether a maneuver is faster than another by more than rounding."""
    return duration(maneuver) < duration(other) - length_tolerance


def optimum_on_side(x: float, y: float, R: float, side: int, tolerance: float) -> Entry:
    """The fastest maneuver onto the circle held on one side."""
    _, best = fastest(x, side * y, R, arc_tolerance_of(x, y, R, tolerance), tolerance == 0.0)
    return flown_entry(best, rounding(x, y, R), side)


def least_time(x: float, y: float, R: float, side: int, tolerance: float) -> float:
    """T of `optimum_on_side`, without its pieces; a piece that is too short to be flown may be included."""
    time, _ = fastest(x, side * y, R, arc_tolerance_of(x, y, R, tolerance), tolerance == 0.0)
    return time


def duration(maneuver: Entry) -> float:
    """T, the whole time of a maneuver."""
    return maneuver.t1 + maneuver.t2 + maneuver.t3


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


def is_same(a: Entry, b: Entry, length_tolerance: float) -> bool:
    """Whether two maneuvers, found as limits of two words, are the same."""
    difference = max(abs(a.t1 - b.t1), abs(a.t2 - b.t2), abs(a.t3 - b.t3))
    return a.side == b.side and a.word == b.word and difference <= length_tolerance


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


# In wind maneuvers tie if their times agree to this share of 1 + R + T: the accuracy found in docs/wind.md, section 6.
WIND_TIE_TOLERANCE = 1e-12


def is_tie(T: float, least: float, length_tolerance: float) -> bool:
    """Whether a time T equals the least time in still air: up to the rounding of the scene, `rounding`."""
    return least + length_tolerance >= T


def is_tie_in_wind(T: float, least: float, R: float) -> bool:
    """Whether a time T equals the least time in wind, within the accuracy of `wind_search.fastest`."""
    return T - least <= WIND_TIE_TOLERANCE * (1.0 + R + least)


def time_apart(a: Entry, b: Entry) -> float:
    """The time during which two maneuvers fly different controls."""
    apart, begin = 0.0, 0.0
    for end in sorted([*piece_ends(a), *piece_ends(b)]):
        if control_at(a, begin) != control_at(b, begin):
            apart += end - begin
        begin = end
    return apart


def piece_ends(maneuver: Entry) -> tuple[float, float, float]:
    """The times at which the pieces of a maneuver end."""
    _, _, t1, t2, t3 = maneuver
    return t1, t1 + t2, t1 + t2 + t3


def control_at(maneuver: Entry, t: float) -> int:
    """The control flown from the time t on; `ABSENT` past the end."""
    for u, end in zip(controls(maneuver.word), piece_ends(maneuver)):
        if t < end:
            return u
    return ABSENT


def first_control(R: float, maneuver: Entry) -> float:
    """Feedback law: the first control of a maneuver; at the target the rate -1/R or 1/R that holds the circle."""
    first, _, _ = controls(maneuver.word)
    return float(first) if first != ABSENT else -maneuver.side / R


def miss(x: float, y: float, R: float, maneuver: Entry) -> float:
    """The distance from the target, in the reduced plane, at which a maneuver from (x, y) ends when flown exactly."""
    side, word, t1, t2, t3 = maneuver
    for u, t in zip(controls(word), (t1, t2, t3)):
        if u != ABSENT:
            x, y = flow(x, y, u, t)
    return length(x, y - side * R)
