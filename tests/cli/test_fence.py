"""`--fence`: whether a plan and its hold stay clear of a fence."""

import json

import pytest

import loiter
from loiter.cli.app import main
from loiter.files import read_fence
from loiter.geo import LocalFrame

FRAME = LocalFrame(47.11, 8.23)
UAV = "--airspeed 18 --bank 35"
SCENE = f"--pose-lla 47.1 8.2 90 --orbit-lla 47.11 8.23 120 {UAV}"


@pytest.fixture
def fence(tmp_path):
    """Writes a .plan whose fence has circles, given by east, north, radius and whether to stay inside."""

    def written(*circles):
        areas = []
        for east_m, north_m, radius_m, inclusion in circles:
            place = [float(value) for value in FRAME.to_geodetic(east_m, north_m)]
            areas.append({"circle": {"center": place, "radius": radius_m}, "inclusion": inclusion, "version": 1})
        path = tmp_path / "field.plan"
        document = {"fileType": "Plan", "version": 1, "geoFence": {"circles": areas, "polygons": [], "version": 2}}
        path.write_text(json.dumps(document))
        return path

    return written


def run(arguments, capsys):
    status = main(arguments.split())
    out, err = capsys.readouterr()
    return status, out, err


def test_a_clear_plan_says_how_far_it_is(fence, capsys, planned):
    path = fence((0.0, 0.0, 3000.0, True), (0.0, 0.0, 50.0, False))
    status, out, err = run(f"plan {SCENE} --fence {path}", capsys)
    assert (status, err) == (0, "")
    assert out.splitlines()[-1].startswith(
        "The plan and its hold stay clear of the fence, 70.0 m from the zone 'circle 2' at least, at 47.1"
    )
    found = planned(f"{SCENE} --fence {path}")["fence"]
    assert found["clear"]
    assert found["margin_m"] == 6.0
    assert found["breaches"] == []
    assert found["closest"]["clearance_m"] == pytest.approx(70.0, abs=1e-5)


def test_a_plan_that_enters_ends_with_1(fence, capsys):
    """A zone of 1000 m about a circle of 120 m: the plan flies to it at 18 m/s, from 2534 m away, and turns before."""
    path = fence((0.0, 0.0, 1000.0, False))
    status, out, err = run(f"plan {SCENE} --fence {path}", capsys)
    assert (status, err) == (1, "")
    sentence, last = out.splitlines()[-2:]
    assert sentence.startswith("The plan enters the zone 'circle 1' in 85.3 s, at 47.1")
    assert sentence.endswith(" E, by up to 880.0 m.")
    assert last == "No entry is clear: 'circle 1' blocks the circle itself, or every way to it."
    status, out, _ = run(f"plan {SCENE} --fence {path} --json", capsys)
    found = json.loads(out)["fence"]
    (breach,) = found["breaches"]
    assert (found["clear_entry"], found["least_s"], found["blocking"]) == (None, None, ["circle 1"])
    assert status == 1
    assert breach["enters"]
    place = loiter.Pose(breach["east_m"], breach["north_m"], 0.0)
    assert FRAME.place(place).latitude_deg == pytest.approx(breach["latitude_deg"])
    assert (breach["east_m"] ** 2 + breach["north_m"] ** 2) ** 0.5 == pytest.approx(1000.0, abs=1e-4)


@pytest.fixture
def beside_a_mast(fence):
    """A scene with a mast on the way of the fastest entry, near the circle."""
    start = loiter.Pose(-300.0, -50.0, 40.0)
    m = loiter.plan(start, loiter.Orbit(0.0, 0.0, 100.0), loiter.Aircraft(18.0, max_bank_deg=35.0))
    samples = m.sample(0.7 * m.duration_s)
    path = fence((float(samples.east_m[1]), float(samples.north_m[1]), 20.0, False))
    latitude, longitude, heading = FRAME.place(start)
    scene = f"--pose-lla {latitude} {longitude} {heading} --orbit-lla 47.11 8.23 100 --airspeed 18 --bank 35"
    return f"plan {scene} --fence {path} --margin 1"


def test_another_entry_is_found(beside_a_mast, capsys):
    status, out, _ = run(beside_a_mast, capsys)
    assert status == 1
    assert "The fastest clear entry found joins 0.2 s later: RSRSR" in out
    assert out.splitlines()[-1].startswith("No clear entry joins before ")
    status, out, _ = run(f"{beside_a_mast} --json", capsys)
    document = json.loads(out)
    entry = document["fence"]["clear_entry"]
    assert entry["later_s"] == pytest.approx(entry["duration_s"] - document["duration_s"])
    assert 0.1 < entry["later_s"] < 0.3
    assert document["fence"]["least_s"] <= entry["duration_s"]


def test_files_have_the_clear_entry(beside_a_mast, capsys, tmp_path):
    """The plan that enters the fence is not in them, nor is the straight flight to the circle in a mission."""
    track, mission, picture = tmp_path / "track.geojson", tmp_path / "mission.plan", tmp_path / "entry.svg"
    files = f"--save {track} --save {mission} --plot {picture} --altitude 120"
    status, out, _ = run(f"{beside_a_mast} {files} --json", capsys)
    assert status == 1
    entry = json.loads(out)["fence"]["clear_entry"]
    lines = [f for f in json.loads(track.read_text())["features"] if f["properties"].get("letter")]
    assert "".join(line["properties"]["letter"] for line in lines) == entry["word"]
    assert len(json.loads(mission.read_text())["mission"]["items"]) > len(entry["segments"])
    assert 'id="stay out' in picture.read_text()


