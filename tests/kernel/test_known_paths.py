"""What a known path reaches is reached no later: slots, points of joining and the circle.

The paths have pieces that vanish, nearly vanish or are half or whole turns, so that several words meet in one path.
"""

from math import cos, inf, pi, sin, tau
from typing import NamedTuple

import numpy as np
import pytest

from loiter.compiled import solver
from loiter.kernel.motion import fly
from loiter.kernel.rounding import rounding
from loiter.kernel.wind.held import width_held
from loiter.kernel.wind.hold import hold_pose, hold_rate
from loiter.kernel.wind.paths import first_path
from loiter.kernel.wind.wind_search import WindProblem, scene_of, time_of

CONTROLS = [
    *((), (0,), (1,), (-1,), (0, 1), (0, -1), (1, 0), (-1, 0), (1, -1), (-1, 1), (1, 0, 1), (1, 0, -1)),
    *((-1, 0, 1), (-1, 0, -1), (1, -1, 1), (-1, 1, -1)),
]
DURATIONS = (pi / 3.0, 0.5, 1.0, pi / 2.0, 2.0, 3.0, pi, 4.0 * pi / 3.0, 1.5 * pi, tau, 2.0 * tau)


class KnownPath(NamedTuple):
    """A problem, a path that solves it, the phase of its point of joining and its time."""

    problem: WindProblem
    controls: tuple[int, ...]
    phase: float
    time: float


def known_paths(seed, n, beside=0.0):
    """Paths flown backward from the circle, in still air and in wind; the start is displaced by a share of R."""
    random = np.random.default_rng(seed)
    return [known_path(random, beside) for _ in range(n)]


def known_path(random, beside):
    w = float(random.choice([0.0, 0.0, 0.1, 0.5, random.uniform(0.01, 0.8)]))
    towards = float(random.choice([0.0, pi / 2.0, random.uniform(0.0, tau)]))
    wx, wy, side = w * cos(towards), w * sin(towards), int(random.choice([1, -1]))
    R = (1.0 + w) ** 2 * float(random.choice([1.01, 2.0, 4.0, random.uniform(1.01, 20.0)]))
    controls = CONTROLS[random.integers(len(CONTROLS))]
    short = 10.0 ** random.uniform(-9.0, -1.0, 3)
    durations = [float(random.choice([*DURATIONS, *random.uniform(0.0, 7.0, 4), *short])) for _ in controls]
    phase = float(random.choice([pi / 6.0 * random.integers(12), random.uniform(0.0, tau)]))
    x, y, c, s, _ = hold_pose(phase, side, R, wx, wy)
    c, s = -c, -s
    for u, t in zip(reversed(controls), reversed(durations), strict=True):
        x, y, c, s = fly(x, y, c, s, -u, t)
        x, y = x - wx * t, y - wy * t
    dx, dy = random.uniform(-beside, beside, 2) * R
    return KnownPath(
        WindProblem(float(x + dx), float(y + dy), -c, -s, R, side, wx, wy, 0.0), controls, phase, sum(durations)
    )


@pytest.mark.parametrize("beside", [0.0, 1e-16, 1e-14])
def test_a_slot_at_the_end_of_a_known_path_is_reached_no_later(beside):
    for known in known_paths(5, 150, beside):
        p, length_tolerance = known.problem, rounding(known.problem.x, known.problem.y, known.problem.R)
        found = solver.first_in_slot(p, known.phase - width_held(known.phase, known.time, p.R, p.wx, p.wy))
        # In a time t the aircraft may cut k^2 (1 - k) t^3 / 24, which may be rounding (docs/slots.md, section 4).
        k = hold_rate(known.phase, p.side, p.R, p.wx, p.wy)
        late = (24.0 * length_tolerance / (k * k * (1.0 - k))) ** (1.0 / 3.0)
        assert time_of(found) <= known.time + late, known
        # Three arcs are roots up to 12 arc tolerances, 4 of this, as is an arc that is left out; then a short piece.
        assert found.miss <= 9.0 * length_tolerance, known


@pytest.mark.parametrize("beside", [0.0, 1e-16])
def test_a_point_of_joining_is_reached_no_later(beside):
    for known in known_paths(5, 500, beside):
        p = known.problem
        time = first_path(known.phase, p.side, scene_of(p), inf).time
        assert time <= known.time + 1e-6 * (1.0 + known.time), known


def test_the_circle_is_reached_no_later():
    for known in known_paths(5, 60):
        assert time_of(solver.fastest(known.problem)) <= known.time + 1e-6 * (1.0 + known.time), known
