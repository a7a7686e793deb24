"""Mutation search for `make prove`: every small change to the kernel's still-air part must not be called certain.

`python -m evidence.campaigns.proof_mutants` changes operators, constants, comparisons, branches and names
of the functions in `SCOPE`, one at a time, and checks the lemmas of proof.md on each changed kernel. It prints how
many of which kind were refused, and by which lemma, and lists those called certain: each of these must be equivalent.

`--share 40` tries every 40th, `--jobs 2` runs two at a time, `--list FILE` writes a line for each.
"""

import argparse
import ast
import importlib.abc
import importlib.util
import multiprocessing
import signal
import sys
from collections import Counter
from collections.abc import Iterator
from copy import copy
from pathlib import Path
from time import process_time
from typing import NamedTuple

KERNEL = Path(__file__).parents[2] / "src" / "loiter" / "kernel"

# What stands between a state in still air and the maneuver that is returned; None is the whole file.
SCOPE = {
    "exact.py": None,
    "angles.py": {
        "TWO_PI",
        "NO_ROTATION",
        "TINY",
        "rotation",
        "angle",
        "is_at_most_half_turn",
        "snap_full_turn",
        "fold_half_turn",
        "total_angle",
    },
    "words.py": {"ABSENT", "encode", "controls", "rest", "mirrored", "opposite", "Side", "Word"},
    "motion.py": {"reduce", "flow"},
    "still_air/extremals.py": None,
    "still_air/switching_curves.py": {"switching_abscissa"},
    "rounding.py": {"ROUNDING", "REACH", "rounding", "rounded_radius", "arc_tolerance_of"},
    "entry.py": {"drop_short_pieces", "is_faster", "duration", "first_control"},
    "still_air/synthesis.py": {
        "is_solvable",
        "status_of",
        "flown_entry",
        "near_side",
        "optimum",
        "side_or_near",
        "optimum_on_side",
        "least_time",
    },
}

COMPARISONS = (ast.Lt, ast.LtE, ast.Gt, ast.GtE, ast.Eq, ast.NotEq)
ARITHMETIC = (ast.Add, ast.Sub, ast.Mult, ast.Div)
BITS = (ast.BitAnd, ast.BitOr, ast.LShift, ast.RShift)

# Functions and attributes that can be mistaken for one another.
ALIKE = (
    {"lsl", "rsl", "lsr", "rsr"},
    {"l", "r"},
    {"rl", "lr"},
    {"left_first", "right_first", "detour"},
    {"external_join", "internal_join"},
    {"max", "min"},
    {"sin", "cos"},
    {"two_sum", "two_product"},
    {"outer", "inner", "fold"},
    {"x", "y", "R"},
    {"L", "R", "RL", "LR", "LSL", "RSL", "LSR", "RSR", "LRL", "RLR"},
    {"CW", "CCW", "EITHER"},
)

# Seconds of processor time after which a changed kernel counts as refused: the check does not end.
LONGEST = 60

# What is checked last, as it is slow, and the functions that only `theorem 2 b` is about.
SLOW = "theorem 2 i", "theorem 2 a", "lemma 1", "theorem 2 b"
SELECTING = "left_first", "right_first", "detour", "fastest", "is_limit", "faster_of", "select"


class Change(NamedTuple):
    """Where a tree is changed: `parent.field`, or the element `index` of it, which becomes `node`."""

    parent: ast.AST
    field: str
    index: int | None
    node: ast.AST
    line: int


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


def like(node: ast.AST, **changed: object) -> ast.AST:
    """A copy of a node with other fields."""
    other = copy(node)
    for field, value in changed.items():
        setattr(other, field, value)
    return other


class Mutant(NamedTuple):
    """A change: file, function, line, kind, what stood there and what stands there now, and the whole source."""

    file: str
    function: str
    line: int
    kind: str
    before: str
    after: str
    source: str

    @property
    def text(self) -> str:
        """One line for a list."""
        return f"{self.file} {self.function} {self.line} [{self.kind}] {self.before}  ->  {self.after}"


