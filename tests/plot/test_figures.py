"""What is in the paper's figures: which curves, from where to where, and which way."""

from functools import cache
from itertools import pairwise
from math import cbrt, cos, hypot, pi, sin, sqrt

import numpy as np
import pytest

import loiter
from golden.paper import ADMISSIBLE, EXAMPLES
from loiter.kernel.rounding import rounding
from loiter.kernel.still_air.switching_curves import beyond_last_circle, switching_abscissa
from loiter.plot.figures import FIGURES, piece

SQRT3 = sqrt(3.0)
LENGTH_TOLERANCE = rounding(4.0, 4.0, 1.0)
CENTRES = {"L": (0.0, -1.0), "R": (0.0, 1.0)}


@cache
def panels(number):
    [figure] = [figure for figure in FIGURES if figure.number == number]
    return figure.draw().axes


def lines(axes, name):
    """The points of each line so named, (n, 2)."""
    return [np.column_stack(line.get_data()) for line in axes.lines if line.get_gid() == name]


def marks(axes, name):
    return [tuple(place) for [place] in lines(axes, name)]


def pieces(axes):
    """Letter and points of each piece of a trajectory, in the order drawn."""
    named = [line for line in axes.lines if (line.get_gid() or "").startswith("piece ")]
    return [(line.get_gid()[-1], np.column_stack(line.get_data())) for line in named]


def arrows(axes):
    return [np.subtract(note.xy, note.xyann) for note in axes.texts if note.arrowprops]


def assert_flown(letter, points):
    """On its circle or its line, in its sense."""
    if letter == "S":
        assert np.abs(points[:, 1]).max() <= LENGTH_TOLERANCE
        assert np.all(np.diff(points[:, 0]) > 0.0)
        return
    away = points - CENTRES[letter]
    assert np.hypot(*away.T) == pytest.approx(np.hypot(*away[0]), abs=LENGTH_TOLERANCE)
    turned = away[:-1, 0] * away[1:, 1] - away[:-1, 1] * away[1:, 0]
    assert np.all(turned < 0.0 if letter == "L" else turned > 0.0)


def test_there_are_seven_each_with_a_caption_of_its_own():
    assert [figure.number for figure in FIGURES] == [1, 2, 3, 4, 5, 6, 7]
    assert len({figure.caption for figure in FIGURES}) == 7
    assert all(figure.caption.endswith(".") for figure in FIGURES)


@pytest.mark.parametrize("number", range(1, 8))
def test_axes_are_named_and_equal(number):
    names = ("ψ₁", "ψ₂") if number == 2 else ("x", "y")
    for axes in panels(number):
        assert (axes.get_xlabel(), axes.get_ylabel()) == names
        assert axes.get_aspect() == 1.0


@pytest.mark.parametrize("number", [1, 2, 3, 5, 6, 7])
def test_every_piece_has_an_arrow_the_way_it_is_flown(number):
    for axes in panels(number):
        found = pieces(axes)
        assert len(arrows(axes)) == len(found) > 0
        for arrow, (_, points) in zip(arrows(axes), found, strict=True):
            middle = len(points) // 2
            assert arrow @ (points[middle] - points[middle - 1]) > 0.0


def test_a_piece_looks_round():
    turn = piece(1.0, 1.0, -1, 2.0 * pi)  # of radius 1
    assert np.hypot(np.diff(turn.x), np.diff(turn.y)).max() < 0.04


def test_figure_1_whole_circles_about_both_centres_in_their_senses():
    for letter, axes in zip("LR", panels(1), strict=True):
        assert marks(axes, "centre") == [CENTRES[letter]]
        radii = []
        for drawn, points in pieces(axes):
            assert drawn == letter
            assert_flown(letter, points)
            assert points[0] == pytest.approx(points[-1], abs=LENGTH_TOLERANCE)
            radii.append(hypot(*(points[0] - CENTRES[letter])))
        assert radii == pytest.approx([0.5, 1.0, 1.5, 2.0], abs=LENGTH_TOLERANCE)


def test_figure_2_the_adjoint_takes_the_longer_arc_left_of_lambda():
    middle = EXAMPLES[1].durations[1]
    lam = -cos(middle / 2.0)
    for letter, axes in zip("RL", panels(2), strict=True):
        [(drawn, arc)] = pieces(axes)
        assert drawn == letter
        assert np.hypot(*arc.T) == pytest.approx(1.0, abs=LENGTH_TOLERANCE)
        assert arc[:, 0].max() <= lam + LENGTH_TOLERANCE
        up = 1.0 if letter == "R" else -1.0
        ends = np.array([[lam, up * sqrt(1.0 - lam**2)], [lam, -up * sqrt(1.0 - lam**2)]])
        assert arc[[0, -1]] == pytest.approx(ends, abs=LENGTH_TOLERANCE)
        assert np.array(marks(axes, "switch")) == pytest.approx(ends, abs=LENGTH_TOLERANCE)
        [[(x, _), _]] = lines(axes, "lambda")
        assert x == pytest.approx(lam, abs=LENGTH_TOLERANCE)
        sense = arc[:-1, 0] * arc[1:, 1] - arc[:-1, 1] * arc[1:, 0]
        assert np.all(sense * up > 0.0)


def test_figure_3_straight_pieces_lie_on_the_axis_and_end_at_the_corner():
    [axes] = panels(3)
    straight = [points for letter, points in pieces(axes) if letter == "S"]
    assert len(straight) == 6
    for letter, points in pieces(axes):
        assert_flown(letter, points)
    for points in straight:
        assert points[-1] == pytest.approx((-SQRT3, 0.0), abs=LENGTH_TOLERANCE)
    ends = np.round(marks(axes, "end"), 9) + 0.0
    assert {tuple(end) for end in ends.tolist()} == {(0.0, 1.0), (0.0, -1.0)}
    assert len(marks(axes, "start")) == 3


