"""`loiter upload` and `loiter watch`: the plan on its way to a vehicle, and beside one that flies."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial
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
    read_options,
)
from loiter.errors import InvalidArgument
from loiter.io.missions.items import Mission
from loiter.mavlink.connection.link import check
from loiter.mavlink.missions.exchange import TIMEOUT_S, check_target
from loiter.planning.solve import fastest

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
TrueRadius = Annotated[
    bool,
    Parameter(
        group=connection,
        help="ArduPlane widens loiters with the altitude, where its NAVL1_LIM_BANK is 0: send the radius with which it flies the one asked for.",
    ),
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
    true_radius: TrueRadius = False,
    start: Annotated[
        bool,
        Parameter(
            group=connection,
            help="Tell the vehicle to fly the mission, if it is in the air; nothing is armed and nothing takes off.",
        ),
    ] = False,
    pose: PlacedStartOptions = PlacedStartOptions(),
    circle: PlacedOrbitOptions = PlacedOrbitOptions(),
    uav: AircraftOptions = AircraftOptions(),
    air: WindOptions = WindOptions(),
    waypoints: MissionOptions = MissionOptions(),
) -> None:
    """Send the fastest entry to a vehicle as a mission, and read it back to see that it is there, item by item."""
    # Before anything is planned and printed.
    check(connect)
    check_target(system, 1, timeout)
    options = (pose, circle, uav, air, waypoints)
    wanted: Mission | Callable[[int], Mission]
    if mission is None:
        wanted = _planned(*options)
    elif any(given != type(given)() for given in options):
        raise InvalidArgument("mission", "FILE is sent as it is: options of a scene are of no use with it")
    else:
        wanted = loiter.io.read_mission(mission)
    with _progress() as tell:
        done = loiter.mavlink.upload(
            wanted,
            connect,
            system=system,
            timeout_s=timeout,
            on_progress=tell,
            true_radius=true_radius,
            start=start,
        )
    kept = ", each as sent" if not done.cut else ""
    lines = [
        f"Vehicle {done.system} ({done.autopilot}) has the mission: {done.items} items sent and read back{kept}.",
        f"It took the place of one of {done.replaced} items." if done.replaced else "It had none before.",
    ]
    lines += ["It flies the mission."] if done.started else []
    report.write(*lines, *done.cut, *done.remarks)


def _planned(
    pose: StartOptions, circle: OrbitOptions, uav: AircraftOptions, air: WindOptions, waypoints: MissionOptions
) -> Callable[[int], Mission]:
    """What makes the scene's fastest entry a mission for an autopilot; the entry is printed on the way."""
    if pose.pose_lla is None or not circle.orbit_lla:
        raise InvalidArgument("pose_lla", "and --orbit-lla are needed: a vehicle's mission is in degrees")
    if uav.altitude is None:
        raise InvalidArgument("altitude_m", f"is needed: a vehicle's mission has one, {waypoints.datum.unit}")
    along_path = waypoints.along_path
    (problem, frame), remark = read_options(pose, circle, uav, air, datum=waypoints.datum)
    assert frame is not None  # both places are in degrees
    best = fastest(problem)
    made = partial(
        loiter.io.mission,
        best,
        frame,
        uav.altitude,
        spacing_m=waypoints.spacing,
        chord_error_m=waypoints.chord_error_m,
        datum=waypoints.datum,
        along_path=along_path,
    )
    # What cannot be a mission is refused before anything is printed.
    made()
    report.write(*([remark] if remark else []), report.headline(best), *([report.ALONG_PATH] if along_path else []))
    return lambda autopilot: made(autopilot=autopilot)


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
    true_radius: TrueRadius = False,
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
        true_radius=true_radius,
    )
    if remark := uav.remark(preset):
        report.write(remark)
    commanded = False
    for seen in islice(heard, reports):
        if seen.commanded and not commanded and seen.turn is not None:
            report.write(f"The vehicle is to hold the circle {seen.turn.described}.")
        commanded = seen.commanded
        report.write(*seen.notices, line(seen))
        sys.stdout.flush()


# Less wind than this is shown as 0.0, and so is a difference between the directions that is less.
LEAST_WIND_M_S, SAME_TIME_S = 0.05, 0.05

ACTIONS = {"L": "left", "R": "right", "S": "straight"}


def line(seen: Report) -> str:
    """A report in a line: "12 s: joins clockwise in 19.8 s; right now, straight in 3.2 s, peel off left in 14.1 s; ..."."""
    clock = f"{seen.time_s:6.1f} s"
    if seen.plan is None:
        return f"{clock}: {seen.problem}"
    if seen.holding:
        return f"{clock}: on the circle, {seen.plan.turn.described}{_off(seen.outside_m)}"
    parts = [f"joins {seen.plan.turn.described} in {seen.time_to_join_s:.1f} s", *_todo(seen), _other(seen)]
    if seen.wind_source != "still air" and seen.wind.speed_m_s >= LEAST_WIND_M_S:
        parts.append(f"wind {seen.wind.speed_m_s:.1f} m/s from {seen.wind.from_deg % 360.0:03.0f}, {seen.wind_source}")
    return f"{clock}: {'; '.join(parts)}"


def _off(outside_m: float) -> str:
    """How far off the circle an aircraft holds it, where that is a metre and more."""
    side = "outside" if outside_m > 0.0 else "inside"
    return f", {abs(outside_m):.0f} m {side}" if abs(outside_m) >= 1.0 else ""


def _todo(seen: Report) -> list[str]:
    """What is to be done before the hold: one part of a line, none where all of it is too short to fly."""
    assert seen.plan is not None  # asked for with a plan
    *pieces, _ = seen.actions
    peeling = len(seen.plan.segments) > 1
    said = [
        f"{'peel off ' * (peeling and piece is pieces[-1])}{ACTIONS[piece.letter]} "
        + (f"in {piece.in_s:.1f} s" if piece.in_s else "now")
        for piece in pieces
    ]
    return [", ".join(said)] if said else []


def _other(seen: Report) -> str:
    """What the other direction costs."""
    assert seen.plan is not None  # asked for with a plan
    other, later = seen.plan.turn.other.described, seen.other_costs_s
    if later is None:
        return f"{other} cannot be held"
    if abs(later) < SAME_TIME_S:
        return f"{other} takes the same time"
    return f"{other} {abs(later):.1f} s {'later' if later > 0.0 else 'sooner'}"
