"""The picture of docs/wind.md, read back from its artists; the map's ties where theory has them."""

import numpy as np
import pytest
from matplotlib.figure import Figure

from loiter import Orbit, Wind, plan
from plot.wind_picture import AIRCRAFT, CIRCLE_RADIUS, MAP_WIND, SAME_TIME, SPEEDS, START, differences, draw, draw_ties


def artists(axes, gid):
    return [artist for artist in axes.get_children() if artist.get_gid() == gid]


@pytest.fixture(scope="module")
def panels():
    return draw(cells=8).axes[:3]


def test_a_track_for_each_wind_ends_where_the_circle_is_joined(panels):
    tracks, joins = artists(panels[0], "track"), artists(panels[0], "join")
    assert len(tracks) == len(joins) == len(SPEEDS)
    for track, join, speed in zip(tracks, joins, SPEEDS, strict=True):
        m = plan(START, Orbit(0.0, 0.0, CIRCLE_RADIUS), AIRCRAFT, Wind(speed, from_deg=180.0))
        ends = np.column_stack(track.get_data())[[0, -1]]
        wanted = [[START.east_m, START.north_m], [m.join.east_m, m.join.north_m]]
        assert ends == pytest.approx(np.array(wanted), abs=1e-9)
        assert np.column_stack(join.get_data()) == pytest.approx(np.array(wanted[1:]), abs=1e-9)
        assert track.get_label() == f"{speed:.2f}: {m.word} {m.turn.value}, T = {m.duration_s:.2f}"


def test_the_maps_show_the_differences(panels):
    for axes, wind in zip(panels[1:], (0.0, MAP_WIND), strict=True):
        [mesh] = artists(axes, "later")
        assert np.allclose(mesh.get_array().reshape(8, 8), differences(wind, 8)[1], rtol=0.0, atol=1e-12)
    [tied] = artists(panels[1], "tied")
    assert tied.get_array().count() == np.count_nonzero(np.abs(differences(0.0, 8)[1]) < SAME_TIME) > 30
    assert artists(panels[2], "tied") == []


def test_in_wind_the_ties_of_still_air_are_gone():
    """On a grid that keeps clear of the curves where they remain."""
    line, still = differences(0.0, 8)
    _, windy = differences(MAP_WIND, 8)
    assert np.count_nonzero(np.abs(still) < SAME_TIME) > 30
    assert np.count_nonzero(np.abs(windy) < 1e-3) == 0
    assert np.allclose(line, -line[::-1])


def test_a_tie_is_drawn_where_the_difference_passes_through_zero_and_not_where_it_jumps():
    line = np.linspace(-1.0, 1.0, 40)

    def later(east, north):
        """Steep, as next to a region's border, but continuous above the axis; a jump below it."""
        return np.where(north > 0.0, np.sign(east) * np.sqrt(np.abs(east)), np.where(east > 0.0, 2.0, -2.0))

    axes = Figure().add_subplot()
    draw_ties(axes, line, later)
    [drawn] = axes.collections
    points = np.concatenate([path.vertices for path in drawn.get_paths()])
    assert np.abs(points[:, 0]).max() < 1e-9
    assert points[:, 1].min() > 0.0
    assert points[:, 1].max() == 1.0
