"""A plan view, in metres, of a fleet: the entries of all aircraft, and their slots when the last one is in its own."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from loiter.fleets.planning import FleetPlan, rounded_down, slot_tracks
from loiter.geo import LocalFrame
from loiter.plot.picture import (
    FAINT,
    MARK,
    MARKS,
    SEGMENTS,
    draw_aircraft,
    draw_bearings,
    draw_circle,
    draw_legend,
    draw_orbit,
    draw_path,
    draw_turns,
    prepare_plan,
)

SLOT: dict[str, Any] = MARK | {"marker": "D", "markersize": 9, "markerfacecolor": "white", "label": "slot"}
NAMES: dict[str, Any] = {"textcoords": "offset points", "xytext": (7.0, 7.0), "fontsize": "small", "zorder": 6}


def draw(plan: FleetPlan, names: Sequence[str], *, frame: LocalFrame | None = None) -> Figure:
    """Draw the entries of a fleet coloured by segment, and the slots when the last aircraft is in its own.

    East is to the right, north up, axes equal, in metres; with a frame the axes name its origin on Earth. In wind
    tracks are ground tracks. A moving circle is drawn where it is when the last aircraft joins, and faint at the start.
    """
    figure, axes = _scene(plan, frame)
    axes.set_title(_title(plan))
    for entry, name in zip(plan.entries, names, strict=True):
        draw_path(axes, entry)
        draw_aircraft(axes, entry.start)
        axes.annotate(name, (entry.start.east_m, entry.start.north_m), gid="name", **NAMES)
    for (place,), name in zip(slot_tracks(plan, np.array([plan.duration_s])), names, strict=True):
        axes.plot([place.real], [place.imag], gid="slot", zorder=4.5, **SLOT)
        axes.annotate(name, (place.real, place.imag), gid="name of slot", **NAMES)
    draw_legend(figure, axes, SEGMENTS | MARKS | {"slot": SLOT})
    return figure


def _scene(plan: FleetPlan, frame: LocalFrame | None) -> tuple[Figure, Axes]:
    """A figure with the circle, its direction, north and wind."""
    first, *_ = plan.entries
    figure = Figure(figsize=(8.0, 6.4), layout="constrained")
    axes = figure.add_subplot()
    prepare_plan(axes)
    orbit = first.orbit.after(plan.duration_s)
    if first.orbit.moves:
        draw_circle(axes, first.orbit, zorder=1, gid="circle at the start", color=FAINT, linestyle="--")
    draw_orbit(axes, orbit)
    draw_turns(axes, orbit, {plan.turn})
    draw_bearings(axes, first.wind, frame)
    return figure, axes


def _title(plan: FleetPlan) -> str:
    apart = f", at least {rounded_down(plan.separation_m, 1)} m apart" if plan.approaches else ""
    first = f"{len(plan.entries)} aircraft, {plan.turn.described}{apart}"
    return f"{first}\nthe last is in its slot in {plan.duration_s:.4g} s"
