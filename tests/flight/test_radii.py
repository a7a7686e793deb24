"""How ArduPlane widens loiters, compared with AP_L1_Control::loiter_radius and its simulator."""

from math import radians, tan

import pytest
from hypothesis import given
from hypothesis import strategies as st

from loiter.flight.missions.flown_radius import LoiterScaling, eas2tas_squared, loiter_scaling

GRAVITY = 9.80665


def by_ardupilot(radius_m, eas2tas_squared, bank_limit_deg, airspeed_m_s):
    """AP_L1_Control::loiter_radius, as its comments tell it."""
    if bank_limit_deg == 0.0 or airspeed_m_s == 0.0:
        return radius_m * eas2tas_squared
    sea_level_radius = airspeed_m_s**2 / (GRAVITY * tan(radians(bank_limit_deg)))
    if sea_level_radius > radius_m:
        return radius_m * eas2tas_squared
    return max(sea_level_radius * eas2tas_squared, radius_m)


@pytest.mark.parametrize(
    ("radius", "altitude", "limit", "measured"),
    [(80.0, 684.0, 0.0, 85.9), (150.0, 684.0, 0.0, 160.2), (80.0, 684.0, 45.0, 80.8), (150.0, 684.0, 45.0, 150.0)],
)
def test_the_radius_is_the_one_that_a_simulator_flew(radius, altitude, limit, measured):
    assert LoiterScaling(limit, 18.0).flown_m(radius, altitude) == pytest.approx(measured, abs=1.0)


@pytest.mark.parametrize(
    ("altitude", "squared"),
    # ICAO's standard atmosphere: the inverse of its density ratio; at the ends of the range beyond it.
    [(0.0, 1.0), (1000.0, 1.1016), (2000.0, 1.2171), (5000.0, 1.6640), (11000.0, 3.3663), (20000.0, 3.3663)],
)
def test_eas2tas_squared_is_that_of_standard_air(altitude, squared):
    assert eas2tas_squared(altitude) == pytest.approx(squared, rel=1e-3)


limits = st.sampled_from([0.0, 20.0, 30.0, 45.0, 60.0])


@given(radius=st.floats(10.0, 3000.0), altitude=st.floats(-400.0, 9000.0), limit=limits, airspeed=st.floats(8.0, 40.0))
def test_the_radius_is_ardupilots(radius, altitude, limit, airspeed):
    expected = by_ardupilot(radius, eas2tas_squared(altitude), limit, airspeed)
    assert LoiterScaling(limit, airspeed).flown_m(radius, altitude) == pytest.approx(expected, rel=1e-12)


@given(radius=st.floats(10.0, 3000.0), altitude=st.floats(0.0, 9000.0), limit=limits, airspeed=st.floats(8.0, 40.0))
def test_what_is_sent_is_flown_as_requested(radius, altitude, limit, airspeed):
    widened = LoiterScaling(limit, airspeed)
    assert widened.flown_m(widened.sent_m(radius, altitude), altitude) == pytest.approx(radius, rel=1e-12)
    assert widened.sent_whole_m(radius, altitude) == pytest.approx(widened.sent_m(radius, altitude), abs=0.5)


@pytest.mark.parametrize(
    ("known", "expected"),
    [
        ({}, None),
        ({"AIRSPEED_CRUISE": 18.0}, None),
        ({"NAVL1_LIM_BANK": 0.0}, LoiterScaling(0.0, 0.0)),
        ({"NAVL1_LIM_BANK": 45.0}, None),
        ({"NAVL1_LIM_BANK": 45.0, "AIRSPEED_CRUISE": 18.0}, LoiterScaling(45.0, 18.0)),
        ({"NAVL1_LIM_BANK": 45.0, "TRIM_ARSPD_CM": 1800.0}, LoiterScaling(45.0, 18.0)),
        ({"NAVL1_LIM_BANK": -1.0}, LoiterScaling(0.0, 0.0)),
    ],
)
def test_how_loiters_are_widened_is_known_once_the_vehicle_has_answered(known, expected):
    assert loiter_scaling(known) == expected
