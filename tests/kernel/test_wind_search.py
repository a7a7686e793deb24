"""The fastest way onto a circle in wind: the laws it obeys, the hold, degenerate starts, and still air as its limit."""

from itertools import combinations, pairwise
from math import atan2, cos, hypot, inf, isnan, nan, pi, sin, sqrt

import pytest
from hypothesis import assume, example, given, settings
from hypothesis import strategies as st

from loiter.kernel.entry import duration, is_tie_in_wind
from loiter.kernel.motion import reduce
from loiter.kernel.rounding import rounding
from loiter.kernel.statuses import Status
from loiter.kernel.still_air.synthesis import optimum
from loiter.kernel.wind.hold import hold_pose, hold_rate, hold_time, phase_of, tightest_radius
from loiter.kernel.wind.paths import WindScene, first_path, join_slope
from loiter.kernel.wind.wind_search import WindProblem, fastest, optima, ranked
from loiter.kernel.words import Side, Word
from strategies import blur, coordinates, one_way, radii, sides, times_of

# A plain solve takes milliseconds, tens of them in a shallow valley on a busy machine.
settings.register_profile("drift", deadline=None, max_examples=30)
settings.load_profile("drift")

angles = st.one_of(st.floats(0.0, 2.0 * pi), st.sampled_from([0.0, pi / 2, pi, 3 * pi / 2]))
CONTROLS = {"L": 1.0, "S": 0.0, "R": -1.0}

WINDIEST = 0.6


@st.composite
def scenes(draw, windiest=WINDIEST):
    """Start, heading, radius, wind: what the kernel takes, but for the side."""
    # Below the square root of the least double directions have no digits; the kernel treats such winds as zero.
    wind = draw(st.one_of(st.just(0.0), st.floats(1e-100, windiest)))
    azimuth, angle = draw(angles), draw(angles)
    wx, wy = wind * cos(azimuth), wind * sin(azimuth)
    R = tightest_radius(wx, wy) * draw(st.one_of(st.just(1.0), st.floats(1.0, 2.5)))
    return draw(coordinates), draw(coordinates), cos(angle), sin(angle), R, wx, wy


def solved(scene, side):
    x, y, c, s, R, wx, wy = scene
    return fastest(WindProblem(x, y, c, s, R, side, wx, wy))


def least_time(scene, side):
    status, _, _, t1, t2, t3, _, _ = solved(scene, side)
    assert status == Status.OK
    return t1 + t2 + t3


def steps(maneuver):
    return [(CONTROLS[letter], t) for letter, t in zip(Word(maneuver.word).letters, times_of(maneuver), strict=False)]


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
    """How far rounding of the start, or of a flight, may move T: as in still air, over the least ground speed.

    Four times that: still air's share is for the last circle alone, and here either may be touched, at either end.
    """
    x, y, _, _, R, wx, wy = scene
    return 4.0 * blur(abs(x) + time, y, R) / (1.0 - hypot(wx, wy))


@pytest.mark.parametrize("wind", [(5e-324, 0.0), (5e-324, 5e-324), (0.0, -1e-310), (1e-200, 1e-200)])
def test_in_the_lightest_winds_the_hold_is_on_the_circle(wind):
    x, y, c, s, speed = hold_pose(0.7, 1, 3.0, *wind)
    assert (hypot(x, y), hypot(c, s), speed) == pytest.approx((3.0, 1.0, 1.0), rel=1e-15)


@given(scenes(), sides)
def test_the_end_is_on_the_circle_and_along_it(scene, side):
    status, held_side, *_, angle, miss = maneuver = solved(scene, side)
    x, y, c, s, R, wx, wy = flown(scene, steps(maneuver))
    size = 2.0 * rounding(*scene[:2], R) + 1e-14 * sum(times_of(maneuver))
    assert status == Status.OK
    assert hypot(x, y) == pytest.approx(R, abs=size)
    assert hypot(x - R * cos(angle), y - R * sin(angle)) <= size
    assert miss <= size
    # Over the ground the vehicle moves along the circle, the right way round.
    vx, vy = c + wx, s + wy
    assert (x * vx + y * vy) / R == pytest.approx(0.0, abs=size)
    assert (x * vy - y * vx) * held_side < 0.0
    assert side in (Side.EITHER, held_side)
    assert min(times_of(maneuver)) >= 0.0


