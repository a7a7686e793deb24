"""Section 6 at R = 1 as a map: the region rule against the least of all extremals, and where T is continuous."""

from functools import cache
from math import cbrt, cos, pi, sin, sqrt

import numba
import numpy as np
import pytest

import loiter
from loiter.kernel.rebinding import rebound
from loiter.kernel.rounding import rounding
from loiter.kernel.still_air.switching_curves import (
    beyond_first_circle,
    beyond_last_circle,
    last_arc_abscissa,
    region,
    switching_abscissa,
)
from loiter.kernel.still_air.synthesis import mirrored
from loiter.kernel.words import Word

MILLION = 1_000_000
REACH = 4.0
LENGTH_TOLERANCE = rounding(REACH, REACH, 1.0)

# How near a boundary rounding of T may hide which word wins. T with and without a straight piece of length s differs by
# s^3/24; with and without a first arc of duration t at the switching curve by t^2 times a number of order one.
STRAIGHT = cbrt(24.0 * LENGTH_TOLERANCE)
FIRST_ARC = sqrt(LENGTH_TOLERANCE)

MIRRORED = np.array([mirrored(word) for word in range(64)])


@cache
def rule():
    """The region rule for arrays of states, mirrored below the axis: its word's code."""
    compiled = rebound(region, finish=numba.njit)

    @numba.vectorize("int64(float64, float64)")
    def codes(x, y):
        return compiled(x, abs(y))

    return lambda x, y: np.where(y < 0.0, MIRRORED[codes(x, y)], codes(x, y))


def exceptions(x, y):
    """States where the rule and the least of all extremals name different words: (x, y, winner, rule)."""
    winner, ruled = loiter.solve(x, y).word.astype(int), rule()(x, y)
    differ = np.flatnonzero(winner != ruled)
    return [(x[i], y[i], Word(winner[i]).letters, Word(ruled[i]).letters) for i in differ]


def on_a_boundary(x, y):
    """Whether (x, y) lies where rounding of T, or of the state, may decide: within the bounds above."""
    y = abs(y)
    # Past the circle (24) by beyond, the straight piece is c - sqrt 3 = beyond/(c + sqrt 3), c near sqrt 3.
    if abs(beyond_first_circle(x, y, 1.0)) <= 2.0 * sqrt(3.0) * STRAIGHT * 1.01:
        return True
    # A state counts as on the last circle up to rounding of its place (rounding.arc_tolerance_of), times 2 radii.
    if y <= LENGTH_TOLERANCE or abs(beyond_last_circle(x, y, 1.0)) <= 4.0 * LENGTH_TOLERANCE:
        return True
    # L moves along the curve's normal by no more than its duration times the radius, 2.
    return y < 1.0 and abs(x - switching_abscissa(y, 1.0)) <= 2.0 * FIRST_ARC


def test_the_rule_is_the_winner_in_a_million_random_states():
    """None here; where a straight piece of up to 2e-5 hides in rounding, the platform's arctangent has a say."""
    found = exceptions(*np.random.default_rng(0).uniform(-REACH, REACH, (2, MILLION)))
    assert len(found) <= 2
    assert all(on_a_boundary(x, y) for x, y, *_ in found)
    assert {frozenset(words) for _, _, *words in found} <= {frozenset({"RL", "RSL"}), frozenset({"LR", "LSR"})}


def test_the_rule_is_the_winner_on_a_grid():
    """On a grid with points on the axis, where words tie, too."""
    line = np.arange(-32, 33) / 8.0
    assert exceptions(*(values.ravel() for values in np.meshgrid(line, line))) == []


def beside_each_boundary(count, seed):
    """States from 1e-15 to 1e-2 off each boundary of the upper half plane, on both sides of it."""
    rng = np.random.default_rng(seed)
    off = 10.0 ** rng.uniform(-15.0, -2.0, count) * rng.choice([-1.0, 1.0], count)
    angle, y = rng.uniform(0.0, pi, count), rng.uniform(0.0, 1.0, count)
    curve, arc = (np.array([f(v) for v in y.tolist()]) for f in (_curve, last_arc_abscissa))
    return {
        "circle (25)": ((2.0 + off) * np.cos(angle), 1.0 + (2.0 + off) * np.sin(angle)),
        "switching curve (23)": (curve + off, y),
        "last arc (27)": (arc + off, y),
        "axis": (rng.uniform(-REACH, REACH, count), np.abs(off)),
    }


def _curve(y):
    return switching_abscissa(y, 1.0)


@pytest.mark.parametrize("place", ["circle (25)", "switching curve (23)", "last arc (27)", "axis"])
def test_beside_a_boundary_the_rule_fails_only_within_rounding_of_it(place):
    found = exceptions(*beside_each_boundary(50_000, 3)[place])
    assert 0 < len(found) < 25_000
    assert [(x, y, *words) for x, y, *words in found if not on_a_boundary(x, y)] == []


# Where T is continuous and where it jumps


def beyond(x, y):
    """Positive outside the circle of the last arc of the state's half plane, for arrays."""
    return x * x + (np.abs(y) - 1.0) * (np.abs(y) + 3.0)


