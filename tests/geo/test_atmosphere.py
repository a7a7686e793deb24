import math

import pytest
from ambiance import Atmosphere
from hypothesis import assume, given
from hypothesis import strategies as st

from loiter import Aircraft
from loiter.errors import InvalidArgument
from loiter.geo import density_altitude_m, density_ratio, true_airspeed

altitudes_m = st.floats(-500.0, 11_000.0)


@given(altitudes_m)
def test_the_standard_atmosphere_of_another_library(altitude):
    # It takes geometric heights and turns them into geopotential ones, which pressure altitudes are.
    geometric = altitude * 6_356_766.0 / (6_356_766.0 - altitude)
    assert density_ratio(altitude) == pytest.approx(float(Atmosphere(geometric).density[0]) / 1.225, rel=1e-6)


@pytest.mark.parametrize(("altitude", "ratio"), [(0.0, 1.0), (2000.0, 1.0065 / 1.225), (11_000.0, 0.36392 / 1.225)])
def test_the_tables_of_the_standard(altitude, ratio):
    # ISO 2533:1975, table 1, density in kg/m^3.
    assert density_ratio(altitude) == pytest.approx(ratio, rel=5e-5)


@given(altitudes_m, st.floats(-60.0, 50.0))
def test_density_altitude_is_where_standard_air_is_as_dense(altitude, temperature):
    height = density_altitude_m(altitude, temperature)
    assume(-500.0 <= height <= 11_000.0)
    assert density_ratio(height) == pytest.approx(density_ratio(altitude, temperature), rel=1e-12)


def test_standard_air_changes_nothing():
    assert density_altitude_m(3000.0) == pytest.approx(3000.0)
    assert density_altitude_m(3000.0, 15.0 - 19.5) == pytest.approx(3000.0)
    assert true_airspeed(20.0, 0.0) == 20.0


def test_a_bank_limit_turns_wider_where_the_air_is_thin():
    # The radius goes with the square of the true airspeed: with one over the density.
    low, high = (Aircraft(true_airspeed(18.0, height), max_bank_deg=35.0).turn_radius_m for height in (0.0, 3000.0))
    assert high / low == pytest.approx(1.0 / density_ratio(3000.0), rel=1e-12)


@pytest.mark.parametrize("altitude", [-501.0, 11_001.0, math.nan, math.inf])
def test_altitudes_outside_the_troposphere(altitude):
    with pytest.raises(InvalidArgument, match="altitude_m is"):
        density_ratio(altitude)


def test_impossible_air():
    with pytest.raises(InvalidArgument, match=r"it must be above -273\.15"):
        density_ratio(0.0, -300.0)
    with pytest.raises(InvalidArgument, match="indicated_airspeed_m_s is 0"):
        true_airspeed(0.0, 0.0)
