"""The optimum: the laws it obeys, the paper's examples, boundaries and multiplicities, degenerate starts."""

from math import cos, inf, nan, pi, sin, sqrt

import pytest
from hypothesis import assume, example, given, settings
from hypothesis import strategies as st

from golden.paper import EXAMPLES
from loiter.kernel.entry import duration, first_control, miss
from loiter.kernel.motion import flow
from loiter.kernel.rounding import rounding
from loiter.kernel.statuses import Status
from loiter.kernel.still_air.synthesis import optima, optimum, ranked, status_of
from loiter.kernel.words import Side, Word, mirrored
from strategies import blur, controls, coordinates, one_way, radii, sides, times_of

SQRT3 = sqrt(3.0)


def least_time(x, y, R, side):
    return duration(optimum(x, y, R, side, 0.0))


def words(x, y, R=1.0, side=Side.EITHER):
    return {(Word(m.word).letters, Side(m.side).name.lower()) for m in optima(x, y, R, side, 0.0)}


@pytest.mark.parametrize("case", EXAMPLES, ids=lambda case: case.name)
def test_the_papers_examples(case):
    maneuvers = optima(case.x, case.y, 1.0, Side.EITHER, 0.0)
    assert [Word(m.word).letters for m in maneuvers] == case.words
    for maneuver in maneuvers:
        assert times_of(maneuver) == pytest.approx(case.durations, abs=1e-12, rel=0.0)
        assert duration(maneuver) == pytest.approx(case.time, abs=1e-12, rel=0.0)


@given(coordinates, coordinates, radii, one_way)
def test_mirror_law(x, y, R, side):
    _, word, *durations = optimum(x, y, R, side, 0.0)
    assert optimum(x, -y, R, -side, 0.0) == (-side, mirrored(word), *durations)


@given(coordinates, coordinates, radii)
def test_either_is_the_better_of_the_two(x, y, R):
    both = [least_time(x, y, R, side) for side in (Side.CW, Side.CCW)]
    assert least_time(x, y, R, Side.EITHER) == pytest.approx(min(both), abs=blur(x, y, R))


@settings(max_examples=500)
@given(coordinates, coordinates, radii, sides)
def test_the_optimum_ends_at_the_target(x, y, R, side):
    assert miss(x, y, R, optimum(x, y, R, side, 0.0)) <= rounding(x, y, R)


@settings(max_examples=500)
@given(coordinates, coordinates, radii, sides, st.floats(0.0, 1.0))
@example(-1.4229643664435092e-11, 1.0000000000142295, 1.0, Side.CW, 0.75)  # next to the target and centre (0, 1)
def test_along_the_optimum_the_time_left_falls_at_unit_rate(x, y, R, side, share):
    held, word, *durations = optimum(x, y, R, side, 0.0)
    left = sum(durations)
    to_fly = share * left
    for letter, t in zip(Word(word).letters, durations, strict=False):
        step = min(t, to_fly)
        x, y = flow(x, y, {"L": 1, "S": 0, "R": -1}[letter], step)
        left, to_fly = left - step, to_fly - step
    # Rounding may lift the state off the last arc by more than its own rounding: the tolerance covers a flown state.
    now = duration(optimum(x, y, R, held, 4.0 * rounding(x, y, R)))
    assert now == pytest.approx(left, abs=blur(x, y, R))


@settings(max_examples=500)
@given(
    coordinates, coordinates, radii, sides, st.lists(st.tuples(st.floats(-1.0, 1.0), st.floats(0.0, 4.0)), max_size=4)
)
def test_nothing_beats_the_answer(x, y, R, side, pieces):
    """Bellman's inequality: after any admissible flight, turns of any radius included, the best is no sooner."""
    best = least_time(x, y, R, side)
    spent = 0.0
    for u, t in pieces:
        x, y = gentle_flow(x, y, u, t)
        spent += t
    # A flown state is only known to its rounding, and T may be lower somewhere within it.
    assert best <= spent + duration(optimum(x, y, R, side, 0.0)) + blur(x, y, R)


