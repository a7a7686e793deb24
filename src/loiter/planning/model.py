"""Values in SI: aircraft, circle, wind, poses, segments and samples, and whether a circle can be held in wind."""

from __future__ import annotations

from dataclasses import dataclass, replace
from enum import StrEnum
from math import atan2, degrees, hypot, inf, radians, tan
from typing import TYPE_CHECKING, Any, Literal, NamedTuple, TypeVar

from loiter.errors import (
    InvalidArgument,
    RadiusTooSmall,
    WindTooStrong,
    as_float,
    instance,
    not_negative,
    number,
    positive,
)
from loiter.kernel.rounding import ROUNDING
from loiter.kernel.statuses import Status
from loiter.kernel.wind import wind_search
from loiter.kernel.wind.hold import tightest_radius
from loiter.kernel.wind.wind_search import WindProblem
from loiter.kernel.words import Side
from loiter.planning.compass import heading_of, heading_vector
from loiter.planning.units import KNOT

if TYPE_CHECKING:
    from numpy import float64
    from numpy.typing import NDArray

# A number of seconds, or an array of them.
AnyTime = TypeVar("AnyTime")

STANDARD_GRAVITY_M_S2 = 9.80665  # exact by definition (3rd CGPM, 1901)

# The control u of each letter, +1 turns left, and what the pilot does then, also in one word where space is short.
CONTROLS = {"L": 1, "S": 0, "R": -1}
ACTIONS = {"L": "turn left", "S": "fly straight", "R": "turn right"}
BRIEF_ACTIONS = {"L": "left", "S": "straight", "R": "right"}


def radius_at_bank(airspeed_m_s: float, bank_deg: float) -> float:
    """Radius of a coordinated turn, metres: V^2 / (g tan bank)."""
    return airspeed_m_s * airspeed_m_s / (STANDARD_GRAVITY_M_S2 * tan(radians(bank_deg)))


def radius_at_rate(airspeed_m_s: float, turn_rate_deg_s: float) -> float:
    """Radius of a turn, metres: V over the turn rate."""
    return airspeed_m_s / radians(turn_rate_deg_s)


def wind_velocity(speed_m_s: float, from_deg: float) -> tuple[float, float]:
    """Velocity of the air over the ground, metres per second towards the east and the north."""
    east, north = heading_vector(from_deg)
    # Subtracting from 0.0 avoids components of -0.0.
    return 0.0 - speed_m_s * east, 0.0 - speed_m_s * north


def position_after(place: Any, velocity: Any, time_s: Any) -> Any:
    """A coordinate `time_s` seconds later at a constant velocity; numbers or arrays."""
    return place + velocity * time_s


# The values of `Turn`, which users may write instead of its members.
TurnName = Literal["either", "cw", "ccw"]


class Turn(StrEnum):
    """Direction in which the circle is held, seen from above."""

    CW = "cw"
    CCW = "ccw"
    EITHER = "either"

    @property
    def other(self) -> Turn:
        """The opposite direction; that of `EITHER` is `EITHER`."""
        return {Turn.CW: Turn.CCW, Turn.CCW: Turn.CW}.get(self, self)

    @property
    def described(self) -> str:
        """The direction in words: "clockwise", "counter-clockwise" or "either way"."""
        return {Turn.CW: "clockwise", Turn.CCW: "counter-clockwise"}.get(self, "either way")


# The kernel's codes of directions, and back.
SIDES = {Turn.CW: Side.CW, Turn.CCW: Side.CCW, Turn.EITHER: Side.EITHER}
TURNS = {side: turn for turn, side in SIDES.items()}


def directions(turn: Turn) -> tuple[Turn, ...]:
    """The directions in which a circle may be held: one, or both for *either*."""
    return (Turn.CW, Turn.CCW) if turn is Turn.EITHER else (turn,)


def sign_of(turn: Turn) -> int:
    """The sign of a direction as a plain number, for formulas: +1 clockwise, -1 counter-clockwise, 0 for either."""
    return int(SIDES[turn])


def _keep(value: object, **fields: float | Turn) -> None:
    """Store checked fields of a frozen value as Python floats: a float32 would lower the precision of all results."""
    for name, field in fields.items():
        object.__setattr__(value, name, field)


