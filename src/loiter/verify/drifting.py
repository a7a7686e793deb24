"""A maneuver in wind with its adjoint: the maximum principle of docs/wind.md, section 3, condition by condition.

All is relative to the circle, as complex numbers: the position q, the heading e, the adjoint p of the position and the
velocity w of the air; lengths in turn radii, times in turn radii over airspeed. The maneuver is flown here from its
start, its letters and its durations; what bounds the residuals:

- `end`: how far a plan may end from the circle: what the kernel lets pass, and a rounding more for seconds and back;
- `angle`: p is the direction of the straight piece, or lies between the headings at two switches: an error `end`
  turns it by that over the length of the piece, or of the chord of the arc, `definite`;
- `choice`: the fastest point of joining is known to where T differs by a rounding. As it moves p turns, by some 2 over
  `definite` a unit of time; a condition that is off by v and changes at the rate r costs v^2/(2 r) of T.
"""

from __future__ import annotations

from cmath import exp
from collections.abc import Iterator
from itertools import pairwise
from math import atan2, cos, hypot, pi, radians, sin, sqrt
from typing import NamedTuple

from loiter.kernel import wind_search
from loiter.kernel.synthesis import ROUNDING, rounding
from loiter.kernel.wind_search import WindProblem
from loiter.kernel.words import Word
from loiter.planning.maneuver import Maneuver
from loiter.planning.model import CONTROLS, Turn
from loiter.planning.problem import problem_of
from loiter.planning.sides import SIDES
from loiter.verify.proof import SAMPLES, Candidate, PieceState, Residual, durations_of, side_of, word_of

# A piece as short as this is what rounding may leave of none: p is then looked for without it too.
SHORT = wind_search.SHORT

# Directions of p tried for a single arc, for which many p may meet the conditions.
DIRECTIONS = 720

# Steps of central differences along a flight, and of T: coarse to fine, until rounding of T takes over.
STEP = 2.0**-15
QUOTIENT_STEPS = (2.0**-6, 2.0**-9, 2.0**-12, 2.0**-15)

# A gradient of T that does not settle to this share of itself says nothing.
RESOLVED = 1e-3


class Leg(NamedTuple):
    """A piece as flown: control, duration, and at its start position, heading and switching function; p and w."""

    u: int
    t: float
    q: complex
    e: complex
    phi: float
    p: complex
    w: complex

    def flown(self, s: float) -> tuple[complex, complex]:
        """Position and heading after a time s."""
        turned = exp(1j * self.u * s)
        through_air = self.e * s if self.u == 0 else self.e * (turned - 1.0) / (1j * self.u)
        return self.q + through_air + self.w * s, self.e * turned

    def at(self, s: float) -> PieceState:
        """As `proof.Piece`: the reduced position, p.e and p.Je, the switching function, whose slope is -p.Je."""
        q, e = self.flown(s)
        reduced = q * e.conjugate()
        phi = self.phi - inner(self.p, 1j * (q - self.q - self.w * s))
        return PieceState(reduced.real, reduced.imag, inner(self.p, e), inner(self.p, 1j * e), phi)

    @property
    def instants(self) -> list[float]:
        """Times within the piece: evenly spread, and where p.e is extreme."""
        even = [self.t * i / (SAMPLES - 1) for i in range(SAMPLES)]
        _, _, psi1, psi2, _ = self.at(0.0)
        extreme = self.u * atan2(psi2, psi1) % pi
        return even + [s for s in (extreme, extreme + pi) if self.u and s < self.t]


class Costate(NamedTuple):
    """p, lambda, and the switching function at the start."""

    p: complex
    lam: float
    phi: float


