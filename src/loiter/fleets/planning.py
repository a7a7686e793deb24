"""Fleets: several aircraft onto one circle, each into a slot of its own (docs/slots.md, section 5)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from importlib import import_module
from math import ceil, floor, inf, tau
from typing import TYPE_CHECKING, Any, NamedTuple

from loiter.compiled import solver
from loiter.errors import InvalidArgument, MissingPackage, NotConverged, instance, not_negative, share
from loiter.kernel.rebinding import rebound
from loiter.kernel.statuses import Status
from loiter.kernel.wind import wind_search
from loiter.kernel.wind.held import time_held
from loiter.kernel.wind.hold import hold_pose
from loiter.planning.flight import along
from loiter.planning.maneuver import Maneuver
from loiter.planning.model import CALM, Aircraft, Orbit, Pose, Turn, Wind, directions, sign_of
from loiter.planning.problem import Problem, maneuver, problem_of
from loiter.planning.slot import Slot, phase_at_start

if TYPE_CHECKING:
    from numpy import float64
    from numpy.typing import NDArray

    from loiter.fleets.separation import Track

# The most aircraft of a fleet.
MOST_AIRCRAFT = 100

# Places of slots that are tried round the circle: as many, or this many for each aircraft where that is more.
PLACES, PLACES_EACH = 720, 4

# The best common phases that are refined, the phases that are tried in each round between two tried before, and rounds.
REFINED, FINER, ROUNDS = 4, 10, 4

# The candidates whose separation is computed, the best first.
MOST_SEPARATED = 40

# Newton's steps from the interpolated place of a hold: each squares an error of 1e-5.
NEWTON_STEPS = 2

# Points round the circle between which the place of a hold is interpolated.
HOLD_POINTS = 1440


class Approach(NamedTuple):
    """Where an aircraft comes closest to another: which one, the horizontal distance, metres, and when, seconds."""

    other: int
    distance_m: float
    time_s: float


@dataclass(frozen=True)
class FleetPlan:
    """A fleet as planned: the entry and the slot of each aircraft, in the order of the poses.

    `approaches` says of each where it comes closest to another, from the start on, on the circle too: the distances are
    lower than the least ones by up to 1e-6 turn radii, and never more; it is empty for a single aircraft. `layers`
    counts the altitude layer of each aircraft from 0: all 0 where the separation is kept.
    """

    entries: tuple[Maneuver, ...]
    slots: tuple[Slot, ...]
    layers: tuple[int, ...]
    approaches: tuple[Approach, ...]

    @property
    def separation_m(self) -> float:
        """The least horizontal distance between two aircraft, metres; infinite for a single one."""
        return min((approach.distance_m for approach in self.approaches), default=inf)

    @property
    def closest(self) -> tuple[int, int, float] | None:
        """The two aircraft that come closest to each other and when, seconds; None for a single one."""
        if not self.approaches:
            return None
        i, (j, _, time_s) = min(enumerate(self.approaches), key=lambda item: item[1].distance_m)
        return i, j, time_s

    @property
    def duration_s(self) -> float:
        """The time at which the last aircraft is in its slot, seconds."""
        return max(entry.duration_s for entry in self.entries)

    @property
    def turn(self) -> Turn:
        """The direction in which the circle is held."""
        return self.entries[0].turn

    def to_dict(self) -> dict[str, object]:
        """The plan as plain values for JSON, in metres, seconds and degrees."""
        return {
            "duration_s": self.duration_s,
            "turn": self.turn.value,
            "separation_m": self.separation_m if self.closest else None,
            "closest": self.closest,
            "aircraft": [
                {"slot": {"phase_deg": slot.phase_deg, "at_s": slot.at_s}, "layer": layer, "entry": entry.to_dict()}
                for entry, slot, layer in zip(self.entries, self.slots, self.layers, strict=True)
            ],
        }


class Candidate(NamedTuple):
    """A common phase: the time of the last aircraft, the sum, the direction, the shift of the slots and their order."""

    last: float
    total: float
    turn: Turn
    shift: float
    order: tuple[int, ...]


def fleet(
    poses: Sequence[Pose],
    orbit: Orbit,
    aircraft: Aircraft,
    wind: Wind | None = None,
    *,
    separation_m: float = 0.0,
    reserve: float = 0.0,
) -> FleetPlan:
    """The entries of up to 100 aircraft of one kind onto a circle, into slots that pass a place at equal intervals.

    Which aircraft takes which slot, and the common phase of the slots, bring the last aircraft in soonest, and among
    such plans with the least sum of times, as far as the phases that are tried resolve it (docs/slots.md, section 5).
    Each entry is the fastest into its slot. With `reserve`, a share from 0 to below 1, the time of an aircraft is
    the worst for any lateness up to that share of it: slots that a late aircraft would miss are then avoided. Where
    two aircraft would come closer than `separation_m`, metres, the next best phase is taken that keeps it; where
    none of those that were tried does, aircraft that come too close to each other are in different altitude layers.
    Raises the errors of `plan`, `InvalidArgument` for no poses or more than 100, a negative separation and a reserve
    outside its range, and `MissingPackage` without SciPy.

    >>> from loiter import Aircraft, Orbit, Pose
    >>> from loiter.fleets import fleet
    >>> poses = [Pose(-400.0, 120.0, 90.0), Pose(300.0, -500.0, 0.0), Pose(0.0, 700.0, 180.0)]
    >>> f = fleet(poses, Orbit(0.0, 0.0, 120.0), Aircraft(18.0, max_bank_deg=35.0))
    >>> [entry.word for entry in f.entries], f.turn.value, round(f.duration_s, 1)
    (['LSR', 'LSR', 'RSR'], 'ccw', 33.3)
    """
    instance("orbit", orbit, Orbit)
    separation_m, reserve = not_negative("separation_m", separation_m, "metres"), share("reserve", reserve)
    problems = [Problem(pose, orbit, aircraft, CALM if wind is None else wind) for pose in _checked(poses)]
    rings = {turn: Ring(problems, turn) for turn in directions(orbit.turn)}
    found = sorted(each for ring in rings.values() for each in candidates_of(ring, reserve))
    best = None
    for candidate in found[: MOST_SEPARATED if separation_m > 0.0 else 1]:
        flights = flights_of(rings[candidate.turn], candidate)
        if best is not None and come_closer(flights, separation_m):
            continue
        plan = _planned(flights, separation_m)
        best = plan if best is None else best
        if max(plan.layers) == 0:
            return plan
    assert best is not None  # there is at least one candidate
    return best


def _checked(poses: object) -> Sequence[Pose]:
    """The poses; raises `InvalidArgument` for what is not a sequence of them, and for none or too many."""
    if not isinstance(poses, Sequence):
        raise InvalidArgument("poses", "must be a list of loiter.Pose")
    for pose in poses:
        instance("poses", pose, Pose)
    if not 1 <= len(poses) <= MOST_AIRCRAFT:
        raise InvalidArgument("poses", f"are {len(poses)}: a fleet has 1 to {MOST_AIRCRAFT} aircraft")
    return poses


class Ring:
    """The slots of a fleet in one direction; a slot is given by the time at which it is north of the centre."""

    def __init__(self, problems: Sequence[Problem], turn: Turn) -> None:
        self.problems, self.turn = problems, turn
        self.given = [problem.with_turn(turn).in_wind() for problem in problems]
        first = self.given[0]
        self.unit_s = problems[0].time_unit_s
        self._widths: Any = ()
        self._times: Any = ()
        self.north = phase_at_start(Slot(0.0), first, self.unit_s)
        self.period_s = time_held(self.north + tau, tau, first.R, first.wx, first.wy) * self.unit_s

    def phase(self, at_s: float) -> float:
        """The phase at the start of the slot that is north at a time: `slot.phase_at_start`, faster."""
        import numpy as np

        R, wx, wy = self.given[0].R, self.given[0].wx, self.given[0].wy
        time = at_s % self.period_s / self.unit_s
        if not len(self._widths):
            self._widths = np.linspace(0.0, tau, HOLD_POINTS + 1)
            self._times = np.array([time_held(self.north, float(w), R, wx, wy) for w in self._widths])
        width = float(np.interp(time, self._times, self._widths))
        for _ in range(NEWTON_STEPS):
            _, _, _, _, g = hold_pose(self.north - width, self.given[0].side, R, wx, wy)
            width += (time - time_held(self.north, width, R, wx, wy)) * g / R
        return self.north - width

    @property
    def spacing_s(self) -> float:
        """The time between two slots."""
        return self.period_s / len(self.problems)

    def slot(self, at_s: float) -> Slot:
        """The slot that is north of the centre at a time."""
        return Slot(0.0, at_s % self.period_s)

    def times(self, shifts: NDArray[Any]) -> NDArray[float64]:
        """The times of all aircraft (rows) into the slots that are north at the given times, seconds."""
        import numpy as np

        phases = [self.phase(float(at_s)) for at_s in shifts]
        return np.array([[self.time(i, phase) for phase in phases] for i in range(len(self.given))])

    def time(self, i: int, phase: float) -> float:
        """The time of one aircraft into the slot at a phase at the start, seconds."""
        entry = solver.first_in_slot(self.given[i], phase)
        if entry.status != Status.OK:
            raise NotConverged(f"no entry into a slot was found from {self.problems[i].pose}")
        return wind_search.time_of(entry) * self.unit_s

    def entry(self, i: int, slot: Slot) -> Maneuver:
        """The fastest maneuver of one aircraft into a slot."""
        entry = solver.first_in_slot(self.given[i], phase_at_start(slot, self.given[i], self.unit_s))
        found = maneuver(self.problems[i], wind_search.entry_of(entry), entry.miss)
        return replace(found, orbit=self.problems[i].orbit)


def candidates_of(ring: Ring, reserve: float) -> list[Candidate]:
    """The candidates of one direction: the best of those tried round the circle, refined, and the others.

    With a reserve, which is much larger than the distance of two places that are tried, none is refined.
    """
    import numpy as np

    n = len(ring.problems)
    each = max(ceil(PLACES / n), PLACES_EACH)
    shifts = ring.period_s / (n * each) * np.arange(n * each)
    table = late_times(ring.times(shifts), ring.spacing_s / each, reserve)
    found = sorted(assigned(table[:, k::each], float(shifts[k]), ring.turn) for k in range(each))
    if reserve > 0.0:
        return found
    refined = [refine(candidate, ring, ring.spacing_s / each) for candidate in found[:REFINED]]
    return sorted([*refined, *found])


def late_times(times: NDArray[float64], step_s: float, reserve: float) -> NDArray[float64]:
    """The times of aircraft (rows) that are late into slots (columns) that pass a place `step_s` apart, seconds.

    An aircraft that is late by a time finds the slot as far ahead as an aircraft in time finds one that passes the
    place so much earlier. Of all times by which it may be late, up to a share `reserve` of its time, the one counts
    after which it is in its slot last.
    """
    import numpy as np

    late, most_s = times.copy(), reserve * times
    for k in range(1, int(most_s.max() / step_s) + 1):
        after = np.roll(times, k, axis=1) + k * step_s
        late = np.where(k * step_s <= most_s, np.maximum(late, after), late)
    return late


def refine(candidate: Candidate, ring: Ring, width: float) -> Candidate:
    """The best candidate with the same assignment whose shift is within a width, and the best assignment there."""
    import numpy as np

    n = len(ring.problems)
    steps = ring.spacing_s * np.array(candidate.order)
    best = candidate
    for _ in range(ROUNDS):
        for shift in best.shift + width / FINER * np.arange(-FINER, FINER + 1):
            times = [ring.time(i, ring.phase(shift + steps[i])) for i in range(n)]
            best = min(best, Candidate(max(times), sum(times), ring.turn, float(shift), candidate.order))
        width /= FINER
    again = assigned(ring.times(best.shift + ring.spacing_s * np.arange(n)), best.shift, ring.turn)
    return min(best, again)


def assigned(times: NDArray[float64], shift: float, turn: Turn) -> Candidate:
    """The assignment of aircraft (rows) to slots (columns) with the least largest time, and then the least sum."""
    import numpy as np

    solve = linear_sum_assignment()
    levels = np.unique(times)
    # No aircraft is in before its soonest slot, nor is a slot taken before its soonest aircraft.
    least = int(np.searchsorted(levels, max(times.min(axis=1).max(), times.min(axis=0).max())))
    most = len(levels) - 1
    while least < most:
        middle = (least + most) // 2
        late = (times > levels[middle]).astype(float)
        rows, columns = solve(late)
        if late[rows, columns].sum() == 0.0:
            most = middle
        else:
            least = middle + 1
    allowed = np.where(times <= levels[most], times, len(times) * float(levels[-1]) + 1.0)
    rows, columns = solve(allowed)
    chosen = times[rows, columns]
    return Candidate(float(chosen.max()), float(chosen.sum()), turn, shift, tuple(columns.tolist()))


def linear_sum_assignment() -> Any:
    """SciPy's solver of assignments."""
    try:
        solvers: Any = import_module("scipy.optimize")
    except ImportError as error:
        raise MissingPackage("fleets need SciPy: pip install 'loiter[fleet]' brings it") from error
    return solvers.linear_sum_assignment


