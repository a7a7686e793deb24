"""Mission files as pymavlink and MAVSDK read them, and as they are read back."""

import json
from math import isnan, nan
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mavsdk import ComponentType, Configuration, Mavsdk
from mavsdk.plugins.mission_raw import MissionRaw
from pymavlink import mavwp
from pymavlink.dialects.v20 import ardupilotmega as mavlink

from earth import SCENES, entry
from loiter import Aircraft, Leg, Orbit, Pose, plan_leg
from loiter.errors import InvalidArgument
from loiter.fences import PlacedCircle, PlacedFence, PlacedPolygon
from loiter.files import (
    AltitudeDatum,
    Autopilot,
    Frame,
    MavCommand,
    Mission,
    MissionItem,
    mission,
    read_fence,
    read_mission,
    save,
    save_leg,
)
from loiter.files.missions.qgcplan import qgcplan
from loiter.files.missions.wpl import wpl
from loiter.files.reading import MAX_BYTES, Source
from loiter.geo import LocalFrame

settings.register_profile("files", deadline=None, max_examples=50)
settings.load_profile("files")


# MAVLink's integers count 1e-7 degrees.
UNIT_DEG = 1e-7


@pytest.fixture(scope="module", params=Autopilot)
def peer(request):
    """MAVSDK's importer for an autopilot. It wants a vehicle: a heartbeat, handed over as bytes, is enough of one."""
    ground = Mavsdk(Configuration.create_with_component_type(ComponentType.GROUND_STATION))
    ground.add_any_connection("raw://")
    vehicle = mavlink.MAVLink(None, srcSystem=1, srcComponent=1)
    beat = vehicle.heartbeat_encode(mavlink.MAV_TYPE_FIXED_WING, request.param, 0, 0, 0)
    ground.pass_received_raw_bytes(beat.pack(vehicle))
    plugin = MissionRaw(ground.first_autopilot(10.0))
    yield request.param, plugin
    plugin.destroy()
    ground.destroy()


def as_sent(item, sequence):
    """An item as MISSION_ITEM_INT has it, without its degrees."""
    return (sequence, item.frame, item.command, *item.params, item.altitude_m, int(item.autocontinue))


def check_sent(sent, items, homes):
    """Whether what is to be sent is some homes, then the items, numbered from 0; and the place of the first home."""
    assert [item.seq for item in sent] == list(range(homes + len(items)))
    for theirs, item in zip(sent[homes:], items, strict=True):
        params = theirs.param1, theirs.param2, theirs.param3, theirs.param4
        mine = as_sent(item, theirs.seq)
        assert (theirs.seq, theirs.frame, theirs.command, *params, theirs.z, theirs.autocontinue) == mine
        check_place(theirs, item.latitude_deg, item.longitude_deg)


def check_place(sent, latitude_deg, longitude_deg):
    assert abs(sent.x - latitude_deg / UNIT_DEG) <= 1.0
    assert abs(sent.y - longitude_deg / UNIT_DEG) <= 1.0


@pytest.mark.parametrize("name", SCENES)
def test_mavsdk_reads_the_plan(peer, tmp_path, name):
    """For ArduPilot it puts the planned home before the items."""
    autopilot, plugin = peer
    m, frame = SCENES[name]
    save(m, tmp_path / "entry.plan", frame=frame, altitude_m=600.0, autopilot=autopilot, along_path=True)
    data = plugin.import_qgroundcontrol_mission(str(tmp_path / "entry.plan"))
    expected = mission(m, frame, 600.0, along_path=True)
    homes = int(autopilot == Autopilot.ARDUPILOT)
    check_sent(data.mission_items, expected.items, homes)
    if homes:
        check_place(data.mission_items[0], *expected.home[:2])
        assert data.mission_items[0].z == 600.0
    assert (data.geofence_items, data.rally_items) == ([], [])


