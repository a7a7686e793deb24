"""Slots whose first arrival is at a fold, found by Newton's method, beside formulas that share no code with the kernel.

At a fold of LRL or RLR two arrivals meet in a double root: h = h' = 0 of docs/slots.md, (3). LSR and RSL vanish where
their circles touch: the length equals the time and |d| = 2. Both are two equations for the phase of the slot and the
angle held until it is met. The slot's distance from the reachable set, which shares no code with the kernel, is zero
there and not before.

In still air the circle has the radius 1: on one side of the fold the kernel has to arrive there, on the other it may
not until later. On wider circles, and in any wind, the least time has no jumps: an aircraft that could be in one slot
cuts inside the circle, or turns outside it, and is in the next slot soon. So folds in wind are checked on both sides,
each slot beside Buzikov's step. Half of these circles are the tightest in a wind of a millionth to a twentieth of the
airspeed, on which cutting takes long.

`python -m kernel.slot_folds 20` finds 20 folds of each kind; `wind` does so in wind. A last number is the seed.
"""

import sys
from math import atan2, cos, inf, nan, sin, tau
from typing import NamedTuple

import numpy as np
from scipy.optimize import fsolve

from kernel.slots import REACHED, Scenes, closest_between, least_times, random_scenes
from loiter.certificate.slot_check import distance
from loiter.compiled.solver import first_in_slot
from loiter.kernel.angles import angle, arc_rotation
from loiter.kernel.wind import slots
from loiter.kernel.wind.hold import hold_pose
from loiter.kernel.wind.moving_target import NO_PATH
from loiter.kernel.wind.wind_search import WindProblem, scene_of, time_of

# How far beside a fold the slot is moved, and by how much that moves the arrival at most: by the square root, or less.
BESIDE, MOVED = 1e-8, 1e-2

# In wind: what a time may exceed that of Buzikov's steps by, which end 1e-10 from the slot, and how many these are.
LATE, STEPS = 1e-3, 1000

# The kinds: outer controls and the half turn of the middle arc, or None for a straight piece.
KINDS = [(u, u, halves) for u in (1, -1) for halves in (0, 1)] + [(1, -1, None), (-1, 1, None)]


def problem_of(scenes, i):
    """A scene as the kernel's problem."""
    q, w, heading = complex(scenes.place[i]), complex(scenes.wind[i]), float(scenes.heading[i])
    side, R = int(-scenes.way[i]), float(scenes.R[i])
    return WindProblem(q.real, q.imag, cos(heading), sin(heading), R, side, w.real, w.imag, 0.0)


def scenes_of(problem, phase):
    """A problem and a phase as a scene of the independent check."""
    p = problem
    x, y, *_ = hold_pose(phase, p.side, p.R, p.wx, p.wy)
    place, wind, heading = complex(p.x, p.y), complex(p.wx, p.wy), atan2(p.s, p.c)
    return Scenes(*(np.array([value]) for value in (place, heading, p.R, wind, float(-p.side), atan2(y, x))))


def at_fold(kind, phase, width, problem):
    """Two numbers that vanish at a fold, and the path there; `inf` as its time where it is none."""
    first, last, halves = kind
    scene, slot = scene_of(problem), slots.Slot(problem.side, phase)
    pose = slots.slot_pose(width, slot, scene)
    if halves is None:
        excess = slots.excess_at(first, last, pose, slot, scene)
        if excess.apart <= -2.0:
            return (1.0, excess.apart), NO_PATH
        return (excess.value, excess.apart), slots.path_with_straight(first, last, pose, scene)
    origin = slots.slot_pose(0.0, slot, scene)
    half = np.pi * halves - 0.5 * angle(arc_rotation(first, scene.c, scene.s, origin.c, origin.s))
    middle = slots.middle_at(first, half, pose, slot, scene)
    return (middle.value, middle.slope), slots.path_of_three_arcs(first, middle, pose, scene)


def fold_of(kind, problem, phase, width):
    """Phase, width and time of a fold near a guess; None where Newton's method does not converge."""
    found, _, status, _ = fsolve(lambda v: at_fold(kind, *v, problem)[0], (phase, width), xtol=1e-14, full_output=True)
    phase, width = (float(value) for value in found)
    if status != 1 or not 0.0 < width * problem.R < 40.0:
        return None
    off, path = at_fold(kind, phase, width, problem)
    pose = slots.slot_pose(width, slots.Slot(problem.side, phase), scene_of(problem))
    fits = path.time < inf and abs(path.time - pose.time) < 1e-6
    return (phase, width, path.time) if fits and max(map(abs, off)) < 1e-10 else None


def times_beside(problem, phase):
    """The kernel's times for slots on either side of a phase."""
    return [time_of(first_in_slot(problem, phase + shift)) for shift in (-BESIDE, BESIDE)]


