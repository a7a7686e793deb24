"""The reference from which altitudes in files are measured."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

from loiter.errors import InvalidArgument, number, positive
from loiter.files.missions.items import Frame
from loiter.files.missions.limits import HIGHEST_ITEM_M


class AltitudeReference(StrEnum):
    """The reference of an altitude: mean sea level, the home position, or the ground below."""

    MSL = "msl"
    HOME = "home"
    GROUND = "ground"


FRAMES = {
    AltitudeReference.MSL: Frame.ABOVE_SEA,
    AltitudeReference.HOME: Frame.ABOVE_HOME,
    AltitudeReference.GROUND: Frame.ABOVE_TERRAIN,
}
UNITS = {
    AltitudeReference.MSL: "metres above mean sea level",
    AltitudeReference.HOME: "metres above home",
    AltitudeReference.GROUND: "metres above the ground",
}


@dataclass(frozen=True)
class AltitudeDatum:
    """The reference of altitudes, and the altitude of the home position in metres above mean sea level, if given.

    `reference` may be given by name: "msl", "home", "ground". Raises `InvalidArgument` for another name, and for an
    altitude of home that is not finite or outside the range of missions.
    """

    reference: AltitudeReference = AltitudeReference.MSL
    home_altitude_m: float | None = None

    def __post_init__(self) -> None:
        if self.reference not in tuple(AltitudeReference):
            known = ", ".join(AltitudeReference)
            raise InvalidArgument("altitude_reference", f"is {self.reference!r}: it must be one of {known}")
        object.__setattr__(self, "reference", AltitudeReference(self.reference))
        if self.home_altitude_m is not None:
            home_m = number("home_altitude_m", self.home_altitude_m, UNITS[AltitudeReference.MSL])
            object.__setattr__(self, "home_altitude_m", _check_range("home_altitude_m", home_m))

    @property
    def frame(self) -> Frame:
        """The altitude frame of mission items."""
        return FRAMES[self.reference]

    @property
    def unit(self) -> str:
        """The unit of an altitude in words: "metres above home"."""
        return UNITS[self.reference]

    def checked(self, altitude_m: object) -> float:
        """The altitude as a float; raises `InvalidArgument` if it is not finite or outside the range of missions."""
        check = positive if self.reference == AltitudeReference.GROUND else number
        return _check_range("altitude_m", check("altitude_m", altitude_m, self.unit))

    def above_sea_m(self, altitude_m: float) -> float:
        """The altitude in metres above mean sea level; raises `InvalidArgument` if that is not known."""
        if self.reference == AltitudeReference.MSL:
            return altitude_m
        if self.reference == AltitudeReference.HOME and self.home_altitude_m is not None:
            return self.home_altitude_m + altitude_m
        if self.reference == AltitudeReference.HOME:
            raise InvalidArgument("home_altitude_m", "is missing: altitudes above home cannot be converted without it")
        raise InvalidArgument("altitude_reference", "is ground: how high that is above mean sea level is not known")

    def planned_home_m(self, altitude_m: float) -> float:
        """The altitude of the planned home of a mission flown at `altitude_m`, metres above mean sea level.

        If it is not given, it is `altitude_m` for missions above mean sea level, which do not depend on it: some
        programs fly to the home as to a waypoint. Other missions raise `InvalidArgument`.
        """
        if self.home_altitude_m is not None:
            return self.home_altitude_m
        if self.reference == AltitudeReference.MSL:
            return altitude_m
        raise InvalidArgument(
            "home_altitude_m",
            f"is missing: a mission in {self.unit} needs that of home, {UNITS[AltitudeReference.MSL]}",
        )


MEAN_SEA_LEVEL = AltitudeDatum()


def _check_range(argument: str, altitude_m: float) -> float:
    """The altitude, if a mission may have it."""
    if abs(altitude_m) > HIGHEST_ITEM_M:
        raise InvalidArgument(
            argument, f"is {altitude_m:g}: it must be from {-HIGHEST_ITEM_M:g} to {HIGHEST_ITEM_M:g} metres"
        )
    return altitude_m
