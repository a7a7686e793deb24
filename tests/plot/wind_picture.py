"""Wind and the fastest entry: the picture of docs/wind.md.

Run: python -m plot.wind_picture docs/wind.png
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.colors import ListedColormap, SymLogNorm
from matplotlib.figure import Figure
from matplotlib.patches import Circle
from numpy.typing import NDArray

from loiter.arrays import min_time_in_wind
from loiter.planning.model import Aircraft, Orbit, Pose, Wind
from loiter.planning.solve import plan
from loiter.plot.files import save_figure
from loiter.plot.picture import MARKS

Floats = NDArray[np.float64]

# In turn radii and airspeeds, so that the pictures apply to every aircraft. The circle can be held in all these winds.
AIRCRAFT, CIRCLE_RADIUS = Aircraft(1.0, min_turn_radius_m=1.0), 2.7
FASTEST_WIND = 0.6
SPEEDS = (0.0, 0.15, 0.3, 0.45, FASTEST_WIND)
START = Pose(-9.0, 2.5, 90.0)

# The wind of the map blows north, across the course; the map covers |east|, |north| <= MAP_REACH.
MAP_WIND, MAP_REACH = 0.4, 8.0

# Colours for differences from a tenth to several; differences below SAME_TIME are due to rounding.
SCALE, SAME_TIME = SymLogNorm(0.1, vmin=-4.5, vmax=4.5), 1e-9

# A sign change of the difference is located by HALVINGS of a step of the map. If the difference still changes by more
# than JUMP there, one of the times jumps, and the two directions do not tie.
HALVINGS, JUMP = 30, 1e-3

TIE_COLOUR = ListedColormap(["#a6dcc8"])


def draw(cells: int = 540) -> Figure:
    """Draw entries from one start in winds of several speeds, and maps of the faster direction, without and with wind.

    Lengths are in turn radii, times in turn radii over airspeed; the maps have `cells` points a side, by default one
    for each pixel of the PNG, which takes a minute.
    """
    figure = Figure(figsize=(9.4, 8.0), layout="constrained")
    rows: list[Any] = [["tracks", "tracks"], ["still", "windy"]]
    tracks, still, windy = figure.subplot_mosaic(rows, height_ratios=[2, 3]).values()
    _draw_tracks(tracks)
    for axes, wind, title in (
        (still, 0.0, "Still air: tied wherever the entry has a straight piece"),
        (windy, MAP_WIND, f"Wind of {MAP_WIND:g} from the south: tied on the black lines"),
    ):
        mesh = _draw_worth(axes, wind, cells)
        axes.set_title(title, fontsize="medium")
    bar = figure.colorbar(mesh, ax=[still, windy], shrink=0.9, ticks=[-3.0, -1.0, -0.3, 0.0, 0.3, 1.0, 3.0])
    bar.ax.set_yticklabels(["3", "1", "0.3", "0", "0.3", "1", "3"])
    bar.set_label("clockwise sooner by        clockwise later by")
    for axes in (tracks, still, windy):
        axes.set_aspect("equal")
        axes.set_xlabel("east (turn radii)")
        axes.set_ylabel("north (turn radii)")
    return figure


def _draw_tracks(axes: Axes) -> None:
    _draw_circle(axes)
    for speed in SPEEDS:
        m = plan(START, Orbit(0.0, 0.0, CIRCLE_RADIUS), AIRCRAFT, Wind(speed, from_deg=180.0))
        track = m.sample(0.02)
        colour = colormaps["viridis"](0.9 * speed / FASTEST_WIND)
        label = f"{speed:.2f}: {m.word} {m.turn.value}, T = {m.duration_s:.2f}"
        axes.plot(track.east_m, track.north_m, color=colour, linewidth=2.0, label=label, gid="track", zorder=3)
        axes.plot([m.join.east_m], [m.join.north_m], **JOIN | {"color": colour}, gid="join", zorder=4)
    axes.plot([START.east_m], [START.north_m], color="black", marker=">", markersize=9, linestyle="none", gid="start")
    axes.set_title("The fastest entry bends with the wind")
    axes.legend(title="wind from the south, in airspeeds", loc="center right", fontsize="small", title_fontsize="small")
    axes.set_xlim(START.east_m - 1.0, 9.5)
    axes.set_ylim(-CIRCLE_RADIUS - 0.6, CIRCLE_RADIUS + 0.9)


JOIN: dict[str, Any] = MARKS["join"] | {"markersize": 6, "markerfacecolor": "white"}


def differences(wind: float, cells: int) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """The grid's coordinates and T clockwise less T counter-clockwise, heading east in a wind that blows north."""
    # An even number of points avoids the axes.
    line = np.linspace(-MAP_REACH, MAP_REACH, cells)
    east, north = np.meshgrid(line, line)
    return line, difference(wind, east, north)


