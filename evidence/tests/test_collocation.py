"""Plans compared with a direct collocation, which shares no code with the kernel."""

from dataclasses import replace
from itertools import pairwise

import pytest

from evidence.checks import collocation_check as module
from evidence.checks.collocation import collocate, interval_ends, letter, on_even_mesh, program, word
from evidence.checks.collocation_check import (
    collocation_difference,
    compare_with_collocation,
    differing,
    examples,
    random_problems,
)
from evidence.checks.oracle import Circle, Planar
from golden.paper import EXAMPLES
from loiter import Aircraft, Orbit, Pose, Turn, candidates
from loiter.errors import InvalidArgument

# What IPOPT's tolerance of 1e-9 leaves of the error and the gap in the two examples, with room for other builds of it.
SMALL = 1e-6


def test_both_examples_of_the_paper_and_random_problems_agree():
    results = list(compare_with_collocation(4, seed=0))
    assert len(results) == 6
    assert [r.problem.place for r in results if not r.passed] == []
    assert max(r.path.error + r.path.gap for r in results) < SMALL
    for result, example in zip(results, EXAMPLES, strict=False):
        assert result.path.word in example.words
        assert result.path.time == pytest.approx(example.time, abs=SMALL)


def slower(plans):
    """Every plan's first piece longer by a thousandth of the whole."""
    first = [replace(m.segments[0], length_m=m.segments[0].length_m + 1e-3 * m.length_m) for m in plans]
    return tuple(replace(m, segments=(piece, *m.segments[1:])) for m, piece in zip(plans, first, strict=True))


def cut_short(plans):
    return tuple(replace(m, segments=m.segments[:-1]) for m in plans)


def backwards(plans):
    """The same pieces in the wrong order: the same time."""
    return tuple(replace(m, segments=m.segments[::-1]) for m in plans)


def test_a_wrong_plan_is_caught(monkeypatch):
    honest = module.plan_all
    for problem in examples():
        path = collocation_difference(problem).path
        monkeypatch.setattr(module, "collocate", lambda *scene, path=path: path)
        for wrong, *same in ((slower, False, True), (cut_short, False, False), (backwards, True, False)):
            monkeypatch.setattr(module, "plan_all", lambda *scene, wrong=wrong: wrong(honest(*scene)))
            result = collocation_difference(problem)
            assert [result.same_time, result.same_structure] == same
            assert not result.passed
        monkeypatch.undo()


def test_a_plan_that_takes_the_runner_up_is_caught(monkeypatch):
    monkeypatch.setattr(module, "plan_all", lambda *scene: candidates(*scene)[-1:])
    assert collocation_difference(next(random_problems(1, seed=0))).later > 0.01


def test_on_even_meshes_the_time_falls_to_the_plan_s_with_the_width_squared():
    """A switch inside an interval of width h costs the integral of |phi|/lambda |du|, at most |psi2|/lambda h^2/4.

    At the two switches of example 2 psi is parallel to the state and psi1 = lambda, so that |psi2|/lambda = |y/x|.
    """
    start, circle, time = Planar(-0.53, 0.31, 0.0), Circle(1.0, clockwise=True), EXAMPLES[1].time
    slope = 0.382789 / 0.291365
    for n in (12, 24, 48, 96):
        late = min(path.time for path in on_even_mesh(start, circle, n)) - time
        assert 0.0 < late < 2 * slope * (time / n) ** 2 / 4


def test_straight_to_the_peel_off():
    """From 10 radii away, pointing at the centre of a circle of 3: straight to sqrt(15), then acos(1/4) of turn."""
    path = collocate(Planar(-10.0, 0.0, 0.0), [Circle(3.0, clockwise=True)])
    assert path.time == pytest.approx(10.0 - 15.0**0.5 + 1.3181160716528180, abs=SMALL)
    assert path.word == "SL"


def test_the_path_ends_on_the_circle_when_flown_exactly():
    """The program's quadrature is not used here: arcs of constant control."""
    path = collocate(Planar(4.0, 4.0, 0.0), [Circle(1.0, clockwise=False)])
    end = interval_ends(Planar(4.0, 4.0, 0.0), path.controls, path.lengths)[-1]
    assert end.east**2 + end.north**2 == pytest.approx(1.0, abs=SMALL)


def test_words_and_differences():
    assert [letter(u) for u in (-1.0, -0.4, 0.0, 0.4, 1.0)] == ["R", "S", "S", "S", "L"]
    assert word([("L", 1.0), ("S", 0.1), ("L", 0.5), ("L", 0.5), ("R", 2.0)], 0.2) == "LR"
    assert differing([("L", 1.0), ("R", 2.0)], [("L", 1.25), ("R", 1.75)]) == pytest.approx(0.25)
    assert differing([("L", 1.0)], [("L", 1.5)]) == pytest.approx(0.5)


def test_problems_are_reproducible_and_take_the_turns_in_rotation():
    drawn = list(random_problems(50, 1))
    assert drawn == list(random_problems(50, 1))
    assert drawn != list(random_problems(50, 2))
    assert {a.orbit.turn for a in drawn} == set(Turn)
    assert all(a.orbit.turn != b.orbit.turn for a, b in pairwise(drawn))
    assert all(1.0 <= s.orbit.radius_m / s.aircraft.turn_radius_m <= 5.0 for s in drawn)


def test_an_offset_centre_and_another_size_give_the_same_path():
    r = 7.0
    problem = module.CheckProblem(
        "offset",
        Pose(100.0 + 4.0 * r, -30.0 + 4.0 * r, 90.0),
        Orbit(100.0, -30.0, r),
        Aircraft(11.0, min_turn_radius_m=r),
    )
    assert collocation_difference(problem).passed


def test_no_path_at_all_is_an_error(monkeypatch):
    program.cache_clear()
    monkeypatch.setattr("evidence.checks.collocation.guesses", lambda start, circle: iter(()))
    with pytest.raises(ArithmeticError, match="no path"):
        collocate(Planar(4.0, 4.0, 0.0), [Circle(1.0, clockwise=True)])


def test_a_negative_number_of_cases_is_refused_at_once():
    with pytest.raises(InvalidArgument, match="cases is -1"):
        compare_with_collocation(-1, 0)
