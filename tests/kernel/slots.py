"""First arrivals in slots beside Buzikov's step (arXiv 2210.03439), which shares no code with the kernel.

The distances are those of `loiter.certificate.slot_check`; here each scene makes a step at a time, and many scenes do
so at once. `python -m kernel.slots 10000` compares random slots in still air; `wind` takes slots in wind, `folds` slots
next to a jump of the time, where two branches of a word meet or a word vanishes. A last number is the seed.
"""

import sys
from math import cos, hypot, pi, sin, tau
from typing import NamedTuple

import numpy as np

from loiter.certificate.slot_check import CLOSING, distance, ground_speed, hold_time
from loiter.compiled.solver import first_in_slot
from loiter.kernel.wind.hold import phase_of
from loiter.kernel.wind.wind_search import WindProblem

# The slot is reached where the distance is less; after that many steps the time so far is a lower bound alone.
REACHED, STEPS = 1e-10, 2000

# Longest step.
LONGEST = 0.25


class Scenes(NamedTuple):
    """Arrays: starts (complex places and headings), radius, wind, control of the hold, azimuth of the slot at 0."""

    place: np.ndarray
    heading: np.ndarray
    R: np.ndarray
    wind: np.ndarray
    way: np.ndarray
    azimuth: np.ndarray


def random_scenes(random, n, windy=False):
    """Scenes in turn radii: R from 1 to 10, or more in strong wind; starts inside, near and far."""
    w = random.uniform(0.02, 0.6, n) if windy else np.zeros(n)
    R = np.maximum(random.uniform(1.0, 10.0, n), (1.0 + w) ** 2 * (1.0 + 1e-12))
    R = np.where(random.random(n) < 0.1, (1.0 + w) ** 2 * (1.0 + 1e-12), R)
    span = R * random.choice([1.0, 1.5, 4.0], n)
    place = span * (random.uniform(-1.0, 1.0, n) + 1j * random.uniform(-1.0, 1.0, n))
    on = random.random(n) < 0.1
    azimuth = random.uniform(0.0, tau, n)
    place = np.where(on, R * np.exp(1j * azimuth), place)
    way = random.choice([1.0, -1.0], n)
    heading = np.where(on, azimuth + way * pi / 2.0, random.uniform(0.0, tau, n))
    return Scenes(place, heading, R, w * np.exp(1j * random.uniform(0.0, tau, n)), way, random.uniform(0.0, tau, n))


def least_times(scenes, steps=STEPS):
    """For each scene a time before which there is no arrival, and distance and azimuth of the slot then.

    A distance of zero is an arrival. Next to a double root the steps are short, and `steps` may end before that.
    """
    n = len(scenes.R)
    times, gaps, azimuths = np.zeros(n), np.full(n, np.inf), scenes.azimuth.copy()
    active = np.arange(n)
    for _ in range(steps):
        part = Scenes(*(field[active] for field in scenes))
        t, azimuth = times[active], azimuths[active]
        _, heading = ground_speed(azimuth, part.way, part.wind)
        start = np.exp(1j * part.heading)
        place = (part.R * np.exp(1j * azimuth) - part.wind * t - part.place) / start
        gaps[active] = gap = distance(place, np.angle(heading / start), t)
        going = gap > REACHED
        if not going.any():
            break
        active, part = active[going], Scenes(*(field[going] for field in part))
        allowed = np.minimum(gap[going] / CLOSING, LONGEST)
        g, _ = ground_speed(azimuth[going], part.way, part.wind)
        width = 0.9 * allowed * g / part.R
        took = hold_time(azimuth[going], width, part.way, part.R, part.wind)
        short = took > allowed
        width = np.where(short, allowed * (1.0 - np.abs(part.wind)) / part.R, width)
        took = np.where(short, hold_time(azimuth[going], width, part.way, part.R, part.wind), took)
        times[active] += took
        azimuths[active] += part.way * width
    return times, gaps, azimuths


def closest_between(scenes, i, begin, azimuth, end, spacing=1e-3):
    """The least distance of a slot between two times, from local minima of samples, for undecided scenes."""
    part = Scenes(*(field[i : i + 1] for field in scenes))

    def sampled(begin, azimuth, width, n):
        widths = np.full(n, width / n)
        many = Scenes(*(np.repeat(field, n) for field in part))
        azimuths = azimuth + part.way[0] * widths * np.arange(n)
        times = begin + np.concatenate(
            [[0.0], np.cumsum(hold_time(azimuths, widths, many.way, many.R, many.wind))[:-1]]
        )
        _, heading = ground_speed(azimuths, many.way, many.wind)
        start = np.exp(1j * many.heading)
        place = (many.R * np.exp(1j * azimuths) - many.wind * times - many.place) / start
        return times, azimuths, distance(place, np.angle(heading / start), times)

    n, width = int((end - begin) / spacing) + 2, (end - begin) * 2.0 / part.R[0]
    times, azimuths, gaps = sampled(begin, azimuth, width, 4 * n)
    inside = times < end - 1e-4
    lowest = [k for k in np.flatnonzero(inside)[1:-1] if gaps[k] <= min(gaps[k - 1], gaps[k + 1])]
    best = np.inf
    for k in lowest:
        begin, azimuth, step = times[k - 1], azimuths[k - 1], 2.0 * width / (4 * n)
        for _ in range(12):
            finer_times, finer, finer_gaps = sampled(begin, azimuth, step, 20)
            j = max(int(np.argmin(finer_gaps)) - 1, 0)
            begin, azimuth, step = finer_times[j], finer[j], 2.0 * step / 20
        best = min(best, float(finer_gaps.min()))
    return best


