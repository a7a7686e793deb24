"""JavaScript from the library's Python: what is between the kernel and the page, translated without types.

The kernel is translated with types (`javascript`). The code above it has classes, text, dictionaries and generators,
and takes little time, so here operators and methods become calls of `source/kernel/python.js`, which treats numbers,
complex numbers, arrays and text as Python does. Functions of the kernel stay those of `kernel.js`. All that the globals
`roots` need is translated, but for what JavaScript has elsewhere.

Classes that are neither dataclasses nor named tuples are classes there too, without a base of ours.

Members of enumerations are their values: text or integers. A number without decimals may be written as a float, unless
it looks like an integer, such as `len(...)`.
"""

from __future__ import annotations

import ast
import builtins
import inspect
import re
import sys
from collections.abc import Callable, Iterator, Sequence
from dataclasses import fields as dataclass_fields
from dataclasses import is_dataclass
from enum import IntEnum, StrEnum
from functools import cache
from types import FunctionType, ModuleType
from typing import Any

from codegen.kinds import NotTranslated
from codegen.unit import assigned, syntax

# Python's operators, as functions of `python.js`.
OPERATORS: dict[type, str] = {
    ast.Add: "add", ast.Sub: "sub", ast.Mult: "mul", ast.Div: "div", ast.Mod: "mod", ast.Pow: "pow",
    ast.FloorDiv: "floordiv", ast.BitOr: "bit_or", ast.BitAnd: "bit_and",
    ast.Eq: "eq", ast.NotEq: "ne", ast.Lt: "lt", ast.LtE: "le", ast.Gt: "gt", ast.GtE: "ge", ast.In: "has",
}  # fmt: skip

# Functions of `python.js` that the translation itself calls, whatever the names of Python's code.
WRITTEN = {
    *OPERATORS.values(),
    *(
        "and",
        "or",
        "neg",
        "invert",
        "truth",
        "item",
        "set_item",
        "sliced",
        "slice",
        "with_middle",
        "set_of",
        "iter_items",
    ),
    *("iter", "list", "str", "repr", "format", "isinstance", "letters", "name_of", "cached", "struct", "enumeration"),
}

# Names that only JavaScript or `python.js` reserves.
RESERVED = WRITTEN | {
    "arguments",
    "case",
    "const",
    "default",
    "delete",
    "function",
    "in",
    "let",
    "new",
    "rows",
    "switch",
    "this",
    "var",
}

# Methods of Python's own values that `python.js` has as functions.
METHODS = {
    *("join", "removesuffix", "removeprefix", "capitalize", "lower", "encode", "replace"),
    *("items", "values", "get", "append", "pop", "tolist", "round", "any", "copy", "conjugate", "index"),
}

# Modules of which JavaScript has a part that functions import.
MODULES = {"np", "shapely"}

# Modules of the kernel that are translated like the code above it: they have generators and methods.
UNTYPED = {"loiter.kernel.wind.elongation"}

# What JavaScript has elsewhere: by module and name, the expression that stands for it.
Replaced = dict[tuple[str, str], str]


def safe(name: str) -> str:
    """A name that JavaScript does not reserve."""
    return f"{name}_" if name in RESERVED else name


@cache
def classes(module: ModuleType) -> dict[str, ast.ClassDef]:
    """The classes of a module."""
    return {node.name: node for node in ast.parse(inspect.getsource(module)).body if isinstance(node, ast.ClassDef)}


@cache
def values(module: ModuleType) -> dict[str, ast.expr]:
    """The constants of a module, by the expressions that set them."""
    typed = {
        node.target.id: node.value
        for node in ast.parse(inspect.getsource(module)).body
        if isinstance(node, ast.AnnAssign) and isinstance(node.target, ast.Name) and node.value
    }
    return assigned(module) | typed