@dataclass(frozen=True)
class Aircraft:
    """A fixed-wing aircraft in level flight: its airspeed and exactly one limit on how tightly it turns.

    `airspeed_m_s` is the true airspeed. The limit is `max_bank_deg` (between 0 and 90; the turn radius is that of a
    coordinated turn, V^2 / (g tan bank)), `min_turn_radius_m` or `max_turn_rate_deg_s`. The rates at which it climbs
    and descends, metres per second, are for legs with an altitude alone (`Leg`).
    Raises `InvalidArgument` for a value that is not a positive, finite number, and for no limit or several.

    >>> round(Aircraft(airspeed_m_s=18.0, max_bank_deg=35.0).turn_radius_m, 2)
    47.18
    """

    airspeed_m_s: float
    max_bank_deg: float | None = None
    min_turn_radius_m: float | None = None
    max_turn_rate_deg_s: float | None = None
    climb_rate_m_s: float | None = None
    descent_rate_m_s: float | None = None

    def __post_init__(self) -> None:
        _keep(self, airspeed_m_s=positive("airspeed_m_s", self.airspeed_m_s, "metres per second"))
        limits = {name: getattr(self, name) for name in TURN_LIMITS if getattr(self, name) is not None}
        if len(limits) != 1:
            given = f"{' and '.join(limits)} were given" if limits else "none was given"
            raise InvalidArgument("turn limit", f"is needed exactly once ({' or '.join(TURN_LIMITS)}): {given}")
        for name, value in limits.items():
            _keep(self, **{name: positive(name, value, TURN_LIMITS[name])})
        if self.max_bank_deg is not None and as_float(self.max_bank_deg) >= 90.0:
            raise InvalidArgument("max_bank_deg", f"is {self.max_bank_deg}: it must be between 0 and 90 degrees")
        positive("turn radius", self.turn_radius_m, "metres; airspeed and turn limit together give it")
        for name in ("climb_rate_m_s", "descent_rate_m_s"):
            if getattr(self, name) is not None:
                _keep(self, **{name: positive(name, getattr(self, name), "metres per second")})

    @property
    def turn_radius_m(self) -> float:
        """Minimum turn radius, metres: V^2 / (g tan bank), or V over the turn rate."""
        if self.min_turn_radius_m is not None:
            return self.min_turn_radius_m
        try:
            if self.max_turn_rate_deg_s is not None:
                return radius_at_rate(self.airspeed_m_s, self.max_turn_rate_deg_s)
            assert self.max_bank_deg is not None  # exactly one limit is given
            return radius_at_bank(self.airspeed_m_s, self.max_bank_deg)
        except ZeroDivisionError:
            # The smallest doubles are 0 after conversion to radians.
            return inf

    def bank_deg(self, radius_m: float) -> float:
        """Bank of a coordinated turn of the given radius at this airspeed, degrees: atan(V^2 / (g radius)).

        A radius of 0, which rounding may give, needs 90 degrees.
        """
        return degrees(atan2(self.airspeed_m_s * self.airspeed_m_s, STANDARD_GRAVITY_M_S2 * radius_m))


# The three possible limits and their units.
TURN_LIMITS = {"max_bank_deg": "degrees", "min_turn_radius_m": "metres", "max_turn_rate_deg_s": "degrees per second"}


def circle_radius_m(argument: str, radius_m: object) -> float:
    """The radius of a circle as a float, metres; raises `InvalidArgument` unless it is positive and finite."""
    # Autopilots mean counter-clockwise by a negative one.
    if -inf < as_float(radius_m) < 0.0:
        raise InvalidArgument(argument, f"is {radius_m}: it must be positive; the turn ccw holds counter-clockwise")
    return positive(argument, radius_m, "metres")