class Outcome(NamedTuple):
    """What was found of a mutant: the lemma that refused it, with its sentence, or none."""

    mutant: Mutant
    lemma: str
    reason: str
    seconds: float


def mutants() -> Iterator[Mutant]:
    """Every change in `SCOPE`."""
    for file, names in SCOPE.items():
        tree = ast.parse((KERNEL / file).read_text("utf-8"))
        for statement in tree.body:
            name = name_of(statement)
            if name and (names is None or name in names):
                yield from changes(file, tree, statement, name)


def name_of(statement: ast.stmt) -> str:
    """The name that a statement of a module defines; nothing for imports and docstrings."""
    match statement:
        case ast.FunctionDef(name=name):
            return name
        case ast.ClassDef(name=name) if name not in ("Start", "Extremal", "Entry"):
            return name
        case ast.Assign(targets=[ast.Name(id=name)]) if name not in ("Rotation",):
            return name
    return ""


def changes(file: str, tree: ast.Module, statement: ast.stmt, name: str) -> Iterator[Mutant]:
    """The changes to one function, class or constant."""
    plain, locals_, seen = ast.unparse(statement), local_names(statement), set[str]()
    before, _, after = ast.unparse(tree).partition(plain)
    for parent, field, index, node in places(statement):
        for kind, other in alternatives(node, locals_):
            source = mutated(statement, Change(parent, field, index, other, node.lineno))
            if source != plain and source not in seen:
                seen.add(source)
                changed = before + source + after
                yield Mutant(file, name, node.lineno, kind, ast.unparse(node), ast.unparse(other), changed)


def local_names(statement: ast.stmt) -> list[str]:
    """The variables of a function in their order: parameters and names that it assigns."""
    names = [node.arg for node in ast.walk(statement) if isinstance(node, ast.arg)]
    names += [n.id for n in ast.walk(statement) if isinstance(n, ast.Name) and isinstance(n.ctx, ast.Store)]
    return [name for name in dict.fromkeys(names) if name != "_"]


def places(node: ast.AST) -> Iterator[tuple[ast.AST, str, int | None, ast.AST]]:
    """Every expression or statement below a node, with where it stands; not docstrings, types and decorators."""
    for field, value in ast.iter_fields(node):
        if field in ("annotation", "returns", "decorator_list", "bases", "targets", "args") and not isinstance(
            node, ast.Call
        ):
            continue
        for index, child in enumerate(value) if isinstance(value, list) else [(None, value)]:
            if isinstance(child, ast.Expr) and isinstance(child.value, ast.Constant):
                continue
            if isinstance(child, ast.expr | ast.stmt):
                yield node, field, index, child
            if isinstance(child, ast.AST):
                yield from places(child)


