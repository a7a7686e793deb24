"""A maneuver flown exactly from its start, with its adjoint, in still air and in wind.

Everything is relative to the circle; vectors are complex numbers. q is the position, e the heading (a unit vector), w
the velocity of the air past the circle, p the constant adjoint of the position (|p| = 1), f the adjoint of the heading,
lambda the multiplier (docs/wind.md, section 3). Lengths are in turn radii, times in turn radii over airspeed.

In the frame of the heading q is the reduced state (2) and p is the paper's psi = (p.e, p.Je); f is its switching
function phi. In still air, w = 0, the plane is rotated so that the heading at the start is along the x axis.
"""

from __future__ import annotations

from cmath import exp
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from math import atan2, pi, sin
from typing import NamedTuple

from loiter.errors import InvalidArgument, as_float
from loiter.kernel.rounding import REACH
from loiter.kernel.words import Word
from loiter.planning.maneuver import Maneuver
from loiter.planning.model import Turn
from loiter.planning.problem import Problem

# Instants checked in each piece. Once the extremes of psi1 and phi are added, both are monotone between instants.
SAMPLES = 9

# A turn is wide if its curvature is less than the tightest by more than this share.
WIDER = 1e-9


def inner(a: complex, b: complex) -> float:
    """The inner product of two vectors."""
    return (a.conjugate() * b).real


@dataclass(frozen=True)
class Residual:
    """One condition: name, equation, violation, and the largest violation of a correct maneuver.

    `value` and `bound` are None where the condition could not be checked; `note` then says why.
    """

    name: str
    equation: str
    value: float | None
    bound: float | None
    note: str = ""

    @property
    def skipped(self) -> bool:
        """Whether the condition could not be checked."""
        return self.value is None

    @property
    def failed(self) -> bool:
        """Whether the condition is violated beyond its bound."""
        return self.value is not None and self.bound is not None and not self.value <= self.bound

    @property
    def verdict(self) -> str:
        """The verdict in a word: "holds", "FAILED" or "skipped"."""
        return "skipped" if self.skipped else "FAILED" if self.failed else "holds"


@dataclass(frozen=True)
class Candidate:
    """Another extremal for the same start; `later_s` (seconds) is negative where it joins sooner."""

    word: str
    turn: Turn
    duration_s: float
    later_s: float


class PieceState(NamedTuple):
    """Position, heading, adjoint psi and switching function phi at an instant."""

    q: complex
    e: complex
    psi: complex
    phi: float

    @property
    def reduced(self) -> complex:
        """The reduced state x + iy, (2)."""
        return self.q * self.e.conjugate()

    @property
    def x(self) -> float:
        """The reduced abscissa."""
        return self.reduced.real

    @property
    def y(self) -> float:
        """The reduced ordinate."""
        return self.reduced.imag

    @property
    def psi1(self) -> float:
        """The adjoint along the heading."""
        return self.psi.real

    @property
    def psi2(self) -> float:
        """The adjoint to the left of the heading."""
        return self.psi.imag


class FlownPiece(NamedTuple):
    """A piece as flown: control and duration; position, heading and phi at its start; the constant p and w."""

    u: int
    t: float
    q: complex
    e: complex
    phi: float
    p: complex
    w: complex

    def at(self, s: float) -> PieceState:
        """The state and the adjoint after a time s of this piece."""
        half = exp(0.5j * self.u * s)
        chord = 2.0 * sin(0.5 * s) if self.u else s
        through_air, e = chord * self.e * half, self.e * half * half
        phi = self.phi - inner(self.p, 1j * through_air)
        return PieceState(self.q + through_air + self.w * s, e, self.p * e.conjugate(), phi)

    @property
    def start(self) -> PieceState:
        """The state and the adjoint at the start of this piece."""
        return self.at(0.0)

    @property
    def end(self) -> PieceState:
        """The state and the adjoint at the end of this piece."""
        return self.at(self.t)

    @property
    def instants(self) -> list[float]:
        """Times within the piece: evenly spread, and where psi2 = 0, so that phi and psi1 are extreme."""
        even = [self.t * i / (SAMPLES - 1) for i in range(SAMPLES)]
        psi = self.start.psi
        extreme = self.u * atan2(psi.imag, psi.real) % pi
        return even + [s for s in (extreme, extreme + pi) if self.u and s < self.t]

    @property
    def radius(self) -> float:
        """The distance of the reduced state from the centre of its arc, (0, -u)."""
        return abs(self.start.reduced + 1j * self.u)


class RelativeStart(NamedTuple):
    """The start relative to the circle: position, heading, velocity of the air; radius and side of the circle held."""

    q: complex
    e: complex
    w: complex
    R: float
    side: int


class InitialAdjoint(NamedTuple):
    """The adjoint p of the position, lambda, and the switching function at the start."""

    p: complex
    lam: float
    phi: float


class MaximumPrinciple(NamedTuple):
    """One number for each condition of the maximum principle: by how much it is violated, or the bound on that."""

    norm: float
    multiplier: float
    sign: float
    hamiltonian: float
    psi1: float
    transversality: float