def planned(scenes, i):
    """The kernel's first arrival in the slot of one scene."""
    side, w, R = int(-scenes.way[i]), complex(scenes.wind[i]), float(scenes.R[i])
    x, y = R * cos(scenes.azimuth[i]), R * sin(scenes.azimuth[i])
    q, heading = complex(scenes.place[i]), float(scenes.heading[i])
    problem = WindProblem(q.real, q.imag, cos(heading), sin(heading), R, side, w.real, w.imag, 0.0)
    return first_in_slot(problem, phase_of(x, y, side, w.real, w.imag))


def flown_miss(scenes, i, entry):
    """How far from the slot a planned path ends, flown in complex numbers, and the slot moved by quadrature."""
    w, way = complex(scenes.wind[i]), scenes.way[i]
    q, direction, time = complex(scenes.place[i]), np.exp(1j * scenes.heading[i]), 0.0
    word = entry.word
    for t in (entry.t1, entry.t2, entry.t3):
        u, word = (word & 3) - 2, word >> 2
        if u > -2:
            turned = np.exp(1j * u * t)
            q += (t * direction if u == 0 else (turned - 1.0) / (1j * u) * direction) + w * t
            direction, time = direction * turned, time + t
    one = Scenes(*(field[i : i + 1] for field in scenes))
    azimuth, left = one.azimuth.copy(), time
    while left > 1e-13 * (1.0 + time):
        g, _ = ground_speed(azimuth, way, w)
        width = min(left, 0.2) * g / one.R
        for _ in range(20):
            took = hold_time(azimuth, width, one.way, one.R, one.wind)
            if abs(float(took[0]) - min(left, 0.2)) < 1e-15:
                break
            width *= min(left, 0.2) / took
        azimuth, left = azimuth + way * width, left - float(took[0])
    _, heading = ground_speed(azimuth, way, w)
    return float(hypot(abs(q - one.R[0] * np.exp(1j * azimuth[0])), abs(direction - heading[0])))


def time_at(scenes, azimuth):
    """The kernel's time for one scene with the slot elsewhere."""
    entry = planned(scenes._replace(azimuth=np.array([azimuth])), 0)
    return entry.t1 + entry.t2 + entry.t3


def beside_jump(scenes, width):
    """One scene with slots on either side of a jump of the time, found by halving to `width`; None for no jump."""
    azimuths = np.linspace(0.0, tau, 65)
    found = [time_at(scenes, azimuth) for azimuth in azimuths]
    longest = max(float(scenes.R[0]), 2.0) * 2.0 * tau / 64
    for i in np.flatnonzero(np.abs(np.diff(found)) > longest + 0.2):
        before, after, first, last = azimuths[i], azimuths[i + 1], found[i], found[i + 1]
        while after - before > width:
            middle = 0.5 * (before + after)
            time = time_at(scenes, middle)
            if abs(time - first) > abs(time - last):
                after, last = middle, time
            else:
                before, first = middle, time
        if abs(first - last) > 0.1:
            pair = Scenes(*(np.repeat(field, 2) for field in scenes))
            return pair._replace(azimuth=np.array([before, after]))
    return None


def fold_scenes(random, n, windy, width=1e-4):
    """Slots next to jumps of the time, n in all."""
    found = []
    while 2 * len(found) < n:
        pair = beside_jump(random_scenes(random, 1, windy), width)
        if pair is not None:
            found.append(pair)
    return Scenes(*(np.concatenate(fields) for fields in zip(*found, strict=True)))


def compare(n, windy, folds, seed):
    """Compare random slots; print the figures and return how many disagree."""
    random, wrong = np.random.default_rng(seed), 0
    late, early, misses, undecided, words = [], [], [], 0, {}
    for begin in range(0, n, 500):
        drawn = fold_scenes if folds else random_scenes
        scenes = drawn(random, min(500, n - begin), windy)
        times, gaps, azimuths = least_times(scenes)
        for i in range(len(times)):
            entry = planned(scenes, i)
            T = entry.t1 + entry.t2 + entry.t3
            words[entry.word] = words.get(entry.word, 0) + 1
            misses.append(flown_miss(scenes, i, entry))
            early.append(times[i] - T)
            if gaps[i] > REACHED:
                undecided += 1
                apart = closest_between(scenes, i, times[i], azimuths[i], T)
                print(f"undecided: {gaps[i]:.3g} away at {times[i]:.9f}, up to {T:.9f}, planned, {apart:.3g} at least")
                wrong += apart < 1e-8
            else:
                late.append(T - times[i])
            if not (misses[-1] < 1e-9 and early[-1] < 1e-9 and (gaps[i] > REACHED or late[-1] < 1e-3)):
                wrong += 1
                print(f"seed {seed} scene {begin + i}: {times[i]:.9f}, gap {gaps[i]:.3g}, planned {T:.9f}, {entry}")
                print(f"  {[field[i] for field in scenes]}")
    print(
        f"{n} slots: later than the check by {max(late):.2g} at most (median {np.median(late):.2g}), earlier by "
        f"{max(early):.2g}; {undecided} undecided; flown, {max(misses):.2g} from the slot; words {words}"
    )
    return wrong


if __name__ == "__main__":
    seed = int(sys.argv[-1]) if sys.argv[2:] and sys.argv[-1].isdigit() else 1
    sys.exit(compare(int(sys.argv[1]), "wind" in sys.argv, "folds" in sys.argv, seed) > 0)
