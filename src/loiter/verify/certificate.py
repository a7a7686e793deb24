"""A maneuver with its proof: the maximum principle (11)-(18) equation by equation, and the extremals it was among.

Why this proves: a fastest maneuver exists (Filippov, paper section 1), obeys the maximum principle, and all maneuvers
that do are the candidates (docs/theory.md, section 3). A certificate shows that this one is an extremal, with lambda
and psi to check it by, and that no candidate is faster. The Hamilton-Jacobi-Bellman equation looks at its neighbours.

Residuals are in turn radii and turn radii over airspeed, psi is of length 1. Each is the largest value over the
maneuver, checked at `SAMPLES` instants of each piece and wherever psi1 and phi are extreme. Four accuracies bound
them:

- `end`: how far the plan may end from the target, the tolerance or rounding (`synthesis.rounding`); a flow is a motion
  of the plane, so no state on the way is further off, and phi = psi x state is as accurate, |psi| being 1;
- `rounding`: that of a length in this scene, 64 units of 2^-52 times its size, some 20 operations for each piece;
- `angle`: psi at the first of two switches has turned with a middle arc whose angle is an accuracy of `end` over that
  arc's radius;
- `choice`: next to where two extremals tie smoothly, rounding of T may choose the slower. Its phi is of the wrong sign
  by up to v somewhere, and it loses some 2/lambda times the integral of that. A v in the middle of a piece lasts
  2 sqrt(2 v) at least, since |phi''| = |psi1| <= 1, and costs 3.7 v^(3/2); at the start, where a first piece is
  missing, it lasts v at least, since |phi'| <= 1, and costs v^2. So v is below rounding^(2/3), and below rounding^(1/2)
  where another candidate ties or the start counts as on a single arc.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import asdict, dataclass
from itertools import pairwise
from math import atan2, hypot, inf, isfinite, pi, radians, sqrt
from typing import NamedTuple

from loiter.errors import InvalidArgument
from loiter.kernel.adjoint import adjoint, switching_function, turned
from loiter.kernel.codes import Side, Word
from loiter.kernel.extremals import onto_axis
from loiter.kernel.motion import flow
from loiter.kernel.synthesis import ROUNDING, Flown, duration, optimum, rounding
from loiter.planning.model import CONTROLS, Maneuver, Turn
from loiter.planning.scaling import SIDES, Scene, normalised
from loiter.planning.solve import candidates

# Between two of them psi1 and phi are monotone once their extremes are added, so few will do.
SAMPLES = 9

# Steps of central differences of functions known to their last digits, whose third derivative is of the size of the
# function: truncation step^2/6 and rounding ROUNDING/step, 1e-9 and 4e-10 of the size, nearly balance.
STEP = 2.0**-15

# Steps of the quotients of T, each half the one before: from a sixteenth of a turn radius, over which few T are
# straight, to where rounding, 64 units of 2^-52 over the step, is all that `RESOLVED` leaves.
QUOTIENT_STEPS = tuple(2.0**-k for k in range(4, 34))

# A quotient of T that does not settle to this share of |grad T| proves nothing.
RESOLVED = 1e-3


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
class Switch:
    """An instant of switching: when (seconds), from and to which letter, the reduced state there (2), and psi."""

    time_s: float
    letters: str
    x: float
    y: float
    psi1: float
    psi2: float


@dataclass(frozen=True, slots=True)
class Candidate:
    """Another extremal for the same start: how much later (seconds) it joins; negative where it is sooner."""

    word: str
    turn: Turn
    duration_s: float
    later_s: float


class Instant(NamedTuple):
    """The proof at one instant: seconds from the start, control u, switching function phi, adjoint psi."""

    time_s: float
    u: int
    phi: float
    psi1: float
    psi2: float


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


class Piece(NamedTuple):
    """A piece as flown: control, duration, and state and adjoint at its start."""

    u: int
    t: float
    x: float
    y: float
    psi1: float
    psi2: float

    def at(self, s: float) -> tuple[float, float, float, float, float]:
        """x, y, psi1, psi2, phi after a time s of this piece."""
        x, y = flow(self.x, self.y, self.u, s)
        psi1, psi2 = turned(self.psi1, self.psi2, self.u, s)
        return x, y, psi1, psi2, switching_function(x, y, psi1, psi2)

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
    """A maneuver in the kernel's terms, with its proof."""

    scene: Scene
    side: int
    word: int
    lam: float
    pieces: list[Piece]
    accuracy: Accuracy

    @property
    def end(self) -> tuple[float, float, float, float, float]:
        """x, y, psi1, psi2, phi at the end."""
        return self.pieces[-1].at(self.pieces[-1].t)

    @property
    def opposed(self) -> list[Piece]:
        """The arcs that begin with a switch between L and R."""
        return [after for before, after in pairwise(self.pieces) if before.u * after.u < 0]