@given(scenes(), sides, st.floats(-3.0, 3.0), st.floats(-3.0, 3.0))
def test_a_moving_circle_is_a_fixed_one_in_the_wind_that_blows_past_it(scene, side, vx, vy):
    """Flown over the ground, in the wind w + v, the maneuver ends on the circle that has moved with v."""
    maneuver = solved(scene, side)
    x, y, c, s, R, wx, wy = scene
    over_ground = flown((x, y, c, s, R, wx + vx, wy + vy), steps(maneuver))
    time = sum(times_of(maneuver))
    assert hypot(over_ground[0] - vx * time, over_ground[1] - vy * time) == pytest.approx(R, abs=1e-12 * (100.0 + time))


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
    assert sum(times_of(one)) == pytest.approx(sum(times_of(other)), abs=moved(scene, sum(times_of(one))))
    assume(times_of(one) == pytest.approx(times_of(other), abs=1e-6))
    assert other.side == -one.side


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


@given(st.floats(1.01, 4.0), st.floats(0.2, 30.0), angles, st.floats(-9.0, -3.0), angles)
@example(1.5, 20.386242, 2.284454, -6.0, pi / 2)
def test_of_two_valleys_almost_as_deep_the_deeper_is_found(R, beyond, angle, magnitude, azimuth):
    """From whose way leads straight to the centre the two directions differ by what a light wind makes of them."""
    wind = 10.0**magnitude
    scene = -R - beyond, 0.0, cos(angle), sin(angle), R, wind * cos(azimuth), wind * sin(azimuth)
    least = min(least_time(scene, side) for side in (Side.CW, Side.CCW))
    assert is_tie_in_wind(least_time(scene, Side.EITHER), least, R)


@settings(max_examples=12)
@given(scenes(), st.floats(-12.0, -4.0))
def test_next_to_a_tie_the_sooner_direction_is_found(scene, magnitude):
    """The heading where clockwise and counter-clockwise tie, by bisection, and a little to either side of it."""

    def heading(angle):
        x, y, _, _, *rest = scene
        return x, y, cos(angle), sin(angle), *rest

    def lead(angle):
        return least_time(heading(angle), Side.CW) - least_time(heading(angle), Side.CCW)

    leads = [(i * pi / 4, lead(i * pi / 4)) for i in range(9)]
    changes = [(a, b, before) for (a, before), (b, after) in pairwise(leads) if before * after < 0.0]
    assume(changes)
    low, high, below = changes[0]
    for _ in range(40):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if below * lead(middle) > 0.0 else (low, middle)
    for angle in (low, low - 10.0**magnitude, low + 10.0**magnitude):
        there = heading(angle)
        least = min(least_time(there, side) for side in (Side.CW, Side.CCW))
        assert is_tie_in_wind(least_time(there, Side.EITHER), least, scene[4])


@given(scenes(), sides, st.floats(0.0, 1.0))
def test_along_the_optimum_the_time_left_falls_at_unit_rate(scene, side, share):
    maneuver = solved(scene, side)
    time = sum(times_of(maneuver))
    to_fly, pieces = share * time, []
    for u, t in steps(maneuver):
        pieces.append((u, min(t, to_fly)))
        to_fly -= pieces[-1][1]
    left = least_time(flown(scene, pieces), maneuver.side)
    assert left == pytest.approx((1.0 - share) * time, abs=moved(scene, time))


pieces_of_flight = st.lists(st.tuples(st.floats(-1.0, 1.0), st.floats(0.0, 4.0)), max_size=3)


@given(scenes(), sides, pieces_of_flight)
def test_nothing_beats_the_answer(scene, side, pieces):
    """Bellman's inequality: after any admissible flight, turns of any radius included, the best is no sooner."""
    spent = sum(t for _, t in pieces)
    after = least_time(flown(scene, pieces), side)
    assert least_time(scene, side) <= spent + after + moved(scene, spent + after)


