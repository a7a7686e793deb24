"""`loiter upload` and `loiter watch`: sending the plan to a vehicle, and planning for a vehicle in flight."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import asdict, dataclass
from functools import partial
from itertools import islice
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, NamedTuple

from cyclopts import Group, Parameter
from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn

from loiter import files, flight
from loiter.cli import report
from loiter.cli.fences import FenceOptions, NotSent, check_fence, check_own_fence
from loiter.cli.options import (
    Fit,
    Json,
    MissionOptions,
    OrbitOptions,
    PlacedOrbitOptions,
    PlacedStartOptions,
    PlannedAircraftOptions,
    Seconds,
    StartOptions,
    Whole,
    WindOptions,
)
from loiter.cli.scenes import fit_proposed, read_options
from loiter.errors import InvalidArgument
from loiter.files.document import maneuver_values
from loiter.files.missions.items import Autopilot, Mission
from loiter.files.missions.mission import own_loiter_remark
from loiter.flight import lines as vehicles
from loiter.flight.link.link import TIMEOUT_S, check_target
from loiter.flight.options import WatchedAircraftOptions
from loiter.geo import LocalFrame
from loiter.planning.solve import fastest

if TYPE_CHECKING:
    from loiter.planning.maneuver import Maneuver

connection = Group("Connection", sort_key=0)

Connect = Annotated[
    str,
    Parameter(
        group=connection,
        metavar="LINK",
        help="udpin:HOST:PORT waits for a vehicle or router that sends to this port, as MAVProxy and most simulators do to 14550; udpout:HOST:PORT and tcp:HOST:PORT call it: udpout:127.0.0.1:18570 is PX4's simulator, tcp:127.0.0.1:5762 ArduPlane's. A radio is a serial device: /dev/ttyUSB0,57600.",
    ),
]


@Parameter(name="*", group=connection)
@dataclass(frozen=True)
class LinkOptions:
    """Which vehicle is meant, and how long it may be silent."""

    system: Whole = None
    """The vehicle's system number, needed if there are several vehicles."""
    timeout: Seconds = TIMEOUT_S
    """Give up after this time without progress."""


@Parameter(name="*", group=connection)
@dataclass(frozen=True)
class RadiusOptions:
    """The radius that is sent."""

    true_radius: bool = False
    """If NAVL1_LIM_BANK is 0, ArduPlane flies wider loiters at higher altitude; this option sends the radius for which it flies the desired one."""


@Parameter(name="*", group=connection)
@dataclass(frozen=True)
class UploadOptions(RadiusOptions):
    """What is sent."""

    start: bool = False
    """Command the vehicle to fly the mission, if it is in the air; it is neither armed nor made to take off."""


@Parameter(name="*", group=connection)
@dataclass(frozen=True)
class WatchOptions:
    """What is printed, and whether anything is sent."""

    every: Seconds = 1.0
    """Time between lines."""
    reports: Whole = None
    """End after this many lines; at Ctrl-C if absent."""
    send: bool = False
    """Command the vehicle to hold the circle, in the faster direction, as soon as there is a plan; it then flies there by its own guidance. Without this option nothing is commanded."""


def upload(
    mission: Annotated[
        Path | None, Parameter(name="FILE", help="A mission to send, .plan or .waypoints, instead of a scene.")
    ] = None,
    /,
    *,
    connect: Connect,
    link: LinkOptions = LinkOptions(),
    sent: UploadOptions = UploadOptions(),
    pose: PlacedStartOptions = PlacedStartOptions(),
    circle: PlacedOrbitOptions = PlacedOrbitOptions(),
    uav: PlannedAircraftOptions = PlannedAircraftOptions(),
    air: WindOptions = WindOptions(),
    fence: FenceOptions = FenceOptions(),
    fit: Fit = False,
    waypoints: MissionOptions = MissionOptions(),
    json: Annotated[Json, Parameter(help="Print one JSON object: the plan, and what the vehicle has now.")] = False,
) -> None:
    """Send the fastest entry to a vehicle as a mission, and read it back, item by item, to verify it."""
    # These checks come before anything is planned or printed.
    check_target(connect, link.system, 1, link.timeout)
    options = (pose, circle, uav, air, waypoints, fence)
    to_send: Mission | Callable[[int], Mission]
    plan: dict[str, object] = {}
    own_loiter, not_sent = "", NotSent()
    if mission is None:
        planned = _plan_mission(*options, fit=fit)
        own_loiter = "" if waypoints.along_path else own_loiter_remark(planned.maneuver)
        to_send, plan = planned.to_mission, {"plan": maneuver_values(planned.maneuver, planned.frame)}
        if not json:
            report.write(*planned.lines)
    elif fit or any(given != type(given)() for given in options):
        raise InvalidArgument("mission", "FILE is sent as it is: options of a scene have no effect with it")
    else:
        to_send = files.read_mission(mission)
        not_sent = check_own_fence(mission, to_send)
        plan = {"not_sent": not_sent._asdict()} if any(not_sent) else {}
    with _progress_bars() as on_progress:
        summary = flight.upload(
            to_send,
            connect,
            system=link.system,
            timeout_s=link.timeout,
            on_progress=on_progress,
            true_radius=sent.true_radius,
            start=sent.start,
        )
    if json:
        report.print_json({"vehicle": asdict(summary)} | plan)
        return
    kept = ", each as sent" if not summary.cut else ""
    vehicle = f"Vehicle {summary.system} ({summary.autopilot})"
    lines = [
        f"{vehicle} has the mission: {summary.items} items sent and read back{kept}.",
        f"It replaced a mission of {summary.replaced} items." if summary.replaced else "It had none before.",
    ]
    lines += ["It flies the mission."] if summary.started else []
    lines += [own_loiter] if own_loiter and summary.autopilot == Autopilot.ARDUPILOT.described else []
    report.write(*lines, *summary.cut, *summary.remarks, *not_sent.lines)


