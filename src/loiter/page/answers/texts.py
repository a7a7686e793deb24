"""A plan as texts: an instruction to the pilot, the command line and the Python code that give it."""

from __future__ import annotations

from loiter.planning.leg import Leg, LegPlan
from loiter.planning.maneuver import Maneuver
from loiter.planning.model import ACTIONS, CALM, TURN_LIMITS, Aircraft, Orbit, Turn
from loiter.planning.problem import Problem
from loiter.planning.slot import Slot

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
    "exit_to": "--exit-to",
    "hold_s": "--hold",
    "turns": "--turns",
    "start_altitude_m": "--altitude",
    "altitude_m": "--to-altitude",
    "climb_rate_m_s": "--climb-rate",
    "descent_rate_m_s": "--descent-rate",
    "slot phase_deg": "--slot",
    "slot at_s": "--slot-at",
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


def command(problem: Problem, slot: Slot | None = None) -> str:
    """The command line that plans the scene, or the entry into a slot, in local metres."""
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
    words += [_option("slot phase_deg", slot.phase_deg)] if slot else []
    words += [_option("slot at_s", slot.at_s)] if slot and slot.at_s else []
    return " ".join(words)


def python(problem: Problem, slot: Slot | None = None) -> str:
    """Python code that computes the plan, or the entry into a slot, as `m` and prints it."""
    tolerance = f", tolerance_m={problem.tolerance_m!r}" if problem.tolerance_m else ""
    names, planned = "plan_all", f"m, *as_fast = plan_all(pose, orbit, uav{_wind(problem)}{tolerance})"
    if slot:
        names, planned = "Slot, plan", f"m = plan(pose, orbit, uav{_wind(problem)}, slot={slot!r})"
    return "\n".join([*_scene_lines(problem, names), planned, "print(m.word, m.turn.value, m.duration_s)"])


def leg_instruction(plan: LegPlan) -> str:
    """What to do now, what next, how long to hold, when to leave and when the point is reached."""
    hold = f"hold {plan.turn.described}"
    decimals = 2 if plan.leg.orbit.radius_m >= 10.0 else 3
    parts = [(segment.duration_s, ACTIONS[segment.letter]) for segment in plan.entry.segments]
    parts += [(plan.held_s, hold)] if plan.held_s > 0.0 else []
    (first_s, first), *later = [*parts, (plan.straight_s, "leave straight")]
    text = f"{first.capitalize()} now"
    if later:
        text += f", then {later[0][1]} in {first_s:.{decimals}f} s"
    if plan.held_s > 0.0:
        text += (
            f". {hold.capitalize()} from {plan.entry.duration_s:.{decimals}f} s for {plan.held_deg / 360.0:.2f} turns"
        )
    return f"{text}. Leave in {plan.exit_s:.{decimals}f} s, at the point in {plan.duration_s:.{decimals}f} s."


def leg_command(problem: Problem, leg: Leg) -> str:
    """The command line that plans a leg, in local metres."""
    words = [f"loiter leg{command(problem).removeprefix('loiter plan')}", _option("exit_to", *leg.exit_to)]
    numbers = {
        "hold_s": leg.hold_s or None,
        "turns": leg.turns or None,
        "start_altitude_m": leg.pose.altitude_m,
        "altitude_m": leg.altitude_m,
        "climb_rate_m_s": problem.aircraft.climb_rate_m_s,
        "descent_rate_m_s": problem.aircraft.descent_rate_m_s,
    }
    words += [_option(name, number) for name, number in numbers.items() if number is not None]
    return " ".join(words)


def leg_python(problem: Problem, leg: Leg) -> str:
    """Python code that computes the plan of a leg as `p` and prints it."""
    east_m, north_m = leg.exit_to
    needs = [f"hold_s={leg.hold_s!r}"] if leg.hold_s else []
    needs += [f"turns={leg.turns!r}"] if leg.turns else []
    needs += [f"altitude_m={leg.altitude_m!r}"] if leg.altitude_m is not None else []
    asked = ", ".join(["pose", "orbit", f"exit_to=({east_m!r}, {north_m!r})", *needs])
    lines = [*_scene_lines(problem, "Leg, plan_leg"), f"p = plan_leg(Leg({asked}), uav{_wind(problem)})", "print(p)"]
    return "\n".join(lines)


def _scene_lines(problem: Problem, names: str) -> list[str]:
    """Python code that imports names, and makes the pose, the orbit and the aircraft of a problem."""
    uav = problem.aircraft
    limit = _given_limit(uav)
    given = [name for name in (limit, "climb_rate_m_s", "descent_rate_m_s") if getattr(uav, name) is not None]
    values = ", ".join(f"{name}={getattr(uav, name)!r}" for name in ("airspeed_m_s", *given))
    imported = ", ".join(["Aircraft", "Orbit", "Pose", *(["Wind"] if _wind(problem) else []), names])
    return [
        f"from loiter import {imported}",
        "",
        f"pose = {problem.pose!r}",
        f"orbit = {_orbit(problem.orbit)}",
        f"uav = Aircraft({values})",
    ]


def _wind(problem: Problem) -> str:
    """The wind as one more argument, or nothing in still air."""
    return f", {problem.wind!r}" if problem.wind != CALM else ""


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
