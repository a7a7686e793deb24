"""A plan as texts: an instruction to the pilot, the command line and the Python code that give it."""

from __future__ import annotations

from loiter.planning.maneuver import Maneuver
from loiter.planning.model import CALM, TURN_LIMITS, Aircraft, Orbit, Turn
from loiter.planning.problem import Problem
from loiter.planning.vocabulary import ACTIONS

# The options of `loiter plan` for what a scene has.
OPTIONS = {
    "pose": "--pose",
    "orbit": "--orbit",
    "turn": "--turn",
    "airspeed_m_s": "--airspeed",
    "max_bank_deg": "--bank",
    "min_turn_radius_m": "--turn-radius",
    "max_turn_rate_deg_s": "--turn-rate",
    "wind": "--wind",
    "orbit_velocity_m_s": "--orbit-velocity",
    "tolerance_m": "--tolerance",
}


def instruction(maneuver: Maneuver) -> str:
    """What to do now, what next, and how to hold: "Turn right now, ... Hold clockwise from 9.14 s."."""
    hold = f"hold {maneuver.turn.described}"
    if not maneuver.segments:
        return f"{hold.capitalize()}: you are on the circle."
    first, *later = maneuver.segments
    decimals = 2 if maneuver.orbit.radius_m >= 10.0 else 3
    next_action = ACTIONS[later[0].letter] if later else hold
    now = f"{ACTIONS[first.letter].capitalize()} now, then {next_action} in {first.duration_s:.{decimals}f} s."
    return f"{now} {hold.capitalize()} from {maneuver.duration_s:.{decimals}f} s." if later else now


def command(problem: Problem) -> str:
    """The command line that plans the scene, in local metres."""
    pose, orbit, wind = problem.pose, problem.orbit, problem.wind
    limit = _given_limit(problem.aircraft)
    words = [
        "loiter plan",
        _option("pose", pose.east_m, pose.north_m, pose.heading_deg),
        _option("orbit", orbit.east_m, orbit.north_m, orbit.radius_m),
    ]
    words += [f"{OPTIONS['turn']} {orbit.turn.value}"] if orbit.turn != Turn.EITHER else []
    words.append(_option("airspeed_m_s", problem.aircraft.airspeed_m_s))
    words.append(_option(limit, getattr(problem.aircraft, limit)))
    words += [_option("wind", wind.speed_m_s, wind.from_deg)] if wind != CALM else []
    velocity = orbit.velocity_east_m_s, orbit.velocity_north_m_s
    words += [_option("orbit_velocity_m_s", *velocity)] if orbit.moves else []
    words += [_option("tolerance_m", problem.tolerance_m)] if problem.tolerance_m else []
    return " ".join(words)


def python(problem: Problem) -> str:
    """Python code that computes the plan as `m` and prints it."""
    wind = f", {problem.wind!r}" if problem.wind != CALM else ""
    tolerance = f", tolerance_m={problem.tolerance_m!r}" if problem.tolerance_m else ""
    uav, limit = problem.aircraft, _given_limit(problem.aircraft)
    names = ", ".join(["Aircraft", "Orbit", "Pose", *(["Wind"] if wind else []), "plan_all"])
    return "\n".join(
        [
            f"from loiter import {names}",
            "",
            f"pose = {problem.pose!r}",
            f"orbit = {_orbit(problem.orbit)}",
            f"uav = Aircraft(airspeed_m_s={uav.airspeed_m_s!r}, {limit}={getattr(uav, limit)!r})",
            f"m, *as_fast = plan_all(pose, orbit, uav{wind}{tolerance})",
            "print(m.word, m.turn.value, m.duration_s)",
        ]
    )


def _orbit(orbit: Orbit) -> str:
    text = f'east_m={orbit.east_m!r}, north_m={orbit.north_m!r}, radius_m={orbit.radius_m!r}, turn="{orbit.turn.value}"'
    if orbit.moves:
        text += f", velocity_east_m_s={orbit.velocity_east_m_s!r}, velocity_north_m_s={orbit.velocity_north_m_s!r}"
    return f"Orbit({text})"


def _given_limit(aircraft: Aircraft) -> str:
    """The name of the turn limit that the aircraft was given."""
    return next(name for name in TURN_LIMITS if getattr(aircraft, name) is not None)


def _option(argument: str, *numbers: float) -> str:
    """An argument as an option of the command line, its numbers with all the digits that they need to be read back."""
    return " ".join([OPTIONS[argument], *(repr(number).removesuffix(".0") for number in numbers)])
