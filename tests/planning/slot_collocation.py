"""Entries into slots, and prescribed times in gaps, beside a collocation with free final time that shares no code.

`python -m planning.slot_collocation 200` collocates random
entries into slots, half of them in wind: any control of 32 intervals of free length, with the slot's pose at the final
time as the end. It prints each that is sooner than its plan, and by how much the others are later. `gaps` takes as many
prescribed times in gaps, and looks for the path of that duration that ends nearest to the pose; a fifth of the gap
beyond either end it has to find one, which shows that it would. A last number is the seed.
"""

import sys
from functools import cache
from itertools import pairwise, product
from math import inf, tau

import numpy as np

from evidence.checks.collocation import IPOPT, LONGEST, QUADRATURE, AirVelocity, interval_ends, velocity
from evidence.checks.oracle import Planar
from kernel.slots import planned, random_scenes
from loiter.kernel.wind.wind_search import time_of
from planning.prescribed_times import complex_ends, gap_of, random_arrival

# Intervals of the even mesh, on which every guess is tried, and of the free one, for the best of them.
COARSE, FINE, REFINED = 16, 32, 2

# IPOPT's tolerance leaves this share of 1 + T.
RESOLUTION = 1e-6

# Nodes and weights on each of so many pieces of the angle held, which give the time of the hold in wind.
NODES, WEIGHTS = np.polynomial.legendre.leggauss(6)
PIECES = 8

# A path that ends nearer to the pose than this has reached it.
MISSED = 1e-5


def ground_speed(azimuth, way, wx, wy):
    """Speed and heading of a hold at an azimuth, by the wind triangle."""
    import casadi as ca

    tx, ty = -way * ca.sin(azimuth), way * ca.cos(azimuth)
    along, across = wx * tx + wy * ty, wy * tx - wx * ty
    crab = ca.sqrt(1.0 - across * across)
    return crab + along, crab * tx + across * ty, crab * ty - across * tx


@cache
def program(n, even):
    """The least time in which n intervals lead to the slot's pose after an angle `held` of the circle."""
    import casadi as ca

    poses, u, held = ca.SX.sym("z", 3, n + 1), ca.SX.sym("u", n), ca.SX.sym("a")
    parameters = ca.SX.sym("p", 8)
    start, R, way, azimuth, wx, wy = ca.vertsplit(parameters, [0, 3, 4, 5, 6, 7, 8])
    steps = ca.SX.sym("h", 1 if even else n)
    h = ca.repmat(steps, n, 1) if even else steps
    z, drift = ca.horzsplit(poses), ca.vertcat(wx, wy, 0.0)
    defects = [b - a - h[k] * (velocity(a, u[k], h[k]) + drift) for k, (a, b) in enumerate(pairwise(z))]
    first, *_, last = z
    time, piece = 0.0, held / PIECES
    for k in range(PIECES):
        for node, weight in zip(NODES, WEIGHTS, strict=True):
            g, _, _ = ground_speed(azimuth + way * piece * (k + 0.5 + 0.5 * float(node)), way, wx, wy)
            time += 0.5 * float(weight) * R * piece / g
    end = azimuth + way * held
    _, c, s = ground_speed(end, way, wx, wy)
    east, north, angle = ca.vertsplit(last)
    constraints = ca.vertcat(
        first - start,
        *defects,
        east - R * ca.cos(end),
        north - R * ca.sin(end),
        ca.sin(angle) * c - ca.cos(angle) * s,
        ca.sum1(h) - time,
        # The heading is the slot's, and not its opposite.
        ca.cos(angle) * c + ca.sin(angle) * s,
    )
    unknowns = ca.vertcat(ca.reshape(poses, -1, 1), u, held, steps)
    return ca.nlpsol("slot", "ipopt", {"x": unknowns, "p": parameters, "f": ca.sum1(h), "g": constraints}, IPOPT)


def optimised(parameters, controls, lengths, even):
    """Time, controls, lengths and error of the time where IPOPT converges from a guess; otherwise None."""
    n, start = len(controls), Planar(*parameters[:3])
    R, wind = parameters[3], AirVelocity(*parameters[6:])
    steps = lengths[:1] if even else lengths
    poses = np.full(3 * (n + 1), inf)
    lower = np.concatenate([-poses, np.full(n, -1.0), [0.0], np.zeros(len(steps))])
    upper = np.concatenate([poses, np.ones(n), [inf], np.full(len(steps), LONGEST * max(lengths))])
    ends = np.ravel(interval_ends(start, controls, lengths, wind))
    guess = np.concatenate([ends, controls, [sum(lengths) / R], steps])
    zeros = np.zeros(3 * (n + 1) + 4)
    solver = program(n, even)
    found = solver(x0=guess, p=parameters, lbx=lower, ubx=upper, lbg=np.append(zeros, 0.5), ubg=np.append(zeros, 1.5))
    if not solver.stats()["success"]:
        return None
    values, multipliers = found["x"].full().ravel(), np.abs(found["lam_g"].full().ravel())
    at = 3 * (n + 1)
    controls, lengths = values[at : at + n], np.broadcast_to(values[at + n + 1 :], n)
    # By how much the time may be too small: the quadrature's error on each interval, times the multipliers.
    quadrature = QUADRATURE * np.abs(controls) ** 6 * lengths**7
    error = float((multipliers[3 : 3 * (n + 1)].reshape(n, 3)[:, :2] * quadrature[:, np.newaxis]).sum())
    return float(found["f"]), controls, lengths, error


