"""Certificates of entries into slots, and of arrivals at a time: plans have valid ones, wrong maneuvers have none."""

import json
from collections import Counter
from dataclasses import replace
from math import degrees, tau
from pathlib import Path
from random import Random

import numpy as np
import pytest

from certificate.certificates import altered, certified
from certificate.slot_certificates import UAV, later_roots, scene, stays_in_slot, wrong_ones
from kernel.slots import fold_scenes, random_scenes
from loiter import Aircraft, Orbit, Pose, Slot, Turn, Wind, plan, plan_at
from loiter.certificate import certify, certify_arrival, certify_slot
from loiter.errors import ImpossibleTime, InvalidArgument
from loiter.kernel.rounding import ROUNDING
from loiter.planning.problem import problem_of

POSE, ORBIT = Pose(-400.0, 120.0, 90.0), Orbit(0.0, 0.0, 120.0)
AIRCRAFT, SLOT = Aircraft(18.0, max_bank_deg=35.0), Slot(200.0)
WINDS = [None, Wind(8.0, 250.0)]


@pytest.mark.parametrize("windy", [False, True])
def test_plans_have_valid_certificates_and_wrong_maneuvers_none(windy):
    scenes, random, refused = random_scenes(np.random.default_rng(11), 3, windy), Random(4), Counter()
    for i in range(3):
        problem, slot = scene(scenes, i)
        certified(certify_slot(plan(problem.pose, problem.orbit, UAV, problem.wind, slot=slot), slot))
        for kind, wrong, where in wrong_ones(random, problem, slot):
            if kind != "duration" or not stays_in_slot(wrong):
                assert not certify_slot(wrong, where).valid, (kind, wrong)
                refused[kind] += 1
    assert min(refused[kind] for kind in ("later root", "word", "phase", "duration")) >= 2


def test_next_to_a_jump_samples_decide_and_the_row_says_so():
    scenes = fold_scenes(np.random.default_rng(3), 2, windy=False, width=1e-6)
    notes = []
    for i in range(2):
        problem, slot = scene(scenes, i)
        certificate = certified(certify_slot(plan(problem.pose, problem.orbit, UAV, problem.wind, slot=slot), slot))
        notes.append(certificate.residual("first").note)
    assert any("by samples from" in note for note in notes)


@pytest.mark.parametrize("wind", WINDS)
def test_a_later_arrival_is_an_extremal_that_only_the_independent_check_refuses(wind):
    orbit = replace(ORBIT, turn=Turn.CCW)
    best, found = plan(POSE, orbit, AIRCRAFT, wind, slot=SLOT), Counter()
    for other in later_roots(problem_of(best), SLOT):
        if other.duration_s > best.duration_s + 0.5:
            certificate = certify_slot(other, SLOT)
            found[tuple(residual.name for residual in certificate.failed)] += 1
            assert certificate.residual("first").failed
            # The check stops where the fastest plan arrives.
            assert certificate.clear_s == pytest.approx(best.duration_s, abs=1e-3)
    assert found["first",] >= 1


@pytest.mark.parametrize("wind", WINDS)
def test_the_slower_direction_is_refused_where_either_is_allowed(wind):
    fast = plan(POSE, ORBIT, AIRCRAFT, wind, slot=SLOT)
    slow = plan(POSE, replace(ORBIT, turn=fast.turn.other), AIRCRAFT, wind, slot=SLOT)
    assert certify_slot(slow, SLOT).valid
    assert {r.name for r in certify_slot(replace(slow, orbit=ORBIT), SLOT).failed} == {"first"}
    assert [other.word for other in certify_slot(fast, SLOT).others] == [slow.word]


@pytest.mark.parametrize("wind", WINDS)
def test_a_slot_given_at_another_time_is_the_same(wind):
    m = plan(POSE, ORBIT, AIRCRAFT, wind, slot=Slot(200.0, at_s=-1000.0))
    assert certify_slot(m, Slot(200.0, at_s=-1000.0)).valid
    refused = certify_slot(m, Slot(200.0, at_s=-1000.0 + 1e-5))
    assert {"target"} <= {r.name for r in refused.failed}


@pytest.mark.parametrize("wind", WINDS)
def test_a_slot_given_long_before_or_after_is_as_exact_as_that_time(wind):
    for at_s in (1e4, -2e4, 1e5, -1e6):
        m = plan(POSE, ORBIT, AIRCRAFT, wind, slot=Slot(200.0, at_s))
        certified(certify_slot(m, Slot(200.0, at_s)))
        assert not certify_slot(m, Slot(200.0, at_s + 6.0 * ROUNDING * abs(at_s))).valid


def test_a_third_arc_longer_than_the_middle_one_violates_the_maximum_principle():
    problem, slot = scene(random_scenes(np.random.default_rng(2), 40, windy=False), 4)
    for other in later_roots(problem, slot):
        first, middle, last = ([s.duration_s for s in other.segments] + [0.0, 0.0])[:3]
        if other.word in ("LRL", "RLR") and max(first, last) > middle + 0.1:
            assert {"sign", "slot"} & {r.name for r in certify_slot(other, slot).failed}
            return
    raise AssertionError("no such root")


def test_a_start_in_the_slot_has_nothing_to_fly():
    orbit = replace(ORBIT, turn=Turn.CCW)
    m = plan(Pose(120.0, 0.0, 0.0), orbit, AIRCRAFT, slot=Slot(90.0))
    assert certified(certify_slot(m, Slot(90.0))).lam is None


