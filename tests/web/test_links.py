"""The keys of the page's links, which people have stored: in the page's own module, run by Node."""

import json
import subprocess
from urllib.parse import parse_qsl

import pytest

from loiter.web.app import STATIC
from web.browsing import NODE

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
    "altitude": "900",
    "altitude-reference": "home",
    "home-altitude": "700",
    "view": "1,2,300",
    "units": "aviation",
}


def run(expression):
    """The value of an expression over the functions of the page's module, as JSON."""
    module = json.dumps((STATIC / "scene" / "link.js").as_uri())
    code = f"import({module}).then(({{ toLink, fromLink }}) => console.log(JSON.stringify({expression})))"
    done = subprocess.run([NODE, "-e", code], capture_output=True, text=True, check=True)
    return json.loads(done.stdout)


def test_a_link_has_these_keys():
    link = run(f"toLink({json.dumps(LINKED)})")
    assert link.startswith("#")
    assert dict(parse_qsl(link.removeprefix("#"))) == KEYS


def test_a_link_is_read_back_whole():
    assert run(f"fromLink(toLink({json.dumps(LINKED)}))") == LINKED


@pytest.mark.parametrize(("key", "limit"), [("turn-radius", "min_turn_radius_m"), ("turn-rate", "max_turn_rate_deg_s")])
def test_the_other_limits_have_these_keys(key, limit):
    read = run(json.dumps(f"#pose=0,0,0&orbit=0,0,80&airspeed=18&{key}=50").join(["fromLink(", ")"]))
    assert read["scene"]["aircraft"] == {"airspeed_m_s": 18, limit: 50}
