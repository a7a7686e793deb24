"""The picture of a guided flight, from its log."""

import numpy as np

from loiter.lab.log_picture import draw


def log(stages):
    """A log of a flight that heads east, then north, one step a second."""
    n = len(stages)
    return {
        "time_s": np.arange(float(n)),
        "stage": stages,
        "east_m": np.minimum(10.0 * np.arange(n), 30.0),
        "north_m": np.maximum(0.0, 10.0 * np.arange(n) - 30.0),
        "heading_deg": [90.0] * n,
        "bank_deg": np.zeros(n),
        "command_deg": [np.nan if stage == "holding" else 0.0 for stage in stages],
        "outside_m": np.ones(n),
        "crosstrack_m": [np.nan if stage == "holding" else 1.0 for stage in stages],
        "orbit_east_m": [0.0] * n,
        "orbit_north_m": [0.0] * n,
        "orbit_radius_m": [80.0] * n,
        "turn": ["ccw"] * n,
    }


def labels(axes):
    return [text.get_text() for text in axes.get_legend().get_texts()]


def marks(axes, gid):
    return [artist for artist in axes.get_children() if artist.get_gid() == gid]


def test_the_legends_list_what_is_drawn():
    track, offset, bank = draw(log(["joining"] * 4 + ["holding"] * 3)).axes
    assert labels(track) == ["holding circle", "joining", "on the circle"]
    assert labels(offset) == ["outside the circle", "left of the path"]
    assert labels(bank) == ["commanded", "measured"]


def test_a_flight_on_the_circle_alone_has_no_entry_for_what_it_lacks():
    track, offset, bank = draw(log(["holding"] * 5)).axes
    assert labels(track) == ["holding circle", "on the circle"]
    assert labels(offset) == ["outside the circle"]
    assert labels(bank) == ["measured"]
    assert marks(track, "direction") == []


def test_start_and_arrows_show_the_direction_of_flight():
    track, _, _ = draw(log(["joining"] * 4 + ["holding"] * 3)).axes
    [start], [arrow] = marks(track, "start"), marks(track, "direction")
    assert start.get_xydata().tolist() == [[0.0, 0.0]]
    assert np.argmax(start.get_marker()[:, 0]) == 0  # the nose points east
    assert np.subtract(arrow.xy, arrow.xyann).tolist() == [10.0, 0.0]
    held = marks(track, "held ccw")
    assert len(held) == 4
    assert all(np.cross([*arrow.xyann, 0.0], [*arrow.xy, 0.0])[2] > 0.0 for arrow in held)