def gentle_flow(x, y, u, t):
    """The flow of (7) for a constant control of any size: a rotation by -u t about (0, -1/u)."""
    if abs(u) < 1e-6:
        return x + t + u * y * t, y - u * (x * t + t * t / 2.0)
    z = (complex(x, y) + 1j / u) * complex(cos(u * t), -sin(u * t)) - 1j / u
    return z.real, z.imag


@given(coordinates, coordinates, radii, sides)
def test_ranking_starts_with_the_optimum_and_is_in_order(x, y, R, side):
    maneuvers = ranked(x, y, R, side, 0.0)
    times = [duration(m) for m in maneuvers]
    assert times == sorted(times)
    assert times[0] == pytest.approx(least_time(x, y, R, side), abs=rounding(x, y, R))
    assert len(set(maneuvers)) == len(maneuvers)
    assert all(miss(x, y, R, m) <= rounding(x, y, R) for m in maneuvers)


@given(coordinates, coordinates)
def test_one_two_or_four_optimal_controls_at_unit_radius(x, y):
    count = len(optima(x, y, 1.0, Side.EITHER, 0.0))
    assert count in {1, 2, 4}
    assert count < 4 or y == pytest.approx(0.0, abs=1e-12)


# Section 6 of the paper for y = 0, in each of its cases; letters as flown.
ON_THE_AXIS = [
    (-3.0, {("SL", "cw"), ("SR", "ccw")}),
    (-SQRT3, {("L", "cw"), ("R", "ccw")}),
    (-1.0, {("LRL", "cw"), ("RLR", "ccw")}),
    (-1e-6, {("LRL", "cw"), ("RLR", "ccw")}),
    (0.0, {("RL", "cw"), ("LR", "ccw")}),
    (1.0, {("RL", "cw"), ("LR", "ccw")}),
    (SQRT3, {("L", "cw"), ("RL", "cw"), ("R", "ccw"), ("LR", "ccw")}),
    (3.0, {("LSL", "cw"), ("RSL", "cw"), ("RSR", "ccw"), ("LSR", "ccw")}),
]


@pytest.mark.parametrize(("x", "expected"), ON_THE_AXIS)
@pytest.mark.parametrize("y", [0.0, -0.0])
def test_ties_on_the_axis(x, y, expected):
    assert words(x, y) == expected


@pytest.mark.parametrize("y", [0.2, 0.7, 1.0, 2.5, 3.0])
@pytest.mark.parametrize("sign", [1, -1])
def test_two_optima_on_the_boundary_24_25(y, sign):
    """On x^2 + (y - sign y)^2 = 4 the first arc ends where the last begins; both last arcs take pi/3."""
    for x in (sqrt(4.0 - (y - 1.0) ** 2), -sqrt(4.0 - (y - 1.0) ** 2)):
        if x < 0.0 and y < 1.0:
            continue  # left of the target's arc (27) another word wins
        swap = str.maketrans("LR", "RL") if sign < 0 else {}
        expected = {
            ("RL".translate(swap), "cw" if sign > 0 else "ccw"),
            ("R".translate(swap), "ccw" if sign > 0 else "cw"),
        }
        assert words(x, sign * y) == expected


@pytest.mark.parametrize("y", [0.1, 0.5, 0.9])
@pytest.mark.parametrize("sign", [1, -1])
def test_no_switch_on_the_last_arc_27_and_a_jump_past_it(y, sign):
    x = -sqrt(3.0 - 2.0 * y - y * y)
    on, past = optimum(x, sign * y, 1.0, Side.EITHER, 0.0), optimum(x + 1e-9, sign * y, 1.0, Side.EITHER, 0.0)
    assert Word(on[1]).letters == ("L" if sign > 0 else "R")
    assert duration(on) < pi / 3
    assert duration(past) > duration(on) + pi
    # With a tolerance that covers the distance the small value comes back, and its miss says so.
    near = optimum(x + 1e-9, sign * y, 1.0, Side.EITHER, 1e-8)
    assert duration(near) == pytest.approx(duration(on), abs=1e-8)
    assert 0.0 < miss(x + 1e-9, sign * y, 1.0, near) <= 1e-8


