"""The contact to a guided vehicle: all that is known from its messages, and the requests for more of them."""

from __future__ import annotations

from math import exp, hypot, inf, nan
from time import monotonic
from typing import Any

from loiter.errors import LinkFailed
from loiter.fences import Fence
from loiter.files.missions.items import Autopilot
from loiter.flight.autopilots.modes import GUIDED, HOLD, OFFBOARD
from loiter.flight.autopilots.settings import parameter_names
from loiter.flight.autopilots.steering import Steering
from loiter.flight.autopilots.sticks import Sticks
from loiter.flight.guiding.measurements import AIRSPEED_LAG_S, LEAST_SHARE, AirspeedSource, Measurements
from loiter.flight.guiding.monitor import Monitor
from loiter.flight.guiding.own_target import OwnTarget
from loiter.flight.link.command import PendingCommand, message_request
from loiter.flight.link.link import BAUD, Link
from loiter.flight.link.parameters import Parameters
from loiter.flight.link.round_trip import RoundTrip
from loiter.flight.link.status_text import StatusTexts
from loiter.flight.link.streams import Streams, guide_streams, rates_to_try_hz
from loiter.flight.link.telemetry import Telemetry, WindSource
from loiter.geo import LocalFrame
from loiter.guidance.protocol import State
from loiter.planning.compass import heading_vector
from loiter.planning.model import Wind, wind_from_velocity

# The longest time between two setpoints, seconds, and the time to wait for the second message of a state.
STEP_S, PARTNER_S = 0.05, 0.006

# Seconds until a request for a message is repeated.
REQUEST_S = 0.5

# The velocity of the air is averaged over this time, seconds. The reported wind counts unless it differs from that by
# more than this share of the airspeed.
AIR_S, WIND_DIFFERS = 1.0, 0.2