def collocated(scenes, i):
    """The least time into the slot of a scene that is found, and its error; inf without any."""
    q, w, R = complex(scenes.place[i]), complex(scenes.wind[i]), float(scenes.R[i])
    p = [q.real, q.imag, float(scenes.heading[i]), R, float(scenes.way[i]), float(scenes.azimuth[i]), w.real, w.imag]
    away, coarse = abs(abs(q) - R), []
    for first, second, more in product((-0.9, 0.0, 0.9), (-0.9, 0.0, 0.9), (1.0, 4.0, 8.0)):
        controls = [first] * (COARSE // 2) + [second] * (COARSE // 2)
        found = optimised(p, controls, [(away + more) / COARSE] * COARSE, even=True)
        coarse += [found] if found else []
    best = sorted(coarse, key=lambda found: found[0])[:REFINED]
    times = []
    for _, controls, lengths, _ in best:
        parts = FINE // COARSE
        fine = optimised(p, np.repeat(controls, parts), np.repeat(lengths / parts, parts), even=False)
        times += [(fine[0], fine[3])] if fine else []
    return min(times, default=(inf, 0.0))


def compare(n, seed):
    """Collocate n slots, half in wind; return how many are sooner than their plan."""
    random, wrong = np.random.default_rng(seed), 0
    later = {False: [], True: []}
    for number in range(n):
        windy = number % 2 == 1
        scenes = random_scenes(random, 1, windy)
        T = time_of(planned(scenes, 0))
        other, error = collocated(scenes, 0)
        later[windy].append((other - T) / (1.0 + T))
        if T - other > RESOLUTION * (1.0 + T) + error:
            wrong += 1
            print(f"WRONG seed {seed} number {number}: {scenes}", flush=True)
        print(f"{number}: planned {T:.9f}, collocated {other:.9f}, error {error:.2g}", flush=True)
    for windy, shares in later.items():
        found = np.array([share for share in shares if share < inf])
        same = int((np.abs(found) < 1e-4).sum())
        print(
            f"{'wind' if windy else 'still air'}: {len(shares)} slots, a path found for {found.size}, the plan's time "
            f"(to 1e-4) for {same}, sooner by {max(0.0, -found.min()):.2g} of 1 + T at most, {wrong} wrong in all"
        )
    return wrong


# Gaps


@cache
def nearest_program(n):
    """The path of a given duration that ends nearest to a pose."""
    import casadi as ca

    poses, u, parameters = ca.SX.sym("z", 3, n + 1), ca.SX.sym("u", n), ca.SX.sym("p", 4)
    east, north, angle, time = ca.vertsplit(parameters)
    z, h = ca.horzsplit(poses), time / n
    defects = [b - a - h * velocity(a, u[k], h) for k, (a, b) in enumerate(pairwise(z))]
    last = z[-1]
    miss = (last[0] - east) ** 2 + (last[1] - north) ** 2 + (last[2] - angle) ** 2
    unknowns = ca.vertcat(ca.reshape(poses, -1, 1), u)
    problem = {"x": unknowns, "p": parameters, "f": miss, "g": ca.vertcat(z[0], *defects)}
    return ca.nlpsol("nearest", "ipopt", problem, IPOPT | {"ipopt.max_iter": 200})


def closest(arrival, time, n=FINE):
    """The least distance from the pose of an arrival, place and heading, at which a path of a duration is found."""
    place, heading = complex_ends(arrival, time)
    best = inf
    turns = np.angle(heading) + tau * np.arange(-2, 3)
    solver = nearest_program(n)
    poses = np.full(3 * (n + 1), inf)
    lower, upper = np.concatenate([-poses, np.full(n, -1.0)]), np.concatenate([poses, np.ones(n)])
    for angle in turns[np.abs(turns) <= time]:
        for first, second, third in product((-0.9, 0.0, 0.9), repeat=3):
            controls = np.repeat([first, second, third], [n // 3, n - 2 * (n // 3), n // 3])
            ends = np.ravel(interval_ends(Planar(0.0, 0.0, 0.0), controls, [time / n] * n))
            found = solver(
                x0=np.concatenate([ends, controls]),
                p=[place.real, place.imag, float(angle), time],
                lbx=lower,
                ubx=upper,
                lbg=0.0,
                ubg=0.0,
            )
            if solver.stats()["success"]:
                best = min(best, float(found["f"]) ** 0.5)
            if best < MISSED:
                return best
    return best


def compare_gaps(n, seed):
    """Collocate n times in gaps, and times beyond them; return how many are wrong."""
    random, missed, beyond = np.random.default_rng(seed), [], []
    while len(missed) < n:
        arrival = random_arrival(random)
        gap = gap_of(arrival)
        if gap is None:
            continue
        before, after = gap
        missed.append(closest(arrival, before + (after - before) * random.uniform(0.1, 0.9)))
        beyond.append(closest(arrival, after + 0.2 * (after - before)))
        print(f"{len(missed)}: {missed[-1]:.2g} away in the gap, {beyond[-1]:.2g} beyond it", flush=True)
    found = int((np.array(beyond) < MISSED).sum())
    print(f"{n} times in gaps: at least {min(missed):.2g} away; beyond the gap a path in {found}")
    return sum(miss < MISSED for miss in missed) + (found < 0.8 * n)


if __name__ == "__main__":
    seed = int(sys.argv[-1]) if sys.argv[2:] and sys.argv[-1].isdigit() else 3
    sys.exit((compare_gaps if "gaps" in sys.argv else compare)(int(sys.argv[1]), seed) > 0)