class Library:
    """The ES module of `roots` and of all that they need, above the functions of the kernel in `kernel`."""

    def __init__(
        self, roots: Sequence[tuple[str, str]], kernel: Callable[[FunctionType], str], replaced: Replaced
    ) -> None:
        self.kernel, self.replaced = kernel, replaced
        self.parts: dict[tuple[str, str], str] = {}
        self.names: dict[str, tuple[str, str]] = {}
        self.waiting: list[tuple[str, str]] = []
        self.properties: dict[str, str] = {}
        self.builtins: set[str] = set()
        self.exported = [self.named(module, name) for module, name in roots]
        while self.waiting:
            self._translate(self.waiting.pop(0))

    def named(self, module: str, name: str) -> str:
        """The name in JavaScript of a global of a module, which is translated if it is not yet."""
        key = (module, name)
        title = safe(name)
        if self.names.setdefault(title, key) != key:
            title = f"{module.rpartition('.')[2]}_{name}"
            if self.names.setdefault(title, key) != key:
                raise NotTranslated(f"{module}: two globals have the name {title}")
        if key not in self.parts and key not in self.waiting:
            self.waiting.append(key)
        return title

    def _translate(self, key: tuple[str, str]) -> None:
        module, name = sys.modules[key[0]], key[1]
        title = self.named(*key)
        writer = Writer(self, module)
        if name in classes(module):
            self.parts[key] = ""
            text = self._class(title, classes(module)[name], getattr(module, name), writer)
            # After its base.
            del self.parts[key]
            self.parts[key] = text
        elif name in syntax(module):
            self.parts[key] = ""
            self.parts[key] = writer.function(syntax(module)[name], title)
        elif name in values(module):
            # After those that it needs.
            self.parts[key] = ""
            others, self.waiting = self.waiting, []
            text = f"const {title} = {writer.expression(values(module)[name])};"
            while self.waiting:
                self._translate(self.waiting.pop(0))
            self.waiting = [one for one in others if one not in self.parts]
            del self.parts[key]
            self.parts[key] = text
        else:
            raise NotTranslated(f"{key[0]}: {name} is defined nowhere")

    def _class(self, title: str, node: ast.ClassDef, cls: type, writer: Writer) -> str:
        if issubclass(cls, IntEnum | StrEnum):
            members = ", ".join(f"{member.name}: {member.value!r}" for member in cls)
            for one in node.body:
                if isinstance(one, ast.FunctionDef):
                    self.properties[one.name] = f"{title}_{one.name}"
            functions = [
                writer.function(one, f"{title}_{one.name}") for one in node.body if isinstance(one, ast.FunctionDef)
            ]
            return "\n".join([f"const {title} = enumeration({{ {members} }});", *functions])
        writer.cls = cls
        if not is_dataclass(cls) and not hasattr(cls, "_fields"):
            return self._plain_class(title, node, cls, writer)
        if is_dataclass(cls):
            fields = [(one.name, one.init) for one in dataclass_fields(cls)]
        else:
            fields = [(name, True) for name in cls._fields]  # type: ignore[attr-defined]
        defaults = {
            one.target.id: writer.expression(one.value)
            for one in node.body
            if isinstance(one, ast.AnnAssign)
            and isinstance(one.target, ast.Name)
            and one.value
            and not _is_field(one.value)
        }
        given = [f"{name} = {defaults[name]}" if name in defaults else name for name, is_given in fields if is_given]
        lines = [f"constructor({', '.join(given)}) {{", "super();"]
        lines += [f"this.{name} = {name if is_given else 'undefined'};" for name, is_given in fields]
        lines += ["this.__post_init__();" * hasattr(cls, "__post_init__"), "}"]
        lines += self._methods(node, cls, writer)
        names = ", ".join(f'"{name}"' for name, is_given in fields if is_given)
        base = "Values" if is_dataclass(cls) else "Tuple"
        return f"const {title} = struct(class extends {base} {{\n" + "\n".join(lines) + f"\n}}, [{names}], {title!r});"

    def _methods(self, node: ast.ClassDef, cls: type, writer: Writer) -> list[str]:
        """The methods of a class, and those of its bases that it does not replace."""
        own = [one for one in node.body if isinstance(one, ast.FunctionDef)]
        lines = [writer.method(one) for one in own if not self._is_unused(one, cls)]
        for base in cls.__mro__[1:]:
            if is_dataclass(base) and base.__module__.startswith("loiter."):
                module = sys.modules[base.__module__]
                others, known = classes(module)[base.__name__].body, {one.name for one in own}
                inherited = [one for one in others if isinstance(one, ast.FunctionDef) and one.name not in known]
                lines += [Writer(self, module).method(one) for one in inherited if not self._is_unused(one, cls)]
                own += inherited
        return lines

    def _plain_class(self, title: str, node: ast.ClassDef, cls: type, writer: Writer) -> str:
        """A class with a constructor."""
        if cls.__bases__[0].__module__.startswith("loiter."):
            raise NotTranslated(f"{cls.__module__}: {cls.__name__} has a base")
        lines = [
            writer.constructor(one) if one.name == "__init__" else writer.method(one)
            for one in node.body
            if isinstance(one, ast.FunctionDef)
        ]
        return f"const {title} = struct(class extends Values {{\n" + "\n".join(lines) + "\n}, []);"

    def _is_unused(self, node: ast.FunctionDef, cls: type) -> bool:
        return node.name in UNUSED.get(cls.__name__, ()) or (
            node.name.startswith("__") and node.name not in ("__post_init__", "__str__")
        )

    def text(self) -> str:
        """The module's statements: enumerations and classes, functions, then constants in the order of their need."""
        definitions = re.compile(r"function|const \w+ = (struct|enumeration)\(")
        first = [text for text in self.parts.values() if definitions.match(text)]
        last = [text for text in self.parts.values() if not definitions.match(text)]
        return "\n\n".join([*first, "\n".join(last), f"export {{ {', '.join(self.exported)} }};"]) + "\n"


