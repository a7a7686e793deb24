"""What an autopilot's parameters say about its aircraft: airspeed, bank limit, roll response, and its failsafe.

The roll response is guessed from RLL2SRV_TCONST and RLL2SRV_RMAX of ArduPlane, or FW_R_TC and FW_R_RMAX of PX4; the
law identifies it in flight. PX4 limits the rate of its bank setpoint to FW_PN_R_SLEW_MAX, which the law must know.
"""

from __future__ import annotations

from collections.abc import Iterable
from enum import Enum
from math import inf, nan
from typing import NamedTuple

from loiter.files.missions.items import Autopilot
from loiter.files.missions.mission import BANK_LIMIT
from loiter.guidance.vehicle import Roll

# The limit of commanded banks lies below the autopilot's own limit by this, degrees, and is never above the second.
BANK_MARGIN_DEG, STEEPEST_DEG = 0.5, 60.0

# Roll response where the parameters do not tell it: degrees per second, seconds.
ROLL_RATE_DEG_S, ROLL_TIME_S = 90.0, 0.4

# The time constant of the response over that of the parameter, which scales the error of the attitude alone: about so
# much was measured in both autopilots' simulators.
TIME_SHARE = 0.5

# The meanings of COM_OBL_RC_ACT in words.
LOSS_ACTIONS = {
    0: "position mode",
    1: "altitude mode",
    2: "stabilized mode",
    3: "return",
    4: "land",
    5: "hold",
    6: "terminate",
    7: "disarm",
}

# Those of them after which PX4 circles or comes home: return, hold.
SAFE_LOSS_ACTIONS = {3, 5}

# The parameters for the largest bank: ArduPlane's in degrees, before version 4.5 in hundredths of them, and PX4's.
BANK_LIMITS = ("ROLL_LIMIT_DEG", "LIM_ROLL_CD", "FW_R_LIM")

# ArduPlane's parameters for the cruise airspeed: in metres per second since version 4.5, before in centimetres per
# second.
CRUISE, OLD_CRUISE = "AIRSPEED_CRUISE", "TRIM_ARSPD_CM"


# ArduPlane's radius of circles that are commanded without one, metres.
LOITER_RADIUS = "WP_LOITER_RAD"


class Need(Enum):
    """How much a parameter is needed: guiding begins not without it, it is waited for while others are, or neither."""

    NEEDED, WANTED, OPTIONAL = range(3)


# The parameters that are requested: for each its names, the newest first, and how much it is needed. Later versions
# have all that are wanted.
PARAMETERS: dict[Autopilot, dict[tuple[str, ...], Need]] = {
    Autopilot.ARDUPILOT: {
        (CRUISE, OLD_CRUISE): Need.NEEDED,
        ("ROLL_LIMIT_DEG", "LIM_ROLL_CD"): Need.NEEDED,
        (BANK_LIMIT,): Need.NEEDED,
        (LOITER_RADIUS,): Need.OPTIONAL,
        ("RLL2SRV_TCONST",): Need.WANTED,
        ("RLL2SRV_RMAX",): Need.WANTED,
        ("NAVL1_PERIOD",): Need.WANTED,
        ("NAVL1_DAMPING",): Need.OPTIONAL,
        ("FENCE_ENABLE",): Need.WANTED,
        ("RCMAP_ROLL",): Need.WANTED,
        ("RCMAP_PITCH",): Need.WANTED,
    },
    Autopilot.PX4: {
        ("FW_AIRSPD_TRIM",): Need.NEEDED,
        ("FW_R_LIM",): Need.NEEDED,
        ("FW_R_TC",): Need.WANTED,
        ("FW_R_RMAX",): Need.WANTED,
        ("FW_PN_R_SLEW_MAX",): Need.OPTIONAL,
        ("NPFG_PERIOD",): Need.WANTED,
        ("NPFG_DAMPING",): Need.WANTED,
        ("COM_OBL_RC_ACT",): Need.WANTED,
        ("GF_ACTION",): Need.WANTED,
        ("RC_MAP_ROLL",): Need.WANTED,
        ("RC_MAP_PITCH",): Need.WANTED,
    },
}


class AutopilotSettings(NamedTuple):
    """The settings of an autopilot: indicated cruise airspeed, metres per second, and largest bank, degrees, or nan.

    `loss_action` is what PX4 does when setpoints stop, `flies_away` whether it then neither circles nor comes home.
    `fence` is what its parameters say about a fence.
    """

    airspeed_m_s: float
    bank_limit_deg: float
    roll: Roll
    loss_action: str = ""
    flies_away: bool = False
    fence: str = "unknown"

    @property
    def guided_bank_deg(self) -> float:
        """The limit of commanded banks, degrees."""
        return min(self.bank_limit_deg - BANK_MARGIN_DEG, STEEPEST_DEG)


