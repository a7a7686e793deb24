"""Fences on the command line: their options, whether a plan stays clear, and the fastest entry that does."""

from __future__ import annotations

from dataclasses import dataclass
from math import isfinite
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, NamedTuple

from cyclopts import Parameter
from rich.console import RenderableType

from loiter.cli import report
from loiter.cli.options import Metres, scene
from loiter.errors import InvalidArgument, LoiterError, clause
from loiter.files.document import maneuver_values
from loiter.geo import LocalFrame
from loiter.planning.problem import Problem

if TYPE_CHECKING:
    from numpy import float64
    from numpy.typing import NDArray

    from loiter.fences import ClearEntry, Fence, FenceCheck, PlacedFence
    from loiter.files.missions.items import Mission
    from loiter.files.missions.site import Site
    from loiter.planning.leg import LegPlan
    from loiter.planning.maneuver import Maneuver

# The problem of a fence in metres where places are in degrees.
METRES_ONLY = (
    "is a table in local metres, which goes with --pose and --orbit: give a file with latitudes and longitudes"
)

FenceFile = Annotated[Path | None, Parameter(group=scene, metavar="FILE")]


@Parameter(name="*", group=scene)
@dataclass(frozen=True)
class FenceOptions:
    """A fence, and how far from it the path must stay."""

    fence: FenceFile = None
    """Fence of polygons and circles: .plan of QGroundControl, QGC WPL 110 with fence items, latitudes and longitudes as ArduPilot's fence.txt, or for scenes in metres a .csv with the columns zone, rule (in or out), east_m, north_m and radius_m. A line says whether the plan and its hold stay clear, and if not, where and when they enter which zone, and the fastest clear entry found, which files and pictures then have: exit status 1. That of --orbit-from if absent. A .plan has the fence too."""
    margin: Metres = None
    """Least distance from the fence; if absent, what loiter guide may be beside its path: 5 % of the radius, and 5 m at least."""

    def read(self, site: Site | None) -> PlacedFence | Fence | None:
        """The fence of the file, or that of an existing mission; None without one. Raises `InvalidArgument`.

        A .csv is a table in local metres; all other files have places in degrees.
        """
        if self.fence is not None and self.fence.suffix.lower() == ".csv":
            from loiter.files.fence_table import read_fence_table

            return read_fence_table(self.fence)
        if self.fence is not None:
            from loiter.files.missions.fences import read_fence

            return read_fence(self.fence)
        found = None if site is None else site.fence
        if found is None and self.margin is not None:
            raise InvalidArgument("margin_m", "has no effect without --fence")
        return found


@Parameter(name="*")
@dataclass(frozen=True)
class BatchFenceOptions(FenceOptions):
    """A fence against which each row of a table is checked."""

    fence: FenceFile = None
    """Fence of polygons and circles, in the formats of loiter plan: a .csv where the table is in metres. Columns say whether each row stays clear, and if not, which zone it enters when, and the time of the fastest clear entry found."""


@Parameter(name="*")
@dataclass(frozen=True)
class LegFenceOptions(FenceOptions):
    """A fence, of which a whole leg is checked."""

    fence: FenceFile = None
    """Fence of polygons and circles, in the formats of loiter plan. A line says whether the way in, the whole circle and the way out stay clear, and if not, where and when they enter which zone: exit status 1. A .plan has the fence too."""


