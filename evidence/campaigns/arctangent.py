"""Proves how far the arctangent of the compiled loops, and of the page, is from the true angle.

`python -m evidence.campaigns.arctangent` reads `_atan` and `branchless_atan2` from the generated C, follows their
operations in the order of the source, and bounds the error of the result for all pairs of doubles whose larger
magnitude is between 2^-1020 and 2^1022. The page's JavaScript must have the same operations. Then it shows that changed
sources have no proof. bridging.md, "The arctangent of the loops", has the argument. Assumed: IEEE 754 doubles, each
operation rounded to nearest, none contracted.

The pair is scaled by a power of two, so that the larger magnitude is in [1, 2); t is the smaller over the larger one.
Boxes of t and of the larger magnitude are halved until the bound holds. Enclosures of computed numbers are the
operations themselves at the ends of intervals, since rounding is monotone. A rounding error is half a unit in the last
place of the largest result on the box, or 0 where the result is a multiple of a power of two with at most 53 digits.
Up to q the errors are those of a quotient of two linear forms; from q on those of a polynomial in q, whose
coefficients are compared with the series of the arctangent.
"""

from __future__ import annotations

import ast
import re
import sys
from collections.abc import Iterator
from fractions import Fraction
from itertools import product
from math import frexp, inf, nextafter
from pathlib import Path
from typing import Any, NamedTuple

import flint
import numpy as np

from evidence.proof.sign_proofs import NotProved

ROOT = Path(__file__).parents[2]
C = ROOT / "src" / "loiter" / "native" / "still_air_loops.h"
PAGE = ROOT / "src" / "loiter" / "page" / "source" / "kernel" / "kernel.js"

# What is proved, in units of 2^-52 of the angle; theorems 4 to 6 assume 2. Boxes are not halved below this width.
BOUND, NARROWEST = 1.95, 2.0**-10

# Errors are in units of 2^-53, so that half of the least double, 2^-1075, is a double. They are computed in doubles:
# each is made larger by this, and by a number below 2^-1100.
WIDEN, FLOOR = 1.0 + 2.0**-45, 2.0**-1060
SCALE = Fraction(2) ** 53
LEAST_NORMAL = Fraction(2) ** -1022

# The largest |q| for which the polynomial is compared with the arctangent.
REACH = Fraction(41422, 100000)

ANY_GRAIN = 10_000


# The source -------------------------------------------------------------------------------------------------------

CHOICE = re.compile(r"([^()?:,=]+)\?([^()?:,=]+):([^()?:,=]+)")
SYMBOLS = {
    ast.Add: "+",
    ast.Sub: "-",
    ast.Mult: "*",
    ast.Div: "/",
    ast.Lt: "<",
    ast.Gt: ">",
    ast.LtE: "<=",
    ast.GtE: ">=",
}
# A number is its text, a name a word; anything else a tuple: an operator and its operands.
Expression = Any


class Function(NamedTuple):
    """A function without loops: its parameters, its statements (a name and an expression), and what it returns."""

    parameters: list[str]
    statements: list[tuple[str, Expression]]
    result: Expression


class Source(NamedTuple):
    """The constants and the functions that the arctangent needs."""

    constants: dict[str, str]
    functions: dict[str, Function]


def read(text: str, name: str) -> Source:
    """The arctangent, which is called `name`, from C or JavaScript."""
    text = re.sub(r"/\*.*?\*/", "", text, flags=re.S).replace("Math.abs", "fabs")
    define = re.search(r"TAN_EIGHTH (?:= )?([\d.]+)", text)
    if define is None:
        raise NotProved("there is no TAN_EIGHTH")
    return Source({"TAN_EIGHTH": define[1]}, {"_atan": function(text, "_atan"), "atan2": function(text, name)})


