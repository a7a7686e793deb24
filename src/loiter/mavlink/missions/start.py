"""A vehicle in flight told to fly the mission that it holds, from its first item. Nothing here arms or takes off.

The mode is changed by DO_SET_MODE: MISSION_START would arm PX4 (Commander.cpp), and ArduPlane accepts that also where
it does not change its mode.
"""

from __future__ import annotations

from collections.abc import Callable
from time import monotonic
from typing import Any

from loiter.errors import LinkFailed
from loiter.io.missions.items import Autopilot
from loiter.mavlink.connection.command import long_command, obeyed
from loiter.mavlink.connection.enumerations import ACCEPTED, command_result
from loiter.mavlink.connection.link import Link, packets
from loiter.mavlink.connection.status_text import Texts
from loiter.mavlink.missions.stored_items import keeps_home
from loiter.mavlink.watching.telemetry import AIRBORNE, EXTENDED_SYS_STATE, UNDEFINED

# MAV_CMD.
DO_SET_MODE, REQUEST_MESSAGE = 176, 512

# MAV_MODE_FLAG_CUSTOM_MODE_ENABLED.
CUSTOM_MODE = 1

# The mode in which each flies its mission, as DO_SET_MODE has it and as HEARTBEAT tells it: PX4's AUTO.MISSION, main
# mode 4 and sub mode 4, and ArduPlane's AUTO.
MODES = {Autopilot.PX4: ((4.0, 4.0), 4 << 16 | 4 << 24), Autopilot.ARDUPILOT: ((10.0, 0.0), 10)}

# Seconds until a question is repeated, and how often it is asked.
REPEAT_S, TRIES = 1.0, 4

_HAS_IT = "; it has the mission"

# Seconds to listen for what a vehicle says of a refusal, which may come after it; and until its mode is believed: three
# heartbeats. PX4 accepts to fly a mission that it does not find valid, and refuses, or goes back, after that.
WORDS_S, STAYS_S = 0.5, 3.0


def start_mission(link: Link, texts: Texts, timeout_s: float) -> None:
    """Have a vehicle in flight fly its mission; `texts` is what it has said.

    Raises `LinkFailed` where it is not in the air, refuses, with what it says, or does not answer.
    """
    mode = next((MODES[known] for known in MODES if known == link.vehicle.autopilot), None)
    if mode is None:
        raise LinkFailed(f"{link.vehicle.named} is told to fly missions in no way that is known here{_HAS_IT}")
    (main, sub), wanted = mode
    _check_in_the_air(link)
    _go_to_first(link)
    try:
        base = _heard(link, "HEARTBEAT", lambda heartbeat: True)
        flags = CUSTOM_MODE | (base.base_mode if base is not None else 0)
        obeyed(link, long_command(link, DO_SET_MODE, flags, main, sub), "fly the mission", timeout_s)
        _check_stays(link, wanted)
    except LinkFailed as failure:
        link.receive(set(), monotonic() + WORDS_S)
        raise LinkFailed(f"{failure}{texts.told}{_HAS_IT}") from failure


def flies_mission(link: Link) -> bool:
    """Whether a vehicle of PX4 or ArduPilot is in the mode in which it flies its mission."""
    heartbeat = _heard(link, "HEARTBEAT", lambda heartbeat: True)
    modes = [wanted for known, (_, wanted) in MODES.items() if known == link.vehicle.autopilot]
    return heartbeat is not None and heartbeat.custom_mode in modes


def _check_in_the_air(link: Link) -> None:
    """Raise `LinkFailed` unless the vehicle says that it is in the air."""
    question = long_command(link, REQUEST_MESSAGE, EXTENDED_SYS_STATE)
    state = _heard(link, "EXTENDED_SYS_STATE", lambda told: told.landed_state != UNDEFINED, question)
    if state is None:
        raise LinkFailed(f"{link.vehicle.named} does not say whether it flies, and is not told to{_HAS_IT}")
    if state.landed_state not in AIRBORNE:
        raise LinkFailed(f"{link.vehicle.named} is not in the air, and is not told to fly{_HAS_IT}")


def _go_to_first(link: Link) -> None:
    """Set the first item as the one to fly next. A vehicle that does not say that it is is not waited for long."""
    first = int(keeps_home(link.vehicle))
    target = link.vehicle.system, link.vehicle.component
    wanted = packets().MAVLink_mission_set_current_message(*target, first)
    _heard(link, "MISSION_CURRENT", lambda current: current.seq == first, wanted)


def _check_stays(link: Link, wanted: int) -> None:
    """Raise `LinkFailed` unless the vehicle gets into a mode and stays there: PX4 may accept first and then refuse."""
    until, there = monotonic() + STAYS_S, False
    while (message := link.receive({"HEARTBEAT", "COMMAND_ACK"}, until)) is not None:
        if message.get_type() == "HEARTBEAT":
            there = message.custom_mode == wanted
        elif message.command == DO_SET_MODE and message.result != ACCEPTED:
            raise LinkFailed(f"{link.vehicle.named} refused to fly the mission: {command_result(message.result)}")
    if not there:
        raise LinkFailed(f"{link.vehicle.named} accepted to fly the mission, and is in another mode")


def _heard(link: Link, kind: str, good: Callable[[Any], bool], question: Any = None) -> Any | None:
    """The first message of a kind that is good; None where none comes. A question is asked again and again."""
    for _ in range(TRIES):
        if question is not None:
            link.send(question)
        again = monotonic() + REPEAT_S
        while (message := link.receive({kind}, again)) is not None:
            if good(message):
                return message
    return None
