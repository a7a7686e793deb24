"""Bounds of the residuals: how large rounding and the tolerance can make them, in turn radii and airspeeds.

A residual is the largest violation at `trajectory.SAMPLES` instants of each piece and at those where psi1 and phi are
extreme. Its bound follows from four accuracies:

- `length`: the rounding of a length in this problem, 64 units of 2^-52 times its size: some 20 operations a piece.
- `end`: the distance from the circle at which the maneuver may end. In still air it is the tolerance or `length`. The
  flow moves the plane rigidly, so no state on the way has a larger error, and phi = psi x state is as accurate, since
  |psi| = 1. In wind it is the error that the kernel accepts, and the tolerance where the maneuver ends beside the
  circle by more than that. The conversion of durations to seconds and back, 4 roundings, adds one `length`.
- `angle`: the accuracy of the direction of p. In still air psi of a single arc is parallel to its start, which may lie
  `end` beside its circle. At the first of two switches psi has turned by the angle of the middle arc, whose accuracy is
  `end` over that arc's radius. In wind p is the direction of the straight piece, or lies between the headings at two
  switches: an error `end` turns it by `end` over the length of the piece, or of the chord of the middle arc.
- `choice`: where two maneuvers nearly tie, rounding of T may choose the slower one. In still air its phi then has the
  wrong sign somewhere, by up to v, and T is too long by 2/lambda times the integral of this error. In the middle of a
  piece such an error lasts at least 2 sqrt(2 v), since |phi''| = |psi1| <= 1, and lengthens T by 3.7 v^(3/2). At the
  start, where a first piece is missing, it lasts at least v, since |phi'| <= 1, and lengthens T by v^2. So v is below
  rounding^(2/3), and below rounding^(1/2) where another candidate ties or the start counts as on a single arc. In wind,
  rounding of T limits how accurately the fastest point of joining is known. As that point moves by a unit of time, p
  turns by some 2 over the length above; a violation v of a condition that changes at the rate r lengthens T by v^2/(2
  r).
"""

from __future__ import annotations

from collections.abc import Sequence
from math import hypot, radians, sin, sqrt
from typing import NamedTuple

from loiter.certificate.trajectory import Candidate, MaximumPrinciple, Trajectory, inner
from loiter.kernel.entry import WIND_TIE_TOLERANCE
from loiter.kernel.rounding import ROUNDING, rounding
from loiter.planning.maneuver import Maneuver

# Steps of central differences of functions known to their last digits, whose third derivative is of the size of the
# function: truncation step^2/6 and rounding ROUNDING/step, 1e-9 and 4e-10 of the size, nearly balance.
STEP = 2.0**-15


class Accuracy(NamedTuple):
    """The accuracies above, and the bounds of residuals.

    `beside` says whether the maneuver ends beside the circle by more than rounding, as the tolerance allows. `motion`
    bounds each equation of motion, in the order of the formulation, `join` the error of the pose at the end of
    the last segment, `gradient` the deviation of the adjoint's direction from that given by the gradient of T.
    Durations closer than `tie` count as equal.
    """

    end: float
    length: float
    angle: float
    beside: bool
    join: float
    motion: tuple[float, ...]
    maximum_principle: MaximumPrinciple
    gradient: float
    tie: float


def accuracy_of(trajectory: Trajectory, others: Sequence[Candidate]) -> Accuracy:
    """The accuracy of a trajectory's residuals; `others` are the candidates it is compared with."""
    return _in_still_air(trajectory, others) if trajectory.problem.has_closed_form else accuracy_in_wind(trajectory)


def _of_difference(third_derivative: float, rounding: float) -> float:
    """The accuracy of a central difference, from the size of the third derivative and the rounding of the function."""
    return STEP * STEP / 6.0 * third_derivative + rounding / STEP


def _in_still_air(trajectory: Trajectory, others: Sequence[Candidate]) -> Accuracy:
    pieces, problem, reduced = trajectory.pieces, trajectory.problem, trajectory.problem.reduced()
    length = rounding(reduced.x, reduced.y, reduced.R)
    end = max(reduced.tolerance, length) + length
    central = _of_switch_at_centre(trajectory, length)
    angle = _angle_of_psi(trajectory, end, length) + central
    tie = 2.0 * length
    tied = any(abs(other.later_s) <= tie * problem.time_unit_s for other in others)
    choice = sqrt(length) if len(pieces) == 1 or tied else length ** (2.0 / 3.0)
    maneuver = trajectory.maneuver
    far = maneuver.length_m / maneuver.aircraft.turn_radius_m + reduced.R
    return Accuracy(
        end,
        length,
        angle,
        beside=2.0 * length < trajectory.miss <= end,
        join=end + length + _heading_rounding(maneuver) * far + _ground_rounding(maneuver),
        # The third derivative of a state on an arc is as large as the arc's radius.
        motion=(
            _of_difference(max((piece.radius for piece in pieces), default=0.0), length),
            _of_difference(1.0, ROUNDING),
            _of_difference(1.0, length),
        ),
        maximum_principle=MaximumPrinciple(
            norm=ROUNDING,
            multiplier=angle,
            sign=angle + choice,
            hamiltonian=angle + 2.0 * choice,
            psi1=angle + choice,
            # The last switch, found from the target, has rounding errors only; a single arc may begin beside its
            # circle.
            transversality=angle if len(pieces) == 1 else length + central,
        ),
        gradient=angle + _turned_by_last_switch(trajectory, end, length),
        tie=tie,
    )


