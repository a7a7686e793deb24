"""A file of C: the functions that some functions of the kernel need, in one arithmetic."""

from __future__ import annotations

import ast
import hashlib
import inspect
import io
import re
import tokenize
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Sequence
from enum import EnumType
from functools import cache
from pathlib import Path
from sys import modules
from types import FunctionType, ModuleType
from typing import Any

from codegen.arithmetic import CONSTANTS, UPDATED, Arithmetic
from codegen.expressions import PRIMARY, RINGS, Expression, Names, constant_value
from codegen.kinds import NOTHING, Kind, NotTranslated, kind_of_value, safe, signature
from codegen.statements import STEP, Function, comment, occurrences, wrapped
from loiter.kernel.rebinding import names_used
from loiter.version import __version__

ROOT = Path(__file__).parents[1]
HELPERS = Path(__file__).with_name("helpers.h").read_text("utf-8")

# A ring: filled with one element; with another last element; and without its first one besides; this where it is.
RING = """typedef struct {{ {element} at[{length}]; }} {ring};

static inline {ring} {ring}_filled({element} one) {{
    {ring} ring;
    for (int i = 0; i < {length}; i++) {{
        ring.at[i] = one;
    }}
    return ring;
}}

static inline {ring} {ring}_with_last({ring} ring, {element} last) {{
    ring.at[{last}] = last;
    return ring;
}}

static inline {ring} {ring}_appended({ring} ring, {element} last) {{
    for (int i = 0; i < {last}; i++) {{
        ring.at[i] = ring.at[i + 1];
    }}
    ring.at[{last}] = last;
    return ring;
}}

static inline void {ring}_append({ring} *ring, {element} last) {{
    for (int i = 0; i < {last}; i++) {{
        ring->at[i] = ring->at[i + 1];
    }}
    ring->at[{last}] = last;
}}"""

# Names of the C library, and of POSIX, that functions of the kernel have too.
TAKEN = frozenset({"atan2", "acos", "atan", "sin", "cos", "tan", "hypot", "select", "l", "r"})


@cache
def syntax(module: ModuleType) -> dict[str, ast.FunctionDef]:
    """The functions of a module."""
    tree = ast.parse(inspect.getsource(module))
    return {node.name: node for node in tree.body if isinstance(node, ast.FunctionDef)}


@cache
def assigned(module: ModuleType) -> dict[str, ast.expr]:
    """The constants of a module: the expressions by which they are set."""
    found: dict[str, ast.expr] = {}
    for node in ast.parse(inspect.getsource(module)).body:
        if isinstance(node, ast.Assign) and len(node.targets) == 1:
            (target,) = node.targets
            whole = isinstance(target, ast.Name)
            names = [target] if whole else getattr(target, "elts", [])
            values = [node.value] if whole else getattr(node.value, "elts", [])
            found |= {name.id: value for name, value in zip(names, values, strict=True) if isinstance(name, ast.Name)}
    return found


@cache
def comments_of(module: ModuleType) -> dict[int, str]:
    """The comments of a module that stand on lines of their own, by line."""
    source = inspect.getsource(module)
    found = {}
    for token in tokenize.generate_tokens(io.StringIO(source).readline):
        if token.type == tokenize.COMMENT and token.line.lstrip().startswith("#"):
            found[token.start[0]] = token.string.lstrip("# ")
    return found


