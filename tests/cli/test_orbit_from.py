"""`--orbit-from`: circle, fence and home of an existing mission."""

import json

import pytest

import loiter
from flight.vehicle import Vehicle, flying
from loiter.fences import PlacedCircle
from loiter.files import MissionCircle, read_site

pytestmark = pytest.mark.usefixtures("quick")

UAV = "--airspeed 18 --bank 35"
START = "--pose-lla 47.1 8.2 90"
FRAME = loiter.geo.LocalFrame(47.11, 8.23)


def box(metres, inclusion=True):
    """A square fence about the circle, as QGroundControl writes it."""
    corners = [(-metres, -metres), (metres, -metres), (metres, metres), (-metres, metres)]
    latitude, longitude = FRAME.to_geodetic(*zip(*corners, strict=True))
    return {
        "inclusion": inclusion,
        "polygon": [list(c) for c in zip(latitude.tolist(), longitude.tolist(), strict=True)],
        "version": 1,
    }


def ring(metres, inclusion=True):
    return {"circle": {"center": [47.11, 8.23], "radius": metres}, "inclusion": inclusion, "version": 1}


@pytest.fixture
def existing(tmp_path, shown):
    """A plan of QGroundControl with a survey, a circle held counter-clockwise, a home and a fence."""

    def written(circles=(), polygons=(), change=lambda document: None):
        path = tmp_path / "existing.plan"
        shown(f"plan {START} --orbit-lla 47.11 8.23 120 --turn ccw {UAV} --altitude 900 --save {path}")
        document = json.loads(path.read_text())
        document["geoFence"] = {"circles": list(circles), "polygons": list(polygons), "version": 2}
        document["mission"]["plannedHomePosition"] = [47.09, 8.21, 450.0]
        document["mission"]["items"].insert(0, {"type": "ComplexItem", "complexItemType": "survey"})
        change(document)
        path.write_text(json.dumps(document))
        return path

    return written


def test_the_circle_and_its_direction_are_those_of_the_mission(existing, shown, planned):
    path = existing()
    same = planned(f"{START} --orbit-lla 47.11 8.23 120 --turn ccw {UAV}")
    got = planned(f"{START} --orbit-from {path} {UAV}")
    assert (got["word"], got["turn"]) == (same["word"], same["turn"])
    assert got["duration_s"] == pytest.approx(same["duration_s"], abs=1e-6)
    text = shown(f"plan {START} --orbit-from {path} {UAV}")
    assert text.splitlines()[0] == f"Circle of item 3 in {path}."
    assert "counter-clockwise: joins in" in text
    assert "fence" not in text
    assert planned(f"{START} --orbit-from {path} --turn cw {UAV}")["turn"] == "cw"


def test_a_file_of_waypoints_has_a_circle_too(tmp_path, shown, planned):
    path = tmp_path / "existing.waypoints"
    shown(f"plan {START} --orbit-lla 47.11 8.23 120 --turn ccw {UAV} --altitude 900 --save {path}")
    assert planned(f"{START} --orbit-from {path} {UAV}")["turn"] == "ccw"


def test_home_and_fence_are_kept(existing, shown, tmp_path):
    path = existing([ring(4000.0)], [box(5000.0)])
    new = tmp_path / "new.plan"
    above_home = "--altitude 120 --altitude-reference home"
    text = shown(
        f"plan {START} --orbit-from {path} {UAV} {above_home} --save {new} --save {tmp_path / 'new.waypoints'}"
    )
    before, after = (json.loads(file.read_text()) for file in (path, new))
    assert after["geoFence"] == before["geoFence"]
    assert after["mission"]["plannedHomePosition"] == [47.09, 8.21, 450.0]
    assert {item["frame"] for item in after["mission"]["items"]} == {3}
    assert loiter.files.read_mission(tmp_path / "new.waypoints").home == (47.09, 8.21, 450.0)
    assert "The plan and its hold stay clear of the fence, " in text


def test_an_upload_outside_the_fence_is_refused(existing, refusal):
    """The start, 2534 m from the middle of a fence of 2000 m, and a hold that enters a zone."""
    for circles, problem in (
        ([ring(2000.0)], "--pose is outside the inclusion zone 'circle 1': a plan must begin inside"),
        (
            [ring(150.0, inclusion=False)],
            "--fence is not kept, and nothing is sent: The plan enters the zone 'circle 1'",
        ),
    ):
        path = existing(circles)
        with flying(Vehicle([])) as vehicle:
            arguments = f"upload --connect {vehicle.connection} {START} --orbit-from {path} {UAV} --altitude 900"
            assert problem in refusal(arguments)
            assert vehicle.mission == []


