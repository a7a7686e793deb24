"""Prescribed times of arrival, in and out of the gap, beside a method that shares no code.

`python -m planning.prescribed_times 1000` draws times at which the kernel finds no path
between two poses though both a shorter and a longer one exist, in still air and in wind, and looks for one by steps of
Gauss and Newton: 16 intervals of constant turn rate, from random beginnings, for every number of whole turns that fits.
None may end closer than `MISSED` to the pose. To show that it would find a path, it gets times beyond either end of the
gap too, by a tenth of its width. As many paths at possible times are flown in complex numbers. A last number is the
seed.
"""

import sys
from math import cos, inf, isfinite, pi, sin, tau

import numpy as np

from loiter.kernel.wind.elongation import Arrival, Ends, is_in_time, last_time, next_time, path_of_length

INTERVALS, BEGINNINGS, STEPS = 16, 24, 80
MISSED = 1e-6


def random_arrival(random):
    """A pose ahead of the start, near enough for a gap at times, that moves with the air in half of the scenes."""
    heading, towards = random.uniform(0.0, tau, 2)
    ahead, beside = random.uniform(-0.5, 3.5), random.normal(0.0, 0.8)
    end = heading + random.normal(0.0, 0.7)
    c, s = cos(heading), sin(heading)
    w = random.choice([0.0, 0.6]) * random.random()
    ends = Ends(c, s, ahead * c - beside * s, ahead * s + beside * c, cos(end), sin(end))
    return Arrival(ends, w * cos(towards), w * sin(towards))


def gap_of(arrival):
    """A span of impossible times between possible ones; None where there is none."""
    for time in np.arange(0.05, 12.0, 0.1):
        if not is_in_time(arrival, time) and isfinite(before := last_time(arrival, time)):
            return before, next_time(arrival, time)
    return None


def complex_ends(arrival, time):
    """Place and heading of the pose at a time, from the start, whose heading is 1."""
    ends = arrival.at(time)
    start = complex(ends.c0, ends.s0)
    return complex(ends.x, ends.y) / start, complex(ends.c, ends.s) / start


def flown(curvatures, times):
    """Place and heading after arcs of given curvatures, from the place 0 and the heading 1."""
    turned = np.concatenate([[0.0], np.cumsum(curvatures * times)])
    half = 0.5 * curvatures * times
    return np.sum(times * np.sinc(half / pi) * np.exp(1j * (turned[:-1] + half))), turned[-1]


def flown_miss(path, arrival, time):
    """How far a path of the kernel ends from the pose: place, heading and time."""
    place, heading = complex_ends(arrival, time)
    curvatures = np.array([path.first, path.curvature, path.last])
    assert np.all(np.abs(curvatures) <= 1.0 + 1e-12), path
    end, turned = flown(curvatures, np.array([path.t1, path.t2, path.t3]))
    return max(abs(end - place), abs(np.exp(1j * turned) - heading), abs(path.length - time))


def closest(arrival, time, random):
    """The least distance from the pose at which steps of Gauss and Newton end, place and heading.

    All beginnings at once, for every number of whole turns that fits; controls at a bound stay there while a step
    would leave it.
    """
    place, heading = complex_ends(arrival, time)
    turns = np.angle(heading) + tau * np.arange(-3, 4)
    turns = np.repeat(turns[np.abs(turns) <= time], BEGINNINGS)
    if turns.size == 0:
        return inf
    h, begin = time / INTERVALS, random.uniform(-1.0, 1.0, (turns.size, INTERVALS))
    controls, best = np.clip(begin + (turns / time)[:, None], -1.0, 1.0), inf
    for step in range(STEPS):
        before = h * (np.cumsum(controls, axis=1) - controls)
        half = 0.5 * h * controls
        chords = h * np.sinc(half / pi) * np.exp(1j * (before + half))
        end, turned = chords.sum(axis=1), h * controls.sum(axis=1)
        off = np.stack([(place - end).real, (place - end).imag, turns - turned], axis=1)
        sizes = np.max(np.abs(off), axis=1)
        best = min(best, float(sizes.min()))
        if best < MISSED or step == STEPS - 1:
            return best
        # A control turns all later chords, and its own by half.
        later = 1j * h * (end[:, None] - np.cumsum(chords, axis=1) + 0.5 * chords)
        slopes = np.stack([later.real, later.imag, np.full(later.shape, h)], axis=1)
        free = np.ones_like(controls)
        for _ in range(3):
            part = slopes * free[:, None, :]
            system = part @ part.transpose(0, 2, 1) + (1e-9 + 1e-3 * sizes**2)[:, None, None] * np.eye(3)
            move = (part.transpose(0, 2, 1) @ np.linalg.solve(system, off[:, :, None]))[:, :, 0]
            free *= ~((controls + move > 1.0) & (controls >= 1.0) | (controls + move < -1.0) & (controls <= -1.0))
        controls = np.clip(controls + np.clip(move, -0.5, 0.5), -1.0, 1.0)
    return best


def compare(n, seed, say=print):
    """Compare n times in gaps, and n possible ones; return how many disagree."""
    random, wrong, gaps, missed, beyond, misses = np.random.default_rng(seed), 0, 0, [], [], []
    while gaps < n:
        arrival = random_arrival(random)
        gap = gap_of(arrival)
        time = random.uniform(0.0, 40.0) if gap is None else gap[1] + random.exponential(0.5)
        path = path_of_length(arrival.at(time), time, 0.0)
        if path is not None and len(misses) < n:
            misses.append(flown_miss(path, arrival, time))
            wrong += misses[-1] > 1e-9
        if gap is None:
            continue
        before, after = gap
        for end in gap:
            path = path_of_length(arrival.at(end), end, 1e-11)
            wrong += path is None or flown_miss(path, arrival, end) > 1e-9
        gaps += 1
        time = before + (after - before) * random.uniform(0.01, 0.99)
        missed.append(closest(arrival, time, random))
        if missed[-1] < MISSED or path_of_length(arrival.at(time), time, 0.0) is not None:
            wrong += 1
            say(f"seed {seed}: {arrival}, {time} in {gap}: the search ends {missed[-1]:.2g} away")
        width = 0.1 * (after - before)
        beyond += [closest(arrival, end, random) for end in (before - width, after + width) if is_in_time(arrival, end)]
        if gaps % 100 == 0:
            say(f"{gaps} gaps, {wrong} wrong", flush=True)
    found = float(np.mean(np.array(beyond) < MISSED))
    say(
        f"{gaps} times in gaps: the search ends {min(missed):.2g} away at least; a tenth beyond the gap it finds a "
        f"path in {found:.0%} of {len(beyond)}; {len(misses)} possible ones: {max(misses):.2g} off when flown"
    )
    return wrong


if __name__ == "__main__":
    seed = int(sys.argv[2]) if sys.argv[2:] else 1
    sys.exit(bool(compare(int(sys.argv[1]), seed) > 0))