def test_figure_4_shades_the_control():
    [axes] = panels(4)
    [mesh] = axes.collections
    u = np.asarray(mesh.get_array()).reshape(600, 600)
    line = (np.arange(600) + 0.5) / 100.0 - 3.0
    for i, j in np.random.default_rng(0).integers(0, 600, (300, 2)):
        assert u[i, j] == loiter.control(line[j], line[i])
    grey, white = mesh.cmap(mesh.norm(1.0))[:3], mesh.cmap(mesh.norm(-1.0))[:3]
    assert white == (1.0, 1.0, 1.0)
    assert 0.5 < grey[0] == grey[1] == grey[2] < 0.9


def test_figure_4_draws_the_curves_between_the_regions():
    [axes] = panels(4)
    [curve], [arc], [ray], [tie] = (lines(axes, name) for name in ("switching curve", "last arc", "straight", "tie"))
    for x, y in curve.tolist():
        assert x == switching_abscissa(abs(y), 1.0)
    for x, y in arc.tolist():
        assert x <= 0.0
        assert beyond_last_circle(x, abs(y), 1.0) == pytest.approx(0.0, abs=LENGTH_TOLERANCE)
    for points in (curve, arc):
        assert points[[0, -1], 1].tolist() == [-1.0, 1.0]
    assert ray[-1] == pytest.approx((-SQRT3, 0.0), abs=LENGTH_TOLERANCE)
    # T with and without a straight piece of length s differs by s^3/24 only: rounding may leave a shorter one out.
    unclear = cbrt(24.0 * LENGTH_TOLERANCE)
    assert np.all(loiter.control(np.linspace(ray[0, 0], ray[1, 0] - unclear, 50), 0.0) == 0.0)
    assert tie.tolist() == [ray[-1].tolist(), [3.0, 0.0]]
    assert marks(axes, "end") == [(0.0, 1.0), (0.0, -1.0)]


def test_figure_4_says_in_each_region_what_the_control_is():
    [axes] = panels(4)
    labels = [text for text in axes.texts if text.get_gid() == "label"]
    names = {1.0: "u = +1", -1.0: "u = −1"}
    assert len(labels) == 4
    for label in labels:
        assert label.get_text() == names[float(loiter.control(*label.get_position()))]
    assert [text.get_text() for text in axes.get_legend().get_texts()] == [
        "u = +1",
        "u = −1",
        "u = 0",
        "last arc (27), T jumps",
        "switching curve (23)",
        "either sign",
    ]


def assert_joined(found, start, end):
    """Pieces that follow one another from start to end, each on its circle."""
    for letter, points in found:
        assert_flown(letter, points)
    for (_, before), (_, after) in pairwise(found):
        assert before[-1] == pytest.approx(after[0], abs=LENGTH_TOLERANCE)
    assert found[0][1][0] == pytest.approx(start, abs=LENGTH_TOLERANCE)
    assert found[-1][1][-1] == pytest.approx(end, abs=LENGTH_TOLERANCE)


def test_figure_5_two_trajectories_to_both_ends():
    [axes] = panels(5)
    found = pieces(axes)
    assert "".join(letter for letter, _ in found) == "RSLRSR"
    assert_joined(found[:3], (4.0, 4.0), (0.0, 1.0))
    assert_joined(found[3:], (4.0, 4.0), (0.0, -1.0))
    corners = [(-sqrt(24.0), 0.0), (-SQRT3, 0.0)] * 2
    assert np.array(marks(axes, "switch")) == pytest.approx(np.array(corners), abs=LENGTH_TOLERANCE)
    assert "T = 6.9136" in axes.get_title()


def test_figure_6_the_admissible_trajectory():
    [axes] = panels(6)
    found = pieces(axes)
    assert "".join(letter for letter, _ in found) == "RL"
    assert_joined(found, (-0.53, 0.31), (0.0, 1.0))
    last = ADMISSIBLE[1]
    assert np.array(marks(axes, "switch")) == pytest.approx(
        np.array([[-2.0 * sin(last), 2.0 * cos(last) - 1.0]]), abs=LENGTH_TOLERANCE
    )
    assert "T = 6.0252" in axes.get_title()
    assert "not optimal" in axes.get_title()


def test_figure_7_the_optimal_trajectory():
    [axes] = panels(7)
    found = pieces(axes)
    assert "".join(letter for letter, _ in found) == "LRL"
    assert_joined(found, (-0.53, 0.31), (0.0, 1.0))
    first, second = marks(axes, "switch")
    assert first == pytest.approx((0.291365, 0.382789), abs=0.5e-6)
    assert second == pytest.approx((-0.672517, 0.883539), abs=0.5e-6)
    assert first[0] == pytest.approx(switching_abscissa(first[1], 1.0), abs=LENGTH_TOLERANCE)
    assert "T = 5.3779" in axes.get_title()


@pytest.mark.parametrize("number", [3, 5, 6, 7])
def test_the_legend_names_what_is_drawn(number):
    [axes] = panels(number)
    labels = {text.get_text() for text in axes.get_legend().get_texts()}
    names = {"L": "u = +1", "S": "u = 0", "R": "u = −1"}
    flown = {names[letter] for letter, _ in pieces(axes)}
    curves = {"switching curve (23)", "last arc (27)"} if number > 5 else set()
    assert labels == flown | {"start", "switch", "end"} | curves