def test_a_plan_has_the_fence_that_was_checked(fence, capsys, tmp_path):
    """That of --fence, also where the mission of --orbit-from has another one."""
    own, checked, saved = fence((0.0, 0.0, 9000.0, True)), tmp_path / "checked.plan", tmp_path / "saved.plan"
    own.rename(tmp_path / "own.plan")
    fence((0.0, 0.0, 3000.0, True), (900.0, 0.0, 50.0, False)).rename(checked)
    document = json.loads((tmp_path / "own.plan").read_text())
    assert run(f"plan {SCENE} --altitude 900 --fence {checked} --save {saved}", capsys)[0] == 0
    assert read_fence(saved) == read_fence(checked)
    existing = json.loads(saved.read_text()) | {"geoFence": document["geoFence"]}
    (tmp_path / "existing.plan").write_text(json.dumps(existing))
    scene = SCENE.replace("--orbit-lla 47.11 8.23 120", f"--orbit-from {tmp_path / 'existing.plan'}")
    for options, kept in ((f"--fence {checked}", checked), ("", tmp_path / "existing.plan")):
        assert run(f"plan {scene} --altitude 900 {options} --save {saved}", capsys)[0] == 0
        assert read_fence(saved) == read_fence(kept)


def test_a_flight_stays_clear(beside_a_mast, capsys, tmp_path):
    """The margin is 1 m there: gusts use more of it, and 8 m are kept."""
    picture, flown = tmp_path / "flown.svg", beside_a_mast.replace("plan", "fly", 1).replace("--margin 1", "--margin 8")
    status, out, _ = run(f"{flown} --plot {picture} --json", capsys)
    document = json.loads(out)
    assert status == 0
    assert document["fence"]["margin_m"] == 8.0
    assert 0.0 < document["fence"]["clearance_m"]["optimal"] < 10.0
    assert document["laws"][0]["settled_s"] is not None
    assert 'id="stay out' in picture.read_text()
    for options, problem in (
        ("--sim kinematic", "goes with --sim point, not with"),
        ("--runs 3", "not with the random starts of --runs"),
    ):
        status, _, err = run(f"{flown} {options}", capsys)
        assert (status, problem in err) == (2, True)


def test_the_margin_is_asked_for(fence, capsys):
    path = fence((0.0, 0.0, 115.0, False))
    # The entry comes from outside the circle, which is 5 m from the zone inside it.
    assert run(f"plan {SCENE} --fence {path} --margin 4.9", capsys)[0] == 0
    assert run(f"plan {SCENE} --fence {path} --margin 5.1", capsys)[0] == 1
    path = fence((0.0, 0.0, 3000.0, True), (400.0, 0.0, 270.0, False))
    status, out, _ = run(f"plan {SCENE} --fence {path} --margin 9.9", capsys)
    assert (status, "10.0 m from the zone 'circle 2'" in out) == (0, True)
    status, out, _ = run(f"plan {SCENE} --fence {path} --margin 10.1", capsys)
    assert status == 1
    assert "The plan comes within 10.0 m of the zone 'circle 2' on the circle, in " in out
    assert "less than the margin of 10.1 m." in out


def test_a_picture_shows_the_fence(fence, capsys, tmp_path):
    path, picture = fence((0.0, 0.0, 300.0, False), (0.0, 0.0, 4000.0, True)), tmp_path / "entry.svg"
    assert run(f"plan {SCENE} --fence {path} --plot {picture}", capsys)[0] == 1
    text = picture.read_text()
    assert all(f'id="{name}' in text for name in ("stay out", "stay in", "breach of the fence"))


@pytest.mark.parametrize(
    ("circles", "options", "problem"),
    [
        ([], "", "it has no fence"),
        ([(-2270.0, -1110.0, 200.0, False)], "", "--pose is inside the zone 'circle 1': a plan must begin outside"),
        ([(0.0, 0.0, 900.0, True)], "", "--pose is outside the inclusion zone 'circle 1': a plan must begin inside"),
        ([(0.0, 0.0, 900.0, False)], "--margin -1", "--margin is -1.0: it must be zero or a positive, finite number"),
        (
            [(0.0, 0.0, 900.0, True), (2000.0, 0.0, 9.0, True)],
            "",
            "--fence has the inclusion zones 'circle 1' and 'circle 2' with no common point",
        ),
    ],
)
def test_what_cannot_be_checked_is_one_sentence(fence, capsys, circles, options, problem):
    status, out, err = run(f"plan {SCENE} --fence {fence(*circles)} {options}", capsys)
    assert (status, out) == (2, "")
    assert problem in err
    assert len(err.splitlines()) == 1


def test_options_that_do_not_go_together(fence, capsys):
    path = fence((0.0, 0.0, 50.0, False))
    status, _, err = run(f"plan --pose -400 120 90 --orbit 0 0 80 --airspeed 18 --bank 35 --fence {path}", capsys)
    assert (status, err) == (2, "loiter: --fence goes with --pose-lla and --orbit-lla: its places are in degrees\n")
    status, _, err = run(f"plan {SCENE} --margin 3", capsys)
    assert (status, err) == (2, "loiter: --margin has no effect without --fence\n")
    status, _, err = run(f"plan {SCENE} --fence {path.parent / 'none.plan'}", capsys)
    assert status == 2
    assert "it cannot be read, No such file or directory" in err
