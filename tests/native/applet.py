"""The applet for ArduPilot in Lua 5.3 over a simulated plane: `python -m native.applet 100`.

Half of the starts have wind. Prints how many flights have settled, how much later than the least time, and the
instructions of a callback.
"""

import argparse
import sys
from collections import deque
from functools import cache
from math import atan, cos, degrees, nan, pi, radians, remainder, sin, tan
from pathlib import Path
from random import Random
from typing import NamedTuple

import numpy as np
from lupa.lua53 import LuaRuntime

from codegen.onboard.lua_files import APPLET, FOLDER
from loiter import Aircraft, Orbit, Pose, Turn, Wind, plan
from loiter.guidance.circle import Band
from loiter.guidance.protocol import Command, Phase
from loiter.guidance.vehicle import Roll
from loiter.lab.rivals.l1 import L1
from loiter.lab.simulators.point_mass import PointMass
from loiter.lab.trials.settling import SettlingMonitor
from loiter.version import __version__

HERE = Path(__file__).parent
GUIDED, LOITER, REPOSITION, HEADING, FAILED = 15, 12, 192, 43002, 4
G = 9.80665

# ArduPlane's delay between a command of heading and the beginning of the roll, seconds, and its response after that.
DELAY_S, ROLL = 0.2, Roll(0.08, 90.0)

# Steps of the law come every so many seconds. A callback may have 10,000 instructions by default (SCR_VM_I_COUNT), of
# which a tenth is left in reserve.
PERIOD_S, MOST_INSTRUCTIONS = 0.05, 9_000

# Steps before the switch is moved.
WAITING = 40

# What the applet says.
READY, BEGINS, HELD = (
    f"Entry: loiter_entry {__version__} ready",
    "Entry: begins",
    "Entry: circle held, left to ArduPlane",
)

# Every so many instructions a hook adds them up, where they are those of the applet; it takes twelve of them itself.
COUNTED, OF_HOOK = 100, 12

COUNT = f"""
local function count_of(call)
  local count = 0
  debug.sethook(function()
    if debug.getinfo(2, "S").source == "{APPLET}" then
      count = count + {COUNTED - OF_HOOK}
    end
  end, "", {COUNTED})
  local first, second = call()
  debug.sethook()
  return count, first, second
end
return count_of
"""


def bindings(path=HERE / "bindings.txt"):
    """The number of arguments of each binding."""
    lines = [line.split() for line in path.read_text("utf-8").splitlines() if not line.startswith("#")]
    return {name: int(count) for name, count in lines}


class World:
    """A plane and its autopilot, as the bindings show them: centimetres in place of 1e-7 degrees."""

    def __init__(self, simulator, radius_m, wind, aircraft):
        self.simulator, self.wind_m_s = simulator, (0.0, 0.0) if wind is None else wind.velocity_m_s
        self.parameters = {
            "WP_LOITER_RAD": radius_m,
            "ROLL_LIMIT_DEG": aircraft.max_bank_deg + 0.5,
            "AIRSPEED_CRUISE": aircraft.airspeed_m_s,
            "RLL2SRV_RMAX": ROLL.rate_deg_s,
            "NAVL1_LIM_BANK": 0.0,
            "NAVL1_PERIOD": 15.0,
            "RCMAP_ROLL": 1,
            "RCMAP_PITCH": 2,
        }
        self.states, self.now_mode, self.centre, self.stick_share = {"armed"}, LOITER, (0, 0), 0.0
        self.said, self.commands, self.waiting, self.heading = [], [], deque(), None
        self.aircraft, self.wind_air, self.loiter = aircraft, wind, None
        self.healthy = True

    # What the bindings call.
    def milliseconds(self):
        return round(self.simulator.true_state().time_s * 1000.0)

    def state(self):
        return self.simulator.measured_state()

    def is_healthy(self):
        return self.healthy

    def place(self):
        s = self.state()
        return s.north_m * 100.0, s.east_m * 100.0, 10000

    def velocity(self):
        return self.state().velocity_north_m_s, self.state().velocity_east_m_s

    def wind(self):
        return self.wind_m_s[1], self.wind_m_s[0]

    def airspeed(self):
        return self.state().airspeed_m_s

    def yaw(self):
        return radians(remainder(self.state().heading_deg, 360.0))

    def roll(self):
        return radians(self.state().bank_deg)

    def mode(self):
        return self.now_mode

    def has(self, name):
        return name in self.states

    def target(self):
        return (*self.centre, 10000)

    def stick(self):
        return self.stick_share

    def say(self, text):
        self.said.append(text)

    def get(self, name):
        return self.parameters.get(name)

    def set(self, name, value):
        self.parameters[name] = value

    def command(self, command, p2, p3, p4, x, y):
        self.commands.append((command, p2, p3, p4))
        if command == REPOSITION:
            self.now_mode, self.heading, self.centre = GUIDED, None, (x, y)
            self.waiting.clear()
            orbit = Orbit(y * 0.01, x * 0.01, p3, Turn.CCW if p4 else Turn.CW)
            self.loiter = L1(orbit, self.aircraft, self.wind_air)
        elif self.now_mode != GUIDED:
            return FAILED
        else:
            self.waiting.append((self.simulator.true_state().time_s + DELAY_S, p2, p3))
        return 0

    # What the autopilot does.
    def bank_deg(self):
        """The bank that the autopilot commands."""
        s = self.simulator.true_state()
        while self.waiting and self.waiting[0][0] <= s.time_s:
            self.heading = self.waiting.popleft()[1:]
        if self.heading is None:
            return 0.0 if self.loiter is None else self.loiter.step(self.state(), PERIOD_S).bank_deg
        target_deg, acceleration = self.heading
        limit_deg = degrees(atan(acceleration / G))
        return max(-limit_deg, min(limit_deg, remainder(target_deg - s.heading_deg, 360.0)))

    def advance(self, dt):
        bank_deg, step_s = self.bank_deg(), 0.01
        rate = degrees(G * tan(radians(bank_deg)) / self.airspeed())
        command = Command(rate, bank_deg, Phase.HOLD, nan, Turn.CW, Phase.HOLD, nan)
        for _ in range(round(dt / step_s)):
            self.simulator.advance(command, step_s)


