"""Small changes to the code: what a test should notice, one at a time."""

import ast
import random
import re
from collections.abc import Iterable, Iterator
from copy import copy
from difflib import unified_diff
from pathlib import Path
from typing import NamedTuple

# What a node holds that only types, documents or registers.
SKIPPED_FIELDS = {"annotation", "returns", "decorator_list", "bases", "format_spec"}

COMPARED = {
    ast.Lt: [ast.LtE, ast.GtE],
    ast.LtE: [ast.Lt, ast.Gt],
    ast.Gt: [ast.GtE, ast.LtE],
    ast.GtE: [ast.Gt, ast.Lt],
    ast.Eq: [ast.NotEq],
    ast.NotEq: [ast.Eq],
    ast.Is: [ast.IsNot],
    ast.IsNot: [ast.Is],
    ast.In: [ast.NotIn],
    ast.NotIn: [ast.In],
}

ARITHMETIC = {
    ast.Add: ast.Sub,
    ast.Sub: ast.Add,
    ast.Mult: ast.Div,
    ast.Div: ast.Mult,
    ast.FloorDiv: ast.Div,
    ast.Mod: ast.Mult,
    ast.Pow: ast.Mult,
    ast.BitAnd: ast.BitOr,
    ast.BitOr: ast.BitAnd,
    ast.LShift: ast.RShift,
    ast.RShift: ast.LShift,
}

FUNCTIONS = {"min": "max", "any": "all", "sin": "cos", "floor": "ceil", "append": "extend", "degrees": "radians"}
FUNCTIONS |= {other: name for name, other in FUNCTIONS.items()}

# Whose arguments may change places.
SYMMETRIC = {"min", "max", "hypot", "isclose"}

# Shorter than this a number is a tolerance: only another order of magnitude is another tolerance.
TOLERANCE = 1e-3

# A key, a name or an ending, not a sentence.
WORD = re.compile(r"[\w./+-]+")


class Change(NamedTuple):
    """Where a tree is changed: `parent.field`, or the element `index` of it, which becomes `node`."""

    parent: ast.AST
    field: str
    index: int | None
    node: ast.AST
    line: int


class Mutant(NamedTuple):
    """A changed file: lines before and after the change, written by `ast.unparse`, and the whole source."""

    file: str
    line: int
    before: str
    after: str
    source: str


def chosen(root: Path, files: Iterable[str], seed: int) -> Iterator[Mutant]:
    """The mutants of `files` under `root`, all of them, in an order that the seed and the sources decide."""
    trees = {file: ast.parse((root / file).read_text("utf-8")) for file in sorted(files)}
    changes = [(file, change) for file, tree in trees.items() for change in changes_of(tree)]
    random.Random(seed).shuffle(changes)
    plain = {file: ast.unparse(tree) for file, tree in trees.items()}
    for file, change in changes:
        source = mutated(trees[file], change)
        before, after = difference(plain[file], source)
        if before != after:
            yield Mutant(file, change.line, before, after, source)


def mutated(tree: ast.AST, change: Change) -> str:
    """The source of a tree with one change, which is then taken back."""
    kept = getattr(change.parent, change.field)
    if change.index is None:
        setattr(change.parent, change.field, change.node)
    else:
        setattr(change.parent, change.field, [*kept[: change.index], change.node, *kept[change.index + 1 :]])
    source = ast.unparse(tree)
    setattr(change.parent, change.field, kept)
    return source


def difference(before: str, after: str) -> tuple[str, str]:
    """The lines that differ, without what leads and trails them."""
    lines = list(unified_diff(before.split("\n"), after.split("\n"), n=0))[2:]
    gone, come = ([line[1:].strip() for line in lines if line[0] == sign] for sign in "-+")
    return "\n".join(gone), "\n".join(come)


def changes_of(node: ast.AST) -> Iterator[Change]:
    """Every change to what is below a node."""
    for field, value in ast.iter_fields(node):
        if field in SKIPPED_FIELDS or (field == "keywords" and isinstance(node, ast.ClassDef)):
            continue
        children = enumerate(value) if isinstance(value, list) else [(None, value)]
        for index, child in children:
            if isinstance(child, ast.AST) and not skipped(node, child):
                line = getattr(child, "lineno", getattr(node, "lineno", 0))
                yield from (Change(node, field, index, other, line) for other in alternatives(child))
                yield from changes_of(child)


