"""Theorem 2 of proof.md, from extremals to the maneuver that is returned: `words` and `synthesis`.

Words and sides are finitely many, and all are tried. Numbers are variables, for every combination of the signs by which
a function may decide. Functions that have been checked are replaced by stand-ins that check their arguments.
"""

from __future__ import annotations

import math
import operator
from collections.abc import Callable, Iterator, Sequence
from fractions import Fraction
from itertools import product
from typing import Any, NamedTuple, NoReturn, Self

import flint

from evidence.proof.algebra import Field
from evidence.proof.answers.turns import StandIn, is_same
from evidence.proof.balls import Certainty
from evidence.proof.identities import require, variables, zero
from evidence.proof.selection.signs import Quantity, Signs, Table, every_case
from evidence.proof.sign_proofs import NEGATIVE, NEVER_NEGATIVE, POSITIVE, ZERO, NotProved
from loiter.kernel import entry as entries
from loiter.kernel import motion, rounding, words
from loiter.kernel.rebinding import rebinding
from loiter.kernel.statuses import Status
from loiter.kernel.still_air import extremals as kernel
from loiter.kernel.still_air import synthesis
from loiter.kernel.words import ABSENT, Side, Word

LETTERS = {"L": 1, "S": 0, "R": -1}
NAMES = ("", "R", "L", "SR", "SL", "RL", "LR", "RSR", "RSL", "LSR", "LSL", "RLR", "LRL")


def controls_of(name: str) -> tuple[int, ...]:
    """The controls of a word, from its letters."""
    return tuple(LETTERS[letter] for letter in name)


def padded(controls: Sequence[int]) -> tuple[int, ...]:
    """Three controls, `ABSENT` past the last."""
    return (*controls, *[ABSENT] * (3 - len(controls)))


def every_word() -> list[tuple[int, ...]]:
    """The controls of all words of up to three pieces."""
    return [controls for length in range(4) for controls in product((-1, 0, 1), repeat=length)]


def all_words() -> Certainty:
    """Words are encoded and decoded without loss; `rest`, `mirrored` and the names are those of the controls."""
    require(ABSENT not in (-1, 0, 1), "an absent piece has a control")
    codes = {controls: words.encode(*controls) for controls in every_word()[1:]} | {(): int(Word.EMPTY)}
    require(len(set(codes.values())) == len(codes), "two words have the same code")
    for controls, code in codes.items():
        require(0 <= code < 64, f"the code of {controls} has more than three digits")
        require(words.controls(code) == padded(controls), f"{controls} is not decoded")
        require(words.rest(code) == codes[controls[1:]], f"`rest` of {controls}")
        require(words.mirrored(code) == codes[tuple(-u for u in controls)], f"`mirrored` of {controls}")
    require({word.letters for word in Word} == set(NAMES), "the words are not those of the text")
    for word in Word:
        require(int(word) == codes[controls_of(word.letters)], f"the name of {word.letters}")
    require((Side.CW, Side.CCW, Side.EITHER) == (1, -1, 0), "a side is not the sign of the target's ordinate")
    return Certainty(len(codes) + len(Word), 0)


# The list of all extremals


def all_extremals() -> Certainty:
    """`extremals` has each of the nine words, RL and LR with both crossings, once; the order decides ties."""
    numbers, start = tuple(object() for _ in range(4)), object()
    found = rebinding({"start_at": StandIn("start_at", numbers, start), **labels(start)})(kernel.extremals)(*numbers)
    singles = [(name, 0.0) for name in ("l", "r", "lsl", "rsl", "lsr", "rsr")]
    crossings = [(name, branch) for name in ("rl", "lr") for branch in (-1.0, 1.0)]
    expected = [*singles, *crossings, ("lrl", 0.0)]
    require(found == expected, "`extremals` leaves out a word, has another one, or has them in another order")
    return Certainty(len(expected), 0)


def labels(start: object) -> dict[str, object]:
    """Stand-ins for the words: each returns its name and crossing, and must get the start."""

    def label(name: str) -> Callable[..., tuple[str, float]]:
        def labelled(given: object, branch: float = 0.0) -> tuple[str, float]:
            require(given is start, f"`{name}` gets another start")
            return name, branch

        return labelled

    return {name: label(name) for name in ("l", "r", "lsl", "rsl", "lsr", "rsr", "rl", "lr", "lrl")}


# The maneuver as flown


class Lengths(NamedTuple):
    """The durations of three pieces, and the tolerances up to which a straight piece and an arc are left out."""

    t1: Any
    t2: Any
    t3: Any
    short: Any
    no_angle: Any


