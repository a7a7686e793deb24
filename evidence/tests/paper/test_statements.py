"""Statements of the paper, section by section, against the kernel: R = 1. paper.md says which is tested where."""

from functools import cache
from itertools import pairwise
from math import acos, cbrt, cos, hypot, inf, pi, sin, sqrt

import numpy as np
import pytest

import loiter
from evidence.tests.paper.printed import T1, T, curve_23, on_left_circle, on_right_circle, root_21
from golden.paper import ADMISSIBLE, EXAMPLES
from kernel.adjoint_along import StateAndAdjoint, state_and_adjoint_at
from loiter.kernel.adjoint import adjoint, switching_function, turn_adjoint
from loiter.kernel.entry import duration, miss
from loiter.kernel.motion import flow, reduce
from loiter.kernel.rebinding import rebound
from loiter.kernel.rounding import rounding
from loiter.kernel.still_air.switching_curves import beyond_last_circle, switching_abscissa
from loiter.kernel.still_air.synthesis import optima, optimum, ranked
from loiter.kernel.words import Side, Word
from strategies import times_of

SQRT3 = sqrt(3.0)
CONTROLS = {"L": 1, "S": 0, "R": -1}
REACH = 4.0
# Rounding of lengths and times of the states drawn here.
LENGTH_TOLERANCE = rounding(REACH, REACH, 1.0)
UNCLEAR = cbrt(24.0 * LENGTH_TOLERANCE)
flow_arrays = rebound(flow, {"sin": np.sin, "cos": np.cos})


def states(count, seed=1):
    return np.random.default_rng(seed).uniform(-REACH, REACH, (count, 2)).tolist()


def best(x, y, side=Side.EITHER):
    return optimum(x, y, 1.0, side, 0.0)


def letters(maneuver):
    return Word(maneuver.word).letters


def switching_points(x, y, maneuver):
    """The states at which one piece gives way to the next, then the end."""
    points = []
    for letter, t in zip(letters(maneuver), times_of(maneuver), strict=False):
        x, y = flow(x, y, CONTROLS[letter], t)
        points.append((x, y))
    return points


def named(word, x, y):
    """Time of the fastest extremal of this word onto the clockwise circle."""
    return min(duration(m) for m in ranked(x, y, 1.0, Side.CW, 0.0) if letters(m) == word)


@cache
def optimal():
    """Starts and their optima, two-endpoint problem."""
    return [(x, y, best(x, y)) for x, y in states(500)]


@cache
def swarm():
    """A million starts and their solutions."""
    x, y = np.random.default_rng(2).uniform(-REACH, REACH, (2, 1_000_000))
    return x, y, loiter.solve(x, y)


def words_of(swarm_words):
    return {Word(int(code)).letters for code in np.unique(swarm_words)}


# Introduction


@pytest.mark.parametrize("tau", [0.0, 0.4, 2.0, 3.7, 6.1])
def test_4_to_6_on_the_circle_the_reduced_state_is_one_point(tau):
    for side, theta in ((Side.CCW, tau + pi / 2.0), (Side.CW, tau - pi / 2.0)):
        assert reduce(cos(tau), sin(tau), cos(theta), sin(theta)) == pytest.approx((0.0, side), abs=LENGTH_TOLERANCE)


@pytest.mark.parametrize(("side", "end"), [(Side.CCW, -1.0), (Side.CW, 1.0)])
def test_8_and_9_each_direction_has_its_end_point(side, end):
    for x, y in states(200):
        [*_, last] = switching_points(x, y, best(x, y, side))
        assert last == pytest.approx((0.0, end), abs=LENGTH_TOLERANCE)


def test_10_with_two_end_points_the_sooner_is_chosen():
    for x, y, maneuver in optimal():
        both = [duration(best(x, y, side)) for side in (Side.CW, Side.CCW)]
        assert duration(maneuver) == pytest.approx(min(both), abs=LENGTH_TOLERANCE)


def test_a_solution_exists_from_everywhere():
    assert np.all(np.isfinite(swarm()[2].time))
    assert swarm()[2].miss.max() <= LENGTH_TOLERANCE


# Section 1


def test_optimal_is_one_end_point_optimal_but_not_the_converse():
    for x, y, maneuver in optimal():
        assert best(x, y, maneuver.side) == maneuver
    assert duration(best(0.5, -1.5, Side.CW)) > duration(best(0.5, -1.5)) + 1.0


