"""Hamilton-Jacobi reachability: least times on a grid of the reduced plane, by hj-reachability (JAX).

It shares no code with the kernel: it uses only the reduced system (7) of docs/theory.md and the end points (8), (9),
and a general solver of Hamilton-Jacobi equations marches backward in time. Lengths are in turn radii, times in turn
radii over airspeed. hj-reachability is needed for development only.

It solves for V(x, t), the least distance from an end point that the state x can reach within a time t. Under one
control history the plane moves as a rigid body. So if a trajectory from x ends at a distance d from the end point, some
state at the distance d from x reaches the end point itself with the same control. Hence

    V(x, t) = distance from x to {T <= t},

which has slope 1 even where T jumps: no state has to be left out.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import sqrt
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from numpy import float64
    from numpy.typing import NDArray

# Optimal trajectories stay this close to their start and to the circle: every arc is about (0, 1) or (0, -1), so the
# first one stays within the start's distance from the centre plus 2, and the others within R + 2.
MARGIN = 2.0

# The map covers starts up to this distance outside the circle.
OUTSIDE = 1.0

# From these starts every time is below this (just above a whole turn); states that have not arrived then count as inf.
HORIZON = 7.0

# V has kinks, which an upwind scheme of order r smears over h^(r/(r+1)); here r = 5, and halving h leaves 0.56 of the
# error. No theorem covers this scheme. For monotone schemes the error is at least of order 1/2 (Crandall and Lions,
# 1984): halving h leaves at most sqrt(1/2) of it, so the error of the finer grid is at most OWN_ERROR times the
# difference of the two grids.
OWN_ERROR = 1.0 / (sqrt(2.0) - 1.0)


@dataclass(frozen=True, eq=False)
class Reach:
    """Least times on a grid: `time[i, j]` is the time from (x[i], y[j]) to within `error` of an end point.

    `error` is the grid's own error in V; `time` is the first of the instants `step` apart, inf past the horizon. `x`
    and `y` are (n,), `spacing` apart, `time` is (n, n). The map is valid up to the distance `within` from the centre.
    """

    x: NDArray[float64]
    y: NDArray[float64]
    time: NDArray[float64]
    within: float
    spacing: float
    step: float
    error: float


class ReducedPlane:
    """The system (7), x' = 1 + u y, y' = -u x, |u| <= 1, with the interface of hj-reachability."""

    def hamiltonian(self, state: Any, time: Any, value: Any, gradient: Any) -> Any:
        """The least of gradient . f over u."""
        (x, y), (by_x, by_y) = state, gradient
        return by_x - abs(by_x * y - by_y * x)

    def partial_max_magnitudes(self, state: Any, time: Any, value: Any, gradients: Any) -> Any:
        """The largest |x'| and |y'| at a state."""
        import jax.numpy as jnp

        x, y = state
        return jnp.stack([1.0 + abs(y), abs(x)])


# One instance: JAX compiles anew for each.
REDUCED_PLANE = ReducedPlane()


def reach(R: float, sides: Sequence[int], cells: int) -> Reach:
    """The map for a circle of radius R, with end points (0, R) for side 1 and (0, -R) for side -1, either or both.

    It has twice `cells` cells in x and in y; its error is estimated from a grid of `cells`.
    """
    within = R + OUTSIDE
    half = within + MARGIN
    spacing = half / cells
    instants, step = np.linspace(0.0, HORIZON, round(HORIZON / spacing) + 1, retstep=True)
    coarse, fine = (distances(R, sides, half, n, instants) for n in (cells, 2 * cells))
    axis = np.linspace(-half, half, 2 * cells + 1)
    inside = np.hypot(axis[::2, np.newaxis], axis[::2]) <= within
    error = OWN_ERROR * float(np.abs(fine[:, ::2, ::2] - coarse)[:, inside].max())
    reached = fine <= error
    time = np.where(reached.any(axis=0), instants[reached.argmax(axis=0)], np.inf)
    return Reach(axis, axis, time, within, spacing, float(step), error)


def distances(R: float, sides: Sequence[int], half: float, cells: int, instants: NDArray[float64]) -> NDArray[float64]:
    """V at each instant and node, (instants, cells + 1, cells + 1), on the square from -`half` to `half`."""
    import hj_reachability as hj
    import jax.numpy as jnp

    corner = jnp.array([half, half])
    grid = hj.Grid.from_lattice_parameters_and_boundary_conditions(hj.sets.Box(-corner, corner), (cells + 1, cells + 1))
    x, y = np.moveaxis(np.asarray(grid.states), -1, 0)
    at_first = np.min([np.hypot(x, y - side * R) for side in sides], axis=0)
    settings = hj.SolverSettings.with_accuracy(
        "very_high", hamiltonian_postprocessor=hj.solver.backwards_reachable_tube
    )
    backward = -jnp.asarray(instants)
    return np.asarray(hj.solve(settings, REDUCED_PLANE, grid, backward, jnp.asarray(at_first), progress_bar=False))
