"""Lower bounds on clear entries: below what is found, near it, and wrong ones are refused."""

from math import inf, pi, tau

import numpy as np
import pytest

from fences.brute import WORDS, blocked_scene, lengths, samples
from loiter.fences import entry_bound, word_bounds
from loiter.fences.airs import Pose2, SteadyWind, StillAir
from loiter.planning.problem import Problem

# Scenes of `python -m fences.bounds`: the fastest entry without a fence, the clear one that is found, and a time that
# no clear entry is faster than, seconds.
STILL = {14: (15.74, 22.1316, 22.13), 21: (12.98, 13.4523, 13.45), 23: (14.41, 14.8433, 14.84)}
WINDY = {19: (17.56, 18.6546, 18.64), 23: (16.60, 17.1172, 17.07)}
SCENES = [(k, False) for k in STILL] + [(k, True) for k in WINDY]


@pytest.fixture(scope="module")
def scenes():
    return {(k, windy): blocked_scene(np.random.default_rng([0, k]), windy=windy) for k, windy in SCENES}


def bound_s(maneuver, fence, margin_m, most_s):
    """The bound, seconds, if no clear entry faster than `most_s` is sought."""
    problem = Problem(maneuver.start, maneuver.orbit, maneuver.aircraft, maneuver.wind)
    air = StillAir(fence, problem, margin_m, []) if problem.still else SteadyWind(fence, problem, margin_m)
    unit_s = problem.time_unit_s
    return entry_bound.least_length(fence, problem, margin_m, air, most_s / unit_s) * unit_s


def test_parts_of_far_apart_numbers_are_bounded(scenes):
    """A circle a million kilometres away had 4.4 million times of arrival for each part of a curve."""
    maneuver, fence, margin_m = scenes[19, True]
    problem = Problem(maneuver.start, maneuver.orbit, maneuver.aircraft, maneuver.wind)
    air = SteadyWind(fence, problem, margin_m)
    parts = entry_bound._Search(fence, problem, margin_m, air, 2e7).first_parts()
    assert parts.time.size <= 60 * entry_bound.MOST_PARTS
    assert entry_bound._Search(fence, problem, margin_m, air, 400.0).first_parts().half_time[0] <= 2.0


def times(k, windy):
    return (WINDY if windy else STILL)[k]


@pytest.mark.parametrize(("k", "windy"), SCENES)
def test_it_is_above_the_fastest_entry_and_below_the_one_found(k, windy, scenes):
    fastest_s, found_s, least_s = times(k, windy)
    bound = bound_s(*scenes[k, windy], 1.2 * found_s)
    assert fastest_s < least_s < bound <= found_s


def test_no_entry_is_known_not_to_exist():
    """Each word from the start enters a zone before it touches anything."""
    assert bound_s(*blocked_scene(np.random.default_rng([0, 7])), inf) == inf


Search = entry_bound._Search


def changed(name, change):
    """A method of the search whose result is changed."""
    method = getattr(Search, name)
    return Search, name, lambda self, *arguments: change(method(self, *arguments))


def some_curves(chosen):
    curves_of = entry_bound.curves_of
    return entry_bound, "curves_of", lambda *arguments: [curve for curve in curves_of(*arguments) if chosen(curve)]


def only_short_arcs():
    arc = word_bounds._arc

    def wrong(angle, half, is_long):
        low, high = arc(angle, half, is_long)
        return np.where(is_long == 1, inf, low), high

    return word_bounds, "_arc", wrong


def one_larger_margin():
    begin = Search.__init__
    return (
        Search,
        "__init__",
        lambda self, fence, problem, margin_m, *more: begin(self, fence, problem, 2.0 * margin_m + 1.0, *more),
    )


def exact_places():
    passed = entry_bound.places_passed
    return (
        entry_bound,
        "places_passed",
        lambda *arguments: passed(*arguments)._replace(off=np.zeros_like(passed(*arguments).off)),
    )


def exact_times():
    return (
        Search,
        "_in_the_air",
        lambda self, parts, poses: poses._replace(x=poses.x - self._wx * parts.time, y=poses.y - self._wy * parts.time),
    )