class Flights(NamedTuple):
    """The flights of a fleet: the entries, the slots, the place of each aircraft as a function of times, seconds.

    `until_s` has the time of each aircraft after which its distances from others in their slots repeat.
    """

    entries: tuple[Maneuver, ...]
    slots: tuple[Slot, ...]
    tracks: tuple[Track, ...]
    until_s: NDArray[float64]


def flights_of(ring: Ring, candidate: Candidate) -> Flights:
    """The flights of a candidate."""
    import numpy as np

    slots = tuple(ring.slot(candidate.shift + ring.spacing_s * j) for j in candidate.order)
    entries = tuple(ring.entry(i, slot) for i, slot in enumerate(slots))
    # In still air the aircraft in their slots stay at equal distances.
    still = ring.given[0].wx == ring.given[0].wy == 0.0
    until_s = np.array([entry.duration_s for entry in entries]) + (0.0 if still else ring.period_s)
    return Flights(entries, slots, tracks_of(entries, slots, ring), until_s)


def come_closer(flights: Flights, separation_m: float) -> bool:
    """Whether samples suffice to show that two aircraft come closer than `separation_m`."""
    from loiter.fleets.separation import sampled_distances

    least, _ = sampled_distances(flights.tracks, flights.until_s, flights.entries[0].aircraft)
    return bool(least.min() < separation_m)


