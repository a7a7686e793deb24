"""Other guidance laws from the start of a plan, beside which the page shows the fastest entry."""

from __future__ import annotations

from typing import Any

from loiter.guidance.protocol import State
from loiter.lab.rivals.following import BAND, Follower
from loiter.lab.rivals.l1 import L1, SHORTEST_PERIOD_S
from loiter.lab.rivals.tangent import Tangent
from loiter.lab.rivals.vector_field import VectorField
from loiter.lab.simulators.kinematic import Kinematic
from loiter.lab.trials.settling import SettlingMonitor
from loiter.planning.problem import Problem

# A law gives a command each time that the aircraft has flown this share of its turn radius.
STEP = 0.05

# A race ends after this many commands, some 300 turn radii: a law that has not joined by then is said not to join.
MOST_STEPS = 6000

# The period of L1 in the times of a turn by one radian, r/V: 10 s, the shortest of ArduPilot's guide, is four of them
# for a small aircraft. A period of 10 s would be meant for no aircraft that turns much faster, as in the paper's scale.
PERIOD = 4.0


def laws(problem: Problem) -> dict[str, Follower]:
    """The laws of a race by their names."""
    orbit, aircraft, wind = problem.orbit, problem.aircraft, problem.wind
    period_s = min(SHORTEST_PERIOD_S, PERIOD * aircraft.turn_radius_m / aircraft.airspeed_m_s)
    return {
        "L1": L1(orbit, aircraft, wind, period_s=period_s),
        "vector field": VectorField(orbit, aircraft, wind),
        "tangent point": Tangent(orbit, aircraft, wind, period_s=period_s),
    }


def race(problem: Problem) -> list[dict[str, Any]]:
    """A flight of each law, of an aircraft that turns instantly, until all have flown a turn of the circle.

    Each has `law`, its name; `joined_s`, when it entered the band of `Flight.joined_s`, None where it did not; and
    `track`: its times, positions and headings.
    """
    dt = STEP * problem.aircraft.turn_radius_m / problem.aircraft.airspeed_m_s
    flown = [_Flown(name, law, problem) for name, law in laws(problem).items()]
    for _ in range(MOST_STEPS):
        if all(one.monitor.settled for one in flown):
            break
        for one in flown:
            one.advance(dt)
    return [one.result() for one in flown]


class _Flown:
    """A law in flight, with all its states."""

    def __init__(self, name: str, law: Follower, problem: Problem) -> None:
        self.name, self.law = name, law
        self.simulator = Kinematic(problem.pose, problem.aircraft, problem.wind)
        self.monitor = SettlingMonitor(problem.orbit, BAND)
        self.states: list[State] = []
        self._record()

    def advance(self, dt: float) -> None:
        """Fly `dt` seconds."""
        self.simulator.advance(self.law.step(self.states[-1], dt), dt)
        self._record()

    def _record(self) -> None:
        self.states.append(self.simulator.true_state())
        self.monitor.update(self.states[-1])

    def result(self) -> dict[str, Any]:
        """The flight as `race` describes it."""
        return {
            "law": self.name,
            "joined_s": self.monitor.joined_s if self.monitor.settled else None,
            "track": {
                "time_s": [state.time_s for state in self.states],
                "east_m": [state.east_m for state in self.states],
                "north_m": [state.north_m for state in self.states],
                "heading_deg": [state.heading_deg for state in self.states],
            },
        }
