"""Arrays of states: the same answers as one by one, nan and codes where there is none."""

from math import inf, nan

import numpy as np
import pytest

import loiter
from golden.paper import EXAMPLES
from loiter import Aircraft, Orbit, Pose, plan
from loiter.errors import InvalidArgument
from loiter.kernel.codes import Side, Status, Word
from loiter.kernel.synthesis import duration, first_control, miss, optimum

RANDOM = np.random.default_rng(7)
X, Y = RANDOM.uniform(-12.0, 12.0, (2, 3000))
R = RANDOM.choice([1.0, 1.0 + 1e-6, 1.5, 2.0, 4.0, 9.0], 3000)
TURNS = RANDOM.choice(["cw", "ccw", "either"], 3000)
SIDES = {"cw": Side.CW, "ccw": Side.CCW, "either": Side.EITHER}
MANEUVERS = [optimum(x, y, q, SIDES[t], 0.0) for x, y, q, t in zip(X, Y, R, TURNS, strict=True)]


def test_arrays_give_what_the_scalar_functions_give():
    solution = loiter.solve(X, Y, R, TURNS)
    assert solution.time == pytest.approx([duration(m) for m in MANEUVERS], abs=1e-13, rel=0.0)
    assert solution.durations == pytest.approx(np.array([m[2:] for m in MANEUVERS]), abs=1e-13, rel=0.0)
    assert solution.word.tolist() == [m[1] for m in MANEUVERS]
    assert solution.side.tolist() == [m[0] for m in MANEUVERS]
    assert np.all(solution.status == Status.OK)
    assert solution.miss == pytest.approx(
        [miss(x, y, q, m) for x, y, q, m in zip(X, Y, R, MANEUVERS, strict=True)], abs=1e-13
    )
    assert np.array_equal(loiter.min_time(X, Y, R, TURNS), solution.time)
    expected = [first_control(x, y, q, SIDES[t], 0.0) for x, y, q, t in zip(X, Y, R, TURNS, strict=True)]
    assert loiter.control(X, Y, R, TURNS).tolist() == expected


@pytest.mark.parametrize("case", EXAMPLES, ids=lambda case: case.name)
def test_the_papers_examples(case):
    assert loiter.min_time(case.x, case.y) == pytest.approx(case.time, abs=1e-12, rel=0.0)
    solution = loiter.solve(case.x, case.y)
    assert Word(solution.word).letters == case.words[0]
    assert solution.durations == pytest.approx(case.durations, abs=1e-12, rel=0.0)


def test_arguments_broadcast():
    times = loiter.min_time(np.zeros((4, 1)), np.ones(3), radius=2.0, turn="cw")
    assert times.shape == (4, 3)
    assert loiter.solve(np.zeros((4, 1)), np.ones(3)).durations.shape == (4, 3, 3)
    assert np.ndim(loiter.min_time(0.0, 1.0)) == 0


@pytest.mark.parametrize(
    ("x", "y", "radius", "tolerance", "status"),
    [
        (nan, 0.0, 1.0, 0.0, Status.NOT_FINITE),
        (0.0, inf, 1.0, 0.0, Status.NOT_FINITE),
        (0.0, 0.0, 0.5, 0.0, Status.RADIUS_TOO_SMALL),
        (1e17, 0.0, 1.0, 0.0, Status.OUT_OF_RANGE),
        (0.0, 0.0, 1.0, -1.0, Status.BAD_TOLERANCE),
    ],
)
def test_a_bad_state_gives_nan_and_spoils_no_neighbour(x, y, radius, tolerance, status):
    solution = loiter.solve([x, 4.0], [y, 4.0], [radius, 1.0], "cw", [tolerance, 0.0])
    assert solution.status.tolist() == [status, Status.OK]
    assert np.isnan(solution.time[0])
    assert np.isnan(solution.durations[0]).all()
    assert np.isnan(solution.miss[0])
    assert solution.word[0] == Word.EMPTY
    assert solution.time[1] == pytest.approx(EXAMPLES[0].time)
    assert np.isnan(loiter.control([x], [y], radius, "cw", tolerance)).all()


@pytest.mark.parametrize("turn", ["left", ["cw", "up"], 3, None])
def test_an_unknown_turn_is_refused(turn):
    with pytest.raises(InvalidArgument, match="it must be cw, ccw or either"):
        loiter.min_time([0.0, 1.0], 0.0, 1.0, turn)


def test_an_empty_array_stays_empty():
    assert loiter.min_time([], []).shape == (0,)
    assert loiter.solve([], []).durations.shape == (0, 3)


def test_reduce_agrees_with_planning_one_by_one():
    uav, orbit = Aircraft(18.0, max_bank_deg=35.0), Orbit(100.0, -40.0, 80.0)
    east, north = RANDOM.uniform(-500.0, 500.0, (2, 50))
    heading = np.concatenate([RANDOM.uniform(-720.0, 720.0, 46), [0.0, 90.0, 180.0, 270.0]])
    x, y = loiter.reduce(east, north, heading, orbit, uav)
    seconds = uav.turn_radius_m / uav.airspeed_m_s
    times = loiter.min_time(x, y, orbit.radius_m / uav.turn_radius_m) * seconds
    expected = [plan(Pose(*pose), orbit, uav).duration_s for pose in zip(east, north, heading, strict=True)]
    assert times == pytest.approx(expected, abs=1e-9)


def test_reduce_is_the_position_seen_along_the_heading():
    uav, orbit = Aircraft(1.0, min_turn_radius_m=2.0), Orbit(10.0, 20.0, 4.0)
    # 6 m north of the centre, flying east: 3 turn radii to the left. Flying north: 3 ahead.
    assert loiter.reduce(10.0, 26.0, 90.0, orbit, uav) == (0.0, 3.0)
    assert loiter.reduce(10.0, 26.0, 0.0, orbit, uav) == (3.0, 0.0)
    assert loiter.reduce(10.0, 26.0, 270.0, orbit, uav) == (0.0, -3.0)


def test_a_circle_as_tight_as_the_aircraft_turns_is_solved_in_spite_of_rounding():
    uav = Aircraft(15.0, max_turn_rate_deg_s=53.0)
    orbit = Orbit(0.0, 0.0, 15.0 * 180.0 / (np.pi * 53.0))
    R = orbit.radius_m / uav.turn_radius_m
    assert R == 1.0 - 2.0**-53 or R <= 1.0
    pose = (90.0, 60.0, 100.0)
    seconds = uav.turn_radius_m / uav.airspeed_m_s
    time = loiter.min_time(*loiter.reduce(*pose, orbit, uav), R) * seconds
    assert time == pytest.approx(plan(Pose(*pose), orbit, uav).duration_s, rel=1e-12)


def test_an_endless_tolerance_is_refused():
    assert loiter.solve(4.0, 4.0, 1.0, "cw", inf).status == Status.BAD_TOLERANCE
