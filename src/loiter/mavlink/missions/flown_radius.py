"""The radius that a loiter is flown with, where that is not the radius of its item.

ArduPlane widens loiters with the altitude (AP_L1_Control::loiter_radius): by EAS2TAS squared, true over equivalent
airspeed, where NAVL1_LIM_BANK is 0, its default. With a limit it flies the radius as it is, as far as a turn at that
bank at sea level, widened, is no larger. PX4 flies the radius of the item (FixedWingModeManager::control_auto_loiter).
"""

from __future__ import annotations

from collections.abc import Sequence
from math import isfinite, isnan, radians, tan
from typing import NamedTuple

from loiter.errors import InvalidArgument, LinkFailed
from loiter.geo.atmosphere import HIGHEST_M, LOWEST_M, density_ratio
from loiter.io.missions.items import Autopilot, Command
from loiter.io.missions.signs import COMMANDS, circle, with_circle
from loiter.mavlink.connection.link import Link, Vehicle
from loiter.mavlink.connection.parameters import Parameters
from loiter.mavlink.missions.stored_items import StoredItem, above_sea_m, called
from loiter.planning.model import STANDARD_GRAVITY_M_S2

# ArduPlane's names of the limit and of the airspeed that it keeps: since version 4.5 in metres per second, before in
# centimetres.
BANK_LIMIT, CRUISE, OLD_CRUISE = "NAVL1_LIM_BANK", "AIRSPEED_CRUISE", "TRIM_ARSPD_CM"

# The loiters of a mission whose radius ArduPlane keeps: not NAV_LOITER_TIME.
LOITERS = {int(c): c for c in (Command.NAV_LOITER_UNLIM, Command.NAV_LOITER_TURNS, Command.NAV_LOITER_TO_ALT)}

# A circle that is off by less than this, metres, is not worth a sentence: ArduPlane keeps whole metres.
LEAST_TOLD_M = 1.0


class Scaling(NamedTuple):
    """ArduPlane's NAVL1_LIM_BANK, degrees, and the airspeed that it keeps, metres per second; 0 where not known."""

    bank_limit_deg: float
    airspeed_m_s: float = 0.0

    def flown_m(self, radius_m: float, altitude_m: float) -> float:
        """The radius, metres, that a loiter of a radius is flown with at an altitude above the sea."""
        widened, least_m = eas2tas_squared(altitude_m), self._least_at_sea_level_m
        if least_m is None or least_m > radius_m:
            return radius_m * widened
        return max(least_m * widened, radius_m)

    def sent_m(self, radius_m: float, altitude_m: float) -> float:
        """The radius of the item with which a radius is flown: the inverse of `flown_m`."""
        widened, least_m = eas2tas_squared(altitude_m), self._least_at_sea_level_m
        if least_m is not None and least_m * max(widened, 1.0) <= radius_m:
            return radius_m
        return radius_m / widened

    def sent_whole_m(self, radius_m: float, altitude_m: float) -> float:
        """`sent_m` in the whole metres that ArduPlane keeps, and not the 0 that would be its own radius."""
        return max(1.0, float(round(self.sent_m(radius_m, altitude_m))))

    @property
    def _least_at_sea_level_m(self) -> float | None:
        """The radius of a turn at the limit at sea level, metres, where there is a limit."""
        if self.bank_limit_deg <= 0.0 or self.airspeed_m_s <= 0.0:
            return None
        return self.airspeed_m_s * self.airspeed_m_s / (STANDARD_GRAVITY_M_S2 * tan(radians(self.bank_limit_deg)))


def eas2tas_squared(altitude_m: float) -> float:
    """The square of true over equivalent airspeed in standard air: the inverse of the density ratio."""
    return 1.0 / density_ratio(min(max(altitude_m, LOWEST_M), HIGHEST_M))


def parameters_of(vehicle: Vehicle) -> Parameters:
    """The parameters that say how a vehicle widens its loiters: none of one that flies radii as they are."""
    widens = vehicle.autopilot == Autopilot.ARDUPILOT
    return Parameters([BANK_LIMIT, CRUISE, OLD_CRUISE] if widens else [], vehicle.autopilot)


