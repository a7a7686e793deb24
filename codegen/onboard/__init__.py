"""C for autopilots: onboard/c/loiter.h and loiter.c, in double or single precision by one macro.

`loiter.h` and `loiter.c` beside this file are what is written by hand; `@NAME@` in them is what is generated.
"""

from collections.abc import Iterator
from pathlib import Path
from types import FunctionType

from codegen.arithmetic import FUNCTIONS, ONBOARD
from codegen.expressions import Expressions, Names
from codegen.kinds import Kind, NotTranslated, kind_of_type
from codegen.statements import comment, wrapped
from codegen.unit import ROOT, Unit, digest
from loiter.guidance.entry import entry_planner, law_step
from loiter.guidance.entry.law_step import Memory, Settings
from loiter.guidance.estimation import bank_history
from loiter.guidance.estimation.vehicle import VehicleModel, fly_as_declared
from loiter.guidance.vehicle import rolling
from loiter.kernel import motion
from loiter.kernel.rounding import rounded_radius
from loiter.kernel.statuses import Status
from loiter.kernel.still_air import synthesis
from loiter.kernel.wind import wind_search
from loiter.planning import model
from loiter.version import __version__

FOLDER = ROOT / "onboard" / "c"

# In the law the kernel's functions stand in for machine code that Python calls.
ARITHMETIC = ONBOARD._replace(
    replaced={"entry_in_still_air": synthesis.optimum, "advance_in_wind": wind_search.advance_search}
)

ROOTS = (
    motion.reduce,
    rounded_radius,
    synthesis.optimum,
    wind_search.status_of,
    wind_search.begin_search,
    wind_search.advance_search,
    wind_search.entry_of,
    model.radius_at_bank,
    fly_as_declared,
    law_step.first_memory,
    law_step.plan_by_clock,
    law_step.advance,
)

# Functions that are not inlined, so that their memory on the stack does not add up.
APART = (
    law_step.prepare,
    law_step.take_entry,
    law_step.conclude,
    entry_planner.begin_in_air,
    wind_search.advance_search,
)

HEAD = """{title}

Generated from the Python of loiter {version} by `make generate`; do not edit.

SHA-256 of the source: {digest}"""

TITLES = {
    "loiter.h": (
        "The fastest way onto a holding circle, and the guidance law that flies it, for autopilots: docs/onboard.md."
        "\n\nDouble or single precision; no memory is allocated, nothing is kept between calls but what the caller "
        "holds, and of the C library only math.h is needed. No function calls itself. Compile with -ffp-contract=off, "
        "and never with -ffast-math."
    ),
    "loiter.c": "The functions of loiter.h, C99 and C++.",
}

# A ring is changed where it is: filled with one element; with another last element; and without its first one besides.
RING = """typedef loiter_{ring} *{ring};

static inline {ring} {ring}_filled({ring} ring, {element} one) {{
    for (int i = 0; i < {length}; i++) {{
        ring->at[i] = one;
    }}
    return ring;
}}

static inline {ring} {ring}_with_last({ring} ring, {element} last) {{
    ring->at[{last}] = last;
    return ring;
}}

static inline {ring} {ring}_appended({ring} ring, {element} last) {{
    for (int i = 0; i < {last}; i++) {{
        ring->at[i] = ring->at[i + 1];
    }}
    ring->at[{last}] = last;
    return ring;
}}"""

SIMPLE = {"real": "loiter_real", "integer": "loiter_integer", "bool": "bool"}


def kinds_within(kind: Kind) -> Iterator[Kind]:
    """A structure and those of its fields, these first."""
    for _, inner in kind.fields:
        yield from kinds_within(inner)
    if kind.fields:
        yield kind


def exported_name(kind: Kind) -> str:
    """The name of a kind in the header; for a ring, that of a pointer to it."""
    return f"loiter_{kind.name} *" if kind.length else SIMPLE.get(kind.name, f"loiter_{kind.name}")


