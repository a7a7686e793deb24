"""Search for the worst answers by optimisation, where faults are likely: `python -m kernel.worst`.

A scene is a point, a radius and a side. Points lie next to the circles and corners where words meet, at distances from
1e-17 to 1; radii next to 1, 2, 3, 4 or anywhere up to 1e6. Each generation keeps the worst scenes and varies them.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

import loiter
from loiter.kernel.rounding import ROUNDING

Array = Any

SPECIAL_RADII = (1.0, 2.0, 3.0, 4.0)
SIDES = np.array(["cw", "ccw", "either"])


@dataclass(frozen=True)
class Scenes:
    """Scenes by the numbers that the search varies, arrays of length n.

    The state is `corner` (a row of `corners`), or at `angle` on the circle `curve` (a row of `curves`), moved by
    10**`offset` towards `bearing`; the radius is one of `SPECIAL_RADII` plus or minus 10**`beside`, or 10**`size`.
    """

    curve: Array
    on_corner: Array
    angle: Array
    offset: Array
    bearing: Array
    special: Array
    beside: Array
    size: Array
    side: Array
    tolerance: Array

    def __len__(self) -> int:
        return len(self.curve)

    def take(self, rows: Array) -> Scenes:
        return Scenes(**{name: values[rows] for name, values in vars(self).items()})


@dataclass(frozen=True)
class States:
    """Arguments of `loiter.solve`, arrays of length n."""

    x: Array
    y: Array
    radius: Array
    turn: Array

    @property
    def rounding(self) -> Array:
        """The rounding of a length of this size, `rounding.rounding`."""
        return ROUNDING * (1.0 + abs(self.x) + abs(self.y) + self.radius)


def curves(R: Array) -> Array:
    """Circles where words meet: rows of (centre, radius), of shape (curves, 2, n)."""
    about = [(-1.0, r) for r in (0.0 * R, R + 1.0, abs(R - 1.0), abs(3.0 - R), 1.0 + 0.0 * R)]
    mirrored = [(1.0, r) for r in (0.0 * R, R + 1.0, abs(R - 1.0), R + 3.0, 1.0 + 0.0 * R)]
    return np.array([[centre + 0.0 * R, radius] for centre, radius in about + mirrored])


def corners(R: Array) -> Array:
    """Points where curves meet: rows of (x, y), of shape (corners, 2, n)."""
    none = 0.0 * R
    ends = np.sqrt(R * (R + 2.0)), np.sqrt(np.maximum(R * (R - 2.0), 0.0))
    axis = [(end, none) for end in (none, ends[0], -ends[0], ends[1], -ends[1])]
    upright = [(none, height) for height in (R, -R, 1.0 + none, -1.0 + none, R + 2.0, -R - 2.0, 2.0 - R, R - 2.0)]
    return np.array([np.broadcast_arrays(x, y) for x, y in axis + upright])


def drawn(random: np.random.Generator, count: int) -> Scenes:
    """Scenes at random."""
    one = np.ones(1)
    return Scenes(
        curve=random.integers(len(curves(one)), size=count),
        on_corner=random.integers(-1, len(corners(one)), size=count),
        angle=random.uniform(0.0, 2.0 * np.pi, count),
        offset=random.uniform(-17.0, 0.0, count),
        bearing=random.uniform(0.0, 2.0 * np.pi, count),
        special=random.integers(-2, len(SPECIAL_RADII), size=count),
        beside=random.choice([-1.0, 1.0], count) * random.uniform(0.0, 17.0, count),
        size=random.uniform(0.0, 6.0, count),
        side=random.integers(3, size=count),
        tolerance=random.uniform(-15.0, 0.0, count),
    )


def varied(random: np.random.Generator, scenes: Scenes) -> Scenes:
    """The scenes with each number moved a little, by amounts from coarse to fine."""
    scale = 10.0 ** random.uniform(-12.0, 0.0, len(scenes))

    def moved(values: Array) -> Array:
        return values + scale * random.normal(size=len(scenes))

    kept = {
        name: moved(getattr(scenes, name)) for name in ("angle", "offset", "bearing", "beside", "size", "tolerance")
    }
    return replace(scenes, **{**kept, "tolerance": np.minimum(kept["tolerance"], 0.0)})


def states(scenes: Scenes) -> States:
    """The numbers of scenes as states."""
    exponent = np.clip(abs(scenes.beside), 0.0, 17.0)
    offset = np.sign(scenes.beside) * np.where(exponent < 16.9, 10.0**-exponent, 0.0)
    known = np.array(SPECIAL_RADII)[np.maximum(scenes.special, 0)]
    radius = np.where(scenes.special >= 0, known + offset, 10.0 ** np.clip(scenes.size, 0.0, 6.0))
    radius = np.maximum(radius, 1.0)
    n = np.arange(len(scenes))
    centre, r = curves(radius)[scenes.curve, :, n].T
    x, y = corners(radius)[np.maximum(scenes.on_corner, 0), :, n].T
    x = np.where(scenes.on_corner >= 0, x, r * np.cos(scenes.angle))
    y = np.where(scenes.on_corner >= 0, y, centre + r * np.sin(scenes.angle))
    step = 10.0 ** np.clip(scenes.offset, -17.0, 0.5)
    # A bearing along an axis leaves the other coordinate as it is.
    return States(
        x + step * np.cos(scenes.bearing), y + step * np.sin(scenes.bearing), radius, SIDES[np.asarray(scenes.side)]
    )


def miss(scenes: Scenes) -> Array:
    """By how much the end misses the circle, over the rounding of the scene: at most 1 is promised."""
    s = states(scenes)
    return _by_side(s, lambda x, y, R, turn, rows: loiter.solve(x, y, R, turn).miss) / s.rounding


def miss_with_tolerance(scenes: Scenes) -> Array:
    """The same over the tolerance."""
    s, tolerance = states(scenes), 10.0**scenes.tolerance
    missed = _by_side(s, lambda x, y, R, turn, rows: loiter.solve(x, y, R, turn, tolerance[rows]).miss)
    return missed / np.maximum(tolerance, s.rounding)


def slower_by_tolerance(scenes: Scenes) -> Array:
    """By how much a tolerance, or one ten times as large, makes the plan slower, over the rounding of the scene."""
    s, tolerance = states(scenes), 10.0**scenes.tolerance

    def times(x: Array, y: Array, R: Array, turn: str, rows: Array) -> Array:
        exact, small, large = (loiter.solve(x, y, R, turn, k * tolerance[rows]).time for k in (0.0, 0.1, 1.0))
        return np.maximum(small - exact, large - small)

    return _by_side(s, times) / s.rounding


def later_than_min_time(scenes: Scenes) -> Array:
    """By how much `solve` and `min_time` differ, over the rounding of the scene."""
    s = states(scenes)

    def difference(x: Array, y: Array, R: Array, turn: str, rows: Array) -> Array:
        return abs(loiter.solve(x, y, R, turn).time - loiter.min_time(x, y, R, turn))

    return _by_side(s, difference) / s.rounding


def _by_side(s: States, answer: Callable[..., Array]) -> Array:
    values = np.empty(len(s.x))
    for turn in SIDES:
        rows = np.flatnonzero(s.turn == turn)
        values[rows] = answer(s.x[rows], s.y[rows], s.radius[rows], str(turn), rows)
    return values


def worst(measure: Callable[[Scenes], Array], seed: int, count: int, generations: int) -> tuple[float, States, Array]:
    """The worst value found, its state and the tolerance; `count` scenes in each generation."""
    random = np.random.default_rng(seed)
    best, values = drawn(random, 0), np.empty(0)
    for generation in range(generations):
        parents = best.take(np.arange(count) % max(len(best), 1)) if generation % 4 else drawn(random, count)
        tried = varied(random, parents) if generation % 4 else parents
        merged = Scenes(**{name: np.concatenate([getattr(best, name), getattr(tried, name)]) for name in vars(best)})
        values = np.concatenate([values, measure(tried)])
        keep = np.argsort(-np.nan_to_num(values, nan=np.inf))[: count // 50]
        best, values = merged.take(keep), values[keep]
    return float(values[0]), states(best.take(np.arange(1))), 10.0 ** best.tolerance[0]


MEASURES = (miss, miss_with_tolerance, slower_by_tolerance, later_than_min_time)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--count", type=int, default=100_000, help="scenes in each generation")
    parser.add_argument("--generations", type=int, default=40)
    given = parser.parse_args()
    for measure in MEASURES:
        value, state, tolerance = worst(measure, given.seed, given.count, given.generations)
        scene = f"({float(state.x[0])!r}, {float(state.y[0])!r}), R = {float(state.radius[0])!r}, {state.turn[0]}"
        print(f"{measure.__name__}: {value:.4g} roundings at {scene}, tolerance {tolerance:.3g}")


if __name__ == "__main__":
    main()
