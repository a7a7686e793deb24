"""The conditions in still air as the paper writes them, in the reduced plane, with its further conditions.

The reduced state (2), psi = (p.e, p.Je) and phi obey (7) and (11)-(18); the target is a point, (8)-(10). Those valid in
still air only are the switching points (19), the line through the centre, and the symmetry of *either* (paper, sections
3 and 5).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from functools import partial
from itertools import pairwise
from math import atan2, hypot, pi, sqrt

from loiter.certificate import conditions
from loiter.certificate.accuracy import Accuracy
from loiter.certificate.conditions import Condition, EquationOfMotion, Formulation, Violation
from loiter.certificate.gradient import GradientEquations
from loiter.certificate.trajectory import FlownPiece, Trajectory
from loiter.kernel.angles import angle
from loiter.kernel.still_air.extremals import onto_axis
from loiter.planning.model import CALM, Turn


def target(trajectory: Trajectory, accuracy: Accuracy) -> Violation:
    """The distance of the last reduced state from the target."""
    return Violation(trajectory.miss, accuracy.end)


def join(trajectory: Trajectory, accuracy: Accuracy) -> Violation:
    """The distance of the maneuver's own last pose, reduced, from the target."""
    maneuver, start = trajectory.maneuver, trajectory.start
    last = replace(trajectory.problem, pose=maneuver.join, orbit=maneuver.orbit_at_join, wind=CALM).reduced()
    return Violation(hypot(last.x, last.y - start.side * start.R), accuracy.join)


# Switching points


def switch(trajectory: Trajectory, accuracy: Accuracy) -> Violation | None:
    """The largest distance of (phi, psi1 - lambda) from 0 at the switches between L and R."""
    starts = [piece.start for piece in trajectory.opposed]
    off = max((hypot(start.phi, start.psi1 - trajectory.lam) for start in starts), default=None)
    return None if off is None else Violation(off, accuracy.angle)


def middle_arc(trajectory: Trajectory, accuracy: Accuracy) -> Violation | None:
    """The error of the duration of the arc between two switches, or how far it falls short of pi, if more."""
    if len(trajectory.opposed) != 2:
        return None
    middle, last = trajectory.opposed
    # Between the switches psi turns from (lambda, +-psi2) to (lambda, -+psi2) the long way, through psi1 < 0.
    lasts = 2.0 * (pi - atan2(abs(last.start.psi2), last.start.psi1))
    return Violation(max(abs(middle.t - lasts), pi - middle.t), 2.0 * accuracy.angle)


def slopes(trajectory: Trajectory, accuracy: Accuracy) -> Violation | None:
    """The violation of (19) by two consecutive switching points, multiplied by y1 y."""
    if len(trajectory.opposed) != 2:
        return None
    a, b = (piece.start for piece in trajectory.opposed)
    # A product of two states, each off by `end`, and of psi, off by `angle`.
    ra, rb = abs(a.reduced), abs(b.reduced)
    return Violation(abs(a.x * b.y + b.x * a.y), accuracy.end * (ra + rb) + accuracy.angle * ra * rb)


def line(trajectory: Trajectory, accuracy: Accuracy) -> Violation | None:
    """The distance of a straight piece from the centre."""
    off = max((abs(piece.start.y) for piece in trajectory.pieces if piece.u == 0), default=None)
    return None if off is None else Violation(off, accuracy.end)


# Either direction: (x, |y|) is a trajectory of the same duration, so it is optimal too, and it switches where y changes
# sign: there phi = -psi2 x = 0. On an arc that is possible only where psi = (1, 0), on the last circle of a single arc.
# So after a switch the last arc begins on the target's side of the axis, and lasts acos(1/(1 + R)) at most, pi/3 at
# R = 1 (docs/theory.md, section 1).


