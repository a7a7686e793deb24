"""`loiter guide`: a vehicle in flight is guided onto its circle and handed over to its own hold."""

from __future__ import annotations

import signal
import sys
from collections.abc import Iterator
from contextlib import closing, contextmanager
from dataclasses import dataclass
from math import isnan
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from cyclopts import Group, Parameter

import loiter
from loiter.cli import report, vehicles
from loiter.cli.commands.mavlink import Connect, JsonLines, System, Timeout, connection
from loiter.cli.coordinates import latitude, longitude
from loiter.cli.numbers import altitude, angle, metres, metres_per_second, one, several, turn_name
from loiter.cli.options import PlacedOrbitOptions, WindOptions, output, scene, written_altitude
from loiter.errors import InvalidArgument
from loiter.mavlink.missions.exchange import TIMEOUT_S
from loiter.planning.model import TurnName, wind_from_velocity

if TYPE_CHECKING:
    from loiter.mavlink import GuideReport

# Winds below this, metres per second, and offsets below this, metres, are omitted: they would print as 0.
LEAST_WIND_M_S, LEAST_OFFSET_M = 0.05, 0.05

# Signals that end the program: the vehicle is commanded back to the fall-back circle first, as at Ctrl-C.
ENDING_SIGNALS = ("SIGTERM", "SIGHUP")


vehicle_limits = Group("Aircraft: what is absent comes from the vehicle's parameters", sort_key=2)


@Parameter(name="*")
@dataclass(frozen=True)
class GuidedOrbitOptions(PlacedOrbitOptions):
    """The circle, which an autopilot must be able to hold: --orbit-velocity is parsed, but hidden."""

    orbit_lla: Annotated[
        tuple[float, ...],
        Parameter(
            group=scene,
            consume_multiple=True,
            converter=several(latitude, longitude, metres),
            metavar="LAT LON RADIUS",
            help="The circle: centre in WGS84 degrees, radius in metres.",
        ),
    ] = ()
    turn: Annotated[
        TurnName | None,
        Parameter(
            group=scene,
            converter=turn_name,
            help="Direction of flight around the circle, seen from above; the faster one if absent.",
        ),
    ] = None
    orbit_velocity: Annotated[
        tuple[float, float], Parameter(show=False, converter=several(metres_per_second, metres_per_second))
    ] = (0.0, 0.0)


@Parameter(name="*")
@dataclass(frozen=True)
class GuidedVehicleOptions:
    """The vehicle, as far as its own parameters are not to be used."""

    airspeed: Annotated[
        float | None,
        Parameter(
            group=vehicle_limits,
            converter=one(metres_per_second),
            metavar="M_PER_S",
            help="True airspeed, metres per second, or with a unit: 35kn.",
        ),
    ] = None
    bank: Annotated[
        float | None,
        Parameter(
            group=vehicle_limits,
            converter=one(angle),
            metavar="DEGREES",
            help="Largest bank, at most that of the autopilot.",
        ),
    ] = None
    altitude: Annotated[
        float | None,
        Parameter(
            group=vehicle_limits,
            converter=one(altitude),
            metavar="METRES",
            help="Altitude at which the circle is flown, always above mean sea level; metres, or with a unit: 3000ft. The present one if absent.",
        ),
    ] = None


