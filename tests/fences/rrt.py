"""Clear entries beside OMPL's RRT*: `python -m fences.rrt --scenes 8` prints a row for each scene.

RRT* samples poses in the Dubins space; its goals are poses all round the circle, and a pose is valid if it is not
closer to a zone than the margin. Its paths are checked each 0.5 m.
"""

import argparse
from math import hypot, pi, radians
from time import process_time

import numpy as np
from ompl import base, geometric, util

from fences.brute import blocked_scene, joins
from loiter.fences import CircleZone, clear_entry

# Processor time.
BUDGETS_S = (1.0, 10.0)


def rrt_star_m(maneuver, zones, margin_m, seconds):
    """The length of RRT*'s best path after so many seconds of processor time, metres; inf without one."""
    r, orbit = maneuver.aircraft.turn_radius_m, maneuver.orbit
    space = base.DubinsStateSpace(r)
    size = 2.0 * (hypot(maneuver.start.east_m - orbit.east_m, maneuver.start.north_m - orbit.north_m) + orbit.radius_m)
    bounds = base.RealVectorBounds(2)
    for i, middle in enumerate((orbit.east_m, orbit.north_m)):
        bounds.setLow(i, middle - size)
        bounds.setHigh(i, middle + size)
    space.setBounds(bounds)
    information = base.SpaceInformation(space)
    information.setStateValidityChecker(lambda state: is_valid(zones, state.getX(), state.getY(), margin_m))
    information.setStateValidityCheckingResolution(0.5 / space.getMaximumExtent())
    information.setup()
    problem = base.ProblemDefinition(information)
    start = maneuver.start
    problem.addStartState(pose(information, start.east_m, start.north_m, radians(90.0 - start.heading_deg)))
    goals = base.GoalStates(information)
    for place, heading in zip(*joins(orbit), strict=True):
        goals.addState(pose(information, place.real, place.imag, float(np.angle(heading))))
    problem.setGoal(goals)
    problem.setOptimizationObjective(base.PathLengthOptimizationObjective(information))
    planner = geometric.RRTstar(information)
    planner.setProblemDefinition(problem)
    planner.setup()
    began = process_time()
    planner.solve(base.PlannerTerminationCondition(lambda: process_time() - began > seconds))
    return problem.getSolutionPath().length() if problem.hasExactSolution() else np.inf


def pose(information, x, y, yaw):
    state = information.allocState()
    state.setXY(x, y)
    state.setYaw((yaw + pi) % (2.0 * pi) - pi)
    return state


def is_valid(zones, x, y, margin_m):
    """Whether a place is farther from every zone than the margin, one zone after the other."""
    return all(clearance_m(zone, x, y) > margin_m for zone in zones)


def clearance_m(zone, x, y):
    if isinstance(zone, CircleZone):
        outside = hypot(x - zone.east_m, y - zone.north_m) - zone.radius_m
        return -outside if zone.inclusion else outside
    inside, nearest = False, np.inf
    for (x0, y0), (x1, y1) in zip(zone.corners, (*zone.corners[1:], zone.corners[0]), strict=True):
        share = ((x - x0) * (x1 - x0) + (y - y0) * (y1 - y0)) / ((x1 - x0) ** 2 + (y1 - y0) ** 2)
        share = min(max(share, 0.0), 1.0)
        nearest = min(nearest, hypot(x - x0 - share * (x1 - x0), y - y0 - share * (y1 - y0)))
        if (y0 > y) != (y1 > y) and x < x0 + (y - y0) * (x1 - x0) / (y1 - y0):
            inside = not inside
    return nearest if inside == zone.inclusion else -nearest


def main():
    parser = argparse.ArgumentParser(prog="python -m fences.rrt", description=__doc__)
    parser.add_argument("--scenes", type=int, default=8)
    arguments = parser.parse_args()
    util.setLogLevel(util.LOG_NONE)
    util.RNG.setSeed(1)
    print("scene, zones, fastest without a fence, clear entry, processor time, RRT* after 1 s, after 10 s", flush=True)
    for k in range(arguments.scenes):
        rng = np.random.default_rng([3, k])
        maneuver, fence, margin_m = blocked_scene(rng, 5)
        began = process_time()
        found = clear_entry(fence, maneuver.start, maneuver.orbit, maneuver.aircraft, margin_m=margin_m)
        cost_s, V = process_time() - began, maneuver.aircraft.airspeed_m_s
        ours = found.maneuver.duration_s if found.maneuver else np.inf
        sampled = [rrt_star_m(maneuver, fence.zones, margin_m, seconds) / V for seconds in BUDGETS_S]
        columns = [maneuver.duration_s, ours, cost_s, *sampled]
        print(k, len(fence.zones), *(f"{value:.2f}" for value in columns), sep=", ", flush=True)


if __name__ == "__main__":
    main()
