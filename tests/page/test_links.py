"""The keys of the page's links, which people have stored: in the page's own module, run by Node."""

import json
from urllib.parse import parse_qsl

import pytest

import loiter
from page.browsing import in_module, values

SCENE = {
    "pose": {"east_m": -400, "north_m": 120, "heading_deg": 90},
    "orbit": {
        "east_m": 1,
        "north_m": 2,
        "radius_m": 120,
        "turn": "cw",
        "velocity_east_m_s": 3,
        "velocity_north_m_s": 4,
    },
    "aircraft": {"airspeed_m_s": 18, "max_bank_deg": 35},
    "wind": {"speed_m_s": 8, "from_deg": 250},
    "tolerance_m": 0.5,
    "origin": {"latitude_deg": 47, "longitude_deg": 8},
    "fence": {
        "zones": [
            {"name": "a mast", "east_m": -150, "north_m": 90.5, "radius_m": 60, "inclusion": False},
            {"name": "field", "corners": [[-600, -300], [300, -300], [300, 400]], "inclusion": True},
        ],
        "margin_m": 12.5,
    },
    "slot": {"phase_deg": 200.5, "at_s": -10},
    "leg": None,
}
LEG = {
    "exit_to": [600, -20.5],
    "hold_s": 60,
    "turns": 1.5,
    "start_altitude_m": 500,
    "altitude_m": 0,
    "climb_rate_m_s": 2.5,
    "descent_rate_m_s": 1.5,
}
LEG_KEYS = {
    "exit-to": "600,-20.5",
    "hold": "60",
    "turns": "1.5",
    "start-altitude": "500",
    "to-altitude": "0",
    "climb-rate": "2.5",
    "descent-rate": "1.5",
}
ALTITUDE = {"altitude_m": 900, "altitude_reference": "home", "home_altitude_m": 700}
LINKED = {"scene": SCENE, "units": "aviation", "altitude": ALTITUDE, "view": [1, 2, 300]}
KEYS = {
    "pose": "-400,120,90",
    "orbit": "1,2,120",
    "turn": "cw",
    "airspeed": "18",
    "bank": "35",
    "wind": "8,250",
    "orbit-velocity": "3,4",
    "tolerance": "0.5",
    "origin": "47,8",
    "zone": "field,in,-600,-300,300,-300,300,400",
    "margin": "12.5",
    "slot": "200.5",
    "slot-at": "-10",
    "altitude": "900",
    "altitude-reference": "home",
    "home-altitude": "700",
    "view": "1,2,300",
    "units": "aviation",
}


def run(expression):
    """The value of an expression over the functions of the page's module, as JSON."""
    return in_module("scene/link.js", f"(({{ toLink, fromLink }}) => {expression})(module)")


def test_a_link_has_these_keys():
    link = run(f"toLink({json.dumps(LINKED)})")
    assert link.startswith("#")
    assert dict(parse_qsl(link.removeprefix("#"))) == KEYS
    assert ("zone", "a mast,out,-150,90.5,60") in parse_qsl(link.removeprefix("#"))


def test_a_link_to_a_leg_has_these_keys_and_no_slot():
    linked = LINKED | {"scene": SCENE | {"slot": None, "leg": LEG}}
    link = run(f"toLink({json.dumps(linked)})")
    assert dict(parse_qsl(link.removeprefix("#"))).items() >= LEG_KEYS.items()
    assert run(f"fromLink({json.dumps(link + '&slot=90')})") == linked


def test_a_link_is_read_back_whole():
    assert run(f"fromLink(toLink({json.dumps(LINKED)}))") == LINKED


@pytest.mark.parametrize(("key", "limit"), [("turn-radius", "min_turn_radius_m"), ("turn-rate", "max_turn_rate_deg_s")])
def test_the_other_limits_have_these_keys(key, limit):
    read = run(json.dumps(f"#pose=0,0,0&orbit=0,0,80&airspeed=18&{key}=50").join(["fromLink(", ")"]))
    assert read["scene"]["aircraft"] == {"airspeed_m_s": 18, limit: 50}


# Numbers with 16 and 17 digits, as conversions and rotations leave them.
LONG = {
    "knots and feet": SCENE
    | {
        "pose": {"east_m": -121.92000000000002, "north_m": 36.57600000000001, "heading_deg": 89.99999999999999},
        "aircraft": {"airspeed_m_s": 18.005555555555556, "max_bank_deg": 35.00000000000001},
        "wind": {"speed_m_s": 4.115555555555556, "from_deg": 250.00000000000003},
        "tolerance_m": 0,
    },
    "the least radius": SCENE
    | {
        "orbit": SCENE["orbit"] | {"radius_m": 47.18430393502829, "velocity_east_m_s": 0, "velocity_north_m_s": 0},
        "wind": None,
        "tolerance_m": 0,
    },
    "turn radius 1": SCENE
    | {
        "pose": {"east_m": -0.53000000000000014, "north_m": 0.3100000000000001, "heading_deg": 90},
        "orbit": SCENE["orbit"] | {"east_m": 0, "north_m": 0, "radius_m": 1, "turn": "either"}
        | {"velocity_east_m_s": 0, "velocity_north_m_s": 0},
        "aircraft": {"airspeed_m_s": 1, "min_turn_radius_m": 0.99999999999999989},
        "wind": None,
        "tolerance_m": 0,
    },
    "turn rate": SCENE | {"aircraft": {"airspeed_m_s": 18, "max_turn_rate_deg_s": 21.857142857142858}},
}  # fmt: skip


@pytest.mark.parametrize("asked", LONG.values(), ids=LONG)
def test_a_link_has_short_numbers_that_give_the_same_plan(asked):
    link = run(f"toLink({json.dumps(LINKED | {'scene': asked})})")
    numbers = [number for _, value in parse_qsl(link.removeprefix("#")) for number in value.split(",")]
    assert max(len(number.lstrip("-").replace(".", "")) for number in numbers) <= 10
    read = run(f"fromLink({json.dumps(link)})")["scene"]
    plans = [loiter.plan(*values(scene), tolerance_m=scene["tolerance_m"]) for scene in (asked, read)]
    assert plans[1].word == plans[0].word
    assert plans[1].turn == plans[0].turn
    assert plans[1].duration_s == pytest.approx(plans[0].duration_s, rel=2e-6)


def test_numbers_that_were_typed_are_in_the_link_as_they_are():
    typed = SCENE | {"pose": {"east_m": -1200.25, "north_m": 0.001, "heading_deg": 359.5}}
    assert "pose=-1200.25,0.001,359.5" in run(f"toLink({json.dumps(LINKED | {'scene': typed})})")
