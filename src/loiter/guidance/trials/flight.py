"""One law flown in one simulator, until the aircraft has settled or time is up."""

from __future__ import annotations

from dataclasses import dataclass
from math import nan
from typing import TYPE_CHECKING, NamedTuple

from loiter.errors import positive
from loiter.guidance.protocol import Command, Law, Phase, Simulator
from loiter.guidance.trials.settling import Band, Settling
from loiter.planning.model import Orbit

if TYPE_CHECKING:
    from numpy import float64
    from numpy.typing import NDArray

# Steps a second at which laws are flown: autopilots navigate at 10 to 50 Hz.
STEP_S = 0.02

# Who has not settled by then has failed, seconds.
LIMIT_S = 600.0

# The time to join is looked at so often, seconds.
REPORT_S = 0.1

# A step that an event cuts is no shorter, seconds.
SHORTEST_S = 1e-9


class Track(NamedTuple):
    """What was flown and commanded: float64 arrays of one length, one value each step.

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


@dataclass(frozen=True, slots=True)
class Flight:
    """A flight and what it came to.

    Times are counted from the start, nan for what never was. `settled_s` is when the full turn within `band` began that
    settled it, `joined_s` when it first entered `band` to stay within twice that for a full turn, `turned_deg` how much
    the heading had turned until then, either way, outside twice that band. `overshoot_m` is the largest distance from
    the circle thereafter (without a stay, at the end), `bank_rate_deg_s` the root mean square over all the flight,
    `distance_m` what was flown over the ground until it settled.
    """

    orbit: Orbit
    band: Band
    track: Track
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
        return self.settled_s == self.settled_s

    @property
    def join_error_s(self) -> float:
        """By how much the reported time to join missed a fall of 1 s a second: root mean square up to the hold.

        Over steps of `REPORT_S` in which both ends have a time to join; 0 where there are none.
        """
        import numpy as np

        report = np.searchsorted(
            self.track.time_s, np.arange(self.track.time_s[0], self._hold_s - SHORTEST_S, REPORT_S)
        )
        error_s = np.diff(self.track.time_to_join_s[report] + self.track.time_s[report])
        error_s = error_s[np.isfinite(error_s)]
        return float(np.sqrt(np.mean(error_s**2))) if error_s.size else 0.0

    @property
    def _hold_s(self) -> float:
        """When the law first said that it holds the circle; the end where it never did."""
        hold = self.phases.index(Phase.HOLD) if Phase.HOLD in self.phases else -1
        return float(self.track.time_s[hold])


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
    """Fly a law in a simulator, a command every `step_s` seconds, until it settles or `limit_s` seconds have gone by.

    `exact_switches` ends a step early where the law says that its next phase begins, as the theory does; a real
    autopilot switches at the next step. Raises `InvalidArgument` for times that are not positive.
    """
    positive("step_s", step_s, "seconds")
    positive("limit_s", limit_s, "seconds")
    settling, state = Settling(orbit, band), simulator.true_state()
    settling.watch(state)
    start_s = state.time_s
    rows: list[tuple[float, ...]] = []
    phases: list[Phase] = []
    while not settling.settled and state.time_s - start_s < limit_s:
        command = law.step(simulator.measured_state(), step_s)
        rows.append((*state, command.bank_deg, command.time_to_join_s))
        phases.append(command.phase)
        simulator.advance(command, _cut(command, step_s) if exact_switches else step_s)
        state = simulator.true_state()
        settling.watch(state)
    rows.append((*state, *rows[-1][len(state) :]))
    return _measured(settling, orbit, band, Track(*_columns(rows)), tuple(phases))


def _cut(command: Command, step_s: float) -> float:
    """A step, no longer than to the next event; nan is none."""
    return max(command.next_in_s, SHORTEST_S) if command.next_in_s < step_s else step_s


def _columns(rows: list[tuple[float, ...]]) -> NDArray[float64]:
    import numpy as np

    return np.array(rows).T


def _measured(settling: Settling, orbit: Orbit, band: Band, track: Track, phases: tuple[Phase, ...]) -> Flight:
    """A flight with its measures."""
    import numpy as np

    start_s, steps_s = float(track.time_s[0]), np.diff(track.time_s)
    settled_s, joined_s = (settling.entered_s, settling.joined_s) if settling.settled else (nan, nan)
    # What never was lasts to the end.
    settled, joined = np.searchsorted(track.time_s, np.nan_to_num([settled_s, joined_s], nan=track.time_s[-1]))
    flown_m = np.hypot(track.velocity_east_m_s, track.velocity_north_m_s)[:-1] * steps_s
    return Flight(
        orbit,
        band,
        track,
        phases,
        settled_s - start_s,
        joined_s - start_s,
        settling.turned_deg,
        float(_off_m(orbit, track)[joined:].max()),
        float(np.sqrt(np.sum(np.diff(track.bank_deg) ** 2 / steps_s) / steps_s.sum())),
        float(flown_m[:settled].sum()),
    )


def _off_m(orbit: Orbit, track: Track) -> NDArray[float64]:
    """The distance from the circle, wherever that is then."""
    import numpy as np

    east_m = track.east_m - orbit.east_m - orbit.velocity_east_m_s * track.time_s
    north_m = track.north_m - orbit.north_m - orbit.velocity_north_m_s * track.time_s
    return np.abs(np.hypot(east_m, north_m) - orbit.radius_m)
