"""Plans: the optimum, every optimum, every extremal."""

from collections.abc import Callable
from dataclasses import replace

from loiter.errors import NotConverged
from loiter.kernel import drift
from loiter.kernel.codes import Status
from loiter.kernel.synthesis import Flown, miss, optima, optimum, ranked
from loiter.planning.held import air_past
from loiter.planning.maneuver import Maneuver
from loiter.planning.model import CALM, Aircraft, Orbit, Pose, Turn, Wind
from loiter.planning.scaling import Scene, drifting, maneuver, normalised


def plan(
    pose: Pose, orbit: Orbit, aircraft: Aircraft, wind: Wind | None = None, *, tolerance_m: float = 0.0
) -> Maneuver:
    """The fastest way from `pose` onto `orbit`, to be joined tangentially and held in the direction `orbit.turn`.

    In still air (`wind` None, or as fast as the circle moves) the answer is the least of the extremals of the maximum
    principle that can win, in closed form (docs/theory.md, section 3). In wind, and onto a circle that moves, it is
    joined tangentially as the circle sees it, over the ground if it stands still, and found by branch and bound over
    the point of joining (docs/wind.md). Where several maneuvers are optimal it is one of them; `plan_all` gives them
    all.

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
    return _solved(pose, orbit, aircraft, wind, tolerance_m, lambda *s: [optimum(*s)], lambda *s: [drift.fastest(*s)])[
        0
    ]


def plan_all(
    pose: Pose, orbit: Orbit, aircraft: Aircraft, wind: Wind | None = None, *, tolerance_m: float = 0.0
) -> tuple[Maneuver, ...]:
    """Every optimal maneuver, those that tie up to rounding; the fastest first. As `plan` else.

    On a circle of the turn radius held either way in still air they are 1, 2 or 4 (paper, section 6); elsewhere there
    may be 3. In wind two tie seldom but where a mirror shows the same scene.
    """
    return _solved(pose, orbit, aircraft, wind, tolerance_m, optima, drift.optima)


def candidates(
    pose: Pose, orbit: Orbit, aircraft: Aircraft, wind: Wind | None = None, *, tolerance_m: float = 0.0
) -> tuple[Maneuver, ...]:
    """The extremals of docs/theory.md, section 3, fastest first and losers too, for the turn asked for. As `plan`.

    In wind: the maneuvers to points of the circle that are met sooner than the points beside them, as far as 128 points
    all round tell them apart.
    """
    return _solved(pose, orbit, aircraft, wind, tolerance_m, ranked, drift.ranked)


def compared(
    pose: Pose, orbit: Orbit, aircraft: Aircraft, wind: Wind | None = None, *, tolerance_m: float = 0.0
) -> tuple[tuple[Maneuver, ...], tuple[Maneuver, ...]]:
    """What `plan_all` gives, and every other extremal, of the other direction too, fastest first. As `plan`.

    In wind it takes half the time of `plan_all` and `candidates` one after the other.
    """
    wind, either = CALM if wind is None else wind, replace(orbit, turn=Turn.EITHER)
    known = candidates(pose, either, aircraft, wind, tolerance_m=tolerance_m)
    if air_past(orbit, aircraft, wind) == (0.0, 0.0):
        best = plan_all(pose, orbit, aircraft, wind, tolerance_m=tolerance_m)
    else:
        best = _tied(tuple(replace(m, orbit=orbit) for m in known if orbit.turn in (Turn.EITHER, m.turn)))
    return best, tuple(m for m in known if not any(m.turn == b.turn and m.segments == b.segments for b in best))


def each_way(
    pose: Pose, orbit: Orbit, aircraft: Aircraft, wind: Wind | None = None, *, tolerance_m: float = 0.0
) -> tuple[tuple[Maneuver, ...], tuple[Maneuver, ...]]:
    """The fastest maneuver of each direction as `compared` tells them: two where they tie, or the best and the other.

    In wind it takes half the time of `compared`. As `plan` else.
    """
    ways = [replace(orbit, turn=turn) for turn in (Turn.CW, Turn.CCW)]
    found = [replace(plan(pose, way, aircraft, wind, tolerance_m=tolerance_m), orbit=orbit) for way in ways]
    known = sorted(found, key=lambda m: m.duration_s)
    best = _tied(tuple(m for m in known if orbit.turn in (Turn.EITHER, m.turn)))
    return best, tuple(m for m in known if m not in best)


def _tied(maneuvers: tuple[Maneuver, ...]) -> tuple[Maneuver, ...]:
    """Those that tie with the first, of maneuvers fastest first: `drift.optima` in SI."""
    first = maneuvers[0]
    r, v = first.aircraft.turn_radius_m, first.aircraft.airspeed_m_s
    T, R = [m.duration_s * v / r for m in maneuvers], first.orbit.radius_m / r
    return tuple(m for m, t in zip(maneuvers, T, strict=True) if drift.tied(t, T[0], R))


def _solved(
    pose: Pose,
    orbit: Orbit,
    aircraft: Aircraft,
    wind: Wind | None,
    tolerance_m: float,
    in_still_air: Callable[..., list[Flown]],
    in_wind: Callable[..., list[drift.Joined]],
) -> tuple[Maneuver, ...]:
    """What the one or the other function of the kernel finds, in SI."""
    wind = CALM if wind is None else wind
    if air_past(orbit, aircraft, wind) == (0.0, 0.0):
        scene = normalised(pose, orbit, aircraft, tolerance_m)
        return tuple(
            maneuver(pose, orbit, aircraft, wind, flown, _missed(scene, flown)) for flown in in_still_air(*scene)
        )
    found = in_wind(*drifting(pose, orbit, aircraft, wind, tolerance_m))
    if not found or found[0][0] != Status.OK:
        raise NotConverged(
            f"{Status.NOT_CONVERGED.message}: pose {pose.east_m:g} {pose.north_m:g} {pose.heading_deg:g}, wind "
            f"{wind.speed_m_s:g} m/s from {wind.from_deg:g}; a pose moved by a millimetre may do"
        )
    return tuple(maneuver(pose, orbit, aircraft, wind, drift.flight(joined), joined[7]) for joined in found)


def _missed(scene: Scene, flown: Flown) -> float:
    return miss(scene.x, scene.y, scene.R, flown)