def check_dropping() -> int:
    """`drop_short_pieces` leaves out what is short, joins equal arcs, and keeps all other pieces in their order."""
    context = flint.fmpq_mpoly_ctx.get(Lengths._fields, "lex")
    t1, t2, t3, short, no_angle = context.gens()
    compared = {
        "t2 - short": t2 - short,
        "t1 - no_angle": t1 - no_angle,
        "t2 - no_angle": t2 - no_angle,
        "t3 - no_angle": t3 - no_angle,
        "t1 + t3 - no_angle": t1 + t3 - no_angle,
        "no_angle": no_angle,
        "short": short,
    }
    signs = Signs(Table(compared, ranges={"no_angle": (1,), "short": (1,)}))
    values = Lengths(*(Quantity(signs, variable) for variable in context.gens()))
    cases = 0
    for controls in every_word():
        # A piece that is absent has no duration.
        given = [t if k < len(controls) else 0.0 for k, t in enumerate(values[:3])]

        def run(controls: tuple[int, ...] = controls, given: list[Any] = given) -> None:
            code = words.encode(*padded(controls))
            t1, t2, t3 = given
            word, *found = entries.drop_short_pieces(code, t1, t2, t3, values.short, values.no_angle)
            pieces = left_after(list(zip(controls, given, strict=False)), values)
            require(words.controls(word) == padded([u for u, _ in pieces]), f"the word that is flown of {controls}")
            expected = [t for _, t in pieces] + [0.0] * (3 - len(pieces))
            same = all(polynomial_of(a, signs) == polynomial_of(b, signs) for a, b in zip(found, expected, strict=True))
            require(same, f"the durations that are flown of {controls}")

        cases += every_case(signs, run)
    return cases


def polynomial_of(value: Any, signs: Signs) -> Any:
    """The polynomial of a quantity or a number."""
    if isinstance(value, Quantity):
        return value.polynomial
    exact = Fraction(value)
    return next(iter(signs.table.deciding.values())) * 0 + flint.fmpq(exact.numerator, exact.denominator)


def left_after(pieces: list[tuple[int, Any]], lengths: Lengths) -> list[tuple[int, Any]]:
    """The pieces that are flown, as proof.md, section 7, says."""
    if len(pieces) == 3 and pieces[1][1] <= lengths.short:
        (u, t), _, (v, last) = pieces
        pieces = [(u, t + last)] if u == v else [(u, t), (v, last)]
    if len(pieces) == 2 and pieces[1][1] <= lengths.no_angle:
        pieces = pieces[:1]
    return pieces[1:] if pieces and pieces[0][1] <= lengths.no_angle else pieces


def flown_entries() -> Certainty:
    """From an extremal to the maneuver that is flown."""
    return Certainty(check_dropping() + flown_as(), 0)


def flown_as() -> int:
    """`flown_entry` drops pieces up to a third of the tolerances, and mirrors the word for the other side."""
    length_tolerance, field = variables("length_tolerance")
    durations = tuple(field.constant(k) for k in (2, 3, 5))
    extremal = kernel.Extremal(int(Word.LSR), (0.0, 1.0), 0.0, (0.0, 1.0), (0.0, 1.0))
    left = (int(Word.LSL), *(field.constant(k) for k in (7, 11, 13)))
    for side in (-1, 1):
        arguments = (int(Word.LSR), *durations, length_tolerance / 3.0, rounding.ROUNDING / 3.0)
        names = {
            "durations": StandIn("durations", (extremal,), durations),
            "drop_short_pieces": StandIn("drop_short_pieces", arguments, left),
        }
        found = rebinding(names)(synthesis.flown_entry)(extremal, length_tolerance, side)
        word = Word.LSL if side > 0 else Word.RSR
        require(is_same(tuple(found), (side, int(word), *left[1:])), "`flown_entry` returns another maneuver")
    return 2


# Sides, tolerances, and the optimum


def sides() -> int:
    """The side that is flown: that of the start for *either*, clockwise on the axis."""
    cases = 0
    for sign, near in ((NEGATIVE, -1), (ZERO, 1), (POSITIVE, 1)):
        y, field = variables("y")
        field.assume(y, sign)
        copied = rebinding(field.names())
        require(copied(synthesis.near_side)(y) == near, "`near_side` is not the side of the start")
        for side in (-1, 0, 1):
            require(copied(synthesis.side_or_near)(y, side) == (side or near), "`side_or_near` is another side")
            cases += 1
    return cases


class Arguments(NamedTuple):
    """A state, a radius and a tolerance: variables, or 0 for no tolerance."""

    x: Any
    y: Any
    R: Any
    tolerance: Any


def scenes() -> Iterator[tuple[Field, Arguments]]:
    """Without a tolerance, and with one."""
    for known in (ZERO, POSITIVE):
        x, y, R, tolerance, field = variables("x y R tolerance")
        if known == POSITIVE:
            field.assume(tolerance, POSITIVE)
        yield field, Arguments(x, y, R, tolerance if known == POSITIVE else field.constant(0.0))