@dataclass(frozen=True)
class Orbit:
    """The holding circle: its centre (metres, local east and north), its radius and the requested direction.

    `turn` is a `Turn` or its value: "cw", "ccw" or "either" (whichever is sooner; the default). A moving circle (about
    a ship, a car or a thermal) has a constant velocity over the ground, metres per second; `east_m` and `north_m` are
    then the position of its centre at the start of the maneuver. Raises `InvalidArgument` for coordinates or velocities
    that are not finite, a radius that is not positive, and an unknown turn.
    """

    east_m: float
    north_m: float
    radius_m: float
    turn: Turn = Turn.EITHER
    velocity_east_m_s: float = 0.0
    velocity_north_m_s: float = 0.0

    if TYPE_CHECKING:
        # Type checkers read this signature: the argument may be a name, while the field is always a `Turn`.
        def __init__(
            self,
            east_m: float,
            north_m: float,
            radius_m: float,
            turn: Turn | TurnName = ...,
            velocity_east_m_s: float = ...,
            velocity_north_m_s: float = ...,
        ) -> None: ...

    def __post_init__(self) -> None:
        east_m, north_m = number("orbit east_m", self.east_m, "metres"), number("orbit north_m", self.north_m, "metres")
        _keep(self, east_m=east_m, north_m=north_m, radius_m=circle_radius_m("orbit radius_m", self.radius_m))
        if self.turn not in tuple(Turn):
            raise InvalidArgument("turn", f"is {self.turn!r}: it must be cw, ccw or either")
        _keep(self, turn=Turn(self.turn))
        for name in ("velocity_east_m_s", "velocity_north_m_s"):
            _keep(self, **{name: number(f"orbit {name}", getattr(self, name), "metres per second")})

    @property
    def moves(self) -> bool:
        """Whether the circle moves over the ground."""
        return self.velocity_east_m_s != 0.0 or self.velocity_north_m_s != 0.0

    def after(self, time_s: float) -> Orbit:
        """The circle `time_s` seconds later; the same object where it does not move."""
        if not self.moves:
            return self
        east_m, north_m = self.centre_after(number("time_s", time_s, "seconds"))
        return replace(self, east_m=east_m, north_m=north_m)

    def centre_after(self, time_s: AnyTime) -> tuple[AnyTime, AnyTime]:
        """East and north of the centre `time_s` seconds later, metres: numbers for a number, arrays for an array."""
        velocity_east, velocity_north = self.velocity_east_m_s, self.velocity_north_m_s
        return position_after(self.east_m, velocity_east, time_s), position_after(self.north_m, velocity_north, time_s)

    def fitted(self, aircraft: Aircraft, wind: Wind | None = None) -> Orbit:
        """The circle, or where the aircraft cannot hold it in the wind, the one with the least radius that it can hold.

        Centre, direction and velocity stay the same; a circle that can be held is returned as it is. At the least
        radius the turn is as tight as the aircraft can fly where it flies downwind. Raises `WindTooStrong` where the
        wind relative to the circle is as fast as the aircraft.

        >>> uav, wind = Aircraft(18.0, max_bank_deg=35.0), Wind(8.0, from_deg=250.0)
        >>> round(Orbit(0.0, 0.0, 60.0).fitted(uav, wind).radius_m, 1)
        98.4
        """
        wind = CALM if wind is None else wind
        air = relative_wind(self, aircraft, wind)
        if _status(self, aircraft, air) in (Status.NOT_HELD, Status.RADIUS_TOO_SMALL):
            return replace(self, radius_m=tightest_radius(*air) * aircraft.turn_radius_m)
        check_held(self, aircraft, air, wind)
        return self

    def distance_m(self, pose: Pose) -> float:
        """Distance of a pose from the centre, metres."""
        instance("pose", pose, Pose)
        return hypot(pose.east_m - self.east_m, pose.north_m - self.north_m)


@dataclass(frozen=True)
class Wind:
    """A constant, horizontal wind: its speed and the compass direction from which it blows (270: from the west).

    Raises `InvalidArgument` for a speed that is negative or not finite and for a direction that is not finite.

    >>> Wind(5.0, from_deg=270.0).velocity_m_s
    (5.0, 0.0)
    """

    speed_m_s: float
    from_deg: float

    def __post_init__(self) -> None:
        _keep(self, speed_m_s=not_negative("wind speed_m_s", self.speed_m_s, "metres per second"))
        _keep(self, from_deg=number("wind from_deg", self.from_deg, "degrees"))

    @property
    def velocity_m_s(self) -> tuple[float, float]:
        """Velocity of the air over the ground, metres per second towards the east and the north."""
        return wind_velocity(self.speed_m_s, self.from_deg)


CALM = Wind(0.0, 0.0)


def wind_from_velocity(east_m_s: float, north_m_s: float) -> Wind:
    """The wind whose air has a velocity over the ground, metres per second towards the east and the north."""
    return Wind(hypot(east_m_s, north_m_s), heading_of(-east_m_s, -north_m_s))


@dataclass(frozen=True)
class Pose:
    """Position (metres, local east and north) and compass heading (degrees clockwise from north) of the aircraft.

    A heading may be any finite number. `altitude_m` is for legs that end at an altitude alone (`Leg`), above the same
    level as that. Raises `InvalidArgument` for a value that is not finite.
    """

    east_m: float
    north_m: float
    heading_deg: float
    altitude_m: float | None = None

    def __post_init__(self) -> None:
        east_m, north_m = number("pose east_m", self.east_m, "metres"), number("pose north_m", self.north_m, "metres")
        _keep(self, east_m=east_m, north_m=north_m, heading_deg=number("pose heading_deg", self.heading_deg, "degrees"))
        if self.altitude_m is not None:
            _keep(self, altitude_m=number("pose altitude_m", self.altitude_m, "metres"))


