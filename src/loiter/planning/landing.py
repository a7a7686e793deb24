"""Landings: onto a circle beside the final approach, down on it, and out on the glide slope (docs/legs.md)."""

from __future__ import annotations

from dataclasses import dataclass
from math import atan2, degrees, hypot, radians, sqrt, tan
from typing import TYPE_CHECKING

from loiter.errors import InvalidArgument, WindTooStrong, instance, not_negative, number, positive
from loiter.kernel.rounding import ROUNDING
from loiter.planning.compass import heading_vector
from loiter.planning.leg import SAME_TIME, Leg, LegPlan, plan_leg
from loiter.planning.maneuver import decimals_of
from loiter.planning.model import (
    CALM,
    Aircraft,
    Orbit,
    Pose,
    Turn,
    TurnName,
    Wind,
    circle_radius_m,
    directions,
    sign_of,
)

if TYPE_CHECKING:
    from numpy import float64
    from numpy.typing import NDArray


@dataclass(frozen=True)
class Runway:
    """The runway that is landed on: its threshold, its direction, and the glide slope down to it.

    `east_m` and `north_m` are the threshold, `altitude_m` its altitude, above the same level as that of the poses;
    `heading_deg` is the direction of landing, degrees clockwise from north. The glide slope of `glide_slope_deg`, over
    the ground, passes `threshold_height_m` above the threshold; by default 3 degrees and 15 m, those of an instrument
    approach (ICAO Annex 10, volume I). Raises `InvalidArgument` for numbers that are not finite, a glide slope that is
    not between 0 and 90 degrees, and a height below zero.

    >>> from loiter import Runway
    >>> runway = Runway(0.0, 0.0, heading_deg=90.0, altitude_m=500.0)
    >>> round(runway.glide_altitude_m(1000.0), 1)
    567.4
    """

    east_m: float
    north_m: float
    heading_deg: float
    altitude_m: float
    glide_slope_deg: float = 3.0
    threshold_height_m: float = 15.0

    def __post_init__(self) -> None:
        for name in ("east_m", "north_m", "altitude_m"):
            object.__setattr__(self, name, number(f"runway {name}", getattr(self, name), "metres"))
        object.__setattr__(self, "heading_deg", number("runway heading_deg", self.heading_deg, "degrees"))
        slope_deg = positive("glide_slope_deg", self.glide_slope_deg, "degrees")
        if slope_deg >= 90.0:
            raise InvalidArgument("glide_slope_deg", f"is {slope_deg:g}: it must be between 0 and 90 degrees")
        object.__setattr__(self, "glide_slope_deg", slope_deg)
        height_m = not_negative("threshold_height_m", self.threshold_height_m, "metres")
        object.__setattr__(self, "threshold_height_m", height_m)

    @property
    def descent(self) -> float:
        """The descent on the glide slope per distance over the ground."""
        return tan(radians(self.glide_slope_deg))

    def glide_altitude_m(self, distance_m: float) -> float:
        """The altitude of the glide slope at a distance before the threshold, metres."""
        return self.altitude_m + self.threshold_height_m + distance_m * self.descent

    def before(self, distance_m: float) -> tuple[float, float]:
        """East and north at a distance before the threshold on the line of the runway, metres."""
        east, north = heading_vector(self.heading_deg)
        return self.east_m - distance_m * east, self.north_m - distance_m * north

    @property
    def touchdown(self) -> tuple[float, float]:
        """East and north, metres, where the glide slope meets the runway: the aiming point beyond the threshold."""
        return self.before(-self.threshold_height_m / self.descent)


