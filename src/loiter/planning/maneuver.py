"""Maneuvers: the answers of `plan`."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from importlib import import_module
from typing import Any

from loiter.errors import InvalidArgument, MissingPackage, instance, positive
from loiter.planning.drawing import drawn_html, drawn_svg
from loiter.planning.flight import over_ground, samples, setpoints
from loiter.planning.hold import Hold
from loiter.planning.model import CALM, Aircraft, Orbit, Pose, Samples, Segment, Setpoints, Turn, Wind

# More samples than this would not fit in the memory of a small machine: 8 arrays of 8 bytes each, 640 MB.
MAX_SAMPLES = 10_000_000


@dataclass(frozen=True)
class Maneuver:
    """A path onto the circle, flown with at most three controls.

    Every pose is a position over the ground with a heading, not a ground track; in wind the arcs and straight lines of
    `segments` are those through the air. `orbit` is the circle at the start, `orbit_at_join` the same circle at the
    time of joining. `turn` is the direction in which the circle is held, never "either"; `orbit.turn` is the direction
    of the problem. A start that is already on the circle has no segments and the word "". `miss_m` is the distance
    between the end of the path, flown exactly, and the tangent point: only rounding, or what `plan` was
    asked to allow.
    """

    start: Pose
    orbit: Orbit
    aircraft: Aircraft
    turn: Turn
    segments: tuple[Segment, ...]
    miss_m: float
    wind: Wind = CALM

    @property
    def word(self) -> str:
        """The letters of the segments in flying order, in Dubins' notation: "RSL"."""
        return "".join(segment.letter for segment in self.segments)

    @property
    def duration_s(self) -> float:
        """Time to join the circle, seconds."""
        return sum(segment.duration_s for segment in self.segments)

    @property
    def length_m(self) -> float:
        """Length of the path through the air, metres."""
        return sum(segment.length_m for segment in self.segments)

    @property
    def join(self) -> Pose:
        """Pose at which the circle is joined: position over the ground and heading."""
        return self.segments[-1].end if self.segments else self.start

    @property
    def orbit_at_join(self) -> Orbit:
        """The circle at the time of joining; `orbit` itself where that does not move."""
        return self.orbit.after(self.duration_s)

    @property
    def hold(self) -> Hold:
        """Bank, heading and ground speed needed to hold the circle afterwards, as functions of azimuth."""
        return Hold(self.orbit, self.aircraft, self.wind, self.turn)

    def over_ground(self, pose: Pose) -> tuple[float, float]:
        """Ground track (compass degrees) and ground speed (metres per second) at a pose of this maneuver."""
        instance("pose", pose, Pose)
        return over_ground(pose.heading_deg, self.aircraft, self.wind)

    def sample(self, step_s: float) -> Samples:
        """The ground track: position, heading, track, ground speed and curvatures every `step_s` seconds from 0.

        The last sample is the point of joining. In wind an arc through the air is a trochoid over the ground. At a
        switching instant the curvatures are those of the piece that begins. Headings are in [0, 360).
        Raises `InvalidArgument` for a step that is not positive, or so small that the samples would exceed the memory.
        """
        step_s = positive("step_s", step_s, "seconds")
        if self.duration_s / step_s > MAX_SAMPLES:
            raise InvalidArgument("step_s", f"is {step_s}: it would take more than {MAX_SAMPLES} samples")
        return samples(self.start, self.segments, self.aircraft, self.wind, step_s)

    def setpoints(self, step_s: float) -> Setpoints:
        """The path over the ground for path-following guidance, at the times of `sample`.

        Position, unit tangent, curvature and speed are what PX4's offboard mode and ArduPilot's pull request 26328
        take (docs/mavlink.md). At a switch the curvature is that of the piece that begins, at the join that of the
        piece that ends. Raises `InvalidArgument` like `sample`.
        """
        return setpoints(self.sample(step_s))

    def to_dict(self) -> dict[str, object]:
        """The maneuver as plain values for JSON: the members of `loiter plan --json`, in metres, seconds, degrees."""
        return maneuver_values(self)

    def to_dataframe(self, step_s: float = 0.1) -> Any:
        """The samples of `sample` every `step_s` seconds as a pandas data frame, a column for each field of `Samples`.

        Raises `InvalidArgument` like `sample`, and `MissingPackage` without pandas.
        """
        samples = self.sample(step_s)
        try:
            pandas: Any = import_module("pandas")
        except ImportError as error:
            raise MissingPackage("a data frame needs pandas: pip install pandas brings it") from error
        return pandas.DataFrame(samples._asdict())

    def __str__(self) -> str:
        """One line: the word, the direction, the time to join and the distance."""
        if not self.segments:
            return f"On the circle already, {self.turn.described}: nothing to fly."
        decimals = decimals_of(self.orbit)
        windy = self.wind.speed_m_s > 0.0 or self.orbit.moves
        return (
            f"{self.word}, {self.turn.described}: joins in {self.duration_s:.{decimals}f} s "
            f"after {self.length_m:.{decimals}f} m{' through the air' if windy else ''}"
        )

    def _repr_svg_(self) -> str:
        """A drawing, for notebooks."""
        return drawn_svg(self)

    def _repr_html_(self) -> str:
        """A drawing with a caption, for notebooks."""
        return drawn_html(self)