@settings(max_examples=300)
@given(radii, sides, st.floats(1e-12, 1e-2), st.floats(-1.0, 1.0), st.floats(-1.0, 1.0), coordinates, coordinates)
def test_the_miss_stays_below_the_tolerance(R, side, tolerance, dx, dy, x, y):
    for state in ((x, y), (tolerance * dx, R + tolerance * dy), (tolerance * dx, -R + tolerance * dy)):
        assert miss(*state, R, optimum(*state, R, side, tolerance)) <= max(tolerance, rounding(*state, R))


@given(radii, one_way)
@example(1.0, Side.CW)
def test_at_the_target_nothing_is_left_to_do(R, side):
    held = optimum(0.0, side * R, R, side, 0.0)
    assert held == (side, Word.EMPTY, 0.0, 0.0, 0.0)
    assert first_control(R, held) == -side / R


@given(radii, one_way, st.floats(0.0, 2.0 * pi))
def test_at_the_target_up_to_rounding_nothing_is_left_to_do(R, side, azimuth):
    x, y = 3e-16 * R * cos(azimuth), side * R + 3e-16 * R * sin(azimuth)
    assert least_time(x, y, R, side) <= 1e-15 * R


@given(radii, one_way)
def test_on_the_circle_the_wrong_way_round_takes_a_maneuver(R, side):
    assert least_time(0.0, -side * R, R, side) > pi / 3


@pytest.mark.parametrize("R", [1.0, 1.5, 2.0, 5.0])
def test_at_the_centre_both_sides_tie(R):
    assert least_time(0.0, 0.0, R, Side.CW) == least_time(0.0, 0.0, R, Side.CCW)
    assert len(optima(0.0, 0.0, R, Side.EITHER, 0.0)) >= 2


@given(st.floats(0.0, 2.0 * pi), radii, sides)
def test_from_ten_million_radii_away(azimuth, R, side):
    x, y = 1e7 * cos(azimuth), 1e7 * sin(azimuth)
    maneuver = optimum(x, y, R, side, 0.0)
    assert miss(x, y, R, maneuver) <= 1e-9 * 1e7
    assert 1e7 - R - 2.0 <= duration(maneuver) <= 1e7 + R + 8.0


@pytest.mark.parametrize(
    ("x", "y", "R", "tolerance", "status"),
    [
        (0.0, 0.0, 1.0, 0.0, Status.OK),
        (nan, 0.0, 1.0, 0.0, Status.NOT_FINITE),
        (0.0, -inf, 1.0, 0.0, Status.NOT_FINITE),
        (0.0, 0.0, nan, 0.0, Status.NOT_FINITE),
        (0.0, 0.0, 0.999, 0.0, Status.RADIUS_TOO_SMALL),
        (0.0, 0.0, -2.0, 0.0, Status.RADIUS_TOO_SMALL),
        (1e300, 0.0, 1.0, 0.0, Status.OUT_OF_RANGE),
        (0.0, 0.0, 1e16, 0.0, Status.OUT_OF_RANGE),
        (0.0, 0.0, 1.0, -1e-9, Status.BAD_TOLERANCE),
        (0.0, 0.0, 1.0, nan, Status.BAD_TOLERANCE),
    ],
)
def test_what_cannot_be_solved_has_a_status(x, y, R, tolerance, status):
    assert status_of(x, y, R, tolerance) == status


@given(coordinates, coordinates, radii, sides, controls, st.floats(0.0, 3.0))
def test_the_feedback_law_is_the_first_letter(x, y, R, side, u, t):
    x, y = flow(x, y, u, t)
    best = optimum(x, y, R, side, 0.0)
    word = Word(best.word).letters
    assume(word)
    assert first_control(R, best) == {"L": 1.0, "S": 0.0, "R": -1.0}[word[0]]