@dataclass(frozen=True)
class Landing:
    """A landing: from a pose with an altitude onto a circle beside the final approach, and down to the runway.

    The circle has the radius `radius_m` and is left onto the final approach, `final_m` metres before the threshold, at
    the altitude of the glide slope there. `turn` is its direction: held clockwise it lies to the right of
    the approach, counter-clockwise to the left. Raises `InvalidArgument` for numbers that are not positive and finite,
    and for a pose without an altitude.
    """

    pose: Pose
    runway: Runway
    radius_m: float
    final_m: float
    turn: Turn = Turn.EITHER

    if TYPE_CHECKING:
        # As for `Orbit`: the argument may be a name.
        def __init__(
            self, pose: Pose, runway: Runway, radius_m: float, final_m: float, turn: Turn | TurnName = ...
        ) -> None: ...

    def __post_init__(self) -> None:
        instance("pose", self.pose, Pose)
        instance("runway", self.runway, Runway)
        if self.pose.altitude_m is None:
            raise InvalidArgument("pose", "needs an altitude for a landing: Pose(..., altitude_m=...)")
        object.__setattr__(self, "radius_m", circle_radius_m("radius_m", self.radius_m))
        object.__setattr__(self, "final_m", positive("final_m", self.final_m, "metres"))
        object.__setattr__(self, "turn", self.circle(self.turn).turn)

    def circle(self, turn: Turn) -> Orbit:
        """The circle in one direction that touches the final approach `final_m` before the threshold."""
        (east, north), (x, y) = heading_vector(self.runway.heading_deg), self.runway.before(self.final_m)
        side = self.radius_m * sign_of(turn) if turn in tuple(Turn) else 0.0
        return Orbit(x + side * north, y - side * east, self.radius_m, turn)

    def leg(self, turn: Turn) -> Leg:
        """The leg by that circle to the threshold, which leaves the circle at the altitude of the glide slope."""
        threshold, altitude_m = self.runway.before(0.0), self.runway.glide_altitude_m(self.final_m)
        return Leg(self.pose, self.circle(turn), threshold, altitude_m=altitude_m)


@dataclass(frozen=True)
class LandingPlan(LegPlan):
    """A landing as planned: a leg whose way out is the final approach, and that ends over the threshold."""

    runway: Runway

    @property
    def final_m(self) -> float:
        """The length of the final approach, from the circle to the threshold, metres."""
        return hypot(self.end.east_m - self.exit.east_m, self.end.north_m - self.exit.north_m)

    @property
    def exit_altitude_m(self) -> float:
        """The altitude at the exit, on the glide slope, metres."""
        return self.runway.glide_altitude_m(self.final_m)

    @property
    def sink_rate_m_s(self) -> float:
        """The rate of descent on the glide slope, metres per second."""
        return self.final_m * self.runway.descent / self.straight_s

    def _altitudes(self, time_s: NDArray[float64]) -> NDArray[float64]:
        """The altitude at times: as that of a leg up to the exit, and then on the glide slope."""
        import numpy as np

        return super()._altitudes(time_s) - self.sink_rate_m_s * np.maximum(time_s - self.exit_s, 0.0)

    def to_dict(self) -> dict[str, object]:
        """The plan as plain values for JSON, in metres, seconds and degrees."""
        east_m, north_m = self.runway.touchdown
        return super().to_dict() | {
            "final_m": self.final_m,
            "exit_altitude_m": self.exit_altitude_m,
            "sink_rate_m_s": self.sink_rate_m_s,
            "touchdown": {"east_m": east_m, "north_m": north_m, "altitude_m": self.runway.altitude_m},
        }

    def __str__(self) -> str:
        """One line: entry, hold, exit and the end."""
        return (
            f"{self._entry_and_hold()}, is on final approach {self.final_m:.0f} m before the threshold and over it "
            f"after {self.duration_s:.{decimals_of(self.leg.orbit)}f} s"
        )


