"""Theorem 4 of proof.md: bounds on the rounding error of T, word by word, from the kernel's own operations.

The states of a word are given by coordinates in which the quantities that vanish in places, `outer`, `inner` and
`fold`, are products. Boxes of these coordinates are halved until the bound is at most `LIMIT`. Errors and bounds are in
units of 2^-52 (1 + |x| + |y| + R); `kernel.rounding.rounding` is 64 of them.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from itertools import pairwise, product
from typing import Any, NamedTuple

import flint

from evidence.proof import balls
from evidence.proof.answers.turns import Traced
from evidence.proof.arrivals import CASES, Case
from evidence.proof.arrivals import Region as WordRegion
from evidence.proof.arrivals import regions as regions_of
from evidence.proof.balls import Box, Certainty, Interval
from evidence.proof.exact_paths import exact, squared, without_tolerance
from evidence.proof.identities import require, zero
from evidence.proof.rounded import (
    BRANCHES,
    OF_SUM,
    UNIT,
    WIDEN,
    Rounded,
    Undecided,
    arithmetic,
    fold_half_turn,
    highest,
    lowest,
    total_angle,
    with_length,
)
from evidence.proof.sign_proofs import POSITIVE, NotProved
from loiter.kernel import angles
from loiter.kernel.entry import Entry, duration
from loiter.kernel.rebinding import Function, rebinding
from loiter.kernel.still_air import extremals as kernel
from loiter.kernel.words import Word

# The largest bound allowed, in units of 2^-52 (1 + |x| + |y| + R).
LIMIT = 64.0

# Boxes after which a word is given up.
MOST_BOXES = 200_000

# Digits of the balls, in bits: differences such as R - 1 keep theirs.
BITS = 160

# The relative error of `exact.beyond_circles` where its value exceeds 2^-46 of the square of the scale, for `fold`
# 2^-94 (proof.md), and of `exact.square_beyond`: two roundings.
BEYOND, SQUARE_BEYOND = 2.6 * UNIT, 2.1 * UNIT

# The relative error of `within_reach` where it exceeds 2^-46 of the square of the scale, `outer` is not positive and
# R + y + 2 is a small share of R (proof.md).
NEAR_END = 3.7 * UNIT

# The error of `exact.beyond_circles` at any value is `BEYOND` of it, and this share of the square of the scale: (B3) of
# bridging.md.
ANYWHERE = 2.0**-100

# The range: R up to 2^10; words with a straight piece up to 2^10 times the radius of the last circle.
OCTAVES = 10

# The distance from the centre of the first arc from which on bounds hold.
APART = 2.0**-4


class State(NamedTuple):
    """The states of a box, in balls: x, y, R, their distance from the centre of the first arc.

    `outer`, `inner` and `fold` are those of the kernel's `Start`, with the bound of `exact.beyond_circles`; None where
    the word does not use them. `reach` is the exact value of `within_reach`.
    """

    x: Any
    y: Any
    R: Any
    distance: Any
    outer: Rounded | None = None
    inner: Rounded | None = None
    fold: Rounded | None = None
    reach: Any = None


class Region(NamedTuple):
    """The states of a word: boxes of coordinates, the state at coordinates, and the kernel's function.

    `weights` say how much bounds depend on the width of each coordinate. `lengths` gives those of the first two
    rotations, where they are known in closed form.
    """

    word: str
    boxes: Sequence[Box]
    state: Callable[..., State | None]
    function: Callable[[Callable[[Function], Function], kernel.Start], kernel.Extremal]
    weights: tuple[float, ...] = (1.0, 1.0, 1.0)
    lengths: Callable[[State], tuple[Any, ...]] = lambda state: ()
    limit: float = LIMIT


class Bound(NamedTuple):
    """The largest bound of a word, in units of 2^-52 (1 + |x| + |y| + R), and what it took."""

    units: float
    certainty: Certainty


def bound(region: Region) -> Bound:
    """The bound of a word on its region; raises `NotProved` where it would exceed `LIMIT`."""
    with flint.ctx.workprec(BITS):
        return _bound(region, word_functions())


def _bound(region: Region, copied: Callable[[Function], Function]) -> Bound:
    waiting, cases, deepest, worst = [(box, 0) for box in region.boxes], 0, 0, 0.0
    while waiting:
        box, depth = waiting.pop()
        cases, deepest = cases + 1, max(deepest, depth)
        units, reason = units_on(region, copied, box)
        if units <= region.limit:
            worst = max(worst, units)
            continue
        if cases > MOST_BOXES:
            raise NotProved(f"{region.word}: the bound is {units:.3g} units on {box} {reason}")
        waiting += [(half, depth + 1) for half in halves(box, region.weights)]
    return Bound(worst, Certainty(cases, deepest))


def sum_of_angles() -> Certainty:
    """`angles.total_angle` of three exact rotations is off by at most `OF_SUM`, by its own operations.

    Rotations by up to half a turn are enough, since the others are their opposites.
    """
    undecided, half = flint.arb(0, 1), Interval(0.0, 3.1416)

    def spare(*turned: Any) -> Any:
        try:
            total = sum_of(*((Rounded(angle.sin()), Rounded(angle.cos())) for angle in turned))
        except Undecided:
            return undecided
        return flint.arb(OF_SUM - total.error) if total.error < OF_SUM else undecided

    with flint.ctx.workprec(BITS):
        sum_of = rebinding(arithmetic() | {"fold_half_turn": fold_half_turn})(angles.total_angle)
        return balls.positive("the sum of three angles", spare, [(half, half, half)])


def lengths() -> Certainty:
    """The lengths of rotations in closed form that bounds use: `about`, `of_arc`."""
    cases = 0
    for case in CASES.values():
        for region in regions_of(case):
            if region.exists:
                check_lengths(case, region)
                cases += 1
    return Certainty(cases, 0)


def check_lengths(case: Case, region: WordRegion) -> None:
    """Raise `NotProved` where a rotation of a word has another length on a region."""
    field, point, R, _ = region.plane
    (word,) = exact(field, case.word)
    extremal = word(region.start, *case.crossing)
    name, square, scale = case.name, squared(point, case.centre), field.constant(1.0)
    if case.crossing:
        last = R + case.centre
        zero(f"the last rotation of {name}", square_of(extremal.middle) - last * last)
    else:
        end = -1.0 if case.name in ("lsl", "rsl") else 1.0
        if (end * point.x).signs == POSITIVE:
            scale = field.sqrt(square - 1.0) + end * point.x
    zero(f"the first rotation of {name}", square_of(extremal.first) - square * square * scale * scale)


def square_of(rotation: Any) -> Any:
    """The squared length of a rotation."""
    cross, dot = rotation
    return cross * cross + dot * dot


def word_functions() -> Callable[[Function], Function]:
    """Rebinds a function of the kernel to `Rounded` numbers; a turn counts as full only where it is."""
    names = arithmetic()
    known = with_length(rebinding(names)(angles.rotation))
    reach = with_reach(rebinding(names)(kernel.within_reach))
    return rebinding(
        names
        | {
            "snap_full_turn": without_tolerance,
            # Its result serves `snap_full_turn` alone.
            "squared_distance": lambda *numbers: None,
            "square_beyond": square_beyond,
            "within_reach": reach,
            "total_angle": total_angle,
            "rotation": known,
        }
    )


def square_beyond(a: Any, b: float) -> Rounded:
    """In place of `exact.square_beyond`, whose product and sums are exact but for the last ones."""
    value = a.value * a.value - b
    error = (2.0 * a.highest * a.error + a.error * a.error) * WIDEN
    return Rounded(value, (error + SQUARE_BEYOND * (highest(value) + error)) * WIDEN)


def with_reach(within_reach: Callable[..., Any]) -> Callable[..., Any]:
    """The kernel's `within_reach` with the values of `State.reach`, and the error of its own operations.

    Where `outer` is not positive, next to the end of RL, its relative error is `NEAR_END`, if it is that sum.
    """
    check_reach()

    def known(start: Any) -> Rounded:
        found = within_reach(start)
        reach = found.value.intersection(start.outer.total)
        if start.outer.sign < 0:
            return Rounded(reach, NEAR_END * highest(reach), NEAR_END, 1)
        return Rounded(reach, found.error, sign=1)

    return known


def check_reach() -> None:
    """Raise `NotProved` where `within_reach` is not computed as 4 (R + y + 2) - `outer`."""
    x, y, R, arc, outer, inner, fold = map(Traced, ("x", "y", "R", "arc", "outer", "inner", "fold"))
    start: Any = kernel.Start(x, y, R, arc, outer, inner, fold)  # type: ignore[arg-type]
    expected = 4.0 * ((R + y) + 2.0) - outer
    require(kernel.within_reach(start).text == expected.text, "`within_reach` is not 4 (R + y + 2) - outer")  # type: ignore[attr-defined]


def halves(box: Box, weights: Sequence[float]) -> list[Box]:
    """A box halved along the coordinate that is widest relative to its size, times its weight."""
    widths = [
        weight * (one.high - one.low) / max(1.0, min(abs(one.low), abs(one.high)))
        for one, weight in zip(box, weights, strict=True)
    ]
    widest = widths.index(max(widths))
    before, after = box[:widest], box[widest + 1 :]
    return [(*before, half, *after) for half in box[widest].halves()]


def units_on(region: Region, copied: Callable[[Function], Function], box: Box) -> tuple[float, str]:
    """The bound on a box, `inf` with a reason where it is not decided; 0 where the word is not to be bounded."""
    state = region.state(*map(balls.ball, box))
    if state is None:
        return 0.0, ""
    try:
        times = BRANCHES.explored(lambda: time_of(region, copied, state))
    except Undecided as reason:
        return float("inf"), str(reason)
    error = max((time.error for both in times for time in both), default=0.0)
    return error / (2.0**-52 * smallest_scale(state)) * WIDEN, ""


def smallest_scale(state: State) -> float:
    """The least 1 + |x| + |y| + R on a box."""
    beyond_centre = max(float((state.distance - 1).lower()) / WIDEN, 0.0)
    return 1.0 + max(lowest(state.x) + lowest(state.y), beyond_centre) + lowest(state.R)


def time_of(region: Region, copied: Callable[[Function], Function], state: State) -> tuple[Rounded, ...]:
    """The time of a word, as `fastest` compares it and as the sum of its durations; none where it is absent."""
    start: Any = kernel.Start(*map(Rounded, state[:3]), 0.0, *state[4:7])  # type: ignore[arg-type, call-arg]
    # By `lengths`, x x + y (y + 2), or that with -y where the first arc is R, is the squared distance less 1.
    start.x.total = state.distance * state.distance - 1
    if state.reach is not None:
        start.outer.total = state.reach
    extremal = region.function(copied, start)
    straight: Any = extremal.straight
    if not isinstance(straight, Rounded) and straight != 0.0:
        return ()
    for rotation, length in zip((extremal.first, extremal.middle), region.lengths(state), strict=False):
        for part in rotation:
            part.length = lowest(length)  # type: ignore[attr-defined]
    t1, t2, t3 = copied(kernel.durations)(extremal)
    entry = Entry(1, 0, t1, t2, t3)
    return Rounded.of(copied(kernel.duration)(extremal)), Rounded.of(copied(duration)(entry))


# States by coordinates


def left_of(angle: Any, distance: Any) -> tuple[Any, Any]:
    """X and y at a distance from (0, -1), the centre of L, at an angle from straight above."""
    return distance * angle.sin(), distance * angle.cos() - 1


def right_of(angle: Any, distance: Any) -> tuple[Any, Any]:
    """X and y at a distance from (0, 1), the centre of R, at an angle from straight below."""
    return distance * angle.sin(), 1 - distance * angle.cos()


def between(near: Any, far: Any, share: Any) -> Any:
    """A distance whose square is near^2 (1 - share) + far^2 share, for balls that are not negative."""
    near, far, share = near.nonnegative_part(), far.nonnegative_part(), share.nonnegative_part()
    low, rest = (near.lower() * near.lower() * (1 - share.upper())), far.lower() * far.lower() * share.lower()
    high = near.upper() * near.upper() * (1 - share.lower()) + far.upper() * far.upper() * share.upper()
    return (low + rest).nonnegative_part().sqrt().union(high.sqrt())


def signed(value: Any, sign: int) -> Rounded:
    """A quantity of `exact.beyond_circles`, whose sign is known."""
    return Rounded(value, BEYOND * highest(value), BEYOND, sign)


def unsigned(value: Any, x: Any, y: Any, R: Any) -> Rounded:
    """A quantity of `exact.beyond_circles` at any state, also next to its circle."""
    scale = 1.0 + highest(x) + highest(y) + highest(R)
    return Rounded(value, (BEYOND * highest(value) + ANYWHERE * scale * scale) * WIDEN)


def joins_external(first: int) -> Callable[..., State | None]:
    """States of LSL (first = 1) or RSL, at R and a distance of at least R + 1."""

    def state(angle: Any, distance: Any, R: Any) -> State | None:
        if distance < R + 1:
            return None
        return State(*(left_of if first > 0 else right_of)(angle, distance), R, distance)

    return state


def joins_internal(first: int) -> Callable[..., State | None]:
    """States of LSR (first = 1) or RSR, at c and R - 2; None where c exceeds X."""

    def state(angle: Any, c: Any, wide: Any) -> State | None:
        R = 2 + wide
        if c * c > R * wide:
            return None
        distance = (1 + c * c).sqrt()
        return State(*(left_of if first > 0 else right_of)(angle, distance), R, distance)

    return state


def right_left(branch: float) -> Callable[..., State | None]:
    """States of RL with the left crossing, `inner` up to 4 R, or with the right one, from there to 8 (R + 1)."""

    def state(angle: Any, share: Any, R: Any) -> State | None:
        inner = 4 * R * share if branch < 0.0 else 4 * R + (4 * R + 8) * share
        distance = between(R - 1, R + 1, share) if branch < 0.0 else between(R + 1, R + 3, share)
        if distance < APART:
            return None
        x, y = right_of(angle, distance)
        reach = 8 * (R + 1) - inner
        outer = unsigned(4 * (R + y + 2) - reach, x, y, R)
        return State(x, y, R, distance, outer, signed(inner, 1), reach=reach)

    return state


def right_left_last(side: Any, share: Any, rest: Any, R: Any) -> State | None:
    """States of RL with the right crossing from there to 8 (R + 1), where `outer` is not positive: next to (0, -R - 2).

    `share` is that of `within_reach` in its value where the other region ends, `rest` that of 4 (R + y + 2) in it.
    """
    reach = (4 * R + 8) * (1 - LONG) * share
    rise = reach * rest / 4
    x2 = 2 * rise * (R + 3) - rise * rise - reach
    if x2 < 0:
        return None
    x, distance = side * x2.nonnegative_part().sqrt(), ((R + 3) * (R + 3) - reach).sqrt()
    outer, inner = signed(-reach * (1 - rest), -1), signed(8 * (R + 1) - reach, 1)
    return State(x, rise - R - 2, R, distance, outer, inner, reach=reach)


def left_right_tight(angle: Any, share: Any, tall: Any) -> State:
    """States of LR with the right crossing for R = 1 + `tall` up to 2: rp from 3 - R to R + 1."""
    R = 1 + tall
    outer, fold = -8 * tall * share, 8 * tall * (1 - share)
    distance = between(R + 1, 3 - R, share)
    return State(*left_of(angle, distance), R, distance, outer=signed(outer, -1), fold=signed(fold, 1))


def left_right_wide(angle: Any, share: Any, R: Any) -> State | None:
    """States of LR with the right crossing for R from 2 on: rp from R - 1 to R + 1."""
    outer, fold = -4 * R * share, 8 * (R - 1) - 4 * R * share
    distance = between(R + 1, R - 1, share)
    return State(*left_of(angle, distance), R, distance, outer=signed(outer, -1), fold=signed(fold, 1))


def left_right_detour(angle: Any, share: Any, R: Any) -> State | None:
    """States of LR with the left crossing, R from 2 on: rp from |R - 3| to R - 1."""
    outer, fold = -4 * R - (4 * R - 8) * share, (4 * R - 8) * (1 - share)
    distance = between(R - 1, abs(R - 3), share)
    if distance < APART:
        return None
    return State(*left_of(angle, distance), R, distance, outer=signed(outer, -1), fold=signed(fold, 1))


def left_right_centre(angle: Any, distance: Any, wide: Any) -> State:
    """States of LR with the left crossing, next to the centre of L: R - 3 from -rp to rp."""
    R = 3 + wide * distance
    outer = (distance - R - 1) * (distance + R + 1)
    fold = distance * distance * ((1 - wide) * (1 + wide)).nonnegative_part()
    return State(*left_of(angle, distance), R, distance, outer=signed(outer, -1), fold=signed(fold, 1))


def left_right_left(angle: Any, share: Any, R: Any) -> State | None:
    """States of LRL with rp from 1 to 3 - R; None where the radius of the middle arc is small, by (P2)."""
    distance = 1 + (2 - R) * share
    outer, fold = (distance - R - 1) * (distance + R + 1), (2 - R) * (share - 1) * (distance + 3 - R)
    K = R * (R + 2)
    h, d = K + outer / 2, outer / 4
    s2 = (h + (h * h - 3 * d * d).nonnegative_part().sqrt()) / 6
    if 4 * s2 - 4 * (s2 * (s2 + K)).sqrt() + (R + 1) * (R + 1) < SMALLEST_MIDDLE * SMALLEST_MIDDLE:
        return None
    return State(*left_of(angle, distance), R, distance, outer=signed(outer, -1), fold=signed(fold, -1))


def about(side: int) -> Callable[[State], tuple[Any, Any]]:
    """The lengths of the rotations of RL (side = 1): rm^2 and R + 1; or of LR: rp^2 and R - 1."""
    return lambda state: (state.distance.lower() * state.distance.lower(), state.R + side)


def about_curve(state: State) -> tuple[Any]:
    """A lower bound on the length of the first rotation of LRL, q rp^2 with q >= 1."""
    return (state.distance.lower() * state.distance.lower(),)


def of_arc(end: float) -> Callable[[State], tuple[Any]]:
    """The length of the rotation of `onto_axis`: the squared distance, times c + end x where that is the scale."""

    def length(state: State) -> tuple[Any]:
        along, square = end * state.x, state.distance.lower() * state.distance.lower()
        scaled = along > 0 or (not along < 0 and BRANCHES.outcomes[:1] == [True])
        return (square * (square - 1).sqrt() if scaled else square,)

    return length


# Weights of the coordinates: an arc onto the axis depends on the place, a crossing on the two radii.
BY_PLACE, BY_CROSSING, BY_CURVE = (0.01, 1.0, 0.1), (0.001, 1.0, 1.0), (0.01, 1.0, 1.0)
BY_SHARES = (1.0, 1.0, 1.0, 1.0)

# The radius of the middle arc of LRL from which on bounds hold.
SMALLEST_MIDDLE = 2.0**-2


def octaves(lowest_power: int, highest_power: int) -> list[Interval]:
    """Intervals from a power of two to the next one."""
    return [Interval(2.0**a, 2.0**b) for a, b in pairwise(range(lowest_power, highest_power + 1))]


def boxes(*coordinates: Iterable[Interval]) -> list[Box]:
    """All combinations of intervals."""
    return list(product(*coordinates))


# Angles all the way round.
ROUND = (Interval(-3.1416, 0.0), Interval(0.0, 3.1416))

SHARES = (Interval(0.0, 1.0),)

# Short of the circle of radius R + 3 about (0, 1), where two circles touch at the crossing.
LONG = 1.0 - 2.0**-4
SHORT = (Interval(0.0, LONG),)

# Left and right of x = 0.
SIDES = Interval(-1.0, -1.0), Interval(1.0, 1.0)

# Closer to the centre of L than 2^-46, `fold` does not exceed 2^-94 of the square of the scale.
CENTRE = octaves(-46, -4)


def joins(name: str, boxes: Sequence[Box], state: Callable[..., State | None]) -> Region:
    """The region of a word with a straight piece; LSR and RSR, inside the circle, have a larger limit."""
    word, sign, outside = Word[name], 1 if name[0] == "L" else -1, name[-1] == "L"

    def function(copied: Callable[[Function], Function], start: kernel.Start) -> kernel.Extremal:
        join = kernel.external_join if outside else kernel.internal_join
        extremal: kernel.Extremal = copied(join)(word, start.y if sign > 0 else -start.y, start, True)
        return extremal

    lengths, limit = of_arc(-1.0 if outside else 1.0), LIMIT if outside else 2.0 * LIMIT
    return Region(name, boxes, state, function, BY_PLACE, lengths, limit)


def crosses(
    name: str, boxes: Sequence[Box], state: Callable[..., State | None], weights: tuple[float, ...] = BY_CROSSING
) -> Region:
    """The region, or a part of it, of RL or LR with the crossing that its name says."""
    is_rl, branch = name.startswith("RL"), 1.0 if "right" in name else -1.0

    def function(copied: Callable[[Function], Function], start: kernel.Start) -> kernel.Extremal:
        extremal: kernel.Extremal = copied(kernel.rl if is_rl else kernel.lr)(start, branch)
        return extremal

    return Region(name, boxes, state, function, weights, about(1 if is_rl else -1))


def regions() -> list[Region]:
    """The regions of the nine words, LR with the right crossing in two parts."""
    radii, wide = octaves(0, OCTAVES), octaves(1, OCTAVES)
    external = boxes(ROUND, octaves(1, 2 * OCTAVES), radii)
    # c is at least 1/8, so R - 2 is more than 2^-8.
    internal = boxes(ROUND, octaves(-3, OCTAVES), octaves(-8, OCTAVES))
    near_end, in_centre = boxes(SIDES, SHARES, SHARES, radii), boxes(ROUND, CENTRE, [Interval(-1.0, 1.0)])
    lrl = boxes(ROUND, SHARES, [Interval(1.0, 2.0)])
    return [
        joins("LSL", external, joins_external(1)),
        joins("RSL", external, joins_external(-1)),
        joins("LSR", internal, joins_internal(1)),
        joins("RSR", internal, joins_internal(-1)),
        crosses("RL, left crossing", boxes(ROUND, SHARES, radii), right_left(-1.0)),
        crosses("RL, right crossing", boxes(ROUND, SHORT, radii), right_left(1.0)),
        crosses("RL, right crossing, next to its end", near_end, right_left_last, BY_SHARES),
        crosses("LR, right crossing, R <= 2", boxes(ROUND, SHARES, octaves(-52, 0)), left_right_tight),
        crosses("LR, right crossing, R >= 2", boxes(ROUND, SHARES, wide), left_right_wide),
        crosses("LR, left crossing", boxes(ROUND, SHARES, wide), left_right_detour),
        crosses("LR, left crossing, next to the centre of L", in_centre, left_right_centre, BY_CURVE),
        Region("LRL", lrl, left_right_left, lambda f, s: f(kernel.lrl)(s), BY_CURVE, about_curve, 4.0 * LIMIT),
    ]
