"""Options that several commands share, declared once: the start, the circle, the wind, the aircraft, missions."""

from collections.abc import Sequence
from dataclasses import dataclass, fields, replace
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

from cyclopts import Group, Parameter

from loiter.cli.numbers import (
    FlightLevel,
    altitude,
    angle,
    check_declination,
    declination,
    direction,
    latitude,
    longitude,
    metres,
    metres_per_second,
    one,
    several,
    true_direction,
    turn_name,
    turn_rate,
    values_given,
    whole,
)
from loiter.cli.sentences import argument_names
from loiter.errors import InvalidArgument, positive
from loiter.files.missions.altitudes import MEAN_SEA_LEVEL, AltitudeDatum, AltitudeReference
from loiter.files.missions.items import AutopilotName
from loiter.geo import LocalFrame, density_altitude_m, true_airspeed
from loiter.planning.model import CALM, Aircraft, Orbit, Turn, TurnName, Wind, circle_radius_m
from loiter.plot import files

if TYPE_CHECKING:
    from loiter.files.missions.parameters import Preset
    from loiter.files.missions.site import Site

scene = Group("Scene", sort_key=1)
aircraft = Group("Aircraft: the airspeed and exactly one limit on the turn", sort_key=2)
vehicle_limits = Group("Aircraft: what is absent comes from the vehicle's parameters", sort_key=2)
air = Group("Wind, and circles that move", sort_key=3)
way_out = Group("The way out", sort_key=4)
output = Group("Output", sort_key=5)
missions = Group("Missions", sort_key=6)

# Default chord error, metres, the same as that of the library.
CHORD_ERROR_M = 1.0

# Types of options by what they hold; a class of options adds the group, and the docstring of each is its help.
Seconds = Annotated[float, Parameter(metavar="SECONDS")]
Metres = Annotated[float | None, Parameter(converter=one(metres), metavar="METRES")]
Altitude = Annotated[float | None, Parameter(converter=one(altitude), metavar="METRES")]
Speed = Annotated[float | None, Parameter(converter=one(metres_per_second), metavar="M_PER_S")]
Angle = Annotated[float | None, Parameter(converter=one(angle), metavar="DEGREES")]
Bearing = Annotated[float | None, Parameter(metavar="DEGREES")]
TurnRate = Annotated[float | None, Parameter(converter=one(turn_rate), metavar="DEG_PER_S")]
Whole = Annotated[int | None, Parameter(converter=whole, metavar="N")]
File = Annotated[Path | None, Parameter(metavar="FILE")]
EAST_NORTH = Parameter(converter=several(metres, metres), metavar="EAST NORTH")
LAT_LON = Parameter(converter=several(latitude, longitude), metavar="LAT LON")
EAST_NORTH_HEADING = Parameter(converter=several(metres, metres, direction), metavar="EAST NORTH HEADING")
LAT_LON_HEADING = Parameter(converter=several(latitude, longitude, direction), metavar="LAT LON HEADING")
EAST_NORTH_RADIUS = Parameter(converter=several(metres, metres, metres), metavar="EAST NORTH RADIUS")
LAT_LON_RADIUS = Parameter(converter=several(latitude, longitude, metres), metavar="LAT LON RADIUS")
# As many numbers as are given: the radius may come from somewhere else.
Circle = Annotated[tuple[float, ...], Parameter(consume_multiple=True)]
TurnChoice = Annotated[TurnName | None, Parameter(converter=turn_name)]
VELOCITY = Parameter(converter=several(metres_per_second, metres_per_second), metavar="EAST NORTH")
WindChoice = Annotated[
    tuple[float, float] | None, Parameter(converter=several(metres_per_second, direction), metavar="SPEED FROM")
]
Tolerance = Annotated[float, Parameter(converter=one(metres), metavar="METRES")]
Columns = Annotated[list[str] | None, Parameter(name="--map", metavar="NAME=COLUMN", negative=())]

# Options of several commands.
Files = Annotated[tuple[Path, ...], Parameter(group=output, metavar="FILE")]
AutopilotChoice = Annotated[
    AutopilotName, Parameter(group=missions, help="The autopilot that missions are for. PX4 takes .plan only.")
]
Json = Annotated[bool, Parameter(group=output, help="Print one JSON object.")]