@dataclass(frozen=True)
class Certificate:
    """The proof that a maneuver is optimal, or what speaks against it. `certify` makes it.

    `lam` is the multiplier lambda and `psi` the adjoint at the start, None for a start on the circle, which has nothing
    to decide; `choice` says whether psi is unique. `others` are the candidates it was compared with, soonest first.
    """

    maneuver: Maneuver
    lam: float | None
    psi: tuple[float, float] | None
    choice: str
    switches: tuple[Switch, ...]
    residuals: tuple[Residual, ...]
    others: tuple[Candidate, ...]
    pieces: tuple[Piece, ...]
    tie_s: float

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
        """The fastest candidate that is slower; None where there is none, or where another is faster than this."""
        if self.others and self.others[0].later_s < -self.tie_s:
            return None
        return next((other for other in self.others if other.later_s > self.tie_s), None)

    @property
    def margin_s(self) -> float | None:
        """By how much the runner-up is slower, seconds."""
        return None if self.runner_up is None else self.runner_up.later_s

    def residual(self, name: str) -> Residual:
        """The residual of a name; raises `InvalidArgument` where this maneuver has no such condition."""
        for residual in self.residuals:
            if residual.name == name:
                return residual
        known = ", ".join(residual.name for residual in self.residuals)
        raise InvalidArgument("residual", f"is {name!r}: this certificate has {known}")

    def history(self, steps: int = 100) -> Iterator[list[Instant]]:
        """The proof over time, piece by piece, each at `steps` + 1 instants from its start to its end."""
        unit_s = self.maneuver.aircraft.turn_radius_m / self.maneuver.aircraft.airspeed_m_s
        began = 0.0
        for piece in self.pieces:
            yield [
                Instant((began + s) * unit_s, piece.u, phi, psi1, psi2)
                for s in (piece.t * i / steps for i in range(steps + 1))
                for _, _, psi1, psi2, phi in [piece.at(s)]
            ]
            began += piece.t

    def to_dict(self) -> dict[str, object]:
        """Plain values, for JSON: no nan, no infinity."""
        return {
            "valid": self.valid,
            "word": self.maneuver.word,
            "turn": self.maneuver.turn.value,
            "duration_s": self.maneuver.duration_s,
            "lambda": self.lam,
            "psi": self.psi,
            "choice": self.choice,
            "switches": [asdict(switch) for switch in self.switches],
            "residuals": [_plain(residual) for residual in self.residuals],
            "candidates": [asdict(other) | {"turn": other.turn.value} for other in self.others],
            "runner_up": None if self.runner_up is None else self.runner_up.word,
            "margin_s": self.margin_s,
        }

    def __str__(self) -> str:
        return "\n".join([*_head(self), *_table(self.residuals), _comparison(self)])


def certify(maneuver: Maneuver, *, tolerance_m: float = 0.0) -> Certificate:
    """The certificate of a maneuver, optimal or not; `tolerance_m` (metres) is that with which it was planned.

    Everything is worked out anew from the start, the letters and the durations. Raises `InvalidArgument` for letters
    that are no word of at most three pieces, durations that are negative or not finite, or a turn that is neither cw
    nor ccw, else as `plan`.

    >>> pose, orbit = loiter.Pose(-400.0, 120.0, 90.0), loiter.Orbit(0.0, 0.0, 80.0)
    >>> c = certify(loiter.plan(pose, orbit, loiter.Aircraft(18.0, max_bank_deg=35.0)))
    >>> c.valid, c.lam, c.runner_up.word, round(c.margin_s, 2)
    (True, 1.0, 'LSL', 16.45)
    """
    others = _others(maneuver, tolerance_m)
    flight = _flight(maneuver, tolerance_m, others)
    unit_s = maneuver.aircraft.turn_radius_m / maneuver.aircraft.airspeed_m_s
    certain = bool(flight.pieces)
    psi = (flight.pieces[0].psi1, flight.pieces[0].psi2) if certain else None
    return Certificate(
        maneuver,
        flight.lam if certain else None,
        psi,
        _choice(flight, maneuver.word),
        _switches(flight, unit_s),
        tuple(_residuals(flight, maneuver, tolerance_m, others)),
        others,
        tuple(flight.pieces),
        flight.accuracy.tie * unit_s,
    )