def test_mavsdk_reads_a_leg_that_climbs_with_its_fence(peer, tmp_path):
    """The last items are a loiter that is left on the tangent at the altitude, and the point; by MAVLink's numbers."""
    autopilot, plugin = peer
    frame, uav = LocalFrame(47.0, 8.0), Aircraft(18.0, max_bank_deg=35.0, climb_rate_m_s=2.5)
    start, circle = Pose(-400.0, 120.0, 90.0, altitude_m=500.0), Orbit(0.0, 0.0, 120.0, "ccw")
    plan = plan_leg(Leg(start, circle, exit_to=(600.0, 0.0), altitude_m=700.0), uav)
    corners = ((46.99, 7.98), (47.02, 7.98), (47.02, 8.02), (46.99, 8.02))
    fence = PlacedFence((PlacedPolygon("field", corners, inclusion=True), PlacedCircle("mast", 47.01, 8.01, 60.0)))
    path = tmp_path / "leg.plan"
    save_leg(plan, path, frame=frame, autopilot=autopilot, fence=fence)
    data = plugin.import_qgroundcontrol_mission(str(path))
    loiter, end = data.mission_items[-2:]
    assert (loiter.command, end.command) == (mavlink.MAV_CMD_NAV_LOITER_TO_ALT, mavlink.MAV_CMD_NAV_WAYPOINT)
    assert (loiter.param1, loiter.param2, loiter.param4) == (1.0, -120.0, 1.0)
    assert {(item.frame, item.z) for item in (loiter, end)} == {(mavlink.MAV_FRAME_GLOBAL, 700.0)}
    check_place(loiter, 47.0, 8.0)
    check_place(end, *map(float, frame.to_geodetic(600.0, 0.0)))
    assert [item.command for item in data.geofence_items] == [5001] * 4 + [5004]
    for item, corner in zip(data.geofence_items, corners, strict=False):
        check_place(item, *corner)
    assert read_fence(path).zones[0].corners == corners


@pytest.mark.parametrize("ending", [".plan", ".waypoints"])
def test_mavsdk_reads_altitudes_above_home(peer, tmp_path, ending):
    autopilot, plugin = peer
    m, frame = SCENES["cw"]
    datum = AltitudeDatum("home", home_altitude_m=450.0)
    path = tmp_path / f"entry{ending}"
    # PX4 takes no files with a home line.
    autopilot = autopilot if ending == ".plan" else Autopilot.ARDUPILOT
    save(m, path, frame=frame, altitude_m=120.0, datum=datum, autopilot=autopilot)
    read = plugin.import_qgroundcontrol_mission if ending == ".plan" else plugin.import_mission_planner_mission
    sent = read(str(path)).mission_items[-len(mission(m, frame, 120.0, autopilot=autopilot).items) :]
    assert {(item.frame, item.z) for item in sent} == {(3, 120.0)}


@pytest.mark.parametrize("ending", [".waypoints", ".TXT"])
@pytest.mark.parametrize("name", SCENES)
def test_mavsdk_reads_the_waypoints(peer, tmp_path, name, ending):
    """It takes the line of the home for a waypoint, and for ArduPilot puts the home before that once more."""
    autopilot, plugin = peer
    m, frame = SCENES[name]
    save(m, tmp_path / f"entry{ending}", frame=frame, altitude_m=600.0)
    sent = plugin.import_mission_planner_mission(str(tmp_path / f"entry{ending}")).mission_items
    expected = mission(m, frame, 600.0)
    check_sent(sent, expected.items, homes=1 + int(autopilot == Autopilot.ARDUPILOT))
    check_place(sent[0], *expected.home[:2])
    assert (sent[0].current, sent[0].command, sent[0].z) == (1, MavCommand.NAV_WAYPOINT, 600.0)


@pytest.mark.parametrize("name", SCENES)
def test_pymavlink_reads_the_waypoints(tmp_path, name):
    m, frame = SCENES[name]
    save(m, tmp_path / "entry.waypoints", frame=frame, altitude_m=600.0)
    loader = mavwp.MAVWPLoader()
    expected = mission(m, frame, 600.0)
    assert loader.load(str(tmp_path / "entry.waypoints")) == len(expected.items) + 1
    for sequence, item in enumerate(expected.items, start=1):
        read = loader.wp(sequence)
        params = read.param1, read.param2, read.param3, read.param4
        assert (read.seq, read.frame, read.command, *params, read.z, read.autocontinue) == as_sent(item, sequence)
        assert (read.x, read.y) == pytest.approx((item.latitude_deg, item.longitude_deg), abs=1e-9)
    home = loader.wp(0)
    assert (home.current, home.x, home.y, home.z) == pytest.approx((1, *expected.home[:2], 600.0), abs=1e-9)


