"""Dubins' words between poses against OMPL's distances, flown exactly, and MATLAB's published example."""

from math import hypot, pi, tan

import numpy as np
import pytest
from ompl import base

from fences.brute import WORDS, lengths
from loiter.fences.words import words_between

POSES = np.random.default_rng(3).uniform(-5.0, 5.0, (300, 6))


def flown(place, angle, control, length):
    """The place and the angle after the pieces of a word with the turn radius 1."""
    for u, t in zip(control, length, strict=True):
        step = t if u == 0.0 else (np.exp(1j * u * t) - 1.0) / (1j * u)
        place, angle = place + np.exp(1j * angle) * step, angle + u * t
    return place, angle


@pytest.mark.parametrize("radius", [1.0, 47.0])
def test_the_shortest_word_is_as_long_as_ompl_says(radius):
    space = base.DubinsStateSpace(radius)
    start, end = space.allocState(), space.allocState()
    for row in POSES:
        x, y, a, to_x, to_y, b = row
        for state, place, angle in ((start, (x, y), a), (end, (to_x, to_y), b)):
            state.setXY(radius * place[0], radius * place[1])
            state.setYaw((angle + pi) % (2.0 * pi) - pi)
        ends = (np.array([radius * to_x]), np.array([radius * to_y]), np.array([b]))
        found = words_between(radius * x, radius * y, a, *ends, radius)
        assert found.length.sum(axis=1).min() == pytest.approx(space.distance(start, end), rel=1e-9)


def test_each_word_ends_at_its_pose():
    for x, y, a, to_x, to_y, b in POSES:
        found = words_between(x, y, a, np.array([to_x]), np.array([to_y]), np.array([b]), 1.0)
        for control, length in zip(found.control, found.length, strict=True):
            place, angle = flown(complex(x, y), a, control, length)
            assert abs(place - complex(to_x, to_y)) < 1e-9
            assert abs(np.exp(1j * angle) - np.exp(1j * b)) < 1e-9


def test_brute_force_has_the_same_words():
    """Shkel and Lumelsky's formulas."""
    for x, y, a, to_x, to_y, b in POSES:
        table = lengths(
            (complex(x, y), np.exp(1j * a)), (np.array([complex(to_x, to_y)]), np.array([np.exp(1j * b)])), 1.0
        )
        theirs = {word: row[0].sum() for word, row in zip(WORDS, table, strict=True) if np.isfinite(row).all()}
        found = words_between(x, y, a, np.array([to_x]), np.array([to_y]), np.array([b]), 1.0)
        ours = {
            "".join({1.0: "L", 0.0: "S", -1.0: "R"}[u] for u in control): length.sum()
            for control, length in zip(found.control, found.length, strict=True)
        }
        assert ours == pytest.approx(theirs, abs=1e-6)


def test_the_published_example_of_a_climb():
    """MATLAB's uavDubinsConnection from [0 0 0 0] to [0 0 20 pi], airspeed 10, roll 0.5: 138.373157.

    It is the shortest word, LRL or RLR, of 7/3 pi turn radii, and the climb of 20 as the other side of a triangle. The
    turn radius is that with 9.8 for the acceleration of gravity; with 9.80665 the length is 138.281.
    """
    for gravity, expected in ((9.8, 138.373157), (9.80665, 138.281)):
        radius = 10.0**2 / (gravity * tan(0.5))
        found = words_between(0.0, 0.0, 0.0, np.zeros(1), np.zeros(1), np.array([pi]), radius)
        level = found.length.sum(axis=1).min()
        assert level == pytest.approx(7.0 / 3.0 * pi * radius)
        assert hypot(level, 20.0) == pytest.approx(expected, abs=1e-3 if gravity > 9.8 else 1e-6)
