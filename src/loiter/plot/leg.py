"""A plan view, in metres, of a leg: the entry, the hold, the way out, and below it the altitude in time."""

from __future__ import annotations

from collections.abc import Sequence
from math import degrees
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from loiter.geo import LocalFrame
from loiter.lazy import LazyModule
from loiter.planning.leg import LegPlan
from loiter.plot.picture import (
    CHORD_RAD,
    FENCE_STYLES,
    LEAST_TRACK,
    MARK,
    MARKS,
    SEGMENTS,
    Box,
    draw_aircraft,
    draw_arrow,
    draw_bearings,
    draw_fence,
    draw_legend,
    draw_orbit,
    draw_path,
    draw_turns,
    mark,
    prepare_plan,
    prepare_timeline,
)

if TYPE_CHECKING:
    from loiter import fences
else:
    fences = LazyModule("loiter.fences")

# The way out and the hold, and where they begin and end; the entry has the colours of its segments.
OUT: dict[str, Any] = {"color": "#CC79A7", "linewidth": 2.6}
HELD: dict[str, Any] = {"color": "#E69F00", "linewidth": 2.6}
EXIT: dict[str, Any] = MARK | {"marker": "s", "markersize": 8, "markerfacecolor": "white"}
POINT: dict[str, Any] = MARK | {"marker": "*", "markersize": 13}

# The steps of the altitude in time.
PROFILE_STEPS = 300


def draw(
    plan: LegPlan,
    *,
    frame: LocalFrame | None = None,
    fence: fences.Fence | None = None,
    breaches: Sequence[fences.Breach] = (),
) -> Figure:
    """Draw a leg: its entry coloured by segment, the hold up to the exit, and the straight way to the point.

    East is to the right, north up, axes equal, in metres; with a frame the axes name its origin on Earth. In wind
    tracks are ground tracks, and an arrow beside the title shows the direction in which the air moves. Of a `fence` the
    zones are drawn, and crosses mark its `breaches`. A leg with an altitude has a second panel with it.
    """
    figure = Figure(figsize=(8.0, 6.4), layout="constrained")
    if plan.leg.altitude_m is None:
        axes = figure.add_subplot()
    else:
        axes, below = figure.subplots(2, height_ratios=(4.0, 1.0))
        _draw_altitude(below, plan)
    axes.set_title(_title(plan))
    prepare_plan(axes)
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
    draw_arrow(axes, east, north, 1, OUT["color"], least=LEAST_TRACK)
    mark(axes, plan.exit, gid="exit", **EXIT)
    mark(axes, end, gid="point", **POINT)
    draw_aircraft(axes, plan.leg.pose)
    flown = plan.sample(plan.duration_s / PROFILE_STEPS)
    draw_fence(axes, fence, breaches, Box.around([(flown.east_m, flown.north_m)]))
    draw_bearings(axes, entry.wind, frame)
    lines: dict[str, Any] = {"hold": HELD | {"label": f"hold, {plan.held_deg / 360.0:.2f} turns"}, "way out": OUT}
    draw_legend(figure, axes, SEGMENTS | lines | MARKS | {"exit": EXIT, "point": POINT} | FENCE_STYLES)
    return figure


def _draw_altitude(axes: Axes, plan: LegPlan) -> None:
    """The altitude in time, with the times at which the circle is joined and left."""
    prepare_timeline(axes)
    step_s = plan.duration_s / PROFILE_STEPS
    track = plan.sample(step_s)
    axes.plot(track.time_s, track.altitude_m, color="black", linewidth=1.6, gid="altitude")
    for time_s, style in ((plan.entry.duration_s, MARKS["join"]), (plan.exit_s, EXIT), (plan.duration_s, POINT)):
        axes.plot(time_s, np.interp(time_s, track.time_s, track.altitude_m), **style)
    axes.margins(y=0.15)  # the marks at the ends are whole
    axes.set(xlabel="time (s)", ylabel="altitude (m)")


def _title(plan: LegPlan) -> str:
    word = plan.entry.word or "on the circle already"
    return (
        f"{word}, {plan.turn.described}: joins in {plan.entry.duration_s:.4g} s, holds for {plan.held_s:.4g} s\n"
        f"leaves after {plan.exit_s:.4g} s, at the point after {plan.duration_s:.4g} s"
    )