def on_one_side() -> int:
    """`optimum_on_side` and `least_time` solve the mirror image for the other side; the number of cases."""
    cases = 0
    for (field, a), side in product(scenes(), (-1, 1)):
        without = a.tolerance.is_zero
        arc_tolerance, length_tolerance, time, best, entry = (object() for _ in range(5))
        names = field.names() | {
            "arc_tolerance_of": StandIn("arc_tolerance_of", a, arc_tolerance),
            "rounding": StandIn("rounding", a[:3], length_tolerance),
            "fastest": StandIn("fastest", (a.x, side * a.y, a.R, arc_tolerance, without), (time, best)),
            "flown_entry": StandIn("flown_entry", (best, length_tolerance, side), entry),
        }
        copied = rebinding(names)
        require(copied(synthesis.optimum_on_side)(a.x, a.y, a.R, side, a.tolerance) is entry, "another optimum")
        require(copied(synthesis.least_time)(a.x, a.y, a.R, side, a.tolerance) is time, "another least time")
        cases += 2
    return cases


def on_either_side() -> int:
    """`optimum` takes the near side, or the far one where a tolerance makes that faster; the number of cases."""
    cases = 0
    for (field, a), side, sign, faster in product(scenes(), (-1, 0, 1), (NEGATIVE, NEVER_NEGATIVE), (False, True)):
        y, field = variables("y")
        field.assume(y, sign)
        near = -1 if sign == NEGATIVE else 1
        a = a._replace(y=y)
        entries = {-1: object(), 1: object()}

        def solved(x: Any, y: Any, R: Any, s: int, tolerance: Any, a: Arguments = a, entries: Any = entries) -> object:
            same = x is a.x and y is a.y and R is a.R and tolerance is a.tolerance
            require(same, "`optimum_on_side` gets another state")
            return entries[s]

        length_tolerance = object()
        asked = (entries[-near], entries[near], length_tolerance)
        names = field.names() | {
            "optimum_on_side": solved,
            "rounding": StandIn("rounding", (a.x, a.y, a.R), length_tolerance),
            "is_faster": StandIn("is_faster", asked, faster),
        }
        found = rebinding(names)(synthesis.optimum)(a.x, a.y, a.R, side, a.tolerance)
        takes_far = side == 0 and not a.tolerance.is_zero and faster
        require(found is entries[-near if takes_far else side or near], "`optimum` takes another side")
        cases += 1
    return cases


def taking_the_faster_side() -> int:
    """`is_faster` compares durations, less the tolerance; `duration` adds up the pieces; the number of cases."""
    t1, t2, t3, _ = variables("t1 t2 t3")
    total = entries.duration(entries.Entry(1, 0, t1, t2, t3))
    zero("`duration`", total - (t1 + t2 + t3))
    for sign in (NEGATIVE, NEVER_NEGATIVE):
        t, other, tolerance, field = variables("t other tolerance")
        field.assume(t - other + tolerance, sign)
        compared = rebinding(field.names() | {"duration": lambda time: time})(entries.is_faster)
        require(compared(t, other, tolerance) == (sign == NEGATIVE), "`is_faster` is not about the durations")
    return 3


def optima() -> Certainty:
    """From the state to the maneuver: sides, tolerances, and the faster of two."""
    return Certainty(sides() + on_one_side() + on_either_side() + taking_the_faster_side() + tolerances(), 0)


def tolerances() -> int:
    """`rounding` and `arc_tolerance_of` are those of theory.md, section 6; the number of cases."""
    require(rounding.ROUNDING == 64.0 * 2.0**-52, "ROUNDING is not 64 units of 2^-52")
    require(rounding.REACH == 2.0**52, "REACH is not 2^52")
    x, y, R, tolerance, ax, ay, field = variables("x y R tolerance ax ay")

    def size(value: Any) -> Any:
        return ax if value is x else ay if value is y else value

    found = rebinding({"abs": size})(rounding.rounding)(x, y, R)
    zero("`rounding`", found - field.constant(rounding.ROUNDING) * (1.0 + ax + ay + R))
    for sign in (NEGATIVE, NEVER_NEGATIVE):
        x, y, R, tolerance, rounded, field = variables("x y R tolerance rounded")
        field.assume(tolerance - rounded, sign)
        names = field.names() | {"rounding": StandIn("rounding", (x, y, R), rounded)}
        share = rebinding(names)(rounding.arc_tolerance_of)(x, y, R, tolerance)
        zero("`arc_tolerance_of`", 3.0 * share - (rounded if sign == NEGATIVE else tolerance))
    return 3


# Which states are solved, and the feedback law


