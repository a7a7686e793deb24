"""The scene that the options of a command describe, with a circle that can be held."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, NamedTuple

from loiter.cli.options import AircraftOptions, OrbitOptions, StartOptions, WindOptions
from loiter.cli.sentences import argument_names
from loiter.errors import InvalidArgument, RadiusTooSmall
from loiter.files.document import PlacedProblem
from loiter.files.missions.altitudes import MEAN_SEA_LEVEL, AltitudeDatum
from loiter.geo import LocalFrame
from loiter.geo.frame import degrees_of
from loiter.planning.model import Aircraft, Orbit, Pose, Wind
from loiter.planning.problem import Problem
from loiter.planning.slot import Slot

if TYPE_CHECKING:
    from loiter.files.missions.parameters import Preset

# Places in degrees that are read as metres lie no further apart than this.
FEW_DEGREES = 2.0


class OptionsRead(NamedTuple):
    """The problem that the options of a command describe, and a remark to print before the result, or ""."""

    placed: PlacedProblem
    remark: str


def read_options(
    start: StartOptions,
    orbit: OrbitOptions,
    aircraft: AircraftOptions,
    wind: WindOptions,
    *,
    fit: bool = False,
    datum: AltitudeDatum = MEAN_SEA_LEVEL,
) -> OptionsRead:
    """The problem that the options describe, with `fit` for a circle that can be held (`Orbit.fitted`).

    Raises `InvalidArgument` where they are contradictory or incomplete.
    """
    aircraft = aircraft.above_sea(datum)
    pose, circle, frame = place_scene(start, orbit, wind, aircraft.preset)
    uav = aircraft.aircraft
    planned = circle.fitted(uav, wind.moving_air) if fit else circle
    problem = Problem(pose, planned, uav, wind.moving_air)
    remarks = [
        orbit.site_remark(),
        _places_remark(start, frame),
        "" if frame else _metres_remark(pose, circle),
        aircraft.remark,
        _fit_remark(circle, planned),
    ]
    return OptionsRead(PlacedProblem(problem, frame), "\n".join(filter(None, remarks)))


class CircleRead(NamedTuple):
    """The circle, the aircraft and the wind that the options of a command describe, with a remark, or ""."""

    orbit: Orbit
    aircraft: Aircraft
    wind: Wind
    frame: LocalFrame | None
    remark: str


def read_circle(
    orbit: OrbitOptions,
    aircraft: AircraftOptions,
    wind: WindOptions,
    *,
    fit: bool = False,
    datum: AltitudeDatum = MEAN_SEA_LEVEL,
) -> CircleRead:
    """What the options describe, without a start; otherwise like `read_options`."""
    aircraft = aircraft.above_sea(datum)
    wind.check_declination()
    circle, frame = orbit.circle(aircraft.preset)
    uav = aircraft.aircraft
    planned = circle.fitted(uav, wind.moving_air) if fit else circle
    remarks = [orbit.site_remark(), aircraft.remark, _fit_remark(circle, planned)]
    return CircleRead(planned, uav, wind.moving_air, frame, "\n".join(filter(None, remarks)))


def _places_remark(start: StartOptions, frame: LocalFrame | None) -> str:
    """A line with the hemispheres of both places in degrees, which shows whether they are swapped; otherwise empty."""
    if start.pose_lla is None or frame is None:
        return ""
    lat, lon, _ = start.pose_lla
    return f"Start {degrees_of(lat, lon)}, circle {degrees_of(frame.latitude_deg, frame.longitude_deg)}."


def _metres_remark(pose: Pose, circle: Orbit) -> str:
    """A line where positions in metres look like latitudes and longitudes; otherwise empty."""
    numbers = (pose.east_m, pose.north_m, circle.east_m, circle.north_m)
    looks_like_degrees = all(0.0 < abs(each) <= 180.0 and each % 1.0 for each in numbers)
    if not looks_like_degrees or circle.distance_m(pose) > FEW_DEGREES:
        return ""
    return "These positions are metres: --pose-lla and --orbit-lla take latitudes and longitudes."


def read_slot(bearing_deg: float, at_s: float) -> Slot:
    """The slot of the options --slot, degrees, and --slot-at, seconds; raises `InvalidArgument`, which names them."""
    with argument_names(**{"slot phase_deg": "slot", "slot at_s": "slot_at_s"}):
        return Slot(bearing_deg, at_s)


def slot_of(bearing_deg: float | None, at_s: float | None) -> Slot | None:
    """The slot of the options, if there is one; raises `InvalidArgument` where they do not fit together."""
    if bearing_deg is None:
        if at_s is not None:
            raise InvalidArgument("slot_at_s", "needs --slot, the bearing of the slot at that time")
        return None
    return read_slot(bearing_deg, 0.0 if at_s is None else at_s)


@contextmanager
def fit_proposed() -> Iterator[None]:
    """Add to the refusal of a circle that cannot be held that `--fit` plans for one that can."""
    try:
        yield
    except RadiusTooSmall as error:
        r = error.fitted_radius_m
        raise RadiusTooSmall(f"{error}; --fit plans for {r:.4g} m", r) from error


def _fit_remark(asked: Orbit, planned: Orbit) -> str:
    """A line with both radii where the circle was widened; otherwise empty."""
    if planned == asked:
        return ""
    return f"A circle of {asked.radius_m:g} m cannot be held; planned for {planned.radius_m:.4g} m, the least radius."


def place_scene(
    start: StartOptions, orbit: OrbitOptions, air: WindOptions, preset: Preset | None = None
) -> tuple[Pose, Orbit, LocalFrame | None]:
    """The start and the circle, and the local frame if they are in degrees; `air` has the declination."""
    air.check_declination(start)
    if (start.pose is None) == (start.pose_lla is None):
        raise InvalidArgument("pose", "or --pose-lla is needed, and not both")
    circle, frame = orbit.circle(preset)
    if (start.pose_lla is None) != (frame is None):
        raise InvalidArgument("pose_lla", "and --orbit-lla go together: places in degrees, or both in metres")
    return start_pose(start, air, frame), circle, frame


def start_pose(start: StartOptions, air: WindOptions, frame: LocalFrame | None) -> Pose:
    """The start in local metres: in a frame if it is in degrees; `air` has the declination."""
    if frame is not None and start.pose_lla is not None:
        lat, lon, heading_deg = start.pose_lla
        return frame.pose(lat, lon, air.true_heading("pose true heading_deg", heading_deg))
    assert start.pose is not None  # one of them is given
    east_m, north_m, heading_deg = start.pose
    return Pose(east_m, north_m, air.true_heading("pose heading_deg", heading_deg))
