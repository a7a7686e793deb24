"""The fence of a vehicle, read by the mission protocol."""

import pytest
from pymavlink.dialects.v20 import ardupilotmega as mavlink

from loiter.errors import LinkFailed
from loiter.fences import PlacedCircle, PlacedFence, PlacedPolygon
from loiter.mavlink import download, download_fence
from mavlink.vehicle import OLD, Vehicle, flying, item

CORNERS = ((47.0, 8.0), (47.01, 8.0), (47.01, 8.02))
FENCE = [
    item(5000, x=470050000, y=80100000),
    *(item(5001, params=(3.0, 0.0, 0.0, 0.0), x=round(a * 1e7), y=round(b * 1e7)) for a, b in CORNERS),
    item(5004, params=(40.5, 0.0, 0.0, 0.0), x=470050000, y=80100000),
]


class Fenced(Vehicle):
    """It has a mission and a fence, by the type in each message."""

    def __init__(self, fence):
        super().__init__(OLD)
        self.fence = fence

    def on_mission_request_list(self, message):
        items = self.fence if message.mission_type == 1 else self.mission
        self.partner = message.get_srcSystem(), message.get_srcComponent()
        # Messages of the other type arrive too.
        for kind in (0, 1):
            count = len(items) if kind == message.mission_type else 7
            self.send(mavlink.MAVLink_mission_count_message(*self.partner, count, kind))

    def on_mission_request_int(self, message):
        items = self.fence if message.mission_type == 1 else self.mission
        command, frame, params, x, y, z, autocontinue = items[message.seq]
        head = *self.partner, message.seq, frame, command, 0, autocontinue
        self.send(mavlink.MAVLink_mission_item_int_message(*head, *params, x, y, z, message.mission_type))


class Ardu(Fenced):
    autopilot = 3


@pytest.mark.parametrize("kind", [Fenced, Ardu])
def test_a_fence_is_read(kind):
    polygon, circle = PlacedPolygon("polygon 1", CORNERS, True), PlacedCircle("circle 1", 47.005, 8.01, 40.5, False)
    with flying(kind(FENCE)) as vehicle:
        assert download_fence(vehicle.connection) == PlacedFence((polygon, circle))
        assert len(download(vehicle.connection).items) == len(OLD) - (kind is Ardu)


def test_a_vehicle_without_a_fence():
    with flying(Fenced([])) as vehicle:
        assert download_fence(vehicle.connection) is None


def test_a_fence_that_is_none_is_one_sentence():
    with (
        flying(Fenced(FENCE[:3])) as vehicle,
        pytest.raises(LinkFailed, match="has a fence in which item 2: a polygon has 3 corners, and 2 follow"),
    ):
        download_fence(vehicle.connection)


def test_a_vehicle_that_keeps_no_fences():
    class Without(Fenced):
        def on_mission_request_list(self, message):
            self.send(mavlink.MAVLink_mission_ack_message(message.get_srcSystem(), message.get_srcComponent(), 3, 1))

    with flying(Without([])) as vehicle, pytest.raises(LinkFailed, match="refused to give its fence"):
        download_fence(vehicle.connection, timeout_s=0.3)
