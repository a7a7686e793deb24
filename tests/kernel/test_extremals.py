"""The closed forms: each piece ends where its name says."""

from math import acos, cos, hypot, inf, pi, sin, sqrt

import pytest
from hypothesis import assume, example, given, settings
from hypothesis import strategies as st

from loiter.kernel.angles import angle
from loiter.kernel.motion import flow
from loiter.kernel.rounding import rounding
from loiter.kernel.still_air.extremals import (
    duration,
    durations,
    extremals,
    fastest,
    is_near_circle,
    lrl,
    onto_axis,
    rl,
    start_at,
)
from loiter.kernel.words import Word
from strategies import coordinates, radii

U = {"L": 1, "S": 0, "R": -1}


def reached(x, y, R):
    """The extremals that reach the target, with the switching points they pass, the end last."""
    for extremal in extremals(x, y, R, rounding(x, y, R) / 3.0):
        if duration(extremal) < inf:
            letters, times = Word(extremal.word).letters, durations(extremal)
            points, here = [], (x, y)
            for letter, t in zip(letters, times, strict=False):
                here = flow(*here, U[letter], t)
                points.append(here)
            yield letters, times, points


@settings(max_examples=500)
@given(coordinates, coordinates, radii)
def test_every_extremal_ends_at_the_target(x, y, R):
    found = list(reached(x, y, R))
    assert found
    for _, times, points in found:
        assert min(times) >= 0.0
        assert hypot(points[-1][0], points[-1][1] - R) <= rounding(x, y, R)


@given(coordinates, coordinates, radii)
def test_straight_pieces_lie_on_the_line_through_the_centre(x, y, R):
    straight = [points for word, _, points in reached(x, y, R) if word[1:2] == "S"]
    assume(straight)
    for (_, height), *_ in straight:
        assert height == pytest.approx(0.0, abs=rounding(x, y, R))


@given(coordinates, coordinates, radii)
def test_last_arcs_after_a_straight_piece_last_as_long_as_the_radius_says(x, y, R):
    last = [(word[2], time) for word, (_, _, time), _ in reached(x, y, R) if word[1:] in ("SL", "SR")]
    assume(last)
    for letter, time in last:
        left, right = (acos(1.0 / (1.0 + R)), 1e-15), (pi - acos(1.0 / max(R - 1.0, 1.0)), 1e-7 if R < 2.1 else 1e-14)
        expected, error = left if letter == "L" else right
        assert time == pytest.approx(expected, abs=error)


@settings(max_examples=200)
@given(st.floats(1.0, 2.7), st.floats(0.0, 0.999), st.floats(-pi, pi))
def test_lrl_switches_where_the_maximum_principle_asks(R, share, azimuth):
    """From the outer part of the circle of 3 - R about (0, -1), where LRL exists."""
    least = 0.4 + 0.3 * (R - 1.0)
    distance = (least + share * (1.0 - least)) * (3.0 - R)
    x, y = distance * cos(azimuth), distance * sin(azimuth) - 1.0
    extremal = lrl(start_at(x, y, R, 0.0))
    first, middle, _ = durations(extremal)
    assume(duration(extremal) < inf)
    xa, ya = flow(x, y, 1, first)
    xb, yb = flow(xa, ya, -1, middle)
    assert xb * ya == pytest.approx(-xa * yb, abs=1e-12 * (1.0 + x * x + y * y + R * R))
    assert xb <= rounding(x, y, R)


@pytest.mark.parametrize("branch", [-1.0, 1.0])
def test_rl_meets_the_last_circle_on_the_side_of_its_branch(branch):
    first, last, _ = durations(rl(start_at(-0.53, 0.31, 1.0, 0.0), branch))
    x1, y1 = flow(-0.53, 0.31, -1, first)
    assert x1 * branch > 0.0
    assert hypot(x1, y1 + 1.0) == pytest.approx(2.0, abs=1e-15)
    assert last == pytest.approx(acos((y1 + 1.0) / 2.0) if branch < 0.0 else 2 * pi - acos((y1 + 1.0) / 2.0), abs=1e-14)


@pytest.mark.parametrize("y", [1e-4, 1e-9, 1e-20, 1e-300])
def test_a_tiny_turn_onto_the_axis_keeps_its_digits(y):
    # From (-9, y) the right turn about (0, 1) lasts y/9 to first order.
    assert angle(onto_axis(-9.0, -y, -1.0, 0.0)[0]) == pytest.approx(y / 9.0, rel=max(4e-16, y))


def test_no_straight_piece_inside_two_turn_radii():
    words = {word for word, _, _ in reached(0.2, 0.1, sqrt(3.0))}
    assert not any("SR" in word for word in words)


@settings(max_examples=1000)
@given(coordinates, coordinates, radii)
@example(0.0, -1.0, 3.0)  # the centre of L, where the last LRL begins
@example(0.0, 1.0, 1.0)
@example(-3e-289, -3.0, 1.0)
@example(2.2250738585e-313, 0.0, 2.000000001)  # a subnormal coordinate, whose products have few digits
def test_the_three_words_that_are_tried_are_as_fast_as_all_eleven(x, y, R):
    """docs/theory.md, section 4: for each first turn one word, and from y < 0 one more."""
    arc_tolerance = rounding(x, y, R) / 3.0
    least, best = fastest(x, y, R, arc_tolerance, True)
    assert least == pytest.approx(min(map(duration, extremals(x, y, R, arc_tolerance))), abs=rounding(x, y, R))
    assert duration(best) == least


@settings(max_examples=300)
@given(coordinates, coordinates, radii)
def test_the_time_of_an_extremal_is_the_sum_of_its_pieces(x, y, R):
    found = [one for one in extremals(x, y, R, rounding(x, y, R) / 3.0) if duration(one) < inf]
    assert found
    for extremal in found:
        assert duration(extremal) == pytest.approx(sum(durations(extremal)), rel=1e-15, abs=4e-15)


@given(coordinates, coordinates, radii, st.floats(0.0, 10.0))
def test_next_to_a_circle_means_within_a_distance_of_it(x, y, radius, distance):
    away = abs(hypot(x, y) - radius)
    assume(abs(away - distance) > 1e-12 * (1.0 + away + distance + radius))
    assert is_near_circle(x * x + y * y - radius * radius, radius, distance) == (away <= distance)
