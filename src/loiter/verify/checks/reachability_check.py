"""`loiter.min_time` beside a Hamilton-Jacobi reachability map, all over the reduced plane around the circle."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import pi, sqrt
from typing import TYPE_CHECKING

from loiter.arrays import min_time
from loiter.errors import InvalidArgument
from loiter.planning.model import Turn
from loiter.verify.checks.reachability import HORIZON, Reach, check_installed, reach

if TYPE_CHECKING:
    from numpy import bool_, float64
    from numpy.typing import NDArray

# Circles and turns whose maps are compared: the paper's problem, its one-endpoint problems, and wider circles.
SCENES = ((1.0, Turn.EITHER), (1.0, Turn.CW), (1.0, Turn.CCW), (2.5, Turn.EITHER), (2.5, Turn.CW), (4.0, Turn.CW))

SIDES = {Turn.CW: (1,), Turn.CCW: (-1,), Turn.EITHER: (1, -1)}

# Plans are computed on a lattice this many times finer than the grid. What falls between its points takes in starts up
# to four half diagonals further away, 0.36 of the grid's spacing.
FINER = 8


@dataclass(frozen=True, slots=True)
class Reached:
    """One map beside the plans. Lengths in turn radii, times in turn radii over airspeed.

    With e the grid's own `error`, a node's time on the grid lies between the least T within 2 e of the node and T at
    the node, to one `step` of time. `late` is by how much it is above T at most, `early` by how much below the least T
    nearby. No node is left out: of `nodes`, those `beside_jumps` have bounds more than a quarter turn apart, because T
    jumps or is steep within 2 e. `difference` is the mean distance from the least T within e, for which the grid's time
    stands.
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


def compare(cells: Sequence[int], scenes: Sequence[tuple[float, Turn]] = SCENES) -> Iterator[Reached]:
    """Compare each scene (radius, turn) on grids of each number of cells, one by one, coarse grids first.

    Raises `InvalidArgument` for fewer than 10 cells, `MissingPackage` where hj-reachability is not installed; both at
    once.
    """
    if min(cells) < 10:
        raise InvalidArgument("cells", f"is {min(cells)}: it must be at least 10")
    check_installed()
    return (beside(radius, turn, n) for n in cells for radius, turn in scenes)


def beside(radius: float, turn: Turn, cells: int) -> Reached:
    """One map and the plans of its nodes."""
    import numpy as np

    found = reach(radius, SIDES[turn], cells)
    inside = np.hypot(found.x[:, np.newaxis], found.y) <= found.within
    T, nearer, near = (least_within(d, found, inside, radius, turn) for d in (0.0, found.error, 2.0 * found.error))
    time = np.where(found.time[inside] < np.inf, found.time[inside], HORIZON)
    # Past the horizon the grid says nothing more.
    T, nearer, near = (np.minimum(t, HORIZON) for t in (T, nearer, near))
    return Reached(
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
    """The least T within a distance of each node inside, on a lattice `FINER` times as fine as the grid."""
    import numpy as np

    width = found.spacing / FINER
    # A point between lattice points is stood for by one of them up to half a diagonal away. Each piece of a plan may
    # use a third of its tolerance: so the arcs through the end point, and that point, do not fall through the lattice.
    blur = sqrt(0.5) * width if distance else 0.0
    steps = (distance + blur) / width
    reach = range(-int(steps), int(steps) + 1)
    axis = found.x[0] + width * np.arange(reach[0], FINER * (found.x.size - 1) + reach[-1] + 1)
    T: NDArray[float64] = min_time(axis[:, np.newaxis], axis, radius, turn, 3.0 * blur)
    i, j = (FINER * index - reach[0] for index in np.nonzero(inside))
    least: NDArray[float64] = T[i, j]
    for di, dj in ((di, dj) for di in reach for dj in reach if di * di + dj * dj <= steps * steps):
        least = np.minimum(least, T[i + di, j + dj])
    return least
