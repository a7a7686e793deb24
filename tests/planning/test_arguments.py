"""Quantities with units as arguments; and words as text."""

import numpy as np
import pytest

import loiter
from loiter import Aircraft, Orbit, Pose, Wind, plan
from loiter.errors import InvalidArgument
from loiter.kernel.words import Word

POSE, ORBIT, UAV = Pose(-400.0, 120.0, 90.0), Orbit(0.0, 0.0, 120.0), Aircraft(18.0, max_bank_deg=35.0)


# Words


def test_words_are_decoded():
    found = loiter.solve([4.0, -3.0, 0.0, np.nan], [4.0, 0.0, 1.0, 0.0])
    assert found.words.tolist() == ["RSL", "SL", "", ""]
    assert found.words.shape == found.word.shape
    assert loiter.solve(4.0, 4.0).words.tolist() == "RSL"


def test_every_code_has_its_letters():
    found = loiter.Solution(*[np.array(list(Word), np.int8)] * 6)
    assert found.words.tolist() == [word.letters for word in Word]


def test_words_in_wind_are_decoded():
    found = loiter.solve_in_wind([-10.0, 0.0], 0.0, 0.0, 3.0, "cw", 0.3, 0.0)
    assert isinstance(found, loiter.WindSolution)
    problem = Pose(-10.0, 0.0, 90.0), Orbit(0.0, 0.0, 3.0, "cw"), Aircraft(1.0, min_turn_radius_m=1.0)
    assert found.words[0] == plan(*problem, Wind(0.3, 270.0)).word


def test_words_of_lazy_arrays_are_lazy():
    da = pytest.importorskip("dask.array")
    x = da.from_array(np.array([4.0, -3.0]), chunks=1)
    words = loiter.solve(x, da.from_array(np.array([4.0, 0.0]), chunks=1)).words
    assert hasattr(words, "compute")
    assert words.compute().tolist() == ["RSL", "SL"]


# Quantities with units


@pytest.fixture(scope="module")
def units():
    return pytest.importorskip("pint").UnitRegistry()


def test_quantities_are_converted(units):
    q = units.Quantity
    uav = Aircraft(q(64.8, "km/h"), max_bank_deg=q(np.radians(35.0), "radian"))
    assert uav.airspeed_m_s == pytest.approx(18.0)
    assert uav.max_bank_deg == pytest.approx(35.0)
    assert type(uav.airspeed_m_s) is float
    orbit = Orbit(q(0, "m"), q(0.0, "ft"), q(0.12, "km"), velocity_east_m_s=q(1.0, "knot"))
    assert (orbit.radius_m, orbit.velocity_east_m_s) == pytest.approx((120.0, 1852.0 / 3600.0))
    pose = Pose(q(-0.4, "km"), q(120.0, "m"), q(0.25, "turn"))
    assert (pose.east_m, pose.heading_deg) == pytest.approx((-400.0, 90.0))
    wind = Wind(q(16.0, "knot"), q(250.0, "degree"))
    assert wind.speed_m_s == pytest.approx(16.0 * 1852.0 / 3600.0)
    assert Aircraft(q(18.0, "m/s"), max_turn_rate_deg_s=q(0.3, "rad/s")).max_turn_rate_deg_s == pytest.approx(
        17.19, abs=0.01
    )


def test_plans_take_quantities(units):
    q = units.Quantity
    with_units = plan(POSE, ORBIT, UAV, tolerance_m=q(50.0, "cm"))
    assert with_units == plan(POSE, ORBIT, UAV, tolerance_m=0.5)
    track = with_units.sample(q(100.0, "ms"))
    assert track.time_s[1] == pytest.approx(0.1)
    frame = loiter.geo.LocalFrame(q(47.11, "degree"), q(np.radians(8.23), "rad"))
    assert frame.longitude_deg == pytest.approx(8.23)
    assert loiter.geo.true_airspeed(q(35.0, "knot"), q(3000.0, "ft")) == pytest.approx(
        loiter.geo.true_airspeed(35.0 * 1852.0 / 3600.0, 914.4)
    )


def test_arrays_of_quantities_are_reduced(units):
    q = units.Quantity
    km = loiter.reduce(q(np.array([0.09, 0.1]), "km"), q(60.0, "m"), q(np.array([100.0, 10.0]), "degree"), ORBIT, UAV)
    metres = loiter.reduce(np.array([90.0, 100.0]), 60.0, np.array([100.0, 10.0]), ORBIT, UAV)
    np.testing.assert_allclose(km, metres, rtol=1e-14)


@pytest.mark.parametrize(
    ("make", "sentence"),
    [
        (
            lambda q: Aircraft(q(18.0, "m"), max_bank_deg=35.0),
            "airspeed_m_s is 18.0 meter: it must be a positive, finite",
        ),
        (lambda q: Pose(q(1.0, "s"), 0.0, 0.0), "pose east_m is 1.0 second: it must be a finite number of metres"),
        (lambda q: Orbit(0.0, 0.0, q(-1.0, "km")), "orbit radius_m is -1.0 kilometer: it must be a positive"),
        (lambda q: Wind(q(float("nan"), "m/s"), 0.0), "wind speed_m_s is nan meter / second: it must be zero or a"),
        (lambda q: Pose(q([1.0, 2.0], "m"), 0.0, 0.0), "pose east_m is [1.0 2.0] meter: it must be a finite number of"),
    ],
)
def test_quantities_that_do_not_fit_are_refused(units, make, sentence):
    with pytest.raises(InvalidArgument) as refused:
        make(units.Quantity)
    assert str(refused.value).startswith(sentence)
