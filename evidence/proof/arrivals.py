"""Lemmas 1 and 3 of proof.md: every word but LRL exists where the text says, and there it ends at the target.

Each word is evaluated for every combination of the signs of the quantities by which it decides, with x, y and R as
variables. So the cases cover every state.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from itertools import product
from math import inf, pi
from typing import Any, NamedTuple

from evidence.proof.algebra import Expression, Field
from evidence.proof.balls import Certainty
from evidence.proof.exact_paths import Point, SnappedArcs, exact, flown, squared, start_at
from evidence.proof.identities import Quantities, check_end, quantities, require, variables, zero
from evidence.proof.sign_proofs import (
    ANY,
    NEGATIVE,
    NEVER_NEGATIVE,
    NEVER_POSITIVE,
    POSITIVE,
    ZERO,
    Impossible,
    Possible,
)
from loiter.kernel.rebinding import rebinding
from loiter.kernel.still_air import extremals as kernel
from loiter.kernel.words import Word


class Condition(NamedTuple):
    """A quantity, by its name in `Quantities`, and the signs with which a word exists."""

    quantity: str
    possible: Possible


class Case(NamedTuple):
    """A word: the name of the kernel's function, its crossing, the centre of its first arc, and where it exists.

    `splits` are further quantities whose signs decide which formula is used.
    """

    name: str
    crossing: tuple[float, ...]
    centre: float
    conditions: tuple[Condition, ...]
    splits: tuple[str, ...] = ()

    @property
    def word(self) -> Callable[..., kernel.Extremal]:
        """The kernel's function."""
        function: Callable[..., kernel.Extremal] = getattr(kernel, self.name)
        return function


# Where each word exists. The circle rm = R + 3, of `far`, is the last on which RL exists.
_RL = Condition("inner", NEVER_NEGATIVE), Condition("far", NEVER_POSITIVE)
_LR = Condition("tall", POSITIVE), Condition("outer", NEVER_POSITIVE), Condition("fold", NEVER_NEGATIVE)
_WIDE = Condition("wide", NEVER_NEGATIVE)
_LSL, _RSL = (Condition("outer", NEVER_NEGATIVE),), (Condition("onto_right", NEVER_NEGATIVE),)
_LSR = _WIDE, Condition("left", NEVER_NEGATIVE), Condition("from_left", NEVER_POSITIVE)
_RSR = _WIDE, Condition("right", NEVER_NEGATIVE), Condition("inner", NEVER_POSITIVE)
CASES = {
    "LSL": Case("lsl", (), -1.0, _LSL, ("left", "x")),
    "RSL": Case("rsl", (), 1.0, _RSL, ("right", "x")),
    "LSR": Case("lsr", (), -1.0, _LSR, ("x",)),
    "RSR": Case("rsr", (), 1.0, _RSR, ("x",)),
    "RL, left crossing": Case("rl", (-1.0,), 1.0, _RL),
    "RL, right crossing": Case("rl", (1.0,), 1.0, _RL),
    "LR, left crossing": Case("lr", (-1.0,), -1.0, _LR),
    "LR, right crossing": Case("lr", (1.0,), -1.0, _LR),
}


class Plane(NamedTuple):
    """All states and all radii from 1 on, or those with certain signs of their quantities."""

    field: Field
    point: Point
    R: Expression
    quantities: Quantities


def plane(tall: Possible = NEVER_NEGATIVE) -> Plane:
    """All states, and all radii from 1 on, or those with R - 1 of the given sign."""
    x, y, R, field = variables("x y R")
    if tall == ZERO:
        R = field.constant(1.0)
    else:
        field.assume(R - 1.0, tall)
    point = Point(x, y)
    return Plane(field, point, R, quantities(point, R))


class Region(NamedTuple):
    """The states with certain signs, their kernel start, and whether the word exists there by the text."""

    plane: Plane
    start: kernel.Start
    exists: bool


def regions(case: Case) -> Iterator[Region]:
    """A region for every combination of signs of the quantities of a word: together they are all states."""
    signs = [(condition.possible, ANY - condition.possible) for condition in case.conditions]
    names = (*(condition.quantity for condition in case.conditions), *case.splits)
    for chosen in product(*signs, *[(POSITIVE, ZERO, NEGATIVE)] * len(case.splits)):
        exists = all(a == b.possible for a, b in zip(chosen, case.conditions, strict=False))
        try:
            yield Region(*restricted(case, dict(zip(names, chosen, strict=True))), exists)
        except Impossible:
            continue


