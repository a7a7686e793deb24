"""A plan view, in metres, of one or more maneuvers onto a circle, and its parts: marks, arrows, fences, scale bar."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.backend_bases import RendererBase
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.offsetbox import AnchoredOffsetbox, AuxTransformBox, HPacker, TextArea
from matplotlib.patches import Circle, ConnectionPatch, PathPatch, Rectangle
from matplotlib.path import Path
from matplotlib.text import Annotation, OffsetFrom
from matplotlib.transforms import Bbox, IdentityTransform
from numpy.typing import NDArray

from loiter.fences import Breach, CircleZone, Fence
from loiter.fences.model import Zone
from loiter.geo import LocalFrame
from loiter.geo.frame import degrees_of
from loiter.planning.compass import heading_vector, wrapped
from loiter.planning.flight import along
from loiter.planning.maneuver import Maneuver
from loiter.planning.model import Orbit, Pose, Segment, Turn, Wind

Floats = NDArray[np.float64]

# East and north of points, metres.
Points = tuple[Floats, Floats]

ARROW: dict[str, Any] = {"arrowstyle": "-|>", "shrinkA": 0.0, "shrinkB": 0.0}

# The wind's arrow, in points: its middle from the upper left corner of the axes, and its length.
WIND_COLOUR = "#505050"
WIND_PLACE, WIND_LENGTH = np.array([14.0, 14.0]), 22.0

# The frame of the part of a plan that a second panel enlarges.
FRAME_COLOUR = "#707070"

# Points of the lines that stand for a turn are this far apart: chords of 2 degrees differ from an arc by 0.015 % of its
# radius, less than the width of a line.
CHORD_RAD = math.radians(2.0)

# The height of the scale bar, points.
BAR_POINTS = 2.5

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

# Styles by the gid of what is drawn with them: the segments of a path, the circle, and marks.
SEGMENTS: dict[str, dict[str, Any]] = {
    f"segment {letter}": {"color": colour, "linewidth": 2.6, "label": MEANINGS[letter]}
    for letter, colour in COLOURS.items()
}
CIRCLE: dict[str, dict[str, Any]] = {"circle": {"color": "black", "linewidth": 1.4, "label": "holding circle"}}
MARK: dict[str, Any] = {"color": "black", "linestyle": "none"}
MARKS: dict[str, dict[str, Any]] = {
    "switch": MARK | {"marker": "o", "markersize": 6, "markerfacecolor": "white"},
    "join": MARK | {"marker": "o", "markersize": 9, "markerfacecolor": "black"},
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

# The zones of a fence, by what they ask for, and the beginning of a breach.
FENCE_STYLES: dict[str, dict[str, Any]] = {
    "stay out": {"color": "#882255", "linewidth": 1.4},
    "stay in": {"color": "#882255", "linewidth": 1.4, "linestyle": "--"},
    "breach of the fence": MARK | {"color": "#cc0000", "marker": "X", "markersize": 9},
}

# Corners of the outline that stands for a circle.
CIRCLE_CORNERS = 180


class Box(NamedTuple):
    """A rectangle with sides to the north and to the east, metres."""

    west: float
    south: float
    east: float
    north: float

    @classmethod
    def around(cls, points: Iterable[Points]) -> Box:
        """The smallest box around points, given as arrays of east and north."""
        east, north = (np.concatenate(values) for values in zip(*points, strict=True))
        return cls(float(east.min()), float(north.min()), float(east.max()), float(north.max()))

    @property
    def size(self) -> float:
        """The longer side."""
        return max(self.east - self.west, self.north - self.south)

    def widened(self, margin: float) -> Box:
        """This box with a margin on each side."""
        return Box(self.west - margin, self.south - margin, self.east + margin, self.north + margin)

    def contains(self, pose: Pose) -> bool:
        """Whether a pose lies in this box."""
        return self.west <= pose.east_m <= self.east and self.south <= pose.north_m <= self.north

    @property
    def corners(self) -> Points:
        """Two opposite corners."""
        return np.array([self.west, self.east]), np.array([self.south, self.north])


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
    draw_bearings(axes, first.wind, frame)
    bands = {
        f"slower {other.turn}": style | {"label": f"{other.word} {other.turn.value}: {_later(other, first)}"}
        for other, style in zip(slower, SLOWER, strict=False)
    }
    draw_legend(figure, axes, SEGMENTS | CIRCLE | {"circle at the start": AT_THE_START} | MARKS | FENCE_STYLES | bands)
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
        (east, north), gid = _segment_track(segment, maneuver), f"segment {segment.letter}"
        axes.plot(east, north, **SEGMENTS[gid], zorder=3, gid=gid)
        colour, gid = COLOURS[segment.letter], f"arrow {segment.letter}"
        draw_arrow(axes, east, north, len(east) // 2, colour, gid=gid, least=LEAST_TRACK)
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


def _later(maneuver: Maneuver, first: Maneuver) -> str:
    later = maneuver.duration_s - first.duration_s
    return f"{_digits(later, 3)} s later" if _is_later(maneuver, first) else "as fast"


def _is_later(maneuver: Maneuver, other: Maneuver) -> bool:
    """Whether a maneuver takes visibly longer than another; the table and JSON show smaller differences."""
    return maneuver.duration_s - other.duration_s > RESOLUTION * maneuver.duration_s


def corners(orbit: Orbit) -> Points:
    """East and north of two opposite corners of the square around a circle."""
    ends = np.array([-orbit.radius_m, orbit.radius_m])
    return orbit.east_m + ends, orbit.north_m + ends


def draw_orbit(axes: Axes, orbit: Orbit) -> None:
    """Draw the circle and its centre."""
    draw_circle(axes, orbit, gid="circle", zorder=2.0, **CIRCLE["circle"])
    mark(axes, orbit, marker="+", markersize=8, zorder=2.0, gid="centre")


def draw_circle(axes: Axes, orbit: Orbit, **style: Any) -> None:
    """Draw a circle as a line."""
    axes.add_patch(Circle((orbit.east_m, orbit.north_m), orbit.radius_m, fill=False, **style))


def draw_turns(axes: Axes, orbit: Orbit, turns: set[Turn]) -> None:
    """Draw arrows on a circle in the directions in which it is held; where there are two, their arrows are apart."""
    for turn in turns:
        sense = -1.0 if turn == Turn.CW else 1.0
        for quarter in range(4):
            angle = math.radians(45.0 + 90.0 * quarter - 8.0 * sense * (len(turns) - 1))
            arc = angle + sense * np.array([0.0, CHORD_RAD])
            east, north = orbit.east_m + orbit.radius_m * np.cos(arc), orbit.north_m + orbit.radius_m * np.sin(arc)
            draw_arrow(axes, east, north, 1, "black", gid=f"held {turn}")


def draw_arrow(
    axes: Axes, east: Floats, north: Floats, i: int, colour: str, gid: str | None = None, least: float = 0.0
) -> None:
    """Draw an arrowhead at point i of a track, in the direction from the point before it.

    It is not drawn where the track is shorter than `least` times the size of the arrow.
    """
    arrow = TrackArrow((east, north), i, least, color=colour, mutation_scale=15.0)
    arrow.set(gid=gid, zorder=4)
    axes.add_artist(arrow)


class TrackArrow(Annotation):
    """An arrowhead on a track, which is not drawn where the track is short in the figure, whose size may change."""

    def __init__(self, track: Points, i: int, least: float, **style: Any) -> None:
        east, north = track
        self._track, self._least = np.column_stack(track), least
        ends: dict[str, Any] = {"xy": (east[i], north[i]), "xytext": (east[i - 1], north[i - 1])}
        super().__init__("", **ends, xycoords="data", arrowprops=ARROW | style)
        self.set_transform(IdentityTransform())

    @property
    def is_shown(self) -> bool:
        """Whether the track is long enough."""
        assert self.axes is not None  # it is drawn on axes only
        sides = np.diff(self.axes.transData.transform(self._track), axis=0)
        size = (self.arrowprops or {})["mutation_scale"] * self.axes.figure.dpi / 72.0
        return bool(np.hypot(*sides.T).sum() >= self._least * size)

    def draw(self, renderer: RendererBase) -> None:
        """Draw the arrowhead if the track is long enough."""
        if self.is_shown:
            super().draw(renderer)


def draw_aircraft(axes: Axes, pose: Pose) -> None:
    """Draw a dart along the heading, under the path, whose first turn may be short."""
    e, n = heading_vector(pose.heading_deg)
    outline = np.array([[1.0, 0.0], [-0.7, 0.6], [-0.35, 0.0], [-0.7, -0.6]]) @ np.array([[e, n], [-n, e]])
    mark(axes, pose, marker=outline, markersize=16, zorder=2.5, gid="start")


def mark(axes: Axes, place: Pose | Orbit | Breach, **style: Any) -> None:
    """Draw a mark at a pose, at the centre of a circle, or where a breach begins."""
    axes.plot([place.east_m], [place.north_m], **MARK | {"zorder": 5} | style)


def draw_bearings(axes: Axes, wind: Wind, frame: LocalFrame | None) -> None:
    """Draw north and, where there is one, the wind beside the title; name the origin of a frame on the axis of east."""
    if frame is not None:
        axes.set_xlabel(f"east of {degrees_of(frame.latitude_deg, frame.longitude_deg)} (m)")
    if wind.speed_m_s > 0.0:
        draw_wind(axes, wind)
    draw_north(axes)


def draw_legend(figure: Figure, axes: Axes, styles: Mapping[str, dict[str, Any]]) -> None:
    """Draw a legend of the styles whose gid is drawn anywhere in the figure; the label is the gid unless it has one."""
    drawn = drawn_gids(figure)
    handles = [Line2D([], [], **{"label": gid} | style) for gid, style in styles.items() if gid in drawn]
    axes.legend(handles=handles, loc="best", fontsize="small", handlelength=2.6, framealpha=0.9)


def draw_wind(axes: Axes, wind: Wind) -> None:
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


def draw_north(axes: Axes) -> None:
    """Draw an N with an arrow to the north, to the right of the title; the arrow of the wind is on the left.

    They are one annotation: layouts give room to text, and to the arrows of text, but not to arrows alone.
    """
    corner: dict[str, Any] = {"xycoords": OffsetFrom(axes.patch, (1.0, 1.0)), "annotation_clip": False}
    ends: dict[str, Any] = {"xy": (-10.0, 29.0), "xytext": (-10.0, 3.0), "textcoords": corner["xycoords"]}
    style = ARROW | {"color": "black", "linewidth": 1.6, "mutation_scale": 13.0}
    axes.annotate("N", **ends, ha="center", va="bottom", fontsize="medium", arrowprops=style, gid="north", **corner)


def prepare_plan(axes: Axes) -> None:
    """Prepare axes for a plan: east and north in metres, equally long, with a grid and a scale bar."""
    axes.set_aspect("equal", adjustable="datalim")
    # Coordinates of a national grid are shown in full, not as an offset and a difference.
    axes.ticklabel_format(useOffset=False, style="plain")
    axes.grid(color="#e6e6e6", linewidth=0.8)
    axes.set_axisbelow(True)
    axes.margins(0.08)
    axes.set_xlabel("east (m)", loc="left")
    axes.set_ylabel("north (m)")
    axes.add_artist(ScaleBar(axes))


def enlarge(detail: Axes, box: Box, overview: Axes, title: str) -> None:
    """Show the box on the panel `detail`, to the right of the overview, and there a frame and lines to this panel."""
    detail.set(xlim=(box.west, box.east), ylim=(box.south, box.north), ylabel="", title=title)
    detail.title.set_fontsize("small")
    detail.set_adjustable("box")
    # The lines from the frame end on the left.
    detail.yaxis.tick_right()
    # Narrow panels have room for few numbers.
    detail.locator_params(nbins=3)
    overview.locator_params(axis="x", nbins=3)
    width, height = box.east - box.west, box.north - box.south
    style: dict[str, Any] = {"color": FRAME_COLOUR, "linewidth": 0.8}
    overview.add_patch(Rectangle((box.west, box.south), width, height, fill=False, zorder=6, gid="frame", **style))
    for north, side in ((box.south, 0.0), (box.north, 1.0)):
        ends: dict[str, Any] = {"coordsA": overview.transData, "coordsB": detail.transAxes}
        line = ConnectionPatch((box.east, north), (0.0, side), **ends, linestyle=":", gid="connection", **style)
        line.set_in_layout(False)
        detail.figure.add_artist(line)
    for spine in detail.spines.values():
        spine.set_edgecolor(FRAME_COLOUR)


class ScaleBar(AnchoredOffsetbox):
    """A bar of a round length, at most a fifth of the axes wide, beside the label of the axis of east.

    There it hides nothing. It is fitted whenever it is drawn, so it is right for every size of the figure. Where the
    label leaves no room it is not drawn.
    """

    def __init__(self, axes: Axes) -> None:
        self._plan = axes
        self.bar = Rectangle((0.0, 0.0), 1.0, 1.0, color="black", linewidth=0.0)  # an edge would make the bar longer
        self.label = TextArea("", textprops={"fontsize": "small"})
        bar = AuxTransformBox(axes.transData)
        bar.add_artist(self.bar)
        row = HPacker(children=[bar, self.label], align="center", pad=0.0, sep=4.0)
        super().__init__("center right", child=row, pad=0.0, borderpad=0.0, frameon=False)
        self.set_gid("scale")

    def get_bbox(self, renderer: RendererBase) -> Bbox:
        """The extent of the bar and its text, after both are fitted to the limits of the axes."""
        west, east = self._plan.get_xlim()
        length_m = round_length((east - west) / 5.0)
        self.bar.set_width(length_m)
        self.bar.set_height(BAR_POINTS / 72.0 * self._plan.figure.dpi * (east - west) / self._plan.bbox.width)
        self.label.set_text(f"{length_m / 1000.0:g} km" if length_m >= 1000.0 else f"{length_m:g} m")
        beside = self._plan.xaxis.label.get_window_extent(renderer)
        self.set_bbox_to_anchor(Bbox.from_extents(beside.x1, beside.y0, self._plan.bbox.x1, beside.y1))
        return super().get_bbox(renderer)

    def draw(self, renderer: RendererBase) -> None:
        """Draw the bar if the label of the axis leaves room for it."""
        beside = self._plan.xaxis.label.get_window_extent(renderer)
        if self.get_window_extent(renderer).x0 > beside.x1:
            super().draw(renderer)


def round_length(most: float) -> float:
    """The largest of 1, 2, 5 times a power of ten that is at most `most`.

    >>> round_length(237.0), round_length(0.05)
    (200.0, 0.05)
    """
    decade = 10.0 ** math.floor(math.log10(most))
    return max(step * decade for step in (1.0, 2.0, 5.0) if step * decade <= most)


def drawn_gids(figure: Figure) -> set[str]:
    """The gids of the artists on the axes of a figure."""
    artists: list[Artist] = [artist for axes in figure.axes for artist in axes.get_children()]
    return {gid for artist in artists if (gid := artist.get_gid()) is not None}


def draw_fence(axes: Axes, fence: Fence | None, breaches: Sequence[Breach], whole: Box) -> None:
    """Draw zones and breaches; what of a fence is farther from the plan than its size does not enlarge the view."""
    if fence is None:
        return
    near = whole.widened(whole.size)
    for zone in fence.zones:
        corners = _outline(zone)
        _draw_zone(axes, zone, corners)
        inside = (corners >= (near.west, near.south)).all(axis=1) & (corners <= (near.east, near.north)).all(axis=1)
        axes.update_datalim(corners[inside])
    for breach in breaches:
        mark(axes, breach, **FENCE_STYLES["breach of the fence"], zorder=6, gid="breach of the fence")


def _draw_zone(axes: Axes, zone: Zone, corners: Floats) -> None:
    """Hatch the inside of a zone to stay out of; of one to stay in draw the edge alone, dashed."""
    name = "stay in" if zone.inclusion else "stay out"
    hatch: dict[str, Any] = {} if zone.inclusion else {"hatch": "///"}
    patch = PathPatch(Path(corners, closed=True), fill=False, zorder=1.05, gid=name, **FENCE_STYLES[name], **hatch)
    # `add_patch` would let the whole zone enlarge the view.
    axes.add_artist(patch)


def _outline(zone: Zone) -> Floats:
    """The corners of a zone, the first one again at the end: (n, 2)."""
    if isinstance(zone, CircleZone):
        angles = np.linspace(0.0, 2.0 * np.pi, CIRCLE_CORNERS + 1)
        east, north = zone.east_m + zone.radius_m * np.cos(angles), zone.north_m + zone.radius_m * np.sin(angles)
        return np.column_stack([east, north])
    return np.array([*zone.corners, zone.corners[0]])


def prepare_timeline(axes: Axes) -> None:
    """Prepare axes for values over time, with a grid."""
    axes.grid(color="#e6e6e6", linewidth=0.8)
    axes.set_axisbelow(True)
