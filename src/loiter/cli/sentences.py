"""Errors as one sentence for the user, with the names of options in place of arguments."""

from cyclopts import Argument, CoercionError, CycloptsError, MissingArgumentError, UnusedCliTokensError

from loiter.errors import InvalidArgument
from loiter.planning.model import TURN_LIMITS
from loiter.planning.vocabulary import OPTIONS


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
        kind = "a whole number" if error.target_type is int else "a number"
        return f"{_option(error)} is {error.token.value!r}: it must be {kind}"
    if isinstance(error, MissingArgumentError) and error.argument is not None:
        return f"{_option(error)} needs {_missing_values(error, error.argument)}"
    if isinstance(error, UnusedCliTokensError) and error.unused_tokens:
        return f"{' '.join(error.unused_tokens)!r} is one argument too many; loiter --help lists commands and options"
    return str(error)


def _missing_values(error: MissingArgumentError, argument: Argument) -> str:
    """What an option needs: "3 numbers, EAST NORTH HEADING: 2 were given"."""
    count, _ = argument.token_count()
    name = argument.parameter.metavar or argument.name
    if count <= 1:
        return f"a value, {name}"
    return f"{count} numbers, {name}: {len(error.tokens_so_far) % count} were given"


def _option(error: CycloptsError) -> str:
    return error.argument.name if error.argument is not None else "an argument"
