"""A certificate: the conditions of the maximum principle checked one by one, and a comparison with other extremals.

It shows that the maneuver is an extremal, gives lambda and psi for checking this, and shows that no candidate is
faster; the Hamilton-Jacobi-Bellman equation compares it with the least times of neighbouring starts. In still air a
fastest maneuver is always among the candidates (evidence/docs/proof.md, theorem 1), so a valid certificate without a
tolerance shows that the maneuver is optimal, up to rounding: `Certificate.proved_optimal`; `Certificate.rounding` says
how much that can be. Distances, curvatures and start times of segments are not checked: letters, durations and the join
are.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import asdict, dataclass
from itertools import pairwise
from math import isfinite
from typing import NamedTuple

from loiter.certificate.accuracy import accuracy_of
from loiter.certificate.adjoints import trajectory_of
from loiter.certificate.conditions import IN_WIND, residuals
from loiter.certificate.paper_conditions import IN_STILL_AIR
from loiter.certificate.rounding_bound import RoundingBound, rounding_bound
from loiter.certificate.trajectory import Candidate, FlownPiece, Residual, Trajectory
from loiter.errors import InvalidArgument, instance
from loiter.planning.maneuver import Maneuver
from loiter.planning.model import CONTROLS, Turn
from loiter.planning.problem import Problem, problem_of
from loiter.planning.solve import extremals

LETTERS = {u: letter for letter, u in CONTROLS.items()}

# Whether the adjoint is unique, and which one is given where it is not.
ON_THE_CIRCLE = "the start is on the circle: there is nothing to decide, and the target is all there is to check"
UNIQUE = "the adjoint psi is unique: the condition phi = 0 at a switch determines it"
ARC_BY_ROUNDING = "a single arc (the other is there by rounding alone)"
STRAIGHT_ENTRY = "that of a straight entry that ends in it, (1, 0) on the axis"
SWITCH_AT_START = "that of a switch at its start, parallel to the state there"
UNIQUE_IN_WIND = "the adjoint is unique: the pieces and the condition at the circle determine it"
BASIS_THEOREM = "evidence/docs/proof.md, theorem 1, up to rounding"
BASIS_NECESSARY = "necessary conditions only"
BASIS_VIOLATED = "a condition is violated"
BY_THE_THEOREM = "Optimal, up to rounding, by theorem 1 of evidence/docs/proof.md."
NOT_PROVED = "Not proved to be optimal: these conditions are necessary ones, and no extremal that was found is faster."
ARC_IN_WIND = "a single arc has many adjoints: this is the one that violates the conditions least"


@dataclass(frozen=True)
class Switch:
    """An instant of switching: when (seconds), from and to which letter, the reduced state there (2), and psi."""

    time_s: float
    letters: str
    x: float
    y: float
    psi1: float
    psi2: float


class Instant(NamedTuple):
    """The certificate at one instant: seconds from the start, control u, switching function phi, adjoint psi."""

    time_s: float
    u: int
    phi: float
    psi1: float
    psi2: float


@dataclass(frozen=True)
class Certificate:
    """The conditions of the maximum principle for a maneuver, and the extremals it was compared with; see `certify`.

    `lam` is the multiplier lambda and `psi` the adjoint at the start, None for a start on the circle, which has no
    pieces; `choice` says whether psi is unique. `others` are the candidates it was compared with, fastest first, and
    `complete` says that these are proved to include an optimum: in still air, without a tolerance.
    """

    maneuver: Maneuver
    lam: float | None
    psi: tuple[float, float] | None
    choice: str
    switches: tuple[Switch, ...]
    residuals: tuple[Residual, ...]
    others: tuple[Candidate, ...]
    pieces: tuple[FlownPiece, ...]
    tie_s: float
    complete: bool

    @property
    def proved_optimal(self) -> bool:
        """Whether the maneuver is proved to be optimal, up to `rounding`, by theorem 1 of evidence/docs/proof.md."""
        return self.complete and self.valid

    @property
    def rounding(self) -> RoundingBound:
        """How far from the target it may end, and how late it may be, for rounding: delta and epsilon."""
        return rounding_bound(self.maneuver, problem_of(self.maneuver), self.proved_optimal)

    @property
    def basis(self) -> str:
        """What the conditions show: the theorem, or that they are necessary only, or that one is violated."""
        if not self.valid:
            return BASIS_VIOLATED
        return BASIS_THEOREM if self.proved_optimal else BASIS_NECESSARY

    @property
    def claim(self) -> str:
        """What a valid certificate shows, as a sentence."""
        return BY_THE_THEOREM if self.proved_optimal else NOT_PROVED

    @property
    def source(self) -> str:
        """Where the equations in parentheses are."""
        return (
            "of the paper, listed in evidence/docs/paper.md" if problem_of(self.maneuver).still else "in docs/wind.md"
        )

    @property
    def comparison(self) -> str:
        """What the maneuver was compared with, as a sentence."""
        return _comparison(self)

    @property
    def valid(self) -> bool:
        """Whether no condition is violated."""
        return not self.failed

    @property
    def failed(self) -> tuple[Residual, ...]:
        """The violated conditions."""
        return tuple(residual for residual in self.residuals if residual.failed)

    @property
    def ties(self) -> tuple[Candidate, ...]:
        """The candidates that are as fast, up to rounding."""
        return tuple(other for other in self.others if abs(other.later_s) <= self.tie_s)

    @property
    def runner_up(self) -> Candidate | None:
        """The fastest candidate that is slower; None where there is none, or where a candidate is faster."""
        if any(other.later_s < -self.tie_s for other in self.others):
            return None
        return next((other for other in self.others if other.later_s > self.tie_s), None)

    @property
    def margin_s(self) -> float | None:
        """By how much the runner-up is slower, seconds."""
        return None if self.runner_up is None else self.runner_up.later_s

    def residual(self, name: str) -> Residual:
        """The residual with a given name; raises `InvalidArgument` where this maneuver has no such condition."""
        for residual in self.residuals:
            if residual.name == name:
                return residual
        known = ", ".join(residual.name for residual in self.residuals)
        raise InvalidArgument("residual", f"is {name!r}: this certificate has {known}")

    def history(self, steps: int = 100) -> Iterator[list[Instant]]:
        """The certificate over time, piece by piece, each at `steps` + 1 instants from its start to its end."""
        unit_s = problem_of(self.maneuver).time_unit_s
        began = 0.0
        for piece in self.pieces:
            times = [piece.t * i / steps for i in range(steps + 1)]
            yield [_instant(piece, began, s, unit_s) for s in times]
            began += piece.t

    def to_dict(self) -> dict[str, object]:
        """Plain values, for JSON: no nan, no infinity."""
        return certificate_values(self)

    def __str__(self) -> str:
        return "\n".join([*_head(self), *_table(self.residuals), *_legend(self), self.comparison])


def certify(maneuver: Maneuver, *, tolerance_m: float = 0.0) -> Certificate:
    """The certificate of a maneuver, optimal or not; `tolerance_m` (metres) is that with which it was planned.

    The maneuver is recomputed from its start, its letters and its durations. In still air the conditions are the
    paper's, (7)-(19); in wind, and for a moving circle, those of docs/wind.md, section 3. Raises `InvalidArgument` for
    letters that are not a word of at most three pieces, durations that are negative or not finite, or a turn that is
    neither cw nor ccw; otherwise like `plan`.

    >>> pose, orbit = loiter.Pose(-400.0, 120.0, 90.0), loiter.Orbit(0.0, 0.0, 80.0)
    >>> c = certify(loiter.plan(pose, orbit, loiter.Aircraft(18.0, max_bank_deg=35.0)))
    >>> c.valid, c.lam, c.runner_up.word, round(c.margin_s, 2)
    (True, 1.0, 'LSL', 16.45)
    """
    instance("maneuver", maneuver, Maneuver)
    problem = problem_of(maneuver, tolerance_m)
    others = _others(maneuver, problem)
    trajectory = trajectory_of(maneuver, problem)
    accuracy = accuracy_of(trajectory, others)
    formulation = IN_STILL_AIR if problem.still else IN_WIND
    lam: float | None = None
    psi: tuple[float, float] | None = None
    if trajectory.pieces:
        start = trajectory.first.start
        lam, psi = trajectory.lam, (start.psi1, start.psi2)
    return Certificate(
        maneuver,
        lam,
        psi,
        _choice(trajectory),
        tuple(switches_of(trajectory)),
        tuple(residuals(formulation, trajectory, accuracy, others)),
        others,
        trajectory.pieces,
        accuracy.tie * problem.time_unit_s,
        complete=problem.has_closed_form and tolerance_m == 0.0,
    )


def certificate_values(certificate: Certificate) -> dict[str, object]:
    """What certificates of every kind have, as plain values for JSON."""
    maneuver, runner_up, rounding = certificate.maneuver, certificate.runner_up, certificate.rounding
    return {
        "valid": certificate.valid,
        "proved_optimal": certificate.proved_optimal,
        "basis": certificate.basis,
        "delta_m": rounding.delta_m,
        "epsilon_s": rounding.epsilon_s,
        "rounding": rounding.basis,
        "word": maneuver.word,
        "turn": Turn(maneuver.turn).value,
        "duration_s": maneuver.duration_s,
        "lambda": certificate.lam,
        "psi": certificate.psi,
        "choice": certificate.choice,
        "switches": [asdict(switch) for switch in certificate.switches],
        "residuals": [_plain(residual) for residual in certificate.residuals],
        "candidates": [asdict(other) | {"turn": other.turn.value} for other in certificate.others],
        "runner_up": None if runner_up is None else runner_up.word,
        "margin_s": certificate.margin_s,
    }


def _instant(piece: FlownPiece, began: float, s: float, unit_s: float) -> Instant:
    now = piece.at(s)
    return Instant((began + s) * unit_s, piece.u, now.phi, now.psi1, now.psi2)


def _others(maneuver: Maneuver, problem: Problem) -> tuple[Candidate, ...]:
    """Every candidate but the maneuver itself."""
    return tuple(
        Candidate(other.word, other.turn, other.duration_s, other.duration_s - maneuver.duration_s)
        for other in extremals(problem)
        if (other.turn, other.segments) != (maneuver.turn, maneuver.segments)
    )


def switches_of(trajectory: Trajectory) -> Iterator[Switch]:
    """The switches of a trajectory, in order."""
    time = 0.0
    for before, after in pairwise(trajectory.pieces):
        time += before.t
        there = after.start
        letters = LETTERS[before.u] + LETTERS[after.u]
        yield Switch(time * trajectory.problem.time_unit_s, letters, there.x, there.y, there.psi1, there.psi2)


def _choice(trajectory: Trajectory) -> str:
    """Whether psi is unique, and which one this is where it is not."""
    if not trajectory.pieces:
        return ON_THE_CIRCLE
    single = len(trajectory.pieces) == 1
    if not trajectory.problem.still:
        return ARC_IN_WIND if single else UNIQUE_IN_WIND
    if not single:
        return UNIQUE
    arc = "a single arc" if len(trajectory.maneuver.segments) == 1 else ARC_BY_ROUNDING
    return f"{arc} has many psi: this is {STRAIGHT_ENTRY if trajectory.lam == 1.0 else SWITCH_AT_START}"


# Text


def _plain(residual: Residual) -> dict[str, object]:
    """A residual for JSON, where a value that is not finite has no place."""
    value = residual.value if residual.value is not None and isfinite(residual.value) else None
    return asdict(residual) | {"value": value, "verdict": residual.verdict}


def _head(certificate: Certificate) -> list[str]:
    maneuver = certificate.maneuver
    verdict = "valid" if certificate.valid else f"NOT VALID, FAILED: {', '.join(r.name for r in certificate.failed)}"
    lines = [f"Certificate of {maneuver.word or 'a start on the circle'}, {Turn(maneuver.turn).described}: {verdict}."]
    if certificate.valid:
        lines.append(certificate.claim)
    if certificate.proved_optimal:
        lines.append(_rounded(certificate.rounding))
    if certificate.lam is not None and certificate.psi is not None:
        psi1, psi2 = certificate.psi
        lines.append(f"lambda = {certificate.lam:.6f}, psi = ({psi1:.6f}, {psi2:.6f}) at the start.")
    lines.append(certificate.choice[:1].upper() + certificate.choice[1:] + ".")
    lines += [
        f"{s.letters} at {s.time_s:.6g} s: (x, y) = ({s.x:.6f}, {s.y:.6f}), psi = ({s.psi1:.6f}, {s.psi2:.6f})."
        for s in certificate.switches
    ]
    return lines


def _rounded(bound: RoundingBound) -> str:
    """What rounding may add, as a sentence."""
    if bound.delta_m is None or bound.epsilon_s is None:
        return f"How much rounding may add is {bound.basis}."
    return (
        f"In doubles: it ends within {bound.delta_m:.2g} m of the point of joining, and takes at most "
        f"{bound.epsilon_s:.2g} s longer than the least time of its start ({bound.basis})."
    )


def _table(residuals: tuple[Residual, ...]) -> Iterator[str]:
    wide = max(len(residual.equation) for residual in residuals)
    yield f"{'condition':<14}  {'equation':<{wide}}  {'off by':>7}  {'bound':>7}"
    for r in residuals:
        figures = "" if r.value is None or r.bound is None else f"{r.value:7.1e}  {r.bound:7.1e}  "
        note = f" ({r.note})" if r.note else ""
        yield f"{r.name:<14}  {r.equation:<{wide}}  {figures}{r.verdict}{note}"


def _legend(certificate: Certificate) -> Iterator[str]:
    source = certificate.source
    yield f"Numbers in parentheses: equations {source}; lengths in turn radii. docs/certificate.md explains each row."


def _comparison(certificate: Certificate) -> str:
    count, runner_up = len(certificate.others), certificate.runner_up
    ties = ", ".join(f"{tie.word} {tie.turn.value}" for tie in certificate.ties)
    text = f"Compared with {count} other {'extremal' if count == 1 else 'extremals'}"
    if certificate.proved_optimal and certificate.pieces:
        this = (
            f"of the {count + 1} extremals with these words none is faster"
            if count
            else "this is the only extremal with one of them"
        )
        text = f"Theorem 1: in each direction the optimum is one of nine words; {this}"
    text += f"; as fast: {ties}" if ties else ""
    if runner_up is None:
        return text + "."
    return f"{text}; the runner-up {runner_up.word} {runner_up.turn.value} takes {runner_up.later_s:.3g} s more."
