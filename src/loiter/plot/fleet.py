"""A plan view, in metres, of a fleet: the entries of all aircraft, and their slots when the last one is in its own."""

from __future__ import annotations

from collections.abc import Sequence
from io import BytesIO
from math import ceil
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from numpy.typing import NDArray
from PIL import Image

from loiter.geo import LocalFrame
from loiter.planning.fleet import FleetPlan, fleet_period_s, fleet_tracks, slot_tracks
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
FLOWN: dict[str, Any] = {"color": "#0072B2", "linewidth": 1.6}
NOW: dict[str, Any] = MARK | {"marker": "o", "markersize": 7, "markerfacecolor": "#D55E00"}
NAMES: dict[str, Any] = {"textcoords": "offset points", "xytext": (7.0, 7.0), "fontsize": "small", "zorder": 6}

# An animation has at most this many frames of so many milliseconds, and goes on for this share of a turn after the last
# aircraft is in its slot; its resolution is in dots per inch.
MOST_FRAMES, FRAME_MS, AFTER, ANIMATION_DPI = 120, 100, 0.5, 80.0


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


def animation(plan: FleetPlan, names: Sequence[str], *, frame: LocalFrame | None = None) -> bytes:
    """The flights of a fleet as a GIF that repeats: tracks, aircraft and slots, until all are on the circle."""
    times_s = _frame_times(plan)
    tracks, slots = fleet_tracks(plan, times_s), slot_tracks(plan, times_s)
    figure, axes = _scene(plan, frame)
    canvas: Any = FigureCanvasAgg(figure)
    figure.set_dpi(ANIMATION_DPI)
    everywhere = np.concatenate([tracks.ravel(), slots.ravel()])
    axes.update_datalim(np.column_stack([everywhere.real, everywhere.imag]))
    lines = [axes.plot([], [], **FLOWN)[0] for _ in names]
    (places,), (aims,) = axes.plot([], [], zorder=5, **NOW), axes.plot([], [], zorder=4.5, **SLOT)
    labels = [axes.annotate(name, (0.0, 0.0), **NAMES) for name in names]
    axes.set_title("0 s")
    # The layout of the first image is that of all: computing it takes longer than drawing.
    canvas.draw()
    figure.set_layout_engine("none")
    images = []
    for i, time_s in enumerate(times_s.tolist()):
        for line, track, label in zip(lines, tracks, labels, strict=True):
            line.set_data(track[: i + 1].real, track[: i + 1].imag)
            label.xy = (track[i].real, track[i].imag)
        places.set_data(tracks[:, i].real, tracks[:, i].imag)
        aims.set_data(slots[:, i].real, slots[:, i].imag)
        axes.set_title(f"{time_s:.1f} s")
        canvas.draw()
        images.append(Image.fromarray(np.asarray(canvas.buffer_rgba())).convert("RGB").quantize(64))
    content = BytesIO()
    first, *others = images
    first.save(content, "GIF", save_all=True, append_images=others, duration=FRAME_MS, loop=0)
    return content.getvalue()


def _frame_times(plan: FleetPlan) -> NDArray[np.float64]:
    last_s = plan.duration_s + AFTER * fleet_period_s(plan)
    return np.linspace(0.0, last_s, min(MOST_FRAMES, ceil(last_s) + 1))


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
    apart = f", at least {plan.separation_m:.4g} m apart" if plan.approaches else ""
    first = f"{len(plan.entries)} aircraft, {plan.turn.described}{apart}"
    return f"{first}\nthe last is in its slot in {plan.duration_s:.4g} s"