def along(x, y, maneuver, count=7):
    """lambda, then instants of a maneuver with its adjoint: control, x, y, psi1, psi2, phi."""
    lam, psi1, psi2 = adjoint(x, y, 1.0, maneuver)
    instants, begun = [], 0.0
    for letter, t in zip(letters(maneuver), times_of(maneuver), strict=False):
        for share in np.linspace(0.0, 1.0, count).tolist():
            now = state_and_adjoint_at(StateAndAdjoint(x, y, psi1, psi2), maneuver, begun + share * t)
            instants.append((CONTROLS[letter], *now, switching_function(*now)))
        begun += t
    return lam, instants


def test_11_to_14_the_control_maximises_and_the_maximum_is_lambda():
    for start in optimal():
        lam, instants = along(*start)
        assert lam >= 0.0
        for u, x, y, psi1, psi2, phi in instants:
            hamiltonian = psi1 * (u * y + 1.0) - psi2 * u * x
            assert hamiltonian == pytest.approx(u * phi + psi1, abs=LENGTH_TOLERANCE)  # (11), (15)
            assert u * phi == pytest.approx(abs(phi), abs=LENGTH_TOLERANCE)  # (13)
            assert abs(phi) + psi1 == pytest.approx(lam, abs=LENGTH_TOLERANCE)  # (14)


def test_16_and_18_psi_keeps_its_length_and_left_of_lambda():
    for start in optimal():
        lam, instants = along(*start)
        for _, _, _, psi1, psi2, _ in instants:
            assert psi1 <= lam + LENGTH_TOLERANCE
            assert hypot(psi1, psi2) == pytest.approx(1.0, abs=LENGTH_TOLERANCE)


def test_12_and_17_the_derivatives_of_psi_and_phi():
    step = 2.0**-13  # truncation step^2/6 and rounding LENGTH_TOLERANCE/step are alike: some 2e-9
    bound = 4.0 * (REACH * step**2 / 6.0 + LENGTH_TOLERANCE / step)
    for x, y, maneuver in optimal():
        _, psi1, psi2 = adjoint(x, y, 1.0, maneuver)
        if maneuver.t1 < 2.0 * step:
            continue
        u = CONTROLS[letters(maneuver)[0]]
        three = [state_and_adjoint_at(StateAndAdjoint(x, y, psi1, psi2), maneuver, k * step) for k in range(3)]
        slopes = [(after - before) / (2.0 * step) for before, after in zip(three[0], three[2], strict=True)]
        assert slopes[2:] == pytest.approx([u * three[1][3], -u * three[1][2]], abs=bound)
        phi = [switching_function(*now) for now in three]
        assert (phi[2] - phi[0]) / (2.0 * step) == pytest.approx(-three[1][3], abs=bound)


# Section 2


def test_a_turn_goes_round_its_centre_in_its_sense():
    for x, y in states(50):
        for u in (1, -1):
            x1, y1 = flow(x, y, u, 0.1)
            assert hypot(x1, y1 + u) == pytest.approx(hypot(x, y + u), abs=LENGTH_TOLERANCE)
            assert u * ((y + u) * x1 - x * (y1 + u)) > 0.0  # clockwise for u = 1


def test_the_last_control_is_that_of_the_end_point():
    for _, _, maneuver in optimal():
        assert CONTROLS[letters(maneuver)[-1]] == maneuver.side


def test_between_switches_lambda_is_passed_and_more_than_half_a_turn():
    two = [start for start in optimal() if letters(start[2]) in {"LRL", "RLR"}]
    assert len(two) > 5
    for x, y, maneuver in two:
        first, middle, last = times_of(maneuver)
        lam, psi1, psi2 = adjoint(x, y, 1.0, maneuver)
        for t in (first, first + middle):
            now = state_and_adjoint_at(StateAndAdjoint(x, y, psi1, psi2), maneuver, t)
            assert now[2] == pytest.approx(lam, abs=LENGTH_TOLERANCE)
            assert switching_function(*now) == pytest.approx(0.0, abs=LENGTH_TOLERANCE)
        assert 0.0 < lam < 1.0
        assert middle == pytest.approx(2.0 * (pi - acos(lam)), abs=LENGTH_TOLERANCE / sqrt(1.0 - lam * lam))
        assert pi < middle
        assert first <= middle
        assert last < middle


