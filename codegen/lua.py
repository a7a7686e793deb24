"""Lua 5.3 from the kernel's Python, for ArduPilot's scripts: numbers of 32 bits, few instructions, little memory.

Named tuples become tables, plain tuples several values where a function returns them and arrays elsewhere. Rings are
copied. Constants stand where they are used, since a
number costs no instruction and a variable does.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Iterable, Sequence
from enum import EnumType
from types import FunctionType
from typing import Any

from codegen.arithmetic import DOUBLE, Arithmetic
from codegen.expressions import (
    AND,
    COMPARED,
    OR,
    ORDER,
    PRIMARY,
    PRODUCT,
    SUM,
    UNARY,
    Expression,
    Expressions,
)
from codegen.kinds import INTEGER, REAL, TRUTH, Kind, safe, signature
from codegen.statements import STEP, Function, paragraphs, wrapped
from codegen.unit import Unit

FUNCTIONS = {name: name for name in ("sqrt", "sin", "cos", "tan", "acos", "exp", "log", "ceil", "fmod")}
FUNCTIONS |= {"fabs": "abs", "atan2": "atan", "atan": "atan", "nan": "(0.0 / 0.0)", "inf": "huge"}

# The numbers of Lua by default, and those of ArduPilot's.
LUA = DOUBLE._replace(functions=FUNCTIONS)
LUA_32BITS = LUA._replace(real="float", integer="int32_t", digits=24, exponents=126)

# The functions of the standard library that functions of the kernel need, and what Python has and Lua has not.
# The table of all functions and of the constants that are tables.
TABLE = "law"

LIBRARY = """local abs, acos, atan, ceil, cos, exp = math.abs, math.acos, math.atan, math.ceil, math.cos, math.exp
local fmod, log, max, min, sin, sqrt = math.fmod, math.log, math.max, math.min, math.sin, math.sqrt
local tan, huge, unpack = math.tan, math.huge, table.unpack"""

HELPERS = {
    "isfinite": """-- Whether a number is neither infinite nor nan.
local function isfinite(a)
    return a - a == 0.0
end""",
    "integer_of": """-- The least integer that is no smaller; nan and what is too large become the largest or the least.
local function integer_of(a)
    return a >= 2147483647.0 and 2147483647 or a > -2147483647.0 and ceil(a) or -2147483647
end""",
    "filled": """-- A ring of equal elements.
local function filled(one, length)
    local ring = {}
    for i = 1, length do
        ring[i] = one
    end
    return ring
end""",
    "with_fields": """-- A table with other values of some fields.
local function with_fields(one, values)
    local copy = {}
    for name, value in pairs(one) do
        copy[name] = value
    end
    for name, value in pairs(values) do
        copy[name] = value
    end
    return copy
end""",
    "with_last": """-- A ring with another last element.
