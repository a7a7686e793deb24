"""Plans: the optimum, every optimum, every extremal."""

from loiter.kernel.synthesis import optima, optimum, ranked
from loiter.planning.maneuver import Maneuver
from loiter.planning.model import Aircraft, Orbit, Pose
from loiter.planning.scaling import maneuver, normalised


def plan(pose: Pose, orbit: Orbit, aircraft: Aircraft, *, tolerance_m: float = 0.0) -> Maneuver:
    """The fastest way from `pose` onto `orbit`, to be joined tangentially and held in the direction `orbit.turn`.

    The answer is the least of the extremals of the maximum principle that can win (docs/theory.md, section 3).
    Where several maneuvers are optimal it is one of them; `plan_all` gives them all.

    The least time jumps where the start passes the last arc (docs/theory.md, section 6): just beyond, the aircraft
    must go round. A start that lies beyond by rounding counts as on the arc; `tolerance_m` (metres) widens that to the
    noise of a sensor. The maneuver then misses the tangent point by no more than that, as its `miss_m` says.

    Raises `RadiusTooSmall` where the aircraft cannot hold the circle, `OutOfRange` where coordinates are so large that
    doubles cannot tell one turn from the next, `InvalidArgument` for a tolerance that is negative or not finite.

    >>> from loiter import Aircraft, Orbit, Pose, plan
    >>> m = plan(Pose(-400.0, 120.0, 90.0), Orbit(0.0, 0.0, 80.0), Aircraft(18.0, max_bank_deg=35.0))
    >>> m.word, m.turn.value, round(m.duration_s, 2)
    ('RSL', 'cw', 19.77)
    """
    scene = normalised(pose, orbit, aircraft, tolerance_m)
    return maneuver(pose, orbit, aircraft, scene, optimum(*scene))


def plan_all(pose: Pose, orbit: Orbit, aircraft: Aircraft, *, tolerance_m: float = 0.0) -> tuple[Maneuver, ...]:
    """Every optimal maneuver, those that tie up to rounding; the fastest first. As `plan` else.

    On a circle of the turn radius held either way they are 1, 2 or 4 (paper, section 6); elsewhere there may be 3.
    """
    scene = normalised(pose, orbit, aircraft, tolerance_m)
    return tuple(maneuver(pose, orbit, aircraft, scene, flown) for flown in optima(*scene))


def candidates(pose: Pose, orbit: Orbit, aircraft: Aircraft, *, tolerance_m: float = 0.0) -> tuple[Maneuver, ...]:
    """The extremals of docs/theory.md, section 3, fastest first and losers too, for the turn asked for. As `plan`."""
    scene = normalised(pose, orbit, aircraft, tolerance_m)
    return tuple(maneuver(pose, orbit, aircraft, scene, flown) for flown in ranked(*scene))
