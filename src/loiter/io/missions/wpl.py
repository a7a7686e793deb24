"""Missions as `QGC WPL 110`, the text format of Mission Planner, MAVProxy and QGroundControl.

Each item has a line; item 0 is the home. Its fields, separated by tabs: number, whether it is the current item, frame,
command, four parameters, latitude, longitude, altitude, autocontinue.
"""

from __future__ import annotations

from math import nan

from loiter.io.missions.items import Frame, MavCommand, Mission, MissionItem
from loiter.io.missions.limits import MAX_COMMAND, MAX_COUNT, check_place, checked_item, checked_mission
from loiter.io.reading import Source, shown

MARK = "QGC WPL"
HEADER = f"{MARK} 110"
FIELDS = 12


def wpl(mission: Mission) -> bytes:
    """The file. The numbers have nine decimals: 0.1 mm in degrees."""
    home = MissionItem(MavCommand.NAV_WAYPOINT, Frame.ABOVE_SEA, (0.0, 0.0, 0.0, 0.0), *mission.home)
    lines = [_line(number, item) for number, item in enumerate((home, *mission.items))]
    return "\n".join([HEADER, *lines, ""]).encode()


def read_wpl(source: Source, text: str) -> Mission:
    """The mission in the text of a file. Raises `InvalidArgument`."""
    (home_line, home), *flown = read_items(source, text)
    home_place = home.latitude_deg, home.longitude_deg, home.altitude_m
    check_place(source, home_line, *home_place)
    return checked_mission(source, Mission(tuple(checked_item(source, *item) for item in flown), home_place))


def read_items(source: Source, text: str) -> list[tuple[str, MissionItem]]:
    """All items in the text of a file, the first included, each with its line. Raises `InvalidArgument`."""
    header, *lines = text.splitlines()
    if header.split() != HEADER.split():
        raise source.fault(f"its first line is {shown(header)}: it must be {HEADER}")
    rows = [(f"line {number}", line.split()) for number, line in enumerate(lines, start=2) if line.strip()]
    if not rows:
        raise source.fault("it ends after its first line")
    return [(where, _item(source, where, sequence, fields)) for sequence, (where, fields) in enumerate(rows)]


def _line(number: int, item: MissionItem) -> str:
    numbers = (*item.params, item.latitude_deg, item.longitude_deg, item.altitude_m)
    integers = (number, int(number == 0), int(item.frame), int(item.command))
    fields = [*(f"{n:d}" for n in integers), *(f"{x:.9f}" for x in numbers)]
    return "\t".join([*fields, f"{int(item.autocontinue):d}"])


def _item(source: Source, where: str, sequence: int, fields: list[str]) -> MissionItem:
    if len(fields) != FIELDS:
        raise source.fault(f"{where}: there are {len(fields)} fields: an item has {FIELDS}")
    number_text, current, frame_text, command_text, *numbers, autocontinue_text = fields
    number = source.integer(f"{where}: the item's number", number_text, MAX_COUNT)
    if number != sequence:
        raise source.fault(f"{where}: the item's number is {number}: it must be {sequence}, they count from 0")
    source.integer(f"{where}: the mark of the current item", current, 1)
    frame = source.integer(f"{where}: the frame", frame_text, 255)
    command = source.integer(f"{where}: the command", command_text, MAX_COMMAND)
    # MAVProxy and pymavlink write "nan" for a parameter that is left to the autopilot; a place must have numbers.
    p1, p2, p3, p4 = (
        nan if text.lower() == "nan" else source.number(f"{where}: a number", text) for text in numbers[:4]
    )
    latitude, longitude, altitude = (source.number(f"{where}: a number", text) for text in numbers[4:])
    autocontinue = source.integer(f"{where}: autocontinue", autocontinue_text, 1)
    return MissionItem(command, frame, (p1, p2, p3, p4), latitude, longitude, altitude, bool(autocontinue))
