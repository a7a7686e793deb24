"""The mission protocol of MAVLink (https://mavlink.io/en/services/mission.html): reading and sending missions.

The receiver of a mission requests each item, and repeats a request that is not answered. Time-outs are measured from
the last progress.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from time import monotonic
from typing import Any

from loiter.errors import LinkFailed
from loiter.flight.link.enumerations import ACCEPTED, CANCELLED, DENIED, ERROR, INVALID_SEQUENCE, mission_result
from loiter.flight.link.link import MISSION, Link, dialect
from loiter.flight.missions.stored_items import StoredItem, from_message, item_name, to_message

# Seconds until a message is repeated, and until a request for an item, which the vehicle answers faster, is repeated:
# the values of the protocol.
REPEAT_S, ITEM_REPEAT_S = 1.5, 0.25

# A vehicle that receives a mission repeats its requests after 0.25 s (PX4) to 3 s (ArduPilot on a slow link). If
# nothing arrives for longer, it has given up, or the request was lost: the transfer starts again, five times at most.
SILENCE_S, ATTEMPTS = 4.0, 5

# How often the last item is sent again to a vehicle that neither accepts the mission nor requests more.
REPEATS = 3

# A repeated request that arrives within this time, seconds, was duplicated on the way, and its item has already been
# sent. No vehicle repeats a request before 0.25 s.
DUPLICATE_S = 0.1

# Seconds to wait for a vehicle that is busy with another transfer: ArduPilot gives one up after 8 s, PX4 after 5 s.
BUSY_S = 10.0
BUSY = {ERROR, DENIED}

# Called with the number of items done and the number of all items.
CountItems = Callable[[int, int], None]


class _Unanswered(LinkFailed):
    """The vehicle neither answers nor refuses."""


def receive(link: Link, timeout_s: float, progress: CountItems = lambda done, total: None) -> list[StoredItem]:
    """The items of the mission or, if the link transfers those, of the fence that a vehicle has.

    Raises `LinkFailed` if it is silent for `timeout_s`, or keeps refusing.
    """
    request = dialect().MAVLink_mission_request_list_message(*_target(link), link.mission_type)
    action = "give its mission" if link.mission_type == MISSION else "give its fence"
    with _cancel_on_error(link):
        for _ in range(1, ATTEMPTS):
            total = _answer(link, request, action, "MISSION_COUNT", REPEAT_S, timeout_s).count
            try:
                return _receive_items(link, total, min(SILENCE_S, timeout_s), progress)
            except _Unanswered:
                # The vehicle has given up, as mavsdk's does when five requests are lost: the transfer starts again.
                continue
        total = _answer(link, request, action, "MISSION_COUNT", REPEAT_S, timeout_s).count
        return _receive_items(link, total, timeout_s, progress)


def _receive_items(link: Link, total: int, timeout_s: float, progress: CountItems) -> list[StoredItem]:
    """The items of a vehicle, requested one after the other; raises `_Unanswered` if one does not arrive."""
    target, mavlink = _target(link), dialect()
    items: list[StoredItem] = []
    for seq in range(total):
        progress(seq, total)
        request = mavlink.MAVLink_mission_request_int_message(*target, seq, link.mission_type)
        action = f"give {item_name(seq, link.vehicle)}"
        items.append(from_message(_answer(link, request, action, "MISSION_ITEM_INT", ITEM_REPEAT_S, timeout_s, seq)))
    progress(total, total)
    link.send(mavlink.MAVLink_mission_ack_message(*target, ACCEPTED, link.mission_type))
    return items


def send(
    link: Link, items: Sequence[StoredItem], timeout_s: float, progress: CountItems = lambda done, total: None
) -> bool:
    """Send all items to a vehicle, as it requests them; returns whether it has acknowledged the mission.

    False means that it has requested all items but not acknowledged them: only reading them back shows whether it has
    them. Raises `LinkFailed` if it refuses, or makes no progress for `timeout_s`.
    """
    with _cancel_on_error(link):
        last_progress = monotonic()
        for _ in range(ATTEMPTS):
            attempt = _SendAttempt(link, items, timeout_s, progress, last_progress)
            if attempt.run():
                return attempt.accepted
            last_progress = attempt.last_progress
        raise LinkFailed(f"{attempt.described}, {ATTEMPTS} times over")


def clear(link: Link, timeout_s: float) -> None:
    """Delete the mission of a vehicle; raises `LinkFailed` if it refuses or does not answer."""
    request = dialect().MAVLink_mission_clear_all_message(*_target(link), 0)
    _answer(link, request, "clear its mission", "MISSION_ACK", REPEAT_S, timeout_s)


def cancel(link: Link) -> None:
    """Tell a vehicle that the transfer is over; if the message is lost, the vehicle's own time-out ends it."""
    with suppress(LinkFailed):
        link.send(dialect().MAVLink_mission_ack_message(*_target(link), CANCELLED, link.mission_type))


