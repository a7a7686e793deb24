"""Options of the commands for vehicles in flight."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from cyclopts import Parameter

from loiter.cli.fences import METRES_ONLY, FenceFile, FenceOptions
from loiter.cli.options import (
    LAT_LON_RADIUS,
    VELOCITY,
    AircraftOptions,
    Altitude,
    Angle,
    Circle,
    Metres,  # noqa: F401  # the type of an inherited option is looked up here
    PlacedOrbitOptions,
    Speed,
    TurnChoice,
    aircraft,
    scene,
    vehicle_limits,
)
from loiter.errors import InvalidArgument

if TYPE_CHECKING:
    from loiter.fences import PlacedFence
    from loiter.files.missions.site import Site
    from loiter.flight.guiding.preparation import OwnFence


@Parameter(name="*", group=aircraft)
@dataclass(frozen=True)
class WatchedAircraftOptions(AircraftOptions):
    """The aircraft; with --send it is commanded to fly at the altitude."""

    altitude: Altitude = None
    """Altitude, always above mean sea level; metres, or with a unit: 3000ft. With --send the circle is flown at this altitude, at the present one if absent. It also converts an indicated airspeed to true airspeed, which is higher in thin air; for that alone it may be a flight level: FL100."""


@Parameter(name="*", group=scene)
@dataclass(frozen=True)
class GuidedOrbitOptions(PlacedOrbitOptions):
    """The circle, which an autopilot must be able to hold: --orbit-velocity is parsed, but hidden."""

    orbit_lla: Annotated[Circle, LAT_LON_RADIUS] = ()
    """The circle: centre in WGS84 degrees, radius in metres."""
    turn: TurnChoice = None
    """Direction of flight around the circle, seen from above; the faster one if absent."""
    orbit_velocity: Annotated[tuple[float, float], VELOCITY, Parameter(show=False)] = (0.0, 0.0)


@Parameter(name="*", group=vehicle_limits)
@dataclass(frozen=True)
class GuidedVehicleOptions:
    """The vehicle, as far as its own parameters are not to be used."""

    airspeed: Speed = None
    """True airspeed, metres per second, or with a unit: 35kn."""
    bank: Angle = None
    """Largest bank, at most that of the autopilot."""
    altitude: Altitude = None
    """Altitude at which the circle is flown, always above mean sea level; metres, or with a unit: 3000ft. The present one if absent."""


@Parameter(name="*")
@dataclass(frozen=True)
class GuidedFenceOptions(FenceOptions):
    """A fence, which may be that of the vehicle."""

    fence: FenceFile = None
    """Stay clear of a fence: that of a file, as for loiter plan, with --fence vehicle the one that the vehicle has, or that of --orbit-from if absent. The fastest clear entry that is found is flown, and a flight without any refused. In flight the vehicle is handed back to its own hold where it enters a zone."""

    def of_flight(self, site: Site | None) -> PlacedFence | OwnFence | None:
        """The fence of the file or of an existing mission, or "vehicle"; None without one. Raises `InvalidArgument`."""
        if self.fence == Path("vehicle"):
            return "vehicle"
        from loiter.fences import Fence

        found = self.read(site)
        if isinstance(found, Fence):
            raise InvalidArgument("fence", METRES_ONLY)
        return found
