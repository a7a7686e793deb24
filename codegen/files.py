"""The files of C and JavaScript, and the functions of the kernel that each of them offers."""

from pathlib import Path

from codegen.arithmetic import DOUBLE, VECTOR
from codegen.javascript import PORTABLE, Module
from codegen.unit import ROOT, Unit
from loiter.guidance.entry import law_step
from loiter.guidance.estimation import identification_step
from loiter.guidance.estimation.vehicle import fly_as_declared
from loiter.kernel import adjoint, entry, motion, rounding
from loiter.kernel.still_air import extremals, switching_curves, synthesis
from loiter.kernel.wind import hold, wind_search

FOLDER = ROOT / "src" / "loiter" / "native"
PAGE = ROOT / "src" / "loiter" / "web" / "static" / "kernel"

SINGLE = (
    motion.reduce,
    synthesis.status_of,
    rounding.rounded_radius,
    synthesis.side_or_near,
    synthesis.optimum,
    synthesis.least_time,
    entry.first_control,
    entry.miss,
    wind_search.fastest,
    wind_search.scene_of,
    wind_search.sampled_times,
    wind_search.is_local_minimum,
    wind_search.entry_near_sample,
)

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
)

# In the law the kernel's functions stand in for machine code that Python calls.
LAW_REPLACED = {"entry_in_still_air": synthesis.optimum, "fastest_in_wind": wind_search.fastest}
LAW_ARITHMETIC = DOUBLE._replace(replaced=LAW_REPLACED)


# The steps of the law and of the identification, and what stands in for the latter.
STEPS = (
    law_step.first_memory,
    law_step.step,
    identification_step.settings_of,
    identification_step.first_identification,
    identification_step.identify,
    fly_as_declared,
)


def law() -> str:
    """The guidance law and the identification of the vehicle as C; it belongs to no package."""
    return Unit("law.h", LAW_ARITHMETIC, STEPS).text()


def law_module() -> str:
    """What `law` has, as JavaScript; it belongs to no package. Its tangents and exponentials are the browser's."""
    functions = PORTABLE.functions | {name: f"Math.{name}" for name in ("tan", "atan", "exp", "log")}
    arithmetic = PORTABLE._replace(functions=functions, replaced=PORTABLE.replaced | LAW_REPLACED)
    return Module("law.js", arithmetic, STEPS).text()


def files() -> dict[Path, str]:
    """The generated files."""
    return {
        FOLDER / "kernel.h": Unit("kernel.h", DOUBLE, SINGLE).text(),
        FOLDER / "still_air_loops.h": Unit("still_air_loops.h", VECTOR, LOOPED).text(),
        PAGE / "kernel.js": Module("kernel.js", PORTABLE, PLANNING).text(),
    }