class Argument(float):
    """A number that may be compared with the boundaries next to which it is tried, and be used for nothing else."""

    boundaries: tuple[float, ...]

    def __new__(cls, number: float, boundaries: tuple[float, ...]) -> Self:
        """A number, and the boundaries with which it may be compared."""
        argument = super().__new__(cls, number)
        argument.boundaries = boundaries
        return argument

    def _compared(self, other: float, compare: Callable[[float, float], bool]) -> bool:
        require(other in self.boundaries, f"a comparison with {other}")
        return compare(float(self), other)

    def _used(self, *_: object) -> NoReturn:
        raise NotProved("a number is not only compared")

    def __lt__(self, other: float) -> bool:
        return self._compared(other, operator.lt)

    def __le__(self, other: float) -> bool:
        return self._compared(other, operator.le)

    def __gt__(self, other: float) -> bool:
        return self._compared(other, operator.gt)

    def __ge__(self, other: float) -> bool:
        return self._compared(other, operator.ge)

    def __abs__(self) -> Argument:
        return Argument(abs(float(self)), self.boundaries)

    __add__ = __radd__ = __sub__ = __rsub__ = __mul__ = __rmul__ = __truediv__ = __rtruediv__ = _used
    __neg__ = __mod__ = __rmod__ = __pow__ = __rpow__ = __bool__ = __eq__ = __ne__ = _used
    __hash__ = float.__hash__


def beside(*boundaries: float) -> list[Argument]:
    """Numbers on, next to, and far from boundaries: all that comparisons with them can tell apart."""
    near = [b for a in boundaries for b in (math.nextafter(a, -math.inf), a, math.nextafter(a, math.inf))]
    return [Argument(number, boundaries) for number in (-math.inf, *sorted(near), math.inf, math.nan)]


def laws() -> Certainty:
    """What is solved, the feedback law, and the motion."""
    return Certainty(solved_states() + motions(), 0)


def solved_states() -> int:
    """`status_of`, `is_solvable`, `rounded_radius` next to each boundary; `first_control` for each word and side."""
    reach, least, cases = 2.0**52, 1.0 - rounding.ROUNDING, 0
    lengths, radii, spreads = beside(-reach, 0.0, reach), beside(0.0, least, 1.0, reach), beside(0.0, reach)
    for R in radii:
        rounded, given = float(rounding.rounded_radius(R)), float(R)
        expected = 1.0 if least <= given < 1.0 else given
        same = rounded == expected or (math.isnan(rounded) and math.isnan(given))
        require(same, "`rounded_radius` is another radius")
    for x, y, R, tolerance in product(lengths, lengths, radii, spreads):
        status = expected_status(float(x), float(y), float(R), float(tolerance), least, reach)
        require(synthesis.status_of(x, y, R, tolerance) == status, f"the status of {(x, y, R, tolerance)}")
        solvable = synthesis.is_solvable(x, y, R, tolerance)
        require(solvable == (status == Status.OK), f"`is_solvable` at {(x, y, R, tolerance)}")
        cases += 1
    for controls, side in product(every_word(), (-1, 1)):
        R, field = variables("R")
        field.assume(R, POSITIVE)
        code = words.encode(*padded(controls))
        law = entries.first_control(R, entries.Entry(side, code, 0.0, 0.0, 0.0))
        zero("`first_control`", field.of(law) - (controls[0] if controls else field.constant(-side) / R))
        cases += 1
    return cases


def expected_status(x: float, y: float, R: float, tolerance: float, least: float, reach: float) -> Status:
    """The status that proof.md, section 7, says."""
    if not all(map(math.isfinite, (x, y, R))):
        return Status.NOT_FINITE
    if least > R:
        return Status.RADIUS_TOO_SMALL
    if max(abs(x), abs(y), R) > reach:
        return Status.OUT_OF_RANGE
    return Status.OK if 0.0 <= tolerance <= reach else Status.BAD_TOLERANCE


def motions() -> int:
    """`flow` turns about (0, -u) clockwise for u = 1, or shifts along x; `reduce` is (2), of which it is the motion."""
    x, y, ce, se, t, _ = variables("x y ce se t")
    copied = rebinding({"cos": StandIn("cos", (t,), ce), "sin": StandIn("sin", (t,), se)})(motion.flow)
    for u in (-1, 1):
        end = copied(x, y, u, t)
        zero("`flow`", end[0] - (x * ce + u * (y + u) * se), end[1] - ((y + u) * ce - u * x * se - u))
    zero("`flow`", *(a - b for a, b in zip(copied(x, y, 0, t), (x + t, y), strict=True)))
    found = motion.reduce(x, y, ce, se)
    zero("`reduce`", found[0] - (x * ce + y * se), found[1] - (y * ce - x * se))
    return 4
