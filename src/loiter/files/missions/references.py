"""Parameters of mission items that are the numbers of other items, as in DO_JUMP.

Files and ArduPilot count home as item 0. PX4 has no home: its first item is item 0.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import isfinite

from loiter.files.missions.items import MissionItem
from loiter.files.missions.signs import Params

# The parameter, from 1, with the number of an item: MAVLink's MAV_CMD. A region of interest has one if its parameter 1
# is `ROI_OF_ITEM` (MAV_ROI_WPINDEX). DO_JUMP_TAG refers to a JUMP_TAG by its name, which does not count items.
DO_JUMP, DO_SET_MISSION_CURRENT, NAV_ROI, DO_SET_ROI = 177, 224, 80, 201
NUMBERS = {DO_JUMP: 1, DO_SET_MISSION_CURRENT: 1, NAV_ROI: 2, DO_SET_ROI: 2}
ROI_OF_ITEM = 2.0

# The item that is flown at present, in DO_SET_MISSION_CURRENT.
PRESENT = -1.0


def reference(command: int, params: Params) -> float | None:
    """The number of the item to which a command with these parameters refers; None if it refers to none."""
    parameter = NUMBERS.get(command)
    if parameter is None or (command in {NAV_ROI, DO_SET_ROI} and params[0] != ROI_OF_ITEM):
        return None
    number = params[parameter - 1]
    return None if command == DO_SET_MISSION_CURRENT and number == PRESENT else number


def renumbered(command: int, params: Params, added: int) -> Params:
    """The parameters of a command, where the number of an item, if they have one, is larger by `added`."""
    number = reference(command, params)
    if number is None or not isfinite(number):
        return params
    new = list(params)
    new[NUMBERS[command] - 1] = number + added
    first, second, third, fourth = new
    return first, second, third, fourth


def dangling_reference(items: Sequence[MissionItem]) -> tuple[int, str] | None:
    """The index of the first item that refers to an item that does not exist, and that in words; None without one.

    The items of a mission are counted from 1: home cannot be flown to again.
    """
    for index, item in enumerate(items):
        number = reference(item.command, item.params)
        if number is not None and number not in range(1, len(items) + 1):
            verb = "jumps" if item.command == DO_JUMP else "refers"
            return index, f"it {verb} to item {number:g}: the mission has items 1 to {len(items)}"
    return None
