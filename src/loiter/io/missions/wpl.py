"""Missions as `QGC WPL 110`, the text of Mission Planner, MAVProxy and QGroundControl.

A line for each item, item 0 being the home: number, whether it is current, frame, command, four parameters, latitude,
longitude, altitude, autocontinue; tabs between them.
"""

from __future__ import annotations

from math import nan

from loiter.io.missions.items import Command, Frame, Mission, MissionItem
from loiter.io.missions.limits import MAX_COMMAND, MAX_COUNT, check_place, checked_item, checked_mission
from loiter.io.reading import Source, shown

MARK = "QGC WPL"
HEADER = f"{MARK} 110"
FIELDS = 12


def wpl(mission: Mission) -> bytes:
    """The file. The numbers have nine decimals: 0.1 mm in degrees."""
    home = MissionItem(Command.NAV_WAYPOINT, Frame.ABOVE_SEA, (0.0, 0.0, 0.0, 0.0), *mission.home)
    lines = [_line(number, item) for number, item in enumerate((home, *mission.items))]
    return "\n".join([HEADER, *lines, ""]).encode()


def read_wpl(source: Source, text: str) -> Mission:
    """The mission in the text of a file. Raises `InvalidArgument`."""
    header, *lines = text.splitlines()
    if header.split() != HEADER.split():
        raise source.fault(f"its first line is {shown(header)}: it must be {HEADER}")
    rows = [(number, line.split()) for number, line in enumerate(lines, start=2) if line.strip()]
    if not rows:
        raise source.fault("it ends after its first line")
    items = [_item(source, line, sequence, fields) for sequence, (line, fields) in enumerate(rows)]
    home, *flown = items
    check_place(source, f"line {rows[0][0]}", *home[3:6])
    flown = [checked_item(source, f"line {row[0]}", item) for row, item in zip(rows[1:], flown, strict=True)]
    return checked_mission(source, Mission(tuple(flown), home[3:6]))


def _line(number: int, item: MissionItem) -> str:
    numbers = (*item.params, item.latitude_deg, item.longitude_deg, item.altitude_m)
    fields = [number, int(number == 0), int(item.frame), int(item.command), *(f"{x:.9f}" for x in numbers)]
    return "\t".join(map(str, [*fields, int(item.autocontinue)]))


def _item(source: Source, line: int, sequence: int, fields: list[str]) -> MissionItem:
    where = f"line {line}"
    if len(fields) != FIELDS:
        raise source.fault(f"{where}: there are {len(fields)} fields: an item has {FIELDS}")
    number = source.integer(f"{where}: the item's number", fields[0], MAX_COUNT)
    if number != sequence:
        raise source.fault(f"{where}: the item's number is {number}: it must be {sequence}, they count from 0")
    source.integer(f"{where}: the mark of the current item", fields[1], 1)
    frame = source.integer(f"{where}: the frame", fields[2], 255)
    command = source.integer(f"{where}: the command", fields[3], MAX_COMMAND)
    # MAVProxy and pymavlink write nan, the autopilot's own, so; a place has to be one.
    a, b, c, d = (nan if text.lower() == "nan" else source.number(f"{where}: a number", text) for text in fields[4:8])
    latitude, longitude, altitude = (source.number(f"{where}: a number", text) for text in fields[8:11])
    autocontinue = source.integer(f"{where}: autocontinue", fields[11], 1)
    return MissionItem(command, frame, (a, b, c, d), latitude, longitude, altitude, bool(autocontinue))
