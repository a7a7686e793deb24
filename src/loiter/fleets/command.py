"""`loiter fleet`: several aircraft onto one circle, each into a slot, as a table or JSON, pictures and files."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, NamedTuple

from cyclopts import Parameter
from rich.console import RenderableType
from rich.table import Table

from loiter.cli import report
from loiter.cli.numbers import column_mapping, metres, one
from loiter.cli.options import (
    AutopilotChoice,
    Columns,
    Files,
    Fit,
    Json,
    Metres,
    MissionOptions,
    OrbitOptions,
    PictureOptions,
    PlannedAircraftOptions,
    WindOptions,
    scene,
)
from loiter.cli.output import Output
from loiter.cli.scenes import CircleRead, fit_proposed, read_circle
from loiter.cli.sentences import argument_names
from loiter.errors import InvalidArgument, positive
from loiter.files.formats import FILE_FORMATS, SaveArguments, check_format, fleet_contents, is_mission
from loiter.files.missions.items import AUTOPILOTS, AutopilotName
from loiter.fleets.planning import FleetPlan, rounded_down, slot_tracks
from loiter.fleets.planning import fleet as plan_fleet
from loiter.planning.compass import heading_of
from loiter.planning.maneuver import decimals_of
from loiter.planning.model import Pose
from loiter.writing import write_content

if TYPE_CHECKING:
    from loiter.files.missions.site import Site
    from loiter.fleets.table import FleetTable

# What missions of a fleet are not.
NO_SLOTS = "An autopilot flies a mission in its own time: it does not keep the slot."


@Parameter(name="*", group=scene)
@dataclass(frozen=True)
class SpacingOptions:
    """How far apart the aircraft stay."""

    separation: Annotated[float, Parameter(converter=one(metres), metavar="METRES")] = 0.0
    """Least horizontal distance between two aircraft, at all times; where no plan that was tried keeps it, those that come too close get different altitudes."""
    reserve: Annotated[float, Parameter(metavar="SHARE")] = 0.0
    """Take slots that aircraft still reach in time if they are late by up to this share of their time, as they are in gusts."""
    layer_height: Metres = None
    """Vertical distance of altitude layers, upwards from --altitude; the separation if absent."""

    @property
    def layer_height_m(self) -> float:
        """The distance of altitude layers."""
        height = self.layer_height
        return self.separation if height is None else positive("layer_height_m", height, "metres")


Mapped = Annotated[
    Columns,
    Parameter(
        group=scene,
        help="The column of the table that holds a quantity, if it has another name or unit: east_m='X_East [ft]'; may be repeated. Its unit is at the end of its name, or added in brackets.",
    ),
]
SAVED = [str(known) for known in FILE_FORMATS if known.kind != "table"]
Save = Annotated[
    Files,
    Parameter(
        help=f"Write the plan to a file: {', '.join(SAVED)}; may be repeated. A map has all aircraft; a mission is written for each, FILE-NAME.plan.",
    ),
]


@Parameter(name="*")
@dataclass(frozen=True)
class FleetMissionOptions(MissionOptions):
    """Missions of a fleet; --path is hidden: they have waypoints all along the path, which may be a detour."""

    path: Annotated[bool, Parameter(show=False)] = True


def fleet(
    table: Annotated[
        Path,
        Parameter(
            name="FILE",
            help="A CSV file with a row for each aircraft: east_m, north_m and heading_deg, or latitude_deg and longitude_deg; optionally name.",
        ),
    ],
    /,
    *,
    map_: Mapped = None,
    circle: OrbitOptions = OrbitOptions(),
    uav: PlannedAircraftOptions = PlannedAircraftOptions(),
    air: WindOptions = WindOptions(),
    fit: Fit = False,
    spacing: SpacingOptions = SpacingOptions(),
    json: Json = False,
    pictures: PictureOptions = PictureOptions(),
    save: Save = (),
    waypoints: FleetMissionOptions = FleetMissionOptions(),
    autopilot: AutopilotChoice = "ardupilot",
) -> None:
    """Plan the entries of several aircraft onto one circle, each into a slot of its own."""
    from loiter.fleets.table import read_fleet

    read = read_circle(circle, uav, air, fit=fit, datum=waypoints.datum(circle.site))
    wanted = Output(json, pictures, save)
    wanted.check(check_format)
    circle.check_unfenced("for fleets")
    rows = read_fleet(table, column_mapping(map_ or []))
    with fit_proposed():
        poses = _poses(rows, read, table)
        plan = plan_fleet(
            poses, read.orbit, read.aircraft, read.wind, separation_m=spacing.separation, reserve=spacing.reserve
        )
    shown = ShownFleet(plan, tuple(row.name for row in rows.rows), spacing.layer_height_m, spacing.separation)
    contents = _contents(shown, save, read, uav, waypoints, autopilot, circle.site)
    for path, content in contents:
        write_content("save", path, content)
    if pictures.plot:
        from loiter.fleets.picture import draw

        wanted.draw(draw(plan, shown.names, frame=read.frame))
    lines = [*([read.remark] if read.remark else []), *shown.lines()]
    lines += [NO_SLOTS] if any(map(is_mission, save)) else []
    written = wanted._replace(save=[path for path, _ in contents])
    written.show(shown.document(), *lines)


class ShownFleet(NamedTuple):
    """A plan with the names of its aircraft, the height of its layers and the separation wanted, metres."""

    plan: FleetPlan
    names: tuple[str, ...]
    layer_height_m: float
    wanted_m: float

    def height_m(self, i: int) -> float:
        """The height of an aircraft above the lowest layer, metres."""
        return self.plan.layers[i] * self.layer_height_m

    @property
    def bearings_deg(self) -> list[float]:
        """The bearing of each slot from the centre at the start, degrees."""
        import numpy as np

        first, *_ = self.plan.entries
        centre = complex(first.orbit.east_m, first.orbit.north_m)
        places = (slot_tracks(self.plan, np.array([0.0]))[:, 0] - centre).tolist()
        return [heading_of(place.real, place.imag) for place in places]

    def document(self) -> dict[str, object]:
        """The plan as plain values for JSON, with names, bearings and heights."""
        document = self.plan.to_dict()
        aircraft = document["aircraft"]
        assert isinstance(aircraft, list)  # one for each entry
        rows = zip(aircraft, self.names, self.bearings_deg, strict=True)
        members = [
            {"name": name, **each, "slot_bearing_deg": bearing, "layer_height_m": self.height_m(i)}
            for i, (each, name, bearing) in enumerate(rows)
        ]
        return document | {"aircraft": members}

    def lines(self) -> list[RenderableType]:
        """Headline, a row for each aircraft, and what became of the separation."""
        plan, first = self.plan, self.plan.entries[0]
        lines: list[RenderableType] = [
            report.headline(
                f"{len(plan.entries)} aircraft, {plan.turn.described}: the last is in its slot in {plan.duration_s:.1f} s"
            )
        ]
        lines += [report.weather(first)] if first.wind.speed_m_s > 0.0 or first.orbit.moves else []
        lines.append(self._table())
        if max(plan.layers) > 0:
            layers = f"{max(plan.layers) + 1} altitude layers, {self.layer_height_m:g} m apart"
            lines.append(f"No plan that was tried keeps {self.wanted_m:g} m: there are {layers}.")
        elif plan.closest is not None:
            i, j, when_s = plan.closest
            who = f"{self.names[i]} and {self.names[j]}"
            lines.append(f"Least distance: {rounded_down(plan.separation_m, 1)} m, between {who} at {when_s:.1f} s.")
        return lines

    def _table(self) -> Table:
        """A row for each aircraft: its slot and its entry, and where it comes closest to another."""
        rows, plan = report.new_table(), self.plan
        rows.add_column("aircraft")
        for heading in ("slot now, deg", "joins in"):
            rows.add_column(heading, justify="right")
        for heading in ("direction", "word"):
            rows.add_column(heading)
        approached = bool(plan.approaches)
        for heading in ("least distance", "to", "in")[: 3 * approached]:
            rows.add_column(heading, justify="left" if heading == "to" else "right")
        rows.add_column("layer", justify="right")
        for i, (entry, bearing) in enumerate(zip(plan.entries, self.bearings_deg, strict=True)):
            decimals = decimals_of(entry.orbit)
            cells = [self.names[i], f"{bearing:05.1f}", f"{entry.duration_s:.{decimals}f} s"]
            cells += [entry.turn.described, entry.word]
            if approached:
                other, distance_m, time_s = plan.approaches[i]
                cells += [f"{rounded_down(distance_m, 1)} m", self.names[other], f"{time_s:.1f} s"]
            rows.add_row(*cells, f"{plan.layers[i]}")
        return rows


def _poses(rows: FleetTable, read: CircleRead, table: Path) -> list[Pose]:
    """The poses of the aircraft; raises `InvalidArgument` where the circle is not given in the same units."""
    if rows.is_placed != (read.frame is not None):
        need = "degrees: --orbit-lla goes with them" if rows.is_placed else "metres: --orbit goes with them"
        raise InvalidArgument("table", f"is {str(table)!r}: its positions are in {need}")
    make, poses = Pose if read.frame is None else read.frame.pose, []
    for row in rows.rows:
        try:
            poses.append(make(row.first, row.second, row.heading_deg))
        except InvalidArgument as error:
            raise InvalidArgument("table", f"is {str(table)!r}: aircraft {row.name}: {error}") from error
    return poses


def _contents(
    shown: ShownFleet,
    save: Sequence[Path],
    read: CircleRead,
    uav: PlannedAircraftOptions,
    waypoints: FleetMissionOptions,
    autopilot: AutopilotName,
    site: Site | None,
) -> list[tuple[Path, bytes]]:
    """The files of --save: a map of all aircraft, and a mission for each."""
    altitude_m = uav.written_altitude if save else None
    arguments = [
        SaveArguments(
            maneuver=entry,
            frame=read.frame,
            altitude_m=None if altitude_m is None else altitude_m + shown.height_m(i),
            datum=waypoints.datum(site),
            spacing_m=waypoints.spacing,
            chord_error_m=waypoints.chord_error_m,
            autopilot=AUTOPILOTS[autopilot],
            along_path=True,
            site=site,
            name=shown.names[i],
        )
        for i, entry in enumerate(shown.plan.entries)
    ]
    with argument_names(path="save"):
        return [found for path in save for found in fleet_contents(path, arguments)]
