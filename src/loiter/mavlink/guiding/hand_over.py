"""The commands at the hand-over of a vehicle to its own hold: the radius of the circle, and the last bank.

ArduPlane keeps the last bank for 3 s, and then holds a circle whose radius has a steady error if its turns are not as
fast as g tan(bank)/V. Its guidance (AP_L1_Control::update_loiter) demands the lateral acceleration V^2/r + Kx e on a
circle of radius r that is e wider than commanded, with Kx = (2 pi/NAVL1_PERIOD)^2. It gets the share k of it, the turn
ratio, and V^2/r is needed: e = (1 - k)/k V^2/(r Kx). The radius that is sent is smaller by e.

In wind its circle lies outside where the aircraft flies with the wind, farther than inside elsewhere: the middle of
both is outside by a share of the offset at which Kx e is the acceleration that the circle needs there beyond V^2/r.
"""

from __future__ import annotations

from dataclasses import replace
from math import atan, degrees, hypot, pi, radians, tan

from loiter.errors import LoiterError
from loiter.guidance.estimation.vehicle import VehicleEstimates
from loiter.guidance.protocol import State
from loiter.guidance.vehicle.circle import circle_offset
from loiter.guidance.vehicle.limits import clip
from loiter.mavlink.guiding.settling import MeanPosition
from loiter.mavlink.missions.flown_radius import loiter_scaling
from loiter.planning.hold import hold
from loiter.planning.model import Aircraft, Orbit, wind_from_velocity
from loiter.planning.sides import sign_of

# ArduPlane's parameter for the period of its guidance, seconds.
PERIOD = "NAVL1_PERIOD"

# The largest share of the radius by which it is corrected, and how far below 1 a turn ratio is noise, as any above 1
# is: upwind, where banks are small, an error of a degree is 15 %.
LARGEST_SHARE, COORDINATED = 0.3, 0.18

# That share, as ArduPlane's simulated aeroplane flies circles of 130 to 198 m in 7 m/s of wind.
DOWNWIND_SHARE = 0.085

# The time, seconds, for which ArduPlane keeps the last bank: it suits the middle of that time.
KEPT_S = 3.0

# A course error at the end of that time counts as the offset to which it leads within this time, seconds. The turn rate
# is corrected by this share at most.
RECOVERY_S, LARGEST_CORRECTION = 2.0, 0.3


def sent_radius_m(
    orbit: Orbit, altitude_m: float, parameters: dict[str, float], estimates: VehicleEstimates | None
) -> float:
    """The radius to send, metres, with which a vehicle flies that of the orbit at an altitude above mean sea level.

    `parameters` are those of the vehicle, `estimates` those of the law, or None before it has flown.
    """
    scaling, radius_m = loiter_scaling(parameters), orbit.radius_m
    if scaling is None:
        return radius_m
    period_s = parameters.get(PERIOD, 0.0)
    if estimates is not None and period_s > 0.0:
        error_m = _acceleration_deficit(radius_m, estimates) * (period_s / (2.0 * pi)) ** 2
        radius_m -= clip(error_m, LARGEST_SHARE * radius_m)
    return scaling.sent_whole_m(radius_m, altitude_m)


def last_bank_deg(
    orbit: Orbit, state: State, mean: MeanPosition, estimates: VehicleEstimates, limit_deg: float
) -> float:
    """The bank, degrees, that keeps an aircraft on its circle over the next seconds, in the wind that is estimated.

    It corrects the mean offset and course as far as a constant bank can.
    """
    azimuth_deg, side = circle_offset(state, orbit).azimuth_deg, sign_of(orbit.turn)
    speed = hypot(state.velocity_east_m_s, state.velocity_north_m_s)
    turn_rate = speed / orbit.radius_m
    ahead_deg = azimuth_deg + side * degrees(0.5 * KEPT_S * turn_rate)
    aircraft = Aircraft(estimates.airspeed_m_s, min_turn_radius_m=orbit.radius_m)
    wind = wind_from_velocity(estimates.wind_east_m_s, estimates.wind_north_m_s)
    try:
        # Only the bank limit of the autopilot matters: an aircraft that could turn tighter has the same bank here.
        tight = replace(aircraft, min_turn_radius_m=0.1 * orbit.radius_m)
        coordinated_deg = hold(orbit, tight, wind).at(ahead_deg).bank_deg
    except LoiterError:
        coordinated_deg = aircraft.bank_deg(orbit.radius_m)
    inward = side * radians(mean.course_error_deg)
    # Outside the circle its tangent turns more slowly.
    slower = mean.outside_m / orbit.radius_m
    correction = _correction(mean.outside_m, inward, speed) / turn_rate - slower
    factor = 1.0 + clip(correction, LARGEST_CORRECTION)
    bank_deg = degrees(atan(factor * tan(radians(coordinated_deg)) / estimates.turn_ratio))
    return side * min(bank_deg, limit_deg)


def _correction(outside_m: float, inward: float, speed: float) -> float:
    """The change of the turn rate towards the circle over `KEPT_S`, radians per second, after which least is left.

    `inward` is the angle, radians, by which the course points into the circle. With the change d, T = `KEPT_S` and
    L = `RECOVERY_S` times the speed V, the offset will be e = outside - V (T inward + T^2 d/2), the angle
    i = inward + T d, and the least e^2 + (L i)^2 is that of a linear equation.
    """
    T, L = KEPT_S, RECOVERY_S * speed
    offset_m, gained_m = outside_m - speed * T * inward, 0.5 * speed * T * T
    return (gained_m * offset_m - L * T * L * inward) / (gained_m * gained_m + L * T * L * T)


def _acceleration_deficit(radius_m: float, estimates: VehicleEstimates) -> float:
    """What ArduPlane's demand of lateral acceleration lacks on a circle of a radius, m/s^2: Kx times its offset."""
    V, k = estimates.airspeed_m_s, estimates.turn_ratio
    if k < 1.0 - COORDINATED:
        return (1.0 - k) / k * V * V / radius_m
    downwind = V + hypot(estimates.wind_east_m_s, estimates.wind_north_m_s)
    return DOWNWIND_SHARE * (downwind * downwind - V * V) / radius_m
