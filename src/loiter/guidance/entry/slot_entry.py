"""The law that flies the fastest entry into a slot, and keeps the slot in the hold."""

from __future__ import annotations

from math import degrees

from loiter.errors import InvalidArgument, instance, share
from loiter.guidance.entry import law_step
from loiter.guidance.entry.loiter_entry import LoiterEntry
from loiter.guidance.entry.slot_step import SlotSettings, advance_in_slot, first_slot_memory, phase_behind
from loiter.guidance.protocol import State
from loiter.guidance.vehicle import Roll
from loiter.planning.model import CALM, Aircraft, Orbit, Pose, Turn, Wind
from loiter.planning.problem import Problem
from loiter.planning.slot import Slot, phase_at_start

# The largest share by which the radius of the hold may differ from that of the circle, unless it is given.
BAND = 0.15


class SlotEntry(LoiterEntry):
    """A guidance law that flies the fastest entry into `slot`, and keeps the slot while it holds the circle.

    The slot moves as an aircraft does that holds `orbit` at the airspeed of `aircraft` in `wind`; its times are those
    of `State.time_s`, and all aircraft of a fleet must be given the same airspeed and wind. The entry is planned anew
    while gusts and errors change the time of arrival. On the circle the radius differs from that of the orbit by a
    share of `band` at most, so that an aircraft which is late turns inside. Otherwise like `LoiterEntry`, whose
    arguments it takes; it needs a direction, cw or ccw.

    Raises `InvalidArgument` for a direction of either and for a band that is not between 0 and 1, and the errors of
    `LoiterEntry`.
    """

    def __init__(
        self,
        orbit: Orbit,
        aircraft: Aircraft,
        wind: Wind | None = None,
        *,
        slot: Slot,
        band: float = BAND,
        roll: Roll = Roll(),  # noqa: B008 (frozen)
        delay_s: float = law_step.DELAY_S,
        identify: bool = True,
    ) -> None:
        super().__init__(orbit, aircraft, wind, roll=roll, delay_s=delay_s, identify=identify)
        instance("slot", slot, Slot)
        if orbit.turn == Turn.EITHER:
            raise InvalidArgument("orbit turn", "is either: a slot moves clockwise or counter-clockwise")
        problem = Problem(Pose(orbit.east_m, orbit.north_m, 0.0), orbit, aircraft, CALM if wind is None else wind)
        given, V = problem.in_wind(), aircraft.airspeed_m_s
        phase = phase_at_start(slot, given, problem.time_unit_s)
        band = share("band", band)
        self._slot = SlotSettings(given.side, phase, orbit.radius_m, V, given.wx * V, given.wy * V, band)
        self._kept = first_slot_memory(self._slot)

    @property
    def behind_deg(self) -> float:
        """How far the slot is ahead of the aircraft on the circle, degrees; nan before there is a plan."""
        return degrees(self._kept.behind)

    def phase_error_deg(self, time_s: float, east_m: float, north_m: float) -> float:
        """How far the slot is ahead of a place at a time, degrees in (-180, 180]."""
        s = self._settings
        x = east_m - s.east_m - s.velocity_east_m_s * time_s
        y = north_m - s.north_m - s.velocity_north_m_s * time_s
        return degrees(phase_behind(self._slot, x, y, time_s - self._kept.zero_s))

    def _advance(self, state: State, dt: float) -> law_step.Memory:
        memory, self._kept = advance_in_slot(
            self._memory, self._kept, self._settings, self._slot, self._vehicle, state, dt
        )
        return memory
