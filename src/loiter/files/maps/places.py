"""Local metres as degrees on the Earth, and headings in the plane as true headings."""

from __future__ import annotations

from typing import TYPE_CHECKING

from loiter.errors import OutOfRange
from loiter.geo.frame import REACH_M, LocalFrame
from loiter.planning.compass import wrapped

if TYPE_CHECKING:
    from numpy import float64
    from numpy.typing import ArrayLike, NDArray


# Decimals of degrees in files and JSON: 0.1 micrometres. Far from the origin, conversion to metres and back would turn
# 47.1 degrees into 47.099999999999994.
DECIMALS = 12


def degrees(frame: LocalFrame, east_m: ArrayLike, north_m: ArrayLike) -> tuple[list[float], list[float]]:
    """Latitudes and longitudes, WGS84 degrees. Raises `OutOfRange` for places too far from the frame's origin."""
    import numpy as np

    latitude, longitude = frame.to_geodetic(east_m, north_m)
    if np.isnan(latitude).any():
        raise OutOfRange(
            f"the maneuver goes more than {REACH_M / 1000.0:g} km from the frame's origin {frame.latitude_deg:g} "
            f"{frame.longitude_deg:g}: take the circle's centre as the origin"
        )
    return latitude.round(DECIMALS).tolist(), longitude.round(DECIMALS).tolist()


def true_headings(frame: LocalFrame, heading_deg: ArrayLike, latitude: ArrayLike, longitude: ArrayLike) -> list[float]:
    """Headings from true north, in [0, 360), for headings from the plane's north at places in degrees."""
    import numpy as np

    true_deg: NDArray[float64] = np.asarray(heading_deg, float) - frame.convergence_deg(latitude, longitude)
    return [wrapped(heading) for heading in true_deg.tolist()]
