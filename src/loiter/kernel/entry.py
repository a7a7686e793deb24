"""Maneuvers as numbers: the side, the word and the durations of an entry, and which entries are the same or tie."""

from typing import NamedTuple

from loiter.kernel.angles import length
from loiter.kernel.motion import flow
from loiter.kernel.words import ABSENT, controls, encode, rest


class Entry(NamedTuple):
    """A maneuver: the side of its circle, its word as flown, and the durations of its pieces (0 past the last)."""

    side: int
    word: int
    t1: float
    t2: float
    t3: float


def duration(maneuver: Entry) -> float:
    """T, the whole time of a maneuver."""
    return maneuver.t1 + maneuver.t2 + maneuver.t3


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


def is_faster(maneuver: Entry, other: Entry, length_tolerance: float) -> bool:
    """Whether a maneuver is faster than another by more than rounding."""
    return duration(maneuver) < duration(other) - length_tolerance


def is_same(a: Entry, b: Entry, length_tolerance: float) -> bool:
    """Whether two maneuvers, found as limits of two words, are the same."""
    difference = max(abs(a.t1 - b.t1), abs(a.t2 - b.t2), abs(a.t3 - b.t3))
    return a.side == b.side and a.word == b.word and difference <= length_tolerance


def time_apart(a: Entry, b: Entry) -> float:
    """The time during which two maneuvers fly different controls."""
    apart, begin = 0.0, 0.0
    for end in sorted([*piece_ends(a), *piece_ends(b)]):
        if control_at(a, begin) != control_at(b, begin):
            apart += end - begin
        begin = end
    return apart


def is_tie(T: float, least: float, length_tolerance: float) -> bool:
    """Whether a time T equals the least time in still air: up to the rounding of the scene, `rounding`."""
    return least + length_tolerance >= T


# In wind maneuvers tie if their times agree to this share of 1 + R + T: the accuracy found in docs/wind.md, section 6.
WIND_TIE_TOLERANCE = 1e-12


def is_tie_in_wind(T: float, least: float, R: float) -> bool:
    """Whether a time T equals the least time in wind, within the accuracy of `wind_search.fastest`."""
    return T - least <= WIND_TIE_TOLERANCE * (1.0 + R + least)