def decimals_of(orbit: Orbit) -> int:
    """Decimals of times and lengths in text: more for small circles."""
    return 1 if orbit.radius_m >= 10.0 else 3


PoseValues = Callable[[Pose], dict[str, float]]


def pose_values(pose: Pose) -> dict[str, float]:
    """A pose as plain values, in metres and degrees."""
    return {"east_m": pose.east_m, "north_m": pose.north_m, "heading_deg": pose.heading_deg}


def maneuver_values(maneuver: Maneuver, pose: PoseValues = pose_values) -> dict[str, object]:
    """A maneuver as plain values for JSON; `pose` converts its poses."""
    return {
        "duration_s": maneuver.duration_s,
        "length_m": maneuver.length_m,
        "word": maneuver.word,
        "turn": maneuver.turn.value,
        "join": pose(maneuver.join),
        "wind": {"speed_m_s": maneuver.wind.speed_m_s, "from_deg": maneuver.wind.from_deg},
        "join_over_ground": _join_over_ground(maneuver),
        "hold": {
            "least_bank_deg": maneuver.hold.least_bank_deg,
            "largest_bank_deg": maneuver.hold.largest_bank_deg,
            "largest_bank_azimuth_deg": maneuver.hold.largest_bank_azimuth_deg,
        },
        "miss_m": maneuver.miss_m,
        "segments": [_segment(segment, pose) for segment in maneuver.segments],
        "aircraft": {
            "airspeed_m_s": maneuver.aircraft.airspeed_m_s,
            "turn_radius_m": maneuver.aircraft.turn_radius_m,
        },
    }


# `dataclasses.asdict` copies every value, which would take longer than the plan.
def _segment(segment: Segment, pose: PoseValues) -> dict[str, object]:
    return {
        "letter": segment.letter,
        "start_s": segment.start_s,
        "duration_s": segment.duration_s,
        "length_m": segment.length_m,
        "curvature_per_m": segment.curvature_per_m,
        "start": pose(segment.start),
        "end": pose(segment.end),
    }


def _join_over_ground(maneuver: Maneuver) -> dict[str, float]:
    """Track and ground speed where the circle is joined, and the position of its centre then."""
    track_deg, speed = maneuver.over_ground(maneuver.join)
    centre = maneuver.orbit_at_join
    return {
        "track_deg": track_deg,
        "ground_speed_m_s": speed,
        "centre_east_m": centre.east_m,
        "centre_north_m": centre.north_m,
    }