def difference(wind: float, east: NDArray[np.float64], north: NDArray[np.float64]) -> NDArray[np.float64]:
    """T clockwise less T counter-clockwise at points, heading east in a wind that blows north."""
    cw, ccw = (min_time_in_wind(east, north, 0.0, CIRCLE_RADIUS, turn, 0.0, wind) for turn in ("cw", "ccw"))
    return cw - ccw


def _draw_worth(axes: Axes, wind: float, cells: int) -> Any:
    line, later = differences(wind, cells)
    tied = np.abs(later) < SAME_TIME
    mesh = axes.pcolormesh(line, line, later, cmap="PuOr", norm=SCALE, shading="nearest", rasterized=True, gid="later")
    if wind == 0.0:
        shown = np.ma.masked_where(~tied, tied)
        axes.pcolormesh(line, line, shown, cmap=TIE_COLOUR, shading="nearest", rasterized=True, gid="tied")
        axes.text(-MAP_REACH + 0.4, -MAP_REACH + 0.4, "tied", fontsize="medium", color="black")
    else:
        draw_ties(axes, line, partial(difference, wind))
    _draw_circle(axes)
    return mesh


def draw_ties(axes: Axes, line: Floats, later: Callable[[Floats, Floats], Floats]) -> None:
    """Draw where a function of east and north is 0, and not where it jumps past 0, on the grid of `line` (n,)."""
    values = later(*np.meshgrid(line, line))
    ties = np.ma.masked_where(_jumps(line, values, later), values)
    axes.contour(line, line, ties, levels=[0.0], colors="black", linewidths=1.8)


def _jumps(line: Floats, values: Floats, later: Callable[[Floats, Floats], Floats]) -> NDArray[np.bool_]:
    """Which points of the grid have a neighbour of the other sign across a jump."""
    points = np.stack(np.meshgrid(line, line), axis=-1)
    found = np.zeros(values.shape, dtype=bool)
    for here, there in ((np.s_[1:], np.s_[:-1]), (np.s_[:, 1:], np.s_[:, :-1])):
        change = values[here] * values[there] < 0.0
        first, second, sign = points[here][change], points[there][change], np.sign(values[here][change])
        for _ in range(HALVINGS):
            middle = 0.5 * (first + second)
            same = (later(*middle.T) * sign > 0.0)[:, np.newaxis]
            first, second = np.where(same, middle, first), np.where(same, second, middle)
        jump = np.zeros(change.shape, dtype=bool)
        jump[change] = np.abs(later(*first.T) - later(*second.T)) > JUMP
        found[here] |= jump
        found[there] |= jump
    return found


def _draw_circle(axes: Axes) -> None:
    axes.add_patch(Circle((0.0, 0.0), CIRCLE_RADIUS, fill=False, color="black", linewidth=1.4, gid="circle"))
    axes.plot([0.0], [0.0], marker="+", color="black", markersize=8, linestyle="none", gid="centre")


if __name__ == "__main__":
    _, file = sys.argv
    save_figure(Path(file), draw())
