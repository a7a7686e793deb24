"""Fleets beside every assignment at many common phases: `python -m fleets.fleets 20`."""

import sys
from itertools import permutations

import numpy as np

from loiter import Aircraft, Orbit, Pose, Slot, Turn, Wind, hold, plan
from loiter.fleets import fleet
from loiter.planning.flight import samples_at
from loiter.planning.problem import problem_of
from loiter.planning.slot import slot_pose


def random_fleet(random, n, windy=False):
    """Poses, circle, aircraft and wind."""
    uav = Aircraft(18.0, max_bank_deg=35.0)
    wind = Wind(float(random.uniform(1.0, 6.0)), float(random.uniform(0.0, 360.0))) if windy else None
    orbit = Orbit(0.0, 0.0, float(random.uniform(110.0, 300.0)))
    span = 4.0 * orbit.radius_m
    return [Pose(*random.uniform(-span, span, 2), random.uniform(0.0, 360.0)) for _ in range(n)], orbit, uav, wind


def period_s(orbit, uav, wind):
    """The time of one turn, by the midpoint rule."""
    held = hold(orbit, uav, wind, turn="cw")
    azimuths = np.arange(0.25, 360.0, 0.5)
    return sum(2.0 * np.pi * orbit.radius_m / 720 / held.at(azimuth_deg=float(a)).ground_speed_m_s for a in azimuths)


def flown_places(planned, times_s):
    """The places of the aircraft of a plan (rows), east + 1j north: of its entries, then of its slots one by one."""
    places = []
    for entry, slot in zip(planned.entries, planned.slots, strict=True):
        problem = problem_of(entry).with_turn(planned.turn)
        before = samples_at(
            times_s[times_s <= entry.duration_s], entry.start, entry.segments, entry.aircraft, entry.wind
        )
        poses = [slot_pose(slot, problem, float(t)) for t in times_s[times_s > entry.duration_s]]
        held = [complex(pose.east_m, pose.north_m) for pose in poses]
        places.append([*(before.east_m + 1j * before.north_m), *held])
    return np.array(places)


def least_s(poses, orbit, uav, wind, phases):
    """The least time of the last aircraft over directions, common phases and assignments."""
    n, whole_s, best = len(poses), period_s(orbit, uav, wind), np.inf
    at_s = whole_s / (n * phases) * np.arange(n * phases)
    for turn in (Turn.CW, Turn.CCW):
        circle = Orbit(orbit.east_m, orbit.north_m, orbit.radius_m, turn)
        times = np.array(
            [[plan(pose, circle, uav, wind, slot=Slot(0.0, float(t))).duration_s for t in at_s] for pose in poses]
        ).reshape(n, n, phases)
        for order in permutations(range(n)):
            best = min(best, times[range(n), order].max(axis=0).min())
    return best


def main(fleets, phases):
    random, better = np.random.default_rng(4), []
    for k in range(fleets):
        scene = random_fleet(random, 2 + k % 5, windy=k % 2 == 1)
        planned = fleet(*scene).duration_s
        better.append(planned - least_s(*scene, max(phases // len(scene[0]), 1)))
        if better[-1] > 1e-6:
            print(f"{len(scene[0])} aircraft: {better[-1]:.3g} s sooner than {planned:.4f} s")
    print(f"{fleets} fleets: every assignment is sooner by {max(better):.3g} s at most, later by {-min(better):.3g} s")
    return max(better) > 1e-3


if __name__ == "__main__":
    sys.exit(main(int(sys.argv[1]), 3600))
