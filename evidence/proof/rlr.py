"""Lemma 7 of proof.md: RLR is never optimal.

Names are those of the text: s = sin alpha, c = cos alpha, q = w/s, g = R - 1, and A the first switching point.
"""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from typing import Any, NamedTuple

import flint

from evidence.proof import balls
from evidence.proof.algebra import Expression, Field
from evidence.proof.balls import Certainty, Interval
from evidence.proof.exact_paths import Point, exact, flown, is_rotation, squared, start_at, without_tolerance
from evidence.proof.identities import require, rotation_about, variables, zero
from evidence.proof.sign_proofs import NEVER_NEGATIVE, POSITIVE
from loiter.kernel.rebinding import rebinding
from loiter.kernel.still_air import extremals as kernel


class Tail(NamedTuple):
    """The start A of the tail L, R of RLR, in the variables s and q, with g = R - 1."""

    field: Field
    s: Expression
    c: Expression
    q: Expression
    g: Expression
    A: Point


def tail(least_q: Fraction, largest_q: Fraction) -> Tail:
    """The tail of RLR for 0 < s < 1 and a closed interval of q = w/s, without q = 3."""
    s, q, field = variables("s q")
    field.assume(s, POSITIVE)
    field.assume(1.0 - s, POSITIVE)
    field.assume(q - field.constant(least_q), NEVER_NEGATIVE)
    field.assume(field.constant(largest_q) - q, NEVER_NEGATIVE)
    field.assume(3.0 - q, POSITIVE)
    c2 = 1.0 - s * s
    c = field.sqrt(c2)
    field.derive(c * c + q * q * s * s, c * c, q * q * s * s)
    g = field.sqrt(c * c + q * q * s * s)
    # rp^2, rm^2, and outer = -4 (g + 1 - s^2 (1 - q)), fold = 4 (g - 1 + s^2 (1 - q)).
    field.derive(c * c + s * s * (q - 2.0) * (q - 2.0), c2, s * s * (q - 2.0) * (q - 2.0))
    field.derive(1.0 + s * s * (3.0 - q) * (5.0 - q), field.constant(1.0), s * s * (3.0 - q) * (5.0 - q))
    field.derive(1.0 - s * s * (1.0 - q), c2, s * s * q)
    # RL: (R + 3)^2 - rm^2 = 8 (g + 2 - s^2 (2 - q)).
    field.derive(2.0 - s * s * (2.0 - q), 2.0 * c2, s * s * q)
    length = s * (3.0 - q)
    return Tail(field, s, c, q, g, Point(length * c, -length * s))


# A little below 2 - sqrt 3.
LEAST_Q, ONE, TWO = Fraction(267, 1000), Fraction(1), Fraction(2)


def rlr_tail() -> Certainty:
    """Lemma 7 (a): the tail of RLR lasts 3 pi - 3 alpha + omega; inner and y1 - yA are what it says."""
    # B is the left crossing for q > 1, the right one for q < 1; RL has a crossing for q <= 2.
    for least, largest, branch in ((LEAST_Q, ONE, 1.0), (ONE, TWO, -1.0), (TWO, Fraction(3), -1.0)):
        t = tail(least, largest)
        s, c, q, g = t.s, t.c, t.q, t.g
        start = start_at(t.field, t.A.x, t.A.y, 1.0 + g)
        x1 = (1.0 - q) * s * c
        lr, rl = exact(t.field, kernel.lr, kernel.rl, known=[4.0 * x1])
        extremal = lr(start, branch)
        require(extremal.straight == 0.0, "the tail does not exist")
        require(is_rotation(extremal.first, c * c - s * s, -2.0 * s * c), "its L does not last 2 pi - 2 alpha")
        # The angle of R is pi - alpha + omega, with (cos, sin) omega = (c, w)/g.
        cosine, sine = -(c * c + q * s * s) / g, (s * c - q * s * c) / g
        require(is_rotation(extremal.middle, cosine, sine), "its R does not last pi - alpha + omega")
        zero("inner", start.inner - 8.0 * s * s * (2.0 - q))
        if largest <= TWO:
            crossing, _, _ = flown(t.A, rl(start, 1.0), [2.0 + g])
            zero("y1 - yA", crossing.y - t.A.y - (1.0 + g - s * s * (1.0 - q)))
    return Certainty(3, 0)


def rlr_excess() -> Certainty:
    """Lemma 7 (b): E = pi - 3 alpha + omega + a rises with q and, at q = 2 - sqrt 3, falls with alpha."""
    h, q, field = variables("h q")
    for bound in (h, 1.0 - h, q, 3.0 - q):
        field.assume(bound, POSITIVE)
    # h = tan(alpha/2), so that s and c are rational; d alpha = 2 dh/(1 + h^2).
    s, c = 2.0 * h / (1.0 + h * h), (1.0 - h * h) / (1.0 + h * h)
    length = s * (3.0 - q)
    omega, a = (c, q * s), (1.0 + length * s, length * c)
    g2, rm2 = c * c + q * q * s * s, 1.0 + 2.0 * length * s + length * length
    by_q = angle_slope(omega, "q") + angle_slope(a, "q")
    zero("dE/dq", by_q - 8.0 * s * s * s * c * (2.0 - q) / (g2 * rm2))
    edge = 2.0 - field.sqrt(field.constant(3.0))
    k = 3.0 - edge
    length = s * k
    omega, a = (c, edge * s), (1.0 + length * s, length * c)
    by_alpha = (angle_slope(omega, "h") + angle_slope(a, "h")) * (1.0 + h * h) / 2.0 - 3.0
    first, second = 1.0 - (1.0 - edge * edge) * s * s, 1.0 + k * (2.0 + k) * s * s
    zero("dE/dalpha", by_alpha + 4.0 * k * (2.0 + k) * (1.0 - edge * edge) * s * s * c * c / (first * second))
    return Certainty(2, 0)


