"""The answer in doubles beside the exact problem, at adversarial doubles: bridging.md.

`python -m evidence.campaigns.bridging --states 1000000` draws doubles next to every circle, axis, centre and
corner where the answer changes, with radii next to those where words begin to exist or end, and climbs from the worst
of them. For each state it flies the answer's pieces, as the doubles that they are, in 512 bits or more, and compares
its time with the least time of all words, by formulas that share nothing with the kernel. Errors are in units of
2^-52 (1 + |x| + |y| + R).
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from contextlib import AbstractContextManager
from fractions import Fraction
from itertools import product
from math import inf, ldexp, nextafter, sqrt
from random import Random
from typing import Any, NamedTuple

import flint
import numpy as np
from flint import arb

import loiter
from loiter.kernel.still_air import synthesis
from loiter.kernel.words import ABSENT, controls

# Numbers below 2^-100 are squared beside numbers of up to 2^104.
BITS, MOST_BITS = 512, 2600

# A rotation that is closer to a whole turn than this is none: an exact one is none, or far from a whole turn.
NO_TURN = arb(2) ** -140


# How far from the target a path ends at most, in units, and one that is LRL: theorem 5 of bridging.md.
LIMIT, LIMIT_OF_LRL = 256.0, 2048.0

# How late an answer is at most, in units, where LRL does not exist: theorem 6. No later one is known elsewhere, though
# 1024 units are proved there.
LATEST = 256.0


class Answer(NamedTuple):
    """A maneuver as the kernel returns it: its side, word and durations, and the least time as `min_time` gives it."""

    side: int
    word: int
    durations: tuple[float, float, float]
    time: float


class Case(NamedTuple):
    """A state of three doubles, the turn that is asked for, and the name of the family from which it was drawn."""

    x: float
    y: float
    R: float
    turn: int
    family: str


# States at which earlier formulas of the kernel were late by 3e3 to 2e6 units, missed by 1e3, or past the target were
# late by a whole turn. The search begins with them.
ONCE_WRONG = [
    Case(-2.9652998050290914e-07, 1.0000000000000315, 3.0000000000000013, -1, "centre of L"),
    Case(-4.013704791455801e-07, 3.7320508075673127, 1.7320508075688774, -1, "outer edge of RL"),
    Case(3.9967860229456235e-09, -3.999999999999963, 1.9999999999999998, 1, "outer edge of RL"),
    Case(-5.905410132397376e-05, -0.7320507997022512, 2.732050793194699, 1, "corner"),
    Case(-6.0911746759290757e-05, -0.7320507985259724, 2.732050791602569, 1, "corner"),
    Case(-6.440274546555344e-13, 63.25000000000033, 63.24999999999972, 1, "past the target"),
    Case(-6.355599708859868e-13, 63.25000000000033, 63.24999999999972, 1, "past the target"),
    Case(-1.7320508075688574, 6.517686263266475e-16, 1.0000000000000169, 1, "circle and axis"),
    Case(-1.732050807568854, 2.034077475764484e-16, 1.00000000000002, 1, "circle and axis"),
    Case(-1.7320508075686263, 4.3436770294091844e-20, 1.0000000000002174, 1, "circle and axis"),
]


class Errors(NamedTuple):
    """In units: the distance from the target at the end, how much later than the exact optimum, and how much sooner."""

    miss: float
    late: float
    early: float


def turned(ax: Any, ay: Any, bx: Any, by: Any) -> Any:
    """The counter-clockwise rotation from one vector to another, in [0, 2 pi)."""
    cross, dot = (ax * by - ay * bx).mid(), (ax * bx + ay * by).mid()
    if cross == 0:
        return arb(0) if dot >= 0 else arb.pi()
    angle = arb.atan2(cross, dot).mid()
    if angle < -NO_TURN:
        return angle + 2 * arb.pi()
    return angle if angle > 0 else arb(0)


def root(square: Any) -> Any:
    """The square root, of 0 for a negative number."""
    return square.mid().sqrt().mid() if square.mid() > 0 else arb(0)


def exact_times(x: Any, y: Any, R: Any) -> Iterator[tuple[str, Any]]:
    """Each word onto the clockwise circle with its exact time; single arcs only from their circles."""
    # Squared distances from the two centres; L turns clockwise about (0, -1), R counter-clockwise about (0, 1).
    p, m = x * x + (y + 1) ** 2, x * x + (y - 1) ** 2
    slack = arb(2) ** (100 - flint.ctx.prec) * (1 + p + R * R)

    def first_turn(first: int, ax: Any, ay: Any) -> Any:
        return turned(ax, ay + 1, x, y + 1) if first > 0 else turned(x, y - 1, ax, ay - 1)

    def last_turn(last: int, ax: Any, ay: Any) -> Any:
        return turned(arb(0), R + 1, ax, ay + 1) if last > 0 else turned(ax, ay - 1, arb(0), R - 1)

    if abs(p - (R + 1) ** 2) <= slack:
        yield "L", last_turn(1, x, y)
    if R > 1 and abs(m - (R - 1) ** 2) <= slack:
        yield "R", last_turn(-1, x, y)
    for first, square in ((1, p), (-1, m)):
        if square >= (R + 1) ** 2 - slack:
            c, X = root(square - 1), root(R * (R + 2))
            yield "LR"[first < 0] + "SL", first_turn(first, -c, arb(0)) + (c - X) + last_turn(1, -X, arb(0))
        if R >= 2 and square >= 1 - slack and square <= (R - 1) ** 2 + slack:
            c, X = root(square - 1), root(R * (R - 2))
            yield "LR"[first < 0] + "SR", first_turn(first, c, arb(0)) + (X - c) + last_turn(-1, X, arb(0))
    for first, square in ((-1, m), (1, p)):
        last = -first
        if first == 1 and R == 1:
            continue
        low, high = (R + last - 2) ** 2, (R + last + 2) ** 2
        if low - slack <= square <= high + slack:
            y1 = first * (square - (R + last) ** 2) / 4
            x1 = root((R + last) ** 2 - (y1 + last) ** 2)
            for branch in (-1, 1):
                yield (
                    "LR"[first < 0] + "LR"[last < 0],
                    first_turn(first, branch * x1, y1) + last_turn(last, branch * x1, y1),
                )
    K, k = R * (R + 2), p - 1
    h, d = (K + k) / 2, (K - k) / 4
    D = h * h - 3 * d * d
    for sign in (-1, 1):
        s2 = (h + sign * root(D)) / 6
        if -slack > D or s2 <= 0 or s2 > 1 + slack:
            continue
        s, c = root(s2), root(1 - s2)
        w = (16 * s2 - (k - K)) / (8 * s)
        a, b = ((3 * s - w) * c, (3 * s - w) * s), ((s - w) * c, -(s - w) * s)
        middle = turned(a[0], a[1] - 1, b[0], b[1] - 1)
        yield "LRL", first_turn(1, *a) + middle + last_turn(1, *b)


def exactly(x: float, y: float) -> AbstractContextManager[Any]:
    """So many bits that the squares of these two and of numbers beside them are exact."""
    smallest = min((abs(value) for value in (x, y) if value), default=1.0)
    return flint.ctx.workprec(BITS if smallest > 2.0**-100 else MOST_BITS)


def least(x: float, y: float, R: float, side: int) -> tuple[str, Any]:
    """The exact optimum onto the circle of a side, +1 clockwise: its word (as if clockwise) and its time."""
    with exactly(x, y):
        return min(exact_times(arb(x), arb(side * y), arb(R)), key=lambda found: found[1])


def end_of(x: float, y: float, answer: Answer) -> tuple[Any, Any]:
    """Where the pieces of an answer end, flown exactly."""
    ax, ay = arb(x), arb(y)
    for u, t in zip(controls(answer.word), answer.durations, strict=True):
        if u == ABSENT:
            continue
        if u == 0:
            ax = ax + arb(t)
            continue
        s, c = arb(t).sin_cos()
        w = u * ay + 1
        ax, ay = ax * c + w * s, u * (w * c - ax * s - 1)
    return ax, ay


def unit(x: float, y: float, R: float) -> float:
    """2^-52 of 1 + |x| + |y| + R."""
    return 2.0**-52 * (1.0 + abs(x) + abs(y) + R)


def errors_of(case: Case, answer: Answer) -> Errors:
    """The errors of an answer, in units."""
    with exactly(case.x, case.y):
        return errors_in_bits(case, answer)


def errors_in_bits(case: Case, answer: Answer) -> Errors:
    """The same in the bits that are set."""
    x, y, R = case.x, case.y, case.R
    ax, ay = end_of(x, y, answer)
    miss = (ax * ax + (ay - answer.side * arb(R)) ** 2).mid().sqrt()
    side = case.turn if case.turn else (-1 if y < 0.0 else 1)
    _, exact = least(x, y, R, side)
    summed = sum((arb(t) for t in answer.durations), arb(0))
    late = max(summed - exact, arb(answer.time) - exact, key=float)
    early = max(exact - summed, exact - arb(answer.time), key=float)
    one = arb(unit(x, y, R))
    return Errors(float(miss / one), float(late / one), float(early / one))


def answers(cases: list[Case]) -> Iterator[Answer]:
    """What the compiled library answers."""
    x, y, R, turn = (np.array([case[i] for case in cases], dtype=float) for i in range(4))
    names = np.array(["either", "cw", "ccw"])[turn.astype(int)]
    found, times = loiter.solve(x, y, R, names), loiter.min_time(x, y, R, names)
    assert (found.status == 0).all()
    for i in range(len(cases)):
        t1, t2, t3 = map(float, found.durations[i])
        yield Answer(int(found.side[i]), int(found.word[i]), (t1, t2, t3), float(times[i]))


def plain_answers(cases: list[Case]) -> Iterator[Answer]:
    """What the kernel answers in plain Python."""
    for x, y, R, turn, _ in cases:
        side, word, *durations = synthesis.optimum(x, y, R, turn, 0.0)
        t1, t2, t3 = durations
        yield Answer(side, word, (t1, t2, t3), synthesis.least_time(x, y, R, side, 0.0))


# States


def nudged(random: Random, value: float) -> float:
    """A double next to a value: some ulps away, or by a power of two, or the value itself."""
    choice = random.random()
    if choice < 0.25:
        return value
    if choice < 0.6:
        for _ in range(random.randint(1, 3)):
            value = nextafter(value, random.choice((-inf, inf)))
        return value
    size = max(abs(value), 1.0) if random.random() < 0.8 else 1.0
    return value + random.choice((-1.0, 1.0)) * size * ldexp(random.uniform(1.0, 2.0), random.randint(-60, -1))


SPECIAL_RADII = (1.0, 2.0, 3.0, 1.0 + sqrt(3.0), sqrt(3.0), 1.5, 4.0)


def radius(random: Random) -> float:
    """A radius from 1 to 2^52: next to those where words begin or end, or of any size."""
    choice = random.random()
    if choice < 0.25:
        R = 1.0
    elif choice < 0.65:
        R = nudged(random, random.choice(SPECIAL_RADII))
    elif choice < 0.85:
        R = random.uniform(1.0, 4.0)
    else:
        R = ldexp(random.uniform(1.0, 2.0), random.randint(0, 51))
    return min(max(R, 1.0), 2.0**52)


def circles(R: float) -> dict[str, tuple[float, float]]:
    """The centre's ordinate and the radius of the circles on which words begin to exist or end."""
    return {
        "last circle L": (-1.0, R + 1.0),
        "last circle R": (1.0, R - 1.0),
        "inner edge of LR": (-1.0, abs(R - 3.0)),
        "outer edge of RL": (1.0, R + 3.0),
        "RSL beside RL": (1.0, R + 1.0),
        "LSR beside LR": (-1.0, R - 1.0),
        "c = 0, LSR": (-1.0, 1.0),
        "c = 0, RSR": (1.0, 1.0),
    }


