"""Expressions of Python as expressions of C, with their kinds."""

from __future__ import annotations

import ast
import math
import re
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from enum import EnumType
from types import FunctionType
from typing import Any, NamedTuple

from codegen.arithmetic import Arithmetic
from codegen.kinds import (
    INTEGER,
    NOTHING,
    REAL,
    REALS,
    TRUTH,
    Kind,
    NotTranslated,
    kind_of_type,
    kind_of_value,
    ring_of,
    safe,
    tuple_of,
)

# How tightly the operators of C bind.
PRIMARY, UNARY, PRODUCT, SUM, ORDER, EQUALITY, AND, OR, CHOICE = 12, 11, 10, 9, 7, 6, 4, 3, 2

OPERATORS = {ast.Add: ("+", SUM), ast.Sub: ("-", SUM), ast.Mult: ("*", PRODUCT), ast.Div: ("/", PRODUCT)}
BITS = {ast.BitAnd: "&", ast.BitOr: "|", ast.RShift: ">>"}
COMPARED = {
    ast.Lt: ("<", ORDER),
    ast.LtE: ("<=", ORDER),
    ast.Gt: (">", ORDER),
    ast.GtE: (">=", ORDER),
    ast.Eq: ("==", EQUALITY),
    ast.NotEq: ("!=", EQUALITY),
}


# The parameter of functions that fill rings in place: a pointer to the structure of all rings.
RINGS = "rings"


class Expression(NamedTuple):
    """An expression of C: its text, its kind, and how tightly its outermost operator binds."""

    text: str
    kind: Kind
    level: int = PRIMARY

    def within(self, level: int) -> str:
        """The text as an operand of an operator that binds as tightly as this."""
        return self.text if self.level >= level else f"({self.text})"


class Names(NamedTuple):
    """What an expression may refer to: functions and constants, which the unit provides, and local variables.

    Those of `by_address` are pointers; `changed` is the parameter that a function changes where it is.
    """

    arithmetic: Arithmetic
    globals: dict[str, Any]
    local: dict[str, Kind]
    replaced: dict[str, Any]
    function: Callable[[FunctionType], tuple[str, dict[str, Kind], Kind]]
    constant: Callable[[str, Any], Expression]
    by_address: frozenset[str] = frozenset()
    changed: str = ""


