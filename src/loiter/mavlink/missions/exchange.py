"""A mission brought to a vehicle whole, or the one that it has left there; and read."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from math import nan
from typing import NamedTuple

from loiter.errors import InvalidArgument, LinkFailed, positive
from loiter.io.missions.items import Autopilot, Mission
from loiter.mavlink.connection.enumerations import autopilot_name
from loiter.mavlink.connection.link import Link, Vehicle, connected
from loiter.mavlink.connection.parameters import Parameters
from loiter.mavlink.connection.status_text import Texts
from loiter.mavlink.missions import requirements, transfer
from loiter.mavlink.missions.flown_radius import Scaling, fitted, parameters_of, scaling_of
from loiter.mavlink.missions.start import flies_mission, start_mission
from loiter.mavlink.missions.stored_items import StoredItem, compared, decoded, encoded, keeps_home, own_home, same

# Seconds without progress after which a transfer is given up: ten times a message that calls for an answer. On a line
# that loses one packet of five each way, all ten fail once in 27,000 times.
TIMEOUT_S = 15.0

# What is being done ("read", "send", "check"), how many items are done, and of how many.
Progress = Callable[[str, int, int], None]


@dataclass(frozen=True, slots=True)
class Summary:
    """What an upload did.

    `items` and `replaced` count the items of the new and of the old mission, home not among them. `cut` says, a
    sentence each, what the autopilot keeps in its own way: ArduPilot a radius in whole metres, for instance. `remarks`
    says, likewise, what the autopilot will make of the mission: fly another radius, or not fly it at all. `started`
    is whether it flies the mission, where that was asked for.
    """

    system: int
    component: int
    autopilot: str
    items: int
    replaced: int
    cut: tuple[str, ...]
    remarks: tuple[str, ...] = ()
    started: bool = False


class Habits(NamedTuple):
    """How a vehicle flies missions: how it widens loiters, and whether to make up for that; what it requires of them.

    `requirement` is the value of `requirements.REQUIREMENT`, 0 for nothing.
    """

    scaling: Scaling | None = None
    true_radius: bool = False
    requirement: float = 0.0


NO_HABITS = Habits()


def upload(
    mission: Mission | Callable[[int], Mission],
    connection: str,
    *,
    system: int | None = None,
    component: int = 1,
    timeout_s: float = TIMEOUT_S,
    on_progress: Progress | None = None,
    true_radius: bool = False,
    start: bool = False,
) -> Summary:
    """Send a mission to a vehicle, and read it back to see that it is there.

    `mission` may be what makes one for an autopilot, a MAV_AUTOPILOT: which it is is known once the vehicle is found.
    `connection` is `udpin:HOST:PORT`, `udpout:HOST:PORT`, `tcp:HOST:PORT` or a serial device, `/dev/ttyUSB0,57600`;
    `system` the vehicle's system number where several are on the line. `timeout_s` (seconds) passes without progress
    before anything is given up. ArduPilot keeps its home as item 0: it gets its own again, the mission's where it has
    none; others get the items alone.

    ArduPlane widens loiters with the altitude, unless its parameters say otherwise; PX4 does not fly a mission without
    a landing, unless its parameters say otherwise. Both are looked up and told in `Summary.remarks`. With `true_radius`
    ArduPlane is sent the radius with which it flies the one of the mission. With `start` a vehicle in flight is told to
    fly the mission from its first item on; none is armed, none takes off.

    The mission that the vehicle has is read first. Where anything goes wrong after that, Ctrl-C included, the transfer
    is cancelled, and the old mission sent back unless it is still there. Raises `LinkFailed` where the vehicle is not
    found, is silent, refuses, or keeps something else than it was sent, and says what became of the old mission, as
    `KeyboardInterrupt` does; where it has the new one and does not start it; `InvalidArgument` for arguments and
    missions that cannot be sent; `MissingPackage` without pymavlink.
    """
    check_target(system, component, timeout_s)
    texts = Texts()
    with connected(connection, system, component, timeout_s, hear=lambda message, now: texts.hear(message)) as link:
        wanted = mission(link.vehicle.autopilot) if callable(mission) else mission
        check_mission(wanted, link.vehicle)
        scaling = scaling_of(link, parameters_of(link.vehicle), true_radius=true_radius)
        habits = Habits(scaling, true_radius, _requirement(link))
        summary = replace_mission(link, wanted, timeout_s, on_progress or (lambda doing, done, total: None), habits)
        if not start:
            return summary
        try:
            start_mission(link, texts, timeout_s)
        except LinkFailed as failure:
            if not habits.requirement:
                raise
            # What keeps PX4 from flying it is a parameter, which it does not always say.
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
    on_progress: Progress | None = None,
) -> Mission:
    """The mission that a vehicle holds; arguments and errors as for `upload`.

    The home is that of ArduPilot's item 0. Other autopilots do not keep it with the mission: it is nan there.
    """
    check_target(system, component, timeout_s)
    with connected(connection, system, component, timeout_s) as link:
        progress = _progress("read", on_progress or (lambda doing, done, total: None))
        return decoded(transfer.receive(link, timeout_s, progress), link.vehicle)


def replace_mission(
    link: Link, mission: Mission, timeout_s: float, on_progress: Progress, habits: Habits = NO_HABITS
) -> Summary:
    """What `upload` does once there is a link, up to the start."""
    vehicle = link.vehicle
    check_mission(mission, vehicle)
    old = transfer.receive(link, timeout_s, _progress("read", on_progress))
    items, remarks = _adapted(mission, vehicle, own_home(old, vehicle), habits)
    try:
        if vehicle.autopilot == Autopilot.PX4 and same(old, items, vehicle) and not flies_mission(link):
            # It would not look again at the mission that it has, whatever has been set since it found it wanting.
            transfer.clear(link, timeout_s)
        wrong, cut = _sent(link, items, timeout_s, on_progress)
        if wrong:
            more = f", and {len(wrong) - 1} more" if len(wrong) > 1 else ""
            raise LinkFailed(f"{vehicle.named} does not keep what it was sent: {wrong[0]}{more}")
    except LinkFailed as failure:
        raise LinkFailed(f"{failure}; {put_back(link, old, timeout_s)}") from failure
    except KeyboardInterrupt:
        raise KeyboardInterrupt(f"interrupted; {link.vehicle.named}: {put_back(link, old, timeout_s)}") from None
    except BaseException:
        put_back(link, old, timeout_s)
        raise
    home = int(keeps_home(vehicle))
    counts = len(items) - home, max(0, len(old) - home)
    who = vehicle.system, vehicle.component, autopilot_name(vehicle.autopilot)
    return Summary(*who, *counts, tuple(cut), tuple(remarks))


def check_mission(mission: Mission, vehicle: Vehicle) -> None:
    """Raise `InvalidArgument` for a mission whose items cannot be sent, before the vehicle is asked for anything."""
    encoded(mission._replace(home=(0.0, 0.0, 0.0)), vehicle)


def _adapted(
    mission: Mission, vehicle: Vehicle, home: StoredItem | None, habits: Habits
) -> tuple[list[StoredItem], list[str]]:
    """The items to send to a vehicle, which may have a home of its own, and what it will make of them."""
    items = encoded(mission, vehicle, home)
    if habits.scaling is not None:
        altitude_m = nan if home is None else home.z
        return fitted(items, habits.scaling, vehicle, altitude_m, true_radius=habits.true_radius)
    missing = requirements.remark(items, habits.requirement)
    return items, [missing] if missing else []


def _requirement(link: Link) -> float:
    """What the vehicle requires of a mission; 0 where it requires nothing, or does not say."""
    if link.vehicle.autopilot != Autopilot.PX4:
        return 0.0
    known = Parameters([requirements.REQUIREMENT], link.vehicle.autopilot).wait(link, bool)
    return known.get(requirements.REQUIREMENT, 0.0)


def _sent(
    link: Link, items: Sequence[StoredItem], timeout_s: float, on_progress: Progress
) -> tuple[list[str], list[str]]:
    """What a vehicle keeps otherwise than it was sent, as `compared` has it.

    Without an acknowledgement it may have given up before the last item came: then the items are sent again.
    """
    for _ in range(transfer.ATTEMPTS):
        accepted = transfer.send(link, items, timeout_s, _progress("send", on_progress))
        kept = transfer.receive(link, timeout_s, _progress("check", on_progress))
        wrong, cut = compared(items, kept, link.vehicle)
        if accepted or not wrong:
            break
    return wrong, cut


def put_back(link: Link, old: Sequence[StoredItem], timeout_s: float) -> str:
    """See to it that a vehicle has its old mission; says how that went."""
    try:
        if same(transfer.receive(link, timeout_s), old, link.vehicle):
            return "it still has its old mission"
        if old:
            transfer.send(link, old, timeout_s)
        else:
            transfer.clear(link, timeout_s)
        if same(transfer.receive(link, timeout_s), old, link.vehicle):
            return "its old mission was sent back"
    except LinkFailed as failure:
        return f"whether it has its old mission is not known: {failure}"
    return "its old mission could not be sent back: see what it has before it flies"


def check_target(system: int | None, component: int, timeout_s: float) -> None:
    """Raise `InvalidArgument` for numbers that no vehicle has, and for no time."""
    for name, number in (("system", system), ("component", component)):
        if number is not None and (isinstance(number, bool) or not isinstance(number, int) or not 0 < number < 256):
            raise InvalidArgument(name, f"is {number!r}: it must be a whole number from 1 to 255")
    positive("timeout_s", timeout_s, "seconds")


def _progress(doing: str, on_progress: Progress) -> transfer.Progress:
    return lambda done, total: on_progress(doing, done, total)
