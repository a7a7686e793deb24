"""`loiter plan --lead`: the plan begins where the aircraft will be, straight on, while one plans."""

import pytest

UAV = "--airspeed 18 --bank 35"
SCENE = f"--pose -400 120 90 --orbit 0 0 80 {UAV}"
WINDY = f"--pose -400 120 90 --orbit 0 0 120 {UAV} --wind 5 180 --orbit-velocity 2 -1"


def start(answer):
    return answer["segments"][0]["start"]


def test_it_begins_straight_ahead(planned):
    led = planned(f"{SCENE} --lead 5")
    assert start(led) == pytest.approx({"east_m": -310.0, "north_m": 120.0, "heading_deg": 90.0})
    assert led["lead_s"] == 5.0
    assert led["duration_s"] == pytest.approx(planned(f"--pose -310 120 90 --orbit 0 0 80 {UAV}")["duration_s"])


def test_wind_and_the_motion_of_the_circle_count(planned):
    """In 10 s the wind from the south carries the aircraft 50 m north; the circle moves 20 m east and 10 m south."""
    led = planned(f"{WINDY} --lead 10")
    assert start(led) == pytest.approx({"east_m": -220.0, "north_m": 170.0, "heading_deg": 90.0})
    same = f"--pose -220 170 90 --orbit 20 -10 120 {UAV} --wind 5 180 --orbit-velocity 2 -1"
    assert led["duration_s"] == pytest.approx(planned(same)["duration_s"], abs=1e-9)
    assert led["join_over_ground"]["centre_east_m"] == pytest.approx(20.0 + 2.0 * led["duration_s"])


def test_a_line_says_where_it_begins(shown):
    first, second, *_ = shown(f"plan {SCENE} --lead 5").splitlines()
    assert first == "Fly straight on for 5 s; the plan, and its times, begin then, at -310.0 m east, 120.0 m north."
    assert "joins in 15.1 s" in second


def test_without_a_lead_nothing_is_said(shown, planned):
    assert shown(f"plan {SCENE} --lead 0") == shown(f"plan {SCENE}")
    assert "lead_s" not in planned(SCENE)


@pytest.mark.parametrize("lead", ["-1", "nan", "inf"])
def test_what_is_no_lead(refusal, lead):
    assert refusal(["plan", *SCENE.split(), "--lead", lead]).startswith(
        f"loiter: --lead is {float(lead)}: it must be zero or a positive"
    )