def test_at_the_end_psi1_is_half_of_lambda():
    for start in optimal():
        lam, instants = along(*start)
        assert instants[-1][3] == pytest.approx(lam / 2.0, abs=LENGTH_TOLERANCE)


def test_a_singular_piece_lies_on_the_axis_and_lasts_as_long_as_it_is():
    singular = [start for start in optimal() if "S" in letters(start[2])]
    assert len(singular) > 100
    for x, y, maneuver in singular:
        lam, instants = along(x, y, maneuver)
        straight = [now for now in instants if now[0] == 0]
        assert lam == 1.0
        for _, _, y1, psi1, psi2, phi in straight:
            assert (y1, psi1, psi2, phi) == pytest.approx((0.0, 1.0, 0.0, 0.0), abs=LENGTH_TOLERANCE)
        assert straight[-1][1] - straight[0][1] == pytest.approx(maneuver[3], abs=LENGTH_TOLERANCE)


def test_two_types_of_optimal_trajectories():
    """One straight piece at most, then pi/3 from (-sqrt 3, 0); or turns alone, at most three."""
    assert words_of(swarm()[2].word) <= {"RSL", "LSR", "RL", "LR", "LRL", "RLR"}
    for x, y, maneuver in optimal():
        if "S" in letters(maneuver):
            assert maneuver[4] == pytest.approx(pi / 3.0, abs=LENGTH_TOLERANCE)
            assert switching_points(x, y, maneuver)[1] == pytest.approx((-SQRT3, 0.0), abs=LENGTH_TOLERANCE)


def test_t1_beats_t_so_lambda_zero_has_no_switch():
    assert T(0.0) == pytest.approx(pi, abs=LENGTH_TOLERANCE)
    assert T1(0.0) == pytest.approx(pi, abs=LENGTH_TOLERANCE)
    step = 2.0**-17  # of a central difference: truncation step^2, rounding 2**-50/step, both below 2e-10
    assert (T1(step) - T1(-step)) / (2.0 * step) == pytest.approx(-2.0, abs=1e-9)
    for xi in (1e-6, 1e-3, 0.01, 0.1, 0.3, 1.0):
        assert T1(xi) < T(xi)


@pytest.mark.parametrize("xi", [0.01, 0.1, 0.5, 1.0])
def test_t_and_t1_are_the_kernels_rl_and_lsl(xi):
    x, y = -4.0 * sin(xi), 1.0 - 4.0 * cos(xi)
    # The circle of radius 4 about (0, 1) touches the last one at (0, -3), so rounding may lift the start over the edge
    # of what RL reaches. A radius smaller by a share e makes x1 = 4 sqrt(2 e), and T less by x1/4 + x1/2.
    e = 1e-7
    inside = named("RL", (1.0 - e) * x, 1.0 + (1.0 - e) * (y - 1.0))
    assert inside + 3.0 * sqrt(2.0 * e) == pytest.approx(T(xi), abs=10.0 * e)
    assert named("LSL", x, y) == pytest.approx(T1(xi), abs=LENGTH_TOLERANCE)
    assert duration(best(x, y, Side.CW)) <= T1(xi) + LENGTH_TOLERANCE


@pytest.mark.parametrize("left", [0.1, 1.0, pi / 3.0, 2.0, 3.0])
def test_lambda_zero_belongs_to_the_left_half_of_the_last_circle(left):
    """One end point: L alone, with psi(T) = (0, 1), obeys (13) and (14) for half a turn before the end, and no more."""
    alone = best(-2.0 * sin(left), 2.0 * cos(left) - 1.0, Side.CW)
    assert (letters(alone), duration(alone)) == ("L", pytest.approx(left, abs=LENGTH_TOLERANCE))
    for before in (left, pi + left):
        psi1, psi2 = turn_adjoint(0.0, 1.0, 1, -before)
        phi = switching_function(*flow(0.0, 1.0, 1, -before), psi1, psi2)
        assert phi + psi1 == pytest.approx(0.0, abs=LENGTH_TOLERANCE)
        assert (phi > 0.0) == (before < pi)


# Section 3


def last_pieces(solution):
    durations = solution.durations
    return np.take_along_axis(durations, ((durations > 0.0).sum(-1) - 1)[:, np.newaxis], -1)[:, 0]


