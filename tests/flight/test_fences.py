"""The fence of a vehicle, read by the mission protocol."""

from math import hypot, pi
from typing import NamedTuple

import numpy as np
import pytest
from pymavlink.dialects.v20 import ardupilotmega as mavlink

from flight.flyer import FRAME, ORBIT, Airframe, GuidedPlane, guided, when
from flight.vehicle import OLD, Vehicle, flying, item
from loiter import Aircraft, Orbit, Pose, Turn, plan
from loiter.errors import LinkFailed
from loiter.fences import PlacedCircle, PlacedFence, PlacedPolygon, PolygonZone
from loiter.fences.clear_entry import fastest_clear
from loiter.fences.model import signed_distance
from loiter.flight import download, download_fence
from loiter.flight.autopilots.own_guidance import Guidance
from loiter.flight.guiding import flight, preparation
from loiter.flight.guiding.fall_back import FallBack, OwnGuidance, fall_back, own_way
from loiter.flight.guiding.flight import GuidedFlight
from loiter.flight.guiding.hand_over import KEPT_S
from loiter.guidance.entry import fenced_entry
from loiter.guidance.protocol import State
from loiter.planning.compass import heading_vector

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

    home = None

    def tell(self, number):
        """Where its home is, if it is set."""
        super().tell(number)
        if number == 242 and self.home is not None:
            place = *(round(1e7 * degrees) for degrees in self.home), 400000
            self.send(mavlink.MAVLink_home_position_message(*place, 0, 0, 0, (1, 0, 0, 0), 0, 0, 0))


class Ardu(Fenced):
    autopilot = 3


def ring(radius_m, command=5003):
    """A circle about that which is guided onto."""
    latitude, longitude = (round(float(value) * 1e7) for value in FRAME.to_geodetic(ORBIT.east_m, ORBIT.north_m))
    return item(command, params=(radius_m, 0.0, 0.0, 0.0), x=latitude, y=longitude)


class FencedPlane(GuidedPlane):
    """A plane in flight with a fence."""

    fence = ()
    parameters = GuidedPlane.parameters | {"FENCE_TYPE": (4.0, 2), "FENCE_RADIUS": (300.0, 9)}

    on_mission_request_list, on_mission_request_int = Fenced.on_mission_request_list, Fenced.on_mission_request_int


@pytest.fixture(autouse=True)
def _searches_at_once(monkeypatch):
    """These vehicles have a clock of their own, which another process does not know."""
    for module in (preparation, fenced_entry):
        monkeypatch.setattr(module, "begin_search", fenced_entry._at_once)


def guided_with(own_fence, **options):
    """A flight from near the middle of the circle, which is inside."""
    vehicle = FencedPlane(Airframe())
    vehicle.fence = own_fence
    return guided(vehicle, seconds=4.0, coast_s=0.3, **options)


@pytest.mark.parametrize(
    ("fence", "end"),
    [
        ([ring(84.0)], "cannot be guided: the plan comes within 4.0 m of the inclusion zone 'circle 1'"),
        ([ring(79.0)], "cannot be guided: the plan leaves the inclusion zone 'circle 1'"),
        ([ring(75.0, 5004)], "cannot be guided: its pose is inside the zone 'circle 1'"),
        ([], "system 1 (ArduPilot) has no fence to be checked"),
    ],
)
def test_a_vehicle_is_not_guided_into_its_fence(fence, end):
    outcome = guided_with(fence, fence="vehicle")
    assert end in outcome.end
    assert outcome.end.endswith("; nothing was commanded")


@pytest.mark.parametrize(
    ("fence", "end"),
    [([ring(78.0)], "the vehicle has left the zone 'circle 1'"), ([ring(400.0)], "")],
)
def test_a_fence_is_watched_in_flight(fence, end, monkeypatch):
    """The plan is called clear whatever it is, as where the vehicle does not fly it."""
    monkeypatch.setattr(preparation, "_fenced", lambda contact, zones, request, chosen: chosen)
    monkeypatch.setattr(GuidedFlight, "_blocked", lambda flight: None)
    monkeypatch.setattr(GuidedFlight, "_find_entry", lambda flight, request, settings: iter(()))
    monkeypatch.setattr(GuidedFlight, "_clear_fall_back", lambda flight, circles, *rest: FallBack(circles[0], True))
    vehicle = FencedPlane(Airframe())
    vehicle.fence = fence
    outcome = guided(vehicle, seconds=25.0, coast_s=0.3, fence="vehicle")
    assert outcome.end.startswith(end) or end in outcome.end
    assert bool(end) == ("the zone" in outcome.end)


def test_a_vehicle_is_guided_inside_its_fence():
    outcome = guided_with([ring(400.0)], fence="vehicle", dry_run=True)
    assert any(notice.startswith("The plan and its hold stay clear of the fence, ") for notice in outcome.notices)