def declared(kind: Kind) -> Iterator[str]:
    """The declaration of a structure in the header."""
    if kind.length:
        ((_, element),) = kind.fields
        yield f"typedef struct {{ loiter_{element.name} at[{kind.length}]; }} loiter_{kind.name};"
        return
    runs: list[tuple[str, list[str]]] = []
    for name, inner in kind.fields:
        if runs and runs[-1][0] == exported_name(inner) and not inner.length:
            runs[-1][1].append(name)
        else:
            runs.append((exported_name(inner), [name]))
    fields = " ".join(f"{title}{'' if title.endswith('*') else ' '}{', '.join(names)};" for title, names in runs)
    yield from wrapped(f"typedef struct {{ {fields} }} loiter_{kind.name};")


class OnboardUnit(Unit):
    """The generated part of loiter.c, whose structures of the law's state the header declares."""

    def __init__(self) -> None:
        of_state = [kind_of_type(one, "") for one in (wind_search.WindSearch, Settings, VehicleModel, Memory)]
        self.exported = list(dict.fromkeys(one for kind in of_state for one in kinds_within(kind)))
        self.rings = [kind for kind in self.exported if kind.length]
        fields = [inner for kind in self.exported for _, inner in kind.fields if inner.length]
        if len(set(fields)) < len(fields):
            raise NotTranslated("the state of the law has two rings of one kind, which would be one ring on board")
        super().__init__("loiter.c", ARITHMETIC, ROOTS)

    def _structure_lines(self, kind: Kind) -> Iterator[str]:
        if kind.length:
            ((_, element),) = kind.fields
            yield RING.format(ring=kind.name, element=element.name, length=kind.length, last=kind.length - 1)
        elif kind in self.exported:
            yield f"typedef loiter_{kind.name} {kind.name};"
        else:
            yield from super()._structure_lines(kind)

    def storage(self, function: FunctionType) -> str:
        """What stands before a function."""
        return "static APART" if function in APART else super().storage(function)

    def parts(self) -> dict[str, str]:
        """What stands for the names of the templates."""
        literal = Expressions(Names(self.arithmetic, {}, {}, {}, self._add, self._constant), "").literal
        roll = rolling.Roll()
        rings = " ".join(f"loiter_{ring.name} {ring.name};" for ring in self.rings)
        search = list(kinds_within(kind_of_type(wind_search.WindSearch, "")))
        of_law = [line for kind in self.exported if kind not in search for line in declared(kind)]
        return {
            "STATUSES": "\n".join(f"    LOITER_{status.name} = {int(status)}," for status in Status),
            "SEARCH": "\n".join(line for kind in dict.fromkeys(search) for line in declared(kind)),
            "STRUCTURES": "\n".join([*of_law, f"typedef struct {{ {rings} }} loiter_Rings;"]),
            "FLOAT_FUNCTIONS": "\n".join(f"#define real_{name} {name}f" for name in FUNCTIONS),
            "DOUBLE_FUNCTIONS": "\n".join(f"#define real_{name} {name}" for name in FUNCTIONS),
            "TYPEDEFS": "typedef loiter_Rings Rings;",
            "GENERATED": self.body(),
            "ROLL_TIME": literal(roll.time_s),
            "ROLL_RATE": literal(roll.rate_deg_s),
            "DELAY": literal(law_step.DELAY_S),
            "RESERVE": literal(law_step.RESERVE),
            "SMOOTHING": literal(law_step.SMOOTHING_S),
            "GAIN": literal(law_step.GAIN),
            "COVERED": literal(bank_history.COVERED_S),
        }


def onboard_files() -> dict[Path, str]:
    """The generated files for autopilots, by place."""
    unit = OnboardUnit()
    parts = unit.parts()
    found = {}
    for name, title in TITLES.items():
        head = HEAD.format(title=title, version=__version__, digest=digest(unit.sources()))
        text = Path(__file__).with_name(name).read_text("utf-8")
        for key, value in {**parts, "HEAD": "\n".join(comment(head))}.items():
            text = text.replace(f"@{key}@", value)
        found[FOLDER / name] = text
    return found
