"""The formulas of docs/theory.md in their plain form, with branches and library functions: the baseline of the kernel.

They use differences of arctangents, wrapped, and square roots of plain differences, and share no code with the kernel's
loops. There are two versions: scalar functions compiled by Numba, and functions of whole NumPy arrays.
"""

from math import acos, atan2, inf, pi, sqrt

import numba
import numpy as np

SQRT3 = sqrt(3.0)
njit = numba.njit(error_model="numpy")


@njit
def wrap(angle):
    """The equivalent in [0, 2 pi) of an angle in [-2 pi, 4 pi)."""
    if angle < 0.0:
        return angle + 2.0 * pi
    if angle >= 2.0 * pi:
        return angle - 2.0 * pi
    return angle


@njit
def clockwise(x, y, x1, y1, centre):
    """The clockwise rotation about (0, centre) from (x, y) to (x1, y1)."""
    return wrap(wrap(atan2(y - centre, x)) - wrap(atan2(y1 - centre, x1)))


@njit
def counter_clockwise(x, y, x1, y1, centre):
    """The counter-clockwise rotation about (0, centre) from (x, y) to (x1, y1)."""
    return wrap(wrap(atan2(y1 - centre, x1)) - wrap(atan2(y - centre, x)))


@njit
def lrl(x, y, R):
    """Duration of LRL."""
    k, K = x * x + (y + 1.0) * (y + 1.0) - 1.0, R * (R + 2.0)
    d, h = (K - k) / 4.0, (K + k) / 2.0
    if h * h < 3.0 * d * d:
        return inf
    s = (h + sqrt(h * h - 3.0 * d * d)) / 3.0
    if s > 2.0:
        return inf
    ya, yb = (s - d) / 2.0, (s + d) / 2.0
    xa, xb = sqrt(max(k + 1.0 - (ya + 1.0) ** 2, 0.0)), -sqrt(max((R + 1.0) ** 2 - (yb + 1.0) ** 2, 0.0))
    if ya < 0.0:
        xa = -xa
    return clockwise(x, y, xa, ya, -1.0) + counter_clockwise(xa, ya, xb, yb, 1.0) + clockwise(xb, yb, 0.0, R, -1.0)


@njit
def rl(x, y, R, branch):
    """Duration of RL; `branch` is the sign of x at the switch."""
    rm2 = x * x + (y - 1.0) * (y - 1.0)
    y1 = ((R + 1.0) ** 2 - rm2) / 4.0
    square = (R + 1.0) ** 2 - (y1 + 1.0) ** 2
    if square < 0.0:
        return inf
    x1 = branch * sqrt(square)
    return counter_clockwise(x, y, x1, y1, 1.0) + clockwise(x1, y1, 0.0, R, -1.0)


@njit
def lr(x, y, R, branch):
    """Duration of LR; `branch` is the sign of x at the switch."""
    rp2 = x * x + (y + 1.0) * (y + 1.0)
    y1 = (rp2 - (R - 1.0) ** 2) / 4.0
    square = (R - 1.0) ** 2 - (y1 - 1.0) ** 2
    if square < 0.0:
        return inf
    x1 = branch * sqrt(square)
    return clockwise(x, y, x1, y1, -1.0) + counter_clockwise(x1, y1, 0.0, R, 1.0)


@njit
def with_straight(x, y, R):
    """The least duration of LSL, RSL, LSR and RSR."""
    rp2, rm2 = x * x + (y + 1.0) * (y + 1.0), x * x + (y - 1.0) * (y - 1.0)
    best, X = inf, sqrt(R * (R + 2.0))
    last = acos(1.0 / (1.0 + R))
    if rp2 - 1.0 >= X * X:
        c = sqrt(rp2 - 1.0)
        best = clockwise(x, y, -c, 0.0, -1.0) + c - X + last
    if rm2 - 1.0 >= X * X:
        c = sqrt(rm2 - 1.0)
        best = min(best, counter_clockwise(x, y, -c, 0.0, 1.0) + c - X + last)
    if R >= 2.0:
        X = sqrt(R * (R - 2.0))
        last = pi - acos(1.0 / (R - 1.0))
        if 0.0 <= rp2 - 1.0 <= X * X:
            c = sqrt(rp2 - 1.0)
            best = min(best, clockwise(x, y, c, 0.0, -1.0) + X - c + last)
        if 0.0 <= rm2 - 1.0 <= X * X:
            c = sqrt(rm2 - 1.0)
            best = min(best, counter_clockwise(x, y, c, 0.0, 1.0) + X - c + last)
    return best