WRONG = {
    "arcs of more than half a turn are left out": (only_short_arcs, (21, False)),
    "entries that touch nothing are left out": (lambda: some_curves(lambda curve: not curve.joined), (21, False)),
    "corners and circles are not touched": (
        lambda: some_curves(lambda curve: curve.joined or curve.width == 0.0),
        (14, False),
    ),
    "what is left is too long by 2 %": (lambda: changed("_onward", lambda least: 1.02 * least), (14, False)),
    "the margin is too large": (one_larger_margin, (14, False)),
    "paths to a part are taken for one": (exact_places, (14, False)),
    "curves are passed in one direction": (
        lambda: changed("first_parts", lambda parts: parts.take(parts.way > 0)),
        (23, True),
    ),
    "times of arrival are taken for one": (exact_times, (23, True)),
}


@pytest.mark.parametrize("wrong", WRONG)
def test_wrong_bounds_are_refused(wrong, scenes, monkeypatch):
    build, scene = WRONG[wrong]
    found_s = times(*scene)[1]
    monkeypatch.setattr(*build())
    assert bound_s(*scenes[scene], 1.2 * found_s) > found_s + 1e-3


def kinds_of(name, pieces):
    """The word of a path as `word_bounds` names it."""
    kind = word_bounds.LRL if name in ("LRL", "RLR") else word_bounds.LSL if name[0] == name[2] else word_bounds.LSR
    return kind, 1.0 if name[0] == "L" else -1.0, int(pieces[0] > pi), int(pieces[2] > pi)


def test_bounds_of_words_hold_for_poses_near_others():
    """Words by the formulas of brute force, flown by its samples."""
    rng, start = np.random.default_rng(32), Pose2(0.3, -0.2, 0.7)
    began = complex(start.x, start.y), np.exp(1j * start.heading)
    for _ in range(60):
        middle, moved, turned = rng.normal(0.0, 3.0, 3), *rng.uniform(0.0, 0.3, 2)
        place = complex(*middle[:2]) + moved * rng.uniform(0.0, 1.0) * np.exp(1j * rng.uniform(0.0, tau))
        heading = middle[2] + turned * rng.uniform(-1.0, 1.0)
        table = lengths(began, (np.array([place]), np.array([np.exp(1j * heading)])), 1.0)[:, 0]
        for name, pieces in zip(WORDS, table, strict=True):
            if not np.isfinite(pieces).all():
                continue
            words = word_bounds.Words(*(np.array([value]) for value in kinds_of(name, pieces)))
            poses = word_bounds.Poses(*(np.array([value]) for value in (*middle, moved, turned)))
            bounds = word_bounds.bounds_of(start, words, poses)
            assert bounds.least[0] <= pieces.sum() + 1e-6
            assert pieces.sum() <= bounds.most[0] + 1e-6
            path = samples(began, name, pieces, 1.0, 0.0, 0.005)
            for places in (
                word_bounds.places_passed(start, words, poses, bounds, 0.0),
                word_bounds.places_before(words, poses, bounds),
            ):
                points = (places.x + 1j * places.y)[0]
                assert (abs(points[:, None] - path).min(axis=1) <= places.off[0] + 0.005).all()


@pytest.mark.parametrize(("k", "windy"), [(14, False), (23, True)])
def test_what_is_left_is_a_bound_for_each_pose_of_a_part(k, windy, scenes):
    maneuver, fence, margin_m = scenes[k, windy]
    problem = Problem(maneuver.start, maneuver.orbit, maneuver.aircraft, maneuver.wind)
    air = StillAir(fence, problem, margin_m, []) if problem.still else SteadyWind(fence, problem, margin_m)
    search = Search(fence, problem, margin_m, air, 1.0)
    parts = search.first_parts()
    parts = parts.take(np.unique(np.stack([parts.curve, parts.share, parts.way]), axis=1, return_index=True)[1])
    rng = np.random.default_rng(32)
    for _ in range(3):
        half = rng.uniform(0.0, 1.0, parts.half.size) * parts.half
        least = search._onward(parts._replace(half=half), search._poses(parts._replace(half=half)))
        inside = parts._replace(share=parts.share + half * rng.uniform(-1.0, 1.0, half.size), half=0.0 * half)
        exact = search._onward(inside, search._poses(inside))
        assert (least <= exact + 1e-9).all()
        assert (least[~search._joined[parts.curve]] > 0.0).mean() > 0.5