@Parameter(name="*", group=scene)
@dataclass(frozen=True)
class StartOptions:
    """The pose of the aircraft, in metres or in degrees."""

    pose: Annotated[tuple[float, float, float] | None, EAST_NORTH_HEADING] = None
    """Pose of the aircraft: metres, and heading in degrees clockwise from north."""
    pose_lla: Annotated[tuple[float, float, float] | None, LAT_LON_HEADING] = None
    """Pose of the aircraft: WGS84 degrees, 47.1 8.2 or 47.1N 8.2E, and heading in degrees clockwise from true north."""


@Parameter(name="*", group=scene)
@dataclass(frozen=True)
class PlacedStartOptions(StartOptions):
    """The pose of the aircraft in degrees, for commands that need places on Earth; --pose is parsed, but hidden."""

    pose: Annotated[tuple[float, float, float] | None, EAST_NORTH_HEADING, Parameter(show=False)] = None


@Parameter(name="*", group=scene)
@dataclass(frozen=True)
class SlotOptions:
    """A slot, and the time at which it is at its bearing."""

    slot: Bearing = None
    """Enter the slot that is at this bearing from the centre, a place that moves round the circle with the hold."""
    slot_at: Annotated[float | None, Parameter(metavar="SECONDS")] = None
    """The time from the start at which the slot is at that bearing; 0 if absent."""


@Parameter(name="*", group=scene)
@dataclass(frozen=True)
class BandedSlotOptions(SlotOptions):
    """A slot that a law enters and keeps."""

    slot_band: Annotated[float | None, Parameter(metavar="SHARE")] = None
    """The largest share by which the radius of the hold may differ from that of the circle, to keep the slot; 0.15 if absent."""


@Parameter(name="*", group=scene)
@dataclass(frozen=True)
class OrbitOptions:
    """The circle, in metres or in degrees, and its motion."""

    orbit: Annotated[Circle, EAST_NORTH_RADIUS] = ()
    """The circle: centre and radius, metres."""
    orbit_lla: Annotated[Circle, LAT_LON_RADIUS] = ()
    """The circle: centre in WGS84 degrees, radius in metres; the radius may come from --params."""
    orbit_from: File = None
    """Instead of --orbit-lla: the circle of an existing mission, .plan or .waypoints, that of its first loiter item, in its direction. Plans and missions keep its home and its fence, which is checked as with --fence."""
    turn: TurnChoice = None
    """Direction of flight around the circle, seen from above: cw is clockwise, ccw counter-clockwise, either the faster one. If absent: that of --orbit-from or --params, otherwise either."""
    orbit_velocity: Annotated[tuple[float, float], VELOCITY, Parameter(group=air)] = (0.0, 0.0)
    """Velocity of the circle over the ground, metres per second; --orbit is its position at the start."""

    def circle(self, preset: "Preset | None") -> tuple[Orbit, LocalFrame | None]:
        """The circle, and the local frame about its centre if it is in degrees; `InvalidArgument` without a circle."""
        radius, turn = (None, None) if preset is None else (preset.loiter_radius_m, preset.turn)
        if sum(map(bool, (self.orbit, self.orbit_lla, self.orbit_from))) != 1:
            raise InvalidArgument("orbit", "or --orbit-lla or --orbit-from is needed, and only one of them")
        if self.orbit:
            east, north, radius = _with_radius("orbit", self.orbit, radius)
            return Orbit(east, north, radius, self._turn(turn), *self.orbit_velocity), None
        if self.orbit_lla:
            lat, lon, radius = _with_radius("orbit_lla", self.orbit_lla, radius)
        else:
            lat, lon, own_radius, own_turn = self._first_circle()
            radius, turn = own_radius or radius, own_turn or turn
        if radius is None:
            raise InvalidArgument("orbit_from", "has a loiter without a radius, which --params with a radius gives")
        circle_radius_m("origin radius_m", radius)
        return Orbit(0.0, 0.0, radius, self._turn(turn), *self.orbit_velocity), LocalFrame(lat, lon)

    @property
    def placed(self) -> bool:
        """Whether the circle is in degrees."""
        return bool(self.orbit_lla) or self.orbit_from is not None

    @cached_property
    def site(self) -> "Site | None":
        """The circles, the home and the fence of the mission; None without one. Raises `InvalidArgument`."""
        if self.orbit_from is None:
            return None
        from loiter.files.missions.site import read_site

        return read_site(self.orbit_from, "orbit_from")

    @property
    def fenced(self) -> bool:
        """Whether the mission of --orbit-from has a fence."""
        return self.site is not None and self.site.fence is not None

    def check_unfenced(self, where: str) -> None:
        """Raise `InvalidArgument` for a fence of --orbit-from where none is checked."""
        if self.fenced:
            raise InvalidArgument("orbit_from", f"has a fence, which is not checked {where}: give --orbit-lla")

    def site_remark(self) -> str:
        """A line on the circle taken from a mission; otherwise empty."""
        if self.site is None:
            return ""
        first, *others = self.site.circles
        which = f", the first of {len(others) + 1} circles" if others else ""
        return f"Circle of item {first.item} in {self.orbit_from}{which}."

    def _first_circle(self) -> tuple[float, float, float | None, Turn | None]:
        assert self.site is not None  # it is the only circle given
        if not self.site.circles:
            others = ", ".join(self.site.complex_items)
            unread = f", and items of these kinds are not read: {others}" if others else ""
            raise InvalidArgument(
                "orbit_from", f"is {str(self.orbit_from)!r}: its mission has no loiter with a place{unread}"
            )
        first, *_ = self.site.circles
        return first.latitude_deg, first.longitude_deg, first.radius_m, first.turn

    def _turn(self, otherwise: Turn | None) -> Turn:
        if self.turn is not None:
            return Turn(self.turn)
        return Turn.EITHER if otherwise is None else otherwise


