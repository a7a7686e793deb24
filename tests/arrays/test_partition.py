"""The synthesis of the reduced plane: regions, and the curves between them, against their equations."""

from math import pi

import numpy as np
import pytest

import loiter
from loiter.arrays.partition import Partition, boundaries, partition, worth
from loiter.errors import InvalidArgument
from loiter.kernel.rounding import rounding
from loiter.kernel.still_air.switching_curves import beyond_first_circle, beyond_last_circle, switching_abscissa
from loiter.kernel.words import Word

# Boundaries are known to 1e-6 grid steps of at most 0.1.
KNOWN = 1e-7


def curves(radius, turn, cells=120):
    return {(c.kind, c.words): c for c in boundaries(partition(radius, turn, cells=cells))}


def test_a_partition_is_the_optimum_on_its_grid():
    regions = partition(2.5, "ccw", cells=20)
    best = loiter.solve(*np.meshgrid(regions.x, regions.y), 2.5, "ccw")
    assert np.array_equal(regions.time, best.time)
    assert np.array_equal(regions.word, best.word)
    assert set(regions.side.flat) == {-1}
    assert regions.x[0] == -regions.x[-1] == pytest.approx(-5.5 + 5.5 / 20)


@pytest.mark.parametrize("radius", [1.0, 1.3, 1.8, 2.4])
def test_the_switching_curve_is_where_the_first_left_turn_of_lrl_vanishes(radius):
    found = curves(radius, "cw")["switch", ("LRL", "RL")].points
    assert len(found) > 3
    for x, y in found:
        # Against its own slope the curve is known as well along y as along x.
        assert x == pytest.approx(switching_abscissa(y, radius), abs=100.0 * KNOWN)


@pytest.mark.parametrize("radius", [1.0, 1.7, 2.0, 4.0])
def test_straight_flight_runs_along_the_axis_outside_and_inside(radius):
    axis = [c.points for (kind, _), c in curves(radius, "cw").items() if kind == "straight"]
    points = np.concatenate(axis)
    assert np.abs(points[:, 1]).max() < KNOWN
    outside = points[:, 0] < -np.sqrt(radius * (radius + 2.0)) + 0.1
    inside = (points[:, 0] > -0.1) & (points[:, 0] < np.sqrt(max(radius * (radius - 2.0), 0.0)) + 0.1)
    assert np.all(outside | inside)
    assert inside.any() == (radius > 2.0)


@pytest.mark.parametrize("turn", ["cw", "either"])
def test_t_jumps_across_the_last_arc_alone(turn):
    """At R = 1: by pi where 120 degrees or less of the last arc are left, then by less, down to 0 at half a turn."""
    jumps = [c for (kind, _), c in curves(1.0, turn).items() if kind == "jump"]
    points, rises = np.concatenate([c.points for c in jumps]), np.concatenate([c.rise for c in jumps])
    up = np.abs(points) * [-1.0, 1.0] if turn == "either" else points
    assert max(abs(beyond_last_circle(x, y, 1.0)) for x, y in up) < 10.0 * KNOWN
    left = np.arctan2(-up[:, 0], up[:, 1] + 1.0)
    assert left.max() < (pi / 3 + 0.1 if turn == "either" else pi)
    # Just inside, T exceeds its limit by the root of the distance.
    assert np.abs(rises[left < 2.0 * pi / 3] - pi).max() < 1e-2
    assert np.all(rises[left > 2.0 * pi / 3 + 0.1] < pi)


@pytest.mark.parametrize("radius", [1.001, 1.5, 3.0])
@pytest.mark.parametrize("turn", ["cw", "either"])
def test_t_is_continuous_for_larger_circles(radius, turn):
    for (kind, _), curve in curves(radius, turn).items():
        assert kind != "jump"
        # The root of the distance, over the root of R - 1 next to the small circle of the last R.
        assert curve.rise.max() < 20.0 * np.sqrt(KNOWN / (radius - 1.0))


@pytest.mark.parametrize("radius", [1.0, 1.5])
def test_a_straight_piece_vanishes_on_the_circle_24(radius):
    same = curves(radius, "cw")["same", ("RL", "RSL")].points
    # T with and without a straight piece s differs by s^3/24: it takes s = cbrt(24 rounding) to tell them apart.
    unclear = np.cbrt(24.0 * rounding(4.0, 4.0, radius))
    assert max(abs(beyond_first_circle(x, y, radius)) for x, y in same) < 2.0 * (radius + 1.0) * 2.0 * unclear


def test_two_controls_tie_where_the_curves_say():
    for (kind, _), curve in curves(1.5, "cw").items():
        if kind == "tie":
            assert curve.rise.max() < 10.0 * KNOWN
            either = loiter.solve(curve.points[:, 0], curve.points[:, 1], 1.5, "cw")
            assert np.all(either.status == 0)


def test_the_mirror_image_of_a_partition():
    cw, ccw = partition(1.5, "cw", cells=40), partition(1.5, "ccw", cells=40)
    assert cw.time == pytest.approx(ccw.time[::-1], abs=1e-6)
    swap = str.maketrans("LR", "RL")
    mirrored = [[Word(int(w)).letters.translate(swap) for w in row] for row in ccw.word[::-1]]
    assert mirrored == [[Word(int(w)).letters for w in row] for row in cw.word]


def test_a_free_direction_is_worth_nothing_on_the_near_side_and_something_beyond():
    regions = partition(1.5, "cw", cells=60)
    value = worth(regions)
    assert np.abs(value[regions.y > 0.0]).max() == 0.0
    assert value.min() >= -1e-13
    assert value.max() == pytest.approx(2.0 * pi, abs=0.2)
    assert np.all(worth(partition(1.5, "either", cells=20)) == 0.0)


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        ({"radius": 0.5}, "radius is 0.5: it must be at least 1"),
        ({"radius": float("nan")}, "radius is nan"),
        ({"radius": "wide"}, "radius is wide"),
        ({"turn": "up"}, "turn is 'up': it must be cw, ccw or either"),
        ({"reach": -1.0}, "reach is -1.0: it must be a positive"),
        ({"cells": 2}, "cells is 2: it must be a whole number, at least 8"),
    ],
)
def test_what_cannot_be_mapped_is_refused(arguments, sentence):
    with pytest.raises(InvalidArgument, match=sentence):
        partition(**arguments)


def test_a_region_map_names_its_arguments():
    regions = partition(2, "either", cells=9)
    assert isinstance(regions, Partition)
    assert (regions.radius, regions.turn, len(regions.x)) == (2.0, "either", 10)