@given(scenes(), sides, st.sampled_from([-1.0, 1.0]))
def test_a_whole_turn_first_never_helps(scene, side, u):
    """The words leave out arcs of a whole turn and more."""
    after = least_time(flown(scene, [(u, 2.0 * pi)]), side)
    assert least_time(scene, side) <= 2.0 * pi + after + moved(scene, 2.0 * pi + after)


@given(scenes(), one_way, st.floats(0.0, 2.0 * pi), st.floats(0.0, 1.0))
def test_a_path_that_joins_can_follow_the_circle(scene, side, phase, width):
    """T(s') <= T(s) + (s' - s): what branch and bound rests on, for the first paths as computed."""
    x, y, _, _, R, wx, wy = scene
    inner = WindScene(*scene, rounding(x, y, R) / 3.0)
    ahead = phase + width * (2.0 * pi - phase)
    earlier, later = (first_path(p, side, inner, inf)[0] for p in (phase, ahead))
    parts = [phase + (ahead - phase) * i / 50 for i in range(51)]
    hold = sum(hold_time(b, b - a, side, R, wx, wy) for a, b in pairwise(parts))
    assert earlier < inf
    assert later <= earlier + hold + moved(scene, later)


@given(scenes(), one_way, st.floats(0.0, 2.0 * pi))
def test_the_slope_is_the_derivative_of_the_time(scene, side, phase):
    x, y, _, _, R, wx, wy = scene
    inner, h = WindScene(*scene, rounding(x, y, R) / 3.0), 1e-5
    ways = [first_path(phase + d, side, inner, inf) for d in (-h, 0.0, h)]
    there = join_slope(ways[1], phase, side, inner)
    speed = hold_pose(phase, side, R, wx, wy)[4]
    measured = (ways[2][0] - ways[0][0]) / (2.0 * h * R / speed)
    assert there <= 1.0 + 1e-9
    # Next to where a piece vanishes neither is to be had.
    assume(len({way[1] for way in ways}) == 1 and min(ways[1][2:5]) > 0.05 and abs(ways[2][0] - ways[0][0]) < 0.05)
    assume(abs(ways[2][0] - 2.0 * ways[1][0] + ways[0][0]) < 1e-8)
    assert measured == pytest.approx(there, abs=1e-3)


@given(scenes(), sides)
def test_the_adjoint_of_three_pieces_is_transversal(scene, side):
    """(5), worked out from the maneuver alone: the straight piece gives p, or the headings at the switches do."""
    maneuver = solved(scene, side)
    pieces = steps(maneuver)
    assume(len(pieces) == 3 and min(t for _, t in pieces) > 1e-3)
    before, (u, t) = complex(*flown(scene, pieces[:1])[2:4]), pieces[1]
    p, lam = before, 1.0
    if u:
        p, lam = -before * complex(cos(u * t / 2), sin(u * t / 2)), -cos(t / 2)
    x, y, c, s, R, wx, wy = flown(scene, pieces)
    e, w, last, hold = complex(c, s), complex(wx, wy), pieces[2][0], -maneuver.side
    k = hold_rate(phase_of(x, y, maneuver.side, wx, wy), maneuver.side, R, wx, wy)
    along = (p.conjugate() * e).real
    residual = (p.conjugate() * (e + w)).real + last * hold * k * (lam - along)
    assert lam + (p.conjugate() * w).real >= -1e-9
    assert residual == pytest.approx(0.0, abs=1e-6)


@given(scenes(), one_way, st.floats(0.0, 2.0 * pi))
def test_the_hold_flies_along_the_circle_at_its_rate(scene, side, phase):
    *_, R, wx, wy = scene
    h = 1e-6
    (x0, y0, c0, s0, _), (x, y, c, s, g), (x1, y1, c1, s1, _) = (
        hold_pose(phase + d, side, R, wx, wy) for d in (-h, 0, h)
    )
    assert (x1 - x0, y1 - y0) == pytest.approx((2 * h * R * (c + wx) / g, 2 * h * R * (s + wy) / g), abs=1e-9)
    turned, time = atan2(c0 * s1 - s0 * c1, c0 * c1 + s0 * s1), 2 * h * R / g
    assert turned / time == pytest.approx(-side * hold_rate(phase, side, R, wx, wy), abs=1e-6)
    assert (
        phase_of(x, y, side, wx, wy) == pytest.approx(phase % (2.0 * pi), abs=1e-9) or phase_of(x, y, side, wx, wy) > 6
    )


