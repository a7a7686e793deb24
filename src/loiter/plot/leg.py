"""A plan view, in metres, of a leg: the entry, the part of the circle that is held, and the way out."""

from __future__ import annotations

from math import degrees
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from loiter.geo import LocalFrame
from loiter.geo.frame import degrees_of
from loiter.planning.leg import LegPlan
from loiter.plot.marks import (
    CHORD_RAD,
    draw_aircraft,
    draw_arrow,
    draw_north,
    draw_orbit,
    draw_turns,
    draw_wind,
    drawn_gids,
    mark,
    prepare_plan,
)
from loiter.plot.picture import COLOURS, MARKS, MEANINGS, draw_path
from loiter.plot.sizes import OUTSIDE_IF_NARROW

# The way out and the hold, and where they begin and end; the entry has the colours of its segments.
OUT: dict[str, Any] = {"color": "#CC79A7", "linewidth": 2.6}
HELD: dict[str, Any] = {"color": "#E69F00", "linewidth": 2.6}
EXIT: dict[str, Any] = {"marker": "s", "markersize": 8, "markerfacecolor": "white"}
POINT: dict[str, Any] = {"marker": "*", "markersize": 13}


def draw(plan: LegPlan, *, frame: LocalFrame | None = None) -> Figure:
    """Draw a leg: its entry coloured by segment, the hold up to the exit, and the straight way to the point.

    East is to the right, north up, axes equal, in metres; with a frame the axes name its origin on Earth. In wind
    tracks are ground tracks, and an arrow beside the title shows the direction in which the air moves.
    """
    figure = Figure(figsize=(8.0, 6.4), layout="constrained")
    axes = figure.add_subplot()
    axes.set_title(_title(plan))
    prepare_plan(axes)
    if frame is not None:
        axes.set_xlabel(f"east of {degrees_of(frame.latitude_deg, frame.longitude_deg)} (m)")
    entry, orbit = plan.entry, plan.leg.orbit
    draw_orbit(axes, orbit)
    draw_turns(axes, orbit, {plan.turn})
    # More than a turn covers the whole circle.
    steps = max(1.0, min(plan.held_deg, 360.0) / degrees(CHORD_RAD))
    held = plan.on_circle(
        np.linspace(max(0.0, 1.0 - 360.0 / max(plan.held_deg, 360.0)), 1.0, round(steps) + 1).tolist()
    )
    axes.plot(held.east_m, held.north_m, zorder=2.8, gid="hold", **HELD)
    draw_path(axes, entry)
    end = plan.end
    east, north = np.linspace((plan.exit.east_m, plan.exit.north_m), (end.east_m, end.north_m), 3).T
    axes.plot(east, north, zorder=3, gid="way out", **OUT)
    draw_arrow(axes, east, north, 1, OUT["color"], least=1.5)
    mark(axes, plan.exit, gid="exit", **EXIT)
    mark(axes, end, gid="point", **POINT)
    draw_aircraft(axes, plan.leg.pose)
    if entry.wind.speed_m_s > 0.0:
        draw_wind(axes, entry.wind)
    draw_north(axes)
    legend = axes.legend(handles=_legend(figure, plan), loc="best", fontsize="small", handlelength=2.6, framealpha=0.9)
    legend.set_gid(OUTSIDE_IF_NARROW)
    return figure


def _title(plan: LegPlan) -> str:
    word = plan.entry.word or "on the circle already"
    return (
        f"{word}, {plan.turn.described}: joins in {plan.entry.duration_s:.4g} s, holds for {plan.held_s:.4g} s\n"
        f"leaves after {plan.exit_s:.4g} s, at the point after {plan.duration_s:.4g} s"
    )


def _legend(figure: Figure, plan: LegPlan) -> list[Line2D]:
    """An entry for each kind of line and mark that is drawn."""
    letters = dict.fromkeys(segment.letter for segment in plan.entry.segments)
    lines: dict[str, dict[str, Any]] = {
        f"segment {u}": {"color": COLOURS[u], "linewidth": 2.6, "label": MEANINGS[u]} for u in letters
    }
    lines |= {
        "hold": HELD | {"label": f"hold, {plan.held_deg / 360.0:.2f} turns"},
        "way out": OUT | {"label": "way out"},
    }
    marks = MARKS | {"exit": EXIT, "point": POINT}
    lines |= {name: {"color": "black", "linestyle": "none", "label": name, **style} for name, style in marks.items()}
    drawn = drawn_gids(figure)
    return [Line2D([], [], **style) for gid, style in lines.items() if gid in drawn]
