"""Text files of other programs, read up to a maximum size; errors name the file in one sentence."""

from __future__ import annotations

from math import inf, isfinite
from pathlib import Path
from typing import NamedTuple

from loiter.errors import InvalidArgument
from loiter.planning.units import parse_number

# MAVLink's largest mission, 65,535 items, takes some 26 MB as an indented plan.
MAX_BYTES = 32_000_000

# The length to which values are cut in error messages.
SHOWN = 40


class Source(NamedTuple):
    """Where a text comes from: the argument that gave the path, and the path."""

    argument: str
    path: Path

    def fault(self, problem: str) -> InvalidArgument:
        """The error to raise; `problem` says what is wrong in the file."""
        return InvalidArgument(self.argument, f"file {str(self.path)!r}: {problem}")

    def text(self) -> str:
        """The whole file. Raises `InvalidArgument` if it cannot be read, is too large, or is not UTF-8."""
        try:
            with self.path.open("rb") as file:
                content = file.read(MAX_BYTES + 1)
        # A name with a nul byte is a ValueError.
        except (OSError, ValueError) as error:
            raise self.fault(f"it cannot be read, {getattr(error, 'strerror', None) or error}") from error
        if len(content) > MAX_BYTES:
            raise self.fault(f"it is longer than {MAX_BYTES:,} bytes")
        try:
            return content.decode("utf-8-sig")
        except UnicodeDecodeError as error:
            raise self.fault(f"it is not UTF-8 text, see byte {error.start}") from error

    def number(self, where: str, text: str) -> float:
        """A finite number read from text; `where` names it in errors, with its line or item."""
        try:
            value = parse_number(text)
        except ValueError:
            value = inf
        if not isfinite(value):
            raise self.fault(f"{where} is {shown(text)}: it must be a finite number")
        return value

    def integer(self, where: str, text: str, largest: int) -> int:
        """A whole number from 0 to `largest` read from text."""
        # More digits than those of `largest` mean a larger number, or leading zeros, which are refused.
        if not (text.isascii() and text.isdigit() and len(text) <= len(str(largest)) and int(text) <= largest):
            raise self.fault(f"{where} is {shown(text)}: it must be a whole number from 0 to {largest}")
        return int(text)


def shown(value: object) -> str:
    """A value as error messages quote it: short, and on one line."""
    if isinstance(value, dict | list):
        return "a list" if isinstance(value, list) else "an object"
    text = repr(value)
    return text if len(text) <= SHOWN else f"{text[: SHOWN - 3]}..."
