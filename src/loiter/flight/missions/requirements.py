"""The takeoff and landing items that PX4 requires in a mission, according to its parameter MIS_TKO_LAND_REQ.

The rules follow FeasibilityChecker::checkTakeoffLandAvailable. PX4 stores a mission that does not meet them, but
refuses to fly it.
"""

from __future__ import annotations

from collections.abc import Sequence

from loiter.flight.missions.stored_items import StoredItem

REQUIREMENT = "MIS_TKO_LAND_REQ"

# MAV_CMD of takeoffs and landings, including those of VTOL aircraft.
TAKEOFFS, LANDINGS = {22, 84}, {21, 85}

# The requirement of each value. 4 and 5 require both or neither; in flight 5 requires a landing.
_TAKEOFF, _LANDING, _BOTH, _ALIKE, _ALIKE_OR_LANDING = 1, 2, 3, 4, 5


def requirement_remark(items: Sequence[StoredItem], requirement: float) -> str:
    """A sentence if PX4 in flight will refuse a mission, for a value of its parameter; otherwise empty."""
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
