"""What comes back from a plan."""

from __future__ import annotations

from dataclasses import dataclass

from loiter.errors import InvalidArgument, positive
from loiter.planning.flight import over_ground, sampled
from loiter.planning.hold import Hold
from loiter.planning.model import CALM, Aircraft, Orbit, Pose, Samples, Segment, Turn, Wind

# More samples than this would not fit in the memory of a small machine: 8 arrays of 8 bytes each, 640 MB.
MAX_SAMPLES = 10_000_000


@dataclass(frozen=True, slots=True)
class Maneuver:
    """A way onto the circle, flown with at most three controls.

    Every pose is a place over the ground with a heading, not a track; in wind the arcs and lines of `segments` are
    those through the air. `orbit` is the circle at the start; one that moves is joined where it is then,
    `orbit_at_join`.
    `turn` is the direction in which it holds the circle, never "either"; `orbit.turn` is what was asked for. A start
    that is already on the circle has no segments and the word "". `miss_m` is the distance by which its end misses the
    tangent point when the durations are flown exactly: rounding, or what the tolerance of `plan` let pass.
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
        """The letters of the segments as flown, in Dubins' notation: "RSL"."""
        return "".join(segment.letter for segment in self.segments)

    @property
    def duration_s(self) -> float:
        """Time to join the circle, seconds."""
        return sum(segment.duration_s for segment in self.segments)

    @property
    def length_m(self) -> float:
        """Distance flown through the air to the point of joining, metres."""
        return sum(segment.length_m for segment in self.segments)

    @property
    def join(self) -> Pose:
        """Where the circle is joined over the ground, and the heading there."""
        return self.segments[-1].end if self.segments else self.start

    @property
    def orbit_at_join(self) -> Orbit:
        """The circle when it is joined; it is `orbit` unless that moves."""
        return self.orbit.after(self.duration_s)

    @property
    def hold(self) -> Hold:
        """What holding the circle takes from then on: bank, heading and ground speed against azimuth."""
        return Hold(self.orbit, self.aircraft, self.wind, self.turn)

    def over_ground(self, pose: Pose) -> tuple[float, float]:
        """Track (compass degrees) and ground speed (metres per second) at a pose of this maneuver, by its heading."""
        return over_ground(pose.heading_deg, self.aircraft, self.wind)

    def sample(self, step_s: float) -> Samples:
        """The ground track: position, heading, track, ground speed and curvatures every `step_s` seconds from 0.

        The last sample is the point of joining. In wind a turn, an arc through the air, is a trochoid over the ground.
        At an instant of switching the curvatures are those of the piece that begins. Headings are in [0, 360).
        Raises `InvalidArgument` for a step that is not positive or so small that memory would not hold the samples.
        """
        if self.duration_s / positive("step_s", step_s, "seconds") > MAX_SAMPLES:
            raise InvalidArgument("step_s", f"is {step_s}: it would take more than {MAX_SAMPLES} samples")
        return sampled(self.start, self.segments, self.aircraft, self.wind, step_s)