def scaling(known: dict[str, float]) -> Scaling | None:
    """How a vehicle widens its loiters, by those parameters; None where it does not, or as long as it is not known."""
    limit_deg = known.get(BANK_LIMIT)
    airspeed = known.get(CRUISE, known.get(OLD_CRUISE, 0.0) / 100.0)
    if limit_deg is None or (limit_deg > 0.0 and airspeed <= 0.0):
        return None
    return Scaling(max(0.0, limit_deg), airspeed)


def scaling_of(link: Link, parameters: Parameters, *, true_radius: bool) -> Scaling | None:
    """`scaling` as soon as the vehicle has answered.

    Raises `LinkFailed` where the true radius is asked for and an ArduPilot does not answer.
    """
    found = scaling(parameters.wait(link, lambda known: scaling(known) is not None))
    if true_radius and found is None and link.vehicle.autopilot == Autopilot.ARDUPILOT:
        raise LinkFailed(f"{link.vehicle.named} does not tell its {BANK_LIMIT}: which radius it flies is not known")
    return found


def remark(widened: Scaling, radius_m: float, altitude_m: float) -> str:
    """A sentence where ArduPlane flies another radius than that of an item, with what would do; else empty."""
    flown_m = widened.flown_m(radius_m, altitude_m)
    if abs(flown_m - radius_m) < LEAST_TOLD_M:
        return ""
    return (
        f"ArduPlane will hold {flown_m:.1f} m in place of {radius_m:g}, since it multiplies the radius by EAS2TAS "
        f"squared, {eas2tas_squared(altitude_m):.3f} at {altitude_m:.0f} m, with {BANK_LIMIT} at "
        f"{widened.bank_limit_deg:g}: set that to the bank limit of the aircraft, or ask for --true-radius."
    )


def fitted(
    items: Sequence[StoredItem], widened: Scaling, vehicle: Vehicle, home_altitude_m: float, *, true_radius: bool
) -> tuple[list[StoredItem], list[str]]:
    """The items of a mission for ArduPlane, and what is to be said of their circles, a sentence each.

    With `true_radius` each loiter gets the radius with which it is flown as asked, in the whole metres that ArduPlane
    keeps. Raises `InvalidArgument` where that cannot be known: above the terrain, above a home of no known altitude.
    """
    fit, remarks = list(items), []
    for seq, item in enumerate(items):
        radius_m, altitude_m = _radius_m(item), above_sea_m(item, home_altitude_m)
        if radius_m == 0.0 or (isnan(altitude_m) and not true_radius):
            continue
        if isnan(altitude_m):
            raise InvalidArgument("true_radius", f"needs altitudes above the sea: not known in {called(seq, vehicle)}")
        if not true_radius:
            remarks.append(remark(widened, radius_m, altitude_m))
            continue
        sent_m = widened.sent_whole_m(radius_m, altitude_m)
        turn = circle(item.command, item.params)[1]
        fit[seq] = item._replace(params=with_circle(item.command, item.params, sent_m, turn))
        if sent_m != radius_m:
            remarks.append(sent_remark(widened, sent_m, altitude_m))
    return fit, [said for said in remarks if said]


def sent_remark(widened: Scaling, sent_m: float, altitude_m: float) -> str:
    """The sentence that tells of a radius that was sent in place of the one asked for."""
    flown_m = widened.flown_m(sent_m, altitude_m)
    return f"The radius is sent as {sent_m:g} m, which ArduPlane flies as {flown_m:.1f} m at {altitude_m:.0f} m."


def _radius_m(item: StoredItem) -> float:
    """The radius of the circle that ArduPlane flies for an item of a mission; 0 where it has none or its own."""
    if item.command not in LOITERS:
        return 0.0
    signed_m = item.params[COMMANDS[LOITERS[item.command]].radius - 1]
    return abs(signed_m) if isfinite(signed_m) else 0.0
