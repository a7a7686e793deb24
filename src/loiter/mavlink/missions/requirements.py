"""What PX4 requires of a mission before it flies it: a takeoff, a landing, by its parameter MIS_TKO_LAND_REQ.

FeasibilityChecker::checkTakeoffLandAvailable. PX4 takes any mission; what it will not fly it says when it is to.
"""

from __future__ import annotations

from collections.abc import Sequence

from loiter.mavlink.missions.stored_items import StoredItem

REQUIREMENT = "MIS_TKO_LAND_REQ"

# MAV_CMD of takeoffs and landings, VTOL's among them.
TAKEOFFS, LANDINGS = {22, 84}, {21, 85}

# What each value requires. For 4 and 5 it is both or neither, for 5 in flight a landing.
_TAKEOFF, _LANDING, _BOTH, _ALIKE, _ALIKE_OR_LANDING = 1, 2, 3, 4, 5


def remark(items: Sequence[StoredItem], requirement: float) -> str:
    """A sentence where PX4 will not fly a mission in flight, by the value of its parameter; else empty."""
    takeoff = any(item.command in TAKEOFFS for item in items)
    landing = any(item.command in LANDINGS for item in items)
    missing = {
        _TAKEOFF: "" if takeoff else "a takeoff",
        _LANDING: "" if landing else "a landing",
        _BOTH: "" if takeoff and landing else "a takeoff and a landing",
        _ALIKE: "" if takeoff == landing else "both a takeoff and a landing, or neither",
        _ALIKE_OR_LANDING: "" if landing else "a landing",
    }.get(int(requirement), "")
    if not missing:
        return ""
    return (
        f"PX4 will not fly this mission: {REQUIREMENT} is {requirement:g}, which requires {missing} in it; set that to "
        "0 and send the mission again."
    )
