"""The files of C, and the functions of the kernel that each of them offers."""

from codegen.arithmetic import DOUBLE, VECTOR
from codegen.unit import ROOT, Unit
from loiter.guidance.identification import identification_step
from loiter.guidance.identification.vehicle import fly_as_declared
from loiter.guidance.laws import law_step
from loiter.kernel import extremals, motion, synthesis, wind_search

FOLDER = ROOT / "src" / "loiter" / "native"

SINGLE = (
    motion.reduce,
    synthesis.status_of,
    synthesis.rounded_radius,
    synthesis.side_or_near,
    synthesis.optimum,
    synthesis.least_time,
    synthesis.first_control,
    synthesis.miss,
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
    synthesis.rounded_radius,
    synthesis.rounding,
    synthesis.least_time,
    extremals.fastest,
    synthesis.arc_tolerance_of,
    synthesis.flown_entry,
    synthesis.is_faster,
    synthesis.first_control,
    synthesis.miss,
)


# In the law the kernel's functions stand in for machine code that Python calls.
LAW_ARITHMETIC = DOUBLE._replace(
    replaced={"entry_in_still_air": synthesis.optimum, "fastest_in_wind": wind_search.fastest}
)


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


def files() -> dict[str, str]:
    """The generated files, by name."""
    return {
        "kernel.h": Unit("kernel.h", DOUBLE, SINGLE).text(),
        "still_air_loops.h": Unit("still_air_loops.h", VECTOR, LOOPED).text(),
    }
