"""Requests and answers of the service, in SI and compass degrees, as `docs/service.md` and the OpenAPI tell them.

What a number may be the library checks, in its own sentences; the schema tells the same. Answers have the names of
`loiter plan --json`.
"""

from __future__ import annotations

from typing import Annotated, Any, Literal, NamedTuple

from pydantic import BaseModel, ConfigDict, Field, Strict, field_validator
from pydantic.json_schema import SkipJsonSchema

from loiter.geo import LocalFrame
from loiter.io.missions.items import AutopilotName
from loiter.planning import model
from loiter.planning.model import TurnName

# A JSON number, never a string or a truth value.
Number = Annotated[float, Strict()]
Positive = Annotated[Number, Field(json_schema_extra={"exclusiveMinimum": 0.0})]
NotNegative = Annotated[Number, Field(json_schema_extra={"minimum": 0.0})]
Latitude = Annotated[Number, Field(json_schema_extra={"minimum": -90.0, "maximum": 90.0})]
Longitude = Annotated[Number, Field(json_schema_extra={"minimum": -360.0, "maximum": 360.0})]


# Finer polylines would be no truer: autopilots fly to metres.
LEAST_CHORD_ERROR_M = 0.01


class Request(BaseModel):
    """A part of a request; a field that is not known is refused."""

    model_config = ConfigDict(extra="forbid")


class PoseIn(Request):
    """Where the aircraft is and where its nose points."""

    east_m: Number = Field(description="Metres east of the origin.")
    north_m: Number = Field(description="Metres north of the origin.")
    heading_deg: Number = Field(description="Degrees clockwise from north, of any size.")


class OrbitIn(Request):
    """The circle, where it is at the start."""

    east_m: Number = Field(description="Centre: metres east of the origin.")
    north_m: Number = Field(description="Centre: metres north of the origin.")
    radius_m: Positive = Field(description="Metres.")
    turn: TurnName = Field("either", description="Direction in which it is held, seen from above.")
    velocity_east_m_s: Number = Field(0.0, description="Over the ground, metres per second.")
    velocity_north_m_s: Number = Field(0.0, description="Over the ground, metres per second.")


def _one_limit(schema: dict[str, Any]) -> None:
    """Exactly one of the limits on the turn is there, and is no null."""
    null = {"type": "null"}
    schema["oneOf"] = [
        {"required": [name], "properties": {n: null if n != name else {"type": "number"} for n in model.TURN_LIMITS}}
        for name in model.TURN_LIMITS
    ]


class AircraftIn(Request):
    """The aircraft: its true airspeed and exactly one limit on how tightly it turns."""

    model_config = ConfigDict(json_schema_extra=_one_limit)

    airspeed_m_s: Positive = Field(description="True airspeed, metres per second.")
    max_bank_deg: (
        Annotated[Number, Field(json_schema_extra={"exclusiveMinimum": 0.0, "exclusiveMaximum": 90.0})] | None
    ) = Field(None, description="Largest bank, degrees.")
    min_turn_radius_m: Positive | None = Field(None, description="Smallest turn radius, metres.")
    max_turn_rate_deg_s: Positive | None = Field(None, description="Largest turn rate, degrees per second.")


class WindIn(Request):
    """A steady, level wind."""

    speed_m_s: NotNegative = Field(description="Metres per second.")
    from_deg: Number = Field(description="The compass direction that it comes from: 270 blows towards the east.")


class OriginIn(Request):
    """Where the local (0, 0) lies on Earth, WGS84."""

    latitude_deg: Latitude
    longitude_deg: Longitude


class Asked(NamedTuple):
    """A scene as the library takes it."""

    pose: model.Pose
    orbit: model.Orbit
    aircraft: model.Aircraft
    wind: model.Wind
    tolerance_m: float
    frame: LocalFrame | None


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
    """What is to be planned."""

    model_config = ConfigDict(json_schema_extra={"examples": [EXAMPLE, IN_WIND]})

    pose: PoseIn
    orbit: OrbitIn
    aircraft: AircraftIn
    wind: WindIn | None = Field(None, description="Still air if absent.")
    tolerance_m: NotNegative = Field(
        0.0, description="In still air: metres by which a start may lie beyond the last arc and still count as on it."
    )
    origin: OriginIn | None = Field(
        None, description="With it places of the answer are told in degrees too, headings from true north."
    )

    def asked(self) -> Asked:
        """The library's values; raises `loiter.errors.InvalidArgument` for what they refuse."""
        orbit = self.orbit.model_dump() | {"turn": model.Turn(self.orbit.turn)}
        return Asked(
            model.Pose(**self.pose.model_dump()),
            model.Orbit(**orbit),
            model.Aircraft(**self.aircraft.model_dump()),
            model.CALM if self.wind is None else model.Wind(**self.wind.model_dump()),
            self.tolerance_m,
            None if self.origin is None else LocalFrame(**self.origin.model_dump()),
        )