@dataclass(frozen=True)
class Segment:
    """One piece of a maneuver with constant control: an arc or a straight line through the air.

    `letter` is "L" (left turn), "S" (straight) or "R" (right turn); `start_s` is the time from the start of the
    maneuver at which the piece begins; `curvature_per_m` is positive to the left and 0 on a straight piece. `length_m`
    and `curvature_per_m` are measured through the air; `start` and `end` are positions over the ground with headings
    (where the nose points), not ground tracks.
    """

    letter: str
    start_s: float
    duration_s: float
    length_m: float
    curvature_per_m: float
    start: Pose
    end: Pose


class Samples(NamedTuple):
    """A maneuver at given times: eight float64 arrays of one length.

    Positions are over the ground. `heading_deg` is where the nose points, `track_deg` the direction of motion over the
    ground; in still air they are equal. `curvature_per_m` is that of the path through the air, `ground_curvature_per_m`
    that of the ground track, both positive to the left; the latter is nan where the ground speed is zero.
    """

    time_s: NDArray[float64]
    east_m: NDArray[float64]
    north_m: NDArray[float64]
    heading_deg: NDArray[float64]
    curvature_per_m: NDArray[float64]
    track_deg: NDArray[float64]
    ground_speed_m_s: NDArray[float64]
    ground_curvature_per_m: NDArray[float64]


class Setpoints(NamedTuple):
    """A path over the ground as guidance follows it: seven float64 arrays of one length.

    The tangent is a unit vector along the motion over the ground. The curvature, positive to the left, and the speed
    are those over the ground too. Where the ground speed is zero the curvature is nan.
    """

    time_s: NDArray[float64]
    east_m: NDArray[float64]
    north_m: NDArray[float64]
    tangent_east: NDArray[float64]
    tangent_north: NDArray[float64]
    curvature_per_m: NDArray[float64]
    speed_m_s: NDArray[float64]


class RelativeWind(NamedTuple):
    """The velocity of the air relative to the circle, divided by the airspeed: east and north, numbers or arrays."""

    x: float
    y: float

    @property
    def still(self) -> bool:
        """Whether the circle meets still air."""
        return (self.x == 0.0) & (self.y == 0.0)


def relative_wind(orbit: Orbit, aircraft: Aircraft, wind: Wind) -> RelativeWind:
    """The velocity of the air relative to the circle, divided by the airspeed; zero where only rounding remains.

    Raises `InvalidArgument` for a value of another class: every function that takes these three begins here.
    """
    for name, value, kind in (("orbit", orbit, Orbit), ("aircraft", aircraft, Aircraft), ("wind", wind, Wind)):
        instance(name, value, kind)
    circle = orbit.velocity_east_m_s, orbit.velocity_north_m_s
    return RelativeWind(*relative_velocity(wind.velocity_m_s, circle, aircraft.airspeed_m_s))


def relative_velocity(air: tuple[float, float], circle: tuple[float, float], airspeed: float) -> tuple[float, float]:
    """The velocity of the air less that of the circle, divided by the airspeed. No branches: it accepts arrays."""
    wx, wy = air[0] - circle[0], air[1] - circle[1]
    passes = hypot(wx, wy) > ROUNDING * (hypot(*air) + hypot(*circle))
    # Adding 0.0 turns -0.0 into 0.0.
    return wx * passes / airspeed + 0.0, wy * passes / airspeed + 0.0


def radius_in_turns(orbit: Orbit, aircraft: Aircraft) -> float:
    """R, the radius of the circle in turn radii of the aircraft."""
    return orbit.radius_m / aircraft.turn_radius_m


