"""Mission items as MAVLink transmits them, and as autopilots store them.

The rules for ArduPilot follow `AP_Mission::mavlink_int_to_mission_cmd` and `mission_cmd_to_mavlink_int`, which store
an item in 15 bytes and round values to fit; those for PX4 follow `parse_mavlink_mission_item` and
`format_mavlink_mission_item` in its mavlink_mission.cpp. Both are for aeroplanes.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import copysign, isfinite, isinf, isnan, nan
from struct import error as StructError  # noqa: N812
from struct import pack, unpack
from typing import Any, NamedTuple

from loiter.errors import InvalidArgument
from loiter.files.missions.items import EQUIVALENT_FRAMES, Autopilot, Frame, MavCommand, Mission, MissionItem
from loiter.files.missions.limits import truncated
from loiter.files.missions.references import dangling_reference, renumbered
from loiter.files.missions.signs import Params
from loiter.flight.link.link import Vehicle, dialect
from loiter.planning.compass import wrapped

PER_DEGREE = 1e7

# MISSION_COUNT has 16 bits.
MOST_ITEMS = 65535

# DO_DIGICAM_CONFIGURE and DO_DIGICAM_CONTROL have numbers in x and y, whatever their frame, as ArduPilot reads them.
_NUMBERS_IN_PLACE = {202, 203}

# The commands with a place in ArduPilot (AP_Mission::stored_in_location). It returns frame, x, y and z of others as 0.
_PLACED_BY_ARDUPILOT = {16, 17, 18, 19, 21, 22, 30, 31, 36, 82, 84, 85, 92, 94, 179, 188, 189, 191, 195, 201}

# The commands that PX4 accepts in missions without a place alone, in MAV_FRAME_MISSION. Mission Planner and MAVProxy
# write them in the frame of the waypoints.
_UNPLACED_BY_PX4 = {
    *(20, 93, 112, 114, 177, 178, 187, 189, 196, 197, 200, 203, 204, 205, 206, 211, 214, 260),
    *(530, 532, 534, 1000, 1001, 2000, 2001, 2003, 2500, 2501, 3000, 42600),
}

# Tolerances of the values read back: ArduPilot truncates an altitude to centimetres after float32 rounding; PX4
# converts a heading to radians and back.
_ALTITUDE_M, _HEADING_DEG = 0.015, 1e-4


class StoredItem(NamedTuple):
    """An item with the fields of MISSION_ITEM_INT: parameters and z are float32 numbers, x and y are int32."""

    frame: int
    command: int
    current: int
    autocontinue: int
    params: Params
    x: int
    y: int
    z: float


def encode(mission: Mission, vehicle: Vehicle, own_home: StoredItem | None = None) -> list[StoredItem]:
    """The items to send to a vehicle for a mission.

    ArduPilot's item 0 is the home: its own if given, otherwise that of the mission. Other vehicles have no home: their
    items count from the first one. Raises `InvalidArgument` for a mission without items or with references to items
    that do not exist, and for numbers that MAVLink cannot represent.
    """
    if not mission.items:
        raise InvalidArgument("mission", "has no items")
    first = int(keeps_home(vehicle))
    if first + len(mission.items) > MOST_ITEMS:
        count = first + len(mission.items)
        raise InvalidArgument("mission", f"has {count} items: MAVLink allows {MOST_ITEMS}")
    dangling = dangling_reference(mission.items)
    if dangling is not None:
        index, problem = dangling
        raise InvalidArgument("mission", f"has item {index + 1}: {problem}")
    items = [
        _encode_item(_for_vehicle(_renumbered(item, first - 1), vehicle), seq, item_name(seq, vehicle))
        for seq, item in enumerate(mission.items, start=first)
    ]
    return [own_home or _encode_home(mission, vehicle), *items] if first else items


def own_home(items: Sequence[StoredItem], vehicle: Vehicle) -> StoredItem | None:
    """The home among the items that a vehicle has; None if there is none, or it is not set (0 N 0 E)."""
    if not keeps_home(vehicle) or not items:
        return None
    home, *_ = items
    return None if home.x == home.y == 0 else home._replace(current=1)


def above_sea_m(item: StoredItem, home_altitude_m: float) -> float:
    """The altitude of an item above the sea, metres; nan if that of its reference is not known."""
    match EQUIVALENT_FRAMES.get(item.frame):
        case Frame.ABOVE_SEA:
            return item.z
        case Frame.ABOVE_HOME:
            return item.z + home_altitude_m
    return nan


def decode(items: Sequence[StoredItem], vehicle: Vehicle) -> Mission:
    """The mission that a vehicle has; the home is nan if it is not among the items."""
    decoded = tuple(map(decode_item, items))
    if not keeps_home(vehicle) or not decoded:
        return Mission(tuple(_renumbered(item, 1) for item in decoded), (nan, nan, nan))
    home, *flown = decoded
    return Mission(tuple(flown), (home.latitude_deg, home.longitude_deg, home.altitude_m))


def _for_vehicle(item: MissionItem, vehicle: Vehicle) -> MissionItem:
    """The item in the frame in which the autopilot of a vehicle accepts its command."""
    unplaced = vehicle.autopilot == Autopilot.PX4 and item.command in _UNPLACED_BY_PX4
    return item._replace(frame=Frame.NOWHERE) if unplaced else item


def _has_place(item: MissionItem | StoredItem) -> bool:
    """Whether parameters 5 and 6 of an item are latitude and longitude."""
    return item.frame in EQUIVALENT_FRAMES and item.command not in _NUMBERS_IN_PLACE


def _renumbered(item: MissionItem, added: int) -> MissionItem:
    """The item, where the number of another item in it is larger by `added`."""
    return item._replace(params=renumbered(item.command, item.params, added))


def keeps_home(vehicle: Vehicle) -> bool:
    """Whether item 0 is the home, which the vehicle sets by itself."""
    return vehicle.autopilot == Autopilot.ARDUPILOT


def item_name(seq: int, vehicle: Vehicle) -> str:
    """The name of an item in sentences: item 1 is the first to be flown."""
    if not keeps_home(vehicle):
        return f"item {seq + 1}"
    return f"item {seq}" if seq else "the home"


def to_message(item: StoredItem, seq: int, vehicle: Vehicle) -> Any:
    """The MISSION_ITEM_INT that sends an item to a vehicle."""
    head = vehicle.system, vehicle.component, seq, item.frame, item.command, item.current, item.autocontinue
    return dialect().MAVLink_mission_item_int_message(*head, *item.params, item.x, item.y, item.z, 0)


def from_message(message: Any) -> StoredItem:
    """The item in a MISSION_ITEM_INT."""
    head = message.frame, message.command, message.current, message.autocontinue
    params = message.param1, message.param2, message.param3, message.param4
    return StoredItem(*head, params, message.x, message.y, message.z)


def differences(
    sent: Sequence[StoredItem], kept: Sequence[StoredItem], vehicle: Vehicle
) -> tuple[list[str], list[str]]:
    """The differences, in words, between the items that a vehicle was sent and those that it has.

    The first list has the errors, the second one what its autopilot is known to round. ArduPilot's home and the current
    item are not compared, since the vehicle sets them.
    """
    wrong: list[str] = []
    cut: list[str] = []
    if len(sent) != len(kept):
        return [f"it keeps {len(kept)} items of {len(sent)}"], cut
    for seq in range(int(keeps_home(vehicle)), len(sent)):
        item = _with_place_kept(sent[seq], kept[seq], vehicle)
        predicted = [_fields(stored) for stored in _as_stored(item, vehicle)]
        before, after = _fields(item), _fields(kept[seq])
        for name in before:
            if not _equal(before[name], after[name]):
                expected = any(_equal(stored[name], after[name], _tolerance(name, vehicle)) for stored in predicted)
                text = f"{item_name(seq, vehicle)} has {after[name]:.9g} for {name}, not {before[name]:.9g}"
                (cut if expected else wrong).append(text)
    return wrong, cut


def is_same(some: Sequence[StoredItem], others: Sequence[StoredItem], vehicle: Vehicle) -> bool:
    """Whether two missions read from a vehicle are the same, apart from what its autopilot rounds."""
    wrong, _ = differences(some, others, vehicle)
    return not wrong


def _encode_home(mission: Mission, vehicle: Vehicle) -> StoredItem:
    latitude, longitude, altitude = mission.home
    place = (latitude, longitude, 0.0 if isnan(altitude) else altitude)
    item = MissionItem(MavCommand.NAV_WAYPOINT, Frame.ABOVE_SEA, (0.0, 0.0, 0.0, 0.0), *place)
    return _encode_item(item, 0, item_name(0, vehicle))


def _encode_item(item: MissionItem, seq: int, name: str) -> StoredItem:
    if any(map(isinf, (*item.params, item.altitude_m))):
        raise InvalidArgument("mission", f"has an infinite number in {name}: {item}")
    try:
        x, y = _encode_place(item, name)
        p1, p2, p3, p4, z = map(_float32, (*item.params, item.altitude_m))
        # Numbers that do not fit are found here, not in the middle of a transfer.
        frame, command, *_ = unpack("<BH2i", pack("<BH2i", item.frame, item.command, x, y))
    except (StructError, OverflowError) as error:
        raise InvalidArgument("mission", f"has a number that is too large for MAVLink in {name}: {item}") from error
    return StoredItem(frame, command, int(seq == 0), int(item.autocontinue), (p1, p2, p3, p4), x, y, z)


def _encode_place(item: MissionItem, name: str) -> tuple[int, int]:
    """Latitude and longitude in 1e-7 degrees; parameters 5 and 6 of an item without a place, with 0 for nan."""
    lat, lon = item.latitude_deg, item.longitude_deg
    if not _has_place(item):
        return round(lat if isfinite(lat) else 0.0), round(lon if isfinite(lon) else 0.0)
    if not (abs(lat) <= 90.0 and abs(lon) <= 360.0):
        raise InvalidArgument("mission", f"has no place on Earth in {name}: {lat:g} {lon:g}")
    if abs(lon) > 180.0:
        lon -= copysign(360.0, lon)
    return round(lat * PER_DEGREE), round(lon * PER_DEGREE)


def decode_item(item: StoredItem) -> MissionItem:
    """The item with its place in degrees."""
    scale = PER_DEGREE if _has_place(item) else 1.0
    place = item.x / scale, item.y / scale, item.z
    frame = EQUIVALENT_FRAMES.get(item.frame, item.frame)
    return MissionItem(item.command, frame, item.params, *place, bool(item.autocontinue))


def _fields(item: StoredItem) -> dict[str, float]:
    """The values that are compared, by name."""
    params = {f"parameter {i}": value for i, value in enumerate(item.params, 1)}
    frame = EQUIVALENT_FRAMES.get(item.frame, item.frame)
    place = {"x": item.x, "y": item.y, "altitude": item.z}
    return {"command": item.command, "frame": frame, **params, **place, "autocontinue": item.autocontinue}


def _with_place_kept(sent: StoredItem, kept: StoredItem, vehicle: Vehicle) -> StoredItem:
    """The item sent; for ArduPilot without frame and place where it has returned 0 because its command has none."""
    if vehicle.autopilot != Autopilot.ARDUPILOT or kept.frame != 0:
        return sent
    if sent.command in _NUMBERS_IN_PLACE:
        return sent._replace(frame=0, z=0.0)
    if sent.command not in _PLACED_BY_ARDUPILOT and kept.x == kept.y == kept.z == 0:
        return sent._replace(frame=0, x=0, y=0, z=0.0)
    return sent._replace(frame=0) if sent.frame == Frame.NOWHERE else sent


def _as_stored(item: StoredItem, vehicle: Vehicle) -> list[StoredItem]:
    """The items as which the autopilot of a vehicle may store an item."""
    if vehicle.autopilot == Autopilot.ARDUPILOT:
        stored = _stored_by_ardupilot(item.command, item.params)
        return [item._replace(params=params, autocontinue=1) for params in stored]
    if vehicle.autopilot == Autopilot.PX4 and item.frame in EQUIVALENT_FRAMES:
        return [item._replace(params=_stored_by_px4(item.command, item.params))]
    return [item]


def _stored_by_ardupilot(command: int, params: Params) -> list[Params]:
    """What may be stored of parameters: of a command that is not known here, each as it is, in whole numbers, or 0."""
    known = _known_to_ardupilot(command, params)
    if known is not None:
        return [known]
    a, b, c, d = map(truncated, params)
    return [params, (a, b, c, d), (0.0, 0.0, 0.0, 0.0)]


def _known_to_ardupilot(command: int, params: Params) -> Params | None:
    a, b, c, d = params
    match command:
        case 20:  # NAV_RETURN_TO_LAUNCH
            return 0.0, 0.0, 0.0, 0.0
        case 22 | 600:  # NAV_TAKEOFF, JUMP_TAG
            return truncated(a), 0.0, 0.0, 0.0
        case 177 | 601:  # DO_JUMP, DO_JUMP_TAG
            return truncated(a), truncated(b), 0.0, 0.0
        case MavCommand.NAV_LAND:
            return truncated(a), 0.0, 0.0, -1.0 if d < 0.0 else 1.0
        case MavCommand.NAV_WAYPOINT:
            return 0.0, min(truncated(b), 255.0), min(truncated(c), 255.0), 0.0
        case MavCommand.NAV_LOITER_UNLIM:
            return 0.0, 0.0, truncated(c), 0.0
        case MavCommand.NAV_LOITER_TURNS:
            # One byte for the radius, in tens of metres above 255, and one for the turns, in 256ths of a turn below 1.
            radius = abs(c) if abs(c) <= 255.0 else 10.0 * min(truncated(abs(c) * 0.1), 255.0)
            turns = truncated(256.0 * a) / 256.0 if 0.0 < a < 1.0 else min(truncated(a), 255.0)
            return turns, 0.0, copysign(truncated(radius), c), float(d > 0.0)
        case MavCommand.NAV_LOITER_TIME:
            return truncated(a), 0.0, -1.0 if c < 0.0 else 1.0, float(d > 0.0)
        case MavCommand.NAV_LOITER_TO_ALT:
            return 0.0, truncated(b), 0.0, float(d > 0.0)
    return None


def _stored_by_px4(command: int, params: Params) -> Params:
    a, b, c, d = params
    match command:
        case MavCommand.NAV_WAYPOINT:
            return a, b, 0.0, wrapped(d)
        case MavCommand.NAV_LOITER_UNLIM:
            return 0.0, 0.0, c, wrapped(d)
        case MavCommand.NAV_LOITER_TIME:
            return a, float(b > 0.0), c, float(d > 0.0)
        case MavCommand.NAV_LOITER_TO_ALT:
            return float(a > 0.0), b, 0.0, float(d > 0.0)
    return params


def _tolerance(name: str, vehicle: Vehicle) -> float:
    if name == "altitude" and vehicle.autopilot == Autopilot.ARDUPILOT:
        return _ALTITUDE_M
    return _HEADING_DEG if name == "parameter 4" and vehicle.autopilot == Autopilot.PX4 else 0.0


def _equal(a: float, b: float, within: float = 0.0) -> bool:
    return (isnan(a) and isnan(b)) or abs(a - b) <= within


def _float32(value: float) -> float:
    (single,) = unpack("<f", pack("<f", value))
    return float(single)
