"""The adjoint of a maneuver, and the trajectory with it.

In still air the adjoint is the closed form of `kernel.adjoint`. In wind it is read off the straight piece or the two
switches, or off the condition (5) at the circle where there is one switch; where a piece may be due to rounding alone,
several adjoints are possible, and the one that violates the conditions least is taken.
"""

from __future__ import annotations

from cmath import exp
from collections.abc import Iterator, Sequence
from itertools import pairwise
from math import atan2, cos, hypot, pi, sqrt
from typing import NamedTuple

from loiter.certificate.trajectory import (
    FlownPiece,
    InitialAdjoint,
    RelativeStart,
    Trajectory,
    durations_of,
    end_rate,
    flown_pieces,
    held_turn,
    inner,
    word_of,
)
from loiter.kernel.adjoint import adjoint, switching_function, turn_adjoint
from loiter.kernel.entry import Entry
from loiter.kernel.motion import flow
from loiter.kernel.rounding import rounding
from loiter.kernel.wind.fits import SHORT
from loiter.kernel.words import encode
from loiter.planning.maneuver import Maneuver
from loiter.planning.model import CONTROLS, sign_of
from loiter.planning.problem import Problem

# Directions of p tried for a single arc, for which many p may meet the conditions.
SCANNED_DIRECTIONS = 720


class FlightPlan(NamedTuple):
    """The arguments of `flown_pieces`: the start, the controls, their durations, and the adjoint."""

    start: RelativeStart
    controls: Sequence[int]
    durations: Sequence[float]
    adjoint: InitialAdjoint


def trajectory_of(maneuver: Maneuver, problem: Problem) -> Trajectory:
    """The maneuver flown from its start, its letters and its durations alone, with its adjoint.

    Raises `InvalidArgument` for a turn that is neither cw nor ccw, letters that are not a word, and durations that
    cannot be flown.
    """
    start = _start(problem, sign_of(held_turn(maneuver)))
    controls, durations = [CONTROLS[letter] for letter in word_of(maneuver).letters], durations_of(maneuver)
    if not controls:
        return Trajectory(maneuver, problem, start, 1.0, ())
    plans = (_in_still_air if problem.has_closed_form else _in_wind)(start, controls, durations)
    flown = (Trajectory(maneuver, problem, plan.start, plan.adjoint.lam, tuple(flown_pieces(*plan))) for plan in plans)
    return min(flown, key=lambda trajectory: trajectory.worst_violation)


def _start(problem: Problem, side: int) -> RelativeStart:
    if problem.has_closed_form:
        x, y, R, _, _ = problem.reduced()
        return RelativeStart(complex(x, y), 1.0 + 0.0j, 0.0j, R, side)
    return start_in_wind(problem, side)


def start_in_wind(problem: Problem, side: int) -> RelativeStart:
    """The start relative to the circle in the axes of the plane, in still air too."""
    x, y, c, s, R, _, wx, wy, _ = problem.in_wind()
    return RelativeStart(complex(x, y), complex(c, s), complex(wx, wy), R, side)


# Still air


def _in_still_air(start: RelativeStart, controls: Sequence[int], durations: Sequence[float]) -> list[FlightPlan]:
    plan = _with_closed_form(start, controls, durations)
    if len(controls) != 2 or 0 in controls:
        return [plan]
    return [_one_arc(plan) or plan, *_switch_at_centre(plan)]


def _with_closed_form(start: RelativeStart, controls: Sequence[int], durations: Sequence[float]) -> FlightPlan:
    """A word flown with the adjoint of `kernel.adjoint`."""
    x, y = start.q.real, start.q.imag
    t1, t2, t3 = [*durations, 0.0, 0.0][:3]
    lam, psi1, psi2 = adjoint(x, y, start.R, Entry(start.side, encode(*controls), t1, t2, t3))
    return FlightPlan(
        start, controls, durations, InitialAdjoint(complex(psi1, psi2), lam, switching_function(x, y, psi1, psi2))
    )


def _switch_at_centre(plan: FlightPlan) -> Iterator[FlightPlan]:
    """The plan with psi = (1, 0) at its switch, where this is at the centre up to the root of rounding.

    The circles of the two arcs touch there, up to rounding: two crossings as far as that from the centre tie, and the
    direction of the switch from the centre, to which psi is parallel, has no digit left. At the centre any psi is
    possible.
    """
    start, (u, _), (first, _), _ = plan
    x, y = start.q.real, start.q.imag
    if hypot(*flow(x, y, u, first)) <= sqrt(rounding(x, y, start.R)):
        psi1, psi2 = turn_adjoint(1.0, 0.0, u, -first)
        yield plan._replace(adjoint=InitialAdjoint(complex(psi1, psi2), 1.0, switching_function(x, y, psi1, psi2)))


