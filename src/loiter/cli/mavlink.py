"""`loiter upload` and `loiter watch`: the plan on its way to a vehicle, and beside one that flies."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from itertools import islice
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from cyclopts import Group, Parameter
from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn

import loiter
from loiter.cli import report
from loiter.cli.numbers import whole
from loiter.cli.options import (
    AircraftOptions,
    MissionOptions,
    OrbitOptions,
    PlacedOrbitOptions,
    PlacedStartOptions,
    StartOptions,
    WindOptions,
    scene_of,
)
from loiter.errors import InvalidArgument
from loiter.io.items import Mission
from loiter.mavlink.link import check
from loiter.mavlink.missions import TIMEOUT_S, check_target

if TYPE_CHECKING:
    from loiter.mavlink import Report

connection = Group("Connection", sort_key=0)

Connect = Annotated[
    str,
    Parameter(
        group=connection,
        metavar="LINK",
        help="udpout:HOST:PORT, udpin:HOST:PORT, tcp:HOST:PORT, or a serial device as /dev/ttyUSB0,57600.",
    ),
]
System = Annotated[
    int | None,
    Parameter(
        group=connection,
        metavar="N",
        converter=whole,
        help="The vehicle's system number, where several are on the line.",
    ),
]
Timeout = Annotated[
    float,
    Parameter(group=connection, metavar="SECONDS", help="How long nothing may come forward before it is given up."),
]


def upload(
    mission: Annotated[
        Path | None, Parameter(name="FILE", help="A mission to send: .plan or .waypoints; instead of a scene.")
    ] = None,
    /,
    *,
    connect: Connect,
    system: System = None,
    timeout: Timeout = TIMEOUT_S,
    start: PlacedStartOptions = PlacedStartOptions(),
    circle: PlacedOrbitOptions = PlacedOrbitOptions(),
    uav: AircraftOptions = AircraftOptions(),
    air: WindOptions = WindOptions(),
    waypoints: MissionOptions = MissionOptions(),
) -> None:
    """Send the fastest entry to a vehicle as a mission, and read it back to see that it is there, item by item."""
    # Before anything is planned and printed.
    check(connect)
    check_target(system, 1, timeout)
    options = (start, circle, uav, air, waypoints)
    if mission is None:
        wanted = _planned(*options)
    elif any(given != type(given)() for given in options):
        raise InvalidArgument("mission", "FILE is sent as it is: options of a scene are of no use with it")
    else:
        wanted = loiter.io.read_mission(mission)
    with _progress() as tell:
        done = loiter.mavlink.upload(wanted, connect, system=system, timeout_s=timeout, on_progress=tell)
    kept = ", each as sent" if not done.cut else ""
    lines = [
        f"Vehicle {done.system} ({done.autopilot}) has the mission: {done.items} items sent and read back{kept}.",
        f"It took the place of one of {done.replaced} items." if done.replaced else "It had none before.",
    ]
    report.write(*lines, *done.cut)


def _planned(
    start: StartOptions, circle: OrbitOptions, uav: AircraftOptions, air: WindOptions, waypoints: MissionOptions
) -> Mission:
    """The scene's fastest entry as a mission; it is printed on the way."""
    if start.pose_lla is None or not circle.orbit_lla:
        raise InvalidArgument("pose_lla", "and --orbit-lla are needed: a vehicle's mission is in degrees")
    if uav.altitude is None:
        raise InvalidArgument("altitude_m", "is needed: a vehicle's mission has one, metres above mean sea level")
    asked = scene_of(start, circle, uav, air)
    assert asked.frame is not None  # both places are in degrees
    best = loiter.plan(asked.start, asked.circle, asked.aircraft, asked.wind)
    planned = loiter.io.mission(
        best, asked.frame, uav.altitude, spacing_m=waypoints.spacing, chord_error_m=waypoints.chord_error
    )
    report.write(*([asked.remark] if asked.remark else []), report.headline(best))
    return planned


DOING = {"read": "Reading its mission", "send": "Sending", "check": "Reading back"}


