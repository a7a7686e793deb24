"""Missions as QGroundControl's .plan files (docs.qgroundcontrol.com, Plan File Format): JSON, version 1.

A DO_JUMP item of a plan names its target by `doJumpId`; that is converted to an item number, where home is item 0.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Set
from math import isfinite, isnan, nan
from typing import Any

from loiter.errors import as_float
from loiter.files.missions.items import Autopilot, Frame, Mission, MissionItem
from loiter.files.missions.limits import MAX_COMMAND, check_home, checked_mission
from loiter.files.missions.references import DO_JUMP
from loiter.files.reading import Source, shown

FIXED_WING = 1  # MAV_TYPE_FIXED_WING

LONGEST_INTEGER = 20

# The types of GeoJSON's objects that are not geometries, and of geometries that may be zones.
GEOJSON = {"FeatureCollection", "Feature", "GeometryCollection", "Polygon", "MultiPolygon", "LineString", "Point"}

# QGroundControl's AltitudeMode of each frame; 0 means that the items of a plan differ.
ALTITUDE_MODES = {Frame.ABOVE_SEA: 2, Frame.ABOVE_HOME: 1, Frame.ABOVE_TERRAIN: 4}


NO_FENCE: dict[str, Any] = {"circles": [], "polygons": [], "version": 2}


def qgcplan(mission: Mission, autopilot: Autopilot, airspeed_m_s: float, fence: dict[str, Any] | None = None) -> bytes:
    """The file. `airspeed_m_s` is the cruise speed from which QGroundControl computes the duration of the mission.

    `fence` is the geoFence of another plan, which is kept as it is.
    """
    document = {
        "fileType": "Plan",
        "version": 1,
        "groundStation": "QGroundControl",
        "geoFence": NO_FENCE if fence is None else fence,
        "rallyPoints": {"points": [], "version": 2},
        "mission": {
            "version": 2,
            "firmwareType": int(autopilot),
            "vehicleType": FIXED_WING,
            "cruiseSpeed": airspeed_m_s,
            "hoverSpeed": airspeed_m_s,
            "globalPlanAltitudeMode": _common_mode(mission),
            "plannedHomePosition": list(mission.home),
            "items": [_written(number, item) for number, item in enumerate(mission.items, start=1)],
        },
    }
    return json.dumps(document, indent=4, allow_nan=False).encode() + b"\n"


def read_qgcplan(source: Source, text: str) -> Mission:
    """The mission in the text of a file. Raises `InvalidArgument`."""
    document = read_document(source, text)
    home = read_home(source, document)
    numbered_items = [_item(source, f"item {number}", item) for number, item in _items(source, document)]
    return checked_mission(source, _with_jump_targets(source, numbered_items), home)


def read_document(source: Source, text: str) -> dict[str, Any]:
    """The JSON document of a plan, with a mission, in versions that are known. Raises `InvalidArgument`."""
    document = read_plan(source, text)
    mission = kind(source, "mission", document.get("mission"), dict, "an object")
    check_version(source, "the version of mission", mission, 2)
    return document


def read_plan(source: Source, text: str) -> dict[str, Any]:
    """The JSON document of a plan, whatever it has in it. Raises `InvalidArgument`."""
    document = _parsed(source, text)
    if "fileType" not in document:
        what = "it is GeoJSON" if document.get("type") in GEOJSON else "it has no fileType"
        raise source.fault(f"it is no plan of QGroundControl: {what}")
    if document.get("fileType") != "Plan":
        raise source.fault(f"fileType is {shown(document.get('fileType'))}: it must be 'Plan'")
    check_version(source, "version", document, 1)
    return document


def read_home(source: Source, document: dict[str, Any]) -> tuple[float, float, float]:
    """The planned home: latitude and longitude, degrees, metres above the sea; nan for what is null or missing.

    Raises `InvalidArgument`.
    """
    where, home = "plannedHomePosition", document["mission"].get("plannedHomePosition")
    latitude, longitude, altitude = _optional_numbers(source, where, [None] * 3 if home is None else home, 3)
    check_home(source, where, (latitude, longitude, altitude))
    return latitude, longitude, altitude


def items_of(source: Source, document: dict[str, Any], commands: Set[int]) -> Iterator[tuple[int, str, MissionItem]]:
    """The simple items of some commands, each with its number and its place in the file; others are passed over.

    Raises `InvalidArgument` for a plan without a list of items, and for an item of these commands that cannot be read.
    """
    for number, item in _items(source, document):
        if isinstance(item, dict) and item.get("type") == "SimpleItem" and item.get("command") in commands:
            where = f"item {number}"
            yield number, where, _item(source, where, item)[1]


def complex_items(document: dict[str, Any]) -> Iterator[str]:
    """The items of a plan that are not simple, in words: "item 2, 'survey'"."""
    for number, item in enumerate(document["mission"]["items"], start=1):
        if isinstance(item, dict) and item.get("type") != "SimpleItem":
            yield f"item {number}, {shown(item.get('complexItemType', item.get('type')))}"


def _items(source: Source, document: dict[str, Any]) -> Iterator[tuple[int, Any]]:
    return enumerate(kind(source, "items", document["mission"].get("items"), list, "a list"), start=1)


def _common_mode(mission: Mission) -> int:
    """The AltitudeMode that all items with a place share, or 0."""
    frames = {item.frame for item in mission.items if item.frame != Frame.NOWHERE}
    return ALTITUDE_MODES[Frame(frames.pop())] if len(frames) == 1 else 0


def _written(number: int, one: MissionItem) -> dict[str, Any]:
    numbers = (*one.params, one.latitude_deg, one.longitude_deg, one.altitude_m)
    params = [None if isnan(value) else value for value in numbers]
    return {
        "AMSLAltAboveTerrain": None,
        "Altitude": params[-1],
        "AltitudeMode": ALTITUDE_MODES.get(Frame(one.frame), 0),
        "autoContinue": one.autocontinue,
        "command": int(one.command),
        "doJumpId": number,
        "frame": int(one.frame),
        "params": params,
        "type": "SimpleItem",
    }


def _parsed(source: Source, text: str) -> dict[str, Any]:
    """The JSON object in a file; repeated keys, nan and infinity are refused."""

    def unique_keys(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
        keys = [key for key, _ in pairs]
        twice = next((key for key in keys if keys.count(key) > 1), None) if len(set(keys)) < len(keys) else None
        if twice is not None:
            raise source.fault(f"the key {shown(twice)} occurs twice in one object")
        return dict(pairs)

    def refuse(word: str) -> float:
        raise source.fault(f"{word} is not a number in JSON")

    def to_integer(digits: str) -> float:
        # Python refuses to read integers of thousands of digits; as a float such a number is infinite.
        return int(digits) if len(digits) <= LONGEST_INTEGER else float(digits)

    try:
        document = json.loads(text, object_pairs_hook=unique_keys, parse_constant=refuse, parse_int=to_integer)
    except json.JSONDecodeError as error:
        raise source.fault(f"it is not JSON, {error.msg.lower()} in line {error.lineno}") from error
    except RecursionError as error:
        raise source.fault("its lists and objects are nested too deeply") from error
    checked: dict[str, Any] = kind(source, "its JSON", document, dict, "an object")
    return checked


def kind(source: Source, where: str, value: Any, type_: type, wanted: str) -> Any:
    """The value, if it is of a type; `InvalidArgument`, which names the place, otherwise."""
    if not isinstance(value, type_):
        raise source.fault(f"{where} is {shown(value)}: it must be {wanted}")
    return value


def check_version(source: Source, where: str, document: dict[str, Any], wanted: int) -> None:
    """Raise `InvalidArgument`, which names the place, for another version than the one that is read."""
    version = document.get("version")
    if isinstance(version, bool) or version != wanted:
        raise source.fault(f"{where} is {shown(version)}: only {wanted} is read")


def numbers(source: Source, where: str, value: Any, count: int) -> list[float]:
    """A list of finite numbers; `InvalidArgument`, which names the place, otherwise."""
    if not isinstance(value, list) or len(value) != count:
        raise source.fault(f"{where} is not a list of {count} numbers")
    return [number(source, where, one) for one in value]


def _optional_numbers(source: Source, where: str, value: Any, count: int) -> list[float]:
    """A list of finite numbers or nulls, which are nan; `InvalidArgument`, which names the place, otherwise."""
    if not isinstance(value, list) or len(value) != count:
        raise source.fault(f"{where} is not a list of {count} numbers")
    return [nan if one is None else number(source, where, one) for one in value]


def number(source: Source, where: str, value: Any) -> float:
    """A finite number; `InvalidArgument`, which names the place, otherwise."""
    found = as_float(value)
    if not isfinite(found):
        raise source.fault(f"{where} has {shown(value)}: it must be a finite number")
    return found


def _integer(source: Source, where: str, value: Any, largest: int) -> int:
    if isinstance(value, bool) or not isinstance(value, int) or not 0 <= value <= largest:
        raise source.fault(f"{where} is {shown(value)}: it must be a whole number from 0 to {largest}")
    return value


def _item(source: Source, where: str, value: Any) -> tuple[int | None, MissionItem]:
    """An item and its `doJumpId`."""
    item = kind(source, where, value, dict, "an object")
    if item.get("type") != "SimpleItem":
        what = item.get("complexItemType", item.get("type"))
        raise source.fault(f"{where} is {shown(what)}: only simple items are read; save the plan as waypoints")
    command = _integer(source, f"{where}: command", item.get("command"), MAX_COMMAND)
    frame = _integer(source, f"{where}: frame", item.get("frame"), 255)
    autocontinue = kind(source, f"{where}: autoContinue", item.get("autoContinue"), bool, "true or false")
    # null leaves the choice to the autopilot.
    p1, p2, p3, p4, latitude, longitude, altitude = _optional_numbers(source, f"{where}: params", item.get("params"), 7)
    jump = item.get("doJumpId")
    jump_id = None if jump is None else _integer(source, f"{where}: doJumpId", jump, MAX_COMMAND)
    return jump_id, MissionItem(command, frame, (p1, p2, p3, p4), latitude, longitude, altitude, autocontinue)


def _with_jump_targets(source: Source, items: list[tuple[int | None, MissionItem]]) -> list[tuple[str, MissionItem]]:
    """The items and their places in the file; the `doJumpId` in each DO_JUMP is the number of the item that has it."""
    numbers: dict[float, int] = {}
    for number, (jump_id, _) in enumerate(items, start=1):
        if jump_id is not None and numbers.setdefault(jump_id, number) != number:
            raise source.fault(f"item {number}: doJumpId is {jump_id}, as of item {numbers[jump_id]}")
    return [
        (f"item {number}", item if item.command != DO_JUMP else _with_jump_target(source, number, item, numbers))
        for number, (_, item) in enumerate(items, start=1)
    ]


def _with_jump_target(source: Source, number: int, item: MissionItem, numbers: dict[float, int]) -> MissionItem:
    jump_id, p2, p3, p4 = item.params
    target = numbers.get(jump_id)
    if target is None:
        raise source.fault(f"item {number}: it jumps to doJumpId {jump_id:g}: no item has it")
    return item._replace(params=(float(target), p2, p3, p4))
