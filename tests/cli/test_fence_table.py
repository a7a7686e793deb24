"""`--fence FILE.csv`: fences in local metres, for scenes in metres."""

import json

import pytest

from loiter.cli.app import main
from loiter.errors import InvalidArgument
from loiter.fences import CircleZone, Fence, PolygonZone
from loiter.files import read_fence_table

SCENE = "--pose -400 120 90 --orbit 0 0 80 --airspeed 18 --bank 35"
HEADER = "zone,rule,east_m,north_m,radius_m\n"
FIELD = "field,in,-600,-300,\nfield,in,300,-300,\nfield,in,300,400,\nfield,in,-600,400,\n"
CORNERS = ((-600.0, -300.0), (300.0, -300.0), (300.0, 400.0), (-600.0, 400.0))


@pytest.fixture
def fence(tmp_path):
    """Writes a table of rows below the header."""

    def written(rows, name="field.csv"):
        path = tmp_path / name
        path.write_text(HEADER + rows)
        return path

    return written


def test_corners_and_circles_make_zones(fence):
    """Spaces and empty lines are passed over; two circles of one name are two zones."""
    rows = f"{FIELD}\nmast, out, -150, 90, 60\nmast, out, 1e3, 90, 6.5\n"
    assert read_fence_table(fence(rows)) == Fence(
        (
            PolygonZone("field", CORNERS, inclusion=True),
            CircleZone("mast", -150.0, 90.0, 60.0),
            CircleZone("mast", 1000.0, 90.0, 6.5),
        )
    )


def test_a_plan_in_metres_is_checked(fence, capsys):
    """The numbers are those of docs/fences.md for the same zones."""
    path = fence(f"{FIELD}mast,out,-150,90,60\n")
    assert main(f"plan {SCENE} --fence {path} --margin 5 --json".split()) == 1
    found = json.loads(capsys.readouterr().out)["fence"]
    (breach,) = found["breaches"]
    assert (breach["zone"], round(breach["time_s"], 2), round(breach["clearance_m"], 2)) == ("mast", 11.42, -17.73)
    assert "latitude_deg" not in breach
    assert found["clear_entry"]["later_s"] == pytest.approx(0.15, abs=0.01)
    assert main(f"leg {SCENE} --exit-to 250 0 --fence {fence(FIELD)} --json".split()) == 0
    assert json.loads(capsys.readouterr().out)["fence"]["closest"]["clearance_m"] == pytest.approx(50.0)
    # The way out leaves the field where nothing else does.
    assert main(f"leg {SCENE} --exit-to 350 0 --fence {fence(FIELD)} --json".split()) == 1
    (breach,) = json.loads(capsys.readouterr().out)["fence"]["breaches"]
    assert breach["east_m"] == pytest.approx(300.0, abs=1e-3)


@pytest.mark.parametrize(
    ("rows", "sentence"),
    [
        (
            "field,in,0,0,\nfield,in,9,9,\nfield,in,9,0,\nfield,in,0,9,\n",
            "cannot be used: zone 'field' crosses or touch",
        ),
        ("field,in,0,0,\nfield,in,9,9,\n", "cannot be used: zone 'field' has 2 different corners"),
        ("mast,out,0,0,-5\n", "cannot be used: zone 'mast' radius_m is -5.0: it must be a positive"),
        ("mast,off,0,0,5\n", "file {path}: line 2: the rule is 'off': it must be in or out"),
        ("mast,out,0,five,5\n", "file {path}: line 2: north_m is 'five': it must be a finite number"),
        ("mast,out,0,5\n", "file {path}: line 2 has 4 values: it must have 5, the last of them may be empty"),
        ("", "file {path}: it has no fence"),
        (f"{FIELD}sea,in,900,0,20\n", "has the inclusion zones 'field' and 'sea' with no common point to fly in"),
    ],
)
def test_a_table_that_cannot_be_used_gets_a_sentence(fence, refusal, rows, sentence):
    path = fence(rows)
    why = sentence.format(path=repr(str(path)))
    assert refusal(f"plan {SCENE} --fence {path}").startswith(f"loiter: --fence {why}")


@pytest.mark.parametrize(
    ("rows", "sentence"),
    [
        (FIELD.replace("-600", "-300"), "--pose is outside the inclusion zone 'field': a plan must begin inside"),
        ("mast,out,-400,100,60\n", "--pose is inside the zone 'mast': a plan must begin outside"),
    ],
)
def test_a_start_on_the_wrong_side_gets_a_sentence(fence, refusal, rows, sentence):
    for command in ("plan", "leg"):
        towards = " --exit-to 250 0" if command == "leg" else ""
        assert refusal(f"{command} {SCENE}{towards} --fence {fence(rows)}") == f"loiter: {sentence}"


def test_metres_and_degrees_are_not_mixed(fence, tmp_path, refusal):
    path = fence(FIELD)
    placed = "--pose-lla 47.1 8.2 90 --orbit-lla 47.11 8.23 120 --airspeed 18 --bank 35"
    for command in (f"plan {placed}", "guide --connect udpin:127.0.0.1:14999 --orbit-lla 47.11 8.23 120 --dry-run"):
        line = refusal(f"{command} --fence {path}")
        assert "--fence is a table in local metres, which goes with --pose and --orbit" in line
    other = tmp_path / "other.csv"
    other.write_text("47.0 8.0\n")
    with pytest.raises(InvalidArgument, match=r"its first line is '47\.0 8\.0': it must be zone,rule,east_m"):
        read_fence_table(other)
    other.write_text("")
    with pytest.raises(InvalidArgument, match="its first line is ''"):
        read_fence_table(other)
