"""Vehicles in flight as JSON lines: `loiter watch` and `loiter guide`."""

from __future__ import annotations

import json
import sys
from typing import TYPE_CHECKING

from loiter.cli.report import json_value
from loiter.planning.model import wind_from_velocity
from loiter.planning.vocabulary import ACTIONS

if TYPE_CHECKING:
    from loiter.guidance.estimation.vehicle import VehicleEstimates
    from loiter.mavlink import GuideReport, Report


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
