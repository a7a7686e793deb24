"""Scenes in wind that are hard for the search, and their least times: wind_scenes.csv, a group for each difficulty.

- slow: by hill climbing on the time that the machine code takes; the first three with |w| < 0.6, the others up to 0.95.
- valleys: those of each side are 4 and 3 degrees apart, and the deeper one is the narrower; the last has a corner
  between a local minimum and the fastest path, at which the path consists of two arcs.
- corners: the minimum lies at a jump of the time, or next to a corner. A search whose bracket kept the times of fewer
  words than it knew stopped short of the first four: later by 0.05, 0.02, 0.01 and 0.006. At the last, a secant across
  the corner leads nowhere, and the corner is later by 3e-5.
- two_minima: two local minima lie in the same cell of 2 pi/128: the search ended in the higher one, later by 6e-4 to
  1e-2.
- beside_corners: the minimum lies within 1e-7 of a corner: the search ended at the corner, or beside it, later by 3e-13
  to 5e-8.
"""

import csv
from pathlib import Path

from loiter.kernel.wind.wind_search import WindProblem

with Path(__file__).with_suffix(".csv").open(encoding="utf-8", newline="") as file:
    ROWS = list(csv.DictReader(file))


def group(name: str) -> list[tuple[WindProblem, float]]:
    """The scenes of a group, each with its least time; nan where that is not needed."""
    return [(problem(row), float(row["time"] or "nan")) for row in ROWS if row["group"] == name]


def problem(row: dict[str, str]) -> WindProblem:
    """The problem of a row."""
    x, y, c, s, R, wx, wy = (float(row[name]) for name in ("x", "y", "c", "s", "R", "wx", "wy"))
    return WindProblem(x, y, c, s, R, int(row["side"]), wx, wy)


SLOW = [scene for scene, _ in group("slow")]
VALLEYS, CORNERS, TWO_MINIMA, BESIDE_CORNERS = map(group, ("valleys", "corners", "two_minima", "beside_corners"))