class _SendAttempt:
    """One attempt to send items, and how far it has come."""

    def __init__(
        self, link: Link, items: Sequence[StoredItem], timeout_s: float, progress: CountItems, last_progress: float
    ) -> None:
        self.link, self.items, self.timeout_s, self.progress = link, items, timeout_s, progress
        self.last_progress = last_progress
        self.last_requested = -1
        self.last_sent, self.last_sent_time = -1, 0.0  # the item sent last, and when
        self.repeats = 0  # how often the last item was sent without a request
        self.accepted = False
        self.refusal = ""
        self.last_request_time = self.last_message_time = self.started = monotonic()

    def run(self) -> bool:
        """Whether the vehicle has requested all items; False if it has given up before."""
        self._start()
        while True:
            message = self.link.receive({"MISSION_REQUEST_INT", "MISSION_REQUEST", "MISSION_ACK"}, self._deadline())
            now = monotonic()
            if message is None:
                done = self._on_silence(now)
            elif message.get_type() == "MISSION_ACK":
                done = self._on_acknowledgement(message.type)
            else:
                self._on_request(message.seq, now)
                continue
            if done is not None:
                return done

    @property
    def _is_complete(self) -> bool:
        return self.last_requested == len(self.items) - 1

    def _start(self) -> None:
        self.link.send(dialect().MAVLink_mission_count_message(*_target(self.link), len(self.items), 0))
        self.last_message_time = monotonic()

    def _deadline(self) -> float:
        """The time of the next action if nothing is received."""
        patience_s = REPEAT_S if self.last_requested < 0 or self._is_complete else SILENCE_S
        return min(self._end(), max(self.last_request_time, self.last_message_time) + patience_s)

    def _end(self) -> float:
        """The time at which the transfer is given up; later for a vehicle that is busy."""
        busy = self.started + BUSY_S if self.refusal and self.last_requested < 0 else 0.0
        return max(busy, self.last_progress + self.timeout_s)

    def _on_silence(self, now: float) -> bool | None:
        """What `run` returns after a silence; None to go on."""
        if self._is_complete:
            return self._repeat_last_item(now)
        if now >= self._end():
            raise LinkFailed(f"{self.described}: no progress in {self.timeout_s:g} s")
        if self.last_requested < 0:
            self._start()
            return None
        return False

    def _repeat_last_item(self, now: float) -> bool | None:
        """Send the last item again: it or its acknowledgement was lost, and PX4 acknowledges a repeated item again."""
        if self.repeats >= REPEATS or now >= self._end():
            return True
        self.repeats += 1
        self._send_item(self.last_requested, now)
        return None

    def _on_request(self, seq: int, now: float) -> None:
        if seq >= len(self.items):
            last = len(self.items) - 1
            raise LinkFailed(f"{self.link.vehicle.named} asks for item number {seq} of a mission whose last is {last}")
        if seq > self.last_requested:
            self.last_requested, self.last_progress = seq, now
            self.progress(seq, len(self.items))
        self.last_request_time = now
        if self.last_sent != seq or now - self.last_sent_time > DUPLICATE_S:
            self._send_item(seq, now)
        if now >= self._end():
            raise LinkFailed(f"{self.described}: no progress in {self.timeout_s:g} s")

    def _send_item(self, seq: int, now: float) -> None:
        self.link.send(to_message(self.items[seq], seq, self.link.vehicle))
        self.last_sent, self.last_sent_time = seq, now
        self.last_message_time = now

    def _on_acknowledgement(self, result: int) -> bool | None:
        """What `run` returns after an acknowledgement; None to go on."""
        if result == ACCEPTED:
            # An acknowledgement that comes too early belongs to an earlier transfer.
            self.accepted = self._is_complete
            return self.accepted or None
        self.refusal = mission_result(result)
        # ArduPilot sends INVALID_SEQUENCE for a repeated item, and goes on; a busy vehicle gets the request again.
        if result == INVALID_SEQUENCE or (self.last_requested < 0 and result in BUSY):
            return None
        if self._is_complete and self.repeats:
            # ArduPilot refuses a repeated last item after it has accepted all items.
            return True
        raise LinkFailed(f"{self.link.vehicle.named} refused {self._item_name()}: {self.refusal}")

    def _item_name(self) -> str:
        return item_name(self.last_requested, self.link.vehicle) if self.last_requested >= 0 else "the mission"

    @property
    def described(self) -> str:
        """How far the vehicle has come, in words, and its reason for going no further, if it has given one."""
        reason = f", reporting that {self.refusal}" if self.refusal else ""
        if self.last_requested < 0:
            return f"{self.link.vehicle.named} did not ask for the mission{reason}"
        return f"{self.link.vehicle.named} asked for no more than {self._item_name()}{reason}"


def _answer(
    link: Link, request: Any, action: str, kind: str, repeat_s: float, timeout_s: float, seq: int | None = None
) -> Any:
    """The answer of one kind to a request, which is repeated until it arrives; `action` is the request in words.

    A refusal may be a late answer to another request, or come from a busy vehicle: it counts only when the time is up.
    """
    started = monotonic()
    deadline, refusal = started + timeout_s, ""
    while (now := monotonic()) < deadline:
        link.send(request)
        until = min(deadline, now + repeat_s)
        while (message := link.receive({kind, "MISSION_ACK"}, until)) is not None:
            if message.get_type() == "MISSION_ACK" and message.type != ACCEPTED:
                refusal = mission_result(message.type)
                deadline = max(deadline, started + BUSY_S)
            elif message.get_type() == kind and (seq is None or message.seq == seq):
                return message
    if refusal:
        raise LinkFailed(f"{link.vehicle.named} refused to {action}: {refusal}")
    raise _Unanswered(f"{link.vehicle.named} did not answer in {timeout_s:g} s when asked to {action}")


def _target(link: Link) -> tuple[int, int]:
    return link.vehicle.system, link.vehicle.component


@contextmanager
def _cancel_on_error(link: Link) -> Iterator[None]:
    """Cancel a transfer that ends with an error or Ctrl-C, so that the vehicle does not wait for more."""
    try:
        yield
    except BaseException:
        cancel(link)
        raise
