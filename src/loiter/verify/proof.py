"""A maneuver in the kernel's terms, with its adjoint and what bounds its residuals.

Residuals are in turn radii and turn radii over airspeed, psi is of length 1. Each is the largest value over the
maneuver, checked at `SAMPLES` instants of each piece and wherever psi1 and phi are extreme. Four accuracies bound
them:

- `end`: how far the plan may end from the target, the tolerance or rounding (`synthesis.rounding`); a flow is a motion
  of the plane, so no state on the way is further off, and phi = psi x state is as accurate, |psi| being 1;
- `rounding`: that of a length in this scene, 64 units of 2^-52 times its size, some 20 operations for each piece;
- `angle`: psi of a single arc is parallel to its start, which may lie `end` beside its circle; and
  psi at the first of two switches has turned with a middle arc whose angle is an accuracy of `end` over that
  arc's radius;
- `choice`: next to where two extremals tie smoothly, rounding of T may choose the slower. Its phi is of the wrong sign
  by up to v somewhere, and it loses some 2/lambda times the integral of that. A v in the middle of a piece lasts
  2 sqrt(2 v) at least, since |phi''| = |psi1| <= 1, and costs 3.7 v^(3/2); at the start, where a first piece is
  missing, it lasts v at least, since |phi'| <= 1, and costs v^2. So v is below rounding^(2/3), and below rounding^(1/2)
  where another candidate ties or the start counts as on a single arc.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from math import atan2, hypot, pi, sqrt
from typing import NamedTuple

from loiter.errors import InvalidArgument, as_float
from loiter.kernel.adjoint import adjoint, switching_function, turn_adjoint
from loiter.kernel.motion import flow
from loiter.kernel.synthesis import REACH, Entry, rounding
from loiter.kernel.words import Word, controls, encode, rest
from loiter.planning.maneuver import Maneuver
from loiter.planning.model import CONTROLS, Turn
from loiter.planning.problem import ReducedProblem, problem_of
from loiter.planning.sides import SIDES

# Between two of them psi1 and phi are monotone once their extremes are added, so few will do.
SAMPLES = 9


@dataclass(frozen=True, slots=True)
class Residual:
    """One condition: its name, the equation, by how much it is violated and how much rounding and tolerance explain.

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
        """The word for it: "holds", "FAILED" or "skipped"."""
        return "skipped" if self.skipped else "FAILED" if self.failed else "holds"


@dataclass(frozen=True, slots=True)
class Candidate:
    """Another extremal for the same start: how much later (seconds) it joins; negative where it is sooner."""

    word: str
    turn: Turn
    duration_s: float
    later_s: float


class Accuracy(NamedTuple):
    """What bounds the residuals (above)."""

    end: float
    rounding: float
    angle: float
    choice: float

    @property
    def tie(self) -> float:
        """Durations are equal that differ by less: rounding of T, and of the conversion to seconds and back."""
        return 2.0 * self.rounding


class PieceState(NamedTuple):
    """State, adjoint and switching function at an instant of a maneuver."""

    x: float
    y: float
    psi1: float
    psi2: float
    phi: float


class Piece(NamedTuple):
    """A piece as flown: control, duration, and state and adjoint at its start."""

    u: int
    t: float
    x: float
    y: float
    psi1: float
    psi2: float

    def at(self, s: float) -> PieceState:
        """State, adjoint and phi after a time s of this piece."""
        x, y = flow(self.x, self.y, self.u, s)
        psi1, psi2 = turn_adjoint(self.psi1, self.psi2, self.u, s)
        return PieceState(x, y, psi1, psi2, switching_function(x, y, psi1, psi2))

    @property
    def instants(self) -> list[float]:
        """Times within the piece: evenly spread, and where psi2 = 0, so that phi and psi1 are extreme."""
        even = [self.t * i / (SAMPLES - 1) for i in range(SAMPLES)]
        extreme = self.u * atan2(self.psi2, self.psi1) % pi
        return even + [s for s in (extreme, extreme + pi) if self.u and s < self.t]

    @property
    def radius(self) -> float:
        """Distance of the state from the centre of an arc, (0, -u)."""
        return hypot(self.x, self.y + self.u)


class Flight(NamedTuple):
    """A maneuver in the kernel's terms, with its adjoint."""

    scene: ReducedProblem
    side: int
    word: int
    lam: float
    pieces: list[Piece]
    accuracy: Accuracy

    @property
    def end(self) -> PieceState:
        """State, adjoint and phi at the end."""
        return self.pieces[-1].at(self.pieces[-1].t)

    @property
    def opposed(self) -> list[Piece]:
        """The arcs that begin with a switch between L and R."""
        return [after for before, after in pairwise(self.pieces) if before.u * after.u < 0]


