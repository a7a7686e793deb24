"""The aircraft of a fleet: a small CSV file with their poses, or with the connections to vehicles in flight.

The columns of poses have the names and units of tables of states.
"""

from __future__ import annotations

import csv
from collections.abc import Mapping
from pathlib import Path
from typing import NamedTuple, TypeVar

from loiter.errors import InvalidArgument
from loiter.files.columns import (
    ENTRY,
    HEADING,
    LOCAL,
    PLACE,
    POSE,
    MappedColumn,
    likely_column,
    mapped_columns,
    separator_hint,
)
from loiter.planning.units import parse_number

# The column with the names of the aircraft; without one they are numbered from 1.
NAME = "name"

# The columns with the connection to a vehicle and its system number, which may be absent or empty.
CONNECT, SYSTEM = "connect", "system"

# The largest system number of MAVLink.
MOST_SYSTEMS = 255

# A name becomes part of the names of files.
FORBIDDEN = frozenset('/\\:*?"<>|')


class FleetRow(NamedTuple):
    """An aircraft: its name, its position, east and north in metres or latitude and longitude, and its heading."""

    name: str
    first: float
    second: float
    heading_deg: float


class FleetVehicle(NamedTuple):
    """A vehicle in flight: its name, its connection as `loiter guide --connect` takes it, and its system number."""

    name: str
    connection: str
    system: int | None = None


AnyRow = TypeVar("AnyRow", FleetRow, FleetVehicle)


class FleetTable(NamedTuple):
    """The aircraft of a fleet; with `is_placed` their positions are WGS84 degrees, and headings true."""

    rows: tuple[FleetRow, ...]
    is_placed: bool


def read_fleet(path: Path, columns: Mapping[str, str]) -> FleetTable:
    """The aircraft in a CSV file: columns east_m, north_m and heading_deg, or latitude_deg and longitude_deg.

    `columns` maps quantities to columns with other names or units, as in `batch.run`; a column `name` is optional.
    Raises `InvalidArgument` for a file that cannot be read or is no such table.
    """
    names, records = _records(path)
    mapped, is_placed = _columns(path, names, columns)
    rows = [_row(path, line, fields, mapped) for line, fields in records]
    return FleetTable(_named(path, rows), is_placed)


def read_connections(path: Path) -> tuple[FleetVehicle, ...]:
    """The vehicles in a CSV file: a column connect and, if wanted, name and system.

    Raises `InvalidArgument` for a file that cannot be read or is no such table.
    """
    names, records = _records(path)
    if CONNECT not in names:
        raise _fault(path, f"it has no column {CONNECT}: each vehicle has its connection there{separator_hint(names)}")
    for name in names:
        if name not in (NAME, CONNECT, SYSTEM):
            raise _fault(path, f"it has a column {name}: those of vehicles are {NAME}, {CONNECT} and {SYSTEM}")
    return _named(path, [_connected(path, line, fields) for line, fields in records])


def _connected(path: Path, line: int, fields: Mapping[str, str]) -> FleetVehicle:
    connection, system = fields[CONNECT].strip(), fields.get(SYSTEM, "").strip()
    if not connection:
        raise _fault(path, f"line {line} has no connection")
    if system and not (system.isdecimal() and 1 <= int(system) <= MOST_SYSTEMS):
        raise _fault(path, f"line {line} has the system {system!r}: it is a number from 1 to {MOST_SYSTEMS}")
    return FleetVehicle(fields.get(NAME, "").strip(), connection, int(system) if system else None)


def _records(path: Path) -> tuple[list[str], list[tuple[int, dict[str, str]]]]:
    """The names of the columns, and each row with its line; raises `InvalidArgument` for what is no such table."""
    try:
        with path.open(encoding="utf-8-sig", newline="") as file:
            lines = [(reader.line_num, record) for reader in [csv.reader(file, strict=True)] for record in reader]
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        cause = (error.strerror or str(error)) if isinstance(error, OSError) else f"it is no CSV file, {error}"
        raise _fault(path, f"it cannot be read, {cause}") from error
    (_, header), *records = [(number, record) for number, record in lines if record] or [(1, [])]
    names = [name.strip() for name in header]
    for name in names:
        if names.count(name) > 1:
            raise _fault(path, f"it has two columns {name!r}")
    for line, record in records:
        if len(record) != len(names):
            raise _fault(path, f"line {line} has {len(record)} fields, the header {len(names)}{separator_hint(names)}")
    if names and not records:
        raise _fault(path, "it has no rows: each aircraft is one")
    return names, [(line, dict(zip(names, record, strict=True))) for line, record in records]


def _fault(path: Path, problem: str) -> InvalidArgument:
    return InvalidArgument("table", f"is {str(path)!r}: {problem}")


def _columns(path: Path, names: list[str], given: Mapping[str, str]) -> tuple[list[MappedColumn], bool]:
    """The columns of the position and the heading, and whether positions are in degrees."""
    mapped = mapped_columns(names, given)
    is_placed = all(name in mapped for name in PLACE)
    if is_placed and all(name in mapped for name in LOCAL):
        raise _fault(path, f"it has the columns {LOCAL[0]} and {PLACE[0]}: positions are in metres or in degrees")
    wanted = (*PLACE, HEADING) if is_placed or any(name in mapped for name in PLACE) else POSE
    for name in wanted:
        if name not in mapped:
            likely = likely_column(name, names)
            hint = separator_hint(names) or (f"; if {likely!r} is it, give --map {name}={likely!r}" if likely else "")
            raise _fault(path, f"it has no column {name}: it needs {', '.join(wanted)}{hint}")
    for name, column in mapped.items():
        if name in ENTRY and name not in (*POSE, *PLACE):
            raise _fault(
                path, f"it has a column {column.name}, but all aircraft of a fleet share that: give the option"
            )
    return [mapped[name] for name in wanted], is_placed


def _row(path: Path, line: int, fields: Mapping[str, str], mapped: list[MappedColumn]) -> FleetRow:
    first, second, heading_deg = (_number(path, line, fields[column.name], column) for column in mapped)
    return FleetRow(fields.get(NAME, "").strip(), first, second, heading_deg)


def _number(path: Path, line: int, text: str, column: MappedColumn) -> float:
    try:
        return parse_number(text.strip()) * column.factor
    except ValueError:
        raise _fault(
            path, f"line {line} has {text.strip()!r} in the column {column.name}, which is no number"
        ) from None


def _named(path: Path, rows: list[AnyRow]) -> tuple[AnyRow, ...]:
    """Rows in which those without a name have their number; raises `InvalidArgument` for names that cannot be used."""
    named = tuple(row._replace(name=row.name or str(i)) for i, row in enumerate(rows, 1))
    names = [row.name for row in named]
    for name in names:
        if names.count(name) > 1:
            raise _fault(path, f"two aircraft have the name {name!r}")
        if FORBIDDEN & set(name) or not name.isprintable() or name.startswith("."):
            raise _fault(path, f"the name {name!r} cannot be part of the name of a file")
    return named
