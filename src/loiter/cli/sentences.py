"""Errors as one sentence for the user, with the names of options in place of arguments."""

from collections.abc import Iterator
from contextlib import contextmanager

from cyclopts import (
    Argument,
    CoercionError,
    CycloptsError,
    MissingArgumentError,
    RepeatArgumentError,
    UnusedCliTokensError,
)

from loiter.cli.numbers import typed, values_given
from loiter.errors import InvalidArgument
from loiter.planning.model import TURN_LIMITS

# The option for each argument of the library. "pose east_m" is the east_m of the argument pose.
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
    "aircraft airspeed_m_s": "--airspeed",
    "aircraft max_bank_deg": "--bank",
    "aircraft min_turn_radius_m": "--turn-radius",
    "aircraft max_turn_rate_deg_s": "--turn-rate",
    "tolerance_m": "--tolerance",
    "lead_s": "--lead",
    "turn": "--turn",
    "plot": "--plot",
    "size_mm": "--size",
    "size_mm width": "--size WIDTH",
    "size_mm height": "--size HEIGHT",
    "dpi": "--dpi",
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
    "rejects": "--rejects",
    "columns": "--map",
    "origin": "--orbit-lla",
    "pose": "--pose",
    "pose_lla": "--pose-lla",
    "orbit": "--orbit",
    "orbit_lla": "--orbit-lla",
    "orbit_from": "--orbit-from",
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
    "yes": "--yes",
    "accept_fly_away": "--accept-fly-away",
    "reports": "--reports",
    "send": "--send",
    "log": "--log",
    "replay": "--replay",
    "true_radius": "--true-radius",
    "runs": "--runs",
    "sim": "--sim",
    "gust": "--gust",
    "airframe": "--airframe",
    "seed": "--seed",
    "scheduler": "--scheduler",
    "wind": "--wind",
    "declination_deg": "--declination",
    "autopilot": "--autopilot",
    "orbit_velocity_m_s": "--orbit-velocity",
    "pose east_m": "--pose EAST",
    "pose north_m": "--pose NORTH",
    "pose heading_deg": "--pose HEADING",
    "pose latitude_deg": "--pose-lla LAT",
    "pose longitude_deg": "--pose-lla LON",
    "pose true heading_deg": "--pose-lla HEADING",
    "origin latitude_deg": "--orbit-lla LAT",
    "origin longitude_deg": "--orbit-lla LON",
    "origin radius_m": "--orbit-lla RADIUS",
    "orbit east_m": "--orbit EAST",
    "orbit north_m": "--orbit NORTH",
    "orbit radius_m": "--orbit RADIUS",
    "orbit velocity_east_m_s": "--orbit-velocity EAST",
    "orbit velocity_north_m_s": "--orbit-velocity NORTH",
    "wind speed_m_s": "--wind SPEED",
    "wind from_deg": "--wind FROM",
}


@contextmanager
def argument_names(**names: str) -> Iterator[None]:
    """A context whose errors name other arguments: `path="save"` for the path that --save gave."""
    try:
        yield
    except InvalidArgument as error:
        if error.argument not in names:
            raise
        raise InvalidArgument(names[error.argument], error.problem) from error


def sentence(error: Exception) -> str:
    """The error message, in one line."""
    if isinstance(error, InvalidArgument):
        text = f"{OPTIONS.get(error.argument, error.argument)} {_problem(error)}"
    elif isinstance(error, CycloptsError):
        text = _usage_sentence(error)
    elif isinstance(error, OSError):
        text = f"cannot write the output: {error.strerror or error}"
    else:
        text = str(error)
    return " ".join(text.split())


def _problem(error: InvalidArgument) -> str:
    """The problem of an argument, with the turn limits as options.

    Only the problem of "turn limit" names other arguments. Other problems may quote the user's input, which stays as
    it is.
    """
    if error.argument != "turn limit":
        return error.problem
    problem = error.problem
    for name in TURN_LIMITS:
        problem = problem.replace(name, OPTIONS[name])
    return problem


def _usage_sentence(error: CycloptsError) -> str:
    """The message for an option or a value that the command does not take."""
    if isinstance(error, CoercionError) and error.token is not None and error.target_type in (int, float):
        need = f"it must be {'a whole number' if error.target_type is int else 'a number'}"
        return f"{_option(error)} is {typed(error.token)!r}: {error.msg or need}"
    if isinstance(error, MissingArgumentError) and error.argument is not None:
        return _missing(error, error.argument)
    if isinstance(error, RepeatArgumentError):
        more = ": it takes one law, and --compare flies all four" if error.token.keyword == "--law" else ""
        return f"{error.token.keyword} is given twice{more}"
    if isinstance(error, UnusedCliTokensError) and error.unused_tokens:
        return f"{' '.join(error.unused_tokens)!r} is one argument too many; loiter --help lists commands and options"
    return str(error)


def _missing(error: MissingArgumentError, argument: Argument) -> str:
    """What is missing: an argument, an option, its value, or some of its numbers."""
    name, metavar = argument.name, argument.parameter.metavar or argument.name
    count, _ = argument.token_count()
    if error.keyword is None and not name.startswith("-"):
        return f"{name} is missing: loiter {' '.join(error.command_chain or ())} --help shows what it means"
    if error.keyword is None:
        return f"{name} {metavar} is needed"
    if count <= 1:
        return f"{name} needs a value, {metavar}"
    reported = ", or one like 250/15kn" if name == "--wind" else ""
    return f"{name} needs {count} numbers, {metavar}{reported}: {values_given(len(error.tokens_so_far) % count)}"


def _option(error: CycloptsError) -> str:
    return error.argument.name if error.argument is not None else "an argument"
