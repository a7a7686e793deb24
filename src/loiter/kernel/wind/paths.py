"""The first path to a point of joining in wind, the best of the six words, and the slope of its time."""

from math import cos, inf, sin
from typing import NamedTuple

from loiter.kernel.rounding import rounding
from loiter.kernel.wind.hold import hold_pose, hold_rate, phase_of
from loiter.kernel.wind.moving_target import NO_PATH, Ends, Path, interception, lrl_rlr, lsl_rsr, lsr_rsl
from loiter.kernel.words import ALL_WORDS, controls, encode, set_of


class WindScene(NamedTuple):
    """Start, heading as a unit vector, radius, wind, and `arc_tolerance` as in `moving_target.Ends`."""

    x: float
    y: float
    c: float
    s: float
    R: float
    wx: float
    wy: float
    arc_tolerance: float


class WindCandidate(NamedTuple):
    """A path and where it joins: the phase of the point (`hold`), and the side on which the circle is held."""

    phase: float
    side: int
    path: Path


def first_path(phase: float, side: int, scene: WindScene, until: float) -> Path:
    """The first path to a point of joining, the best of the six words; `NO_PATH` where it takes longer than `until`."""
    return first_path_of(ALL_WORDS, phase, side, scene, until)


def first_path_of(words: int, phase: float, side: int, scene: WindScene, until: float) -> Path:
    """The first path to a point of joining of a set of words; `NO_PATH` where it takes longer than `until`."""
    x, y, c0, s0, R, wx, wy, arc_tolerance = scene
    px, py, c, s, _ = hold_pose(phase, side, R, wx, wy)
    dx, dy = px - x, py - y
    best = NO_PATH
    if interception(dx, dy, wx, wy) <= until + arc_tolerance:
        ends = Ends(c0, s0, c, s, wx, wy, arc_tolerance)
        # The vectors are those from the centre of the first arc to that of the last. The words that take least to find
        # are tried first.
        for u in (1, -1):
            if words & set_of(encode(u, 0, u)):
                path = lsl_rsr(u, dx - u * (s - s0), dy + u * (c - c0), ends, min(until, best.time))
                best = faster_path(best, path, until)
        for u in (1, -1):
            if words & set_of(encode(u, 0, -u)):
                path = lsr_rsl(u, dx + u * (s + s0), dy - u * (c + c0), ends, min(until, best.time))
                best = faster_path(best, path, until)
        for u in (1, -1):
            if words & set_of(encode(u, -u, u)):
                path = lrl_rlr(u, dx - u * (s - s0), dy + u * (c - c0), ends, min(until, best.time))
                best = faster_path(best, path, until)
    return best


def path_to_pose(words: int, x: float, y: float, c: float, s: float, track: float, wx: float, wy: float) -> Path:
    """The first path of a set of words to a pose at rest over the ground, passed in the direction `track`, radians.

    (x, y) is the start from the pose, and (c, s) its heading.
    """
    # The pose as a point of a circle of radius 1 on its left, passed counter-clockwise.
    nx, ny = sin(track), -cos(track)
    scene = WindScene(x + nx, y + ny, c, s, 1.0, wx, wy, rounding(x + nx, y + ny, 1.0) / 3.0)
    return first_path_of(words, phase_of(nx, ny, -1, wx, wy), -1, scene, inf)


def faster_path(a: Path, b: Path, until: float) -> Path:
    """The path that takes less time: a where they tie, or where b takes longer than `until`."""
    return b if b.time < a.time and b.time <= until else a


def join_slope(path: Path, phase: float, side: int, scene: WindScene) -> float:
    """The derivative of the time of the path with respect to the point of joining, in units of hold time, (6).

    It is zero where the adjoint is transversal to the circle, and it never exceeds 1.
    """
    _, _, c, s, _ = hold_pose(phase, side, scene.R, scene.wx, scene.wy)
    along, drift = path.p1 * c + path.p2 * s, path.p1 * scene.wx + path.p2 * scene.wy
    _, _, last = controls(path.word)
    rate = side * last * hold_rate(phase, side, scene.R, scene.wx, scene.wy)
    return (along + drift - rate * (path.lam - along)) / (path.lam + drift)


class JoinPoint(NamedTuple):
    """A point of joining: its phase, the first path to it, and the slope of the time there, `join_slope`."""

    phase: float
    path: Path
    slope: float


def join_point(words: int, phase: float, side: int, scene: WindScene) -> JoinPoint:
    """The point of joining at a phase, for a set of words."""
    path = first_path_of(words, phase, side, scene, inf)
    return JoinPoint(phase, path, join_slope(path, phase, side, scene))
