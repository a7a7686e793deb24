"""Problems with the place on Earth of their coordinates, and their answers as plain values for JSON."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from typing import NamedTuple

from loiter.files.maps.places import DECIMALS
from loiter.geo import LocalFrame
from loiter.planning import maneuver as planned
from loiter.planning.maneuver import Maneuver, pose_values
from loiter.planning.model import Pose
from loiter.planning.problem import Problem


class PlacedProblem(NamedTuple):
    """A problem in local metres, and their frame, which is None where no place was given in degrees."""

    problem: Problem
    frame: LocalFrame | None


def answer(best: Sequence[Maneuver], others: Sequence[Maneuver], frame: LocalFrame | None = None) -> dict[str, object]:
    """The first of `best` as plain values, with the rest of `best` and then `others` as its `alternatives`."""
    first, *rest = best
    alternatives = [maneuver_values(m, frame) | {"later_s": m.duration_s - first.duration_s} for m in (*rest, *others)]
    return maneuver_values(first, frame) | {"alternatives": alternatives}


def maneuver_values(maneuver: Maneuver, frame: LocalFrame | None = None) -> dict[str, object]:
    """A maneuver as plain values; with a frame its poses have latitude, longitude and true heading too."""
    return planned.maneuver_values(maneuver, partial(_placed_values, frame) if frame is not None else pose_values)


def _placed_values(frame: LocalFrame, pose: Pose) -> dict[str, float]:
    place = frame.place(pose)
    return pose_values(pose) | {
        "latitude_deg": round(place.latitude_deg, DECIMALS),
        "longitude_deg": round(place.longitude_deg, DECIMALS),
        "true_heading_deg": place.heading_deg,
    }
