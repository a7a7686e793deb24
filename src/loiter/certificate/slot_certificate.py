"""Certificates of entries into slots, and of arrivals at a place at a time (docs/slots.md).

An entry into a slot ends at a given pose at each time, so that no condition of transversality selects the point of
joining: what is left of it is (5) of docs/slots.md. That the arrival is the first one is checked by a method that
shares no code with the kernel. An arrival at a prescribed time claims no least time: the pose, the time and the
curvatures are all there is to check.
"""

from __future__ import annotations

from cmath import exp
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import radians, sin

from loiter.certificate.accuracy import accuracy_in_wind
from loiter.certificate.adjoints import start_in_wind, switch_adjoints, vanishing_at
from loiter.certificate.conditions import IN_WIND, join, motion_residuals, turn
from loiter.certificate.entry_certificate import BASIS_VIOLATED, Certificate, certificate_values, switches_of
from loiter.certificate.slot_check import HeldCircle, LowerBound, SlotState, no_arrival_before, resolution
from loiter.certificate.trajectory import (
    Candidate,
    InitialAdjoint,
    RelativeStart,
    Residual,
    Trajectory,
    durations_of,
    flown_pieces,
    held_turn,
    word_of,
)
from loiter.errors import instance, number, positive
from loiter.kernel.rounding import ROUNDING, rounding
from loiter.kernel.wind.elongation import possible_times
from loiter.kernel.wind.fits import SHORT
from loiter.planning.arrival import placed_arrival
from loiter.planning.maneuver import Maneuver
from loiter.planning.model import CONTROLS, Turn, directions, sign_of
from loiter.planning.problem import Problem, problem_of
from loiter.planning.slot import Slot
from loiter.planning.solve import arrivals

# The distance from the slot, in roundings of the scene's size, at which the kernel counts a double root as an arrival.
DOUBLE_ROOT = 8.0

# The gap of a prescribed time is looked for in this many turn radii over airspeed before and after it.
BEFORE, AFTER = 32.0, 16.0

BASIS_SLOT = "an extremal into the slot; that no path arrives earlier is cross-checked by an independent method"
BASIS_ARRIVAL = "the path is exact; no least time is claimed"
IN_SLOT = (
    "It meets the slot, and is an extremal with at most two switches. That no path arrives earlier is cross-checked "
    "by an independent method."
)
AT_TIME = "It arrives at the place at that time. No least time is claimed."
# The default of a field that is always given.
HERE = Slot(0.0)

NO_ADJOINT = "no adjoint: a path longer than need be is no extremal"
STARTS_IN_SLOT = "the start is in the slot: there is nothing to decide, and the target is all there is to check"
LINE, BISECTOR, ANY = (
    "the adjoint is unique: it is along the straight piece",
    "the adjoint is unique: the two switches determine it",
    "fewer than two switches have many adjoints: this is one",
)


@dataclass(frozen=True)
class SlotCertificate(Certificate):
    """The conditions for the fastest entry into a slot, whose own one replaces transversality; see `certify_slot`.

    `clear_s` is the time, seconds, before which no path arrives in the slot, by an independent method.
    """

    slot: Slot = HERE
    clear_s: float = 0.0

    @property
    def basis(self) -> str:
        """What the conditions show, or that one is violated."""
        return BASIS_SLOT if self.valid else BASIS_VIOLATED

    @property
    def claim(self) -> str:
        """What a valid certificate shows, as a sentence."""
        return IN_SLOT

    @property
    def source(self) -> str:
        """Where the equations in parentheses are."""
        return "in docs/slots.md, (4) in docs/wind.md"

    @property
    def comparison(self) -> str:
        """The lower bound, and the entry in the other direction."""
        others = "".join(f" {other.word} {other.turn.value} takes {other.later_s:.3g} s more." for other in self.others)
        return f"No arrival before {self.clear_s:.9g} s; this one is at {self.maneuver.duration_s:.9g} s.{others}"

    def to_dict(self) -> dict[str, object]:
        """Plain values, for JSON."""
        return {
            **certificate_values(self),
            "slot": {"phase_deg": self.slot.phase_deg, "at_s": self.slot.at_s},
            "no_arrival_before_s": self.clear_s,
        }