# The parameters for which the law of a flight is built: cruise airspeed, bank limit and roll response.
LAW_PARAMETERS: dict[Autopilot, tuple[str, ...]] = {
    Autopilot.ARDUPILOT: (CRUISE, OLD_CRUISE, *BANK_LIMITS, "RLL2SRV_TCONST", "RLL2SRV_RMAX"),
    Autopilot.PX4: ("FW_AIRSPD_TRIM", *BANK_LIMITS, "FW_R_TC", "FW_R_RMAX", "FW_PN_R_SLEW_MAX"),
}


class ParameterChange(NamedTuple):
    """A parameter that has another value than before."""

    name: str
    before: float
    now: float

    @property
    def sentence(self) -> str:
        """The change in words."""
        return f"{self.name} was changed from {self.before:g} to {self.now:g} in flight"


def change_of(names: Iterable[str], before: dict[str, float], now: dict[str, float]) -> ParameterChange | None:
    """The first of some parameters that has another value now; one that was not known before has not."""
    changes = (ParameterChange(name, before[name], now[name]) for name in names if name in before)
    return next((change for change in changes if change.now != change.before), None)


def law_change(
    autopilot: Autopilot, before: dict[str, float], now: dict[str, float], bank_deg: float
) -> ParameterChange | None:
    """The first parameter for which a law that banks by so many degrees was built, and which has another value now.

    A bank limit counts only where it is below that bank: the law does not use more.
    """
    is_allowed = bank_deg <= autopilot_settings(autopilot, now).guided_bank_deg
    names = (name for name in LAW_PARAMETERS[autopilot] if not (is_allowed and name in BANK_LIMITS))
    return change_of(names, before, now)


def parameter_names(autopilot: Autopilot) -> list[str]:
    """The names of all parameters that are requested of an autopilot."""
    return [name for names in PARAMETERS[autopilot] for name in names]


def missing(autopilot: Autopilot, known: dict[str, float], least: Need = Need.NEEDED) -> list[str]:
    """The parameters that are needed and not known yet, by their newest names; with `WANTED` the wanted ones too."""
    needs = PARAMETERS[autopilot].items()
    return [names[0] for names, need in needs if need.value <= least.value and not known.keys() & set(names)]


def autopilot_settings(autopilot: Autopilot, known: dict[str, float]) -> AutopilotSettings:
    """The settings in the parameters of an autopilot."""
    return _plane_settings(known) if autopilot == Autopilot.ARDUPILOT else _px4_settings(known)


def _plane_settings(known: dict[str, float]) -> AutopilotSettings:
    return AutopilotSettings(
        known.get(CRUISE, known.get(OLD_CRUISE, nan) / 100.0),
        known.get("ROLL_LIMIT_DEG", known.get("LIM_ROLL_CD", nan) / 100.0),
        _roll(known.get("RLL2SRV_TCONST", ROLL_TIME_S), known.get("RLL2SRV_RMAX", 0.0)),
        fence=_fence(known.get("FENCE_ENABLE")),
    )


def _px4_settings(known: dict[str, float]) -> AutopilotSettings:
    slew_deg_s = known.get("FW_PN_R_SLEW_MAX", 0.0)
    action = round(known.get("COM_OBL_RC_ACT", -1.0))
    return AutopilotSettings(
        known.get("FW_AIRSPD_TRIM", nan),
        known.get("FW_R_LIM", nan),
        _roll(known.get("FW_R_TC", ROLL_TIME_S), known.get("FW_R_RMAX", 0.0), slew_deg_s if slew_deg_s > 0.0 else inf),
        loss_action=LOSS_ACTIONS.get(action, "what COM_OBL_RC_ACT says"),
        flies_away=action not in SAFE_LOSS_ACTIONS,
        fence=_fence(known.get("GF_ACTION")),
    )


def _fence(setting: float | None) -> str:
    """What FENCE_ENABLE or GF_ACTION says about a fence: 0 is none."""
    return "unknown" if setting is None else "on" if setting else "off"


def _roll(time_s: float, rate_deg_s: float, slew_deg_s: float = inf) -> Roll:
    """The response with a time constant and a rate limit; a rate of 0 is no limit, and a default stands in for it."""
    return Roll(TIME_SHARE * max(time_s, 0.0), rate_deg_s if rate_deg_s > 0.0 else ROLL_RATE_DEG_S, slew_deg_s)