def test_t_jumps_across_the_last_arcs_and_is_continuous_elsewhere():
    """A million pairs of neighbours.

    Just inside a last arc T exceeds its limit by sqrt(3 e/2), e = 4 - rp^2 (below), and e changes by at most 4 step
    from one to the other: T by sqrt(6 step). Next to the target T grows with the angle about it, by 1/distance.
    """
    step, clear = 1e-3, 0.1
    rng = np.random.default_rng(4)
    x, y = rng.uniform(-2.5, 2.5, (2, MILLION))
    angle = rng.uniform(0.0, 2.0 * pi, MILLION)
    x1, y1 = x + step * np.cos(angle), y + step * np.sin(angle)
    rise = np.abs(loiter.min_time(x1, y1) - loiter.min_time(x, y))
    away = np.hypot(x, np.abs(y) - 1.0) > clear
    across = ((beyond(x, y) < 0.0) != (beyond(x1, y1) < 0.0)) & (x < 0.0) & (np.abs(y) < 1.0)
    modulus = sqrt(6.0 * step) + step / clear
    assert np.count_nonzero(across & away) == 89  # 102 expected
    assert np.abs(rise[across & away] - pi).max() < modulus
    assert rise[~across & away].max() < modulus


@pytest.mark.parametrize("left", [0.05, 0.3, 0.7, 1.0])
@pytest.mark.parametrize("e", [1e-3, 1e-5, 1e-7, 1e-9])
def test_across_the_last_arc_t_jumps_by_pi(left, e):
    """T inside less T on the arc is pi + sqrt(3 e/2) + O(e^(3/2)) where rp^2 = 4 - e, at the same angle about (0, -1).

    LRL with s = 2 - e/3: L to xa = sqrt(e/6), past the target by sqrt(e/6)/2 radians; R for pi + sqrt(6 e)/3; L for
    sqrt(e/6)/2. It is followed along the arc all the way, so `left` drops out.
    """
    radius = sqrt(4.0 - e)
    inside = loiter.min_time(-radius * sin(left), radius * cos(left) - 1.0)
    on = loiter.min_time(-2.0 * sin(left), 2.0 * cos(left) - 1.0)
    assert on == pytest.approx(left, abs=LENGTH_TOLERANCE)
    # e is known to the rounding of the state, T to that over sqrt(e).
    assert inside - on == pytest.approx(pi + sqrt(1.5 * e), abs=e**1.5 + 4.0 * LENGTH_TOLERANCE / sqrt(e))


@pytest.mark.parametrize("left", [0.5, 1.0, 1.5, 2.0, 2.2, 2.5, 3.0])
def test_with_one_end_point_t_jumps_by_pi_then_by_less(left):
    """Clockwise alone: min(pi, 3 (pi - left)): R to the other side of the circle, pi - left, leaves 2 pi - left."""
    e = 1e-12
    radius = sqrt(4.0 - e)
    inside = loiter.min_time(-radius * sin(left), radius * cos(left) - 1.0, turn="cw")
    on = loiter.min_time(-2.0 * sin(left), 2.0 * cos(left) - 1.0, turn="cw")
    assert inside - on == pytest.approx(min(pi, 3.0 * (pi - left)), abs=2.0 * sqrt(1.5 * e))


@pytest.mark.parametrize("azimuth", [-3.0, -2.0, -1.0, 0.0, 1.0, 2.0, 3.0])
def test_around_the_target_t_takes_every_value_from_0_to_pi(azimuth):
    """At the target T = 0; next to it R turns on the spot to the last arc, pi - azimuth; from below L comes first."""
    r = 1e-10
    expected = pi - azimuth if azimuth >= 0.0 else pi
    near = loiter.min_time(r * cos(azimuth), 1.0 + r * sin(azimuth))
    # Below, e = 4 - rp^2 = -4 r sin(azimuth) makes sqrt(3 e/2).
    assert near == pytest.approx(expected, abs=sqrt(6.0 * r) * 1.01)


def test_on_each_boundary_t_is_that_of_the_side_with_the_smaller_one():
    """T is lower semicontinuous: on the last arc it is the arc's own time."""
    y = np.linspace(0.05, 0.95, 19)
    arc = np.array([last_arc_abscissa(v) for v in y.tolist()])
    here = loiter.min_time(arc, y)
    assert here == pytest.approx(np.arccos((y + 1.0) / 2.0), abs=LENGTH_TOLERANCE)
    for offset in (-1e-9, 1e-9):
        assert np.all(loiter.min_time(arc + offset, y) > here - 2e-9)


@pytest.mark.parametrize("place", ["circle (25)", "switching curve (23)", "axis"])
def test_t_is_continuous_across_every_other_boundary(place):
    """From 1e-9 on one side to 1e-9 on the other T moves by that over lambda, which is over 0.1 where y < 0.9."""
    step = 1e-9
    rng = np.random.default_rng(5)
    angle, y = rng.uniform(0.0, pi, 2000), rng.uniform(0.05, 0.9, 2000)
    curve = np.array([_curve(v) for v in y.tolist()])
    pairs = {
        "circle (25)": [((2.0 + d) * np.cos(angle), 1.0 + (2.0 + d) * np.sin(angle)) for d in (-step, step)],
        "switching curve (23)": [(curve + d, y) for d in (-step, step)],
        "axis": [(4.0 * np.cos(angle), np.full(2000, d)) for d in (-step, step)],
    }
    before, after = (loiter.min_time(*pair) for pair in pairs[place])
    assert np.abs(after - before).max() <= 2.0 * step / 0.1
