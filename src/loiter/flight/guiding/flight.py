"""A guided flight: its stages from the first message to the hand-over, and its end where something goes wrong."""

from __future__ import annotations

from collections.abc import Callable, Generator
from contextlib import suppress
from dataclasses import replace
from math import hypot, inf, isfinite, nan
from time import monotonic, time

from loiter.errors import InvalidArgument, LinkFailed, LoiterError, clause
from loiter.fences import ClearEntry
from loiter.fences.fence import checked_margin_m
from loiter.flight.autopilots.acceleration_sign import AccelerationSign, is_release, sign_of_version
from loiter.flight.autopilots.modes import GUIDED, HOLD, HOLD_MODES, OFFBOARD
from loiter.flight.autopilots.own_guidance import guidance_of
from loiter.flight.autopilots.settings import (
    LOITER_RADIUS,
    AutopilotSettings,
    autopilot_settings,
    change_of,
    law_change,
)
from loiter.flight.autopilots.steering import AccelerationSteering, CourseHold, RollSteering, Steering
from loiter.flight.guiding.contact import STEP_S, Contact
from loiter.flight.guiding.fall_back import FallBack, OwnGuidance, circles_beside, fall_back
from loiter.flight.guiding.hand_over import KEPT_S, SentCircle, last_bank_deg, sent_circle
from loiter.flight.guiding.holdability import HoldabilityWatch
from loiter.flight.guiding.monitor import StopReason
from loiter.flight.guiding.preparation import (
    LONGEST_SEARCH_S,
    FlightSetup,
    GuideRequest,
    Search,
    choose,
    pose_ahead,
    prepare,
)
from loiter.flight.guiding.report import GuideReport, Stage
from loiter.flight.guiding.settling import LASTING_S, PRESENT_S, SteadyHoldDetector
from loiter.flight.guiding.summary import loss_consequence, summary
from loiter.flight.link.command import PendingCommand, hold_command, mode_command
from loiter.flight.link.link import ACTIVE
from loiter.guidance.entry.fenced_entry import FencedEntry, SearchProblem
from loiter.guidance.entry.loiter_entry import LoiterEntry
from loiter.guidance.entry.route import MOST_PIECES
from loiter.guidance.entry.slot_entry import SlotEntry
from loiter.guidance.estimation.turn_fits import bounded_turn_ratio
from loiter.guidance.protocol import Command, Phase, State
from loiter.guidance.vehicle import VehicleEstimates, bank_at_rate, clip
from loiter.planning.maneuver import Maneuver
from loiter.planning.model import Orbit, Turn, sign_of, wind_from_velocity
from loiter.planning.slot import Slot

# Seconds for a command to be confirmed: the fall-back circle, PX4's offboard mode, the hand-over.
CONFIRM_S = 4.0

# At an early end a heartbeat shows first whether the mode is still ours: it is awaited for the first time, seconds. An
# autopilot that acts by itself, on a breach of its fence or in a failsafe, has changed its mode after the second.
FRESH_MODE_S, OWN_ACTION_S = 0.5, 1.0

# Seconds until the circle is commanded again, and PX4's change of mode, which is refused until PX4 has noticed the
# setpoints.
REPEAT_S, MODE_REPEAT_S = 0.5, 0.25

# Seconds to wait for a heartbeat before PX4's mode is changed, and before the first command.
NEXT_HEARTBEAT_S, FIRST_HEARTBEAT_S = 0.3, 2.0

# Seconds after an accepted circle in which the vehicle may still report the place to which it flew before; seconds for
# which a report is awaited at an early end, and the age of one that still counts.
TARGET_CHANGE_S, OBSERVE_S, RECENT_S = 1.0, 2.0, 1.0

# The first guess of the age of measurements without that of the link, seconds, before the law has identified it.
DELAY_S = 0.1

# Seconds between checks of the wind.
WIND_S = 0.5

# The law has twice the time of its first plan and this, seconds, until the circle is held steadily.
HAND_OVER_S = 180.0

# An entry clear of a fence begins so many seconds ahead at first, and the first command is given so many seconds
# before: meanwhile the circle is accepted, and the aircraft rolls.
FIRST_AHEAD_S, BEGIN_S = 1.5, 0.4

# Seconds between checks of the own way to the fall-back circle.
FALL_BACK_S = 1.0

# What a refused circle may mean.
OUTSIDE_FENCE = "; its fence is on, and the circle may be outside"


class GuidingStopped(Exception):
    """Guiding must stop, for the reason in `stop`."""

    def __init__(self, stop: StopReason) -> None:
        super().__init__(stop.reason)
        self.stop = stop


