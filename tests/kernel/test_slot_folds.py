"""First arrivals at folds, found by Newton's method (`python -m kernel.slot_folds`): a fold of each kind."""

import pytest

from kernel.slot_bounds import worst_shares
from kernel.slot_folds import BESIDE, MOVED, distance_at, scenes_of, times_beside
from kernel.slots import least_times
from loiter.kernel.wind.wind_search import WindProblem

R = 1.0 + 1e-12

# Outer controls and half turns of the middle arc (None: straight); place, heading and side; phase, width and time.
FOLDS = [
    (
        (1, 1, 0),
        (0.5696638779313652, -1.0312451363779338, 0.6047161662308528, -0.7964410576427232, R, -1),
        (3.6837879225074834, 5.804824209384754, 5.804824209390559),
    ),
    (
        (1, 1, 1),
        (-0.641306413080729, 2.3442941086674147, 0.024016083518374726, -0.9997115722709418, R, -1),
        (5.309897247965514, 1.7518646413032954, 1.751864641305053),
    ),
    (
        (-1, -1, 0),
        (0.7137238845087864, 1.2805860020827673, -0.7393839363314844, 0.6732840371603649, R, 1),
        (3.375924261220065, 5.739086532403584, 5.739086532409322),
    ),
    (
        (-1, -1, 1),
        (-1.6258013993937508, 3.116009616101875, 0.3366646829916588, -0.9416246020714019, R, 1),
        (-0.5927410513305555, 3.3189067019904446, 3.318906701993764),
    ),
    (
        (1, -1, None),
        (2.1520874380086368, -2.302698280429043, -0.9998267127436242, -0.01861570531240323, R, -1),
        (6.92183904045799, 3.2394282438972932, 3.239428243900533),
    ),
    (
        (-1, 1, None),
        (1.105311664952927, 0.8658622668541567, -0.25023755981471224, -0.968184467783892, R, 1),
        (3.8254579902141366, 0.7242170050312055, 0.7242170050319298),
    ),
]


@pytest.mark.parametrize(("kind", "start", "fold"), FOLDS, ids=[str(kind) for kind, _, _ in FOLDS])
def test_the_kernel_arrives_at_a_fold_and_not_beyond_it(kind, start, fold):
    problem, (phase, width, time) = WindProblem(*start, 0.0, 0.0, 0.0), fold
    near, beyond = sorted(times_beside(problem, phase))
    # Next to a double root the arrival moves by the square root of the slot's displacement.
    assert near == pytest.approx(time, abs=10.0 * BESIDE**0.5)
    assert beyond > time + 5.0 * MOVED
    # The slot touches the reachable set there, and Buzikov's steps do not pass it.
    assert distance_at(problem, phase, width) < 1e-12
    begin, _, _ = least_times(scenes_of(problem, phase), 200)
    assert begin[0] < time + 1e-6


@pytest.mark.parametrize("windy", [False, True])
def test_no_step_is_longer_than_its_bound_allows(windy):
    second, speed = worst_shares(2, windy, 5)
    # The searches get close to the bounds, and not beyond them.
    assert 0.5 < second < 1.0 + 1e-5
    assert 0.5 < speed < 1.0 + 1e-9
