"""`loiter fleet`: a table of aircraft in; tables, JSON, pictures, maps and missions out (docs/slots.md)."""

import json
from pathlib import Path
from xml.etree import ElementTree as ET

import pytest

from loiter import Aircraft, Orbit, Pose
from loiter.files import read_mission
from loiter.fleets import fleet
from loiter.geo import LocalFrame

UAV = "--airspeed 18 --bank 35"
CIRCLE = f"--orbit 0 0 120 {UAV}"
ROWS = "name,east_m,north_m,heading_deg\nnorth,-400,120,90\nsouth,300,-500,0\nmast,0,700,180\n"
POSES = [Pose(-400.0, 120.0, 90.0), Pose(300.0, -500.0, 0.0), Pose(0.0, 700.0, 180.0)]
FRAME = LocalFrame(47.11, 8.23)


@pytest.fixture
def table(tmp_path, monkeypatch):
    """Writes fleet.csv into the present folder."""
    monkeypatch.chdir(tmp_path)
    return lambda text=ROWS: Path("fleet.csv").write_text(text, "utf-8")


def in_degrees(poses=POSES):
    """The rows of a table of places on Earth."""
    placed = [FRAME.place(pose) for pose in poses]
    rows = [f"{p.latitude_deg:.12f},{p.longitude_deg:.12f},{p.heading_deg:.12f}" for p in placed]
    return "\n".join(["latitude_deg,longitude_deg,heading_deg", *rows])


def test_json_has_the_plan_of_the_library_with_names(table, shown):
    table()
    answer = json.loads(shown(f"fleet fleet.csv {CIRCLE} --separation 100 --json"))
    planned = fleet(POSES, Orbit(0.0, 0.0, 120.0), Aircraft(18.0, max_bank_deg=35.0), separation_m=100.0)
    for each, name, pose in zip(answer["aircraft"], ("north", "south", "mast"), POSES, strict=True):
        assert (each.pop("name"), each.pop("layer_height_m")) == (name, 0.0)
        # The bearing of a slot at the start is what `loiter plan --slot` takes.
        scene = f"--pose {pose.east_m} {pose.north_m} {pose.heading_deg} --turn {planned.turn} {CIRCLE}"
        slot = json.loads(shown(f"plan {scene} --slot {each.pop('slot_bearing_deg')} --json"))
        assert slot["duration_s"] == pytest.approx(each["entry"]["duration_s"], abs=1e-3)
    assert answer == json.loads(json.dumps(planned.to_dict()))


def test_columns_of_other_names_and_units(table, shown):
    table("X [km],y,hdg(rad)\n-0.4,120,1.5707963267948966\n0.3,-500,0\n0,700,3.141592653589793\n")
    mapped = "--map 'east_m=X [km]' --map north_m=y --map 'heading_deg=hdg(rad)'"
    other = shown(f"fleet fleet.csv {CIRCLE} {mapped}")
    table()
    assert [line.split()[1:] for line in shown(f"fleet fleet.csv {CIRCLE}").splitlines()[2:5]] == [
        [word if word not in "123" else {"1": "north", "2": "south", "3": "mast"}[word] for word in line.split()[1:]]
        for line in other.splitlines()[2:5]
    ]


def test_who_comes_too_close_flies_in_a_layer(table, shown):
    near = [Pose(-400.0, 120.0, 90.0), Pose(-402.0, 121.0, 90.0), Pose(0.0, 700.0, 180.0)]
    table(in_degrees(near))
    options = f"--orbit-lla 47.11 8.23 120 {UAV} --separation 60 --layer-height 25 --altitude 900"
    text = shown(f"fleet fleet.csv {options} --save out.plan --save out.waypoints --save fleet.kml")
    assert "No plan that was tried keeps 60 m: there are 2 altitude layers, 25 m apart." in text
    assert "An autopilot flies a mission in its own time: it does not keep the slot." in text
    heights = []
    for i in (1, 2, 3):
        mission = read_mission(f"out-{i}.plan")
        assert mission.items == read_mission(f"out-{i}.waypoints").items or len(mission.items) > 3
        heights.append({item.altitude_m for item in mission.items})
    assert sorted(map(sorted, heights)) == [[900.0], [900.0], [925.0]]
    folders = ET.parse("fleet.kml").getroot().findall(".//{*}Folder")
    assert [folder.findtext("{*}name")[:2] for folder in folders] == ["1:", "2:", "3:"]