@numba.vectorize("float64(float64, float64, float64, int8)")
def any_circle(x, y, R, side):
    """T for any radius and turn: the least duration of all words."""
    y = abs(y) if side == 0 else side * y
    best = min(with_straight(x, y, R), lrl(x, y, R))
    best = min(best, min(rl(x, y, R, -1.0), rl(x, y, R, 1.0)))
    if R > 1.0:
        best = min(best, min(lr(x, y, R, -1.0), lr(x, y, R, 1.0)))
    return best


@numba.vectorize("float64(float64, float64)")
def tight(x, y):
    """T for R = 1, either turn, by the regions of the paper, section 6, corrected (evidence/docs/paper.md)."""
    y = abs(y)
    rm2 = x * x + (y - 1.0) * (y - 1.0)
    if rm2 >= 4.0:
        c = sqrt(rm2 - 1.0)
        return counter_clockwise(x, y, -c, 0.0, 1.0) + c - SQRT3 + pi / 3.0
    if y < 1.0 and x * x + (y + 1.0) * (y + 1.0) <= 4.0:
        square = -y * y + 3.0 * y + 1.5 - sqrt(y * y + 9.0 * y + 2.25)
        if x < sqrt(max(square, 0.0)):
            return lrl(x, y, 1.0)
    return rl(x, y, 1.0, -1.0)


def tight_arrays(x, y):
    """T for R = 1, either turn, on whole NumPy arrays: the durations of all words, then a choice by region."""
    y = np.abs(y)
    rm2, rp2 = x * x + (y - 1.0) ** 2, x * x + (y + 1.0) ** 2
    with np.errstate(invalid="ignore"):
        c = np.sqrt(rm2 - 1.0)
        rsl_time = _counter_clockwise(x, y, -c, 0.0, 1.0) + c - SQRT3 + pi / 3.0
        y1 = (4.0 - rm2) / 4.0
        x1 = -np.sqrt(4.0 - (y1 + 1.0) ** 2)
        rl_time = _counter_clockwise(x, y, x1, y1, 1.0) + _clockwise(x1, y1, 0.0, 1.0, -1.0)
        k = rp2 - 1.0
        d, h = (3.0 - k) / 4.0, (3.0 + k) / 2.0
        s = (h + np.sqrt(h * h - 3.0 * d * d)) / 3.0
        ya, yb = (s - d) / 2.0, (s + d) / 2.0
        xa = np.copysign(np.sqrt(np.maximum(rp2 - (ya + 1.0) ** 2, 0.0)), ya)
        xb = -np.sqrt(np.maximum(4.0 - (yb + 1.0) ** 2, 0.0))
        lrl_time = (
            _clockwise(x, y, xa, ya, -1.0)
            + _counter_clockwise(xa, ya, xb, yb, 1.0)
            + _clockwise(xb, yb, 0.0, 1.0, -1.0)
        )
        square = -y * y + 3.0 * y + 1.5 - np.sqrt(y * y + 9.0 * y + 2.25)
        inside = (y < 1.0) & (rp2 <= 4.0) & (x < np.sqrt(np.maximum(square, 0.0)))
    return np.where(rm2 >= 4.0, rsl_time, np.where(inside, lrl_time, rl_time))


def _clockwise(x, y, x1, y1, centre):
    return (np.arctan2(y - centre, x) - np.arctan2(y1 - centre, x1)) % (2.0 * pi)


def _counter_clockwise(x, y, x1, y1, centre):
    return (np.arctan2(y1 - centre, x1) - np.arctan2(y - centre, x)) % (2.0 * pi)
