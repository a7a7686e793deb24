"""Vehicles in flight as lines of text and of JSON, and the signals that end it: `loiter watch` and `loiter guide`."""

from __future__ import annotations

import json
import signal
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from math import isnan
from types import FrameType
from typing import TYPE_CHECKING

from loiter.cli.report import json_value
from loiter.planning.model import ACTIONS, wind_from_velocity

if TYPE_CHECKING:
    from loiter.guidance.vehicle import VehicleEstimates
    from loiter.mavlink import GuideReport, Report

# Winds below this, metres per second, and offsets below this, metres, are omitted: they would print as 0.
LEAST_WIND_M_S, LEAST_OFFSET_M = 0.05, 0.05

# Signals that end the program: the vehicle is commanded back to the fall-back circle first. Shells let programs that
# they start in the background ignore SIGINT.
ENDING_SIGNALS = ("SIGINT", "SIGTERM", "SIGHUP")


@contextmanager
def ending_signals(handler: Callable[[int, FrameType | None], object]) -> Iterator[None]:
    """`ENDING_SIGNALS` have this handler meanwhile."""
    numbers = [number for name in ENDING_SIGNALS if (number := getattr(signal, name, None)) is not None]
    former = [signal.signal(number, handler) for number in numbers]
    try:
        yield
    finally:
        for number, before in zip(numbers, former, strict=True):
            signal.signal(number, before)


def print_line(document: dict[str, object]) -> None:
    """Print one JSON object on a line of its own, at once."""
    sys.stdout.write(json.dumps(document, allow_nan=False) + "\n")
    sys.stdout.flush()


def watch_document(vehicle: Report) -> dict[str, object]:
    """A report of `watch` as plain values, in the units of `Report`; what is unknown is None."""
    return {
        "time_s": vehicle.time_s,
        "latitude_deg": json_value(vehicle.latitude_deg),
        "longitude_deg": json_value(vehicle.longitude_deg),
        "altitude_m": json_value(vehicle.altitude_m),
        "heading_deg": json_value(vehicle.heading_deg),
        "indicated_airspeed_m_s": json_value(vehicle.airspeed_m_s),
        "age_s": json_value(vehicle.age_s),
        "wind": {
            "speed_m_s": vehicle.wind.speed_m_s,
            "from_deg": vehicle.wind.from_deg,
            "source": vehicle.wind_source.value,
        },
        "problem": vehicle.problem or None,
        "word": None if vehicle.plan is None else vehicle.plan.word,
        "turn": None if vehicle.turn is None else vehicle.turn.value,
        "time_to_join_s": json_value(vehicle.time_to_join_s),
        "actions": [{"action": ACTIONS[action.letter], "in_s": action.in_s} for action in vehicle.actions],
        "other_direction_later_s": vehicle.other_costs_s,
        "holding": vehicle.holding,
        "outside_m": json_value(vehicle.outside_m),
        "commanded": vehicle.commanded,
        "notices": list(vehicle.notices),
    }


def guide_document(vehicle: GuideReport) -> dict[str, object]:
    """A report of `guide` as plain values, in the units of `GuideReport`; what is unknown is None."""
    return {
        "time_s": vehicle.time_s,
        "stage": vehicle.stage.value,
        "phase": vehicle.phase.value,
        "turn": vehicle.turn.value,
        "time_to_join_s": json_value(vehicle.time_to_join_s),
        "state": None
        if vehicle.state is None
        else {name: json_value(value) for name, value in vehicle.state._asdict().items()},
        "altitude_m": json_value(vehicle.altitude_m),
        "height_above_home_m": json_value(vehicle.height_m),
        "airspeed_source": vehicle.airspeed_source.value,
        "commanded_bank_deg": json_value(vehicle.command_deg),
        "crosstrack_m": json_value(vehicle.crosstrack_m),
        "outside_m": json_value(vehicle.outside_m),
        "rate_hz": vehicle.rate_hz,
        "age_s": json_value(vehicle.age_s),
        "estimates": None if vehicle.estimates is None else _estimates(vehicle.estimates),
        "notices": list(vehicle.notices),
    }


def _estimates(estimates: VehicleEstimates) -> dict[str, object]:
    """The estimates that the lines for people show: roll response, delay, ratio of turn rates, wind."""
    wind = wind_from_velocity(estimates.wind_east_m_s, estimates.wind_north_m_s)
    values = {
        "roll_time_s": estimates.roll.time_s,
        "delay_s": estimates.delay_s,
        "turn_ratio": estimates.turn_ratio,
        "wind_speed_m_s": wind.speed_m_s,
        "wind_from_deg": wind.from_deg,
    }
    return {name: json_value(value) for name, value in values.items()}


def line(vehicle: GuideReport) -> str:
    """A report in a line: "  12.0 s: joining clockwise in 8.2 s; bank 44 of 45 deg; 600 m, 100 above home; ..."."""
    parts = [_progress(vehicle), *_bank(vehicle), *_altitude(vehicle), *_offset(vehicle), *_slot(vehicle)]
    parts += _wind(vehicle)
    return f"{vehicle.time_s:6.1f} s: {'; '.join(parts)}"


def _progress(vehicle: GuideReport) -> str:
    if isnan(vehicle.time_to_join_s):
        return str(vehicle.stage)
    turn = vehicle.turn.described
    if vehicle.stage in ("joining", "dry run"):
        return f"{vehicle.stage} {turn} in {vehicle.time_to_join_s:.1f} s"
    return f"{vehicle.stage} {turn}"


def _bank(vehicle: GuideReport) -> list[str]:
    """The measured and the commanded bank."""
    if vehicle.state is None or isnan(vehicle.command_deg):
        return []
    return [f"bank {round(vehicle.state.bank_deg)} of {round(vehicle.command_deg)} deg"]


def _altitude(vehicle: GuideReport) -> list[str]:
    if isnan(vehicle.altitude_m):
        return []
    side = "above" if vehicle.height_m >= 0.0 else "below"
    height = "" if isnan(vehicle.height_m) else f", {abs(round(vehicle.height_m))} {side} home"
    return [f"{round(vehicle.altitude_m)} m{height}"]


def _offset(vehicle: GuideReport) -> list[str]:
    """How far the vehicle is beside its path or, on the circle, outside it."""
    on_circle = vehicle.stage in ("holding", "handing over", "handed over")
    offset_m, sides = (
        (vehicle.outside_m, ("outside", "inside")) if on_circle else (vehicle.crosstrack_m, ("left", "right"))
    )
    if isnan(offset_m):
        return []
    side = sides[0] if offset_m > 0.0 else sides[1]
    place = "circle" if on_circle else "path"
    beside = side if on_circle else f"{side} of path"
    return [f"on {place}" if abs(offset_m) < LEAST_OFFSET_M else f"{abs(offset_m):.1f} m {beside}"]


def _slot(vehicle: GuideReport) -> list[str]:
    """How far the slot is ahead or behind."""
    ahead_deg = vehicle.slot_ahead_deg
    if isnan(ahead_deg):
        return []
    return [f"slot {abs(ahead_deg):.1f} deg {'ahead' if ahead_deg >= 0.0 else 'behind'}"]


def _wind(vehicle: GuideReport) -> list[str]:
    """The wind that the law estimates."""
    e = vehicle.estimates
    if e is None:
        return []
    wind = wind_from_velocity(e.wind_east_m_s, e.wind_north_m_s)
    return [f"wind {wind.speed_m_s:.1f} m/s from {wind.from_deg:03.0f}"] if wind.speed_m_s >= LEAST_WIND_M_S else []