def tiny(random: Random) -> float:
    """A number next to zero, of either sign and of any size down to the least."""
    return random.choice((-1.0, 1.0)) * ldexp(
        random.uniform(1.0, 2.0), -random.choice((random.randint(1, 80), random.randint(80, 1074)))
    )


def on_circle(random: Random, R: float) -> tuple[str, float, float]:
    """A state next to one of the circles, also next to its crossings with another or with an axis."""
    name, (centre, r) = random.choice(sorted(circles(R).items()))
    choice = random.random()
    if choice < 0.35:  # at any angle
        direction = random.uniform(-3.2, 3.2)
        x, y = r * float(np.cos(direction)), centre + r * float(np.sin(direction))
    elif choice < 0.6:  # next to its highest or lowest point, or exactly there
        x = 0.0 if random.random() < 0.3 else tiny(random) * random.choice((1.0, R))
        y = centre + random.choice((-1.0, 1.0)) * r
    elif choice < 0.8:  # next to the axis
        y = 0.0 if random.random() < 0.3 else tiny(random)
        x = random.choice((-1.0, 1.0)) * sqrt(max(r * r - (y - centre) ** 2, 0.0))
    else:  # next to a crossing with another circle
        _, (other, q) = random.choice(sorted(circles(R).items()))
        if other == centre:
            y = centre + random.choice((-1.0, 1.0)) * r
        else:
            y = (r * r - q * q + other * other - centre * centre) / (2.0 * (other - centre))
        x = random.choice((-1.0, 1.0)) * sqrt(max(r * r - (y - centre) ** 2, 0.0))
    return name, nudged(random, x), nudged(random, y)