# The maneuver in the kernel's terms


def _flight(maneuver: Maneuver, tolerance_m: float, others: tuple[Candidate, ...]) -> Flight:
    """The maneuver from its start, its letters and its durations alone."""
    scene = normalised(maneuver.start, maneuver.orbit, maneuver.aircraft, tolerance_m)
    if maneuver.turn not in (Turn.CW, Turn.CCW):
        raise InvalidArgument("maneuver", f"holds the circle {str(maneuver.turn)!r}: it must be cw or ccw")
    word, durations = _word(maneuver), _durations(maneuver)
    x, y, R = scene.x, scene.y, scene.R
    side, size = int(SIDES[maneuver.turn]), rounding(x, y, R)
    lam, pieces = _pieces(x, y, R, side, word, durations)
    if len(pieces) == 2 and pieces[0].u * pieces[1].u < 0:
        word, lam, pieces = _one_arc(x, y, R, side, word, durations, size) or (word, lam, pieces)
    accuracy = _accuracy(scene, size, pieces)
    tie_s = accuracy.tie * maneuver.aircraft.turn_radius_m / maneuver.aircraft.airspeed_m_s
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
    (first, last), u = durations, (word & 3) - 2
    lam, late = _pieces(*flow(x, y, u, first), R, side, word >> 2, [last])
    if (abs(late[0].at(0.0)[4]) + first) * first <= lam * size:
        return word >> 2, lam, late
    end_x, end_y = flow(x, y, u, first + last)
    if hypot(end_x, end_y - side * R) <= size:
        return word & 3, *_pieces(x, y, R, side, word & 3, [first + last])
    return None


def _accuracy(scene: Scene, size: float, pieces: list[Piece]) -> Accuracy:
    # Durations went through metres and seconds and back, 4 roundings, so a flight of them ends a rounding further off.
    end = max(scene.tolerance, size) + size
    middle = pieces[1].radius if len(pieces) == 3 and pieces[1].u else 1.0
    return Accuracy(end, size, end * (1.0 + 1.0 / max(middle, size)), size ** (2.0 / 3.0))


def _word(maneuver: Maneuver) -> int:
    if not maneuver.segments:
        return int(Word.EMPTY)
    if maneuver.word not in Word.__members__ or maneuver.word == Word.EMPTY.name:
        known = ", ".join(word.letters for word in Word if word)
        raise InvalidArgument("maneuver", f"has the word {maneuver.word!r}: it must be one of {known}")
    return int(Word[maneuver.word])


def _durations(maneuver: Maneuver) -> list[float]:
    """Durations in turn radii over airspeed."""
    seconds = [segment.duration_s for segment in maneuver.segments]
    if not all(isfinite(t) and t >= 0.0 for t in seconds):
        raise InvalidArgument("maneuver", f"has durations {seconds}: they must be zero or positive, finite seconds")
    return [t * maneuver.aircraft.airspeed_m_s / maneuver.aircraft.turn_radius_m for t in seconds]


def _pieces(x: float, y: float, R: float, side: int, word: int, durations: list[float]) -> tuple[float, list[Piece]]:
    """The multiplier lambda and the pieces of a word flown from (x, y), with psi."""
    pieces = []
    t1, t2, t3 = [*durations, 0.0, 0.0, 0.0][:3]
    lam, psi1, psi2 = adjoint(x, y, R, side, word, t1, t2, t3)
    for letter, t in zip(Word(word).letters, durations, strict=True):
        pieces.append(Piece(CONTROLS[letter], t, x, y, psi1, psi2))
        x, y, psi1, psi2, _ = pieces[-1].at(t)
    return lam, pieces