def function(text: str, name: str) -> Function:
    """A function of the source."""
    found = re.search(rf"\b{name}\(([^()]*)\) {{\n(.*?)\n}}", text, flags=re.S)
    if found is None:
        raise NotProved(f"there is no function {name}")
    parameters = [word.split()[-1] for word in found[1].split(",")]
    statements, result = [], None
    for line in found[2].split(";"):
        words = re.sub(r"^\s*(const |real |bool |let )*", "", line).strip()
        if result is not None and words:
            raise NotProved(f"after the result: {words}")
        if words.startswith("return "):
            result = parsed(words.removeprefix("return "))
        elif words:
            # `a = 1, b = 2`: the commas between declarations stand before a name and `=`.
            for part in re.split(r",\s*(?=\w+ = )", words):
                name, _, value = part.partition(" = ")
                statements.append((name, parsed(value)))
    return Function(parameters, statements, result)


def parsed(text: str) -> Expression:
    """An expression of C, whose operations have the ranks of Python's; a choice is written as Python writes it."""
    try:
        tree = ast.parse(CHOICE.sub(r"(\2 if \1 else \3)", " ".join(text.split())), mode="eval")
    except SyntaxError:
        raise NotProved(f"not understood: {text}") from None
    return operations(tree.body)


def operations(node: ast.expr) -> Expression:
    """The operations of an expression and their operands."""
    match node:
        case ast.Name(id=name):
            return name
        case ast.Constant(value=float(value)):
            return repr(value)
        case ast.UnaryOp(op=ast.USub(), operand=value):
            return "negative", operations(value)
        case ast.BinOp(left=a, op=operator, right=b) | ast.Compare(left=a, ops=[operator], comparators=[b]):
            if type(operator) in SYMBOLS:
                return SYMBOLS[type(operator)], operations(a), operations(b)
        case ast.IfExp(test=condition, body=a, orelse=b):
            return "?", operations(condition), operations(a), operations(b)
        case ast.Call(func=ast.Name(id=name), args=[value], keywords=[]):
            return "call", name, operations(value)
    raise NotProved(f"not understood: {ast.unparse(node)}")


def evaluate(source: Source, node: Expression, scope: dict[str, Any], arithmetic: Any) -> Any:
    """The value of an expression in some arithmetic: doubles, polynomials, or numbers with bounds on their errors."""
    if isinstance(node, str):
        if node in scope:
            return scope[node]
        return arithmetic.number(source.constants.get(node, node))
    operator, *operands = node
    if operator == "call":
        name, argument = operands
        value = evaluate(source, argument, scope, arithmetic)
        if name == "fabs":
            return arithmetic.magnitude(value)
        called = source.functions[name]
        return run(source, called, dict(zip(called.parameters, [value], strict=True)), arithmetic)
    if operator == "?":
        return arithmetic.choose(source, operands, scope)
    if operator in "<>=":
        return arithmetic.compare(node, source, scope)
    values = [evaluate(source, operand, scope, arithmetic) for operand in operands]
    if operator == "negative":
        return -values[0]
    a, b = values
    return {"+": lambda: a + b, "-": lambda: a - b, "*": lambda: a * b, "/": lambda: a / b}[operator]()


def run(source: Source, called: Function, scope: dict[str, Any], arithmetic: Any) -> Any:
    """What a function returns."""
    for name, expression in called.statements:
        scope[name] = evaluate(source, expression, scope, arithmetic)
    return evaluate(source, called.result, scope, arithmetic)


class Doubles:
    """Operations on arrays of doubles: what the compiled code computes, to the bit."""

    def number(self, text: str) -> Any:
        """A constant."""
        return np.float64(text)

    def magnitude(self, value: Any) -> Any:
        """Its magnitude."""
        return np.abs(value)

    def compare(self, node: Expression, source: Source, scope: dict[str, Any]) -> Any:
        """A comparison of numbers."""
        a, b = (evaluate(source, operand, scope, self) for operand in node[1:])
        return {"<": a < b, ">": a > b, "<=": a <= b, ">=": a >= b}[node[0]]

    def choose(self, source: Source, operands: list[Expression], scope: dict[str, Any]) -> Any:
        """One of two numbers."""
        return np.where(*(evaluate(source, operand, scope, self) for operand in operands))