def angle_slope(direction: tuple[Expression, Expression], name: str) -> Expression:
    """The derivative by a variable of the angle of a direction."""
    x, y = direction
    x.field.derive(x * x + y * y, x * x, y * y)
    return (x * y.derivative(name) - y * x.derivative(name)) / (x * x + y * y)


# The corner alpha = pi/2, q = 1 (R = 2), where the tail and RL take the same time, is cut out of the boxes of
# `rlr_slower`, and proved by lemma 7 (b): 3 e > tan(e)/q for e = pi/2 - alpha up to this.
CORNER = 1.0 / 16.0


# A little below 2 - sqrt 3, and a little above pi/2, so that the boxes cover the closed region.
LOWEST_Q, HIGHEST_Q, HIGHEST_ANGLE = 0.2679, 2.0, 1.571


# Balls of 53 digits.
SAME_TIME = 1e-12


def rlr_slower() -> Certainty:
    """Lemma 7 (c): the kernel's RL from A is faster than the tail of RLR, in ball arithmetic, for q up to 2."""
    # Beyond q = 2, `inner` is negative and the crossing of RL does not exist.
    require(HIGHEST_Q <= 2.0 and LOWEST_Q * (4.0 - LOWEST_Q) <= 1.0, "the boxes are not those of q <= 2")
    angles = Interval(HIGHEST_ANGLE - CORNER, HIGHEST_ANGLE)
    boxes = [
        (Interval(0.0, HIGHEST_ANGLE - CORNER), Interval(LOWEST_Q, HIGHEST_Q)),
        (angles, Interval(LOWEST_Q, 1.0 - CORNER)),
        (angles, Interval(1.0 + CORNER, HIGHEST_Q)),
    ]
    margin = rlr_margin()
    arb = flint.arb
    touching = abs(margin(0.5 * arb.pi(), arb(1)))
    require(bool(touching < SAME_TIME), f"the two times differ by {touching} at R = 2, where they are equal")
    outside = balls.positive("RLR is slower than RL", margin, boxes)
    # A lower bound of E/e at alpha = pi/2 - e: 3 - tan(e)/(e q), where tan(e)/e is at most 1 + e^2/2.
    around = [(Interval(0.0, CORNER), Interval(1.0 - CORNER, 1.0 + CORNER))]
    corner = balls.positive("RLR is slower next to R = 2", lambda e, q: 3 - (1 + e * e / 2) / q, around)
    return Certainty(outside.cases + corner.cases, max(outside.depth, corner.depth))


def rlr_margin() -> Callable[[Any, Any], Any]:
    """The time of the tail of RLR less that of the faster crossing of RL, as a function of the balls alpha and q."""
    arb = flint.arb
    rl = rebinding(balls.arithmetic() | {"snap_full_turn": without_tolerance})(kernel.rl)

    def margin(alpha: Any, q: Any) -> Any:
        s, c = alpha.sin(), alpha.cos()
        w = q * s
        g = (c * c + w * w).sqrt()
        length = s * (3 - q)
        x, y = length * c, -length * s
        inner = (8 * s * s * (2 - q)).max(arb(0))
        start = kernel.Start(x, y, 1 + g, arb(0), arb(0), inner, arb(0))
        left, right = rl(start, -1.0), rl(start, 1.0)
        # The last arc of the left crossing lasts less than pi, and may vanish: no cut at 0.
        time_left = balls.angle(left.first) + arb.atan2(*left.middle)
        time_right = balls.angle(right.first) + balls.angle(right.middle)
        tail_time = 3 * arb.pi() - 3 * alpha + arb.atan2(w, c)
        return tail_time - time_left.min(time_right)

    return margin


# A little more than the root of 8.
LONGEST_X = 2.8285


def rsr_faster() -> Certainty:
    """Lemma 7 (d): for q from 2 to 3 RSR from A takes at most pi + X - atan X, X <= sqrt 8, less than 2 pi."""
    t = tail(TWO, Fraction(3))
    R = 1.0 + t.g
    start = start_at(t.field, t.A.x, t.A.y, R)
    X2 = R * (R - 2.0)
    zero("X^2", X2 - t.s * t.s * (t.q * t.q - 1.0))
    (rsr,) = exact(t.field, kernel.rsr)
    extremal = rsr(start)
    X = t.field.sqrt(X2)
    cut = t.field.sqrt(squared(t.A, 1.0) - 1.0)
    zero("the straight piece", extremal.straight - (X - cut))
    require(is_rotation(extremal.last, -1.0 / t.g, X / t.g), "the last arc is not pi - atan X")
    down = rotation_about(Point(t.field.constant(0.0), t.field.constant(0.0)), t.A, 1.0)
    cross, dot = extremal.first
    total = (cross * down[1] + dot * down[0], dot * down[1] - cross * down[0])
    require(is_rotation(total, t.field.constant(1.0), cut), "the first arc is not atan c - a")
    require(LONGEST_X * LONGEST_X >= 8.0, "X may be longer")
    pi, boxes = flint.arb.pi(), [(Interval(0.0, LONGEST_X),)]
    # By how much pi + X - atan X is less than 2 pi.
    bound = balls.positive("X - atan X < pi", lambda x: pi - (x - x.atan()), boxes)
    return Certainty(1 + bound.cases, bound.depth)
