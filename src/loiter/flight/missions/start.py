"""Starting the mission of a vehicle that is in flight. Nothing here arms a vehicle or makes it take off.

The mode is changed by DO_SET_MODE. MISSION_START would arm PX4 (Commander.cpp), and ArduPlane accepts it even if it
does not change its mode.
"""

from __future__ import annotations

from collections.abc import Callable
from time import monotonic
from typing import Any

from loiter.errors import LinkFailed
from loiter.flight.autopilots.modes import MISSION_MODES
from loiter.flight.link.command import DO_SET_MODE, message_request, mode_command, send_command
from loiter.flight.link.enumerations import ACCEPTED, command_result
from loiter.flight.link.link import Link, dialect
from loiter.flight.link.status_text import StatusTexts
from loiter.flight.link.telemetry import AIRBORNE, UNDEFINED
from loiter.flight.missions.stored_items import keeps_home

# Seconds until a request is repeated, and how often it is sent.
REPEAT_S, TRIES = 1.0, 4

_HAS_IT = "; it has the mission"

# Seconds to wait for the status texts of a refusal, which may follow it, and for three heartbeats that confirm the
# mode: PX4 accepts the command for a mission that is not valid, and then refuses it or changes the mode back.
WORDS_S, STAYS_S = 0.5, 3.0


def start_mission(link: Link, texts: StatusTexts, timeout_s: float) -> None:
    """Command a vehicle in flight to fly its mission from the first item; `texts` are its status texts.

    Raises `LinkFailed` if it is not in the air, does not answer, or refuses, with its status texts.
    """
    mode = MISSION_MODES.get(link.vehicle.autopilot)
    if mode is None:
        raise LinkFailed(f"{link.vehicle.named} has an autopilot whose mission mode is not known here{_HAS_IT}")
    _check_in_the_air(link)
    _go_to_first(link)
    try:
        heartbeat = _await_message(link, "HEARTBEAT")
        base_mode = 0 if heartbeat is None else heartbeat.base_mode
        send_command(link, mode_command(link, mode, base_mode), "fly the mission", timeout_s)
        _check_mode_stays(link, mode)
    except LinkFailed as failure:
        link.receive(set(), monotonic() + WORDS_S)
        raise LinkFailed(f"{failure}{texts.quoted}{_HAS_IT}") from failure


def flies_mission(link: Link) -> bool:
    """Whether a vehicle with PX4 or ArduPilot is in the mode in which it flies its mission."""
    heartbeat = _await_message(link, "HEARTBEAT")
    return heartbeat is not None and heartbeat.custom_mode == MISSION_MODES.get(link.vehicle.autopilot)


def _check_in_the_air(link: Link) -> None:
    """Raise `LinkFailed` unless the vehicle reports that it is in the air."""
    kind = "EXTENDED_SYS_STATE"
    state = _await_message(link, kind, lambda state: state.landed_state != UNDEFINED, message_request(link, kind))
    if state is None:
        raise LinkFailed(
            f"{link.vehicle.named} does not report whether it is in the air: the mission is not started{_HAS_IT}"
        )
    if state.landed_state not in AIRBORNE:
        raise LinkFailed(f"{link.vehicle.named} is not in the air: the mission is not started{_HAS_IT}")


def _go_to_first(link: Link) -> None:
    """Make the first item the current one. It is not an error if the vehicle does not confirm that."""
    first = int(keeps_home(link.vehicle))
    target = link.vehicle.system, link.vehicle.component
    request = dialect().MAVLink_mission_set_current_message(*target, first)
    _await_message(link, "MISSION_CURRENT", lambda current: current.seq == first, request)


def _check_mode_stays(link: Link, mode: int) -> None:
    """Raise `LinkFailed` unless the vehicle changes to a mode and stays in it: PX4 may accept first and then refuse."""
    until, in_mode = monotonic() + STAYS_S, False
    while (message := link.receive({"HEARTBEAT", "COMMAND_ACK"}, until)) is not None:
        if message.get_type() == "HEARTBEAT":
            in_mode = message.custom_mode == mode
        elif message.command == DO_SET_MODE and message.result != ACCEPTED:
            raise LinkFailed(f"{link.vehicle.named} refused to fly the mission: {command_result(message.result)}")
    if not in_mode:
        raise LinkFailed(f"{link.vehicle.named} accepted to fly the mission, but is in another mode")


def _await_message(
    link: Link, kind: str, fits: Callable[[Any], bool] = lambda message: True, request: Any = None
) -> Any | None:
    """The first message of a kind that fits, or None; a request for it is sent repeatedly."""
    for _ in range(TRIES):
        if request is not None:
            link.send(request)
        until = monotonic() + REPEAT_S
        while (message := link.receive({kind}, until)) is not None:
            if fits(message):
                return message
    return None