class Contact:
    """A link to a vehicle with ArduPilot or PX4, and what its messages say.

    `pending`, once it is set, gets every message too. `fence` is that against which plans are checked, if any.
    """

    def __init__(self, link: Link, connection: str, frame: LocalFrame) -> None:
        vehicle = link.vehicle
        if vehicle.autopilot not in list(Autopilot):
            raise LinkFailed(f"{vehicle.named} cannot be guided: its autopilot is neither ArduPilot nor PX4")
        self.link = link
        self.autopilot = Autopilot(vehicle.autopilot)
        self.began = monotonic()
        self.telemetry, self.texts = Telemetry(self.began), StatusTexts()
        lag_s = AIRSPEED_LAG_S if self.autopilot == Autopilot.ARDUPILOT else 0.0
        self.measurements = Measurements(self.telemetry, frame, lag_s)
        self.monitor = Monitor(vehicle, self.telemetry, self.measurements)
        self.own_target, self.sticks = OwnTarget(frame), Sticks()
        self.streams = Streams(guide_streams(self.autopilot), self.began, rates_to_try_hz(connection, BAUD))
        self.parameters = Parameters(parameter_names(self.autopilot), vehicle.autopilot)
        self.round_trip = RoundTrip()
        self.steering: Steering | None = None
        self.pending: PendingCommand | None = None
        self.fence: Fence | None = None
        self._next_request = -inf
        # The mean velocity of the air, east and north, from ground speed, heading and airspeed, the mean airspeed, and
        # the time of the last state in them.
        self._air, self._air_s = (nan, nan, nan), -inf
        link.on_message = self._on_message
        link.become_guide()

    @property
    def name(self) -> str:
        """The vehicle in sentences."""
        return self.link.vehicle.named

    @property
    def flies_px4(self) -> bool:
        """Whether the autopilot is PX4; otherwise it is ArduPilot."""
        return self.autopilot == Autopilot.PX4

    @property
    def is_commanded(self) -> bool:
        """Whether the vehicle is already in a mode in which guiding would leave it, and has kept what it was told."""
        return self.monitor.modes.mode in ((HOLD, OFFBOARD) if self.flies_px4 else (GUIDED,))

    @property
    def home_altitude_m(self) -> float:
        """The altitude of home above mean sea level, metres; nan if it is not known."""
        return self.telemetry.fix().altitude_m - self.telemetry.height_m

    @property
    def version(self) -> int:
        """The flight_sw_version of AUTOPILOT_VERSION, 0 before it is known."""
        message = self.telemetry.last("AUTOPILOT_VERSION")
        return 0 if message is None else int(message.flight_sw_version)

    def listen(self) -> float:
        """Receive messages until a new state is complete, or for `STEP_S`; returns the time."""
        m, until = self.measurements, monotonic() + STEP_S
        m.take()
        while monotonic() < until:
            message = self.link.receive({"ATTITUDE", "GLOBAL_POSITION_INT"}, until)
            if message is None or m.complete:
                break
            until = min(until, monotonic() + PARTNER_S)
        self.link.process_pending(monotonic() + PARTNER_S)
        self._average_air()
        return monotonic()

    def _average_air(self) -> None:
        """Update the mean velocity of the air, if a new state with a measured airspeed has arrived."""
        state = self.state()
        if state is None or state.time_s <= self._air_s:
            return
        if self.measurements.airspeed(None, monotonic())[1] != AirspeedSource.MEASURED:
            return
        (c, s), V = heading_vector(state.heading_deg), state.airspeed_m_s
        measured = state.velocity_east_m_s - V * c, state.velocity_north_m_s - V * s, V
        before = measured if self._air_s == -inf else self._air
        share = 1.0 - exp((self._air_s - state.time_s) / AIR_S)
        east, north, airspeed = (old + share * (new - old) for old, new in zip(before, measured, strict=True))
        self._air = east, north, airspeed
        self._air_s = state.time_s

    def request_all(self, now: float) -> None:
        """Send the requests that are due before the flight begins."""
        self.streams.request(self.link, self.telemetry, now)
        self.parameters.request(self.link, now)
        self.round_trip.request(self.link, now)
        if now < self._next_request:
            return
        self._next_request = now + REQUEST_S
        for kind in ("HEARTBEAT", "EXTENDED_SYS_STATE", *(["AUTOPILOT_VERSION"] if self.flies_px4 else [])):
            if self.telemetry.last(kind) is None:
                self.link.send(message_request(self.link, kind))

    def request_in_flight(self, now: float) -> None:
        """Send the requests that are due in flight: for streams that have become slow, and for the round trip time."""
        self.streams.request(self.link, self.telemetry, now)
        self.parameters.request_again(self.link, now)
        self.round_trip.request(self.link, now)
        self.monitor.unanswered_s = self.round_trip.unanswered_s()

    def request_heartbeat(self, now: float) -> None:
        """Request a heartbeat if that is due: it shows a change of mode sooner than the next regular one."""
        if now >= self._next_request:
            self._next_request = now + REQUEST_S
            self.link.send(message_request(self.link, "HEARTBEAT"))

    def reported_wind(self) -> Wind | None:
        """The wind that the vehicle reports, or None."""
        wind, source = self.telemetry.wind(monotonic())
        return wind if source == WindSource.VEHICLE else None

    def likely_wind(self, airspeed_m_s: float) -> Wind | None:
        """The wind that the vehicle reports, or the measured velocity of the air where that differs; None if unknown.

        A reported wind is the estimate of a filter that may need a minute after a change.
        """
        reported, (east, north, measured_m_s) = self.reported_wind(), self._air
        if not measured_m_s > LEAST_SHARE * airspeed_m_s:
            return reported
        reported_east, reported_north = (0.0, 0.0) if reported is None else reported.velocity_m_s
        if hypot(east - reported_east, north - reported_north) <= WIND_DIFFERS * airspeed_m_s:
            return reported
        return wind_from_velocity(east, north)

    def state(self) -> State | None:
        """The last measured state, or None."""
        return self.measurements.state(self.reported_wind(), monotonic())

    def _on_message(self, message: Any, now: float) -> None:
        """Pass a message of the vehicle to all that need it."""
        self.telemetry.update(message, now)
        self.measurements.update(message, now)
        self.streams.update(message, now)
        self.parameters.update(message)
        self.texts.update(message)
        self.round_trip.update(message, now)
        self.own_target.update(message, now)
        self.sticks.update(message, self.parameters.known)
        self.monitor.stick_moved = self.sticks.moved
        if self.pending is not None:
            self.pending.update(message)
        if message.get_type() == "HEARTBEAT":
            self.monitor.modes.update(message)