@pytest.mark.parametrize(("turn", "radius"), [("cw", 120.0), ("ccw", -120.0)])
def test_peers_read_the_way_round(peer, tmp_path, turn, radius):
    m, frame = entry(turn)
    save(m, tmp_path / "entry.plan", frame=frame, altitude_m=600.0)
    save(m, tmp_path / "entry.txt", frame=frame, altitude_m=600.0)
    loiter = peer[1].import_qgroundcontrol_mission(str(tmp_path / "entry.plan")).mission_items[-1]
    loader = mavwp.MAVWPLoader()
    loader.load(str(tmp_path / "entry.txt"))
    assert (loiter.command, loiter.param3) == (mavlink.MAV_CMD_NAV_LOITER_UNLIM, radius)
    last = loader.wp(loader.count() - 1)
    assert (last.command, last.param3) == (mavlink.MAV_CMD_NAV_LOITER_UNLIM, radius)


def test_a_plan_has_what_qgroundcontrol_asks_for(tmp_path):
    """The keys and types that its loaders demand: PlanMasterController, MissionController, MissionItem,
    SimpleMissionItem, GeoFenceController, RallyPointController."""
    m, frame = SCENES["wind"]
    save(m, tmp_path / "entry.plan", frame=frame, altitude_m=600.0, autopilot=Autopilot.PX4)
    plan = json.loads((tmp_path / "entry.plan").read_text())
    assert (plan["fileType"], plan["version"], plan["groundStation"]) == ("Plan", 1, "QGroundControl")
    assert plan["geoFence"] == {"circles": [], "polygons": [], "version": 2}
    assert plan["rallyPoints"] == {"points": [], "version": 2}
    flown = plan["mission"]
    assert (flown["version"], flown["firmwareType"], flown["vehicleType"]) == (2, 12, 1)
    assert (flown["cruiseSpeed"], flown["hoverSpeed"]) == (18.0, 18.0)
    assert flown["globalPlanAltitudeMode"] == 2
    assert [len(flown["plannedHomePosition"]), flown["plannedHomePosition"][2]] == [3, 600.0]
    for number, item in enumerate(flown["items"], start=1):
        assert item["type"] == "SimpleItem"
        assert (item["frame"], item["doJumpId"], item["autoContinue"]) == (0, number, True)
        assert (item["AltitudeMode"], item["Altitude"], item["AMSLAltAboveTerrain"]) == (2, 600.0, None)
        assert len(item["params"]) == 7


# Read back

PLACES = st.tuples(st.floats(-90.0, 90.0), st.floats(-180.0, 180.0), st.floats(-1e3, 1e4))
NUMBERS = st.floats(-1e6, 1e6)
ITEMS = st.builds(
    lambda command, frame, params, place, going_on: MissionItem(command, frame, params, *place, going_on),
    st.sampled_from([16, 17, 18, 22, 93, 178, 65535]),
    st.sampled_from(list(Frame)),
    st.tuples(*[NUMBERS] * 4),
    PLACES,
    st.booleans(),
)
MISSIONS = st.builds(lambda items, home: Mission(tuple(items), home), st.lists(ITEMS, min_size=1, max_size=5), PLACES)


def read_text(tmp_path_factory, name, content):
    path = Path(tmp_path_factory.mktemp("missions")) / name
    path.write_bytes(content)
    return read_mission(path)


@given(flown=MISSIONS)
def test_a_plan_is_read_back_to_the_last_bit(tmp_path_factory, flown):
    assert read_text(tmp_path_factory, "a.plan", qgcplan(flown, Autopilot.PX4, 18.0)) == flown