class CheckedFence(NamedTuple):
    """A fence in local metres, and whether a plan stays clear of it."""

    fence: Fence
    check: FenceCheck
    placed: PlacedFence | None = None

    def clear_entry(self, problem: Problem) -> ClearEntry | None:
        """The fastest entry found that is clear; None where the plan is."""
        from loiter.fences import clear_entry

        p = problem
        if self.check.clear:
            return None
        return clear_entry(self.fence, p.pose, p.orbit, p.aircraft, p.wind, self.check.margin_m)

    def least_m(self, east_m: NDArray[float64], north_m: NDArray[float64]) -> float:
        """The least distance of points (n,) from the fence, metres, negative on the wrong side of a zone."""
        points = zip(east_m.tolist(), north_m.tolist(), strict=True)
        return min(float(side.min()) for at in points for side in self.fence.signed_distances(*at) if side.size)

    @property
    def drawn(self) -> dict[str, Any]:
        """What a picture shows of it, as arguments."""
        return {"fence": self.fence, "breaches": self.check.breaches}

    def lines(self, entry: ClearEntry | None, frame: LocalFrame | None) -> list[RenderableType]:
        """Whether the plan stays clear and, where it does not, the entry that does as a sentence and a table."""
        lines: list[RenderableType] = [self.check.sentence(frame)]
        if entry is None or entry.maneuver is None:
            return lines + ([] if entry is None else [entry.sentence])
        lines += [entry.sentence, *([report.table(entry.maneuver, frame)] if entry.maneuver.segments else [])]
        least = report.seconds(entry.maneuver, entry.least_s)
        return [*lines, f"No clear entry joins before {least}; files and pictures have the clear entry."]

    def document(self, entry: ClearEntry | None, frame: LocalFrame | None) -> dict[str, object]:
        """The check and, where the plan is not clear, the entry that is, for JSON."""
        if entry is None:
            return self.check.to_dict(frame)
        least_s = entry.least_s if isfinite(entry.least_s) else None
        flown = entry.maneuver
        values = None if flown is None else maneuver_values(flown, frame) | {"later_s": entry.later_s}
        return self.check.to_dict(frame) | {"clear_entry": values, "least_s": least_s, "blocking": entry.blocking}


def check_fence(
    options: FenceOptions, site: Site | None, maneuver: Maneuver | LegPlan, frame: LocalFrame | None
) -> CheckedFence | None:
    """Whether a plan or a leg stays clear of the fence of the options or of a mission; None without a fence."""
    try:
        found = options.read(site)
        if found is None:
            return None
        from loiter.fences import Fence

        if isinstance(found, Fence):
            if frame is not None:
                raise InvalidArgument("fence", METRES_ONLY)
            return CheckedFence(found, found.check(maneuver, options.margin))
        if frame is None:
            raise InvalidArgument("fence", "goes with --pose-lla and --orbit-lla: its places are in degrees")
        fence = found.local(frame)
    except InvalidArgument as error:
        if error.argument.startswith("zone "):
            raise InvalidArgument("fence", f"cannot be used: {error}") from error
        raise
    return CheckedFence(fence, fence.check(maneuver, options.margin), found)


class NotSent(NamedTuple):
    """What a file has beside its mission, which is not sent: zones of a fence, and rally points."""

    zones: int = 0
    rally_points: int = 0

    @property
    def lines(self) -> list[str]:
        """What a user must know about it."""
        lines = []
        if self.zones:
            lines.append(
                f"The file's own fence, zones: {self.zones}, is not sent: send it from your ground station. The lines and "
                "circles of the mission stay clear of it. Not checked are the way to its first item, the turns between "
                "lines, and loiters without a radius."
            )
        if self.rally_points:
            lines.append(f"Its rally points, {self.rally_points}, are not sent either: send them from there too.")
        return lines


def check_own_fence(path: Path, mission: Mission) -> NotSent:
    """What is not sent with the mission of a file; `InvalidArgument` where it enters the file's own fence."""
    from loiter.files.missions.own_fence import mission_breach
    from loiter.files.missions.site import read_site

    site = read_site(path, "mission")
    if site.fence is None:
        return NotSent(0, site.rally_points)
    try:
        breach = mission_breach(mission, site.fence)
    except LoiterError as error:
        raise InvalidArgument(
            "mission", f"file {str(path)!r}: its own fence cannot be checked, and nothing is sent: {clause(str(error))}"
        ) from error
    if breach:
        raise InvalidArgument("mission", f"file {str(path)!r}: {breach} of its own fence: nothing is sent")
    return NotSent(len(site.fence.zones), site.rally_points)
