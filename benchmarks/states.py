"""Seconds per state and error of T: the kernel, the plain formulas, and other methods."""

import os
from collections.abc import Callable
from math import cos, inf, nan, sin
from time import perf_counter

import numpy as np

import loiter
from benchmarks import peers, plain
from benchmarks.timing import Row, least_times
from evidence.checks import wind_scan_check
from loiter import Aircraft, Orbit, Pose
from loiter.compiled import solver, ufuncs
from loiter.kernel.wind import wind_search
from loiter.kernel.wind.wind_search import WindProblem
from loiter.kernel.words import Side

COUNT = 4_000_000
ROUNDS = 7
CORES = os.cpu_count() or 1

# |x| and |y| of the states: those of the paper's figures, where every word occurs, and mostly distant ones, with RSL.
NEAR, FAR = 4.0, 40.0


def measure() -> list[Row]:
    """The rows of all tasks; ratios are to the first contender of each task."""
    return [*tight(NEAR, "|x|, |y| < 4"), *tight(FAR, "|x|, |y| < 40"), *any_circle(), *wind(), *one_plan(), *others()]


def tight(span: float, where: str) -> list[Row]:
    """Rows for R = 1, *either*."""
    x, y = np.random.default_rng(0).uniform(-span, span, (2, COUNT))
    out = np.empty(COUNT)
    calls = {
        "plain formulas, Numba": lambda: plain.tight(x, y, out=out),
        "plain formulas, NumPy": lambda: plain.tight_arrays(x, y),
        "loiter.min_time": lambda: loiter.min_time(x, y, out=out),
        f"loiter.min_time, {CORES} threads": lambda: loiter.min_time(x, y, out=out, workers=CORES),
        "loiter.control": lambda: loiter.control(x, y, out=out),
        "loiter.solve": lambda: loiter.solve(x, y),
    }
    results = {"plain formulas, Numba": plain.tight(x, y), "plain formulas, NumPy": plain.tight_arrays(x, y)}
    return rows(f"R = 1, either, {where}", calls, results, scalar(x, y, np.ones(COUNT), np.zeros(COUNT, np.int8)))


def any_circle() -> list[Row]:
    """Rows for a random radius and turn of each state."""
    rng = np.random.default_rng(1)
    R = 1.0 + rng.exponential(1.5, COUNT)
    x, y = rng.uniform(-1.0, 1.0, (2, COUNT)) * (R + 3.0)
    side = rng.integers(-1, 2, COUNT).astype(np.int8)
    out = np.empty(COUNT)
    calls = {
        "plain formulas, Numba": lambda: plain.any_circle(x, y, R, side, out=out),
        "loiter.min_time": lambda: loiter.min_time(x, y, R, side, out=out),
        f"loiter.min_time, {CORES} threads": lambda: loiter.min_time(x, y, R, side, out=out, workers=CORES),
        "loiter.solve": lambda: loiter.solve(x, y, R, side),
    }
    results = {"plain formulas, Numba": plain.any_circle(x, y, R, side)}
    return rows("any R, any turn", calls, results, scalar(x, y, R, side))


def wind() -> list[Row]:
    """Rows for wind, |w| up to 0.6, R from 1 to 2.5 times (1 + |w|)^2: compiled, plain Python, search over words."""
    scenes = list(wind_scan_check.random_problems(3000, 0))
    columns = [
        (s.start.east, s.start.north, s.start.angle, s.radius, int(s.side), s.wind_east, s.wind_north) for s in scenes
    ]
    x, y, angle, R, side, wx, wy = np.array(columns).T
    states = x, y, angle, R, side.astype(np.int8), wx, wy
    few = [WindProblem(*row) for row in zip(x, y, np.cos(angle), np.sin(angle), R, side, wx, wy, strict=True)][:100]
    contenders = {
        "kernel, plain Python": (lambda: [wind_search.fastest(problem) for problem in few], len(few)),
        "loiter.min_time_in_wind": (lambda: loiter.min_time_in_wind(*states), len(scenes)),
        f"loiter.min_time_in_wind, {CORES} threads": (
            lambda: loiter.min_time_in_wind(*states, workers=CORES),
            len(scenes),
        ),
        "loiter.solve_in_wind": (lambda: loiter.solve_in_wind(*states), len(scenes)),
    }
    times = least_times({name: call for name, (call, _) in contenders.items()}, 3)
    begin = perf_counter()
    differences = [wind_scan_check.scan_difference(scene) for scene in scenes[:20]]
    search = (perf_counter() - begin) / 20
    errors = [max(d.later, d.earlier) for d in differences]
    rows = [("search over points, words and times, NumPy", search, max(errors), float(np.mean(errors)))]
    rows += [(name, times[name] / count, nan, nan) for name, (_, count) in contenders.items()]
    for windiest in (wind_scan_check.WINDIEST, 0.95):
        median, slow = np.percentile(single_scenes(windiest, 3000), [50, 99]).tolist()
        rows += [(f"one scene, compiled, |w| < {windiest}: median", median, nan, nan)]
        rows += [(f"one scene, compiled, |w| < {windiest}: 99 % take less", slow, nan, nan)]
    return [Row("wind", name, seconds, seconds / search, largest, mean) for name, seconds, largest, mean in rows]


