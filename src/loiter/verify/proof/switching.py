"""Lemmas 4 to 6 of docs/proof.md: the switching points of LRL and RLR, the kernel's LRL, and a bound for RL.

Names are those of the text: s = sin alpha, c = cos alpha, w, and the switching points A and B.
"""

from __future__ import annotations

from itertools import product
from typing import NamedTuple

from loiter.kernel import extremals as kernel
from loiter.kernel import switching_curves
from loiter.verify.proof.algebra import Expression, Field
from loiter.verify.proof.balls import Certainty
from loiter.verify.proof.exact_paths import Point, exact, flown, is_rotation, squared, start_at
from loiter.verify.proof.identities import check_decisions, check_end, require, rotation_about, variables, zero


class Switches(NamedTuple):
    """The family of CCC extremals: the two switching points, with s, c, w and the radius, in one field."""

    field: Field
    s: Expression
    c: Expression
    w: Expression
    R: Expression
    A: Point
    B: Point


def family(middle: int, s: float, w: float) -> Switches:
    """LRL (`middle` -1) or RLR (+1): A = (3 s - w) (c, -middle s), B = (s - w) (c, middle s)."""
    s_, w_, field = variables("s w", (s, w))
    c = field.sqrt(1.0 - s_ * s_)
    R = field.sqrt(1.0 + w_ * w_ - s_ * s_) + middle
    a, b = 3.0 * s_ - w_, s_ - w_
    return Switches(field, s_, c, w_, R, Point(a * c, -middle * a * s_), Point(b * c, middle * b * s_))


def along_curve(expression: Expression, f: Switches) -> Expression:
    """The derivative by w along the switching curve, where R is constant: ds/dw = w/s."""
    return expression.derivative("w") + f.w / f.s * expression.derivative("s")


def switching_points() -> Certainty:
    """Lemma 4: B lies on the last circle, the middle arc lasts 2 pi - 2 alpha, and both radii change as it says."""
    for middle in (-1, 1):
        f = family(middle, 0.7, 2.0)
        s, c, w, R = f.s, f.c, f.w, f.R
        last = R - middle
        zero("B is not on the last circle", squared(f.B, middle) - last * last)
        zero("A is not on the middle circle", squared(f.A, -middle) - squared(f.B, -middle))
        turned = rotation_about(f.A, f.B, -middle)
        require(is_rotation((-middle * turned[0], turned[1]), c * c - s * s, -2.0 * s * c), "the middle arc differs")
        middle2, first2 = squared(f.A, -middle), squared(f.A, middle)
        # In LRL the middle circle is that of R, so middle2 is rm^2.
        zero("middle radius", middle2 - (4.0 * s * s - 4.0 * s * w + last * last))
        zero("first radius", first2 - (16.0 * s * s - 8.0 * s * w + last * last))
        zero("R along the curve", along_curve(last * last, f))
        zero("middle slope", s * along_curve(middle2, f) + 4.0 * (w - s) * (w - s))
        zero("first slope", s * along_curve(first2, f) + 8.0 * (w * w - 4.0 * s * w + s * s))
    return Certainty(2, 0)


# s and w at sample points of LRL: ya > 0 and ya < 0; heights of starts on the circle of the first arc.
LRL_SAMPLES = ((0.7, 2.0, -0.3), (0.5, 1.84, -0.3), (0.5, 1.84, -1.3))


def kernel_lrl() -> Certainty:
    """Lemma 5: the kernel's `lrl` has these switching points, ends at (0, R), and exists for s < 1 alone."""
    for (s_, w_, y_), left in product(LRL_SAMPLES, (-1.0, 1.0)):
        field = Field({"s": s_, "w": w_, "y": y_})
        s, w, y = map(field.variable, "swy")
        c = field.sqrt(1.0 - s * s)
        R = field.sqrt(1.0 + w * w - s * s) - 1.0
        first2 = 16.0 * s * s - 8.0 * s * w + (R + 1.0) * (R + 1.0)
        x = left * field.sqrt(first2 - (y + 1.0) * (y + 1.0))
        start = start_at(field, x, y, R)
        field.compared.clear()
        (lrl,) = exact(field, kernel.lrl, known=[c / s])
        extremal = lrl(start)
        half, D = 7.0 * s * s + w * w - 4.0 * s * w, (w * w - 4.0 * s * w + s * s) * (w * w - 4.0 * s * w + s * s)
        check_decisions("lrl", field, (R - 3.0, first2 - (R - 3.0) * (R - 3.0), half - 6.0), (D,))
        require(extremal.straight == 0.0, "lrl does not exist")
        scale = (R + 1.0) * (5.0 * s - w) / s
        a, b, end = flown(Point(x, y), extremal, [scale])
        A, B = (3.0 * s - w, s), (s - w, -s)
        zero("the first switch of lrl", a.x - A[0] * c, a.y - A[0] * A[1])
        zero("the second switch of lrl", b.x - B[0] * c, b.y - B[0] * B[1])
        check_end("lrl", field, R, end)
        curve(field, a, R, c / s)
    return Certainty(2 * len(LRL_SAMPLES), 0)


def curve(field: Field, a: Point, R: Expression, slope: Expression) -> None:
    """Raise `NotProved` where the first switch of LRL is not on the kernel's switching curve."""
    # The roots in `switching_abscissa`: B = y + K/2 - 8 (...) is 4/a - A up to sign, and x/y.
    A, K = 3.0 * a.y + 0.5 * R * (R + 2.0), R * (R + 2.0)
    inner = 8.0 / (slope * slope + 1.0) - A
    require((inner * inner - (a.y * a.y + 3.0 * K * a.y + 0.25 * K * K)).is_zero, "the root of the switching curve")
    (abscissa,) = exact(field, switching_curves.switching_abscissa, known=[inner, slope])
    zero("the switching curve", abscissa(a.y, R) - a.x)


def rl_bound() -> Certainty:
    """Lemma 6: cos b1 + cos b2 at the crossing of RL has the sign of R + 1 - rm."""
    x, y, R, field = variables("x y R", (-1.3, 1.7, 1.4))
    start = start_at(field, x, y, R)
    crossings = exact(field, kernel.rl)
    for branch in (-1.0, 1.0):
        crossing, _, _ = flown(Point(x, y), crossings[0](start, branch))
        rm = field.sqrt(squared(Point(x, y), 1.0))
        total = (crossing.y - 1.0) / rm + (crossing.y + 1.0) / (R + 1.0)
        sum_ = R + 1.0 + rm
        zero("cos b1 + cos b2", total - (R + 1.0 - rm) * (sum_ * sum_ - 4.0) / (4.0 * rm * (R + 1.0)))
        require(branch * crossing.x.sample > 0.0, "the crossing is on the other side")
    return Certainty(2, 0)