def emulated(source: Source, y: Any, x: Any) -> Any:
    """The arctangent of arrays by the operations that are analysed."""
    with np.errstate(over="ignore", invalid="ignore", divide="ignore", under="ignore"):
        return run(source, source.functions["atan2"], {"y": y, "x": x}, Doubles())


# The analysis -----------------------------------------------------------------------------------------------------


class Case(NamedTuple):
    """The outcomes of the comparisons: |x| against |y| (-1, 0, +1), the signs, and whether t is above tan(pi/8)."""

    relation: int
    x_negative: bool
    y_negative: bool
    beyond: bool

    def holds(self, node: Expression) -> bool:
        """The outcome of a comparison of the source."""
        match node:
            case (">", "small", ("*", "TAN_EIGHTH", "large")):
                return self.beyond
            case (">", "ax", "ay"):
                return self.relation > 0
            case (">", "ay", "ax"):
                return self.relation < 0
            case ("<", "x", "0.0"):
                return self.x_negative
            case ("<", "y", "0.0"):
                return self.y_negative
            case (">", "below", "0.0"):
                return True
        raise NotProved(f"a comparison that is not understood: {node}")

    def turns(self) -> tuple[int, int]:
        """The true angle is the first number times pi/4, and the second (a sign) times the arctangent of q."""
        eighths, sign = (1 if self.beyond else 0), 1
        if self.relation < 0:
            eighths, sign = 2 - eighths, -sign
        if self.x_negative:
            eighths, sign = 4 - eighths, -sign
        return (-eighths, -sign) if self.y_negative else (eighths, sign)


class Box(NamedTuple):
    """The intervals of t, and of the larger magnitude."""

    t: tuple[float, float]
    large: tuple[float, float]

    def linear(self, form: tuple[int, int]) -> tuple[Fraction, Fraction]:
        """The range of a small + b large."""
        a, b = form
        corners = [Fraction(m) * (a * Fraction(t) + b) for t in self.t for m in self.large]
        return min(corners), max(corners)

    def halves(self) -> tuple[Box, Box]:
        """The box, cut where it is wider."""
        (t0, t1), (m0, m1) = self
        t, m = (t0 + t1) / 2.0, (m0 + m1) / 2.0
        if t1 - t0 >= m1 - m0:
            return Box((t0, t), self.large), Box((t, t1), self.large)
        return Box(self.t, (m0, m)), Box(self.t, (m, m1))


def widened(error: float) -> float:
    """A sum or product of errors, no smaller than in real numbers."""
    return error * WIDEN + FLOOR if error else 0.0


def half_unit(largest: Fraction) -> float:
    """Half a unit in the last place of the numbers up to this one, in units of 2^-53; 0 for 0."""
    if largest == 0:
        return 0.0
    if largest <= LEAST_NORMAL:
        return 2.0**-1022
    exponent = frexp(float(largest))[1]
    # A power of two is the end of the binade below it.
    if largest <= Fraction(2) ** (exponent - 1):
        exponent -= 1
    return 2.0 ** (exponent - 1)


def grain_of(lowest: float) -> int:
    """Numbers of at least this magnitude are multiples of 2 to this power."""
    return max(frexp(lowest)[1] - 53, -1074) if lowest else -1074