class Expressions:
    """The translation of expressions within one function to C; another language overrides what it writes otherwise."""

    compared = COMPARED
    both, either, inverse = " && ", " || ", "!"

    def __init__(self, names: Names, file: str) -> None:
        self.names = names
        self.file = file
        # Statements that must stand before the one that is translated now.
        self.before: list[str] = []
        self.temporaries = 0
        self.is_lazy = False

    def refused(self, node: ast.AST, what: str) -> NotTranslated:
        """The error for a node."""
        return NotTranslated(
            f"{self.file}:{getattr(node, 'lineno', 0)}: {what} is not part of the kernel's subset of Python"
        )

    def translate(self, node: ast.expr) -> Expression:
        """An expression."""
        method = getattr(self, f"_{type(node).__name__}", None)
        if method is None:
            raise self.refused(node, f"the expression {ast.unparse(node)!r}")
        found: Expression = method(node)
        return found

    def condition(self, node: ast.expr) -> Expression:
        """An expression as a truth value; a number is true unless it is zero."""
        if isinstance(node, ast.BoolOp):
            return self._BoolOp(node)
        found = self.translate(node)
        if found.kind == TRUTH:
            return found
        if found.kind in (INTEGER, REAL):
            sign, level = self.compared[ast.NotEq]
            return Expression(f"{found.within(level + 1)} {sign} {self.zero(found.kind)}", TRUTH, level)
        raise self.refused(node, f"{ast.unparse(node)!r} as a condition")

    def zero(self, kind: Kind) -> str:
        """Zero of a kind."""
        return "0" if kind == INTEGER else self.literal(0.0)

    def literal(self, value: float) -> str:
        """A number of the arithmetic."""
        known = self.names.arithmetic
        if math.isnan(value):
            return known.functions.get("nan", "NAN")
        if math.isinf(value):
            return ("" if value > 0 else "-") + known.functions.get("inf", "INFINITY")
        return f"{known.prefix}{value!r}{known.suffix}"

    def as_real(self, found: Expression) -> Expression:
        """An expression as a real number; C would convert an integer without a word, but C++ and warnings do not."""
        return Expression(self.real(found), REAL, UNARY) if found.kind == INTEGER else found

    def of_kind(self, kind: Kind, found: Expression) -> Expression:
        """An expression as a value of a kind."""
        return self.as_real(found) if kind == REAL else found

    def temporary(self, found: Expression, stem: str, is_constant: bool = True) -> str:
        """The name of a new constant, or of a variable, with this value."""
        if self.is_lazy:
            raise NotTranslated(
                f"{self.file}: a structure is taken apart where it may not be computed, in {found.text!r}"
            )
        self.temporaries += 1
        name = f"{stem}_{self.temporaries}"
        self.before.append(f"{self.declared(found.kind, is_constant)} {name} = {found.text};")
        return name

    def declared(self, kind: Kind, is_constant: bool) -> str:
        """What stands before the name of a variable where it is declared."""
        return f"const {kind.name}" if is_constant else kind.name

    def field(self, text: str, kind: Kind, name: str) -> str:
        """A field of a structure of a kind."""
        return f"{text}->{name}" if kind.length and self.names.arithmetic.in_place else f"{text}.{name}"

    def real(self, integer: Expression) -> str:
        """An integer as a real number."""
        return f"(real){integer.within(UNARY)}"

    def member(self, enum: EnumType, name: str) -> str:
        """A member of an enumeration."""
        return f"{enum.__name__.upper()}_{name}"

    def ring_call(self, kind: Kind, change: str, *arguments: Expression) -> str:
        """A call of a function that makes or changes a ring."""
        place = [f"&{RINGS}->{kind.name}"] if change == "filled" and self.names.arithmetic.in_place else []
        return f"{kind.name}_{change}({', '.join([*place, *(argument.text for argument in arguments)])})"

    def parts(self, node: ast.expr) -> list[Expression]:
        """The elements of an expression that is a tuple."""
        if isinstance(node, ast.Tuple):
            return [self.translate(one) for one in node.elts]
        if isinstance(node, ast.IfExp) and isinstance(node.body, ast.Tuple):
            return self._chosen_parts(node)
        found = self.translate(node)
        if not found.kind.fields:
            raise self.refused(node, f"{ast.unparse(node)!r} as a tuple")
        name = found.text
        if not isinstance(node, ast.Name | ast.Attribute):
            stem = node.func.id if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) else "parts"
            name = self.temporary(found, stem)
        return [Expression(self.field(name, found.kind, field), kind) for field, kind in found.kind.fields]

    def _chosen_parts(self, node: ast.IfExp) -> list[Expression]:
        """The elements of a choice between two tuples, each chosen by itself."""
        test = self.condition(node.test)
        if not isinstance(node.test, ast.Name):
            test = Expression(self.temporary(Expression(test.text, TRUTH), "chosen"), TRUTH)
        with self.lazily():
            pairs = list(zip(self.parts(node.body), self.parts(node.orelse), strict=True))
        return [self.choice(test, a, b) for a, b in pairs]

    def choice(self, test: Expression, a: Expression, b: Expression) -> Expression:
        """The first of two values of one kind where a condition holds, otherwise the second."""
        text = f"{test.within(CHOICE + 1)} ? {a.within(CHOICE + 1)} : {b.within(CHOICE)}"
        return Expression(text, a.kind, CHOICE)

    @contextmanager
    def lazily(self) -> Iterator[None]:
        """Within this, an expression may not be computed at all."""
        outer, self.is_lazy = self.is_lazy, True
        yield
        self.is_lazy = outer

    def structure(self, kind: Kind, values: list[Expression]) -> Expression:
        """A structure made from its fields."""
        texts = (self.of_kind(inner, value).text for (_, inner), value in zip(kind.fields, values, strict=True))
        return Expression(f"{self.names.arithmetic.made.format(kind.name)}{{{', '.join(texts)}}}", kind)

    def as_result(self, node: ast.expr, found: Expression, kind: Kind) -> Expression:
        """A tuple as the structure that a function returns."""
        if isinstance(node, ast.Tuple):
            return self.structure(kind, [self.translate(one) for one in node.elts])
        made = self.names.arithmetic.made
        return Expression(found.text.replace(made.format(found.kind.name), made.format(kind.name), 1), kind)

    def constant(self, kind: Kind, values: list[Expression]) -> Expression:
        """A structure that initialises a constant."""
        return Expression(f"{{{', '.join(value.text for value in values)}}}", kind)

    def _Constant(self, node: ast.Constant) -> Expression:
        if isinstance(node.value, bool):
            return Expression("true" if node.value else "false", TRUTH)
        if isinstance(node.value, int):
            return Expression(str(node.value), INTEGER)
        if isinstance(node.value, float):
            return Expression(self.literal(node.value), REAL)
        raise self.refused(node, f"the constant {node.value!r}")

    def _Name(self, node: ast.Name) -> Expression:
        if node.id in self.names.by_address:
            return Expression(f"(*{safe(node.id)})", self.names.local[node.id])
        if node.id in self.names.local:
            return Expression(safe(node.id), self.names.local[node.id])
        if node.id not in self.names.globals:
            raise self.refused(node, f"the name {node.id!r} without a value")
        value = self.names.globals[node.id]
        if getattr(math, node.id, None) is value and isinstance(value, float):
            level = PRIMARY if value >= 0.0 or math.isnan(value) else UNARY
            return Expression(self.literal(value), REAL, level)
        return self.names.constant(node.id, self.names.globals)

    def _Attribute(self, node: ast.Attribute) -> Expression:
        if isinstance(node.value, ast.Name) and isinstance(self.names.globals.get(node.value.id), EnumType):
            return Expression(self.member(self.names.globals[node.value.id], node.attr), INTEGER)
        found = self.translate(node.value)
        kinds = dict(found.kind.fields)
        if safe(node.attr) not in kinds or found.kind.is_tuple:
            raise self.refused(node, f"the attribute {ast.unparse(node)!r}")
        return Expression(f"{found.within(PRIMARY)}.{safe(node.attr)}", kinds[safe(node.attr)])

    def _Subscript(self, node: ast.Subscript) -> Expression:
        array = self.translate(node.value)
        if array.kind.length:
            return self._ring_element(array, node)
        index = self.translate(node.slice)
        if array.kind != REALS or index.kind != INTEGER:
            raise self.refused(node, f"{ast.unparse(node)!r}")
        return Expression(f"{array.text}[{index.text}]", REAL)

    def _ring_element(self, ring: Expression, node: ast.Subscript) -> Expression:
        """An element of a ring; negative constants count from its end."""
        ((_, element),) = ring.kind.fields
        match node.slice:
            case ast.UnaryOp(op=ast.USub(), operand=ast.Constant(value=int(back))):
                index = Expression(str(ring.kind.length - back), INTEGER)
            case _:
                index = self.translate(node.slice)
        if index.kind != INTEGER:
            raise self.refused(node, f"{ast.unparse(node)!r}")
        return Expression(f"{self.field(ring.within(PRIMARY), ring.kind, 'at')}[{index.text}]", element)

    def _changed_ring(self, node: ast.Tuple) -> Expression:
        """A ring with another last element, `(*ring[:-1], x)`, or without its first one too: `(*ring[1:], x)`."""
        match node.elts:
            case [ast.Starred(value=ast.Subscript(value=source, slice=ast.Slice() as part)), last]:
                ring, change = self.translate(source), {"1:": "appended", ":-1": "with_last"}.get(ast.unparse(part))
                if ring.kind.length and change:
                    return Expression(self.ring_call(ring.kind, change, ring, self.translate(last)), ring.kind)
        raise self.refused(node, f"{ast.unparse(node)!r}")

    def _filled_ring(self, node: ast.BinOp) -> Expression:
        """A ring of equal elements: `(x,) * LENGTH`."""
        match node:
            case ast.BinOp(left=ast.Tuple(elts=[one]), right=ast.Name(id=name)):
                element, length = self.translate(one), self.names.globals.get(name)
                if isinstance(length, int):
                    kind = ring_of(element.kind, length)
                    return Expression(self.ring_call(kind, "filled", element), kind)
        raise self.refused(node, f"{ast.unparse(node)!r}")

    def _Tuple(self, node: ast.Tuple) -> Expression:
        if any(isinstance(one, ast.Starred) for one in node.elts):
            return self._changed_ring(node)
        values = [self.translate(one) for one in node.elts]
        return self.structure(tuple_of(tuple(value.kind for value in values)), values)

    def _UnaryOp(self, node: ast.UnaryOp) -> Expression:
        if isinstance(node.op, ast.Not):
            return Expression(f"{self.inverse}{self.condition(node.operand).within(UNARY)}", TRUTH, UNARY)
        found = self.translate(node.operand)
        if isinstance(node.op, ast.USub) and found.kind in (REAL, INTEGER):
            operand = found.within(UNARY)
            return Expression(f"-({operand})" if operand.startswith("-") else f"-{operand}", found.kind, UNARY)
        if isinstance(node.op, ast.Invert) and found.kind == INTEGER:
            return Expression(f"~{found.within(UNARY)}", INTEGER, UNARY)
        raise self.refused(node, f"{ast.unparse(node)!r}")

    def _BinOp(self, node: ast.BinOp) -> Expression:
        if isinstance(node.op, ast.Mult) and isinstance(node.left, ast.Tuple):
            return self._filled_ring(node)
        a, b, operator = self.translate(node.left), self.translate(node.right), type(node.op)
        if not {a.kind, b.kind} <= {REAL, INTEGER}:
            raise self.refused(node, f"{ast.unparse(node)!r}")
        whole = a.kind == b.kind == INTEGER
        if operator in OPERATORS:
            sign, level = OPERATORS[operator]
            if not whole or operator is ast.Div:
                a, b = self.as_real(a), self.as_real(b)
            kind = INTEGER if whole and operator is not ast.Div else REAL
            return Expression(f"{a.within(level)} {sign} {b.within(level + 1)}", kind, level)
        if operator is ast.Mod and not whole:
            return Expression(f"real_modulo({self.as_real(a).text}, {self.as_real(b).text})", REAL)
        helpers = {ast.LShift: "shift_left", ast.Mod: "integer_modulo", ast.FloorDiv: "integer_quotient"}
        if whole and operator in helpers:
            return Expression(f"{helpers[operator]}({a.text}, {b.text})", INTEGER)
        if whole and operator in BITS:
            # In parentheses, since the precedence of C's operators on bits is not Python's.
            return Expression(f"({a.within(UNARY)} {BITS[operator]} {b.within(UNARY)})", INTEGER)
        raise self.refused(node, f"{ast.unparse(node)!r}")

    def _BoolOp(self, node: ast.BoolOp) -> Expression:
        sign, level = (self.both, AND) if isinstance(node.op, ast.And) else (self.either, OR)
        first, *others = node.values
        texts = [self.condition(first).within(EQUALITY)]
        with self.lazily():
            texts += [self.condition(one).within(EQUALITY) for one in others]
        return Expression(sign.join(texts), TRUTH, level)

    def _Compare(self, node: ast.Compare) -> Expression:
        operands = [node.left, *node.comparators]
        if any(isinstance(op, ast.In) for op in node.ops):
            return self._member(node)
        if any(not isinstance(one, ast.Name | ast.Attribute | ast.Constant | ast.UnaryOp) for one in operands[1:-1]):
            raise self.refused(node, f"the comparison {ast.unparse(node)!r} with a computed value in its middle")
        values = [self.translate(one) for one in operands]
        texts = []
        for a, op, b in zip(values, node.ops, values[1:], strict=False):
            if type(op) not in self.compared or not {a.kind, b.kind} <= {REAL, INTEGER, TRUTH}:
                raise self.refused(node, f"the comparison {ast.unparse(node)!r}")
            sign, level = self.compared[type(op)]
            if REAL in (a.kind, b.kind):
                a, b = self.as_real(a), self.as_real(b)
            texts.append(f"{a.within(level + 1)} {sign} {b.within(level + 1)}")
        level = self.compared[type(node.ops[0])][1] if len(texts) == 1 else AND
        return Expression(self.both.join(texts), TRUTH, level)

    def _member(self, node: ast.Compare) -> Expression:
        """Whether a value is one of a few: `x in (a, b)`."""
        (choices,) = node.comparators
        if not isinstance(choices, ast.Tuple) or not isinstance(node.left, ast.Name):
            raise self.refused(node, f"{ast.unparse(node)!r}")
        value = self.translate(node.left)
        sign, level = self.compared[ast.Eq]
        texts = [f"{value.text} {sign} {self.translate(one).within(level + 1)}" for one in choices.elts]
        return Expression(self.either.join(texts), TRUTH, OR)

    def _IfExp(self, node: ast.IfExp) -> Expression:
        if isinstance(node.body, ast.Tuple):
            values = self._chosen_parts(node)
            return self.structure(tuple_of(tuple(value.kind for value in values)), values)
        if isinstance(node.orelse, ast.Tuple):
            raise self.refused(node, f"the choice {ast.unparse(node)!r} with a tuple as its second part only")
        test = self.condition(node.test)
        with self.lazily():
            a, b = self.translate(node.body), self.translate(node.orelse)
        kind = REAL if {a.kind, b.kind} == {REAL, INTEGER} else a.kind
        if kind != a.kind and kind != b.kind:
            raise self.refused(node, f"the choice {ast.unparse(node)!r} between two kinds")
        a, b = self.of_kind(kind, a), self.of_kind(kind, b)
        return self.choice(test, a, b)._replace(kind=kind)

    def _changed(self, node: ast.Call, structure: ast.expr) -> Expression:
        """A structure with other values of some fields: `structure._replace(field=value)`."""
        found, values = self.translate(structure), {}
        for name, value in ((safe(str(keyword.arg)), keyword.value) for keyword in node.keywords):
            if name not in dict(found.kind.fields):
                raise self.refused(node, f"the field {name!r} in {ast.unparse(node)!r}")
            values[name] = self.of_kind(dict(found.kind.fields)[name], self.translate(value))
        return self.changed(found, values)

    def changed(self, found: Expression, values: dict[str, Expression]) -> Expression:
        """A structure with other values of some fields."""
        name = self.temporary(found, "changed", is_constant=False)
        self.before += [f"{name}.{field} = {value.text};" for field, value in values.items()]
        return Expression(name, found.kind)

    def _Call(self, node: ast.Call) -> Expression:
        if isinstance(node.func, ast.Attribute) and node.func.attr == "_replace":
            return self._changed(node, node.func.value)
        if not isinstance(node.func, ast.Name) or node.func.id in self.names.local:
            raise self.refused(node, f"the call {ast.unparse(node)!r}")
        name = node.func.id
        called = self.names.replaced.get(name, self.names.globals.get(name))
        arguments = [value for one in node.args for value in self._argument(one)]
        if called is None and hasattr(self, f"_call_{name}"):
            found: Expression = getattr(self, f"_call_{name}")(node, arguments)
            return found
        if isinstance(called, type) and issubclass(called, tuple):
            return self._constructed(node, called, arguments)
        if isinstance(called, FunctionType):
            title, kinds, arguments, result = self._with_all(node, called, arguments)
            at = next((i for i, kind in enumerate(kinds) if kind.is_changed), None)
            if at is not None:
                is_fresh = re.fullmatch(r"changed_\d+", arguments[at].text)
                name = arguments[at].text if is_fresh else self.temporary(arguments[at], "changed", is_constant=False)
                arguments[at] = Expression(name, result)
                self.before.append(f"{title}({', '.join(self._texts(title, kinds, arguments))});")
                return arguments[at]
            return Expression(f"{title}({', '.join(self._texts(title, kinds, arguments))})", result)
        if called is not None and getattr(math, name, None) is called:
            return self._of_math(node, name, arguments)
        raise self.refused(node, f"the call {ast.unparse(node)!r}")

    def _argument(self, node: ast.expr) -> list[Expression]:
        """The values of an argument: of several where it is starred."""
        return self.parts(node.value) if isinstance(node, ast.Starred) else [self.translate(node)]

    def _defaults(self, node: ast.Call, called: FunctionType, names: list[str], given: int) -> list[Expression]:
        """The arguments after the `given` ones: by keyword, or by default."""
        keywords = {keyword.arg: self.translate(keyword.value) for keyword in node.keywords}
        defaults = dict(zip(reversed(names), reversed(called.__defaults__ or ()), strict=False))
        values = []
        for name in names[given:]:
            if name not in keywords and name not in defaults:
                raise self.refused(node, f"the call {ast.unparse(node)!r} without {name!r}")
            values.append(keywords[name] if name in keywords else Expression(str(defaults[name]), INTEGER, UNARY))
        return values

    def _with_all(
        self, node: ast.Call, called: FunctionType, arguments: list[Expression]
    ) -> tuple[str, list[Kind], list[Expression], Kind]:
        """The name of a function, the kinds of its parameters, all arguments, and the kind of its result."""
        title, parameters, result = self.names.function(called)
        if RINGS in parameters:
            arguments.insert(0, Expression(RINGS, parameters[RINGS]))
        arguments += self._defaults(node, called, list(parameters), len(arguments))
        return title, list(parameters.values()), arguments, result

    def _texts(self, title: str, kinds: list[Kind], arguments: list[Expression]) -> list[str]:
        """The arguments of a call."""
        pairs = list(zip(kinds, arguments, strict=True))
        for kind, argument in pairs:
            if kind.value != argument.kind and (kind, argument.kind) not in ((REAL, INTEGER), (INTEGER, TRUTH)):
                raise NotTranslated(f"{self.file}: {title} is called with {argument.text!r}, which is no {kind.name}")
        return [self.address(one) if kind.by_address else self.of_kind(kind, one).text for kind, one in pairs]

    def change(self, node: ast.Call) -> str:
        """The call of a function that changes its first argument, a variable, where it is; empty for another call."""
        name = node.func.id if isinstance(node.func, ast.Name) else ""
        called = self.names.replaced.get(name, self.names.globals.get(name))
        if not isinstance(called, FunctionType) or not any(
            k.is_changed for k in self.names.function(called)[1].values()
        ):
            return ""
        arguments = [value for one in node.args for value in self._argument(one)]
        title, kinds, arguments, _ = self._with_all(node, called, arguments)
        return f"{title}({', '.join(self._texts(title, kinds, arguments))});"

    def address(self, found: Expression) -> str:
        """The address of a structure, which is stored first unless it is already."""
        if parameter := re.fullmatch(r"\(\*(\w+)\)", found.text):
            return parameter.group(1)
        is_stored = re.fullmatch(r"(\w+|\(\*\w+\))(\.\w+)*", found.text)
        return f"&{found.text if is_stored else self.temporary(found, 'stored')}"

    def _constructed(self, node: ast.Call, called: type, arguments: list[Expression]) -> Expression:
        kind = kind_of_type(called, f"{self.file}:{node.lineno}")
        if node.keywords:
            given = {str(keyword.arg): self.translate(keyword.value) for keyword in node.keywords}
            arguments += [given[name] for name in called._fields[len(arguments) :]]  # type: ignore[attr-defined]
        if len(arguments) != len(kind.fields):
            raise self.refused(node, f"{called.__name__} with {len(arguments)} of {len(kind.fields)} fields")
        return self.structure(kind, arguments)

    def _of_math(self, node: ast.Call, name: str, arguments: list[Expression]) -> Expression:
        texts = ", ".join(self.as_real(argument).text for argument in arguments)
        if name == "isfinite":
            return Expression(f"isfinite({texts})", TRUTH)
        if name in ("degrees", "radians"):
            # As Python's: a product with this constant.
            (angle,) = arguments
            size = self.literal(180.0 / math.pi if name == "degrees" else math.pi / 180.0)
            return Expression(f"{angle.within(PRODUCT)} * {size}", REAL, PRODUCT)
        if name not in self.names.arithmetic.functions:
            raise self.refused(node, f"the function {name!r} of math")
        call = f"{self.names.arithmetic.functions[name]}({texts})"
        # Python's `ceil` gives an integer; so does its `floor`, which the kernel uses as a real number only.
        return Expression(f"integer_of({call})", INTEGER) if name == "ceil" else Expression(call, REAL)

    def _call_min(self, node: ast.Call, arguments: list[Expression]) -> Expression:
        return self._folded("min", arguments)

    def _call_max(self, node: ast.Call, arguments: list[Expression]) -> Expression:
        return self._folded("max", arguments)

    def _folded(self, name: str, arguments: list[Expression]) -> Expression:
        """The least or largest of several, compared from left to right as Python does."""
        kind = INTEGER if all(argument.kind == INTEGER for argument in arguments) else REAL
        text, *others = (self.of_kind(kind, argument).text for argument in arguments)
        for other in others:
            text = f"{name}_{kind.name}({text}, {other})"
        return Expression(text, kind)

    def _call_abs(self, node: ast.Call, arguments: list[Expression]) -> Expression:
        (value,) = arguments
        if value.kind != REAL:
            raise self.refused(node, f"{ast.unparse(node)!r} of an integer")
        return Expression(f"{self.names.arithmetic.functions['fabs']}({value.text})", REAL)

    def _call_float(self, node: ast.Call, arguments: list[Expression]) -> Expression:
        (value,) = arguments
        return Expression(self.real(value), REAL, UNARY)


def constant_value(value: Any, place: str, translator: Expressions) -> Expression:
    """A constant of Python as a constant of C: a number, or a structure."""
    kind = kind_of_value(value, place)
    if kind == REAL:
        return Expression(translator.literal(value), REAL, PRIMARY if value >= 0.0 else UNARY)
    if kind == TRUTH:
        return Expression("true" if value else "false", kind)
    if kind == INTEGER:
        return Expression(str(int(value)), kind, PRIMARY if value >= 0 else UNARY)
    if kind == NOTHING or not kind.fields:
        raise NotTranslated(f"{place}: a constant {value!r} is not part of the kernel's subset of Python")
    return translator.constant(kind, [constant_value(one, place, translator) for one in value])
