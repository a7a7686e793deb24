"""A plan view, in metres, of one or more maneuvers onto a circle."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from loiter.fences import Breach, Fence
from loiter.geo import LocalFrame
from loiter.geo.frame import degrees_of
from loiter.planning.flight import along
from loiter.planning.maneuver import Maneuver
from loiter.planning.model import Segment, Turn
from loiter.plot.fences import FENCE_STYLES, draw_fence
from loiter.plot.marks import (
    CHORD_RAD,
    Box,
    Points,
    corners,
    draw_aircraft,
    draw_arrow,
    draw_circle,
    draw_north,
    draw_orbit,
    draw_turns,
    draw_wind,
    drawn_gids,
    enlarge,
    mark,
    prepare_plan,
)
from loiter.plot.sizes import OUTSIDE_IF_NARROW

# Okabe and Ito's palette, which people with all common forms of colour blindness can distinguish.
COLOURS = {"L": "#009E73", "S": "#0072B2", "R": "#D55E00"}
MEANINGS = {"L": "left turn", "S": "straight", "R": "right turn"}
FAINT = "#b0b0b0"

# The slower maneuvers are bands below the path, the slower the wider and the paler, so that each can be followed from
# the start, also where it shares its first turn with others. Hues show the turns.
SLOWER: tuple[dict[str, Any], ...] = (
    {"color": "#b2b2b2", "linewidth": 4.4, "zorder": 1.2, "solid_capstyle": "butt"},
    {"color": "#dcdcdc", "linewidth": 7.6, "zorder": 1.1, "solid_capstyle": "butt"},
)
AT_THE_START: dict[str, Any] = {"color": FAINT, "linewidth": 1.2, "linestyle": "--"}

MARKS: dict[str, dict[str, Any]] = {
    "switch": {"marker": "o", "markersize": 6, "markerfacecolor": "white"},
    "join": {"marker": "o", "markersize": 9, "markerfacecolor": "black"},
}

# Turns with a radius below this share of the picture are specks: a second panel enlarges the last of them.
SPECK = 1.0 / 30.0

# Segments shorter than three of the marks at their ends, in sizes of an arrow, have no arrow: it would lie below the
# marks.
LEAST_TRACK = 1.5

# Beside a second panel, a scene that is wider than so many times its height leaves most of its panel empty: its picture
# is lower, by default so many inches.
FLAT, FLAT_HEIGHT = 2.0, 4.2

# The resolution of times in a picture, relative.
RESOLUTION = 1e-6

# The second panel shows the whole circle if its radius is at most this many turn radii, and the whole path if that is
# at most this many turn radii long.
WHOLE_CIRCLE, WHOLE_PATH = 4.0, 12.0


def draw(
    best: Sequence[Maneuver],
    others: Sequence[Maneuver] = (),
    *,
    frame: LocalFrame | None = None,
    fence: Fence | None = None,
    breaches: Sequence[Breach] = (),
) -> Figure:
    """Draw maneuvers from one start: `best` coloured by segment, over the soonest of `others` in each direction.

    Those of `best` that are slower than the fastest of them count as `others`.

    East is to the right, north up, axes equal, in metres, with a scale bar; with a frame the axes are labelled with its
    origin on Earth. Start, switches and join are marked. If the turns are specks, a second panel enlarges the last one,
    with the circle. The first of `best` gives the title. In wind, tracks are ground tracks, and an arrow beside the
    title shows the direction in which the air moves. A moving circle is drawn where it is when it is joined, and faint
    where it is at the start; each of `others` ends on the circle at its own time of joining. The zones of a fence to
    stay out of are hatched, those to stay in are dashed, and crosses mark where `breaches` of it begin.
    """
    fastest = min(best, key=lambda maneuver: maneuver.duration_s)
    slower = soonest_each_way([*others, *(maneuver for maneuver in best if _is_later(maneuver, fastest))])
    best = [maneuver for maneuver in best if not _is_later(maneuver, fastest)]
    first, *_ = best
    whole = _whole(best, slower)
    enlarged = _enlarged(best, whole)
    flat = enlarged is not None and whole.east - whole.west > FLAT * (whole.north - whole.south)
    figure = Figure(figsize=(8.0, FLAT_HEIGHT if flat else 6.4), layout="constrained")
    if enlarged is None:
        axes = figure.add_subplot()
        axes.set_title(_title(best))
    else:
        axes, detail = figure.subplots(1, 2)
        figure.suptitle(_title(best), fontsize="large")
        _draw_panel(detail, best, slower)
        draw_fence(detail, fence, breaches, whole)
        enlarge(detail, enlarged, axes, f"{_enlarged_part(best, enlarged)}, enlarged")
    _draw_panel(axes, best, slower, elsewhere=enlarged)
    draw_fence(axes, fence, breaches, whole)
    if frame is not None:
        axes.set_xlabel(f"east of {degrees_of(frame.latitude_deg, frame.longitude_deg)} (m)")
    if first.wind.speed_m_s > 0.0:
        draw_wind(axes, first.wind)
    draw_north(axes)
    handles = _legend(figure, best, slower)
    legend = axes.legend(handles=handles, loc="best", fontsize="small", handlelength=2.6, framealpha=0.9)
    legend.set_gid(OUTSIDE_IF_NARROW)
    return figure


def soonest_each_way(others: Sequence[Maneuver]) -> list[Maneuver]:
    """The soonest maneuver in each direction of holding, the sooner first; none for those without segments."""
    found: dict[Turn, Maneuver] = {}
    for maneuver in sorted(others, key=lambda other: other.duration_s):
        if maneuver.segments:
            found.setdefault(maneuver.turn, maneuver)
    return list(found.values())


def _whole(best: Sequence[Maneuver], slower: Sequence[Maneuver]) -> Box:
    """The box around all that is drawn."""
    first, *_ = best
    circles = [corners(first.orbit), corners(first.orbit_at_join)]
    return Box.around([*circles, *(_track(maneuver) for maneuver in (*best, *slower))])


def _enlarged(best: Sequence[Maneuver], whole: Box) -> Box | None:
    """The part of a plan that a second panel enlarges; None where the turns are no specks."""
    first, *_ = best
    orbit, radius = first.orbit_at_join, first.aircraft.turn_radius_m
    if not first.segments or radius >= SPECK * whole.size:
        return None
    shown = Box.around(_track(maneuver) for maneuver in best)
    if shown.size > WHOLE_PATH * radius:
        shown = Box.around(_last_turn(maneuver) for maneuver in best)
    if orbit.radius_m <= WHOLE_CIRCLE * radius:
        shown = Box.around([shown.corners, corners(orbit)])
    return shown.widened(max(radius, 0.1 * shown.size))


def _enlarged_part(best: Sequence[Maneuver], enlarged: Box) -> str:
    """What of the path a second panel shows, in words."""
    first, *_ = best
    if all(enlarged.contains(segment.start) for segment in first.segments):
        return "the path"
    return "the point of joining" if first.segments[-1].letter == "S" else "the last turn"


def _draw_panel(axes: Axes, best: Sequence[Maneuver], slower: Sequence[Maneuver], elsewhere: Box | None = None) -> None:
    """Draw the plan on the axes of a panel, without the marks that another panel enlarges."""
    first, *_ = best
    prepare_plan(axes)
    for maneuver, style in zip(slower, SLOWER, strict=False):
        axes.plot(*_track(maneuver), **style, gid=f"slower {maneuver.turn}")
    if first.orbit.moves:
        _draw_movement(axes, first)
    draw_orbit(axes, first.orbit_at_join)
    if elsewhere is None:
        draw_turns(axes, first.orbit_at_join, {maneuver.turn for maneuver in best})
    for maneuver in best:
        draw_path(axes, maneuver, elsewhere)
    draw_aircraft(axes, first.start)


def draw_path(axes: Axes, maneuver: Maneuver, elsewhere: Box | None = None) -> None:
    """Draw the segments of a maneuver, and its marks where no other panel enlarges them."""
    for segment in maneuver.segments:
        east, north = _segment_track(segment, maneuver)
        axes.plot(east, north, color=COLOURS[segment.letter], linewidth=2.6, zorder=3, gid=f"segment {segment.letter}")
        gid = f"arrow {segment.letter}"
        draw_arrow(axes, east, north, len(east) // 2, COLOURS[segment.letter], gid=gid, least=LEAST_TRACK)
    switches = [("switch", segment.start) for segment in maneuver.segments[1:]]
    for name, pose in [*switches, ("join", maneuver.join)]:
        if elsewhere is None or not elsewhere.contains(pose):
            mark(axes, pose, gid=name, **MARKS[name])


def _draw_movement(axes: Axes, maneuver: Maneuver) -> None:
    """Draw the circle at the start, and the path of its centre until it is joined."""
    before, after = maneuver.orbit, maneuver.orbit_at_join
    draw_circle(axes, before, zorder=1, gid="circle at the start", **AT_THE_START)
    east, north = np.linspace((before.east_m, before.north_m), (after.east_m, after.north_m), 3).T
    axes.plot(east, north, color=FAINT, linewidth=1.0, linestyle=":", gid="way of the centre")
    draw_arrow(axes, east, north, 1, FAINT)


def _title(best: Sequence[Maneuver]) -> str:
    first, *_ = best
    words = " or ".join(f"{m.word} {m.turn.described}".strip() for m in best)
    if not first.segments:
        return f"on the circle already, {words}"
    air = " through the air" if first.wind.speed_m_s > 0.0 or first.orbit.moves else ""
    return f"{words}\njoins in {_digits(first.duration_s, 4)} s, {_digits(first.length_m, 4)} m{air}"


def _digits(value: float, digits: int) -> str:
    """A number with some digits, and all of those before the point."""
    return f"{value:.{digits}g}" if abs(value) < 10.0**digits - 0.5 else f"{value:.0f}"


def _segment_track(segment: Segment, maneuver: Maneuver) -> Points:
    turned = abs(segment.curvature_per_m) * segment.length_m
    steps = 3 + math.ceil(turned / CHORD_RAD)  # a straight segment needs a point in the middle, for its arrow
    east, north, _ = along(segment, np.linspace(0.0, segment.length_m, steps), maneuver.aircraft, maneuver.wind)
    return east, north


def _track(maneuver: Maneuver) -> Points:
    """The track from the start to the join: the start alone for a maneuver without segments."""
    start = (np.array([maneuver.start.east_m]), np.array([maneuver.start.north_m]))
    east, north = zip(start, *(_segment_track(segment, maneuver) for segment in maneuver.segments), strict=True)
    return np.concatenate(east), np.concatenate(north)


def _last_turn(maneuver: Maneuver) -> Points:
    """The track of the last segment, of which the end alone if it is straight."""
    *_, last = maneuver.segments
    east, north = _segment_track(last, maneuver)
    return (east[-1:], north[-1:]) if last.letter == "S" else (east, north)


def _legend(figure: Figure, best: Sequence[Maneuver], slower: Sequence[Maneuver]) -> list[Line2D]:
    """An entry for each kind of line and mark that is drawn."""
    letters = dict.fromkeys(segment.letter for maneuver in best for segment in maneuver.segments)
    bands = {
        f"slower {other.turn}": style | {"label": f"{other.word} {other.turn.value}: {_later(other, best)}"}
        for other, style in zip(slower, SLOWER, strict=False)
    }
    styles: dict[str, dict[str, Any]] = {
        **{f"segment {u}": {"color": COLOURS[u], "linewidth": 2.6, "label": MEANINGS[u]} for u in letters},
        "circle": {"color": "black", "linewidth": 1.4, "label": "holding circle"},
        "circle at the start": {"label": "circle at the start", **AT_THE_START},
        **{name: {"color": "black", "linestyle": "none", "label": name, **style} for name, style in MARKS.items()},
        **{name: {"label": name, **style} for name, style in FENCE_STYLES.items()},
        **bands,
    }
    drawn = drawn_gids(figure)
    return [Line2D([], [], **style) for gid, style in styles.items() if gid in drawn]


def _later(maneuver: Maneuver, best: Sequence[Maneuver]) -> str:
    first, *_ = best
    later = maneuver.duration_s - first.duration_s
    return f"{_digits(later, 3)} s later" if _is_later(maneuver, first) else "as fast"


def _is_later(maneuver: Maneuver, other: Maneuver) -> bool:
    """Whether a maneuver takes visibly longer than another; the table and JSON show smaller differences."""
    return maneuver.duration_s - other.duration_s > RESOLUTION * maneuver.duration_s
