"""Lemmas 4 to 6 of proof.md: the switching points of LRL and RLR, the kernel's LRL, and a bound for RL.

Names are those of the text: s = sin alpha, c = cos alpha, q = w/s, and the switching points A and B.
"""

from __future__ import annotations

from itertools import product
from math import isnan

from evidence.proof.algebra import Expression
from evidence.proof.arrivals import CASES, check_crossing, check_word, restricted
from evidence.proof.balls import Certainty
from evidence.proof.exact_paths import Point, SnappedArcs, exact, flown, is_rotation, squared, start_at
from evidence.proof.identities import check_end, require, rotation_about, variables, zero
from evidence.proof.sign_proofs import (
    NEGATIVE,
    NEVER_NEGATIVE,
    NEVER_POSITIVE,
    NOT_ZERO,
    POSITIVE,
    ZERO,
    Possible,
)
from loiter.kernel.still_air import extremals as kernel
from loiter.kernel.still_air import switching_curves


def along_curve(expression: Expression, s: Expression, w: Expression) -> Expression:
    """The derivative by w along the switching curve, where R is constant: ds/dw = w/s."""
    return expression.derivative("w") + w / s * expression.derivative("s")


def switching_points() -> Certainty:
    """Lemma 4: B lies on the last circle, the middle arc lasts 2 pi - 2 alpha, and both radii change as it says.

    LRL (`middle` -1) or RLR (+1): A = (3 s - w) (c, -middle s), B = (s - w) (c, middle s), for w > 0, 0 < s < 1.
    """
    for middle in (-1, 1):
        s, w, field = variables("s w")
        for bound in (s, 1.0 - s, w):
            field.assume(bound, POSITIVE)
        c = field.sqrt(1.0 - s * s)
        # The radius of the last circle: R + 1 in LRL, R - 1 in RLR.
        field.derive(1.0 + w * w - s * s, w * w, 1.0 - s * s)
        last = field.sqrt(1.0 + w * w - s * s)
        a, b = 3.0 * s - w, s - w
        A, B = Point(a * c, -middle * a * s), Point(b * c, middle * b * s)
        zero("B is not on the last circle", squared(B, middle) - last * last)
        zero("A is not on the middle circle", squared(A, -middle) - squared(B, -middle))
        field.derive(squared(A, -middle), c * c, (w - 2.0 * s) * (w - 2.0 * s))
        turned = rotation_about(A, B, -middle)
        require(is_rotation((-middle * turned[0], turned[1]), c * c - s * s, -2.0 * s * c), "the middle arc differs")
        middle2, first2 = squared(A, -middle), squared(A, middle)
        # In LRL the middle circle is that of R, so middle2 is rm^2.
        zero("middle radius", middle2 - (4.0 * s * s - 4.0 * s * w + last * last))
        zero("first radius", first2 - (16.0 * s * s - 8.0 * s * w + last * last))
        zero("R along the curve", along_curve(last * last, s, w))
        zero("middle slope", s * along_curve(middle2, s, w) + 4.0 * (w - s) * (w - s))
        zero("first slope", s * along_curve(first2, s, w) + 8.0 * (w * w - 4.0 * s * w + s * s))
    return Certainty(2, 0)


def kernel_lrl() -> Certainty:
    """Lemma 5: for each s and q = w/s of the text, the kernel's `lrl` exists, has these switches, and ends at (0, R).

    s < 1, and besides s = 1 with q inside its range: there the last arc vanishes.
    """
    cases = 0
    for left, (rest, spread) in product((-1.0, 1.0), ((POSITIVE, NEVER_NEGATIVE), (ZERO, POSITIVE))):
        lrl_on(left, rest, spread)
        cases += 1
    return Certainty(cases + curve() + off_curve(), 0)


