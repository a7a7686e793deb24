"""`loiter guide`: a vehicle in flight is guided onto its circle and handed over to its own hold."""

from __future__ import annotations

import signal
import sys
from collections.abc import Iterator
from contextlib import closing, contextmanager
from dataclasses import replace
from math import isnan
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, NamedTuple

from cyclopts import Parameter

import loiter
from loiter.cli import report
from loiter.cli.commands.mavlink import Connect, System, Timeout, connection
from loiter.cli.options import AircraftOptions, PlacedOrbitOptions, WindOptions, output
from loiter.errors import InvalidArgument
from loiter.mavlink.missions.exchange import TIMEOUT_S
from loiter.planning.model import wind_from_velocity

if TYPE_CHECKING:
    from loiter.io.missions.parameters import Preset
    from loiter.mavlink import GuideReport

# Winds below this, metres per second, and offsets below this, metres, are omitted: they would print as 0.
LEAST_WIND_M_S, LEAST_OFFSET_M = 0.05, 0.05

# Signals that end the program: the vehicle is commanded back to the fall-back circle first, as at Ctrl-C.
ENDING_SIGNALS = ("SIGTERM", "SIGHUP")


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
    circle: PlacedOrbitOptions = PlacedOrbitOptions(),
    uav: AircraftOptions = AircraftOptions(),
    air: WindOptions = WindOptions(),
    log: Annotated[
        Path | None,
        Parameter(
            group=output, metavar="FILE", help="Write every step to a .csv or .parquet; loiter fly --replay plots it."
        ),
    ] = None,
) -> None:
    """Guide a vehicle in flight onto the circle by bank commands, then hand it over to its own hold."""
    if not circle.orbit_lla:
        raise InvalidArgument("orbit_lla", "is needed: a vehicle reports its position in degrees")
    preset = uav.preset()
    orbit, frame = circle.circle(preset)
    assert frame is not None  # the circle is in degrees
    limits = _limits(uav, preset)
    reports = loiter.mavlink.guide(
        connect,
        orbit,
        frame,
        airspeed_m_s=limits.airspeed_m_s,
        max_bank_deg=limits.max_bank_deg,
        wind=None if air.wind is None else air.moving_air,
        system=system,
        period_s=every,
        timeout_s=timeout,
        altitude_m=uav.altitude,
        keep=keep,
        dry_run=dry_run,
        log=log,
    )
    with _ending_signals(), closing(reports):
        try:
            for vehicle in reports:
                report.write(*vehicle.notices, line(vehicle))
                sys.stdout.flush()
        except KeyboardInterrupt as interrupt:
            if str(interrupt):
                raise
            # It came between two reports: the vehicle is commanded back, and the interrupt says so.
            reports.throw(KeyboardInterrupt)


class _Limits(NamedTuple):
    """True airspeed and largest bank that the options give; None where the vehicle's own count."""

    airspeed_m_s: float | None
    max_bank_deg: float | None


def _limits(uav: AircraftOptions, preset: Preset | None) -> _Limits:
    """Airspeed and bank from the options of the aircraft, all of which may be absent."""
    has_speed = uav.airspeed is not None or uav.indicated(preset) is not None
    has_circle = uav.turn_radius is not None or uav.turn_rate is not None
    has_limit = has_circle or uav.bank is not None or (preset is not None and preset.max_bank_deg is not None)
    if has_speed and has_limit:
        aircraft = uav.aircraft(preset)
        return _Limits(aircraft.airspeed_m_s, aircraft.bank_deg(aircraft.turn_radius_m))
    if has_circle:
        raise InvalidArgument("airspeed_m_s", "is needed with --turn-radius and --turn-rate")
    if has_speed:
        # The bank is not used; an aircraft needs one.
        return _Limits(replace(uav, bank=45.0).aircraft(preset).airspeed_m_s, None)
    return _Limits(None, uav.bank if preset is None or uav.bank is not None else preset.max_bank_deg)


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