class Flight(NamedTuple):
    """A maneuver in the kernel's terms, with its adjoint."""

    scene: WindProblem
    side: int
    lam: float
    legs: list[Leg]
    size: float
    end: float

    @property
    def w(self) -> complex:
        """The air past the circle."""
        return complex(self.scene.wx, self.scene.wy)

    @property
    def definite(self) -> float:
        """The length of the piece whose direction p is, the chord of the arc between two switches, or 1."""
        if self.lam == 1.0:
            return min(1.0, max((leg.t for leg in self.legs if leg.u == 0), default=1.0))
        return min(1.0, 2.0 * abs(sin(0.5 * self.legs[1].t))) if len(self.legs) == 3 else 1.0

    @property
    def angle(self) -> float:
        """The accuracy of the direction of p."""
        return self.end * (1.0 + 1.0 / max(self.definite, self.end))

    @property
    def choice(self) -> float:
        """By how much a condition may be off where T is off by a rounding only."""
        return self.angle + sqrt(4.0 * self.end * (1.0 + 1.0 / max(self.definite, self.end)))

    @property
    def tie(self) -> float:
        """Durations are equal that differ by less."""
        return wind_search.TIE_TOLERANCE * (1.0 + self.scene.R + sum(leg.t for leg in self.legs)) + 2.0 * self.size

    @property
    def flown(self) -> tuple[complex, complex]:
        """Position and heading at the end."""
        if not self.legs:
            return complex(self.scene.x, self.scene.y), complex(self.scene.c, self.scene.s)
        return self.legs[-1].flown(self.legs[-1].t)


def inner(a: complex, b: complex) -> float:
    """The inner product of two vectors."""
    return (a.conjugate() * b).real


def flight_of(maneuver: Maneuver, tolerance_m: float) -> Flight:
    """The maneuver flown from its start, its letters and its durations alone."""
    scene = problem_of(maneuver, tolerance_m).in_wind()
    word, times, side = word_of(maneuver), durations_of(maneuver), int(SIDES[side_of(maneuver)])
    size = rounding(scene.x, scene.y, scene.R)
    end = 3.0 * size + 2.0 * ROUNDING * sum(times)
    controls = [CONTROLS[letter] for letter in Word(word).letters]
    # Where a piece is there by rounding alone several p are possible: the one that violates the conditions least.
    flights = (
        Flight(scene, side, costate.lam, legs_of(scene, controls, times, costate), size, end)
        for costate in costates(scene, side, controls, times)
    )
    return min(flights, key=violated, default=Flight(scene, side, 1.0, [], size, end))


def legs_of(scene: WindProblem, controls: list[int], times: list[float], costate: Costate) -> list[Leg]:
    """The pieces flown one after the other."""
    q, e, w, phi = complex(scene.x, scene.y), complex(scene.c, scene.s), complex(scene.wx, scene.wy), costate.phi
    legs = []
    for u, t in zip(controls, times, strict=True):
        legs.append(Leg(u, t, q, e, phi, costate.p, w))
        phi = legs[-1].at(t).phi
        q, e = legs[-1].flown(t)
    return legs


def costates(scene: WindProblem, side: int, controls: list[int], times: list[float]) -> Iterator[Costate]:
    """Every p and lambda that the pieces may have."""
    legs = legs_of(scene, controls, times, Costate(1.0 + 0.0j, 1.0, 0.0))
    if not legs:
        return
    u, k, (q, e), w = legs[-1].u, 0.0, legs[-1].flown(legs[-1].t), legs[-1].w
    k = -side * u * rate(q, e, w)
    for before, leg in pairwise([None, *legs]):
        assert leg is not None
        if leg.u == 0:
            yield vanishing_at(legs, leg, leg.e, 1.0)
        elif before is not None and (before.u != 0 or before.t <= SHORT):
            # (5) is linear in the cosine and the sine of the angle from the heading at the switch to p.
            across = inner(1j * leg.e, e + w) - k * inner(1j * leg.e, e)
            along = inner(leg.e, e + w) + k * (1.0 - inner(leg.e, e))
            for angle in (atan2(-along, across), atan2(along, -across)):
                yield vanishing_at(legs, leg, leg.e * exp(1j * angle), cos(angle))
    if len(legs) == 3 and legs[1].u:
        middle = legs[1]
        yield vanishing_at(legs, middle, -middle.e * exp(0.5j * middle.u * middle.t), -cos(0.5 * middle.t))
    if sum(leg.t > SHORT for leg in legs) <= 1:
        longest = max(legs, key=lambda leg: leg.t)
        for i in range(DIRECTIONS):
            p = exp(2j * pi * i / DIRECTIONS)
            lam = inner(p, e) - inner(p, e + w) / k
            yield Costate(p, lam, longest.u * (lam - inner(p, legs[0].e)))


def vanishing_at(legs: list[Leg], leg: Leg, p: complex, lam: float) -> Costate:
    """The costate whose switching function vanishes at the start of a piece."""
    flown = leg.q - legs[0].q - leg.w * sum(before.t for before in legs[: legs.index(leg)])
    return Costate(p, lam, inner(p, 1j * flown))