def centre(random: Random, R: float) -> tuple[str, float, float]:
    """A state next to a centre, or to the target or its opposite."""
    name, y = random.choice(
        (("centre of L", -1.0), ("centre of R", 1.0), ("centre", 0.0), ("target", R), ("opposite", -R))
    )
    x = 0.0 if random.random() < 0.2 else tiny(random)
    return name, x, nudged(random, y) if random.random() < 0.5 else y + tiny(random)


def switching(random: Random, R: float) -> tuple[str, float, float]:
    """A state next to a switching curve: A of (P1), or on the first arc before it; at R = 1 up to the jump."""
    low, high = 2.0 - sqrt(3.0), 2.0 + sqrt(3.0)
    K = R * (R + 2.0)
    # w^2 - s^2 = K with s <= 1, so q = w/s from sqrt(1 + K) to 2 + sqrt(3).
    q = min(sqrt(1.0 + K), high) if random.random() < 0.3 else random.uniform(min(sqrt(1.0 + K), high), high)
    q = max(nudged(random, q), 1.0 + 2.0**-50, low)
    s = min(sqrt(K / (q * q - 1.0)), 1.0)
    c, w = sqrt(max(1.0 - s * s, 0.0)), q * s
    x, y = (3.0 * s - w) * c, (3.0 * s - w) * s
    if random.random() < 0.5:
        back = random.choice((random.uniform(0.0, 3.2), abs(tiny(random))))
        cb, sb = float(np.cos(back)), float(np.sin(back))
        x, y = x * cb - (y + 1.0) * sb, (y + 1.0) * cb + x * sb - 1.0
    return "switching curve", nudged(random, x), nudged(random, y)


