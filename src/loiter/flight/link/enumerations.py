"""Texts for the values of MAVLink's enumerations MAV_MISSION_RESULT, MAV_RESULT and MAV_AUTOPILOT."""

from __future__ import annotations

from loiter.files.missions.items import Autopilot

ACCEPTED = 0

# MAV_MISSION_RESULT: the result of a mission transfer.
ERROR, INVALID_SEQUENCE, DENIED, CANCELLED = 1, 13, 14, 15
_MISSION_RESULTS = {
    ERROR: "it accepts no missions now (MAV_MISSION_ERROR)",
    2: "it does not know the altitude frame (MAV_MISSION_UNSUPPORTED_FRAME)",
    3: "it does not know the command (MAV_MISSION_UNSUPPORTED)",
    4: "it has no space for so many items (MAV_MISSION_NO_SPACE)",
    5: "a parameter has a value that it does not accept (MAV_MISSION_INVALID)",
    6: "parameter 1 has a value that it does not accept (MAV_MISSION_INVALID_PARAM1)",
    7: "parameter 2 has a value that it does not accept (MAV_MISSION_INVALID_PARAM2)",
    8: "parameter 3 has a value that it does not accept (MAV_MISSION_INVALID_PARAM3)",
    9: "parameter 4 has a value that it does not accept (MAV_MISSION_INVALID_PARAM4)",
    10: "the latitude has a value that it does not accept (MAV_MISSION_INVALID_PARAM5_X)",
    11: "the longitude has a value that it does not accept (MAV_MISSION_INVALID_PARAM6_Y)",
    12: "the altitude has a value that it does not accept (MAV_MISSION_INVALID_PARAM7)",
    INVALID_SEQUENCE: "the item came out of sequence (MAV_MISSION_INVALID_SEQUENCE)",
    DENIED: "it accepts no missions from this station (MAV_MISSION_DENIED)",
    CANCELLED: "it cancelled the transfer (MAV_MISSION_OPERATION_CANCELLED)",
}

# MAV_RESULT: the result of a command, or that it is in progress. A vehicle may accept later what it does not now.
NOT_NOW, UNSUPPORTED, IN_PROGRESS = 1, 3, 5
_COMMAND_RESULTS = {
    NOT_NOW: "not now (MAV_RESULT_TEMPORARILY_REJECTED)",
    2: "the command has a value that it does not accept (MAV_RESULT_DENIED)",
    UNSUPPORTED: "it does not know the command (MAV_RESULT_UNSUPPORTED)",
    4: "it tried and failed (MAV_RESULT_FAILED)",
    6: "the command was cancelled (MAV_RESULT_CANCELLED)",
    7: "it accepts the command as COMMAND_LONG only (MAV_RESULT_COMMAND_LONG_ONLY)",
    8: "it accepts the command as COMMAND_INT only (MAV_RESULT_COMMAND_INT_ONLY)",
    9: "it does not accept the altitude frame (MAV_RESULT_COMMAND_UNSUPPORTED_MAV_FRAME)",
    10: "it accepts no commands from this station (MAV_RESULT_NOT_IN_CONTROL)",
}

_AUTOPILOTS: dict[int, str] = {0: "generic", **{autopilot: autopilot.described for autopilot in Autopilot}}


def mission_result(code: int) -> str:
    """The reason why a vehicle refuses to receive or to send a mission."""
    return _MISSION_RESULTS.get(code, f"MAV_MISSION_RESULT {code}")


def command_result(code: int) -> str:
    """The reason why a vehicle refuses a command."""
    return _COMMAND_RESULTS.get(code, f"MAV_RESULT {code}")


def autopilot_name(code: int) -> str:
    """The name of a MAV_AUTOPILOT."""
    return _AUTOPILOTS.get(code, f"autopilot {code} of MAV_AUTOPILOT")
