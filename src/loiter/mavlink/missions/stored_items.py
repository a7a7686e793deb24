"""Items as they are on the wire, and what autopilots make of those that they store.

What is said of ArduPilot is read from `AP_Mission::mavlink_int_to_mission_cmd` and `mission_cmd_to_mavlink_int`, which
keep 15 bytes an item and cut values to fit; what is said of PX4 from `parse_mavlink_mission_item` and
`format_mavlink_mission_item` of its mavlink_mission.cpp. Both for aeroplanes.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import copysign, isfinite, isinf, isnan, nan, trunc
from struct import error as StructError  # noqa: N812
from struct import pack, unpack
from typing import Any, NamedTuple

from loiter.errors import InvalidArgument
from loiter.io.missions.items import Autopilot, Command, Frame, Mission, MissionItem
from loiter.mavlink.connection.link import Vehicle, packets

# The MAV_FRAMEs in which x and y are latitude and longitude, and the twin of each: PX4 answers with those whose names
# end in INT.
_TWINS = {0: 0, 3: 3, 10: 10, 5: 0, 6: 3, 11: 10}
PER_DEGREE = 1e7

# MISSION_COUNT has 16 bits.
MOST_ITEMS = 65535

# ArduPilot cuts an altitude to centimetres, with some rounding of float32 numbers around; PX4 turns a heading into
# radians and back.
_ALTITUDE_M, _HEADING_DEG = 0.015, 1e-4

Params = tuple[float, float, float, float]


class StoredItem(NamedTuple):
    """An item as MISSION_ITEM_INT carries it: parameters and z are float32 numbers, x and y are int32."""

    frame: int
    command: int
    current: int
    autocontinue: int
    params: Params
    x: int
    y: int
    z: float


def encoded(mission: Mission, vehicle: Vehicle, own_home: StoredItem | None = None) -> list[StoredItem]:
    """What is sent to a vehicle for a mission; ArduPilot's item 0 is the home: its own where known, or the mission's.

    Raises `InvalidArgument` for a mission without items and for numbers that MAVLink cannot carry.
    """
    if not mission.items:
        raise InvalidArgument("mission", "has no items")
    first = int(keeps_home(vehicle))
    if first + len(mission.items) > MOST_ITEMS:
        count = first + len(mission.items)
        raise InvalidArgument("mission", f"has {count} items: MAVLink counts no further than {MOST_ITEMS}")
    items = [_encoded(item, seq, called(seq, vehicle)) for seq, item in enumerate(mission.items, start=first)]
    return [own_home or _home(mission, vehicle), *items] if first else items


def own_home(items: Sequence[StoredItem], vehicle: Vehicle) -> StoredItem | None:
    """The home among the items that a vehicle holds; None where there is none, or it is not set: 0 N 0 E."""
    if not keeps_home(vehicle) or not items or items[0].x == items[0].y == 0:
        return None
    return items[0]._replace(current=1)


def above_sea_m(item: StoredItem, home_altitude_m: float) -> float:
    """The altitude of an item above the sea, metres; nan where it is above something whose altitude is not known."""
    match _TWINS.get(item.frame):
        case Frame.ABOVE_SEA:
            return item.z
        case Frame.ABOVE_HOME:
            return item.z + home_altitude_m
    return nan


def decoded(items: Sequence[StoredItem], vehicle: Vehicle) -> Mission:
    """The mission that a vehicle holds; the home is nan where it does not stand among the items."""
    flown = tuple(map(_decoded, items))
    if not keeps_home(vehicle) or not flown:
        return Mission(flown, (nan, nan, nan))
    home = flown[0]
    return Mission(flown[1:], (home.latitude_deg, home.longitude_deg, home.altitude_m))


def keeps_home(vehicle: Vehicle) -> bool:
    """Whether item 0 is the home, which the vehicle sets by itself."""
    return vehicle.autopilot == Autopilot.ARDUPILOT


def called(seq: int, vehicle: Vehicle) -> str:
    """An item in sentences: the first to be flown is item 1."""
    if not keeps_home(vehicle):
        return f"item {seq + 1}"
    return f"item {seq}" if seq else "the home"


def packet(item: StoredItem, seq: int, vehicle: Vehicle) -> Any:
    """The MISSION_ITEM_INT that brings an item to a vehicle."""
    head = vehicle.system, vehicle.component, seq, item.frame, item.command, item.current, item.autocontinue
    return packets().MAVLink_mission_item_int_message(*head, *item.params, item.x, item.y, item.z, 0)


def unpacked(message: Any) -> StoredItem:
    """The item of a MISSION_ITEM_INT."""
    head = message.frame, message.command, message.current, message.autocontinue
    params = message.param1, message.param2, message.param3, message.param4
    return StoredItem(*head, params, message.x, message.y, message.z)


def compared(sent: Sequence[StoredItem], kept: Sequence[StoredItem], vehicle: Vehicle) -> tuple[list[str], list[str]]:
    """In words, where a vehicle keeps something else than it was sent: what is wrong, and what its autopilot cuts.

    ArduPilot's home is its own affair, and which item is the current one that of every vehicle.
    """
    wrong: list[str] = []
    cut: list[str] = []
    if len(sent) != len(kept):
        return [f"it keeps {len(kept)} items of {len(sent)}"], cut
    for seq in range(int(keeps_home(vehicle)), len(sent)):
        may = _fields(_as_stored(sent[seq], vehicle))
        was, now = _fields(sent[seq]), _fields(kept[seq])
        for name in was:
            if not _equal(was[name], now[name]):
                expected = _equal(may[name], now[name], _tolerance(name, vehicle))
                said = f"{called(seq, vehicle)} has {now[name]:.9g} for {name}, not {was[name]:.9g}"
                (cut if expected else wrong).append(said)
    return wrong, cut


def same(some: Sequence[StoredItem], others: Sequence[StoredItem], vehicle: Vehicle) -> bool:
    """Whether two missions that a vehicle gave are one and the same, but for what its autopilot rounds."""
    wrong, _ = compared(some, others, vehicle)
    return not wrong


def _home(mission: Mission, vehicle: Vehicle) -> StoredItem:
    item = MissionItem(Command.NAV_WAYPOINT, Frame.ABOVE_SEA, (0.0, 0.0, 0.0, 0.0), *mission.home)
    return _encoded(item, 0, called(0, vehicle))


def _encoded(item: MissionItem, seq: int, name: str) -> StoredItem:
    if any(map(isinf, (*item.params, item.altitude_m))):
        raise InvalidArgument("mission", f"has an infinite number in {name}: {item}")
    try:
        x, y = _place(item, name)
        p1, p2, p3, p4, z = map(_float32, (*item.params, item.altitude_m))
        # What does not fit is found here, not halfway through a transfer.
        frame, command, *_ = unpack("<BH2i", pack("<BH2i", item.frame, item.command, x, y))
    except (StructError, OverflowError) as error:
        raise InvalidArgument("mission", f"has a number that is too large for MAVLink in {name}: {item}") from error
    return StoredItem(frame, command, int(seq == 0), int(item.autocontinue), (p1, p2, p3, p4), x, y, z)


def _place(item: MissionItem, name: str) -> tuple[int, int]:
    """Latitude and longitude in 1e-7 degrees; what an item without a place has instead, as it is, nan as 0."""
    lat, lon = item.latitude_deg, item.longitude_deg
    if item.frame not in _TWINS:
        return round(lat if isfinite(lat) else 0.0), round(lon if isfinite(lon) else 0.0)
    if not (abs(lat) <= 90.0 and abs(lon) <= 360.0):
        raise InvalidArgument("mission", f"has no place on Earth in {name}: {lat:g} {lon:g}")
    if abs(lon) > 180.0:
        lon -= copysign(360.0, lon)
    return round(lat * PER_DEGREE), round(lon * PER_DEGREE)


def _decoded(item: StoredItem) -> MissionItem:
    scale = PER_DEGREE if item.frame in _TWINS else 1.0
    place = item.x / scale, item.y / scale, item.z
    return MissionItem(item.command, _TWINS.get(item.frame, item.frame), item.params, *place, bool(item.autocontinue))


def _fields(item: StoredItem) -> dict[str, float]:
    """What has to come back, by name."""
    params = {f"parameter {i}": value for i, value in enumerate(item.params, 1)}
    frame = _TWINS.get(item.frame, item.frame)
    place = {"x": item.x, "y": item.y, "altitude": item.z}
    return {"command": item.command, "frame": frame, **params, **place, "autocontinue": item.autocontinue}


def _as_stored(item: StoredItem, vehicle: Vehicle) -> StoredItem:
    """What the autopilot of a vehicle makes of an item, as far as it is known."""
    if vehicle.autopilot == Autopilot.ARDUPILOT:
        return item._replace(params=_ardupilot(item.command, item.params), autocontinue=1)
    if vehicle.autopilot == Autopilot.PX4 and item.frame in _TWINS:
        return item._replace(params=_px4(item.command, item.params))
    return item


def _ardupilot(command: int, params: Params) -> Params:
    a, b, c, d = params
    match command:
        case Command.NAV_WAYPOINT:
            return 0.0, min(_whole(b), 255.0), min(_whole(c), 255.0), 0.0
        case Command.NAV_LOITER_UNLIM:
            return 0.0, 0.0, _whole(c), 0.0
        case Command.NAV_LOITER_TURNS:
            # A byte for the radius, in tens of metres above 255; one for the turns, in 256ths of a turn below 1.
            radius = abs(c) if abs(c) <= 255.0 else 10.0 * min(_whole(abs(c) * 0.1), 255.0)
            turns = _whole(256.0 * a) / 256.0 if 0.0 < a < 1.0 else min(_whole(a), 255.0)
            return turns, 0.0, copysign(_whole(radius), c), float(d > 0.0)
        case Command.NAV_LOITER_TIME:
            return _whole(a), 0.0, -1.0 if c < 0.0 else 1.0, float(d > 0.0)
        case Command.NAV_LOITER_TO_ALT:
            return 0.0, _whole(b), 0.0, float(d > 0.0)
    return params


def _px4(command: int, params: Params) -> Params:
    a, b, c, d = params
    match command:
        case Command.NAV_WAYPOINT:
            return a, b, 0.0, d % 360.0
        case Command.NAV_LOITER_UNLIM:
            return 0.0, 0.0, c, d % 360.0
        case Command.NAV_LOITER_TIME:
            return a, float(b > 0.0), c, float(d > 0.0)
        case Command.NAV_LOITER_TO_ALT:
            return float(a > 0.0), b, 0.0, float(d > 0.0)
    return params


def _whole(value: float) -> float:
    return value if isnan(value) else float(trunc(value))


def _tolerance(name: str, vehicle: Vehicle) -> float:
    if name == "altitude" and vehicle.autopilot == Autopilot.ARDUPILOT:
        return _ALTITUDE_M
    return _HEADING_DEG if name == "parameter 4" and vehicle.autopilot == Autopilot.PX4 else 0.0


def _equal(a: float, b: float, tolerance: float = 0.0) -> bool:
    return (isnan(a) and isnan(b)) or abs(a - b) <= tolerance


def _float32(value: float) -> float:
    single: float = unpack("<f", pack("<f", value))[0]
    return single
