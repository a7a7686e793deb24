"""What an aircraft with a limited roll rate can reach, as a nonlinear program."""

from dataclasses import replace
from math import atan, cos, pi, sin, tan

import pytest

from evidence.checks.oracle import Circle, Planar, Search
from evidence.checks.rolling import BankProfile, Rolling, _flown, fastest_roll
from evidence.checks.rolling_check import (
    AIRCRAFT,
    MISS,
    RATES_DEG_S,
    compare_with_rolling,
    guesses,
    missed,
    rolling_bound,
    scaled,
    settling_bound_s,
)
from evidence.checks.rolling_lower import lower_bound
from loiter import Aircraft, Orbit, Pose, plan
from loiter.errors import InvalidArgument
from loiter.guidance.circle import Band
from loiter.guidance.vehicle import Roll
from loiter.lab.trials.campaign import trials

# The start of the first example, 25 s away, in metres.
ENTRY = plan(Pose(-400.0, 120.0, 90.0), Orbit(0.0, 0.0, 120.0), Aircraft(22.0, max_bank_deg=45.0))


@pytest.fixture(scope="module")
def bounds():
    return list(compare_with_rolling(1, seed=3))


def test_no_aircraft_is_sooner_than_is_proved_and_each_path_can_be_flown(bounds):
    # The starts are those of the campaigns.
    assert {bound.problem.pose for bound in bounds} == {trials(1, 3, AIRCRAFT)[0].ideal.start}
    assert [bound.rate_deg_s for bound in bounds] == list(RATES_DEG_S)
    assert [bound.passed for bound in bounds] == [True] * 4
    # A path of a slower roll is one of a quicker roll too.
    assert [bound.reached_s for bound in bounds] == sorted((bound.reached_s for bound in bounds), reverse=True)


def test_the_bounds_are_close(bounds):
    """At 45 degrees a second 0.35 s are left: the circle is tight, and its sets are large."""
    for bound, closely_s in zip(bounds, (0.4, 0.03, 0.03, 0.03), strict=True):
        assert bound.planned_s + 0.3 < bound.at_least_s
        assert bound.gap_s < closely_s


def test_a_bound_that_is_too_large_is_refused(bounds):
    """That of a roll which is a tenth slower."""
    entry = trials(1, 3, AIRCRAFT)[0].ideal
    for bound in bounds[1:]:
        start, circle, slow, unit_s = scaled(entry, Roll(0.0, 0.9 * bound.rate_deg_s))
        assert not replace(bound, at_least_s=unit_s * lower_bound(start, circle, slow)).passed


def test_a_known_path_is_taken_where_no_faster_one_is_found(bounds):
    slow = bounds[0].path._replace(time=0.0)
    assert rolling_bound(trials(1, 3, AIRCRAFT)[0].ideal, 150.0, slow).path == slow


def test_the_quicker_the_roll_the_nearer_the_plan():
    """From level to 45 degrees takes 0.009 s at 5000 degrees a second, and a reversal twice that."""
    assert 0.0 < rolling_bound(ENTRY, 5000.0).later_s < 0.02


def test_it_is_no_slower_than_rolling_out_of_the_hold_backwards():
    """A path that is known: straight, then a roll at the largest rate into the bank of the hold."""
    roll, circle = Rolling(pi / 4, 2.0), Circle(2.0, clockwise=False)
    hold = atan(tan(roll.limit) / circle.radius)
    into = BankProfile((0.0, 0.0, *(hold * k / 8 for k in range(1, 9))), (3.0, *(hold / roll.rate / 8,) * 8))
    *_, end = _flown(Planar(0.0, 0.0, 0.0), into, roll)
    # Moved and turned so that it ends at the circle's easternmost point, heading north.
    ends = Planar(circle.radius, 0.0, pi / 2)
    angle = ends.angle - end.angle
    turned = complex(end.east, end.north) * complex(cos(angle), sin(angle))
    start = Planar(ends.east - turned.real, ends.north - turned.imag, angle)
    known = sum(into.lengths)
    path = fastest_roll(start, circle, roll, [[(0.0, 3.0), (0.5, known - 3.0)]])
    assert Search(1.0).shortest(start, circle, joins=32).length <= path.time <= known + 1e-7


def test_the_band_is_entered_before_the_circle_is_joined_and_a_lag_costs_time():
    band = Band(0.05, 5.0)
    settled_s, with_lag_s = (settling_bound_s(ENTRY, Roll(time_s, 60.0), band) for time_s in (0.0, 0.5))
    joined_s = rolling_bound(ENTRY, 60.0).reached_s
    assert joined_s - 1.5 < settled_s < joined_s
    assert settled_s < settling_bound_s(ENTRY, Roll(0.0, 60.0), Band(0.01, 1.0)) < joined_s
    assert settled_s < with_lag_s < settled_s + 1.5


def wrong_paths(start, circle, roll, path):
    """Paths of programs that forget a condition: the rate, the level wings at the start, the bank of the hold."""
    banks, lengths = path.profile
    yield "rate", path, roll._replace(rate=0.5 * roll.rate)
    yield "start", path._replace(profile=BankProfile((0.1, *banks[1:]), lengths)), roll
    yield "hold", path._replace(profile=BankProfile((*banks[:-1], 0.0), lengths)), roll
    yield "limit", path, roll._replace(limit=0.9 * roll.limit)
    yield "end", path._replace(profile=BankProfile(banks, (2.0 * lengths[0], *lengths[1:]))), roll


def test_paths_that_cannot_be_flown_are_noticed():
    start, circle, roll, _ = scaled(ENTRY, Roll(0.0, 60.0))
    path = fastest_roll(start, circle, roll, guesses(ENTRY))
    assert missed(start, circle, roll, path) < MISS
    found = {
        name: missed(start, circle, limits, wrong) > 100.0 * MISS
        for name, wrong, limits in wrong_paths(start, circle, roll, path)
    }
    assert found == dict.fromkeys(found, True)


def test_bad_input():
    with pytest.raises(InvalidArgument, match="cases is 0: it must be at least 1"):
        compare_with_rolling(0, seed=0)
