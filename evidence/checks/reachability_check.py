"""`loiter.min_time` compared with a Hamilton-Jacobi reachability map, over the reduced plane around the circle."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import pi, sqrt
from typing import TYPE_CHECKING

import numpy as np

from evidence.checks.reachability import HORIZON, Reach, reach
from loiter.arrays import min_time
from loiter.errors import InvalidArgument
from loiter.planning.model import Turn

if TYPE_CHECKING:
    from numpy import bool_, float64
    from numpy.typing import NDArray

# Circles and turns whose maps are compared: the paper's problem, its problems with one end point, and wider circles.
MAPS = ((1.0, Turn.EITHER), (1.0, Turn.CW), (1.0, Turn.CCW), (2.5, Turn.EITHER), (2.5, Turn.CW), (4.0, Turn.CW))

SIDES = {Turn.CW: (1,), Turn.CCW: (-1,), Turn.EITHER: (1, -1)}

# T is computed on a lattice this many times finer than the grid. To allow for points between lattice points, starts up
# to four half diagonals further away are included, 0.36 of the grid's spacing.
FINER = 8


@dataclass(frozen=True)
class ReachabilityDifference:
    """By how much one map differs from T. Lengths in turn radii, times in turn radii over airspeed.

    With e the grid's own `error`, a node's time on the grid must lie between the least T within 2 e of the node and T
    at the node, up to one `step` of time. `late` is the largest excess over T, `early` the largest deficit from the
    least T nearby. No node is left out: for `beside_jumps` of the `nodes` the bounds are more than a quarter turn
    apart, because T jumps or is steep within 2 e. `difference` is the mean distance from the least T within e, which
    the grid's time approximates.
    """

    radius: float
    turn: Turn
    spacing: float
    error: float
    step: float
    nodes: int
    beside_jumps: int
    late: float
    early: float
    difference: float

    @property
    def passed(self) -> bool:
        """Whether every node's time lies between its bounds."""
        return self.late <= self.step and self.early <= 0.0


def compare_with_reachability(
    cells: Sequence[int], maps: Sequence[tuple[float, Turn]] = MAPS
) -> Iterator[ReachabilityDifference]:
    """Compare each map (radius, turn) on grids of each number of cells, one by one, coarse grids first.

    Raises at the call, not at the first result: `InvalidArgument` for fewer than 10 cells.
    """
    if min(cells) < 10:
        raise InvalidArgument("cells", f"is {min(cells)}: it must be at least 10")
    return (reachability_difference(radius, turn, n) for n in cells for radius, turn in maps)


def reachability_difference(radius: float, turn: Turn, cells: int) -> ReachabilityDifference:
    """One map compared with T at its nodes."""
    found = reach(radius, SIDES[turn], cells)
    inside = np.hypot(found.x[:, np.newaxis], found.y) <= found.within
    T, nearer, near = (least_within(d, found, inside, radius, turn) for d in (0.0, found.error, 2.0 * found.error))
    time = np.where(found.time[inside] < np.inf, found.time[inside], HORIZON)
    # The grid has no times past the horizon.
    T, nearer, near = (np.minimum(t, HORIZON) for t in (T, nearer, near))
    return ReachabilityDifference(
        radius=radius,
        turn=turn,
        spacing=found.spacing,
        error=found.error,
        step=found.step,
        nodes=int(inside.sum()),
        beside_jumps=int((T - near > 0.5 * pi).sum()),
        late=float((time - T).max()),
        early=float((near - time).max()),
        difference=float(np.abs(time - 0.5 * found.step - nearer).mean()),
    )


def least_within(distance: float, found: Reach, inside: NDArray[bool_], radius: float, turn: Turn) -> NDArray[float64]:
    """The least T within a distance of each node inside, (nodes,), on a lattice `FINER` times as fine as the grid."""
    width = found.spacing / FINER
    # A lattice point represents the points up to half a diagonal away. Each piece of a plan may use a third of what
    # it may miss by, so three times that distance keeps the arcs through the end point, and that point, on the lattice.
    blur = sqrt(0.5) * width if distance else 0.0
    steps = (distance + blur) / width
    reach = range(-int(steps), int(steps) + 1)
    axis = found.x.min() + width * np.arange(-int(steps), FINER * (found.x.size - 1) + int(steps) + 1)
    T: NDArray[float64] = min_time(axis[:, np.newaxis], axis, radius, turn, 3.0 * blur)
    i, j = (FINER * index + int(steps) for index in np.nonzero(inside))
    least: NDArray[float64] = T[i, j]
    for di, dj in ((di, dj) for di in reach for dj in reach if di * di + dj * dj <= steps * steps):
        least = np.minimum(least, T[i + di, j + dj])
    return least