def restricted(case: Case, signs: dict[str, Possible]) -> tuple[Plane, kernel.Start]:
    """The states at which quantities have given signs; raises `Impossible` where there are none."""
    whole = plane()
    field, point, R, q = whole
    for name, possible in signs.items():
        field.assume(point.x if name == "x" else getattr(q, name), possible)
    if signs.get("outer") == NEVER_NEGATIVE:
        field.derive(q.left, q.outer, R * (R + 2.0))
    if signs.get("onto_right") == NEVER_NEGATIVE:
        field.derive(q.right, q.onto_right, R * (R + 2.0))
    # Where c exists the first arc has a radius of 1 or more; at a radius of 0 see `without_first_arc`.
    if all(signs[condition.quantity] == condition.possible for condition in case.conditions):
        field.assume(squared(point, case.centre), POSITIVE)
    start = start_at(field, point.x, point.y, R)
    zero("`start_at`", start.outer - q.outer, start.inner - q.inner, start.fold - q.fold)
    return whole, start


def arrivals() -> Certainty:
    """Each word of lemma 1 but LRL exists where the text says, and there ends at (0, R)."""
    cases = 0
    for name, case in CASES.items():
        for region in regions(case):
            check_region(name, case, region)
            cases += 1
    return Certainty(cases + single_arcs() + without_first_arc(), 0)


def check_region(name: str, case: Case, region: Region) -> None:
    """Raise `NotProved` where a word exists on a region other than as the text says, or misses the target."""
    field, point, R, q = region.plane
    snapped, arc_tolerance = SnappedArcs(), object()
    (word,) = exact(field, case.word, snap=snapped)
    start = region.start._replace(arc_tolerance=arc_tolerance)  # type: ignore[arg-type]
    extremal = word(start, *case.crossing)
    require((extremal.straight is not inf) == region.exists, f"{name} does not exist where the text says")
    if not region.exists:
        return
    check_word(name, extremal)
    first = extremal.first, squared(point, case.centre)
    if not case.crossing:
        snapped.check(name, arc_tolerance, first)
        check_end(name, R, flown(point, extremal, axis_roots(field, point, case))[2])
        return
    last = R + case.centre
    snapped.check(name, arc_tolerance, first, (extremal.middle, last * last))
    crossing, _, end = flown(point, extremal)
    check_end(name, R, end)
    check_crossing(name, case, crossing, q)


def check_crossing(name: str, case: Case, crossing: Point, q: Quantities) -> None:
    """Raise `NotProved` where a crossing is on the other side of x = 0, or its ordinate is not that of section 6."""
    (branch,) = case.crossing
    require((branch * crossing.x).signs <= NEVER_NEGATIVE, f"{name}: the crossing is on the other side")
    zero(f"{name}: the crossing", crossing.y - 0.25 * (q.from_left if case.centre < 0.0 else -q.onto_right))


def check_word(name: str, extremal: kernel.Extremal) -> None:
    """Raise `NotProved` where an extremal is not of the word in its name."""
    letters = Word(int(extremal.word)).letters
    require(letters == name.partition(",")[0], f"{name} is {letters}")


def axis_roots(field: Field, point: Point, case: Case) -> list[Expression]:
    """The length of the rotation of `onto_axis`, of which the field does not see that it is a square."""
    radius2 = squared(point, case.centre)
    c = field.sqrt(radius2 - 1.0)
    return [radius2 * (c + end * point.x) for end in (-1.0, 1.0) if (end * point.x).signs == POSITIVE]


def single_arcs() -> int:
    """`l` and `r` exist on their circle alone, r for R > 1 alone, and there end at the target; the number of cases."""
    cases = 0
    for word, centre, grown in ((kernel.l, -1.0, 1.0), (kernel.r, 1.0, -1.0)):
        for beside, wide in product((NEGATIVE, POSITIVE), (ZERO, POSITIVE)):
            field, point, R, q = plane(wide)
            field.assume(q.outer if word is kernel.l else q.inner, beside)
            extremal = exact(field, word)[0](start_at(field, point.x, point.y, R))
            require(extremal.straight is inf, f"{word.__name__} exists beside its circle")
            single_arc_within_tolerance(word, plane(wide), centre)
            cases += 1
        for left, wide in product((-1.0, 1.0), (POSITIVE, ZERO)):
            on_circle(word, centre, grown, left, wide)
            cases += 1
    return cases