@given(st.floats(0.0, 0.95), angles, one_way)
def test_the_tightest_circle_takes_the_full_rate_downwind_and_nowhere_more(wind, azimuth, side):
    wx, wy = wind * cos(azimuth), wind * sin(azimuth)
    R = tightest_radius(wx, wy)
    rates = [hold_rate(2.0 * pi * i / 360, side, R, wx, wy) for i in range(360)]
    assert max(rates) == pytest.approx(1.0, abs=1e-12)
    assert rates[180] == pytest.approx(1.0, abs=1e-12)


@given(scenes(), one_way, st.floats(0.0, 2.0 * pi))
def test_on_the_circle_and_along_it_nothing_is_left_to_do(scene, side, phase):
    *_, R, wx, wy = scene
    x, y, c, s, _ = hold_pose(phase, side, R, wx, wy)
    for asked in (side, Side.EITHER):
        status, held_side, word, *durations, angle, miss = fastest(WindProblem(x, y, c, s, R, asked, wx, wy))
        assert (status, held_side, word, durations) == (Status.OK, side, Word.EMPTY, [0.0, 0.0, 0.0])
        assert cos(angle - atan2(y, x)) == pytest.approx(1.0)
        assert miss <= rounding(x, y, R)
    assert least_time((x, y, c, s, R, wx, wy), -side) > 1.0


@given(scenes(), one_way, st.floats(0.0, 2.0 * pi), st.sampled_from([-1.0, 1.0]), st.floats(0.1, 1.5))
def test_a_start_on_the_last_arc_gets_that_arc_alone(scene, side, phase, u, time):
    """Flown backwards from the circle. T rises with the root of a distance there, so few digits may be lost.

    The closer the rates of turn of the arc and of the circle, the less distinct is the point where they part.
    """
    *_, R, wx, wy = scene
    x, y, c, s, _ = hold_pose(phase, side, R, wx, wy)
    parting = max(1.0 + u * side * hold_rate(phase, side, R, wx, wy), 1e-9)
    back = cos(u * time), -sin(u * time)
    e = complex(c, s)
    e0 = e * complex(*back)
    z = complex(x, y) - complex(wx, wy) * time - (e - e0) / (1j * u)
    found = solved((z.real, z.imag, e0.real, e0.imag, R, wx, wy), side)
    assume(sum(times_of(found)) > time - 1e-4)
    assert sum(times_of(found)) == pytest.approx(time, abs=1e-11 + 1e-12 / parting)


@pytest.mark.parametrize("wind", [5e-324, 1e-310, 1e-200, 1e-17])
def test_negligible_wind_is_treated_as_zero(wind):
    calm, windy = (least_time((3.0, 1.0, 0.6, 0.8, 2.0, w, w), Side.EITHER) for w in (0.0, wind))
    assert windy == pytest.approx(calm, abs=1e-14)


@pytest.mark.parametrize("wind", [0.95, 0.99])
def test_almost_as_windy_as_the_aircraft_is_fast(wind):
    for i in range(12):
        scene = (6.0 * cos(i), 6.0 * sin(i), cos(3 * i), sin(3 * i), tightest_radius(wind, 0.0), wind, 0.0)
        assert 0.0 < least_time(scene, Side.EITHER) < 40.0 / (1.0 - wind)


@pytest.mark.parametrize(
    ("change", "status"),
    [
        ({"R": 1.21}, Status.OK),
        ({"R": 1.2}, Status.NOT_HELD),
        ({"R": 0.99}, Status.RADIUS_TOO_SMALL),
        ({"wx": 1.0}, Status.WIND_TOO_STRONG),
        ({"wx": -0.8, "wy": 0.8}, Status.WIND_TOO_STRONG),
        ({"x": nan}, Status.NOT_FINITE),
        ({"s": nan}, Status.NOT_FINITE),
        ({"wy": inf}, Status.NOT_FINITE),
        ({"R": nan}, Status.NOT_FINITE),
        ({"y": 1e17}, Status.OUT_OF_RANGE),
    ],
)
def test_what_cannot_be_solved_has_a_status(change, status):
    arguments = {"x": 3.0, "y": 1.0, "c": 1.0, "s": 0.0, "R": 2.0, "side": Side.CW, "wx": 0.0, "wy": 0.1} | change
    answer = fastest(WindProblem(**arguments))
    assert answer[0] == status
    assert Status(answer[0]).message
    assert isnan(answer[3]) == (status != Status.OK)


