"""Numbers on the command line."""

from collections.abc import Sequence

from cyclopts import CoercionError, Token


def whole(type_: type, tokens: Sequence[Token]) -> int:
    """A whole number; 1.5 is refused, not rounded."""
    token, *_ = tokens
    try:
        return int(token.value)
    except ValueError as error:
        raise CoercionError(token=token, target_type=int) from error
