"""Functions of Python as functions of C: statements, and where each variable is declared."""

from __future__ import annotations

import ast
from collections.abc import Iterable, Iterator
from textwrap import wrap
from typing import NamedTuple

from codegen.expressions import PRIMARY, Expression, Expressions, Names
from codegen.kinds import INTEGER, REAL, REALS, Kind, NotTranslated, safe

WIDTH = 116
STEP = "    "

# A block of statements: the node that contains it, and the name of its field there.
Block = tuple[ast.AST, str]


class Occurrence(NamedTuple):
    """A place where a variable occurs: the blocks around it, outermost first, the statement, and whether it is set."""

    blocks: tuple[Block, ...]
    statement: ast.stmt
    is_set: bool


def targets(node: ast.expr) -> Iterator[str]:
    """The names that an assignment sets."""
    if isinstance(node, ast.Tuple):
        for one in node.elts:
            yield from targets(one)
    elif isinstance(node, ast.Name):
        yield node.id


def names_in(node: ast.AST | None) -> Iterator[str]:
    """The names that an expression reads."""
    if node is not None:
        for one in ast.walk(node):
            if isinstance(one, ast.Name) and isinstance(one.ctx, ast.Load):
                yield one.id


def occurrences(body: list[ast.stmt], blocks: tuple[Block, ...]) -> Iterator[tuple[str, Occurrence]]:
    """Every place where a variable is read or set, in the order of the source, without the variables of loops."""
    for statement in body:
        read: list[ast.AST | None] = []
        written: list[str] = []
        match statement:
            case ast.Assign(targets=[target]):
                read, written = [statement.value], list(targets(target))
                read += [target.value, target.slice] if isinstance(target, ast.Subscript) else []
            case ast.AnnAssign(target=ast.Name(id=name), value=value):
                read, written = [value], [name]
            case ast.AugAssign(target=ast.Name(id=name)):
                yield name, Occurrence(blocks, statement, False)
                read, written = [statement.value], [name]
            case ast.If() | ast.While():
                read = [statement.test]
            case ast.For():
                read = [statement.iter]
            case ast.Return() | ast.Expr():
                read = [statement.value]
        for node in read:
            for name in names_in(node):
                yield name, Occurrence(blocks, statement, False)
        for name in written:
            yield name, Occurrence(blocks, statement, True)
        own = set(targets(statement.target)) if isinstance(statement, ast.For) else set()
        for field in ("body", "orelse"):
            inside = occurrences(getattr(statement, field, []), (*blocks, (statement, field)))
            yield from ((name, occurrence) for name, occurrence in inside if name not in own or occurrence.is_set)


class Declared(NamedTuple):
    """Where a variable is declared: where it is first set, or before a statement; and whether it is set only once."""

    at: ast.stmt
    where_set: bool
    is_constant: bool


def declarations(function: ast.FunctionDef) -> dict[str, Declared]:
    """Where the variables of a function are declared."""
    parameters = {argument.arg for argument in function.args.args}
    found: dict[str, list[Occurrence]] = {}
    for name, occurrence in occurrences(function.body, ((function, "body"),)):
        found.setdefault(name, []).append(occurrence)
    return {
        name: _declared(places)
        for name, places in found.items()
        if name not in parameters and any(place.is_set for place in places)
    }


def _declared(places: list[Occurrence]) -> Declared:
    common = 0
    while all(len(p.blocks) > common and p.blocks[common] == places[0].blocks[common] for p in places):
        common += 1
    first = places[0]
    here = len(first.blocks) == common
    statement = first.statement if here else first.blocks[common][0]
    if not isinstance(statement, ast.stmt):
        raise NotTranslated(f"line {first.statement.lineno}: a variable without a place to declare it")
    once = sum(place.is_set for place in places) == 1
    return Declared(statement, here and first.is_set, once and here)


