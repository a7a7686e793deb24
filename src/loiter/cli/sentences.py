"""Errors as one sentence for a person, in the command line's own names."""

from cyclopts import Argument, CoercionError, CycloptsError, MissingArgumentError, UnusedCliTokensError

from loiter.errors import InvalidArgument
from loiter.planning.model import TURN_LIMITS

# What a user of the command line calls the arguments of the library.
OPTIONS = {
    "airspeed_m_s": "--airspeed",
    "indicated_airspeed_m_s": "--indicated-airspeed",
    "altitude_m": "--altitude",
    "altitude_reference": "--altitude-reference",
    "home_altitude_m": "--home-altitude",
    "temperature_c": "--temperature",
    "max_bank_deg": "--bank",
    "min_turn_radius_m": "--turn-radius",
    "max_turn_rate_deg_s": "--turn-rate",
    "tolerance_m": "--tolerance",
    "turn": "--turn",
    "plot": "--plot",
    "states": "--states",
    "cases": "--cases",
    "radius": "--radius",
    "reach": "--reach",
    "cells": "--cells",
    "save": "--save",
    "show": "--show",
    "out": "--out",
    "source": "IN",
    "target": "OUT",
    "pose": "--pose",
    "pose_lla": "--pose-lla",
    "orbit": "--orbit",
    "orbit_lla": "--orbit-lla",
    "spacing_m": "--spacing",
    "chord_error_m": "--chord-error",
    "host": "--host",
    "port": "--port",
    "cors": "--cors",
    "parameters": "--params",
    "frame": "--orbit-lla",
    "workers": "--workers",
    "connection": "--connect",
    "system": "--system",
    "timeout_s": "--timeout",
    "period_s": "--every",
    "reports": "--reports",
    "send": "--send",
    "true_radius": "--true-radius",
    "runs": "--runs",
    "gust": "--gust",
    "airframe": "--airframe",
    "seed": "--seed",
    "scheduler": "--scheduler",
    "wind": "--wind",
    "orbit_velocity_m_s": "--orbit-velocity",
    "pose east_m": "--pose EAST",
    "pose north_m": "--pose NORTH",
    "pose heading_deg": "--pose HEADING",
    "pose latitude_deg": "--pose-lla LAT",
    "pose longitude_deg": "--pose-lla LON",
    "pose true heading_deg": "--pose-lla HEADING",
    "origin latitude_deg": "--orbit-lla LAT",
    "origin longitude_deg": "--orbit-lla LON",
    "orbit east_m": "--orbit EAST",
    "orbit north_m": "--orbit NORTH",
    "orbit radius_m": "--orbit RADIUS",
    "orbit velocity_east_m_s": "--orbit-velocity EAST",
    "orbit velocity_north_m_s": "--orbit-velocity NORTH",
    "wind speed_m_s": "--wind SPEED",
    "wind from_deg": "--wind FROM",
}


def sentence(error: Exception) -> str:
    """One line for a person."""
    if isinstance(error, InvalidArgument):
        text = f"{OPTIONS.get(error.argument, error.argument)} {_translated(error)}"
    elif isinstance(error, CycloptsError):
        text = _of_the_command_line(error)
    elif isinstance(error, OSError):
        text = f"cannot write the output: {error.strerror or error}"
    else:
        text = str(error)
    return " ".join(text.split())


def _translated(error: InvalidArgument) -> str:
    # Only this problem names other arguments; the others may quote what the user typed, which stays as it is.
    if error.argument != "turn limit":
        return error.problem
    problem = error.problem
    for name in TURN_LIMITS:
        problem = problem.replace(name, OPTIONS[name])
    return problem


def _of_the_command_line(error: CycloptsError) -> str:
    if isinstance(error, CoercionError) and error.token is not None and error.target_type in (int, float):
        kind = "a whole number" if error.target_type is int else "a number"
        return f"{_option(error)} is {error.token.value!r}: it must be {kind}"
    if isinstance(error, MissingArgumentError) and error.argument is not None:
        return f"{_option(error)} needs {_wanted(error, error.argument)}"
    if isinstance(error, UnusedCliTokensError) and error.unused_tokens:
        return f"{' '.join(error.unused_tokens)!r} is one word too many; loiter --help lists what is understood"
    return str(error)


def _wanted(error: MissingArgumentError, argument: Argument) -> str:
    count, _ = argument.token_count()
    name = argument.parameter.metavar or argument.name
    return (
        f"{count} numbers, {name}: {len(error.tokens_so_far) % count} were given" if count > 1 else f"a value, {name}"
    )


def _option(error: CycloptsError) -> str:
    return error.argument.name if error.argument is not None else "an argument"
