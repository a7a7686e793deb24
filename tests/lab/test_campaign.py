"""Campaigns: the same starts for all laws and any number of processes; the performance of the law on a few starts."""

from functools import partial

import numpy as np
import pytest

from guidance.flights import UAV
from loiter import Orbit, Pose, Wind, plan
from loiter.errors import InvalidArgument, WindTooStrong
from loiter.lab.trials.campaign import LAWS, Trial, campaign, kinematic, optimal, point_mass, trials
from loiter.lab.trials.summary import summary

STARTS = trials(12, 5, UAV)


def test_starts_are_within_their_bounds_and_independent_of_their_number():
    assert trials(4, 5, UAV) == STARTS[:4]
    assert trials(4, 6, UAV) != STARTS[:4]
    r = UAV.turn_radius_m
    for trial in trials(200, 1, UAV, radii=(1.5, 2.0), reach=3.0):
        radius = trial.ideal.orbit.radius_m
        assert 1.5 * r <= radius <= 2.0 * r
        assert trial.ideal.orbit.distance_m(trial.ideal.start) <= 3.0 * radius


def test_in_wind_every_circle_can_be_held():
    """The same starts scaled by (1 + w/V)^2, the factor of the tightest circle in wind (docs/wind.md, section 2)."""
    windy = trials(12, 5, UAV, Wind(9.0, 250.0))
    assert [t.ideal.orbit.radius_m for t in windy] == pytest.approx([2.25 * t.ideal.orbit.radius_m for t in STARTS])
    assert [t.ideal.start.heading_deg for t in windy] == [t.ideal.start.heading_deg for t in STARTS]
    with pytest.raises(WindTooStrong):
        trials(1, 5, UAV, Wind(18.0, 250.0))


def test_other_laws_get_the_direction_of_the_fastest_entry():
    for trial in STARTS:
        assert trial.orbit.turn == trial.ideal.turn
        assert trial.ideal.orbit.turn == "either"
        assert all(law(trial) for law in LAWS.values())


def test_a_campaign_does_not_depend_on_its_processes_and_the_law_settles_sooner():
    """Twelve starts in gusts of 5 %; the table of docs/guidance.md has a thousand."""
    laws = {name: LAWS[name] for name in ("optimal", "l1")}
    seen = []
    shared = campaign(laws, point_mass, STARTS, workers=2, limit_s=200.0)
    alone = campaign(laws, point_mass, STARTS[:2], workers=1, limit_s=200.0, progress=lambda *n: seen.append(n))
    assert seen == [(1, 2), (2, 2)]
    for name in laws:
        # As text, since nan, the settling time of a flight that has not settled, is not equal to itself.
        assert repr(shared[name][:2]) == repr(alone[name])
    optimal_law, l1 = shared["optimal"], shared["l1"]
    one = summary(optimal_law, l1)
    assert (one.flights, one.settled, one.round_again) == (12, 12, 0)
    assert one.median_ratio < 1.15
    assert one.sooner >= 0.9
    assert one.worst_join_error_s < 0.3


def test_the_theory_flies_the_optimum():
    flown = campaign({"optimal": optimal}, kinematic, STARTS[:3], workers=1)["optimal"]
    assert all(o.settled and abs(o.settled_s - o.ideal_s) < 0.2 * o.ideal_s + 1.0 for o in flown)


def test_a_flight_that_does_not_settle_is_later_than_all():
    far = Trial(plan(Pose(-5000.0, 0.0, 90.0), Orbit(0.0, 0.0, 90.0), UAV, Wind(0.0, 0.0)), 1)
    outcomes = campaign({"optimal": optimal}, partial(point_mass, gust=0.0), [far], workers=1, limit_s=1.0)["optimal"]
    one = summary(outcomes)
    assert (one.flights, one.settled) == (1, 0)
    assert one.median_ratio == one.median_late_s == np.inf
    assert np.isnan(one.sooner)


def test_a_campaign_has_at_least_one_run():
    with pytest.raises(InvalidArgument, match=r"^runs is 0: it must be at least 1$"):
        trials(0, 1, UAV)


def test_a_seed_is_not_negative():
    for seeded in (lambda: trials(1, -1, UAV), lambda: Trial(STARTS[0].ideal, -1)):
        with pytest.raises(InvalidArgument, match=r"^seed is -1: it must be at least 0$"):
            seeded()
