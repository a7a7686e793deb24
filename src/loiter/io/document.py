"""Maneuvers as plain values, for JSON."""

from __future__ import annotations

from collections.abc import Sequence

from loiter.geo import LocalFrame
from loiter.io.maps.places import DECIMALS
from loiter.planning.maneuver import Maneuver
from loiter.planning.model import Pose, Segment


def answer(best: Sequence[Maneuver], others: Sequence[Maneuver], frame: LocalFrame | None = None) -> dict[str, object]:
    """The first of `best` as plain values, with the rest of `best` and then `others` as its `alternatives`."""
    first, *rest = best
    alternatives = [maneuver_values(m, frame) | {"later_s": m.duration_s - first.duration_s} for m in (*rest, *others)]
    return maneuver_values(first, frame) | {"alternatives": alternatives}


def maneuver_values(maneuver: Maneuver, frame: LocalFrame | None = None) -> dict[str, object]:
    """A maneuver as plain values; with a frame its poses have latitude, longitude and true heading too."""
    return {
        "duration_s": maneuver.duration_s,
        "length_m": maneuver.length_m,
        "word": maneuver.word,
        "turn": maneuver.turn.value,
        "join": _pose(maneuver.join, frame),
        "wind": {"speed_m_s": maneuver.wind.speed_m_s, "from_deg": maneuver.wind.from_deg},
        "join_over_ground": _join_over_ground(maneuver),
        "hold": {
            "least_bank_deg": maneuver.hold.least_bank_deg,
            "largest_bank_deg": maneuver.hold.largest_bank_deg,
            "largest_bank_azimuth_deg": maneuver.hold.largest_bank_azimuth_deg,
        },
        "miss_m": maneuver.miss_m,
        "segments": [_segment(segment, frame) for segment in maneuver.segments],
        "aircraft": {
            "airspeed_m_s": maneuver.aircraft.airspeed_m_s,
            "turn_radius_m": maneuver.aircraft.turn_radius_m,
        },
    }


# `dataclasses.asdict` copies every value, which would take longer than the plan.
def _segment(segment: Segment, frame: LocalFrame | None) -> dict[str, object]:
    return {
        "letter": segment.letter,
        "start_s": segment.start_s,
        "duration_s": segment.duration_s,
        "length_m": segment.length_m,
        "curvature_per_m": segment.curvature_per_m,
        "start": _pose(segment.start, frame),
        "end": _pose(segment.end, frame),
    }


def _pose(pose: Pose, frame: LocalFrame | None) -> dict[str, float]:
    values = {"east_m": pose.east_m, "north_m": pose.north_m, "heading_deg": pose.heading_deg}
    if frame is None:
        return values
    place = frame.place(pose)
    return values | {
        "latitude_deg": round(place.latitude_deg, DECIMALS),
        "longitude_deg": round(place.longitude_deg, DECIMALS),
        "true_heading_deg": place.heading_deg,
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
