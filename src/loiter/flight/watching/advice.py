"""Advice for a pilot: the actions of a plan without those too short to fly, and whether the circle is held.

Because of measurement noise a plan from a measured position usually begins with a tiny turn. And since autopilots hold
circles with an error of a few metres, plans from near the circle would always lead back onto it.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from loiter.guidance.circle import Band, CircleOffset, circle_offset
from loiter.guidance.protocol import State
from loiter.planning.compass import heading_vector
from loiter.planning.maneuver import Maneuver
from loiter.planning.model import Turn, sign_of

# Segments shorter than SHORT_S seconds are not advised: banking takes about as long. The current action is advised
# until less than LEFT_S is left of it, so that noise does not make the advice alternate.
SHORT_S, LEFT_S = 1.0, 0.4

# An aircraft flies along the circle if its track is within ALONG_DEG of the tangent, and its distance from the circle
# within BAND_SHARE of the radius, or BAND_M if that is more; while joining, it crosses this band at a steeper angle.
# It holds the circle once it has flown along it for HOLD_S seconds, until it exceeds LEAVING times these limits.
ALONG_DEG, BAND_SHARE, BAND_M, HOLD_S, LEAVING = 15.0, 0.15, 15.0, 3.0, 2.0


class Action(NamedTuple):
    """What to do, "L", "S" or "R", and in how many seconds. The last action of a plan is the turn of the hold."""

    letter: str
    in_s: float


def actions(plan: Maneuver, current: str) -> tuple[Action, ...]:
    """The actions for the segments of a plan that are long enough, and the turn of the hold.

    The first action begins now, even if segments before it are left out. `current` is the action advised last.
    """
    long_enough: list[Action] = []
    previous = ""
    for i, segment in enumerate(plan.segments):
        least_s = LEFT_S if i == 0 and segment.letter == current else SHORT_S
        if segment.duration_s >= least_s and segment.letter != previous:
            long_enough.append(Action(segment.letter, segment.start_s if long_enough else 0.0))
            previous = segment.letter
    # A clockwise circle is held with a right turn.
    hold = "L" if plan.turn == Turn.CCW else "R"
    return (*long_enough, Action(hold, plan.duration_s if long_enough else 0.0))


def plan_offset(plan: Maneuver) -> CircleOffset:
    """The offset from the circle of an aircraft at the start of a plan."""
    here, V = plan.start, plan.aircraft.airspeed_m_s
    (east, north), (wind_east, wind_north) = heading_vector(here.heading_deg), plan.wind.velocity_m_s
    velocity = V * east + wind_east, V * north + wind_north
    return circle_offset(State(0.0, here.east_m, here.north_m, here.heading_deg, 0.0, *velocity, V), plan.orbit)


class HoldDetector:
    """Detects, from successive offsets, whether an aircraft holds the circle, and in which direction."""

    def __init__(self, radius_m: float, noise_m: float) -> None:
        self._band = Band(max(BAND_SHARE, BAND_M / radius_m), ALONG_DEG)
        self._noise_m = noise_m
        self._along_since: dict[Turn, float] = {}
        self._turn: Turn | None = None

    def turn(self, offset: CircleOffset, turns: Sequence[Turn], time_s: float) -> Turn | None:
        """The direction of `turns` in which the circle is held at a time, or None.

        For the first of `turns`, flying along the circle within `noise_m` of it counts as holding it at once.
        """
        if self._turn is not None and self._band.has(offset, sign_of(self._turn), LEAVING):
            return self._turn
        self._turn = None
        for i, turn in enumerate(turns):
            if not self._band.has(offset, sign_of(turn)):
                self._along_since.pop(turn, None)
                continue
            since_s = time_s - self._along_since.setdefault(turn, time_s)
            if since_s >= HOLD_S or (i == 0 and abs(offset.outside_m) <= self._noise_m):
                self._turn = turn
                break
        return self._turn