def single_scenes(windiest: float, count: int) -> list[float]:
    """Seconds of machine code for each of some random scenes with wind, the least of seven calls."""
    problems = [
        WindProblem(*s.start[:2], cos(s.start.angle), sin(s.start.angle), s.radius, s.side, s.wind_east, s.wind_north)
        for s in wind_scan_check.random_problems(count, 5, windiest)
        if s.wind_east != 0.0 or s.wind_north != 0.0
    ]
    least = [inf] * len(problems)
    for _ in range(7):
        for i, problem in enumerate(problems):
            begin = perf_counter()
            solver.fastest(problem)
            least[i] = min(least[i], perf_counter() - begin)
    return least


def scalar(x, y, R, side) -> np.ndarray:
    """T by the scalar functions for the first ten thousand states: the reference of all errors."""
    from loiter.kernel.entry import duration
    from loiter.kernel.still_air.synthesis import optimum

    first = zip(x[:10_000].tolist(), y[:10_000].tolist(), R[:10_000].tolist(), side[:10_000].tolist(), strict=True)
    return np.array([duration(optimum(*state, 0.0)) for state in first])


def rows(
    task: str, calls: dict[str, Callable[[], object]], results: dict[str, np.ndarray], true: np.ndarray
) -> list[Row]:
    """Rows of all contenders; the errors compare `results`, and the answers of our own functions, with `true`."""
    times = least_times(calls, ROUNDS)
    baseline = next(iter(times.values()))
    table = []
    for name, seconds in times.items():
        answer = results[name] if name in results else getattr(calls[name](), "time", calls[name]())
        error = np.abs(answer[: len(true)] - true) if "control" not in name else np.array([nan])
        table.append(Row(task, name, seconds / COUNT, seconds / baseline, float(error.max()), float(error.mean())))
    return table


def one_plan() -> list[Row]:
    """Rows for one plan in SI units, in plain Python, and for the sweep of the same scene."""
    uav, pose, orbit = Aircraft(18.0, max_bank_deg=35.0), Pose(-400.0, 120.0, 90.0), Orbit(0.0, 0.0, 80.0)
    r = uav.turn_radius_m
    state = -400.0 / r, 120.0 / r, 80.0 / r
    times = least_times(
        {
            "OMPL, 360 headings each way": lambda: peers.sweep(*state, (1, -1)),
            "loiter.plan": lambda: loiter.plan(pose, orbit, uav),
        },
        50,
    )
    best = float(ufuncs.min_time(*state, 0, 0.0))
    baseline = times["OMPL, 360 headings each way"]
    planned = loiter.plan(pose, orbit, uav).length_m / r
    errors = {"OMPL, 360 headings each way": peers.sweep(*state, (1, -1)) - best, "loiter.plan": abs(planned - best)}
    return [Row("one plan", name, s, s / baseline, errors[name], errors[name]) for name, s in times.items()]


def others() -> list[Row]:
    """Rows for R = 1, *either*: the sweep, a nonlinear program, a grid, and the kernel, with their errors."""
    task, sides = "R = 1, either, other methods", (Side.CW, Side.CCW)
    x, y = np.random.default_rng(2).uniform(-NEAR, NEAR, (2, 400))
    true = scalar(x, y, np.ones(400), np.zeros(400, np.int8))
    sweep = _others_row(
        task, "OMPL, 360 headings each way", lambda n: [peers.sweep(*s, 1.0, sides) for s in _states(x, y, n)], true
    )
    program = _others_row(
        task, "CasADi, IPOPT", lambda n: [peers.program(*s, 1.0, sides) for s in _states(x, y, n)], true, 12
    )
    table = [sweep, program]
    peers.grid(1.0, sides, 20)
    begin = perf_counter()
    gx, gy, times = peers.grid(1.0, sides, 80)
    seconds = (perf_counter() - begin) / len(times)
    error = np.abs(times - loiter.min_time(gx, gy))[np.isfinite(times)]
    table.append(
        Row(task, f"hj-reachability, {len(times)} nodes", seconds, 0.0, float(error.max()), float(error.mean()))
    )
    wide = np.random.default_rng(3).uniform(-NEAR, NEAR, (2, COUNT))
    seconds = least_times({"": lambda: loiter.min_time(*wide)}, ROUNDS)[""] / COUNT
    error = np.abs(loiter.min_time(x, y) - true)
    table.append(Row(task, "loiter.min_time", seconds, 0.0, float(error.max()), float(error.mean())))
    return [row._replace(ratio=row.seconds / sweep.seconds) for row in table]


def _states(x, y, count):
    """The first `count` states."""
    return zip(x[:count].tolist(), y[:count].tolist(), strict=True)


def _others_row(task, name, answers, true, count=400) -> Row:
    """The row of `answers(count)`, a function that solves the first `count` states."""
    answers(1)
    begin = perf_counter()
    times = np.array(answers(count))
    seconds = (perf_counter() - begin) / count
    error = np.abs(times - true[:count])
    return Row(task, name, seconds, 0.0, float(error.max()), float(error.mean()))
