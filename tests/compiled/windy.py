"""Random problems in wind: anywhere, next to ties of the two directions, in valleys almost as deep, on the circle."""

from math import cos, nan, pi, sin
from random import Random

from loiter.kernel.wind.hold import hold_pose, tightest_radius
from loiter.kernel.wind.wind_search import WindProblem

PLACES = ("near", "near", "far", "mirrored", "towards the centre", "on the circle", "tightest", "calm")


def drawn(count, seed, windiest=0.6):
    """Problems for every place of `PLACES`, in equal shares."""
    random = Random(seed)
    return [_drawn(random, PLACES[i % len(PLACES)], windiest) for i in range(count)]


def _drawn(random, place, windiest):
    wind, azimuth = random.uniform(0.0, windiest), random.uniform(-pi, pi)
    if place == "towards the centre":
        wind = 10.0 ** random.uniform(-15.0, -2.0)
    wx, wy = (wind * cos(azimuth), wind * sin(azimuth)) if place != "calm" else (0.0, 0.0)
    R = tightest_radius(wx, wy) * (1.0 if place == "tightest" else random.uniform(1.0, 2.5))
    reach = 100.0 if place == "far" else 2.5 * R
    x, y, heading = random.uniform(-reach, reach), random.uniform(-reach, reach), random.uniform(-pi, pi)
    c, s, side = cos(heading), sin(heading), random.choice([1, -1, 0, 0])
    if place == "mirrored":
        # Start, heading and wind along one line through the centre: each maneuver ties with its reflection.
        x, y, c, s, wx, wy, side = x, 0.0, random.choice([-1.0, 1.0]), 0.0, random.choice([-wind, wind]), 0.0, 0
    if place == "towards the centre":
        x, y, c, s, side = -R - random.uniform(0.2, 30.0), 0.0, 1.0, 0.0, 0
    if place == "on the circle":
        one = side or 1
        x, y, c, s, _ = hold_pose(random.uniform(0.0, 2.0 * pi), one, R, wx, wy)
        x += random.choice([0.0, 1e-16, 1e-13, 1e-8, -1e-8])
    return WindProblem(x, y, c, s, R, side, wx, wy)


BAD = [
    WindProblem(nan, 0.0, 1.0, 0.0, 2.0, 1, 0.1, 0.0),
    WindProblem(0.0, 0.0, 1.0, 0.0, 0.9, 1, 0.0, 0.0),
    WindProblem(0.0, 0.0, 1.0, 0.0, 1.1, 0, 0.1, 0.0),
    WindProblem(0.0, 0.0, 1.0, 0.0, 9.0, -1, 1.0, 0.0),
    WindProblem(1e17, 0.0, 1.0, 0.0, 2.0, 0, 0.1, 0.0),
]
