"""`loiter guide-fleet`: several vehicles in flight at once, each into a slot of one circle."""

from __future__ import annotations

import sys
from collections.abc import Callable
from dataclasses import dataclass
from math import inf
from pathlib import Path
from time import monotonic
from typing import Annotated, NamedTuple

from cyclopts import Parameter
from rich.console import RenderableType

from loiter.cli import report
from loiter.cli.options import (
    Json,
    Metres,
    Seconds,
    WindOptions,
    scene,
    written_altitude,
)
from loiter.cli.status import LINK_FAILED, abandon_output
from loiter.errors import LinkFailed
from loiter.fleets.command import ShownFleet
from loiter.fleets.guided import REPORT_S, FleetRequest, GuidedFleet, Member, check_fleet
from loiter.fleets.table import read_connections
from loiter.flight.guide_command import GuidingOptions, placed_circle, question
from loiter.flight.guiding.preparation import GuideRequest
from loiter.flight.lines import ending_signals, guide_line
from loiter.flight.link.link import TIMEOUT_S
from loiter.flight.options import GuidedOrbitOptions, GuidedVehicleOptions
from loiter.flight.transfer_commands import connection
from loiter.guidance.entry.slot_entry import BAND
from loiter.planning.model import Orbit


class FleetOutput(NamedTuple):
    """How to go about it: the question before the first command (None: none), and what is printed.

    With `dry_run` nothing is commanded; `period_s` is the time between lines.
    """

    question: Callable[[], bool] | None
    dry_run: bool
    period_s: float
    json: bool

    def write(self, *lines: RenderableType) -> None:
        """Print lines and tables; on standard error where standard output has the JSON object alone."""
        if self.json:
            sys.stderr.writelines(f"{each}\n" for each in lines if isinstance(each, str))
            return
        report.write(*lines)
        sys.stdout.flush()


def guide_vehicles(table: Path, request: FleetRequest, output: FleetOutput) -> int:
    """Guide the vehicles of a file until a signal ends it; returns the exit status, 0 if all are in their slots then.

    Raises `InvalidArgument` for a file of vehicles that cannot be guided together, and `LinkFailed` where one of them
    cannot be guided at the start: none is commanded then.
    """
    vehicles = read_connections(table)
    check_fleet(vehicles, request)
    # Noted, and not raised: an exception could come amid a message.
    signals: list[int] = []
    with ending_signals(lambda number, _: signals.append(number)), GuidedFleet(vehicles, request) as fleet:
        flight = _FleetFlight(fleet, output, signals)
        try:
            planned = flight.plan()
            if planned is None:
                raise KeyboardInterrupt("guiding was interrupted; nothing was commanded")
            if output.dry_run:
                output.write("Dry run: nothing was commanded.")
            else:
                flight.fly()
        except BrokenPipeError:
            abandon_output()
            fleet.stop()
            ends = (f"{each.vehicle.name}: {each.ended.sentence}" for each in fleet.members if each.ended is not None)
            raise LinkFailed(f"standard output was closed; {'; '.join(ends)}") from None
        settled = fleet.settled
        fleet.stop()
        for each in fleet.members:
            if each.ended is not None and each.vehicle.name not in flight.told:
                output.write(f"{each.vehicle.name}: {each.ended.sentence}")
    if output.json:
        report.print_json(flight.document(planned, settled=settled))
    return 0 if settled or output.dry_run else LINK_FAILED


@Parameter(name="*", group=scene)
@dataclass(frozen=True)
class FleetSlotOptions:
    """The slots of the vehicles."""

    separation: Metres = None
    """Least horizontal distance between two vehicles. A fleet whose plan does not keep it is refused; in flight a line says where it is not kept."""
    slot_band: Annotated[float | None, Parameter(metavar="SHARE")] = None
    """The largest share by which the radius of the hold may differ from that of the circle, to keep the slot; 0.15 if absent."""