def alternatives(node: ast.AST, names: list[str]) -> Iterator[tuple[str, ast.AST]]:
    """What may stand in the place of a node, with the kind of the change."""
    match node:
        case ast.Compare(ops=ops):
            for i, op in enumerate(ops):
                for other in COMPARISONS:
                    if isinstance(op, COMPARISONS) and not isinstance(op, other):
                        yield "comparison", like(node, ops=[*ops[:i], other(), *ops[i + 1 :]])
        case ast.BoolOp(op=op, values=values):
            yield "branch", like(node, op=ast.Or() if isinstance(op, ast.And) else ast.And())
            yield from (("branch", like(node, values=values[:i] + values[i + 1 :])) for i in range(len(values)))
        case ast.BinOp(op=op):
            for group in (ARITHMETIC, BITS):
                if isinstance(op, group):
                    yield from (("operator", like(node, op=other())) for other in group if not isinstance(op, other))
        case ast.UnaryOp(operand=operand):
            yield "operator", operand
        case ast.Constant(value=bool()):
            yield "constant", ast.Constant(not node.value)
        case ast.Constant(value=int()) | ast.Constant(value=float()):
            yield from constants(node.value, names)
        case ast.Call():
            yield from calls(node)
        case ast.IfExp(test=test, body=body, orelse=orelse):
            yield from (("branch", body), ("branch", orelse), ("branch", ast.IfExp(test, orelse, body)))
        case ast.Name(id=name, ctx=ast.Load()):
            yield from (("name", ast.Name(other)) for other in [*alike(name), *near(name, names)])
        case ast.Attribute(attr=name):
            yield from (("name", like(node, attr=other)) for other in alike(name))
        case ast.If(test=test, body=body, orelse=orelse):
            yield from (
                ("branch", like(node, test=other))
                for other in (ast.UnaryOp(ast.Not(), test), ast.Constant(True), ast.Constant(False))
            )
        case (
            ast.Return(value=ast.Tuple(elts=elements) | ast.List(elts=elements))
            | ast.Assign(value=ast.Tuple(elts=elements))
        ):
            for i in range(len(elements) - 1):
                swapped = [*elements[:i], elements[i + 1], elements[i], *elements[i + 2 :]]
                yield "order", like(node, value=like(node.value, elts=swapped))


def constants(value: float, names: list[str]) -> Iterator[tuple[str, ast.AST]]:
    """Other constants: neighbours, dyadic ones a little beside, and ones that are wrong for some radii only."""
    if isinstance(value, int):
        yield from (("constant", ast.Constant(value + step)) for step in (1, -1))
    else:
        moved = (value + 0.25, value + 2.0**-10, value - 2.0**-10, 2.0 * value, -value)
        yield from (("constant", ast.Constant(other)) for other in dict.fromkeys(moved) if other != value)
    radius = "R" if "R" in names else "start.R" if "start" in names else ""
    if radius and isinstance(value, float):
        for part in (
            "max(1.25 - {R}, 0.0)",
            "max({R} - 2.5, 0.0)",
            "(sqrt(({R} - 1.25) * ({R} - 1.25)) - ({R} - 1.25))",
            "max(({R} - 2.5) * (2.75 - {R}), 0.0)",
        ):
            text = f"({value!r} + {part.format(R=radius)})"
            yield "part of R", ast.parse(text, mode="eval").body


def calls(node: ast.Call) -> Iterator[tuple[str, ast.AST]]:
    """A call with two arguments exchanged, or replaced by one of its arguments."""
    arguments = node.args
    for i in range(len(arguments) - 1):
        swapped = [*arguments[:i], arguments[i + 1], arguments[i], *arguments[i + 2 :]]
        yield "order", like(node, args=swapped)
    match node.func:
        case ast.Name(id="select"):
            yield from (("branch", argument) for argument in arguments[1:])
        case ast.Name(id="max" | "min" | "sqrt" | "abs" | "snap_full_turn" | "beyond"):
            yield from (("branch", argument) for argument in arguments)


def alike(name: str) -> list[str]:
    """Names that can be mistaken for a name."""
    return [other for group in ALIKE if name in group for other in sorted(group - {name})]


def near(name: str, names: list[str]) -> list[str]:
    """The next variable of a function, where the name is one."""
    return [names[(names.index(name) + 1) % len(names)]] if name in names and len(names) > 1 else []


# Checking one


class Changed(importlib.abc.MetaPathFinder, importlib.abc.Loader):
    """Imports one module of the kernel from a changed source."""

    def __init__(self, name: str, source: str) -> None:
        self.name, self.source = name, source

    def find_spec(self, fullname, path, target=None):
        return importlib.util.spec_from_loader(fullname, self) if fullname == self.name else None

    def exec_module(self, module):
        exec(compile(self.source, f"<{self.name}, changed>", "exec"), module.__dict__)


class TooLong(BaseException):
    """A check does not end; no `Exception`, as a lemma counts these as its own refusal."""