@Parameter(name="*", group=scene)
@dataclass(frozen=True)
class PlacedOrbitOptions(OrbitOptions):
    """The circle in degrees; otherwise like `PlacedStartOptions`."""

    orbit: Annotated[Circle, EAST_NORTH_RADIUS, Parameter(show=False)] = ()


def written_altitude(altitude_m: float | None) -> float | None:
    """The altitude for files and vehicles; raises `InvalidArgument` for a flight level, whose height above sea varies."""
    if isinstance(altitude_m, FlightLevel):
        raise InvalidArgument(
            "altitude_m",
            f"is {altitude_m}, whose height above the sea depends on the air pressure: give metres or feet above mean "
            "sea level",
        )
    return altitude_m


@Parameter(name="*", group=aircraft)
@dataclass(frozen=True)
class AircraftOptions:
    """The aircraft, from options or from the parameters of its autopilot, and the density of the air."""

    airspeed: Speed = None
    """True airspeed, metres per second, or with a unit: 35kn."""
    indicated_airspeed: Speed = None
    """Instead of --airspeed: indicated airspeed, metres per second; --altitude converts it to true airspeed."""
    bank: Angle = None
    """Largest bank, degrees."""
    turn_radius: Metres = None
    """Smallest turn radius, metres."""
    turn_rate: TurnRate = None
    """Largest turn rate, degrees per second."""
    params: File = None
    """Parameter file of ArduPlane (.param) or PX4 (.params): it gives the indicated airspeed, the bank limit, and the circle's radius and direction where no option does."""
    altitude: Altitude = None
    """Altitude above mean sea level, metres, or with a unit: 3000ft; or a flight level: FL100. It converts an indicated airspeed to true airspeed, which is higher in thin air."""
    temperature: Annotated[float | None, Parameter(metavar="CELSIUS")] = None
    """Outside air temperature; that of the standard atmosphere if absent."""

    @property
    def written_altitude(self) -> float | None:
        """The altitude for files and vehicles; raises `InvalidArgument` for a flight level."""
        return written_altitude(self.altitude)

    @property
    def names_given(self) -> list[str]:
        """The options given, as they are written on the command line."""
        return [f"--{field.name.replace('_', '-')}" for field in fields(self) if getattr(self, field.name) is not None]

    @cached_property
    def preset(self) -> "Preset | None":
        """The values of the parameter file; None without one."""
        if self.params is None:
            return None
        from loiter.files.missions.parameters import read_parameters

        return read_parameters(self.params)

    def above_sea(self, datum: AltitudeDatum) -> "AircraftOptions":
        """The same options with the altitude above mean sea level, if an indicated airspeed needs it.

        Raises `InvalidArgument` where that altitude is unknown.
        """
        if self.altitude is None:
            if datum != MEAN_SEA_LEVEL:
                raise InvalidArgument("altitude_m", "is needed: --altitude-reference and --home-altitude go with it")
            return self
        if datum.reference != AltitudeReference.MSL:
            written_altitude(self.altitude)
        if self.indicated_m_s is None:
            return self
        return replace(self, altitude=datum.above_sea_m(self.altitude))

    @property
    def aircraft(self) -> Aircraft:
        """The aircraft; options take precedence over the parameter file."""
        limits = {
            "max_bank_deg": self._bank_deg,
            "min_turn_radius_m": self.turn_radius,
            "max_turn_rate_deg_s": self.turn_rate,
        }
        return Aircraft(self._true_airspeed_m_s, **limits)

    @property
    def _bank_deg(self) -> float | None:
        """The bank limit: that of the parameter file where no option limits the turn."""
        is_limited = any(value is not None for value in (self.bank, self.turn_radius, self.turn_rate))
        return self.bank if self.preset is None or is_limited else self.preset.max_bank_deg

    @property
    def indicated_m_s(self) -> float | None:
        """The indicated airspeed, metres per second; None where the true airspeed is given."""
        if self.airspeed is not None:
            if self.indicated_airspeed is not None:
                raise InvalidArgument("airspeed_m_s", "and --indicated-airspeed are given: one is enough")
            if self.temperature is not None:
                raise InvalidArgument("temperature_c", "goes with an indicated airspeed: --airspeed is the true one")
            return None
        if self.indicated_airspeed is None and self.preset is not None:
            return self.preset.indicated_airspeed_m_s
        return self.indicated_airspeed

    @property
    def remark(self) -> str:
        """A line with the true airspeed where the indicated one was given, and with the bank limit of a file."""
        indicated, bank, sentences = self.indicated_m_s, self._bank_deg, []
        if indicated is not None:
            density_altitude = density_altitude_m(self._altitude_m, self.temperature)
            sentences.append(
                f"True airspeed {self._true_airspeed_m_s:.4g} m/s: {indicated:.4g} indicated, "
                f"density altitude {density_altitude:.0f} m."
            )
        if bank is not None and bank != self.bank and self.params is not None:
            sentences.append(f"Bank limit {bank:g} deg, from {self.params.name}.")
        return " ".join(sentences)

    @property
    def _true_airspeed_m_s(self) -> float:
        if self.indicated_m_s is not None:
            return true_airspeed(self.indicated_m_s, self._altitude_m, self.temperature)
        if self.airspeed is None:
            raise InvalidArgument("airspeed_m_s", "is needed, or --indicated-airspeed, or --params with an airspeed")
        return self.airspeed

    @property
    def _altitude_m(self) -> float:
        return 0.0 if self.altitude is None else self.altitude