def _switches(flight: Flight, unit_s: float) -> tuple[Switch, ...]:
    times = [sum(piece.t for piece in flight.pieces[:i]) * unit_s for i in range(1, len(flight.pieces))]
    return tuple(
        Switch(time, Word(flight.word).letters[i : i + 2], *piece[2:])
        for i, (time, piece) in enumerate(zip(times, flight.pieces[1:], strict=True))
    )


def _others(maneuver: Maneuver, tolerance_m: float) -> tuple[Candidate, ...]:
    """Every candidate but the maneuver itself."""
    found = candidates(maneuver.start, maneuver.orbit, maneuver.aircraft, tolerance_m=tolerance_m)
    return tuple(
        Candidate(other.word, other.turn, other.duration_s, other.duration_s - maneuver.duration_s)
        for other in found
        if (other.turn, other.segments) != (maneuver.turn, maneuver.segments)
    )


def _choice(flight: Flight, letters: str) -> str:
    if not flight.pieces:
        return "the start is on the circle: there is nothing to decide, and the target is all there is to check"
    if len(flight.pieces) > 1:
        return "psi is unique: phi = 0 at a switch fixes it"
    arc = "a single arc" if len(letters) == 1 else "a single arc (the other is there by rounding alone)"
    if flight.lam == 1.0:
        return f"{arc} has many psi: this is that of a straight entry that ends in it, (1, 0) on the axis"
    return f"{arc} has many psi: this is that of a switch at its start, parallel to the state there"


# The conditions


def _residuals(
    flight: Flight, maneuver: Maneuver, tolerance_m: float, others: tuple[Candidate, ...]
) -> Iterator[Residual]:
    yield from _arrival(flight, maneuver, tolerance_m)
    if flight.pieces:
        yield from _motions(flight)
        yield from _maximum_principle(flight)
        yield from _switching(flight)
        yield from _either(flight)
        yield from _bellman(flight)
    yield _fastest(flight, maneuver, others)


def _arrival(flight: Flight, maneuver: Maneuver, tolerance_m: float) -> Iterator[Residual]:
    """The maneuver ends on the circle, in the kernel's terms and in metres."""
    scene, (end, size, *_) = flight.scene, flight.accuracy
    x, y = flight.end[:2] if flight.pieces else (scene.x, scene.y)
    yield Residual("target", "x(T) = 0, y(T) = R or -R (8)-(10)", hypot(x, y - flight.side * scene.R), end)
    join = normalised(maneuver.join, maneuver.orbit, maneuver.aircraft, tolerance_m)
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
    lam, (end, size, angle, choice) = flight.lam, flight.accuracy
    sign = hamiltonian = above = 0.0
    for piece in flight.pieces:
        for _, _, psi1, _, phi in map(piece.at, piece.instants):
            # The control +1 or -1 asks for phi of its sign or 0, the control 0 for phi = 0.
            sign = max(sign, -piece.u * phi if piece.u else abs(phi))
            hamiltonian = max(hamiltonian, abs(abs(phi) + psi1 - lam))
            above = max(above, psi1 - lam)
    start, last = flight.pieces[0], flight.pieces[-1].u * flight.side * flight.scene.R
    transversality = abs(flight.end[2] * (1.0 + last) - lam)
    # The last switch is found from the target and off by rounding alone; a single arc may begin beside its circle.
    off = end * (1.0 + (1.0 + flight.scene.R) / max(hypot(start.x, start.y), size)) if len(flight.pieces) == 1 else size
    yield Residual("multiplier", "lambda >= 0", max(0.0, -lam), angle)
    yield Residual("sign", "u = sign phi, u = 0 only where phi = 0 (13)", sign, angle + choice)
    yield Residual("hamiltonian", "|phi| + psi1 = lambda (14)", hamiltonian, angle + 2.0 * choice)
    yield Residual("psi1", "psi1 <= lambda (16)", above, angle + choice)
    yield Residual("transversality", "psi1(T) (1 + u side R) = lambda", transversality, off)