@pytest.mark.parametrize(
    ("arguments", "where"),
    [
        ("fleet none.csv --airspeed 18 --bank 35", "for fleets"),
        ("guide-fleet none.csv --yes", "for fleets"),
        ("guide --connect udpin:127.0.0.1:14550 --slot 90 --yes", "for slots"),
        ("watch --connect udpin:127.0.0.1:14550 --airspeed 18 --bank 35 --send", "with --send"),
        (f"fly {START} --slot 90 {UAV}", "with --slot"),
    ],
)
def test_a_fence_that_would_not_be_checked_is_refused(existing, refusal, arguments, where):
    sentence = refusal(f"{arguments} --orbit-from {existing([ring(4000.0)])}")
    assert sentence == f"loiter: --orbit-from has a fence, which is not checked {where}: give --orbit-lla"


def test_watching_says_that_the_fence_is_not_checked(existing, shown):
    with flying(Vehicle([])) as vehicle:
        text = shown(f"watch --connect {vehicle.connection} {UAV} --reports 1 --orbit-from {existing([ring(4000.0)])}")
    assert text.splitlines()[0] == "The fence of --orbit-from is not checked."


def test_a_site_is_read(existing):
    site = read_site(existing([ring(500.0, inclusion=False)], [box(3000.0)]))
    assert site.home == (47.09, 8.21, 450.0)
    [circle] = site.circles
    assert circle == MissionCircle(3, pytest.approx(47.11), pytest.approx(8.23), 120.0, loiter.Turn.CCW)
    polygon, ring_outside = site.fence.zones
    assert ring_outside == PlacedCircle("circle 1", 47.11, 8.23, 500.0, False)
    assert (len(polygon.corners), polygon.inclusion) == (4, True)


def first_area(kind, key, value):
    def change(document):
        document["geoFence"][kind][0][key] = value

    return change


@pytest.mark.parametrize(
    ("change", "problem"),
    [
        (lambda d: d.update(geoFence=3), "geoFence is 3: it must be an object"),
        (first_area("circles", "inclusion", "yes"), "geoFence: circle 1: inclusion is 'yes': it must be true or false"),
        (first_area("circles", "circle", {"center": [147, 8], "radius": 1}), "geoFence: circle 1: the latitude is 147"),
        (first_area("circles", "circle", {"center": [47, 8], "radius": 0}), "radius is 0: it must be positive"),
        (first_area("polygons", "polygon", [[47, 8], [47, 9]]), "geoFence: polygon 1: it has 2 corners"),
        (first_area("polygons", "polygon", [[47], [47, 9], [48, 8]]), "geoFence: polygon 1 is not a list of 2 numbers"),
        (lambda d: d["mission"].update(plannedHomePosition=[47]), "plannedHomePosition is not a list of 3 numbers"),
        (
            lambda d: d["mission"].update(items=d["mission"]["items"][:1]),
            "its mission has no loiter with a place, and items of these kinds are not read: item 1, 'survey'",
        ),
        (lambda d: d["mission"].update(items=d["mission"]["items"][1:2]), "its mission has no loiter with a place"),
        (
            lambda d: d["mission"]["items"][-1]["params"].__setitem__(slice(4, 6), [0, 0]),
            "its mission has no loiter with a place",
        ),
    ],
)
def test_what_cannot_be_read_is_named(existing, refusal, change, problem):
    path = existing([ring(500.0)], [box(500.0)], change)
    err = refusal(["plan", *START.split(), "--orbit-from", str(path), *UAV.split()])
    assert problem in err
    assert str(path) in err


def unneeded(document):
    """Items that are no circles, some of which no mission could have; loiters without a place; no home."""
    loiter = document["mission"]["items"][-1]
    waypoint = document["mission"]["items"][1]
    before = [
        waypoint | {"command": 530, "frame": 2, "params": [0, 2] + [None] * 5},
        waypoint | {"command": 177, "frame": 2, "params": [99] + [0] * 6},
        waypoint | {"frame": 4, "params": [0] * 3},
        loiter | {"params": [0, 0, 70, 0, 0, 0, 100]},
        loiter | {"params": [0, 0, 70, 0, None, None, 100]},
    ]
    loiter["params"][6] = None
    document["mission"].update(items=[*before, loiter], plannedHomePosition=None)


