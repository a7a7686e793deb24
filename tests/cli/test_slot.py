"""`loiter plan --slot` and `loiter plan --arrive`."""

import pytest

from loiter import Aircraft, Orbit, Pose, Slot, plan, plan_at
from loiter.certificate.slot_certificate import BASIS_ARRIVAL

SCENE = "--pose -400 120 90 --orbit 0 0 120 --airspeed 18 --bank 35"
PLANNED = Pose(-400.0, 120.0, 90.0), Orbit(0.0, 0.0, 120.0), Aircraft(18.0, max_bank_deg=35.0)
AT_60_S = f"{SCENE} --arrive 60 --bearing 200"


def test_json_has_the_plan_and_the_other_direction(planned):
    found = planned(f"{SCENE} --slot 200 --slot-at 5")
    assert found["duration_s"] == plan(*PLANNED, slot=Slot(200.0, 5.0)).duration_s
    assert {found["turn"], *(m["turn"] for m in found["alternatives"])} == {"cw", "ccw"}


def test_the_direction_is_kept(shown):
    assert "clockwise: joins in 31.7 s" in shown(f"plan {SCENE} --slot 200 --turn cw")


def test_a_place_at_a_time(planned, shown):
    assert planned(AT_60_S)["duration_s"] == plan_at(*PLANNED, time_s=60.0, bearing_deg=200.0).duration_s
    assert "turn right, radius 2" in shown(f"plan {AT_60_S} --turn ccw")


def test_a_plan_into_a_slot_is_certified(shown, tmp_path):
    out = shown(f"plan {SCENE} --slot 200 --certify --plot {tmp_path}/entry.svg")
    assert "Certificate of LSR, counter-clockwise: valid." in out
    assert "f (u - h k) >= 0 at T (5)" in out
    assert "No arrival before 26.08" in out
    assert (tmp_path / "entry-certificate.svg").stat().st_size > 1000


def test_an_arrival_at_a_time_is_certified(planned, shown, tmp_path):
    out = shown(f"plan {AT_60_S} --certify --plot {tmp_path}/entry.svg")
    assert "No least time is claimed" in out
    assert "Possible times between" in out
    assert [path.name for path in tmp_path.iterdir()] == ["entry.svg"]
    assert planned(f"{AT_60_S} --certify")["certificate"]["basis"] == BASIS_ARRIVAL


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ("--slot-at 3", "--slot-at needs --slot"),
        ("--slot nan", "--slot is nan"),
        ("--slot 20 --slot-at inf", "--slot-at is inf"),
        ("--slot 20 --tolerance 2", "--tolerance must be 0 with a slot"),
        ("--slot 20 --slot-at 1e9", "more than 100000 turns"),
        ("--arrive 60", "--arrive needs --bearing"),
        ("--bearing 60", "--bearing needs --arrive"),
        ("--arrive 0 --bearing 60", "--arrive is 0"),
        ("--arrive 60 --bearing nan", "--bearing is nan"),
        ("--arrive 60 --bearing 60 --slot 3", "--arrive cannot be combined with --slot"),
        ("--arrive 5 --bearing 200", "the next possible time is 23.861 s, none is sooner"),
    ],
)
def test_what_does_not_fit_is_said(options, words, refusal):
    assert words in refusal(f"plan {SCENE} {options}")
