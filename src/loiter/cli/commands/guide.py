"""`loiter guide`: a vehicle in flight is guided onto its circle and handed over to its own hold."""

from __future__ import annotations

import os
import signal
import sys
from collections.abc import Callable, Iterator
from contextlib import closing, contextmanager, suppress
from math import isnan
from pathlib import Path
from queue import Empty, Queue
from threading import Thread
from types import FrameType
from typing import TYPE_CHECKING, Annotated, Any

from cyclopts import Parameter

import loiter
from loiter.cli import report, vehicles
from loiter.cli.commands.mavlink import Connect, System, Timeout, connection
from loiter.cli.numbers import metres, one
from loiter.cli.options import (
    GuidedFenceOptions,
    GuidedOrbitOptions,
    GuidedVehicleOptions,
    SlotBand,
    SlotBearing,
    WindOptions,
    output,
    scene,
    written_altitude,
)
from loiter.cli.scenes import read_slot
from loiter.cli.status import abandon_output
from loiter.errors import InvalidArgument, LinkFailed, not_negative, positive, share
from loiter.guidance.entry.slot_entry import BAND
from loiter.mavlink.connection.link import TIMEOUT_S
from loiter.planning.model import wind_from_velocity

if TYPE_CHECKING:
    from loiter.mavlink import GuideReport

# Winds below this, metres per second, and offsets below this, metres, are omitted: they would print as 0.
LEAST_WIND_M_S, LEAST_OFFSET_M = 0.05, 0.05

# Signals that end the program: the vehicle is commanded back to the fall-back circle first. Shells let programs that
# they start in the background ignore SIGINT.
ENDING_SIGNALS = ("SIGINT", "SIGTERM", "SIGHUP")


def guide(
    *,
    connect: Connect | None = None,
    fleet: Annotated[
        Path | None,
        Parameter(
            group=connection,
            metavar="FILE",
            help="Instead of --connect: several vehicles at once, each into a slot of the circle. A CSV file with a row for each: connect, and optionally name and system.",
        ),
    ] = None,
    system: System = None,
    timeout: Timeout = TIMEOUT_S,
    every: Annotated[float, Parameter(group=connection, metavar="SECONDS", help="Time between lines.")] = 1.0,
    keep: Annotated[
        bool,
        Parameter(
            group=connection, help="Fly the circle until Ctrl-C, instead of handing it over once it is held steadily."
        ),
    ] = False,
    dry_run: Annotated[
        bool,
        Parameter(
            group=connection,
            help="Command nothing, and show what would be commanded. Only heartbeats and requests for telemetry and parameters are sent.",
        ),
    ] = False,
    yes: Annotated[
        bool,
        Parameter(group=connection, help="Begin without a question after the summary: for scripts."),
    ] = False,
    accept_fly_away: Annotated[
        bool,
        Parameter(
            group=connection,
            help="Guide PX4 although it does not stay near if this program or the link dies: COM_OBL_RC_ACT is neither hold nor return.",
        ),
    ] = False,
    resume: Annotated[
        bool,
        Parameter(
            group=connection,
            help="After a lost link begin anew if the vehicle is heard within a minute, still on its way to the circle: ArduPlane only.",
        ),
    ] = False,
    circle: GuidedOrbitOptions = GuidedOrbitOptions(),
    uav: GuidedVehicleOptions = GuidedVehicleOptions(),
    air: WindOptions = WindOptions(),
    fence: GuidedFenceOptions = GuidedFenceOptions(),
    slot: SlotBearing = None,
    slot_at: Annotated[
        float | None,
        Parameter(
            group=scene,
            metavar="UNIX",
            help="The Unix time, seconds, at which the slot is at that bearing, by the clock of this computer: date +%s prints it. Needed with --slot.",
        ),
    ] = None,
    slot_band: SlotBand = None,
    separation: Annotated[
        float | None,
        Parameter(
            group=scene,
            converter=one(metres),
            metavar="METRES",
            help="With --fleet: least horizontal distance between two vehicles. A fleet whose plan does not keep it is refused; in flight a line says where it is not kept.",
        ),
    ] = None,
    log: Annotated[
        Path | None,
        Parameter(
            group=output, metavar="FILE", help="Write every step to a .csv or .parquet; loiter fly --replay plots it."
        ),
    ] = None,
    json: Annotated[
        bool,
        Parameter(
            group=output,
            help="Print a JSON object a line instead of text. With --fleet: one object at the end, and text on standard error.",
        ),
    ] = False,
) -> int | None:
    """Guide a vehicle in flight onto the circle by bank commands, then hand it over to its own hold."""
    if not circle.placed:
        raise InvalidArgument("orbit_lla", "is needed: a vehicle reports its position in degrees")
    air.check_declination()
    orbit, frame = circle.circle(None)
    assert frame is not None  # the circle is in degrees
    wind, altitude_m = None if air.wind is None else air.moving_air, written_altitude(uav.altitude)
    if not (yes or dry_run or sys.stdin.isatty()):
        raise InvalidArgument("yes", "is needed where nobody can answer: standard input is not a terminal")
    if fleet is not None:
        from loiter.cli.commands.guide_fleet import FleetOutput, guide_fleet
        from loiter.mavlink.guiding.fleet import FleetRequest

        single = {"connection": connect, "system": system, "slot": slot, "slot_at_s": slot_at, "log": log}
        for name, value in (single | {"fence": fence.fence, "keep": keep or None}).items():
            if value is not None:
                raise InvalidArgument(name, "has no effect with --fleet")
        if uav.airspeed is None:
            raise InvalidArgument("airspeed_m_s", "is needed with --fleet: the slots move with it")
        request = FleetRequest(
            orbit=orbit,
            frame=frame,
            airspeed_m_s=positive("airspeed_m_s", uav.airspeed, "metres per second"),
            max_bank_deg=None if uav.bank is None else positive("max_bank_deg", uav.bank, "degrees"),
            wind=wind,
            altitude_m=altitude_m,
            timeout_s=timeout,
            slot_band=BAND if slot_band is None else share("slot_band", slot_band),
            accept_fly_away=accept_fly_away,
            resume=resume,
            separation_m=0.0 if separation is None else not_negative("separation_m", separation, "metres"),
        )
        return guide_fleet(fleet, request, FleetOutput(None if yes or dry_run else _question(), dry_run, every, json))
    if separation is not None:
        raise InvalidArgument("separation_m", "has no effect without --fleet")
    if connect is None:
        raise InvalidArgument("connection", "is needed, or --fleet for several vehicles")
    reports = loiter.mavlink.guide(
        connect,
        orbit,
        frame,
        airspeed_m_s=uav.airspeed,
        max_bank_deg=uav.bank,
        wind=wind,
        system=system,
        period_s=every,
        timeout_s=timeout,
        altitude_m=altitude_m,
        keep=keep,
        dry_run=dry_run,
        accept_fly_away=accept_fly_away,
        confirm=None if yes else _question(),
        resume=resume,
        log=log,
        fence=fence.of_flight(),
        margin_m=fence.margin,
        **_slot_arguments(slot, slot_at, slot_band),
    )
    with ending_signals(signal.default_int_handler), closing(reports):
        try:
            for vehicle in reports:
                if json:
                    vehicles.print_line(vehicles.guide_document(vehicle))
                    continue
                report.write(*vehicle.notices, line(vehicle))
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