def test_the_last_piece_is_no_longer_than_a_sixth_of_a_turn():
    # Where a straight piece of length s vanishes, T with and without it differs by s^3/24: up to UNCLEAR rounding may
    # choose the word without it, whose last arc then begins that much earlier, on a circle of radius 2.
    assert last_pieces(swarm()[2]).max() <= pi / 3.0 + UNCLEAR / 2.0


def test_with_one_end_point_the_last_piece_may_be_longer():
    x, y = np.array(states(10_000)).T
    assert last_pieces(loiter.solve(x, y, turn="cw")).max() > 2.0


# Section 4


def switch_pairs():
    """The two switching points of each LRL among the optima, mirrored to the upper half where it is RLR."""
    for x, y, maneuver in optimal():
        if letters(maneuver) in {"LRL", "RLR"}:
            (xa, ya), (xb, yb), _ = switching_points(x, y, maneuver)
            yield xa, maneuver.side * ya, xb, maneuver.side * yb


def test_19_to_23_two_switches_lie_where_the_paper_says():
    for x, y, x1, y1 in switch_pairs():
        assert x1 * x1 + (y1 + 1.0) ** 2 == pytest.approx(4.0, abs=LENGTH_TOLERANCE)  # (19), line by line
        assert hypot(x1, y1 - 1.0) == pytest.approx(hypot(x, y - 1.0), abs=LENGTH_TOLERANCE)
        assert x1 * y == pytest.approx(-x * y1, abs=LENGTH_TOLERANCE)
        a = (x / y) ** 2 + 1.0
        # a is known to the rounding of x/y, that is of 1/y.
        assert a * (y1 + y) == pytest.approx(2.0, abs=LENGTH_TOLERANCE / y**2)  # (20)
        assert a == pytest.approx(root_21(y), abs=LENGTH_TOLERANCE / y**2)  # (21)
        assert x == pytest.approx(curve_23(y), abs=LENGTH_TOLERANCE / x)  # (22)
        assert switching_abscissa(y, 1.0) == pytest.approx(curve_23(y), abs=LENGTH_TOLERANCE / x)


def test_23_is_symmetric_and_ends_on_the_axis():
    assert switching_abscissa(0.0, 1.0) == 0.0
    assert curve_23(0.0) == curve_23(1.0) == 0.0
    # The square is known to a few roundings, its root to their root.
    assert switching_abscissa(1.0, 1.0) == pytest.approx(0.0, abs=sqrt(LENGTH_TOLERANCE))
    below = best(-0.53, -0.31)
    assert letters(below) == "RLR"
    x, y = switching_points(-0.53, -0.31, below)[0]
    assert x == pytest.approx(curve_23(y), abs=LENGTH_TOLERANCE / x)


@pytest.mark.parametrize("b", [0.1, 0.5, 1.0])
def test_a_full_loop_back_onto_the_last_circle_loses(b):
    """Section 4, y1 = y: from the right part of the last circle, R to its left part at once beats L before R."""
    x, y = 2.0 * sin(b), 2.0 * cos(b) - 1.0
    for further in (0.05, 0.2):
        assert named("RL", x, y) < further + named("RL", *flow(x, y, 1, further))


def test_a_last_switch_has_one_before_it_only_near_the_target():
    """x1^2 + (y1 - 1)^2 <= 1 for two switches; past the axis, where it is more, RL has one."""
    assert all(hypot(x1, y1 - 1.0) <= 1.0 + LENGTH_TOLERANCE for _, _, x1, y1 in switch_pairs())
    x, y = 1.0, 0.5
    assert letters(best(x, y)) == "RL"
    assert hypot(*np.subtract(switching_points(x, y, best(x, y))[0], (0.0, 1.0))) > 1.0


