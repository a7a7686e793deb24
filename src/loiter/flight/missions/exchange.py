"""Upload of a mission, after which a vehicle has either the new or its old mission, and download."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from math import isnan, nan
from typing import Any, NamedTuple

from loiter.errors import InvalidArgument, LinkFailed, instance
from loiter.files.missions.items import Autopilot, Frame, Mission
from loiter.flight.link.enumerations import autopilot_name
from loiter.flight.link.link import TIMEOUT_S, Link, Vehicle, check_target, open_link
from loiter.flight.link.parameters import Parameters
from loiter.flight.link.status_text import StatusTexts
from loiter.flight.link.telemetry import NO_FIX, Fix, Telemetry
from loiter.flight.missions import transfer
from loiter.flight.missions.flown_radius import LoiterScaling, fit_radii, query_scaling, scaling_parameters
from loiter.flight.missions.requirements import REQUIREMENT, requirement_remark
from loiter.flight.missions.start import flies_mission, start_mission
from loiter.flight.missions.stored_items import (
    PER_DEGREE,
    StoredItem,
    decode,
    differences,
    encode,
    is_same,
    keeps_home,
    own_home,
)
from loiter.geo.frame import LocalFrame, degrees_of, is_swapped

# Called with the phase ("read", "send", "check"), the number of items done in it, and the number of all items.
ReportProgress = Callable[[str, int, int], None]


@dataclass(frozen=True)
class MissionSummary:
    """The result of an upload.

    `items` and `replaced` count the items of the new and of the old mission, without home. `cut` lists, one sentence
    each, the values that the autopilot rounds, such as a radius that ArduPilot stores in whole metres. `remarks` lists
    what the autopilot will do differently from the mission: fly another radius, or not fly the mission at all.
    `started` says whether the vehicle was commanded to fly the mission and flies it.
    """

    system: int
    component: int
    autopilot: str
    items: int
    replaced: int
    cut: tuple[str, ...]
    remarks: tuple[str, ...] = ()
    started: bool = False


class Behaviour(NamedTuple):
    """How a vehicle flies missions.

    `scaling` describes how it widens loiters, and `true_radius` says whether to compensate for that; `requirement` is
    the value of its parameter `REQUIREMENT`, 0 for none.
    """

    scaling: LoiterScaling | None = None
    true_radius: bool = False
    requirement: float = 0.0


PLAIN_BEHAVIOUR = Behaviour()


def upload(
    mission: Mission | Callable[[int], Mission],
    connection: str,
    *,
    system: int | None = None,
    component: int = 1,
    timeout_s: float = TIMEOUT_S,
    on_progress: ReportProgress | None = None,
    true_radius: bool = False,
    start: bool = False,
) -> MissionSummary:
    """Send a mission to a vehicle, and read it back to verify that the vehicle has it.

    `mission` may also be a function that makes the mission for an autopilot, a MAV_AUTOPILOT; it is called when the
    vehicle has been found. `connection` is `udpin:HOST:PORT`, `udpout:HOST:PORT`, `tcp:HOST:PORT` or a serial device,
    `/dev/ttyUSB0,57600`; `system` is the system id of the vehicle, needed if there are several. A transfer without
    progress for `timeout_s` seconds is given up. ArduPilot keeps its home as item 0: its own home is sent again, or
    that of the mission if it has none. To other autopilots only the items are sent.

    ArduPlane widens loiters with the altitude, and PX4 does not fly a mission without a landing, unless their
    parameters say otherwise; `remarks` of the result reports both. With `true_radius` each loiter is sent with the
    radius for which ArduPlane flies that of the mission. With `start` a vehicle in flight is commanded to fly the
    mission from its first item; it is neither armed nor made to take off.

    The present mission of the vehicle is read first. If anything fails after that, or on Ctrl-C, the transfer is
    cancelled, and the old mission is sent back unless the vehicle still has it. Raises `LinkFailed` if the vehicle is
    not found, does not answer, refuses, or does not have what it was sent, or if it does not start the mission; the
    error, and likewise `KeyboardInterrupt`, says which mission the vehicle has. Raises `InvalidArgument` for arguments
    and missions that cannot be sent; `MissingPackage` without pymavlink.
    """
    check_target(connection, system, component, timeout_s)
    if not callable(mission):
        instance("mission", mission, Mission)
    texts, telemetry = StatusTexts(), Telemetry()

    def on_message(message: Any, now: float) -> None:
        texts.update(message)
        telemetry.update(message, now)

    with open_link(connection, system, component, timeout_s, on_message=on_message) as link:
        new = mission(link.vehicle.autopilot) if callable(mission) else mission
        instance("mission", new, Mission)
        check_mission(new, link.vehicle)
        scaling = query_scaling(link, scaling_parameters(link.vehicle), true_radius=true_radius)
        behaviour = Behaviour(scaling, true_radius, _requirement(link))
        summary = replace_mission(link, new, timeout_s, on_progress or _no_progress, behaviour, telemetry.fix)
        if not start:
            return summary
        try:
            start_mission(link, texts, timeout_s)
        except LinkFailed as failure:
            if not behaviour.requirement:
                raise
            # The cause is a parameter of PX4; its answer does not always name it.
            raise LinkFailed(
                "; ".join([str(failure), *(remark.rstrip(".") for remark in summary.remarks)])
            ) from failure
        return replace(summary, started=True)


def download(
    connection: str,
    *,
    system: int | None = None,
    component: int = 1,
    timeout_s: float = TIMEOUT_S,
    on_progress: ReportProgress | None = None,
) -> Mission:
    """The mission that a vehicle has, without home: places in WGS84 degrees, altitudes in metres.

    `connection`, `system`, `component`, `timeout_s` (seconds without progress) and `on_progress` are those of `upload`.
    Raises `LinkFailed` if the vehicle is not found or does not answer; `InvalidArgument` for arguments that cannot be
    used, and `MissingPackage` without pymavlink.

    The home is that of ArduPilot's item 0. Other autopilots do not store it with the mission, so it is nan.
    """
    check_target(connection, system, component, timeout_s)
    with open_link(connection, system, component, timeout_s) as link:
        progress = _in_phase("read", on_progress or _no_progress)
        return decode(transfer.receive(link, timeout_s, progress), link.vehicle)


def replace_mission(
    link: Link,
    mission: Mission,
    timeout_s: float,
    on_progress: ReportProgress,
    behaviour: Behaviour = PLAIN_BEHAVIOUR,
    fix: Callable[[], Fix] = lambda: NO_FIX,
) -> MissionSummary:
    """The steps of `upload` with an open link, without the start; `fix` gives the position of the vehicle then."""
    vehicle = link.vehicle
    check_mission(mission, vehicle)
    old = transfer.receive(link, timeout_s, _in_phase("read", on_progress))
    home = own_home(old, vehicle)
    check_not_swapped(mission, home, fix())
    items, remarks = _adapt(mission, vehicle, home, behaviour)
    try:
        if vehicle.autopilot == Autopilot.PX4 and is_same(old, items, vehicle) and not flies_mission(link):
            # If PX4 has found a mission invalid, it does not check it again, even after its parameters have changed.
            transfer.clear(link, timeout_s)
        wrong, cut = _send_and_check(link, items, timeout_s, on_progress)
        if wrong:
            first, *others = wrong
            more = f", and {len(others)} more" if others else ""
            raise LinkFailed(f"{vehicle.named} does not keep what it was sent: {first}{more}")
    except LinkFailed as failure:
        raise LinkFailed(f"{failure}; {restore(link, old, timeout_s)}") from failure
    except KeyboardInterrupt:
        raise KeyboardInterrupt(f"interrupted; {link.vehicle.named}: {restore(link, old, timeout_s)}") from None
    except BaseException:
        restore(link, old, timeout_s)
        raise
    homes = int(keeps_home(vehicle))
    return MissionSummary(
        system=vehicle.system,
        component=vehicle.component,
        autopilot=autopilot_name(vehicle.autopilot),
        items=len(items) - homes,
        replaced=max(0, len(old) - homes),
        cut=tuple(cut),
        remarks=tuple(remarks),
    )


def check_mission(mission: Mission, vehicle: Vehicle) -> None:
    """Raise `InvalidArgument` for a mission whose items cannot be sent, before anything is requested of the vehicle."""
    encode(mission._replace(home=(0.0, 0.0, 0.0)), vehicle)


def check_not_swapped(mission: Mission, home: StoredItem | None, fix: Fix) -> None:
    """Raise `InvalidArgument` for a mission far from the vehicle that would be near with coordinates swapped.

    The place of the vehicle is its position or, if it has not sent it, its home; without either nothing is checked.
    """
    if home is not None and isnan(fix.latitude_deg):
        fix = NO_FIX._replace(latitude_deg=home.x / PER_DEGREE, longitude_deg=home.y / PER_DEGREE)
    item = next((item for item in mission.items if item.frame != Frame.NOWHERE), None)
    if isnan(fix.latitude_deg) or item is None:
        return
    here = LocalFrame(fix.latitude_deg, fix.longitude_deg)
    if is_swapped(here, item.latitude_deg, item.longitude_deg):
        raise InvalidArgument(
            "mission",
            f"begins at {degrees_of(item.latitude_deg, item.longitude_deg)}, far from the vehicle at "
            f"{degrees_of(here.latitude_deg, here.longitude_deg)}: are latitude and longitude swapped?",
        )


def _adapt(
    mission: Mission, vehicle: Vehicle, home: StoredItem | None, behaviour: Behaviour
) -> tuple[list[StoredItem], list[str]]:
    """The items to send to a vehicle, whose own home may be given, and remarks on how it will fly them."""
    items = encode(mission, vehicle, home)
    if behaviour.scaling is not None:
        altitude_m = nan if home is None else home.z
        return fit_radii(items, behaviour.scaling, vehicle, altitude_m, true_radius=behaviour.true_radius)
    missing = requirement_remark(items, behaviour.requirement)
    return items, [missing] if missing else []


def _requirement(link: Link) -> float:
    """The value of `REQUIREMENT` in a vehicle; 0 for other autopilots than PX4, and if it does not answer."""
    if link.vehicle.autopilot != Autopilot.PX4:
        return 0.0
    known = Parameters([REQUIREMENT], link.vehicle.autopilot).wait(link, bool)
    return known.get(REQUIREMENT, 0.0)


def _send_and_check(
    link: Link, items: Sequence[StoredItem], timeout_s: float, on_progress: ReportProgress
) -> tuple[list[str], list[str]]:
    """Send the items and read them back; returns the result of `differences`.

    A vehicle that does not acknowledge may have given up before the last item: the items are then sent again.
    """
    for _ in range(transfer.ATTEMPTS):
        accepted = transfer.send(link, items, timeout_s, _in_phase("send", on_progress))
        kept = transfer.receive(link, timeout_s, _in_phase("check", on_progress))
        wrong, cut = differences(items, kept, link.vehicle)
        if accepted or not wrong:
            break
    return wrong, cut


def restore(link: Link, old: Sequence[StoredItem], timeout_s: float) -> str:
    """Send a vehicle its old mission unless it still has it; returns the result in words."""
    try:
        if is_same(transfer.receive(link, timeout_s), old, link.vehicle):
            return "it still has its old mission"
        if old:
            transfer.send(link, old, timeout_s)
        else:
            transfer.clear(link, timeout_s)
        if is_same(transfer.receive(link, timeout_s), old, link.vehicle):
            return "its old mission was sent back"
    except LinkFailed as failure:
        return f"whether it has its old mission is not known: {failure}"
    return "its old mission could not be sent back: check its mission before it flies"


def _no_progress(phase: str, done: int, total: int) -> None:
    """Progress that nobody wants to know."""


def _in_phase(phase: str, on_progress: ReportProgress) -> transfer.CountItems:
    return lambda done, total: on_progress(phase, done, total)
