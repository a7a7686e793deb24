"""Lower bounds for whole arcs of the circle: no path of a word that they exclude is earlier, and they come close."""

from math import hypot, inf, pi
from random import Random

import pytest

from compiled.windy import drawn
from kernel.slow_scenes import CORNERS, SLOW, VALLEYS
from loiter.kernel import wind_search
from loiter.kernel.wind import minimum
from loiter.kernel.wind.cell_bounds import words_inside
from loiter.kernel.wind.paths import first_path, first_path_of, join_point
from loiter.kernel.wind_search import fastest, scene_of, time_of
from loiter.kernel.words import ALL_WORDS, Word, set_of

WORDS = Word.LSL, Word.RSR, Word.LSR, Word.RSL, Word.LRL, Word.RLR
POINTS = 16


def earliest(word, phase, half, side, scene):
    """The time of the earliest of the paths of a word to points all over a cell."""
    phases = [phase + half * (2.0 * i / POINTS - 1.0) for i in range(POINTS + 1)]
    return min(first_path_of(set_of(word), one, side, scene, inf).time for one in phases)


def test_each_word_has_its_bit():
    assert sorted(map(set_of, WORDS)) == [1, 2, 4, 8, 16, 32]
    assert sum(map(set_of, WORDS)) == ALL_WORDS


@pytest.mark.parametrize(("seed", "windiest"), [(1, 0.6), (2, 0.95)])
def test_no_path_into_a_cell_is_earlier_than_the_time_for_which_its_word_is_excluded(seed, windiest):
    random, excluded, tried = Random(seed), 0, 0
    for problem in [*drawn(240, seed, windiest), *SLOW]:
        scene, side = scene_of(problem), problem.side or random.choice([1, -1])
        for _ in range(6):
            word, phase = random.choice(WORDS), random.uniform(0.0, 2.0 * pi)
            half = pi / 8 * 2.0 ** -random.randint(0, 8)
            time = earliest(word, phase, half, side, scene)
            if time < inf:
                later = time + 10.0 ** random.uniform(-7.0, 0.0)
                assert words_inside(phase, half, set_of(word), side, scene, later) != 0
                tried += 1
                excluded += words_inside(phase, half, set_of(word), side, scene, time - 0.3) == 0
    assert excluded > 0.7 * tried


def test_in_small_cells_the_bound_is_close():
    """A word that is the fastest is excluded up to a time that is earlier by the hold through a few cells."""
    random, half = Random(3), pi / 1024
    for problem in drawn(80, 3):
        scene, side, phase = scene_of(problem), problem.side or 1, random.uniform(0.0, 2.0 * pi)
        path = first_path_of(ALL_WORDS, phase, side, scene, inf)
        if min(path.t1, path.t2, path.t3) > 0.1:
            hold = half * scene.R / (1.0 - hypot(scene.wx, scene.wy))
            assert words_inside(phase, half, set_of(path.word), side, scene, path.time - 40.0 * hold) == 0


def least_of_points(problem):
    """The time of the earliest of the first paths to 360 points of the circle, and the number of their sides."""
    sides = [side for side in (1, -1) if problem.side != -side]
    scene, phases = scene_of(problem), [2.0 * pi * i / 360 for i in range(360)]
    return min(first_path_of(ALL_WORDS, phase, side, scene, inf).time for phase in phases for side in sides)


@pytest.mark.parametrize("problem", SLOW)
def test_the_slowest_scenes_found_take_a_bounded_number_of_paths(problem, monkeypatch):
    counted = []
    monkeypatch.setattr(wind_search, "first_path", lambda *point: counted.append(1) or first_path(*point))
    monkeypatch.setattr(minimum, "join_point", lambda *point: counted.append(1) or join_point(*point))
    assert time_of(fastest(problem)) <= least_of_points(problem)
    assert len(counted) < 800


@pytest.mark.parametrize(("problem", "time"), [*VALLEYS, *CORNERS])
def test_the_deeper_of_two_valleys_and_the_minimum_at_a_corner_are_found(problem, time):
    assert time_of(fastest(problem)) == pytest.approx(time, abs=1e-11)
