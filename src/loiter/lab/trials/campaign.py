"""Monte Carlo campaigns: several laws flown from the same random starts with the same noise."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, replace
from functools import partial
from math import cos, degrees, isnan, pi, sin, sqrt
from multiprocessing import get_context
from typing import TYPE_CHECKING, NamedTuple, TypeVar

import numpy as np

from loiter.errors import InvalidArgument
from loiter.guidance.circle import Band
from loiter.guidance.entry.loiter_entry import LoiterEntry
from loiter.guidance.protocol import Law, Simulator
from loiter.guidance.vehicle import Roll
from loiter.kernel.wind.hold import tightest_radius
from loiter.lab.rivals.l1 import L1, advised_period_s
from loiter.lab.rivals.tangent import Tangent
from loiter.lab.rivals.vector_field import VectorField, advised_gains
from loiter.lab.simulators.kinematic import Kinematic
from loiter.lab.simulators.point_mass import PointMass
from loiter.lab.simulators.sensors import Noise
from loiter.lab.trials.flight import LIMIT_S, STEP_S, Flight, fly
from loiter.planning.maneuver import Maneuver
from loiter.planning.model import CALM, Aircraft, Orbit, Pose, Wind, relative_wind
from loiter.planning.solve import plan

if TYPE_CHECKING:
    from numpy.random import Generator

AnyTrial = TypeVar("AnyTrial", bound="Trial")


@dataclass(frozen=True)
class Trial:
    """One start: the fastest entry from it in the steady wind, and the seed of the noise.

    `known_aircraft` and `known_wind` are the aircraft and the wind as the laws know them. Raises `InvalidArgument` for
    a seed below 0.
    """

    ideal: Maneuver
    seed: int

    def __post_init__(self) -> None:
        at_least(0, "seed", self.seed)

    @property
    def orbit(self) -> Orbit:
        """The circle with the direction of the fastest entry."""
        return replace(self.ideal.orbit, turn=self.ideal.turn)

    @property
    def known_aircraft(self) -> Aircraft:
        """The aircraft itself."""
        return self.ideal.aircraft

    @property
    def known_wind(self) -> Wind:
        """The wind itself."""
        return self.ideal.wind

    def lag_s(self, roll: Roll) -> float:
        """The roll lag that laws are tuned to, seconds, where they know the roll response."""
        return roll.time_s


# A flight counts as a go-around if it turns, off the circle, by this much more than the fastest entry. A go-around is a
# whole turn that leaves the circle and returns to it. Up to 20 degrees of it at each end lie within twice the band and
# do not count; the rest of the difference from a whole turn is margin.
GO_AROUND_DEG = 270.0


def at_least(least: int, name: str, value: int) -> None:
    """Raise `InvalidArgument` for a value below `least`."""
    if value < least:
        raise InvalidArgument(name, f"is {value}: it must be at least {least}")


# Functions that make a law or a simulator for a trial. They must be functions of a module, or a `partial` of one, so
# that they can be sent to other processes.
MakeLaw = Callable[[Trial], Law]
MakeSimulator = Callable[[Trial], Simulator]


class Outcome(NamedTuple):
    """The result of one flight of a campaign; times in seconds, nan for events that did not happen.

    `ideal_s` is the duration of the fastest entry. `settled_s`, `joined_s`, `overshoot_m`, `bank_rate_deg_s`,
    `distance_m` and `join_error_s` are those of `Flight`. `round_again` marks a go-around: before joining and off the
    circle, the heading turned by `GO_AROUND_DEG` more than in the arcs of the fastest entry.
    """

    trial: int
    ideal_s: float
    settled_s: float
    joined_s: float
    overshoot_m: float
    bank_rate_deg_s: float
    distance_m: float
    round_again: bool
    join_error_s: float

    @property
    def settled(self) -> bool:
        """Whether the aircraft settled."""
        return not isnan(self.settled_s)


def trials(
    runs: int,
    seed: int,
    aircraft: Aircraft,
    wind: Wind | None = None,
    *,
    radii: tuple[float, float] = (1.2, 4.0),
    reach: float = 6.0,
) -> list[Trial]:
    """Random starts from a seed; start i depends on the seed and on i alone, not on `runs`.

    The circle is about the origin and may be held in either direction. Its radius is between `radii` times the tightest
    that can be held in the wind; in still air that is the turn radius. The start is within `reach` radii of the centre,
    on any heading. Raises `InvalidArgument` for fewer than one run and a seed below 0, and the same as `plan`.
    """

    def draw(random: Generator) -> Trial:
        return Trial(random_entry(random, aircraft, wind, radii, reach), int(random.integers(2**63)))

    return random_trials(draw, runs, seed)


def random_trials(draw: Callable[[Generator], AnyTrial], runs: int, seed: int) -> list[AnyTrial]:
    """Trials that a function draws; trial i depends on the seed and on i alone, not on `runs`.

    Raises `InvalidArgument` for fewer than one run and a seed below 0.
    """
    at_least(1, "runs", runs)
    at_least(0, "seed", seed)
    return [draw(np.random.default_rng((seed, i))) for i in range(runs)]


def random_entry(
    random: Generator, aircraft: Aircraft, wind: Wind | None, radii: tuple[float, float], reach: float
) -> Maneuver:
    """The fastest entry from a random start onto a random circle about the origin, as `trials` describes them."""
    tightest = tightest_radius(*relative_wind(Orbit(0.0, 0.0, 1.0), aircraft, CALM if wind is None else wind))
    radius_m = aircraft.turn_radius_m * tightest * random.uniform(*radii)
    distance_m, azimuth = reach * radius_m * sqrt(random.random()), 2.0 * pi * random.random()
    pose = Pose(distance_m * cos(azimuth), distance_m * sin(azimuth), 360.0 * random.random())
    return plan(pose, Orbit(0.0, 0.0, radius_m), aircraft, wind)


def optimal(trial: Trial, roll: Roll = Roll()) -> Law:  # noqa: B008 (frozen)
    """The fastest entry, which chooses the direction of holding itself."""
    return LoiterEntry(trial.ideal.orbit, trial.known_aircraft, trial.known_wind, roll=roll)


def l1(trial: Trial, roll: Roll = Roll()) -> Law:  # noqa: B008 (frozen)
    """L1 tuned as its autopilot's guide advises, with the direction of the fastest entry."""
    period_s = advised_period_s(trial.lag_s(roll))
    return L1(trial.orbit, trial.known_aircraft, trial.known_wind, period_s=period_s)