class Function:
    """One function, translated to C; another language overrides what it writes otherwise."""

    translator = Expressions
    remark = "/* {} */"
    stop = ";"
    if_, elif_, else_, while_, end = "if ({}) {{", "}} else if ({}) {{", "} else {", "while ({}) {{", "}"

    def __init__(self, node: ast.FunctionDef, names: Names, result: Kind, file: str, comments: dict[int, str]) -> None:
        self.node, self.result, self.file, self.comments = node, result, file, comments
        self.names = names
        self.declared = declarations(node)
        self.parameters = dict(names.local)
        self.lines: list[str] = []
        self.last_line = node.lineno
        self.loops = 0

    def body(self) -> list[str]:
        """The lines of its body. The kinds of variables are found first, by translating until they no longer change."""
        while True:
            before = dict(self.names.local)
            self.lines, self.loops = [], 0
            self.last_line = self.node.body[0].lineno
            self.expressions = self.translator(self.names, self.file)
            statements = self.node.body[1:] if ast.get_docstring(self.node) else self.node.body
            if statements is not self.node.body:
                self.last_line = self.node.body[0].end_lineno or self.last_line
            self._block(statements, STEP)
            if self.names.local == before:
                return self.lines

    def _write(self, indent: str, text: str) -> None:
        self.lines += wrapped(text, indent)

    def _block(self, body: list[ast.stmt], indent: str) -> None:
        for statement in body:
            for number in range(self.last_line + 1, statement.lineno):
                if number in self.comments:
                    self.lines.append(indent + self.remark.format(self.comments[number]))
            self.last_line = max(self.last_line, statement.lineno)
            self._declare_before(statement, indent)
            method = getattr(self, f"_{type(statement).__name__}", None)
            if method is None:
                raise self.expressions.refused(statement, f"the statement {ast.unparse(statement).splitlines()[0]!r}")
            method(statement, indent)
            if not isinstance(statement, ast.If | ast.For | ast.While):
                self.last_line = max(self.last_line, statement.end_lineno or 0)

    def _declare_before(self, statement: ast.stmt, indent: str) -> None:
        by_kind: dict[str, list[str]] = {}
        for name, declared in self.declared.items():
            if declared.at is statement and not declared.where_set and name in self.names.local:
                head = self.expressions.declared(self.names.local[name], False)
                by_kind.setdefault(head, []).append(safe(name))
        for head, names in by_kind.items():
            self._write(indent, f"{head} {', '.join(names)};")

    def _before(self, indent: str) -> None:
        for line in self.expressions.before:
            self._write(indent, line)
        self.expressions.before.clear()

    def _set_kind(self, name: str, kind: Kind, node: ast.AST) -> None:
        known = self.names.local.get(name, kind)
        if known != kind:
            if {known, kind} != {REAL, INTEGER} or (name in self.parameters and known == INTEGER):
                raise self.expressions.refused(
                    node, f"the variable {name!r} with values of the kinds {known.name} and {kind.name}"
                )
            kind = REAL
        self.names.local[name] = kind

    def _Assign(self, node: ast.Assign, indent: str) -> None:
        if len(node.targets) != 1:
            raise self.expressions.refused(node, "an assignment to several targets")
        (target,) = node.targets
        if isinstance(target, ast.Subscript):
            place, value = self.expressions.translate(target), self.expressions.translate(node.value)
            self._before(indent)
            self._write(indent, f"{place.text} = {self.expressions.of_kind(place.kind, value).text};")
            return
        if isinstance(target, ast.Name) and self._changes(target.id, node.value, indent):
            return
        pairs = list(self._pairs(target, node.value))
        self._before(indent)
        self._assign(pairs, node, indent)

    def _changes(self, name: str, value: ast.expr, indent: str) -> bool:
        """Change a large structure where it is, `one = one._replace(...)` or `one = f(one, ...)`, if this is that."""
        if not self.names.arithmetic.large:
            return False
        if self._appends(name, value, indent):
            return True
        match value:
            case ast.Call(func=ast.Attribute(value=ast.Name(id=source), attr="_replace")) if source == name:
                self._set_fields(value, indent)
                return True
            case ast.Call(func=ast.Name(), args=[ast.Name(id=source), *_]) if source == name:
                if change := self.expressions.change(value):
                    self._before(indent)
                    self._write(indent, change)
                    return True
        return False

    def _set_fields(self, call: ast.Call, indent: str) -> None:
        """Set fields of a variable where it is; values that read it are computed before."""
        name = ast.unparse(call.func.value)  # type: ignore[attr-defined]
        if self._changes_field(name, call.keywords, indent):
            return
        values = []
        for keyword in call.keywords:
            value = self.expressions.translate(keyword.value)
            if len(call.keywords) > 1 and name in names_in(keyword.value):
                value = value._replace(text=self.expressions.temporary(value, "new"), level=PRIMARY)
            values.append((str(keyword.arg), value))
        self._before(indent)
        for field, value in values:
            place = self.expressions.translate(ast.Attribute(ast.Name(name), field))
            self._write(indent, f"{place.text} = {self.expressions.of_kind(place.kind, value).text};")

    def _appends(self, place: str, value: ast.expr, indent: str) -> bool:
        """Append to a ring where it is, `ring = (*ring[1:], last)`, if this is that and rings are passed by value."""
        match value:
            case ast.Tuple(elts=[ast.Starred(value=ast.Subscript(value=source, slice=ast.Slice() as part)), last]):
                if ast.unparse(source) == place and ast.unparse(part) == "1:" and not self.names.arithmetic.in_place:
                    ring, one = self.expressions.translate(source), self.expressions.translate(last)
                    self._before(indent)
                    self._write(indent, f"{ring.kind.name}_append({self.expressions.address(ring)}, {one.text});")
                    return True
        return False

    def _changes_field(self, name: str, keywords: list[ast.keyword], indent: str) -> bool:
        """Change one field where it is, `one = one._replace(field=f(one.field, ...))`, if this is that."""
        if len(keywords) == 1 and self._appends(f"{name}.{keywords[0].arg}", keywords[0].value, indent):
            return True
        match keywords:
            case [
                ast.keyword(arg=field, value=ast.Call(func=ast.Name(), args=[ast.Attribute() as source, *_]) as call)
            ]:
                if ast.unparse(source) == f"{name}.{field}" and (change := self.expressions.change(call)):
                    self._before(indent)
                    self._write(indent, change)
                    return True
        return False

    def _pairs(self, target: ast.expr, value: ast.expr) -> Iterator[tuple[str, Expression]]:
        """Names and the values that they are set to."""
        if isinstance(target, ast.Name):
            if target.id != "_":
                yield target.id, self.expressions.translate(value)
            return
        if not isinstance(target, ast.Tuple):
            raise self.expressions.refused(target, f"the assignment to {ast.unparse(target)!r}")
        if isinstance(value, ast.Tuple) and len(value.elts) == len(target.elts):
            for one, part in zip(target.elts, value.elts, strict=True):
                yield from self._pairs(one, part)
            return
        yield from self._fields(target, self.expressions.parts(value))

    def _fields(self, target: ast.Tuple, parts: list[Expression]) -> Iterator[tuple[str, Expression]]:
        """Names and the fields of a structure that they are set to."""
        if len(parts) != len(target.elts):
            raise self.expressions.refused(target, f"the assignment of {len(parts)} values to {ast.unparse(target)!r}")
        for one, part in zip(target.elts, parts, strict=True):
            if isinstance(one, ast.Tuple):
                inner = [
                    Expression(self.expressions.field(part.text, part.kind, f), kind) for f, kind in part.kind.fields
                ]
                yield from self._fields(one, inner)
            elif isinstance(one, ast.Name) and one.id != "_":
                yield one.id, part

    def _assign(self, pairs: list[tuple[str, Expression]], node: ast.Assign, indent: str) -> None:
        for name, value in pairs:
            self._set_kind(name, value.kind, node)
        pairs = [(name, self.expressions.of_kind(self.names.local[name], value)) for name, value in pairs]
        pairs = self._without_hazards(pairs, node, indent)
        run: list[tuple[str, str]] = []
        for name, value in pairs:
            declared = self.declared.get(name)
            if declared is None or declared.at is not node or not declared.where_set:
                self._flush(run, indent)
                self._write(indent, f"{safe(name)} = {value.text};")
                continue
            head = self.expressions.declared(self.names.local[name], declared.is_constant)
            if run and run[0][0] != head:
                self._flush(run, indent)
            run.append((head, f"{safe(name)} = {value.text}"))
        self._flush(run, indent)

    def _flush(self, run: list[tuple[str, str]], indent: str) -> None:
        """Write declarations of one kind."""
        if run:
            self._write(indent, f"{run[0][0]} {', '.join(text for _, text in run)};")
        run.clear()

    def _without_hazards(
        self, pairs: list[tuple[str, Expression]], node: ast.Assign, indent: str
    ) -> list[tuple[str, Expression]]:
        """The pairs; where one sets a variable that a later one reads, all values are computed first."""
        if not isinstance(node.targets[0], ast.Tuple) or not isinstance(node.value, ast.Tuple):
            source = set(names_in(node.value)) if isinstance(node.value, ast.Name | ast.Attribute) else set()
            if source & {name for name, _ in pairs}:
                raise self.expressions.refused(node, "a structure taken apart into itself")
            return pairs
        done: set[str] = set()
        for one, part in zip(node.targets[0].elts, node.value.elts, strict=True):
            if done & set(names_in(part)):
                break
            done |= set(targets(one))
        else:
            return pairs
        changed = []
        for name, value in pairs:
            fresh = f"new_{name}"
            self._write(indent, f"{self.expressions.declared(self.names.local[name], True)} {fresh} = {value.text};")
            changed.append((name, Expression(fresh, value.kind)))
        return changed

    def _AugAssign(self, node: ast.AugAssign, indent: str) -> None:
        if not isinstance(node.target, ast.Name):
            raise self.expressions.refused(node, f"{ast.unparse(node)!r}")
        name = node.target.id
        signs = {ast.Add: "+=", ast.Sub: "-=", ast.Mult: "*=", ast.BitOr: "|=", ast.BitAnd: "&="}
        value = self.expressions.translate(node.value)
        if type(node.op) not in signs or name not in self.names.local:
            raise self.expressions.refused(node, f"{ast.unparse(node)!r}")
        if self.names.local[name] == INTEGER and value.kind != INTEGER:
            raise self.expressions.refused(node, f"{ast.unparse(node)!r}, which makes a real number of an integer,")
        self._before(indent)
        value = self.expressions.of_kind(self.names.local[name], value)
        self._write(indent, f"{safe(name)} {signs[type(node.op)]} {value.text};")

    def _Return(self, node: ast.Return, indent: str) -> None:
        if node.value is None:
            self._write(indent, "return;")
            return
        if self.names.changed:
            self._return_changed(self.names.changed, node.value, indent)
            return
        # A variable that is returned is changed where it is.
        for name in self.declared:
            if self._changes(name, node.value, indent):
                self._write(indent, f"return {safe(name)};")
                return
        value = self.expressions.translate(node.value)
        if value.kind != self.result and (self.result, value.kind) != (REAL, INTEGER):
            same = [kind for _, kind in value.kind.fields] == [kind for _, kind in self.result.fields]
            widened = value.kind.is_tuple and len(value.kind.fields) == len(self.result.fields)
            if not same and not widened:
                raise self.expressions.refused(
                    node, f"the result {ast.unparse(node.value)!r}, which is no {self.result.name},"
                )
            value = self.expressions.as_result(node.value, value, self.result)
        self._before(indent)
        self._write(indent, f"return {self.expressions.of_kind(self.result, value).text};")

    def _return_changed(self, name: str, value: ast.expr, indent: str) -> None:
        """Return from a function that changes a parameter where it is."""
        if isinstance(value, ast.IfExp):
            test = self.expressions.condition(value.test)
            self._before(indent)
            self._write(indent, f"if ({test.text}) {{")
            self._return_changed(name, value.body, indent + STEP)
            self._write(indent, "}")
            self._return_changed(name, value.orelse, indent)
            return
        is_same = isinstance(value, ast.Name) and value.id == name
        if not is_same and not self._changes(name, value, indent):
            found = self.expressions.translate(value)
            self._before(indent)
            self._write(indent, f"*{safe(name)} = {found.text};")
        self._write(indent, "return;")

    def _If(self, node: ast.If, indent: str) -> None:
        test = self.expressions.condition(node.test)
        self._before(indent)
        self._write(indent, self.if_.format(test.text))
        self._block(node.body, indent + STEP)
        while len(node.orelse) == 1 and isinstance(node.orelse[0], ast.If):
            node = node.orelse[0]
            test = self.expressions.condition(node.test)
            if self.expressions.before:
                raise self.expressions.refused(node, "a structure taken apart in an elif")
            self._write(indent, self.elif_.format(test.text))
            self._block(node.body, indent + STEP)
        if node.orelse:
            self._write(indent, self.else_)
            self._block(node.orelse, indent + STEP)
        self._write(indent, self.end)

    def _While(self, node: ast.While, indent: str) -> None:
        test = self.expressions.condition(node.test)
        if self.expressions.before or node.orelse:
            raise self.expressions.refused(node, f"the condition {ast.unparse(node.test)!r} of a loop")
        self._write(indent, self.while_.format(test.text))
        self._block(node.body, indent + STEP)
        self._write(indent, self.end)

    def _For(self, node: ast.For, indent: str) -> None:
        if node.orelse:
            raise self.expressions.refused(node, "a loop with else")
        if isinstance(node.iter, ast.Call) and isinstance(node.iter.func, ast.Name):
            if node.iter.func.id == "range":
                return self._for_range(node, indent)
            if node.iter.func.id == "zip":
                return self._for_each(node, node.iter.args, indent)
        return self._for_each(node, [node.iter], indent)

    def _for_range(self, node: ast.For, indent: str) -> None:
        """A loop over integers; the variable belongs to the loop."""
        if not isinstance(node.target, ast.Name) or not isinstance(node.iter, ast.Call):
            raise self.expressions.refused(node, "a loop over a range with several variables")
        name = safe(node.target.id)
        values = [self.expressions.translate(one).text for one in node.iter.args]
        first, last = ("0", values[0]) if len(values) == 1 else values
        if name == "_":
            self.loops += 1
            name = f"pass_{self.loops}"
        else:
            self._own(node.target.id, node, INTEGER)
        self._before(indent)
        if not last.isidentifier() and not last.isdigit():
            self.loops += 1
            self._write(indent, f"{self.expressions.declared(INTEGER, True)} last_{self.loops} = {last};")
            last = f"last_{self.loops}"
        head = self.expressions.declared(INTEGER, False)
        self._write(indent, f"for ({head} {name} = {first}; {name} < {last}; {name}++) {{")
        self._block(node.body, indent + STEP)
        self._write(indent, self.end)
        self._disown(node)

    def _own(self, name: str, node: ast.For, kind: Kind) -> None:
        """A variable of a loop, which nothing else sets or reads."""
        if name in self.declared or name in self.names.local:
            raise self.expressions.refused(node, f"the variable {name!r} of a loop, set elsewhere too,")
        self.names.local[name] = kind

    def _disown(self, node: ast.For) -> None:
        """Forget the variables of a loop after it."""
        for name in targets(node.target):
            self.names.local.pop(name, None)

    def _for_each(self, node: ast.For, sources: list[ast.expr], indent: str) -> None:
        """A loop over the elements of tuples of one length."""
        wanted = node.target.elts if isinstance(node.target, ast.Tuple) else [node.target]
        if len(wanted) != len(sources):
            raise self.expressions.refused(node, f"the loop over {ast.unparse(node.iter)!r}")
        self.loops += 1
        index = f"i_{self.loops}"
        inside: list[str] = []
        lengths: set[int] = set()
        for target, source in zip(wanted, sources, strict=True):
            parts = self.expressions.parts(source)
            kinds = {part.kind for part in parts}
            kind = REAL if kinds == {REAL, INTEGER} else parts[0].kind
            if not isinstance(target, ast.Name) or (len(kinds) != 1 and kind != REAL) or kind == REALS:
                raise self.expressions.refused(node, f"the loop over {ast.unparse(source)!r}")
            self._own(target.id, node, kind)
            lengths.add(len(parts))
            self._before(indent)
            values = ", ".join(self.expressions.of_kind(kind, part).text for part in parts)
            self._write(indent, f"const {kind.name} each_{target.id}_{self.loops}[{len(parts)}] = {{{values}}};")
            inside.append(f"const {kind.name} {safe(target.id)} = each_{target.id}_{self.loops}[{index}];")
        (length,) = lengths
        self._write(indent, f"for (int {index} = 0; {index} < {length}; {index}++) {{")
        for line in inside:
            self._write(indent + STEP, line)
        self._block(node.body, indent + STEP)
        self._write(indent, self.end)
        self._disown(node)

    def _Break(self, node: ast.Break, indent: str) -> None:
        self._write(indent, "break;")

    def _Continue(self, node: ast.Continue, indent: str) -> None:
        self._write(indent, "continue;")


def wrapped(text: str, indent: str = "") -> list[str]:
    """A statement in lines that are not too long."""
    later = indent + 2 * STEP
    return wrap(
        text, WIDTH, initial_indent=indent, subsequent_indent=later, break_long_words=False, break_on_hyphens=False
    )


def paragraphs(text: str, width: int = WIDTH - 3) -> list[str]:
    """A docstring in lines that are not too long."""
    lines: list[str] = []
    for paragraph in text.strip().split("\n\n"):
        lines += [*wrap(" ".join(paragraph.split()), width), ""]
    return lines[:-1]


def comment(text: str, indent: str = "") -> Iterable[str]:
    """A docstring as a comment."""
    lines = paragraphs(text, WIDTH - len(indent) - 3)
    if len(lines) == 1:
        yield f"{indent}/* {lines[0]} */"
        return
    yield f"{indent}/* {lines[0]}"
    yield from (f"{indent} * {line}".rstrip() for line in lines[1:])
    yield f"{indent} */"
