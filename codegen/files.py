"""The files of C and JavaScript, and the functions of the kernel that each of them offers."""

import re
from pathlib import Path

from codegen.arithmetic import DOUBLE, VECTOR
from codegen.javascript import PORTABLE, Module
from codegen.kinds import NotTranslated
from codegen.library import Library
from codegen.unit import ROOT, Unit
from loiter.arrays import partition  # noqa: F401
from loiter.guidance.entry import law_step
from loiter.guidance.estimation import identification_step
from loiter.guidance.vehicle import fly_as_declared
from loiter.kernel import adjoint, entry, motion, rounding, words
from loiter.kernel.still_air import extremals, switching_curves, synthesis, value_gradient
from loiter.kernel.wind import held, hold, paths, slots, way_out, wind_search
from loiter.page.answers import fences, legs, plans, refusals  # noqa: F401
from loiter.page.answers import files as answer_files  # noqa: F401
from loiter.version import __version__

FOLDER = ROOT / "src" / "loiter" / "native"
PAGE = ROOT / "src" / "loiter" / "page" / "source" / "kernel"

SINGLE = (
    motion.reduce,
    synthesis.status_of,
    rounding.rounded_radius,
    synthesis.side_or_near,
    synthesis.optimum,
    synthesis.least_time,
    entry.first_control,
    entry.miss,
    value_gradient.value_gradient,
    wind_search.fastest,
    wind_search.scene_of,
    wind_search.sampled_times,
    wind_search.is_local_minimum,
    wind_search.entry_near_sample,
    slots.first_in_slot,
    paths.path_to_pose,
)

# The state of a search, which would take longer to copy than a step of the search, is passed by address.
LARGE = 32

LOOPED = (
    motion.reduce,
    synthesis.side_or_near,
    synthesis.is_solvable,
    synthesis.status_of,
    rounding.rounded_radius,
    rounding.rounding,
    synthesis.least_time,
    extremals.fastest,
    rounding.arc_tolerance_of,
    synthesis.flown_entry,
    entry.is_faster,
    entry.first_control,
    entry.miss,
)

# Everything that the page needs.
PLANNING = (
    motion.reduce,
    motion.fly,
    motion.flow,
    synthesis.status_of,
    rounding.rounded_radius,
    synthesis.optimum,
    synthesis.optima,
    synthesis.ranked,
    synthesis.least_time,
    synthesis.side_or_near,
    entry.first_control,
    entry.miss,
    entry.is_tie_in_wind,
    adjoint.adjoint,
    adjoint.turn_adjoint,
    adjoint.switching_function,
    switching_curves.region,
    switching_curves.last_arc_abscissa,
    hold.hold_pose,
    hold.hold_rate,
    hold.phase_of,
    wind_search.fastest,
    wind_search.optima,
    wind_search.ranked,
    wind_search.entry_of,
    wind_search.scene_of,
    way_out.exit_point,
    way_out.least_width,
    way_out.soonest_exit,
    way_out.entry_before,
    slots.less_whole_turns,
    held.time_held,
    held.width_held,
    slots.first_in_slot,
    paths.path_to_pose,
    words.controls,
    words.set_of,
)

# In the law the kernel's functions stand in for machine code that Python calls.
LAW_REPLACED = {"entry_in_still_air": synthesis.optimum, "advance_in_wind": wind_search.advance_search}
LAW_ARITHMETIC = DOUBLE._replace(replaced=LAW_REPLACED)


# The steps of the law and of the identification, and what stands in for the latter.
STEPS = (
    law_step.first_memory,
    law_step.step,
    identification_step.settings_of,
    identification_step.begin_identification,
    identification_step.identify,
    fly_as_declared,
)


def law() -> str:
    """The guidance law and the identification of the vehicle as C; it belongs to no package."""
    return Unit("law.h", LAW_ARITHMETIC, STEPS).text()


# Only a bound on the steps of the search for slots has an exponential: it is the browser's.
PAGE_ARITHMETIC = PORTABLE._replace(functions=PORTABLE.functions | {"exp": "Math.exp"})

