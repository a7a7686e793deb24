"""Saving: formats by their endings, whole files or none, what is missing said in a sentence."""

import re
from concurrent.futures import ThreadPoolExecutor
from math import inf, nan
from pathlib import Path
from threading import Barrier

import pytest

from earth import FRAME, SCENES, UAV, entry
from loiter import Orbit, Pose, plan
from loiter.errors import InvalidArgument, OutOfRange
from loiter.files import FORMATS, Autopilot, check_format, mission, read_mission, save
from loiter.files.formats import FILE_FORMATS
from loiter.writing import check_writable, write_whole

ROOT = Path(__file__).parents[2]
M, _ = SCENES["wind"]


def test_formats_are_those_of_the_documentation():
    rows = re.findall(r"^\| (`\..*?) \|", (ROOT / "docs" / "maps.md").read_text("utf-8"), re.MULTILINE)
    assert tuple(re.findall(r"`(\.\w+)`", " ".join(rows))) == FORMATS


@pytest.mark.parametrize("ending", FORMATS)
def test_endings_are_understood_in_capitals_too(tmp_path, ending):
    small, large = tmp_path / f"a{ending}", tmp_path / f"a{ending.upper()}"
    for path in (small, large):
        check_format(path)
        save(M, path, frame=FRAME, altitude_m=600.0)
    assert small.read_bytes() == large.read_bytes()


@pytest.mark.parametrize("ending", FORMATS)
def test_the_path_may_be_text_and_an_older_file_is_replaced(tmp_path, ending):
    path = tmp_path / f"a{ending}"
    path.write_text("old")
    save(M, str(path), frame=FRAME, altitude_m=600)
    assert path.stat().st_size > 100
    assert [entry.name for entry in tmp_path.iterdir()] == [path.name]


@pytest.mark.parametrize("ending", FORMATS)
def test_the_same_maneuver_makes_the_same_bytes(tmp_path, ending):
    for name in ("a", "b"):
        save(entry(wind=M.wind)[0], tmp_path / f"{name}{ending}", frame=FRAME, altitude_m=600.0)
    assert (tmp_path / f"a{ending}").read_bytes() == (tmp_path / f"b{ending}").read_bytes()


@pytest.mark.parametrize("ending", FORMATS)
def test_a_smaller_error_and_a_spacing_make_more_points(tmp_path, ending):
    sizes = []
    for options in ({}, {"chord_error_m": 0.1}, {"spacing_m": 2.0}):
        save(M, tmp_path / f"a{ending}", frame=FRAME, altitude_m=600.0, along_path=True, **options)
        sizes.append((tmp_path / f"a{ending}").stat().st_size)
    assert sizes == sorted(sizes)
    assert sizes[0] < sizes[1] < sizes[2]


@pytest.mark.parametrize("ending", [ending for one in FILE_FORMATS if one.kind == "mission" for ending in one.endings])
def test_a_mission_has_waypoints_along_the_path_if_that_or_a_spacing_is_requested(tmp_path, ending):
    counts = []
    for options in ({}, {"chord_error_m": 0.1}, {"along_path": True}, {"spacing_m": 50.0}):
        save(M, tmp_path / f"a{ending}", frame=FRAME, altitude_m=600.0, **options)
        counts.append(len(read_mission(tmp_path / f"a{ending}").items))
        assert counts[-1] == len(mission(M, FRAME, 600.0, **options).items)
    assert counts[:2] == [2, 2]
    assert min(counts[2:]) > 5


def test_a_mission_is_for_an_autopilot(tmp_path):
    for autopilot, count in ((Autopilot.ARDUPILOT, 2), (Autopilot.PX4, 1)):
        save(M, tmp_path / "a.plan", frame=FRAME, altitude_m=600.0, autopilot=autopilot)
        assert len(read_mission(tmp_path / "a.plan").items) == count


@pytest.mark.parametrize("ending", [".waypoints", ".txt", ".TXT"])
def test_a_file_with_a_home_line_is_not_for_px4(tmp_path, ending):
    """PX4 has no home among its items: it would fly to the first line as to a waypoint."""
    sentence = rf"^autopilot is px4, .* home line of a {ending.lower()} file .* write a .plan file for PX4$"
    refused(tmp_path, f"a{ending}", sentence, frame=FRAME, altitude_m=600.0, autopilot=Autopilot.PX4)


@pytest.mark.parametrize("ending", [".geojson", ".kml", ".gpx", ".csv"])
def test_a_circle_that_moves_is_drawn_where_it_is_joined(tmp_path, ending):
    m, frame = entry(velocity_east_m_s=3.0)
    save(m, tmp_path / f"a{ending}", frame=frame)
    assert (tmp_path / f"a{ending}").stat().st_size > 100


def test_threads_save_into_one_folder_at_a_time(tmp_path):
    """Each is held before its file takes its place, until all have written."""
    together = Barrier(4, timeout=30.0)

    def write(number):
        def slowly(file):
            file.write(b"%d" % number)
            together.wait()

        write_whole("save", tmp_path / f"{number}.csv", slowly)

    with ThreadPoolExecutor(4) as pool:
        list(pool.map(write, range(4)))
    assert {path.name: path.read_text() for path in tmp_path.iterdir()} == {f"{i}.csv": str(i) for i in range(4)}


