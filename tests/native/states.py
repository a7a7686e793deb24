"""States in still air: anywhere, next to the boundaries of the synthesis, and where numbers of doubles are special."""

from itertools import product
from math import cos, inf, nan, nextafter, pi, sin
from random import Random

RADII = (1.0, 1.0, 1.0 + 1e-6, 1.2, 1.5, 2.0, 2.5, 3.0, 5.0, 30.0)

# The least distance of states from boundaries, and the largest, as powers of ten.
NEAREST, FARTHEST = -12.0, -5.0


def drawn(count, seed, nearest=NEAREST, farthest=FARTHEST):
    """States (x, y, R, side, tolerance), two thirds of them next to a circle or to the axis of the synthesis."""
    random = Random(seed)
    rows = []
    for _ in range(count):
        R, angle = random.choice(RADII), random.uniform(-pi, pi)
        off = 10.0 ** random.uniform(nearest, farthest) * random.choice([-1.0, 0.0, 1.0])
        circles = {"outer": (R + 1.0, -1.0), "inner": (R - 1.0, 1.0), "fold": (abs(R - 3.0), -1.0)}
        place = random.choice([*circles, "axis", "anywhere", "anywhere"])
        if place in circles:
            radius, centre = circles[place]
            x, y = (radius + off) * cos(angle), centre + (radius + off) * sin(angle)
        elif place == "axis":
            x, y = random.uniform(-3.0 * R, 3.0 * R), off
        else:
            x, y = random.uniform(-3.0 * R, 3.0 * R), random.uniform(-3.0 * R, 3.0 * R)
        rows.append((x, y, R, random.choice([1, -1, 0]), random.choice([0.0, 10.0 ** random.uniform(-14.0, -3.0)])))
    return rows


LARGE = 2.0**52
NUMBERS = [0.0, -0.0, 5e-324, -5e-324, 2.2e-308, -1e-160, 1e-9, 1.0, -1.0, 3.0, 4.0, -7.5]
NUMBERS += [LARGE, -LARGE, nextafter(LARGE, inf), 1e300, -inf, nan]
CIRCLES = [near for R in (1.0, 2.0, 3.0) for near in (nextafter(R, 0.0), R, nextafter(R, inf))]
CIRCLES += [0.5, 1.0 - 1e-14, 1.0 - 1e-13, 1e9, LARGE, 1e17, inf, nan, -1.0, 0.0]
TOLERANCES = [0.0, 1e-3, LARGE, -1.0, nan]

SPECIAL = [
    (x, y, R, side, tolerance)
    for x, y, R, side, tolerance in product(NUMBERS, NUMBERS, CIRCLES, (1, -1, 0), TOLERANCES)
    if tolerance in (0.0, 1e-3) or R == 2.0
]
