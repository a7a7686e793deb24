"""Errors as one sentence for the user, with the names of options in place of arguments."""

import re
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

# The arguments of the library that have an option of their name, without its unit: `chord_error_m` has --chord-error.
_NAMED = """
accept_fly_away airframe airspeed_m_s altitude_m altitude_reference arrive_s autopilot bearing_deg cases cells
chord_error_m climb_rate_m_s declination_deg descent_rate_m_s exit_to fence gust
hold_s home_altitude_m indicated_airspeed_m_s keep layer_height_m lead_s log margin_m orbit orbit_from orbit_lla
orbit_velocity_m_s out plot port pose pose_lla radius reach rejects replay reports reserve runs save
scheduler seed send separation_m show sim slot slot_at_s slot_band spacing_m states system temperature_c
timeout_s to_altitude_m tolerance_m true_radius turn turns wind workers yes
"""
NAMED = frozenset(_NAMED.split())
# Those of several values, each of which may be the argument of an error.
SEVERAL = ("exit_to", "pose", "orbit", "origin", "wind")
# Those whose option has another name.
RENAMED = {
    "max_bank_deg": "--bank",
    "min_turn_radius_m": "--turn-radius",
    "max_turn_rate_deg_s": "--turn-rate",
    "source": "IN",
    "table": "FILE",
    "target": "OUT",
    "columns": "--map",
    "origin": "--orbit-lla",
    "frame": "--orbit-lla",
    "parameters": "--params",
    "connection": "--connect",
    "period_s": "--every",
    "pose altitude_m": "--altitude",
    "pose latitude_deg": "--pose-lla LAT",
    "pose longitude_deg": "--pose-lla LON",
    "pose true heading_deg": "--pose-lla HEADING",
    "origin latitude_deg": "--orbit-lla LAT",
    "origin longitude_deg": "--orbit-lla LON",
    "orbit velocity_east_m_s": "--orbit-velocity EAST",
    "orbit velocity_north_m_s": "--orbit-velocity NORTH",
}

_UNIT = re.compile(r"_(m_s|mm|m|deg|s|c)$")


def option(argument: str) -> str:
    """The option for an argument of the library, or the argument itself; "pose east_m" is the east_m of `pose`.

    >>> option("chord_error_m"), option("pose east_m"), option("aircraft max_bank_deg"), option("maneuver")
    ('--chord-error', '--pose EAST', '--bank', 'maneuver')
    """
    whole, _, part = argument.partition(" ")
    if argument in RENAMED:
        return RENAMED[argument]
    if whole == "aircraft" and part:
        return option(part)
    if part and whole in SEVERAL:
        return f"{option(whole)} {_UNIT.sub('', part).upper()}"
    return f"--{_UNIT.sub('', argument).replace('_', '-')}" if argument in NAMED else argument


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
        text = f"{option(error.argument)} {_problem(error)}"
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
        problem = problem.replace(name, option(name))
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