def guide(
    *,
    connect: Connect,
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
    circle: GuidedOrbitOptions = GuidedOrbitOptions(),
    uav: GuidedVehicleOptions = GuidedVehicleOptions(),
    air: WindOptions = WindOptions(),
    log: Annotated[
        Path | None,
        Parameter(
            group=output, metavar="FILE", help="Write every step to a .csv or .parquet; loiter fly --replay plots it."
        ),
    ] = None,
    json: JsonLines = False,
) -> None:
    """Guide a vehicle in flight onto the circle by bank commands, then hand it over to its own hold."""
    if not circle.placed:
        raise InvalidArgument("orbit_lla", "is needed: a vehicle reports its position in degrees")
    air.check_declination()
    orbit, frame = circle.circle(None)
    assert frame is not None  # the circle is in degrees
    reports = loiter.mavlink.guide(
        connect,
        orbit,
        frame,
        airspeed_m_s=uav.airspeed,
        max_bank_deg=uav.bank,
        wind=None if air.wind is None else air.moving_air,
        system=system,
        period_s=every,
        timeout_s=timeout,
        altitude_m=written_altitude(uav.altitude),
        keep=keep,
        dry_run=dry_run,
        log=log,
    )
    with _ending_signals(), closing(reports):
        try:
            for vehicle in reports:
                if json:
                    vehicles.print_line(vehicles.guided(vehicle))
                    continue
                report.write(*vehicle.notices, line(vehicle))
                sys.stdout.flush()
        except KeyboardInterrupt as interrupt:
            if str(interrupt):
                raise
            # It came between two reports: the vehicle is commanded back, and the interrupt says so.
            reports.throw(KeyboardInterrupt)


@contextmanager
def _ending_signals() -> Iterator[None]:
    """`ENDING_SIGNALS` raise KeyboardInterrupt meanwhile."""
    numbers = [number for name in ENDING_SIGNALS if (number := getattr(signal, name, None)) is not None]
    former = [signal.signal(number, signal.default_int_handler) for number in numbers]
    try:
        yield
    finally:
        for number, handler in zip(numbers, former, strict=True):
            signal.signal(number, handler)


def line(vehicle: GuideReport) -> str:
    """A report in a line: "12.0 s: joining counter-clockwise in 8.2 s; right, bank 44 of 45 deg; 0.3 m left; ..."."""
    clock = f"{vehicle.time_s:6.1f} s"
    parts = [_progress(vehicle), *_bank(vehicle), *_offset(vehicle), *_link(vehicle), *_estimates(vehicle)]
    return f"{clock}: {'; '.join(parts)}"


def _progress(vehicle: GuideReport) -> str:
    if isnan(vehicle.time_to_join_s):
        return str(vehicle.stage)
    turn = vehicle.turn.described
    if vehicle.stage in ("joining", "dry run"):
        return f"{vehicle.stage}, {turn} in {vehicle.time_to_join_s:.1f} s"
    return f"{vehicle.stage}, {turn}"


def _bank(vehicle: GuideReport) -> list[str]:
    if vehicle.state is None or isnan(vehicle.command_deg):
        return []
    return [f"{vehicle.phase}, bank {round(vehicle.state.bank_deg)}, commanded {round(vehicle.command_deg)} deg"]


def _offset(vehicle: GuideReport) -> list[str]:
    """How far the vehicle is beside its path or, on the circle, outside it."""
    on_circle = vehicle.stage in ("holding", "handing over", "handed over")
    offset_m, sides = (
        (vehicle.outside_m, ("outside", "inside")) if on_circle else (vehicle.crosstrack_m, ("left", "right"))
    )
    if isnan(offset_m):
        return []
    side = sides[0] if offset_m > 0.0 else sides[1]
    place = "the circle" if on_circle else "the path"
    beside = side if on_circle else f"{side} of"
    return [f"on {place}" if abs(offset_m) < LEAST_OFFSET_M else f"{abs(offset_m):.1f} m {beside} {place}"]


def _link(vehicle: GuideReport) -> list[str]:
    return [] if isnan(vehicle.age_s) else [f"{vehicle.rate_hz:.0f} Hz, {1e3 * vehicle.age_s:.0f} ms old"]


def _estimates(vehicle: GuideReport) -> list[str]:
    """The law's estimates: roll response, delay, turn rate over that of the bank, wind."""
    e = vehicle.estimates
    if e is None:
        return []
    parts = [f"roll {e.roll.time_s:.2f} s, delay {e.delay_s:.2f} s, turns {e.turn_ratio:.2f}"]
    wind = wind_from_velocity(e.wind_east_m_s, e.wind_north_m_s)
    if wind.speed_m_s >= LEAST_WIND_M_S:
        parts.append(f"wind {wind.speed_m_s:.1f} m/s from {wind.from_deg:03.0f}")
    return parts
