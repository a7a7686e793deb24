"""C for autopilots: onboard/c/loiter.h and loiter.c, in double or single precision by one macro.

`loiter.h` and `loiter.c` beside this file are what is written by hand; `@NAME@` in them is what is generated.
"""

from collections.abc import Iterator, Sequence
from pathlib import Path
from types import FunctionType
from typing import Any

from codegen.arithmetic import FUNCTIONS, ONBOARD, Arithmetic
from codegen.expressions import Expressions, Names
from codegen.kinds import Kind, NotTranslated, kind_of_type
from codegen.statements import comment, wrapped
from codegen.unit import RING as VALUE_RING
from codegen.unit import ROOT, Unit, digest
from loiter.guidance import settings
from loiter.guidance.entry import entry_planner, law_step, limits, plan, tracking
from loiter.guidance.entry.law_step import Memory
from loiter.guidance.entry.limits import Settings
from loiter.guidance.estimation import identification_step, observer
from loiter.guidance.estimation.identification_step import Identification, IdentificationSettings
from loiter.guidance.estimation.turn_fits import EXPECTED_TURN_RATIO
from loiter.guidance.estimation.wind_fit import DECLARED_WIND_S
from loiter.guidance.vehicle import Roll, VehicleModel, fly_as_declared
from loiter.kernel import motion
from loiter.kernel.rounding import rounded_radius
from loiter.kernel.statuses import Status
from loiter.kernel.still_air import synthesis
from loiter.kernel.wind import wind_search
from loiter.planning import model
from loiter.version import __version__

FOLDER = ROOT / "onboard" / "c"

# The statuses that the C returns, and what they say there.
STATUSES = {
    Status.OK: "There is an answer.",
    Status.NOT_FINITE: "A number of the problem is nan or infinite.",
    Status.RADIUS_TOO_SMALL: "The circle is below the least turn radius, airspeed^2 / (9.80665 * tan(bank limit)).",
    Status.OUT_OF_RANGE: "The position or the radius is beyond 2^23 turn radii in single precision, 2^52 in double.",
    Status.BAD_TOLERANCE: "The tolerance is negative, or beyond the same bounds.",
    Status.BAD_AIRCRAFT: "The airspeed is not within 0 to 1000 m/s, or the bank limit not within 0 to 90 degrees.",
    Status.BAD_ORBIT: "The radius is not a positive, finite number.",
    Status.BAD_TURN: "The side is none of LOITER_CW, LOITER_CCW and LOITER_EITHER.",
    Status.BAD_POSE: "(c, s) of the problem is not a unit vector.",
    Status.WIND_TOO_STRONG: "The wind is as fast as the aircraft, or faster.",
    Status.NOT_HELD: (
        "The circle is too tight for this wind: (airspeed + wind)^2 / (9.80665 * tan(bank limit)) exceeds its radius."
    ),
    Status.NOT_CONVERGED: "The search found no entry that ends on the circle.",
    Status.BAD_WIND: "The wind is nan or infinite.",
}

# In the law the kernel's functions stand in for machine code that Python calls.
# Its rings are apart from its memory, which is passed by value in places: within it a step would take 16.9 kB of stack.
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
    plan.plan_by_clock,
    law_step.advance,
)

# Functions that are not inlined, so that their memory on the stack does not add up.
APART = (
    law_step.prepare,
    plan.take_entry,
    law_step.conclude,
    entry_planner.begin_in_air,
    identification_step.begin_identification,
    identification_step.advance_identification,
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
    "loiter_identification.h": (
        "Identification of the vehicle in flight, for the law of loiter.h: docs/onboard.md. Without it this "
        "file and loiter_identification.c are left out."
    ),
    "loiter_identification.c": "The functions of loiter_identification.h, C99 and C++.",
}

# The identification, whose rings are in its state.
IDENTIFICATION_ARITHMETIC = ARITHMETIC._replace(in_place=False)
IDENTIFICATION_ROOTS = (
    identification_step.settings_of,
    identification_step.begin_identification,
    identification_step.advance_identification,
)

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


def exported_name(kind: Kind, in_place: bool) -> str:
    """The name of a kind in the header; for a ring in place, that of a pointer to it."""
    is_pointer = kind.length and in_place
    return f"loiter_{kind.name} *" if is_pointer else SIMPLE.get(kind.name, f"loiter_{kind.name}")


def declared(kind: Kind, in_place: bool) -> Iterator[str]:
    """The declaration of a structure in the header."""
    if kind.length:
        ((_, element),) = kind.fields
        yield f"typedef struct {{ {exported_name(element, False)} at[{kind.length}]; }} loiter_{kind.name};"
        return
    runs: list[tuple[str, list[str]]] = []
    for name, inner in kind.fields:
        if runs and runs[-1][0] == exported_name(inner, in_place) and not inner.length:
            runs[-1][1].append(name)
        else:
            runs.append((exported_name(inner, in_place), [name]))
    fields = " ".join(f"{title}{'' if title.endswith('*') else ' '}{', '.join(names)};" for title, names in runs)
    yield from wrapped(f"typedef struct {{ {fields} }} loiter_{kind.name};")


def kinds_of(*states: type) -> list[Kind]:
    """The structures of which states consist, each after those of its fields."""
    kinds = [kind_of_type(one, "") for one in states]
    return list(dict.fromkeys(one for kind in kinds for one in kinds_within(kind)))


