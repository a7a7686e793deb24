"""A guided flight: its stages from the first message to the hand-over, and its end where something goes wrong."""

from __future__ import annotations

from collections.abc import Callable, Generator
from dataclasses import replace
from math import atan2, degrees, hypot, inf, nan
from time import monotonic
from typing import Any, NamedTuple

from loiter.errors import InvalidArgument, LinkFailed, LoiterError
from loiter.geo import LocalFrame
from loiter.guidance.laws.loiter_entry import LoiterEntry
from loiter.guidance.protocol import Command, Phase, State
from loiter.guidance.vehicle.limits import clip
from loiter.io.missions.items import Autopilot
from loiter.mavlink.connection.command import hold_command, long_command
from loiter.mavlink.connection.fast_streams import FastStreams, fastest_hz
from loiter.mavlink.connection.link import BAUD, Link, not_found
from loiter.mavlink.connection.parameters import Parameters
from loiter.mavlink.connection.pending_command import PendingCommand
from loiter.mavlink.connection.round_trip import RoundTrip
from loiter.mavlink.connection.status_text import StatusTexts
from loiter.mavlink.guiding.acceleration_sign import AccelerationSign, sign_of_version
from loiter.mavlink.guiding.autopilot_settings import (
    NAMES,
    AutopilotSettings,
    autopilot_settings,
    is_complete,
    missing,
)
from loiter.mavlink.guiding.measurements import AirspeedSource, Measurements
from loiter.mavlink.guiding.modes import GUIDED, HOLD, OFFBOARD, PX4_OFFBOARD
from loiter.mavlink.guiding.monitor import LEAST_HZ, Monitor, Stop
from loiter.mavlink.guiding.readiness import refusal
from loiter.mavlink.guiding.report import GuideReport, Stage
from loiter.mavlink.guiding.settling import SteadyHold
from loiter.mavlink.guiding.steering import AccelerationSteering, RollSteering, Steering
from loiter.mavlink.missions.flown_radius import eas2tas_squared, loiter_scaling
from loiter.mavlink.missions.start import CUSTOM_MODE, DO_SET_MODE, REQUEST_MESSAGE
from loiter.mavlink.watching.telemetry import EXTENDED_SYS_STATE, Telemetry, WindSource
from loiter.planning.feasibility import check_held, relative_wind
from loiter.planning.model import Aircraft, Orbit, Turn, Wind
from loiter.planning.solve import plan

# The longest time between two setpoints, seconds, and the time to wait for the second message of a state.
STEP_S, PARTNER_S = 0.05, 0.006

# Seconds to listen for a second vehicle: heartbeats come once a second.
OTHERS_S = 1.1

# Seconds until requests for messages are repeated, and for everything that is needed to arrive.
REQUEST_S, PREPARE_S = 0.5, 8.0

# Seconds for a command to be confirmed: the fall-back circle, PX4's offboard mode, the hand-over.
CONFIRM_S, OFFBOARD_S = 4.0, 4.0

# The first guess of the age of measurements without that of the link, seconds, before the law has identified it.
DELAY_S = 0.1

# The share by which the measured airspeed may differ from the declared one before the plan uses the measured one.
AIRSPEED_SHARE = 0.15

# Seconds between checks of the wind, and steps of a law that is thrown away: they load and compile what it needs.
WIND_S, WARM_STEPS = 1.0, 3

# Seconds between requests for a heartbeat while a change of mode is awaited.
HEARTBEAT_S = 0.3

# Numbers of messages that are requested once.
HEARTBEAT, AUTOPILOT_VERSION = 0, 148


class FlightPlan(NamedTuple):
    """What is wanted: the circle and its frame, the aircraft and the wind as far as they are given, and the options."""

    orbit: Orbit
    frame: LocalFrame
    airspeed_m_s: float | None
    max_bank_deg: float | None
    wind: Wind | None
    altitude_m: float | None
    keep: bool
    dry_run: bool


class Stopped(Exception):
    """Guiding must stop, for the reason in `stop`."""

    def __init__(self, stop: Stop) -> None:
        super().__init__(stop.reason)
        self.stop = stop


