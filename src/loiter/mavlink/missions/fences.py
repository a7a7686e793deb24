"""The fence that a vehicle has, by the mission protocol with MAV_MISSION_TYPE_FENCE."""

from __future__ import annotations

from loiter.errors import LinkFailed
from loiter.fences.places import PlacedFence
from loiter.io.missions.fences import zones_of
from loiter.mavlink.connection.link import FENCE, TIMEOUT_S, Link, check_target, open_link
from loiter.mavlink.missions import transfer
from loiter.mavlink.missions.stored_items import decode_item


def download_fence(
    connection: str, *, system: int | None = None, component: int = 1, timeout_s: float = TIMEOUT_S
) -> PlacedFence | None:
    """The fence that a vehicle has: zones in WGS84 degrees, metres (`loiter.fences.PlacedFence`); None without one.

    `connection`, `system`, `component` and `timeout_s` (seconds without progress) are those of `upload`. Whether the
    vehicle heeds its fence is a parameter (FENCE_ENABLE, GF_ACTION) that is not read here. Raises `LinkFailed` if the
    vehicle is not found, does not answer, keeps no fences, or has items that are none; `InvalidArgument` for arguments
    that cannot be used, and `MissingPackage` without pymavlink.
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
    zones = tuple(
        zones_of(numbered, lambda problem: LinkFailed(f"{link.vehicle.named} has a fence in which {problem}"))
    )
    return PlacedFence(zones) if zones else None
