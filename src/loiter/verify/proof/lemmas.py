"""The lemmas of docs/proof.md as checks: each raises `NotProved`, or says how many cases and boxes it took.

Identities are checked in exact algebra, on the kernel's own functions: for one sample point in every branch, which by
`Field.compared` stands for all states in that branch. Inequalities are checked in ball arithmetic. Names are those of
docs/proof.md: s = sin alpha, c = cos alpha, w, q = w/s, A and B the switching points.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from itertools import product
from typing import Any, NamedTuple

from loiter.compiled.rebinding import rebinding
from loiter.kernel import extremals as kernel
from loiter.kernel import switching_curves
from loiter.verify.proof import balls
from loiter.verify.proof.algebra import Expression, Field, NotProved, flint
from loiter.verify.proof.balls import Certainty, Interval
from loiter.verify.proof.exact_paths import Point, exact, flown, is_rotation, squared, start_at, without_tolerance


class Lemma(NamedTuple):
    """A lemma of docs/proof.md: its section, what it says, and its check."""

    section: str
    statement: str
    check: Callable[[], Certainty]


def require(holds: bool, sentence: str) -> None:
    """Raise `NotProved` with a sentence where something does not hold."""
    if not holds:
        raise NotProved(sentence)


def zero(sentence: str, *expressions: Expression) -> None:
    """Raise `NotProved` where an expression is not 0 at every point."""
    for expression in expressions:
        require(expression.is_zero, f"{sentence}: off by {expression.sample:.3g} at the sample point")


# Lemma 1: the words arrive, and exist where the text says


class Quantities(NamedTuple):
    """The quantities whose signs decide which words exist, each as docs/proof.md writes it."""

    outer: Expression
    inner: Expression
    fold: Expression
    onto_right: Expression  # rm^2 - (R + 1)^2
    from_left: Expression  # rp^2 - (R - 1)^2
    tall: Expression  # R - 1
    wide: Expression  # R - 2


def quantities(start: Point, R: Expression) -> Quantities:
    """The deciding quantities of a start, written without the kernel."""
    left, right = squared(start, -1.0), squared(start, 1.0)
    return Quantities(
        left - (R + 1.0) * (R + 1.0),
        right - (R - 1.0) * (R - 1.0),
        left - (R - 3.0) * (R - 3.0),
        right - (R + 1.0) * (R + 1.0),
        left - (R - 1.0) * (R - 1.0),
        R - 1.0,
        R - 2.0,
    )


class Case(NamedTuple):
    """A word, a sample point of it, and the quantities that decide its existence."""

    word: Callable[..., kernel.Extremal]
    crossing: tuple[float, ...]
    sample: tuple[float, float, float]
    decided_by: Callable[[Quantities], tuple[Expression, ...]]


def arrival_cases() -> Iterator[Case]:
    """The words of two arcs, and those with a straight piece from both branches of `onto_axis`."""
    for crossing in (-1.0, 1.0):
        yield Case(kernel.rl, (crossing,), (-1.3, 1.7, 1.4), lambda q: (q.inner, q.inner - 8.0 * (q.tall + 2.0)))
        yield Case(kernel.lr, (crossing,), (0.3, 1.3, 1.4), lambda q: (q.tall, q.outer, q.fold))
        yield Case(kernel.lsl, (), (8.3 * crossing, 1.3, 1.4), lambda q: (q.outer,))
        yield Case(kernel.rsl, (), (8.3 * crossing, 1.3, 1.4), lambda q: (q.onto_right,))
        yield Case(kernel.lsr, (), (1.3 * crossing, 0.3, 4.4), lambda q: (q.from_left, q.wide))
        yield Case(kernel.rsr, (), (1.3 * crossing, 0.3, 4.4), lambda q: (q.inner, q.wide))


def arrivals() -> Certainty:
    """Each word of lemma 1 with a switch off the switching curve ends at (0, R), and exists where it says."""
    cases = 0
    for case in arrival_cases():
        x, y, R, field = variables("x y R", case.sample)
        point = Point(x, y)
        start = start_at(field, x, y, R)
        named = quantities(point, R)
        zero("`start_at`", start.outer - named.outer, start.inner - named.inner, start.fold - named.fold)
        field.compared.clear()
        (word,) = exact(field, case.word)
        extremal = word(start, *case.crossing)
        # The centre of the first turn decides whether it meets the axis, and x which branch computes it.
        meets_axis = (squared(point, -1.0) - 1.0, squared(point, 1.0) - 1.0, x)
        check_decisions(case.word.__name__, field, case.decided_by(named), meets_axis)
        check_end(case.word.__name__, field, R, flown(point, extremal, axis_roots(field, point))[2])
        cases += 1
    return Certainty(cases + single_arcs(), 0)


def single_arcs() -> int:
    """`l` and `r` from a start on their circle; the number of cases."""
    samples = list(product((kernel.l, kernel.r), (-1.0, 1.0)))
    for word, left in samples:
        y, R, field = variables("y R", (0.7, 2.6))
        radius, centre = (R + 1.0, -1.0) if word is kernel.l else (R - 1.0, 1.0)
        x = left * field.sqrt(radius * radius - (y - centre) * (y - centre))
        start = start_at(field, x, y, R)
        (function,) = exact(field, word)
        extremal = function(start)
        require(extremal.straight == 0.0, f"{word.__name__} does not exist on its circle")
        point = Point(x, y)
        check_end(word.__name__, field, R, flown(point, extremal, [radius * radius])[0])
    return len(samples)


def variables(names: str, sample: Iterable[float]) -> Any:
    """The variables of a new field, and the field."""
    field = Field(dict(zip(names.split(), sample, strict=True)))
    return *map(field.variable, names.split()), field


def axis_roots(field: Field, start: Point) -> list[Expression]:
    """The lengths of the rotations of `onto_axis`, of which the field does not see that they are squares."""
    found = []
    for centre, end in product((-1.0, 1.0), (-1.0, 1.0)):
        radius2 = squared(start, centre)
        if radius2.sample > 1.0:
            found.append(radius2 * (field.sqrt(radius2 - 1.0) + end * start.x))
    return found


def check_end(name: str, field: Field, R: Expression, end: Point) -> None:
    """Raise `NotProved` where a path does not end at (0, R)."""
    zero(f"{name} misses the target", end.x, end.y - R)


def check_decisions(
    name: str, field: Field, deciding: Iterable[Expression], further: Iterable[Expression] = ()
) -> None:
    """Raise `NotProved` where a kernel function compared anything but the given quantities, or not all `deciding`."""
    deciding = tuple(deciding)
    known = (*deciding, *further)
    for compared in field.compared:
        sound = any(compared == quantity or compared == -quantity for quantity in known)
        # A root, such as c, is compared with 0, and is never negative.
        require(sound or is_root(compared), f"{name} decides by an unknown quantity")
    for quantity in deciding:
        used = any(compared == quantity or compared == -quantity for compared in field.compared)
        require(used, f"{name} does not decide by the quantity of the text")


def is_root(expression: Expression) -> bool:
    """Whether an expression, or its opposite, is a root by itself."""
    powers = [tuple(map(int, exponents)) for exponents in expression.num.to_dict()]
    variables_only = expression.field.variables
    return len(powers) == 1 and sum(powers[0]) == 1 and not any(powers[0][:variables_only])


# Lemma 4: the switching points of LRL and RLR


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


def rotation_about(a: Point, b: Point, centre: float) -> tuple[Expression, Expression]:
    """The counter-clockwise rotation about (0, centre) from one point to another: cross and inner product."""
    ay, by = a.y - centre, b.y - centre
    return a.x * by - ay * b.x, a.x * b.x + ay * by


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


# Lemma 6: an upper bound for RL


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


# Lemma 7: RLR


class Tail(NamedTuple):
    """The start A of the tail L, R of RLR, in the variables s and q, with g = R - 1."""

    field: Field
    s: Expression
    c: Expression
    q: Expression
    g: Expression
    A: Point


def tail(s: float, q: float) -> Tail:
    """The tail of RLR at s and q: w = q s."""
    s_, q_, field = variables("s q", (s, q))
    c = field.sqrt(1.0 - s_ * s_)
    g = field.sqrt(c * c + q_ * q_ * s_ * s_)
    length = s_ * (3.0 - q_)
    return Tail(field, s_, c, q_, g, Point(length * c, -length * s_))


def rlr_tail() -> Certainty:
    """Lemma 7 (a): the tail of RLR lasts 3 pi - 3 alpha + omega; inner and y1 - yA are what it says."""
    # B is the left crossing for q > 1, the right one for q < 1.
    for q_, branch in ((0.6, 1.0), (1.4, -1.0)):
        t = tail(0.8, q_)
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
        crossing, _, _ = flown(t.A, rl(start, 1.0))
        zero("y1 - yA", crossing.y - t.A.y - (1.0 + g - s * s * (1.0 - q)))
    return Certainty(2, 0)


def rlr_excess() -> Certainty:
    """Lemma 7 (b): E = pi - 3 alpha + omega + a rises with q and, at q = 2 - sqrt 3, falls with alpha."""
    h, q, field = variables("h q", (0.4, 0.7))
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
    return (x * y.derivative(name) - y * x.derivative(name)) / (x * x + y * y)


# The corner alpha = pi/2, q = 1 (R = 2), where the tail and RL take the same time, is cut out of the boxes of
# `rlr_slower`, and proved by lemma 7 (b): 3 e > tan(e)/q for e = pi/2 - alpha up to this.
CORNER = 1.0 / 16.0

# A little below 2 - sqrt 3, and a little above pi/2, so that the boxes cover the closed region.
LOWEST_Q, HIGHEST_ANGLE = 0.2679, 1.571


def rlr_slower() -> Certainty:
    """Lemma 7 (c): the kernel's RL from A is faster than the tail of RLR, in ball arithmetic, for q up to 2."""
    angles = Interval(HIGHEST_ANGLE - CORNER, HIGHEST_ANGLE)
    boxes = [
        (Interval(0.0, HIGHEST_ANGLE - CORNER), Interval(LOWEST_Q, 2.0)),
        (angles, Interval(LOWEST_Q, 1.0 - CORNER)),
        (angles, Interval(1.0 + CORNER, 2.0)),
    ]
    outside = balls.positive("RLR is slower than RL", rlr_margin(), boxes)
    corner = balls.positive(
        "RLR is slower next to R = 2", corner_margin, [(Interval(0.0, CORNER), Interval(1.0 - CORNER, 1.0 + CORNER))]
    )
    return Certainty(outside.cases + corner.cases, max(outside.depth, corner.depth))


