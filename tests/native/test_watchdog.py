"""The watchdog of the applet for ArduPilot: what the vehicle does, in six degrees of freedom, when the applet dies.

`python -m native.test_watchdog` prints it.
"""

from math import hypot, inf

import pytest
from lupa.lua53 import LuaError

from codegen.onboard.lua_files import FOLDER
from loiter import Orbit, Pose
from loiter.guidance.circle import Band
from loiter.lab.simulators.airframes import AEROSONDE
from loiter.lab.simulators.jsbsim_aircraft import JsbsimAircraft
from loiter.lab.trials.settling import SettlingMonitor
from native.applet import REPOSITION, Applet, World

WATCHDOG, RADIUS_M, START = FOLDER / "loiter_watchdog.lua", 150.0, Pose(-500.0, 150.0, 200.0)

# A hook as ArduPilot's: after so many instructions every further one is an error, which no pcall can go on after.
STARVED = """
return function(call)
  local function stop() debug.sethook(stop, "", 1) error("exceeded CPU time") end
  debug.sethook(stop, "", 500)
  return 0, call()
end
"""


def kill(applet):
    applet.call = lambda: inf


def starve(applet):
    applet.count_of = applet.lua.execute(STARVED)


def deny_memory(applet):
    applet.lua.execute("collectgarbage()")
    applet.lua.set_max_memory(applet.lua.get_memory_used() // 2)


class Death:
    """A flight in which the applet dies in its first turn.

    `commanded_s` is the time from then until the circle was commanded, `held_s` until it was held for good, and
    `distance_m` the distance from its centre at the end.
    """

    def __init__(self, die, *, is_watched=True, until_s=120.0):
        self.world = World(JsbsimAircraft(START, AEROSONDE), RADIUS_M, None, AEROSONDE.aircraft)
        applet, simulator = Applet(self.world), self.world.simulator
        scripts = {applet: 0.0, **({Applet(self.world, WATCHDOG): 0.0} if is_watched else {})}
        monitor = SettlingMonitor(Orbit(0.0, 0.0, RADIUS_M), Band())
        died_s, self.commanded_s, known = inf, inf, 0
        while simulator.true_state().time_s < min(died_s, 30.0) + until_s and not monitor.settled:
            state = simulator.true_state()
            if state.time_s >= 2.0:
                self.world.states.add("switch")
            if died_s == inf and abs(state.bank_deg) > 20.0:
                die(applet)
                died_s, known = state.time_s, len(self.world.commands)
            for script, due_s in scripts.items():
                if due_s <= state.time_s + 1e-6:
                    scripts[script] = state.time_s + seconds(script)
            is_commanded = any(command == REPOSITION for command, *_ in self.world.commands[known:])
            if died_s < inf and is_commanded and self.commanded_s == inf:
                self.commanded_s = state.time_s - died_s
            self.world.advance(0.01)
            monitor.update(simulator.true_state())
        self.held_s = monitor.entered_s - died_s if monitor.settled else inf
        end = simulator.true_state()
        self.distance_m = hypot(end.east_m, end.north_m)


def seconds(script):
    """The time until the next call; for ever where it has failed, as ArduPilot does not call it again."""
    try:
        return script.call()
    except LuaError:
        return inf


DEATHS = {"killed": kill, "starved of instructions": starve, "denied memory": deny_memory}


@pytest.mark.parametrize("name", DEATHS)
def test_a_plane_whose_applet_dies_in_a_turn_is_released_and_holds_the_circle(name):
    flown = Death(DEATHS[name])
    # Four readings a tenth of a second apart, and one before them.
    assert 0.0 <= flown.commanded_s <= 0.6
    assert flown.held_s < 90.0
    assert flown.world.get("LENT_BEAT") == 0


def test_without_the_watchdog_it_flies_away():
    flown = Death(kill, is_watched=False, until_s=60.0)
    assert flown.commanded_s == inf
    assert flown.distance_m > 5.0 * RADIUS_M


def main():
    print("| the applet is | circle commanded after | circle held after |\n|---|---|---|")
    for name, die in DEATHS.items():
        flown = Death(die)
        print(f"| {name} | {flown.commanded_s:.2f} s | {flown.held_s:.1f} s |")
    flown = Death(kill, is_watched=False, until_s=60.0)
    print(f"| killed, without the watchdog | never | never: {flown.distance_m:.0f} m from the centre after a minute |")


if __name__ == "__main__":
    main()
