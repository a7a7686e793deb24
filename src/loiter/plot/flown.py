"""Figures of flights in closed loop: tracks with the circle, and bank and time to join over time."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Circle

from loiter.guidance.trials.flight import Flight
from loiter.planning.compass import wrapped
from loiter.planning.maneuver import Maneuver
from loiter.plot.picture import FAINT
from loiter.plot.sizes import BELOW_IF_NARROW

# From the palette of Okabe and Ito.
COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7")

# The sign of the bank, as autopilots count it.
BANK_LABEL = "bank (deg,\nright +)"


def draw(ideal: Maneuver, flights: Mapping[str, Flight], *, conditions: str = "") -> Figure:
    """A figure with the tracks of laws from one start and the fastest entry; below, bank and reported time to join.

    A dot marks the beginning of the full turn in which the aircraft settled. A moving circle is drawn where the fastest
    entry joins it. `conditions`, such as the simulator and its seed, are the last line of the title.
    """
    figure = Figure(figsize=(8.0, 8.6), layout="constrained")
    layout: Any = [["tracks"], ["bank"], ["join"]]
    axes = figure.subplot_mosaic(layout, height_ratios=[6, 2, 2])
    _draw_tracks(axes["tracks"], ideal, flights)
    axes["tracks"].set_title("\n".join(filter(None, [_title(ideal, list(flights)), conditions])), fontsize="medium")
    for (name, flight), colour in zip(flights.items(), COLOURS, strict=False):
        track, time_s = flight.track, flight.track.elapsed_s
        axes["bank"].plot(time_s, track.bank_deg, color=colour, linewidth=1.2, gid=f"bank {name}")
        axes["join"].plot(time_s, track.time_to_join_s, color=colour, linewidth=1.2, gid=f"join {name}")
    axes["bank"].set_ylabel(BANK_LABEL)
    axes["join"].set_ylabel("to join (s)")
    axes["join"].set_xlabel("time (s)")
    axes["join"].sharex(axes["bank"])
    for panel in axes.values():
        panel.grid(color="#e6e6e6", linewidth=0.8)
        panel.set_axisbelow(True)
    return figure


def _title(ideal: Maneuver, names: Sequence[str]) -> str:
    """What was flown: the laws, then the circle, the airspeed and the wind."""
    laws = f"Laws {', '.join(names[:-1])} and {names[-1]}" if len(names) > 1 else f"Law {names[0]}"
    circle = f"a circle of {ideal.orbit.radius_m:.4g} m, {ideal.turn.described}"
    air = f", wind {ideal.wind.speed_m_s:.3g} m/s from {wrapped(ideal.wind.from_deg):.0f} deg"
    scene = f"{circle}, at {ideal.aircraft.airspeed_m_s:.4g} m/s"
    return f"{laws} in closed loop\nonto {scene}{air if ideal.wind.speed_m_s > 0.0 else ''}"


def _draw_tracks(axes: Axes, ideal: Maneuver, flights: Mapping[str, Flight]) -> None:
    circle = ideal.orbit_at_join
    centre = (circle.east_m, circle.north_m)
    axes.add_patch(Circle(centre, circle.radius_m, fill=False, color="black", linewidth=1.4, gid="circle"))
    sampled = ideal.sample(max(ideal.duration_s, 1e-3) / 400.0)
    axes.plot(sampled.east_m, sampled.north_m, color=FAINT, linewidth=5.0, label="fastest entry", gid="ideal")
    for (name, flight), colour in zip(flights.items(), COLOURS, strict=False):
        east, north = flight.track.east_m, flight.track.north_m
        axes.plot(east, north, color=colour, linewidth=1.3, label=_label(name, flight), gid=f"track {name}")
        if flight.settled:
            i = np.searchsorted(flight.track.elapsed_s, flight.settled_s)
            axes.plot([east[i]], [north[i]], color=colour, marker="o", linestyle="none", gid=f"settled {name}")
    axes.set_aspect("equal", adjustable="datalim")
    axes.set_xlabel("east (m)")
    axes.set_ylabel("north (m)")
    legend = axes.legend(loc="best", fontsize="small", framealpha=0.9)
    legend.set_gid(BELOW_IF_NARROW)


def _label(name: str, flight: Flight) -> str:
    return f"{name}: settled in {flight.settled_s:.1f} s" if flight.settled else f"{name}: not settled"