def flight_of(maneuver: Maneuver, tolerance_m: float, others: tuple[Candidate, ...]) -> Flight:
    """The maneuver from its start, its letters and its durations alone."""
    scene = problem_of(maneuver, tolerance_m).reduced()
    turn, word, durations = side_of(maneuver), word_of(maneuver), durations_of(maneuver)
    x, y, R = scene.x, scene.y, scene.R
    side, size = int(SIDES[turn]), rounding(x, y, R)
    lam, pieces = _pieces(x, y, R, side, word, durations)
    if len(pieces) == 2 and pieces[0].u * pieces[1].u < 0:
        word, lam, pieces = _one_arc(x, y, R, side, word, durations, size) or (word, lam, pieces)
    accuracy = _accuracy(scene, size, pieces)
    tie_s = accuracy.tie * problem_of(maneuver).time_unit_s
    if len(pieces) == 1 or any(abs(other.later_s) <= tie_s for other in others):
        accuracy = accuracy._replace(choice=sqrt(size))
    return Flight(scene, side, word, lam, pieces, accuracy)


def _one_arc(
    x: float, y: float, R: float, side: int, word: int, durations: list[float], size: float
) -> tuple[int, float, list[Piece]] | None:
    """Two arcs of which one is there by rounding alone, as the single arc whose many psi they share; else None.

    A start a rounding beside the circle of the last arc begins with a piece so short that no control there loses more
    than a rounding: 2/lambda times |phi|, which changes by its duration at most. Where the circles touch at the target,
    the last piece is so short that the first arc, flown on, ends there too.
    """
    (first, last), (u, _, _) = durations, controls(word)
    lam, late = _pieces(*flow(x, y, u, first), R, side, rest(word), [last])
    if (abs(late[0].at(0.0).phi) + first) * first <= lam * size:
        return rest(word), lam, late
    end_x, end_y = flow(x, y, u, first + last)
    if hypot(end_x, end_y - side * R) <= size:
        return encode(u), *_pieces(x, y, R, side, encode(u), [first + last])
    return None


def _accuracy(scene: ReducedProblem, size: float, pieces: list[Piece]) -> Accuracy:
    # Durations went through metres and seconds and back, 4 roundings, so a flight of them ends a rounding further off.
    end = max(scene.tolerance, size) + size
    middle = pieces[1].radius if len(pieces) == 3 and pieces[1].u else 1.0
    angle = end * (1.0 + 1.0 / max(middle, size))
    if len(pieces) == 1:
        # psi of a lone arc is parallel to its start, which may lie `end` beside its circle; phi is read R + 1 away.
        angle = end * (1.0 + (1.0 + scene.R) / max(hypot(scene.x, scene.y), size))
    return Accuracy(end, size, angle, size ** (2.0 / 3.0))


def side_of(maneuver: Maneuver) -> Turn:
    """The direction in which the circle is held; raises `InvalidArgument` where that is neither cw nor ccw."""
    if maneuver.turn not in (Turn.CW, Turn.CCW):
        raise InvalidArgument("maneuver", f"holds the circle {str(maneuver.turn)!r}: it must be cw or ccw")
    return Turn(maneuver.turn)


def word_of(maneuver: Maneuver) -> int:
    """The code of the word; raises `InvalidArgument` for letters that are none."""
    if not maneuver.segments:
        return int(Word.EMPTY)
    if maneuver.word not in Word.__members__ or maneuver.word == Word.EMPTY.name:
        known = ", ".join(word.letters for word in Word if word)
        raise InvalidArgument("maneuver", f"has the word {maneuver.word!r}: it must be one of {known}")
    return int(Word[maneuver.word])


def durations_of(maneuver: Maneuver) -> list[float]:
    """Durations in turn radii over airspeed; raises `InvalidArgument` for those that cannot be flown."""
    seconds = [segment.duration_s for segment in maneuver.segments]
    durations = [as_float(t) * maneuver.aircraft.airspeed_m_s / maneuver.aircraft.turn_radius_m for t in seconds]
    # The longest straight piece is REACH turn radii, an arc adds 2 pi at most; 8 leaves room for altered maneuvers.
    if not all(0.0 <= t <= 8.0 * REACH for t in durations):
        raise InvalidArgument("maneuver", f"has durations {seconds}: they must be zero or positive, finite seconds")
    return durations


def _pieces(x: float, y: float, R: float, side: int, word: int, durations: list[float]) -> tuple[float, list[Piece]]:
    """The multiplier lambda and the pieces of a word flown from (x, y), with psi."""
    pieces = []
    t1, t2, t3 = [*durations, 0.0, 0.0, 0.0][:3]
    lam, psi1, psi2 = adjoint(x, y, R, Entry(side, word, t1, t2, t3))
    for letter, t in zip(Word(word).letters, durations, strict=True):
        pieces.append(Piece(CONTROLS[letter], t, x, y, psi1, psi2))
        x, y, psi1, psi2, _ = pieces[-1].at(t)
    return lam, pieces
