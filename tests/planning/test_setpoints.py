"""Path setpoints, compared with differences of the positions alone."""

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from loiter import Aircraft, Orbit, Pose, Wind, plan
from loiter.errors import InvalidArgument

UAV = Aircraft(18.0, max_bank_deg=35.0)


@settings(max_examples=40, deadline=None)
@given(
    st.tuples(st.floats(-500, 500), st.floats(-500, 500), st.floats(0, 360)),
    st.floats(0.0, 8.0),
    st.floats(0.0, 360.0),
)
def test_tangent_speed_and_curvature_are_those_of_the_positions(pose, wind, from_deg):
    m = plan(Pose(*pose), Orbit(0.0, 0.0, 120.0), UAV, Wind(wind, from_deg))
    assume(m.duration_s >= 1.0)
    h = 1e-3
    s = m.setpoints(h)
    place = np.stack([s.east_m, s.north_m], axis=1)[:-1]
    # Not next to a switch, where the differences take both pieces.
    switches = [segment.start_s for segment in m.segments] + [m.duration_s]
    inside = np.min(np.abs(s.time_s[1:-2, None] - np.array(switches)), axis=1) > 3 * h
    velocity = ((place[2:] - place[:-2]) / (2 * h))[inside]
    acceleration = ((place[2:] - 2 * place[1:-1] + place[:-2]) / h**2)[inside]
    speed = np.hypot(*velocity.T)
    tangent = np.stack([s.tangent_east, s.tangent_north], axis=1)[1:-2][inside]
    assert np.allclose(s.speed_m_s[1:-2][inside], speed, atol=1e-4)
    assert np.allclose(tangent * speed[:, None], velocity, atol=1e-3)
    left = velocity[:, 0] * acceleration[:, 1] - velocity[:, 1] * acceleration[:, 0]
    assert np.allclose(s.curvature_per_m[1:-2][inside] * speed**3, left, atol=2e-2 * 18**2)


def test_in_still_air_they_are_the_samples():
    m = plan(Pose(-400.0, 120.0, 90.0), Orbit(0.0, 0.0, 80.0), UAV)
    s, track = m.setpoints(0.1), m.sample(0.1)
    assert (s.time_s == track.time_s).all()
    assert (s.curvature_per_m == track.curvature_per_m).all()
    assert np.allclose(np.degrees(np.arctan2(s.tangent_east, s.tangent_north)) % 360.0, track.heading_deg)
    assert np.allclose(np.hypot(s.tangent_east, s.tangent_north), 1.0, atol=1e-15)
    assert set(np.sign(s.curvature_per_m)) == {-1.0, 0.0, 1.0}


def test_on_the_circle_there_is_one():
    m = plan(Pose(0.0, 80.0, 90.0), Orbit(0.0, 0.0, 80.0, "cw"), UAV)
    assert m.setpoints(0.1).east_m.shape == (1,)


def test_a_step_that_is_not_positive_is_refused():
    m = plan(Pose(-400.0, 120.0, 90.0), Orbit(0.0, 0.0, 80.0), UAV)
    with pytest.raises(InvalidArgument, match="step_s"):
        m.setpoints(0.0)