def _planned(flights: Flights, separation_m: float) -> FleetPlan:
    """The plan of flights."""
    from loiter.fleets.separation import least_distances

    entries, slots, tracks, until_s = flights
    if len(entries) == 1:
        return FleetPlan(entries, slots, (0,), ())
    least, when_s = least_distances(tracks, until_s, entries[0].aircraft, separation_m)
    approaches = [
        Approach(j, float(least[i, j]), float(when_s[i, j])) for i, j in enumerate(least.argmin(axis=1).tolist())
    ]
    return FleetPlan(entries, slots, layers_of(least < separation_m), tuple(approaches))


def rounded_down(value: float, decimals: int) -> str:
    """A distance with so many decimals, never more than it is: "49.9" for 49.96."""
    return f"{floor(value * 10**decimals) / 10**decimals:.{decimals}f}"


def layers_of(close: NDArray[Any]) -> tuple[int, ...]:
    """The least free layer of each aircraft after the others: those that come too close have different ones."""
    layers: list[int] = []
    for i in range(len(close)):
        taken = {layers[j] for j in range(i) if close[i, j]}
        layers.append(min(set(range(i + 1)) - taken))
    return tuple(layers)


def fleet_period_s(plan: FleetPlan) -> float:
    """The time of one turn of the circle, seconds."""
    return _ring_of(plan).period_s


