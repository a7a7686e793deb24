"""CSV as pandas reads it: the track, its tangent and its curvature as PX4 and ArduPilot count it."""

import numpy as np
import pandas as pd
import pytest
from hypothesis import assume, given, settings

from earth import SCENES, apart_m, at_time, entry, on_earth, placed, same_direction, switches
from loiter.files import save
from loiter.files.maps.table import table
from loiter.files.maps.track import step_counts, vertices

settings.register_profile("tables", deadline=None, max_examples=25)
settings.load_profile("tables")

COLUMNS = [
    "time_s",
    "latitude_deg",
    "longitude_deg",
    "north_m",
    "east_m",
    "heading_deg",
    "track_deg",
    "ground_speed_m_s",
    "tangent_north",
    "tangent_east",
    "curvature_right_per_m",
    "altitude_m",
]


def read(tmp_path, m, **options):
    save(m, tmp_path / "entry.csv", **options)
    return pd.read_csv(tmp_path / "entry.csv")


@pytest.mark.parametrize("name", SCENES)
def test_pandas_reads_the_maneuver(tmp_path, name):
    m, frame = SCENES[name]
    rows = read(tmp_path, m, frame=frame, altitude_m=600.0)
    assert rows.columns.tolist() == COLUMNS
    assert all(np.abs(rows.time_s - time).min() < 1e-9 for time in switches(m))
    for row in rows.itertuples():
        east, north, heading = at_time(m, row.time_s)
        latitude, longitude, turned = on_earth(frame, east, north)
        assert (row.east_m, row.north_m) == pytest.approx((east, north), abs=1e-6)
        assert apart_m((row.latitude_deg, row.longitude_deg), (latitude, longitude)) < 1e-6
        assert same_direction(row.heading_deg, heading + turned, 1e-6)
        assert row.altitude_m == 600.0


@pytest.mark.parametrize("name", ["wind", "wind ccw", "ccw"])
def test_the_track_is_that_of_the_samples_to_the_last_bit(tmp_path, name):
    m, _ = SCENES[name]
    rows, track = read(tmp_path, m, spacing_m=5.0), vertices(m, step_counts(m, 5.0, 1.0))
    for column in ("time_s", "east_m", "north_m", "heading_deg", "track_deg", "ground_speed_m_s"):
        assert rows[column].tolist() == getattr(track, column).tolist()
    assert rows.curvature_right_per_m.tolist() == (-track.ground_curvature_per_m).tolist()


def test_without_a_frame_or_an_altitude_there_are_no_columns_for_them(tmp_path):
    rows = read(tmp_path, SCENES["wind"][0])
    assert rows.columns.tolist() == [name for name in COLUMNS if name[:3] not in ("lat", "lon", "alt")]


@given(placed())
def test_the_tangent_is_the_direction_of_the_velocity(scene):
    """By differences of the flight: central ones, within a piece."""
    m, _ = scene
    track = vertices(m, step_counts(m, None, 1.0))
    rows = pd.read_csv(pd.io.common.BytesIO(table(track, None, None)))
    assert np.hypot(rows.tangent_north.values, rows.tangent_east.values) == pytest.approx(1.0, abs=1e-14)
    dt = 1e-3
    long = [segment for segment in m.segments if segment.duration_s >= 4.0 * dt]
    assume(long)
    for segment in long:
        i = int(np.searchsorted(rows.time_s, segment.start_s))
        before, after = (at_time(m, rows.time_s[i] + t) for t in (0.0, dt))
        east, north = (after[0] - before[0]) / dt, (after[1] - before[1]) / dt
        speed = rows.ground_speed_m_s[i]
        tangent = speed * rows.tangent_east[i], speed * rows.tangent_north[i]
        # An acceleration of v^2/r over dt, and rounding of coordinates of kilometres.
        assert (east, north) == pytest.approx(
            tangent, abs=dt * m.aircraft.airspeed_m_s**2 / m.aircraft.turn_radius_m + 1e-8
        )


@pytest.mark.parametrize(("turn", "sign"), [("cw", 1.0), ("ccw", -1.0)])
def test_right_turns_have_a_positive_curvature(tmp_path, turn, sign):
    """The cross product of the tangents, north to east, as NPFG and the L1 law have it; and the hold's direction."""
    m, frame = entry(turn)
    rows = read(tmp_path, m, frame=frame, spacing_m=2.0)
    turning = (
        rows.tangent_north.values[:-1] * rows.tangent_east.values[1:]
        - rows.tangent_east.values[:-1] * rows.tangent_north.values[1:]
    )
    length = rows.ground_speed_m_s.values[:-1] * np.diff(rows.time_s)
    assert turning / length == pytest.approx(rows.curvature_right_per_m.values[:-1], abs=1e-4)
    assert rows.curvature_right_per_m.iloc[-1] * -sign > 0.0


def test_a_straight_piece_has_no_negative_nought(tmp_path):
    save(SCENES["wind"][0], tmp_path / "entry.csv")
    assert "-0.0," not in (tmp_path / "entry.csv").read_text()
