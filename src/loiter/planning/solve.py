"""Plans: the optimum, every optimum, every extremal."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any, NamedTuple

from loiter.errors import NotConverged
from loiter.kernel import wind_search
from loiter.kernel.codes import Status
from loiter.kernel.synthesis import Entry, duration, miss, optima, optimum, ranked
from loiter.kernel.wind_search import WindEntry, WindProblem
from loiter.planning.feasibility import air_past
from loiter.planning.maneuver import Maneuver
from loiter.planning.model import CALM, Aircraft, Orbit, Pose, Turn, Wind
from loiter.planning.scaling import Scene, drifting, maneuver, normalised, radius_in_turns


def plan(
    pose: Pose, orbit: Orbit, aircraft: Aircraft, wind: Wind | None = None, *, tolerance_m: float = 0.0
) -> Maneuver:
    """The fastest way from `pose` onto `orbit`, to be joined tangentially and held in the direction `orbit.turn`.

    In still air (`wind` None, or as fast as the circle moves) the answer is the fastest of the extremals of the maximum
    principle that docs/theory.md, section 3, lists, in closed form: proved to be the optimum for a circle of the
    minimum turn radius, cross-checked for wider ones. In wind, and onto a circle that moves, it is joined tangentially
    as the circle sees it, over the ground if it stands still, and found by branch and bound over the point of joining
    (docs/wind.md). Where several maneuvers are optimal it is one of them; `plan_all` gives them all.

    In still air the least time jumps where the start passes the last arc (docs/theory.md, section 6): just beyond, the
    aircraft must go round. A start that lies beyond by rounding counts as on the arc; `tolerance_m` (metres) widens
    that to the noise of a sensor. The maneuver then misses the tangent point by no more than that, as its `miss_m`
    says. In wind the time does not jump there, and the tolerance is not used.

    Raises `RadiusTooSmall` where the aircraft cannot hold the circle, `WindTooStrong` where the air passes it as fast
    as the aircraft flies, `OutOfRange` where coordinates are so large that doubles cannot tell one turn from the next,
    `InvalidArgument` for a tolerance that is negative or not finite, `NotConverged` where no maneuver in wind was
    found that ends on the circle.

    >>> from loiter import Aircraft, Orbit, Pose, Wind, plan
    >>> m = plan(Pose(-400.0, 120.0, 90.0), Orbit(0.0, 0.0, 80.0), Aircraft(18.0, max_bank_deg=35.0))
    >>> m.word, m.turn.value, round(m.duration_s, 2)
    ('RSL', 'cw', 19.77)
    >>> m = plan(m.start, Orbit(0.0, 0.0, 120.0), m.aircraft, Wind(8.0, from_deg=250.0))
    >>> m.word, m.turn.value, round(m.duration_s, 2)
    ('RSL', 'cw', 13.55)
    """
    best, *_ = _solved(pose, orbit, aircraft, wind, tolerance_m, _optimum_alone, _fastest_alone)
    return best.maneuver


def plan_all(
    pose: Pose, orbit: Orbit, aircraft: Aircraft, wind: Wind | None = None, *, tolerance_m: float = 0.0
) -> tuple[Maneuver, ...]:
    """Every optimal maneuver, those that tie up to rounding; the fastest first. As `plan` else.

    On a circle of the turn radius held either way in still air they are 1, 2 or 4 (paper, section 6); elsewhere there
    may be 3. In wind two tie seldom but where a mirror shows the same scene.
    """
    found = _solved(pose, orbit, aircraft, wind, tolerance_m, optima, wind_search.optima)
    return tuple(one.maneuver for one in found)


def candidates(
    pose: Pose, orbit: Orbit, aircraft: Aircraft, wind: Wind | None = None, *, tolerance_m: float = 0.0
) -> tuple[Maneuver, ...]:
    """The extremals of docs/theory.md, section 3, fastest first and losers too, for the turn asked for. As `plan`.

    In wind: the maneuvers to points of the circle that are met sooner than the points beside them, as far as 128 points
    all round tell them apart.
    """
    found = _solved(pose, orbit, aircraft, wind, tolerance_m, ranked, wind_search.ranked)
    return tuple(one.maneuver for one in found)


def compared(
    pose: Pose, orbit: Orbit, aircraft: Aircraft, wind: Wind | None = None, *, tolerance_m: float = 0.0
) -> tuple[tuple[Maneuver, ...], tuple[Maneuver, ...]]:
    """What `plan_all` gives, and every other extremal, of the other direction too, fastest first. As `plan`.

    In wind it takes half the time of `plan_all` and `candidates` one after the other.
    """
    wind, either = CALM if wind is None else wind, replace(orbit, turn=Turn.EITHER)
    known = _solved(pose, either, aircraft, wind, tolerance_m, ranked, wind_search.ranked)
    if air_past(orbit, aircraft, wind) == (0.0, 0.0):
        best = plan_all(pose, orbit, aircraft, wind, tolerance_m=tolerance_m)
    else:
        best = _tied(known, orbit, aircraft)
    others = (candidate.maneuver for candidate in known)
    return best, tuple(m for m in others if not any(m.turn == b.turn and m.segments == b.segments for b in best))


def each_way(
    pose: Pose, orbit: Orbit, aircraft: Aircraft, wind: Wind | None = None, *, tolerance_m: float = 0.0
) -> tuple[tuple[Maneuver, ...], tuple[Maneuver, ...]]:
    """The fastest maneuver of each direction as `compared` tells them: two where they tie, or the best and the other.

    In wind it takes half the time of `compared`. As `plan` else.
    """
    found: list[Solved] = []
    for turn in (Turn.CW, Turn.CCW):
        one_way = replace(orbit, turn=turn)
        found += _solved(pose, one_way, aircraft, wind, tolerance_m, _optimum_alone, _fastest_alone)
    known = sorted((_asked_as(candidate, orbit) for candidate in found), key=lambda candidate: candidate.time)
    best = _tied(known, orbit, aircraft)
    return best, tuple(candidate.maneuver for candidate in known if candidate.maneuver not in best)


class Solved(NamedTuple):
    """A maneuver, and its time in the kernel's units, which decides ties."""

    maneuver: Maneuver
    time: float