def slot_tracks(plan: FleetPlan, times_s: NDArray[float64]) -> Any:
    """The places of all slots (rows) at times, seconds: east + 1j north, metres."""
    import numpy as np

    held = held_track(_ring_of(plan))
    return np.array([held(times_s, slot) for slot in plan.slots])


def _ring_of(plan: FleetPlan) -> Ring:
    return Ring([problem_of(entry) for entry in plan.entries], plan.turn)


def tracks_of(entries: Sequence[Maneuver], slots: Sequence[Slot], ring: Ring) -> tuple[Track, ...]:
    """The place of each aircraft as a function of times, seconds: on its entry, then in its slot."""
    held = held_track(ring)
    return tuple(_track(entry, slot, held) for entry, slot in zip(entries, slots, strict=True))


def _track(entry: Maneuver, slot: Slot, held: Any) -> Track:
    import numpy as np

    V = entry.aircraft.airspeed_m_s
    starts = [segment.start_s for segment in entry.segments[1:]]

    def at(times_s: NDArray[float64]) -> Any:
        places = np.empty(times_s.shape, complex)
        flown = np.searchsorted([*starts, entry.duration_s], times_s, side="right") if entry.segments else 0
        holds = flown == len(entry.segments)
        places[holds] = held(times_s[holds], slot)
        for k, segment in enumerate(entry.segments):
            own = flown == k
            east, north, _ = along(segment, (times_s[own] - segment.start_s) * V, entry.aircraft, entry.wind)
            places[own] = east + 1j * north
        return places

    return at