def rlr_margin() -> Callable[[Any, Any], Any]:
    """The time of the tail of RLR less that of the faster crossing of RL, as a function of the balls alpha and q."""
    arb = flint().arb
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


def corner_margin(e: Any, q: Any) -> Any:
    """A lower bound of E/e at alpha = pi/2 - e: 3 - tan(e)/(e q), where tan(e)/e is at most 1 + e^2/2."""
    return 3 - (1 + e * e / 2) / q


def rsr_faster() -> Certainty:
    """Lemma 7 (d): for q from 2 to 3 RSR from A takes at most pi + X - atan X, X <= sqrt 8, less than 2 pi."""
    t = tail(0.8, 2.4)
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
    bound = balls.positive("X - atan X < pi", lambda x: flint().arb.pi() - (x - x.atan()), [(Interval(0.0, 2.8285),)])
    return Certainty(1 + bound.cases, bound.depth)


# Lemma 3: straight pieces, and the corner R = 2


def straight_at_two() -> Certainty:
    """Lemma 3: at R = 2, LR from (-c, 0) has y1 = c^2/4, so it is faster than straight on through the centre."""
    c, field = variables("c", (0.9,))
    R, nought = field.constant(2.0), field.constant(0.0)
    (lr,) = exact(field, kernel.lr)
    start = Point(-c, nought)
    extremal = lr(start_at(field, -c, nought, R), 1.0)
    crossing, end, _ = flown(start, extremal)
    zero("y1", crossing.y - 0.25 * c * c)
    require(crossing.x.sample > 0.0, "the crossing is on the left")
    check_end("LR", field, R, end)
    return Certainty(1, 0)


LEMMAS = (
    Lemma("lemma 1", "every word but LRL ends at (0, R), and exists where the text says", arrivals),
    Lemma("lemma 3", "R = 2: no straight piece through the centre", straight_at_two),
    Lemma("lemma 4", "switching points of LRL and RLR, and their radii along the curve", switching_points),
    Lemma("lemma 5", "the kernel's LRL is the extremal, and exists where the text says", kernel_lrl),
    Lemma("lemma 6", "RL takes at most 2 pi - a", rl_bound),
    Lemma("lemma 7 a", "the tail of RLR lasts 3 pi - 3 alpha + omega", rlr_tail),
    Lemma("lemma 7 b", "E > 0: the tail of RLR lasts more than 2 pi - a", rlr_excess),
    Lemma("lemma 7 c", "RL is faster than the tail of RLR, on boxes", rlr_slower),
    Lemma("lemma 7 d", "RSR is faster than the tail of RLR for q > 2", rsr_faster),
)