class OnboardUnit(Unit):
    """The generated part of a file, whose structures of the state are declared in headers."""

    def __init__(self, title: str, arithmetic: Arithmetic, roots: Sequence[Any], exported: list[Kind]) -> None:
        self.exported = exported
        self.rings = [kind for kind in exported if kind.length]
        fields = [inner for kind in exported for _, inner in kind.fields if inner.length]
        if arithmetic.in_place and len(set(fields)) < len(fields):
            raise NotTranslated("the state of the law has two rings of one kind, which would be one ring on board")
        super().__init__(title, arithmetic, roots)

    def _structure_lines(self, kind: Kind) -> Iterator[str]:
        if kind.length:
            ((_, element),) = kind.fields
            template = RING
            if not self.arithmetic.in_place:
                _, _, functions = VALUE_RING.partition("\n")
                template = f"typedef loiter_{{ring}} {{ring}};\n{functions}"
            yield template.format(ring=kind.name, element=element.name, length=kind.length, last=kind.length - 1)
        elif kind in self.exported:
            yield f"typedef loiter_{kind.name} {kind.name};"
        else:
            yield from super()._structure_lines(kind)

    def storage(self, function: FunctionType) -> str:
        """What stands before a function."""
        return "static APART" if function in APART else super().storage(function)

    def literal(self, value: float) -> str:
        """A number of the arithmetic."""
        return Expressions(Names(self.arithmetic, {}, {}, {}, self._add, self._constant), "").literal(value)

    def parts(self) -> dict[str, str]:
        """What stands for the names of the templates of every file."""
        return {
            "ARITHMETIC": Path(__file__).with_name("arithmetic.c").read_text("utf-8").rstrip("\n"),
            "FLOAT_FUNCTIONS": "\n".join(f"#define real_{name} {name}f" for name in FUNCTIONS),
            "DOUBLE_FUNCTIONS": "\n".join(f"#define real_{name} {name}" for name in FUNCTIONS),
            "GENERATED": self.body(),
        }


def law_unit() -> tuple[OnboardUnit, dict[str, str]]:
    """The kernel and the law, and what stands for the names of their templates."""
    search, exported = (
        kinds_of(wind_search.WindSearch),
        kinds_of(wind_search.WindSearch, Settings, VehicleModel, Memory),
    )
    unit, roll = OnboardUnit("loiter.c", ARITHMETIC, ROOTS, exported), Roll()
    rings = " ".join(f"loiter_{ring.name} {ring.name};" for ring in unit.rings)
    of_law = [line for kind in exported if kind not in search for line in declared(kind, True)]
    return unit, {
        **unit.parts(),
        "STATUSES": "\n".join(
            f"    /* {text} */\n    LOITER_{status.name} = {int(status)}," for status, text in STATUSES.items()
        ),
        "SEARCH": "\n".join(line for kind in search for line in declared(kind, True)),
        "STRUCTURES": "\n".join([*of_law, f"typedef struct {{ {rings} }} loiter_Rings;"]),
        "TYPEDEFS": "typedef loiter_Rings Rings;",
        "LARGEST_SETTING": unit.literal(settings.LARGEST_SETTING),
        "LEAST_ROLL_RATE": unit.literal(settings.LEAST_ROLL_RATE_DEG_S),
        "LEAST_ROLL_TIME": unit.literal(settings.LEAST_ROLL_TIME_S),
        "ROLL_TIME": unit.literal(roll.time_s),
        "ROLL_RATE": unit.literal(roll.rate_deg_s),
        "DELAY": unit.literal(law_step.DELAY_S),
        "RESERVE": unit.literal(limits.RESERVE),
        "SMOOTHING": unit.literal(law_step.SMOOTHING_S),
        "GAIN": unit.literal(tracking.GAIN),
        "LONGEST_STEP": f"{law_step.LONGEST_STEP_S:.0f}",
        "COVERED": unit.literal(observer.COVERED_S),
    }


def identification_unit(of_law: list[Kind]) -> tuple[OnboardUnit, dict[str, str]]:
    """The identification, and what stands for the names of its templates; the header of the law has its structures."""
    exported = kinds_of(IdentificationSettings, Identification)
    unit = OnboardUnit("loiter_identification.c", IDENTIFICATION_ARITHMETIC, IDENTIFICATION_ROOTS, exported)
    return unit, {
        **unit.parts(),
        "STRUCTURES": "\n".join(line for kind in exported if kind not in of_law for line in declared(kind, False)),
        "TURN_RATIO": unit.literal(EXPECTED_TURN_RATIO),
        "NEGLIGIBLE_WIND": unit.literal(limits.NEGLIGIBLE_WIND),
        "WIND_KNOWN": unit.literal(DECLARED_WIND_S),
    }


def onboard_files() -> dict[Path, str]:
    """The generated files for autopilots, by place."""
    law = law_unit()
    identification, found = identification_unit(law[0].exported), {}
    for name, title in TITLES.items():
        unit, parts = identification if "identification" in name else law
        head = HEAD.format(title=title, version=__version__, digest=digest(unit.sources()))
        text = Path(__file__).with_name(name).read_text("utf-8")
        for key, value in {**parts, "HEAD": "\n".join(comment(head))}.items():
            text = text.replace(f"@{key}@", value)
        # The arithmetic has names itself.
        for key in ("FLOAT_FUNCTIONS", "DOUBLE_FUNCTIONS"):
            text = text.replace(f"@{key}@", parts[key])
        found[FOLDER / name] = text
    return found
