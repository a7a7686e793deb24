"""The hold in wind: its headings follow the wind triangle, and flown with its bank it stays on the circle."""

from dataclasses import replace
from math import atan2, cos, degrees, hypot, pi, radians, sin, tan

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from loiter import Aircraft, Orbit, Pose, Turn, Wind, hold, plan
from loiter.errors import InvalidArgument, RadiusTooSmall, WindTooStrong
from loiter.planning.model import STANDARD_GRAVITY_M_S2
from strategies import windy_scenes

settings.register_profile("hold", deadline=None, max_examples=25)
settings.load_profile("hold")

UAV, ORBIT, WIND = Aircraft(18.0, max_bank_deg=35.0), Orbit(0.0, 0.0, 120.0), Wind(8.0, 250.0)
one_way = st.sampled_from([Turn.CW, Turn.CCW])


def past(orbit, wind):
    """The velocity of the air past the circle, by angles."""
    blows = radians(wind.from_deg + 180.0)
    east, north = wind.speed_m_s * sin(blows), wind.speed_m_s * cos(blows)
    return east - orbit.velocity_east_m_s, north - orbit.velocity_north_m_s


@given(windy_scenes(), one_way, st.floats(-360.0, 720.0))
def test_heading_and_wind_add_up_to_a_velocity_along_the_circle(scene, turn, azimuth):
    _, orbit, uav, wind = scene
    point = hold(orbit, uav, wind, turn=turn).at(azimuth)
    e, n = past(orbit, wind)
    heading, out = radians(point.heading_deg), radians(azimuth)
    ve, vn = uav.airspeed_m_s * sin(heading) + e, uav.airspeed_m_s * cos(heading) + n
    assert ve * sin(out) + vn * cos(out) == pytest.approx(0.0, abs=1e-9)
    clockwise = ve * cos(out) - vn * sin(out)
    assert (clockwise > 0.0) == (turn == Turn.CW)
    over = hypot(ve + orbit.velocity_east_m_s, vn + orbit.velocity_north_m_s)
    assert point.ground_speed_m_s == pytest.approx(over, abs=1e-9)
    assert cos(radians(point.azimuth_deg) - out) == pytest.approx(1.0)


@pytest.mark.parametrize("turn", [Turn.CW, Turn.CCW])
@pytest.mark.parametrize("orbit", [ORBIT, replace(ORBIT, velocity_east_m_s=3.0, velocity_north_m_s=-2.0)])
def test_flown_with_its_bank_the_aircraft_stays_on_the_circle(orbit, turn):
    """Flown once and a half round by Runge and Kutta, turning at g tan(bank)/V for the azimuth of the moment."""
    circle = hold(orbit, UAV, WIND, turn=turn)
    start = circle.at(30.0)
    e, n = past(orbit, WIND)
    sense, step = (1.0 if turn == Turn.CW else -1.0), 0.02
    state = np.array([120.0 * sin(radians(30.0)), 120.0 * cos(radians(30.0)), radians(start.heading_deg)])

    def rates(z):
        bank = circle.at(degrees(np.arctan2(z[0], z[1]))).bank_deg
        turning = sense * STANDARD_GRAVITY_M_S2 * tan(radians(bank)) / UAV.airspeed_m_s
        return np.array([18.0 * sin(z[2]) + e, 18.0 * cos(z[2]) + n, turning])

    swept = 0.0
    while swept < 3.0 * pi:
        k1 = rates(state)
        k2 = rates(state + 0.5 * step * k1)
        k3 = rates(state + 0.5 * step * k2)
        k4 = rates(state + step * k3)
        after = state + step / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4)
        turned = np.arctan2(after[0], after[1]) - np.arctan2(state[0], state[1])
        swept += sense * ((turned + pi) % (2.0 * pi) - pi)
        state = after
        assert hypot(state[0], state[1]) == pytest.approx(120.0, abs=1e-5)


@given(windy_scenes(), one_way)
def test_the_bank_is_largest_downwind_and_never_more_than_the_aircraft_can(scene, turn):
    _, orbit, uav, wind = scene
    circle = hold(orbit, uav, wind, turn=turn)
    every = circle.sample(1.0)
    assert len(every.azimuth_deg) == 360
    assert every.bank_deg.max() <= circle.largest_bank_deg + 1e-9
    assert every.bank_deg.min() >= circle.least_bank_deg - 1e-9
    assert circle.largest_bank_deg <= uav.max_bank_deg + 1e-9
    w, R = hypot(*past(orbit, wind)) / uav.airspeed_m_s, orbit.radius_m
    assert circle.largest_bank_deg == pytest.approx(uav.bank_deg(R / (1.0 + w) ** 2), abs=1e-9)
    assert circle.least_bank_deg == pytest.approx(uav.bank_deg(R / (1.0 - w) ** 2), abs=1e-9)
    there = circle.at(circle.largest_bank_azimuth_deg)
    assert there.bank_deg == pytest.approx(circle.largest_bank_deg, abs=1e-9)


def test_a_plan_knows_its_hold():
    m = plan(Pose(-400.0, 120.0, 90.0), ORBIT, UAV, WIND)
    assert m.hold == hold(ORBIT, UAV, WIND, turn=m.turn)
    azimuth = degrees(atan2(m.join.east_m, m.join.north_m))
    assert m.hold.at(azimuth).heading_deg == pytest.approx(m.join.heading_deg, abs=1e-9)


def test_in_still_air_the_bank_is_the_same_all_round():
    every = hold(ORBIT, UAV, turn="ccw").sample(10.0)
    assert every.bank_deg == pytest.approx(UAV.bank_deg(120.0), abs=1e-12)
    assert every.ground_speed_m_s == pytest.approx(18.0, abs=1e-12)
    assert every.heading_deg == pytest.approx((every.azimuth_deg - 90.0) % 360.0, abs=1e-9)


@pytest.mark.parametrize("turn", [None, "either", "left"])
def test_a_hold_has_one_direction(turn):
    with pytest.raises(InvalidArgument, match=r"^turn is '(either|left)': a circle is held cw or ccw$"):
        hold(ORBIT, UAV, WIND, turn=turn)


@pytest.mark.parametrize("step", [0.0, -1.0, 1e-4, float("nan")])
def test_a_step_is_not_too_small(step):
    with pytest.raises(InvalidArgument, match="step_deg is"):
        hold(ORBIT, UAV, WIND, turn="cw").sample(step)


def test_the_finest_step_is_allowed(monkeypatch):
    monkeypatch.setattr("loiter.planning.hold.FINEST_DEG", 45.0)
    assert hold(ORBIT, UAV, WIND, turn="cw").sample(45.0).azimuth_deg.shape == (8,)
    with pytest.raises(InvalidArgument, match=r"^step_deg is 44\.9: it must be at least 45 degrees$"):
        hold(ORBIT, UAV, WIND, turn="cw").sample(44.9)


def test_a_circle_that_cannot_be_held_is_refused():
    with pytest.raises(RadiusTooSmall, match=r"it needs 98\.45 m, or 48\.96 deg"):
        hold(replace(ORBIT, radius_m=60.0), UAV, Wind(8.0, 0.0), turn="cw")
    with pytest.raises(RadiusTooSmall, match="orbit radius 40 m is tighter than the aircraft can turn"):
        hold(replace(ORBIT, radius_m=40.0), UAV, turn="cw")
    with pytest.raises(WindTooStrong, match="a wind of 20 m/s"):
        hold(ORBIT, UAV, Wind(20.0, 0.0), turn="cw")
