"""A maneuver as a small SVG, for notebooks: drawn without matplotlib, which takes a second to load."""

from __future__ import annotations

from html import escape
from math import atan2, degrees
from typing import TYPE_CHECKING, NamedTuple

from loiter.planning.compass import heading_vector
from loiter.planning.flight import along
from loiter.planning.model import Aircraft, Orbit, Pose, Segment, Turn, Wind

if TYPE_CHECKING:
    from loiter.planning.maneuver import Maneuver

# Okabe and Ito's palette, as in the pictures of `loiter.plot`.
COLOURS = {"L": "#009E73", "S": "#0072B2", "R": "#D55E00"}

# The picture: its width in pixels, the heights that it may have over its width, and the margin over its larger side.
WIDTH, FLATTEST, STEEPEST, MARGIN = 480.0, 0.35, 1.0, 0.08

# Points of an arc; a straight line through the air is straight over the ground too.
ARC_POINTS = 48

# Sizes of lines, marks and text, pixels.
THIN, THICK, MARK, ARROW, AIRCRAFT, TEXT = 1.5, 3.0, 4.5, 6.0, 18.0, 12.0


class _View(NamedTuple):
    """Conversion of local metres to pixels: north is up. The middle of the picture, its scale and its height."""

    east: float
    north: float
    scale: float
    height: float

    def pixels(self, east_m: float, north_m: float) -> str:
        """A place in the picture."""
        x = 0.5 * WIDTH + self.scale * (east_m - self.east)
        y = 0.5 * self.height - self.scale * (north_m - self.north)
        return f"{x:.1f},{y:.1f}"


def _view_of(points: list[tuple[float, float]]) -> _View:
    """The view that shows all points."""
    east, north = zip(*points, strict=True)
    width, height = max(east) - min(east), max(north) - min(north)
    margin = MARGIN * max(width, height)
    pixels = WIDTH * min(max((height + 2 * margin) / (width + 2 * margin), FLATTEST), STEEPEST)
    scale = min(WIDTH / (width + 2 * margin), pixels / (height + 2 * margin))
    return _View(0.5 * (max(east) + min(east)), 0.5 * (max(north) + min(north)), scale, pixels)


def drawn_svg(maneuver: Maneuver) -> str:
    """The track over the ground, coloured by control, with the circle when it is joined, start, switches and join."""
    tracks = [(segment.letter, _track(segment, maneuver.aircraft, maneuver.wind)) for segment in maneuver.segments]
    circle = maneuver.orbit_at_join
    east, north, radius = circle.east_m, circle.north_m, circle.radius_m
    corners = [(east - radius, north - radius), (east + radius, north + radius)]
    start = (maneuver.start.east_m, maneuver.start.north_m)
    view = _view_of([*corners, start, *(point for _, track in tracks for point in track)])
    centre_x, centre_y = view.pixels(east, north).split(",")
    title, height = escape(str(maneuver)), f"{view.height:.0f}"
    size = f'width="{WIDTH:.0f}" height="{height}" viewBox="0 0 {WIDTH:.0f} {height}"'
    ring = f'cx="{centre_x}" cy="{centre_y}" r="{view.scale * radius:.1f}"'
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" role="img" aria-label="{title}" {size}>',
        f"<title>{title}</title>",
        '<rect width="100%" height="100%" fill="white"/>',
        f'<circle {ring} fill="none" stroke="black" stroke-width="{THIN}"/>',
        *(_direction(view, circle, maneuver.turn, quarter) for quarter in range(4)),
        *(_line(view, letter, track) for letter, track in tracks),
        *(_dot(view, segment.start, "white") for segment in maneuver.segments[1:]),
        _dot(view, maneuver.join, "black"),
        _aircraft(view, maneuver.start),
        "</svg>",
    ]
    return "\n".join(parts)


def drawn_html(maneuver: Maneuver) -> str:
    """The SVG with the maneuver in words below it."""
    caption = f'<figcaption style="font: {TEXT:.0f}px sans-serif">{escape(str(maneuver))}</figcaption>'
    return f'<figure style="margin: 0">{drawn_svg(maneuver)}{caption}</figure>'


def _direction(view: _View, circle: Orbit, turn: Turn, quarter: int) -> str:
    """An arrow on the circle, in the direction in which it is held, between two of the compass points."""
    azimuth = 45.0 + 90.0 * quarter
    east, north = heading_vector(azimuth)
    place = view.pixels(circle.east_m + circle.radius_m * east, circle.north_m + circle.radius_m * north)
    turned = azimuth + (90.0 if turn == Turn.CW else -90.0)
    outline = f"0,{-ARROW} {0.7 * ARROW},{0.6 * ARROW} {-0.7 * ARROW},{0.6 * ARROW}"
    return f'<polygon points="{outline}" transform="translate({place}) rotate({turned:.1f})" fill="black"/>'


def _track(segment: Segment, aircraft: Aircraft, wind: Wind) -> list[tuple[float, float]]:
    """Points of a segment over the ground."""
    import numpy as np

    points = 2 if segment.letter == "S" else ARC_POINTS
    east, north, _ = along(segment, np.linspace(0.0, segment.length_m, points), aircraft, wind)
    return list(zip(east.tolist(), north.tolist(), strict=True))


def _line(view: _View, letter: str, track: list[tuple[float, float]]) -> str:
    points = " ".join(view.pixels(*point) for point in track)
    return (
        f'<polyline points="{points}" fill="none" stroke="{COLOURS[letter]}" stroke-width="{THICK}" '
        f'stroke-linejoin="round"/>'
    )


def _dot(view: _View, pose: Pose, fill: str) -> str:
    x, y = view.pixels(pose.east_m, pose.north_m).split(",")
    return f'<circle cx="{x}" cy="{y}" r="{MARK}" fill="{fill}" stroke="black"/>'


def _aircraft(view: _View, pose: Pose) -> str:
    """A dart that points along the heading."""
    turned = degrees(atan2(*heading_vector(pose.heading_deg)))
    place = view.pixels(pose.east_m, pose.north_m)
    size = 0.5 * AIRCRAFT
    outline = f"0,{-size} {0.6 * size},{0.7 * size} 0,{0.35 * size} {-0.6 * size},{0.7 * size}"
    return f'<polygon points="{outline}" transform="translate({place}) rotate({turned:.1f})" fill="black"/>'