# Methods that the page never calls, and that need what a browser has not.
UNUSED = {
    "Maneuver": {"to_dataframe", "to_dict", "_repr_html_", "_repr_svg_"},
    "Hold": {"sample", "at"},
    "Orbit": {"fitted"},
    "LocalFrame": {"pose", "_swapped_hint", "_reaches"},
    "Certificate": {"residual", "__str__", "claim", "source", "comparison", "ties"},
    "SlotCertificate": {"residual", "__str__", "claim", "source", "comparison", "ties"},
}


def _is_field(node: ast.expr) -> bool:
    return isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id == "field"


class Writer:
    """The translation of one module's code."""

    def __init__(self, library: Library, module: ModuleType) -> None:
        self.library, self.module = library, module
        self.local: list[set[str]] = []
        self.temporaries = 0
        self.cls: type | None = None

    # Statements

    def function(self, node: ast.FunctionDef, title: str) -> str:
        """A function by its name in JavaScript."""
        star = "*" if _yields(node) else ""
        return f"function{star} {title}({self._parameters(node.args)}) {{\n{self._body(node)}\n}}"

    def method(self, node: ast.FunctionDef) -> str:
        """A method, or a property as a getter."""
        decorators = [ast.unparse(one) for one in node.decorator_list]
        body = self._body(node, "this")
        if "cached_property" in decorators:
            return f'get {node.name}() {{ return cached(this, "{node.name}", () => {{\n{body}\n}}); }}'
        if "classmethod" in decorators:
            return f"static {safe(node.name)}({self._parameters(node.args)}) {{\n{self._body(node)}\n}}"
        get = "get " if "property" in decorators else "*" if _yields(node) else ""
        name = {"__str__": "toString"}.get(node.name, safe(node.name))
        return f"{get}{name}({self._parameters(node.args, skip=1)}) {{\n{body}\n}}"

    def constructor(self, node: ast.FunctionDef) -> str:
        """A constructor."""
        return f"constructor({self._parameters(node.args, skip=1)}) {{\nsuper();\n{self._body(node, 'this')}\n}}"

    def _parameters(self, arguments: ast.arguments, skip: int = 0) -> str:
        given = [*arguments.posonlyargs, *arguments.args]
        defaults = [None] * (len(given) - len(arguments.defaults)) + list(arguments.defaults)
        texts = [
            _with_default(one.arg, self.expression(value) if value else None)
            for one, value in zip(given, defaults, strict=True)
        ]
        if arguments.vararg:
            texts.append(f"...{safe(arguments.vararg.arg)}")
        for one, value in zip(arguments.kwonlyargs, arguments.kw_defaults, strict=True):
            texts.append(_with_default(one.arg, self.expression(value) if value else None))
        texts += [f"{safe(arguments.kwarg.arg)} = new Map()"] if arguments.kwarg else []
        return ", ".join(texts[skip:])

    def _body(self, node: ast.FunctionDef, this: str = "") -> str:
        given = {one.arg for one in (*node.args.posonlyargs, *node.args.args, *node.args.kwonlyargs)}
        given |= {one.arg for one in (node.args.vararg, node.args.kwarg) if one}
        assigned = set(_assigned(node.body)) - given
        self.local.append(given | assigned)
        lines = [f"let {', '.join(sorted(safe(name) for name in assigned))};"] if assigned else []
        if this:
            lines.append(f"const self = {this};")
        lines += self._block(node.body)
        self.local.pop()
        return "\n".join(lines)

    def _block(self, body: list[ast.stmt]) -> list[str]:
        lines = []
        for node in body:
            if isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant):
                continue
            method = getattr(self, f"_{type(node).__name__}", None)
            if method is None:
                raise NotTranslated(f"{self.module.__name__}:{node.lineno}: {ast.unparse(node)[:60]!r}")
            lines.append(method(node))
        return lines

    def _FunctionDef(self, node: ast.FunctionDef) -> str:
        return f"{safe(node.name)} = {self.function(node, '')};"

    def _Return(self, node: ast.Return) -> str:
        return f"return {self.expression(node.value)};" if node.value else "return;"

    def _Expr(self, node: ast.Expr) -> str:
        match node.value:
            case ast.Yield(value=ast.expr() as value):
                return f"yield {self.expression(value)};"
            case ast.YieldFrom(value=value):
                return f"yield* iter({self.expression(value)});"
        return f"{self.expression(node.value)};"

    def _Assign(self, node: ast.Assign) -> str:
        value = self.expression(node.value)
        if len(node.targets) == 1:
            return self._assignment(node.targets[0], value)
        self.temporaries += 1
        name = f"chained{self.temporaries}"
        return "\n".join([f"const {name} = {value};", *(self._assignment(target, name) for target in node.targets)])

    def _assignment(self, target: ast.expr, value: str) -> str:
        match target:
            case ast.Tuple(elts=targets) if any(isinstance(one, ast.Subscript) for one in targets):
                self.temporaries += 1
                name = f"unpacked{self.temporaries}"
                parts = [self._assignment(one, f"{name}[{i}]") for i, one in enumerate(targets)]
                return "\n".join([f"const {name} = iter({value});", *parts])
            case ast.Tuple(elts=targets) | ast.List(elts=targets):
                return f"{self._pattern(targets)} = {self._unpacked(targets, value)};"
            case ast.Subscript(value=owner, slice=key):
                return f"set_item({self.expression(owner)}, {self.expression(key)}, {value});"
        return f"{self._target(target)} = {value};"

    def _unpacked(self, targets: list[ast.expr], value: str) -> str:
        stars = [i for i, one in enumerate(targets) if isinstance(one, ast.Starred)]
        if stars and stars[0] < len(targets) - 1:
            return f"with_middle({value}, {stars[0]}, {len(targets) - 1 - stars[0]})"
        return f"iter({value})"

    def _pattern(self, targets: list[ast.expr]) -> str:
        star = [i for i, one in enumerate(targets) if isinstance(one, ast.Starred)]
        is_inner = bool(star) and star[0] < len(targets) - 1
        parts = []
        for one in targets:
            match one:
                case ast.Starred(value=value):
                    parts.append(f"{'' if is_inner else '...'}{self._target(value)}")
                case ast.Tuple(elts=inner):
                    parts.append(self._pattern(inner))
                case _:
                    parts.append(self._target(one))
        return f"[{', '.join(parts)}]"

    def _target(self, node: ast.expr) -> str:
        if isinstance(node, ast.Attribute):
            return f"{self.expression(node.value)}.{node.attr}"
        assert isinstance(node, ast.Name), ast.unparse(node)
        return safe(node.id)

    def _AnnAssign(self, node: ast.AnnAssign) -> str:
        return self._assignment(node.target, self.expression(node.value)) if node.value else ""

    def _AugAssign(self, node: ast.AugAssign) -> str:
        value = f"{OPERATORS[type(node.op)]}({self.expression(node.target)}, {self.expression(node.value)})"
        return self._assignment(node.target, value)

    def _If(self, node: ast.If) -> str:
        if ast.unparse(node.test) == "TYPE_CHECKING":
            return ""
        text = f"if ({self.condition(node.test)}) {{\n" + "\n".join(self._block(node.body)) + "\n}"
        return text + (" else {\n" + "\n".join(self._block(node.orelse)) + "\n}" if node.orelse else "")

    def _For(self, node: ast.For) -> str:
        target, source = node.target, self.expression(node.iter)
        pattern = self._pattern(target.elts) if isinstance(target, ast.Tuple) else self._target(target)
        each = f"{'rows' if isinstance(target, ast.Tuple) else 'iter'}({source})"
        return f"for ({pattern} of {each}) {{\n" + "\n".join(self._block(node.body)) + "\n}"

    def _While(self, node: ast.While) -> str:
        return f"while ({self.condition(node.test)}) {{\n" + "\n".join(self._block(node.body)) + "\n}"

    def _Raise(self, node: ast.Raise) -> str:
        assert node.exc is not None
        return f"throw {self.expression(node.exc)};"

    def _Try(self, node: ast.Try) -> str:
        """Only divisions by zero are caught, which raise nothing in JavaScript."""
        return "\n".join(self._block(node.body))

    def _With(self, node: ast.With) -> str:
        """Only NumPy's warnings are switched off so."""
        return "\n".join(self._block(node.body))

    def _Assert(self, node: ast.Assert) -> str:
        return ""

    _Pass = _Import = _Assert

    def _Break(self, node: ast.Break) -> str:
        return "break;"

    def _Continue(self, node: ast.Continue) -> str:
        return "continue;"

    def _ImportFrom(self, node: ast.ImportFrom) -> str:
        raise NotTranslated(f"{self.module.__name__}:{node.lineno}: an import inside a function")

    # Expressions

    def condition(self, node: ast.expr) -> str:
        """An expression as JavaScript takes it for a condition."""
        match node:
            case ast.Compare() | ast.UnaryOp(op=ast.Not()):
                return self.expression(node)
            case ast.BoolOp(op=op, values=values):
                sign = " && " if isinstance(op, ast.And) else " || "
                return "(" + sign.join(self.condition(value) for value in values) + ")"
        return f"truth({self.expression(node)})"

    def expression(self, node: ast.expr) -> str:
        """An expression."""
        method = getattr(self, f"_{type(node).__name__}", None)
        if method is None:
            raise NotTranslated(f"{self.module.__name__}:{node.lineno}: {ast.unparse(node)[:60]!r}")
        text: str = method(node)
        return text

    def _Constant(self, node: ast.Constant) -> str:
        match node.value:
            case None:
                return "null"
            case True | False:
                return str(node.value).lower()
            case str():
                return _quoted(node.value)
            case bytes():
                return _quoted(node.value.decode())
            case complex():
                return f"new Complex({node.value.real}, {node.value.imag})"
        return repr(node.value)

    def _Name(self, node: ast.Name) -> str:
        if node.id in MODULES:
            return node.id
        if any(node.id in names for names in self.local):
            return safe(node.id)
        return self._global(node.id, node)

    def _global(self, name: str, node: ast.expr) -> str:
        if name not in vars(self.module):
            if hasattr(builtins, name):
                self.library.builtins.add(name)
                return name
            raise NotTranslated(f"{self.module.__name__}:{node.lineno}: the name {name!r}")
        value = vars(self.module)[name]
        if isinstance(value, FunctionType | type) or callable(value):
            return self._of_object(value, name)
        owner = _owner(self.module, name, value)
        if (found := self.library.replaced.get((owner.__name__, name))) is not None:
            return found
        if owner.__name__ in ("math", "cmath") or not owner.__name__.startswith("loiter"):
            return f"math.{name}"
        return self.library.named(owner.__name__, name)

    def _of_object(self, value: Any, name: str) -> str:
        module = getattr(value, "__module__", "") or ""
        title = getattr(value, "__name__", name)
        if (found := self.library.replaced.get((module, title))) is not None:
            return found
        if module in ("math", "cmath"):
            return f"{module}.{title}"
        if module in ("loiter.kernel.words", "loiter.kernel.statuses") and isinstance(value, type):
            return f"kernel.{title}"
        if module.startswith("loiter.kernel.") and module not in UNTYPED and isinstance(value, FunctionType):
            return f"kernel.{self.library.kernel(value)}"
        if module.startswith("loiter."):
            return self.library.named(module, title)
        return {
            "partial": "partial",
            "pairwise": "pairwise",
            "accumulate": "accumulate",
            "replace": "replace",
            "asdict": "asdict",
            "escape": "escape",
            "heappop": "heappop",
            "heappush": "heappush",
        }[title]

    def _static(self, node: ast.expr) -> Any:
        """The object of Python that an expression names, if it is known."""
        match node:
            case ast.Name(id=name) if not any(name in names for names in self.local):
                return vars(self.module).get(name, getattr(builtins, name, None))
            case ast.Attribute(value=value, attr=attr):
                owner = self._static(value)
                if isinstance(owner, ModuleType | type):
                    return getattr(owner, attr, None)
        return None

    def _Attribute(self, node: ast.Attribute) -> str:
        owner = self._static(node.value)
        if isinstance(owner, ModuleType):
            value = getattr(owner, node.attr)
            if (found := self.library.replaced.get((owner.__name__, node.attr))) is not None:
                return found
            if owner.__name__.startswith("loiter."):
                return (
                    self._of_object(value, node.attr)
                    if callable(value)
                    else self.library.named(owner.__name__, node.attr)
                )
            module = "np" if owner.__name__ == "numpy" else owner.__name__.rpartition(".")[2]
            return f"{module}.{node.attr}"
        # The value of a member of an enumeration, which is itself; other classes have fields of that name.
        if node.attr == "value" and re.search(r"\bturn\)?$", ast.unparse(node.value)):
            return self.expression(node.value)
        if node.attr == "letters":
            return f"letters({self.expression(node.value)})"
        if node.attr == "message":
            messages = self.library.named("loiter.kernel.statuses", "_MESSAGES")
            return f"item({messages}, {self.expression(node.value)})"
        if node.attr == "name" and isinstance(node.value, ast.Call):
            return f"name_of({self.expression(node.value.func)}, {self.expression(node.value)})"
        if node.attr == "__name__":
            return f"{self.expression(node.value)}.name"
        if node.attr in self.library.properties or node.attr == "described":
            from loiter.planning.model import Turn

            self._of_object(Turn, "Turn")
            return f"Turn_{node.attr}({self.expression(node.value)})"
        return f"{self.expression(node.value)}.{safe(node.attr)}"

    def _Tuple(self, node: ast.Tuple | ast.List) -> str:
        return f"[{', '.join(map(self._element, node.elts))}]"

    _List = _Tuple

    def _element(self, node: ast.expr) -> str:
        return f"...iter({self.expression(node.value)})" if isinstance(node, ast.Starred) else self.expression(node)

    def _Dict(self, node: ast.Dict) -> str:
        pairs = [
            f"[{self.expression(key)}, {self.expression(value)}]" if key else f"...iter_items({self.expression(value)})"
            for key, value in zip(node.keys, node.values, strict=True)
        ]
        return f"new Map([{', '.join(pairs)}])"

    def _Set(self, node: ast.Set) -> str:
        return f"[{', '.join(map(self._element, node.elts))}]"

    def _BinOp(self, node: ast.BinOp) -> str:
        return f"{OPERATORS[type(node.op)]}({self.expression(node.left)}, {self.expression(node.right)})"

    def _UnaryOp(self, node: ast.UnaryOp) -> str:
        if isinstance(node.op, ast.Not):
            return f"!{self.condition(node.operand)}"
        if isinstance(node.op, ast.Invert):
            return f"invert({self.expression(node.operand)})"
        if isinstance(node.operand, ast.Constant) and not isinstance(node.operand.value, complex):
            return f"-{self.expression(node.operand)}"
        return f"neg({self.expression(node.operand)})"

    def _BoolOp(self, node: ast.BoolOp) -> str:
        if all(isinstance(value, ast.Compare) for value in node.values):
            return self.condition(node)
        first, *others = node.values
        text, name = self.expression(first), "and" if isinstance(node.op, ast.And) else "or"
        for value in others:
            text = f"{name}({text}, () => {self.expression(value)})"
        return text

    def _Compare(self, node: ast.Compare) -> str:
        parts, left = [], node.left
        for op, right in zip(node.ops, node.comparators, strict=True):
            a, b = self.expression(left), self.expression(right)
            if isinstance(op, ast.Is | ast.IsNot):
                parts.append(f"{a} {'==' if isinstance(op, ast.Is) else '!='} {b}")
            elif isinstance(op, ast.NotIn):
                parts.append(f"!has({a}, {b})")
            else:
                parts.append(f"{OPERATORS[type(op)]}({a}, {b})")
            left = right
        return parts[0] if len(parts) == 1 and " " not in parts[0].split("(")[0] else f"({' && '.join(parts)})"

    def _IfExp(self, node: ast.IfExp) -> str:
        return f"({self.condition(node.test)} ? {self.expression(node.body)} : {self.expression(node.orelse)})"

    def _NamedExpr(self, node: ast.NamedExpr) -> str:
        return f"({self._target(node.target)} = {self.expression(node.value)})"

    def _Lambda(self, node: ast.Lambda) -> str:
        self.local.append({one.arg for one in node.args.args})
        text = f"(({self._parameters(node.args)}) => {_in_parentheses(self.expression(node.body))})"
        self.local.pop()
        return text

    def _Subscript(self, node: ast.Subscript) -> str:
        owner = self.expression(node.value)
        if isinstance(node.slice, ast.Slice):
            ends = [
                self.expression(one) if one else "null" for one in (node.slice.lower, node.slice.upper, node.slice.step)
            ]
            return f"sliced({owner}, {', '.join(ends)})"
        return f"item({owner}, {self.expression(node.slice)})"

    def _Slice(self, node: ast.Slice) -> str:
        """A slice of one axis of several."""
        ends = (self.expression(one) if one else "null" for one in (node.lower, node.upper))
        return f"slice({', '.join(ends)})"

    def _ListComp(self, node: ast.ListComp | ast.GeneratorExp) -> str:
        return self._of_each(node.generators, lambda: self.expression(node.elt))

    _GeneratorExp = _ListComp

    def _SetComp(self, node: ast.SetComp) -> str:
        return f"set_of({self._of_each(node.generators, lambda: self.expression(node.elt))})"

    def _DictComp(self, node: ast.DictComp) -> str:
        pairs = self._of_each(node.generators, lambda: f"[{self.expression(node.key)}, {self.expression(node.value)}]")
        return f"new Map({pairs})"

    def _of_each(self, generators: list[ast.comprehension], element: Callable[[], str]) -> str:
        part, *others = generators
        source = f"iter({self.expression(part.iter)})"
        names = {one.id for one in ast.walk(part.target) if isinstance(one, ast.Name)}
        self.local.append(names)
        is_tuple = isinstance(part.target, ast.Tuple)
        parameter = (
            _unique(self._pattern(part.target.elts))
            if isinstance(part.target, ast.Tuple)
            else self._target(part.target)
        )
        text = f"list({source})" + (".map((one) => iter(one))" if is_tuple else "")
        for test in part.ifs:
            text += f".filter(({parameter}) => {self.condition(test)})"
        if others:
            text += f".flatMap(({parameter}) => {self._of_each(others, element)})"
        else:
            text += f".map(({parameter}) => {_in_parentheses(element())})"
        self.local.pop()
        return text

    def _JoinedStr(self, node: ast.JoinedStr) -> str:
        parts = []
        for one in node.values:
            if isinstance(one, ast.Constant):
                parts.append(
                    str(one.value).replace("\\", "\\\\").replace("`", "\\`").replace("${", "\\${").replace("\n", "\\n")
                )
            else:
                assert isinstance(one, ast.FormattedValue)
                parts.append(f"${{{self._formatted(one)}}}")
        return f"`{''.join(parts)}`"

    def _formatted(self, node: ast.FormattedValue) -> str:
        value = self.expression(node.value)
        if node.conversion == ord("r"):
            return f"repr({value})"
        if node.format_spec is not None:
            # A number within a format is an integer.
            return f"format({value}, {self.expression(node.format_spec).replace('${str(', '${String(')})"
        return value if _is_integer(node.value) else f"str({value})"

    def _Call(self, node: ast.Call) -> str:
        match node.func:
            case ast.Attribute(value=ast.Name(id="object"), attr="__setattr__"):
                owner, name, value = map(self.expression, node.args)
                return f"({owner}[{name}] = {value})"
            case ast.Name(id="map") if (
                isinstance(method := node.args[0], ast.Attribute) and self._static(method) is None
            ):
                others = ", ".join(map(self._element, node.args[1:]))
                return f"map((...given) => {self.expression(method)}(...given), {others})"
            case ast.Name(id="isinstance"):
                tested = [node.args[0], *_alternatives(node.args[1])]
                return f"isinstance({', '.join(map(self.expression, tested))})"
            case ast.Name(id="getattr"):
                owner, name = map(self.expression, node.args)
                return f"{owner}[{name}]"
            case ast.Name(id="replace"):
                changes = ", ".join(f"{one.arg}: {self.expression(one.value)}" for one in node.keywords)
                return f"replace({self.expression(node.args[0])}, {{ {changes} }})"
            case ast.Attribute(value=value, attr="_replace"):
                changes = ", ".join(f"{one.arg}: {self.expression(one.value)}" for one in node.keywords)
                return f"replace({self.expression(value)}, {{ {changes} }})"
        function = self._static(node.func)
        if isinstance(node.func, ast.Attribute) and function is None:
            return self._method_call(node)
        is_own = isinstance(function, FunctionType | type) and function.__module__.startswith("loiter.")
        if not is_own:
            options = [f"{one.arg}: {self.expression(one.value)}" for one in node.keywords if one.arg != "strict"]
            arguments = [*map(self._element, node.args), *([f"{{ {', '.join(options)} }}"] if options else [])]
            return f"{self.expression(node.func)}({', '.join(arguments)})"
        if isinstance(function, type) and issubclass(function, IntEnum | StrEnum):
            self.expression(node.func)
            return self.expression(node.args[0])
        return f"{self.expression(node.func)}({', '.join(self._bound(node, function))})"

    def _method_call(self, node: ast.Call) -> str:
        assert isinstance(node.func, ast.Attribute)
        owner, name = self.expression(node.func.value), node.func.attr
        if owner == "self" and node.keywords and self.cls is not None:
            # Its own methods take their arguments in order.
            return f"self.{safe(name)}({', '.join(self._bound(node, getattr(self.cls, name), skip=1))})"
        if name in METHODS and owner not in MODULES:
            return f"{name}_({', '.join([owner, *map(self._element, node.args)])})"
        if not node.keywords:
            return f"{owner}.{safe(name)}({', '.join(map(self._element, node.args))})"
        options = ", ".join(f"{one.arg}: {self.expression(one.value)}" for one in node.keywords)
        return f"{owner}.{safe(name)}({', '.join([*map(self._element, node.args), f'{{ {options} }}'])})"

    def _bound(self, node: ast.Call, function: Any, skip: int = 0) -> Iterator[str]:
        """The arguments of a call of a known function, in the order of its parameters but for the first `skip`."""
        if isinstance(function, type) and issubclass(function, Exception):
            yield from map(self._element, node.args)
            return
        parameters = list(inspect.signature(function).parameters.values())[skip:]
        rest = [one for one in parameters if one.kind == one.VAR_KEYWORD]
        plain = [one.name for one in parameters if one.kind != one.VAR_KEYWORD]
        texts = list(map(self._element, node.args))
        known = {one.arg: self.expression(one.value) for one in node.keywords if one.arg in plain}
        if known:
            last = max(plain.index(name) for name in known)
            if not any(isinstance(one, ast.Starred) for one in node.args):
                texts += [known.get(name, "undefined") for name in plain[len(texts) : last + 1]]
            else:
                texts += [known[name] for name in plain if name in known]
        elif function.__module__.startswith("loiter.kernel.") and not any(
            isinstance(one, ast.Starred) for one in node.args
        ):
            # Functions of the kernel have no default values in JavaScript.
            texts += [repr(one.default) for one in parameters[len(texts) :]]
        if rest:
            texts += ["undefined"] * (len(plain) - len(texts))
            pairs = [
                f"...iter_items({self.expression(one.value)})"
                if one.arg is None
                else f'["{one.arg}", {self.expression(one.value)}]'
                for one in node.keywords
                if one.arg not in plain
            ]
            texts.append(f"new Map([{', '.join(pairs)}])")
        elif any(one.arg is None for one in node.keywords):
            raise NotTranslated(f"{self.module.__name__}:{node.lineno}: {ast.unparse(node)[:60]!r}")
        yield from texts


