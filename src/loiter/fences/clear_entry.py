"""The fastest entry that stays clear of a fence: the candidates, then a search over where a path can touch it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import atan2, inf, nan
from typing import NamedTuple

from loiter.errors import InvalidArgument, instance
from loiter.fences.airs import STILL_AIR_GAP_M, WIND_GAP_M, Air, Pose2, SteadyWind, StillAir
from loiter.fences.chains import NO_PIECE_M, Chain, ChainSearch, Piece
from loiter.fences.contacts import (
    Contacts,
    Curve,
    Row,
    beside,
    curves_of,
    placed,
    rows_of,
    rows_on,
    rows_on_tangents,
    rows_without_straight,
)
from loiter.fences.entry_bound import least_length
from loiter.fences.fence import Fence, FenceCheck, checked_margin_m, zones_on_circle
from loiter.fences.lattice import PathSearch
from loiter.fences.model import clear_points
from loiter.fences.taut import least_length_m
from loiter.planning.compass import heading_vector
from loiter.planning.maneuver import Maneuver
from loiter.planning.model import CALM, CONTROLS, Aircraft, Orbit, Pose, Segment, Turn, Wind
from loiter.planning.problem import Problem, segment
from loiter.planning.solve import extremals

# The first search has one contact for each step of `contacts`; where it finds nothing, or nothing that is less than
# `LATE` turn radii longer than the fastest entry, a second one follows, in still air with half the steps.
PASSES, LATE = (1, 2), 1.0

# Chains that are longer than the first one by up to so many turn radii are refined too, up to so many of them.
SLACK, MOST_CHAINS = 0.5, 4

# Steps are halved so many times: the last is then a thousandth of a degree, or less than a millimetre.
HALVINGS = 14

# The largest number of poses from which a search goes on, in still air and in wind.
MOST_POSES, MOST_POSES_IN_WIND = 1500, 60

# Steps of Newton's method towards a tangent, which begin within a step of it: the errors are squared.
TANGENT_STEPS = 5

# In wind the second search has contacts farther from the zones too, by these shares of a turn radius: over the ground
# turns are tighter in some directions than in others, so that a path bends about a zone without touching it.
WIDER = (0.2, 0.5)

# Unless that is less than `NEAR` turn radii longer than the fastest entry, lattices of steps of so many turn radii are
# searched then: the last one passes between zones that leave the others no pose.
NEAR = 0.05
LATTICE_STEPS = (0.25, 0.12, 0.06, 0.03)

# A path of a lattice that is shorter by less, metres, is the same.
LEAST_GAIN_M = 0.01

# Paths of a lattice of more pieces than this are no improvement: they zigzag, and the law follows no more pieces.
MOST_PIECES = 12

# Where no entry is found in wind, the bound is at most this later than the fastest one, turn radii over airspeed.
LONGER_IN_WIND = 40.0

LETTERS = {float(control): letter for letter, control in CONTROLS.items()}

# Differences below this, seconds, are printed as none.
SAME_TIME_S = 0.05


class ClearEntry(NamedTuple):
    """The answer of `first_clear` and of `clear_entry`.

    `maneuver` is the fastest that stays clear, `check` its check, and `later_s` how much later than the fastest of all
    it joins, seconds; None, None and nan where none is clear. `tried` counts the candidates that were checked, and
    `blocking` names the zones that the others breach first. No clear entry takes less than `least_s` seconds; where
    that is infinite there is none. `searched` says whether other paths than candidates were searched for.
    """

    maneuver: Maneuver | None
    check: FenceCheck | None
    later_s: float
    tried: int
    blocking: tuple[str, ...]
    least_s: float = 0.0
    searched: bool = False

    @property
    def is_fastest(self) -> bool:
        """Whether the fastest entry is clear itself."""
        return self.maneuver is not None and self.tried == 1 and not self.searched

    @property
    def sentence(self) -> str:
        """The answer in a sentence."""
        if self.maneuver is None:
            return self._refusal
        if self.is_fastest:
            return "The fastest entry is clear."
        later = f"joins {self.later_s:.1f} s later" if self.later_s >= SAME_TIME_S else "is as fast"
        what = "The fastest clear entry found" if self.searched else "The first candidate that is clear"
        return f"{what} {later}: {self.maneuver}"

    @property
    def _refusal(self) -> str:
        zones, block = " and ".join(map(repr, self.blocking)), "blocks" if len(self.blocking) == 1 else "block"
        if self.least_s == inf:
            return f"No entry is clear: {zones} {block} the circle itself, or every way to it."
        candidates = "the candidate" if self.tried == 1 else f"the {self.tried} candidates"
        if self.searched:
            return f"No entry found, though there may be one: {zones} {block} {candidates}."
        return f"No entry found: {zones} {block} {candidates}, and no other path was searched."


def first_clear(fence: Fence, maneuvers: Sequence[Maneuver], margin_m: float | None = None) -> ClearEntry:
    """The fastest of some maneuvers from one start, such as `loiter.candidates`, that stays clear of a fence.

    The margin, metres, is that of `Fence.check`, and so are the errors; none to choose from is an `InvalidArgument`.
    Other entries than these are not tried: that none of them is clear does not say that there is none. `least_s` is
    the time of the fastest of them.
    """
    instance("fence", fence, Fence)
    ordered = sorted(maneuvers, key=lambda maneuver: maneuver.duration_s)
    if not ordered:
        raise InvalidArgument("maneuvers", "has none to choose from")
    blocking: dict[str, None] = {}
    for tried, maneuver in enumerate(ordered, start=1):
        found = fence.check(maneuver, margin_m)
        if found.clear:
            later_s = maneuver.duration_s - ordered[0].duration_s
            return ClearEntry(maneuver, found, later_s, tried, tuple(blocking), ordered[0].duration_s)
        blocking[found.breaches[0].zone.name] = None
    return ClearEntry(None, None, nan, len(ordered), tuple(blocking), ordered[0].duration_s)


def clear_entry(
    fence: Fence, pose: Pose, orbit: Orbit, aircraft: Aircraft, wind: Wind | None = None, margin_m: float | None = None
) -> ClearEntry:
    """The fastest entry found that stays clear of a fence, with its hold, and a lower bound on the time of any.

    The margin, metres, is that of `Fence.check`. Where the fastest candidate of the planner is not clear, paths that
    touch the margin are searched, as docs/fences.md describes; onto a circle that moves only candidates are tried.
    Raises the errors of `candidates` and of `Fence.check`.

    >>> from loiter import Aircraft, Orbit, Pose
    >>> from loiter.fences import CircleZone, Fence, clear_entry
    >>> fence, uav = Fence((CircleZone("mast", -150.0, 90.0, 60.0),)), Aircraft(18.0, max_bank_deg=35.0)
    >>> found = clear_entry(fence, Pose(-400.0, 120.0, 90.0), Orbit(0.0, 0.0, 80.0), uav, margin_m=5.0)
    >>> found.maneuver.word, round(found.maneuver.duration_s, 2), round(found.later_s, 2)
    ('RSLSL', 19.92, 0.15)
    """
    problem = Problem(pose, orbit, aircraft, CALM if wind is None else wind)
    instance("fence", fence, Fence)
    margin_m = checked_margin_m(orbit, margin_m)
    found = _fastest_clear(fence, problem, margin_m)
    if not found.searched or found.least_s == inf:
        return found
    longest_s = inf if problem.still else found.least_s + LONGER_IN_WIND * problem.time_unit_s
    most_s = found.maneuver.duration_s if found.maneuver else longest_s
    air = _air(fence, problem, margin_m, [])
    bound = least_length(fence, problem, margin_m, air, most_s / problem.time_unit_s)
    return found._replace(least_s=max(found.least_s, bound * problem.time_unit_s))


def fastest_clear(
    fence: Fence, pose: Pose, orbit: Orbit, aircraft: Aircraft, wind: Wind | None = None, margin_m: float | None = None
) -> ClearEntry:
    """The answer of `clear_entry` with a lower bound that costs nothing: no clear entry is faster than any entry."""
    problem = Problem(pose, orbit, aircraft, CALM if wind is None else wind)
    instance("fence", fence, Fence)
    return _fastest_clear(fence, problem, checked_margin_m(orbit, margin_m))


def _air(fence: Fence, problem: Problem, margin_m: float, curves: list[Curve]) -> Air:
    """The words between contacts on some curves, in the air of the problem."""
    return StillAir(fence, problem, margin_m, curves) if problem.still else SteadyWind(fence, problem, margin_m)


def _fastest_clear(fence: Fence, problem: Problem, margin_m: float) -> ClearEntry:
    aircraft, orbit = problem.aircraft, problem.orbit
    known = extremals(problem)
    found = first_clear(fence, known, margin_m)
    if found.is_fastest or orbit.moves:
        return found
    if blocking := zones_on_circle(fence, known[0], margin_m):
        return found._replace(blocking=blocking, least_s=inf)
    fastest_m_s = aircraft.airspeed_m_s + problem.wind.speed_m_s
    least_s = max(known[0].duration_s, least_length_m(fence, problem, margin_m) / fastest_m_s)
    best = _Search(fence, problem, margin_m).fastest(found.maneuver, known[0].length_m) if least_s < inf else None
    if best is None:
        return found._replace(searched=True, least_s=least_s)
    later_s = best.duration_s - known[0].duration_s
    return found._replace(
        maneuver=best, check=fence.check(best, margin_m), later_s=later_s, searched=True, least_s=least_s
    )


class _Search:
    """The search for one problem: first over contacts all along the curves, then about those of the best chains."""

    def __init__(self, fence: Fence, problem: Problem, margin_m: float) -> None:
        gap_m = STILL_AIR_GAP_M if problem.still else WIND_GAP_M
        self._fence, self._problem, self._margin_m = fence, problem, margin_m
        self._curves: list[Curve] = curves_of(fence, problem.orbit, margin_m + gap_m)
        self._touching = len(self._curves)
        for share in () if problem.still else WIDER:
            clearance_m = margin_m + gap_m + share * problem.aircraft.turn_radius_m
            self._curves += [curve for curve in curves_of(fence, problem.orbit, clearance_m) if not curve.joined]
        self._air = _air(fence, problem, margin_m, self._curves)
        c, s = heading_vector(problem.pose.heading_deg)
        self._start = Pose2(problem.pose.east_m, problem.pose.north_m, atan2(s, c))

    def fastest(self, known: Maneuver | None, least_m: float) -> Maneuver | None:
        """The fastest of the clear maneuvers found, and of the one that is known, if any.

        No maneuver is shorter through the air than `least_m`, which decides how much is searched.
        """
        best, r = known, self._problem.aircraft.turn_radius_m
        for search in PASSES:
            for maneuver in self._maneuvers(search, inf if best is None else best.length_m):
                best = self._faster(best, maneuver)
            if best is not None and best.length_m < least_m + LATE * r:
                break
        if best is not None and best.length_m < least_m + NEAR * r:
            return best
        is_late = best is None or best.length_m >= least_m + LATE * r
        return self._without_contacts(best, SLACK * r if is_late else 0.0)

    def _without_contacts(self, best: Maneuver | None, slack_m: float) -> Maneuver | None:
        """The fastest of the clear maneuvers from lattices, and of the one that is known, if any.

        Paths of lattices that are longer than that by `slack_m` are shortened too.
        """
        search, least_m = PathSearch(self._air, self._start, self._problem.aircraft.turn_radius_m), inf
        for step in LATTICE_STEPS:
            path = search.over_lattice(step, least_m if best is None else min(least_m, best.length_m + slack_m))
            if path is None or (best is not None and len(path.pieces) > max(MOST_PIECES, len(best.segments))):
                continue
            least_m = path.length_m
            shorter = search.shortened(path) if len(path.pieces) <= MOST_PIECES else path
            if best is None or shorter.length_m < best.length_m - LEAST_GAIN_M:
                best = self._faster(best, self._maneuver(shorter.pieces, shorter.way))
        return best

    def _faster(self, best: Maneuver | None, maneuver: Maneuver) -> Maneuver | None:
        """A maneuver where it is faster than the best one, if any, and clear; otherwise the best one."""
        faster = best is None or maneuver.duration_s < best.duration_s
        return maneuver if faster and self._fence.check(maneuver, self._margin_m).clear else best

    def _maneuvers(self, search: int, most_m: float) -> Iterator[Maneuver]:
        """Those of the best chains of the first or the second search.

        They may be longer than a length by what their coarse steps cost.
        """
        r = self._problem.aircraft.turn_radius_m
        refined = search if self._problem.still else 1
        curves = self._curves if search > 1 else self._curves[: self._touching]
        rows = [*rows_on(curves, r, refined), *rows_without_straight(curves, *self._start, r)]
        rows += rows_on_tangents(curves, *self._start, r)
        for chain in self._chains(placed(self._curves, rows), most_m + SLACK * r, SLACK * r, MOST_CHAINS):
            moved = self._moved(chain, refined)
            yield self._maneuver(_merged(moved), int(moved.contacts.way[-1]))

    def _chains(self, contacts: Contacts, most_m: float, slack_m: float, most: int) -> list[Chain]:
        clear = clear_points(self._fence, contacts.x, contacts.y, self._margin_m)
        allowed = contacts.take(clear.nonzero()[0])
        poses = MOST_POSES if self._problem.still else MOST_POSES_IN_WIND
        return ChainSearch(self._air, self._start, allowed, most_m, poses).chains(slack_m, most)

    def _moved(self, chain: Chain, refined: int) -> Chain:
        """A chain whose contacts are moved along their curves, by steps that are halved, where that shortens it."""
        for k in range(1, HALVINGS + 1):
            rows = {row for path in range(len(chain.paths)) for row in self._rows_near(chain, path, 0.5**k, refined)}
            near = placed(self._curves, sorted(rows))
            chain = next(iter(self._chains(near, chain.length_m, 0.0, 1)), chain)
        return self._tangent(chain)

    def _tangent(self, chain: Chain) -> Chain:
        """A chain without short arcs before and after a wide curve that it follows, if it has any.

        Where an arc of the angle q leads from a straight line to a curve, the line is along the tangent q before.
        """
        r, tangent = self._problem.aircraft.turn_radius_m, chain
        for _ in range(TANGENT_STEPS):
            rows, paths = [], tangent.paths
            for k, (i, share, way) in enumerate(rows_of(tangent.contacts)):
                move = 0.0
                if k + 1 < len(paths) and paths[k + 1][0].radius_m > r:
                    move = -_turned(paths[k][2])
                elif k + 1 < len(paths) and paths[k][0].radius_m > r:
                    move = _turned(paths[k + 1][0])
                rows.append((i, beside(self._curves[i], share, move / (self._curves[i].width or inf)), way))
            found = self._chains(placed(self._curves, rows), inf, 0.0, 1)
            if not found or len(found[0].paths) != len(paths):
                return chain
            tangent = found[0]
        return tangent if tangent.length_m < chain.length_m else chain

    def _rows_near(self, chain: Chain, k: int, step: float, refined: int) -> Iterator[Row]:
        """Contacts about that of path k: up to two parts `step` of a first step away."""
        i, share, way = rows_of(chain.contacts)[k]
        curve = self._curves[i]
        width = step / curve.steps(self._problem.aircraft.turn_radius_m, refined)
        moves = [m * width for m in (-2, -1, 0, 1, 2)]
        yield from ((i, beside(curve, share, move), way) for move in moves)

    def _maneuver(self, pieces: Sequence[Piece], way: int) -> Maneuver:
        """Pieces as a maneuver that joins in a way."""
        problem = self._problem
        segments: list[Segment] = []
        here, now = problem.pose, 0.0
        for control, length_m, radius_m in pieces:
            segments.append(segment(here, now, LETTERS[control], length_m, problem.aircraft, problem.wind, radius_m))
            here, now = segments[-1].end, now + segments[-1].duration_s
        turn = Turn.CCW if way > 0 else Turn.CW
        miss_m = abs(problem.orbit.distance_m(here) - problem.orbit.radius_m)
        return Maneuver(problem.pose, problem.orbit, problem.aircraft, turn, tuple(segments), miss_m, problem.wind)


def _turned(piece: Piece) -> float:
    """The angle of an arc, counter-clockwise positive."""
    return piece.control * piece.length_m / piece.radius_m


def _merged(chain: Chain) -> list[Piece]:
    """The pieces of a chain, without those of no length; those that go on alike are one."""
    merged: list[Piece] = []
    for piece in (piece for path in chain.paths for piece in path):
        if piece.length_m < NO_PIECE_M:
            continue
        if merged and (merged[-1].control, merged[-1].radius_m) == (piece.control, piece.radius_m):
            merged.append(piece._replace(length_m=piece.length_m + merged.pop().length_m))
        else:
            merged.append(piece)
    return merged