def test_a_fence_of_a_file_is_kept():
    mast = PlacedFence((PlacedCircle("mast", 47.0, 8.0, 60.0),))
    assert "cannot be guided: its pose is inside the zone 'mast'" in guided_with([], fence=mast).end


def test_a_vehicle_is_guided_round_a_mast():
    """It stands on the fastest entry from the middle of the circle, before the circle."""
    fastest = plan(Pose(0.0, 0.0, 0.0), ORBIT, Aircraft(18.0, max_bank_deg=44.0))
    east_m, north_m = (column[1] for column in fastest.sample(0.5 * fastest.duration_s)[1:3])
    place = FRAME.place(Pose(float(east_m), float(north_m), 0.0))
    mast = PlacedFence((PlacedCircle("mast", place.latitude_deg, place.longitude_deg, 4.0),))
    outcome = guided_with([], fence=mast, margin_m=3.0, dry_run=True)
    assert any(notice.startswith("The fastest clear entry found joins ") for notice in outcome.notices), outcome


# A wall between a vehicle that flies east and the circle; searches take their time.

WALL = PolygonZone("wall", ((-140.0, -150.0), (-100.0, -150.0), (-100.0, 110.0), (-140.0, 110.0)))
PLACES = (FRAME.place(Pose(*corner, 0.0)) for corner in WALL.corners)
PLACED_WALL = PlacedFence((PlacedPolygon("wall", tuple((each.latitude_deg, each.longitude_deg) for each in PLACES)),))


class Slow(NamedTuple):
    """A search whose answer comes at a time of the vehicle's clock."""

    problem: fenced_entry.SearchProblem
    at_s: float

    def ready(self):
        return preparation.monotonic() >= self.at_s

    def get(self):
        return fastest_clear(*self.problem)


class Tracked(FencedPlane):
    """Notes its track."""

    def set_up(self):
        self.track = []

    def idle(self, now):
        super().idle(now)
        self.track.append((self.airframe.east, self.airframe.north))

    @property
    def least_m(self):
        """How near it has come to the wall, metres; negative inside."""
        return float(signed_distance(WALL, *np.array(self.track).T).min())


@pytest.fixture
def slow(monkeypatch):
    """A function that makes searches take so many seconds."""

    def take(took_s):
        for module in (preparation, fenced_entry):
            monkeypatch.setattr(module, "begin_search", lambda problem: Slow(problem, preparation.monotonic() + took_s))

    return take


def past_wall(start=(-650.0, -20.0, 90.0), vehicle=Tracked, events=(), **options):
    return guided(vehicle(Airframe(*start), events), fence=PLACED_WALL, coast_s=60.0, **options)


@pytest.mark.parametrize("took_s", [0.1, 3.0])
@pytest.mark.parametrize("start", [(-650.0, -20.0, 90.0), (-550.0, 60.0, 120.0)])
def test_an_entry_begins_where_the_vehicle_is_when_it_is_found(slow, start, took_s):
    """It keeps clear of the wall, and is not commanded to a circle to which it would fly through that."""
    slow(took_s)
    outcome = past_wall(start)
    assert outcome.end == ""
    assert outcome.vehicle.least_m > 2.0
    first, *_, last = (float(FRAME.to_local(m.x / 1e7, m.y / 1e7)[0]) for m in outcome.vehicle.commands)
    assert first < -140.0
    assert last == pytest.approx(ORBIT.east_m, abs=5.0)
    assert any("the fall-back circle is one of " in notice for notice in outcome.notices)
    assert outcome.notices.count("Its own way to the circle is clear of the fence: that is the fall-back circle now.")


@pytest.mark.parametrize("at_s", [10.0, 14.0, 18.0, 22.0, 26.0, 30.0])
def test_a_vehicle_whose_link_dies_keeps_clear_of_the_fence(slow, at_s):
    slow(0.1)
    outcome = past_wall(events=[when(at_s, silent=True, muted=True)])
    assert "nothing was heard" in outcome.end
    assert outcome.vehicle.least_m > 0.0


def test_the_own_way_is_that_of_arduplane():
    """The `plane` of its simulator, whose link dies: it comes 15 m farther east than with a turn ratio of 1."""
    east_m, north_m, heading_deg, airspeed = 243.0, 173.0, 71.0, 23.4
    state = State(
        0.0, east_m, north_m, heading_deg, 0.0, *(airspeed * x for x in heading_vector(heading_deg)), airspeed
    )
    own = OwnGuidance(Aircraft(airspeed, max_bank_deg=44.5), None, Guidance(2.0 * pi / 15.0, 0.75), KEPT_S)
    way = own_way(state, Orbit(-58.0, -5.0, 70.0, Turn.CW), own)
    assert max(way.east_m) == pytest.approx(408.0, abs=6.0)