class Number:
    """A double of the source on a box: where it lies, and a bound on its error, in units of 2^-53.

    It is a multiple of 2^`grain`. `form` is (a, b) where it stands for a small + b large.
    """

    def __init__(self, low: float, high: float, error: float, grain: int, form: Any = None, box: Any = None) -> None:
        self.low, self.high, self.error, self.form, self.box = low, high, error, form, box
        lowest = 0.0 if low <= 0.0 <= high else min(abs(low), abs(high))
        self.grain = ANY_GRAIN if low == high == 0.0 else max(grain, grain_of(lowest))

    @property
    def largest(self) -> float:
        """The largest magnitude."""
        return max(abs(self.low), abs(self.high))

    def __neg__(self) -> Number:
        form = self.form and (-self.form[0], -self.form[1])
        return Number(-self.high, -self.low, self.error, self.grain, form, self.box)

    def __add__(self, other: Number) -> Number:
        grain = min(self.grain, other.grain)
        form = None
        if self.form and other.form and self.error == other.error == 0.0:
            form = self.form[0] + other.form[0], self.form[1] + other.form[1]
            low, high = self.box.linear(form)
        else:
            low, high = Fraction(self.low) + Fraction(other.low), Fraction(self.high) + Fraction(other.high)
        largest = max(abs(low), abs(high))
        exact = grain == ANY_GRAIN or largest <= Fraction(2) ** (grain + 53)
        error = self.error + other.error + (0.0 if exact else half_unit(largest))
        return Number(float(low), float(high), widened(error), grain, form, self.box)

    def __sub__(self, other: Number) -> Number:
        return self + -other

    def __mul__(self, other: Number) -> Number:
        if self is other:
            ends = [Fraction(self.low) ** 2, Fraction(self.high) ** 2]
            if self.low <= 0.0 <= self.high:
                ends.append(Fraction(0))
        else:
            ends = [Fraction(a) * Fraction(b) for a in (self.low, self.high) for b in (other.low, other.high)]
        grain = self.grain + other.grain
        largest = max(map(abs, ends))
        exact = largest == 0 or (grain >= -1074 and largest <= Fraction(2) ** (grain + 53))
        error = self.error * other.largest + self.largest * other.error + self.error * other.error * 2.0**-53
        error += 0.0 if exact else half_unit(largest)
        return Number(float(min(ends)), float(max(ends)), widened(error), max(grain, -1074))

    def __truediv__(self, other: Number) -> Number:
        """The quotient of two linear forms, which is monotone in t."""
        if not (self.form and other.form and other.low > 0.0):
            raise NotProved("a quotient that is not one of two linear forms with a positive denominator")
        (a, b), (c, d) = self.form, other.form
        ends = [(a * Fraction(t) + b) / (c * Fraction(t) + d) for t in self.box.t]
        largest = max(map(abs, ends))
        least = self.box.linear(other.form)[0]
        before = widened((self.error + up(largest) * other.error) / nextafter(float(least), 0.0))
        before = widened(before / (1.0 - other.error * 2.0**-53 / other.low)) if other.error else before
        error = widened(before + half_unit(largest + Fraction(before) / SCALE))
        low, high = min(ends) - Fraction(error) / SCALE, max(ends) + Fraction(error) / SCALE
        if before == 0.0:
            low, high = min(ends), max(ends)
        return Number(float(low), float(high), error, -1074, (self.form, other.form), self.box)


def up(number: Fraction) -> float:
    """A double that is no smaller."""
    return nextafter(float(number), inf)


class OfCase:
    """Arithmetics in which a case knows the outcomes of comparisons."""

    def __init__(self, case: Case) -> None:
        self.case = case

    def compare(self, node: Expression, source: Source, scope: dict[str, Any]) -> Expression:
        """The comparison itself."""
        return node

    def choose(self, source: Source, operands: list[Expression], scope: dict[str, Any]) -> Any:
        """The number for the outcome of the case."""
        condition, first, second = operands
        outcome = self.case.holds(evaluate(source, condition, scope, self))
        return evaluate(source, first if outcome else second, scope, self)


class Bounds(OfCase):
    """Numbers with bounds on their errors, on a box."""

    def number(self, text: str) -> Number:
        """A constant, which is exact."""
        value = float(text)
        numerator = abs(Fraction(value).numerator)
        grain = (numerator & -numerator).bit_length() - 1 - Fraction(value).denominator.bit_length() + 1
        return Number(value, value, 0.0, grain)

    def magnitude(self, value: Number) -> Number:
        """Its magnitude."""
        return value if value.low >= 0.0 else -value

    def compare(self, node: Expression, source: Source, scope: dict[str, Any]) -> Expression:
        """The comparison itself, of a denominator only if it cannot vanish."""
        if node == (">", "below", "0.0") and not scope["below"].low > 0.0:
            raise NotProved("a denominator may vanish")
        return node


