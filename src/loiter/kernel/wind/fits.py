"""Entries in wind that consist of one or two arcs: Newton's method moves their end onto the circle.

A search among the words of three pieces, of which they are the limits, finds them only up to rounding.
"""

from math import atan2

from loiter.kernel.angles import length
from loiter.kernel.entry import Entry, duration
from loiter.kernel.motion import fly
from loiter.kernel.wind.hold import hold_pose, hold_rate
from loiter.kernel.wind.paths import WindCandidate, WindScene
from loiter.kernel.words import ABSENT, controls, encode

# Where two arcs are the fastest, the search ends on a word with a short third piece that is due to rounding: a straight
# piece of up to the square root of 4e-14 where the phase is accurate to 1e-14.
SHORT = 1e-4

# Newton's method reduces an error of 1e-4 to rounding in three steps.
ARC_STEPS = 8

# The path found next to two arcs may be too early by this many times its miss: both vary with the adjoint, whose length
# over lambda + p . w stays below 10 where lambda = 1 and |w| < 0.9.
TOO_EARLY = 10.0


def two_arc_entry(found: WindCandidate, short: float) -> Entry:
    """The two arcs left of a word whose third piece lasts `short` or less; the empty word where there are none."""
    _, side, path = found
    first, middle, last = controls(path.word)
    if middle == 0:
        if path.t2 <= short and first != last:
            return Entry(side, encode(first, last), path.t1, path.t3, 0.0)
    elif path.t1 <= min(short, path.t3):
        return Entry(side, encode(middle, last), path.t2, path.t3, 0.0)
    elif path.t3 <= short:
        return Entry(side, encode(first, middle), path.t1, path.t2, 0.0)
    return Entry(side, 0, 0.0, 0.0, 0.0)


def fit_two_arcs(arcs: Entry, phase: float, scene: WindScene) -> tuple[Entry, float]:
    """Two arcs that end on the circle, and their phase, from an approximation, by Newton's method.

    Where the headings agree, joining later by s along the circle moves the point of joining just as flying the second
    arc for s longer moves the end of the path. So the position determines t1 and t2 - s, and then the heading
    determines s.
    """
    x, y, c, s, R, wx, wy, arc_tolerance = scene
    side, word, t1, t2, _ = arcs
    first, second, _ = controls(word)
    for _ in range(ARC_STEPS):
        x1, y1, c1, s1 = fly(x, y, c, s, first, t1)
        x2, y2, c2, s2 = fly(x1, y1, c1, s1, second, t2)
        px, py, ce, se, g = hold_pose(phase, side, R, wx, wy)
        rx, ry = px - x2 - wx * (t1 + t2), py - y2 - wy * (t1 + t2)
        # How the end moves with t1, which turns the second arc about its start, and with t2.
        ax, ay = c1 + wx - first * (y2 - y1), s1 + wy + first * (x2 - x1)
        bx, by = c2 + wx, s2 + wy
        across, bend = ax * by - ay * bx, second + side * hold_rate(phase, side, R, wx, wy)
        if across == 0.0 or bend == 0.0:
            break
        d1, d2 = (rx * by - ry * bx) / across, (ax * ry - ay * rx) / across
        later = (atan2(c2 * se - s2 * ce, c2 * ce + s2 * se) - first * d1 - second * d2) / bend
        t1, t2, phase = t1 + d1, t2 + d2 + later, phase + later * g / R
        if abs(d1) + abs(d2) + abs(later) <= arc_tolerance:
            break
    return Entry(side, word, t1, t2, 0.0), phase


def one_arc_entry(found: WindCandidate) -> Entry:
    """The arc left of a word whose other pieces together last `SHORT` or less; the empty word where there is none."""
    _, side, path = found
    first, middle, last = controls(path.word)
    if first == last and path.t2 <= SHORT:
        return Entry(side, encode(first), path.t1 + path.t3, 0.0, 0.0)
    if middle != 0 and path.t1 + path.t3 <= SHORT:
        return Entry(side, encode(middle), path.t2, 0.0, 0.0)
    if path.t2 + path.t3 <= SHORT:
        return Entry(side, encode(first), path.t1, 0.0, 0.0)
    if path.t1 + path.t2 <= SHORT:
        return Entry(side, encode(last), path.t3, 0.0, 0.0)
    return Entry(side, 0, 0.0, 0.0, 0.0)


def fit_one_arc(arc: Entry, phase: float, scene: WindScene) -> tuple[Entry, float]:
    """One arc that ends on the circle, and its phase, from an approximation, by Newton's method.

    It can end on the circle and along it only where the start is on it by rounding. The end and the point of joining
    move in the same direction, so the distance between them along it determines the duration of the arc less the time s
    by which it joins later, and then the heading determines s.
    """
    x, y, c, s, R, wx, wy, arc_tolerance = scene
    side, word, t, _, _ = arc
    u, _, _ = controls(word)
    for _ in range(ARC_STEPS):
        x1, y1, c1, s1 = fly(x, y, c, s, u, t)
        px, py, ce, se, g = hold_pose(phase, side, R, wx, wy)
        rx, ry, vx, vy = px - x1 - wx * t, py - y1 - wy * t, ce + wx, se + wy
        longer, bend = (rx * vx + ry * vy) / (g * g), u + side * hold_rate(phase, side, R, wx, wy)
        if bend == 0.0:
            break
        later = (atan2(c1 * se - s1 * ce, c1 * ce + s1 * se) - u * longer) / bend
        t, phase = t + longer + later, phase + later * g / R
        if abs(longer) + abs(later) <= arc_tolerance:
            break
    return Entry(side, word, t, 0.0, 0.0), phase


def polish(found: WindCandidate, scene: WindScene) -> tuple[Entry, float]:
    """The maneuver and phase of a candidate, or those of one or two of its arcs alone if close and no slower."""
    phase, side, path = found
    entry = Entry(side, path.word, path.t1, path.t2, path.t3)
    latest = path.time + TOO_EARLY * end_miss(entry, phase, scene)
    arc, arcs = one_arc_entry(found), two_arc_entry(found, SHORT)
    if arc.word != 0:
        arc, arc_phase = fit_one_arc(arc, phase, scene)
        if is_close(arc, arc_phase, latest, scene):
            return arc, arc_phase
    if arcs.word != 0:
        arcs, arcs_phase = fit_two_arcs(arcs, phase, scene)
        if is_close(arcs, arcs_phase, latest, scene):
            return arcs, arcs_phase
    return entry, phase


def is_close(arcs: Entry, phase: float, latest: float, scene: WindScene) -> bool:
    """Whether one or two arcs end on the circle, and no later than `latest`, up to rounding."""
    both_flown = min(arcs.t1, arcs.t2) >= 0.0
    late = duration(arcs) - latest
    return both_flown and max(late, end_miss(arcs, phase, scene)) <= 3.0 * scene.arc_tolerance


def end_miss(entry: Entry, phase: float, scene: WindScene) -> float:
    """The distance of the end of a maneuver, flown exactly, from a point of joining: position and heading together."""
    x, y, c, s, R, wx, wy, _ = scene
    side, word, t1, t2, t3 = entry
    for u, t in zip(controls(word), (t1, t2, t3)):
        if u != ABSENT:
            x, y, c, s = fly(x, y, c, s, u, t)
            x, y = x + wx * t, y + wy * t
    px, py, ce, se, _ = hold_pose(phase, side, R, wx, wy)
    return length(length(px - x, py - y), length(ce - c, se - s))
