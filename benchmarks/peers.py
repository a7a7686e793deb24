"""Alternatives to the kernel: a sweep of Dubins paths, a nonlinear program, a grid. None of them uses its code."""

from math import cos, pi, remainder, sin

import numpy as np

from evidence.checks.collocation import collocate
from evidence.checks.oracle import Circle, Planar, Search
from evidence.checks.reachability import reach

HEADINGS = 360


def sweep(x, y, R, sides):
    """T as the least of OMPL's Dubins distances to `HEADINGS` poses round the circle, on each side; turn radius 1."""
    space = Search(1.0).space
    start, goal = space.allocState(), space.allocState()
    start.setX(x)
    start.setY(y)
    start.setYaw(0.0)
    least = float("inf")
    for side in sides:
        for i in range(HEADINGS):
            azimuth = 2.0 * pi * i / HEADINGS
            goal.setX(R * cos(azimuth))
            goal.setY(R * sin(azimuth))
            goal.setYaw(remainder(azimuth - side * pi / 2.0, 2.0 * pi))
            least = min(least, space.distance(start, goal))
    return least


def program(x, y, R, sides):
    """T by direct collocation with CasADi and IPOPT (`evidence.checks.collocation`)."""
    return collocate(Planar(x, y, 0.0), [Circle(R, side == 1) for side in sides]).time


def grid(R, sides, cells):
    """A map of T by hj-reachability: x, y and T at its nodes, inf where the front has not arrived."""
    solution = reach(R, sides, cells)
    inside = np.hypot(solution.x[:, np.newaxis], solution.y) <= solution.within
    X, Y = np.broadcast_arrays(solution.x[:, np.newaxis], solution.y)
    return X[inside], Y[inside], solution.time[inside]