def double_root(random: Random, R: float) -> tuple[str, float, float]:
    """A state on a short first arc of LRL, next to where its two roots meet: `w/s` of (P1) next to 2 + sqrt(3)."""
    K, short = R * (R + 2.0), ldexp(random.uniform(1.0, 2.0), -random.randint(1, 50))
    q = max(2.0 + sqrt(3.0) - short, 1.5)
    s = min(sqrt(K / (q * q - 1.0)), 1.0)
    m, back = 3.0 * s - q * s, random.choice((0.0, short * random.random(), short * random.uniform(0.0, 8.0), 1e-3))
    x, y = m * sqrt(max(1.0 - s * s, 0.0)), m * s
    cb, sb = float(np.cos(back)), float(np.sin(back))
    return "double root", nudged(random, x * cb - (y + 1.0) * sb), nudged(random, (y + 1.0) * cb + x * sb - 1.0)


def on_axis(random: Random, R: float) -> tuple[str, float, float]:
    """A state next to y = 0 whose difference of squares from a circle is as small as doubles allow: 1e-32 and less."""
    centre, radius = random.choice(((-1, Fraction(R) + 1), (1, Fraction(R) - 1), (-1, Fraction(R) - 3)))
    x = random.choice((-1.0, 1.0)) * sqrt(max(float(radius * radius - 1), 0.0))
    for _ in range(random.choice((0, 1, 2, 40))):
        x = nextafter(x, random.choice((-inf, inf)))
    beyond = Fraction(x) ** 2 + 1 - radius * radius
    y = beyond / (2 * centre)
    y = (beyond + y * y) / (2 * centre)
    return "circle and axis", nudged(random, x) if random.random() < 0.3 else x, float(y) if abs(y) < 1 else 0.0