def lrl_on(left: float, rest: Possible, spread: Possible) -> None:
    """Check `lrl` from starts left or right of x = 0; `rest` is the sign of 1 - s, `spread` that of 4 q - q^2 - 1."""
    s, q, y, field = variables("s q y")
    if rest == ZERO:
        s = field.constant(1.0)
        # At q = 2, R = 1 the start is on the last circle: see `coinciding.on_outer_at_turn_radius`.
        field.assume(q - 2.0, NOT_ZERO)
    else:
        field.assume(s, POSITIVE)
        field.assume(1.0 - s, POSITIVE)
    # 2 - sqrt 3 <= q <= 2 + sqrt 3, and K = R (R + 2) = (q^2 - 1) s^2 is at least 3.
    field.assume(q, POSITIVE)
    field.assume(4.0 - q, POSITIVE)
    e = 4.0 * q - q * q - 1.0
    field.assume(e, spread)
    K = (q * q - 1.0) * s * s
    field.assume(K - 3.0, NEVER_NEGATIVE)
    c2 = 1.0 - s * s
    field.derive(1.0 + K, K - 3.0, field.constant(4.0))
    R = field.sqrt(1.0 + K) - 1.0
    field.derive(15.0 - K, 15.0 * c2, s * s * (16.0 - q * q))
    # fold <= 0, and h < 6.
    field.derive(3.0 - s * s * (q - 2.0) * (q - 2.0), 3.0 * c2, s * s * e)
    field.derive(2.0 - s * s * (2.0 - q), 2.0 * c2, s * s * q)
    field.derive(6.0 - s * s * (6.0 - e), 6.0 * c2, s * s * e)
    field.derive(6.0 - s * s * (6.0 - e) + s * s * e, 6.0 * c2, 2.0 * s * s * e)
    first2 = 16.0 * s * s - 8.0 * s * s * q + (R + 1.0) * (R + 1.0)
    field.assume(first2, POSITIVE)
    middle2 = 4.0 * s * s - 4.0 * s * s * q + (R + 1.0) * (R + 1.0)
    field.derive(middle2, c2, s * s * (q - 2.0) * (q - 2.0))
    field.assume(first2 - (y + 1.0) * (y + 1.0), NEVER_NEGATIVE)
    x = left * field.sqrt(first2 - (y + 1.0) * (y + 1.0))
    c = field.sqrt(c2)
    snapped, arc_tolerance = SnappedArcs(), object()
    (lrl,) = exact(field, kernel.lrl, known=[c / s], snap=snapped)
    extremal = lrl(start_at(field, x, y, R)._replace(arc_tolerance=arc_tolerance))  # type: ignore[arg-type]
    snapped.check("lrl", arc_tolerance, (extremal.first, first2))
    require(extremal.straight == 0.0, "lrl does not exist")
    check_word("LRL", extremal)
    scale = (R + 1.0) * (5.0 - q)
    a, b, end = flown(Point(x, y), extremal, [scale])
    A, B = (3.0 - q) * s, (1.0 - q) * s
    zero("the first switch of lrl", a.x - A * c, a.y - A * s)
    zero("the second switch of lrl", b.x - B * c, b.y + B * s)
    check_end("lrl", R, end)


def curve() -> int:
    """The first switch of LRL lies on the kernel's switching curve; the number of cases."""
    s, q, field = variables("s q")
    for bound in (s, 1.0 - s, q, 4.0 - q):
        field.assume(bound, POSITIVE)
    field.assume(4.0 * q - q * q - 1.0, NEVER_NEGATIVE)
    K = (q * q - 1.0) * s * s
    field.assume(K - 3.0, NEVER_NEGATIVE)
    field.derive(1.0 + K, K - 3.0, field.constant(4.0))
    R, c = field.sqrt(1.0 + K) - 1.0, field.sqrt(1.0 - s * s)
    x, y = (3.0 - q) * s * c, (3.0 - q) * s * s
    # B = 8/a - A, where x = y sqrt(a - 1) and a = 1/s^2.
    A = 3.0 * y + 0.5 * K
    root = 8.0 * s * s - A
    field.derive(root, 0.5 * s * s * (4.0 * q - q * q - 1.0), s * s * q)
    (abscissa,) = exact(field, switching_curves.switching_abscissa, known=[root, c / s])
    zero("the switching curve", abscissa(y, R) - x)
    return 1


def off_curve() -> int:
    """`switching_abscissa` is nan where a root does not exist, or y sqrt(8/(A + B) - 1); the number of cases."""
    cases = 0
    signs = (NEGATIVE, NEVER_NEGATIVE), (NEVER_POSITIVE, POSITIVE), (NEGATIVE, NEVER_NEGATIVE)
    for square, total, excess in product(*signs):
        y, R, field = variables("y R")
        field.assume(R - 1.0, NEVER_NEGATIVE)
        K = R * (R + 2.0)
        B2, A = y * y + 3.0 * K * y + 0.25 * K * K, 3.0 * y + 0.5 * K
        field.assume(B2, square)
        if square != NEGATIVE:
            field.assume(A + field.sqrt(B2), total)
            field.assume(8.0 - A - field.sqrt(B2), excess)
        (abscissa,) = exact(field, switching_curves.switching_abscissa)
        found = abscissa(y, R)
        if (square, total, excess) == (NEVER_NEGATIVE, POSITIVE, NEVER_NEGATIVE):
            root = field.sqrt(8.0 / (A + field.sqrt(B2)) - 1.0)
            zero("the switching curve", found - y * root)
        else:
            require(isinstance(found, float) and isnan(found), "the switching curve does not end where it should")
        cases += 1
    return cases


def rl_bound() -> Certainty:
    """Lemma 6: cos b1 + cos b2 at the crossing of RL has the sign of R + 1 - rm."""
    for name in ("RL, left crossing", "RL, right crossing"):
        case = CASES[name]
        (field, point, R, q), start = restricted(case, {c.quantity: c.possible for c in case.conditions})
        crossing, _, _ = flown(point, exact(field, kernel.rl)[0](start, *case.crossing))
        rm = field.sqrt(squared(point, 1.0))
        total = (crossing.y - 1.0) / rm + (crossing.y + 1.0) / (R + 1.0)
        sum_ = R + 1.0 + rm
        zero("cos b1 + cos b2", total - (R + 1.0 - rm) * (sum_ * sum_ - 4.0) / (4.0 * rm * (R + 1.0)))
        check_crossing(name, case, crossing, q)
    return Certainty(2, 0)
