"""Legs with an altitude beside paths at random: `python -m planning.sampled_legs 30`, or `30 wind`.

From 24 points of joining round the circle and the last one that is allowed, arcs of three curvatures are drawn, with
whole turns, and closed by plane geometry: the circle in the middle touches the outer two. None may end, with the rest
of the circle, between the altitude and the plan's exit. It shares no code with the search. Legs are those whose exits
by first paths jump over the altitude. A last number is the seed.
"""

import sys
from cmath import exp, phase
from dataclasses import replace
from math import acos, inf, radians, sqrt, tau

import numpy as np

from loiter import Turn, plan_leg
from planning.legs import angle_enough, climb_time, hold_times, random_leg

JOINS, PATHS, ROUNDS = 24, 10_000, 40

NEARLY_STRAIGHT = 1e-5

# A path is closed that misses the end by less, in turn radii; a plan is not sooner by less of its time.
CLOSED, SAME = 1e-7, 1e-6


def curvatures(random, n):
    """Curvatures of three pieces and whole turns of the first; the tightest ones and straight pieces are frequent."""
    free = random.uniform(-1.0, 1.0, (3, n)) ** random.choice([1, 3], (3, n))
    special = random.choice([-1.0, 1.0], (3, n))
    special[1] *= random.random(n) < 0.7
    k = np.where(random.random((3, n)) < 0.7, special, free)
    # A piece that is nearly straight stands for a straight one.
    return np.where(np.abs(k) < NEARLY_STRAIGHT, NEARLY_STRAIGHT, k), random.integers(0, 3, n)


def durations(start, heading, end, last, k, turns, side):
    """Of the pieces of the path of each three curvatures between two poses; nan where its circles do not touch."""
    radius = 1.0 / k
    first, third = start + 1j * heading * radius[0], end + 1j * last * radius[2]
    a, b, d = radius[1] - radius[0], radius[1] - radius[2], third - first
    # The middle centre is -a n from the first one and -b m from the third, n and m the normals where circles touch.
    along = (np.abs(d) ** 2 + a**2 - b**2) / (2.0 * np.abs(d))
    middle = first + d / np.abs(d) * (along + 1j * side * np.sqrt(a**2 - along**2))
    leaves, joins = (middle - first) / (1j * a), (middle - third) / (1j * b)
    turned = np.angle([leaves / heading, joins / leaves, last / joins]) * np.sign(k)
    return (turned % tau + tau * turns * [[1], [0], [0]]) / np.abs(k)


def misses(start, heading, end, last, k, t):
    """How far from the end, place and heading, the paths are when they are flown."""
    for curvature, duration in zip(k, t, strict=True):
        turn = np.exp(1j * curvature * duration)
        start, heading = start + heading * (turn - 1.0) / (1j * curvature), heading * turn
    return np.abs(start - end) + np.abs(heading - last)


def arrival_times(random, start, heading, place, last, w, n=PATHS):
    """Times at which paths at random arrive at a pose that moves with -w through the air."""
    (k, turns), side = curvatures(random, n), random.choice([-1.0, 1.0], n)
    time = np.zeros(n)
    with np.errstate(all="ignore"):
        for _ in range(ROUNDS if w else 1):
            t = durations(start, heading, place - w * time, last, k, turns, side)
            time = t.sum(axis=0)
        return time[misses(start, heading, place - w * time, last, k, t) <= CLOSED]


def soonest_s(random, leg, uav, wind):
    """The least time at the exit, no less than that of the climb, that is found in a leg's direction, seconds."""
    way = -1 if leg.orbit.turn is Turn.CW else 1
    r, v = uav.turn_radius_m, uav.airspeed_m_s
    centre, R, w = complex(leg.orbit.east_m, leg.orbit.north_m), leg.orbit.radius_m / r, complex(*wind.velocity_m_s) / v
    place, target = (complex(leg.pose.east_m, leg.pose.north_m) - centre) / r, (complex(*leg.exit_to) - centre) / r
    azimuth, climb_s = phase(target) - way * acos(R / abs(target)), climb_time(leg, uav)
    angles = np.arange(0.0, angle_enough(leg, climb_s, R, abs(w), v / r), tau / (8 * JOINS))
    angles, held = hold_times(azimuth, way, w, angles, R)
    exits = [np.array([np.inf])]
    for angle, time in zip(angles[::8], held[::8], strict=True):
        if time * r / v < climb_s:
            out = exp(1j * (azimuth - way * angle))
            across = (w / (1j * way * out)).imag
            last = 1j * way * out * (sqrt(1.0 - across**2) - 1j * across)
            heading = exp(1j * radians(90.0 - leg.pose.heading_deg))
            exits.append(time + arrival_times(random, place, heading, R * out, last, w))
    exit_s = np.concatenate(exits) * r / v
    return exit_s[exit_s >= climb_s].min()


def jumping_leg(random, windy):
    """A leg with an altitude alone over which exits of first paths jump, its aircraft, wind and plan."""
    while True:
        leg, uav, wind = random_leg(random, windy)
        orbit = replace(leg.orbit, turn=random.choice([Turn.CW, Turn.CCW]))
        level = replace(leg, orbit=orbit, hold_s=0.0, turns=0.0, altitude_m=None)
        leg = replace(level, altitude_m=100.0 + random.uniform(-60.0, 60.0))
        if plan_leg(level, uav, wind).exit_s < climb_time(leg, uav):
            plan = plan_leg(leg, uav, wind)
            widest = min(abs(segment.curvature_per_m) or inf for segment in plan.entry.segments)
            if plan.exit_s > climb_time(leg, uav) * (1.0 + 1e-9) or widest * uav.turn_radius_m < 1.0 - 1e-6:
                return leg, uav, wind, plan


def main(legs, windy, seed):
    random, sooner, later, late = np.random.default_rng(seed), 0, [], 0
    for _ in range(legs):
        leg, uav, wind, plan = jumping_leg(random, windy)
        late += plan.exit_s > climb_time(leg, uav) * (1.0 + 1e-9)
        later.append(soonest_s(random, leg, uav, wind) / plan.exit_s - 1.0)
        if later[-1] < -SAME:
            sooner += 1
            print(f"sooner by {-later[-1]:.2g}: {leg}, {uav}, {wind}", flush=True)
    print(f"{legs} legs, {late} of them with no path in time: sooner in {sooner}, later by {np.median(later):.2g}")
    return sooner


if __name__ == "__main__":
    seed = int(sys.argv[-1]) if sys.argv[2:] and sys.argv[-1].isdigit() else 1
    sys.exit(main(int(sys.argv[1]), "wind" in sys.argv, seed) > 0)
