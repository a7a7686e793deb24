"""The applet for ArduPilot: onboard/ardupilot/loiter_entry.lua.

`loiter_entry.lua` beside this file is what is written by hand; `@NAME@` in it is what is generated.
"""

from pathlib import Path
from typing import Any

from codegen.arithmetic import Arithmetic
from codegen.lua import LUA_32BITS, Chunk, note
from codegen.unit import ROOT, digest
from loiter.compiled import solver
from loiter.flight.guiding import hand_over
from loiter.guidance.entry import entry_planner, join_tracking, law_step, limits, plan, tracking
from loiter.guidance.estimation import identification_step, observer, turn_fits
from loiter.guidance.vehicle import fly_as_declared
from loiter.kernel.statuses import Status
from loiter.kernel.still_air import synthesis
from loiter.kernel.wind import wind_search
from loiter.kernel.wind.hold import tightest_radius
from loiter.planning.model import radius_at_bank
from loiter.version import __version__

FOLDER = ROOT / "onboard" / "ardupilot"

APPLET = "loiter_entry.lua"

ROOTS: tuple[Any, ...] = (
    law_step.first_memory,
    law_step.prepare,
    plan.continue_search,
    law_step.conclude,
    fly_as_declared,
    turn_fits.first_turns,
    turn_fits.restart_turns,
    turn_fits.add_turn,
    identification_step.update_airspeeds,
    radius_at_bank,
    tightest_radius,
    synthesis.optimum,
    join_tracking.track,
)

# The functions that the applet has by hand, with these names: they search in wind by `join_tracking`.
BY_HAND: dict[Any, str] = {
    wind_search.begin_search: "begin_in_wind",
    solver.advance: "advance_in_wind",
}

# The kernel's function stands in for machine code that Python calls.
REPLACED = {"entry_in_still_air": synthesis.optimum}

HEAD = """The fastest entry onto a holding circle, for ArduPlane.

Generated from the Python of loiter {version} by `make generate`; do not edit.

SHA-256 of the source: {digest}"""


def law(arithmetic: Arithmetic) -> Chunk:
    """The law and the solvers, for an arithmetic."""
    return Chunk(APPLET, arithmetic._replace(replaced=REPLACED), ROOTS, BY_HAND)


def applet(arithmetic: Arithmetic) -> str:
    """The applet, for an arithmetic."""
    chunk = law(arithmetic)
    head = HEAD.format(version=__version__, digest=digest(chunk.sources()))
    parts = {
        "HEAD": "\n".join(note(head)),
        "LAW": chunk.body(),
        "VERSION": __version__,
        "FIRST_SHIFT": join_tracking.FIRST_SHIFT,
        "ENDED": wind_search.ENDED,
        "NOT_CONVERGED": int(Status.NOT_CONVERGED),
        "NO_DATA": law_step.NO_DATA,
        "HOLD": law_step.HOLD,
        "NOTHING": entry_planner.NOTHING,
        "FIRST_TURN": plan.FIRST_TURN,
        "DOWNWIND_SHARE": hand_over.DOWNWIND_SHARE,
        "LARGEST_SHARE": hand_over.LARGEST_SHARE,
        "GAIN": tracking.GAIN,
        "RESERVE": limits.RESERVE,
        "SMOOTHING": law_step.SMOOTHING_S,
        "NEGLIGIBLE_WIND": limits.NEGLIGIBLE_WIND,
        "EXPECTED_RATIO": turn_fits.EXPECTED_TURN_RATIO,
        "DECLARED_AIRSPEED": identification_step.DECLARED_AIRSPEED_S,
        "DECLARED_TURN_AIRSPEED": identification_step.DECLARED_TURN_AIRSPEED_S,
        "COVERED": observer.COVERED_S,
    }
    text = Path(__file__).with_name(APPLET).read_text("utf-8")
    for key, value in parts.items():
        text = text.replace(f"@{key}@", str(value))
    return text


def applet_files() -> dict[Path, str]:
    """The generated files, by place."""
    return {FOLDER / APPLET: applet(LUA_32BITS)}