@given(flown=MISSIONS)
def test_waypoints_are_read_back_with_nine_decimals(tmp_path_factory, flown):
    read = read_text(tmp_path_factory, "a.txt", wpl(flown))
    # Half of the last decimal, and how far apart doubles are next to a million.
    coarse = 5e-10 + 2.0**-33
    assert read.home == pytest.approx(flown.home, abs=coarse)
    for mine, theirs in zip(flown.items, read.items, strict=True):
        assert (*theirs[:2], *theirs.params, *theirs[3:]) == pytest.approx(
            (*mine[:2], *mine.params, *mine[3:]), abs=coarse, rel=0.0
        )


def test_a_parameter_that_is_the_autopilots_own_is_null_in_a_plan(tmp_path):
    item = MissionItem(16, 3, (0.0, 0.0, 0.0, nan), 47.0, 8.0, 100.0)
    (tmp_path / "a.plan").write_bytes(qgcplan(Mission((item,), (47.0, 8.0, 500.0)), Autopilot.PX4, 18.0))
    assert json.loads((tmp_path / "a.plan").read_text())["mission"]["items"][0]["params"][3] is None
    (read,) = read_mission(tmp_path / "a.plan").items
    assert isnan(read.params[3])
    assert read._replace(params=item.params) == item


@pytest.mark.parametrize("text", ["nan", "NaN"])
def test_a_parameter_that_is_the_autopilots_own_is_nan_among_waypoints(tmp_path, text):
    """As pymavlink and MAVProxy write what PX4 keeps for the heading of a waypoint."""
    item = MissionItem(16, 3, (0.0, 0.0, 0.0, nan), 47.0, 8.0, 100.0)
    (tmp_path / "a.waypoints").write_text(wpl(Mission((item,), (47.0, 8.0, 500.0))).decode().replace("nan", text))
    (read,) = read_mission(tmp_path / "a.waypoints").items
    assert isnan(read.params[3])
    assert read._replace(params=item.params) == item


def test_a_jump_finds_its_goal_among_the_items(tmp_path):
    """QGroundControl numbers `doJumpId` with gaps where complex items were."""
    items = [MissionItem(16, 3, (0.0,) * 4, 47.0, 8.0, 100.0), MissionItem(177, 2, (7.0, 2.0, 0.0, 0.0), 0.0, 0.0, 0.0)]
    plan = json.loads(qgcplan(Mission(tuple(items), (47.0, 8.0, 500.0)), Autopilot.PX4, 18.0))
    plan["mission"]["items"][0]["doJumpId"] = 7
    (tmp_path / "a.plan").write_text(json.dumps(plan))
    assert read_mission(tmp_path / "a.plan").items[1].params == (1.0, 2.0, 0.0, 0.0)
    plan["mission"]["items"][0]["doJumpId"] = 6
    (tmp_path / "a.plan").write_text(json.dumps(plan))
    with pytest.raises(InvalidArgument, match=r"item 2: it jumps to doJumpId 7: no item has it$"):
        read_mission(tmp_path / "a.plan")


def test_waypoints_of_mission_planner_and_mavproxy_are_read(tmp_path):
    """As these write them: CRLF and blanks, spaces for tabs, home at 0 0, an item without a place."""
    (tmp_path / "a.waypoints").write_bytes(
        b"QGC WPL 110\r\n"
        b"0\t1\t0\t16\t0\t0\t0\t0\t0\t0\t0\t1\r\n"
        b"1 0 3 22 15.00000000 0.00000000 0.00000000 0.00000000 -35.36000000 149.16000000 50.000000 1\r\n"
        b"2\t0\t3\t17\t0\t0\t-90\t0\t-35.361\t149.161\t100\t1\r\n"
        b"3\t0\t2\t20\t0\t0\t0\t0\t0\t0\t0\t0\r\n\r\n"
    )
    read = read_mission(tmp_path / "a.waypoints")
    assert read.home == (0.0, 0.0, 0.0)
    assert [item.command for item in read.items] == [22, 17, 20]
    assert read.items[1] == MissionItem(17, 3, (0.0, 0.0, -90.0, 0.0), -35.361, 149.161, 100.0)
    assert read.items[2] == MissionItem(20, 2, (0.0,) * 4, 0.0, 0.0, 0.0, autocontinue=False)


