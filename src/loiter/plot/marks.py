"""Marks of plan views: the circle, the aircraft, arrows along tracks, the wind, north and the scale bar."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import Any, NamedTuple

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.backend_bases import RendererBase
from matplotlib.figure import Figure
from matplotlib.offsetbox import AnchoredOffsetbox, AuxTransformBox, HPacker, TextArea
from matplotlib.patches import Circle, ConnectionPatch, Rectangle
from matplotlib.text import Annotation, OffsetFrom
from matplotlib.transforms import Bbox, IdentityTransform
from numpy.typing import NDArray

from loiter.planning.compass import heading_vector, wrapped
from loiter.planning.model import Orbit, Pose, Turn, Wind

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


def corners(orbit: Orbit) -> Points:
    """East and north of two opposite corners of the square around a circle."""
    ends = np.array([-orbit.radius_m, orbit.radius_m])
    return orbit.east_m + ends, orbit.north_m + ends


def draw_orbit(axes: Axes, orbit: Orbit) -> None:
    """Draw the circle and its centre."""
    draw_circle(axes, orbit, gid="circle", color="black", linewidth=1.4, zorder=2.0)
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


def mark(axes: Axes, place: Pose | Orbit, **style: Any) -> None:
    """Draw a mark at a pose or at the centre of a circle."""
    chosen: dict[str, Any] = {"color": "black", "linestyle": "none", "zorder": 5} | style
    axes.plot([place.east_m], [place.north_m], **chosen)


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
