"""The bounds on second derivatives with which slots are stepped, attacked by optimisation, in still air and in wind.

A step is safe if, anywhere within it, the second derivative of h (docs/slots.md, section 3) lies between the bounds
that the kernel takes at its beginning, and V is no larger than its own.
`python -m kernel.slot_bounds 20` searches for the scene, the place and the step at which
central differences come closest to a bound, from so many beginnings by Nelder and Mead's method; `wind` does so in wind
of up to 0.95 of the airspeed. A share above 1 would let a step jump over an arrival. A last number is the seed.
"""

import sys
from functools import partial
from math import cos, pi, sin

import numpy as np
from scipy.optimize import minimize

from loiter.kernel.angles import angle, arc_rotation, length
from loiter.kernel.wind import slots
from loiter.kernel.wind.wind_search import WindProblem, scene_of

# Steps of central differences, and what rounding leaves of a second one.
STEP, ROUNDING_LEFT = 1e-4, 1e-6


def scene_at(v, windy):
    """A scene, a slot and a place within a step from eleven numbers."""
    w = 0.95 * 0.5 * (1.0 + sin(v[0])) if windy else 0.0
    R = (1.0 + w) ** 2 * (1.0 + 1e-9 + v[1] ** 2)
    x, y, heading, phase = v[2], v[3], v[4], v[5]
    problem = WindProblem(
        x, y, cos(heading), sin(heading), R, 1 if v[10] > 0.0 else -1, w * cos(v[9]), w * sin(v[9]), 0.0
    )
    slot = slots.Slot(problem.side, phase)
    width, share = abs(v[6]), 0.5 * (1.0 + sin(v[7]))
    return scene_of(problem), slot, width, share, 1 if v[8] > 0.0 else -1


def shares(v, windy):
    """The second derivative of h, and V, within a step, over their bounds."""
    scene, slot, width, share, u = scene_at(v, windy)
    pose = slots.slot_pose(width, slot, scene)
    limits = slots.bounds_at(u, pose, slot, scene)
    if limits.speed <= 1e-6:
        return 0.0, 0.0
    origin = slots.slot_pose(0.0, slot, scene)
    half = -0.5 * angle(arc_rotation(u, scene.c, scene.s, origin.c, origin.s)) + pi * (v[7] > 0.0)
    limit = min(limits.step, 1.0 / limits.speed)
    middle = slots.middle_at(u, half, pose, slot, scene)
    furthest = length(middle.dx, middle.dy) + limits.speed * limit
    bends, square = slots.bends_of_square(u, furthest, limits, scene), 2.0 * limits.speed**2
    low = min(bends.down + 4.0 * limits.speed_change, bends.size + square)
    high = min(bends.up + square + 4.0 * limits.speed_change, bends.size + square)
    there = width + STEP + share * max(limit - 2.0 * STEP, 0.0)

    def value(at):
        return slots.middle_at(u, half, slots.slot_pose(at, slot, scene), slot, scene).value

    h = (value(there + STEP) - 2.0 * value(there) + value(there - STEP)) / STEP**2
    excess = ROUNDING_LEFT * (1.0 + furthest**2)
    speed = slots.centre_speed(u, slots.slot_pose(there, slot, scene), slot) / limits.speed
    return max((-h - excess) / low, (h - excess) / high), speed


def negative_share(v, windy, k):
    """The share of a bound, to be minimised."""
    return -shares(v, windy)[k]


def worst_shares(beginnings, windy, seed):
    """The largest shares that optimisation finds, each by its own searches."""
    random, best = np.random.default_rng(seed), [0.0, 0.0]
    for _ in range(beginnings):
        for k in range(2):
            drawn = [random.normal(0.0, 2.0, 11) for _ in range(30)]
            start = min(drawn, key=partial(negative_share, windy=windy, k=k))
            found = minimize(negative_share, start, (windy, k), "Nelder-Mead", options={"maxfev": 1500})
            best[k] = max(best[k], -float(found.fun))
    return best


if __name__ == "__main__":
    seed = int(sys.argv[-1]) if sys.argv[2:] and sys.argv[-1].isdigit() else 1
    second, speed = worst_shares(int(sys.argv[1]), "wind" in sys.argv, seed)
    print(f"the largest share of a bound that optimisation found: {second:.6f} of h'', {speed:.6f} of V")
    sys.exit(max(second, speed) > 1.0 + 1e-5)