def test_a_last_switch_in_the_disk_has_exactly_one_before_it():
    """On the last circle the disk is y1 >= 3/4; (19) and (20) leave one y, which increases with y1 from 0 to 1."""
    before = [y1 * (4.0 * y1 - 3.0) / (3.0 - 2.0 * y1) for y1 in np.linspace(0.75, 1.0, 101)]
    assert (before[0], before[-1]) == pytest.approx((0.0, 1.0))
    assert all(a < b for a, b in pairwise(before))
    for y1, y in zip(np.linspace(0.75, 1.0, 101)[1:-1], before[1:-1], strict=True):
        x1 = -sqrt(4.0 - (y1 + 1.0) ** 2)
        assert x1 * x1 + (y1 - 1.0) ** 2 <= 1.0
        # On the line of (19), on the circle of the switch about (0, 1), and on the curve (22).
        x = -x1 / y1 * y
        assert hypot(x, y - 1.0) == pytest.approx(hypot(x1, y1 - 1.0), abs=LENGTH_TOLERANCE)
        assert x == pytest.approx(switching_abscissa(y, 1.0), abs=1e-9)


def test_no_more_than_two_switches():
    assert max(len(word) for word in words_of(swarm()[2].word)) == 3


# Section 5


def test_an_optimum_stays_in_the_half_plane_of_its_start():
    x, y, solution = (part[:100_000] if isinstance(part, np.ndarray) else part for part in swarm())
    lowest = np.full(x.shape, inf)
    x, y, up, word = x, np.abs(y), np.sign(y), solution.word[: len(x)].astype(int)
    for k in range(3):
        # Mirrored to the upper half, where the control changes sign too.
        u = np.where(word > 0, (word & 3) - 2, 0) * np.where(up < 0.0, -1, 1)
        t = solution.durations[: len(x), k]
        for share in np.linspace(0.0, 1.0, 33)[1:]:
            lowest = np.minimum(lowest, flown(x, y, u, share * t)[1])
        x, y = flown(x, y, u, t)
        word = word >> 2
    assert lowest.min() >= -LENGTH_TOLERANCE


def flown(x, y, u, t):
    """The flow of arrays of states, each with its control."""
    places = [np.broadcast_arrays(*flow_arrays(x, y, v, t)) for v in (-1, 0, 1)]
    return tuple(np.choose(u + 1, [place[k] for place in places]) for k in (0, 1))


def test_folded_at_the_axis_a_trajectory_is_one_still():
    """(x, |y|) obeys (7) with u sign y: L along the last circle, from below the axis."""
    x, y = flow(0.0, 1.0, 1, -2.0)
    below = 2.0 - pi / 3.0
    axis = flow(x, -y, -1, below)
    for t in np.linspace(0.0, 2.0, 21).tolist():
        x1, y1 = flow(x, y, 1, t)
        folded = flow(x, -y, -1, t) if t < below else flow(*axis, 1, t - below)
        assert (x1, abs(y1)) == pytest.approx(folded, abs=LENGTH_TOLERANCE)


def test_the_other_optimum_crosses_the_axis_at_most_once():
    """Where the last piece takes pi/3 there is a twin to the other end point, beyond the axis."""
    for x, y in ((4.0, 4.0), (0.0, 3.0), (-3.0, 1.0), (SQRT3, 0.0), (3.0, 0.0)):
        for maneuver in optima(x, y, 1.0, Side.EITHER, 0.0):
            times = np.linspace(0.0, duration(maneuver), 400).tolist()
            ys = [state_and_adjoint_at(StateAndAdjoint(x, y, 1.0, 0.0), maneuver, t).y for t in times]
            signs = [s for s in np.sign(np.where(np.abs(ys) <= LENGTH_TOLERANCE, 0.0, ys)).tolist() if s]
            assert sum(a != b for a, b in pairwise(signs)) <= 1


# Section 6 for y0 = 0, case by case: words, and where they switch. Each has its mirror image.

ON_THE_AXIS = [
    ("x0 < -sqrt 3", -3.0, {"SL", "SR"}, [(-SQRT3, 0.0)]),
    ("x0 = -sqrt 3", -SQRT3, {"L", "R"}, []),
    ("-sqrt 3 < x0 < 0", -1.0, {"LRL", "RLR"}, None),
    ("x0 = 0", 0.0, {"RL", "LR"}, None),
    ("0 <= x0 < sqrt 3", 1.0, {"RL", "LR"}, None),
    ("x0 = sqrt 3", SQRT3, {"RL", "LR", "R", "L"}, [(-SQRT3, 0.0)]),
    ("x0 > sqrt 3", 3.0, {"RSL", "RSR", "LSR", "LSL"}, [(-3.0, 0.0), (-SQRT3, 0.0)]),
]