def _owner(module: ModuleType, name: str, value: Any) -> ModuleType:
    """The module that defines a global, itself or that from which it is imported."""
    if name in values(module) or name in classes(module) or name in syntax(module):
        return module
    for node in ast.walk(ast.parse(inspect.getsource(module))):
        if isinstance(node, ast.ImportFrom) and any((one.asname or one.name) == name for one in node.names):
            source = sys.modules[node.module or ""]
            return _owner(source, name, value) if source.__name__.startswith("loiter.") else source
    raise NotTranslated(f"{module.__name__}: {name} is defined nowhere")


def _yields(node: ast.FunctionDef) -> bool:
    return any(isinstance(one, ast.Yield | ast.YieldFrom) for part in node.body for one in ast.walk(part))


def _assigned(body: Sequence[ast.AST]) -> Iterator[str]:
    """The names that statements set, but for those of inner functions and comprehensions."""
    for node in body:
        if isinstance(node, ast.FunctionDef):
            yield node.name
        elif isinstance(node, ast.Lambda | ast.ListComp | ast.GeneratorExp | ast.SetComp | ast.DictComp):
            yield from (one.target.id for one in ast.walk(node) if isinstance(one, ast.NamedExpr))
        elif isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
            yield node.id
        else:
            yield from _assigned(list(ast.iter_child_nodes(node)))