def vector_field(trial: Trial, roll: Roll = Roll()) -> Law:  # noqa: B008 (frozen)
    """The vector field with the gains that its publication advises, with the direction of the fastest entry."""
    gains = advised_gains(trial.orbit, trial.known_aircraft, trial.lag_s(roll))
    return VectorField(trial.orbit, trial.known_aircraft, trial.known_wind, gains=gains)


def nearest_tangent(trial: Trial, roll: Roll = Roll()) -> Law:  # noqa: B008 (frozen)
    """Dubins' path to the nearest point of the circle, with the direction of the fastest entry."""
    return Tangent(trial.orbit, trial.known_aircraft, trial.known_wind, lead_s=trial.lag_s(roll))


# The laws by name. Each function also takes a `Roll`.
LAWS: dict[str, Callable[..., Law]] = {
    "optimal": optimal,
    "l1": l1,
    "vector-field": vector_field,
    "tangent": nearest_tangent,
}


def point_mass(trial: Trial, roll: Roll = Roll(), gust: float = 0.05, noise: Noise = Noise()) -> Simulator:  # noqa: B008
    """The point mass in the steady wind of the trial, with its noise."""
    m = trial.ideal
    return PointMass(m.start, m.aircraft, m.wind, seed=trial.seed, roll=roll, gust=gust, noise=noise)


def kinematic(trial: Trial) -> Simulator:
    """The vehicle of the theory, without noise."""
    return Kinematic(trial.ideal.start, trial.ideal.aircraft, trial.ideal.wind)


def outcome(
    i: int,
    trial: Trial,
    law: MakeLaw,
    simulator: MakeSimulator,
    band: Band = Band(),  # noqa: B008 (frozen)
    step_s: float = STEP_S,
    limit_s: float = LIMIT_S,
) -> Outcome:
    """Fly one trial, number `i`, and return its result."""
    m = trial.ideal
    flight = fly(law(trial), simulator(trial), m.orbit, band=band, step_s=step_s, limit_s=limit_s)
    return Outcome(
        i,
        m.duration_s,
        flight.settled_s,
        flight.joined_s,
        flight.overshoot_m,
        flight.bank_rate_deg_s,
        flight.distance_m,
        is_go_around(flight, m),
        flight.join_error_s,
    )


def is_go_around(flight: Flight, ideal: Maneuver) -> bool:
    """Whether a flight that settled turned by `GO_AROUND_DEG` more, off the circle, than the fastest entry."""
    return flight.settled and flight.turned_deg > arcs_deg(ideal) + GO_AROUND_DEG


def arcs_deg(ideal: Maneuver) -> float:
    """The angle that a maneuver turns, in both directions."""
    return degrees(sum(abs(segment.curvature_per_m) * segment.length_m for segment in ideal.segments))


def campaign(
    laws: Mapping[str, MakeLaw],
    simulator: MakeSimulator,
    starts: Sequence[Trial],
    *,
    band: Band = Band(),  # noqa: B008 (frozen)
    step_s: float = STEP_S,
    limit_s: float = LIMIT_S,
    workers: int | None = None,
    progress: Callable[[int, int], None] = lambda done, of: None,
) -> dict[str, list[Outcome]]:
    """Fly each law from each start; the outcomes of each law, in the order of the starts.

    The outcomes do not depend on `workers`, the number of processes: by default the number of cores; with 1 no other
    process is used. The others start anew, so a script calls this below `if __name__ == "__main__":`. `progress` is
    called with the number of completed starts and the number of all. Raises
    `InvalidArgument` for fewer than one worker.
    """
    if workers is not None:
        at_least(1, "workers", workers)
    fly_all = partial(_outcomes, tuple(laws.values()), simulator, band, step_s, limit_s)
    done: list[tuple[Outcome, ...]] = []
    for row in _map_in_processes(fly_all, list(enumerate(starts)), workers):
        done.append(row)
        progress(len(done), len(starts))
    return {name: list(column) for name, column in zip(laws, zip(*done, strict=True), strict=True)}


def _outcomes(
    laws: tuple[MakeLaw, ...],
    simulator: MakeSimulator,
    band: Band,
    step_s: float,
    limit_s: float,
    numbered: tuple[int, Trial],
) -> tuple[Outcome, ...]:
    return tuple(outcome(*numbered, law, simulator, band, step_s, limit_s) for law in laws)


def _map_in_processes(
    job: Callable[[tuple[int, Trial]], tuple[Outcome, ...]], tasks: list[tuple[int, Trial]], workers: int | None
) -> Iterator[tuple[Outcome, ...]]:
    if workers == 1:
        yield from map(job, tasks)
        return
    # Not forked: a caller with threads of its own (JAX's, a service's) would risk a deadlock.
    with ProcessPoolExecutor(workers, get_context("forkserver")) as pool:
        yield from pool.map(job, tasks)