class Polynomials(OfCase):
    """Polynomials in q with rational coefficients: what the source means from q on, without rounding."""

    def number(self, text: str) -> Any:
        """A constant."""
        return flint.fmpq_poly([flint.fmpq(*float(text).as_integer_ratio())])


def split_at_q(source: Source) -> tuple[list[tuple[str, Expression]], Function]:
    """The statements up to q, and the rest as a function of q."""
    called = source.functions["atan2"]
    names = [name for name, _ in called.statements]
    if names.count("q") != 1:
        raise NotProved("there is no single q")
    position = names.index("q") + 1
    return called.statements[:position], Function(["q"], called.statements[position:], called.result)


# The two quotients that q may be: small / large, or (small - large) / (small + large).
QUOTIENTS = {False: ((1, 0), (0, 1)), True: ((1, -1), (1, 1))}


class Meaning(NamedTuple):
    """What a case means without rounding: its sign times a polynomial in q, and the error of its constant, of pi."""

    constant: float
    approximation: float


def meaning(source: Source, case: Case) -> Meaning:
    """The errors, in units of 2^-53, that are not rounding: of the constants, and of the polynomial in units of |q|."""
    arb = flint.arb
    before, rest = split_at_q(source)
    scope = {name: expression for name, expression in before if expression[0] in "<>="}
    whole = run(source, rest, {**scope, "q": flint.fmpq_poly([0, 1])}, Polynomials(case))
    coefficients = [Fraction(int(c.p), int(c.q)) for c in whole.coeffs()]
    eighths, sign = case.turns()
    constant = arb(flint.fmpq(coefficients[0].numerator, coefficients[0].denominator)) - eighths * arb.pi() / 4
    core = tuple(sign * c for c in coefficients[1:])
    if any(core[1::2]):
        raise NotProved("the polynomial has even powers of q")
    return Meaning(up_of(abs(constant)), approximation(core[::2]))


def up_of(ball: Any) -> float:
    """An upper bound of a ball in units of 2^-53."""
    return nextafter(float((ball * 2**53).upper()), inf) * WIDEN


KNOWN: dict[tuple[Fraction, ...], float] = {}
TERMS = 80


def approximation(coefficients: tuple[Fraction, ...]) -> float:
    """A bound on |sum c_k z^k - atan(q)/q|, z = q^2 up to REACH^2, in units of 2^-53.

    The difference of the two series, of which the terms past `TERMS` are below the next one, is expanded about the
    middle of each of 200 intervals, so that little is lost by evaluating it on the interval.
    """
    if coefficients not in KNOWN:
        arb, fmpq = flint.arb, flint.fmpq
        series = [Fraction((-1) ** k, 2 * k + 1) for k in range(TERMS)]
        padded = [*coefficients, *([Fraction(0)] * (TERMS - len(coefficients)))]
        differences = [c - s for c, s in zip(padded, series, strict=True)]
        polynomial = flint.fmpq_poly([fmpq(d.numerator, d.denominator) for d in differences])
        tail = Fraction(1, 2 * TERMS + 1) * REACH ** (2 * TERMS)
        cells, worst = 200, arb(0)
        width = REACH * REACH / cells
        for i in range(cells):
            middle = width * i + width / 2
            shifted = polynomial(flint.fmpq_poly([fmpq(middle.numerator, middle.denominator), 1]))
            radius = arb(0, float(width) * 0.5 * WIDEN)
            value = arb(0)
            for c in reversed(shifted.coeffs()):
                value = value * radius + arb(c)
            worst = worst.max(abs(value))
        KNOWN[coefficients] = up_of(worst + arb(fmpq(tail.numerator, tail.denominator)))
    return KNOWN[coefficients]