def _asked_as(candidate: Solved, orbit: Orbit) -> Solved:
    """A candidate with the circle as it was asked for: one direction, or either."""
    return candidate._replace(maneuver=replace(candidate.maneuver, orbit=orbit))


def _tied(known: Sequence[Solved], orbit: Orbit, aircraft: Aircraft) -> tuple[Maneuver, ...]:
    """The maneuvers in the direction asked for that tie with the fastest; `known` has the fastest first."""
    asked = [_asked_as(one, orbit) for one in known if orbit.turn in (Turn.EITHER, one.maneuver.turn)]
    R = radius_in_turns(orbit, aircraft)
    least = min(candidate.time for candidate in asked)
    return tuple(candidate.maneuver for candidate in asked if wind_search.is_tie(candidate.time, least, R))


def _optimum_alone(*scene: Any) -> list[Entry]:
    return [optimum(*scene)]


def _fastest_alone(problem: WindProblem) -> list[WindEntry]:
    return [wind_search.fastest(problem)]


def _solved(
    pose: Pose,
    orbit: Orbit,
    aircraft: Aircraft,
    wind: Wind | None,
    tolerance_m: float,
    in_still_air: Callable[..., list[Entry]],
    in_wind: Callable[..., list[WindEntry]],
) -> tuple[Solved, ...]:
    """The answers of the function for still air or of that for wind, in SI."""
    wind = CALM if wind is None else wind
    if air_past(orbit, aircraft, wind) == (0.0, 0.0):
        scene = normalised(pose, orbit, aircraft, tolerance_m)
        return tuple(
            Solved(maneuver(pose, orbit, aircraft, wind, entry, _missed(scene, entry)), duration(entry))
            for entry in in_still_air(*scene)
        )
    found = in_wind(drifting(pose, orbit, aircraft, wind, tolerance_m))
    if not found or found[0].status != Status.OK:
        raise NotConverged(
            f"{Status.NOT_CONVERGED.message}: pose {pose.east_m:g} {pose.north_m:g} {pose.heading_deg:g}, wind "
            f"{wind.speed_m_s:g} m/s from {wind.from_deg:g}; a pose moved by a millimetre may do"
        )
    return tuple(
        Solved(
            maneuver(pose, orbit, aircraft, wind, wind_search.entry_of(entry), entry.miss), wind_search.time_of(entry)
        )
        for entry in found
    )


def _missed(scene: Scene, flown: Entry) -> float:
    return miss(scene.x, scene.y, scene.R, flown)
