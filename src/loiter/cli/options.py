"""What several commands ask for alike: where the aircraft is, the circle, the air, the aircraft."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal, NamedTuple

from cyclopts import Group, Parameter

from loiter.errors import InvalidArgument, positive
from loiter.geo import LocalFrame, density_altitude_m, true_airspeed
from loiter.geo.placed import PlacedProblem
from loiter.io.missions.altitudes import MEAN_SEA_LEVEL, AltitudeDatum, AltitudeReference
from loiter.planning.model import CALM, Aircraft, Orbit, Pose, Turn, TurnName, Wind
from loiter.planning.problem import Problem

if TYPE_CHECKING:
    from loiter.io.missions.parameters import Preset

scene = Group("Scene", sort_key=1)
aircraft = Group("Aircraft: the airspeed and exactly one limit on the turn", sort_key=2)
air = Group("Wind, and circles that move", sort_key=3)
output = Group("Output", sort_key=5)
missions = Group("Missions", sort_key=6)

# Where no chord error is given, metres: as the library has it.
CHORD_ERROR_M = 1.0


@Parameter(name="*")
@dataclass(frozen=True)
class StartOptions:
    """Where the aircraft is, in metres or in degrees."""

    pose: Annotated[
        tuple[float, float, float] | None,
        Parameter(group=scene, metavar="EAST NORTH HEADING", help="The aircraft: metres, and degrees from north."),
    ] = None
    pose_lla: Annotated[
        tuple[float, float, float] | None,
        Parameter(
            group=scene,
            metavar="LAT LON HEADING",
            help="The aircraft: WGS84 degrees, and degrees from true north.",
        ),
    ] = None


@Parameter(name="*")
@dataclass(frozen=True)
class PlacedStartOptions(StartOptions):
    """Where the aircraft is, in degrees; metres are understood, and refused where they mean nothing."""

    pose: Annotated[tuple[float, float, float] | None, Parameter(show=False)] = None


@Parameter(name="*")
@dataclass(frozen=True)
class OrbitOptions:
    """The circle, in metres or in degrees."""

    orbit: Annotated[
        tuple[float, ...],
        Parameter(
            group=scene,
            consume_multiple=True,
            show_default=False,
            metavar="EAST NORTH RADIUS",
            help="The circle: its centre and its radius, metres.",
        ),
    ] = ()
    orbit_lla: Annotated[
        tuple[float, ...],
        Parameter(
            group=scene,
            consume_multiple=True,
            show_default=False,
            metavar="LAT LON RADIUS",
            help="The circle: its centre in WGS84 degrees, its radius in metres, which --params may give.",
        ),
    ] = ()
    turn: Annotated[
        TurnName | None,
        Parameter(
            group=scene,
            help="Direction in which the circle is held, seen from above: that of --params if absent, without it either.",
        ),
    ] = None
    orbit_velocity: Annotated[
        tuple[float, float],
        Parameter(
            group=air,
            metavar="EAST NORTH",
            help="How the circle moves over the ground, metres per second; --orbit is where it is at the start.",
        ),
    ] = (0.0, 0.0)

    def circle(self, preset: Preset | None) -> tuple[Orbit, LocalFrame | None]:
        """The circle, and the plane of metres about its centre where that is in degrees."""
        radius = None if preset is None else preset.loiter_radius_m
        if bool(self.orbit) == bool(self.orbit_lla):
            raise InvalidArgument("orbit", "or --orbit-lla is needed, and not both")
        if self.orbit:
            east, north, radius = _with_radius("orbit", self.orbit, radius)
            return Orbit(east, north, radius, self._turn(preset), *self.orbit_velocity), None
        lat, lon, radius = _with_radius("orbit_lla", self.orbit_lla, radius)
        return Orbit(0.0, 0.0, radius, self._turn(preset), *self.orbit_velocity), LocalFrame(lat, lon)

    def _turn(self, preset: Preset | None) -> Turn:
        if self.turn is not None:
            return Turn(self.turn)
        return Turn.EITHER if preset is None or preset.turn is None else preset.turn


@Parameter(name="*")
@dataclass(frozen=True)
class PlacedOrbitOptions(OrbitOptions):
    """The circle, in degrees; as `PlacedStartOptions`."""

    orbit: Annotated[tuple[float, ...], Parameter(show=False, consume_multiple=True)] = ()


@Parameter(name="*")
@dataclass(frozen=True)
class AircraftOptions:
    """The aircraft: by options, or by its autopilot's parameters, and the air that it flies in."""

    airspeed: Annotated[
        float | None, Parameter(group=aircraft, metavar="M_PER_S", help="True airspeed, metres per second.")
    ] = None
    indicated_airspeed: Annotated[
        float | None,
        Parameter(
            group=aircraft,
            metavar="M_PER_S",
            help="Instead of --airspeed: as indicated, metres per second; true airspeed follows from --altitude.",
        ),
    ] = None
    bank: Annotated[float | None, Parameter(group=aircraft, metavar="DEGREES", help="Largest bank, degrees.")] = None
    turn_radius: Annotated[
        float | None, Parameter(group=aircraft, metavar="METRES", help="Smallest turn radius, metres.")
    ] = None
    turn_rate: Annotated[
        float | None, Parameter(group=aircraft, metavar="DEG_PER_S", help="Largest turn rate, degrees per second.")
    ] = None
    params: Annotated[
        Path | None,
        Parameter(
            group=aircraft,
            metavar="FILE",
            help="Parameters of ArduPlane (.param) or PX4 (.params): they give what no option does, the indicated airspeed, the bank limit, and the circle's radius and direction.",
        ),
    ] = None
    altitude: Annotated[
        float | None,
        Parameter(
            group=aircraft,
            metavar="METRES",
            help="Above mean sea level, or what --altitude-reference says: in thin air an indicated airspeed is a higher true one. Missions and maps hold it too.",
        ),
    ] = None
    temperature: Annotated[
        float | None,
        Parameter(group=aircraft, metavar="CELSIUS", help="Of the air outside; that of standard air if absent."),
    ] = None

    def preset(self) -> Preset | None:
        """What the parameter file says."""
        if self.params is None:
            return None
        from loiter.io.missions.parameters import read_parameters

        return read_parameters(self.params)

    def above_sea(self, preset: Preset | None, datum: AltitudeDatum) -> AircraftOptions:
        """The same with its altitude above mean sea level, where an airspeed is indicated in the air there.

        Raises `InvalidArgument` where that altitude is not known.
        """
        if self.altitude is None:
            if datum != MEAN_SEA_LEVEL:
                raise InvalidArgument("altitude_m", "is needed: --altitude-reference and --home-altitude go with it")
            return self
        if self.indicated(preset) is None:
            return self
        return replace(self, altitude=datum.above_sea_m(self.altitude))

    def aircraft(self, preset: Preset | None) -> Aircraft:
        """The aircraft; an option stands above the parameter file."""
        limits = {
            "max_bank_deg": self.bank,
            "min_turn_radius_m": self.turn_radius,
            "max_turn_rate_deg_s": self.turn_rate,
        }
        if preset is not None and not any(value is not None for value in limits.values()):
            limits["max_bank_deg"] = preset.max_bank_deg
        return Aircraft(self._true_airspeed(preset), **limits)

    def indicated(self, preset: Preset | None) -> float | None:
        """The indicated airspeed, where that is what is given."""
        if self.airspeed is not None:
            if self.indicated_airspeed is not None:
                raise InvalidArgument("airspeed_m_s", "and --indicated-airspeed are given: one is enough")
            if self.temperature is not None:
                raise InvalidArgument("temperature_c", "goes with an indicated airspeed: --airspeed is the true one")
            return None
        if self.indicated_airspeed is None and preset is not None:
            return preset.indicated_airspeed_m_s
        return self.indicated_airspeed

    def remark(self, preset: Preset | None) -> str:
        """A line for the user where the airspeed was not given as true airspeed; else empty."""
        indicated = self.indicated(preset)
        if indicated is None:
            return ""
        height = density_altitude_m(self._height, self.temperature)
        return f"True airspeed {self._true_airspeed(preset):.4g} m/s: {indicated:g} indicated, density altitude {height:.0f} m."

    def _true_airspeed(self, preset: Preset | None) -> float:
        indicated = self.indicated(preset)
        if indicated is not None:
            return true_airspeed(indicated, self._height, self.temperature)
        if self.airspeed is None:
            raise InvalidArgument("airspeed_m_s", "is needed, or --indicated-airspeed, or --params with an airspeed")
        return self.airspeed

    @property
    def _height(self) -> float:
        return 0.0 if self.altitude is None else self.altitude