@dataclass(frozen=True)
class ArrivalCertificate(Certificate):
    """What `plan_at` claims of its path: the place, the exact time and the curvatures; see `certify_arrival`.

    `possible_s` are the spans of possible times, seconds, in the direction held, among `searched_s`.
    """

    possible_s: tuple[tuple[float, float], ...] = ()
    searched_s: tuple[float, float] = (0.0, 0.0)

    @property
    def basis(self) -> str:
        """What is shown, or that a condition is violated."""
        return BASIS_ARRIVAL if self.valid else BASIS_VIOLATED

    @property
    def claim(self) -> str:
        """What a valid certificate shows, as a sentence."""
        return AT_TIME

    @property
    def source(self) -> str:
        """Where the equations in parentheses are."""
        return "in docs/slots.md"

    @property
    def comparison(self) -> str:
        """The possible times, and so the gap."""
        begin, end = self.searched_s
        spans = ", ".join(f"{a:.6g} to {b:.6g} s" for a, b in self.possible_s)
        return f"Possible times between {begin:.6g} and {end:.6g} s: {spans}."

    def to_dict(self) -> dict[str, object]:
        """Plain values, for JSON."""
        return {**certificate_values(self), "possible_s": self.possible_s, "searched_s": self.searched_s}


def certify_slot(maneuver: Maneuver, slot: Slot) -> SlotCertificate:
    """The certificate of a maneuver into a slot, the fastest or not.

    The maneuver is recomputed from its start, its letters and its durations, and the slot by quadrature. A maneuver for
    either direction must be no later than any arrival in either. Raises the errors of `loiter.certificate.certify`.

    >>> from loiter import Aircraft, Orbit, Pose, Slot
    >>> pose, orbit, slot = Pose(-400.0, 120.0, 90.0), Orbit(0.0, 0.0, 120.0), Slot(200.0)
    >>> c = certify_slot(loiter.plan(pose, orbit, Aircraft(18.0, max_bank_deg=35.0), slot=slot), slot)
    >>> c.valid, c.proved_optimal, round(c.maneuver.duration_s - c.clear_s, 3)
    (True, False, 0.0)
    """
    instance("maneuver", maneuver, Maneuver)
    instance("slot", slot, Slot)
    problem = problem_of(maneuver)
    unit_s = problem.time_unit_s
    trajectory = _trajectory(maneuver, problem)
    bounds = [_no_arrival(trajectory, problem.with_turn(turn), slot) for turn in directions(problem.orbit.turn)]
    first = min(bounds, key=lambda bound: bound.time)
    pieces = trajectory.pieces
    start = pieces[0].start if pieces else None
    return SlotCertificate(
        maneuver=maneuver,
        lam=trajectory.lam if start else None,
        psi=(start.psi1, start.psi2) if start else None,
        choice=_choice(trajectory),
        switches=tuple(switches_of(trajectory)),
        residuals=tuple(_slot_residuals(trajectory, slot, first)),
        others=_other_direction(maneuver, problem, slot),
        pieces=pieces,
        tie_s=resolution(trajectory.duration) * unit_s,
        complete=False,
        slot=slot,
        clear_s=first.time * unit_s,
    )


def certify_arrival(maneuver: Maneuver, *, time_s: float, bearing_deg: float) -> ArrivalCertificate:
    """The certificate of a maneuver of `plan_at`: that it arrives at the place at exactly the time.

    The maneuver is recomputed from its start, and the letters, durations and curvatures of its pieces. Raises
    `InvalidArgument` for pieces that cannot be flown; otherwise like `plan_at`.

    >>> from loiter import Aircraft, Orbit, Pose, plan_at
    >>> pose, orbit = Pose(-400.0, 120.0, 90.0), Orbit(0.0, 0.0, 80.0)
    >>> m = plan_at(pose, orbit, Aircraft(18.0, max_bank_deg=35.0), time_s=60.0, bearing_deg=200.0)
    >>> certify_arrival(m, time_s=60.0, bearing_deg=200.0).valid
    True
    """
    instance("maneuver", maneuver, Maneuver)
    time_s, bearing_deg = positive("time_s", time_s, "seconds"), number("bearing_deg", bearing_deg, "degrees")
    problem, held = problem_of(maneuver), held_turn(maneuver)
    unit_s = problem.time_unit_s
    start, place = start_in_wind(problem, sign_of(held)), placed_arrival(problem, held, time_s, bearing_deg)
    begin, end = max(place.time - BEFORE, 0.0), place.time + AFTER
    spans = possible_times(place.arrival, begin, end)
    return ArrivalCertificate(
        maneuver=maneuver,
        lam=None,
        psi=None,
        choice=NO_ADJOINT,
        switches=(),
        residuals=tuple(_arrival_residuals(maneuver, problem, start, time_s, bearing_deg)),
        others=(),
        pieces=(),
        tie_s=0.0,
        complete=False,
        possible_s=tuple((a * unit_s, b * unit_s) for a, b in spans),
        searched_s=(begin * unit_s, end * unit_s),
    )