def _switching(flight: Flight) -> Iterator[Residual]:
    """What follows for the pieces: (19), equal arcs, the line through the centre."""
    lam, (end, _, angle, _), opposed = flight.lam, flight.accuracy, flight.opposed
    if opposed:
        off = max(hypot(piece.at(0.0)[4], piece.psi1 - lam) for piece in opposed)
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
    ends = sorted(onto_axis(piece.x, piece.u * piece.y, end, 0.0)[0] for end in (-1.0, 1.0))
    bounds = [0.0, *(s for s in ends if s < piece.t), piece.t]
    heights = [abs(piece.at(0.5 * (a + b))[1]) for a, b in pairwise(bounds)]
    for s, (before, after) in zip(bounds[1:], pairwise(heights), strict=False):
        yield abs(piece.at(s)[3]) * min(before, after)


def _fastest(flight: Flight, maneuver: Maneuver, others: tuple[Candidate, ...]) -> Residual:
    """No candidate is faster: what makes an extremal an optimum."""
    unit_s = maneuver.aircraft.turn_radius_m / maneuver.aircraft.airspeed_m_s
    sooner = max((-other.later_s / unit_s for other in others), default=0.0)
    note = f"{others[0].word} {others[0].turn.value} is faster" if sooner > flight.accuracy.tie else ""
    return Residual("fastest", "T is the least of all candidates", max(0.0, sooner), flight.accuracy.tie, note)


# The Hamilton-Jacobi-Bellman equation


class Gradient(NamedTuple):
    """The gradient of T by finite differences, and its accuracy."""

    x: float
    y: float
    bound: float


def _bellman(flight: Flight) -> Iterator[Residual]:
    """The gradient of T at the start is -psi/lambda, and obeys 1 + min over u of grad T . f = 0."""
    value, bellman = "lambda grad T = -psi", "1 + min grad T . f = 0"
    x, y = flight.end[:2]
    if 2.0 * flight.accuracy.rounding < hypot(x, y - flight.side * flight.scene.R) <= flight.accuracy.end:
        gradient: Gradient | str = "the tolerance lets the start count as on the last arc, which T knows nothing of"
    else:
        gradient = _gradient(flight.scene, _steps(flight))
    if isinstance(gradient, str):
        yield Residual("gradient", value, None, None, gradient)
        yield Residual("bellman", bellman, None, None, gradient)
        return
    start, lam = flight.pieces[0], flight.lam
    off = hypot(lam * gradient.x + start.psi1, lam * gradient.y + start.psi2)
    yield Residual("gradient", value, off, abs(lam) * gradient.bound + _direction(flight))
    phi = switching_function(start.x, start.y, gradient.x, gradient.y)
    bound = gradient.bound * (1.0 + hypot(start.x, start.y))
    yield Residual("bellman", bellman, abs(1.0 + gradient.x - abs(phi)), bound)


def _direction(flight: Flight) -> float:
    """The accuracy of the direction of psi.

    The last switch is where two circles about (0, 1) and (0, -1) of radii r1, r2 cross, under the angle whose sine is
    2 |x|/(r1 r2): an error `end` of one radius moves it by end r1 r2/(2 |x|), but no more than to where they touch, by
    the root of end r1 r2. Seen from the centre, at a distance r, that turns psi.
    """
    end, size, angle, _ = flight.accuracy
    if not flight.opposed:
        return angle
    x, y = flight.opposed[-1][2:4]
    radii = hypot(x, y + 1.0) * hypot(x, y - 1.0)
    moved = min(end * radii / max(2.0 * abs(x), size), sqrt(end * radii))
    return angle + moved / max(hypot(x, y), size)


def _steps(flight: Flight) -> list[float]:
    """Steps that are small beside the distance from the centre of the state that psi is parallel to.

    Over a distance like that the direction of psi turns by a radian, which wider quotients would average.
    """
    parallel = flight.opposed[-1] if flight.opposed else flight.pieces[0] if len(flight.pieces) == 1 else None
    widest = inf if parallel is None else 0.25 * hypot(parallel.x, parallel.y)
    return [h for h in QUOTIENT_STEPS if h <= widest]