def held_track(ring: Ring) -> Any:
    """A function of times and a slot: the places of the slot, complex, metres east and north.

    The angle flown is interpolated between `HOLD_POINTS`, where its rate is the ground speed over the radius: by cubic
    polynomials, whose error is of the fourth order, 1e-12 of the radius in a light wind.
    """
    import numpy as np

    problem, given = ring.problems[0], ring.given[0]
    side, R, wind, r = sign_of(ring.turn), given.R, (given.wx, given.wy), problem.aircraft.turn_radius_m
    widths = np.linspace(0.0, tau, HOLD_POINTS + 1)
    held_s = np.array([time_held(ring.north + w, w, R, *wind) for w in widths]) * ring.unit_s
    rates = np.array([hold_pose(ring.north + w, side, R, *wind)[4] for w in widths]) / (R * ring.unit_s)
    pose = rebound(hold_pose, {"sin": np.sin, "cos": np.cos, "sqrt": np.sqrt})

    def at(times_s: NDArray[float64], slot: Slot) -> Any:
        since = (times_s - slot.at_s) % ring.period_s
        k = np.clip(np.searchsorted(held_s, since, side="right") - 1, 0, HOLD_POINTS - 1)
        step_s, width = held_s[k + 1] - held_s[k], widths[1]
        t = (since - held_s[k]) / step_s
        # Hermite's form of the angle beyond the straight line from point to point.
        before, after = rates[k] * step_s - width, rates[k + 1] * step_s - width
        angle = widths[k] + width * t + t * (1.0 - t) * (before * (1.0 - t) - after * t)
        x, y, *_ = pose(ring.north + angle, side, R, *wind)
        east_m, north_m = problem.orbit.centre_after(times_s)
        return r * (x + 1j * y) + east_m + 1j * north_m

    return at