def check(problem, phase, time):
    """What is wrong at a fold that is the first arrival: empty for nothing."""
    beside = times_beside(problem, phase)
    scenes = scenes_of(problem, phase)
    if min(abs(one - time) for one in beside) > MOVED:
        return f"the kernel arrives at {beside}, not at {time}"
    begin, gap, azimuth = (float(values[0]) for values in least_times(scenes, 400))
    if begin > time + 1e-6 or (gap <= REACHED and begin < time - 1e-3):
        return f"Buzikov's step ends at {begin}, {gap} away, not at {time}"
    if gap > REACHED and closest_between(scenes, 0, begin, azimuth, time - 1e-3) < 1e-8:
        return f"there is an arrival between {begin} and {time}"
    return ""


def distance_at(problem, phase, width):
    """The distance of the slot from the reachable set after an angle, by formulas that share no code."""
    pose = slots.slot_pose(width, slots.Slot(problem.side, phase), scene_of(problem))
    start = complex(problem.c, problem.s)
    place, heading = complex(pose.x, pose.y) / start, complex(pose.c, pose.s) / start
    return float(distance(np.array([place]), np.array([np.angle(heading)]), np.array([pose.time]))[0])


class Beside(NamedTuple):
    """A slot beside a fold in wind: what is wrong, and how late its time is, nan where Buzikov's steps do not end."""

    said: str
    late: float


def check_beside(problem, phase):
    """The kernel's time of a slot beside Buzikov's steps and, where these do not end, beside sampled distances."""
    time, scenes = time_of(first_in_slot(problem, phase)), scenes_of(problem, phase)
    begin, gap, azimuth = (float(values[0]) for values in least_times(scenes, STEPS))
    if begin > time + 1e-9:
        return Beside(f"the kernel arrives at {time}, Buzikov's step ends at {begin}, {gap} away", nan)
    if gap <= REACHED:
        return Beside(f"the kernel arrives at {time}, later than {begin}" if time > begin + LATE else "", time - begin)
    if begin < time - LATE and closest_between(scenes, 0, begin, azimuth, time - LATE) < 1e-8:
        return Beside(f"there is an arrival between {begin} and {time}", nan)
    return Beside("", nan)


def is_first(beside, time, windy):
    """Whether no arrival is earlier than a fold and, in still air, the next one beyond it is later."""
    return min(beside) > time - MOVED and (windy or max(beside) > time + 5.0 * MOVED)


def starts_there(problem, phase):
    """Whether the aircraft starts in the slot, nearly."""
    pose = slots.slot_pose(0.0, slots.Slot(problem.side, phase), scene_of(problem))
    return abs(complex(pose.x, pose.y)) < 1e-3


def fold_scenes(random, n, windy):
    """Random scenes; in still air the circles have the radius 1, in wind half of them the least, in a weak one."""
    scenes = random_scenes(random, n, windy)
    wind = np.where(random.random(n) < 0.5, 10.0 ** random.uniform(-6.0, -1.3, n) * np.sign(scenes.wind), scenes.wind)
    tight = np.abs(wind) != np.abs(scenes.wind) if windy else np.full(n, True)
    R = np.where(tight, (1.0 + np.abs(wind)) ** 2 * (1.0 + 1e-12), scenes.R)
    return scenes._replace(R=R, wind=wind)


def folds(random, kind, n, windy):
    """Folds of a kind that are first arrivals."""
    found = []
    while len(found) < n:
        scenes = fold_scenes(random, 20, windy)
        for i in range(20):
            problem = problem_of(scenes, i)
            fold = fold_of(kind, problem, random.uniform(0.0, tau), random.uniform(0.5, 12.0) / problem.R)
            if fold is None or starts_there(problem, fold[0]):
                continue
            if is_first(times_beside(problem, fold[0]), fold[2], windy):
                found.append((problem, *fold))
    return found[:n]


def compare(n, windy, seed, say=print):
    """Check n folds of each kind; return how many disagree."""
    random, wrong = np.random.default_rng(seed), 0
    for kind in KINDS:
        jumps, late = [], []
        for problem, phase, width, time in folds(random, kind, n, windy):
            apart = distance_at(problem, phase, width)
            said = f"the slot is {apart} away at the fold" if apart > 1e-7 else ""
            if windy:
                sides = [check_beside(problem, phase + shift) for shift in (-BESIDE, 0.0, BESIDE)]
                said = said or next((side.said for side in sides if side.said), "")
                late += [side.late for side in sides]
            else:
                said = said or check(problem, phase, time)
            jumps.append(max(times_beside(problem, phase)) - time)
            wrong += said != ""
            if said:
                say(f"seed {seed} {kind}: {problem}, phase {phase!r}, width {width!r}: {said}")
        text = f"{kind}: {n} folds, {wrong} wrong so far; beyond them up to {max(jumps):.2g} later"
        if windy:
            undecided = int(np.isnan(late).sum())
            text += f"; later than the check by up to {np.nanmax(late):.2g}, {undecided} of {len(late)} undecided"
        say(text, flush=True)
    return wrong


if __name__ == "__main__":
    seed = int(sys.argv[-1]) if sys.argv[2:] and sys.argv[-1].isdigit() else 1
    sys.exit(compare(int(sys.argv[1]), "wind" in sys.argv, seed) > 0)
