"""The conditions that every maneuver has to meet, in still air and in wind, one function each.

They are those of docs/wind.md, sections 2 and 3, of which still air is the case w = 0. Certificates in still air show
them as the paper writes them, with its further conditions: `paper_conditions`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import NamedTuple

from loiter.certificate.accuracy import STEP, Accuracy
from loiter.certificate.gradient import GradientEquations, gradient_residuals
from loiter.certificate.trajectory import Candidate, FlownPiece, PieceState, Residual, Trajectory, inner
from loiter.planning.model import Turn


class Violation(NamedTuple):
    """By how much a condition is violated, and its bound."""

    value: float
    bound: float


class Condition(NamedTuple):
    """A condition: its name, its equation, and its violation, None where a maneuver has no such condition."""

    name: str
    equation: str
    violation: Callable[[Trajectory, Accuracy], Violation | None]


class EquationOfMotion(NamedTuple):
    """An equation of motion: `quantity`' = `rate`."""

    name: str
    equation: str
    quantity: Callable[[PieceState], complex]
    rate: Callable[[FlownPiece, PieceState], complex]


class Formulation(NamedTuple):
    """The conditions with their names and equations, in the order of a certificate.

    `maximum_principle` maps the fields of `MaximumPrinciple` to equations; `further` holds additional conditions.
    """

    arrival: tuple[Condition, ...]
    motion: tuple[EquationOfMotion, ...]
    maximum_principle: dict[str, str]
    further: tuple[Condition, ...]
    gradient: GradientEquations


def residuals(
    formulation: Formulation, trajectory: Trajectory, accuracy: Accuracy, others: Sequence[Candidate]
) -> Iterator[Residual]:
    """The residual of every condition; those of the adjoint only where the maneuver has pieces."""
    yield from _check(formulation.arrival, trajectory, accuracy)
    if trajectory.pieces:
        yield from motion_residuals(formulation.motion, trajectory, accuracy)
        for name, equation in formulation.maximum_principle.items():
            off, bound = getattr(trajectory.violations, name), getattr(accuracy.maximum_principle, name)
            yield Residual(name, equation, off, bound)
        yield from _check(formulation.further, trajectory, accuracy)
        yield from gradient_residuals(formulation.gradient, trajectory, accuracy)
    yield _comparison(trajectory, accuracy, others)


def _check(conditions: Sequence[Condition], trajectory: Trajectory, accuracy: Accuracy) -> Iterator[Residual]:
    for condition in conditions:
        violation = condition.violation(trajectory, accuracy)
        if violation is not None:
            yield Residual(condition.name, condition.equation, *violation)


def motion_residuals(
    motions: Sequence[EquationOfMotion], trajectory: Trajectory, accuracy: Accuracy
) -> Iterator[Residual]:
    """The equations of motion by central differences along each piece."""
    for motion, bound in zip(motions, accuracy.motion, strict=True):
        off = 0.0
        for piece in trajectory.pieces:
            for s in piece.instants:
                rise = motion.quantity(piece.at(s + STEP)) - motion.quantity(piece.at(s - STEP))
                off = max(off, abs(rise / (2.0 * STEP) - motion.rate(piece, piece.at(s))))
        yield Residual(motion.name, motion.equation, off, bound)


def _comparison(trajectory: Trajectory, accuracy: Accuracy, others: Sequence[Candidate]) -> Residual:
    """The condition that no candidate is faster, which makes an extremal an optimum."""
    sooner, note = 0.0, ""
    for other in others:
        if -other.later_s / trajectory.problem.time_unit_s > sooner:
            sooner = -other.later_s / trajectory.problem.time_unit_s
            note = f"{other.word} {other.turn.value} is faster" if sooner > accuracy.tie else ""
    return Residual("fastest", "T is the least of all candidates", sooner, accuracy.tie, note)


def distance_from_circle(trajectory: Trajectory, accuracy: Accuracy) -> Violation:
    """How far from the circle the maneuver ends."""
    q, _ = trajectory.end
    return Violation(abs(abs(q) - trajectory.start.R), accuracy.end)


def course(trajectory: Trajectory, accuracy: Accuracy) -> Violation:
    """The component of the velocity across the circle at the end."""
    q, e = trajectory.end
    return Violation(abs(inner(q, e + trajectory.start.w)) / max(abs(q), accuracy.end), 2.0 * accuracy.end)


def join(trajectory: Trajectory, accuracy: Accuracy) -> Violation:
    """How far the maneuver's own last pose over the ground is from where its pieces end."""
    pose, circle = trajectory.maneuver.join, trajectory.maneuver.orbit_at_join
    from_centre = complex(pose.east_m - circle.east_m, pose.north_m - circle.north_m)
    q, _ = trajectory.end
    return Violation(abs(from_centre / trajectory.problem.aircraft.turn_radius_m - q), accuracy.join)


def turn(trajectory: Trajectory, accuracy: Accuracy) -> Violation:
    """1 where the maneuver holds the circle in a direction that the problem excludes."""
    maneuver = trajectory.maneuver
    return Violation(float(maneuver.orbit.turn not in (maneuver.turn, Turn.EITHER)), 0.0)


def turn_as_flown(trajectory: Trajectory, accuracy: Accuracy) -> Violation:
    """1 where the maneuver's direction is excluded, or is not the one in which it arrives."""
    (q, e), (_, _, w, _, side) = trajectory.end, trajectory.start
    opposite = inner(1j * q, e + w) * side > 0.0
    excluded, bound = turn(trajectory, accuracy)
    return Violation(max(excluded, float(opposite)), bound)


IN_WIND = Formulation(
    arrival=(
        Condition("target", "|q(T)| = R", distance_from_circle),
        Condition("course", "q.(e + w) = 0 at T: along the circle (1)", course),
        Condition("join", "the last pose over the ground is where the circle is then", join),
        Condition("turn", "the circle is held as asked for", turn_as_flown),
    ),
    motion=(
        EquationOfMotion("motion", "q' = e + w", lambda now: now.q, lambda piece, now: now.e + piece.w),
        EquationOfMotion("turning", "e' = u J e", lambda now: now.e, lambda piece, now: 1j * piece.u * now.e),
        EquationOfMotion("slope", "f' = -p.Je", lambda now: now.phi, lambda piece, now: -now.psi2),
    ),
    maximum_principle={
        "norm": "|p| = 1",
        "multiplier": "lambda + p.w >= 0 (4)",
        "sign": "u = sign f, u = 0 only where f = 0 (4)",
        "hamiltonian": "|f| + p.e = lambda (4)",
        "transversality": "p.(e + w) + u h k (lambda - p.e) = 0 at T (5)",
    },
    further=(),
    gradient=GradientEquations(gradient="(lambda + p.w) grad T = -(p, f)", bellman="1 + min grad T . (e + w, u) = 0"),
)
