"""Plans: the optimum, all optima, all extremals."""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from typing import Any, NamedTuple

from loiter.compiled import solver
from loiter.errors import InvalidArgument, NotConverged, instance
from loiter.kernel.entry import Entry, duration, is_tie_in_wind, miss
from loiter.kernel.statuses import Status
from loiter.kernel.still_air.synthesis import optima, ranked
from loiter.kernel.wind import wind_search
from loiter.kernel.wind.wind_search import WindEntry, WindProblem
from loiter.planning.maneuver import Maneuver
from loiter.planning.model import CALM, Aircraft, Orbit, Pose, Turn, Wind, directions
from loiter.planning.problem import Problem, maneuver
from loiter.planning.slot import Slot, phase_at_start


def plan(
    pose: Pose,
    orbit: Orbit,
    aircraft: Aircraft,
    wind: Wind | None = None,
    *,
    tolerance_m: float = 0.0,
    slot: Slot | None = None,
) -> Maneuver:
    """The fastest maneuver from `pose` onto `orbit`, which it joins tangentially and in the direction `orbit.turn`.

    In still air (`wind` is None, or equals the velocity of the circle) the answer is the fastest of the extremals of
    the maximum principle that docs/theory.md, section 3, lists, in closed form: proved to be the optimum in
    evidence/docs/proof.md. In wind, and onto a moving circle, the path is tangential
    in the frame of the circle, and is found by branch and bound over the point of joining (docs/wind.md). Where several
    maneuvers are optimal, one of them is returned; `plan_all` returns all.

    In still air the least time jumps where the start crosses the last arc (docs/theory.md, section 6): just beyond it
    the aircraft must fly a full turn more. A start that is beyond it only by rounding counts as on the arc;
    `tolerance_m` (metres) extends this to sensor noise. The maneuver then misses the tangent point by `miss_m`, at most
    that distance. In wind the time is steep there and does not jump; a start beyond the circle, or beyond its last arc,
    by less than the tolerance counts as on it.

    With a `slot` the answer is the fastest maneuver that ends in that slot, a place on the circle that moves round it
    with the hold: the first of all arrivals of the six words of Dubins (docs/slots.md). There is no tolerance then.

    Raises `RadiusTooSmall` where the aircraft cannot hold the circle, `WindTooStrong` where the wind relative to the
    circle is as fast as the aircraft, `OutOfRange` where coordinates are so large that doubles cannot tell one turn
    from the next, `InvalidArgument` for a tolerance that is negative or not finite, or not 0 with a slot,
    `NotConverged` where no maneuver in wind was found that ends on the circle.

    >>> from loiter import Aircraft, Orbit, Pose, Wind, plan
    >>> m = plan(Pose(-400.0, 120.0, 90.0), Orbit(0.0, 0.0, 80.0), Aircraft(18.0, max_bank_deg=35.0))
    >>> m.word, m.turn.value, round(m.duration_s, 2)
    ('RSL', 'cw', 19.77)
    >>> m = plan(m.start, Orbit(0.0, 0.0, 120.0), m.aircraft, Wind(8.0, from_deg=250.0))
    >>> m.word, m.turn.value, round(m.duration_s, 2)
    ('RSL', 'cw', 13.55)
    """
    problem = Problem(pose, orbit, aircraft, CALM if wind is None else wind, tolerance_m)
    if slot is None:
        return fastest(problem)
    best, *_ = arrivals(problem, slot)
    return best


def arrivals(problem: Problem, slot: Slot) -> tuple[Maneuver, ...]:
    """The fastest maneuvers into a slot in the directions of the problem, one each, the fastest first."""
    instance("slot", slot, Slot)
    if problem.tolerance_m != 0.0:
        raise InvalidArgument("tolerance_m", "must be 0 with a slot: its entry ends in the slot")
    found = sorted(
        (_arrival(problem, turn, slot) for turn in directions(problem.orbit.turn)), key=lambda solved: solved.time
    )
    return maneuvers(_with_orbit(one, problem.orbit) for one in found)


def best_and_others_in_slot(problem: Problem, slot: Slot) -> tuple[tuple[Maneuver, ...], tuple[Maneuver, ...]]:
    """The fastest maneuver into a slot, and that in the other direction, as `best_and_others` gives them."""
    both = [replace(m, orbit=problem.orbit) for m in arrivals(problem.with_turn(Turn.EITHER), slot)]
    best = next(m for m in both if problem.orbit.turn in (Turn.EITHER, m.turn))
    return (best,), tuple(m for m in both if m is not best)


def _arrival(problem: Problem, turn: Turn, slot: Slot) -> "Solved":
    """The fastest maneuver into a slot in one direction."""
    given = problem.with_turn(turn).in_wind()
    entry = solver.first_in_slot(given, phase_at_start(slot, given, problem.time_unit_s))
    if entry.status != Status.OK:
        raise _not_converged(problem)
    return Solved(maneuver(problem, wind_search.entry_of(entry), entry.miss), wind_search.time_of(entry))