def test_maps_have_all_aircraft(table, shown):
    table(in_degrees())
    shown(f"fleet fleet.csv --orbit-lla 47.11 8.23 120 {UAV} --save fleet.geojson --save fleet.gpx")
    features = json.loads(Path("fleet.geojson").read_text("utf-8"))["features"]
    assert {feature["properties"]["aircraft"] for feature in features} == {"1", "2", "3"}
    assert len(ET.parse("fleet.gpx").getroot().findall("{*}trk")) == 3


def test_pictures(table, shown):
    table()
    shown(f"fleet fleet.csv {CIRCLE} --plot fleet.svg")
    drawn = Path("fleet.svg").read_text("utf-8")
    assert [drawn.count(f'id="{gid}"') for gid in ("slot", "start", "join", "circle")] == [3, 3, 3, 1]


@pytest.mark.parametrize(
    ("rows", "problem"),
    [
        (None, "it cannot be read, No such file or directory"),
        ("", "it has no column east_m: it needs east_m, north_m, heading_deg"),
        ("east_m,north_m,heading_deg\n", "it has no rows: each aircraft is one"),
        (
            "east_m,north_m,hdg\n1,2,3\n",
            "it has no column heading_deg: it needs east_m, north_m, heading_deg; if 'hdg'",
        ),
        (
            "east_m;north_m;heading_deg\n1;2;3\n",
            "it has no column east_m: it needs east_m, north_m, heading_deg; its f",
        ),
        (
            "east_m;north_m;heading_deg\n1,5;2;3\n",
            "line 2 has 2 fields, the header 1; its fields are separated by semi",
        ),
        (ROWS + "x,1,2\n", "line 5 has 3 fields, the header 4"),
        (ROWS + "x,1,2,east\n", "line 5 has 'east' in the column heading_deg, which is no number"),
        (ROWS + "mast,1,2,3\n", "two aircraft have the name 'mast'"),
        (ROWS + "a/b,1,2,3\n", "the name 'a/b' cannot be part of the name of a file"),
        (ROWS + "x,nan,2,3\n", "aircraft x: pose east_m is nan: it must be a finite number of metres"),
        ("airspeed_m_s,east_m,north_m,heading_deg\n9,1,2,3\n", "it has a column airspeed_m_s, but all aircraft of a"),
    ],
)
def test_a_bad_table_gets_a_sentence(table, refusal, rows, problem):
    if rows is not None:
        table(rows)
    assert refusal(["fleet", "fleet.csv", *CIRCLE.split()]).startswith(f"loiter: FILE is 'fleet.csv': {problem}")


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        (f"--orbit-lla 47 8 120 {UAV}", "FILE is 'fleet.csv': its positions are in metres: --orbit goes with them"),
        (UAV, "--orbit or --orbit-lla or --orbit-from is needed"),
        (f"--orbit 0 0 20 {UAV}", "orbit radius 20 m is tighter than the aircraft can turn"),
        (f"{CIRCLE} --separation -1", "--separation is -1.0: it must be zero or a positive, finite number"),
        (f"{CIRCLE} --save fleet.csv", "--save is 'fleet.csv': a .csv file has a single track"),
        (f"{CIRCLE} --save fleet.kml", "--orbit-lla is missing: a .kml file needs places on Earth"),
        (f"{CIRCLE} --layer-height 0", "--layer-height is 0.0: it must be a positive"),
    ],
)
def test_bad_input_gets_a_sentence(table, refusal, options, sentence):
    table()
    assert refusal(["fleet", "fleet.csv", *options.split()]).startswith(f"loiter: {sentence}")
    assert {path.name for path in Path().iterdir()} <= {"fleet.csv"}


def test_more_than_a_hundred_are_refused(table, refusal):
    table("east_m,north_m,heading_deg\n" + "".join(f"{i},500,0\n" for i in range(101)))
    assert refusal(["fleet", "fleet.csv", *CIRCLE.split()]) == "loiter: poses are 101: a fleet has 1 to 100 aircraft"
