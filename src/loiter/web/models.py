"""Requests and answers of the service, in SI units and compass degrees; `docs/service.md` describes them.

The library checks the ranges of numbers and writes the error messages; the schema states the same ranges. Fields of
answers have the names of `loiter plan --json`.
"""

from __future__ import annotations

from typing import Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Field, Strict, field_validator
from pydantic.json_schema import SkipJsonSchema

from loiter.geo import LocalFrame
from loiter.io.document import PlacedProblem
from loiter.io.missions.items import AutopilotName
from loiter.planning import model
from loiter.planning.model import TurnName
from loiter.planning.problem import Problem

# A JSON number; strings, true and false are refused.
Number = Annotated[float, Strict()]
Positive = Annotated[Number, Field(json_schema_extra={"exclusiveMinimum": 0.0})]
NotNegative = Annotated[Number, Field(json_schema_extra={"minimum": 0.0})]
Latitude = Annotated[Number, Field(json_schema_extra={"minimum": -90.0, "maximum": 90.0})]
Longitude = Annotated[Number, Field(json_schema_extra={"minimum": -360.0, "maximum": 360.0})]


# A finer polyline would have no effect: autopilots fly to within metres.
MIN_CHORD_ERROR_M = 0.01


class Request(BaseModel):
    """A part of a request; unknown fields are refused."""

    model_config = ConfigDict(extra="forbid")


class PoseIn(Request):
    """Position and heading of the aircraft."""

    east_m: Number = Field(description="Metres east of the origin.")
    north_m: Number = Field(description="Metres north of the origin.")
    heading_deg: Number = Field(description="Degrees clockwise from north; any finite number.")


class OrbitIn(Request):
    """The circle at the start."""

    east_m: Number = Field(description="Centre: metres east of the origin.")
    north_m: Number = Field(description="Centre: metres north of the origin.")
    radius_m: Positive = Field(description="Radius, metres.")
    turn: TurnName = Field("either", description="Direction of flight around the circle, seen from above.")
    velocity_east_m_s: Number = Field(0.0, description="Velocity of the centre over the ground, metres per second.")
    velocity_north_m_s: Number = Field(0.0, description="Velocity of the centre over the ground, metres per second.")


def _require_one_limit(schema: dict[str, Any]) -> None:
    """Add to the schema that exactly one of the turn limits is given, and is not null."""
    null = {"type": "null"}
    schema["oneOf"] = [
        {"required": [name], "properties": {n: null if n != name else {"type": "number"} for n in model.TURN_LIMITS}}
        for name in model.TURN_LIMITS
    ]


class AircraftIn(Request):
    """The aircraft: its true airspeed and exactly one turn limit."""

    model_config = ConfigDict(json_schema_extra=_require_one_limit)

    airspeed_m_s: Positive = Field(description="True airspeed, metres per second.")
    max_bank_deg: (
        Annotated[Number, Field(json_schema_extra={"exclusiveMinimum": 0.0, "exclusiveMaximum": 90.0})] | None
    ) = Field(None, description="Largest bank, degrees.")
    min_turn_radius_m: Positive | None = Field(None, description="Smallest turn radius, metres.")
    max_turn_rate_deg_s: Positive | None = Field(None, description="Largest turn rate, degrees per second.")


class WindIn(Request):
    """A steady, horizontal wind."""

    speed_m_s: NotNegative = Field(description="Wind speed, metres per second.")
    from_deg: Number = Field(description="The compass direction that the wind comes from: 270 blows towards the east.")


class OriginIn(Request):
    """The position of the local (0, 0) on Earth, WGS84 degrees."""

    latitude_deg: Latitude
    longitude_deg: Longitude


EXAMPLE: dict[str, Any] = {
    "pose": {"east_m": -400.0, "north_m": 120.0, "heading_deg": 90.0},
    "orbit": {"east_m": 0.0, "north_m": 0.0, "radius_m": 80.0, "turn": "either"},
    "aircraft": {"airspeed_m_s": 18.0, "max_bank_deg": 35.0},
}
IN_WIND = EXAMPLE | {
    "orbit": {"east_m": 0.0, "north_m": 0.0, "radius_m": 120.0},
    "wind": {"speed_m_s": 8.0, "from_deg": 250.0},
    "origin": {"latitude_deg": 47.11, "longitude_deg": 8.23},
}