def rate(q: complex, e: complex, w: complex) -> float:
    """The size of the rate of turn that holds the circle at q on the heading e, (3)."""
    along = (e + w) / abs(e + w)
    return abs(e + w) ** 2 / (abs(q) * inner(e, along))


def violated(flight: Flight) -> float:
    """By how much the worst of the conditions of the maximum principle is violated."""
    return max(conditions(flight).values())


def conditions(flight: Flight) -> dict[str, float]:
    """By how much each condition of (4) and (5) is violated."""
    lam, sign, hamiltonian = flight.lam, 0.0, 0.0
    for leg in flight.legs:
        for _, _, psi1, _, phi in map(leg.at, leg.instants):
            sign = max(sign, -leg.u * phi if leg.u else abs(phi))
            hamiltonian = max(hamiltonian, abs(abs(phi) + psi1 - lam))
    last = flight.legs[-1]
    q, e = last.flown(last.t)
    k = -flight.side * last.u * rate(q, e, last.w)
    return {
        "multiplier": max(0.0, -lam - inner(last.p, last.w)),
        "sign": sign,
        "hamiltonian": hamiltonian,
        "transversality": abs(inner(last.p, e + last.w) + k * (lam - inner(last.p, e))),
    }


def residuals(flight: Flight, maneuver: Maneuver, others: tuple[Candidate, ...]) -> Iterator[Residual]:
    """Every condition that the maneuver has to meet; those of the adjoint only where there is something to decide."""
    yield from _arrival(flight, maneuver)
    if flight.legs:
        yield from _motions(flight)
        yield from _maximum_principle(flight)
        yield from _bellman(flight)
    unit_s = problem_of(maneuver).time_unit_s
    sooner = max((-other.later_s / unit_s for other in others), default=0.0)
    note = f"{others[0].word} {others[0].turn.value} is faster" if sooner > flight.tie else ""
    yield Residual("fastest", "T is the least of all candidates", max(0.0, sooner), flight.tie, note)


def _arrival(flight: Flight, maneuver: Maneuver) -> Iterator[Residual]:
    """The maneuver ends on the circle and along it, in the kernel's terms and in metres."""
    (q, e), end, R = flight.flown, flight.end, flight.scene.R
    yield Residual("target", "|q(T)| = R", abs(abs(q) - R), end)
    yield Residual(
        "course", "q.(e + w) = 0 at T: along the circle (1)", abs(inner(q, e + flight.w)) / abs(q), 2.0 * end
    )
    join = _placed(maneuver)
    # A heading of 360 degrees is rounded at each of three pieces, twice; positions over the ground by their size.
    start, centre = maneuver.start, maneuver.orbit
    metres = sum(map(abs, (start.east_m, start.north_m, centre.east_m, centre.north_m))) + maneuver.length_m
    speeds = maneuver.wind.speed_m_s + hypot(centre.velocity_east_m_s, centre.velocity_north_m_s)
    metres += speeds * maneuver.duration_s
    headings = 6.0 * 2.0**-52 * radians(abs(start.heading_deg) + 720.0) * (1.0 + sum(leg.t for leg in flight.legs))
    bound = end + headings + ROUNDING * metres / maneuver.aircraft.turn_radius_m
    yield Residual("join", "the last pose over the ground is where the circle is then", abs(join - q), bound)
    wrong = maneuver.orbit.turn not in (maneuver.turn, Turn.EITHER) or inner(1j * q, e + flight.w) * flight.side > 0.0
    yield Residual("turn", "the circle is held as asked for", float(wrong), 0.0)


def _placed(maneuver: Maneuver) -> complex:
    """Where the join over the ground is from the centre of the circle then, in turn radii."""
    join, circle = maneuver.join, maneuver.orbit_at_join
    return complex(join.east_m - circle.east_m, join.north_m - circle.north_m) / maneuver.aircraft.turn_radius_m


