"""Figures of guided flights, from their logs: the track with the circle, the distance from the path, and the bank."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Circle

from loiter.plot.flown import BANK_LABEL, COLOURS
from loiter.plot.picture import FAINT

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
        axes["offset"].plot(time_s, np.asarray(log[name], float), color=colour, linewidth=1.2, label=label, gid=name)
    holding = [stage == "holding" for stage in log["stage"]]
    _limit_offset(axes["offset"], np.asarray(log["outside_m"], float), np.asarray(log["crosstrack_m"], float), holding)
    for name, label, colour in (("command_deg", "commanded", COLOURS[1]), ("bank_deg", "measured", COLOURS[0])):
        axes["bank"].plot(time_s, np.asarray(log[name], float), color=colour, linewidth=1.2, label=label, gid=name)
    axes["offset"].set_ylabel("distance (m)")
    axes["bank"].set_ylabel(BANK_LABEL)
    axes["bank"].set_xlabel("time (s)")
    axes["offset"].sharex(axes["bank"])
    for panel in axes.values():
        panel.grid(color="#e6e6e6", linewidth=0.8)
        panel.set_axisbelow(True)
        panel.legend(loc="best", fontsize="small", framealpha=0.9)
    return figure


def _draw_track(axes: Axes, log: Columns) -> None:
    centre = log["orbit_east_m"][-1], log["orbit_north_m"][-1]
    axes.add_patch(Circle(centre, log["orbit_radius_m"][-1], fill=False, color=FAINT, linewidth=5.0, gid="circle"))
    east, north = np.asarray(log["east_m"], float), np.asarray(log["north_m"], float)
    holding = np.array([stage != "joining" for stage in log["stage"]])
    for label, part, colour in (("joining", ~holding, COLOURS[0]), ("on the circle", holding, COLOURS[2])):
        x, y = np.where(part, east, np.nan), np.where(part, north, np.nan)
        axes.plot(x, y, color=colour, linewidth=1.3, label=label, gid=label)
    axes.plot(east[:1], north[:1], color=COLOURS[0], marker="o", linestyle="none", gid="start")
    axes.set_aspect("equal", adjustable="datalim")
    axes.set_xlabel("east (m)")
    axes.set_ylabel("north (m)")


def _limit_offset(axes: Axes, outside: Any, crosstrack: Any, holding: Sequence[bool]) -> None:
    """Limit the axis of distances to those from the path and, on the circle, from the circle: it begins far outside."""
    shown = np.concatenate([crosstrack, outside[np.asarray(holding, bool)]])
    shown = np.abs(shown[np.isfinite(shown)])
    if shown.size:
        limit = 1.1 * max(float(shown.max()), 1.0)
        axes.set_ylim(-limit, limit)
