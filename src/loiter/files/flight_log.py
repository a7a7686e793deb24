"""The log of a guided flight: a row for each step, as CSV while it flies, and its columns when it is read back."""

from __future__ import annotations

import csv
from math import isnan, nan
from pathlib import Path
from typing import NamedTuple, TextIO

from loiter.errors import InvalidArgument


class LogRow(NamedTuple):
    """A step of a guided flight: its column names and their order.

    Angles in degrees, distances in metres, local and relative to the circle as in `GuideReport`; `clock_s` is the time
    stamp of the autopilot. The last columns are the law's estimates and the circle.
    """

    time_s: float
    clock_s: float
    stage: str
    phase: str
    east_m: float
    north_m: float
    altitude_m: float
    heading_deg: float
    bank_deg: float
    velocity_east_m_s: float
    velocity_north_m_s: float
    airspeed_m_s: float
    command_deg: float
    time_to_join_s: float
    crosstrack_m: float
    outside_m: float
    rate_hz: float
    age_s: float
    roll_time_s: float
    roll_rate_deg_s: float
    delay_s: float
    turn_ratio: float
    course_lead_s: float
    wind_east_m_s: float
    wind_north_m_s: float
    orbit_east_m: float
    orbit_north_m: float
    orbit_radius_m: float
    turn: str


# The columns of text.
TEXTS = {"stage", "phase", "turn"}

# Digits after the point: tenths of a millimetre and of a millisecond.
DIGITS = 4


class LogWriter:
    """Writes rows to an open file; each row is handed to the operating system at once, so that none is lost."""

    def __init__(self, file: TextIO) -> None:
        self._file = file
        self._writer = csv.writer(file, lineterminator="\n")
        self._writer.writerow(LogRow._fields)

    def write(self, row: LogRow) -> None:
        """Append a row."""
        self._writer.writerow([_text(value) for value in row])
        self._file.flush()


def read_log(path: Path) -> dict[str, list[float] | list[str]]:
    """The columns of a CSV log by name; a last line that is incomplete is left out.

    Raises `InvalidArgument` for a file that cannot be read or is not such a log.
    """
    try:
        with path.open(newline="", encoding="utf-8") as file:
            header, *rows = csv.reader(file)
    except (OSError, ValueError, csv.Error) as error:
        raise InvalidArgument("replay", f"is {str(path)!r}: it cannot be read, {_reason(error)}") from error
    check_columns(path, header)
    rows = [row for row in rows if len(row) == len(header)]
    columns = zip(*rows, strict=True) if rows else [()] * len(header)
    return {
        name: list(column) if name in TEXTS else [_number(path, name, text) for text in column]
        for name, column in zip(header, columns, strict=True)
        if name in LogRow._fields
    }


def check_columns(path: Path, names: list[str]) -> None:
    """Raise `InvalidArgument` if a file lacks columns of a log."""
    missing = [name for name in LogRow._fields if name not in names]
    if missing:
        raise InvalidArgument(
            "replay", f"is {str(path)!r}: it is no log of loiter guide, the column {missing[0]} is missing"
        )


def _text(value: object) -> str:
    if not isinstance(value, float):
        return str(value)
    return "" if isnan(value) else f"{value:.{DIGITS}f}"


def _number(path: Path, name: str, text: str) -> float:
    try:
        return float(text) if text else nan
    except ValueError as error:
        raise InvalidArgument("replay", f"is {str(path)!r}: {name} is {text!r}, not a number") from error


def _reason(error: Exception) -> str:
    return getattr(error, "strerror", None) or (str(error) or "it is empty")
