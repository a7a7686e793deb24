"""The settings with which a law can be flown."""

from loiter.errors import InvalidArgument, not_negative

# The settings that a law can be flown with: a bank that follows at once or with a time constant from the first number,
# seconds, whose square no precision rounds to 0, to the last, the largest of any time or gain, and a least rate of bank
# and of its command, degrees per second. With others numbers would overflow, or divide by zero.
LEAST_ROLL_TIME_S, LEAST_ROLL_RATE_DEG_S, LARGEST_SETTING = 1e-6, 0.1, 1000.0


def setting(argument: str, value: object, unit: str) -> float:
    """A time or a gain of a law as a float; raises `InvalidArgument` unless it is from 0 to `LARGEST_SETTING`."""
    x = not_negative(argument, value, unit)
    if x > LARGEST_SETTING:
        raise InvalidArgument(argument, f"is {value}: it must be at most {LARGEST_SETTING:g} {unit}")
    return x
