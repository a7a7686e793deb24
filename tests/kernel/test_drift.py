"""The fastest way onto a circle in wind: the laws it obeys, the hold, degenerate starts, and still air as its limit."""

from functools import cache
from math import atan2, cos, hypot, inf, isnan, nan, pi, sin, sqrt

import numba
import pytest
from hypothesis import assume, example, given, settings
from hypothesis import strategies as st

from loiter.kernel.codes import Side, Status, Word
from loiter.kernel.drift import fastest, first_way, slope
from loiter.kernel.hold import held, hold_rate, hold_time, phase_of, tightest_held
from loiter.kernel.motion import reduce
from loiter.kernel.rebinding import rebound
from loiter.kernel.synthesis import duration, mirrored, optimum, rounding
from strategies import blur, coordinates, one_way, radii, sides

# A plain solve takes milliseconds, tens of them in a shallow valley on a busy machine.
settings.register_profile("drift", deadline=None)
settings.load_profile("drift")

angles = st.one_of(st.floats(0.0, 2.0 * pi), st.sampled_from([0.0, pi / 2, pi, 3 * pi / 2]))
CONTROLS = {"L": 1.0, "S": 0.0, "R": -1.0}

# T moves by at most so much for each unit by which it is moved from outside, per unit of 1 - |w| (docs/wind.md).
WINDIEST = 0.6


@st.composite
def scenes(draw, windiest=WINDIEST):
    """Start, heading, radius, wind: what the kernel takes, but for the side."""
    wind, azimuth, angle = draw(st.floats(0.0, windiest)), draw(angles), draw(angles)
    wx, wy = wind * cos(azimuth), wind * sin(azimuth)
    R = tightest_held(wx, wy) * draw(st.one_of(st.just(1.0), st.floats(1.0, 2.5)))
    return draw(coordinates), draw(coordinates), cos(angle), sin(angle), R, wx, wy


def solved(scene, side):
    x, y, c, s, R, wx, wy = scene
    return fastest(x, y, c, s, R, side, wx, wy)


def least_time(scene, side):
    status, _, _, t1, t2, t3, _, _ = solved(scene, side)
    assert status == Status.OK
    return t1 + t2 + t3


def steps(maneuver):
    return [(CONTROLS[letter], t) for letter, t in zip(Word(maneuver[2]).letters, maneuver[3:6], strict=False)]


def flown(scene, pieces):
    """The scene after a flight, turns of any radius included: positions as complex numbers, nothing of the kernel's."""
    x, y, c, s, R, wx, wy = scene
    z, e, w = complex(x, y), complex(c, s), complex(wx, wy)
    for u, t in pieces:
        turned = complex(cos(u * t), sin(u * t))
        z += w * t + (e * t if abs(u) < 1e-6 else e * (turned - 1.0) / (1j * u))
        e *= turned
    return z.real, z.imag, e.real / abs(e), e.imag / abs(e), R, wx, wy


def moved(scene, time):
    """How far rounding of the start, or of a flight, may move T: as without wind, faster by what the wind does."""
    x, y, _, _, R, wx, wy = scene
    return blur(abs(x) + time, y, R) / (1.0 - hypot(wx, wy))


@settings(max_examples=300)
@given(scenes(), sides)
def test_the_end_is_on_the_circle_and_along_it(scene, side):
    status, held_side, word, *_, angle, miss = maneuver = solved(scene, side)
    x, y, c, s, R, wx, wy = flown(scene, steps(maneuver))
    size = rounding(*scene[:2], R) + 1e-14 * sum(maneuver[3:6])
    assert status == Status.OK
    assert hypot(x, y) == pytest.approx(R, abs=size)
    assert hypot(x - R * cos(angle), y - R * sin(angle)) <= size
    assert miss <= size
    # Over the ground the vehicle moves along the circle, the right way round.
    vx, vy = c + wx, s + wy
    assert (x * vx + y * vy) / R == pytest.approx(0.0, abs=size)
    assert (x * vy - y * vx) * held_side < 0.0
    assert side in (Side.EITHER, held_side)
    assert min(maneuver[3:6]) >= 0.0


