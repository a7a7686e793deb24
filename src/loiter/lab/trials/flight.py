"""One law flown in one simulator until the aircraft has settled or a time limit is reached."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import isnan, nan
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from loiter.errors import positive
from loiter.guidance.circle import Band, circle_offset
from loiter.guidance.protocol import Command, Law, Phase, Simulator, State
from loiter.lab.trials.settling import SettlingMonitor
from loiter.planning.model import Orbit

if TYPE_CHECKING:
    from numpy import float64
    from numpy.typing import NDArray

# The time step of a law, seconds: autopilots navigate at 10 to 50 Hz.
STEP_S = 0.02

# The time limit of a flight, seconds: one that settles later counts as not settled.
LIMIT_S = 600.0

# The interval at which the reported time to join is checked, seconds.
REPORT_S = 0.1

# The shortest step to an event, seconds.
SHORTEST_S = 1e-9


class FlightTrack(NamedTuple):
    """The states and commands of a flight: float64 arrays of equal length, one value per step.

    Each row is the true state at an instant and the command given there; the last row repeats the last command.
    """

    time_s: NDArray[float64]
    east_m: NDArray[float64]
    north_m: NDArray[float64]
    heading_deg: NDArray[float64]
    bank_deg: NDArray[float64]
    velocity_east_m_s: NDArray[float64]
    velocity_north_m_s: NDArray[float64]
    airspeed_m_s: NDArray[float64]
    commanded_bank_deg: NDArray[float64]
    time_to_join_s: NDArray[float64]

    @property
    def start_s(self) -> float:
        """The time of the first row."""
        return float(self.time_s[0])

    @property
    def elapsed_s(self) -> NDArray[float64]:
        """The time since the first row."""
        return self.time_s - self.start_s


@dataclass(frozen=True)
class Flight:
    """A flight and its measures.

    Times are counted from the start; nan for events that did not happen. `settled_s` is the settling time: when the
    full turn within `band` began. `joined_s` is when the aircraft first entered `band` and then stayed within twice
    that band for a full turn; `turned_deg` is how much the heading had turned until then, in both directions, outside
    twice that band. `overshoot_m` is the largest distance from the circle after joining (at the end, if it never
    joined), `bank_rate_deg_s` the root mean square of the bank rate over the whole flight, `distance_m` the distance
    over the ground until the aircraft settled.
    """

    orbit: Orbit
    band: Band
    track: FlightTrack
    phases: tuple[Phase, ...]
    settled_s: float
    joined_s: float
    turned_deg: float
    overshoot_m: float
    bank_rate_deg_s: float
    distance_m: float

    @property
    def settled(self) -> bool:
        """Whether the aircraft settled."""
        return not isnan(self.settled_s)

    @property
    def join_error_s(self) -> float:
        """The root mean square error of the reported time to join, which should fall by 1 s per second, until the hold.

        It is taken over the steps of `REPORT_S` with a time to join at both ends; 0 if there are none.
        """
        time_s, to_join_s = self.track.time_s, self.track.time_to_join_s
        report = np.searchsorted(time_s, np.arange(self.track.start_s, self._hold_s - SHORTEST_S, REPORT_S))
        error_s = np.diff(to_join_s[report] + time_s[report])
        error_s = error_s[np.isfinite(error_s)]
        return float(np.sqrt(np.mean(error_s**2))) if error_s.size else 0.0

    @property
    def _hold_s(self) -> float:
        """When the law first reported `HOLD`; the end of the flight where it never did."""
        i = self.phases.index(Phase.HOLD) if Phase.HOLD in self.phases else -1
        return float(self.track.time_s[i])


def fly(
    law: Law,
    simulator: Simulator,
    orbit: Orbit,
    *,
    band: Band = Band(),  # noqa: B008 (frozen)
    step_s: float = STEP_S,
    limit_s: float = LIMIT_S,
    exact_switches: bool = False,
) -> Flight:
    """Fly a law in a simulator until it settles, for `limit_s` seconds at most, with a command every `step_s` seconds.

    `exact_switches` ends a step early where the law reports that its next phase begins, as in the theory; a real
    autopilot switches at the next step. Raises `InvalidArgument` for times that are not positive.
    """
    step_s = positive("step_s", step_s, "seconds")
    limit_s = positive("limit_s", limit_s, "seconds")
    monitor, state = SettlingMonitor(orbit, band), simulator.true_state()
    monitor.update(state)
    start_s, states, commands = state.time_s, [state], list[Command]()
    while not monitor.settled and state.time_s - start_s < limit_s:
        command = law.step(simulator.measured_state(), step_s)
        simulator.advance(command, _step_to_event(command, step_s) if exact_switches else step_s)
        state = simulator.true_state()
        states.append(state)
        commands.append(command)
        monitor.update(state)
    return _measured_flight(monitor, orbit, band, states, commands)


def _step_to_event(command: Command, step_s: float) -> float:
    """`step_s`, or the time to the next event if that is shorter; a `next_in_s` of nan means that there is none."""
    return max(command.next_in_s, SHORTEST_S) if command.next_in_s < step_s else step_s


def _track(states: Sequence[State], commands: Sequence[Command]) -> FlightTrack:
    """The track of a flight: each state with its command, the last state with the last command."""
    *_, last = commands
    rows = [
        (*state, command.bank_deg, command.time_to_join_s)
        for state, command in zip(states, (*commands, last), strict=True)
    ]
    return FlightTrack(*np.array(rows).T)


def _measured_flight(
    monitor: SettlingMonitor, orbit: Orbit, band: Band, states: Sequence[State], commands: Sequence[Command]
) -> Flight:
    """A flight with its measures."""
    track = _track(states, commands)
    steps_s = np.diff(track.time_s)
    settled_s, joined_s = (monitor.entered_s, monitor.joined_s) if monitor.settled else (nan, nan)
    # An event that did not happen is placed at the end of the flight.
    settled, joined = np.searchsorted(track.time_s, np.nan_to_num([settled_s, joined_s], nan=track.time_s.max()))
    flown_m = np.hypot(track.velocity_east_m_s, track.velocity_north_m_s)[:-1] * steps_s
    return Flight(
        orbit,
        band,
        track,
        tuple(command.phase for command in commands),
        settled_s - track.start_s,
        joined_s - track.start_s,
        monitor.turned_deg,
        max(abs(circle_offset(state, orbit).outside_m) for state in states[joined:]),
        float(np.sqrt(np.sum(np.diff(track.bank_deg) ** 2 / steps_s) / steps_s.sum())),
        float(flown_m[:settled].sum()),
    )
