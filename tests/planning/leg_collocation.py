"""Legs beside a collocation in three dimensions: any path onto the circle, the hold, and the climb at a bounded rate.

`python -m planning.leg_collocation 50` collocates random legs
in still air, prints each that is sooner than its plan, and by how much the others are later. Like the plans of legs the
program may take a path onto the circle that is longer than need be, to be at an altitude just in time.
"""

import sys
from functools import cache
from itertools import pairwise, product
from math import acos, atan2, hypot, inf, pi, tau
from typing import NamedTuple

import numpy as np

from evidence.checks.collocation import IPOPT, LONGEST, interval_ends, velocity
from evidence.checks.oracle import Planar, from_compass
from loiter import Turn, plan_leg
from planning.legs import climb_time, random_leg

# Intervals of the even mesh, on which every guess is tried, and of the free one, for the best of them.
COARSE, FINE, REFINED = 12, 24, 2

# IPOPT's tolerance, and the quadrature of intervals of up to a radian, leave this share of the time.
RESOLUTION = 1e-6


class Round(NamedTuple):
    """A leg in turn radii: the start, the circle, the exit's angle, the least angle held, and the time of the climb."""

    start: Planar
    radius: float
    side: float  # 1 clockwise, -1 counter-clockwise
    exit_angle: float
    least: float
    climb: float


def rounds_of(leg, uav):
    """The leg in each direction."""
    r, orbit = uav.turn_radius_m, leg.orbit
    start = from_compass(
        (leg.pose.east_m - orbit.east_m) / r, (leg.pose.north_m - orbit.north_m) / r, leg.pose.heading_deg
    )
    east, north = (leg.exit_to[0] - orbit.east_m) / r, (leg.exit_to[1] - orbit.north_m) / r
    R, unit = orbit.radius_m / r, uav.airspeed_m_s / r
    for turn in [Turn.CW, Turn.CCW] if leg.orbit.turn is Turn.EITHER else [leg.orbit.turn]:
        side = 1.0 if turn is Turn.CW else -1.0
        angle = atan2(north, east) + side * acos(min(R / hypot(east, north), 1.0))
        least = max(tau * leg.turns, leg.hold_s * unit / R)
        yield Round(start, R, side, angle, least, climb_time(leg, uav) * unit)


@cache
def program(n, even):
    """The nonlinear program: n intervals to the circle, the angle that is held, and the share of the rate in each."""
    import casadi as ca

    poses, u, rates, held = ca.SX.sym("z", 3, n + 1), ca.SX.sym("u", n), ca.SX.sym("w", n + 1), ca.SX.sym("a")
    parameters = ca.SX.sym("p", 7)
    start, R, side, exit_angle, climb = ca.vertsplit(parameters, [0, 3, 4, 5, 6, 7])
    steps = ca.SX.sym("h", 1 if even else n)
    h = ca.repmat(steps, n, 1) if even else steps
    z = ca.horzsplit(poses)
    defects = [b - a - h[k] * velocity(a, u[k], h[k]) for k, (a, b) in enumerate(pairwise(z))]
    first, *_, last = z
    # Clockwise the angle falls: the circle is joined at a larger one than that of the exit.
    join = exit_angle + side * held
    off = last[2] - (join - side * pi / 2.0)
    climbed = ca.dot(h, rates[:n]) + R * held * rates[n]
    constraints = ca.vertcat(
        first - start, *defects, last[0] - R * ca.cos(join), last[1] - R * ca.sin(join), ca.sin(off), climbed - climb
    )
    unknowns = ca.vertcat(ca.reshape(poses, -1, 1), u, rates, held, steps)
    # The heading is the tangent's, and not its opposite.
    constraints = ca.vertcat(constraints, ca.cos(off))
    total = ca.sum1(h) + R * held
    return ca.nlpsol("leg", "ipopt", {"x": unknowns, "p": parameters, "f": total, "g": constraints}, IPOPT)


def optimised(one, controls, lengths, held, even):
    """Time, controls, lengths and angle to which IPOPT converges from a guess; None where it does not converge."""
    n = len(controls)
    steps = lengths[:1] if even else lengths
    poses = np.full(3 * (n + 1), inf)
    lower = np.concatenate([-poses, np.full(n, -1.0), np.zeros(n + 1), [one.least], np.zeros(len(steps))])
    upper = np.concatenate([poses, np.ones(n), np.ones(n + 1), [inf], np.full(len(steps), LONGEST * max(lengths))])
    ends = np.ravel(interval_ends(one.start, controls, lengths))
    guess = np.concatenate([ends, controls, np.full(n + 1, 0.9), [max(held, one.least + 1e-3)], steps])
    p = [*one.start, one.radius, one.side, one.exit_angle, one.climb]
    zeros = np.zeros(3 * (n + 1) + 4)
    solver = program(n, even)
    found = solver(x0=guess, p=p, lbx=lower, ubx=upper, lbg=np.append(zeros, 0.5), ubg=np.append(zeros, 1.0))
    if not solver.stats()["success"]:
        return None
    values = found["x"].full().ravel()
    at = 3 * (n + 1)
    return float(found["f"]), values[at : at + n], np.broadcast_to(values[at + 2 * n + 2 :], n), values[at + 2 * n + 1]


def collocated(one):
    """The least time to the exit that is found, in turn radii over airspeed; inf without any."""
    away = abs(hypot(one.start.east, one.start.north) - one.radius)
    held_guesses = sorted({one.least, one.least + 1.5, max(one.least, (one.climb - away - 2.0) / one.radius)})
    coarse = []
    for first, second, time, held in product((-0.9, 0.9), (-0.9, 0.0, 0.9), (away + 2.0, away + 7.0), held_guesses):
        controls = [first] * (COARSE // 2) + [second] * (COARSE // 2)
        found = optimised(one, controls, [time / COARSE] * COARSE, held, even=True)
        coarse += [found] if found else []
    times = [found[0] for found in coarse]
    for _, controls, lengths, held in sorted(coarse, key=lambda found: found[0])[:REFINED]:
        parts = FINE // COARSE
        fine = optimised(one, np.repeat(controls, parts), np.repeat(lengths / parts, parts), held, even=False)
        times += [fine[0]] if fine else []
    return min(times, default=inf)


def collocated_s(leg, uav):
    """The least time at the exit and on to the point that the collocation finds, seconds."""
    unit, east = uav.turn_radius_m / uav.airspeed_m_s, leg.exit_to[0] - leg.orbit.east_m
    straight = max(east**2 + (leg.exit_to[1] - leg.orbit.north_m) ** 2 - leg.orbit.radius_m**2, 0.0) ** 0.5
    return min(map(collocated, rounds_of(leg, uav))) * unit + straight / uav.airspeed_m_s


def main(legs):
    random = np.random.default_rng(3)
    wrong, later = 0, []
    for number in range(legs):
        leg, uav, _ = random_leg(random)
        plan = plan_leg(leg, uav)
        other = collocated_s(leg, uav)
        share = (other - plan.duration_s) / plan.duration_s
        later.append(share)
        if share < -RESOLUTION:
            wrong += 1
            print(f"{number + 1}: sooner by {-share:.2g}: {leg}", flush=True)
        print(f"{number + 1}: later by {share:.2g}", flush=True)
    print(
        f"{legs} legs: the collocation is later by {np.median(later):.2g} of the time in the median, found "
        f"{np.isinf(later).sum()} no path, and is sooner in {wrong}"
    )
    return wrong


if __name__ == "__main__":
    sys.exit(main(int(sys.argv[1])) > 0)