# What the page needs above the kernel, and what it has elsewhere than in Python.
ABOVE_KERNEL = (
    ("loiter.page.answers.plans", "plan"),
    ("loiter.page.answers.plans", "certificate"),
    ("loiter.page.answers.plans", "first_maneuver"),
    ("loiter.page.answers.tracks", "lap"),
    ("loiter.page.answers.legs", "leg_plan"),
    ("loiter.page.answers.legs", "leg_fence_check"),
    ("loiter.page.answers.legs", "leg_file"),
    ("loiter.page.answers.fences", "fence_check"),
    ("loiter.page.answers.fences", "clear_plan"),
    ("loiter.page.answers.fences", "clear_maneuver"),
    ("loiter.fences.model", "CircleZone"),
    ("loiter.fences.model", "PolygonZone"),
    ("loiter.fences.fence", "Fence"),
    ("loiter.page.answers.files", "check_points"),
    ("loiter.files.formats", "FILE_FORMATS"),
    ("loiter.files.formats", "SaveArguments"),
    ("loiter.files.missions.altitudes", "AltitudeDatum"),
    ("loiter.files.missions.items", "AUTOPILOTS"),
    ("loiter.page.answers.refusals", "SCENE_FIELDS"),
    ("loiter.planning.model", "Pose"),
    ("loiter.planning.model", "Orbit"),
    ("loiter.planning.model", "Aircraft"),
    ("loiter.planning.model", "Wind"),
    ("loiter.planning.problem", "Problem"),
    ("loiter.planning.slot", "Slot"),
    ("loiter.planning.slot", "slot_pose"),
    ("loiter.planning.compass", "heading_vector"),
    ("loiter.planning.maneuver", "Maneuver"),
    ("loiter.planning.drawing", "drawn_svg"),
    ("loiter.geo.frame", "LocalFrame"),
    ("loiter.files.document", "PlacedProblem"),
    ("loiter.arrays.partition", "_kind"),
    ("loiter.arrays.partition", "NARROW"),
    ("loiter.arrays.partition", "SHARE"),
    ("loiter.arrays.partition", "JUMP"),
    ("loiter.arrays.partition", "LARGEST_GAP"),
    ("loiter.arrays.partition", "VANISHING"),
)
ELSEWHERE = {
    ("loiter.errors", "LoiterError"): "errors.LoiterError",
    ("loiter.errors", "InvalidArgument"): "errors.InvalidArgument",
    ("loiter.errors", "RadiusTooSmall"): "errors.RadiusTooSmall",
    ("loiter.errors", "WindTooStrong"): "errors.WindTooStrong",
    ("loiter.errors", "NotConverged"): "errors.NotConverged",
    ("loiter.errors", "OutOfRange"): "errors.OutOfRange",
    ("loiter.errors", "instance"): "arrays.unchecked",
    ("loiter.errors", "in_unit"): "arrays.same",
    ("loiter.errors", "as_float"): "float",
    ("loiter.errors", "_refuse"): "arrays.refuse",
    ("loiter.geo.frame", "to_plane"): "geodesic.to_plane",
    ("loiter.geo.frame", "from_plane"): "geodesic.from_plane",
    ("loiter.arrays.reduction", "reduce"): "arrays.reducer(heading_vector)",
    ("loiter.planning.flight", "_fly_arrays"): "arrays.fly_arrays",
    ("loiter.compiled.solver", "fastest"): "kernel.wind_search_fastest",
    ("loiter.compiled.solver", "ranked"): "kernel.wind_search_ranked",
    ("loiter.compiled.solver", "optima"): "kernel.wind_search_optima",
    ("loiter.compiled.solver", "optimum"): "kernel.optimum",
    ("loiter.arrays.still_air", "min_time"): "arrays.min_time",
    ("loiter.arrays.wind", "min_time_in_wind"): "arrays.min_time_in_wind",
    ("loiter.fences.airs", "_paths_to_poses"): "arrays.path_to_pose",
    ("loiter.fences.airs", "_optima"): "arrays.optima",
    ("loiter.fences.airs", "_optima_in_wind"): "arrays.optima_in_wind",
    ("loiter.kernel.motion", "reduce"): "arrays.reduce_states",
    # The page has no string pulled taut, which needs shapely: its bound is the fastest entry.
    ("loiter.fences.taut", "least_length_m"): "arrays.no_length",
    ("loiter.fences.model", "_invalidity"): "shapes.invalidity",
    ("loiter.fences.model", "_gap_m"): "shapes.gap_m",
    ("loiter.compiled.solver", "first_in_slot"): "kernel.first_in_slot",
    ("loiter.certificate.slot_check", "NODES"): "arrays.NODES",
    ("loiter.certificate.slot_check", "WEIGHTS"): "arrays.WEIGHTS",
    ("loiter.kernel.words", "encode"): "arrays.encode",
    ("loiter.certificate.trajectory", "word_of"): "arrays.word_of",
}
LIBRARY_HEAD = """// @ts-nocheck
// What is between the kernel and the page: problems, maneuvers, their answers, certificates and files.
// Generated from the Python of loiter {version} by `make generate`; do not edit.
import * as errors from "./errors.js";
import * as geodesic from "./geodesic.js";
import * as kernel from "./kernel.js";
import * as arrays from "./arrays.js";
import * as shapes from "./shapes.js";
import {{ Complex, np }} from "./numpy.js";
import {{ {names} }} from "./python.js";
import {{ shapely }} from "./shapes.js";

"""


def library_module(kernel: Module) -> str:
    """What the page needs above the kernel, as an ES module."""
    library = Library(ABOVE_KERNEL, kernel.name, ELSEWHERE)
    text = library.text()
    python = (PAGE / "python.js").read_text("utf-8")
    offered = set(re.findall(r"^export (?:const|function) (\w+)", kernel.text(), re.MULTILINE))
    if missing := set(re.findall(r"\bkernel\.(\w+)", text)) - offered:
        raise NotTranslated(f"kernel.js has no {', '.join(sorted(missing))}")
    known = set(re.findall(r"^export (?:const|function\*?|class) (\w+)", python, re.MULTILINE)) | {"complex"}
    used = set(re.findall(r"\b\w+\b", text)) & known
    if missing := library.builtins - known:
        raise NotTranslated(f"python.js has no {', '.join(sorted(missing))}")
    numpy = re.findall(r"\b\w+\b", (PAGE / "numpy.js").read_text("utf-8").partition("export const np = {")[2])
    if missing := set(re.findall(r"\bnp\.(\w+)", text)) - {*numpy, "intp"}:
        raise NotTranslated(f"numpy.js has no {', '.join(sorted(missing))}")
    return LIBRARY_HEAD.format(version=__version__, names=", ".join(sorted(used))) + text


def files() -> dict[Path, str]:
    """The generated files."""
    kernel = Module("kernel.js", PAGE_ARITHMETIC, PLANNING)
    return {
        FOLDER / "kernel.h": Unit("kernel.h", DOUBLE._replace(large=LARGE), SINGLE).text(),
        FOLDER / "still_air_loops.h": Unit("still_air_loops.h", VECTOR, LOOPED).text(),
        PAGE / "kernel.js": kernel.text(),
        PAGE / "library.js": library_module(kernel),
    }