class ExportOptions(Scene):
    """What is to be planned, and how it is to be written; numbers as for `loiter plan --save`."""

    altitude_m: Number | None = Field(None, description="Above what altitude_reference says; missions need it.")
    altitude_reference: Literal["msl", "home", "ground"] = Field(
        "msl",
        description="What altitude_m is measured from: mean sea level, home, or the ground (ArduPilot's missions).",
    )
    home_altitude_m: Number | None = Field(
        None, description="Of home, above mean sea level; missions above home or ground need it."
    )
    spacing_m: Positive | None = Field(None, description="Points are at most so many metres apart.")
    chord_error_m: Annotated[Number, Field(json_schema_extra={"minimum": LEAST_CHORD_ERROR_M})] = Field(
        1.0, description="The track is nowhere further from the lines between points, metres."
    )
    autopilot: AutopilotName = Field("ardupilot", description="Whom a .plan is for.")

    @field_validator("chord_error_m")
    @classmethod
    def _coarse(cls, chord_error_m: float) -> float:
        """Refuse what would make files too large."""
        if not chord_error_m >= LEAST_CHORD_ERROR_M:
            raise ValueError(f"it is {chord_error_m:g} and must be at least {LEAST_CHORD_ERROR_M:g}")
        return chord_error_m


class Answer(BaseModel):
    """A part of an answer: finite numbers only."""

    model_config = ConfigDict(allow_inf_nan=False)


def _absent(schema: dict[str, Any]) -> None:
    """What is not told has no value, not even null."""
    del schema["default"]


class Pose(Answer):
    """A place over the ground and a heading; degrees where the request has an origin."""

    east_m: float
    north_m: float
    heading_deg: float
    latitude_deg: float | SkipJsonSchema[None] = Field(
        None, description="WGS84; with an origin only.", json_schema_extra=_absent
    )
    longitude_deg: float | SkipJsonSchema[None] = Field(
        None, description="WGS84; with an origin only.", json_schema_extra=_absent
    )
    true_heading_deg: float | SkipJsonSchema[None] = Field(
        None, description="From true north, as latitude_deg.", json_schema_extra=_absent
    )


class Wind(Answer):
    """The wind as asked for."""

    speed_m_s: float
    from_deg: float


class JoinOverGround(Answer):
    """Track and ground speed where the circle is joined, and where its centre is then."""

    track_deg: float
    ground_speed_m_s: float
    centre_east_m: float
    centre_north_m: float


class Hold(Answer):
    """The bank that the hold takes all the way round; the azimuth of the most, from the centre."""

    least_bank_deg: float
    largest_bank_deg: float
    largest_bank_azimuth_deg: float


class Segment(Answer):
    """One piece: "L" and "R" turn, "S" flies straight; length and curvature (left positive) through the air."""

    letter: Literal["L", "S", "R"]
    start_s: float
    duration_s: float
    length_m: float
    curvature_per_m: float
    start: Pose
    end: Pose


class FlownBy(Answer):
    """The aircraft: its true airspeed and the turn radius of its limit."""

    airspeed_m_s: float
    turn_radius_m: float


class Track(Answer):
    """A polyline: over the ground (metres, headings in degrees), and x, y in the reduced plane (turn radii).

    It has a point at each switch, and its chords are off by less than 0.002 turn radii.
    """

    time_s: list[float]
    east_m: list[float]
    north_m: list[float]
    heading_deg: list[float]
    x: list[float]
    y: list[float]


class Maneuver(Answer):
    """A way onto the circle."""

    duration_s: float
    length_m: float
    word: str = Field(description='The letters of the segments as flown, "RSL"; empty on the circle.')
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
    """A maneuver beside a faster one."""

    later_s: float = Field(description="How much later it joins than the first.")


class ReducedState(Answer):
    """The start in the reduced plane of docs/theory.md, and the circle's radius: turn radii."""

    x: float
    y: float
    radius: float


class Plan(Maneuver):
    """The first optimal maneuver, and others."""

    alternatives: list[LaterManeuver]
    optimal: int = Field(description="How many maneuvers are optimal: this and the first of the alternatives.")
    other_turn_later_s: float | None = Field(
        description="How much later the best maneuver the other way round joins; 0 where they tie."
    )
    instruction: str = Field(description="What to do now and next, for a person.")
    command: str = Field(description="The command line that gives this plan.")
    python: str = Field(description="Lines of Python that give this plan.")
    reduced: ReducedState


class Candidates(Answer):
    """Every extremal, fastest first."""

    candidates: list[LaterManeuver]


class Switch(Answer):
    """An instant of switching: from and to which letter, the reduced state there, and psi."""

    time_s: float
    letters: str
    x: float
    y: float
    psi1: float
    psi2: float


class Residual(Answer):
    """One condition of the maximum principle, and how far it is off; null where it could not be checked."""

    name: str
    equation: str
    value: float | None
    bound: float | None
    note: str
    verdict: Literal["holds", "FAILED", "skipped"]


class Candidate(Answer):
    """Another extremal, and how much later it joins."""

    word: str
    turn: Literal["cw", "ccw"]
    duration_s: float
    later_s: float


class Certificate(Answer):
    """The conditions of the maximum principle for a maneuver, checked.

    They are necessary. That they are also sufficient is proved for circles of the turn radius in still air alone (the
    paper). `lambda` and `psi` are null where nothing is to be flown.
    """

    valid: bool
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
    """Control, switching function and adjoint over time; pieces one after the other, both ends of each."""

    time_s: list[float]
    u: list[int]
    phi: list[float]
    psi1: list[float]
    psi2: list[float]
    switches_s: list[float]


class Proof(Answer):
    """The certificate of the first optimal maneuver, and what a picture of it shows."""

    certificate: Certificate
    series: Series


class Curve(Answer):
    """A line between two regions: what changes there, between which words, and its points."""

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
    region: list[list[int]] = Field(description="Rows of y: which of the words wins; -1 for none.")
    curves: list[Curve]


class Health(Answer):
    """The service is there."""

    status: Literal["ok"]
    version: str