def plan_all(
    pose: Pose, orbit: Orbit, aircraft: Aircraft, wind: Wind | None = None, *, tolerance_m: float = 0.0
) -> tuple[Maneuver, ...]:
    """All optimal maneuvers, equally fast up to rounding, the fastest first.

    Arguments and their units are those of `plan`: a pose and a circle in metres, a wind in metres per second,
    `tolerance_m` in metres. Raises `RadiusTooSmall`, `WindTooStrong`, `OutOfRange`, `InvalidArgument` and
    `NotConverged` as `plan` does.
    For a circle of the turn radius, held in either direction in still air, there are 1, 2 or 4 (paper, section 6); for
    other circles there may be 3. In wind ties are rare except in scenes that are their own mirror image.
    """
    return all_fastest(Problem(pose, orbit, aircraft, CALM if wind is None else wind, tolerance_m))


def candidates(
    pose: Pose, orbit: Orbit, aircraft: Aircraft, wind: Wind | None = None, *, tolerance_m: float = 0.0
) -> tuple[Maneuver, ...]:
    """All extremals of docs/theory.md, section 3, in the direction `orbit.turn`, the fastest first.

    Arguments and their units are those of `plan`: a pose and a circle in metres, a wind in metres per second,
    `tolerance_m` in metres. Raises `RadiusTooSmall`, `WindTooStrong`, `OutOfRange`, `InvalidArgument` and
    `NotConverged` as `plan` does. In wind: the maneuvers to the points of joining at which the time has a local
    minimum, as far as 128 points round the circle resolve the minima.
    """
    return extremals(Problem(pose, orbit, aircraft, CALM if wind is None else wind, tolerance_m))


def fastest(problem: Problem) -> Maneuver:
    """The answer of `plan` to a problem."""
    best, *_ = solve_problem(problem, _optimum_alone, _fastest_alone)
    return best.maneuver


def all_fastest(problem: Problem) -> tuple[Maneuver, ...]:
    """The answer of `plan_all` to a problem."""
    return maneuvers(solve_problem(problem, optima, solver.optima))


def extremals(problem: Problem) -> tuple[Maneuver, ...]:
    """The answer of `candidates` to a problem."""
    return maneuvers(solve_problem(problem, ranked, solver.ranked))


def best_and_others(problem: Problem) -> tuple[tuple[Maneuver, ...], tuple[Maneuver, ...]]:
    """The maneuvers of `plan_all`, and every other extremal, of the other direction too, fastest first.

    Raises the errors of `plan`. In wind it takes half the time of `plan_all` followed by `candidates`.
    """
    known = solve_problem(problem.with_turn(Turn.EITHER), ranked, solver.ranked)
    best = all_fastest(problem) if problem.has_closed_form else _tied(known, problem)
    others = maneuvers(known)
    return best, tuple(m for m in others if not any(m.turn == b.turn and m.segments == b.segments for b in best))


class Solved(NamedTuple):
    """A maneuver, and its time in the kernel's units, which decides ties."""

    maneuver: Maneuver
    time: float


def maneuvers(found: Iterable[Solved]) -> tuple[Maneuver, ...]:
    """The maneuvers alone."""
    return tuple(candidate.maneuver for candidate in found)


def solve_problem(
    problem: Problem,
    in_still_air: Callable[..., list[Entry]],
    in_wind: Callable[..., list[WindEntry]],
) -> tuple[Solved, ...]:
    """The answers, in SI, of the kernel's function for still air or of its function for wind, as the problem needs."""
    if problem.has_closed_form:
        reduced = problem.reduced()
        x, y, R, _, _ = reduced
        return tuple(
            Solved(maneuver(problem, entry, miss(x, y, R, entry)), duration(entry)) for entry in in_still_air(*reduced)
        )
    found = in_wind(problem.in_wind())
    if not found or found[0].status != Status.OK:
        raise _not_converged(problem)
    return tuple(
        Solved(maneuver(problem, wind_search.entry_of(entry), entry.miss), wind_search.time_of(entry))
        for entry in found
    )


def _not_converged(problem: Problem) -> NotConverged:
    pose, wind = problem.pose, problem.wind
    return NotConverged(
        f"{Status.NOT_CONVERGED.message}: pose {pose.east_m:g} {pose.north_m:g} {pose.heading_deg:g}, wind "
        f"{wind.speed_m_s:.4g} m/s from {wind.from_deg:g}; try a pose moved by a millimetre"
    )


def _with_orbit(candidate: Solved, orbit: Orbit) -> Solved:
    """A candidate with the circle of the problem, whose direction may be `EITHER`."""
    return candidate._replace(maneuver=replace(candidate.maneuver, orbit=orbit))


def _tied(known: Sequence[Solved], problem: Problem) -> tuple[Maneuver, ...]:
    """The maneuvers in the problem's direction that tie with the fastest of them; `known` is sorted by time."""
    turn, R = problem.orbit.turn, problem.radius
    allowed = [_with_orbit(one, problem.orbit) for one in known if turn in (Turn.EITHER, one.maneuver.turn)]
    least = min(candidate.time for candidate in allowed)
    return maneuvers(candidate for candidate in allowed if is_tie_in_wind(candidate.time, least, R))


def _optimum_alone(*arguments: Any) -> list[Entry]:
    best = solver.optimum(*arguments)
    return [] if best is None else [best]


def _fastest_alone(problem: WindProblem) -> list[WindEntry]:
    return [solver.fastest(problem)]