def _gradient(scene: Scene, steps: list[float]) -> Gradient | str:
    """The gradient of the kernel's T by central differences at the step of the least bound; why not, where none does.

    Quotients D(h) and D(h/2) of a smooth T differ by three times the truncation of the second, and rounding of T adds
    2 rounding/h. Quotients to the left and to the right differ by h T'' or, at a corner, by all of it.
    """
    best: Gradient | None = None
    coarse: tuple[float, float] | None = None
    for h in steps:
        rounded = 2.0 * rounding(scene.x, scene.y, scene.R) / h
        if best is not None and rounded > best.bound:
            break
        gx, gy, apart = _quotients(scene, h)
        if coarse is not None:
            bound = hypot(gx - coarse[0], gy - coarse[1]) + apart + rounded
            best = min(best or Gradient(gx, gy, bound), Gradient(gx, gy, bound), key=lambda gradient: gradient.bound)
        coarse = gx, gy
    if best is not None and best.bound <= RESOLVED * hypot(best.x, best.y):
        return best
    words = dict.fromkeys(
        f"{Word(w).letters} {Side(s).name.lower()}" for s, w, *_ in _around(scene, QUOTIENT_STEPS[-1])
    )
    return f"T has a corner or a jump here, or bends too sharply: {', '.join(words)}"


def _around(scene: Scene, h: float) -> list[Flown]:
    """The fastest from the state and from its neighbours east, west, north and south."""
    x, y, R, side, tolerance = scene
    places = ((0.0, 0.0), (h, 0.0), (-h, 0.0), (0.0, h), (0.0, -h))
    return [optimum(x + dx, y + dy, R, side, tolerance) for dx, dy in places]


def _quotients(scene: Scene, h: float) -> tuple[float, float, float]:
    """Central difference quotients of T, and how far the one-sided ones are apart."""
    T, *others = map(duration, _around(scene, h))
    east, west, north, south = (other - T for other in others)
    return (east - west) / (2.0 * h), (north - south) / (2.0 * h), hypot(east + west, north + south) / h


# Text


def _plain(residual: Residual) -> dict[str, object]:
    """A residual for JSON, where a value that is not finite has no place."""
    value = residual.value if residual.value is not None and isfinite(residual.value) else None
    return asdict(residual) | {"value": value, "verdict": residual.verdict}


def _head(certificate: Certificate) -> list[str]:
    maneuver = certificate.maneuver
    verdict = "valid" if certificate.valid else f"NOT VALID, {len(certificate.failed)} conditions FAILED"
    lines = [f"Certificate of {maneuver.word or 'a start on the circle'}, {maneuver.turn.described}: {verdict}."]
    if certificate.lam is not None and certificate.psi is not None:
        psi1, psi2 = certificate.psi
        lines.append(f"lambda = {certificate.lam:.6f}, psi = ({psi1:.6f}, {psi2:.6f}) at the start.")
    lines.append(certificate.choice[0].upper() + certificate.choice[1:] + ".")
    lines += [
        f"{s.letters} at {s.time_s:.6g} s: (x, y) = ({s.x:.6f}, {s.y:.6f}), psi = ({s.psi1:.6f}, {s.psi2:.6f})."
        for s in certificate.switches
    ]
    return lines


def _table(residuals: tuple[Residual, ...]) -> Iterator[str]:
    wide = max(len(residual.equation) for residual in residuals)
    yield f"{'condition':<14}  {'equation':<{wide}}  {'off by':>7}  {'bound':>7}"
    for r in residuals:
        figures = "" if r.value is None or r.bound is None else f"{r.value:7.1e}  {r.bound:7.1e}  "
        note = f" ({r.note})" if r.note else ""
        yield f"{r.name:<14}  {r.equation:<{wide}}  {figures}{r.verdict}{note}"


def _comparison(certificate: Certificate) -> str:
    count, runner_up = len(certificate.others), certificate.runner_up
    ties = ", ".join(f"{tie.word} {tie.turn.value}" for tie in certificate.ties)
    text = f"Compared with {count} other {'extremal' if count == 1 else 'extremals'}"
    text += f"; as fast: {ties}" if ties else ""
    if runner_up is None:
        return text + "."
    return f"{text}; the runner-up {runner_up.word} {runner_up.turn.value} takes {runner_up.later_s:.3g} s more."
