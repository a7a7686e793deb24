"""A plan in words: what to do, the command line, the lines of Python."""

from __future__ import annotations

from loiter.planning.maneuver import Maneuver
from loiter.planning.model import CALM, TURN_LIMITS, Aircraft, Orbit, Turn
from loiter.planning.vocabulary import ACTIONS
from loiter.web.models import Asked

LIMIT_OPTIONS = {
    "max_bank_deg": "--bank",
    "min_turn_radius_m": "--turn-radius",
    "max_turn_rate_deg_s": "--turn-rate",
}


def instruction(maneuver: Maneuver) -> str:
    """What to do now, and what next: "Turn right now, then fly straight in 1.7 s."."""
    hold = f"hold {maneuver.turn.described}"
    if not maneuver.segments:
        return f"{hold.capitalize()}: you are on the circle."
    first, *later = maneuver.segments
    following = ACTIONS[later[0].letter] if later else hold
    decimals = 1 if maneuver.orbit.radius_m >= 10.0 else 3
    return f"{ACTIONS[first.letter].capitalize()} now, then {following} in {first.duration_s:.{decimals}f} s."


def command(asked: Asked) -> str:
    """The command line that plans the scene, in local metres."""
    pose, orbit, wind = asked.pose, asked.orbit, asked.wind
    limit = _limit(asked.aircraft)
    words = [
        "loiter plan",
        _option("--pose", pose.east_m, pose.north_m, pose.heading_deg),
        _option("--orbit", orbit.east_m, orbit.north_m, orbit.radius_m),
    ]
    words += [f"--turn {orbit.turn.value}"] if orbit.turn != Turn.EITHER else []
    words.append(_option("--airspeed", asked.aircraft.airspeed_m_s))
    words.append(_option(LIMIT_OPTIONS[limit], getattr(asked.aircraft, limit)))
    words += [_option("--wind", wind.speed_m_s, wind.from_deg)] if wind != CALM else []
    words += [_option("--orbit-velocity", orbit.velocity_east_m_s, orbit.velocity_north_m_s)] if orbit.moves else []
    words += [_option("--tolerance", asked.tolerance_m)] if asked.tolerance_m else []
    return " ".join(words)


def python(asked: Asked) -> str:
    """Lines of Python after which `m` is the plan."""
    wind = f", {asked.wind!r}" if asked.wind != CALM else ""
    tolerance = f", tolerance_m={asked.tolerance_m!r}" if asked.tolerance_m else ""
    limit = _limit(asked.aircraft)
    names = ", ".join(["Aircraft", "Orbit", "Pose", *(["Wind"] if wind else []), "plan_all"])
    return "\n".join(
        [
            f"from loiter import {names}",
            "",
            f"pose = {asked.pose!r}",
            f"orbit = {_orbit(asked.orbit)}",
            f"uav = Aircraft(airspeed_m_s={asked.aircraft.airspeed_m_s!r}, {limit}={getattr(asked.aircraft, limit)!r})",
            f"m, *as_fast = plan_all(pose, orbit, uav{wind}{tolerance})",
            "print(m.word, m.turn.value, m.duration_s)",
        ]
    )


def _orbit(orbit: Orbit) -> str:
    text = f'east_m={orbit.east_m!r}, north_m={orbit.north_m!r}, radius_m={orbit.radius_m!r}, turn="{orbit.turn.value}"'
    if orbit.moves:
        text += f", velocity_east_m_s={orbit.velocity_east_m_s!r}, velocity_north_m_s={orbit.velocity_north_m_s!r}"
    return f"Orbit({text})"


def _limit(aircraft: Aircraft) -> str:
    return next(name for name in TURN_LIMITS if getattr(aircraft, name) is not None)


def _option(name: str, *numbers: float) -> str:
    """An option with its numbers, each with all the digits that it takes to read it back."""
    return " ".join([name, *(repr(number).removesuffix(".0") for number in numbers)])
