"""Numbers as people type them."""

from collections.abc import Sequence

from cyclopts import CoercionError, Token


def whole(type_: type, tokens: Sequence[Token]) -> int:
    """A whole number as it stands: 1.5 is refused, not rounded."""
    try:
        return int(tokens[0].value)
    except ValueError as error:
        raise CoercionError(token=tokens[0], target_type=int) from error
