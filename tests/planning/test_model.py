"""What people say about aircraft, circles and poses: derived values and refusals."""

from dataclasses import FrozenInstanceError
from math import degrees, inf, nan, pi

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from loiter import Aircraft, Orbit, Pose, Turn, Wind, plan
from loiter.errors import InvalidArgument, LoiterError


def test_turn_radius_from_bank_is_that_of_a_coordinated_turn():
    # V^2 / (g tan bank) at 20 m/s and 45 degrees, where tan is 1: 400 / 9.80665.
    assert Aircraft(20.0, max_bank_deg=45.0).turn_radius_m == pytest.approx(40.788648519117, abs=1e-12)


def test_turn_radius_from_turn_rate_and_from_itself():
    assert Aircraft(20.0, max_turn_rate_deg_s=degrees(0.5)).turn_radius_m == pytest.approx(40.0, abs=1e-13)
    assert Aircraft(20.0, min_turn_radius_m=33.0).turn_radius_m == 33.0


@given(st.floats(5.0, 50.0), st.floats(1.0, 80.0))
def test_bank_of_the_tightest_circle_is_the_largest_bank(speed, bank):
    uav = Aircraft(speed, max_bank_deg=bank)
    assert uav.bank_deg(uav.turn_radius_m) == pytest.approx(bank, rel=1e-12)


BAD_NUMBERS = [nan, inf, -inf, "fast", None, True, [1.0], 10**400]


LIMITS = ["max_bank_deg", "min_turn_radius_m", "max_turn_rate_deg_s"]
BAD_AIRCRAFT = [("airspeed_m_s", value) for value in [*BAD_NUMBERS, 0, -3.0]]
# None says that a limit is not given.
BAD_AIRCRAFT += [(name, value) for name in LIMITS for value in [*BAD_NUMBERS, 0, -3.0] if value is not None]


@pytest.mark.parametrize(("name", "value"), BAD_AIRCRAFT)
def test_an_aircraft_needs_positive_numbers(name, value):
    arguments = {"airspeed_m_s": 18.0, "max_bank_deg": 35.0} if name == "airspeed_m_s" else {"airspeed_m_s": 18.0}
    with pytest.raises(InvalidArgument) as refused:
        Aircraft(**arguments | {name: value})
    assert str(refused.value).startswith(f"{name} is ")
    assert "\n" not in str(refused.value)


@pytest.mark.parametrize("bank", [90.0, 120.0])
def test_no_level_turn_at_ninety_degrees_of_bank(bank):
    with pytest.raises(InvalidArgument, match=f"max_bank_deg is {bank}: it must be between 0 and 90 degrees"):
        Aircraft(18.0, max_bank_deg=bank)


@pytest.mark.parametrize("limits", [{}, {"max_bank_deg": 30.0, "min_turn_radius_m": 50.0}])
def test_exactly_one_turn_limit(limits):
    with pytest.raises(InvalidArgument, match="turn limit is needed exactly once"):
        Aircraft(18.0, **limits)


def test_a_turn_radius_beyond_doubles_is_refused():
    with pytest.raises(InvalidArgument, match="turn radius is inf"):
        Aircraft(18.0, max_bank_deg=5e-324)


@pytest.mark.parametrize("value", BAD_NUMBERS)
@pytest.mark.parametrize("place", range(3))
def test_a_pose_needs_finite_numbers(place, value):
    numbers = [1.0, 2.0, 3.0]
    numbers[place] = value
    with pytest.raises(InvalidArgument, match=r"^pose (east_m|north_m|heading_deg) is "):
        Pose(*numbers)


@pytest.mark.parametrize("value", [*BAD_NUMBERS, 0.0])
def test_an_orbit_needs_a_positive_radius(value):
    with pytest.raises(
        InvalidArgument, match=r"^orbit radius_m is .*: it must be a positive, finite number of metres$"
    ):
        Orbit(0.0, 0.0, value)


def test_a_negative_radius_is_refused_with_what_it_may_mean():
    with pytest.raises(InvalidArgument, match=r"^orbit radius_m is -80.0: .*; the turn ccw holds counter-clockwise$"):
        Orbit(0.0, 0.0, -80.0)


@pytest.mark.parametrize("value", ["left", "CW", "", 1, None, nan])
def test_an_unknown_turn_is_refused(value):
    with pytest.raises(InvalidArgument, match=r"^turn is .*: it must be cw, ccw or either$"):
        Orbit(0.0, 0.0, 80.0, value)


def test_a_turn_may_be_given_as_a_string():
    assert Orbit(0.0, 0.0, 80.0, "cw").turn is Turn.CW
    assert Orbit(0.0, 0.0, 80.0).turn is Turn.EITHER
    assert (Turn.CW.other, Turn.CCW.other, Turn.EITHER.other) == (Turn.CCW, Turn.CW, Turn.EITHER)


def test_numbers_of_numpy_are_numbers():
    assert Pose(np.float64(1.0), np.int64(2), np.float32(3.0)) == Pose(1.0, 2, 3.0)
    assert Aircraft(np.float64(pi), min_turn_radius_m=np.int32(2)).turn_radius_m == 2


def test_every_refusal_is_a_value_error():
    assert issubclass(LoiterError, ValueError)
    assert issubclass(InvalidArgument, LoiterError)


def test_small_number_types_do_not_decide_how_it_is_reckoned():
    pose = Pose(np.int8(100), np.int8(60), np.float32(100.0))
    orbit = Orbit(np.int8(-100), np.uint8(0), np.float16(80.0))
    uav = Aircraft(np.float32(18.0), min_turn_radius_m=np.uint8(50))
    values = (pose.east_m, pose.heading_deg, orbit.east_m, orbit.radius_m, uav.airspeed_m_s, uav.turn_radius_m)
    assert {type(value) for value in values} == {float}
    expected = plan(Pose(100.0, 60.0, 100.0), Orbit(-100.0, 0.0, 80.0), Aircraft(18.0, min_turn_radius_m=50.0))
    assert plan(pose, orbit, uav) == expected


@pytest.mark.parametrize("value", [Pose(0.0, 0.0, 0.0), Wind(1.0, 2.0), Orbit(0.0, 0.0, 80.0), Aircraft(18.0, 35.0)])
@pytest.mark.parametrize("name", ["east_m", "unknown"])
def test_values_cannot_be_changed(value, name):
    """An unknown attribute raised TypeError from within the standard library."""
    with pytest.raises(FrozenInstanceError, match=f"cannot assign to field '{name}'"):
        setattr(value, name, 1.0)