class Unit:
    """The file of C of the functions `roots`, and of what they need."""

    translator = Function
    taken = TAKEN
    has_lists = False
    note, aside = staticmethod(comment), " /* {} */"

    def __init__(self, title: str, arithmetic: Arithmetic, roots: Sequence[Any]) -> None:
        self.title, self.arithmetic = title, arithmetic
        self.functions: dict[FunctionType, list[str]] = {}
        self.constants: dict[tuple[str, str], list[str]] = {}
        self.constant_kinds: dict[tuple[str, str], Kind] = {}
        self.structures: dict[str, Kind] = {}
        self.documented: dict[str, str] = {}
        self.enums: dict[str, EnumType] = {}
        self.open: list[FunctionType] = []
        reached = self._reachable(roots)
        self.shared = {name for name, count in Counter(f.__name__ for f in reached).items() if count > 1}
        for root in roots:
            self._add(root)

    def _reachable(self, roots: Sequence[Any]) -> set[FunctionType]:
        """These functions and all that they call."""
        found: set[FunctionType] = set()
        waiting = list(roots)
        while waiting:
            function = waiting.pop()
            if function not in found:
                found.add(function)
                waiting += self._called(function)
        return found

    def _called(self, function: FunctionType) -> list[FunctionType]:
        """The functions that a function calls: by name, whether or not they are replaced."""
        replaced = self._replaced(function)
        named = (replaced.get(name, function.__globals__.get(name)) for name in names_used(function.__code__))
        return [one for one in named if isinstance(one, FunctionType) and one.__module__.startswith("loiter.")]

    def _fills(self, function: FunctionType) -> bool:
        """Whether a function fills a ring, `(x,) * LENGTH`, itself or by a function that it calls."""
        return any(
            isinstance(node, ast.BinOp) and isinstance(node.op, ast.Mult) and isinstance(node.left, ast.Tuple)
            for one in self._reachable([function])
            for node in ast.walk(syntax(modules[one.__module__])[one.__name__])
        )

    def _passed(self, function: FunctionType, name: str, kind: Kind) -> Kind:
        """The kind of a parameter: large structures are passed by address, unless the function sets them."""
        body = syntax(modules[function.__module__])[function.__name__].body
        is_set = any(one == name and place.is_set for one, place in occurrences(body, ()))
        return kind._replace(by_address=kind.size(self.arithmetic.in_place) >= self.arithmetic.large and not is_set)

    def _replaced(self, function: FunctionType) -> dict[str, Any]:
        """What stands in for the globals of a function; replacements are themselves as they are written."""
        is_replacement = function.__module__ == "loiter.compiled.branchless"
        return {} if is_replacement else self.arithmetic.replaced

    def name(self, function: FunctionType) -> str:
        """The name in C: that in Python, after that of the module where two functions share it, or C has it too."""
        module = function.__module__.rpartition(".")[2]
        taken = function.__name__ in self.shared or function.__name__ in self.taken
        return f"{module}_{function.__name__}" if taken else function.__name__

    def _add(self, function: FunctionType) -> tuple[str, dict[str, Kind], Kind]:
        """Translate a function unless that is done; its name, parameters and result."""
        module = modules[function.__module__]
        place = str(Path(inspect.getfile(module)).relative_to(ROOT))
        parameters, result = signature(function, place)
        if self.arithmetic.in_place and self._fills(function):
            parameters = {RINGS: Kind("Rings *"), **parameters}
        if self.arithmetic.large:
            first, *_ = [*(name for name in parameters if name != RINGS), ""]
            is_changed = parameters.get(first) == result and result.size(self.arithmetic.in_place) >= UPDATED
            parameters = {name: self._passed(function, name, kind) for name, kind in parameters.items()}
            if is_changed:
                parameters[first] = result._replace(by_address=True, is_changed=True)
        for kind in (*parameters.values(), result):
            if kind.length < 0 and not self.has_lists:
                raise NotTranslated(f"{place}: {function.__name__} has a list, {kind.name}, which only JavaScript has")
            self._structure(kind.value)
        title = self.name(function)
        if function in self.open:
            raise NotTranslated(f"{place}: {function.__name__} calls itself, which a kernel function must not")
        if function not in self.functions:
            self.open.append(function)
            lines = self._translated(function, module, place, parameters, result)
            self.open.pop()
            self.functions[function] = lines
        return title, parameters, result

    def _translated(
        self, function: FunctionType, module: ModuleType, place: str, parameters: dict[str, Kind], result: Kind
    ) -> list[str]:
        node = syntax(module)[function.__name__]
        if node.args.vararg or node.args.kwarg or node.args.kwonlyargs or node.decorator_list:
            raise NotTranslated(f"{place}:{node.lineno}: {node.name} has arguments or decorators that C does not have")
        names = Names(
            self.arithmetic,
            function.__globals__,
            {name: kind.value for name, kind in parameters.items()},
            self._replaced(function),
            self._add,
            self._constant,
            frozenset(name for name, kind in parameters.items() if kind.by_address),
            "".join(name for name, kind in parameters.items() if kind.is_changed),
        )
        body = self.translator(node, names, result, place, comments_of(module)).body()
        body = [re.sub(r"\(\*(\w+)\)\.", r"\1->", line) for line in body]
        for kind in names.local.values():
            self._structure(kind)
        return self._function(function, node, parameters, result, body)

    def _function(
        self, function: FunctionType, node: ast.FunctionDef, parameters: dict[str, Kind], result: Kind, body: list[str]
    ) -> list[str]:
        """The lines of a function whose body is translated."""
        listed = ", ".join(_declaration(kind, safe(name)) for name, kind in parameters.items()) or "void"
        if node.name in self.arithmetic.faster:
            body = ["#ifdef FP_FAST_FMA", STEP + self.arithmetic.faster[node.name], "#else", *body, "#endif"]
        doc = ast.get_docstring(node)
        kind = NOTHING if any(one.is_changed for one in parameters.values()) else result
        head = f"{self.storage(function)} {kind.name} {self.name(function)}({listed}) {{"
        return [*(comment(doc) if doc else ()), *wrapped(head), *body, "}", ""]

    def storage(self, function: FunctionType) -> str:
        """What stands before a function."""
        return self.arithmetic.storage

    def _structure(self, kind: Kind) -> None:
        """Declare a structure, after those of its fields."""
        for _, inner in kind.fields:
            self._structure(inner)
        if kind.fields and self.structures.setdefault(kind.name, kind) != kind:
            raise NotTranslated(f"two structures have the name {kind.name}: rename one of them")

    def _constant(self, name: str, names: dict[str, Any]) -> Expression:
        """A constant of the module with these globals, where it is defined."""
        value = names[name]
        owner = self._owner(name, value, names["__name__"])
        module = owner.__name__.rpartition(".")[2]
        value = CONSTANTS[module, name](self.arithmetic) if (module, name) in CONSTANTS else value
        if isinstance(value, EnumType):
            raise NotTranslated(f"{owner.__name__}: the class {name} is used as a value")
        key = module, name
        kind = kind_of_value(value, owner.__name__)
        self._structure(kind)
        if key not in self.constants:
            names_here = Names(self.arithmetic, {}, {}, {}, self._add, self._constant)
            found = constant_value(value, owner.__name__, self.translator.translator(names_here, ""))
            source = ast.unparse(assigned(owner)[name])
            shown = "" if kind.fields or source in (found.text, repr(value)) else self.aside.format(source)
            lines = [self._definition(name, found) + shown]
            if self.arithmetic.single and key in CONSTANTS:
                translator = self.translator.translator(names_here, "")
                single = constant_value(CONSTANTS[key](self.arithmetic.single), owner.__name__, translator)
                lines = ["#ifdef LOITER_FLOAT", self._definition(name, single), "#else", *lines, "#endif"]
            above = list(comment_above(owner, name, self.note))
            known = any(above and above == lines[: len(above)] for lines in self.constants.values())
            if name in {other for _, other in self.constants}:
                raise NotTranslated(f"{owner.__name__}: another module has a constant {name} too: rename one of them")
            self.constants[key] = [*(() if known else above), *lines]
            self.constant_kinds[key] = kind
        return Expression(name, kind)

    def _definition(self, name: str, value: Expression) -> str:
        """The line that defines a constant."""
        if value.kind.fields:
            return f"static const {value.kind.name} {name} = {value.text};"
        return f"#define {name} {value.text if value.level == PRIMARY else f'({value.text})'}"

    def _owner(self, name: str, value: Any, importer: str) -> ModuleType:
        """The module that defines a constant."""
        if name in assigned(modules[importer]):
            return modules[importer]
        for title, module in sorted(modules.items()):
            if title.startswith("loiter.") and getattr(module, name, None) is value and name in assigned(module):
                return module
        raise NotTranslated(f"{importer}: the constant {name!r} is defined nowhere in the kernel")

    def text(self) -> str:
        """The whole file."""
        return "\n".join([*self._head(), *self._types(), self.body(), "#endif"]) + "\n"

    def body(self) -> str:
        """All but the beginning and the end."""
        used = "\n".join(line for lines in self.functions.values() for line in lines)
        parts: list[str] = [self._helpers(), *self._enums(used)]
        for kind in self.structures.values():
            parts += [*self._structure_lines(kind), ""]
        for lines in self.constants.values():
            parts += lines
        parts.append("")
        for lines in self.functions.values():
            parts += lines
        return "\n".join(parts)

    def _helpers(self) -> str:
        """What Python has and C has not, in this arithmetic."""
        a = self.arithmetic
        text = re.sub(r"\d+\.\d+", lambda number: f"{a.prefix}{number.group()}{a.suffix}", HELPERS)
        return re.sub(r"\b(fmod|copysign)\(", lambda call: f"{a.functions[call.group(1)]}(", text)

    def _head(self) -> Iterator[str]:
        guard = f"LOITER_{Path(self.title).stem.upper()}_H"
        yield from comment(self._description())
        yield f"#ifndef {guard}\n#define {guard}\n"

    def _description(self) -> str:
        return (
            f"{DESCRIPTIONS[self.title]}\n\nGenerated from the Python of loiter {__version__} by `make generate`; "
            f"do not edit.\n\nSHA-256 of the source: {digest(self.sources())}"
        )

    def _types(self) -> Iterator[str]:
        yield "#include <math.h>\n#include <stdbool.h>\n#include <stdint.h>\n"
        unsigned = f"u{self.arithmetic.integer}"
        yield f"typedef {self.arithmetic.real} real;"
        yield f"typedef {self.arithmetic.integer} integer;\ntypedef {unsigned} unsigned_integer;\n"

    def _enums(self, used: str) -> Iterator[str]:
        from loiter.kernel.statuses import Status
        from loiter.kernel.words import Side, Word

        for kind in (Side, Status, Word):
            if f"{kind.__name__.upper()}_" in used:
                members = ", ".join(f"{kind.__name__.upper()}_{member.name} = {int(member)}" for member in kind)
                yield from comment(kind.__doc__ or kind.__name__)
                yield from wrapped(f"enum {{ {members} }};")
                yield ""

    def _structure_lines(self, kind: Kind) -> Iterator[str]:
        if kind.length:
            ((_, element),) = kind.fields
            yield RING.format(ring=kind.name, element=element.name, length=kind.length, last=kind.length - 1)
            return
        if not kind.is_tuple:
            yield from comment(self._class_of(kind).__doc__ or kind.name)
        by_kind: list[tuple[str, list[str]]] = []
        for name, inner in kind.fields:
            if by_kind and by_kind[-1][0] == inner.name:
                by_kind[-1][1].append(name)
            else:
                by_kind.append((inner.name, [name]))
        fields = " ".join(f"{title} {', '.join(names)};" for title, names in by_kind)
        yield from wrapped(f"typedef struct {{ {fields} }} {kind.name};")

    def _class_of(self, kind: Kind) -> type:
        for function in self.functions:
            found = function.__globals__.get(kind.name)
            if isinstance(found, type):
                return found
        raise NotTranslated(f"the class {kind.name} is not imported where it is used")

    def sources(self) -> list[Path]:
        """The files of Python from which the functions come."""
        found = {Path(inspect.getfile(modules[function.__module__])) for function in self.functions}
        return sorted(found)


