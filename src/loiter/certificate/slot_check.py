"""A time before which no path arrives in a slot, by a method that shares no code with the kernel (docs/slots.md).

The poses that a vehicle reaches in exactly the time t with a given heading lie inside curves that six words bound.
Each of them is an arc of a circle or an involute, so the distance d of the slot from all of them is exact. A pose that
can be reached at t + dt lies within a few dt of one with the slot's heading at t, so there is no arrival within
d / `CLOSING` (M. E. Buzikov and A. A. Galyaev, arXiv 2210.03439). Lengths are in turn radii, times in turn radii over
airspeed; vectors are complex numbers, relative to the circle.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from math import floor, pi, tau
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from numpy import float64
    from numpy.typing import NDArray

    Reals = NDArray[float64]

# How fast slot and curves approach each other at most: the slot moves by 1, the end of the path by 1; their headings,
# which differ by 2 dt at most, are made equal by another last piece, which moves the end by up to 3 times that angle.
CLOSING = 8.0

# A slot at a smaller distance from the curves, over 1 + T, is reached.
REACHED = 1e-12


# Times closer than this, over 1 + T, are not divided; so many times, and passes that divide, at most.
FINEST, MOST_TIMES, PASSES = 1e-9, 50_000, 60

# The times of the first pass. A pass of the curves ends where the slot is `NEAR` away; samples of it, and the most
# local minima of these that are refined, on so many finer grids.
BEGIN, NEAR, SAMPLES, MINIMA, ZOOMS = 129, 1e-3, 2001, 20, 12

# The nodes that integrate the time of a hold over a piece of the circle, and the pieces of a turn.
GAUSS = np.polynomial.legendre.leggauss(8)
NODES, WEIGHTS = GAUSS[0], GAUSS[1]
PIECES = 256


def ground_speed(azimuth: Any, way: Any, w: Any) -> tuple[Any, Any]:
    """Of a hold at an azimuth, by the wind triangle, and the heading; `way` is 1 counter-clockwise, -1 clockwise."""
    track = 1j * way * np.exp(1j * azimuth)
    across, along = (w * track.conjugate()).imag, (w * track.conjugate()).real
    crab = np.sqrt(1.0 - across**2)
    return crab + along, track * (crab - 1j * across)


def hold_time(azimuth: Any, width: Any, way: Any, R: Any, w: Any) -> Any:
    """The time to hold the circle over an angle `width` from an azimuth on, by Gauss's quadrature."""
    total = np.zeros_like(azimuth + width)
    for node, weight in zip(NODES, WEIGHTS, strict=True):
        g, _ = ground_speed(azimuth + way * width * 0.5 * (1.0 + node), way, w)
        total += 0.5 * weight / g
    return R * width * total


class SlotState(NamedTuple):
    """Where a slot is: place and heading, and the control that holds the circle there, 1 the tightest left turn."""

    place: complex
    heading: complex
    control: float


@dataclass(frozen=True)
class HeldCircle:
    """A circle of radius R that is held in the direction `way`, in air of velocity w relative to it, from an azimuth.

    The *width* is the angle that has been held since then.
    """

    azimuth: float
    way: float
    R: float
    w: complex

    @cached_property
    def times(self) -> Reals:
        """The times at the ends of the pieces of a turn."""
        widths = np.full(PIECES, tau / PIECES)
        begins = self.azimuth + self.way * widths * np.arange(PIECES)
        return np.concatenate([[0.0], np.cumsum(hold_time(begins, widths, self.way, self.R, self.w))])

    def time(self, width: Reals) -> Reals:
        """The times at which angles have been held."""
        turns = np.floor(width / tau)
        piece = np.floor(np.minimum((width - tau * turns) * (PIECES / tau), PIECES - 1.0)).astype(int)
        begin = tau * turns + piece * (tau / PIECES)
        within = hold_time(self.azimuth + self.way * begin, width - begin, self.way, self.R, self.w)
        found: Reals = turns * self.times[-1] + self.times[piece] + within
        return found

    def width(self, time: float) -> float:
        """The angle that is held in a time, which may be negative."""
        period = float(self.times[-1])
        turns = floor(time / period)
        left = time - turns * period
        piece = min(np.flatnonzero(self.times <= left).size - 1, PIECES - 1)
        low, high = piece * tau / PIECES, (piece + 1) * tau / PIECES
        for _ in range(60):
            middle = 0.5 * (low + high)
            low, high = (middle, high) if float(self.time(np.array([middle]))[0]) < left else (low, middle)
        return tau * turns + 0.5 * (low + high)

    def after(self, time: float) -> HeldCircle:
        """The same circle, from where the hold is after a time, which may be negative."""
        return HeldCircle(self.azimuth + self.way * self.width(time), self.way, self.R, self.w)

    def state(self) -> SlotState:
        """Place, heading and control where the hold begins."""
        g, heading = ground_speed(self.azimuth, self.way, self.w)
        out = np.exp(1j * self.azimuth)
        crab = float((heading.conjugate() * 1j * self.way * out).real)
        return SlotState(complex(self.R * out), complex(heading), float(self.way * g * g / (self.R * crab)))


