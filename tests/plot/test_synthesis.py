"""The picture of a synthesis: which regions, which curves."""

import numpy as np
import pytest

from loiter.arrays.partition import boundaries, lines, partition
from loiter.plot.synthesis import draw


def drawn(radius, turn, show="words"):
    regions = partition(radius, turn, cells=80)
    return draw(regions, boundaries(regions), show).axes[0]


def gids(axes, kind):
    return {artist.get_gid() for artist in [*axes.lines, *axes.texts] if (artist.get_gid() or "").startswith(kind)}


def test_the_papers_figure_4_has_its_regions_and_curves():
    axes = drawn(1.0, "either")
    assert {text.get_text() for text in axes.texts} == {"RSL", "RL", "LRL", "LSR", "LR", "RLR"}
    assert gids(axes, "jump") == {"jump LR RLR", "jump LRL RL"}
    assert gids(axes, "switch") == {"switch LR RLR", "switch LRL RL"}
    assert gids(axes, "straight") == {"straight LSR RSL"}
    targets = [line.get_xydata()[0].tolist() for line in axes.lines if line.get_gid() == "target"]
    assert targets == [[0.0, 1.0], [0.0, -1.0]]
    labels = [text.get_text() for text in axes.get_legend().get_texts()]
    assert labels == [
        "T jumps",
        "switching curve",
        "straight flight",
        "two controls tie",
        "same first control",
        "circle joined",
    ]


def test_labels_stand_in_their_regions():
    regions = partition(3.0, "cw", cells=80)
    axes = draw(regions, ()).axes[0]
    for text in axes.texts:
        x, y = text.get_position()
        here = regions.word[np.abs(regions.y - y).argmin(), np.abs(regions.x - x).argmin()]
        assert text.get_gid() == f"region {text.get_text()}"
        assert here == next(word for word in map(int, np.unique(regions.word)) if word == here)


@pytest.mark.parametrize(("show", "title"), [("time", "Time to join"), ("worth", "What a free direction is worth")])
def test_values_have_a_scale_and_a_title(show, title):
    axes = drawn(1.5, "cw", show)
    assert axes.get_title() == f"{title}, R = 1.5, clockwise"
    assert len(axes.figure.axes) == 2


def test_curves_over_values_have_a_white_outline():
    """Without it violet and black cannot be seen on the dark end of the colours."""
    for show, outlined in (("words", False), ("time", True), ("worth", True)):
        axes = drawn(1.5, "either", show)
        curves = [line for line in axes.lines if line.get_gid() != "target"]
        assert curves
        assert all(bool(line.get_path_effects()) == outlined for line in curves)


def test_a_curve_is_drawn_in_order():
    axes = drawn(1.0, "cw")
    line = next(line for line in axes.lines if line.get_gid() == "same RL RSL").get_xydata()
    steps = np.hypot(*np.diff(line, axis=0).T)
    assert np.nanmax(steps) < 0.4


@pytest.mark.parametrize(("radius", "turn"), [(1.0, "either"), (1.5, "cw")])
def test_a_connected_region_has_one_label(radius, turn):
    regions = partition(radius, turn, cells=80)
    labels = [text.get_text() for text in draw(regions, ()).axes[0].texts]
    assert len(labels) == len(set(labels)) >= 5


def test_an_arc_that_begins_in_the_middle_has_no_gap():
    """The leftmost point of the circle around (0, 1), where the search for neighbours begins, is not an end."""
    regions = partition(1.5, "cw", cells=80)
    [curve] = [curve for curve in boundaries(regions) if curve.kind == "same" and curve.words == ("RL", "RSL")]
    [arc] = lines(regions, curve)
    assert np.hypot(*np.diff(arc, axis=0).T).max() < 3.0 * (regions.x[1] - regions.x[0])
    ends = arc[[0, -1]]
    assert np.abs(ends[:, 1]).max() < 0.2
    assert len(arc) == len(curve.points)