def axis(trajectory: Trajectory, accuracy: Accuracy) -> Violation | None:
    """|psi2| where y changes sign, times the |y| reached beyond; only for *either*."""
    if trajectory.problem.orbit.turn != Turn.EITHER:
        return None
    arcs = (piece for piece in trajectory.pieces if piece.u)
    return Violation(
        max((lost for arc in arcs for lost in _crossings(arc)), default=0.0), accuracy.maximum_principle.sign
    )


def _crossings(arc: FlownPiece) -> Iterator[float]:
    """For each crossing of the axis by an arc, |psi2| there times the smaller of the heights before and after.

    It is lambda/2 times the time that a start at this height loses by crossing, so rounding bounds it.
    """
    crossings = (onto_axis(arc.start.x, arc.u * arc.start.y, end, 0.0) for end in (-1.0, 1.0))
    ends = sorted(angle(rotated) for rotated, c in crossings if c >= 0.0)
    bounds = [0.0, *(s for s in ends if s < arc.t), arc.t]
    heights = [abs(arc.at(0.5 * (a + b)).y) for a, b in pairwise(bounds)]
    for s, (before, after) in zip(bounds[1:], pairwise(heights), strict=False):
        yield abs(arc.at(s).psi2) * min(before, after)


def last_arc(trajectory: Trajectory, accuracy: Accuracy, *, tight: bool) -> Violation | None:
    """By how much a last arc after a switch exceeds acos(1/(1 + R)); None unless `tight` equals (R == 1)."""
    last, (_, _, _, R, side) = trajectory.last, trajectory.start
    free = trajectory.problem.orbit.turn == Turn.EITHER and tight == (R == 1.0)
    if not free or len(trajectory.pieces) == 1 or last.u != side:
        return None
    longest = atan2(sqrt(R * (R + 2.0)), 1.0)
    # If the arc begins t too early, psi differs from (1, 0) by at most t, and phi from 0 by t^2/2 in mid-arc.
    early = sqrt(2.0 * accuracy.length ** (2.0 / 3.0))
    return Violation(max(0.0, last.t - longest), accuracy.end + early)


IN_STILL_AIR = Formulation(
    arrival=(
        Condition("target", "x(T) = 0, y(T) = R or -R (8)-(10)", target),
        Condition("join", "the last pose, reduced by (2), is the target", join),
        Condition("turn", "the circle is held as asked for", conditions.turn),
    ),
    motion=(
        EquationOfMotion(
            "motion",
            "x' = 1 + u y, y' = -u x (7)",
            lambda now: now.reduced,
            lambda piece, now: 1.0 - 1j * piece.u * now.reduced,
        ),
        EquationOfMotion(
            "adjoint",
            "psi1' = u psi2, psi2' = -u psi1 (12)",
            lambda now: now.psi,
            lambda piece, now: -1j * piece.u * now.psi,
        ),
        EquationOfMotion("slope", "phi' = -psi2 (17)", lambda now: now.phi, lambda piece, now: -now.psi2),
    ),
    maximum_principle={
        "norm": "|psi| = 1 (18)",
        "multiplier": "lambda >= 0",
        "sign": "u = sign phi, u = 0 only where phi = 0 (13)",
        "hamiltonian": "|phi| + psi1 = lambda (14)",
        "psi1": "psi1 <= lambda (16)",
        "transversality": "psi1(T) (1 + u side R) = lambda",
    },
    further=(
        Condition("switch", "phi = 0, psi1 = lambda at each switch", switch),
        Condition("middle arc", "lasts 2 pi - 2 acos lambda, more than pi", middle_arc),
        Condition("slopes", "x1/y1 = -x/y (19)", slopes),
        Condition("line", "y = 0 while u = 0: a line through the centre", line),
        Condition("axis", "|psi2| times the |y| reached beyond = 0 where y changes sign", axis),
        Condition("last arc", "lasts pi/3 at most", partial(last_arc, tight=True)),
        Condition("last arc", "lasts acos(1/(1 + R)) at most", partial(last_arc, tight=False)),
    ),
    gradient=GradientEquations(gradient="lambda grad T = -psi", bellman="1 + min grad T . f = 0"),
)
