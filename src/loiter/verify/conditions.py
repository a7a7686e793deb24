"""The conditions of the maximum principle (11)-(18), one by one, for a maneuver and its adjoint."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise
from math import atan2, hypot, pi, radians, sqrt

from loiter.kernel.angles import angle
from loiter.kernel.codes import Side
from loiter.kernel.extremals import onto_axis
from loiter.kernel.synthesis import ROUNDING
from loiter.planning.maneuver import Maneuver
from loiter.planning.model import Turn
from loiter.planning.problem import Problem, problem_of
from loiter.verify.bellman import bellman
from loiter.verify.proof import Candidate, Flight, Piece, Residual

# Steps of central differences of functions known to their last digits, whose third derivative is of the size of the
# function: truncation step^2/6 and rounding ROUNDING/step, 1e-9 and 4e-10 of the size, nearly balance.
STEP = 2.0**-15


def residuals(
    flight: Flight, maneuver: Maneuver, tolerance_m: float, others: tuple[Candidate, ...]
) -> Iterator[Residual]:
    """Every condition that the maneuver has to meet; those of the adjoint only where there is something to decide."""
    yield from _arrival(flight, maneuver, tolerance_m)
    if flight.pieces:
        yield from _motions(flight)
        yield from _maximum_principle(flight)
        yield from _switching(flight)
        yield from _either(flight)
        yield from bellman(flight)
    yield _fastest(flight, maneuver, others)


def _arrival(flight: Flight, maneuver: Maneuver, tolerance_m: float) -> Iterator[Residual]:
    """The maneuver ends on the circle, in the kernel's terms and in metres."""
    scene, (end, size, *_) = flight.scene, flight.accuracy
    x, y = flight.end[:2] if flight.pieces else (scene.x, scene.y)
    yield Residual("target", "x(T) = 0, y(T) = R or -R (8)-(10)", hypot(x, y - flight.side * scene.R), end)
    join = Problem(maneuver.join, maneuver.orbit_at_join, maneuver.aircraft, tolerance_m=tolerance_m).reduced()
    # A heading is rounded at each of three pieces, twice, and the course errs by that much over the whole length.
    headings = 6.0 * 2.0**-52 * radians(abs(maneuver.start.heading_deg) + 720.0)
    far = maneuver.length_m / maneuver.aircraft.turn_radius_m + scene.R
    bound = end + max(join.tolerance, size) + headings * far
    yield Residual(
        "join", "the last pose, reduced by (2), is the target", hypot(join.x, join.y - flight.side * scene.R), bound
    )
    wrong = maneuver.orbit.turn not in (maneuver.turn, Turn.EITHER)
    yield Residual("turn", "the circle is held as asked for", float(wrong), 0.0)


def _motions(flight: Flight) -> Iterator[Residual]:
    """The equations of motion by central differences of state, psi and phi along each piece."""
    size = flight.accuracy.rounding
    state = costate = slope = norm = reach = 0.0
    for piece in flight.pieces:
        reach = max(reach, piece.radius)
        for s in piece.instants:
            x, y, psi1, psi2, _ = piece.at(s)
            before, after = piece.at(s - STEP), piece.at(s + STEP)
            dx, dy, dpsi1, dpsi2, dphi = ((b - a) / (2.0 * STEP) for a, b in zip(before, after, strict=True))
            state = max(state, hypot(dx - 1.0 - piece.u * y, dy + piece.u * x))
            costate = max(costate, hypot(dpsi1 - piece.u * psi2, dpsi2 + piece.u * psi1))
            slope = max(slope, abs(dphi + psi2))
            norm = max(norm, abs(hypot(psi1, psi2) - 1.0))
    # Third derivatives: the radius of the arc for the state, |psi| = 1 for psi and, phi' being -psi2, for phi.
    truncation = STEP * STEP / 6.0
    yield Residual("motion", "x' = 1 + u y, y' = -u x (7)", state, truncation * reach + size / STEP)
    yield Residual("adjoint", "psi1' = u psi2, psi2' = -u psi1 (12)", costate, truncation + ROUNDING / STEP)
    yield Residual("slope", "phi' = -psi2 (17)", slope, truncation + size / STEP)
    yield Residual("norm", "|psi| = 1 (18)", norm, ROUNDING)