GOOD = MissionItem(16, 3, (0.0,) * 4, 47.0, 8.0, 100.0)


def plan_with(**changes):
    """A plan of one item with some of the item's keys changed, or taken away where the value is ..."""
    document = json.loads(qgcplan(Mission((GOOD,), (47.0, 8.0, 500.0)), Autopilot.ARDUPILOT, 18.0))
    item = document["mission"]["items"][0]
    for key, value in changes.items():
        item.pop(key, None)
        if value is not ...:
            item[key] = value
    return json.dumps(document)


def whole_plan_with(path, value):
    """A plan with one value changed."""
    document = json.loads(plan_with())
    *keys, last = path
    inner = document
    for key in keys:
        inner = inner[key]
    inner[last] = value
    return json.dumps(document)


ROW = "1\t0\t3\t16\t0\t0\t0\t0\t47\t8\t100\t1"
HOME = "0\t1\t0\t16\t0\t0\t0\t0\t47\t8\t500\t1"
TAKEOFF = "0\t1\t3\t22\t15\t0\t0\t0\t47\t8\t50\t1"
JUMP = "{}\t0\t2\t177\t{}\t3\t0\t0\t0\t0\t0\t1"


def rows(*lines, header="QGC WPL 110"):
    return "\n".join([header, *lines]) + "\n"


@pytest.mark.parametrize("home", [HOME, HOME.replace("\t16\t", "\t0\t")])
def test_the_first_line_is_home_if_it_is_a_waypoint(tmp_path, home):
    (tmp_path / "a.txt").write_text(rows(home, ROW))
    read = read_mission(tmp_path / "a.txt")
    assert (read.home, read.items) == ((47.0, 8.0, 500.0), (GOOD,))


def test_a_first_line_that_is_no_waypoint_is_the_first_item(tmp_path):
    """Its numbers count from that item: here the jump is back to the waypoint."""
    loiter = ROW.replace("1\t0\t3\t16", "2\t0\t3\t17", 1)
    (tmp_path / "a.txt").write_text(rows(TAKEOFF, ROW, loiter, JUMP.format(3, 1)))
    read = read_mission(tmp_path / "a.txt")
    assert [item.command for item in read.items] == [22, 16, 17, 177]
    assert read.items[-1].params == (2.0, 3.0, 0.0, 0.0)
    assert all(map(isnan, read.home))


def test_lines_of_comments_are_passed_over(tmp_path):
    """As MAVProxy does."""
    (tmp_path / "a.txt").write_text(rows("", "# home", HOME, "  # the field", ROW))
    assert read_mission(tmp_path / "a.txt").items == (GOOD,)


# MAV_FRAME: GLOBAL_INT, GLOBAL_RELATIVE_ALT_INT, GLOBAL_TERRAIN_ALT_INT.
@pytest.mark.parametrize(("frame", "same"), [(5, Frame.ABOVE_SEA), (6, Frame.ABOVE_HOME), (11, Frame.ABOVE_TERRAIN)])
def test_frames_whose_names_end_in_int_are_the_same_without(tmp_path, frame, same):
    for text in (plan_with(frame=frame), rows(HOME, ROW.replace("\t3\t", f"\t{frame}\t", 1))):
        (tmp_path / "a.plan").write_text(text)
        assert read_mission(tmp_path / "a.plan").items == (GOOD._replace(frame=same),)


def test_what_an_item_without_a_place_leaves_open_is_null_in_a_plan_and_read_back(tmp_path):
    """SET_CAMERA_MODE as QGroundControl writes it."""
    text = plan_with(command=530, frame=2, params=[0, 2, None, None, None, None, None])
    (tmp_path / "a.plan").write_text(text)
    read = read_mission(tmp_path / "a.plan")
    assert repr(read.items) == repr((MissionItem(530, 2, (0.0, 2.0, nan, nan), nan, nan, nan),))
    (tmp_path / "b.plan").write_bytes(qgcplan(read, Autopilot.PX4, 18.0))
    (tmp_path / "b.txt").write_bytes(wpl(read))
    for name in ("b.plan", "b.txt"):
        assert repr(read_mission(tmp_path / name)) == repr(read)