def _motions(flight: Flight) -> Iterator[Residual]:
    """The equations of motion by central differences along each piece."""
    place = turn = slope = 0.0
    for leg in flight.legs:
        for s in leg.instants:
            (q0, e0), (_, e), (q1, e1) = leg.flown(s - STEP), leg.flown(s), leg.flown(s + STEP)
            place = max(place, abs((q1 - q0) / (2.0 * STEP) - e - leg.w))
            turn = max(turn, abs((e1 - e0) / (2.0 * STEP) - 1j * leg.u * e))
            slope = max(slope, abs((leg.at(s + STEP).phi - leg.at(s - STEP).phi) / (2.0 * STEP) + leg.at(s).psi2))
    # The third derivatives are of the size of 1.
    bound = STEP * STEP / 6.0 + flight.size / STEP
    yield Residual("motion", "q' = e + w", place, bound)
    yield Residual("turning", "e' = u J e", turn, bound)
    yield Residual("slope", "f' = -p.Je", slope, bound)
    yield Residual("norm", "|p| = 1", abs(abs(flight.legs[0].p) - 1.0), ROUNDING)


def _maximum_principle(flight: Flight) -> Iterator[Residual]:
    """(4) and (5)."""
    found, choice = conditions(flight), flight.choice
    yield Residual("multiplier", "lambda + p.w >= 0 (4)", found["multiplier"], choice)
    yield Residual("sign", "u = sign f, u = 0 only where f = 0 (4)", found["sign"], choice)
    yield Residual("hamiltonian", "|f| + p.e = lambda (4)", found["hamiltonian"], 2.0 * choice)
    yield Residual("transversality", "p.(e + w) + u h k (lambda - p.e) = 0 at T (5)", found["transversality"], choice)


def _bellman(flight: Flight) -> Iterator[Residual]:
    """The gradient of T at the start is -(p, f)/(lambda + p.w), and obeys 1 + min over u of grad T . motion = 0."""
    value, bellman = "(lambda + p.w) grad T = -(p, f)", "1 + min grad T . (e + w, u) = 0"
    gradient = _gradient(flight.scene)
    if gradient is None:
        note = "T has a corner here, or bends too sharply"
        yield Residual("gradient", value, None, None, note)
        yield Residual("bellman", bellman, None, None, note)
        return
    (east, north, turned), off = gradient
    start = flight.legs[0]
    c = flight.lam + inner(start.p, start.w)
    apart = hypot(c * east + start.p.real, c * north + start.p.imag, c * turned + start.phi)
    yield Residual("gradient", value, apart, abs(c) * off + flight.choice)
    motion = inner(complex(east, north), start.e + start.w)
    yield Residual("bellman", bellman, abs(1.0 + motion - abs(turned)), 4.0 * off)


class Gradient(NamedTuple):
    """The gradient of T by position and heading."""

    east: float
    north: float
    heading: float


class GradientEstimate(NamedTuple):
    """A gradient of T by difference quotients, and its accuracy."""

    gradient: Gradient
    bound: float


def _gradient(scene: WindProblem) -> GradientEstimate | None:
    """The gradient of the kernel's T by position and heading, and its accuracy; None where quotients do not settle.

    As `bellman`: quotients at two steps differ by their truncation, those to either side by h T'' or by a corner.
    """
    best: GradientEstimate | None = None
    coarse: Gradient | None = None
    T = _least_time(scene)
    for h in QUOTIENT_STEPS:
        sides = [(_least_time(_moved(scene, axis, h)), _least_time(_moved(scene, axis, -h))) for axis in range(3)]
        fine = Gradient(*((after - before) / (2.0 * h) for after, before in sides))
        bend = hypot(*(after - 2.0 * T + before for after, before in sides)) / h
        if coarse is not None:
            rounded = 2.0 * wind_search.TIE_TOLERANCE * (1.0 + scene.R + T) / h
            off = hypot(*(a - b for a, b in zip(fine, coarse, strict=True))) + bend + rounded
            best = GradientEstimate(fine, off) if best is None or off < best.bound else best
        coarse = fine
    return best if best is not None and best.bound <= RESOLVED * hypot(*best.gradient) else None


def _moved(scene: WindProblem, axis: int, h: float) -> WindProblem:
    """The scene with its start moved east or north, or its heading turned to the left."""
    if axis == 2:
        e = complex(scene.c, scene.s) * exp(1j * h)
        return scene._replace(c=e.real, s=e.imag)
    return scene._replace(x=scene.x + h * (axis == 0), y=scene.y + h * (axis == 1))


def _least_time(scene: WindProblem) -> float:
    return wind_search.time_of(wind_search.fastest(scene))