class GuidedFlight:
    """A guided flight; `stages` flies it, `stop` ends it early.

    `record` is called with a report for every step. The times of reports count from `began`. `resumed` is whether an
    earlier flight has already commanded the vehicle.
    """

    def __init__(self, contact: Contact, request: GuideRequest, period_s: float, began: float) -> None:
        self.orbit = request.orbit
        self.resumed = False
        self.record: Callable[[GuideReport], None] = lambda report: None
        self._contact, self._request, self._period_s, self._began = contact, request, period_s, began
        self._monitor, self._modes = contact.monitor, contact.monitor.modes
        self._setup: FlightSetup
        # The parameters of the vehicle when the law was made.
        self._built_for: dict[str, float]
        self._law: LoiterEntry
        self._holdability: HoldabilityWatch
        self._steady = SteadyHoldDetector(self.orbit)
        self._sent: SentCircle
        # What has been done: whether the fall-back circle was commanded and accepted, whether banks are commanded.
        self._commanded = self._accepted = self._steered = False
        self._accepted_at = inf
        # The circle to which the vehicle is commanded back, the one before, and when it is due to be chosen again; the
        # entry clear of the fence that is flown from the first command on.
        self._circle = self._former_circle = self.orbit
        self._next_fall_back = -inf
        self._new_fall_back: PendingCommand | None = None
        self._entry: Maneuver | None = None
        # How often the vehicle was found to bank opposite to its commands.
        self._reversals = 0
        self._notices: list[str] = []
        self._state: State
        self._stage = Stage.SHOWING if request.dry_run else Stage.FALL_BACK
        self._report = GuideReport(0.0, self._stage)
        self._last_step = contact.began
        self._next_report, self._next_wind = inf, -inf
        self._plan_report(contact.began)

    # The stages.

    def stages(self, timeout_s: float, *, only_vehicle: bool) -> Generator[GuideReport, None, None]:
        """Fly all stages; yields reports. The arguments are those of `prepare`."""
        self._begin(prepare(self._contact, self._request, timeout_s, only_vehicle=only_vehicle))
        if self._request.dry_run:
            yield from self._show()
        yield from self._await_confirmation()
        yield from self._fall_back()
        if self._contact.flies_px4:
            yield from self._enter_offboard()
        yield from self._steer()
        yield self._hand_over()

    def _begin(self, setup: FlightSetup) -> None:
        """Take what the flight begins with, and make the law; raises errors before anything is commanded."""
        self._setup, self.orbit, self._state = setup, setup.orbit, setup.state
        self._circle = self.orbit
        self._notices += setup.notices
        self._steady = SteadyHoldDetector(self.orbit)
        self._built_for = dict(self._contact.parameters.known)
        self._law = self._new_law()
        self._contact.steering = self._new_steering()

    def _await_confirmation(self) -> Generator[GuideReport, None, None]:
        """Show the summary, wait until it is confirmed, and check that the mode is still the first that was heard."""
        contact = self._contact
        self._check_mode()
        self._notices += self._summary
        self._stage = Stage.READY
        yield self._take_report(monotonic())
        confirmed_at = inf
        while contact.telemetry.arrived("HEARTBEAT") <= confirmed_at:
            now = contact.listen()
            self._check(now)
            self._check_mode()
            if confirmed_at == inf:
                confirmed_at = now if self._is_confirmed() else inf
            elif now > confirmed_at + FIRST_HEARTBEAT_S:
                raise LinkFailed(f"{contact.name} sends no heartbeat")
            contact.request_in_flight(now)
            contact.request_heartbeat(now)
        # Meanwhile the vehicle has flown on; the altitude is the one that was confirmed.
        request = self._request._replace(altitude_m=self._setup.altitude_m)
        if contact.fence is not None:
            request = request._replace(orbit=self.orbit)
        settings = autopilot_settings(contact.autopilot, contact.parameters.known)
        self._begin(choose(contact, request, settings)._replace(notices=()))
        if isinstance(self._law, FencedEntry):
            yield from self._find_entry(request, settings)
        self._stage = Stage.FALL_BACK
        self._plan_report(monotonic())

    def _find_entry(self, request: GuideRequest, settings: AutopilotSettings) -> Generator[GuideReport, None, None]:
        """Search for a clear entry from where the vehicle will be when it is found, and wait until it is there.

        Raises `LinkFailed` where none is found, or the vehicle is elsewhere by then each time.
        """
        contact, ahead_s, is_tight, until = self._contact, FIRST_AHEAD_S, False, monotonic() + LONGEST_SEARCH_S
        while monotonic() < until:
            self._begin(choose(contact, request, settings)._replace(notices=()))
            law, state, began = self._law, self._state, monotonic()
            assert isinstance(law, FencedEntry)
            start = pose_ahead(contact, state, ahead_s, self._setup.wind)
            found = yield from self._searched(law.problem_at(start, is_tight=is_tight), until)
            took_s = monotonic() - began
            if found.maneuver is None or len(found.maneuver.segments) > MOST_PIECES:
                if is_tight:
                    raise LinkFailed(f"{contact.name} cannot be guided: {clause(found.sentence)}")
                is_tight = True
            while self._measure().time_s < state.time_s + ahead_s - BEGIN_S:
                yield from self._wait()
            here = pose_ahead(contact, self._state, BEGIN_S, self._setup.wind)
            if found.maneuver is not None and took_s <= ahead_s and law.begins_at(here, start):
                self._entry = found.maneuver
                return
            # The next one begins where the vehicle will be if that search takes as long and half as much again.
            ahead_s = min(max(FIRST_AHEAD_S, 1.5 * took_s + BEGIN_S), LONGEST_SEARCH_S)
        elsewhere = f"was elsewhere than expected each time when one was found, for {LONGEST_SEARCH_S:g} s"
        raise LinkFailed(f"{contact.name} cannot be guided by an entry clear of the fence: it {elsewhere}")

    def _searched(self, problem: SearchProblem, until: float) -> Generator[GuideReport, None, ClearEntry]:
        """The answer of a search for a clear entry; the vehicle is listened to meanwhile."""
        search = Search(self._contact, problem, until)
        while not search.ended(monotonic()):
            yield from self._wait()
        try:
            return search.found
        except InvalidArgument as error:
            raise LinkFailed(f"{self._contact.name} cannot be guided: its {error}") from error

    def _wait(self) -> Generator[GuideReport, None, None]:
        """Listen until the next state, before the first command."""
        now = self._contact.listen()
        self._check(now)
        self._check_mode()
        self._contact.request_in_flight(now)
        if now >= self._next_report:
            self._measure()
            yield self._take_report(now)

    def _is_confirmed(self) -> bool:
        """Whether the flight may begin; a vehicle of a fleet takes its slot then."""
        request = self._request
        if request.assign is None:
            return request.confirm is None or request.confirm()
        assigned = request.assign(self._setup, self._measure(), monotonic() - self._contact.measurements.arrived)
        if assigned is None:
            return False
        self._request = request._replace(orbit=assigned.orbit, slot=assigned.slot)
        return True

    def _check_mode(self) -> None:
        """Stop where the mode has changed since the vehicle was first heard: the pilot has taken over."""
        if change := self._modes.change:
            raise GuidingStopped(StopReason(f"{change} before the first command"))

    @property
    def _summary(self) -> tuple[str, ...]:
        turn = self._setup.orbit.turn.described
        if self._request.orbit.turn == Turn.EITHER:
            assigned = self._request.assign is not None
            turn = "in the direction of the fleet" if assigned else f"{turn}, which is faster now"
        return summary(self._contact, self._setup, turn)

    def _new_law(self) -> LoiterEntry:
        p = self._setup
        delay_s, fence = DELAY_S + self._contact.round_trip.seconds, self._contact.fence
        if self._request.slot is not None:
            slot, band = self._slot_by_vehicle(self._request.slot), self._request.slot_band
            aimed = p.aircraft, self._request.wind
            return SlotEntry(self.orbit, *aimed, slot=slot, band=band, roll=p.settings.roll, delay_s=delay_s)
        if fence is None or self._request.dry_run:
            return LoiterEntry(self.orbit, p.aircraft, p.wind, roll=p.settings.roll, delay_s=delay_s)
        return FencedEntry(
            self.orbit,
            p.aircraft,
            p.wind,
            fence=fence,
            margin_m=self._request.margin_m,
            background=True,
            first=self._entry,
            roll=p.settings.roll,
            delay_s=delay_s,
        )

    def _new_holdability(self) -> HoldabilityWatch:
        limit_deg = self._setup.aircraft.max_bank_deg
        assert limit_deg is not None  # the aircraft is made with a bank limit
        return HoldabilityWatch(self.orbit.radius_m, limit_deg)

    def _slot_by_vehicle(self, slot: Slot) -> Slot:
        """The slot by the clock of the vehicle: the newest measurement arrived at a Unix time."""
        arrived_s = time() - (monotonic() - self._contact.measurements.arrived)
        return replace(slot, at_s=slot.at_s - (arrived_s - self._state.time_s))

    def _new_steering(self) -> Steering:
        vehicle, p = self._contact.link.vehicle, self._setup
        if not self._contact.flies_px4:
            return RollSteering(vehicle)
        version = self._contact.version
        sign = AccelerationSign(sign_of_version(version), p.settings.roll, known=is_release(version))
        guidance = guidance_of(self._contact.parameters.known)
        course = CourseHold(guidance.course_gain if guidance else 0.0, p.settings.airspeed_m_s)
        return AccelerationSteering(vehicle, self._contact.telemetry, p.altitude_m, sign, course)

    def _show(self) -> Generator[GuideReport, None, None]:
        """Show what would be commanded, until the generator is closed; nothing is commanded."""
        self._notices.append("Dry run: nothing is commanded; only telemetry and parameters are requested.")
        self._notices += self._summary
        while True:
            now = self._contact.listen()
            self._check(now)
            if now >= self._next_report:
                # Its commands are not flown: each report is that of a law that begins now.
                self._law = self._new_law()
                state = self._measure()
                self._record_step(state, self._law.step(state, STEP_S), now)
                yield self._take_report(now)

    def _fall_back(self) -> Generator[GuideReport, None, None]:
        """Command the fall-back circle, and wait until the vehicle has accepted it.

        Raises `LinkFailed` where the vehicle would fly through the fence to each that it could be.
        """
        if self._contact.fence is not None:
            chosen = self._clear_fall_back([self.orbit], 0.0)
            if not chosen.is_clear:
                through = "by its own guidance it would fly through the fence, onto the circle and onto any beside it"
                raise LinkFailed(f"{self._contact.name} cannot be guided: {through}")
            self._take_circle(chosen.circle)
        pending = self._contact.pending = self._hold_command()
        self._commanded, self._contact.link.status = True, ACTIVE
        self._contact.link.commanders = False  # what was commanded before is taken over
        self._monitor.circle_altitude_m = self._setup.altitude_m
        self._modes.expect(self._hold_mode)
        # PX4 accepts the offboard mode only while setpoints arrive: they begin here.
        yield from self._await(pending)
        self._accepted, self._accepted_at = True, monotonic()
        self._modes.accepted(self._accepted_at)

    def _clear_fall_back(self, circles: list[Orbit], kept_s: float, bank_deg: float | None = None) -> FallBack:
        """The first of some circles, and of those beside the vehicle, onto which its own guidance keeps clear.

        The vehicle keeps its bank for some seconds before: the present one, or that given and for a circle beside it
        that of the circle.
        """
        fence, state, own = self._contact.fence, self._measure(), self._own_guidance(kept_s)
        assert fence is not None  # the caller has checked
        beside = [*circles_beside(state, self.orbit, own.aircraft)]
        states = [state if bank_deg is None else state._replace(bank_deg=bank_deg)] * len(circles)
        turning = [state if bank_deg is None else state._replace(bank_deg=self._circle_bank_deg(c)) for c in beside]
        margin_m = checked_margin_m(self.orbit, self._request.margin_m)
        return fall_back(fence, margin_m, [*circles, *beside], [*states, *turning], own)

    def _own_guidance(self, kept_s: float) -> OwnGuidance:
        """The vehicle as it would fly by itself: as the law has identified it, once that flies it."""
        p, guidance = self._setup, guidance_of(self._contact.parameters.known)
        if not self._steered:
            return OwnGuidance(p.aircraft, p.wind, guidance, kept_s)
        estimates = self._law.estimates
        aircraft = replace(p.aircraft, airspeed_m_s=estimates.airspeed_m_s)
        wind = wind_from_velocity(estimates.wind_east_m_s, estimates.wind_north_m_s)
        return OwnGuidance(aircraft, wind, guidance, kept_s, estimates.turn_ratio)

    def _circle_bank_deg(self, circle: Orbit) -> float:
        """The bank, degrees, that holds a circle in still air."""
        V = self._setup.aircraft.airspeed_m_s
        return sign_of(circle.turn) * bank_at_rate(V / circle.radius_m, V)

    def _take_circle(self, circle: Orbit) -> None:
        """Take a circle for that to which the vehicle is commanded back, and say so where it is another one."""
        former, self._circle = self._circle, circle
        if circle != self.orbit:
            self._notices.append(
                f"Its own way to the circle leads through the fence: the fall-back circle is one {self._beside}."
            )
        elif former != circle:
            self._notices.append("Its own way to the circle is clear of the fence: that is the fall-back circle now.")

    @property
    def _beside(self) -> str:
        """Where a fall-back circle is that is not the circle itself, in words."""
        off_m = hypot(self._circle.east_m - self.orbit.east_m, self._circle.north_m - self.orbit.north_m)
        return f"of {self._circle.radius_m:.0f} m, {off_m:.0f} m from the centre of the circle"

    def _update_fall_back(self, now: float) -> None:
        """Command ArduPlane another fall-back circle where its own way to the present one is not clear of the fence.

        It flies there if the link dies, with the last bank for 3 s. PX4 forgets its circle when it enters OFFBOARD.
        """
        contact, pending = self._contact, self._new_fall_back
        if contact.fence is None or contact.flies_px4 or self._stage == Stage.HANDING_OVER:
            return
        if pending is not None and not pending.final:
            pending.send(contact.link, now)
        elif pending is not None:
            self._circle = self._circle if pending.accepted else self._former_circle
            self._new_fall_back, self._accepted_at = None, now
        elif now >= self._next_fall_back:
            self._next_fall_back = now + FALL_BACK_S
            circles = [self.orbit] if self._circle == self.orbit else [self.orbit, self._circle]
            chosen = self._clear_fall_back(circles, KEPT_S)
            if chosen.is_clear and chosen.circle != self._circle:
                self._former_circle = self._circle
                self._take_circle(chosen.circle)
                self._new_fall_back = contact.pending = self._hold_command()
                self._accepted_at = inf

    def _enter_offboard(self) -> Generator[GuideReport, None, None]:
        """Change PX4's mode to offboard, once a heartbeat has shown the hold: the pilot may have taken over.

        A heartbeat that does not come soon is not waited for.
        """
        until = monotonic() + NEXT_HEARTBEAT_S
        while not self._modes.confirmed and monotonic() < until:
            self._send_level()
            self._contact.request_heartbeat(monotonic())
            self._check(self._contact.listen())
        change = mode_command(self._contact.link, OFFBOARD)
        pending = self._contact.pending = PendingCommand(change, "change to the offboard mode", MODE_REPEAT_S)
        self._modes.expect(OFFBOARD)
        yield from self._await(pending)

    def _await(self, pending: PendingCommand) -> Generator[GuideReport, None, None]:
        """Send a command until it is accepted; raises `LinkFailed` if it is refused, or not answered in time.

        PX4 gets setpoints for straight flight meanwhile.
        """
        deadline = monotonic() + CONFIRM_S
        while not pending.accepted:
            if pending.final or monotonic() > deadline:
                raise LinkFailed(pending.failure(self._contact.link.vehicle, CONFIRM_S) + self._why_refused(pending))
            pending.send(self._contact.link, monotonic())
            if self._contact.flies_px4:
                self._send_level()
            now = self._contact.listen()
            self._check(now)
            if now >= self._next_report:
                self._state = self._measure()
                yield self._take_report(now)

    def _why_refused(self, pending: PendingCommand) -> str:
        """What a refused command may mean: the fence, and the texts of the vehicle."""
        if not pending.refusal:
            return ""
        fence = OUTSIDE_FENCE if self._setup.settings.fence == "on" and not self._accepted else ""
        return fence + self._texts

    def _steer(self) -> Generator[GuideReport, None, None]:
        """Fly the law until the circle is held steadily, or without end with `keep`."""
        self._modes.accepted(monotonic())
        self._contact.pending = None
        self._stage, self._steered = Stage.JOINING, True
        self._law, self._holdability = self._new_law(), self._new_holdability()
        self._entry = None  # another law would begin elsewhere
        began = monotonic()
        limit_s, self._last_step = inf, began - STEP_S
        while not (self._steady.settled and not self._request.keep):
            self._step()
            if limit_s == inf and not self._request.keep and isfinite(self._report.time_to_join_s):
                limit_s = 2.0 * self._report.time_to_join_s + HAND_OVER_S
            if monotonic() > began + limit_s:
                raise GuidingStopped(StopReason(f"the circle was not held steadily within {limit_s:.0f} s"))
            if monotonic() >= self._next_report:
                yield self._take_report(monotonic())
            self._check(self._contact.listen())

    def _hand_over(self) -> GuideReport:
        """Hand the vehicle over to its own hold; returns the last report."""
        self._stage, self._circle = Stage.HANDING_OVER, self.orbit
        if not self._command_hold(measured=True):
            raise GuidingStopped(
                StopReason("the vehicle did not confirm the circle on which it is handed over", ours=False)
            )
        self._stage = Stage.HANDED_OVER
        turn = self.orbit.turn.described
        self._notices.append(f"Handed over: {self._contact.name} holds the circle {turn} by its own guidance.")
        if remark := self._sent.remark(self.orbit):
            self._notices.append(remark)
        return self._take_report(monotonic())

    # A lost link, and the end.

    def vehicle_returns(self, timeout_s: float) -> bool:
        """Wait until a lost vehicle is heard again; returns whether it may be guided on. Nothing is commanded.

        It must be ArduPlane that was steered, still in GUIDED, and report the circle as its target if it reports one.
        """
        if not self._steered or self._contact.flies_px4:
            return False
        lost_at = monotonic()
        deadline, telemetry, target = lost_at + timeout_s, self._contact.telemetry, self._contact.own_target
        while telemetry.arrived("HEARTBEAT") < lost_at and monotonic() < deadline:
            self._contact.listen()
        # The radius of the circle shows in some reports only.
        deadline = monotonic() + OBSERVE_S
        while telemetry.arrived("HEARTBEAT") >= lost_at and monotonic() < deadline:
            self._contact.listen()
        elsewhere = target.arrived > lost_at and self._elsewhere
        return telemetry.arrived("HEARTBEAT") >= lost_at and self._modes.mode == GUIDED and not elsewhere

    def request_again(self) -> GuideRequest:
        """The request with which guiding begins anew: the same altitude and direction, without a question."""
        altitude_m = self._setup.altitude_m
        return self._request._replace(orbit=self.orbit, altitude_m=altitude_m, confirm=None, assign=None)

    def stop(self, stop: StopReason) -> str:
        """Stop guiding: command the fall-back circle where that is allowed; returns the sentence that says why."""
        if not self._commanded:
            more = " more" if self.resumed else ""
            return stop.reason if self._request.dry_run else f"{stop.reason}; nothing{more} was commanded"
        self._new_fall_back, self._next_fall_back = None, inf
        if stop.ours:
            try:
                self._check_still_ours(stop)
                if self._contact.fence is not None and stop.measured:
                    kept_s = KEPT_S if self._steered and not self._contact.flies_px4 else 0.0
                    self._circle = self._clear_fall_back([self.orbit], kept_s, 0.0).circle
                if self._command_hold(measured=stop.measured):
                    return f"{stop.reason}: {self._end}, and {self._contact.name} {self._flies_fall_back}"
            except (LoiterError, GuidingStopped) as failure:
                stop = StopReason(f"{stop.reason}, and then {failure}", ours=False)
        return f"{stop.reason}: {self._end}, nothing more is sent, and {self._consequence()}{self._texts}"

    @property
    def _end(self) -> str:
        """That guiding has ended, or that it never began."""
        return "guiding has stopped" if self._steered or self.resumed else "guiding has not begun"

    def _check_still_ours(self, stop: StopReason) -> None:
        """Steer on until a heartbeat has shown the present mode, or none comes; raises `GuidingStopped` for another's.

        The reason to stop may have reached us before the change of mode that it has caused.
        """
        contact, began, levelled = self._contact, monotonic(), False
        seen_from = began + (OWN_ACTION_S if stop.acts else 0.0)
        now = began
        while contact.telemetry.arrived("HEARTBEAT") <= seen_from and now < seen_from + FRESH_MODE_S:
            contact.request_heartbeat(now)
            levelled = self._keep_steering(measured=stop.measured, levelled=levelled)
            now = contact.listen()
            if (other := self._reason(now)) and not other.ours:
                raise GuidingStopped(other)

    def _hear_mode(self) -> bool:
        """Listen until a heartbeat shows the present mode, if the link is alive; returns whether one has."""
        contact, began = self._contact, monotonic()
        now = began
        with suppress(LinkFailed):
            while contact.telemetry.arrived("HEARTBEAT") <= began and now < began + OBSERVE_S:
                if self._monitor.silent(now):
                    break
                now = contact.listen()
        return contact.telemetry.arrived("HEARTBEAT") > began

    def _consequence(self) -> str:
        """What the vehicle does when nothing more is sent: what it was observed to do, or is set to do."""
        contact, verb = self._contact, "flies" if self._hear_mode() else "was last seen"
        mode = self._modes.mode
        if self._monitor.is_ended:
            return f"{contact.name} is in {self._modes.name}"
        if mode not in (GUIDED, OFFBOARD, HOLD) or not self._accepted:
            return f"{contact.name} {verb} in {self._modes.name}"
        if contact.link.rivals:
            return f"{contact.name} {verb} in {self._modes.name} as the other program commands it"
        elsewhere = self._observe_elsewhere()
        if elsewhere:
            return f"{contact.name} flies in {self._modes.name} {elsewhere}"
        if contact.link.commanders:
            return f"{contact.name} {verb} in {self._modes.name} as the other station commands it"
        if self._steered and self._modes.mode in (GUIDED, OFFBOARD):
            return loss_consequence(contact)
        if elsewhere is None and self._modes.mode == HOLD and self._steered:
            return f"{contact.name} flies in {self._modes.name} and does not report where"
        return f"{contact.name} {self._flies_fall_back}"

    @property
    def _flies_fall_back(self) -> str:
        """What the vehicle does that has been commanded back, in words."""
        if self._circle == self.orbit:
            return "flies the fall-back circle"
        return f"flies a circle {self._beside}, to which its own way would lead through the fence"

    def _observe_elsewhere(self) -> str | None:
        """Where the vehicle flies by its own guidance, in words; "" on the circle, None if it does not report that.

        Listens for a while, if the link is alive; nothing is commanded. What PX4 reports in OFFBOARD does not count: it
        is the place of our last setpoint.
        """
        contact, now, is_offboard = self._contact, monotonic(), self._modes.mode == OFFBOARD
        deadline, oldest, target = now + OBSERVE_S, now if is_offboard else now - RECENT_S, contact.own_target
        began = now
        with suppress(LinkFailed):
            while (is_offboard or target.arrived < began) and now < deadline and not self._monitor.silent(now):
                now = contact.listen()
                is_offboard = self._modes.mode == OFFBOARD
                if is_offboard:
                    began = oldest = now
        if is_offboard or target.arrived < oldest:
            return None
        return self._elsewhere

    @property
    def _elsewhere(self) -> str:
        """Where the vehicle has reported that it flies by its own guidance, in words; "" on the circle."""
        contact, target = self._contact, self._contact.own_target
        # What PX4 reports beside its place is not the distance from a circle.
        radius = "" if contact.flies_px4 else target.other_radius
        return target.difference(self._circle, self._setup.altitude_m) or radius

    def _command_hold(self, *, measured: bool) -> bool:
        """Command the circle, and keep the vehicle steered until it has confirmed it; returns whether it has.

        With `measured` the law flies on until then; otherwise the wings are levelled.
        """
        contact = self._contact
        pending = contact.pending = self._hold_command()
        self._modes.expect(self._hold_mode)
        deadline, levelled, self._accepted_at = monotonic() + CONFIRM_S, False, inf
        # ArduPlane accepts the command also where it denies the change of mode: only a later heartbeat shows the mode.
        while not (self._modes.confirmed and contact.telemetry.arrived("HEARTBEAT") > self._accepted_at):
            if monotonic() > deadline or (pending.final and not pending.accepted):
                return False
            pending.send(contact.link, monotonic())
            contact.own_target.forget_radius()
            if pending.accepted:
                contact.request_heartbeat(monotonic())
            levelled = self._keep_steering(measured=measured, levelled=levelled)
            now = contact.listen()
            self._accepted_at = min(self._accepted_at, now) if pending.accepted else inf
            if (stop := self._reason(now)) and not stop.ours:
                raise GuidingStopped(stop)
        if measured and self._steered:
            self._send_last()
        return True

    def _send_last(self) -> None:
        """Send ArduPlane the bank that it keeps until it flies the circle by itself.

        It is that of the circle where the vehicle is on it; otherwise the wings are levelled.
        """
        contact, limit_deg = self._contact, self._setup.aircraft.max_bank_deg
        if contact.flies_px4 or contact.steering is None or limit_deg is None:
            return
        if self._circle != self.orbit:
            contact.steering.send(contact.link, self._circle_bank_deg(self._circle), self._state.bank_deg, monotonic())
            return
        on_circle = self._report.phase == Phase.HOLD
        mean, estimates = self._steady.mean, self._measured_estimates(PRESENT_S)
        bank_deg = last_bank_deg(self.orbit, self._state, mean, estimates, limit_deg) if on_circle else 0.0
        contact.steering.send(contact.link, bank_deg, self._state.bank_deg, monotonic())

    def _keep_steering(self, *, measured: bool, levelled: bool) -> bool:
        """Keep the vehicle steered while it changes over; returns whether the wings were levelled.

        ArduPlane gets one setpoint to level its wings: each prolongs the time until it flies the circle.
        """
        if not self._steered:
            return False
        if measured:
            self._step()
        elif self._contact.flies_px4 or not levelled:
            self._send_level()
        return not measured

    # A step.

    def _step(self) -> None:
        """Make a step of the law, and send its command."""
        now, state, steering = monotonic(), self._measure(), self._contact.steering
        dt, self._last_step = max(now - self._last_step, 1e-3), now
        assert steering is not None  # made by `_begin`
        if steering.reversals != self._reversals:
            # What was flown until then was not what the law had commanded: it identifies the vehicle from now on.
            self._reversals, self._law = steering.reversals, self._new_law()
        self._law.command_limit_deg = steering.limit_deg
        command = self._law.step(state, dt)
        assert self._setup.aircraft.max_bank_deg is not None  # the aircraft is made with a bank limit
        bank_deg = command.bank_deg
        if command.phase == Phase.HOLD and not self._contact.flies_px4:
            # ArduPlane flies the bank that it measures, with the bias that the law takes from measured banks.
            bank_deg += self._law.estimates.bank_bias_deg
        bank_deg = clip(bank_deg, self._setup.aircraft.max_bank_deg)
        # From the measurement to the middle of the time for which the setpoint is flown.
        delay_s = self._contact.round_trip.seconds + 0.5 * min(dt, STEP_S)
        steering.prepare(delay_s, self._contact.reported_wind())
        sent_deg = steering.send(self._contact.link, bank_deg, state.bank_deg, now)
        if self._stage != Stage.HANDING_OVER:
            self._stage = Stage.HOLDING if command.phase == Phase.HOLD else Stage.JOINING
        self._monitor.command_deg, self._monitor.bank_deg = sent_deg, state.bank_deg
        self._check_wind(now)
        self._note_radius()
        self._update_fall_back(now)
        self._contact.request_in_flight(now)
        self._record_step(state, command._replace(bank_deg=sent_deg), now)

    def _record_step(self, state: State, command: Command, now: float) -> None:
        """Make and record the report of a step."""
        m, offset, telemetry = self._contact.measurements, self._steady.update(state), self._contact.telemetry
        self._report = GuideReport(
            time_s=now - self._began,
            stage=self._stage,
            state=state,
            altitude_m=telemetry.fix().altitude_m,
            height_m=telemetry.height_m,
            airspeed_source=m.airspeed(self._contact.reported_wind(), now)[1],
            phase=command.phase,
            time_to_join_s=command.time_to_join_s,
            turn=self.orbit.turn,
            command_deg=command.bank_deg,
            crosstrack_m=self._law.crosstrack_m,
            outside_m=offset.outside_m,
            rate_hz=m.rate_hz(now),
            age_s=now - m.arrived,
            estimates=self._law.estimates,
            slot_ahead_deg=self._law.behind_deg if isinstance(self._law, SlotEntry) else nan,
        )
        self.record(self._report)

    def _check_wind(self, now: float) -> None:
        """Note whether the circle can be held in the wind, at the airspeed and with the turn ratio of the law."""
        if now >= self._next_wind:
            self._next_wind = now + WIND_S
            warned = self._holdability.warning
            self._monitor.wind_problem = self._holdability.problem(self._law.estimates, now)
            if self._holdability.warning and not warned:
                self._notices.append(self._holdability.warning)

    def _note_radius(self) -> None:
        """Note that a ground station has set another radius of circles, which does not change the one that is flown."""
        known = self._contact.parameters.known
        if change := change_of([LOITER_RADIUS], self._built_for, known):
            self._built_for[LOITER_RADIUS] = change.now
            self._notices.append(f"{change.sentence}: the circle of {self.orbit.radius_m:g} m is flown all the same.")

    def _measure(self) -> State:
        """The last measured state; the one before where the last messages give none."""
        self._state = self._contact.state() or self._state
        return self._state

    def _check(self, now: float) -> None:
        if stop := self._reason(now):
            raise GuidingStopped(stop)

    def _reason(self, now: float) -> StopReason | None:
        """The reason to stop, or None."""
        return (
            self._monitor.check(now)
            or self._other_commander()
            or self._beyond_fence()
            or self._blocked()
            or self._other_law()
        )

    def _other_law(self) -> StopReason | None:
        """That a parameter for which the law was built has another value now."""
        if not self._commanded:
            return None
        contact, limit_deg = self._contact, self._setup.aircraft.max_bank_deg
        assert limit_deg is not None  # the aircraft is made with a bank limit
        change = law_change(contact.autopilot, self._built_for, contact.parameters.known, limit_deg)
        return StopReason(change.sentence) if change else None

    def _blocked(self) -> StopReason | None:
        """That no entry is found that stays clear of the fence."""
        problem = self._law.problem if self._steered and isinstance(self._law, FencedEntry) else ""
        return StopReason(clause(problem)) if problem else None

    def _beyond_fence(self) -> StopReason | None:
        """That the vehicle is on the wrong side of a zone of the fence against which its plan was checked."""
        fence, state = self._contact.fence, self._contact.state()
        zone = None if fence is None or state is None else fence.violated(state.east_m, state.north_m)
        if zone is None:
            return None
        # The autopilot may know the zone too, and act.
        acts = self._setup.settings.fence == "on"
        return StopReason(
            f"the vehicle has {'left' if zone.inclusion else 'entered'} the zone {zone.name!r}", acts=acts
        )

    def _other_commander(self) -> StopReason | None:
        """That another station or program commands the vehicle as well."""
        contact, target = self._contact, self._contact.own_target
        if contact.link.rivals:
            return StopReason("another program guides the vehicle too", ours=False)
        if self._commanded and contact.link.commanders:
            return StopReason("another station has commanded the vehicle to hold another circle", ours=False)
        if contact.flies_px4 or self._modes.mode != GUIDED:
            return None
        if target.arrived < self._accepted_at + TARGET_CHANGE_S:
            target.forget_radius()
            return None
        elsewhere = self._elsewhere
        return StopReason(f"another station has sent the vehicle {elsewhere}", ours=False) if elsewhere else None

    def _take_report(self, now: float) -> GuideReport:
        """The present report with the notices; the next one is due a period later."""
        self._next_report = max(self._next_report + self._period_s, now)
        notices, self._notices = tuple(self._notices), []
        telemetry = self._contact.telemetry
        return self._report._replace(
            time_s=now - self._began,
            stage=self._stage,
            state=self._state,
            altitude_m=telemetry.fix().altitude_m,
            height_m=telemetry.height_m,
            notices=notices,
        )

    def _plan_report(self, now: float) -> None:
        """Make the next report due at the next whole period."""
        self._next_report = self._began + (int((now - self._began) / self._period_s) + 1) * self._period_s

    def _send_level(self) -> None:
        steering = self._contact.steering
        if steering is not None and steering.is_ready(monotonic()):
            steering.send_level(self._contact.link, monotonic())

    # The circle.

    @property
    def _texts(self) -> str:
        return self._contact.texts.quoted

    @property
    def _hold_mode(self) -> int:
        return HOLD_MODES[self._contact.autopilot]

    def _measured_estimates(self, time_s: float) -> VehicleEstimates:
        """The estimates of the law, with what is measured on the circle if it was held.

        That is the ratio of turn rates over a time, and the present airspeed: that of the law is an average over the
        flight, in which a slow start lasts.
        """
        estimates, ratio = self._law.estimates, self._steady.turn_ratio(time_s)
        if ratio is None:
            return estimates
        return estimates._replace(turn_ratio=bounded_turn_ratio(ratio), airspeed_m_s=self._steady.airspeed_m_s)

    def _hold_command(self) -> PendingCommand:
        """The command to hold the circle, with the circle that the vehicle flies as the orbit."""
        altitude_m = self._setup.altitude_m
        estimates = self._measured_estimates(LASTING_S) if self._steered else None
        circle = self._sent = sent_circle(self._circle, altitude_m, self._contact.parameters.known, estimates)
        latitude_deg, longitude_deg = self._request.frame.to_geodetic(circle.east_m, circle.north_m)
        place = float(latitude_deg), float(longitude_deg), altitude_m
        message = hold_command(self._contact.link.vehicle, place, circle.radius_m, self._circle.turn)
        return PendingCommand(message, "hold the circle", REPEAT_S)
