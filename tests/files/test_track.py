"""Polylines of tracks: chords within what is asked, vertices at every switch."""

from itertools import pairwise
from math import inf, nan

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from earth import SCENES, at_time, off_lines, placed, switches
from loiter.errors import InvalidArgument
from loiter.files.maps.track import LEAST_SIDES, circle_polygon, step_counts, vertices
from loiter.planning.flight import samples_at

settings.register_profile("tracks", deadline=None, max_examples=40)
settings.load_profile("tracks")

ERRORS = st.sampled_from([0.01, 0.3, 1.0, 10.0])


def between(m, track, parts=20):
    """The track, some samples in each step of a polyline; and the polyline's vertices before and after each."""
    shares = np.linspace(0.0, 1.0, parts, endpoint=False)
    times = np.concatenate([a + shares * (b - a) for a, b in pairwise(track.time_s)])
    dense = samples_at(times, m.start, m.segments, m.aircraft, m.wind)
    corners = track.east_m + 1j * track.north_m
    return dense.east_m + 1j * dense.north_m, corners[:-1].repeat(parts), corners[1:].repeat(parts)


@given(placed(), ERRORS)
def test_no_chord_is_further_off_than_requested(scene, error):
    m, _ = scene
    track = vertices(m, step_counts(m, None, error))
    assume(m.segments)
    assert off_lines(*between(m, track)).max() <= error * (1.0 + 1e-9) + 1e-9


@given(placed(0.3), st.floats(1e-4, 1e-2))
def test_chords_are_not_much_closer_than_requested(scene, share):
    """Cut into three steps or more, rounded up, an arc has steps of 2/3 the length that would do, and chords off by 4/9
    of what is asked; less what of the acceleration is along the track, a crab angle's sine of at most 0.3."""
    m, _ = scene
    error = share * m.aircraft.turn_radius_m
    counts = step_counts(m, None, error)
    track = vertices(m, counts)
    off = np.split(off_lines(*between(m, track)).reshape(-1, 20).max(axis=1), np.cumsum(counts)[:-1])
    each = zip(m.segments, counts, off, strict=True)
    largest = [of_one.max() for segment, count, of_one in each if segment.letter != "S" and count > 2]
    assume(largest)
    assert min(largest) >= 0.4 * error


@given(placed(), st.floats(1.0, 200.0))
def test_neighbours_are_no_further_apart_than_requested(scene, spacing):
    m, _ = scene
    track = vertices(m, step_counts(m, max(spacing, m.length_m / 1e4), 1.0))
    apart = np.hypot(np.diff(track.east_m), np.diff(track.north_m))
    assert apart.max(initial=0.0) <= max(spacing, m.length_m / 1e4) * (1.0 + 1e-9)


@given(placed(), ERRORS)
def test_every_switch_is_a_vertex_and_every_vertex_on_the_track(scene, error):
    m, _ = scene
    counts = step_counts(m, None, error)
    track = vertices(m, counts)
    assert track.time_s.size == sum(counts) + 1
    assert track.time_s[np.cumsum([0, *counts])] == pytest.approx(switches(m), rel=1e-14)
    size = 1e-11 * (1e4 + 60.0 * m.duration_s)
    for i in {0, track.time_s.size // 2, track.time_s.size - 1}:
        place = at_time(m, track.time_s[i])[:2]
        assert (track.east_m[i], track.north_m[i]) == pytest.approx(place, abs=size)


def test_the_start_and_the_end_are_the_pose_and_the_join():
    for m, _ in SCENES.values():
        track = vertices(m, step_counts(m, None, 1.0))
        assert (track.east_m[0], track.north_m[0]) == (m.start.east_m, m.start.north_m)
        assert (track.east_m[-1], track.north_m[-1]) == pytest.approx((m.join.east_m, m.join.north_m), abs=1e-8)


@given(st.floats(1e-2, 1e5), st.floats(1e-2, 100.0))
def test_a_ring_is_within_the_error_of_its_circle(radius, error):
    m, _ = SCENES["cw"]
    orbit = m.orbit.__class__(30.0, -40.0, radius)
    east, north = circle_polygon(orbit, error)
    assert (east[0], north[0]) == (east[-1], north[-1])
    assert len(east) > LEAST_SIDES
    corners = (east - 30.0) + 1j * (north + 40.0)
    assert np.abs(corners) == pytest.approx(radius, abs=1e-9)
    assert radius - np.abs(corners[:-1] + corners[1:]).min() / 2.0 <= error * (1.0 + 1e-9)
    assert np.all(np.angle(corners[1:] / corners[:-1]) > 0.0)


@pytest.mark.parametrize("value", [0.0, -1.0, nan, inf, "1", None])
def test_an_error_is_positive(value):
    with pytest.raises(InvalidArgument, match=r"^chord_error_m is .*: it must be a positive, finite number of metres$"):
        step_counts(SCENES["cw"][0], None, value)


@pytest.mark.parametrize("value", [0.0, -1.0, nan, inf, "1"])
def test_a_spacing_is_positive(value):
    with pytest.raises(InvalidArgument, match=r"^spacing_m is .*: it must be a positive, finite number of metres$"):
        step_counts(SCENES["cw"][0], value, 1.0)


@pytest.mark.parametrize(("spacing", "error"), [(1e-9, 1.0), (None, 1e-12), (1e-49, 1.0), (1.0, 1e-49)])
def test_too_many_points_are_refused(spacing, error):
    with pytest.raises(InvalidArgument, match=r"^track would have more than 1,000,000 points with a chord error of"):
        step_counts(SCENES["wind"][0], spacing, error)


def test_a_ring_of_too_many_sides_is_refused():
    with pytest.raises(
        InvalidArgument, match=r"^circle would have more than 1,000,000 points with a chord error of 1e-12 m$"
    ):
        circle_polygon(SCENES["cw"][0].orbit, 1e-12)