class Flight:
    """A guided flight over a link; `stages` flies it, `stop` ends it early.

    `orbit` is the circle, with its direction once that is chosen. `record` is called with a report for every step.
    """

    def __init__(self, link: Link, wanted: FlightPlan, connection: str, timeout_s: float, period_s: float) -> None:
        vehicle = link.vehicle
        if vehicle.autopilot not in list(Autopilot):
            raise LinkFailed(f"{vehicle.named} cannot be guided: its autopilot is neither ArduPilot nor PX4")
        self.orbit = wanted.orbit
        self.record: Callable[[GuideReport], None] = lambda report: None
        self._link, self._wanted, self._connection = link, wanted, connection
        self._timeout_s, self._period_s = min(timeout_s, PREPARE_S), period_s
        self._autopilot = Autopilot(vehicle.autopilot)
        self._measurements = Measurements(wanted.frame)
        self._telemetry, self._texts = Telemetry(), StatusTexts()
        self._streams = FastStreams(self._autopilot, fastest_hz(connection, BAUD))
        self._parameters = Parameters(NAMES[self._autopilot], vehicle.autopilot)
        self._monitor = Monitor(vehicle, self._measurements)
        self._settings: AutopilotSettings
        self._aircraft: Aircraft
        self._law: Any = None
        self._steering: Steering | None = None
        self._steady = SteadyHold(self.orbit)
        self._pending: PendingCommand | None = None
        self._round_trip = RoundTrip()
        self._extended: Any = None
        self._version = 0
        self._commanded = self._steered = False
        self._altitude_m = nan
        self._notices: list[str] = []
        self._state: State | None = None
        self._stage = Stage.SHOWING if wanted.dry_run else Stage.FALL_BACK
        self._report = GuideReport(0.0, self._stage)
        self._began = self._last_step = monotonic()
        self._next_report = self._began + period_s
        self._next_request = self._next_wind = -inf
        self._monitor.last_message = self._began
        link.on_message = self._on_message

    # The stages.

    def stages(self, *, only_vehicle: bool) -> Generator[GuideReport, None, None]:
        """Fly all stages; yields reports. `only_vehicle` is whether a second vehicle must be listened for."""
        self._prepare(only_vehicle=only_vehicle)
        self._plan()
        if self._wanted.dry_run:
            yield from self._show()
        yield from self._fall_back()
        if self._autopilot == Autopilot.PX4:
            yield from self._enter_offboard()
        yield from self._steer()
        yield self._hand_over()

    def _prepare(self, *, only_vehicle: bool) -> None:
        """Wait until everything that is needed has arrived; raises `LinkFailed` where it does not."""
        listen_until = self._began + (OTHERS_S if only_vehicle else 0.0)
        while (lacking := self._lacking()) or monotonic() < listen_until:
            now = monotonic()
            if lacking and now - self._began > self._timeout_s:
                raise LinkFailed(f"{self._link.vehicle.named} {lacking}{self._texts.quoted}")
            self._request_all(now)
            self._listen(now + STEP_S)
        if only_vehicle and self._link.others:
            vehicles = {self._link.vehicle, *self._link.others}
            raise LinkFailed(not_found(self._connection, None, vehicles, 0.0))
        if problem := refusal(self._monitor.heartbeat, self._extended):
            raise LinkFailed(f"{self._link.vehicle.named} cannot be guided: {problem}")

    def _request_all(self, now: float) -> None:
        """Send the requests that are due."""
        self._streams.request(self._link, now, self._measurements.rate_hz(now))
        self._parameters.request(self._link, now)
        self._round_trip.request(self._link, now)
        if now < self._next_request:
            return
        self._next_request = now + REQUEST_S
        wanted = [(HEARTBEAT, self._monitor.heartbeat), (EXTENDED_SYS_STATE, self._extended)]
        if self._autopilot == Autopilot.PX4:
            wanted.append((AUTOPILOT_VERSION, self._version or None))
        for number, received in wanted:
            if received is None:
                self._link.send(long_command(self._link, REQUEST_MESSAGE, number))

    def _lacking(self) -> str:
        """What has not arrived yet, in words; empty if nothing is missing."""
        now, m = monotonic(), self._measurements
        if self._monitor.heartbeat is None:
            return "sends no heartbeat"
        if self._extended is None:
            return "does not report whether it is in the air (EXTENDED_SYS_STATE)"
        if unknown := missing(self._autopilot, self._parameters.known):
            return f"does not report {unknown[0]}"
        if not self._parameters.done and not is_complete(self._autopilot, self._parameters.known):
            return "does not report all parameters"
        if m.state(None, now) is None:
            return "sends no position and attitude, or its position is more than 100 km from the circle"
        if m.rate_hz(now) < LEAST_HZ:
            return f"sends {m.rate_hz(now):.1f} measurements a second, and {LEAST_HZ:.0f} are needed"
        if self._autopilot == Autopilot.PX4 and self._telemetry.gap_s("LOCAL_POSITION_NED", now) > 1.0:
            return "sends no local position (LOCAL_POSITION_NED)"
        return "" if self._streams.settled else "does not answer requests for streams"

    def _plan(self) -> None:
        """Choose aircraft, altitude and direction, and make the law; raises errors before anything is commanded."""
        self._settings = autopilot_settings(self._autopilot, self._parameters.known)
        self._altitude_m = self._measurements.altitude_m
        if self._wanted.altitude_m is not None:
            self._altitude_m = self._wanted.altitude_m
        self._aircraft = self._choose_aircraft()
        state = self._measure(monotonic())
        if self.orbit.turn == Turn.EITHER:
            pose = self._wanted.frame.pose(*self._measurements.place, 0.0)
            start = replace(pose, heading_deg=state.heading_deg)
            self.orbit = replace(self.orbit, turn=plan(start, self.orbit, self._aircraft, self._wind()).turn)
        self._steady = SteadyHold(self.orbit)
        self._steering = self._make_steering()
        warm = self._make_law()
        for _ in range(WARM_STEPS):
            warm.step(state, STEP_S)
        self._law = self._make_law()

    def _choose_aircraft(self) -> Aircraft:
        """The aircraft: from the options, otherwise from the parameters of the autopilot."""
        limit_deg = self._settings.bank_limit_deg
        bank_deg = self._wanted.max_bank_deg
        if bank_deg is not None and bank_deg > limit_deg:
            raise InvalidArgument("max_bank_deg", f"is {bank_deg:g}: the autopilot banks {limit_deg:g} degrees at most")
        bank_deg = self._settings.guided_bank_deg if bank_deg is None else bank_deg
        declared = self._settings.airspeed_m_s * eas2tas_squared(self._measurements.altitude_m) ** 0.5
        airspeed = declared if self._wanted.airspeed_m_s is None else self._wanted.airspeed_m_s
        self._measurements.declared_m_s = airspeed
        measured, source = self._measurements.airspeed(self._reported_wind(), monotonic())
        if source != AirspeedSource.MEASURED:
            self._notices.append(f"The vehicle reports no airspeed: the airspeed is the one {_of(source)}.")
        elif self._wanted.airspeed_m_s is None and abs(measured - airspeed) > AIRSPEED_SHARE * airspeed:
            text = f"The vehicle flies at {measured:.1f} m/s, not at its cruise airspeed of {airspeed:.1f} m/s"
            self._notices.append(f"{text}: it is planned for {measured:.1f} m/s.")
            self._measurements.declared_m_s = airspeed = measured
        return Aircraft(airspeed, max_bank_deg=bank_deg)

    def _make_law(self) -> Any:
        delay_s = DELAY_S + self._round_trip.seconds
        return LoiterEntry(self.orbit, self._aircraft, self._wind(), roll=self._settings.roll, delay_s=delay_s)

    def _make_steering(self) -> Steering:
        if self._autopilot == Autopilot.ARDUPILOT:
            return RollSteering(self._link.vehicle)
        sign = AccelerationSign(sign_of_version(self._version), self._settings.roll)
        return AccelerationSteering(self._link.vehicle, self._altitude_m, sign)

    def _show(self) -> Generator[GuideReport, None, None]:
        """Show what would be commanded, until the generator is closed; nothing is commanded."""
        self._notices.append("Dry run: nothing is commanded; streams and parameters are requested, heartbeats sent.")
        while True:
            self._listen(monotonic() + STEP_S)
            now = monotonic()
            self._check(now)
            if now >= self._next_report:
                # Its commands are not flown: each report is that of a law that begins now.
                self._law = self._make_law()
                self._note(self._measure(now), self._law.step(self._measure(now), STEP_S), now)
                yield self._take_report(now)

    def _fall_back(self) -> Generator[GuideReport, None, None]:
        """Command the fall-back circle, and wait until the vehicle has accepted it."""
        self._pending = PendingCommand(self._hold_command())
        self._commanded = True
        self._monitor.modes.expect(self._hold_mode)
        deadline = monotonic() + CONFIRM_S
        while not self._pending.accepted:
            self._refuse_late(self._pending, deadline, "hold the circle")
            self._pending.send(self._link, monotonic())
            if self._autopilot == Autopilot.PX4:
                # PX4 accepts the offboard mode only while setpoints arrive.
                self._send_level()
            yield from self._wait()

    def _enter_offboard(self) -> Generator[GuideReport, None, None]:
        """Change PX4's mode to offboard; setpoints for straight flight go on meanwhile."""
        change = long_command(self._link, DO_SET_MODE, CUSTOM_MODE, PX4_OFFBOARD)
        self._pending = PendingCommand(change, repeat_s=0.25)
        self._monitor.modes.expect(OFFBOARD)
        deadline = monotonic() + OFFBOARD_S
        while not self._pending.accepted:
            self._refuse_late(self._pending, deadline, "change to the offboard mode")
            self._send_level()
            self._pending.send(self._link, monotonic())
            yield from self._wait()

    def _steer(self) -> Generator[GuideReport, None, None]:
        """Fly the law until the circle is held steadily, or without end with `keep`."""
        self._monitor.modes.accepted(monotonic())
        self._pending = None
        self._stage, self._steered = Stage.JOINING, True
        self._law = self._make_law()
        self._last_step = monotonic() - STEP_S
        while not (self._steady.settled and not self._wanted.keep):
            self._step()
            if monotonic() >= self._next_report:
                yield self._take_report(monotonic())
            self._listen(monotonic() + STEP_S)
            self._check(monotonic())

    def _hand_over(self) -> GuideReport:
        """Hand the vehicle over to its own hold; returns the last report."""
        self._stage = Stage.HANDING_OVER
        if not self._command_hold(measured=True):
            raise Stopped(Stop("the vehicle did not confirm the circle that it was handed over to", ours=False))
        self._stage = Stage.HANDED_OVER
        turn = self.orbit.turn.described
        text = f"Handed over: {self._link.vehicle.named} holds the circle {turn} by its own guidance."
        self._notices.append(text)
        return self._take_report(monotonic())

    # The end.

    def stop(self, stop: Stop) -> str:
        """Stop guiding: command the fall-back circle where that is allowed; returns the sentence that says why."""
        name = self._link.vehicle.named
        if not self._commanded:
            return f"{stop.reason}; nothing was commanded"
        if not self._steered and not stop.ours:
            return f"{stop.reason}; nothing more is sent"
        if stop.ours:
            try:
                confirmed = self._command_hold(measured=stop.measured)
            except (LoiterError, Stopped) as failure:
                stop, confirmed = Stop(f"{stop.reason}, then {failure}", ours=False), False
            if confirmed:
                return f"{stop.reason}: guiding has stopped, and {name} has confirmed the fall-back circle"
        return f"{stop.reason}: guiding has stopped, nothing more is sent, {self._consequence}"

    @property
    def _consequence(self) -> str:
        """What the vehicle does by itself when nothing more is sent."""
        modes = self._monitor.modes
        if modes.mode is not None and modes.mode not in (GUIDED, OFFBOARD):
            return f"and the vehicle flies in {modes.name}"
        if self._autopilot == Autopilot.ARDUPILOT:
            return "and ArduPlane keeps its bank for up to 3 s and then flies the fall-back circle"
        return f"and PX4 follows COM_OBL_RC_ACT, {self._settings.loss_action}"

    def _command_hold(self, *, measured: bool) -> bool:
        """Command the circle, and keep the vehicle steered until it has confirmed it; returns whether it has.

        With `measured` the law flies on until then; otherwise the wings are levelled.
        """
        pending = self._pending = PendingCommand(self._hold_command())
        self._monitor.modes.expect(self._hold_mode)
        deadline, levelled = monotonic() + CONFIRM_S, False
        while monotonic() < deadline and not (pending.accepted and self._monitor.modes.confirmed):
            pending.send(self._link, monotonic())
            self._request_heartbeat(pending)
            levelled = self._steer_on(measured=measured, levelled=levelled)
            self._listen(monotonic() + STEP_S)
            self._check_taken_over(monotonic())
            if pending.final and not pending.accepted:
                return False
        return pending.accepted and self._monitor.modes.confirmed

    def _request_heartbeat(self, pending: PendingCommand) -> None:
        """Request a heartbeat, once a command was accepted: it shows the mode sooner than the next regular one."""
        now = monotonic()
        if pending.accepted and now >= self._next_request:
            self._next_request = now + HEARTBEAT_S
            self._link.send(long_command(self._link, REQUEST_MESSAGE, HEARTBEAT))

    def _steer_on(self, *, measured: bool, levelled: bool) -> bool:
        """Keep the vehicle steered while it changes over; returns whether the wings were levelled.

        ArduPlane needs one setpoint to level its wings: each prolongs the time until it flies the circle.
        """
        if not self._steered:
            return True
        if measured:
            self._step()
        elif self._autopilot == Autopilot.PX4 or not levelled:
            self._send_level()
        return not measured

    def _check_taken_over(self, now: float) -> None:
        if (stop := self._monitor.check(now)) and not stop.ours:
            raise Stopped(stop)

    # A step.

    def _step(self) -> None:
        """Make a step of the law, and send its command."""
        assert self._steering is not None  # made by `_plan`
        now = monotonic()
        state, dt = self._measure(now), max(now - self._last_step, 1e-3)
        self._last_step = now
        command = self._law.step(state, dt)
        bank_deg = clip(command.bank_deg, self._aircraft.max_bank_deg or 0.0)
        if isinstance(self._steering, AccelerationSteering):
            self._steering.wind = self._reported_wind()
            # From the measurement to the middle of the time for which the setpoint is flown.
            self._steering.delay_s = self._round_trip.seconds + 0.5 * min(dt, STEP_S)
        sent_deg = self._steering.send(self._link, bank_deg, state.bank_deg, now)
        if self._stage in (Stage.JOINING, Stage.HOLDING):
            self._stage = Stage.HOLDING if command.phase == Phase.HOLD else Stage.JOINING
        self._monitor.command_deg, self._monitor.bank_deg = sent_deg, state.bank_deg
        self._check_wind(now)
        self._round_trip.request(self._link, now)
        self._note(state, command._replace(bank_deg=sent_deg), now)
        self._measurements.take()

    def _note(self, state: State, command: Command, now: float) -> None:
        """Make and record the report of a step."""
        position = self._steady.update(state)
        m = self._measurements
        self._report = GuideReport(
            now - self._began,
            self._stage,
            state,
            m.altitude_m,
            m.airspeed(self._reported_wind(), now)[1],
            command.phase,
            command.time_to_join_s,
            self.orbit.turn,
            command.bank_deg,
            getattr(self._law, "crosstrack_m", nan),
            position.outside_m,
            m.rate_hz(now),
            now - m.arrived,
            getattr(self._law, "estimates", None),
        )
        self.record(self._report)

    def _check_wind(self, now: float) -> None:
        """Note whether the circle can be held in the wind that the law estimates."""
        if now < self._next_wind:
            return
        self._next_wind = now + WIND_S
        e = getattr(self._law, "estimates", None)
        if e is None:
            return
        speed = hypot(e.wind_east_m_s, e.wind_north_m_s)
        from_deg = degrees(atan2(-e.wind_east_m_s, -e.wind_north_m_s))
        try:
            wind = Wind(speed, from_deg)
            check_held(self.orbit, self._aircraft, relative_wind(self.orbit, self._aircraft, wind))
            self._monitor.wind_problem = ""
        except LoiterError as error:
            self._monitor.wind_problem = str(error)

    def _measure(self, now: float) -> State:
        """The last measured state."""
        state = self._measurements.state(self._reported_wind(), now)
        if state is not None:
            self._state = state
        assert self._state is not None  # `_prepare` waits for the first
        return self._state

    def _wait(self) -> Generator[GuideReport, None, None]:
        """Listen for a step, check, and yield a report if that is due."""
        self._listen(monotonic() + STEP_S)
        now = monotonic()
        self._check(now)
        if now >= self._next_report:
            state = self._measure(now)
            yield self._take_report(now, state=state)

    def _listen(self, until: float) -> None:
        """Receive messages until a new state is complete, or until a time."""
        m = self._measurements
        while (now := monotonic()) < until:
            message = self._link.receive({"ATTITUDE", "GLOBAL_POSITION_INT"}, until)
            if message is None or m.complete:
                break
            until = min(until, now + PARTNER_S)
        self._link.process_pending(monotonic() + PARTNER_S)
        m.take()

    def _check(self, now: float) -> None:
        if stop := self._monitor.check(now):
            raise Stopped(stop)

    def _take_report(self, now: float, state: State | None = None) -> GuideReport:
        """The present report with the notices; the next one is due a period later."""
        self._next_report = max(self._next_report + self._period_s, now)
        notices, self._notices = tuple(self._notices), []
        state = self._report.state if state is None else state
        return self._report._replace(time_s=now - self._began, stage=self._stage, state=state, notices=notices)

    def _send_level(self) -> None:
        assert self._steering is not None  # made by `_plan`
        if self._steering.is_ready(monotonic()):
            self._steering.send_level(self._link, monotonic())

    def _on_message(self, message: Any, now: float) -> None:
        """Pass a message of the vehicle to all that need it."""
        self._measurements.update(message, now)
        self._monitor.update(message, now)
        self._telemetry.update(message, now)
        self._streams.update(message)
        self._parameters.update(message)
        self._texts.update(message)
        self._round_trip.update(message, now)
        if self._steering is not None:
            self._steering.update(message, now)
        if self._pending is not None:
            self._pending.update(message)
        kind = message.get_type()
        if kind == "EXTENDED_SYS_STATE":
            self._extended = message
        elif kind == "AUTOPILOT_VERSION":
            self._version = message.flight_sw_version

    # The circle.

    @property
    def _hold_mode(self) -> int:
        return GUIDED if self._autopilot == Autopilot.ARDUPILOT else HOLD

    def _hold_command(self) -> Any:
        """The command to hold the circle, with the radius with which the vehicle flies that of the orbit."""
        radius_m = self.orbit.radius_m
        if self._autopilot == Autopilot.ARDUPILOT:
            scaling = loiter_scaling(self._parameters.known)
            if scaling is None:
                raise LinkFailed(f"{self._link.vehicle.named} does not report which radius it flies (NAVL1_LIM_BANK)")
            radius_m = scaling.sent_whole_m(radius_m, self._altitude_m)
        latitude_deg, longitude_deg = self._wanted.frame.to_geodetic(self.orbit.east_m, self.orbit.north_m)
        place = float(latitude_deg), float(longitude_deg), self._altitude_m
        return hold_command(self._link.vehicle, place, radius_m, self.orbit.turn)

    def _refuse_late(self, pending: PendingCommand, deadline: float, action: str) -> None:
        """Raise `LinkFailed` if a command was refused, or not answered in time."""
        name = self._link.vehicle.named
        if pending.final or (pending.refusal and monotonic() > deadline):
            raise LinkFailed(f"{name} refused to {action}: {pending.refusal}{self._texts.quoted}")
        if monotonic() > deadline:
            raise LinkFailed(f"{name} did not answer the command to {action} in {CONFIRM_S:g} s")

    def _wind(self) -> Wind | None:
        """The first guess of the wind: the one given, or reported by the vehicle; None for still air."""
        return self._wanted.wind or self._reported_wind()

    def _reported_wind(self) -> Wind | None:
        """The wind that the vehicle reports, or None."""
        wind, source = self._telemetry.wind(monotonic())
        return wind if source == WindSource.VEHICLE else None


def _of(source: AirspeedSource) -> str:
    """The source of an airspeed, as the end of a sentence."""
    return "declared" if source == AirspeedSource.DECLARED else "that follows from ground speed and wind"