@pytest.mark.parametrize("home", [None, [None, None, None], [47.0, 8.0, None]])
def test_a_home_may_be_unknown(tmp_path, home):
    (tmp_path / "a.plan").write_text(whole_plan_with(["mission", "plannedHomePosition"], home))
    read = read_mission(tmp_path / "a.plan")
    assert repr(read.home) == repr((*(home[:2] if home and home[0] else (nan, nan)), nan))


def test_a_file_that_pymavlink_saved_is_read(tmp_path):
    loader = mavwp.MAVWPLoader()
    for number, (command, radius) in enumerate([(16, 0.0), (16, 0.0), (17, -75.0)]):
        place = (47.0 + number / 100.0, 8.0, 500.0)
        loader.add(mavlink.MAVLink_mission_item_message(1, 1, number, 0, command, 0, 1, 0, 0, radius, 0, *place))
    loader.save(str(tmp_path / "theirs.txt"))
    read = read_mission(tmp_path / "theirs.txt")
    assert read.home == pytest.approx((47.0, 8.0, 500.0), abs=1e-9)
    assert read.items[-1].params == (0.0, 0.0, -75.0, 0.0)


# Refusals


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("", "it is neither a QGroundControl plan nor a QGC WPL 110 file"),
        ("hello", "it is neither"),
        ("[]", "it is neither"),
        ("\x00" * 50, "it is neither"),
        ("{", "it is not JSON, expecting property name .* in line 1"),
        ("{}", "it is no plan of QGroundControl: it has no fileType"),
        ('{"a": 1, "a": 2}', "the key 'a' occurs twice in one object"),
        ('{"a": NaN}', "NaN is not a number in JSON"),
        ('{"a": -Infinity}', "-Infinity is not a number in JSON"),
        ('{"a":' * 100_000, "its lists and objects are nested too deeply"),
        ('{"fileType": "Plan", "version": ' + "9" * 5000 + "}", "version is inf: only 1 is read"),
        (whole_plan_with(["fileType"], "Params"), "fileType is 'Params': it must be 'Plan'"),
        (whole_plan_with(["version"], 2), "version is 2: only 1 is read"),
        (whole_plan_with(["version"], True), "version is True: only 1 is read"),
        (whole_plan_with(["version"], 10**60), r"version is 1e\+60: only 1 is read"),
        (whole_plan_with(["mission"], []), "mission is a list: it must be an object"),
        (whole_plan_with(["mission", "version"], 1), "the version of mission is 1: only 2 is read"),
        (whole_plan_with(["mission", "items"], {}), "items is an object: it must be a list"),
        (whole_plan_with(["mission", "items"], []), "the mission has no items"),
        (whole_plan_with(["mission", "items"], [7]), "item 1 is 7: it must be an object"),
        (whole_plan_with(["mission", "items"], [{}] * 2), "item 1 is None: only simple items are read"),
        (whole_plan_with(["mission", "plannedHomePosition"], [1, 2]), "plannedHomePosition is not a list of 3 numbers"),
        (whole_plan_with(["mission", "plannedHomePosition"], [1, 2, "3"]), "plannedHomePosition has '3': it must be a"),
        (
            whole_plan_with(["mission", "plannedHomePosition"], [91, 2, 3]),
            "plannedHomePosition: the latitude is 91: it",
        ),
        (
            plan_with(type="ComplexItem", complexItemType="survey"),
            "item 1 is 'survey': only simple items are read; sav",
        ),
        (plan_with(type=...), "item 1 is None: only simple items are read"),
        (plan_with(command=...), "item 1: command is None: it must be a whole number from 0 to 65535"),
        (plan_with(command=16.0), "item 1: command is 16.0: it must be a whole number"),
        (plan_with(command=-1), "item 1: command is -1: it must be a whole number"),
        (plan_with(command=70000), "item 1: command is 70000: it must be a whole number from 0 to 65535"),
        (plan_with(frame=4), "item 1: the frame is 4: only 0, 2, 3, 5, 6, 10, 11 are known"),
        (plan_with(frame=False), "item 1: frame is False: it must be a whole number"),
        (plan_with(autoContinue=1), "item 1: autoContinue is 1: it must be true or false"),
        (plan_with(params=[0] * 6), "item 1: params is not a list of 7 numbers"),
        (plan_with(params=["0"] * 7), "item 1: params has '0': it must be a finite number"),
        (plan_with(params=[0, 0, 0, 0, None, 8, 9]), "item 1: the latitude is nan: it must be from -90 to 90 degrees"),
        (plan_with(params=[0, 0, 0, 0, 9, 8, None]), "item 1: the altitude is nan: it must be from -83000 to 83000"),
        (plan_with(params=[0, 0, 0, 0, 91, 8, 9]), "item 1: the latitude is 91: it must be from -90 to 90 degrees"),
        (plan_with(params=[0, 0, 0, 0, 9, -181, 9]), "item 1: the longitude is -181: it must be from -180 to 180 deg"),
        (plan_with(params=[0, 0, 0, 0, 9, 8, 1e6]), r"item 1: the altitude is 1e\+06: it must be from -83000 to 83000"),
        (plan_with(params=[10**400, 0, 0, 0, 9, 8, 9]), "item 1: params has inf: it must be a finite number"),
        (plan_with(doJumpId="x"), "item 1: doJumpId is 'x': it must be a whole number"),
        (plan_with(command=177, params=[9, 0, 0, 0, 9, 8, 9]), "item 1: it jumps to doJumpId 9: no item has it"),
        (
            whole_plan_with(["mission", "items"], [json.loads(plan_with())["mission"]["items"][0]] * 2),
            "item 2: doJumpId is 1, as of item 1",
        ),
        (
            plan_with(command=224, params=[2, 0, 0, 0, 9, 8, 9]),
            "item 1: it refers to item 2: the mission has items 1 t",
        ),
        ("QGC WPL 110", "it ends after its first line"),
        ("QGC WPL 110\n# nothing\n", "it ends after its first line"),
        (rows(HOME, JUMP.format(1, 2)), "line 3: it jumps to item 2: the mission has items 1 to 1"),
        (
            rows(HOME, JUMP.format(1, 0), ROW.replace("1", "2", 1)),
            "line 3: it jumps to item 0: the mission has items 1",
        ),
        (rows(HOME, JUMP.format(1, 1.5)), "line 3: it jumps to item 1.5: the mission has items 1 to 1"),
        (rows(HOME, JUMP.format(1, "nan")), "line 3: it jumps to item nan: the mission has items 1 to 1"),
        (rows(TAKEOFF, JUMP.format(1, 2)), "line 3: it jumps to item 3: the mission has items 1 to 2"),
        (rows(HOME, ROW, header="QGC WPL 120"), "its first line is 'QGC WPL 120': it must be QGC WPL 110"),
        (rows(HOME, ROW, header="QGC WPL"), "its first line is 'QGC WPL': it must be QGC WPL 110"),
        (rows(HOME), "the mission has no items"),
        (rows(HOME, ROW[:-2]), "line 3: there are 11 fields: an item has 12"),
        (rows(HOME, ROW + "\t1"), "line 3: there are 13 fields: an item has 12"),
        (rows(HOME, ROW.replace("1", "2", 1)), "line 3: the item's number is 2: it must be 1, they count from 0"),
        (rows(HOME, ROW, ROW), "line 4: the item's number is 1: it must be 2"),
        (rows(ROW), "line 2: the item's number is 1: it must be 0"),
        (
            rows(HOME, ROW.replace("1", "one", 1)),
            "line 3: the item's number is 'one': it must be a whole number from 0",
        ),
        (rows(HOME, ROW.replace("\t0\t", "\t2\t", 1)), "line 3: the mark of the current item is '2': it must be a who"),
        (rows(HOME, ROW.replace("\t3\t", "\t4\t", 1)), "line 3: the frame is 4: only 0, 2, 3, 5, 6, 10, 11"),
        (rows(HOME, ROW.replace("\t16\t", "\t99999\t")), "line 3: the command is '99999': it must be a whole number"),
        (rows(HOME, ROW.replace("\t47\t", "\tnan\t")), "line 3: the latitude is nan: it must be from -90 to 90 degre"),
        (rows(HOME, ROW.replace("\t47\t", "\t1e999\t")), "line 3: a number is '1e999': it must be a finite number"),
        (rows(HOME, ROW.replace("\t47\t", "\t4_7\t")), "line 3: a number is '4_7': it must be a finite number"),
        (rows(HOME, ROW.replace("\t47\t", "\t４７\t")), "line 3: a number is '４７': it must be a finite number"),
        (rows(HOME, ROW.replace("\t47\t", "\t-91\t")), "line 3: the latitude is -91: it must be from -90 to 90 degre"),
        (rows(HOME.replace("\t8\t", "\t500\t"), ROW), "line 2: the longitude is 500: it must be from -180 to 180 deg"),
        (rows(HOME, ROW.replace("\t100\t1", "\t100\t7")), "line 3: autocontinue is '7': it must be a whole number fr"),
    ],
)
def test_what_is_no_mission_is_refused_in_a_sentence(tmp_path, text, sentence):
    (tmp_path / "a.plan").write_text(text)
    with pytest.raises(InvalidArgument, match=rf"^mission file '.*a\.plan': {sentence}") as refusal:
        read_mission(tmp_path / "a.plan")
    assert refusal.value.argument == "mission"
    assert "\n" not in str(refusal.value)
    assert len(str(refusal.value)) < 250 + len(str(tmp_path))


