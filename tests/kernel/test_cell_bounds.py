"""Lower bounds for whole arcs of the circle: no path of a word that they exclude is earlier, and they come close."""

from math import hypot, inf, pi
from random import Random

import pytest

from compiled.windy import drawn
from golden.wind_scenes import BESIDE_CORNERS, CORNERS, SLOW, TWO_MINIMA, VALLEYS
from loiter.kernel.motion import fly
from loiter.kernel.wind import minimum, wind_search
from loiter.kernel.wind.cell_bounds import cell_at, centres, least_inside_curved, words_inside
from loiter.kernel.wind.corner_bounds import Corner, words_beside
from loiter.kernel.wind.hold import hold_pose
from loiter.kernel.wind.paths import WindScene, first_path, first_path_of, join_point
from loiter.kernel.wind.wind_search import fastest, scene_of, time_of
from loiter.kernel.words import ALL_WORDS, Word, encode, set_of

WORDS = Word.LSL, Word.RSR, Word.LSR, Word.RSL, Word.LRL, Word.RLR
POINTS = 16


def earliest(word, phase, half, side, scene):
    """The time of the earliest of the paths of a word to points all over a cell."""
    phases = [phase + half * (2.0 * i / POINTS - 1.0) for i in range(POINTS + 1)]
    return min(first_path_of(set_of(word), one, side, scene, inf).time for one in phases)


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
    assert len(counted) < 1200


@pytest.mark.parametrize(("problem", "time"), [*TWO_MINIMA, *BESIDE_CORNERS])
def test_next_to_ties_the_answer_is_the_least_time_up_to_rounding(problem, time):
    """Rounding of T is some 1e-15 of 1 + R + T; by the least of the differences that were found, 20 times as much."""
    assert time_of(fastest(problem)) <= time + 3e-14 * (1.0 + problem.R + time)


@pytest.mark.parametrize("seed", [1, 2])
def test_no_path_is_faster_than_two_arcs_near_their_point_of_joining_where_its_word_is_excluded(seed):
    """The start is flown backwards from the circle. Each of the three words is excluded in many of the scenes."""
    random, excluded = Random(seed), dict.fromkeys(range(3), 0)
    for problem in drawn(400, seed, 0.95):
        _, _, _, _, R, _, wx, wy, _ = problem
        side, phase, u = random.choice([1, -1]), random.uniform(0.0, 2.0 * pi), random.choice([1, -1])
        corner = Corner(phase, u, random.uniform(0.1, 2.0 * pi), random.uniform(0.1, 2.0 * pi))
        scene, time, reach = (
            start_of(corner, side, R, wx, wy),
            corner.t1 + corner.t2,
            10.0 ** random.uniform(-5.0, -0.5),
        )
        for i, word in enumerate((encode(u, 0, -u), encode(u, -u, u), encode(-u, u, -u))):
            if words_beside(corner, reach, set_of(word), side, scene) == 0:
                excluded[i] += 1
                assert earliest(word, phase, reach, side, scene) >= time - 1e-11 * (1.0 + R + time)
                near = reach * 10.0 ** random.uniform(-4.0, 0.0)
                assert earliest(word, phase, near, side, scene) >= time - 1e-11 * (1.0 + R + time)
    assert min(excluded.values()) > 50


def start_of(corner, side, R, wx, wy):
    """The scene from whose start two arcs end on the circle."""
    px, py, c, s, _ = hold_pose(corner.phase, side, R, wx, wy)
    x, y, c, s = fly(px, py, -c, -s, corner.u, corner.t2)
    x, y, c, s = fly(x, y, c, s, -corner.u, corner.t1)
    time = corner.t1 + corner.t2
    return WindScene(x - wx * time, y - wy * time, -c, -s, R, wx, wy, 1e-15)


def test_the_curvature_of_a_bound_is_that_of_the_length():
    """The derivatives in a cell by the phase, against differences; the third ones are bounded."""
    random, h = Random(4), 1e-3
    for problem in drawn(200, 4, 0.95):
        scene, side, phase = scene_of(problem), problem.side or 1, random.uniform(0.0, 2.0 * pi)
        for last in (1, -1):
            before, there, after = (cell_at(phase + d, 0.0, side, scene) for d in (-h, 0.0, h))
            a, b = centres(1, last, before), centres(1, last, after)
            around = centres(1, last, cell_at(phase, h, side, scene))
            wide = cell_at(phase, h, side, scene)
            off = wide.bend_change * h
            assert hypot((b.dx - a.dx) / (2.0 * h) - around.ddx, (b.dy - a.dy) / (2.0 * h) - around.ddy) <= off
            assert hypot(b.ddx - a.ddx, b.ddy - a.ddy) <= 2.0 * off
            assert max(hypot(a.dx, a.dy), hypot(b.dx, b.dy)) <= around.fastest
            assert abs(after.turned_more - before.turned_more) <= 2.0 * h * wide.jerk
            assert abs((after.turning - before.turning) / (2.0 * h) - there.turned_more) <= h * wide.jerk + 1e-9


def test_a_lower_bound_by_three_derivatives():
    """It is the least value of the cubic with the lowest third derivative."""
    random = Random(5)
    for _ in range(300):
        value, slope, curvature = (random.uniform(-1.0, 1.0) for _ in range(3))
        change, half = random.uniform(0.0, 5.0), random.uniform(0.1, 1.0)
        steps = [half * i / 2000 for i in range(2001)]
        least = min(value - abs(slope) * x + 0.5 * curvature * x * x - change * x * x * x / 6.0 for x in steps)
        assert least_inside_curved(value, slope, curvature, change, half) == pytest.approx(least, abs=1e-5)


@pytest.mark.parametrize(("problem", "time"), [*VALLEYS, *CORNERS])
def test_the_deeper_of_two_valleys_and_the_minimum_at_a_corner_are_found(problem, time):
    assert time_of(fastest(problem)) == pytest.approx(time, abs=1e-11)
