"""Telemetry streams, requested if they are too slow, or as fast as the vehicle grants them.

Requests are SET_MESSAGE_INTERVAL (https://mavlink.io/en/messages/common.html), and REQUEST_DATA_STREAM where that does
not help. Streams that are fast enough are not changed: other programs may use the same link.
ArduPlane denies intervals below 0.8 times that of its main loop. An answer does not say which stream it is about.
Therefore one stream is requested first, at lower and lower rates, until it is granted; the others follow at that rate.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from math import inf
from typing import Any, NamedTuple

from loiter.files.missions.items import Autopilot
from loiter.flight.link.command import SET_MESSAGE_INTERVAL, long_command, message_number
from loiter.flight.link.enumerations import ACCEPTED, IN_PROGRESS, UNSUPPORTED
from loiter.flight.link.link import Link, dialect
from loiter.flight.link.telemetry import Telemetry

# Rates that are tried in turn where the fastest is wanted, messages per second, and the one that is requested from a
# vehicle that grants none.
RATES_HZ, UNGRANTED_HZ = (50.0, 40.0, 25.0, 10.0, 5.0), 10.0

# The highest and the lowest rate of positions for a watch, and the rate of its other streams, messages per second.
HIGHEST_HZ, LOWEST_HZ, SLOW_HZ = 10.0, 2.0, 1.0

# The rate of streams about the state of a guided vehicle, messages per second, and of the wind; heartbeats show the
# mode, and a pilot who changes it must be noticed sooner than in the usual second.
STATE_HZ, WIND_HZ, HEARTBEAT_HZ = 2.0, 5.0, 5.0

# A stream is too slow if less than this share of its messages arrives.
LEAST_SHARE = 0.6

# Seconds between requests for a stream, their number, and the number after which REQUEST_DATA_STREAM is sent too.
REPEAT_S, TRIES, OLDER_AFTER = 2.0, 5, 2

# Seconds until an unanswered request for a rate is repeated, and how often it is sent.
RATE_REPEAT_S, RATE_TRIES = 0.4, 3

# Bytes of the fast messages together, and the share of a serial line that they may take.
FAST_BYTES, SERIAL_SHARE, BITS_PER_BYTE = 150, 0.7, 10


class Stream(NamedTuple):
    """A kind of message, its MAV_DATA_STREAM for REQUEST_DATA_STREAM, and the rate that is wanted, messages per second.

    A rate of 0 is the fastest that is granted.
    """

    kind: str
    data_stream: int | None = None
    rate_hz: float = 0.0


ATTITUDE, POSITION, SPEEDS = Stream("ATTITUDE", 10), Stream("GLOBAL_POSITION_INT", 6), Stream("VFR_HUD", 11)
LANDED_STATE = Stream("EXTENDED_SYS_STATE")


def watch_streams(period_s: float) -> list[Stream]:
    """The streams for reports with a period, seconds: two positions in each."""
    position_hz = min(max(2.0 / period_s, LOWEST_HZ), HIGHEST_HZ)
    rates_hz = {POSITION: position_hz, ATTITUDE: position_hz, SPEEDS: SLOW_HZ, LANDED_STATE: SLOW_HZ}
    return [stream._replace(rate_hz=rate_hz) for stream, rate_hz in rates_hz.items()]


def guide_streams(autopilot: Autopilot) -> list[Stream]:
    """The streams for guiding a vehicle."""
    streams = [
        ATTITUDE,
        POSITION,
        SPEEDS,
        Stream("HEARTBEAT", None, HEARTBEAT_HZ),
        LANDED_STATE._replace(rate_hz=STATE_HZ),
        Stream("POSITION_TARGET_GLOBAL_INT", 2, STATE_HZ),
        Stream("RC_CHANNELS", 3, HEARTBEAT_HZ),
    ]
    if autopilot == Autopilot.PX4:
        own = [
            Stream("LOCAL_POSITION_NED", 6),
            Stream("MANUAL_CONTROL", 3, HEARTBEAT_HZ),
            Stream("WIND_COV", 12, WIND_HZ),
            Stream("ESTIMATOR_STATUS", 12, STATE_HZ),
        ]
    else:
        fence, wind = Stream("FENCE_STATUS", 2, STATE_HZ), Stream("WIND", 12, WIND_HZ)
        own = [fence, wind, Stream("EKF_STATUS_REPORT", 12, STATE_HZ), Stream("NAV_CONTROLLER_OUTPUT", 2, STATE_HZ)]
    return streams + own


def rates_to_try_hz(connection: str, default_baud: int) -> list[float]:
    """The rates to try on a connection, messages per second, the fastest first: a serial line limits them."""
    if not connection.startswith(("/", "COM")):
        return list(RATES_HZ)
    _, _, baud = connection.partition(",")
    fastest_hz = SERIAL_SHARE * int(baud or default_baud) / (BITS_PER_BYTE * FAST_BYTES)
    return [rate for rate in RATES_HZ if rate <= fastest_hz] or [RATES_HZ[-1]]


class Streams:
    """The streams that are needed, and the requests for them.

    With `rates_hz` the fastest of these rates that the vehicle grants is agreed first, and then every stream is
    requested at once; without them, those that are too slow. `settled` is whether the rate is agreed.
    """

    def __init__(self, needed: Sequence[Stream], now: float, rates_hz: Sequence[float] = ()) -> None:
        self._needed, self._rates = needed, list(rates_hz)
        self.settled = not self._rates
        # Whether the vehicle has granted a rate, and whether it does not know SET_MESSAGE_INTERVAL.
        self._granted = self._unknown = False
        self.restart(now)
        self._all_at_once = not self.settled

    def restart(self, now: float) -> None:
        """Start again, as after a restart of the vehicle: rates are measured again before anything is requested."""
        self._started, self._next = now, -inf
        self._tries: Counter[str] = Counter()
        self._rate_tries = 0
        self._all_at_once = False

    @property
    def rate_hz(self) -> float:
        """The rate that is requested of the fast streams, messages per second."""
        return self._rates[0] if self._rates else UNGRANTED_HZ

    def update(self, message: Any, now: float) -> None:
        """Process a message, which may be the answer to a request."""
        if message.get_type() != "COMMAND_ACK" or message.command != SET_MESSAGE_INTERVAL:
            return
        self._unknown = self._unknown or message.result == UNSUPPORTED
        if self.settled or message.result == IN_PROGRESS:
            return
        self._granted = message.result == ACCEPTED
        if not self._granted:
            self._rates = [] if self._unknown else self._rates[1:]
            self._rate_tries = 0
        self.settled = self._granted or not self._rates
        self._next = -inf

    def request(self, link: Link, telemetry: Telemetry, now: float) -> None:
        """Send the requests that are due."""
        if now < self._next:
            return
        if not self.settled and self._rate_tries < RATE_TRIES:
            self._next, self._rate_tries = now + RATE_REPEAT_S, self._rate_tries + 1
            link.send(self._interval_request(link, ATTITUDE))
            return
        self.settled = True
        due = self._needed if self._all_at_once else self._too_slow(telemetry, now)
        if due:
            self._next, self._all_at_once = now + REPEAT_S, False
            self._request(link, due)

    def _too_slow(self, telemetry: Telemetry, now: float) -> list[Stream]:
        """The streams that have had the time to arrive, are too slow, and were not requested too often."""
        return [
            stream
            for stream in self._needed
            if (now - self._started) * LEAST_SHARE * self._wanted_hz(stream) > 1.0
            and telemetry.rate_hz(stream.kind, now) < LEAST_SHARE * self._wanted_hz(stream)
            and self._tries[stream.kind] < TRIES
        ]

    def _request(self, link: Link, due: Sequence[Stream]) -> None:
        """Send the requests for streams."""
        older: dict[int, int] = {}
        for stream in due:
            self._tries[stream.kind] += 1
            # Where a rate was granted, and fewer messages arrive, it is the line that is slow.
            unhelped = not self._granted and self._tries[stream.kind] > OLDER_AFTER
            if not self._unknown:
                link.send(self._interval_request(link, stream))
            if (self._unknown or unhelped) and stream.data_stream is not None:
                older[stream.data_stream] = max(older.get(stream.data_stream, 0), round(self._wanted_hz(stream)))
        to = link.vehicle.system, link.vehicle.component
        for data_stream, rate_hz in older.items():
            link.send(dialect().MAVLink_request_data_stream_message(*to, data_stream, rate_hz, 1))

    def _interval_request(self, link: Link, stream: Stream) -> Any:
        interval_us = round(1e6 / self._wanted_hz(stream))
        return long_command(link, SET_MESSAGE_INTERVAL, message_number(stream.kind), interval_us)

    def _wanted_hz(self, stream: Stream) -> float:
        """The rate that is wanted of a stream, messages per second."""
        return stream.rate_hz or self.rate_hz
