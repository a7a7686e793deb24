"""Errors as one sentence for the user, with the names of options in place of arguments."""

from cyclopts import (
    Argument,
    CoercionError,
    CycloptsError,
    MissingArgumentError,
    RepeatArgumentError,
    UnusedCliTokensError,
)

from loiter.cli.numbers import given, typed
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
    return f"{name} needs {count} numbers, {metavar}{reported}: {given(len(error.tokens_so_far) % count)}"


def _option(error: CycloptsError) -> str:
    return error.argument.name if error.argument is not None else "an argument"
