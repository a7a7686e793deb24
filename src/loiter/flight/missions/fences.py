"""The fence that a vehicle has, by the mission protocol with MAV_MISSION_TYPE_FENCE, and its circle about home."""

from __future__ import annotations

from math import nan
from time import monotonic

from loiter.errors import LinkFailed
from loiter.fences.places import PlacedCircle, PlacedFence, PlacedZone
from loiter.files.missions.fences import FenceCommand, zones_of
from loiter.files.missions.items import Autopilot
from loiter.flight.link.command import message_request
from loiter.flight.link.link import FENCE, TIMEOUT_S, Link, check_target, open_link
from loiter.flight.link.parameters import REPEAT_S, TRIES, Parameters
from loiter.flight.missions import transfer
from loiter.flight.missions.stored_items import PER_DEGREE, decode_item

# The parameters of each autopilot that set a circle about home, and the bit of FENCE_TYPE that switches it on.
HOME_CIRCLE = {Autopilot.ARDUPILOT: ("FENCE_TYPE", "FENCE_RADIUS"), Autopilot.PX4: ("GF_MAX_HOR_DIST",)}
TYPE_CIRCLE = 2


def download_fence(
    connection: str, *, system: int | None = None, component: int = 1, timeout_s: float = TIMEOUT_S
) -> PlacedFence | None:
    """The fence that a vehicle has: zones in WGS84 degrees, metres (`loiter.fences.PlacedFence`); None without one.

    `connection`, `system`, `component` and `timeout_s` (seconds without progress) are those of `upload`. The circle
    about home that its parameters set (FENCE_TYPE and FENCE_RADIUS, GF_MAX_HOR_DIST) is one of the zones. Whether the
    vehicle heeds its fence is a parameter (FENCE_ENABLE, GF_ACTION) that is not read here. Raises `LinkFailed` if the
    vehicle is not found, does not answer, keeps no fences, or has items that are not known; `InvalidArgument` for
    arguments that cannot be used, and `MissingPackage` without pymavlink.
    """
    check_target(connection, system, component, timeout_s)
    with open_link(connection, system, component, timeout_s) as link:
        return receive_fence(link, timeout_s)


def receive_fence(link: Link, timeout_s: float) -> PlacedFence | None:
    """The fence of the vehicle at an open link; None without one."""
    before, link.mission_type = link.mission_type, FENCE
    try:
        items = transfer.receive(link, timeout_s)
    finally:
        link.mission_type = before
    numbered = [(f"item {seq}", decode_item(item)) for seq, item in enumerate(items, start=1)]
    radius_m = _home_radius_m(link)
    needs_home = radius_m != 0.0 or any(item.command == FenceCommand.HOME_CIRCLE_INCLUSION for item in items)
    home = _home(link) if needs_home else None
    zones: list[PlacedZone] = [*zones_of(numbered, lambda problem: _fault(link, problem), home)]
    if radius_m != 0.0:
        if home is None or not radius_m > 0.0:
            raise _fault(link, f"the circle about home ({', '.join(_names(link))}) is not known")
        zones.append(PlacedCircle("circle about home", *home, radius_m, inclusion=True))
    return PlacedFence(tuple(zones)) if zones else None


def _fault(link: Link, problem: str) -> LinkFailed:
    return LinkFailed(f"{link.vehicle.named} has a fence in which {problem}")


def _names(link: Link) -> tuple[str, ...]:
    """The parameters of the vehicle's autopilot that set a circle about home."""
    return next((names for autopilot, names in HOME_CIRCLE.items() if autopilot == link.vehicle.autopilot), ())


def _home_radius_m(link: Link) -> float:
    """The radius of the circle about home that parameters set: 0 without one, nan if it is on and not known."""
    names = _names(link)
    if not names:
        return 0.0
    known = Parameters(names, link.vehicle.autopilot).wait(link, lambda known: len(known) == len(names))
    if link.vehicle.autopilot == Autopilot.PX4:
        return known.get("GF_MAX_HOR_DIST", 0.0)
    return known.get("FENCE_RADIUS", nan) if int(known.get("FENCE_TYPE", 0.0)) & TYPE_CIRCLE else 0.0


def _home(link: Link) -> tuple[float, float] | None:
    """Latitude and longitude of the vehicle's home; None if it does not say."""
    for _ in range(TRIES):
        link.send(message_request(link, "HOME_POSITION"))
        message = link.receive({"HOME_POSITION"}, monotonic() + REPEAT_S)
        if message is not None:
            return message.latitude / PER_DEGREE, message.longitude / PER_DEGREE
    return None