@Parameter(name="*", group=aircraft)
@dataclass(frozen=True)
class PlannedAircraftOptions(AircraftOptions):
    """The aircraft; its altitude is written to files, and may be measured from --altitude-reference."""

    altitude: Altitude = None
    """Altitude above mean sea level, or above --altitude-reference; metres, or with a unit: 3000ft. It is written to missions and maps, and converts an indicated airspeed to true airspeed, which is higher in thin air; for that alone it may be a flight level: FL100."""


Declination = Annotated[
    float | None,
    Parameter(
        converter=one(declination),
        metavar="DEGREES",
        help="Magnetic declination (variation), positive to the east: 3.5, 3.5E or 2W. It converts the directions that end in M, 87M, to true ones.",
    ),
]


def moving_air(wind: tuple[float, float] | None, declination_deg: float | None) -> Wind | None:
    """The wind of an option with speed and direction; None if it is absent."""
    if wind is None:
        return None
    speed_m_s, from_deg = wind
    return Wind(speed_m_s, true_direction("wind from_deg", from_deg, declination_deg))


@Parameter(name="*", group=air)
@dataclass(frozen=True)
class WindOptions:
    """The wind, and the declination of magnetic directions."""

    wind: WindChoice = None
    """Wind speed, metres per second, and the compass direction that the wind comes from; or as in weather reports, 250/15kn or 25015KT; with places in degrees, clockwise from true north at the circle."""
    declination: Declination = None

    @property
    def moving_air(self) -> Wind:
        """The wind; still air if the option is absent."""
        return moving_air(self.wind, self.declination) or CALM

    def true_heading(self, argument: str, heading_deg: float) -> float:
        """A heading of the start, degrees clockwise from true north; `argument` names it in errors."""
        return true_direction(argument, heading_deg, self.declination)

    def check_declination(self, start: "StartOptions | None" = None) -> None:
        """Raise `InvalidArgument` for a declination that has no effect on the wind and on the start."""
        poses = [] if start is None else [start.pose, start.pose_lla]
        check_declination(self.declination, *(values[-1] for values in (self.wind, *poses) if values))