@Parameter(name="*")
@dataclass(frozen=True)
class WindOptions:
    """The wind."""

    wind: Annotated[
        tuple[float, float] | None,
        Parameter(
            group=air,
            metavar="SPEED FROM",
            help="Metres per second, and the compass direction the wind comes from; from true north at the circle, where places are in degrees.",
        ),
    ] = None

    @property
    def moving_air(self) -> Wind:
        """The wind; none is still air."""
        return CALM if self.wind is None else Wind(*self.wind)


@Parameter(name="*")
@dataclass(frozen=True)
class MissionOptions:
    """How a mission leads onto the circle, and how finely a file follows the track."""

    path: Annotated[
        bool,
        Parameter(
            group=missions,
            help="Waypoints all along the path, in place of the one at most that autopilots fly best: they cut its turns and join later.",
        ),
    ] = False
    spacing: Annotated[
        float | None,
        Parameter(
            group=missions,
            metavar="METRES",
            help="Points of the track at most so far apart, as far as they may if absent; a mission then has --path.",
        ),
    ] = None
    chord_error: Annotated[
        float | None,
        Parameter(
            group=missions,
            metavar="METRES",
            help="By how much straight lines between points of the track may cut a turn; 1 if absent.",
        ),
    ] = None
    altitude_reference: Annotated[
        Literal["msl", "home", "ground"],
        Parameter(
            group=missions,
            help="What --altitude is measured from: mean sea level, the home position, or the ground below (ArduPilot only).",
        ),
    ] = "msl"
    home_altitude: Annotated[
        float | None,
        Parameter(
            group=missions,
            metavar="METRES",
            help="Of the home position, above mean sea level: needed for altitudes above home or ground.",
        ),
    ] = None

    @property
    def datum(self) -> AltitudeDatum:
        """What --altitude is measured from."""
        return AltitudeDatum(AltitudeReference(self.altitude_reference), self.home_altitude)

    @property
    def along_path(self) -> bool:
        """Whether a mission has waypoints all along the path; an error without them is an `InvalidArgument`."""
        positive("chord_error_m", self.chord_error_m, "metres")
        if self.chord_error is not None and not self.path and self.spacing is None:
            raise InvalidArgument("chord_error_m", "goes with --path: without it a mission has no turns to cut")
        return self.path or self.spacing is not None

    @property
    def chord_error_m(self) -> float:
        """The largest chord error, metres."""
        return CHORD_ERROR_M if self.chord_error is None else self.chord_error