local function with_last(ring, last)
    local changed = {unpack(ring)}
    changed[#ring] = last
    return changed
end""",
    "appended": """-- A ring with another last element, and without its first one.
local function appended(ring, last)
    local changed = {unpack(ring, 2, #ring + 1)}
    changed[#ring] = last
    return changed
end""",
}


def note(text: str, indent: str = "") -> Iterable[str]:
    """A docstring as a comment."""
    for line in paragraphs(text):
        yield f"{indent}-- {line}".rstrip()


class LuaExpressions(Expressions):
    """The translation of expressions within one function to Lua."""

    compared = {  # noqa: RUF012 (as the one that it overrides)
        op: (sign if sign != "!=" else "~=", ORDER) for op, (sign, _) in COMPARED.items()
    }
    both, either, inverse = " and ", " or ", "not "

    def declared(self, kind: Kind, is_constant: bool) -> str:
        """What stands before the name of a variable where it is declared."""
        return "local"

    def temporary(self, found: Expression, stem: str, is_constant: bool = True) -> str:
        """The name of a new variable with this value."""
        name = super().temporary(found, stem, is_constant)
        self.before[-1] = f"local {name} = {found.text}"
        return name

    def parts(self, node: ast.expr) -> list[Expression]:
        """The elements of an expression that is a tuple; several values are named."""
        if not isinstance(node, ast.Call) or not (found := self.translate(node)).kind.is_tuple:
            return super().parts(node)
        stem = self.temporary(found, node.func.id if isinstance(node.func, ast.Name) else "parts")
        names = [f"{stem}_{i}" for i, _ in enumerate(found.kind.fields, start=1)]
        self.before[-1] = f"local {', '.join(names)} = {several(found)}"
        return [Expression(name, kind) for name, (_, kind) in zip(names, found.kind.fields, strict=True)]

    def field(self, text: str, kind: Kind, name: str) -> str:
        """A field of a table, or an element of an array."""
        return text if kind.length else f"{text}[{int(name[1:]) + 1}]" if kind.is_tuple else f"{text}.{name}"

    def as_real(self, found: Expression) -> Expression:
        """An expression as a real number: Lua converts integers."""
        return found

    def real(self, integer: Expression) -> str:
        """An integer as a real number."""
        return f"({integer.within(SUM)} + 0.0)"

    def member(self, enum: EnumType, name: str) -> str:
        """A member of an enumeration, by its number."""
        return f"{int(enum[name])}--[[{enum.__name__}.{name}]]"

    def choice(self, test: Expression, a: Expression, b: Expression) -> Expression:
        """The first of two values where a condition holds; only `false`, and no number, is false in Lua."""
        text = f"{test.within(AND)} and {a.within(AND + 1)} or "
        text += f"not {test.within(UNARY)} and {b.within(AND + 1)}" if a.kind == TRUTH else b.within(OR)
        return Expression(text, a.kind, OR)

    def ring_call(self, kind: Kind, change: str, *arguments: Expression) -> str:
        """A call of a function that makes or changes a ring."""
        texts = [argument.text for argument in arguments]
        return f"{change}({', '.join([*texts, str(kind.length)] if change == 'filled' else texts)})"

    def structure(self, kind: Kind, values: list[Expression]) -> Expression:
        """A table made from its fields."""
        if kind.is_tuple:
            return Expression(f"{{{', '.join(value.text for value in values)}}}", kind)
        pairs = (f"{name} = {value.text}" for (name, _), value in zip(kind.fields, values, strict=True))
        return Expression(f"{{{', '.join(pairs)}}}", kind)

    constant = structure

    def changed(self, found: Expression, values: dict[str, Expression]) -> Expression:
        """A copy with other values of some fields."""
        return Expression(
            f"with_fields({found.text}, {{{', '.join(f'{k} = {v.text}' for k, v in values.items())}}})", found.kind
        )

    def as_result(self, node: ast.expr, found: Expression, kind: Kind) -> Expression:
        """A tuple as the values that a function returns."""
        return found._replace(kind=kind)

    def _Call(self, node: ast.Call) -> Expression:
        """A call; where it gives several values, an array of them."""
        found = super()._Call(node)
        return found._replace(text=f"{{{found.text}}}") if found.kind.is_tuple else found

    def _ring_element(self, ring: Expression, node: ast.Subscript) -> Expression:
        found = super()._ring_element(ring, node)
        place = ring.within(PRIMARY)
        index = found.text[len(place) + 1 : -1]
        return found._replace(text=f"{place}[{int(index) + 1 if index.isdigit() else f'{index} + 1'}]")

    def _BinOp(self, node: ast.BinOp) -> Expression:
        signs = {ast.Mod: "%", ast.FloorDiv: "//"}
        if type(node.op) in signs:
            a, b = self.translate(node.left), self.translate(node.right)
            kind = INTEGER if a.kind == b.kind == INTEGER else REAL
            return Expression(f"{a.within(PRODUCT)} {signs[type(node.op)]} {b.within(PRODUCT + 1)}", kind, PRODUCT)
        if isinstance(node.op, ast.LShift):
            a, b = self.translate(node.left), self.translate(node.right)
            return Expression(f"({a.within(UNARY)} << {b.within(UNARY)})", INTEGER)
        return super()._BinOp(node)

    def _of_math(self, node: ast.Call, name: str, arguments: list[Expression]) -> Expression:
        (first, *_) = arguments
        if name == "ceil":
            return Expression(f"integer_of({first.text})", INTEGER)
        if name == "floor":
            return Expression(f"{first.within(PRODUCT)} // 1.0", REAL, PRODUCT)
        if name == "copysign":
            raise self.refused(node, f"the function {name!r} of math")
        return super()._of_math(node, name, arguments)

    def _folded(self, name: str, arguments: list[Expression]) -> Expression:
        kind = INTEGER if all(argument.kind == INTEGER for argument in arguments) else REAL
        return Expression(f"{name}({', '.join(argument.text for argument in arguments)})", kind)


def several(found: Expression) -> str:
    """A tuple as several values."""
    return found.text[1:-1] if found.text.startswith("{") else f"unpack({found.text})"


class LuaFunction(Function):
    """One function, translated to Lua."""

    translator = LuaExpressions
    remark = "-- {}"
    if_, elif_, else_, while_, end = "if {} then", "elseif {} then", "else", "while {} do", "end"

    def _write(self, indent: str, text: str) -> None:
        super()._write(indent, text.removesuffix(";"))

    def _Assign(self, node: ast.Assign, indent: str) -> None:
        """Several values are set at once where a call returns them."""
        match node:
            case ast.Assign(targets=[ast.Tuple(elts=targets)], value=ast.Call() as call) if all(
                isinstance(one, ast.Name) for one in targets
            ):
                found = self.expressions.translate(call)
                if found.kind.is_tuple and found.text.startswith("{"):
                    self._before(indent)
                    self._set_several([one.id for one in targets if isinstance(one, ast.Name)], found, node, indent)
                    return
                self.expressions.before.clear()
        super()._Assign(node, indent)

    def _set_several(self, names: list[str], found: Expression, node: ast.Assign, indent: str) -> None:
        fresh = []
        for name, (_, kind) in zip(names, found.kind.fields, strict=True):
            if name != "_":
                self._set_kind(name, kind, node)
                declared = self.declared.get(name)
                if declared is not None and declared.at is node and declared.where_set:
                    fresh.append(name)
        while names[-1] == "_":
            names.pop()
        every = len(fresh) == len([name for name in names if name != "_"])
        if fresh and not every:
            self._write(indent, f"local {', '.join(map(safe, fresh))}")
        head = "local " if every else "" if "_" not in names else "local _\n"
        if head.endswith("\n"):
            self._write(indent, head.strip())
            head = ""
        self._write(indent, f"{head}{', '.join(map(safe, names))} = {several(found)}")

    def _flush(self, run: list[tuple[str, str]], indent: str) -> None:
        """Write declarations, together where none needs another one."""
        together: list[list[str]] = []
        for name, _, value in (text.partition(" = ") for _, text in run):
            if together and not any(re.search(rf"\b{known}\b", value) for known, _ in together):
                together.append([name, value])
            else:
                self._write_together(together, indent)
                together = [[name, value]]
        self._write_together(together, indent)
        run.clear()

    def _write_together(self, together: list[list[str]], indent: str) -> None:
        if together:
            names, values = zip(*together, strict=True)
            self._write(indent, f"local {', '.join(names)} = {', '.join(values)}")

    def _AugAssign(self, node: ast.AugAssign, indent: str) -> None:
        if not isinstance(node.target, ast.Name):
            raise self.expressions.refused(node, f"{ast.unparse(node)!r}")
        target = ast.Name(node.target.id, ast.Load())
        changed = ast.BinOp(target, node.op, node.value, lineno=node.lineno)
        value = self.expressions.translate(changed)
        self._before(indent)
        self._write(indent, f"{safe(node.target.id)} = {value.text}")

    def _Return(self, node: ast.Return, indent: str) -> None:
        super()._Return(node, indent)
        if self.result.is_tuple:
            start = max(i for i, line in enumerate(self.lines) if line.lstrip().startswith("return"))
            text = " ".join(line.strip() for line in self.lines[start:]).removeprefix("return ")
            self.lines[start:] = wrapped(f"return {several(Expression(text, self.result))}", indent)

    def _for_range(self, node: ast.For, indent: str) -> None:
        if not isinstance(node.target, ast.Name) or not isinstance(node.iter, ast.Call):
            raise self.expressions.refused(node, "a loop over a range with several variables")
        values = [self.expressions.translate(one) for one in node.iter.args]
        first, last = (Expression("0", INTEGER), values[0]) if len(values) == 1 else values
        if node.target.id != "_":
            self._own(node.target.id, node, INTEGER)
        self._before(indent)
        end = str(int(last.text) - 1) if last.text.isdigit() else f"{last.within(SUM)} - 1"
        self._write(indent, f"for {safe(node.target.id)} = {first.text}, {end} do")
        self._loop_body(node, indent)

    def _for_each(self, node: ast.For, sources: list[ast.expr], indent: str) -> None:
        wanted = node.target.elts if isinstance(node.target, ast.Tuple) else [node.target]
        self.loops += 1
        number = self.loops
        inside: list[str] = []
        for target, source in zip(wanted, sources, strict=True):
            parts = self.expressions.parts(source)
            if not isinstance(target, ast.Name):
                raise self.expressions.refused(node, f"the loop over {ast.unparse(source)!r}")
            self._own(target.id, node, REAL if REAL in {part.kind for part in parts} else parts[0].kind)
            self._before(indent)
            self._write(indent, f"local each_{target.id}_{number} = {{{', '.join(part.text for part in parts)}}}")
            inside.append(f"local {safe(target.id)} = each_{target.id}_{number}[i_{number}]")
        self._write(indent, f"for i_{number} = 1, {len(parts)} do")
        for line in inside:
            self._write(indent + STEP, line)
        self._loop_body(node, indent)

    def _loop_body(self, node: ast.For, indent: str) -> None:
        """The body of a loop, and its end, to which `continue` jumps."""
        start = len(self.lines)
        self._block(node.body, indent + STEP)
        if any(line.lstrip() == "goto next" for line in self.lines[start:]):
            self._write(indent + STEP, "::next::")
        self._write(indent, self.end)
        self._disown(node)

    def _Continue(self, node: ast.Continue, indent: str) -> None:
        self._write(indent, "goto next")


class Chunk(Unit):
    """The functions `roots`, and what they need, in Lua; `by_hand` names functions that are written elsewhere."""

    translator = LuaFunction
    taken = frozenset[str]()
    note, aside = staticmethod(note), " -- {}"

    def __init__(self, title: str, arithmetic: Arithmetic, roots: Sequence[Any], by_hand: dict[Any, str]) -> None:
        self.by_hand = by_hand
        super().__init__(title, arithmetic, roots)

    def name(self, function: FunctionType) -> str:
        """The name in Lua: ArduPilot allows 100 local names in a file, so functions are in a table."""
        return f"{TABLE}.{super().name(function)}"

    def _called(self, function: FunctionType) -> list[FunctionType]:
        return [] if function in self.by_hand else super()._called(function)

    def _add(self, function: FunctionType) -> tuple[str, dict[str, Kind], Kind]:
        if function in self.by_hand:
            return self.by_hand[function], *signature(function, self.by_hand[function])
        return super()._add(function)

    def _function(
        self, function: FunctionType, node: ast.FunctionDef, parameters: dict[str, Kind], result: Kind, body: list[str]
    ) -> list[str]:
        head = f"function {self.name(function)}({', '.join(map(safe, parameters))})"
        return [*note(ast.get_docstring(node) or ""), *wrapped(head), *body, "end", ""]

    def _constant(self, name: str, names: dict[str, Any]) -> Expression:
        """A constant: a number with its name as a remark, or the name of a table."""
        found = super()._constant(name, names)
        owner = self._owner(name, names[name], names["__name__"]).__name__.rpartition(".")[2]
        if found.kind.fields:
            return found._replace(text=f"{TABLE}.{name}")
        value = self.constants[owner, name][-1].split(" = ")[1].split(" -- ")[0]
        return Expression(f"{value}--[[{name}]]", found.kind, UNARY if value.startswith("-") else PRIMARY)

    def _definition(self, name: str, value: Expression) -> str:
        return f"{f'{TABLE}.' if value.kind.fields else '-- '}{name} = {value.text}"

    def body(self) -> str:
        """Helpers, constants and functions."""
        lines = LIBRARY.splitlines()
        used = "\n".join(line for lines in self.functions.values() for line in lines)
        for name, text in HELPERS.items():
            if re.search(rf"\b{name}\(", used):
                lines += ["", *text.splitlines()]
        for part in (*self.constants.values(), [""], *self.functions.values()):
            lines += part
        return "\n".join(lines).rstrip("\n")