Fit = Annotated[
    bool,
    Parameter(
        group=air,
        help="Where the aircraft cannot hold the circle, take the least radius that it can hold, and say so.",
    ),
]


@Parameter(name="*", group=missions)
@dataclass(frozen=True)
class MissionOptions:
    """How a mission leads onto the circle, how closely a file follows the track, and what altitudes refer to."""

    path: bool = False
    """Write waypoints all along the path. Autopilots cut its turns and join later; they fly best without --path, with at most one waypoint."""
    spacing: Metres = None
    """Largest distance between points of the track; limited by --chord-error alone if absent. For a mission it implies --path."""
    chord_error: Metres = None
    """Largest distance by which straight lines between points of the track may cut a turn; 1 if absent."""
    altitude_reference: Literal["msl", "home", "ground"] = "msl"
    """Reference of --altitude: mean sea level, the home position, or the ground below (only in missions of ArduPilot, and in .kml)."""
    home_altitude: Metres = None
    """Altitude of the home position above mean sea level; needed for altitudes above home or ground, unless --orbit-from has a home."""

    def datum(self, site: "Site | None" = None) -> AltitudeDatum:
        """The reference of --altitude; the altitude of home may come from an existing mission."""
        home_m = self.home_altitude
        if home_m is None and site is not None and self.altitude_reference != "msl":
            home_m = site.home_altitude_m
        return AltitudeDatum(AltitudeReference(self.altitude_reference), home_m)

    @property
    def along_path(self) -> bool:
        """Whether a mission has waypoints all along the path; a chord error without them is an `InvalidArgument`."""
        positive("chord_error_m", self.chord_error_m, "metres")
        if self.chord_error is not None and not self.path and self.spacing is None:
            raise InvalidArgument("chord_error_m", "goes with --path: without it a mission has no turns to cut")
        return self.path or self.spacing is not None

    @property
    def chord_error_m(self) -> float:
        """The largest chord error, metres."""
        return CHORD_ERROR_M if self.chord_error is None else self.chord_error


@Parameter(name="*", group=output)
@dataclass(frozen=True)
class PictureOptions:
    """The pictures of a command."""

    plot: Files = ()
    """Draw a picture to a file: .png, .svg or .pdf; may be repeated."""

    def check(self) -> None:
        """Raise `InvalidArgument` for a format that is not known."""
        with argument_names(path="plot"):
            for path in self.plot:
                files.check_format(path)


def _with_radius(argument: str, numbers: Sequence[float], radius_m: float | None) -> tuple[float, float, float]:
    """The two coordinates of the centre and the radius; `radius_m`, if any, is that of the parameter file."""
    match [*numbers]:
        case [first, second, radius]:
            return first, second, radius
        case [first, second] if radius_m is not None:
            return first, second, radius_m
    raise InvalidArgument(
        argument,
        f"needs 3 numbers, centre and radius, or 2 and --params with a radius: {values_given(len(numbers))}",
    )
