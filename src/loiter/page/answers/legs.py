"""Legs on the page: the way in, round and out towards a point, and its files."""

from __future__ import annotations

from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np

from loiter.arrays import reduce
from loiter.errors import InvalidArgument
from loiter.fences.fence import Fence, check
from loiter.files.document import PlacedProblem, maneuver_values
from loiter.files.legs import leg_text
from loiter.files.missions.items import Autopilot
from loiter.page.answers.texts import leg_command, leg_instruction, leg_python
from loiter.page.answers.tracks import LAP_STEPS, track
from loiter.planning.leg import HoldState, Leg, LegPlan, climb_time_s, hold_states, plan_leg
from loiter.planning.maneuver import pose_values
from loiter.planning.model import Turn
from loiter.planning.problem import Problem

# The most states of a hold in a track: a hold of more than a hundred turns has fewer a turn after its first one.
MOST_STATES = 12_000

# The control of a hold.
HOLD_LETTERS = {Turn.CW: "R", Turn.CCW: "L"}


class LegRequest(NamedTuple):
    """What a leg asks for beside the scene: `Leg`, with the altitude of the start and the rates of the aircraft."""

    exit_to: tuple[float, float]
    hold_s: float = 0.0
    turns: float = 0.0
    start_altitude_m: float | None = None
    altitude_m: float | None = None
    climb_rate_m_s: float | None = None
    descent_rate_m_s: float | None = None


def leg_plan(placed: PlacedProblem, asked: LegRequest) -> dict[str, Any]:
    """The plan of a leg: `LegPlan.to_dict`, with texts, the whole leg as one maneuver with its track, and altitudes.

    `altitudes` has times and altitudes between which the altitude changes evenly; None where the leg has none.
    """
    plan = _planned(placed, asked)
    leg, problem = plan.leg, _problem(placed, asked)
    return plan.to_dict() | {
        "sentence": str(plan),
        "instruction": leg_instruction(plan),
        "command": leg_command(problem, leg),
        "python": leg_python(problem, leg),
        "altitudes": _altitudes(plan),
        "maneuver": _whole(plan, placed),
    }


def leg_fence_check(placed: PlacedProblem, asked: LegRequest, fence: Fence, margin_m: float | None) -> dict[str, Any]:
    """Whether a leg stays clear: `FenceCheck.to_dict`, with its sentence."""
    found = check(fence, _planned(placed, asked), margin_m)
    return found.to_dict() | {"sentence": found.sentence()}


def leg_file(placed: PlacedProblem, asked: LegRequest, ending: str) -> bytes:
    """A leg as a file of `loiter.files.save_leg`, for ArduPilot."""
    if placed.frame is None:
        raise InvalidArgument("frame", f"is missing: a {ending} file needs places on Earth")
    return leg_text(_planned(placed, asked), ending, placed.frame, Autopilot.ARDUPILOT)


def _problem(placed: PlacedProblem, asked: LegRequest) -> Problem:
    """The problem with the altitude of the start and the rates of the aircraft."""
    problem = placed.problem
    pose = replace(problem.pose, altitude_m=asked.start_altitude_m)
    rates = asked.climb_rate_m_s, asked.descent_rate_m_s
    uav = replace(problem.aircraft, climb_rate_m_s=rates[0], descent_rate_m_s=rates[1])
    return Problem(pose, problem.orbit, uav, problem.wind)


def _planned(placed: PlacedProblem, asked: LegRequest) -> LegPlan:
    if asked.altitude_m is not None and asked.start_altitude_m is None:
        raise InvalidArgument("start_altitude_m", "is missing: the climb or descent to the exit begins there")
    problem = _problem(placed, asked)
    leg = Leg(problem.pose, problem.orbit, asked.exit_to, asked.hold_s, asked.turns, asked.altitude_m)
    return plan_leg(leg, problem.aircraft, problem.wind)


def _altitudes(plan: LegPlan) -> dict[str, list[float]] | None:
    leg = plan.leg
    if leg.altitude_m is None or leg.pose.altitude_m is None:
        return None
    reached_s = climb_time_s(leg, plan.entry.aircraft)
    return {
        "time_s": [0.0, reached_s, plan.duration_s],
        "altitude_m": [leg.pose.altitude_m, leg.altitude_m, leg.altitude_m],
    }


def _whole(plan: LegPlan, placed: PlacedProblem) -> dict[str, Any]:
    """The whole leg as a maneuver of the page: entry, hold and way out are its segments."""
    entry: dict[str, Any] = maneuver_values(plan.entry, placed.frame)
    hold = _segment("hold", HOLD_LETTERS[plan.turn], plan.entry.duration_s, plan.held_s)
    hold |= {"start": pose_values(plan.entry.join), "end": pose_values(plan.exit)}
    leave = _segment("leave", "S", plan.exit_s, plan.straight_s)
    leave |= {"start": pose_values(plan.exit), "end": pose_values(plan.end)}
    after = [segment for segment in (hold, leave) if segment["duration_s"] > 0.0]
    whole = {
        "duration_s": plan.duration_s,
        "join_s": plan.entry.duration_s,
        "length_m": plan.duration_s * plan.entry.aircraft.airspeed_m_s,
        "segments": [*entry["segments"], *after],
        "track": _track(plan),
    }
    return entry | whole


def _segment(name: str, letter: str, start_s: float, duration_s: float) -> dict[str, Any]:
    return {"name": name, "letter": letter, "start_s": start_s, "duration_s": duration_s}


def _track(plan: LegPlan) -> dict[str, list[float]]:
    """The track of a whole leg, as `tracks.track`."""
    entry, end = track(plan.entry), plan.end
    last = HoldState(plan.duration_s, end.east_m, end.north_m, end.heading_deg)
    states = [*hold_states(plan, _shares(plan.held_deg)), last]
    time_s, east, north, heading = (list(column) for column in zip(*states, strict=True))
    x, y = reduce(np.array(east), np.array(north), np.array(heading), plan.leg.orbit, plan.entry.aircraft)
    after = {"time_s": time_s, "east_m": east, "north_m": north, "heading_deg": heading}
    after |= {"x": x.tolist(), "y": y.tolist()}
    return {name: [*entry[name], *after[name]] for name in entry}


def _shares(held_deg: float) -> list[float]:
    """The shares of a hold at which it has states: its first turn is drawn, so that it has more of them."""
    turns = held_deg / 360.0
    if turns == 0.0:
        return []
    first = min(turns, 1.0)
    steps = [max(round(LAP_STEPS * first), 1), min(round(LAP_STEPS * (turns - first)), MOST_STATES)]
    shares = [first / turns * (i + 1) / steps[0] for i in range(steps[0])]
    return shares + [(first + (turns - first) * (i + 1) / steps[1]) / turns for i in range(steps[1])]