def check_held(orbit: Orbit, aircraft: Aircraft, air: RelativeWind, wind: Wind | None = None) -> None:
    """Raise `WindTooStrong` or `RadiusTooSmall` if the aircraft cannot hold the circle at every azimuth.

    `air` is the wind relative to the circle, from `relative_wind`; `wind` is that wind as the user gave it, if it was
    given: the error says so where its speed and its direction seem to be swapped.
    """
    status = _status(orbit, aircraft, air)
    if status == Status.WIND_TOO_STRONG:
        V, speed = aircraft.airspeed_m_s, hypot(*air) * aircraft.airspeed_m_s
        raise WindTooStrong(
            f"in {_air(orbit, speed)} an aircraft of {V:.4g} m/s can hold no circle: "
            f"its airspeed must be above {speed:.4g} m/s{_swapped_hint(orbit, aircraft, wind)}"
        )
    if status in (Status.NOT_HELD, Status.RADIUS_TOO_SMALL):
        tightest = tightest_radius(*air)
        sentence = too_tight(orbit, aircraft) if air.still else _not_held(orbit, aircraft, air, tightest)
        raise RadiusTooSmall(sentence, tightest * aircraft.turn_radius_m)


def is_holdable(orbit: Orbit, aircraft: Aircraft, air: RelativeWind) -> bool:
    """Whether the aircraft can hold the circle at every azimuth; `air` is that of `check_held`."""
    return _status(orbit, aircraft, air) not in (Status.WIND_TOO_STRONG, Status.NOT_HELD, Status.RADIUS_TOO_SMALL)


def _status(orbit: Orbit, aircraft: Aircraft, air: RelativeWind) -> int:
    """Whether the circle can be held: the status of a start at its centre."""
    R = radius_in_turns(orbit, aircraft)
    return wind_search.status_of(WindProblem(0.0, 0.0, 1.0, 0.0, R, Side.EITHER, *air))


def too_tight(orbit: Orbit, aircraft: Aircraft) -> str:
    """The error message for a circle that is tighter than the turn radius."""
    r, V, needed = aircraft.turn_radius_m, aircraft.airspeed_m_s, aircraft.bank_deg(orbit.radius_m)
    if aircraft.max_bank_deg is not None:
        limit, need = f" and {aircraft.max_bank_deg:.4g} deg of bank", f"{needed:.4g} deg"
    elif aircraft.max_turn_rate_deg_s is not None:
        rate = aircraft.max_turn_rate_deg_s * r / orbit.radius_m
        limit, need = f" and {aircraft.max_turn_rate_deg_s:.4g} deg/s", f"{rate:.4g} deg/s ({needed:.4g} deg of bank)"
    else:
        limit, need = "", f"{needed:.4g} deg of bank"
    return (
        f"orbit radius {orbit.radius_m:g} m is tighter than the aircraft can turn: "
        f"{r:.4g} m at {V:.4g} m/s{limit}; it needs {need}"
    )


def _swapped_hint(orbit: Orbit, aircraft: Aircraft, wind: Wind | None) -> str:
    """The likely meaning of a wind whose direction comes first, as in weather reports; empty where it has none."""
    if wind is None or not 0.0 < wind.from_deg < wind.speed_m_s <= 360.0:
        return ""
    speed, from_deg = wind.from_deg, wind.speed_m_s
    for unit, size in {"m/s": 1.0, "knots": KNOT}.items():
        if hypot(*relative_wind(orbit, aircraft, Wind(speed * size, from_deg))) < 1.0:
            return (
                f"; for a wind of {speed:.4g} {unit} from {from_deg:g} degrees the speed comes first "
                "(weather reports have the direction first, and knots)"
            )
    return ""


def _air(orbit: Orbit, speed: float) -> str:
    return f"air that passes the circle at {speed:.4g} m/s" if orbit.moves else f"a wind of {speed:.4g} m/s"


def _not_held(orbit: Orbit, aircraft: Aircraft, air: RelativeWind, tightest: float) -> str:
    """The error message for a circle that is too tight to be held in the wind: below `tightest` turn radii."""
    r, V = aircraft.turn_radius_m, aircraft.airspeed_m_s
    bank = f"{aircraft.bank_deg(orbit.radius_m / tightest):.4g} deg"
    if aircraft.max_bank_deg is not None:
        limit, need = f"{aircraft.max_bank_deg:.4g} deg of bank", bank
    elif aircraft.max_turn_rate_deg_s is not None:
        rate = aircraft.max_turn_rate_deg_s * r * tightest / orbit.radius_m
        limit, need = f"{aircraft.max_turn_rate_deg_s:.4g} deg/s", f"{rate:.4g} deg/s ({bank} of bank)"
    else:
        limit, need = f"a turn radius of {r:.4g} m", f"a turn radius of {orbit.radius_m / tightest:.4g} m"
    return (
        f"orbit radius {orbit.radius_m:g} m cannot be held in {_air(orbit, hypot(*air) * V)} "
        f"at {V:.4g} m/s and {limit}: it needs {tightest * r:.4g} m, or {need}"
    )