@pytest.mark.parametrize(("case", "x", "words", "points"), ON_THE_AXIS, ids=[row[0] for row in ON_THE_AXIS])
def test_each_case_of_y0_zero(case, x, words, points):
    maneuvers = optima(x, 0.0, 1.0, Side.EITHER, 0.0)
    assert {letters(m) for m in maneuvers} == words
    assert len(maneuvers) == len(words) == (4 if x >= SQRT3 else 2)
    for maneuver in maneuvers:
        assert miss(x, 0.0, 1.0, maneuver) <= LENGTH_TOLERANCE
        assert duration(maneuver) == pytest.approx(duration(maneuvers[0]), abs=LENGTH_TOLERANCE)
        if points is not None:
            flown_through = switching_points(x, 0.0, maneuver)[:-1]
            assert flown_through == [pytest.approx(p, abs=LENGTH_TOLERANCE) for p in points[: len(flown_through)]]


@pytest.mark.parametrize("x", [row[1] for row in ON_THE_AXIS])
def test_on_the_axis_every_control_has_its_mirror_image(x):
    swap = str.maketrans("LR", "RL")
    found = {(letters(m), m.side): times_of(m) for m in optima(x, 0.0, 1.0, Side.EITHER, 0.0)}
    for (word, side), durations in found.items():
        assert found[word.translate(swap), -side] == pytest.approx(durations, abs=LENGTH_TOLERANCE)


def test_on_the_axis_the_end_points_are_those_of_the_paper():
    """u0 first: it ends at (0, u0) left of the centre, at (0, -u0) right of it."""
    for x in (-1.0, 0.0, 1.0):
        for maneuver in optima(x, 0.0, 1.0, Side.EITHER, 0.0):
            assert maneuver.side == CONTROLS[letters(maneuver)[0]] * (1 if x < 0.0 else -1)


def test_left_of_the_centre_the_first_switch_lies_on_the_curve_23():
    for maneuver in optima(-1.0, 0.0, 1.0, Side.EITHER, 0.0):
        x, y = switching_points(-1.0, 0.0, maneuver)[0]
        assert x == pytest.approx(curve_23(y), abs=LENGTH_TOLERANCE / x)


# Section 6, y0 != 0: the open-loop rule, and how many controls there are


@pytest.mark.parametrize("s", [1.0, -1.0])
@pytest.mark.parametrize(
    ("x", "y", "words", "points"),
    [
        (4.0, 4.0, ["RSL", "RSR"], [(-sqrt(24.0), 0.0), (-SQRT3, 0.0)]),
        (0.0, 3.0, ["R", "RL"], [(-SQRT3, 0.0)]),
        (-0.53, 0.31, ["LRL"], None),
        (-sqrt(1.75), 0.5, ["L"], []),
        (1.0, 0.5, ["RL"], None),
        (0.0, 2.0, ["RL"], None),
    ],
    ids=["(24)", "(25)", "(26)", "(27)", "none", "none, |y| > 1"],
)
def test_each_case_of_y0_not_zero(x, y, words, points, s):
    maneuvers = optima(x, s * y, 1.0, Side.EITHER, 0.0)
    swap = str.maketrans("LR", "RL") if s < 0.0 else {}
    assert sorted(letters(m) for m in maneuvers) == sorted(word.translate(swap) for word in words)
    for maneuver in maneuvers:
        flown_through = switching_points(x, s * y, maneuver)[:-1]
        if points is not None:
            assert flown_through == [
                pytest.approx((px, s * py), abs=LENGTH_TOLERANCE) for px, py in points[: len(flown_through)]
            ]
        elif "L" in words[0]:
            xb, yb = flown_through[-1]
            assert beyond_last_circle(xb, s * yb, 1.0) == pytest.approx(0.0, abs=LENGTH_TOLERANCE)


def test_off_the_axis_a_nonsingular_control_is_the_only_one():
    for x, y, maneuver in optimal():
        assert len(optima(x, y, 1.0, Side.EITHER, 0.0)) == (2 if "S" in letters(maneuver) else 1)


# Section 7

PRINTED = 0.5e-4  # four digits after the comma