def _maximum_principle(flight: Flight) -> Iterator[Residual]:
    """(13), (14), (16) and the condition at the target."""
    lam, (_, size, angle, choice) = flight.lam, flight.accuracy
    sign = hamiltonian = above = 0.0
    for piece in flight.pieces:
        for _, _, psi1, _, phi in map(piece.at, piece.instants):
            # The control +1 or -1 asks for phi of its sign or 0, the control 0 for phi = 0.
            sign = max(sign, -piece.u * phi if piece.u else abs(phi))
            hamiltonian = max(hamiltonian, abs(abs(phi) + psi1 - lam))
            above = max(above, psi1 - lam)
    last = flight.pieces[-1].u * flight.side * flight.scene.R
    transversality = abs(flight.end.psi1 * (1.0 + last) - lam)
    # The last switch is found from the target and off by rounding alone; a single arc may begin beside its circle.
    off = angle if len(flight.pieces) == 1 else size
    yield Residual("multiplier", "lambda >= 0", max(0.0, -lam), angle)
    yield Residual("sign", "u = sign phi, u = 0 only where phi = 0 (13)", sign, angle + choice)
    yield Residual("hamiltonian", "|phi| + psi1 = lambda (14)", hamiltonian, angle + 2.0 * choice)
    yield Residual("psi1", "psi1 <= lambda (16)", above, angle + choice)
    yield Residual("transversality", "psi1(T) (1 + u side R) = lambda", transversality, off)


def _switching(flight: Flight) -> Iterator[Residual]:
    """What follows for the pieces: (19), equal arcs, the line through the centre."""
    lam, (end, _, angle, _), opposed = flight.lam, flight.accuracy, flight.opposed
    if opposed:
        off = max(hypot(piece.at(0.0).phi, piece.psi1 - lam) for piece in opposed)
        yield Residual("switch", "phi = 0, psi1 = lambda at each switch", off, angle)
    if len(opposed) == 2:
        a, b = opposed
        # Between two switches psi goes round from (lambda, +-psi2) to (lambda, -+psi2) the long way, through psi1 < 0.
        apart = 2.0 * (pi - atan2(abs(b.psi2), b.psi1))
        yield Residual(
            "middle arc", "lasts 2 pi - 2 acos lambda, more than pi", max(abs(a.t - apart), pi - a.t), 2.0 * angle
        )
        # A product of two states, each off by `end`, and of psi, off by `angle`.
        ra, rb = hypot(a.x, a.y), hypot(b.x, b.y)
        yield Residual("slopes", "x1/y1 = -x/y (19)", abs(a.x * b.y + b.x * a.y), end * (ra + rb) + angle * ra * rb)
    for piece in flight.pieces:
        if piece.u == 0:
            yield Residual("line", "y = 0 while u = 0: a line through the centre", abs(piece.y), end)


def _either(flight: Flight) -> Iterator[Residual]:
    """What being free to choose the direction adds (paper, sections 3 and 5; docs/theory.md, section 1).

    (x, |y|) is a trajectory as fast, so it is optimal too, and where y changes sign it switches: phi = -psi2 x = 0.
    On an arc that holds where psi = (1, 0) alone, on the last circle of a single arc. With a switch before it the last
    arc therefore begins on the target's side of the axis, and takes acos(1/(1 + R)) at most: pi/3 at R = 1.
    """
    if flight.scene.side != Side.EITHER:
        return
    end, _, angle, choice = flight.accuracy
    across = max((lost for piece in flight.pieces if piece.u for lost in _crossings(piece)), default=0.0)
    yield Residual("axis", "psi2 = 0 where y changes sign, times |y| beyond", across, angle + choice)
    last, R = flight.pieces[-1], flight.scene.R
    if len(flight.pieces) > 1 and last.u == flight.side:
        longest = atan2(sqrt(R * (R + 2.0)), 1.0)
        name = "pi/3" if R == 1.0 else "acos(1/(1 + R))"
        # Begun t too early, psi is off (1, 0) by t or less and phi is wrong by t^2/2 in the middle of the arc.
        early = sqrt(2.0 * flight.accuracy.rounding ** (2.0 / 3.0))
        yield Residual("last arc", f"lasts {name} at most", max(0.0, last.t - longest), end + early)


def _crossings(piece: Piece) -> Iterator[float]:
    """For each time that an arc crosses the axis, |psi2| there times the least of the heights before and after.

    That is half the time, times lambda, that a start at this height loses by crossing, so rounding bounds it.
    """
    crossings = (onto_axis(piece.x, piece.u * piece.y, end, 0.0) for end in (-1.0, 1.0))
    ends = sorted(angle(rotated) for rotated, c in crossings if c >= 0.0)
    bounds = [0.0, *(s for s in ends if s < piece.t), piece.t]
    heights = [abs(piece.at(0.5 * (a + b)).y) for a, b in pairwise(bounds)]
    for s, (before, after) in zip(bounds[1:], pairwise(heights), strict=False):
        yield abs(piece.at(s).psi2) * min(before, after)


def _fastest(flight: Flight, maneuver: Maneuver, others: tuple[Candidate, ...]) -> Residual:
    """No candidate is faster: what makes an extremal an optimum."""
    unit_s = problem_of(maneuver).time_unit_s
    sooner = max((-other.later_s / unit_s for other in others), default=0.0)
    note = f"{others[0].word} {others[0].turn.value} is faster" if sooner > flight.accuracy.tie else ""
    return Residual("fastest", "T is the least of all candidates", max(0.0, sooner), flight.accuracy.tie, note)
