"""Fences on Earth: zones in WGS84 degrees, and their conversion to local metres.

An edge is straight in the local plane. The autopilots' edges are straight in a plane of latitude and longitude: within
an edge of length L they are apart by L^2 tan(latitude) / 8 Earth radii at most, 2 cm in a kilometre at 47 degrees.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple, TypeAlias

from loiter.errors import OutOfRange, instance
from loiter.fences.fence import Fence
from loiter.fences.model import CircleZone, PolygonZone, Zone
from loiter.geo.frame import REACH_M, LocalFrame, degrees_of


class PlacedCircle(NamedTuple):
    """A circle to stay inside (`inclusion`) or outside: its centre in WGS84 degrees, its radius in metres."""

    name: str
    latitude_deg: float
    longitude_deg: float
    radius_m: float
    inclusion: bool = False

    def local(self, frame: LocalFrame) -> CircleZone:
        """The circle in local metres."""
        ((east, north),) = _local(self.name, frame, [(self.latitude_deg, self.longitude_deg)])
        return CircleZone(self.name, east, north, self.radius_m, self.inclusion)


class PlacedPolygon(NamedTuple):
    """A polygon to stay inside (`inclusion`) or outside: (latitude, longitude) of its corners in WGS84 degrees."""

    name: str
    corners: tuple[tuple[float, float], ...]
    inclusion: bool = False

    def local(self, frame: LocalFrame) -> PolygonZone:
        """The polygon in local metres."""
        return PolygonZone(self.name, tuple(_local(self.name, frame, self.corners)), self.inclusion)


PlacedZone: TypeAlias = PlacedCircle | PlacedPolygon


class PlacedFence(NamedTuple):
    """Zones in WGS84 degrees, as ground stations and vehicles store them."""

    zones: tuple[PlacedZone, ...]

    def local(self, frame: LocalFrame) -> Fence:
        """The fence in local metres.

        Raises `InvalidArgument` like `Fence` and its zones, and `OutOfRange` for a place more than 100 km from the
        origin of the frame.
        """
        zones: list[Zone] = [zone.local(frame) for zone in self.zones]
        return Fence(tuple(zones))


def _local(name: str, frame: LocalFrame, places: Sequence[tuple[float, float]]) -> list[tuple[float, float]]:
    """East and north of the places of a zone, in degrees."""
    instance("frame", frame, LocalFrame)
    latitudes, longitudes = zip(*places, strict=True)
    east_m, north_m = frame.to_local(latitudes, longitudes)
    if (east_m != east_m).any():
        i = int((east_m != east_m).argmax())
        corner = f"corner {i + 1} of " if len(places) > 1 else ""
        raise OutOfRange(
            f"the fence cannot be checked: {corner}the zone {name!r}, at {degrees_of(*places[i])}, is more than "
            f"{REACH_M / 1000.0:g} km from {degrees_of(frame.latitude_deg, frame.longitude_deg)}"
        )
    return list(zip(east_m.tolist(), north_m.tolist(), strict=True))