class Scene(Request):
    """The problem to solve."""

    model_config = ConfigDict(json_schema_extra={"examples": [EXAMPLE, IN_WIND]})

    pose: PoseIn
    orbit: OrbitIn
    aircraft: AircraftIn
    wind: WindIn | None = Field(None, description="Still air if absent.")
    tolerance_m: NotNegative = Field(
        0.0, description="A start up to this many metres beyond the last arc counts as on it."
    )
    origin: OriginIn | None = Field(
        None, description="If given, the answer also has positions in degrees and headings from true north."
    )

    def placed(self) -> PlacedProblem:
        """The problem and its frame as values of the library; raises their `loiter.errors.InvalidArgument`."""
        orbit = self.orbit.model_dump() | {"turn": model.Turn(self.orbit.turn)}
        problem = Problem(
            model.Pose(**self.pose.model_dump()),
            model.Orbit(**orbit),
            model.Aircraft(**self.aircraft.model_dump()),
            model.CALM if self.wind is None else model.Wind(**self.wind.model_dump()),
            self.tolerance_m,
        )
        return PlacedProblem(problem, None if self.origin is None else LocalFrame(**self.origin.model_dump()))


class ExportOptions(Scene):
    """The problem to solve, and how to write its solution to a file; numbers as for `loiter plan --save`."""

    altitude_m: Number | None = Field(None, description="Altitude above altitude_reference, metres; missions need it.")
    altitude_reference: Literal["msl", "home", "ground"] = Field(
        "msl",
        description="The reference of altitude_m: mean sea level, home, or the ground (ArduPilot and KML only).",
    )
    home_altitude_m: Number | None = Field(
        None, description="Altitude of home above mean sea level, metres; missions above home or ground need it."
    )
    spacing_m: Positive | None = Field(None, description="Largest distance between points of the track, metres.")
    chord_error_m: Annotated[Number, Field(json_schema_extra={"minimum": MIN_CHORD_ERROR_M})] = Field(
        1.0, description="Largest distance between the track and the straight lines through its points, metres."
    )
    autopilot: AutopilotName = Field(
        "ardupilot", description="The autopilot that a mission is for; PX4 takes .plan files only."
    )

    @field_validator("chord_error_m")
    @classmethod
    def _check_chord_error(cls, chord_error_m: float) -> float:
        """Refuse chord errors so small that files would be too large."""
        if not chord_error_m >= MIN_CHORD_ERROR_M:
            raise ValueError(f"it is {chord_error_m:g} and must be at least {MIN_CHORD_ERROR_M:g}")
        return chord_error_m


class Answer(BaseModel):
    """A part of an answer; its numbers are finite."""

    model_config = ConfigDict(allow_inf_nan=False)


def _drop_default(schema: dict[str, Any]) -> None:
    """Remove the default from the schema: the field is absent from an answer, never null."""
    del schema["default"]


class Pose(Answer):
    """A position over the ground and a heading; also in degrees where the request has an origin."""

    east_m: float
    north_m: float
    heading_deg: float
    latitude_deg: float | SkipJsonSchema[None] = Field(
        None, description="WGS84 degrees; only with an origin.", json_schema_extra=_drop_default
    )
    longitude_deg: float | SkipJsonSchema[None] = Field(
        None, description="WGS84 degrees; only with an origin.", json_schema_extra=_drop_default
    )
    true_heading_deg: float | SkipJsonSchema[None] = Field(
        None, description="Degrees clockwise from true north; only with an origin.", json_schema_extra=_drop_default
    )


class Wind(Answer):
    """The wind of the request."""

    speed_m_s: float
    from_deg: float


class JoinOverGround(Answer):
    """Track and ground speed of the aircraft, and the position of the centre, when it joins the circle."""

    track_deg: float
    ground_speed_m_s: float
    centre_east_m: float
    centre_north_m: float


class Hold(Answer):
    """Least and largest bank on the circle, and the azimuth of the largest, seen from the centre."""

    least_bank_deg: float
    largest_bank_deg: float
    largest_bank_azimuth_deg: float


class Segment(Answer):
    """One segment: "L" and "R" turn, "S" flies straight; length and curvature (left positive) relative to the air."""

    letter: Literal["L", "S", "R"]
    start_s: float
    duration_s: float
    length_m: float
    curvature_per_m: float
    start: Pose
    end: Pose


class FlownBy(Answer):
    """The aircraft: its true airspeed and its minimum turn radius."""

    airspeed_m_s: float
    turn_radius_m: float