# Slots


def _trajectory(maneuver: Maneuver, problem: Problem) -> Trajectory:
    """The maneuver flown from its start, with the adjoint that violates the conditions least."""
    start = start_in_wind(problem, sign_of(held_turn(maneuver)))
    controls, durations = [CONTROLS[letter] for letter in word_of(maneuver).letters], durations_of(maneuver)
    if not controls:
        return Trajectory(maneuver, problem, start, 1.0, ())
    flown = (
        Trajectory(maneuver, problem, start, adjoint.lam, tuple(flown_pieces(start, controls, durations, adjoint)))
        for adjoint in _adjoints(start, controls, durations)
    )
    return min(flown, key=lambda one: max(one.violations.sign, one.violations.hamiltonian))


def _adjoints(start: RelativeStart, controls: Sequence[int], durations: Sequence[float]) -> Iterator[InitialAdjoint]:
    """All adjoints that the pieces may have; one of many where fewer than two switches leave a choice."""
    pieces = list(flown_pieces(start, controls, durations, InitialAdjoint(1.0 + 0.0j, 1.0, 0.0)))
    yield from switch_adjoints(start, pieces)
    if sum(piece.t > SHORT for piece in pieces) < 3:
        # A straight piece of no length, along the heading where the last piece begins.
        yield vanishing_at(start, pieces, pieces[-1], pieces[-1].e, 1.0)


def _choice(trajectory: Trajectory) -> str:
    """Whether the adjoint is unique."""
    if not trajectory.pieces:
        return STARTS_IN_SLOT
    if any(piece.u == 0 for piece in trajectory.pieces):
        return LINE
    return BISECTOR if len(trajectory.pieces) == 3 else ANY


def _held_circle(trajectory: Trajectory, problem: Problem, slot: Slot) -> HeldCircle:
    """The circle as the slot holds it, from the time 0 on, in the direction of a problem."""
    start = trajectory.start
    way = -float(sign_of(problem.orbit.turn))
    at = HeldCircle(radians(90.0 - slot.phase_deg), way, start.R, start.w)
    return at.after(-slot.at_s / problem.time_unit_s)


def _no_arrival(trajectory: Trajectory, problem: Problem, slot: Slot) -> LowerBound:
    """The time before which there is no arrival in the slot in the direction of a problem; at most the maneuver's."""
    circle = _held_circle(trajectory, problem, slot)
    return no_arrival_before(trajectory.start.q, trajectory.start.e, circle, trajectory.duration)


def _slot_at_end(trajectory: Trajectory, slot: Slot) -> SlotState:
    """The slot when the maneuver ends."""
    held = trajectory.problem.with_turn(held_turn(trajectory.maneuver))
    return _held_circle(trajectory, held, slot).after(trajectory.duration).state()


def _other_direction(maneuver: Maneuver, problem: Problem, slot: Slot) -> tuple[Candidate, ...]:
    """The fastest entry into the slot in the other direction, where the problem has it."""
    return tuple(
        Candidate(other.word, other.turn, other.duration_s, other.duration_s - maneuver.duration_s)
        for other in arrivals(problem, slot)
        if other.turn != maneuver.turn
    )


