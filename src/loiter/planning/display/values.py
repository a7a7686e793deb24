"""Maneuvers as plain values, for JSON."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from loiter.planning.model import Pose, Segment

if TYPE_CHECKING:
    from loiter.planning.maneuver import Maneuver

PoseValues = Callable[[Pose], dict[str, float]]


def pose_values(pose: Pose) -> dict[str, float]:
    """A pose as plain values, in metres and degrees."""
    return {"east_m": pose.east_m, "north_m": pose.north_m, "heading_deg": pose.heading_deg}


def maneuver_values(maneuver: Maneuver, pose: PoseValues = pose_values) -> dict[str, object]:
    """A maneuver as plain values; `pose` converts its poses."""
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
