"""JavaScript from the kernel's Python: an ES module, with types in its comments that TypeScript checks.

Named tuples become objects, tuples and lists become arrays, integers are doubles without fraction. Other than C,
JavaScript has the kernel's lists of maneuvers too: comprehensions, `sorted`, `any` and `all` over a list.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator
from enum import EnumType
from pathlib import Path
from types import FunctionType

from codegen.arithmetic import DOUBLE
from codegen.expressions import (
    COMPARED,
    EQUALITY,
    PRIMARY,
    SUM,
    UNARY,
    Expression,
    Expressions,
)
from codegen.kinds import INTEGER, NOTHING, REAL, REALS, TRUTH, Kind, kind_of_type, list_of, safe
from codegen.statements import STEP, Function, comment, paragraphs, wrapped
from codegen.unit import Unit
from loiter.compiled import branchless

# The functions of `math` that JavaScript computes exactly. The others are not the same in every browser, so those of
# `compiled/branchless.py` stand in for them; the cube root decides only which maneuvers count as one.
EXACT = {name: f"Math.{name}" for name in ("sqrt", "floor", "ceil", "cbrt")} | {"fabs": "Math.abs"}
PORTABLE = DOUBLE._replace(
    functions=EXACT,
    replaced={name: getattr(branchless, name) for name in ("atan2", "sin", "cos", "tan", "acos", "atan")},
)

HELPERS = Path(__file__).with_name("helpers.js").read_text("utf-8")

TYPES = {REAL: "number", INTEGER: "number", TRUTH: "boolean", NOTHING: "void", REALS: "number[]"}


def type_of(kind: Kind) -> str:
    """The type of a kind, as TypeScript writes it."""
    if kind.length:
        return f"{type_of(kind.fields[0][1])}[]"
    if kind.is_tuple:
        return f"[{', '.join(type_of(inner) for _, inner in kind.fields)}]"
    return TYPES.get(kind, kind.name)


def element_of(kind: Kind) -> Kind:
    """The kind of the elements of a list."""
    return REAL if kind == REALS else kind.fields[0][1]


class JavaScriptExpressions(Expressions):
    """The translation of expressions within one function to JavaScript."""

    compared = COMPARED | {ast.Eq: ("===", EQUALITY), ast.NotEq: ("!==", EQUALITY)}

    def declared(self, kind: Kind, is_constant: bool) -> str:
        """What stands before the name of a variable where it is declared, with a type that TypeScript cannot infer."""
        types = f"/** @type {{{type_of(kind)}}} */ " if kind == TRUTH or kind.is_tuple else ""
        return types + ("const" if is_constant else "let")

    def temporary(self, found: Expression, stem: str, is_constant: bool = True) -> str:
        """The name of a new constant with this value."""
        name = super().temporary(found, stem)
        self.before[-1] = f"const {name} = {found.text};"
        return name

    def field(self, text: str, kind: Kind, name: str) -> str:
        """A field of an object, or an element of an array."""
        return text if kind.length else f"{text}[{name[1:]}]" if kind.is_tuple else f"{text}.{name}"

    def real(self, integer: Expression) -> str:
        """An integer as a real number."""
        return integer.within(UNARY)

    def as_real(self, found: Expression) -> Expression:
        """An expression as a real number: integers are real numbers."""
        return found

    def member(self, enum: EnumType, name: str) -> str:
        """A member of an enumeration."""
        return f"{enum.__name__}.{name}"

    def literal(self, value: float) -> str:
        """A number."""
        return super().literal(value).replace("NAN", "NaN").replace("INFINITY", "Infinity")

    def structure(self, kind: Kind, values: list[Expression]) -> Expression:
        """An object made from its fields, or an array."""
        if kind.is_tuple:
            return Expression(f"[{', '.join(value.text for value in values)}]", kind)
        pairs = [(name, value.text) for (name, _), value in zip(kind.fields, values, strict=True)]
        fields = ", ".join(name if name == text else f"{name}: {text}" for name, text in pairs)
        return Expression(f"{{ {fields} }}", kind)

    constant = structure

    def _BinOp(self, node: ast.BinOp) -> Expression:
        if isinstance(node.op, ast.Mult) and isinstance(node.left, ast.List):
            (one,), length = (self.translate(each) for each in node.left.elts), self.translate(node.right)
            return Expression(f"Array({length.text}).fill({one.text})", REALS)
        found = super()._BinOp(node)
        constant = any(isinstance(one, ast.Constant) for one in (node.left, node.right))
        if isinstance(node.op, ast.RShift) and not isinstance(node.right, ast.Constant):
            a, b = self.translate(node.left), self.translate(node.right)
            return Expression(f"shift_right({a.text}, {b.text})", INTEGER)
        if isinstance(node.op, ast.Mult) and found.kind == INTEGER and not constant:
            # An integer has no negative zero.
            return Expression(f"{found.text} + 0", INTEGER, SUM)
        return found

    def _UnaryOp(self, node: ast.UnaryOp) -> Expression:
        found = super()._UnaryOp(node)
        if isinstance(node.op, ast.USub) and found.kind == INTEGER and not isinstance(node.operand, ast.Constant):
            return Expression(f"0 - {self.translate(node.operand).within(SUM + 1)}", INTEGER, SUM)
        return found

    def _List(self, node: ast.List) -> Expression:
        texts, kinds = [], set()
        for one in node.elts:
            values = self._argument(one)
            texts += [value.text for value in values]
            kinds |= {value.kind for value in values}
        if len(kinds) != 1:
            raise self.refused(node, f"the list {ast.unparse(node)!r}")
        return Expression(f"[{', '.join(texts)}]", list_of(kinds.pop()))

    def elements(self, node: ast.expr) -> Expression:
        """A list, or a tuple or a range as one."""
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id == "range":
            return Expression(f"range({', '.join(self.translate(one).text for one in node.args)})", list_of(INTEGER))
        found = self._List(ast.List(node.elts)) if isinstance(node, ast.Tuple) else self.translate(node)
        if found.kind.is_tuple:
            return found._replace(kind=list_of(found.kind.fields[0][1]))
        if found.kind.length >= 0 and found.kind != REALS:
            raise self.refused(node, f"{ast.unparse(node)!r} as a list")
        return found

    def _of_each(self, node: ast.ListComp | ast.GeneratorExp, method: str) -> Expression:
        """The list of a comprehension: its elements filtered, then each taken by a method of arrays."""
        part, *others = node.generators
        if others or not isinstance(part.target, ast.Name) or part.target.id in self.names.local:
            raise self.refused(node, f"{ast.unparse(node)!r}")
        source, name = self.elements(part.iter), part.target.id
        self.names.local[name] = element_of(source.kind)
        with self.lazily():
            text = source.within(PRIMARY)
            for test in part.ifs:
                text += f".filter(({name}) => {self.condition(test).text})"
            one = self.translate(node.elt)
        del self.names.local[name]
        if one.text != name:
            text += f".{method}(({name}) => {f'({one.text})' if one.text.startswith('{') else one.text})"
        return Expression(text, list_of(one.kind))

    def _ListComp(self, node: ast.ListComp) -> Expression:
        return self._of_each(node, "map")

    def changed(self, found: Expression, values: dict[str, Expression]) -> Expression:
        """An object with other values of some fields."""
        texts = ", ".join(f"{field}: {value.text}" for field, value in values.items())
        return Expression(f"{{ ...{found.within(PRIMARY)}, {texts} }}", found.kind)

    def _Call(self, node: ast.Call) -> Expression:
        match node:
            case ast.Call(func=ast.Name(id="any" | "all" as name), args=[ast.GeneratorExp() as tests]):
                return self._of_each(tests, "some" if name == "any" else "every")._replace(kind=TRUTH)
            case ast.Call(func=ast.Name(id="sorted"), args=[values], keywords=keys):
                return self._sorted(values, keys)
            case ast.Call(
                func=ast.Name(id="min"), args=[ast.Call(func=ast.Name(id="map"), args=[of, values])], keywords=[_]
            ):
                return Expression(f"Math.min(...{self.elements(values).text}.map({self._named(of)}))", REAL)
            case ast.Call(func=ast.Attribute(value=value, attr="append"), args=[one]):
                return Expression(f"{self.translate(value).text}.push({self.translate(one).text})", NOTHING)
        return super()._Call(node)

    def _named(self, node: ast.expr) -> str:
        """A function that is named as a value."""
        if isinstance(node, ast.Name) and isinstance(function := self.names.globals.get(node.id), FunctionType):
            return self.names.function(function)[0]
        raise self.refused(node, f"{ast.unparse(node)!r} as a function")

    def _sorted(self, values: ast.expr, keys: list[ast.keyword]) -> Expression:
        """A list in the order of its elements, or of a function of them."""
        found, key = self.elements(values), self._named(keys[0].value) if keys else "Number"
        return found._replace(text=f"sorted({found.text}, {key})", level=PRIMARY)


class JavaScriptFunction(Function):
    """One function, translated to JavaScript."""

    translator = JavaScriptExpressions
    expressions: JavaScriptExpressions
    remark = "// {}"

    def _AnnAssign(self, node: ast.AnnAssign, indent: str) -> None:
        """A list that begins empty."""
        kind = kind_of_type(eval(ast.unparse(node.annotation), self.names.globals), self.file)
        if not isinstance(node.target, ast.Name) or not isinstance(node.value, ast.List) or node.value.elts:
            raise self.expressions.refused(node, f"{ast.unparse(node)!r}")
        self._set_kind(node.target.id, kind, node)
        self._write(indent, f"/** @type {{{type_of(kind)}}} */")
        self._write(indent, f"const {safe(node.target.id)} = [];")

    def _AugAssign(self, node: ast.AugAssign, indent: str) -> None:
        if isinstance(node.target, ast.Name) and self.names.local.get(node.target.id, REAL).length:
            self._write(indent, f"{node.target.id}.push(...{self.expressions.translate(node.value).text});")
        else:
            super()._AugAssign(node, indent)

    def _Return(self, node: ast.Return, indent: str) -> None:
        if isinstance(node.value, ast.List) and not node.value.elts:
            self._write(indent, "return [];")
        else:
            super()._Return(node, indent)

    def _Expr(self, node: ast.Expr, indent: str) -> None:
        call = self.expressions.translate(node.value)
        self._before(indent)
        self._write(indent, f"{call.text};")

    def _for_each(self, node: ast.For, sources: list[ast.expr], indent: str) -> None:
        """A loop over the elements of one list, or of several of one length."""
        wanted = node.target.elts if isinstance(node.target, ast.Tuple) and len(sources) > 1 else [node.target]
        lists = [self.expressions.elements(source) for source in sources]
        for target, source in zip(wanted, lists, strict=True):
            if not isinstance(target, ast.Name):
                raise self.expressions.refused(node, f"the loop over {ast.unparse(node.iter)!r}")
            self._own(target.id, node, element_of(source.kind))
        self._before(indent)
        names = [safe(target.id) for target in wanted if isinstance(target, ast.Name)]
        if len(lists) == 1:
            self._write(indent, f"for (const {names[0]} of {lists[0].text}) {{")
        else:
            self.loops += 1
            index, each = f"i_{self.loops}", [f"each_{name}_{self.loops}" for name in names]
            pairs = ", ".join(f"{title} = {source.text}" for title, source in zip(each, lists, strict=True))
            self._write(indent, f"const {pairs};")
            self._write(indent, f"for (let {index} = 0; {index} < {each[0]}.length; {index}++) {{")
            elements = ", ".join(f"{name} = {title}[{index}]" for name, title in zip(names, each, strict=True))
            self._write(indent + STEP, f"const {elements};")
        self._block(node.body, indent + STEP)
        self._write(indent, "}")
        self._disown(node)


class Module(Unit):
    """The ES module of the functions `roots`, and of what they need."""

    translator = JavaScriptFunction
    taken = frozenset[str]()
    has_lists = True

    def _function(
        self, function: FunctionType, node: ast.FunctionDef, parameters: dict[str, Kind], result: Kind, body: list[str]
    ) -> list[str]:
        types = ", ".join(f"{safe(name)}: {type_of(kind)}" for name, kind in parameters.items())
        tag = f"@type {{({types}) => {type_of(result)}}}"
        head = f"export function {self.name(function)}({', '.join(map(safe, parameters))}) {{"
        return [*documented(ast.get_docstring(node) or "", tag), *wrapped(head), *body, "}", ""]

    def _definition(self, name: str, value: Expression) -> str:
        types = "" if value.kind in TYPES else f"/** @type {{{type_of(value.kind)}}} */\n"
        return f"{types}export const {name} = {value.text};"

    def text(self) -> str:
        """The whole module."""
        parts = ["// @ts-check", *comment(self._description()), "", HELPERS, *self._enumerations()]
        for kind in self.structures.values():
            if not kind.is_tuple and not kind.length:
                fields = ", ".join(f"{name}: {type_of(inner)}" for name, inner in kind.fields)
                tag = f"@typedef {{{{{fields}}}}} {kind.name}"
                parts += [*documented(self._class_of(kind).__doc__ or "", tag), ""]
        for lines in (*self.constants.values(), [""], *self.functions.values()):
            parts += lines
        return "\n".join(parts).rstrip("\n") + "\n"

    def _enumerations(self) -> Iterator[str]:
        from loiter.kernel.statuses import Status
        from loiter.kernel.words import Side, Word

        for kind in (Side, Status, Word):
            members = ", ".join(f"{member.name}: {int(member)}" for member in kind)
            yield from comment(kind.__doc__ or kind.__name__)
            yield from paired(f"export const {kind.__name__} = {{ {members} }};")
            yield ""


def paired(text: str) -> list[str]:
    """A text in lines that end nowhere between a name and its type or value."""
    return [line.replace("\xa0", " ") for line in wrapped(text.replace(": ", ":\xa0"))]


def documented(doc: str, tag: str) -> Iterator[str]:
    """A docstring, and a tag for TypeScript, as a comment."""
    yield "/**"
    for line in paragraphs(doc):
        yield f" * {line}".rstrip()
    if doc:
        yield " *"
    yield from (f" * {line}" for line in paired(tag))
    yield " */"
