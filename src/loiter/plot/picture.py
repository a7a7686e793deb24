"""A plan view, in metres, of one or more maneuvers onto a circle."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Circle
from matplotlib.text import OffsetFrom
from mpl_toolkits.axes_grid1.anchored_artists import AnchoredSizeBar
from numpy.typing import NDArray

from loiter.geo import LocalFrame
from loiter.geo.frame import degrees_of
from loiter.planning.compass import heading_vector, wrapped
from loiter.planning.flight import along
from loiter.planning.maneuver import Maneuver
from loiter.planning.model import Orbit, Pose, Segment, Turn, Wind

# Okabe and Ito's palette, which people with all common forms of colour blindness can distinguish.
COLOURS = {"L": "#009E73", "S": "#0072B2", "R": "#D55E00"}
MEANINGS = {"L": "left turn", "S": "straight", "R": "right turn"}
FAINT = "#b0b0b0"

# The slower maneuvers in the legend differ in dashes and shade, not in hue: hues show the turns. The rest are faint.
SLOWER: tuple[dict[str, Any], ...] = (
    {"color": "#606060", "linestyle": "-"},
    {"color": "#505050", "linestyle": (0, (6, 2))},
    {"color": "#404040", "linestyle": (0, (1, 1.5))},
)
STILL_SLOWER: dict[str, Any] = {"color": FAINT, "linestyle": "-"}
AT_THE_START: dict[str, Any] = {"color": FAINT, "linewidth": 1.2, "linestyle": "--"}

ARROW: dict[str, Any] = {"arrowstyle": "-|>", "shrinkA": 0.0, "shrinkB": 0.0}

# The wind's arrow, in points: its middle from the upper left corner of the axes, and its length.
WIND_COLOUR = "#505050"
WIND_PLACE, WIND_LENGTH = np.array([14.0, 14.0]), 22.0
MARKS: dict[str, dict[str, Any]] = {
    "switch": {"marker": "o", "markersize": 6, "markerfacecolor": "white"},
    "join": {"marker": "o", "markersize": 9, "markerfacecolor": "black"},
}

# Chords of 2 degrees differ from an arc by 0.015 % of its radius, less than the width of a line.
CHORD_RAD = math.radians(2.0)


def draw(best: Sequence[Maneuver], others: Sequence[Maneuver] = (), *, frame: LocalFrame | None = None) -> Figure:
    """Draw maneuvers from one start: `best` coloured by segment, `others` thin and grey; start, switches, join marked.

    East is to the right, north up, axes equal, in metres, with a scale bar; with a frame the axes are labelled with its
    origin on Earth. The first of `best` gives the title. In wind, tracks are ground tracks, and an arrow beside the
    title shows the direction in which the air moves. A moving circle is drawn where it is when it is joined, and faint
    where it is at the start; each of `others` ends on the circle at its own time of joining.
    """
    first, *_ = best
    figure = Figure(figsize=(8.0, 6.4), layout="constrained")
    axes = figure.add_subplot()
    axes.set_aspect("equal", adjustable="datalim")
    # Coordinates of a national grid are shown in full, not as an offset and a difference.
    axes.ticklabel_format(useOffset=False, style="plain")
    axes.grid(color="#e6e6e6", linewidth=0.8)
    axes.set_axisbelow(True)
    for i, maneuver in enumerate(others):
        if maneuver.segments:
            axes.plot(*_track(maneuver), **_slower_style(i), linewidth=1.0, alpha=0.8, zorder=1, gid="candidate")
    if first.orbit.moves:
        _draw_movement(axes, first)
    _draw_circle(axes, first.orbit_at_join, {maneuver.turn for maneuver in best})
    for maneuver in best:
        _draw_path(axes, maneuver)
    _draw_aircraft(axes, first.start)
    origin = "" if frame is None else f" of {degrees_of(frame.latitude_deg, frame.longitude_deg)}"
    axes.set_xlabel(f"east{origin} (m)")
    axes.set_ylabel("north (m)")
    axes.set_title(_title(best))
    if first.wind.speed_m_s > 0.0:
        _draw_wind(axes, first.wind)
    axes.margins(0.08)
    _draw_north(axes)
    _draw_scale(axes)
    axes.legend(handles=_legend(best, others), loc="best", fontsize="small", handlelength=2.6, framealpha=0.9)
    return figure


def _slower_style(i: int) -> dict[str, Any]:
    """The colour and dashes of the slower maneuver with index i."""
    return SLOWER[i] if i < len(SLOWER) else STILL_SLOWER


def _title(best: Sequence[Maneuver]) -> str:
    first, *_ = best
    words = " or ".join(f"{m.word} {m.turn.described}".strip() for m in best)
    if not first.segments:
        return f"on the circle already, {words}"
    air = " through the air" if first.wind.speed_m_s > 0.0 or first.orbit.moves else ""
    return f"{words}\njoins in {first.duration_s:.4g} s, {first.length_m:.4g} m{air}"


def _draw_path(axes: Axes, maneuver: Maneuver) -> None:
    for segment in maneuver.segments:
        east, north = _segment_track(segment, maneuver)
        axes.plot(east, north, color=COLOURS[segment.letter], linewidth=2.6, zorder=3, gid=f"segment {segment.letter}")
        _arrow(axes, east, north, COLOURS[segment.letter])
    for segment in maneuver.segments[1:]:
        _mark(axes, segment.start, gid="switch", **MARKS["switch"])
    _mark(axes, maneuver.join, gid="join", **MARKS["join"])


def _mark(axes: Axes, pose: Pose, **style: Any) -> None:
    mark: dict[str, Any] = {"color": "black", "linestyle": "none", "zorder": 5} | style
    axes.plot([pose.east_m], [pose.north_m], **mark)


def _draw_circle(axes: Axes, orbit: Orbit, turns: set[Turn]) -> None:
    centre = east_m, north_m = orbit.east_m, orbit.north_m
    axes.add_patch(Circle(centre, orbit.radius_m, fill=False, color="black", linewidth=1.4, zorder=2, gid="circle"))
    axes.plot(*centre, marker="+", color="black", markersize=8, linestyle="none", gid="centre")
    for turn in turns:
        sense = -1.0 if turn == Turn.CW else 1.0
        # Where both directions tie, their arrows are drawn apart.
        for quarter in range(4):
            angle = math.radians(45.0 + 90.0 * quarter - 8.0 * sense * (len(turns) - 1))
            arc = angle + sense * np.array([0.0, CHORD_RAD])
            east, north = east_m + orbit.radius_m * np.cos(arc), north_m + orbit.radius_m * np.sin(arc)
            _arrow(axes, east, north, "black", gid=f"held {turn}")


def _draw_movement(axes: Axes, maneuver: Maneuver) -> None:
    """Draw the circle at the start, and the path of its centre until it is joined."""
    before, after = maneuver.orbit, maneuver.orbit_at_join
    centre = (before.east_m, before.north_m)
    axes.add_patch(Circle(centre, before.radius_m, fill=False, zorder=1, gid="circle at the start", **AT_THE_START))
    east, north = np.linspace(centre, (after.east_m, after.north_m), 3).T
    axes.plot(east, north, color=FAINT, linewidth=1.0, linestyle=":", gid="way of the centre")
    _arrow(axes, east, north, FAINT)


def _draw_wind(axes: Axes, wind: Wind) -> None:
    """Draw an arrow in the direction of the moving air, beside the title, where it hides nothing."""
    towards = np.array(wind.velocity_m_s) / wind.speed_m_s
    tail, head = WIND_PLACE - 0.5 * WIND_LENGTH * towards, WIND_PLACE + 0.5 * WIND_LENGTH * towards
    corner: dict[str, Any] = {"xycoords": OffsetFrom(axes.patch, (0.0, 1.0)), "annotation_clip": False}
    style = ARROW | {"color": WIND_COLOUR, "linewidth": 2.0, "mutation_scale": 14.0}
    axes.annotate(
        "", xy=tuple(head), xytext=tuple(tail), textcoords=corner["xycoords"], arrowprops=style, gid="wind", **corner
    )
    label = f"wind {wind.speed_m_s:.3g} m/s\nfrom {wrapped(wind.from_deg):.0f} deg"
    beside = WIND_PLACE + np.array([0.6 * WIND_LENGTH, 0.0])
    axes.annotate(label, xy=tuple(beside), va="center", fontsize="small", color=WIND_COLOUR, gid="wind label", **corner)


def _draw_north(axes: Axes) -> None:
    """Draw an arrow to the north, to the right of the title; the arrow of the wind is on the left."""
    corner: dict[str, Any] = {"xycoords": OffsetFrom(axes.patch, (1.0, 1.0)), "annotation_clip": False}
    ends: dict[str, Any] = {"xy": (-12.0, 27.0), "xytext": (-12.0, 5.0), "textcoords": corner["xycoords"]}
    style = ARROW | {"color": "black", "linewidth": 1.6, "mutation_scale": 13.0}
    axes.annotate("", **ends, arrowprops=style, gid="north", **corner)
    axes.annotate("N", xy=(-20.0, 11.0), ha="right", fontsize="medium", gid="north label", **corner)


def _draw_scale(axes: Axes) -> None:
    """Draw a bar of a round length in the lower right corner, about a fifth of the axes wide."""
    axes.apply_aspect()
    west, east = axes.get_xlim()
    length = round_length((east - west) / 5.0)
    text = f"{length / 1000.0:g} km" if length >= 1000.0 else f"{length:g} m"
    bar = AnchoredSizeBar(
        axes.transData, length, text, "lower right", pad=0.8, frameon=False, size_vertical=length / 60.0
    )
    for patch in bar.size_bar.get_children():
        patch.set_linewidth(0.0)  # an edge would make the bar longer than it says
    bar.set_gid("scale")
    axes.add_artist(bar)


def round_length(most: float) -> float:
    """The largest of 1, 2, 5 times a power of ten that is at most `most`.

    >>> round_length(237.0), round_length(0.05)
    (200.0, 0.05)
    """
    decade = 10.0 ** math.floor(math.log10(most))
    return max(step * decade for step in (1.0, 2.0, 5.0) if step * decade <= most)


def _arrow(
    axes: Axes, east: NDArray[np.float64], north: NDArray[np.float64], colour: str, gid: str | None = None
) -> None:
    i = len(east) // 2
    axes.annotate(
        "",
        xy=(east[i], north[i]),
        xytext=(east[i - 1], north[i - 1]),
        arrowprops=ARROW | {"color": colour, "mutation_scale": 15.0},
        gid=gid,
        zorder=4,
    )


def _draw_aircraft(axes: Axes, pose: Pose) -> None:
    # A dart along the heading, wide enough to show it, under the path, whose first turn may be short.
    e, n = heading_vector(pose.heading_deg)
    outline = np.array([[1.0, 0.0], [-0.7, 0.6], [-0.35, 0.0], [-0.7, -0.6]]) @ np.array([[e, n], [-n, e]])
    _mark(axes, pose, marker=outline, markersize=16, zorder=2.5, gid="start")


def _segment_track(segment: Segment, maneuver: Maneuver) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    turned = abs(segment.curvature_per_m) * segment.length_m
    steps = 3 + math.ceil(turned / CHORD_RAD)  # a straight segment needs a point in the middle, for its arrow
    east, north, _ = along(segment, np.linspace(0.0, segment.length_m, steps), maneuver.aircraft, maneuver.wind)
    return east, north


def _track(maneuver: Maneuver) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    tracks = [_segment_track(segment, maneuver) for segment in maneuver.segments]
    return np.concatenate([east for east, _ in tracks]), np.concatenate([north for _, north in tracks])


def _legend(best: Sequence[Maneuver], others: Sequence[Maneuver]) -> list[Line2D]:
    letters = dict.fromkeys(segment.letter for maneuver in best for segment in maneuver.segments)
    handles = [Line2D([], [], color=COLOURS[letter], linewidth=2.6, label=MEANINGS[letter]) for letter in letters]
    handles.append(Line2D([], [], color="black", linewidth=1.4, label="holding circle"))
    fastest, *_ = best
    if fastest.orbit.moves:
        handles.append(Line2D([], [], label="circle at the start", **AT_THE_START))
    handles += [Line2D([], [], color="black", linestyle="none", **style, label=label) for label, style in MARKS.items()]
    handles += [
        Line2D([], [], **style, linewidth=1.0, label=f"{other.word} {other.turn.value}: {_later(other, best)}")
        for other, style in zip(others, SLOWER, strict=False)
    ]
    if len(others) > len(SLOWER):
        label = f"{len(others) - len(SLOWER)} more, slower still"
        handles.append(Line2D([], [], **STILL_SLOWER, linewidth=1.0, label=label))
    return handles


def _later(maneuver: Maneuver, best: Sequence[Maneuver]) -> str:
    fastest, *_ = best
    later = maneuver.duration_s - fastest.duration_s
    # The resolution of a picture; the table and JSON show smaller differences.
    return f"{later:.3g} s later" if later > 1e-6 * maneuver.duration_s else "as fast"
