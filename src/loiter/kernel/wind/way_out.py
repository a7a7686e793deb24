"""The soonest exit from the circle at a point of it, after a hold: where to join (docs/legs.md).

Joining earlier and holding the circle up to a point of it is one way to that point, so the first path to it never takes
longer. Hence the time at the exit never falls as the aircraft joins further before it: the least hold that is allowed
gives the soonest exit, and the soonest exit after a given time is found by halving.
"""

from math import ceil, inf, sqrt
from typing import NamedTuple

from loiter.kernel.angles import TWO_PI
from loiter.kernel.entry import Entry, drop_short_pieces
from loiter.kernel.rounding import ROUNDING, rounding
from loiter.kernel.wind.fits import end_miss
from loiter.kernel.wind.held import HALVINGS, time_held, width_held
from loiter.kernel.wind.moving_target import Path
from loiter.kernel.wind.paths import WindScene, first_path
from loiter.kernel.wind.wind_search import is_on_circle, start_on_circle


class WayOut(NamedTuple):
    """Where and when to leave: the side of the hold, the phase of the exit, and what must have passed by then.

    `hold` is the least time on the circle, `width` the least angle of it, `time` the least time since the start.
    """

    side: int
    phase: float
    hold: float
    width: float
    time: float


class Exit(NamedTuple):
    """The path onto the circle, the angle of the circle that is held after it, and the time at the exit."""

    path: Path
    width: float
    time: float


def exit_point(x: float, y: float, side: int, R: float) -> tuple[float, float]:
    """The unit vector to the point at which the tangent towards (x, y), outside the circle, leaves it."""
    square = x * x + y * y
    along = sqrt(max(square - R * R, 0.0))
    return (R * x - side * along * y) / square, (R * y + side * along * x) / square


def exit_after(width: float, out: WayOut, scene: WindScene) -> Exit:
    """The exit after an angle of the circle, with the first path to the point where the hold begins."""
    path = first_path(out.phase - width, out.side, scene, inf)
    return Exit(path, width, path.time + time_held(out.phase, width, scene.R, scene.wx, scene.wy))


def least_width(out: WayOut, scene: WindScene) -> float:
    """The least angle of the circle that is held."""
    return max(out.width, width_held(out.phase, out.hold, scene.R, scene.wx, scene.wy))


def soonest_exit(out: WayOut, scene: WindScene) -> Exit:
    """The exit with the least time at it, among those that join by a first path (docs/legs.md, section 3)."""
    least = least_width(out, scene)
    best = exit_after(least, out, scene)
    if best.time < out.time:
        best = exit_at_time(least, out, scene)
    if is_on_circle(out.side, scene):
        held = exit_of_hold(least, out, scene)
        best = held if held.time < best.time else best
    return best


def exit_at_time(least: float, out: WayOut, scene: WindScene) -> Exit:
    """The soonest exit that is no sooner than `out.time`, by halving the angle that is held, from `least` on."""
    most = max(least, width_held(out.phase, out.time, scene.R, scene.wx, scene.wy))
    best = exit_after(most, out, scene)
    for _ in range(HALVINGS):
        middle = exit_after(0.5 * (least + most), out, scene)
        if middle.time < out.time:
            least = middle.width
        else:
            most, best = middle.width, middle
    return best


def exit_of_hold(least: float, out: WayOut, scene: WindScene) -> Exit:
    """The exit of an aircraft that holds the circle from the start on, at its first passage that is late enough."""
    start = start_on_circle(out.side, scene)
    # A passage that is too early by rounding only counts.
    width = (out.phase - start.phase) % TWO_PI
    enough = max(least, width_held(out.phase, out.time, scene.R, scene.wx, scene.wy)) * (1.0 - ROUNDING) - ROUNDING
    width += TWO_PI * max(ceil((enough - width) / TWO_PI), 0)
    return Exit(start.path, width, time_held(out.phase, width, scene.R, scene.wx, scene.wy))


def entry_before(found: Exit, out: WayOut, scene: WindScene) -> tuple[Entry, float]:
    """The path of an exit as the maneuver flown, and its miss: how far from the circle it ends when flown exactly."""
    word, t1, t2, t3 = drop_short_pieces(
        found.path.word, found.path.t1, found.path.t2, found.path.t3, rounding(scene.x, scene.y, scene.R), ROUNDING
    )
    entry = Entry(out.side, word, t1, t2, t3)
    return entry, end_miss(entry, out.phase - found.width, scene)