def _slot_residuals(trajectory: Trajectory, given: Slot, first: LowerBound) -> Iterator[Residual]:
    """The conditions for an entry into a slot."""
    accuracy, (q, e), slot = accuracy_in_wind(trajectory), trajectory.end, _slot_at_end(trajectory, given)
    # The kernel arrives where it is within rounding of a double root, which is some roundings of the scene's size away.
    end = accuracy.end + DOUBLE_ROOT * rounding(abs(trajectory.start.q), trajectory.start.R, trajectory.duration)
    # The sum of the pieces of a turn rounds its time by 64 units of 2^-52 at most, and with it the time since the slot
    # was given; the slot moves at less than 2 over the ground.
    end += 2.0 * ROUNDING * abs(given.at_s) / trajectory.problem.time_unit_s
    yield Residual("target", "q(T) is the place of the slot at T", abs(q - slot.place), end)
    yield Residual("course", "e(T) is its heading then", abs(e - slot.heading), end)
    yield Residual("join", "the last pose over the ground is where the circle is then", *join(trajectory, accuracy))
    yield Residual("turn", "the circle is held as asked for", *turn(trajectory, accuracy))
    if trajectory.pieces:
        yield from motion_residuals(IN_WIND.motion, trajectory, accuracy)
        off, bounds = trajectory.violations, accuracy.maximum_principle
        yield Residual("norm", "|p| = 1", off.norm, bounds.norm)
        yield Residual("sign", "u = sign f, u = 0 only where f = 0 (4)", off.sign, bounds.sign)
        yield Residual("hamiltonian", "|f| + p.e = lambda (4)", off.hamiltonian, bounds.hamiltonian)
        last = trajectory.last
        behind = last.end.phi * (last.u - slot.control)
        yield Residual("slot", "f (u - h k) >= 0 at T (5)", max(0.0, -behind), 2.0 * bounds.sign)
    later, note = max(trajectory.duration - first.time, 0.0), _passes(trajectory.problem, first)
    yield Residual("first", "no path arrives before T", later, resolution(trajectory.duration), note)


def _passes(problem: Problem, first: LowerBound) -> str:
    """The spans of time that samples alone decide."""
    unit_s, r = problem.time_unit_s, problem.aircraft.turn_radius_m
    return "; ".join(
        f"by samples from {one.begin * unit_s:.6g} to {one.end * unit_s:.6g} s, {one.gap * r:.2g} m from reach"
        for one in first.passed
    )


# Arrivals at a time


def _arrival_residuals(
    maneuver: Maneuver, problem: Problem, start: RelativeStart, time_s: float, bearing_deg: float
) -> Iterator[Residual]:
    """The conditions for a path that arrives at a place at a time."""
    unit_s, r = problem.time_unit_s, problem.aircraft.turn_radius_m
    curvatures, durations = [segment.curvature_per_m * r for segment in maneuver.segments], durations_of(maneuver)
    q, e = start.q, start.e
    for k, t in zip(curvatures, durations, strict=True):
        half = exp(0.5j * k * t)
        q, e = q + e * half * _chord(k, t) + start.w * t, e * half * half
    duration = sum(durations)
    place = HeldCircle(radians(90.0 - bearing_deg), -float(start.side), start.R, start.w).state()
    end = 4.0 * rounding(abs(start.q), start.R, duration) / (1.0 - abs(start.w))
    yield Residual("target", "q(T) is the place on the circle", abs(q - place.place), end)
    yield Residual("course", "e(T) is the heading of the hold there", abs(e - place.heading), end)
    yield Residual("time", "T is the time asked for", abs(duration - time_s / unit_s), ROUNDING * (1.0 + duration))
    excess = max((abs(k) - 1.0 for k in curvatures), default=0.0)
    yield Residual("curvature", "|k| <= 1", max(excess, 0.0), ROUNDING)
    yield Residual("pieces", "three at most", float(max(len(durations) - 3, 0)), 0.0)
    pose, circle = maneuver.join, maneuver.orbit_at_join
    shown = complex(pose.east_m - circle.east_m, pose.north_m - circle.north_m) / r
    yield Residual("join", "the last pose over the ground is there", abs(shown - q), 4.0 * end)
    excluded = float(maneuver.orbit.turn not in (maneuver.turn, Turn.EITHER))
    yield Residual("turn", "the circle is held as asked for", excluded, 0.0)


def _chord(k: float, t: float) -> float:
    """The chord of an arc of curvature k and length t."""
    half = 0.5 * k * t
    return t * sin(half) / half if half else t
