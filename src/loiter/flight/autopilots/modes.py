"""Flight modes: those in which a vehicle takes our commands, the changes that are expected, and the names of all."""

from __future__ import annotations

from math import inf
from typing import Any

from loiter.files.missions.items import Autopilot

# ArduPlane's modes (ArduPlane/mode.h).
PLANE_MODES = {
    0: "MANUAL",
    1: "CIRCLE",
    2: "STABILIZE",
    3: "TRAINING",
    4: "ACRO",
    5: "FBWA",
    6: "FBWB",
    7: "CRUISE",
    8: "AUTOTUNE",
    10: "AUTO",
    11: "RTL",
    12: "LOITER",
    13: "TAKEOFF",
    14: "AVOID_ADSB",
    15: "GUIDED",
    17: "QSTABILIZE",
    18: "QHOVER",
    19: "QLOITER",
    20: "QLAND",
    21: "QRTL",
    22: "QAUTOTUNE",
    23: "QACRO",
    24: "THERMAL",
    25: "LOITER_ALT_QLAND",
    26: "AUTOLAND",
}
GUIDED = 15

# The modes of ArduPlane in which a wing does not carry the aircraft, or an automatic takeoff or landing goes on.
PLANE_UNFIT = {number for number, name in PLANE_MODES.items() if name.startswith("Q") or name.endswith("LAND")} | {13}

# PX4's main modes, and the sub modes of AUTO (px4_custom_mode.h).
PX4_MAIN = {1: "MANUAL", 2: "ALTCTL", 3: "POSCTL", 4: "AUTO", 5: "ACRO", 6: "OFFBOARD", 7: "STABILIZED"}
PX4_AUTO = {
    1: "READY",
    2: "TAKEOFF",
    3: "LOITER",
    4: "MISSION",
    5: "RTL",
    6: "LAND",
    8: "FOLLOW_TARGET",
    9: "PRECLAND",
    10: "VTOL_TAKEOFF",
    19: "GUIDED_COURSE",
}
PX4_OFFBOARD, PX4_AUTO_MAIN, PX4_LOITER_SUB, PX4_MISSION_SUB = 6, 4, 3, 4

# The sub modes of AUTO in which PX4 takes off or lands.
PX4_UNFIT = {2, 6, 9, 10}

# MAV_STATE: critical and above is a failsafe, 8 is a terminated flight.
CRITICAL, TERMINATION = 5, 8

# Seconds for a change of mode that was accepted to show in the heartbeats, which come once a second.
CHANGE_S = 3.0


def px4_mode(main: int, sub: int = 0) -> int:
    """PX4's custom_mode of a main and a sub mode."""
    return main << 16 | sub << 24


OFFBOARD, HOLD = px4_mode(PX4_OFFBOARD), px4_mode(PX4_AUTO_MAIN, PX4_LOITER_SUB)

# The modes in which autopilots hold a circle that was commanded, and fly their missions, by MAV_AUTOPILOT.
HOLD_MODES: dict[int, int] = {Autopilot.ARDUPILOT: GUIDED, Autopilot.PX4: HOLD}
MISSION_MODES: dict[int, int] = {
    Autopilot.ARDUPILOT: 10,
    Autopilot.PX4: px4_mode(PX4_AUTO_MAIN, PX4_MISSION_SUB),
}


def mode_name(autopilot: int, custom_mode: int) -> str:
    """The name of a mode, as ground stations show it: "GUIDED", "AUTO.LOITER"."""
    if autopilot == Autopilot.ARDUPILOT:
        return PLANE_MODES.get(custom_mode, f"mode {custom_mode}")
    main, sub = custom_mode >> 16 & 255, custom_mode >> 24 & 255
    name = PX4_MAIN.get(main, f"mode {main}")
    return f"AUTO.{PX4_AUTO.get(sub, sub)}" if main == PX4_AUTO_MAIN else name


def is_unfit(autopilot: int, custom_mode: int) -> bool:
    """Whether a vehicle takes off, lands or hovers in a mode: guiding does not begin then."""
    if autopilot == Autopilot.ARDUPILOT:
        return custom_mode in PLANE_UNFIT
    return custom_mode >> 16 & 255 == PX4_AUTO_MAIN and custom_mode >> 24 & 255 in PX4_UNFIT


class ModeWatch:
    """The mode of a vehicle, and whether it is one that is expected.

    Before the first `expect` every mode is. Then the mode is expected to change to the given one, within `CHANGE_S` of
    `accepted`; until it has, the modes from before count as expected too.
    """

    def __init__(self, autopilot: int) -> None:
        self._autopilot = autopilot
        self.mode: int | None = None
        self._first: int | None = None
        self._target: int | None = None
        self._former: set[int] = set()
        self._deadline = inf

    @property
    def name(self) -> str:
        """The name of the present mode."""
        return "unknown" if self.mode is None else mode_name(self._autopilot, self.mode)

    @property
    def change(self) -> str:
        """How the mode differs from the first one that was heard, in words; "" where it does not."""
        if self._first is None or self.mode == self._first:
            return ""
        return f"the mode changed from {mode_name(self._autopilot, self._first)} to {self.name}"

    @property
    def confirmed(self) -> bool:
        """Whether the last heartbeat shows the mode that was expected."""
        return self._target is not None and self.mode == self._target

    def update(self, message: Any) -> None:
        """Take the mode from a heartbeat."""
        self.mode = message.custom_mode
        self._first = self.mode if self._first is None else self._first
        if self.confirmed:
            self._former = set()

    def expect(self, mode: int) -> None:
        """Expect the mode to change, since that is being commanded."""
        if mode != self._target:
            former = {other for other in (self.mode, self._target) if other is not None}
            self._former = {*self._former, *former} - {mode}
        self._target, self._deadline = mode, inf

    def accepted(self, now: float) -> None:
        """Expect the change soon, since the vehicle has accepted the command."""
        self._deadline = now + CHANGE_S

    def unexpected_mode(self, now: float) -> str:
        """What is not as expected, in words, and "" while all is well."""
        if self._target is None or self.mode is None or self.confirmed:
            return ""
        if self.mode not in self._former:
            return f"the pilot or a failsafe changed the mode to {self.name}"
        wanted = mode_name(self._autopilot, self._target)
        return (
            ""
            if now < self._deadline
            else f"the vehicle stays in the mode {self.name}, and does not change to {wanted}"
        )
