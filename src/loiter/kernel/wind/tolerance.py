"""Starts in wind that count as on the circle, or on a last arc, as they lie beyond it by less than a tolerance."""

from math import inf, pi
from typing import NamedTuple

from loiter.kernel.angles import TWO_PI, angle, arc_rotation, length
from loiter.kernel.entry import Entry
from loiter.kernel.motion import fly
from loiter.kernel.wind.fits import end_miss, fit_one_arc
from loiter.kernel.wind.hold import hold_pose, phase_of
from loiter.kernel.wind.paths import WindScene
from loiter.kernel.words import encode


class EntryBeside(NamedTuple):
    """A maneuver that ends beside the circle by `miss`, at the point of joining with this phase."""

    entry: Entry
    phase: float
    miss: float


NO_ENTRY_BESIDE = EntryBeside(Entry(0, 0, inf, 0.0, 0.0), 0.0, inf)


class ArcEnd(NamedTuple):
    """An arc that ends with the heading of a point of joining: its duration, and how far along the hold it is short."""

    t: float
    short: float


# Points of joining around the circle between which single arcs are looked for.
ARC_SAMPLES = 32


def entry_beside(sides: int, tolerance: float, scene: WindScene) -> EntryBeside:
    """The fastest maneuver of no piece or of one arc that ends within `tolerance` of the circle; T is inf for none.

    `sides` is a `words.Side`. An arc ends with the heading of its point of joining, so that its miss is the distance
    from that point.
    """
    best = NO_ENTRY_BESIDE
    for side in (1, -1):
        if sides != -side:
            phase = phase_of(scene.x, scene.y, side, scene.wx, scene.wy)
            nothing = Entry(side, 0, 0.0, 0.0, 0.0)
            if hold_miss(phase, side, scene) <= tolerance and best.entry.t1 > 0.0:
                best = EntryBeside(nothing, phase, end_miss(nothing, phase, scene))
            for u in (1, -1):
                best = faster_beside(best, arc_beside(u, 0.0, phase, side, scene), tolerance)
                best = fastest_arc_beside(best, u, side, tolerance, scene)
    return best


def hold_miss(phase: float, side: int, scene: WindScene) -> float:
    """The distance of the start from a point of joining, where an angle between the headings counts R times."""
    px, py, ce, se, _ = hold_pose(phase, side, scene.R, scene.wx, scene.wy)
    return length(length(px - scene.x, py - scene.y), scene.R * length(ce - scene.c, se - scene.s))


def fastest_arc_beside(best: EntryBeside, u: int, side: int, tolerance: float, scene: WindScene) -> EntryBeside:
    """The faster of `best` and the arcs of the control u between `ARC_SAMPLES` points of joining."""
    before = arc_end(u, 0.0, side, scene)
    for i in range(1, ARC_SAMPLES + 1):
        phase = TWO_PI / ARC_SAMPLES * i
        after = arc_end(u, phase, side, scene)
        # Where the heading of the start lies between those of two points, one of the two arcs is almost a whole turn.
        if before.short <= 0.0 <= after.short and abs(after.t - before.t) < pi:
            best = faster_beside(best, arc_beside(u, after.t, phase, side, scene), tolerance)
        before = after
    return best


def arc_end(u: int, phase: float, side: int, scene: WindScene) -> ArcEnd:
    """The end of the arc of control u that ends with the heading of a point of joining."""
    x, y, c, s, R, wx, wy, _ = scene
    px, py, ce, se, g = hold_pose(phase, side, R, wx, wy)
    t = angle(arc_rotation(u, c, s, ce, se))
    x1, y1, _, _ = fly(x, y, c, s, u, t)
    rx, ry = px - x1 - wx * t, py - y1 - wy * t
    return ArcEnd(t, (rx * (ce + wx) + ry * (se + wy)) / g)


def arc_beside(u: int, t: float, phase: float, side: int, scene: WindScene) -> EntryBeside:
    """The arc of control u next to an approximation that ends abreast of the circle, with the heading of the hold."""
    entry, phase = fit_one_arc(Entry(side, encode(u), t, 0.0, 0.0), phase, scene)
    return EntryBeside(entry, phase, end_miss(entry, phase, scene))


def faster_beside(a: EntryBeside, b: EntryBeside, tolerance: float) -> EntryBeside:
    """The maneuver that takes less time; a where b ends too far from the circle."""
    return b if b.miss <= tolerance and 0.0 <= b.entry.t1 < min(a.entry.t1, TWO_PI) else a