def error_on(source: Source, case: Case, box: Box, known: Meaning) -> tuple[float, float]:
    """Bounds on a box: of the error of the angle in units of 2^-53, and of the angle from below."""
    arithmetic = Bounds(case)
    forms = {"small": (1, 0), "large": (0, 1)}
    magnitudes = {name: Number(*map(float, box.linear(form)), 0.0, -1074, form, box) for name, form in forms.items()}
    names = ("large", "small") if case.relation > 0 else ("small", "large")
    x, y = (magnitudes[name] for name in names)
    scope: dict[str, Any] = {"x": -x if case.x_negative else x, "y": -y if case.y_negative else y}
    before, rest = split_at_q(source)
    for name, expression in before:
        scope[name] = evaluate(source, expression, scope, arithmetic)
    q = scope["q"]
    if q.form != QUOTIENTS[case.beyond]:
        raise NotProved(f"q is not the quotient that it should be: {q.form}")
    if not q.largest <= REACH:
        raise NotProved("q is beyond the polynomial")
    scope["q"] = Number(q.low, q.high, 0.0, q.grain)
    computed = run(source, rest, scope, arithmetic)
    # The slope of the arctangent between the exact q and the computed one.
    nearest = 0.0 if q.low <= 0.0 <= q.high else min(abs(q.low), abs(q.high))
    nearest = max(nearest - q.error * 2.0**-52, 0.0)
    slope = 1.0 / (1.0 + nearest * nearest) * WIDEN
    error = widened(computed.error + known.constant + known.approximation * q.largest + q.error * slope)
    return error, angle_from_below(case, box)


def angle_from_below(case: Case, box: Box) -> float:
    """The least magnitude of the true angle on a box."""
    arb = flint.arb
    least = inf
    for t in box.t:
        angle = arb(t).atan()
        angle = arb.pi() / 2 - angle if case.relation < 0 else angle
        angle = arb.pi() - angle if case.x_negative else angle
        least = min(least, float(angle.lower()) / WIDEN)
    return max(least, 0.0)


def cases() -> Iterator[Case]:
    """All outcomes of the comparisons."""
    for relation, x, y, beyond in product((-1, 0, 1), (False, True), (False, True), (False, True)):
        yield Case(relation, x, y, beyond)


def boxes(source: Source, case: Case) -> Iterator[Box]:
    """The boxes to begin with: for t below 1/8 one for each power of two, on which units in the last place are alike.

    The product with tan(pi/8) is rounded, so that t on either side of that may have either outcome.
    """
    every = (1.0, 2.0)
    limit = float(source.constants["TAN_EIGHTH"])
    if case.relation == 0:
        if case.beyond:
            yield Box((1.0, 1.0), every)
    elif case.beyond:
        yield Box((nextafter(limit, 0.0), 0.5), every)
        yield Box((0.5, 1.0), every)
    else:
        yield Box((0.25, nextafter(limit, 1.0)), every)
        if case.turns()[0]:
            yield Box((0.0, 0.25), every)
            return
        for k in range(2, 1022):
            yield Box((2.0 ** -(k + 1), 2.0**-k), every)
        yield Box((0.0, 2.0**-1022), every)


def proved(source: Source, bound: float = BOUND) -> dict[Case, float]:
    """The largest error of each case in units of 2^-52 of the angle, where t >= 2^-1022; `NotProved` above the bound.

    Below, the angle itself may be subnormal: there the error is shown to be at most 2^-1074, or within the bound.
    """
    worst: dict[Case, float] = {}
    for case in cases():
        with flint.ctx.workprec(200):
            known = meaning(source, case)
        open_boxes = list(boxes(source, case))
        while open_boxes:
            box = open_boxes.pop()
            error, angle = error_on(source, case, box, known)
            ratio = 0.5 * error / angle * WIDEN if angle > 0.0 else inf
            if ratio <= bound:
                worst[case] = max(worst.get(case, 0.0), ratio)
            elif box.t[0] == 0.0 and error <= 2.0**-1021:
                continue
            elif max(box.t[1] - box.t[0], box.large[1] - box.large[0]) < NARROWEST:
                raise NotProved(f"{ratio} units of 2^-52 for {case} on {box}")
            else:
                open_boxes += box.halves()
    return worst