def distance(place: Any, angle: Any, t: Any) -> Any:
    """The distance of places from the curves of all words that end with a heading at the time t, from 0 along 1."""
    best = np.abs(place) + np.inf
    for u in (1.0, -1.0):
        turned = (u * angle) % tau
        # A heading that only a single arc reaches in time: how far its end and its heading are from the slot's.
        arc_end, short = 1j * u * (1.0 - np.exp(1j * u * t)), np.abs((turned - t + pi) % tau - pi)
        best = np.minimum(best, np.maximum(np.abs(place - arc_end), 0.5 * CLOSING * short))
        same = place - 1j * u * (1.0 - np.exp(1j * angle))
        other = place - 1j * u * (1.0 + np.exp(1j * angle))
        best = np.minimum(best, _beside_same(same, u, turned, t))
        best = np.fmin(best, _beside_other(other, u, turned, t))
        best = np.minimum(best, _beside_three_arcs(same, u, turned, t))
    return best


def _beside_same(same: Any, u: float, turned: Any, t: Any) -> Any:
    """The distance from the curves of LSL or RSR."""
    best = np.abs(same) + np.inf
    for k in range(3):
        arcs = turned + tau * k
        straight = t - arcs
        for a in (0.0 * t, arcs, (u * np.angle(same)) % tau):
            ok = (straight >= 0.0) & (a <= arcs)
            best = np.where(ok, np.minimum(best, np.abs(same - straight * np.exp(1j * u * a))), best)
    return best


def _beside_other(other: Any, u: float, turned: Any, t: Any) -> Any:
    """The distance from the curves of LSR or RSL, which are involutes."""
    best = np.abs(other) + np.inf
    with np.errstate(invalid="ignore", divide="ignore"):
        tip = np.arcsin(-2.0 * u / np.abs(other))
    for k in range(-2, 2):
        more = turned + tau * k
        least, most = np.maximum(more, 0.0), 0.5 * (t + more)
        found = [least, most]
        for direction in (np.angle(other) - tip, np.angle(other) - pi + tip):
            found += [(u * direction) % tau + tau * n for n in range(3)]
        for a in found:
            end = (t - 2.0 * a + more - 2j * u) * np.exp(1j * u * a)
            ok = (a >= least) & (a <= most)
            best = np.where(ok, np.fmin(best, np.abs(other - end)), best)
    return best


def _beside_three_arcs(same: Any, u: float, turned: Any, t: Any) -> Any:
    """The distance from the curves of LRL or RLR."""
    best = np.abs(same) + np.inf
    for k in range(2):
        middle = 0.5 * ((t - turned) % tau) + pi * k
        most = t - middle
        chord = 2j * u * (np.exp(-1j * u * middle) - 1.0)
        for a in (0.0 * t, most, (u * (np.angle(same) - np.angle(chord))) % tau):
            ok = (most >= 0.0) & (a <= most)
            best = np.where(ok, np.minimum(best, np.abs(same - chord * np.exp(1j * u * a))), best)
    return best


class Watched(NamedTuple):
    """A slot seen from a start: the times, its distances from the curves, and the times for which they exclude it."""

    width: Reals
    time: Reals
    gap: Reals
    clear: Reals


class NearPass(NamedTuple):
    """A span of times in which a slot passes near the curves, and the least distance that samples find in it."""

    begin: float
    end: float
    gap: float


class LowerBound(NamedTuple):
    """A time before which there is no arrival in a slot, and the near passes before it, which samples alone decide."""

    time: float
    passed: tuple[NearPass, ...]


def watched(start: complex, heading: complex, circle: HeldCircle, width: Reals) -> Watched:
    """The slot, at which the hold begins, after angles held."""
    time = circle.time(width)
    azimuth = circle.azimuth + circle.way * width
    _, slot_heading = ground_speed(azimuth, circle.way, circle.w)
    place = (circle.R * np.exp(1j * azimuth) - circle.w * time - start) / heading
    beyond = np.abs(place) - time
    gap = distance(place, np.angle(slot_heading / heading), time)
    # Beyond the reach of any path, slot and reach approach each other at twice the airspeed at most.
    return Watched(width, time, gap, np.maximum(gap / CLOSING, 0.5 * beyond))


