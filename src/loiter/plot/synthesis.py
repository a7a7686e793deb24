"""The synthesis of the reduced plane as a picture: Fig. 4 of the paper for any radius and turn."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import ListedColormap
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patheffects import withStroke
from numpy.typing import NDArray

from loiter.arrays.partition import BOUNDARIES, Boundary, Partition, lines, worth
from loiter.kernel.words import Word
from loiter.planning.model import Turn

# The hue of a region shows its first control (as in the plan view); shades distinguish words with the same first
# control.
SHADES = {
    Word.RSL: "#f6cfb4",
    Word.RL: "#f0ad83",
    Word.RSR: "#f9e0cf",
    Word.RLR: "#dd8452",
    Word.R: "#dd8452",
    Word.SR: "#0072B2",
    Word.LSL: "#c3e6da",
    Word.LR: "#8fd0b9",
    Word.LSR: "#dcf1ea",
    Word.LRL: "#4fb392",
    Word.L: "#4fb392",
    Word.SL: "#0072B2",
}
LINES: dict[str, dict[str, Any]] = {
    "jump": {"color": "black", "linewidth": 2.6, "label": BOUNDARIES["jump"]},
    "switch": {"color": "#7b3294", "linewidth": 2.0, "label": BOUNDARIES["switch"]},
    "straight": {"color": "#0072B2", "linewidth": 2.6, "label": BOUNDARIES["straight"]},
    "tie": {"color": "black", "linewidth": 1.4, "linestyle": (0, (4, 2)), "label": BOUNDARIES["tie"]},
    "same": {"color": "#808080", "linewidth": 0.8, "label": BOUNDARIES["same"]},
}

# The points by which an outline makes a line wider: dark lines cannot be seen on the dark end of viridis.
OUTLINE = 2.0


def draw(regions: Partition, curves: Sequence[Boundary], show: str = "words") -> Figure:
    """Draw a partition: `show` is "words" (regions by winning word), "time" (T) or "worth" (T less T of *either*)."""
    figure = Figure(figsize=(8.4, 7.2), layout="constrained")
    axes = figure.add_subplot()
    axes.set_aspect("equal")
    if show == "words":
        _paint_words(axes, regions)
    else:
        _paint_values(figure, axes, regions, show)
    handles = [
        _draw_curve(axes, regions, kind, curves, outlined=show != "words")
        for kind in LINES
        if any(c.kind == kind for c in curves)
    ]
    handles.append(_draw_targets(axes, regions))
    axes.set_xlim(regions.x.min(), regions.x.max())
    axes.set_ylim(regions.y.min(), regions.y.max())
    axes.set_xlabel("x: passed the centre by (turn radii)")
    axes.set_ylabel("y: to the left of the centre by (turn radii)")
    axes.set_title(f"{_TITLES[show]}, R = {regions.radius:g}, {regions.turn.described}")
    axes.legend(handles=handles, loc="upper right", fontsize="small", framealpha=0.92)
    return figure


_TITLES = {"words": "Winning word", "time": "Time to join", "worth": "What a free direction is worth"}


def _paint_words(axes: Axes, regions: Partition) -> None:
    present = [word for word in SHADES if np.any(regions.word == word)]
    index = np.zeros(regions.word.shape)
    for i, word in enumerate(present):
        index[regions.word == word] = i
    colours = ListedColormap([SHADES[word] for word in present])
    axes.pcolormesh(regions.x, regions.y, index, cmap=colours, vmin=-0.5, vmax=len(present) - 0.5, rasterized=True)
    for word in present:
        for x, y in _middles(regions, word):
            axes.text(x, y, word.letters, ha="center", va="center", fontsize=10, gid=f"region {word.letters}")


def _paint_values(figure: Figure, axes: Axes, regions: Partition, show: str) -> None:
    values = regions.time if show == "time" else worth(regions)
    mesh = axes.pcolormesh(regions.x, regions.y, values, cmap="viridis", rasterized=True)
    figure.colorbar(mesh, ax=axes, label="turn radii over airspeed")


def _middles(regions: Partition, word: Word) -> list[tuple[float, float]]:
    """The positions of the labels of a word: in each part, the cell farthest from the border.

    A region that crosses the axis is one part; if it does not, those above and below the axis are two.
    """
    inside = regions.word == word
    upper = regions.y[:, np.newaxis] > 0.0
    below, above = inside[len(regions.y) // 2 - 1], inside[len(regions.y) // 2]
    parts = [inside] if np.any(below & above) else [inside & upper, inside & ~upper]
    found = []
    for part in parts:
        depth = _depth(part)
        # Below a fiftieth of the map a region is narrower than its label.
        if depth.max() >= 0.02 * len(regions.x):
            row, column = np.unravel_index(int(depth.argmax()), depth.shape)
            found.append((float(regions.x[column]), float(regions.y[row])))
    return found


def _depth(inside: NDArray[np.bool_]) -> NDArray[np.int64]:
    """For each cell, how many times the region can be eroded by one cell before this cell disappears."""
    depth = np.zeros(inside.shape, dtype=np.int64)
    while inside.any():
        depth += inside
        shrunk = np.zeros_like(inside)
        core = inside[1:-1, 1:-1] & inside[:-2, 1:-1] & inside[2:, 1:-1] & inside[1:-1, :-2] & inside[1:-1, 2:]
        shrunk[1:-1, 1:-1] = core
        inside = shrunk
    return depth


def _draw_curve(axes: Axes, regions: Partition, kind: str, curves: Sequence[Boundary], *, outlined: bool) -> Line2D:
    """Draw the curves of a kind, with a white outline where colours below show values; returns their legend entry."""
    style = LINES[kind]
    if outlined:
        outline = withStroke(linewidth=style["linewidth"] + OUTLINE, foreground="white")
        style = style | {"path_effects": [outline]}
    for curve in curves:
        if curve.kind == kind:
            # nan separates two lines.
            line = np.concatenate([np.vstack([line, [np.nan, np.nan]]) for line in lines(regions, curve)])
            axes.plot(*line.T, **style, solid_capstyle="round", gid=f"{kind} {' '.join(curve.words)}")
    return Line2D([], [], **style)


def _draw_targets(axes: Axes, regions: Partition) -> Line2D:
    """Draw the states in which the circle is joined; returns their entry in the legend."""
    ends = {Turn.CW: [1.0], Turn.CCW: [-1.0], Turn.EITHER: [1.0, -1.0]}[regions.turn]
    style: dict[str, Any] = {"marker": "o", "color": "black", "linestyle": "none"}
    for sign in ends:
        axes.plot([0.0], [sign * regions.radius], markersize=8, gid="target", **style)
    return Line2D([], [], markersize=6, label="circle joined", **style)
