"""The radius with which a loiter is flown, which may differ from the radius of its mission item.

ArduPlane increases loiter radii with the altitude (AP_L1_Control::loiter_radius): with NAVL1_LIM_BANK at 0, its
default, by the square of EAS2TAS, the ratio of true to equivalent airspeed. With a bank limit it flies the radius
unchanged, unless a turn at that bank, widened from sea level to the altitude, needs a larger one. PX4 flies the radius
of the item (FixedWingModeManager::control_auto_loiter).
"""

from __future__ import annotations

from collections.abc import Sequence
from math import isnan, radians, tan
from typing import NamedTuple

from loiter.errors import InvalidArgument, LinkFailed
from loiter.files.missions.items import Autopilot, MavCommand
from loiter.files.missions.mission import BANK_LIMIT, LEAST_REPORTED_M
from loiter.files.missions.signs import OWN_RADIUS_M, circle, held_circle, with_circle
from loiter.flight.autopilots.settings import CRUISE, OLD_CRUISE
from loiter.flight.link.link import Link, Vehicle
from loiter.flight.link.parameters import Parameters
from loiter.flight.missions.stored_items import StoredItem, above_sea_m, item_name
from loiter.geo.atmosphere import eas2tas_squared
from loiter.planning.model import STANDARD_GRAVITY_M_S2

# The loiters of a mission whose radius ArduPlane stores; it does not store that of NAV_LOITER_TIME.
LOITERS = {int(c): c for c in (MavCommand.NAV_LOITER_UNLIM, MavCommand.NAV_LOITER_TURNS, MavCommand.NAV_LOITER_TO_ALT)}


class LoiterScaling(NamedTuple):
    """ArduPlane's NAVL1_LIM_BANK, degrees, and its cruise airspeed, metres per second; 0 if not known."""

    bank_limit_deg: float
    airspeed_m_s: float = 0.0

    def flown_m(self, radius_m: float, altitude_m: float) -> float:
        """The radius, metres, with which a loiter is flown at an altitude above the sea, for the radius of its item."""
        widened, least_m = eas2tas_squared(altitude_m), self._least_at_sea_level_m
        if least_m is None or least_m > radius_m:
            return radius_m * widened
        return max(least_m * widened, radius_m)

    def sent_m(self, radius_m: float, altitude_m: float) -> float:
        """The radius of the item with which ArduPlane flies `radius_m`: the inverse of `flown_m`."""
        widened, least_m = eas2tas_squared(altitude_m), self._least_at_sea_level_m
        if least_m is not None and least_m * max(widened, 1.0) <= radius_m:
            return radius_m
        return radius_m / widened

    def sent_whole_m(self, radius_m: float, altitude_m: float) -> float:
        """`sent_m` in whole metres, which ArduPlane stores, and at least 2, since 1 means its default radius."""
        return max(OWN_RADIUS_M + 1.0, float(round(self.sent_m(radius_m, altitude_m))))

    @property
    def _least_at_sea_level_m(self) -> float | None:
        """The radius of a turn at the bank limit at sea level, metres; None without a limit."""
        if self.bank_limit_deg <= 0.0 or self.airspeed_m_s <= 0.0:
            return None
        return self.airspeed_m_s * self.airspeed_m_s / (STANDARD_GRAVITY_M_S2 * tan(radians(self.bank_limit_deg)))


def scaling_parameters(vehicle: Vehicle) -> Parameters:
    """The parameters that determine how a vehicle widens its loiters: none for a vehicle that does not."""
    widens = vehicle.autopilot == Autopilot.ARDUPILOT
    return Parameters([BANK_LIMIT, CRUISE, OLD_CRUISE] if widens else [], vehicle.autopilot)


def loiter_scaling(known: dict[str, float]) -> LoiterScaling | None:
    """How a vehicle widens its loiters, from its parameters; None if it does not, or if they are not known yet."""
    limit_deg = known.get(BANK_LIMIT)
    airspeed = known.get(CRUISE, known.get(OLD_CRUISE, 0.0) / 100.0)
    if limit_deg is None or (limit_deg > 0.0 and airspeed <= 0.0):
        return None
    return LoiterScaling(max(0.0, limit_deg), airspeed)


def query_scaling(link: Link, parameters: Parameters, *, true_radius: bool) -> LoiterScaling | None:
    """`loiter_scaling` from the parameters that the vehicle sends when they are requested.

    Raises `LinkFailed` if the true radius is required and an ArduPilot does not answer.
    """
    found = loiter_scaling(parameters.wait(link, lambda known: loiter_scaling(known) is not None))
    if true_radius and found is None and link.vehicle.autopilot == Autopilot.ARDUPILOT:
        raise LinkFailed(f"{link.vehicle.named} does not report {BANK_LIMIT}: which radius it flies is not known")
    return found


def radius_remark(scaling: LoiterScaling, radius_m: float, altitude_m: float) -> str:
    """A sentence with the remedy if ArduPlane flies another radius than that of an item; otherwise empty."""
    flown_m = scaling.flown_m(radius_m, altitude_m)
    if abs(flown_m - radius_m) < LEAST_REPORTED_M:
        return ""
    return (
        f"ArduPlane will hold {flown_m:.1f} m instead of {radius_m:g}, because it multiplies the radius by EAS2TAS "
        f"squared, {eas2tas_squared(altitude_m):.3f} at {altitude_m:.0f} m, with {BANK_LIMIT} at "
        f"{scaling.bank_limit_deg:g}: set that to the bank limit of the aircraft, or use --true-radius."
    )


def fit_radii(
    items: Sequence[StoredItem], scaling: LoiterScaling, vehicle: Vehicle, home_altitude_m: float, *, true_radius: bool
) -> tuple[list[StoredItem], list[str]]:
    """The items of a mission for ArduPlane, and remarks on their circles, a sentence each.

    With `true_radius` each loiter gets the radius, in whole metres, with which ArduPlane flies that of the mission.
    Raises `InvalidArgument` if the altitude above the sea is not known: above the terrain, or above a home of unknown
    altitude.
    """
    fit, remarks = list(items), []
    for seq, item in enumerate(items):
        radius_m, altitude_m = _radius_m(item), above_sea_m(item, home_altitude_m)
        if radius_m == 0.0 or (isnan(altitude_m) and not true_radius):
            continue
        if isnan(altitude_m):
            name = item_name(seq, vehicle)
            raise InvalidArgument("true_radius", f"needs altitudes above the sea: that of {name} is not known")
        if not true_radius:
            remarks.append(radius_remark(scaling, radius_m, altitude_m))
            continue
        sent_m = scaling.sent_whole_m(radius_m, altitude_m)
        _, turn = circle(item.command, item.params)
        fit[seq] = item._replace(params=with_circle(item.command, item.params, sent_m, turn))
        if sent_m != radius_m:
            remarks.append(sent_remark(scaling, sent_m, altitude_m))
    return fit, [remark for remark in remarks if remark]


def sent_remark(scaling: LoiterScaling, sent_m: float, altitude_m: float) -> str:
    """The sentence about a radius that was sent instead of the radius of the mission."""
    flown_m = scaling.flown_m(sent_m, altitude_m)
    return f"The radius is sent as {sent_m:g} m, which ArduPlane flies as {flown_m:.1f} m at {altitude_m:.0f} m."


def _radius_m(item: StoredItem) -> float:
    """The radius of an item's circle, metres; 0 if it has no circle, or if ArduPlane uses a radius of its own."""
    if item.command not in LOITERS:
        return 0.0
    radius_m, _ = held_circle(item.command, item.params)
    return radius_m or 0.0