def _alternatives(node: ast.expr) -> list[ast.expr]:
    """The classes of a union: `A | B`."""
    match node:
        case ast.BinOp(left=left, op=ast.BitOr(), right=right):
            return [*_alternatives(left), *_alternatives(right)]
    return [node]


def _is_integer(node: ast.expr) -> bool:
    """Whether an expression is an integer by its look, which is written without decimals."""
    match node:
        case ast.Constant(value=int()) | ast.BinOp(left=ast.Call(func=ast.Name(id="len"))):
            return True
        case (
            ast.Call(func=ast.Name(id="len" | "int" | "sum"))
            | ast.Attribute(attr="size")
            | ast.Name(id="MAX_ITEMS" | "MAX_SAMPLES" | "count")
        ):
            return True
    return False


def _with_default(name: str, default: str | None) -> str:
    return safe(name) if default is None else f"{safe(name)} = {default}"


def _in_parentheses(text: str) -> str:
    return f"({text})" if text.startswith("{") else text


def _unique(pattern: str) -> str:
    """A pattern of parameters without repeated names."""
    parts = pattern.split("_,")
    return pattern if len(parts) < 2 else "".join(f"{part}_{i}," for i, part in enumerate(parts[:-1])) + parts[-1]


def _quoted(text: str) -> str:
    import json

    return json.dumps(text)