class PlannedMission(NamedTuple):
    """A maneuver, its frame, the function that makes it a mission for an autopilot, and lines to print."""

    maneuver: Maneuver
    frame: LocalFrame
    to_mission: Callable[[int], Mission]
    lines: list[str]


def _plan_mission(
    pose: StartOptions,
    circle: OrbitOptions,
    uav: PlannedAircraftOptions,
    air: WindOptions,
    waypoints: MissionOptions,
    fence: FenceOptions,
    *,
    fit: bool,
) -> PlannedMission:
    """The scene's fastest entry, to be sent."""
    datum = waypoints.datum(circle.site)
    if pose.pose_lla is None or not circle.placed:
        raise InvalidArgument("pose_lla", "and --orbit-lla are needed: a vehicle's mission is in degrees")
    altitude_m = uav.written_altitude
    if altitude_m is None:
        raise InvalidArgument("altitude_m", f"is needed: a vehicle's mission has one, {datum.unit}")
    along_path = waypoints.along_path
    (problem, frame), remark = read_options(pose, circle, uav, air, fit=fit, datum=datum)
    assert frame is not None  # both places are in degrees
    with fit_proposed():
        best = fastest(problem)
    to_mission = partial(
        files.mission,
        best,
        frame,
        altitude_m,
        spacing_m=waypoints.spacing,
        chord_error_m=waypoints.chord_error_m,
        datum=datum,
        along_path=along_path,
    )
    # An entry that cannot become a mission is refused before anything is printed.
    to_mission()
    fenced = check_fence(fence, circle.site, best, frame)
    if fenced and not fenced.check.clear:
        raise InvalidArgument("fence", f"is not kept, and nothing is sent: {fenced.check.sentence(frame)}")
    lines = [
        *([remark] if remark else []),
        str(best),
        *([report.ALONG_PATH] if along_path else []),
        *([fenced.check.sentence(frame), "The fence itself is not sent."] if fenced else []),
    ]
    return PlannedMission(best, frame, lambda autopilot: to_mission(autopilot=autopilot), lines)


TRANSFER_STEPS = {"read": "Reading its mission", "send": "Sending", "check": "Reading back"}


@contextmanager
def _progress_bars() -> Iterator[Callable[[str, int, int], None]]:
    """A progress bar for each phase of a transfer, on standard error if that is a terminal."""
    console = Console(stderr=True)
    with Progress(
        TextColumn("{task.description}"),
        BarColumn(),
        MofNCompleteColumn(),
        console=console,
        transient=True,
        disable=not sys.stderr.isatty(),
    ) as bars:
        tasks = {phase: bars.add_task(text, total=None, visible=False) for phase, text in TRANSFER_STEPS.items()}

        def on_progress(phase: str, done: int, total: int) -> None:
            bars.update(tasks[phase], completed=done, total=total, visible=True)

        yield on_progress


def watch(
    *,
    connect: Connect,
    link: LinkOptions = LinkOptions(),
    shown: WatchOptions = WatchOptions(),
    radius: RadiusOptions = RadiusOptions(),
    circle: PlacedOrbitOptions = PlacedOrbitOptions(),
    uav: WatchedAircraftOptions = WatchedAircraftOptions(),
    air: WindOptions = WindOptions(),
    json: Annotated[Json, Parameter(help="Print a JSON object a line instead of text.")] = False,
) -> None:
    """Receive the telemetry of a vehicle and print, live, the fastest entry from its position."""
    if not circle.placed:
        raise InvalidArgument("orbit_lla", "is needed: a vehicle reports its position in degrees")
    air.check_declination()
    if shown.send:
        circle.check_unfenced("with --send")
    orbit, frame = circle.circle(uav.preset)
    assert frame is not None  # the circle is in degrees
    if shown.reports is not None and shown.reports < 1:
        raise InvalidArgument("reports", f"is {shown.reports}: it must be at least 1")
    wind = None if air.wind is None else air.moving_air
    vehicle_reports = flight.watch(
        connect,
        orbit,
        frame,
        uav.aircraft,
        wind,
        system=link.system,
        period_s=shown.every,
        timeout_s=link.timeout,
        send=shown.send,
        altitude_m=uav.written_altitude if shown.send else None,
        true_radius=radius.true_radius,
    )
    if json:
        for vehicle in islice(vehicle_reports, shown.reports):
            vehicles.print_line(vehicles.watch_document(vehicle))
        return
    unchecked = "The fence of --orbit-from is not checked." if circle.fenced else ""
    report.write(*filter(None, [uav.remark, unchecked]))
    commanded = False
    for vehicle in islice(vehicle_reports, shown.reports):
        if vehicle.commanded and not commanded and vehicle.turn is not None:
            report.write(f"The vehicle was commanded to hold the circle {vehicle.turn.described}.")
        commanded = vehicle.commanded
        report.write(*vehicle.notices, vehicles.watch_line(vehicle))
        sys.stdout.flush()
