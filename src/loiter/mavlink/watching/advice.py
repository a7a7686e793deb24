"""What to do next, as a pilot can use it: a plan without what is too short to fly, and whether the circle is held.

A plan from a measured place begins, as a rule, with a tiny turn that noise makes; and beside the circle it leads back
onto it for ever, since autopilots hold circles a few metres off.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import atan2, degrees
from typing import NamedTuple

from loiter.guidance.laws.following import polar_state
from loiter.planning.compass import heading_vector
from loiter.planning.maneuver import Maneuver
from loiter.planning.model import Turn

# Seconds below which a piece is too short to fly: banking takes about as long. The piece that is being flown is told
# until less than the second is left of it, so that the words do not go to and fro with the noise.
SHORT_S, LEFT_S = 1.0, 0.4

# An aircraft flies along a circle within this angle, degrees. Beside it is within this share of its radius, or so many
# metres where that is more; a plan that joins would cross that band at a steeper angle. Who keeps along beside the
# circle for so many seconds holds it, until it leaves a band and an angle so many times as wide.
ALONG_DEG, BESIDE_SHARE, BESIDE_M, BESIDE_S, LEAVING = 15.0, 0.15, 15.0, 3.0, 2.0


class Action(NamedTuple):
    """What to do, "L", "S" or "R", and in how many seconds. The last one of a plan is the turn of the hold."""

    letter: str
    in_s: float


class Beside(NamedTuple):
    """An aircraft beside a circle: metres outside it, and degrees between its way and the clockwise tangent.

    Both are over the ground, or as the circle sees them where it moves.
    """

    outside_m: float
    off_clockwise_deg: float

    def off_deg(self, turn: Turn) -> float:
        """Degrees between its way and the tangent in a direction."""
        return self.off_clockwise_deg if turn == Turn.CW else 180.0 - self.off_clockwise_deg


def actions(plan: Maneuver, flown: str) -> tuple[Action, ...]:
    """What to do now and then: the pieces of a plan that are long enough, and the hold. `flown` is what was told last.

    The first of them begins now, whatever is left out before it.
    """
    worth: list[Action] = []
    for segment in plan.segments:
        least_s = LEFT_S if segment is plan.segments[0] and segment.letter == flown else SHORT_S
        if segment.duration_s >= least_s and not (worth and worth[-1].letter == segment.letter):
            worth.append(Action(segment.letter, segment.start_s if worth else 0.0))
    # A clockwise circle is held turning right.
    hold = "L" if plan.turn == Turn.CCW else "R"
    return (*worth, Action(hold, plan.duration_s if worth else 0.0))


def beside(plan: Maneuver) -> Beside:
    """Where an aircraft at the start of a plan is beside the circle."""
    here, orbit = plan.start, plan.orbit
    (east, north), (wind_east, wind_north) = heading_vector(here.heading_deg), plan.wind.velocity_m_s
    speed = plan.aircraft.airspeed_m_s
    velocity = (
        speed * east + wind_east - orbit.velocity_east_m_s,
        speed * north + wind_north - orbit.velocity_north_m_s,
    )
    seen = polar_state(here.east_m - orbit.east_m, here.north_m - orbit.north_m, velocity, here.heading_deg)
    off = abs(degrees(atan2(seen.outward_m_s, seen.clockwise_m_s)))
    return Beside(seen.distance_m - orbit.radius_m, off)


class Holding:
    """Tells whether an aircraft holds the circle, and which way round, from where it is time after time."""

    def __init__(self, radius_m: float, tolerance_m: float) -> None:
        self._band_m = max(BESIDE_SHARE * radius_m, BESIDE_M)
        self._tolerance_m = tolerance_m
        self._along: dict[Turn, float] = {}
        self._held: Turn | None = None

    def turn(self, seen: Beside, turns: Sequence[Turn], time_s: float) -> Turn | None:
        """The direction in which it holds the circle at a time, of some; the first counts at once on the circle."""
        if self._held is not None and self._keeps(seen, self._held, LEAVING):
            return self._held
        self._held = None
        for turn in turns:
            if not self._keeps(seen, turn, 1.0):
                self._along.pop(turn, None)
                continue
            since_s = time_s - self._along.setdefault(turn, time_s)
            if since_s >= BESIDE_S or (turn == turns[0] and abs(seen.outside_m) <= self._tolerance_m):
                self._held = turn
                break
        return self._held

    def _keeps(self, seen: Beside, turn: Turn, factor: float) -> bool:
        return abs(seen.outside_m) <= factor * self._band_m and seen.off_deg(turn) <= factor * ALONG_DEG
