"""Words, the controls of a maneuver in the order flown, and sides, as integers. All arithmetic on words is here.

A word is a number in base 4 whose lowest digit is the first control plus 2: R = 1, S = 2, L = 3, and 0 where there is
no piece. It fits into one byte, and compiled code decodes it without a table.
"""

from enum import IntEnum

# The control of a piece that the word does not have.
ABSENT = -2


def encode(u1: int, u2: int = ABSENT, u3: int = ABSENT) -> int:
    """The word of the controls -1, 0 or +1 of up to three pieces, in the order flown."""
    return (u1 + 2) + 4 * (u2 + 2) + 16 * (u3 + 2)


def controls(word: int) -> tuple[int, int, int]:
    """The controls of the three pieces of a word, `ABSENT` past its last."""
    return (word & 3) - 2, (word >> 2 & 3) - 2, (word >> 4 & 3) - 2


def rest(word: int) -> int:
    """The word without its first piece."""
    return word >> 2


def mirrored(word: int) -> int:
    """The word with L and R exchanged."""
    u1, u2, u3 = controls(word)
    return encode(opposite(u1), opposite(u2), opposite(u3))


def opposite(u: int) -> int:
    """The opposite control; `ABSENT` stays as it is."""
    return u if u == ABSENT else -u


def code(member: int) -> int:
    """The plain number of a member of `Word`, `Side` or `Status`, which Python answers in as compiled code does."""
    return member + 0


# Sets of the six words of three pieces, a bit for each: all, and those with a straight piece.
ALL_WORDS, WITH_STRAIGHT = 63, 15


def set_of(word: int) -> int:
    """The set that contains only a word of three pieces: LSL, RSR, LSR, RSL, LRL and RLR are its bits, lowest first."""
    first, middle, last = controls(word)
    lowest = 16 if middle != 0 else 1 if first == last else 4
    return lowest if first > 0 else 2 * lowest


class Side(IntEnum):
    """The direction in which the circle is held: the sign of the target's ordinate in the reduced plane, (8)-(10)."""

    CW = 1
    CCW = -1
    EITHER = 0


class Word(IntEnum):
    """The words that occur, in Dubins' letters: L (u = +1), S (u = 0), R (u = -1).

    `EMPTY` is the word of a start that is already on the circle.
    """

    EMPTY = 0
    R = encode(-1)
    L = encode(1)
    SR = encode(0, -1)
    SL = encode(0, 1)
    RL = encode(-1, 1)
    LR = encode(1, -1)
    RSR = encode(-1, 0, -1)
    RSL = encode(-1, 0, 1)
    LSR = encode(1, 0, -1)
    LSL = encode(1, 0, 1)
    RLR = encode(-1, 1, -1)
    LRL = encode(1, -1, 1)

    @property
    def letters(self) -> str:
        """The word as a string: "RSL"; "" for `EMPTY`."""
        return "" if self is Word.EMPTY else self.name
