"""The telemetry streams that guiding needs, requested as fast as the vehicle grants them.

The streams are requested by SET_MESSAGE_INTERVAL (https://mavlink.io/en/messages/common.html). ArduPlane denies
intervals below 0.8 times that of its main loop, so one stream is requested first, at lower and lower rates, until it is
accepted; the others follow at that rate.
"""

from __future__ import annotations

from typing import Any, NamedTuple

from loiter.io.missions.items import Autopilot
from loiter.mavlink.connection.command import long_command
from loiter.mavlink.connection.enumerations import ACCEPTED, IN_PROGRESS
from loiter.mavlink.connection.link import Link, dialect
from loiter.mavlink.connection.streams import SET_MESSAGE_INTERVAL

# Rates that are tried in turn, messages per second.
RATES_HZ = (50.0, 40.0, 25.0, 10.0, 5.0)

# The rate of streams about the state of the vehicle, messages per second, and of the wind; heartbeats show the mode,
# and a pilot who changes it must be noticed sooner than in the usual second.
STATE_HZ, WIND_HZ, HEARTBEAT_HZ = 2.0, 5.0, 5.0

# Seconds until a request without an answer is repeated, and how often it is sent.
REPEAT_S, TRIES = 0.4, 3

# Seconds between checks whether the streams arrive, how often they are requested again, and the share of the rate that
# must arrive.
CHECK_S, CHECKS, LEAST_SHARE = 2.0, 3, 0.6

# MAV_RESULT_UNSUPPORTED: such a vehicle may understand REQUEST_DATA_STREAM.
UNSUPPORTED = 3

# Bytes of the fast messages together, and the share of a serial line that they may take.
FAST_BYTES, SERIAL_SHARE, BITS_PER_BYTE = 150, 0.7, 10


class GuideStream(NamedTuple):
    """A stream: the number of its message, its MAV_DATA_STREAM, and its rate; 0 means the rate that is granted."""

    number: int
    data_stream: int
    rate_hz: float = 0.0


ATTITUDE = GuideStream(30, 10)
FAST = {
    Autopilot.ARDUPILOT: [ATTITUDE, GuideStream(33, 6), GuideStream(74, 11)],
    Autopilot.PX4: [ATTITUDE, GuideStream(33, 6), GuideStream(32, 6), GuideStream(74, 11)],
}
# HEARTBEAT, EXTENDED_SYS_STATE, the wind, the estimator's state, the target of the own guidance, the sticks and, for
# ArduPlane, the fence.
SLOW = {
    Autopilot.ARDUPILOT: [
        GuideStream(0, 0, HEARTBEAT_HZ),
        GuideStream(245, 2, STATE_HZ),
        GuideStream(168, 12, WIND_HZ),
        GuideStream(193, 12, STATE_HZ),
        GuideStream(87, 2, STATE_HZ),
        GuideStream(65, 3, HEARTBEAT_HZ),
        GuideStream(162, 2, STATE_HZ),
    ],
    Autopilot.PX4: [
        GuideStream(0, 0, HEARTBEAT_HZ),
        GuideStream(245, 2, STATE_HZ),
        GuideStream(231, 12, WIND_HZ),
        GuideStream(230, 12, STATE_HZ),
        GuideStream(87, 2, STATE_HZ),
        GuideStream(65, 3, HEARTBEAT_HZ),
    ],
}


class FastStreams:
    """The requests for streams to an autopilot, not faster than `fastest_hz`.

    `settled` is whether the rate is agreed; `rate_hz` is the rate granted, 0 where all were refused.
    """

    def __init__(self, autopilot: Autopilot, fastest_hz: float = RATES_HZ[0]) -> None:
        self._autopilot = autopilot
        self._rates = [rate for rate in RATES_HZ if rate <= fastest_hz] or [RATES_HZ[-1]]
        self._next, self._tries, self._checks = -1.0, 0, 0
        self._old = False
        self.settled = False

    @property
    def rate_hz(self) -> float:
        """The rate of the fast streams, messages per second."""
        return self._rates[0] if self._rates else 0.0

    def update(self, message: Any) -> None:
        """Process the answer to a request."""
        if message.get_type() != "COMMAND_ACK" or message.command != SET_MESSAGE_INTERVAL or self.settled:
            return
        if message.result == IN_PROGRESS:
            return
        if message.result != ACCEPTED:
            self._old = self._old or message.result == UNSUPPORTED
            self._rates = [] if self._old else self._rates[1:]
            self._tries = 0
        self.settled = message.result == ACCEPTED or not self._rates
        self._next = -1.0

    def request(self, link: Link, now: float, measured_hz: float) -> None:
        """Send the requests that are due; `measured_hz` is the rate at which measurements arrive."""
        if now < self._next:
            return
        if not self.settled and self._tries < TRIES:
            self._next, self._tries = now + REPEAT_S, self._tries + 1
            _request(link, ATTITUDE, self.rate_hz)
            return
        first, self.settled = self._checks == 0, True
        if not first and (self._checks > CHECKS or measured_hz >= LEAST_SHARE * self.rate_hz):
            self._next = now + CHECK_S
            return
        self._next, self._checks = now + CHECK_S, self._checks + 1
        for stream in FAST[self._autopilot] + SLOW[self._autopilot]:
            self._request(link, stream)

    def _request(self, link: Link, stream: GuideStream) -> None:
        if not self._rates:
            if self._old:
                to = link.vehicle.system, link.vehicle.component
                rate_hz = round(stream.rate_hz or RATES_HZ[-2])
                link.send(dialect().MAVLink_request_data_stream_message(*to, stream.data_stream, rate_hz, 1))
            return
        _request(link, stream, stream.rate_hz or self.rate_hz)


def fastest_hz(connection: str, default_baud: int) -> float:
    """The fastest rate that a connection can carry, messages per second: a serial line limits it."""
    if not connection.startswith(("/", "COM")):
        return RATES_HZ[0]
    _, _, baud = connection.partition(",")
    return SERIAL_SHARE * int(baud or default_baud) / (BITS_PER_BYTE * FAST_BYTES)


def _request(link: Link, stream: GuideStream, rate_hz: float) -> None:
    link.send(long_command(link, SET_MESSAGE_INTERVAL, stream.number, round(1e6 / rate_hz)))