def test_json_and_text_say_that_it_is_not_proved():
    certificate = certify_slot(plan(POSE, ORBIT, AIRCRAFT, slot=SLOT), SLOT)
    values = json.loads(json.dumps(certificate.to_dict()))
    assert not values["proved_optimal"]
    assert "cross-checked" in values["basis"]
    assert values["slot"] == {"phase_deg": 200.0, "at_s": 0.0}
    assert "is cross-checked by an independent method" in str(certificate)


@pytest.mark.parametrize("wind", WINDS)
def test_an_arrival_at_a_time_is_certified_for_its_place_and_time_alone(wind):
    m = plan_at(POSE, ORBIT, AIRCRAFT, wind, time_s=60.0, bearing_deg=200.0)
    certificate = certified(certify_arrival(m, time_s=60.0, bearing_deg=200.0))
    assert not certificate.proved_optimal
    assert "No least time is claimed" in str(certificate)
    assert any(a <= 60.0 <= b for a, b in certificate.possible_s)
    for wrong in (
        certify_arrival(m, time_s=60.0 + 1e-6, bearing_deg=200.0),
        certify_arrival(m, time_s=60.0, bearing_deg=200.00001),
        certify_arrival(altered(m, 0, 1e-6), time_s=60.0, bearing_deg=200.0),
        certify_arrival(bent(m, 1.0 + 1e-6), time_s=60.0, bearing_deg=200.0),
    ):
        assert not wrong.valid


def random_arrival(random):
    """An arrival at random after up to a million times the time of a turn radius, its time and bearing."""
    w = random.choice([0.0, random.uniform(0.0, 0.9)])
    R = (1.0 + w) ** 2 * random.choice([1.0 + 1e-9, 10.0 ** random.uniform(0.0, 3.0)])
    span = 50.0 * R * random.choice([1.0, 30.0])
    pose = Pose(random.uniform(-span, span), random.uniform(-span, span), random.uniform(0.0, 360.0))
    orbit, wind = Orbit(0.0, 0.0, 50.0 * R, random.choice(list(Turn))), Wind(w * 18.0, random.uniform(0.0, 360.0))
    time_s, bearing_deg = 10.0 ** random.uniform(1.0, 6.4), random.uniform(0.0, 360.0)
    try:
        return plan_at(pose, orbit, UAV, wind, time_s=time_s, bearing_deg=bearing_deg), time_s, bearing_deg
    except ImpossibleTime as e:
        return plan_at(pose, orbit, UAV, wind, time_s=e.next_s, bearing_deg=bearing_deg), e.next_s, bearing_deg


def test_arrivals_after_a_long_way_are_exact_and_forged_ones_are_refused():
    """The longer the way, the less exactly an angle gives its length: the first one was late by 17 times its bound."""
    pose, orbit = Pose(30.0, -35.0, 198.0), Orbit(0.0, 0.0, 50.0, Turn.CW)
    m = plan_at(pose, orbit, UAV, time_s=1519.0, bearing_deg=107.0)
    drawn, random = [(m, 1519.0, 107.0)], Random(6)
    drawn += [random_arrival(random) for _ in range(40)]
    for m, time_s, bearing_deg in drawn:
        target = certified(certify_arrival(m, time_s=time_s, bearing_deg=bearing_deg)).residual("target")
        moved_s, longest = 3.0 * ROUNDING * (time_s + 50.0 / 18.0), max(m.segments, key=lambda s: s.duration_s)
        moved_deg, which = degrees(3.0 * target.bound * 50.0 / m.orbit.radius_m), m.segments.index(longest)
        forged = [(m, time_s + moved_s, bearing_deg), (m, time_s, bearing_deg + moved_deg)]
        forged += [(altered(m, which, by_s), time_s, bearing_deg) for by_s in (moved_s, -moved_s, -tau * 50.0 / 18.0)]
        for wrong, at_s, where_deg in forged:
            assert not certify_arrival(wrong, time_s=at_s, bearing_deg=where_deg).valid


def bent(m, factor):
    first, *rest = m.segments
    return replace(m, segments=(replace(first, curvature_per_m=first.curvature_per_m * factor), *rest))


def test_the_gap_of_a_prescribed_time_is_said():
    pose, orbit = Pose(120.0, -60.0, 0.0), Orbit(0.0, 0.0, 120.0, "ccw")
    m = plan_at(pose, orbit, AIRCRAFT, time_s=20.0, bearing_deg=90.0)
    (first, second) = certify_arrival(m, time_s=20.0, bearing_deg=90.0).possible_s
    assert first[1] == pytest.approx(3.392, abs=1e-3)
    assert second[0] == pytest.approx(19.804, abs=1e-3)


def test_a_wide_turn_is_named_as_the_cause():
    m = plan_at(POSE, ORBIT, AIRCRAFT, time_s=60.0, bearing_deg=200.0)
    for check in (certify, lambda wide: certify_slot(wide, SLOT)):
        with pytest.raises(InvalidArgument, match=r"has a turn of \d+.*wider than the tightest.*certify_arrival"):
            check(m)


def test_the_document_has_a_row_for_each_condition_of_a_slot():
    section = Path("docs/certificate.md").read_text(encoding="utf-8").partition("## Slots")[2]
    cells = [line.split(" | ")[:2] for line in section.splitlines() if line.startswith("| ")]
    listed = {name: equation for names, equation in cells for name in names.strip("| ").split(", ")}
    for residual in certify_slot(plan(POSE, ORBIT, AIRCRAFT, slot=SLOT), SLOT).residuals:
        assert listed[residual.name] in (f"`{residual.equation}`", "as in wind")