@pytest.mark.parametrize("autopilot", Autopilot)
def test_an_autopilot_may_be_given_by_its_number(tmp_path, autopilot):
    for name, who in (("a", autopilot), ("b", int(autopilot))):
        save(M, tmp_path / f"{name}.plan", frame=FRAME, altitude_m=600.0, autopilot=who)
    assert (tmp_path / "a.plan").read_bytes() == (tmp_path / "b.plan").read_bytes()


# Refusals: nothing is written


def refused(tmp_path, name, sentence, kind=InvalidArgument, maneuver=M, **options):
    before = sorted(tmp_path.rglob("*"))
    with pytest.raises(kind, match=sentence):
        save(maneuver, tmp_path / name, **options)
    assert sorted(tmp_path.rglob("*")) == before


@pytest.mark.parametrize("name", ["a", "a.json", "a.kmz", ".kml", "a.kml.gz"])
def test_other_endings_are_refused(tmp_path, name):
    sentence = rf"^path is '.*{name}': the file name must end in {', '.join(FORMATS)}$"
    refused(tmp_path, name, sentence, frame=FRAME, altitude_m=600.0)
    with pytest.raises(InvalidArgument, match=sentence):
        check_format(Path(name))


@pytest.mark.parametrize("ending", [ending for ending in FORMATS if ending != ".csv"])
def test_without_a_frame_there_is_no_place_on_earth(tmp_path, ending):
    refused(tmp_path, f"a{ending}", rf"^frame is missing: a {ending} file needs places on Earth; .csv does not$")


@pytest.mark.parametrize("ending", [".plan", ".waypoints", ".txt"])
def test_without_an_altitude_there_is_no_mission(tmp_path, ending):
    sentence = rf"^altitude_m is missing: a {ending} file needs metres above mean sea level$"
    refused(tmp_path, f"a{ending}", sentence, frame=FRAME)


@pytest.mark.parametrize("ending", FORMATS)
@pytest.mark.parametrize("altitude", [nan, inf, 1e6, "high"])
def test_an_altitude_is_a_number_that_can_be_meant(tmp_path, ending, altitude):
    refused(tmp_path, f"a{ending}", r"^altitude_m is .*: it must be", frame=FRAME, altitude_m=altitude)


@pytest.mark.parametrize("ending", FORMATS)
@pytest.mark.parametrize("option", ["spacing_m", "chord_error_m"])
@pytest.mark.parametrize("value", [0.0, -1.0, nan, "fine"])
def test_spacing_and_error_are_positive(tmp_path, ending, option, value):
    sentence = rf"^{option} is .*: it must be a positive, finite number of metres$"
    refused(tmp_path, f"a{ending}", sentence, frame=FRAME, altitude_m=600.0, **{option: value})


@pytest.mark.parametrize("ending", FORMATS)
def test_what_is_beyond_the_reach_of_the_frame_is_refused(tmp_path, ending):
    far = plan(Pose(-120e3, 0.0, 90.0), Orbit(0.0, 0.0, 120.0), UAV)
    sentence = r"^the maneuver goes more than 100 km from the frame's origin 47 8"
    refused(tmp_path, f"a{ending}", sentence, OutOfRange, far, frame=FRAME, altitude_m=600.0)


@pytest.mark.parametrize("ending", [".plan", ".txt"])
def test_a_circle_that_moves_is_no_mission(tmp_path, ending):
    moving, frame = entry(velocity_east_m_s=3.0)
    refused(tmp_path, f"a{ending}", r"^orbit moves over the ground", maneuver=moving, frame=frame, altitude_m=600.0)


@pytest.mark.parametrize("ending", FORMATS)
def test_a_folder_that_is_not_there_is_refused(tmp_path, ending):
    sentence = rf"^path is '.*none/a{ending}': it cannot be written, No such file or directory$"
    refused(tmp_path, f"none/a{ending}", sentence, frame=FRAME, altitude_m=600.0)


def test_an_autopilot_is_one_that_is_known(tmp_path):
    sentence = r"^autopilot is 'px4': it must be Autopilot.ARDUPILOT or Autopilot.PX4$"
    refused(tmp_path, "a.plan", sentence, frame=FRAME, altitude_m=600.0, autopilot="px4")


def test_asking_whether_a_file_can_be_written_changes_nothing(tmp_path):
    kept = tmp_path / "kept.csv"
    kept.write_text("older")
    check_writable("save", kept)
    check_writable("save", tmp_path / "new.csv")
    assert [(path.name, path.read_text()) for path in tmp_path.iterdir()] == [("kept.csv", "older")]
    with pytest.raises(InvalidArgument, match=r"^save is .*: it cannot be written, No such file or directory$"):
        check_writable("save", tmp_path / "no" / "new.csv")
    with pytest.raises(InvalidArgument, match=r"^save is .*: it cannot be written, Is a directory$"):
        check_writable("save", tmp_path)
    assert [path.name for path in tmp_path.iterdir()] == ["kept.csv"]
