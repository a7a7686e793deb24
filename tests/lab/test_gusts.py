"""Dryden gusts: the scale lengths of the specification, and the covariances of its spectra."""

from math import exp

import numpy as np
import pytest

from loiter.errors import InvalidArgument
from loiter.lab.simulators.gusts import Gusts, scale_length_m


def test_scale_lengths_are_those_of_the_specification():
    # At 1000 ft the horizontal length is 1000 ft again, to the digits of its coefficients; Beard and McLain, "Small
    # Unmanned Aircraft", table 4.1, round that at 50 m to 200 m.
    assert scale_length_m(304.8) == pytest.approx(304.8, rel=1e-3)
    assert scale_length_m(50.0) == pytest.approx(200.0, rel=0.02)


@pytest.mark.parametrize("altitude", [0.0, -5.0, 400.0, float("nan")])
def test_other_altitudes_are_refused(altitude):
    with pytest.raises(InvalidArgument, match=r"^altitude_m is "):
        scale_length_m(altitude)


def samples(dt, n, time_s=1.0, seed=11):
    gusts = Gusts(2.0, time_s, np.random.default_rng(seed))
    rows = np.empty((n, 2))
    for i in range(n):
        rows[i] = gusts.velocity_m_s
        gusts.advance(dt)
    return rows


@pytest.mark.parametrize("dt", [0.1, 0.5])
def test_covariances_are_those_of_the_spectra(dt):
    """For any step, with h the lag divided by T: s^2 exp(-h) along and s^2 (1 - h/2) exp(-h) across."""
    n, lags = 60_000, np.array([0.0, 0.5, 1.0, 2.0, 3.0])
    rows = samples(dt, n)
    # n dt correlation times give about half as many independent samples: standard errors of 4/sqrt(n dt/2).
    tolerance = 4.0 * 4.0 / (n * dt / 2.0) ** 0.5
    for lag in lags:
        k = round(lag / dt)
        along, across = (rows[: n - k] * rows[k:]).mean(axis=0)
        assert along == pytest.approx(4.0 * exp(-lag), abs=tolerance)
        assert across == pytest.approx(4.0 * (1.0 - 0.5 * lag) * exp(-lag), abs=tolerance)
    assert (rows[:, 0] * rows[:, 1]).mean() == pytest.approx(0.0, abs=tolerance)


def test_the_first_sample_has_the_stationary_deviation():
    first = np.array([Gusts(2.0, 1.0, np.random.default_rng(i)).velocity_m_s for i in range(4000)])
    assert first.std(axis=0) == pytest.approx([2.0, 2.0], rel=0.05)


def test_gusts_without_deviation_are_zero():
    gusts = Gusts(0.0, 1.0, np.random.default_rng(1))
    gusts.advance(0.1)
    assert gusts.velocity_m_s == (0.0, 0.0)
