"""The reasons to stop guiding a vehicle: lost link, mode changes, failsafes, bad or missing measurements."""

from __future__ import annotations

from math import inf, isnan, nan
from typing import NamedTuple

from loiter.flight.autopilots.modes import CRITICAL, TERMINATION, ModeWatch
from loiter.flight.autopilots.readiness import ARMED
from loiter.flight.guiding.measurements import Measurements
from loiter.flight.link.link import Vehicle
from loiter.flight.link.telemetry import ON_GROUND, STATE_KINDS, Telemetry

# Seconds without any message after which the link is lost, without a new state after which the data are stale, and
# within which some message must have arrived for the link to be alive.
SILENT_S, STALE_S, ALIVE_S = 2.0, 1.0, 0.5

# Measurements may be late by this, seconds, for this time, seconds; and the vehicle may leave our requests for its time
# unanswered for this time, seconds.
LATE_S, LATE_FOR_S, UNHEARD_S = 1.0, 0.5, 3.0

# The least rate of measurements, per second, with some margin, and the seconds for which it may be lower.
LEAST_HZ, SLOW_S = 4.5, 2.0

# Seconds for which the estimator may report that it has no position.
BAD_ESTIMATE_S = 1.0

# Seconds for which the pilot may move a stick.
STICK_S = 0.3

# The bank may differ from the command by more than this, degrees, for this time, seconds.
UNRESPONSIVE_DEG, UNRESPONSIVE_S = 25.0, 3.0

# The altitude may depart by this, metres, from the nearest that it has been to that of the circle, for this time,
# seconds.
DEPARTED_M, DEPARTED_S = 25.0, 0.5

# The least height above home, metres, of a vehicle that begins to be guided, of its circle, and in flight.
LEAST_HEIGHT_M, LOWEST_HEIGHT_M = 30.0, 15.0

# Flags of EKF_STATUS_REPORT and ESTIMATOR_STATUS: attitude, horizontal velocity and absolute position are needed; a
# constant position means that the estimator has none.
NEEDED_FLAGS, CONSTANT_POSITION = 1 | 2 | 16, 128


class StopReason(NamedTuple):
    """A reason to stop, as the beginning of a sentence.

    `ours` is whether the vehicle may be commanded once more, back to the fall-back circle: not if the link is lost, and
    not if the pilot or a failsafe has taken over. `measured` is whether its state is still known. `lost` is whether
    nothing is heard of the vehicle. `acts` is whether the autopilot may act on the same reason by itself.
    """

    reason: str
    ours: bool = True
    measured: bool = True
    lost: bool = False
    acts: bool = False


class ConditionTimer:
    """How long a condition has held without interruption, seconds."""

    def __init__(self) -> None:
        self._began: float | None = None

    def update(self, condition: bool, now: float) -> float:
        """The time for which the condition has held; 0 if it does not hold."""
        if not condition:
            self._began = None
            return 0.0
        if self._began is None:
            self._began = now
        return now - self._began


