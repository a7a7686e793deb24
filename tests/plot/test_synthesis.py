"""The picture of a synthesis: which regions, which curves."""

import numpy as np
import pytest

from loiter.arrays.partition import boundaries, partition
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


def test_a_curve_is_drawn_in_order():
    axes = drawn(1.0, "cw")
    line = next(line for line in axes.lines if line.get_gid() == "same RL RSL").get_xydata()
    steps = np.hypot(*np.diff(line, axis=0).T)
    assert np.nanmax(steps) < 0.4