def guide_fleet(
    table: Annotated[
        Path,
        Parameter(name="FILE", help="A CSV file with a row for each vehicle: connect, and optionally name and system."),
    ],
    /,
    *,
    timeout: Annotated[
        Seconds, Parameter(group=connection, help="Give up after this time without progress.")
    ] = TIMEOUT_S,
    how: GuidingOptions = GuidingOptions(),
    circle: GuidedOrbitOptions = GuidedOrbitOptions(),
    uav: GuidedVehicleOptions = GuidedVehicleOptions(),
    air: WindOptions = WindOptions(),
    slots: FleetSlotOptions = FleetSlotOptions(),
    json: Annotated[Json, Parameter(help="Print one JSON object at the end, and text on standard error.")] = False,
) -> int:
    """Guide several vehicles onto one circle, each into a slot of its own."""
    orbit, frame = placed_circle(circle, air)
    how.check_answerable()
    circle.check_unfenced("for fleets")
    each = GuideRequest(
        orbit=orbit,
        frame=frame,
        airspeed_m_s=uav.airspeed,
        max_bank_deg=uav.bank,
        wind=None if air.wind is None else air.moving_air,
        altitude_m=written_altitude(uav.altitude),
        accept_fly_away=how.accept_fly_away,
        slot_band=BAND if slots.slot_band is None else slots.slot_band,
    )
    request = FleetRequest(each, timeout, how.resume, 0.0 if slots.separation is None else slots.separation)
    asked = None if how.yes or how.dry_run else question()
    return guide_vehicles(table, request, FleetOutput(asked, how.dry_run, how.every, json))


class _FleetFlight:
    """The steps of the program: the vehicles are prepared, planned for, asked about and followed.

    `told` has the names of those of which it was said why they are not guided any more.
    """

    def __init__(self, fleet: GuidedFleet, output: FleetOutput, signals: list[int]) -> None:
        self._fleet, self._output, self._signals = fleet, output, signals
        self._names = tuple(member.vehicle.name for member in fleet.members)
        self.told: set[str] = set()

    def plan(self) -> ShownFleet | None:
        """The plan that is begun, once it is confirmed; None after a signal. In a dry run it is not begun."""
        for _ in self._fleet.prepare():
            self._write_notices()
            if self._signals:
                return None
        self._write_notices()
        shown, at_s = self._show(self._fleet.request.each.orbit)
        if self._output.dry_run:
            return shown
        if self._output.question is not None:
            while not self._output.question():
                for _ in self._fleet.listen(monotonic() + REPORT_S):
                    self._fleet.check_waiting()
                if self._signals:
                    return None
            # Meanwhile they have flown on: the direction is the one that was confirmed.
            self._output.write("The plan from where they are now:")
            shown, at_s = self._show(shown.plan.entries[0].orbit)
        if self._signals:
            return None
        self._fleet.begin(shown.plan, at_s)
        return shown

    def _show(self, orbit: Orbit) -> tuple[ShownFleet, float]:
        """A plan, which is printed, and the Unix time of its start."""
        plan, at_s = self._fleet.plan(orbit)
        shown = ShownFleet(plan, self._names, 0.0, self._fleet.request.separation_m)
        self._output.write(*shown.lines())
        return shown, at_s

    def fly(self) -> None:
        """Print what the vehicles report until a signal, or until none is guided any more."""
        due = monotonic() + self._output.period_s
        while self._fleet.flying and not self._signals:
            for _ in self._fleet.listen(min(due, monotonic() + REPORT_S)):
                pass
            self._write_notices()
            self._output.write(*self._fleet.separation_notices())
            self._tell_faults()
            if monotonic() >= due:
                due += self._output.period_s
                self._output.write(*(self._line(member) for member in self._fleet.flying if member.report))

    def _line(self, member: Member) -> str:
        assert member.report is not None  # the caller has asked
        return f"{member.vehicle.name}: {guide_line(member.report)}"

    def _write_notices(self) -> None:
        for member in self._fleet.members:
            self._output.write(*(f"{member.vehicle.name}: {notice}" for notice in member.notices))
            member.notices.clear()

    def _tell_faults(self) -> None:
        """Say once of each vehicle that is not guided any more why, and what becomes of the others."""
        for member in self._fleet.members:
            name = member.vehicle.name
            if member.fault and name not in self.told:
                self.told.add(name)
                others = "the others fly on" if self._fleet.flying else "no other is guided any more"
                self._output.write(
                    f"{name}: {member.fault}",
                    f"{name} keeps no slot, and its distances are not watched any more; {others}.",
                )

    def document(self, shown: ShownFleet, *, settled: bool) -> dict[str, object]:
        """The plan and what became of it as plain values for JSON."""
        members = self._fleet.members
        return {
            "settled": settled,
            "least_distance_m": None if self._fleet.least_m == inf else self._fleet.least_m,
            "vehicles": [
                {
                    "name": member.vehicle.name,
                    "connection": member.vehicle.connection,
                    "system": member.vehicle.system,
                    "in_slot": member.in_slot,
                    "slot_ahead_deg": report.json_value(member.slot_ahead_deg),
                    "guided": member.fault == "",
                    "end": None if member.ended is None else member.ended.sentence,
                }
                for member in members
            ],
            "plan": shown.document(),
        }
