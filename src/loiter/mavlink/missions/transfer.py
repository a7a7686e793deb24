"""The mission protocol of MAVLink: a mission read from a vehicle, and one sent to it.

https://mavlink.io/en/services/mission.html. The receiver of a mission asks for each item, so whoever receives says
again what was not answered. Time is measured from the last progress.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from time import monotonic
from typing import Any

from loiter.errors import LinkFailed
from loiter.mavlink.connection.enumerations import ACCEPTED, CANCELLED, DENIED, ERROR, INVALID_SEQUENCE, mission_result
from loiter.mavlink.connection.link import Link, packets
from loiter.mavlink.missions.stored_items import StoredItem, called, packet, unpacked

# Seconds until a message is repeated, and a request for an item, which costs the vehicle less: as the protocol has it.
REPEAT_S, ITEM_REPEAT_S = 1.5, 0.25

# Vehicles that receive say again what they want after 0.25 s (PX4) to 3 s (ArduPilot on a slow line). Where nothing is
# heard for longer one has given up, or lost what it was asked for: the transfer begins anew, five times at the most.
SILENCE_S, ATTEMPTS = 4.0, 5

# How often the last item is sent again to a vehicle that neither accepts the mission nor asks for more.
REPEATS = 3

# An item asked for again so soon has been sent already: the line has doubled the request. No vehicle repeats one sooner
# than after 0.25 s.
DOUBLED_S = 0.1

# Seconds to wait for a vehicle that is busy with another transfer: ArduPilot gives one up after 8 s, PX4 after 5 s.
BUSY_S = 10.0
BUSY = {ERROR, DENIED}

# Called with the number of items done and of all.
Progress = Callable[[int, int], None]


class _Unanswered(LinkFailed):
    """A vehicle does not answer, and does not refuse."""


def receive(link: Link, timeout_s: float, progress: Progress = lambda done, total: None) -> list[StoredItem]:
    """The items that a vehicle holds. Raises `LinkFailed` where it is silent for `timeout_s`, or refuses to the end."""
    wanted = packets().MAVLink_mission_request_list_message(*_to(link), 0)
    with _cancelling(link):
        for _ in range(1, ATTEMPTS):
            total = _answer(link, wanted, "give its mission", "MISSION_COUNT", REPEAT_S, timeout_s).count
            try:
                return _items(link, total, min(SILENCE_S, timeout_s), progress)
            except _Unanswered:
                # It has given up halfway, as mavsdk's vehicle does when five requests are lost: it is asked anew.
                continue
        total = _answer(link, wanted, "give its mission", "MISSION_COUNT", REPEAT_S, timeout_s).count
        return _items(link, total, timeout_s, progress)


def _items(link: Link, total: int, timeout_s: float, progress: Progress) -> list[StoredItem]:
    """The items of a vehicle, asked for one after the other; raises `_Unanswered` where one does not come."""
    to, mavlink = _to(link), packets()
    items: list[StoredItem] = []
    for seq in range(total):
        progress(seq, total)
        wanted = mavlink.MAVLink_mission_request_int_message(*to, seq, 0)
        asked = f"give {called(seq, link.vehicle)}"
        items.append(unpacked(_answer(link, wanted, asked, "MISSION_ITEM_INT", ITEM_REPEAT_S, timeout_s, seq)))
    progress(total, total)
    link.send(mavlink.MAVLink_mission_ack_message(*to, ACCEPTED, 0))
    return items


def send(
    link: Link, items: Sequence[StoredItem], timeout_s: float, progress: Progress = lambda done, total: None
) -> bool:
    """Every item to a vehicle, as it asks for them.

    Whether it has accepted them; False where it has asked for all of them and then says no more, so that only reading
    them back tells. Raises `LinkFailed` where it refuses, or makes no progress for `timeout_s`.
    """
    with _cancelling(link):
        progressed = monotonic()
        for _ in range(ATTEMPTS):
            attempt = _Sending(link, items, timeout_s, progress, progressed)
            if attempt.run():
                return attempt.accepted
            progressed = attempt.progressed
        raise LinkFailed(f"{attempt.stuck}, {ATTEMPTS} times over")


def clear(link: Link, timeout_s: float) -> None:
    """A vehicle left without a mission; raises `LinkFailed` where it refuses or is silent."""
    wanted = packets().MAVLink_mission_clear_all_message(*_to(link), 0)
    _answer(link, wanted, "clear its mission", "MISSION_ACK", REPEAT_S, timeout_s)


def cancel(link: Link) -> None:
    """Tell a vehicle that the transfer is over; not heard, it finds out by itself."""
    with suppress(LinkFailed):
        link.send(packets().MAVLink_mission_ack_message(*_to(link), CANCELLED, 0))


class _Sending:
    """One attempt to send items: how far the vehicle has asked, and when it last did."""

    def __init__(
        self, link: Link, items: Sequence[StoredItem], timeout_s: float, progress: Progress, progressed: float
    ) -> None:
        self.link, self.items, self.timeout_s, self.progress = link, items, timeout_s, progress
        self.progressed = progressed
        self.last = -1  # the last item that was asked for
        self.answered = -1, 0.0  # the item sent last, and when
        self.repeats = 0  # how often the last item was sent without being asked for
        self.accepted = False
        self.refusal = ""
        self.heard = self.said = self.begun = monotonic()

    def run(self) -> bool:
        """Whether the vehicle has asked for all items; False where it has given up halfway."""
        self._begin()
        while True:
            message = self.link.receive({"MISSION_REQUEST_INT", "MISSION_REQUEST", "MISSION_ACK"}, self._deadline())
            now = monotonic()
            if message is None:
                done = self._silent(now)
            elif message.get_type() == "MISSION_ACK":
                done = self._acknowledged(message.type)
            else:
                self._asked(message.seq, now)
                continue
            if done is not None:
                return done

    @property
    def _complete(self) -> bool:
        return self.last == len(self.items) - 1

    def _begin(self) -> None:
        self.link.send(packets().MAVLink_mission_count_message(*_to(self.link), len(self.items), 0))
        self.said = monotonic()

    def _deadline(self) -> float:
        """When something is to be done if nothing is heard."""
        patience = REPEAT_S if self.last < 0 or self._complete else SILENCE_S
        return min(self._end(), max(self.heard, self.said) + patience)

    def _end(self) -> float:
        """When the vehicle has had its time: a busy one has longer."""
        busy = self.begun + BUSY_S if self.refusal and self.last < 0 else 0.0
        return max(busy, self.progressed + self.timeout_s)

    def _silent(self, now: float) -> bool | None:
        if self._complete:
            return self._unacknowledged(now)
        if now >= self._end():
            raise LinkFailed(f"{self.stuck}: no progress in {self.timeout_s:g} s")
        if self.last < 0:
            self._begin()
            return None
        return False

    def _unacknowledged(self, now: float) -> bool | None:
        """The last item or its acknowledgement was lost. The item again makes PX4 acknowledge it again."""
        if self.repeats >= REPEATS or now >= self._end():
            return True
        self.repeats += 1
        self._send_item(self.last, now)
        return None

    def _asked(self, seq: int, now: float) -> None:
        if seq >= len(self.items):
            raise LinkFailed(
                f"{self.link.vehicle.named} asks for item number {seq} of a mission whose last is {len(self.items) - 1}"
            )
        if seq > self.last:
            self.last, self.progressed = seq, now
            self.progress(seq, len(self.items))
        self.heard = now
        if self.answered[0] != seq or now - self.answered[1] > DOUBLED_S:
            self._send_item(seq, now)
        if now >= self._end():
            raise LinkFailed(f"{self.stuck}: no progress in {self.timeout_s:g} s")

    def _send_item(self, seq: int, now: float) -> None:
        self.link.send(packet(self.items[seq], seq, self.link.vehicle))
        self.answered = seq, now
        self.said = now

    def _acknowledged(self, result: int) -> bool | None:
        if result == ACCEPTED:
            # One that comes too early belongs to an earlier transfer.
            self.accepted = self._complete
            return self.accepted or None
        self.refusal = mission_result(result)
        # ArduPilot says so of an item that came twice, and goes on; a vehicle that is busy will not be for ever.
        if result == INVALID_SEQUENCE or (self.last < 0 and result in BUSY):
            return None
        if self._complete and self.repeats:
            # ArduPilot refuses a last item that comes again after it has taken all.
            return True
        raise LinkFailed(f"{self.link.vehicle.named} refused {self._what()}: {self.refusal}")

    def _what(self) -> str:
        return called(self.last, self.link.vehicle) if self.last >= 0 else "the mission"

    @property
    def stuck(self) -> str:
        """How far it came, in words, and why no further as far as the vehicle said."""
        said = f", saying that {self.refusal}" if self.refusal else ""
        what = f"asked for no more than {self._what()}" if self.last >= 0 else "did not ask for the mission"
        return f"{self.link.vehicle.named} {what}{said}"


def _answer(
    link: Link, wanted: Any, asked: str, kind: str, repeat_s: float, timeout_s: float, seq: int | None = None
) -> Any:
    """The answer of one kind to a message, which is repeated until it comes; `asked` is what for, in words.

    A refusal may be a late answer to something else, and that of a busy vehicle passes: it counts when time is up.
    """
    begun = monotonic()
    deadline, refusal = begun + timeout_s, ""
    while (now := monotonic()) < deadline:
        link.send(wanted)
        again = min(deadline, now + repeat_s)
        while (message := link.receive({kind, "MISSION_ACK"}, again)) is not None:
            if message.get_type() == "MISSION_ACK" and message.type != ACCEPTED:
                refusal = mission_result(message.type)
                deadline = max(deadline, begun + BUSY_S)
            elif message.get_type() == kind and (seq is None or message.seq == seq):
                return message
    if refusal:
        raise LinkFailed(f"{link.vehicle.named} refused to {asked}: {refusal}")
    raise _Unanswered(f"{link.vehicle.named} did not answer in {timeout_s:g} s when asked to {asked}")


def _to(link: Link) -> tuple[int, int]:
    return link.vehicle.system, link.vehicle.component


@contextmanager
def _cancelling(link: Link) -> Iterator[None]:
    """A transfer that ends halfway is cancelled, Ctrl-C included, so that the vehicle need not wait for more."""
    try:
        yield
    except BaseException:
        cancel(link)
        raise
