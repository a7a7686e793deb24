"""`loiter guide`: a vehicle in flight is guided onto its circle and handed over to its own hold."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable
from contextlib import closing, suppress
from dataclasses import dataclass
from queue import Empty, Queue
from threading import Thread
from typing import Annotated, Any

from cyclopts import Parameter

from loiter import flight
from loiter.cli import report
from loiter.cli.options import (
    BandedSlotOptions,
    File,
    Json,
    Seconds,
    WindOptions,
    output,
    scene,
    written_altitude,
)
from loiter.cli.scenes import read_slot
from loiter.cli.status import abandon_output
from loiter.errors import InvalidArgument, LinkFailed
from loiter.flight import lines as vehicles
from loiter.flight.options import GuidedFenceOptions, GuidedOrbitOptions, GuidedVehicleOptions
from loiter.flight.transfer_commands import Connect, LinkOptions, connection
from loiter.geo import LocalFrame
from loiter.planning.model import Orbit


@Parameter(name="*", group=connection)
@dataclass(frozen=True)
class GuidingOptions:
    """How vehicles are guided."""

    every: Seconds = 1.0
    """Time between lines."""
    dry_run: bool = False
    """Command nothing, and show what would be commanded. Only heartbeats and requests for telemetry and parameters are sent."""
    yes: bool = False
    """Begin without a question after the summary: for scripts."""
    accept_fly_away: bool = False
    """Guide PX4 although it does not stay near if this program or the link dies: COM_OBL_RC_ACT is neither hold nor return."""
    resume: bool = False
    """After a lost link begin anew if the vehicle is heard within a minute, still on its way to the circle: ArduPlane only."""

    def check_answerable(self) -> None:
        """Raise `InvalidArgument` where a question would be asked that nobody can answer."""
        if not (self.yes or self.dry_run or sys.stdin.isatty()):
            raise InvalidArgument("yes", "is needed where nobody can answer: standard input is not a terminal")


@Parameter(name="*", group=connection)
@dataclass(frozen=True)
class GuideOptions(GuidingOptions):
    """How one vehicle is guided."""

    keep: bool = False
    """Fly the circle until Ctrl-C, instead of handing it over once it is held steadily."""


@Parameter(name="*", group=scene)
@dataclass(frozen=True)
class GuidedSlotOptions(BandedSlotOptions):
    """A slot by the clock."""

    slot_at: Annotated[float | None, Parameter(metavar="UNIX")] = None
    """The Unix time, seconds, at which the slot is at that bearing, by the clock of this computer: date +%s prints it. Needed with --slot."""

    @property
    def arguments(self) -> dict[str, Any]:
        """The slot as arguments of `loiter.flight.guide`; raises `InvalidArgument` where it is not complete."""
        if self.slot is None:
            for name, value in (("slot_at_s", self.slot_at), ("slot_band", self.slot_band)):
                if value is not None:
                    raise InvalidArgument(name, "has no effect without --slot")
            return {}
        if self.slot_at is None:
            raise InvalidArgument(
                "slot_at_s", "is needed with --slot: the Unix time at which the slot is at that bearing"
            )
        slot = {"slot": read_slot(self.slot, self.slot_at)}
        return slot | ({} if self.slot_band is None else {"slot_band": self.slot_band})


def guide(
    *,
    connect: Connect,
    link: LinkOptions = LinkOptions(),
    how: GuideOptions = GuideOptions(),
    circle: GuidedOrbitOptions = GuidedOrbitOptions(),
    uav: GuidedVehicleOptions = GuidedVehicleOptions(),
    air: WindOptions = WindOptions(),
    fence: GuidedFenceOptions = GuidedFenceOptions(),
    slotted: GuidedSlotOptions = GuidedSlotOptions(),
    log: Annotated[
        File, Parameter(group=output, help="Write every step to a .csv; loiter fly --replay plots it.")
    ] = None,
    json: Annotated[
        Json,
        Parameter(
            help="Print a JSON object a line instead of text.",
        ),
    ] = False,
) -> int | None:
    """Guide a vehicle in flight onto the circle by bank commands, then hand it over to its own hold."""
    orbit, frame = placed_circle(circle, air)
    wind, altitude_m = None if air.wind is None else air.moving_air, written_altitude(uav.altitude)
    how.check_answerable()
    if slotted.slot is not None:
        circle.check_unfenced("for slots")
    reports = flight.guide(
        connect,
        orbit,
        frame,
        airspeed_m_s=uav.airspeed,
        max_bank_deg=uav.bank,
        wind=wind,
        system=link.system,
        period_s=how.every,
        timeout_s=link.timeout,
        altitude_m=altitude_m,
        keep=how.keep,
        dry_run=how.dry_run,
        accept_fly_away=how.accept_fly_away,
        confirm=None if how.yes else question(),
        resume=how.resume,
        log=log,
        fence=fence.of_flight(circle.site),
        margin_m=fence.margin,
        **slotted.arguments,
    )
    with vehicles.ending_signals(vehicles.interrupt_once()), closing(reports):
        try:
            for vehicle in reports:
                if json:
                    vehicles.print_line(vehicles.guide_document(vehicle))
                    continue
                report.write(*vehicle.notices, vehicles.guide_line(vehicle))
                sys.stdout.flush()
        except BrokenPipeError:
            # The vehicle is commanded back, and the error says so.
            abandon_output()
            reports.throw(BrokenPipeError)
        except KeyboardInterrupt as interrupt:
            if str(interrupt):
                raise
            # It came between two reports: the vehicle is commanded back, and the interrupt says so.
            reports.throw(KeyboardInterrupt)
    return None


def placed_circle(circle: GuidedOrbitOptions, air: WindOptions) -> tuple[Orbit, LocalFrame]:
    """The circle and the local frame of its degrees; raises `InvalidArgument` for one in metres."""
    if not circle.placed:
        raise InvalidArgument("orbit_lla", "is needed: a vehicle reports its position in degrees")
    air.check_declination()
    orbit, frame = circle.circle(None)
    assert frame is not None  # the circle is in degrees
    return orbit, frame


def question() -> Callable[[], bool]:
    """A function that asks whether to begin when it is first called, and returns whether the user has agreed.

    The answer is read in the background: the vehicle is listened to meanwhile. Raises `LinkFailed` after a no.
    """
    answers: Queue[bytes] = Queue()
    reader = Thread(target=lambda: answers.put(os.read(sys.stdin.fileno(), 1024)), daemon=True)

    def agreed() -> bool:
        if reader.ident is None:
            sys.stderr.write("Begin? [y/N] ")
            sys.stderr.flush()
            reader.start()
        with suppress(Empty):
            if answers.get_nowait().strip().lower() not in (b"y", b"yes"):
                raise LinkFailed("the summary was not confirmed")
            return True
        return False

    return agreed
