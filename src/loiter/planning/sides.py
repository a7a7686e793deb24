"""Conversion between directions as the user gives them and the kernel's codes."""

from loiter.kernel.words import Side
from loiter.planning.model import Turn

SIDES = {Turn.CW: Side.CW, Turn.CCW: Side.CCW, Turn.EITHER: Side.EITHER}
TURNS = {side: turn for turn, side in SIDES.items()}


def directions(turn: Turn) -> tuple[Turn, ...]:
    """The directions in which a circle may be held: one, or both for *either*."""
    return (Turn.CW, Turn.CCW) if turn is Turn.EITHER else (turn,)


def sign_of(turn: Turn) -> int:
    """The sign of a direction as a plain number, for formulas: +1 clockwise, -1 counter-clockwise, 0 for either."""
    return int(SIDES[turn])
