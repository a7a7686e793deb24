"""Missions as `QGC WPL 110`, the text format of Mission Planner, MAVProxy and QGroundControl.

Each item has a line; item 0 is the home, unless it is something other than a waypoint: some programs write no home.
Its fields, separated by tabs: number, whether it is the current item, frame, command, four parameters, latitude,
longitude, altitude, autocontinue. Lines that begin with # are comments.
"""

from __future__ import annotations

from collections.abc import Iterator, Set
from math import nan

from loiter.files.missions.items import Frame, MavCommand, Mission, MissionItem
from loiter.files.missions.limits import MAX_COMMAND, MAX_COUNT, check_home, checked_mission
from loiter.files.missions.references import renumbered
from loiter.files.reading import Source, shown

MARK = "QGC WPL"
HEADER = f"{MARK} 110"
FIELDS = 12
COMMAND = 3  # the field of the command, from 0

# The commands of a line of home; Mission Planner may write 0.
HOME_COMMANDS = {0, int(MavCommand.NAV_WAYPOINT)}
UNKNOWN_HOME = (nan, nan, nan)


def wpl(mission: Mission) -> bytes:
    """The file. The numbers have nine decimals: 0.1 mm in degrees."""
    home = MissionItem(MavCommand.NAV_WAYPOINT, Frame.ABOVE_SEA, (0.0, 0.0, 0.0, 0.0), *mission.home)
    lines = [_line(number, item) for number, item in enumerate((home, *mission.items))]
    return "\n".join([HEADER, *lines, ""]).encode()


def read_wpl(source: Source, text: str) -> Mission:
    """The mission in the text of a file. Raises `InvalidArgument`."""
    items = read_items(source, text)
    (where, first), *flown = items
    if first.command in HOME_COMMANDS:
        return checked_mission(source, flown, _home(source, where, first))
    # Without a line of home the items are counted from 0.
    counted = [(line, item._replace(params=renumbered(item.command, item.params, 1))) for line, item in items]
    return checked_mission(source, counted, UNKNOWN_HOME)


def read_items(source: Source, text: str) -> list[tuple[str, MissionItem]]:
    """All items in the text of a file, the first included, each with its line. Raises `InvalidArgument`."""
    return [
        (where, _numbered_item(source, where, sequence, fields))
        for sequence, (where, fields) in enumerate(_rows(source, text))
    ]


def read_home(source: Source, text: str) -> tuple[float, float, float]:
    """The home in the text of a file; nan if it has none. Raises `InvalidArgument`."""
    (where, fields), *_ = _rows(source, text)
    if not _has_command(fields, HOME_COMMANDS):
        return UNKNOWN_HOME
    return _home(source, where, _item(source, where, fields))


def items_of(source: Source, text: str, commands: Set[int]) -> Iterator[tuple[int, str, MissionItem]]:
    """The items of some commands, each with its number, where home is 0, and its line; other lines are passed over.

    Raises `InvalidArgument` for a file that has no items, and for an item of these commands that cannot be read.
    """
    rows = _rows(source, text)
    first = 0 if _has_command(rows[0][1], HOME_COMMANDS) else 1
    for number, (where, fields) in enumerate(rows, start=first):
        if _has_command(fields, commands):
            yield number, where, _item(source, where, fields)


def _rows(source: Source, text: str) -> list[tuple[str, list[str]]]:
    """The fields of each line after the first one, without comments and empty lines, with the line's number."""
    header, *lines = text.splitlines()
    if header.split() != HEADER.split():
        raise source.fault(f"its first line is {shown(header)}: it must be {HEADER}")
    numbered = [(f"line {number}", line.split()) for number, line in enumerate(lines, start=2)]
    rows = [(where, fields) for where, fields in numbered if fields and not fields[0].startswith("#")]
    if not rows:
        raise source.fault("it ends after its first line")
    return rows


def _has_command(fields: list[str], commands: Set[int]) -> bool:
    return len(fields) > COMMAND and fields[COMMAND] in set(map(str, commands))


def _home(source: Source, where: str, item: MissionItem) -> tuple[float, float, float]:
    home = item.latitude_deg, item.longitude_deg, item.altitude_m
    check_home(source, where, home)
    return home


def _line(number: int, item: MissionItem) -> str:
    numbers = (*item.params, item.latitude_deg, item.longitude_deg, item.altitude_m)
    integers = (number, int(number == 0), int(item.frame), int(item.command))
    fields = [*(f"{n:d}" for n in integers), *(f"{x:.9f}" for x in numbers)]
    return "\t".join([*fields, f"{int(item.autocontinue):d}"])


def _numbered_item(source: Source, where: str, sequence: int, fields: list[str]) -> MissionItem:
    """The item of a line, whose number must be `sequence`."""
    item = _item(source, where, fields)
    number = source.integer(f"{where}: the item's number", fields[0], MAX_COUNT)
    if number != sequence:
        raise source.fault(f"{where}: the item's number is {number}: it must be {sequence}, they count from 0")
    return item


def _item(source: Source, where: str, fields: list[str]) -> MissionItem:
    if len(fields) != FIELDS:
        raise source.fault(f"{where}: there are {len(fields)} fields: an item has {FIELDS}")
    _, current, frame_text, command_text, *numbers, autocontinue_text = fields
    source.integer(f"{where}: the mark of the current item", current, 1)
    frame = source.integer(f"{where}: the frame", frame_text, 255)
    command = source.integer(f"{where}: the command", command_text, MAX_COMMAND)
    # MAVProxy and pymavlink write "nan" for a parameter that is left to the autopilot.
    p1, p2, p3, p4, latitude, longitude, altitude = (
        nan if text.lower() == "nan" else source.number(f"{where}: a number", text) for text in numbers
    )
    autocontinue = source.integer(f"{where}: autocontinue", autocontinue_text, 1)
    return MissionItem(command, frame, (p1, p2, p3, p4), latitude, longitude, altitude, bool(autocontinue))
