"""Missions and the fence of their file: places, circles and the lines between them."""

import pytest

from loiter.errors import InvalidArgument, OutOfRange
from loiter.fences import PlacedCircle, PlacedFence, PlacedPolygon
from loiter.files.missions.items import Frame, MavCommand, Mission, MissionItem
from loiter.files.missions.own_fence import mission_breach
from loiter.geo import LocalFrame

FRAME = LocalFrame(47.0, 8.0)


def place(east_m, north_m):
    return tuple(float(degrees) for degrees in FRAME.to_geodetic(east_m, north_m))


def item(command, east_m, north_m, *params):
    return MissionItem(command, Frame.ABOVE_SEA, (*params, *[0.0] * (4 - len(params))), *place(east_m, north_m), 500.0)


def waypoint(east_m, north_m):
    return item(MavCommand.NAV_WAYPOINT, east_m, north_m)


def loiter(east_m, north_m, radius_m):
    return item(MavCommand.NAV_LOITER_UNLIM, east_m, north_m, 0.0, 0.0, radius_m)


def box(east_m, north_m, half_m, inclusion=False):
    corners = tuple(place(east_m + a * half_m, north_m + b * half_m) for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1)))
    return PlacedPolygon("zone", corners, inclusion)


def disc(east_m, north_m, radius_m, inclusion=False):
    return PlacedCircle("zone", *place(east_m, north_m), radius_m, inclusion)


JUMP = item(177, 0.0, 0.0, 1.0, 2.0)._replace(frame=Frame.NOWHERE)
HERE = waypoint(0.0, 0.0)._replace(latitude_deg=0.0, longitude_deg=0.0)
LOOKED_AT = item(80, 500.0, 500.0)


@pytest.mark.parametrize(
    ("items", "zone", "breach"),
    [
        ([waypoint(0, 0), waypoint(1000, 0)], box(500, 0, 50), "the line from item 1 to item 2 enters"),
        ([waypoint(0, 0), waypoint(1000, 0)], box(500, 51, 50), ""),
        ([waypoint(0, 0)], box(0, 0, 50), "item 1 enters"),
        ([waypoint(0, 0)], disc(0, 0, 50), "item 1 enters"),
        ([waypoint(0, 0)], disc(0, 51, 50), ""),
        ([loiter(0, 0, 100.0)], disc(0, 0, 500), "the circle of item 1 enters"),
        ([loiter(0, 0, 100.0)], box(0, 0, 500), "the circle of item 1 enters"),
        # A mast in the middle of the circle, to which the line from the west does not lead.
        ([waypoint(-500, 0), loiter(0, 0, -100.0)], box(0, 0, 60), ""),
        ([waypoint(-500, 0), loiter(0, 0, -100.0), waypoint(0, 500)], disc(-90, 0, 5), ""),
        (
            [waypoint(-500, 0), loiter(0, 0, -100.0), waypoint(0, 500)],
            disc(0, 200, 5),
            "the line from item 2 to item 3",
        ),
        ([loiter(0, 0, -100.0)], box(0, 0, 90), "the circle of item 1 enters"),
        ([loiter(0, 0, -100.0)], box(0, 0, 99.9, inclusion=True), "the circle of item 1 leaves the inclusion zone"),
        ([loiter(0, 0, -100.0)], box(0, 0, 100.1, inclusion=True), ""),
        ([loiter(0, 0, -100.0)], box(1000, 0, 100, inclusion=True), "the circle of item 1 leaves"),
        ([loiter(0, 0, -100.0)], disc(0, 10, 109.9, inclusion=True), "the circle of item 1 leaves"),
        # The radius is the autopilot's: its centre alone is checked.
        ([loiter(0, 0, 0.0)], box(0, 0, 10), "item 1 enters"),
        ([loiter(0, 0, 0.0)], box(60, 0, 10), ""),
        (
            [waypoint(0, 0), waypoint(1000, 0), waypoint(1000, 1000), JUMP],
            box(500, 500, 50),
            "the line from item 3 to item 1",
        ),
        ([waypoint(0, 0), HERE, LOOKED_AT, waypoint(1000, 0)], box(500, 500, 50), ""),
        ([waypoint(0, 0), HERE, LOOKED_AT, waypoint(1000, 0)], box(500, 0, 50), "the line from item 1 to item 4"),
        ([HERE], box(0, 0, 50), ""),
    ],
)
def test_what_enters_a_zone_is_named(items, zone, breach):
    found = mission_breach(Mission(tuple(items), (47.0, 8.0, 400.0)), PlacedFence((zone,)))
    assert found.startswith(breach)
    assert bool(found) == bool(breach)


def test_what_cannot_be_checked_is_an_error():
    mission = Mission((waypoint(0, 0), waypoint(90e3, 0)), (47.0, 8.0, 400.0))
    with pytest.raises(OutOfRange, match="the zone 'far'"):
        mission_breach(mission, PlacedFence((PlacedCircle("far", 48.0, 8.0, 10.0),)))
    with pytest.raises(InvalidArgument, match="no common point"):
        mission_breach(mission, PlacedFence((disc(0, 0, 50, inclusion=True), disc(200, 0, 50, inclusion=True))))