@dataclass(frozen=True)
class Trajectory:
    """A maneuver flown from its start, with its adjoint, and its problem; a start on the circle has no pieces."""

    maneuver: Maneuver
    problem: Problem
    start: RelativeStart
    lam: float
    pieces: tuple[FlownPiece, ...]

    @property
    def first(self) -> FlownPiece:
        """The first piece."""
        return self.pieces[0]

    @property
    def last(self) -> FlownPiece:
        """The last piece."""
        return self.pieces[-1]

    @property
    def end(self) -> tuple[complex, complex]:
        """Position and heading at the end."""
        if not self.pieces:
            return self.start.q, self.start.e
        end = self.last.end
        return end.q, end.e

    @property
    def miss(self) -> float:
        """The distance of the last reduced state from the target in still air."""
        q, e = self.end
        return abs(q * e.conjugate() - 1j * self.start.side * self.start.R)

    @property
    def beside(self) -> float:
        """How far from the circle the maneuver ends, or the component of its velocity across the circle if larger."""
        q, e = self.end
        return max(abs(abs(q) - self.start.R), abs(inner(q, e + self.start.w)) / (abs(q) or 1.0))

    @property
    def opposed(self) -> list[FlownPiece]:
        """The arcs that begin with a switch between L and R."""
        return [after for before, after in pairwise(self.pieces) if before.u * after.u < 0]

    @property
    def duration(self) -> float:
        """T, in turn radii over airspeed."""
        return sum(piece.t for piece in self.pieces)

    @cached_property
    def violations(self) -> MaximumPrinciple:
        """By how much (4) and (5) of docs/wind.md are violated: in still air the paper's (13), (14), (16) and (18)."""
        lam, norm, sign, hamiltonian, psi1 = self.lam, 0.0, 0.0, 0.0, 0.0
        for piece in self.pieces:
            for now in map(piece.at, piece.instants):
                norm = max(norm, abs(abs(now.psi) - 1.0))
                # The control +1 or -1 needs phi of its sign or 0, the control 0 needs phi = 0.
                sign = max(sign, -piece.u * now.phi if piece.u else abs(now.phi))
                hamiltonian = max(hamiltonian, abs(abs(now.phi) + now.psi1 - lam))
                psi1 = max(psi1, now.psi1 - lam)
        last, (q, e) = self.last, self.end
        off = inner(last.p, e + last.w) + end_rate(self.start, q, e, last.u) * (lam - inner(last.p, e))
        # In still air (5) is divided by k = 1/R, as the paper writes it.
        off *= self.start.R if self.problem.still else 1.0
        return MaximumPrinciple(norm, max(0.0, -lam - inner(last.p, last.w)), sign, hamiltonian, psi1, abs(off))

    @property
    def worst_violation(self) -> float:
        """The largest violation of (4) and (5)."""
        off = self.violations
        return max(off.multiplier, off.sign, off.hamiltonian, off.transversality)


def end_rate(start: RelativeStart, q: complex, e: complex, u: int) -> float:
    """The turn rate (3) that holds the circle, positive in the direction of the last control u.

    In wind the radius is that of the end q, which equals R where the maneuver ends on the circle.
    """
    radius = start.R if start.w == 0.0 else abs(q) or start.R
    over_ground = e + start.w
    g = abs(over_ground)
    return -start.side * u * g**3 / (radius * inner(e, over_ground))


def flown_pieces(
    start: RelativeStart, controls: Sequence[int], durations: Sequence[float], adjoint: InitialAdjoint
) -> Iterator[FlownPiece]:
    """The pieces flown one after the other."""
    q, e, phi = start.q, start.e, adjoint.phi
    for u, t in zip(controls, durations, strict=True):
        piece = FlownPiece(u, t, q, e, phi, adjoint.p, start.w)
        yield piece
        q, e, _, phi = piece.end


def held_turn(maneuver: Maneuver) -> Turn:
    """The direction in which the circle is held; raises `InvalidArgument` where that is neither cw nor ccw."""
    if maneuver.turn not in (Turn.CW, Turn.CCW):
        raise InvalidArgument("maneuver", f"holds the circle {str(maneuver.turn)!r}: it must be cw or ccw")
    return Turn(maneuver.turn)


def check_tight(maneuver: Maneuver) -> None:
    """Raise `InvalidArgument` for a turn wider than the tightest, which no entry of least time has."""
    r = maneuver.aircraft.turn_radius_m
    for segment in maneuver.segments:
        k = abs(segment.curvature_per_m) * r
        if 0.0 < k < 1.0 - WIDER:
            raise InvalidArgument(
                "maneuver",
                f"has a turn of {r / k:.6g} m, wider than the tightest of {r:.6g} m: its path is longer than need be, "
                "and no condition of least time holds; certify_arrival checks the paths of plan_at",
            )


def word_of(maneuver: Maneuver) -> Word:
    """The word of a maneuver; raises `InvalidArgument` for letters that are not a word."""
    if not maneuver.segments:
        return Word.EMPTY
    check_tight(maneuver)
    if maneuver.word not in Word.__members__ or maneuver.word == Word.EMPTY.name:
        known = ", ".join(word.letters for word in Word if word)
        raise InvalidArgument("maneuver", f"has the word {maneuver.word!r}: it must be one of {known}")
    return Word[maneuver.word]


def durations_of(maneuver: Maneuver) -> list[float]:
    """Durations in turn radii over airspeed; raises `InvalidArgument` for those that cannot be flown."""
    seconds = [segment.duration_s for segment in maneuver.segments]
    durations = [as_float(t) * maneuver.aircraft.airspeed_m_s / maneuver.aircraft.turn_radius_m for t in seconds]
    # The longest straight piece is REACH turn radii, an arc adds 2 pi at most; the factor 8 leaves room for altered
    # maneuvers.
    if not all(0.0 <= t <= 8.0 * REACH for t in durations):
        raise InvalidArgument("maneuver", f"has durations {seconds}: they must be zero or positive, finite seconds")
    return durations