# A text of the C, and what stands there in the mutant; the coefficients have mutants of their own.
MUTANTS = [
    ("(beyond ? 0.25 * 3.141592653589793 : 0.0)", "(beyond ? 0.25 * 3.14159265358979 : 0.0)"),
    ("0.5 * 3.141592653589793 - a", "0.5 * 3.141592653589794 - a"),
    ("x < 0.0 ? 3.141592653589793 - a", "x < 0.0 ? 3.141592653589794 - a"),
    ("y < 0.0 ? -a : a", "y < 0.0 ? a : -a"),
    ("ay > ax ? 0.5", "ax > ay ? 0.5"),
    ("#define TAN_EIGHTH 0.41421356237309515", "#define TAN_EIGHTH 0.4143"),
    ("#define TAN_EIGHTH 0.41421356237309515", "#define TAN_EIGHTH 0.4141"),
    ("beyond = small > TAN_EIGHTH * large", "beyond = small > 0.4142 * large"),
    ("beyond = small > TAN_EIGHTH * large", "beyond = large > TAN_EIGHTH * small"),
    ("beyond ? small - large : small", "beyond ? large - small : small"),
    ("beyond ? small + large : large", "beyond ? small + large : small"),
    ("below > 0.0 ? below : 1.0", "below > 0.5 ? below : 1.0"),
    ("q + q * _atan(q * q) +", "(q + 4.0) - 4.0 + q * _atan(q * q) +"),
    ("q + q * _atan(q * q) +", "q * (1.0 + _atan(q * q)) +"),
    ("q + q * _atan(q * q) +", "q + q * _atan(q) +"),
    ("z * (low + middle * z4", "z * (low - middle * z4"),
    ("const real z4 = z2 * z2;", "const real z4 = z2 * z;"),
    ("real a = q +", "if (q > 0.3) { return 1.0; } real a = q +"),
]


def mutants(text: str) -> Iterator[tuple[str, str]]:
    """Each change, and the C with it: those above, and each coefficient off by 2^-50 z^-k for the largest z."""
    for old, new in MUTANTS:
        if text.count(old) != 1:
            raise ValueError(old)
        yield f"{old} -> {new}", text.replace(old, new)
    body = text[text.index("real _atan(real z)") :].partition("return")[0]
    coefficients = re.findall(r"-?\d\.\d+", body)
    for k, digits in enumerate(coefficients, 1):
        changed = repr(float(digits) + 2.0**-50 / float(REACH) ** (2 * k))
        yield f"{digits} -> {changed}", text.replace(digits, changed)


def refusal(text: str) -> str:
    """Why a source has no proof; empty where it has one."""
    try:
        proved(read(text, "branchless_atan2"))
    except NotProved as error:
        return str(error)
    return ""


def main() -> int:
    """Print the bounds of each case, and what is said of each mutant; the exit code is 1 if one is not refused."""
    text = C.read_text("utf-8")
    source = read(text, "branchless_atan2")
    if read(PAGE.read_text("utf-8"), "atan2") != source:
        raise NotProved("the page computes another arctangent")
    worst = proved(source)
    print(f"{C.relative_to(ROOT)}, and the page: at most {max(worst.values()):.3f} units of 2^-52 of the angle")
    for case, value in worst.items():
        print(f"  {value:.3f}  {case}")
    refusals = {change: refusal(changed) for change, changed in mutants(text)}
    for change, reason in refusals.items():
        print(f"{change}: {reason or 'PROVED'}")
    return 0 if all(refusals.values()) else 1


if __name__ == "__main__":
    sys.exit(main())