def _angle_of_psi(trajectory: Trajectory, end: float, length: float) -> float:
    pieces, reduced = trajectory.pieces, trajectory.problem.reduced()
    if len(pieces) == 1:
        # psi is parallel to the start, which may lie `end` beside its circle; phi is evaluated up to R + 1 away.
        return end * (1.0 + (1.0 + reduced.R) / max(hypot(reduced.x, reduced.y), length))
    middle = 1.0
    if len(pieces) == 3:
        _, second, _ = pieces
        middle = second.radius if second.u else 1.0
    return end * (1.0 + 1.0 / max(middle, length))


def _of_switch_at_centre(trajectory: Trajectory, length: float) -> float:
    """The accuracy of psi after a switch of two arcs at the centre, up to the root of rounding; 0 without one.

    psi is then that of a switch at the centre itself, on a circle of R = 2 (`adjoints`): by the distance of the switch
    from the centre the arcs, R, and phi at the switch are different.
    """
    if len(trajectory.pieces) != 2 or not trajectory.opposed:
        return 0.0
    distance = abs(trajectory.last.q)
    return 4.0 * distance if distance <= sqrt(length) else 0.0


def _turned_by_last_switch(trajectory: Trajectory, end: float, length: float) -> float:
    """The angle by which an error `end` of the last switch between L and R turns psi; 0 without such a switch.

    The switch is the crossing of two circles about (0, 1) and (0, -1) with radii r1 and r2, at an angle whose sine is 2
    |x|/(r1 r2). An error `end` of one radius moves the crossing by end r1 r2/(2 |x|), but at most to where the circles
    touch, by the square root of end r1 r2. psi is parallel to the state, so it turns by that distance over the state's
    distance from the centre.
    """
    if not trajectory.opposed:
        return 0.0
    *_, last = trajectory.opposed
    x, y = last.start.x, last.start.y
    radii = hypot(x, y + 1.0) * hypot(x, y - 1.0)
    moved = min(end * radii / max(2.0 * abs(x), length), sqrt(end * radii))
    return moved / max(hypot(x, y), length)


def accuracy_in_wind(trajectory: Trajectory) -> Accuracy:
    """The accuracy of a trajectory whose adjoint is read off its pieces."""
    start, maneuver, T = trajectory.start, trajectory.maneuver, trajectory.duration
    length = rounding(start.q.real, start.q.imag, start.R)
    end = 3.0 * length + 2.0 * ROUNDING * T
    tolerance = trajectory.problem.in_wind().tolerance
    beside = end < trajectory.beside <= end + tolerance
    end += tolerance if beside else 0.0
    turning = 1.0 + 1.0 / max(_length_of_direction(trajectory), end)
    angle = end * turning
    choice = angle + sqrt(4.0 * end * turning)
    join = end + _heading_rounding(maneuver) * (1.0 + T) + _ground_rounding(maneuver)
    return Accuracy(
        end,
        length,
        angle,
        beside,
        join=join,
        motion=(_of_difference(1.0, length),) * 3,
        maximum_principle=MaximumPrinciple(
            norm=ROUNDING,
            multiplier=choice,
            sign=choice,
            hamiltonian=2.0 * choice,
            psi1=choice,
            transversality=choice,
        ),
        gradient=choice,
        tie=WIND_TIE_TOLERANCE * (1.0 + start.R + T) + 2.0 * _time_of_rounding(trajectory, length),
    )


def _time_of_rounding(trajectory: Trajectory, length: float) -> float:
    """By how much rounding of the end can change T in wind: its length over lambda + p.w, but at most its root.

    A displacement of the start, or of the end, changes T by its component along p over lambda + p.w. Where the circles
    of two arcs touch that is 0, and T changes with the root of a displacement.
    """
    if not trajectory.pieces:
        return length
    first = trajectory.first
    steep = trajectory.lam + inner(first.p, first.w)
    return max(length, min(length / max(steep, length), sqrt(length)))


def _length_of_direction(trajectory: Trajectory) -> float:
    """The length of the straight piece or of the chord of the middle arc that fixes the direction of p; at most 1."""
    pieces = trajectory.pieces
    if trajectory.lam == 1.0:
        return min(1.0, max((piece.t for piece in pieces if piece.u == 0), default=1.0))
    if len(pieces) < 3:
        return 1.0
    _, middle, _ = pieces
    return min(1.0, 2.0 * abs(sin(0.5 * middle.t)))


def _heading_rounding(maneuver: Maneuver) -> float:
    """The rounding of a heading, radians: of the start's plus two turns, rounded twice at each of three pieces."""
    return 6.0 * 2.0**-52 * radians(abs(maneuver.start.heading_deg) + 720.0)


def _ground_rounding(maneuver: Maneuver) -> float:
    """The rounding of positions over the ground, turn radii: that of coordinates and of the distances that all move."""
    start, centre = maneuver.start, maneuver.orbit
    coordinates = sum(map(abs, (start.east_m, start.north_m, centre.east_m, centre.north_m)))
    speeds = maneuver.wind.speed_m_s + hypot(centre.velocity_east_m_s, centre.velocity_north_m_s)
    metres = coordinates + maneuver.length_m + speeds * maneuver.duration_s
    return ROUNDING * metres / maneuver.aircraft.turn_radius_m