@contextmanager
def _progress() -> Iterator[Callable[[str, int, int], None]]:
    """A bar for each part of a transfer, on standard error where that is a terminal."""
    console = Console(stderr=True)
    with Progress(
        TextColumn("{task.description}"),
        BarColumn(),
        MofNCompleteColumn(),
        console=console,
        transient=True,
        disable=not sys.stderr.isatty(),
    ) as bars:
        tasks = {doing: bars.add_task(text, total=None, visible=False) for doing, text in DOING.items()}

        def tell(doing: str, done: int, total: int) -> None:
            bars.update(tasks[doing], completed=done, total=total, visible=True)

        yield tell


def watch(
    *,
    connect: Connect,
    system: System = None,
    timeout: Timeout = TIMEOUT_S,
    every: Annotated[float, Parameter(group=connection, metavar="SECONDS", help="How often a line is printed.")] = 1.0,
    reports: Annotated[
        int | None,
        Parameter(group=connection, metavar="N", converter=whole, help="End after so many lines; at Ctrl-C if absent."),
    ] = None,
    send: Annotated[
        bool,
        Parameter(
            group=connection,
            help="Tell the vehicle to hold the circle, in the direction that is sooner, as soon as there is a plan; it then flies there by its own law. Without it nothing is commanded.",
        ),
    ] = False,
    circle: PlacedOrbitOptions = PlacedOrbitOptions(),
    uav: AircraftOptions = AircraftOptions(),
    air: WindOptions = WindOptions(),
) -> None:
    """Listen to a vehicle and print, live, the fastest entry from where it is."""
    if not circle.orbit_lla:
        raise InvalidArgument("orbit_lla", "is needed: a vehicle says where it is in degrees")
    preset = uav.preset()
    orbit, frame = circle.circle(preset)
    assert frame is not None  # the circle is in degrees
    if reports is not None and reports < 1:
        raise InvalidArgument("reports", f"is {reports}: it must be at least 1")
    wind = None if air.wind is None else air.moving_air
    heard = loiter.mavlink.watch(
        connect,
        orbit,
        frame,
        uav.aircraft(preset),
        wind,
        system=system,
        period_s=every,
        timeout_s=timeout,
        send=send,
        altitude_m=uav.altitude if send else None,
    )
    if remark := uav.remark(preset):
        report.write(remark)
    commanded = False
    for seen in islice(heard, reports):
        if seen.commanded and not commanded and seen.turn is not None:
            report.write(f"The vehicle is to hold the circle {seen.turn.described}.")
        commanded = seen.commanded
        report.write(line(seen))
        sys.stdout.flush()


ACTIONS = {"L": "left", "R": "right", "S": "straight"}


def line(seen: Report) -> str:
    """A report in a line: "12 s: joins clockwise in 19.8 s; right now, straight in 3.2 s; ..."."""
    clock = f"{seen.time_s:6.1f} s"
    if seen.plan is None:
        return f"{clock}: {seen.problem}"
    turn = seen.plan.turn
    if not seen.plan.segments:
        return f"{clock}: on the circle, {turn.described}"
    after = (
        f"{ACTIONS[seen.next_control]} in {seen.next_in_s:.1f} s"
        if len(seen.plan.segments) > 1
        else f"on the circle in {seen.next_in_s:.1f} s"
    )
    parts = [
        f"joins {turn.described} in {seen.time_to_join_s:.1f} s",
        f"{ACTIONS[seen.control]} now, {after}",
        _other(seen),
    ]
    if seen.wind_source != "still air":
        parts.append(f"wind {seen.wind.speed_m_s:.1f} m/s from {seen.wind.from_deg % 360.0:03.0f}, {seen.wind_source}")
    return f"{clock}: {'; '.join(parts)}"


def _other(seen: Report) -> str:
    """What the other direction costs."""
    assert seen.plan is not None  # asked for with a plan
    other, later = seen.plan.turn.other.described, seen.other_costs_s
    if later is None:
        return f"{other} cannot be held"
    return f"{other} {abs(later):.1f} s {'later' if later >= 0.0 else 'sooner'}"