class Applet:
    """An applet in a world."""

    def __init__(self, world, path=FOLDER / APPLET):
        self.world = world
        self.lua = LuaRuntime(unpack_returned_tuples=True, max_memory=0)
        load = self.lua.eval("function(text, name) return assert(load(text, name)) end")
        load((HERE / "bindings.lua").read_text("utf-8"), "bindings")(world, self.lua.table_from(bindings()))
        self.count_of = self.lua.execute(COUNT)
        self.load_count, self.update, _ = self.count_of(load(_source(path), path.name))
        self.counts = []

    def call(self):
        """Call what it asked to be called, and count its instructions; the seconds until the next call."""
        count, self.update, delay_ms = self.count_of(self.update)
        self.counts.append(count)
        return delay_ms / 1000.0

    def callback(self):
        """The same, and let the world go on until the next call."""
        self.world.advance(self.call())


@cache
def _source(path):
    return path.read_text("utf-8")


AIRCRAFT = Aircraft(airspeed_m_s=22.0, max_bank_deg=45.0)


def scene(i):
    """Start, radius and wind."""
    random = Random(i)
    wind = Wind(random.uniform(2.0, 7.0), random.uniform(0.0, 360.0)) if i % 2 else None
    radius_m = random.uniform(120.0, 200.0) if wind else random.uniform(70.0, 150.0)
    distance_m, azimuth = radius_m * random.uniform(0.1, 4.0), random.uniform(0.0, 2.0 * pi)
    start = Pose(distance_m * sin(azimuth), distance_m * cos(azimuth), random.uniform(0.0, 360.0))
    return start, radius_m, wind


def point_mass(i, turn_ratio=1.0):
    start, _, wind = scene(i)
    return PointMass(start, AIRCRAFT, wind, seed=i, roll=ROLL, gust=0.03, turn_ratio=turn_ratio)


class Flown(NamedTuple):
    """A flight: the world and the applet after it, and the seconds from the switch until the circle was entered."""

    world: World
    applet: Applet
    entered_s: float


def flown(i, simulator=None, until_s=240.0, waiting=WAITING, mode=LOITER):
    """A flight from the start `i`, from the mode, until the applet leaves the circle to the autopilot."""
    _, radius_m, wind = scene(i)
    world = World(point_mass(i) if simulator is None else simulator, radius_m, wind, AIRCRAFT)
    world.now_mode = mode
    applet, monitor = Applet(world), SettlingMonitor(Orbit(0.0, 0.0, radius_m), Band())
    while world.simulator.true_state().time_s < waiting * PERIOD_S:
        applet.callback()
    world.states.add("switch")
    begun_s = world.simulator.true_state().time_s
    while world.simulator.true_state().time_s < begun_s + until_s:
        applet.callback()
        if world.said[-1] not in (READY, BEGINS):
            break
        monitor.update(world.simulator.true_state())
    return Flown(world, applet, monitor.entered_s - begun_s)


def least_s(i, waiting=WAITING):
    """The least time from where the switch is moved, for an aircraft that banks at once."""
    _, radius_m, wind = scene(i)
    simulator = point_mass(i)
    world = World(simulator, radius_m, wind, AIRCRAFT)
    for _ in range(waiting):
        world.advance(PERIOD_S)
    state = simulator.true_state()
    pose = Pose(state.east_m, state.north_m, state.heading_deg)
    return plan(pose, Orbit(0.0, 0.0, radius_m), AIRCRAFT, wind).duration_s


def main():
    parser = argparse.ArgumentParser(prog="python -m native.applet", description=__doc__.partition("\n")[0])
    parser.add_argument("starts", type=int, nargs="?", default=100)
    options = parser.parse_args()
    done = [flown(i) for i in range(options.starts)]
    held = [HELD in one.world.said for one in done]
    late = [one.entered_s - least_s(i) for i, one in enumerate(done)]
    counts = np.array([count for one in done for count in one.applet.counts])
    others = [one.world.said[-1] for one in done if HELD not in one.world.said]
    print(f"{sum(held)} of {len(done)} starts settled; others: {others}")
    print(f"later than the least time by {np.median(late):.2f} s (median), {np.quantile(late, 0.9):.2f} s (90 %)")
    print(f"instructions: mean {counts.mean():.0f}, 99 % {np.quantile(counts, 0.99):.0f}, most {counts.max()}")
    print(f"loading: {done[0].applet.load_count}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
