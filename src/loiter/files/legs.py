"""Write the plan of a leg to a file: a map with altitudes, or a mission."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from loiter.errors import InvalidArgument, file_path, instance
from loiter.files.maps.leg_kml import leg_kml
from loiter.files.missions.fences import fence_document
from loiter.files.missions.items import Autopilot
from loiter.files.missions.legs import leg_mission
from loiter.files.missions.qgcplan import qgcplan
from loiter.files.missions.wpl import wpl
from loiter.geo.frame import LocalFrame
from loiter.lazy import LazyModule
from loiter.planning.leg import LegPlan
from loiter.writing import write_content

if TYPE_CHECKING:
    from loiter import fences
else:
    fences = LazyModule("loiter.fences")

# The endings of files that `save_leg` writes.
LEG_FORMATS = (".kml", ".plan", ".waypoints", ".txt")


def save_leg(
    plan: LegPlan,
    path: str | Path,
    *,
    frame: LocalFrame,
    autopilot: Autopilot = Autopilot.ARDUPILOT,
    fence: fences.PlacedFence | None = None,
) -> None:
    """Write the plan of a leg to `path`: .kml for maps, .plan (QGroundControl) or .waypoints and .txt as missions.

    `frame` says where on Earth it is; altitudes are metres above mean sea level. Missions are those of `leg_mission`;
    for PX4 only .plan is. A .plan has the `fence` too. Raises `InvalidArgument` like that, for another ending, and for
    a file that cannot be written: it appears whole or not at all.
    """
    path = Path(file_path("path", path))
    write_content("path", path, leg_content(plan, path, frame, autopilot, fence))


def check_leg_format(path: Path) -> None:
    """Raise `InvalidArgument` unless the ending names a format of legs."""
    if path.suffix.lower() not in LEG_FORMATS:
        raise InvalidArgument("path", f"is {str(path)!r}: the file name must end in {', '.join(LEG_FORMATS)}")


def leg_content(
    plan: LegPlan, path: Path, frame: LocalFrame, autopilot: Autopilot, fence: fences.PlacedFence | None = None
) -> bytes:
    """The content of a file of `save_leg`."""
    instance("plan", plan, LegPlan)
    if fence is not None:
        instance("fence", fence, fences.PlacedFence)
    check_leg_format(path)
    return leg_text(plan, path.suffix.lower(), frame, autopilot, fence and fence_document(fence))


def leg_text(
    plan: LegPlan, ending: str, frame: LocalFrame, autopilot: Autopilot, fence: dict[str, Any] | None = None
) -> bytes:
    """The content of a file with a known ending; `fence` is the geoFence of a .plan."""
    if ending == ".kml":
        instance("frame", frame, LocalFrame)
        return leg_kml(plan, frame)
    if ending != ".plan" and autopilot == Autopilot.PX4:
        raise InvalidArgument("autopilot", f"is px4, which takes no {ending} file: write a .plan file for PX4")
    found = leg_mission(plan, frame, autopilot=autopilot)
    if ending != ".plan":
        return wpl(found)
    return qgcplan(found, autopilot, plan.entry.aircraft.airspeed_m_s, fence)