def attempted(mutant: Mutant) -> Outcome:
    """The lemma that refuses a mutant; to be called in a process that has not imported the kernel."""
    began = process_time()
    signal.signal(signal.SIGPROF, too_long)
    signal.setitimer(signal.ITIMER_PROF, LONGEST)
    try:
        module = mutant.file.removesuffix(".py").replace("/", ".")
        sys.meta_path.insert(0, Changed(f"loiter.kernel.{module}", mutant.source))
        lemma, reason = refused_by(mutant.function)
    except TooLong:
        lemma, reason = "time", f"no answer in {LONGEST} s"
    except Exception as error:  # noqa: BLE001
        lemma, reason = "import", f"{type(error).__name__}: {error}"
    signal.setitimer(signal.ITIMER_PROF, 0)
    return Outcome(mutant, lemma, reason, process_time() - began)


def too_long(*_: object) -> None:
    """Stop a check that does not end."""
    raise TooLong


def refused_by(function: str) -> tuple[str, str]:
    """The first lemma that is not certain, with its sentence; the slowest lemmas are checked last."""
    from evidence.proof.lemmas import LEMMAS, check

    def rank(section: str) -> int:
        return -1 if function in SELECTING and section == "theorem 2 b" else section in SLOW and 1 + SLOW.index(section)

    for lemma in sorted(LEMMAS, key=lambda lemma: rank(lemma.section)):
        finding = check(lemma)
        if finding.failure:
            return lemma.section, finding.failure
    return "", ""


def outcomes(chosen: list[Mutant], jobs: int) -> Iterator[Outcome]:
    """The outcome of each mutant, each in a process of its own."""
    with multiprocessing.get_context("fork").Pool(jobs, maxtasksperchild=1) as pool:
        yield from pool.imap_unordered(attempted, chosen, chunksize=1)


def table(found: list[Outcome]) -> str:
    """How many of each kind were refused, and by which lemma."""
    kinds = sorted({outcome.mutant.kind for outcome in found})
    lines = [f"| {'kind':10} | mutants | refused | certain |", "|---|---|---|---|"]
    for kind in [*kinds, "all"]:
        of_kind = [outcome for outcome in found if kind in (outcome.mutant.kind, "all")]
        refused = sum(bool(outcome.lemma) for outcome in of_kind)
        lines.append(f"| {kind:10} | {len(of_kind)} | {refused} | {len(of_kind) - refused} |")
    lines += ["", "| refused by | mutants |", "|---|---|"]
    lemmas = Counter(outcome.lemma for outcome in found if outcome.lemma)
    lines += [f"| {lemma} | {count} |" for lemma, count in sorted(lemmas.items())]
    return "\n".join(lines)


def main() -> int:
    """Try the mutants, print the table and those called certain."""
    parser = argparse.ArgumentParser(
        prog="python -m evidence.campaigns.proof_mutants", description=__doc__.partition("\n")[0]
    )
    parser.add_argument("--share", type=int, default=1, metavar="N", help="try every Nth mutant")
    parser.add_argument("--first", type=int, default=0, metavar="K", help="begin with the Kth of them")
    parser.add_argument("--jobs", type=int, default=2, help="processes (default 2)")
    parser.add_argument("--list", type=Path, metavar="FILE", help="write a line for each mutant")
    options = parser.parse_args()
    import flint  # noqa: F401  # Imported once, before the processes are forked.

    chosen = list(mutants())[options.first :: options.share]
    found = []
    for outcome in outcomes(chosen, options.jobs):
        found.append(outcome)
        if options.list:
            with options.list.open("a", encoding="utf-8") as lines:
                row = f"{outcome.lemma or 'certain'}\t{outcome.seconds:.1f}\t{outcome.mutant.text}\t{outcome.reason}"
                print(row.replace("\n", " "), file=lines)
    print(table(found))
    for outcome in found:
        if not outcome.lemma:
            print("certain:", outcome.mutant.text)
    return 0


if __name__ == "__main__":
    sys.exit(main())
