"""An independent search: OMPL's Dubins distance to a pose, minimised over the point where the circle is joined.

It shares no code with the kernel: positions and headings are not reduced, the path between two poses is OMPL's, and the
minimum over the point of joining is found by trying points all round the circle and refining. OMPL is needed for
development only.
"""

from collections.abc import Callable
from math import atan2, cos, hypot, inf, pi, radians, remainder, sin, sqrt
from typing import Any, NamedTuple

# OMPL treats arcs within 1e-6 of a full turn as zero (`DUBINS_EPS` in its DubinsStateSpace.cpp), so its path may miss
# the pose by a few 1e-6 turn radii. A path that misses by more is an error of OMPL.
OMPL_MISS = 1e-5

# Evaluations of a golden-section search that shrink a bracket to 1e-15 of its width: 0.618^72.
GOLDEN_STEPS = 72
GOLDEN = (sqrt(5.0) - 1.0) / 2.0

# Where the end of OMPL's path is read, as a fraction of its length: exactly at the end OMPL returns the goal itself.
ALMOST = 1.0 - 1e-13


class Planar(NamedTuple):
    """A pose: east and north of the circle's centre, and the mathematical angle of its heading, radians."""

    east: float
    north: float
    angle: float


class Circle(NamedTuple):
    """A circle about the origin, to be joined and held in a direction."""

    radius: float
    clockwise: bool

    def join(self, azimuth: float) -> Planar:
        """The pose on the circle at a mathematical azimuth from its centre."""
        course = azimuth - pi / 2 if self.clockwise else azimuth + pi / 2
        return Planar(self.radius * cos(azimuth), self.radius * sin(azimuth), remainder(course, 2.0 * pi))


class OraclePath(NamedTuple):
    """The shortest path that the search found: its length, and the azimuth at which it joins the circle."""

    length: float
    azimuth: float


def from_compass(east: float, north: float, heading_deg: float) -> Planar:
    """The planar pose of a compass heading."""
    return Planar(east, north, radians(90.0 - remainder(heading_deg, 360.0)))


class Search:
    """OMPL's Dubins space for one turn radius."""

    def __init__(self, turn_radius: float) -> None:
        from ompl import base

        self.space = base.DubinsStateSpace(turn_radius)
        self.turn_radius = turn_radius

    def shortest(self, start: Planar, circle: Circle, joins: int) -> OraclePath:
        """The shortest of OMPL's paths to `joins` points all round the circle, and more near the azimuth of the start.

        Each local minimum is refined.
        """
        origin, goal = self.state(start), self.space.allocState()

        def length(azimuth: float) -> float:
            self.place(goal, circle.join(azimuth))
            return float(self.space.distance(origin, goal))

        azimuths = all_round(start, joins)
        lengths = [length(azimuth) for azimuth in azimuths]
        best = OraclePath(inf, 0.0)
        for i, here in enumerate(lengths):
            before, after = i - 1, (i + 1) % len(lengths)
            if here <= lengths[before] and here <= lengths[after]:
                left = azimuths[before] - (2.0 * pi if before < 0 else 0.0)
                right = azimuths[after] + (2.0 * pi if after == 0 else 0.0)
                best = min(best, golden_section(length, left, OraclePath(here, azimuths[i]), right))
        return best

    def exact_start(self, start: Planar, circle: Circle, found: OraclePath) -> tuple[Planar, float]:
        """The start from which OMPL's path ends exactly on the circle, and its distance from `start`.

        OMPL's path is moved as a whole until its end is the point of joining. Raises `ArithmeticError` where the
        distance is more than `OMPL_MISS`.
        """
        goal = circle.join(found.azimuth)
        last = self.space.allocState()
        self.space.interpolate(self.state(start), self.state(goal), ALMOST, last)
        end = Planar(last.getX(), last.getY(), last.getYaw())
        turn = goal.angle - end.angle
        east, north = start.east - end.east, start.north - end.north
        moved = Planar(
            goal.east + east * cos(turn) - north * sin(turn),
            goal.north + east * sin(turn) + north * cos(turn),
            start.angle + turn,
        )
        shift = hypot(moved.east - start.east, moved.north - start.north)
        if shift > OMPL_MISS * (self.turn_radius + found.length):
            raise ArithmeticError(f"OMPL's path misses its goal by {shift}")
        return moved, shift

    def state(self, pose: Planar) -> Any:
        """An OMPL state at a pose."""
        state = self.space.allocState()
        self.place(state, pose)
        return state

    @staticmethod
    def place(state: Any, pose: Planar) -> None:
        """Move an OMPL state to a pose."""
        state.setX(pose.east)
        state.setY(pose.north)
        state.setYaw(pose.angle)


def all_round(start: Planar, joins: int) -> list[float]:
    """`joins` azimuths evenly round the circle, and twice as many that approach the azimuth of the start."""
    own = atan2(start.north, start.east)
    closer = [own + sign * pi * 10.0 ** (-16.0 * i / joins) for i in range(joins) for sign in (-1.0, 1.0)]
    even = [2.0 * pi * i / joins for i in range(joins)]
    return sorted(azimuth % (2.0 * pi) for azimuth in [*even, *closer, own])


def golden_section(length: Callable[[float], float], left: float, best: OraclePath, right: float) -> OraclePath:
    """A local minimum of `length` between `left` and `right`, from a point `best` between them that is not longer.

    The best point stays inside the bracket, so the search also converges to a minimum at a jump of the shortest path's
    length.
    """
    for _ in range(GOLDEN_STEPS):
        wide, sign = (
            (right - best.azimuth, 1.0) if right - best.azimuth > best.azimuth - left else (best.azimuth - left, -1.0)
        )
        azimuth = best.azimuth + sign * (1.0 - GOLDEN) * wide
        tried = OraclePath(length(azimuth), azimuth)
        if tried.length < best.length:
            outer, best = best.azimuth, tried
            left, right = (outer, right) if sign > 0.0 else (left, outer)
        else:
            left, right = (left, azimuth) if sign > 0.0 else (azimuth, right)
    return best