@pytest.mark.parametrize(
    ("content", "sentence"),
    [
        (b"QGC WPL 110\n\xff\xfe", "it is not UTF-8 text, see byte 12"),
        ("QGC WPL 110\n".encode("utf-16"), "it is not UTF-8 text, see byte 0"),
    ],
)
def test_another_encoding_is_refused(tmp_path, content, sentence):
    (tmp_path / "a.plan").write_bytes(content)
    with pytest.raises(InvalidArgument, match=rf"^mission file '.*a\.plan': {sentence}$"):
        read_mission(tmp_path / "a.plan")


def test_a_byte_order_mark_is_none_of_the_text(tmp_path):
    (tmp_path / "a.txt").write_bytes(rows(HOME, ROW).encode("utf-8-sig"))
    assert len(read_mission(tmp_path / "a.txt").items) == 1


def test_more_items_than_mavlink_counts_are_refused(tmp_path):
    lines = [HOME, *(ROW.replace("1", str(n), 1) for n in range(1, 65537))]
    (tmp_path / "a.txt").write_text(rows(*lines))
    with pytest.raises(InvalidArgument, match=r": line 65538: the item's number is '65536': it must be .* to 65535$"):
        read_mission(tmp_path / "a.txt")


def test_a_huge_file_is_refused_before_it_is_read(tmp_path):
    with (tmp_path / "a.plan").open("wb") as file:
        file.truncate(MAX_BYTES + 1)
    with pytest.raises(InvalidArgument, match=r": it is longer than 32,000,000 bytes$"):
        read_mission(tmp_path / "a.plan")


@pytest.mark.parametrize(
    ("name", "sentence"),
    [
        ("none.plan", "it cannot be read, No such file or directory"),
        (".", "it cannot be read, Is a directory"),
        ("a\x00b", "it cannot be read, embedded null byte"),
    ],
)
def test_a_file_that_cannot_be_read_is_refused(tmp_path, name, sentence):
    with pytest.raises(InvalidArgument, match=rf": {sentence}$"):
        read_mission(tmp_path / name)


def test_a_sentence_quotes_no_more_than_it_must(tmp_path):
    fault = Source("mission", tmp_path).fault
    assert str(fault("it is")).endswith("': it is")
    (tmp_path / "a.txt").write_text(rows(HOME, ROW.replace("\t47\t", "\t" + "4" * 1_000_000 + "x\t")))
    with pytest.raises(InvalidArgument, match=r": line 3: a number is '4{36}\.\.\.: it must be a finite number$"):
        read_mission(tmp_path / "a.txt")