def resolution(until: float) -> float:
    """By how much the bound may be less than an arrival: d may vanish as the cube of the time that remains, over 24."""
    return float((24.0 * REACHED * (1.0 + until)) ** (1.0 / 3.0))


def no_arrival_before(start: complex, heading: complex, circle: HeldCircle, until: float) -> LowerBound:
    """A time before which no path from a start arrives in the slot at which a hold begins; at most `until`.

    Times are divided until each excludes an arrival up to the next one. Where they would be too close or too many, the
    slot is reached, or passes near the curves: samples find the least distance until it is `NEAR` away again.
    """
    reached, later = REACHED * (1.0 + until), resolution(until)
    begin, last = 0.0, circle.width(until)
    passed: list[NearPass] = []
    limit = circle.width(max(until - 0.9 * later, 0.0))
    while True:
        stopped = _first_unclear(start, heading, circle, np.linspace(begin, last, BEGIN), FINEST * (1.0 + until))
        if stopped is None or until - stopped.time <= later:
            return LowerBound(until if stopped is None else stopped.time, tuple(passed))
        begin, end = stopped.width, _end_of_pass(start, heading, circle, stopped.width, limit)
        gap = _least_gap(start, heading, circle, begin, end)
        if gap <= reached:
            return LowerBound(stopped.time, tuple(passed))
        ends = float(circle.time(np.array([end]))[0])
        passed.append(NearPass(stopped.time, ends, gap))
        if end >= limit:
            return LowerBound(ends, tuple(passed))
        begin = end


class Stop(NamedTuple):
    """An angle held, and the time then."""

    width: float
    time: float


def _excludes(seen: Watched) -> Any:
    """Whether each time excludes an arrival up to the next one; a distance that is nan does not."""
    return seen.time[:-1] + seen.clear[:-1] >= seen.time[1:]


def _first_unclear(start: complex, heading: complex, circle: HeldCircle, widths: Reals, finest: float) -> Stop | None:
    """The first of the divided times that does not exclude an arrival up to the next one; None if all do."""
    seen = watched(start, heading, circle, widths)
    for _ in range(PASSES):
        unclear = np.flatnonzero(~_excludes(seen))
        close = unclear[seen.time[unclear + 1] - seen.time[unclear] <= finest]
        if close.size:
            seen = Watched(*(field[: close[0] + 2] for field in seen))
            unclear = unclear[unclear < close[0]]
        if unclear.size == 0 or seen.time.size + unclear.size > MOST_TIMES:
            break
        between = watched(start, heading, circle, 0.5 * (seen.width[unclear] + seen.width[unclear + 1]))
        seen = Watched(*(np.insert(old, unclear + 1, new) for old, new in zip(seen, between, strict=True)))
    left = np.flatnonzero(~_excludes(seen))
    return Stop(float(seen.width[left[0]]), float(seen.time[left[0]])) if left.size else None


def _end_of_pass(start: complex, heading: complex, circle: HeldCircle, begin: float, limit: float) -> float:
    """The first sample, up to a limit, at which the slot is `NEAR` away from the curves again."""
    seen = watched(start, heading, circle, np.linspace(begin, limit, SAMPLES))
    away = np.flatnonzero(seen.gap[1:] >= NEAR)
    return float(seen.width[away[0] + 1]) if away.size else limit


def _least_gap(start: complex, heading: complex, circle: HeldCircle, begin: float, end: float) -> float:
    """The least distance between two angles: the local minima of samples, each on finer and finer grids."""
    seen = watched(start, heading, circle, np.linspace(begin, end, SAMPLES))
    # The last sample may be next to the arrival itself: it is none of the minima.
    before, after = np.concatenate([[np.inf], seen.gap[:-1]]), np.concatenate([seen.gap[1:], [-np.inf]])
    lowest = np.flatnonzero((seen.gap <= before) & (seen.gap <= after))
    best = float(seen.gap.min()) if lowest.size == 0 else np.inf
    for k in lowest[np.argsort(seen.gap[lowest])][:MINIMA]:
        low, high = float(seen.width[max(k - 1, 0)]), float(seen.width[min(k + 1, SAMPLES - 1)])
        for _ in range(ZOOMS):
            finer = watched(start, heading, circle, np.linspace(low, high, 21))
            best, at = min(best, float(finer.gap.min())), int(finer.gap.argmin())
            low, high = float(finer.width[max(at - 1, 0)]), float(finer.width[min(at + 1, 20)])
    return best