def test_the_own_way_is_flown_in_the_wind_and_with_the_slip_that_the_law_has_identified(slow, monkeypatch):
    """The wind begins in flight."""
    seen = []
    monkeypatch.setattr(flight, "fall_back", lambda *given: (seen.append(given[-1]), fall_back(*given))[1])

    class Slipping(Tracked):
        def set_up(self):
            super().set_up()
            self.airframe.turn_ratio = 0.75

    def blow(vehicle):
        vehicle.airframe.wind = 0.0, -5.0

    slow(0.1)
    past_wall(vehicle=Slipping, events=[(4.0, blow)], seconds=26.0)
    east_m_s, north_m_s = seen[-1].wind.velocity_m_s
    assert hypot(east_m_s, north_m_s + 5.0) < 1.0
    assert seen[-1].turn_ratio == pytest.approx(0.75, abs=0.1)


@pytest.mark.parametrize("at_s", [10.0, 14.0, 18.0, 22.0, 26.0])
def test_a_vehicle_that_is_commanded_back_keeps_clear_of_the_fence(slow, at_s):
    slow(0.1)
    outcome = past_wall(interrupt=[at_s])
    assert outcome.end.startswith("guiding was interrupted: guiding has stopped, and system 1 (ArduPilot) flies ")
    assert outcome.vehicle.least_m > 0.0
    (east_m, _), _, _ = outcome.vehicle.hold_circle
    assert outcome.end.endswith("flies the fall-back circle") == (abs(east_m - ORBIT.east_m) < 5.0)


def test_a_vehicle_that_enters_a_zone_while_the_question_waits_is_not_guided():
    outcome = past_wall((-250.0, -20.0, 90.0), confirm=lambda: False)
    assert outcome.end == "the vehicle has entered the zone 'wall'; nothing was commanded"
    assert outcome.vehicle.commands == []


def test_a_search_that_takes_too_long_is_given_up(slow):
    slow(1e9)
    outcome = past_wall()
    assert outcome.end == (
        "system 1 (ArduPilot) cannot be guided: no entry that stays clear of the fence was found in 30 s; "
        "nothing was commanded"
    )


def test_a_vehicle_that_is_never_where_an_entry_begins_is_not_guided(slow, monkeypatch):
    monkeypatch.setattr(fenced_entry.FencedEntry, "begins_at", lambda law, pose, start: False)
    slow(1.0)
    outcome = past_wall((-2000.0, -20.0, 90.0))
    assert "it was elsewhere than expected each time when one was found, for 30 s" in outcome.end
    assert outcome.vehicle.commands == []


def test_a_vehicle_that_would_fly_through_the_fence_to_any_circle_is_not_commanded(monkeypatch):
    monkeypatch.setattr(preparation, "_fenced", lambda contact, zones, request, chosen: chosen)
    monkeypatch.setattr(GuidedFlight, "_find_entry", lambda flight, request, settings: iter(()))
    outcome = past_wall((-195.0, -20.0, 90.0))
    assert "by its own guidance it would fly through the fence" in outcome.end
    assert outcome.vehicle.commands == []


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


@pytest.mark.parametrize(
    ("kind", "fence", "parameters"),
    [
        (Ardu, [item(5005, params=(300.0, 0.0, 0.0, 0.0), x=0, y=0)], {}),
        (Ardu, [], {"FENCE_TYPE": (7.0, 2), "FENCE_RADIUS": (300.0, 9)}),
        (Fenced, [], {"GF_MAX_HOR_DIST": (300.0, 9)}),
    ],
)
def test_a_circle_about_home_is_a_zone(kind, fence, parameters):
    """An item of ArduPilot's fence, and the circles that parameters of ArduPilot and PX4 switch on."""
    vehicle = kind(fence)
    vehicle.parameters = parameters
    with flying(vehicle):
        with pytest.raises(LinkFailed, match=r"circle about home .* is not known|the home is not known"):
            download_fence(vehicle.connection, timeout_s=1.0)
        vehicle.home = 47.1, -8.2
        (circle,) = download_fence(vehicle.connection, timeout_s=1.0).zones
    assert circle[1:] == (47.1, -8.2, 300.0, True)


def test_a_circle_about_home_that_is_off_is_no_zone():
    vehicle = Ardu([])
    vehicle.parameters = {"FENCE_TYPE": (4.0, 2), "FENCE_RADIUS": (300.0, 9)}
    with flying(vehicle):
        assert download_fence(vehicle.connection) is None


def test_an_unknown_item_of_a_fence_is_not_ignored():
    with (
        flying(Fenced([*FENCE, item(5006)])) as vehicle,
        pytest.raises(
            LinkFailed, match=r"has a fence in which item 6: command 5006 is not known .* may restrict the flight"
        ),
    ):
        download_fence(vehicle.connection)


def test_a_vehicle_that_keeps_no_fences():
    class Without(Fenced):
        def on_mission_request_list(self, message):
            self.send(mavlink.MAVLink_mission_ack_message(message.get_srcSystem(), message.get_srcComponent(), 3, 1))

    with flying(Without([])) as vehicle, pytest.raises(LinkFailed, match="refused to give its fence"):
        download_fence(vehicle.connection, timeout_s=0.3)