def plan_landing(landing: Landing, aircraft: Aircraft, wind: Wind | None = None) -> LandingPlan:
    """The plan of a landing with the least time over the threshold, among the sides of the circle.

    The climb or descent to the altitude of the exit begins at once; the circle is flown as long as that takes. It
    touches the final approach `final_m` before the threshold: docs/legs.md says why no place farther out is better.
    Where both sides take the same time, the circle lies where the entry turns onto it in its direction.
    Raises the errors of `plan_leg`, `WindTooStrong` for a wind in which the aircraft cannot fly along the approach, and
    `InvalidArgument` for a glide slope steeper than the aircraft's descent rate allows, and for a final approach
    shorter than its turn radius.

    >>> from loiter import Aircraft, Landing, Pose, Runway, plan_landing
    >>> uav = Aircraft(18.0, max_bank_deg=35.0, descent_rate_m_s=3.0)
    >>> high = Pose(-400.0, 900.0, 90.0, altitude_m=650.0)
    >>> p = plan_landing(Landing(high, Runway(0.0, 0.0, 90.0, altitude_m=500.0), radius_m=120.0, final_m=500.0), uav)
    >>> p.entry.word, p.turn.value, round(p.exit_s, 1), round(p.duration_s, 1)
    ('RSL', 'ccw', 54.3, 82.1)
    """
    instance("landing", landing, Landing)
    instance("aircraft", aircraft, Aircraft)
    air = CALM if wind is None else wind
    instance("wind", air, Wind)
    speed_m_s = approach_speed_m_s(landing.runway, aircraft, air)
    _check_approach(landing, aircraft, speed_m_s)
    plans = [plan_leg(landing.leg(turn), aircraft, air) for turn in directions(landing.turn)]
    least_s = min(plan.duration_s for plan in plans)
    best = min((plan for plan in plans if plan.duration_s <= least_s * (1.0 + SAME_TIME)), key=_awkwardness)
    return LandingPlan(**vars(best), runway=landing.runway)


def _awkwardness(plan: LegPlan) -> tuple[bool, float]:
    """Which of plans of one duration is chosen: one that turns onto the circle in its direction, and joins sooner."""
    return plan.entry.word[-1:] != ("R" if plan.turn is Turn.CW else "L"), plan.entry.duration_s


def approach_speed_m_s(runway: Runway, aircraft: Aircraft, wind: Wind) -> float:
    """The ground speed on the final approach, metres per second.

    Raises `WindTooStrong` where the aircraft cannot fly along it: the wind across, or against it, is its airspeed.
    """
    V, (east, north), (wx, wy) = aircraft.airspeed_m_s, heading_vector(runway.heading_deg), wind.velocity_m_s
    along, across = wx * east + wy * north, wx * north - wy * east
    if abs(across) >= V:
        raise WindTooStrong(
            f"the wind across the runway is {abs(across):.4g} m/s: an aircraft of {V:.4g} m/s cannot stay on the "
            "approach"
        )
    speed = sqrt(V * V - across * across) + along
    if speed <= ROUNDING * V:
        raise WindTooStrong(
            f"the wind along the runway is {abs(along):.4g} m/s, against the landing: an aircraft of {V:.4g} m/s never "
            "comes to it"
        )
    return speed


def _check_approach(landing: Landing, aircraft: Aircraft, speed_m_s: float) -> None:
    """Raise `InvalidArgument` for an approach that is too steep or too short for the aircraft."""
    runway, rate = landing.runway, aircraft.descent_rate_m_s
    if rate is None:
        raise InvalidArgument("descent_rate_m_s", "is needed: a landing descends on its glide slope")
    sink = speed_m_s * runway.descent
    if sink > rate * (1.0 + ROUNDING):
        flattest = degrees(atan2(rate, speed_m_s))
        raise InvalidArgument(
            "glide_slope_deg",
            f"is {runway.glide_slope_deg:g}: at {speed_m_s:.4g} m/s over the ground that is {sink:.3g} m/s down, and "
            f"the aircraft descends at {rate:g} m/s at most, which is a slope of {flattest:.3g} degrees",
        )
    if landing.final_m < aircraft.turn_radius_m:
        raise InvalidArgument(
            "final_m",
            f"is {landing.final_m:g}, too near the threshold to come out of a turn: it must be the turn radius at "
            f"least, {aircraft.turn_radius_m:.4g} m",
        )