def corner(random: Random, R: float) -> tuple[str, float, float]:
    """A state next to rp = |3 - R|, below the centre: where LRL, LR and LSR meet for R near 1 + sqrt(3)."""
    r = abs(3.0 - R) - random.choice((0.0, ldexp(random.random(), -random.randint(1, 60))))
    turn = random.choice((-1.0, 1.0)) * random.choice((random.random(), ldexp(random.random(), -random.randint(1, 50))))
    return "corner", nudged(random, r * float(np.sin(turn))), nudged(random, r * float(np.cos(turn)) - 1.0)


def anywhere(random: Random, R: float) -> tuple[str, float, float]:
    """A state of any size, each coordinate for itself."""
    size = random.choice((1.0, R, ldexp(1.0, random.randint(-20, 51))))
    x, y = (min(max(random.uniform(-2.0, 2.0) * size, -(2.0**52)), 2.0**52) for _ in range(2))
    return "anywhere", x, y


def drawn(random: Random) -> Case:
    """A random adversarial case."""
    R = radius(random)
    families = on_circle, centre, switching, double_root, on_axis, corner, anywhere
    family = random.choices(families, (6, 2, 3, 1, 1, 2, 1))[0]
    if family is corner:
        R = max(1.0 + sqrt(3.0) + random.choice((-1.0, 1.0)) * ldexp(random.random(), -random.randint(0, 52)), 1.0)
    name, x, y = family(random, R)
    if random.random() < 0.25:
        y = -y
    x, y = (min(max(value, -(2.0**52)), 2.0**52) for value in (x, y))
    return Case(x, y, R, random.choice((1, -1, 0)), name)


def moved(random: Random, case: Case) -> Case:
    """A neighbour of a case, for climbing."""
    x, y, R = case.x, case.y, case.R
    which = random.randint(0, 6)
    x = nudged(random, x) if which & 1 or which == 0 else x
    y = nudged(random, y) if which & 2 or which == 0 else y
    R = min(max(nudged(random, R), 1.0), 2.0**52) if which & 4 else R
    x, y = (min(max(value, -(2.0**52)), 2.0**52) for value in (x, y))
    return case._replace(x=x, y=y, R=R)


class Worst(NamedTuple):
    """The largest error of a kind in a family, or of a word, with the case and its answer."""

    units: float
    case: Case
    answer: Answer


def letters(answer: Answer) -> str:
    """The word of an answer, as if its circle were held clockwise: "LRL"."""
    return "".join("RSL"[answer.side * u + 1] for u in controls(answer.word) if u != ABSENT) or "none"


def campaign(states: int, seed: int, ask: Any = answers, batch: int = 2000) -> dict[tuple[str, str], Worst]:
    """The largest miss and lateness of each family and word: half of the states are drawn, half sought by climbing."""
    random, worst = Random(seed), dict[tuple[str, str], Worst]()
    for number in range(-(-states // batch)):
        climbing = number % 2 == 1
        found = list(worst.values())
        cases = [moved(random, random.choice(found).case) if climbing else drawn(random) for _ in range(batch)]
        if number == 0:
            cases[: len(ONCE_WRONG)] = ONCE_WRONG
        for case, answer in zip(cases, ask(cases), strict=True):
            errors = errors_of(case, answer)
            for kind, group in product(("miss", "late"), (case.family, letters(answer))):
                key, units = (kind, group), getattr(errors, kind)
                if key not in worst or not units <= worst[key].units:
                    worst[key] = Worst(units, case, answer)
    return worst


def largest(worst: dict[tuple[str, str], Worst], kind: str) -> Worst:
    """The largest error of a kind."""
    return max((found for (of, _), found in worst.items() if of == kind), key=lambda found: found.units)


def main() -> None:
    parser = argparse.ArgumentParser(prog="python -m evidence.campaigns.bridging", description=__doc__)
    parser.add_argument("--states", type=int, default=1_000_000)
    parser.add_argument("--seed", type=int, default=0)
    given = parser.parse_args()
    worst = campaign(given.states, given.seed)
    print("| next to, or word | miss | late |\n|---|---|---|")
    for group in sorted({group for _, group in worst}):
        print(f"| {group} | {worst['miss', group].units:.2f} | {worst['late', group].units:.2f} |")
    for kind in ("miss", "late"):
        print(kind, *largest(worst, kind))


if __name__ == "__main__":
    main()
