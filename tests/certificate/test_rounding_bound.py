"""What certificates quote of theorems 5 and 6 of bridging.md, beside 154 digits, and where they quote nothing."""

from math import nextafter, sqrt
from random import Random

import pytest

pytest.importorskip("flint")

from evidence.campaigns import bridging
from evidence.campaigns.bridging import Answer, Case
from loiter import Aircraft, Orbit, Pose, Wind, candidates, plan
from loiter.certificate import certify
from loiter.certificate.rounding_bound import (
    BY_THEOREMS,
    LATE,
    LATE_BEYOND,
    LATE_OF_LRL,
    MISS,
    MISS_OF_LRL,
    NOT_CLAIMED,
    NOT_PLANNED,
    rounding_bound,
    units_at,
)
from loiter.kernel.words import Word
from loiter.planning.model import SIDES
from loiter.planning.problem import problem_of

# R = 1, past the switching curve by an arc that counts as none: late by 21.5 units.
PAST_THE_CURVE = Case(0.03302678726138515, 0.026673956063606785, 1.0, 1, "switching curve")
TURNS = {1: "cw", -1: "ccw", 0: "either"}


def scene(case):
    return Pose(case.x, case.y, 90.0), Orbit(0.0, 0.0, case.R, TURNS[case.turn]), Aircraft(1.0, min_turn_radius_m=1.0)


def answer_of(maneuver):
    """The durations of a maneuver of an aircraft of speed 1 and turn radius 1, and its word as the kernel has it."""
    word = Word[maneuver.word] if maneuver.word else Word.EMPTY
    durations = [segment.duration_s for segment in maneuver.segments]
    t1, t2, t3 = [*durations, 0.0, 0.0, 0.0][:3]
    return Answer(int(SIDES[maneuver.turn]), int(word), (t1, t2, t3), maneuver.duration_s)


def holds(case, maneuver, delta_m, epsilon_s):
    """Whether a maneuver ends within delta and is late by at most epsilon."""
    errors, unit = bridging.errors_of(case, answer_of(maneuver)), bridging.unit(case.x, case.y, case.R)
    return errors.miss * unit <= delta_m and errors.late * unit <= epsilon_s


def bound(maneuver):
    return rounding_bound(maneuver, problem_of(maneuver), True)


def test_plans_of_adversarial_doubles_respect_what_is_quoted():
    random = Random(3)
    cases = [*bridging.ONCE_WRONG, PAST_THE_CURVE, *double_roots(30), *(bridging.drawn(random) for _ in range(400))]
    for case in cases:
        maneuver = plan(*scene(case))
        found = bound(maneuver)
        assert found.basis == BY_THEOREMS
        assert holds(case, maneuver, found.delta_m, found.epsilon_s), case


def test_bounds_that_are_too_small_are_refused():
    maneuver = plan(*scene(PAST_THE_CURVE))
    found = bound(maneuver)
    assert holds(PAST_THE_CURVE, maneuver, found.delta_m, found.epsilon_s)
    assert not holds(PAST_THE_CURVE, maneuver, found.delta_m, 1e-3 * found.epsilon_s)
    assert not holds(PAST_THE_CURVE, maneuver, 1e-3 * found.delta_m, found.epsilon_s)


def test_the_double_below_the_largest_radius_of_lrl_is_one_of_lrl():
    """1 + sqrt(3) as a double is below the number: at (0, 2 - R) the first arc of LRL ends where its second begins."""
    R = 1.0 + sqrt(3.0)
    assert units_at(0.0, 2.0 - R, R).delta == MISS_OF_LRL
    assert units_at(0.0, 2.0 - R, nextafter(R, 3.0)).delta == MISS


def test_states_that_may_be_states_of_lrl_have_its_bounds():
    """Next to D = 0, on either side, and next to r_p = 3 - R; elsewhere the others, which are smaller."""
    assert units_at(0.0, 0.5, 1.5) == (MISS_OF_LRL, LATE_OF_LRL)
    assert units_at(0.0, 0.625, 1.5) == (MISS, LATE)
    assert units_at(0.6, -0.2, 2.5) == units_at(0.0, -2.5, 4.5) == (MISS, LATE)
    assert units_at(0.0, 0.0, 2.0**45) == (MISS, LATE_BEYOND)
    found = [units_at(case.x, case.y, case.R) for case in double_roots(30)]
    assert all(one == (MISS_OF_LRL, LATE_OF_LRL) for one in found)
    x, y, R = 0.0, 0.25, 1.0
    assert lrl_discriminant(x, -0.2, R) < 0.0
    assert units_at(x, -0.2, R) == (MISS, LATE)
    assert lrl_discriminant(x, y, R) > 0.0
    assert units_at(x, y, R) == (MISS_OF_LRL, LATE_OF_LRL)


def test_certificates_quote_the_bounds_in_metres_and_seconds():
    maneuver = plan(Pose(-400.0, 120.0, 90.0), Orbit(0.0, 0.0, 80.0), Aircraft(20.0, min_turn_radius_m=50.0))
    certificate = certify(maneuver)
    unit = 2.0**-52 * (1.0 + 8.0 + 2.4 + 1.6)
    assert certificate.rounding.delta_m == pytest.approx(256 * 50.0 * unit, rel=0.02)
    assert certificate.rounding.epsilon_s == pytest.approx(256 * 2.5 * unit, rel=0.02)
    values = certificate.to_dict()
    assert (values["delta_m"], values["epsilon_s"], values["rounding"]) == certificate.rounding
    assert "In doubles: it ends within" in str(certificate)


def test_nothing_is_quoted_where_the_theorems_do_not_hold():
    here = Pose(-0.53, 0.31, 90.0), Orbit(0.0, 0.0, 1.0), Aircraft(1.0, min_turn_radius_m=1.0)
    *_, slowest = candidates(*here)
    windy = certify(plan(*here[:1], Orbit(0.0, 0.0, 3.0), here[2], Wind(0.2, 90.0)))
    for certificate in (certify(slowest), windy):
        assert certificate.rounding == (None, None, NOT_CLAIMED)
        assert certificate.to_dict()["epsilon_s"] is None
        assert "In doubles" not in str(certificate)
    tie = plan(Pose(3.0, 0.0, 90.0), Orbit(0.0, 0.0, 1.0, "cw"), here[2])
    other = next(m for m in candidates(Pose(3.0, 0.0, 90.0), Orbit(0.0, 0.0, 1.0), here[2]) if m.turn != tie.turn)
    assert bound(other).basis == NOT_PLANNED
    assert f"How much rounding may add is {NOT_PLANNED}" in str(certify(other))


def lrl_discriminant(x, y, R):
    """D of word 5 of docs/theory.md, over 3 g^2; negative where LRL has no root."""
    k, K = x * x + y * (y + 2.0), R * (R + 2.0)
    h, d = 0.5 * (K + k), 0.25 * (K - k)
    return h * h - 3.0 * d * d


def double_roots(count):
    """States where the two roots of LRL meet but for rounding."""
    random, found = Random(1), []
    while len(found) < count:
        R = random.uniform(1.1, 2.6)
        _, x, y = bridging.double_root(random, R)
        if abs(lrl_discriminant(x, y, R)) < 1e-13:
            found.append(Case(x, y, R, 1, "double root"))
    return found