def test_what_is_not_needed_of_a_mission_does_not_matter(existing, planned):
    asked = planned(f"{START} --orbit-lla 47.11 8.23 120 --turn ccw {UAV}")
    got = planned(f"{START} --orbit-from {existing(change=unneeded)} {UAV}")
    assert got["duration_s"] == pytest.approx(asked["duration_s"], abs=1e-6)
    assert got["turn"] == "ccw"


def test_what_is_not_needed_of_waypoints_does_not_matter(tmp_path):
    path = tmp_path / "theirs.waypoints"
    path.write_text(
        "QGC WPL 110\n# no home\n7 1 3 22 0 0\n8 0 0 177 50 0 0 0 0 0 0 1\n9 0 6 17 0 0 -120 0 47.11 8.23 nan 1\n"
        "9 0 3 19 60 0 1 0 47.12 8.24 100 1\n9 0 3 19 60 0 -1 0 0 0 100 1\n"
    )
    site = read_site(path)
    assert site.circles == (
        MissionCircle(3, 47.11, 8.23, 120.0, loiter.Turn.CCW),
        MissionCircle(4, 47.12, 8.24, None, None),
    )
    assert (site.home_altitude_m, site.fence) == (None, None)


@pytest.mark.parametrize("home", [[47.09, 8.21, None], [0, 0, 0], None])
def test_the_altitude_of_home_is_asked_for_only_where_it_is_needed(existing, shown, refusal, tmp_path, home):
    path = existing(change=lambda document: document["mission"].update(plannedHomePosition=home))
    new = tmp_path / "new.plan"
    save = f"plan {START} --orbit-from {path} {UAV} --save {new}"
    text = shown(f"{save} --altitude 900")
    assert "The altitude of home is not known, so it is 900 m too" in text
    latitude, longitude, altitude = loiter.files.read_mission(new).home
    expected = (47.09, 8.21) if home and home[0] else (47.1, 8.2)
    assert (latitude, longitude, altitude) == (*(pytest.approx(x, abs=1e-7) for x in expected), 900.0)
    assert "--home-altitude is missing" in refusal(f"{save} --altitude 120 --altitude-reference home")
    shown(f"{save} --altitude 120 --altitude-reference home --home-altitude 450")
    assert loiter.files.read_mission(new).home[2] == 450.0


@pytest.mark.parametrize(
    ("sign", "own", "turn"), [(1.0, 90.0, "cw"), (1.0, -90.0, "ccw"), (-1.0, 90.0, "ccw"), (-1.0, -90.0, "ccw")]
)
@pytest.mark.parametrize(("firmware", "radius"), [(12, 1.0), (3, 1.0), (3, 120.0)])
def test_the_radius_of_a_loiter_for_a_time_is_that_of_arduplane(
    existing, planned, tmp_path, firmware, radius, sign, own, turn
):
    """ArduPlane stores only its sign; without a minus it holds in the direction of WP_LOITER_RAD."""

    def change(document):
        document["mission"]["firmwareType"] = firmware
        loiter_item = document["mission"]["items"][-1]
        loiter_item.update(command=19, params=[60, 0, sign * radius, 0, *loiter_item["params"][4:]])

    parameters = tmp_path / "uav.param"
    parameters.write_text(f"WP_LOITER_RAD,{own}\n")
    got = planned(f"{START} --orbit-from {existing(change=change)} --params {parameters} {UAV}")
    asked = planned(f"{START} --orbit-lla 47.11 8.23 90 --turn {turn} {UAV}")
    assert got["turn"] == turn
    assert got["duration_s"] == pytest.approx(asked["duration_s"], abs=1e-6)


def test_a_loiter_without_a_radius_needs_one(existing, refusal):
    def change(document):
        document["mission"]["items"][-1]["params"][2] = None

    path = existing(change=change)
    line = refusal(["plan", *START.split(), "--orbit-from", str(path), *UAV.split()])
    assert "--orbit-from has a loiter without a radius, which --params with a radius gives" in line


def test_only_one_circle_is_given(existing, refusal):
    path = existing()
    scene = [*START.split(), "--orbit-from", str(path), "--orbit-lla", "47", "8", "120", *UAV.split()]
    assert "--orbit or --orbit-lla or --orbit-from is needed, and only one of them" in refusal(["plan", *scene])