def single_arc_within_tolerance(word: Callable[..., kernel.Extremal], whole: Plane, centre: float) -> None:
    """Check that `arc_tolerance` widens the circle of a single arc, and applies to the arc."""
    field, point, R, q = whole
    near, snapped, arc_tolerance, asked = object(), SnappedArcs(), object(), list[tuple[Any, ...]]()

    def is_near_circle(beyond2: Any, radius: Any, distance: Any) -> bool:
        asked.append((beyond2 - (q.outer if centre < 0.0 else q.inner), radius - (R - centre), distance))
        return bool(near)

    start = start_at(field, point.x, point.y, R)._replace(arc_tolerance=arc_tolerance)  # type: ignore[arg-type]
    copied = rebinding(field.names() | {"snap_full_turn": snapped, "is_near_circle": is_near_circle})
    for near in (False, True):
        extremal = copied(word)(start)
        exists = near and (centre < 0.0 or not (R - 1.0).is_zero)
        require((extremal.straight is not inf) == exists, f"{word.__name__} does not exist within `arc_tolerance`")
    same = all(a.is_zero and b.is_zero and c is arc_tolerance for a, b, c in asked)
    require(same, f"{word.__name__}: `arc_tolerance` is not that of its circle")
    snapped.arcs = snapped.arcs[-1:]
    snapped.check(word.__name__, arc_tolerance, (extremal.first, (R - centre) * (R - centre)))


def on_circle(word: Callable[..., kernel.Extremal], centre: float, grown: float, left: float, wide: Possible) -> None:
    """Check a single arc on its circle, left or right of x = 0, for R > 1 or R = 1."""
    name = word.__name__.upper()
    y, tall, field = variables("y tall")
    field.assume(tall, wide)
    R = tall + 1.0 if wide == POSITIVE else field.constant(1.0)
    radius, height = R + grown, y - centre
    (function,) = exact(field, word)
    if radius.is_zero:
        extremal = function(start_at(field, field.constant(0.0), field.constant(centre), R))
        require(extremal.straight is inf, f"{name} exists at R = 1")
        return
    field.assume(radius * radius - height * height, NEVER_NEGATIVE)
    x = left * field.sqrt(radius * radius - height * height)
    extremal = function(start_at(field, x, y, R))
    require(extremal.straight == 0.0, f"{name} does not exist on its circle")
    check_word(name, extremal)
    check_end(name, R, flown(Point(x, y), extremal)[0])


def without_first_arc() -> int:
    """RL from (0, 1) at R = 1, and LR from (0, -1) at R = 3: the start is the centre of the first arc.

    These are the only such starts, as rm = 0 makes `inner` -(R - 1)^2, and rp = 0 makes `fold` -(R - 3)^2.
    """
    for word, y, R, last in ((kernel.rl, 1.0, 1.0, 0.0), (kernel.lr, -1.0, 3.0, pi)):
        for branch in (-1.0, 1.0):
            extremal = word(kernel.start_at(0.0, y, R, 0.0), branch)
            require(extremal.straight == 0.0, f"{word.__name__} does not exist at the centre of its first arc")
            require(kernel.durations(extremal) == (0.0, last, 0.0), f"{word.__name__} turns about its start")
    return 2


def straight_at_two() -> Certainty:
    """Lemma 3: at R = 2, LR from (-c, 0) has y1 = c^2/4, so it is faster than straight on through the centre."""
    c, field = variables("c")
    field.assume(c, POSITIVE)
    field.assume(8.0 - c * c, POSITIVE)
    R, nought = field.constant(2.0), field.constant(0.0)
    (lr,) = exact(field, kernel.lr)
    start = Point(-c, nought)
    extremal = lr(start_at(field, -c, nought, R), 1.0)
    crossing, end, _ = flown(start, extremal)
    zero("y1", crossing.y - 0.25 * c * c)
    require(crossing.x.signs == POSITIVE, "the crossing is on the left")
    check_end("LR", R, end)
    return Certainty(1, 0)
