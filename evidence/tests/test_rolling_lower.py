"""A time that no aircraft beats whose bank changes at a limited rate: the lemmas. test_rolling.py has the bounds."""

from math import pi

import numpy as np

from evidence.checks import rolling_lower
from evidence.checks.oracle import Planar
from evidence.checks.rolling import BankProfile, Rolling
from evidence.checks.rolling_check import flown_end
from evidence.checks.rolling_lower import Reach, States, before, has_passed, passing_time

ROLL = Rolling(pi / 4, 2.5)


def random_profile(random, roll, bank, time):
    """A bank that changes at a limited rate, within its limit, for a time."""
    lengths = np.diff(np.sort(np.concatenate([[0.0, time], random.uniform(0.0, time, 7)])))
    banks = [bank]
    for length in lengths:
        way = random.choice([-1.0, 1.0, random.uniform(-1.0, 1.0)])
        banks.append(float(np.clip(banks[-1] + way * roll.rate * length, -roll.limit, roll.limit)))
    return BankProfile(tuple(banks), tuple(lengths.tolist()))


def test_every_path_that_rolls_is_in_the_set(monkeypatch):
    random = np.random.default_rng(5)
    monkeypatch.setattr(rolling_lower, "FIRST_CELLS", 40)
    for bank in (0.0, -0.4, 0.6):
        reach = Reach(1.5, -2.0, ROLL, bank, 0.5)
        cells = rolling_lower._cut(reach, rolling_lower._whole(reach))
        states = rolling_lower._states(reach, cells)
        for _ in range(60):
            end = flown_end(Planar(1.5, -2.0, 0.0), ROLL, random_profile(random, ROLL, bank, 0.5))
            assert np.any(is_in(states, *reduced(end)))
    # The set is not larger than it must be: a roll that is a tenth quicker leaves it.
    quick = flown_end(Planar(1.5, -2.0, 0.0), ROLL, BankProfile((0.6, pi / 4, pi / 4), (0.067, 0.433)))
    assert not np.any(is_in(states, *reduced(quick)))


def reduced(pose):
    c, s = np.cos(pose.angle), np.sin(pose.angle)
    return c * pose.east + s * pose.north, c * pose.north - s * pose.east


def is_in(states, x, y):
    """In which cells a state is, up to the error of Simpson's rule."""
    p, tiny = 0.5 * (x * x + y * y), 1e-9
    inside = [(low - tiny <= v) & (v <= high + tiny) for (low, high), v in zip(states, (x, y, p), strict=True)]
    return np.logical_and.reduce(inside)


def test_all_of_a_cell_is_reached_in_the_time_that_is_said():
    random, n = np.random.default_rng(6), 4000
    wide = random.uniform(0.0, 0.2, (2, n))
    x, y = random.uniform(-3.0, 3.0, n), random.uniform(-4.0, 4.0, n)
    x = np.where(random.random(n) < 0.3, random.uniform(-0.2, 0.2, n), x)
    states = States(np.stack([x, x + wide[0]]), np.stack([y, y + wide[1]]), np.zeros((2, n)))
    squares = 0.5 * (rolling_lower._square(states.x) + rolling_lower._square(states.y))
    from_x, from_y, late = before(states._replace(p=squares))
    to_x, to_y = x + wide[0] * random.random(n), y + wide[1] * random.random(n)
    # Where the centre is abeam on the way, straight on from there.
    straight = np.where((from_x < 0.0) & (to_x > 0.0), to_x, 0.0)
    assert np.all(arc_time(from_x, from_y, to_x - straight, to_y) + straight <= late + 1e-9)


def arc_time(x, y, to_x, to_y):
    """How long one arc takes from states to states; nan where none leads there."""
    fall = 0.5 * (to_x**2 + to_y**2 - x * x - y * y)
    u = (y - to_y) / fall
    at, to = np.arctan2(u * x, 1.0 + u * y), np.arctan2(u * to_x, 1.0 + u * to_y)
    time = np.where(np.abs(u) < 1e-9, to_x - x, np.mod(to - at + 1e-12, 2 * pi) / np.where(u == 0.0, 1.0, u))
    time = np.where(u < 0.0, np.mod(at - to + 1e-12, 2 * pi) / np.where(u == 0.0, 1.0, -u), time)
    return np.where(np.abs(u) <= 1.0 + 1e-9, time, np.nan)


def test_nothing_passes_the_centre_sooner_than_is_said():
    random, step = np.random.default_rng(7), 0.02
    z = random.uniform(-6.0, 6.0, (2, 1500))
    radius = random.uniform(1.001, 3.0, z.shape[1])
    least = passing_time(*z, radius)
    controls, time = random.choice([-1.0, 0.0, 1.0], (3, z.shape[1])), np.zeros(z.shape[1])
    switches = np.sort(random.uniform(0.0, 8.0, (2, z.shape[1])), axis=0) * random.integers(0, 2, z.shape[1])
    x, y = z
    for k in range(500):
        u = np.where(k * step < switches[0], controls[0], np.where(k * step < switches[1], controls[1], controls[2]))
        middle = x + 0.5 * step * (1.0 + u * y), y - 0.5 * step * u * x
        x, y = x + step * (1.0 + u * middle[1]), y - step * u * middle[0]
        time = np.where((time == 0.0) & has_passed(x, y, radius), (k + 1) * step, time)
    passed = time > 0.0
    assert passed.sum() > 300
    assert np.all(least[passed] <= time[passed] + 1e-3)
    # Some of these paths are the fastest, which the bound without one of its words would exceed.
    assert np.sum(time[passed] - least[passed] < 2.0 * step) > 30
