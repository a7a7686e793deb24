"""Figures of guided flights, from their logs: the track with the circle, the distance from the path, and the bank."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from loiter.lab.picture import BANK_LABEL, COLOURS
from loiter.planning.model import Orbit, Pose
from loiter.plot.picture import (
    FAINT,
    Floats,
    draw_aircraft,
    draw_arrow,
    draw_circle,
    draw_turns,
    prepare_plan,
    prepare_timeline,
)

Columns = Mapping[str, Sequence[Any]]


def draw(log: Columns) -> Figure:
    """A figure of the columns of a log: the track; over time the distance from path and circle, and the bank.

    On the track the colour changes where the circle is held.
    """
    figure = Figure(figsize=(8.0, 9.2), layout="constrained")
    layout: Any = [["track"], ["offset"], ["bank"]]
    axes = figure.subplot_mosaic(layout, height_ratios=[6, 2, 2])
    _draw_track(axes["track"], log)
    axes["track"].set_title(f"Guided flight onto a circle of {log['orbit_radius_m'][-1]:.4g} m", fontsize="medium")
    time_s = np.asarray(log["time_s"], float)
    for name, label, colour in (
        ("outside_m", "outside the circle", COLOURS[0]),
        ("crosstrack_m", "left of the path", COLOURS[1]),
    ):
        _draw_values(axes["offset"], time_s, log, name, label, colour)
    holding = [stage == "holding" for stage in log["stage"]]
    _limit_offset(axes["offset"], np.asarray(log["outside_m"], float), np.asarray(log["crosstrack_m"], float), holding)
    for name, label, colour in (("command_deg", "commanded", COLOURS[1]), ("bank_deg", "measured", COLOURS[0])):
        _draw_values(axes["bank"], time_s, log, name, label, colour)
    axes["offset"].set_ylabel("distance (m)")
    axes["bank"].set_ylabel(BANK_LABEL)
    axes["bank"].set_xlabel("time (s)")
    axes["offset"].sharex(axes["bank"])
    for panel in (axes["offset"], axes["bank"]):
        prepare_timeline(panel)
    for panel, columns in ((axes["track"], 1), (axes["offset"], 2), (axes["bank"], 2)):
        if panel.get_legend_handles_labels()[0]:
            panel.legend(loc="best", ncols=columns, fontsize="small", framealpha=0.9)
    return figure


def _draw_values(axes: Axes, time_s: Floats, log: Columns, name: str, label: str, colour: str) -> None:
    """Draw a column over time, unless it has no value at all."""
    values = np.asarray(log[name], float)
    if np.isfinite(values).any():
        axes.plot(time_s, values, color=colour, linewidth=1.2, label=label, gid=name)


def _draw_track(axes: Axes, log: Columns) -> None:
    prepare_plan(axes)
    east_m, north_m, radius_m, turn = (
        log[name][-1] for name in ("orbit_east_m", "orbit_north_m", "orbit_radius_m", "turn")
    )
    orbit = Orbit(east_m, north_m, radius_m, turn)
    band: dict[str, Any] = {"color": FAINT, "linewidth": 5.0}
    draw_circle(axes, orbit, gid="circle", **band)
    axes.plot([], [], **band, label="holding circle")  # a legend shows a circle as a rectangle
    draw_turns(axes, orbit, {orbit.turn})
    east, north = np.asarray(log["east_m"], float), np.asarray(log["north_m"], float)
    holding = np.array([stage != "joining" for stage in log["stage"]])
    for label, part, colour in (("joining", ~holding, COLOURS[0]), ("on the circle", holding, COLOURS[2])):
        if part.any():
            x, y = np.where(part, east, np.nan), np.where(part, north, np.nan)
            axes.plot(x, y, color=colour, linewidth=1.3, label=label, gid=label)
    draw_aircraft(axes, Pose(east[0], north[0], log["heading_deg"][0]))
    middle = int(np.count_nonzero(~holding)) // 2
    if middle > 0:
        draw_arrow(axes, east, north, middle, COLOURS[0], gid="direction")


def _limit_offset(axes: Axes, outside: Any, crosstrack: Any, holding: Sequence[bool]) -> None:
    """Limit the axis of distances to those from the path and, on the circle, from the circle: it begins far outside."""
    shown = np.concatenate([crosstrack, outside[np.asarray(holding, bool)]])
    shown = np.abs(shown[np.isfinite(shown)])
    if shown.size:
        limit = 1.1 * max(float(shown.max()), 1.0)
        axes.set_ylim(-limit, limit)