def _one_arc(plan: FlightPlan) -> FlightPlan | None:
    """The single arc that two arcs amount to where one of them is due to rounding alone; otherwise None.

    A start that is off the circle of the last arc by rounding begins with a piece so short that its control changes T
    by no more than rounding: by 2/lambda times the integral of |phi|, which changes by at most the duration. Where the
    circles touch at the target, the last piece is so short that the first arc, continued, ends there too.
    """
    start, (u, v), (first, last), _ = plan
    x, y = start.q.real, start.q.imag
    size = rounding(x, y, start.R)
    late = _with_closed_form(start._replace(q=complex(*flow(x, y, u, first))), [v], [last])
    if (abs(late.adjoint.phi) + first) * first <= late.adjoint.lam * size:
        return late
    end_x, end_y = flow(x, y, u, first + last)
    if hypot(end_x, end_y - start.side * start.R) <= size:
        return _with_closed_form(start, [u], [first + last])
    return None


# Wind


def _in_wind(start: RelativeStart, controls: Sequence[int], durations: Sequence[float]) -> list[FlightPlan]:
    adjoints = _adjoints_in_wind(start, controls, durations)
    return [FlightPlan(start, controls, durations, adjoint) for adjoint in adjoints]


def _adjoints_in_wind(
    start: RelativeStart, controls: Sequence[int], durations: Sequence[float]
) -> Iterator[InitialAdjoint]:
    """All adjoints that the pieces may have."""
    pieces = list(flown_pieces(start, controls, durations, InitialAdjoint(1.0 + 0.0j, 1.0, 0.0)))
    yield from switch_adjoints(start, pieces)
    for before, piece in pairwise(pieces):
        if piece.u and (before.u or before.t <= SHORT):
            yield from _transversal(start, pieces, piece)
    if sum(piece.t > SHORT for piece in pieces) <= 1:
        yield from _of_single_arc(start, pieces)


def _transversal(start: RelativeStart, pieces: list[FlownPiece], switched: FlownPiece) -> Iterator[InitialAdjoint]:
    """The adjoints that meet (5) with a switch at the start of a piece."""
    # (5) is linear in the cosine and the sine of the angle from the heading at the switch to p.
    turned, (e, k) = switched.e, _end(start, pieces)
    across = inner(1j * turned, e + start.w) - k * inner(1j * turned, e)
    along = inner(turned, e + start.w) + k * (1.0 - inner(turned, e))
    for angle in (atan2(-along, across), atan2(along, -across)):
        yield vanishing_at(start, pieces, switched, turned * exp(1j * angle), cos(angle))


def _of_single_arc(start: RelativeStart, pieces: list[FlownPiece]) -> Iterator[InitialAdjoint]:
    """The adjoints that meet (5) without a switch: one for each of `SCANNED_DIRECTIONS` directions of p."""
    longest, (e, k) = max(pieces, key=lambda piece: piece.t), _end(start, pieces)
    for i in range(SCANNED_DIRECTIONS):
        p = exp(2j * pi * i / SCANNED_DIRECTIONS)
        lam = inner(p, e) - inner(p, e + start.w) / k
        yield InitialAdjoint(p, lam, longest.u * (lam - inner(p, start.e)))


def _end(start: RelativeStart, pieces: list[FlownPiece]) -> tuple[complex, float]:
    """The heading at the end, and the turn rate that holds the circle there."""
    *_, last = pieces
    return last.end.e, end_rate(start, last.end.q, last.end.e, last.u)


def switch_adjoints(start: RelativeStart, pieces: list[FlownPiece]) -> Iterator[InitialAdjoint]:
    """The adjoints along the straight pieces, and the one that two switches about an arc determine."""
    for piece in pieces:
        if piece.u == 0:
            yield vanishing_at(start, pieces, piece, piece.e, 1.0)
    if len(pieces) == 3 and pieces[1].u:
        middle = pieces[1]
        yield vanishing_at(start, pieces, middle, -middle.e * exp(0.5j * middle.u * middle.t), -cos(0.5 * middle.t))


def vanishing_at(
    start: RelativeStart, pieces: list[FlownPiece], piece: FlownPiece, p: complex, lam: float
) -> InitialAdjoint:
    """The adjoint whose switching function vanishes at the start of a piece."""
    elapsed = sum(before.t for before in pieces[: pieces.index(piece)])
    return InitialAdjoint(p, lam, inner(p, 1j * (piece.q - start.q - start.w * elapsed)))
