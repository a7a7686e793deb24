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
from loiter.planning.compass import wrapped
from loiter.planning.model import ACTIONS, BRIEF_ACTIONS, Wind, wind_from_velocity

if TYPE_CHECKING:
    from loiter.flight import GuideReport, Report
    from loiter.guidance.vehicle import VehicleEstimates
    from loiter.planning.maneuver import Maneuver

# Winds below this, metres per second, and offsets below this, metres, are omitted: they would print as 0. Times closer
# than this count as equal.
LEAST_WIND_M_S, LEAST_OFFSET_M, SAME_TIME_S = 0.05, 0.05, 0.05

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


def interrupt_once() -> Callable[[int, FrameType | None], None]:
    """A handler that raises `KeyboardInterrupt` for the first signal alone.

    A second one would cut short the command back to the fall-back circle, which takes seconds, and the last sentence.
    """
    signals: list[int] = []

    def interrupt(number: int, _: FrameType | None) -> None:
        signals.append(number)
        if len(signals) == 1:
            raise KeyboardInterrupt

    return interrupt


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
    wind = _estimated_wind(estimates)
    values = {
        "roll_time_s": estimates.roll.time_s,
        "delay_s": estimates.delay_s,
        "turn_ratio": estimates.turn_ratio,
        "wind_speed_m_s": wind.speed_m_s,
        "wind_from_deg": wind.from_deg,
    }
    return {name: json_value(value) for name, value in values.items()}


def _estimated_wind(estimates: VehicleEstimates) -> Wind:
    return wind_from_velocity(estimates.wind_east_m_s, estimates.wind_north_m_s)


def guide_line(vehicle: GuideReport) -> str:
    """A report in a line: "  12.0 s: joining clockwise in 8.2 s; bank 44 of 45 deg; 600 m, 100 above home; ..."."""
    parts = [_progress(vehicle), *_bank(vehicle), *_altitude(vehicle), *_offset(vehicle), *_slot(vehicle)]
    parts += [] if vehicle.estimates is None else _wind(_estimated_wind(vehicle.estimates))
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


def _wind(wind: Wind) -> list[str]:
    """A wind that is not negligible."""
    if wind.speed_m_s < LEAST_WIND_M_S:
        return []
    return [f"wind {wind.speed_m_s:.1f} m/s from {wrapped(wind.from_deg):03.0f}"]


def watch_line(vehicle: Report) -> str:
    """A report in a line: "12 s: joins clockwise in 19.8 s; right now, peel off left in 14.1 s; ..."."""
    clock = f"{vehicle.time_s:6.1f} s"
    if vehicle.plan is None:
        return f"{clock}: {vehicle.problem}"
    if vehicle.holding:
        return f"{clock}: on the circle, {vehicle.plan.turn.described}{_outside(vehicle.outside_m)}"
    parts = [
        f"joins {vehicle.plan.turn.described} in {vehicle.time_to_join_s:.1f} s",
        *_next_actions(vehicle, vehicle.plan),
        _other_direction(vehicle, vehicle.plan),
    ]
    if vehicle.wind_source != "still air":
        parts += [f"{text}, {vehicle.wind_source}" for text in _wind(vehicle.wind)]
    return f"{clock}: {'; '.join(parts)}"


def _outside(outside_m: float) -> str:
    """The distance of an aircraft from the circle that it holds, if it is a metre or more."""
    side = "outside" if outside_m > 0.0 else "inside"
    return f", {abs(outside_m):.0f} m {side}" if abs(outside_m) >= 1.0 else ""


def _next_actions(vehicle: Report, plan: Maneuver) -> list[str]:
    """The actions before the hold as one part of a line; none if all are too short to fly."""
    *before_hold, _ = vehicle.actions
    texts = [
        f"{BRIEF_ACTIONS[action.letter]} " + (f"in {action.in_s:.1f} s" if action.in_s else "now")
        for action in before_hold
    ]
    if not texts:
        return []
    *others, last = texts
    peel_off = "peel off " if len(plan.segments) > 1 else ""
    return [", ".join([*others, peel_off + last])]


def _other_direction(vehicle: Report, plan: Maneuver) -> str:
    """How much later or sooner the other direction would join."""
    other, later = plan.turn.other.described, vehicle.other_costs_s
    if later is None:
        return f"{other} cannot be held"
    if abs(later) < SAME_TIME_S:
        return f"{other} takes the same time"
    return f"{other} {abs(later):.1f} s {'later' if later > 0.0 else 'sooner'}"
