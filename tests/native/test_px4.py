"""The module for PX4 of onboard/px4, compiled against names of our own, and flown in a simulation of ours.

tests/native/px4/flight.cpp has the aircraft and the commander: it registers the mode, enters it, and switches to Hold
when the module commands an orbit. Each scenario is what then happens.
"""

import re
import shutil
import subprocess
from functools import cache
from itertools import pairwise
from pathlib import Path
from tempfile import mkdtemp

import pytest

from codegen.unit import ROOT
from native.library import COMPILER, needs_compiler

CPP = shutil.which("c++")
pytestmark = [needs_compiler, pytest.mark.skipif(CPP is None, reason="there is no compiler of C++")]

MODULE = ROOT / "onboard" / "px4" / "src" / "modules" / "loiter_entry"
C = ROOT / "onboard" / "c"
SIMULATION = Path(__file__).with_name("px4")

# The warnings with which PX4 compiles its modules.
WARNINGS = (
    "-Wall -Wextra -Werror -Wcast-align -Wdouble-promotion -Wfloat-equal -Wformat-security -Wpointer-arith -Wshadow"
)
WARNINGS += " -Wlogical-op -Wno-missing-field-initializers -Wno-unused-parameter -Wno-stringop-truncation"

# What DO_ORBIT is in MAVLink.
DO_ORBIT = 34

# Seconds: between two orders, and from the last position to the first order.
AGAIN_S, MISSED_S = 1.0, 0.4

# Metres outside the circle at the end that count as on it: 5 % of the radius.
ON_CIRCLE_M = 3.0


def compile_module(folder, headers, *more):
    """Compile the module with PX4's warnings; `headers` are the names of PX4's that it finds."""
    for name in headers:
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text("#include <px4.hpp>\n", "utf-8")
    includes = [f"-I{one}" for one in (folder, SIMULATION, C, MODULE)]
    sources = [MODULE / "LoiterEntry.cpp", MODULE / "EntryFlight.cpp"]
    command = [CPP, "-std=c++17", "-DLOITER_FLOAT", *WARNINGS.split(), *includes]
    subprocess.run([*command, *sources, *more], check=True)


def px4_headers():
    """The names of the headers of PX4 that the module includes."""
    own = {path.name for path in MODULE.iterdir()} | {"loiter.h", "math.h", "string.h"}
    text = "".join(path.read_text("utf-8") for path in MODULE.glob("*.?pp"))
    return set(re.findall(r'#include ["<]([\w/.]+)[">]', text)) - own


@cache
def program():
    """The simulation with the module."""
    folder = Path(mkdtemp())
    flags = ["-std=c99", "-DLOITER_FLOAT", "-O1", "-ffp-contract=off"]
    subprocess.run([COMPILER, *flags, "-c", C / "loiter.c", "-o", folder / "loiter.o"], check=True)
    compile_module(
        folder, px4_headers(), SIMULATION / "flight.cpp", folder / "loiter.o", "-o", folder / "flight", "-lm"
    )
    return folder / "flight"


class Flown:
    """What a flight printed: its orders and its last values."""

    def __init__(self, scenario):
        done = subprocess.run([program(), scenario], capture_output=True, text=True, timeout=120)
        assert (done.returncode, done.stderr) == (0, "")
        self.text = done.stdout
        self.orders = [tuple(map(float, line.split()[1:])) for line in re.findall(r"^ordered .*", self.text, re.M)]

    def number(self, name):
        return float(re.search(rf"{name} (-?[\d.]+)", self.text)[1])

    @property
    def registered(self):
        return "registered 1 Loiter entry" in self.text


def test_it_compiles_without_the_topic_that_older_versions_lack(tmp_path):
    compile_module(tmp_path, px4_headers() - {"uORB/topics/setpoint_config.h"}, "-fsyntax-only")


def test_it_joins_the_circle_and_hands_over_to_hold():
    flown = Flown("")
    assert flown.registered
    assert "can run 2 1" in flown.text
    [(after_s, command, radius_m, latitude_deg, longitude_deg, altitude_m)] = flown.orders
    assert (command, abs(radius_m), latitude_deg, longitude_deg, altitude_m) == (DO_ORBIT, 60.0, 0.0, 8.5, 500.0)
    # 8 s and a quarter of the circle after it has joined, from some 200 m at 15 m/s.
    assert 18.0 < after_s < 45.0
    assert flown.number("last") <= after_s + 0.02
    assert abs(flown.number("outside")) < ON_CIRCLE_M
    assert flown.number("largest bank") <= 49.5 + 0.01
    assert "altitude 500.0, airspeed 15.0" in flown.text
    assert "Loiter entry: on the circle" in flown.text
    assert "Loiter entry: Hold flies the circle" in flown.text
    assert flown.number("configured") == 1


def test_the_direction_of_the_parameter_is_flown_and_handed_over():
    assert Flown("clockwise").orders[0][2] == 60.0
    assert abs(Flown("").orders[0][2]) == 60.0


def test_a_missing_airspeed_ends_nothing():
    flown = Flown("no airspeed")
    assert len(flown.orders) == 1
    assert abs(flown.number("outside")) < ON_CIRCLE_M


def test_after_a_change_of_mode_nothing_is_sent():
    flown = Flown("pilot")
    assert flown.orders == []
    assert 4.9 < flown.number("last") <= 5.03
    assert "Loiter entry: the mode was changed" in flown.text


def test_without_positions_it_flies_level_and_commands_hold_again_and_again():
    flown = Flown("no position")
    times = [order[0] for order in flown.orders]
    assert 5.0 <= times[0] <= 5.0 + MISSED_S
    assert len(times) > 50
    assert max(later - time for time, later in pairwise(times)) < AGAIN_S + 0.1
    assert flown.number("last bank") == 0.0


@pytest.mark.parametrize("scenario", ["jump", "stop"])
def test_a_jump_or_a_stop_commands_hold_at_once(scenario):
    flown = Flown(scenario)
    assert 5.0 <= flown.orders[0][0] <= 5.05
    assert len(flown.orders) == 1
    assert flown.number("last") <= 5.05
    assert flown.number("unregistered") == (scenario == "stop")
    if scenario == "stop":
        assert "stop gives 0" in flown.text
        assert "unregistered 1 Loiter entry 2 23" in flown.text


def test_until_hold_has_taken_over_the_law_goes_on():
    flown = Flown("deaf")
    assert len(flown.orders) > 10
    assert abs(flown.number("outside")) < ON_CIRCLE_M


@pytest.mark.parametrize("scenario", ["tight", "unset"])
def test_a_circle_that_cannot_be_held_or_is_not_given_cannot_be_flown(scenario):
    flown = Flown(scenario)
    assert "can run 2 0" in flown.text
    # If the mode is forced nevertheless, PX4's own guidance flies the circle.
    assert flown.orders[0][0] < 0.1
    assert flown.number("largest bank") == 0.0


def test_it_registers_before_arming_only():
    flown = Flown("armed")
    assert "registered 0" in flown.text
    assert flown.orders == []
    assert "setpoints 0" in flown.text


def test_it_declares_the_parameters_that_it_reads():
    declared = set(re.findall(r"^      (LOIT_\w+):", (MODULE / "module.yaml").read_text("utf-8"), re.M))
    assert declared == set(re.findall(r'param_find\("(LOIT_\w+)"', (MODULE / "LoiterEntry.cpp").read_text("utf-8")))
