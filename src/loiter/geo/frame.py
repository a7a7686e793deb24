"""WGS84 latitude and longitude to local metres and back, about a point: an azimuthal equidistant plane.

The place at distance d along the geodesic of azimuth a from the origin has east = d sin(a), north = d cos(a). Distances
from the origin are true; perpendicular to them, the plane stretches by c / sin(c) = 1 + c^2 / 6, with c the distance
over the Earth's radius. pyproj computes the geodesics (C. F. F. Karney, Algorithms for geodesics, J. Geodesy 87, 2013).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from typing import TYPE_CHECKING, Any, NamedTuple

from loiter.errors import InvalidArgument, OutOfRange, instance, number
from loiter.lazy import LazyModule
from loiter.planning.compass import wrapped
from loiter.planning.model import Pose

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt
else:
    np, npt = LazyModule("numpy"), LazyModule("numpy.typing")

# At this distance the plane stretches by 4.1e-5: a flight from there to the origin is off by less than 4 m, which is
# the accuracy of satellite navigation, and headings by less than 0.002 degrees.
REACH_M = 100_000.0


class Place(NamedTuple):
    """A place on Earth and a heading there: WGS84 degrees, the heading clockwise from true north, in [0, 360)."""

    latitude_deg: float
    longitude_deg: float
    heading_deg: float


@dataclass(frozen=True)
class LocalFrame:
    """A plane of metres east and north of an origin on the WGS84 ellipsoid, accurate within 100 km of it.

    Take the circle's centre as the origin. Longitudes may start from -180 or from 0. Raises `InvalidArgument` for a
    latitude that is not between -90 and 90 degrees and for values that are not finite.

    >>> from loiter.geo import LocalFrame
    >>> frame = LocalFrame(47.0, 8.0)
    >>> east_m, north_m = frame.to_local(47.01, 8.0)
    >>> round(float(north_m), 3)
    1111.709
    """

    latitude_deg: float
    longitude_deg: float

    def __post_init__(self) -> None:
        latitude_deg, longitude_deg = checked_place("origin", self.latitude_deg, self.longitude_deg)
        object.__setattr__(self, "latitude_deg", latitude_deg)
        object.__setattr__(self, "longitude_deg", longitude_deg)

    def to_local(
        self, latitude_deg: npt.ArrayLike, longitude_deg: npt.ArrayLike
    ) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]:
        """East and north, metres, of places in degrees; they broadcast. nan beyond 100 km and for invalid places."""
        east, north, _ = to_plane(self.latitude_deg, self.longitude_deg, latitude_deg, longitude_deg)
        return east, north

    def to_geodetic(
        self, east_m: npt.ArrayLike, north_m: npt.ArrayLike
    ) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]:
        """Latitude and longitude, degrees, of places in metres; they broadcast. nan beyond 100 km.

        Longitudes are in [-180, 180].
        """
        return from_plane(self.latitude_deg, self.longitude_deg, east_m, north_m)

    def convergence_deg(self, latitude_deg: npt.ArrayLike, longitude_deg: npt.ArrayLike) -> npt.NDArray[np.float64]:
        """The angle to add to a true heading at each place to measure it from the plane's north; places broadcast.

        The meridians of two places are not parallel: 20 km east at a latitude of 60 degrees makes 0.3 degrees. nan
        where `to_local` gives nan.
        """
        _, _, convergence = to_plane(self.latitude_deg, self.longitude_deg, latitude_deg, longitude_deg)
        return convergence

    def pose(self, latitude_deg: float, longitude_deg: float, heading_deg: float) -> Pose:
        """A pose from WGS84 degrees and a true heading.

        Raises `InvalidArgument` for an invalid place, `OutOfRange` for one more than 100 km from the origin.
        """
        lat, lon = checked_place("pose", latitude_deg, longitude_deg)
        heading = number("pose true heading_deg", heading_deg, "degrees")
        east, north, convergence = (float(value) for value in to_plane(self.latitude_deg, self.longitude_deg, lat, lon))
        if east != east:
            raise self._too_far(f"{lat:g} {lon:g}", self._swapped_hint(lat, lon))
        return Pose(east, north, wrapped(heading) + convergence)

    def place(self, pose: Pose) -> Place:
        """The place on Earth of a pose of the plane, and its true heading.

        Raises `OutOfRange` for one more than 100 km from the origin.
        """
        instance("pose", pose, Pose)
        latitude, longitude = (float(value) for value in self.to_geodetic(pose.east_m, pose.north_m))
        if latitude != latitude:
            raise self._too_far(f"{pose.east_m:g} m east, {pose.north_m:g} m north")
        heading = wrapped(pose.heading_deg) - float(self.convergence_deg(latitude, longitude))
        return Place(latitude, longitude, wrapped(heading))

    def _too_far(self, where: str, hint: str = "") -> OutOfRange:
        return OutOfRange(
            f"the place {where} is more than {REACH_M / 1000.0:g} km from the origin {self.latitude_deg:g} "
            f"{self.longitude_deg:g}: the plane is not a good model of the Earth at that distance{hint}"
        )

    def _swapped_hint(self, latitude_deg: float, longitude_deg: float) -> str:
        """A question where the place would be near if its coordinates, or those of the origin, were swapped."""
        near = self._reaches(longitude_deg, latitude_deg) or (
            abs(self.longitude_deg) <= 90.0
            and LocalFrame(self.longitude_deg, self.latitude_deg)._reaches(latitude_deg, longitude_deg)
        )
        return "; are latitude and longitude swapped in one of them?" if near else ""

    def _reaches(self, latitude_deg: float, longitude_deg: float) -> bool:
        east_m, _ = self.to_local(latitude_deg, longitude_deg)
        return not bool(east_m != east_m)


def to_plane(
    latitude_0_deg: npt.ArrayLike,
    longitude_0_deg: npt.ArrayLike,
    latitude_deg: npt.ArrayLike,
    longitude_deg: npt.ArrayLike,
) -> tuple[npt.NDArray[np.float64], ...]:
    """East and north, metres, of places in the planes of their origins, and the convergence there, degrees.

    The origins are the first two arguments; all broadcast. nan beyond 100 km and for invalid places.
    """
    import numpy as np

    given = (latitude_0_deg, longitude_0_deg, latitude_deg, longitude_deg)
    lat0, lon0, lat, lon = np.broadcast_arrays(*(np.asarray(each, float) for each in given))
    good = (np.abs(lat) <= 90.0) & np.isfinite(lon) & (np.abs(lat0) <= 90.0) & np.isfinite(lon0)
    lat0, lon0, lat, lon = (np.where(good, each, 0.0) for each in (lat0, lon0, lat, lon))
    out, back, distance = _geod().inv(lon0, lat0, lon, lat)
    angle = np.radians(out)
    good &= distance <= REACH_M
    # The geodesic arrives with the azimuth back + 180; in the plane it is straight.
    convergence = wrapped(out - back) - 180.0
    return tuple(
        np.where(good, column, np.nan) for column in (distance * np.sin(angle), distance * np.cos(angle), convergence)
    )


def from_plane(
    latitude_0_deg: npt.ArrayLike, longitude_0_deg: npt.ArrayLike, east_m: npt.ArrayLike, north_m: npt.ArrayLike
) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]:
    """Latitude and longitude, degrees, of places in the planes of their origins; nan beyond 100 km. All broadcast."""
    import numpy as np

    given = (latitude_0_deg, longitude_0_deg, east_m, north_m)
    lat0, lon0, east, north = np.broadcast_arrays(*(np.asarray(each, float) for each in given))
    near = np.hypot(east, north) <= REACH_M
    lat0, lon0, east, north = (np.where(near, each, 0.0) for each in (lat0, lon0, east, north))
    azimuth, distance = np.degrees(np.arctan2(east, north)), np.hypot(east, north)
    longitude, latitude, _ = _geod().fwd(lon0, lat0, azimuth, distance)
    return np.where(near, latitude, np.nan), np.where(near, longitude, np.nan)


def is_swapped(frame: LocalFrame, latitude_deg: float, longitude_deg: float) -> bool:
    """Whether a place is more than 100 km from the origin, and would be nearer with its coordinates swapped."""
    return not frame._reaches(latitude_deg, longitude_deg) and frame._reaches(longitude_deg, latitude_deg)


def degrees_of(latitude_deg: float, longitude_deg: float) -> str:
    """A place as text, to a decimetre: "47.110000 N 8.230000 E"."""
    north, east = "N" if latitude_deg >= 0.0 else "S", "E" if longitude_deg >= 0.0 else "W"
    return f"{abs(latitude_deg):.6f} {north} {abs(longitude_deg):.6f} {east}"


def checked_place(argument: str, latitude_deg: object, longitude_deg: object) -> tuple[float, float]:
    """Latitude and longitude as floats; raises `InvalidArgument` unless they are a place on Earth."""
    lat = number(f"{argument} latitude_deg", latitude_deg, "degrees")
    lon = number(f"{argument} longitude_deg", longitude_deg, "degrees")
    if abs(lat) > 90.0:
        swapped = "; are latitude and longitude swapped?" if abs(lon) <= 90.0 else ""
        raise InvalidArgument(
            f"{argument} latitude_deg", f"is {latitude_deg}: it must be between -90 and 90 degrees{swapped}"
        )
    if abs(lon) > 360.0:
        raise InvalidArgument(
            f"{argument} longitude_deg", f"is {longitude_deg}: it must be between -360 and 360 degrees"
        )
    return lat, lon


@cache
def _geod() -> Any:
    from pyproj import Geod

    return Geod(ellps="WGS84")