class OptionsRead(NamedTuple):
    """The problem that the options of a command describe, and a remark that the user should read first, if any."""

    placed: PlacedProblem
    remark: str


def read_options(
    start: StartOptions,
    orbit: OrbitOptions,
    aircraft: AircraftOptions,
    wind: WindOptions,
    *,
    tolerance_m: float = 0.0,
    datum: AltitudeDatum = MEAN_SEA_LEVEL,
) -> OptionsRead:
    """The problem that the options describe; raises `InvalidArgument` where they contradict each other or fall short."""
    preset = aircraft.preset()
    aircraft = aircraft.above_sea(preset, datum)
    pose, circle, frame = placed(start, orbit, preset)
    problem = Problem(pose, circle, aircraft.aircraft(preset), wind.moving_air, tolerance_m)
    return OptionsRead(PlacedProblem(problem, frame), aircraft.remark(preset))


def placed(
    start: StartOptions, orbit: OrbitOptions, preset: Preset | None = None
) -> tuple[Pose, Orbit, LocalFrame | None]:
    """The start and the circle, and the plane of metres where they are in degrees."""
    if (start.pose is None) == (start.pose_lla is None):
        raise InvalidArgument("pose", "or --pose-lla is needed, and not both")
    circle, frame = orbit.circle(preset)
    if (start.pose_lla is None) != (frame is None):
        raise InvalidArgument("pose_lla", "and --orbit-lla go together: places in degrees, or both in metres")
    if frame is not None and start.pose_lla is not None:
        return frame.pose(*start.pose_lla), circle, frame
    assert start.pose is not None  # one of them is given
    return Pose(*start.pose), circle, None


def _with_radius(argument: str, numbers: Sequence[float], radius_m: float | None) -> tuple[float, float, float]:
    """Two numbers for the centre and the radius, which a parameter file may give."""
    if len(numbers) == 2 and radius_m is not None:
        return numbers[0], numbers[1], radius_m
    if len(numbers) != 3:
        raise InvalidArgument(
            argument, f"needs 3 numbers, centre and radius, or 2 and --params with a radius: {len(numbers)} were given"
        )
    return numbers[0], numbers[1], numbers[2]
