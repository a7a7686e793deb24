"""Figures of flights in closed loop: tracks with the circle, and bank and time to join over time."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from numpy.typing import NDArray

from loiter.fences import Fence
from loiter.lab.trials.flight import Flight
from loiter.planning.compass import wrapped
from loiter.planning.maneuver import Maneuver
from loiter.plot.picture import (
    CIRCLE,
    FAINT,
    SPECK,
    Box,
    corners,
    draw_aircraft,
    draw_arrow,
    draw_fence,
    draw_orbit,
    draw_turns,
    drawn_gids,
    enlarge,
    prepare_plan,
    prepare_timeline,
)

# From the palette of Okabe and Ito.
COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7")

# The sign of the bank, as autopilots count it.
BANK_LABEL = "bank (deg,\nright +)"

IDEAL: dict[str, Any] = {"color": FAINT, "linewidth": 5.0}
TRACK_WIDTH = 1.3

# The arrow on the track of a law stands after this share of the time until it joined, so that arrows on tracks that lie
# side by side do not cover each other.
ARROW_SHARES = (0.3, 0.4, 0.5, 0.6)


def draw(ideal: Maneuver, flights: Mapping[str, Flight], *, conditions: str = "", fence: Fence | None = None) -> Figure:
    """A figure with the tracks of laws from one start and the fastest entry; below, bank and reported time to join.

    A dot marks the beginning of the full turn in which the aircraft settled. A moving circle is drawn where the fastest
    entry joins it. From a start so far away that the turns are specks, another panel enlarges the circle.
    The zones of a `fence` are drawn. `conditions`, such as the simulator and its seed, are the last line of the title.
    """
    figure = Figure(figsize=(8.0, 8.6), layout="constrained")
    enlarged = _enlarged(ideal, flights)
    whole = Box.around([(flight.track.east_m, flight.track.north_m) for flight in flights.values()])
    above = ["tracks"] if enlarged is None else ["tracks", "circle"]
    layout: Any = [above, ["bank"] * len(above), ["join"] * len(above)]
    axes = figure.subplot_mosaic(layout, height_ratios=[6, 2, 2])
    title = "\n".join(filter(None, [_title(ideal, list(flights)), conditions]))
    _draw_tracks(axes["tracks"], ideal, flights, elsewhere=enlarged)
    draw_fence(axes["tracks"], fence, (), whole)
    if enlarged is None:
        axes["tracks"].set_title(title, fontsize="medium")
    else:
        figure.suptitle(title, fontsize="medium")
        _draw_tracks(axes["circle"], ideal, flights)
        enlarge(axes["circle"], enlarged, axes["tracks"], "the circle, enlarged")
    axes["tracks"].legend(handles=_legend(figure, flights), loc="best", fontsize="small", framealpha=0.9)
    _draw_bank(axes["bank"], flights)
    _draw_time_to_join(axes["join"], flights)
    axes["join"].sharex(axes["bank"])
    return figure


def _title(ideal: Maneuver, names: Sequence[str]) -> str:
    """What was flown: the laws, then the circle, the airspeed and the wind."""
    laws = f"Laws {', '.join(names[:-1])} and {names[-1]}" if len(names) > 1 else f"Law {names[0]}"
    circle = f"a circle of {ideal.orbit.radius_m:.4g} m, {ideal.turn.described}"
    air = f", wind {ideal.wind.speed_m_s:.3g} m/s from {wrapped(ideal.wind.from_deg):.0f} deg"
    scene = f"{circle}, at {ideal.aircraft.airspeed_m_s:.4g} m/s"
    return f"{laws} in closed loop\nonto {scene}{air if ideal.wind.speed_m_s > 0.0 else ''}"


def _enlarged(ideal: Maneuver, flights: Mapping[str, Flight]) -> Box | None:
    """The box around the circle, if the turns are specks in a plan of all tracks; else None."""
    around_circle = corners(ideal.orbit_at_join)
    whole = Box.around([around_circle, *((flight.track.east_m, flight.track.north_m) for flight in flights.values())])
    circle = Box.around([around_circle]).widened(ideal.aircraft.turn_radius_m)
    specks = ideal.aircraft.turn_radius_m < SPECK * whole.size
    return circle if specks and circle.size < 0.5 * whole.size else None


def _draw_tracks(axes: Axes, ideal: Maneuver, flights: Mapping[str, Flight], elsewhere: Box | None = None) -> None:
    """Draw the tracks, without the marks on the circle if another panel enlarges it."""
    prepare_plan(axes)
    draw_orbit(axes, ideal.orbit_at_join)
    if elsewhere is None:
        draw_turns(axes, ideal.orbit_at_join, {ideal.turn})
    if ideal.segments:
        sampled = ideal.sample(ideal.duration_s / 400.0)
        axes.plot(sampled.east_m, sampled.north_m, **IDEAL, zorder=1, gid="ideal")
    for (name, flight), colour, share in zip(flights.items(), COLOURS, ARROW_SHARES, strict=False):
        _draw_track(axes, name, flight, colour, share)
        if elsewhere is None and flight.settled:
            _mark_settling(axes, name, flight, colour)
    draw_aircraft(axes, ideal.start)


def _draw_track(axes: Axes, name: str, flight: Flight, colour: str, share: float) -> None:
    east, north, elapsed_s = flight.track.east_m, flight.track.north_m, flight.track.elapsed_s
    axes.plot(east, north, color=colour, linewidth=TRACK_WIDTH, zorder=3, gid=f"track {name}")
    *_, last_s = elapsed_s
    arrow = max(1, int(np.searchsorted(elapsed_s, share * (flight.joined_s if flight.settled else last_s))))
    draw_arrow(axes, east, north, arrow, colour, gid=f"direction {name}")


def _mark_settling(axes: Axes, name: str, flight: Flight, colour: str) -> None:
    track = flight.track
    i = np.searchsorted(track.elapsed_s, flight.settled_s)
    place = [track.east_m[i]], [track.north_m[i]]
    axes.plot(*place, color=colour, marker="o", linestyle="none", zorder=5, gid=f"settled {name}")


def _legend(figure: Figure, flights: Mapping[str, Flight]) -> list[Line2D]:
    """An entry for the fastest entry, the circle and each law; the line of a law that settled has its dot."""
    drawn = drawn_gids(figure)
    ideal = [Line2D([], [], **IDEAL, label="fastest entry")] if "ideal" in drawn else []
    laws = [
        Line2D(
            [],
            [],
            color=colour,
            linewidth=TRACK_WIDTH,
            marker="o" if f"settled {name}" in drawn else "",
            label=_label(name, flight),
        )
        for (name, flight), colour in zip(flights.items(), COLOURS, strict=False)
    ]
    return [*ideal, Line2D([], [], **CIRCLE["circle"]), *laws]


def _label(name: str, flight: Flight) -> str:
    return f"{name}: settled in {flight.settled_s:.1f} s (dot)" if flight.settled else f"{name}: not settled"


def _draw_bank(axes: Axes, flights: Mapping[str, Flight]) -> None:
    for (name, flight), colour in zip(flights.items(), COLOURS, strict=False):
        axes.plot(flight.track.elapsed_s, flight.track.bank_deg, color=colour, linewidth=1.2, gid=f"bank {name}")
    axes.set_ylabel(BANK_LABEL)
    prepare_timeline(axes)


def _draw_time_to_join(axes: Axes, flights: Mapping[str, Flight]) -> None:
    """Draw the time to join of the laws that predict it, and name the others, which report 0 on the circle only."""
    silent = []
    for (name, flight), colour in zip(flights.items(), COLOURS, strict=False):
        time_to_join_s = flight.track.time_to_join_s
        if _predicts(time_to_join_s):
            axes.plot(flight.track.elapsed_s, time_to_join_s, color=colour, linewidth=1.2, gid=f"join {name}")
        else:
            silent.append(name)
    if silent:
        note = f"not predicted by {' and '.join(silent)}"
        # Times to join fall, so the upper right corner is free.
        axes.text(0.985, 0.9, note, transform=axes.transAxes, ha="right", va="top", fontsize="small", gid="silent")
    axes.set_ylabel("time to\njoin (s)")
    axes.set_xlabel("time (s)")
    prepare_timeline(axes)


def _predicts(time_to_join_s: NDArray[np.float64]) -> bool:
    """Whether a law reports times to join before the circle, not only 0 on it."""
    return bool(np.any(time_to_join_s > 0.0))
