"""A mission brought to a vehicle whole, or the one that it has left there; and read."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from loiter.errors import InvalidArgument, LinkFailed, positive
from loiter.io.items import Mission
from loiter.mavlink import transfer
from loiter.mavlink.link import Link, connected
from loiter.mavlink.stored import StoredItem, compared, decoded, encoded, keeps_home, same
from loiter.mavlink.words import autopilot_name

# Seconds without progress after which a transfer is given up: ten times a message that calls for an answer. On a line
# that loses one packet of five each way, all ten fail once in 27,000 times.
TIMEOUT_S = 15.0

# What is being done ("read", "send", "check"), how many items are done, and of how many.
Progress = Callable[[str, int, int], None]


@dataclass(frozen=True, slots=True)
class Summary:
    """What an upload did.

    `items` and `replaced` count the items of the new and of the old mission, home not among them. `cut` says, a
    sentence each, what the autopilot keeps in its own way: ArduPilot a radius in whole metres, for instance.
    """

    system: int
    component: int
    autopilot: str
    items: int
    replaced: int
    cut: tuple[str, ...]


def upload(
    mission: Mission,
    connection: str,
    *,
    system: int | None = None,
    component: int = 1,
    timeout_s: float = TIMEOUT_S,
    on_progress: Progress | None = None,
) -> Summary:
    """Send a mission to a vehicle, and read it back to see that it is there.

    `connection` is `udpin:HOST:PORT`, `udpout:HOST:PORT`, `tcp:HOST:PORT` or a serial device, `/dev/ttyUSB0,57600`;
    `system` the vehicle's system number where several are on the line. `timeout_s` (seconds) passes without progress
    before anything is given up. ArduPilot gets the mission's home as item 0, others the items alone.

    The mission that the vehicle has is read first. Where anything goes wrong after that, Ctrl-C included, the transfer
    is cancelled, and the old mission sent back unless it is still there. Raises `LinkFailed` where the vehicle is not
    found, is silent, refuses, or keeps something else than it was sent, and says what became of the old mission, as
    `KeyboardInterrupt` does; `InvalidArgument` for arguments and missions that cannot be sent; `MissingPackage` without
    pymavlink.
    """
    check_target(system, component, timeout_s)
    with connected(connection, system, component, timeout_s) as link:
        return replace(link, mission, timeout_s, on_progress or (lambda doing, done, total: None))


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


def replace(link: Link, mission: Mission, timeout_s: float, on_progress: Progress) -> Summary:
    """What `upload` does once there is a link."""
    vehicle = link.vehicle
    items = encoded(mission, vehicle)
    old = transfer.receive(link, timeout_s, _progress("read", on_progress))
    try:
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
    return Summary(vehicle.system, vehicle.component, autopilot_name(vehicle.autopilot), *counts, tuple(cut))


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