class Monitor:
    """Watches a vehicle and its link; `check` gives the first reason to stop.

    `circle_altitude_m` is the altitude of the circle above mean sea level, metres, nan before it is commanded;
    `wind_problem` why the circle cannot be held; `unanswered_s` how long the vehicle has not answered, seconds;
    `stick_moved` whether the pilot moves a stick.
    """

    def __init__(self, vehicle: Vehicle, telemetry: Telemetry, measurements: Measurements) -> None:
        self._vehicle, self._telemetry, self._measurements = vehicle, telemetry, measurements
        self.modes = ModeWatch(vehicle.autopilot)
        self.wind_problem = ""
        self.stick_moved = False
        self.unanswered_s = 0.0
        self.command_deg = self.bank_deg = 0.0
        self.circle_altitude_m, self._nearest_m = nan, inf
        self._bad, self._slow, self._off, self._departed, self._stick, self._late = (ConditionTimer() for _ in range(6))

    def check(self, now: float) -> StopReason | None:
        """The reason to stop, or None. Those that forbid any further command come first."""
        return self._taken_over(now) or self._unsafe(now) or self._unmeasured(now)

    def silent(self, now: float) -> str:
        """That the link is lost, in words; empty if it is not."""
        lost = now - self._telemetry.last_message_time > SILENT_S
        return f"nothing was heard from {self._vehicle.named} for {SILENT_S:g} s" if lost else ""

    def _taken_over(self, now: float) -> StopReason | None:
        if silent := self.silent(now):
            return StopReason(silent, ours=False, measured=False, lost=True)
        if unexpected_mode := self.modes.unexpected_mode(now):
            return StopReason(unexpected_mode, ours=False)
        if ended := self._ended():
            return StopReason(ended, ours=False)
        if self._stick.update(self.stick_moved, now) > STICK_S:
            return StopReason("the pilot moves a stick", ours=False)
        return None

    @property
    def is_ended(self) -> bool:
        """Whether the vehicle does not fly any more."""
        return bool(self._ended())

    def _ended(self) -> str:
        """That the vehicle does not fly any more, in words; empty if it does."""
        heartbeat, state = self._telemetry.last("HEARTBEAT"), self._telemetry.last("EXTENDED_SYS_STATE")
        if heartbeat is not None and heartbeat.system_status >= TERMINATION:
            return "the autopilot has terminated the flight"
        if heartbeat is not None and not heartbeat.base_mode & ARMED:
            return "the vehicle is disarmed"
        if state is not None and state.landed_state == ON_GROUND:
            return "the vehicle reports that it is on the ground"
        return ""

    def _unsafe(self, now: float) -> StopReason | None:
        fence, heartbeat = self._telemetry.last("FENCE_STATUS"), self._telemetry.last("HEARTBEAT")
        if fence is not None and fence.breach_status:
            return StopReason("the vehicle is outside its fence", acts=True)
        if heartbeat is not None and heartbeat.system_status >= CRITICAL:
            return StopReason("the autopilot reports a failsafe", acts=True)
        if problem := self._altitude(now):
            return problem
        if self.wind_problem:
            return StopReason(f"the circle cannot be held: {self.wind_problem}")
        if self._off.update(abs(self.command_deg - self.bank_deg) > UNRESPONSIVE_DEG, now) > UNRESPONSIVE_S:
            return StopReason(f"the vehicle does not follow the commanded bank, {self.command_deg:.0f} degrees")
        return None

    def _altitude(self, now: float) -> StopReason | None:
        """That the vehicle is too low, or that its altitude departs from that of the circle."""
        altitude_m, height_m, circle_m = (
            self._telemetry.fix().altitude_m,
            self._telemetry.height_m,
            self.circle_altitude_m,
        )
        off_m = abs(altitude_m - circle_m)
        self._nearest_m = min(self._nearest_m, off_m)
        if self._departed.update(off_m > self._nearest_m + DEPARTED_M, now) > DEPARTED_S:
            side = "above" if altitude_m > circle_m else "below"
            return StopReason(f"the vehicle is at {altitude_m:.0f} m, {off_m:.0f} m {side} the circle")
        if not isnan(circle_m) and height_m < LOWEST_HEIGHT_M:
            return StopReason(f"the vehicle is only {height_m:.0f} m above home", measured=False)
        return None

    @property
    def _is_estimator_ok(self) -> bool:
        """Whether the estimator has attitude, velocity and position, or has reported nothing."""
        reports = (self._telemetry.last(kind) for kind in ("EKF_STATUS_REPORT", "ESTIMATOR_STATUS"))
        return all(
            report is None or (report.flags & NEEDED_FLAGS == NEEDED_FLAGS and not report.flags & CONSTANT_POSITION)
            for report in reports
        )

    def _unmeasured(self, now: float) -> StopReason | None:
        m, telemetry = self._measurements, self._telemetry
        if telemetry.restarts:
            return StopReason("the clock of the autopilot went back: it has restarted", measured=False)
        if m.jump_m > 0.0:
            return StopReason(f"the position jumped by {m.jump_m:.0f} m", measured=False)
        if self._bad.update(not self._is_estimator_ok, now) > BAD_ESTIMATE_S:
            return StopReason("the estimator of the autopilot has lost its position", measured=False)
        # Where nothing at all arrives the pilot may have taken over: nothing is commanded until that is clear.
        alive = now - telemetry.last_message_time <= ALIVE_S
        for kind, measured in zip(STATE_KINDS, ("attitude", "position"), strict=True):
            if alive and telemetry.recent(kind, now, STALE_S) is None:
                return StopReason(f"no {measured} arrived for {STALE_S:g} s", measured=False)
        if self._late.update(m.late_s > LATE_S, now) > LATE_FOR_S:
            return StopReason(f"the measurements arrive {m.late_s:.1f} s late", measured=False)
        if self.unanswered_s > UNHEARD_S:
            return StopReason(f"{self._vehicle.named} has answered nothing for {UNHEARD_S:g} s: it may not hear us")
        rate_hz = m.rate_hz(now)
        if self._slow.update(rate_hz < LEAST_HZ, now) > SLOW_S:
            return StopReason(f"only {rate_hz:.1f} measurements a second arrive, and {LEAST_HZ:.0f} are needed")
        return None
