"""Whether a vehicle may be guided: a fixed wing in flight, in a mode from which it may be taken over."""

from __future__ import annotations

from typing import Any

from loiter.files.missions.items import Autopilot
from loiter.flight.autopilots.modes import CRITICAL, is_unfit, mode_name
from loiter.flight.link.telemetry import UNDEFINED

# MAV_TYPE_FIXED_WING, and the types that take off and land vertically, which report in which of their two ways they
# fly: MAV_VTOL_STATE_FW is the fixed wing.
FIXED_WING, VTOL, VTOL_FIXED_WING = 1, range(19, 26), 4

# MAV_LANDED_STATE: on the ground, in the air, taking off, landing.
LANDED = {1: "it is on the ground", 3: "it is taking off", 4: "it is landing"}

# MAV_TYPE in words.
TYPES = {2: "a quadrotor", 4: "a helicopter", 10: "a rover", 11: "a boat", 12: "a submarine", 13: "a hexarotor"}

# MAV_MODE_FLAG_SAFETY_ARMED.
ARMED = 128


def refusal(heartbeat: Any, extended: Any) -> str:
    """Why a vehicle must not be guided, in words; empty if it may be.

    `heartbeat` is its last HEARTBEAT, `extended` its last EXTENDED_SYS_STATE.
    """
    kind, mode = heartbeat.type, heartbeat.custom_mode
    if heartbeat.autopilot not in list(Autopilot):
        return "its autopilot is neither ArduPilot nor PX4"
    if kind != FIXED_WING and kind not in VTOL:
        return f"it is no fixed wing, but {TYPES.get(kind, f'of the MAV_TYPE {kind}')}"
    if kind in VTOL and extended.vtol_state != VTOL_FIXED_WING:
        return "it does not fly as a fixed wing now"
    if not heartbeat.base_mode & ARMED:
        return "it is not armed"
    if extended.landed_state == UNDEFINED:
        return "it does not know whether it is in the air"
    if extended.landed_state in LANDED:
        return LANDED[extended.landed_state]
    if is_unfit(heartbeat.autopilot, mode):
        return f"it is in the mode {mode_name(heartbeat.autopilot, mode)}"
    return "it is in a failsafe" if heartbeat.system_status >= CRITICAL else ""