def skipped(parent: ast.AST, child: ast.AST) -> bool:
    """Whether a node is a docstring, an import, an alias of a type, a text or label, or for type checkers."""
    match child:
        case ast.Import() | ast.ImportFrom() | ast.Expr(value=ast.Constant()) | ast.If(test=ast.Name("TYPE_CHECKING")):
            return True
        case ast.Assign(value=ast.Subscript() | ast.BinOp(op=ast.BitOr())):
            return isinstance(parent, ast.Module)
        case ast.Assign(targets=[ast.Name("__all__")]):
            return True
        case ast.Constant(value=str()):
            return isinstance(parent, ast.JoinedStr | ast.Call | ast.keyword)
    return False


def alternatives(node: ast.AST) -> Iterator[ast.AST]:
    """What may stand in the place of a node."""
    match node:
        case ast.Compare(ops=ops):
            for i, op in enumerate(ops):
                yield from (like(node, ops=[*ops[:i], other(), *ops[i + 1 :]]) for other in COMPARED[type(op)])
        case ast.BoolOp(op=op, values=values):
            yield like(node, op=ast.Or() if isinstance(op, ast.And) else ast.And())
            yield from (like(node, values=values[:i] + values[i + 1 :]) for i in range(len(values)))
        case ast.BinOp(op=op) if type(op) in ARITHMETIC:
            yield like(node, op=ARITHMETIC[type(op)]())
        case ast.UnaryOp(op=ast.USub() | ast.Not(), operand=operand):
            yield operand
        case ast.Constant(value=value):
            yield from (ast.Constant(other) for other in constants(value))
        case ast.Call():
            yield from calls(node)
        case ast.IfExp(body=body, orelse=orelse):
            yield from (body, orelse)
        case ast.comprehension(ifs=[_, *_]):
            yield like(node, ifs=[])
        case ast.stmt():
            yield from statements(node)


def constants(value: object) -> Iterator[object]:
    """Other constants of the same kind: neighbours of a number, another word."""
    match value:
        case bool():
            yield not value
        case int():
            yield from (value + 1, value - 1)
        case float() if value == 0.0:
            yield from (0.25, -0.25)
        case float():
            factor = 1.5 if abs(value) >= TOLERANCE else 1000.0
            yield from (value * factor, value / factor)
        case str() if WORD.fullmatch(value):
            yield value + "_"


def calls(node: ast.Call) -> Iterator[ast.Call]:
    """A call of the opposite function, with its first arguments swapped, or with one named argument less."""
    match node.func:
        case ast.Name(id=name) if name in FUNCTIONS:
            yield like(node, func=ast.Name(FUNCTIONS[name]))
        case ast.Attribute(attr=name) if name in FUNCTIONS:
            yield like(node, func=like(node.func, attr=FUNCTIONS[name]))
    match node.func, node.args:
        case ast.Name(id=name), [first, second, *rest] if name not in SYMMETRIC:
            yield like(node, args=[second, first, *rest])
    for i in range(len(node.keywords)):
        yield like(node, keywords=node.keywords[:i] + node.keywords[i + 1 :])


def statements(node: ast.stmt) -> Iterator[ast.stmt]:
    """A statement left out, a condition turned round, or another value returned."""
    match node:
        case ast.Expr() | ast.AugAssign() | ast.Raise() | ast.Break() | ast.Continue() | ast.Delete():
            yield ast.Pass()
        case ast.Assign(targets=[ast.Attribute() | ast.Subscript()]):
            yield ast.Pass()
        case ast.If(test=test, orelse=orelse):
            yield like(node, test=ast.UnaryOp(ast.Not(), test))
            yield like(node, test=ast.Constant(value=True))
            yield ast.If(test, [ast.Pass()], orelse)
        case ast.Return(value=ast.Tuple(elts=[first, second, *rest])):
            yield ast.Return(ast.Tuple([second, first, *rest]))
        case ast.Return(value=ast.expr()):
            yield ast.Return(ast.Constant(None))


def like(node: ast.AST, **changed: object) -> ast.AST:
    """A copy of a node with other fields."""
    other = copy(node)
    for field, value in changed.items():
        setattr(other, field, value)
    return other