def test_example_1_prints_these_numbers():
    x, y = EXAMPLES[0].x, EXAMPLES[0].y
    up, down = optima(x, y, 1.0, Side.EITHER, 0.0)
    tau1, tau2, end = np.cumsum(up[2:]).tolist()
    (x1, y1), (x2, y2), _ = switching_points(x, y, up)
    assert (tau1, tau2, end) == pytest.approx((2.6994, 5.8664, 6.9136), abs=PRINTED)
    golden = np.cumsum(EXAMPLES[0].durations)
    assert (tau1, tau2, end) == pytest.approx(golden.tolist(), abs=1e-12)
    assert (x1, y1) == pytest.approx((-sqrt(24.0), 0.0), abs=1e-12)
    assert x1 == pytest.approx(-4.8990, abs=PRINTED)
    assert (x2, y2) == pytest.approx((-SQRT3, 0.0), abs=1e-12)
    assert [letters(up), letters(down)] == ["RSL", "RSR"]
    assert up[2:] == down[2:]


def constants(x, y, u, t):
    """a1, a2 of the piece with control u = +-1 that passes (x, y) at the time t, as section 7 writes it."""
    x0, y0 = flow(x, y, u, -t)
    return x0, u * y0 + 1.0


def test_example_1_pieces_are_those_written_out():
    x, y = EXAMPLES[0].x, EXAMPLES[0].y
    up, down = optima(x, y, 1.0, Side.EITHER, 0.0)
    tau2 = up[2] + up[3]
    (_, last_start, end), (*_, other_end) = switching_points(x, y, up), switching_points(x, y, down)
    assert constants(x, y, -1, 0.0) == (4.0, -3.0)
    b1, b2 = constants(*last_start, 1, tau2)
    assert (b1, b2) == pytest.approx((-1.1789, 1.6156), abs=PRINTED)
    assert (b1, b2) == pytest.approx((-2.0 * sin(tau2 + pi / 3.0), 2.0 * cos(tau2 + pi / 3.0)), abs=1e-12)
    assert constants(*last_start, -1, tau2) == pytest.approx((b1, b2), abs=1e-12)
    assert (*end, *other_end) == pytest.approx((0.0, 1.0, 0.0, -1.0), abs=1e-12)
    assert on_left_circle(b1, b2, duration(up)) == pytest.approx(end, abs=1e-12)


def test_example_2_admissible_control_prints_these_numbers():
    x, y = EXAMPLES[1].x, EXAMPLES[1].y
    admissible = next(m for m in ranked(x, y, 1.0, Side.CW, 0.0) if letters(m) == "RL")
    assert admissible[2:4] == pytest.approx(ADMISSIBLE, abs=1e-12)
    assert (admissible[2], duration(admissible)) == pytest.approx((5.5867, 6.0252), abs=PRINTED)
    assert duration(admissible) == pytest.approx(6.025185252835342, abs=1e-12)
    assert constants(x, y, -1, 0.0) == pytest.approx((-0.53, 0.69), abs=1e-12)
    switch, _ = switching_points(x, y, admissible)
    assert constants(*switch, 1, admissible[2]) == pytest.approx((0.5103, 1.9338), abs=PRINTED)


def test_example_2_optimal_control_prints_these_numbers():
    x, y = EXAMPLES[1].x, EXAMPLES[1].y
    [maneuver] = optima(x, y, 1.0, Side.EITHER, 0.0)
    tau1, tau2, end = np.cumsum(times_of(maneuver)).tolist()
    assert (tau1, tau2, end) == pytest.approx((0.5921, 5.0349, 5.3779), abs=PRINTED)
    assert times_of(maneuver) == pytest.approx(EXAMPLES[1].durations, abs=1e-12)
    first, second, last = switching_points(x, y, maneuver)
    assert (*first, *second) == pytest.approx((0.291365, 0.382789, -0.672517, 0.883539), abs=0.5e-6)
    assert last == pytest.approx((0.0, 1.0), abs=1e-12)
    assert constants(x, y, 1, 0.0) == pytest.approx((-0.53, 1.31), abs=1e-12)
    b = constants(*first, -1, tau1)
    assert b == pytest.approx((-0.1027, 0.6748), abs=PRINTED)
    assert on_right_circle(*b, tau2) == pytest.approx(second, abs=1e-12)
    c = constants(*second, 1, tau2)
    assert c == pytest.approx((1.5732, 1.2349), abs=PRINTED)
    assert on_left_circle(*c, end) == pytest.approx(last, abs=1e-12)