def _slot_arguments(bearing_deg: float | None, at_s: float | None, band: float | None) -> dict[str, Any]:
    """The slot of the options as arguments of `guide`; raises `InvalidArgument` where they do not fit together."""
    if bearing_deg is None:
        for name, value in (("slot_at_s", at_s), ("slot_band", band)):
            if value is not None:
                raise InvalidArgument(name, "has no effect without --slot")
        return {}
    if at_s is None:
        raise InvalidArgument("slot_at_s", "is needed with --slot: the Unix time at which the slot is at that bearing")
    return {"slot": read_slot(bearing_deg, at_s)} | ({} if band is None else {"slot_band": band})


def _question() -> Callable[[], bool]:
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


@contextmanager
def ending_signals(handler: Callable[[int, FrameType | None], object]) -> Iterator[None]:
    """`ENDING_SIGNALS` have this handler meanwhile."""
    numbers = [number for name in ENDING_SIGNALS if (number := getattr(signal, name, None)) is not None]
    former = [signal.signal(number, handler) for number in numbers]
    try:
        yield
    finally:
        for number, before in zip(numbers, former, strict=True):
            signal.signal(number, before)


def line(vehicle: GuideReport) -> str:
    """A report in a line: "  12.0 s: joining clockwise in 8.2 s; bank 44 of 45 deg; 600 m, 100 above home; ..."."""
    parts = [_progress(vehicle), *_bank(vehicle), *_altitude(vehicle), *_offset(vehicle), *_slot(vehicle)]
    parts += _wind(vehicle)
    return f"{vehicle.time_s:6.1f} s: {'; '.join(parts)}"


def _progress(vehicle: GuideReport) -> str:
    if isnan(vehicle.time_to_join_s):
        return str(vehicle.stage)
    turn = vehicle.turn.described
    if vehicle.stage in ("joining", "dry run"):
        return f"{vehicle.stage} {turn} in {vehicle.time_to_join_s:.1f} s"
    return f"{vehicle.stage} {turn}"


def _bank(vehicle: GuideReport) -> list[str]:
    """The measured and the commanded bank."""
    if vehicle.state is None or isnan(vehicle.command_deg):
        return []
    return [f"bank {round(vehicle.state.bank_deg)} of {round(vehicle.command_deg)} deg"]


def _altitude(vehicle: GuideReport) -> list[str]:
    if isnan(vehicle.altitude_m):
        return []
    side = "above" if vehicle.height_m >= 0.0 else "below"
    height = "" if isnan(vehicle.height_m) else f", {abs(round(vehicle.height_m))} {side} home"
    return [f"{round(vehicle.altitude_m)} m{height}"]


def _offset(vehicle: GuideReport) -> list[str]:
    """How far the vehicle is beside its path or, on the circle, outside it."""
    on_circle = vehicle.stage in ("holding", "handing over", "handed over")
    offset_m, sides = (
        (vehicle.outside_m, ("outside", "inside")) if on_circle else (vehicle.crosstrack_m, ("left", "right"))
    )
    if isnan(offset_m):
        return []
    side = sides[0] if offset_m > 0.0 else sides[1]
    place = "circle" if on_circle else "path"
    beside = side if on_circle else f"{side} of path"
    return [f"on {place}" if abs(offset_m) < LEAST_OFFSET_M else f"{abs(offset_m):.1f} m {beside}"]


def _slot(vehicle: GuideReport) -> list[str]:
    """How far the slot is ahead or behind."""
    ahead_deg = vehicle.slot_ahead_deg
    if isnan(ahead_deg):
        return []
    return [f"slot {abs(ahead_deg):.1f} deg {'ahead' if ahead_deg >= 0.0 else 'behind'}"]


def _wind(vehicle: GuideReport) -> list[str]:
    """The wind that the law estimates."""
    e = vehicle.estimates
    if e is None:
        return []
    wind = wind_from_velocity(e.wind_east_m_s, e.wind_north_m_s)
    return [f"wind {wind.speed_m_s:.1f} m/s from {wind.from_deg:03.0f}"] if wind.speed_m_s >= LEAST_WIND_M_S else []