@settings(max_examples=200)
@given(scenes(), sides, st.floats(-3.0, 3.0), st.floats(-3.0, 3.0))
def test_a_moving_circle_is_a_fixed_one_in_the_wind_that_blows_past_it(scene, side, vx, vy):
    """Flown over the ground, in the wind w + v, the maneuver ends on the circle that has moved with v."""
    maneuver = solved(scene, side)
    x, y, c, s, R, wx, wy = scene
    over_ground = flown((x, y, c, s, R, wx + vx, wy + vy), steps(maneuver))
    time = sum(maneuver[3:6])
    assert hypot(over_ground[0] - vx * time, over_ground[1] - vy * time) == pytest.approx(R, abs=1e-12 * (100.0 + time))


@settings(max_examples=200)
@given(coordinates, coordinates, angles, radii, sides)
def test_still_air_gives_the_closed_form(x, y, angle, R, side):
    c, s = cos(angle), sin(angle)
    closed = duration(optimum(*reduce(x, y, c, s), R, side, 0.0))
    assert least_time((x, y, c, s, R, 0.0, 0.0), side) == pytest.approx(closed, abs=blur(x, y, R))


@given(coordinates, coordinates, angles, st.floats(1.01, 10.0), sides, st.floats(1e-14, 1e-4), angles)
def test_a_light_wind_changes_little(x, y, angle, R, side, wind, azimuth):
    """In a wind w the vehicle ends |w| T off; T is continuous, and moves with the root of that at the steepest."""
    c, s = cos(angle), sin(angle)
    calm = least_time((x, y, c, s, R, 0.0, 0.0), side)
    windy = least_time((x, y, c, s, R, wind * cos(azimuth), wind * sin(azimuth)), side)
    off = wind * (calm + R)
    assert windy == pytest.approx(calm, abs=4.0 * (sqrt(off) + sqrt((R + 1.0) / (R - 1.0) * off)))


@given(scenes(), one_way)
def test_mirror_law(scene, side):
    x, y, c, s, R, wx, wy = scene
    one, other = solved(scene, side), solved((x, -y, c, -s, R, wx, -wy), -side)
    assert sum(one[3:6]) == pytest.approx(sum(other[3:6]), abs=moved(scene, sum(one[3:6])))
    assume(one[3:6] == pytest.approx(other[3:6], abs=1e-6))
    assert other[1] == -one[1]


@given(scenes(), sides, angles)
def test_turning_everything_changes_nothing(scene, side, angle):
    x, y, c, s, R, wx, wy = scene
    a, b = cos(angle), sin(angle)
    turned = (
        [a * p - b * q for p, q in ((x, y), (c, s), (wx, wy))],
        [b * p + a * q for p, q in ((x, y), (c, s), (wx, wy))],
    )
    (x1, c1, w1), (y1, s1, w2) = turned
    time = least_time(scene, side)
    assert least_time((x1, y1, c1, s1, R * (1.0 + 1e-15), w1, w2), side) == pytest.approx(time, abs=moved(scene, time))


@given(scenes())
def test_either_is_the_better_of_the_two(scene):
    both = [least_time(scene, side) for side in (Side.CW, Side.CCW)]
    assert least_time(scene, Side.EITHER) == pytest.approx(min(both), abs=moved(scene, min(both)))


@settings(max_examples=300)
@given(scenes(), sides, st.floats(0.0, 1.0))
def test_along_the_optimum_the_time_left_falls_at_unit_rate(scene, side, share):
    maneuver = solved(scene, side)
    time = sum(maneuver[3:6])
    to_fly, pieces = share * time, []
    for u, t in steps(maneuver):
        pieces.append((u, min(t, to_fly)))
        to_fly -= pieces[-1][1]
    left = least_time(flown(scene, pieces), maneuver[1])
    assert left == pytest.approx((1.0 - share) * time, abs=moved(scene, time))


pieces_of_flight = st.lists(st.tuples(st.floats(-1.0, 1.0), st.floats(0.0, 4.0)), max_size=3)


@settings(max_examples=300)
@given(scenes(), sides, pieces_of_flight)
def test_nothing_beats_the_answer(scene, side, pieces):
    """Bellman's inequality: after any admissible flight, turns of any radius included, the best is no sooner."""
    spent = sum(t for _, t in pieces)
    after = least_time(flown(scene, pieces), side)
    assert least_time(scene, side) <= spent + after + moved(scene, spent + after)


@settings(max_examples=200)
@given(scenes(), sides, st.sampled_from([-1.0, 1.0]))
def test_a_whole_turn_first_never_helps(scene, side, u):
    """The words leave out arcs of a whole turn and more."""
    after = least_time(flown(scene, [(u, 2.0 * pi)]), side)
    assert least_time(scene, side) <= 2.0 * pi + after + moved(scene, 2.0 * pi + after)