@given(scenes(), sides)
def test_what_is_ranked_begins_with_the_fastest_and_ends_on_the_circle(scene, side):
    x, y, c, s, R, wx, wy = scene
    found = ranked(WindProblem(x, y, c, s, R, side, wx, wy))
    times = [sum(times_of(maneuver)) for maneuver in found]
    assert times == sorted(times)
    assert times[0] == pytest.approx(least_time(scene, side), abs=moved(scene, times[0]))
    assert {maneuver.side for maneuver in found} == ({1, -1} if side == Side.EITHER else {side})
    tied = optima(WindProblem(x, y, c, s, R, side, wx, wy))
    assert tied == found[: len(tied)]
    assert sum(tied[-1][3:6]) <= times[0] + 1e-11 * (R + times[0])
    for status, *_, miss in found:
        assert status == Status.OK
        assert miss <= 2.0 * rounding(x, y, R) + 1e-14 * times[-1]


@given(scenes(), one_way)
def test_no_point_beside_a_ranked_one_is_met_sooner(scene, side):
    x, y, c, s, R, wx, wy = scene
    inner = WindScene(*scene, rounding(x, y, R) / 3.0)
    for _, held_side, _, t1, t2, t3, azimuth, _ in ranked(WindProblem(x, y, c, s, R, side, wx, wy)):
        phase, time = phase_of(cos(azimuth), sin(azimuth), held_side, wx, wy), t1 + t2 + t3
        beside = [first_path(phase + d, held_side, inner, inf)[0] for d in (-1e-4, 1e-4)]
        assert min(beside) >= time - moved(scene, time)


def test_a_side_without_an_answer_leaves_none(monkeypatch):
    monkeypatch.setattr("loiter.kernel.wind.wind_search.end_miss", lambda *_: nan)
    assert ranked(WindProblem(3.0, 1.0, 1.0, 0.0, 2.0, Side.EITHER, 0.1, 0.0)) == []


VALLEYS_SEEN = 64


def valleys_seen(scene, side):
    """Phases of points of joining, of `VALLEYS_SEEN` all round, that are met sooner than both next to them."""
    x, y, _, _, R, _, _ = scene
    inner, step = WindScene(*scene, rounding(x, y, R) / 3.0), 2.0 * pi / VALLEYS_SEEN
    times = [first_path(step * i, side, inner, inf).time for i in range(VALLEYS_SEEN)]
    margin = moved(scene, max(times))
    return [
        step * i for i, time in enumerate(times) if time + margin < min(times[i - 1], times[(i + 1) % VALLEYS_SEEN])
    ]


@given(scenes(), sides)
@example((3.0, 1.0, 0.6, 0.8, 2.0, 0.2, -0.1), Side.EITHER)
def test_each_valley_is_ranked_once(scene, side):
    """Two points of joining of one side are two maneuvers; the fastest, which is found twice, is one."""
    *_, wx, wy = scene
    found = ranked(WindProblem(*scene[:5], side, wx, wy))
    phases = [(m.side, phase_of(cos(m.azimuth), sin(m.azimuth), m.side, wx, wy)) for m in found]
    for one in sorted({m.side for m in found}):
        joins = [phase for held_side, phase in phases if held_side == one]
        for valley in valleys_seen(scene, one):
            assert min(abs((phase - valley + pi) % (2.0 * pi) - pi) for phase in joins) < 2.0 * pi / VALLEYS_SEEN
    for a, b in combinations(found, 2):
        assert (a.side, a.word) != (b.side, b.word) or times_of(a) != pytest.approx(times_of(b), abs=1e-9)