class Track(Answer):
    """A polyline: over the ground (metres, headings in degrees), and x, y in the reduced plane (turn radii).

    It has a vertex at each switch, and it stays within 0.002 turn radii of the track.
    """

    time_s: list[float]
    east_m: list[float]
    north_m: list[float]
    heading_deg: list[float]
    x: list[float]
    y: list[float]


class Maneuver(Answer):
    """A maneuver onto the circle."""

    duration_s: float
    length_m: float
    word: str = Field(description='The letters of the segments in the order flown, "RSL"; empty on the circle.')
    turn: Literal["cw", "ccw"]
    join: Pose
    wind: Wind
    join_over_ground: JoinOverGround
    hold: Hold
    miss_m: float
    segments: list[Segment]
    aircraft: FlownBy
    track: Track


class LaterManeuver(Maneuver):
    """A maneuver compared with the first one."""

    later_s: float = Field(description="Seconds by which it joins later than the first.")


class ReducedState(Answer):
    """The start in the reduced plane of docs/theory.md, and the circle's radius: turn radii."""

    x: float
    y: float
    radius: float


class Plan(Maneuver):
    """The first optimal maneuver, and others."""

    alternatives: list[LaterManeuver]
    optimal: int = Field(
        description="The number of optimal maneuvers: this one, and the others, which come first in the alternatives."
    )
    other_turn_later_s: float | None = Field(
        description="Seconds by which the best maneuver in the other direction joins later; 0 where they tie."
    )
    instruction: str = Field(description="What the pilot should do now and next.")
    command: str = Field(description="The command line that gives this plan.")
    python: str = Field(description="Python code that gives this plan.")
    reduced: ReducedState


class Candidates(Answer):
    """Every extremal, fastest first."""

    candidates: list[LaterManeuver]


class Switch(Answer):
    """A switch of the control: the letters before and after it, the reduced state and psi at that instant."""

    time_s: float
    letters: str
    x: float
    y: float
    psi1: float
    psi2: float


class Residual(Answer):
    """One condition of the maximum principle and its residual; null where it could not be checked."""

    name: str
    equation: str
    value: float | None
    bound: float | None
    note: str
    verdict: Literal["holds", "FAILED", "skipped"]


class Candidate(Answer):
    """Another extremal, and the seconds by which it joins later."""

    word: str
    turn: Literal["cw", "ccw"]
    duration_s: float
    later_s: float


class Certificate(Answer):
    """The conditions of the maximum principle for a maneuver, checked.

    They are necessary. `proved_optimal` says that the maneuver is proved to be optimal, up to rounding: it is valid, in
    still air, without a tolerance; `basis` names the theorem, or says what is missing. For rounding the path ends
    within `delta_m` metres of the point of joining and takes at most `epsilon_s` seconds longer than the least time;
    both are null where no theorem covers the state, and `rounding` names the theorem, or says why not. `lambda` and
    `psi` are null where the aircraft is on the circle already.
    """

    valid: bool
    proved_optimal: bool
    basis: str
    delta_m: float | None
    epsilon_s: float | None
    rounding: str
    word: str
    turn: Literal["cw", "ccw"]
    duration_s: float
    lam: float | None = Field(alias="lambda")
    psi: tuple[float, float] | None
    choice: str
    switches: list[Switch]
    residuals: list[Residual]
    candidates: list[Candidate]
    runner_up: str | None
    margin_s: float | None


class Series(Answer):
    """Control, switching function and adjoint over time, for each segment in turn, including both of its ends."""

    time_s: list[float]
    u: list[int]
    phi: list[float]
    psi1: list[float]
    psi2: list[float]
    switches_s: list[float]


class Proof(Answer):
    """The certificate of the first optimal maneuver, and its curves over time."""

    certificate: Certificate
    series: Series


class Curve(Answer):
    """A curve between two regions: what changes across it, the two words, and its points."""

    kind: Literal["jump", "same", "straight", "switch", "tie"]
    words: tuple[str, str]
    x: list[float]
    y: list[float]


class Synthesis(Answer):
    """The optimal synthesis of the reduced plane on a grid, in turn radii."""

    radius: float
    turn: TurnName
    x: list[float]
    y: list[float]
    words: list[str]
    region: list[list[int]] = Field(
        description="For each y a row over x: the index, in words, of the fastest word; -1 where there is none."
    )
    curves: list[Curve]


class Health(Answer):
    """The service is running."""

    status: Literal["ok"]
    version: str
