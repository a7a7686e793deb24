from math import inf, isnan, nan

import pytest

from loiter.lab.trials.campaign import Outcome
from loiter.lab.trials.summary import summary


def outcome(settled_s, ideal_s=10.0, round_again=False):
    return Outcome(0, ideal_s, settled_s, settled_s, 2.0, 5.0, 180.0, round_again, 0.1)


def test_times_are_compared_with_the_fastest_entry():
    s = summary([outcome(11.0), outcome(12.0), outcome(45.0, ideal_s=30.0), outcome(20.0, round_again=True)])
    assert (s.flights, s.settled, s.round_again) == (4, 4, 1)
    assert (s.median_ratio, s.ninth_decile_ratio) == (1.2, 2.0)
    assert (s.median_late_s, s.percentile_99_late_s) == (2.0, 15.0)
    assert (s.median_overshoot_m, s.bank_rate_deg_s, s.worst_join_error_s) == (2.0, 5.0, 0.1)
    assert isnan(s.sooner)


def test_flights_that_never_settled_are_the_latest():
    s = summary([outcome(11.0), outcome(nan), outcome(nan)])
    assert (s.settled, s.median_ratio, s.median_late_s) == (1, inf, inf)


def test_a_start_on_the_circle_has_no_ratio():
    assert summary([outcome(0.0, ideal_s=0.0), outcome(11.0)]).median_ratio == 1.1
    assert isnan(summary([outcome(0.0, ideal_s=0.0)]).median_ratio)


def test_sooner_counts_pairs_and_no_ties():
    some, others = [outcome(11.0), outcome(12.0), outcome(nan)], [outcome(12.0), outcome(12.0), outcome(13.0)]
    assert summary(some, others).sooner == pytest.approx(1 / 3)
    assert summary(others, some).sooner == pytest.approx(1 / 3)
    assert summary([outcome(nan)], [outcome(nan)]).sooner == 0.0