def _declaration(kind: Kind, name: str) -> str:
    if kind.by_address:
        return f"{'' if kind.is_changed else 'const '}{kind.name} *{name}"
    return f"{kind.name}{'' if kind.name.endswith('*') else ' '}{name}"


def comment_above(module: ModuleType, name: str, note: Callable[[str], Iterable[str]]) -> Iterator[str]:
    """The comment above a constant, in another language."""
    comments, line = comments_of(module), assigned(module)[name].lineno - 1
    block: list[str] = []
    while line in comments:
        block.insert(0, comments[line])
        line -= 1
    if block:
        yield from ["", *note(" ".join(block))]


def digest(files: list[Path]) -> str:
    """A digest of the sources."""
    found = hashlib.sha256()
    for file in files:
        found.update(file.read_bytes())
    return found.hexdigest()


DESCRIPTIONS = {
    "kernel.js": (
        "The fastest way onto a holding circle, in still air and in wind, for browsers and Node: the same answers in "
        "all of them, to the last bit, since sine, cosine and arctangent are its own."
    ),
    "law.h": (
        "A guidance law that flies the fastest entry onto a holding circle, and the identification of its vehicle, as "
        "steps without side effects."
    ),
    "kernel.h": (
        "The fastest way onto a holding circle, in still air and in wind, in double precision, with the functions of "
        "the C library: the same answers as in Python, to the last bit."
    ),
    "still_air_loops.h": (
        "The fastest way onto a holding circle in still air, in double precision, without branches and without calls "
        "of the C library, for loops that a compiler vectorises."
    ),
}
