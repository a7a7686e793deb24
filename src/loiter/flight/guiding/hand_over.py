"""The commands at the hand-over of a vehicle to its own hold: the circle that is sent, and the last bank.

ArduPlane keeps the last bank for 3 s, and then flies a circle by its own guidance (AP_L1_Control::update_loiter). On a
circle of radius r, e outside it, that demands the lateral acceleration v^2/r + Kx e + Kv e', with the speed v along the
circle, omega = 2 pi/NAVL1_PERIOD, Kx = omega^2 and Kv = 2 NAVL1_DAMPING omega. The aircraft turns otherwise than that,
by a factor G: it slips, obeys late, and its slip settles slowly. So its circle is another one, in two ways:

- Its radius is wrong by a steady e. Of the demand the share k is turned, the turn ratio, and V^2/r is needed:
  e = (1 - k)/k V^2/(r Kx). In wind the mean of the circle is outside by a share of the offset at which Kx e is the
  acceleration that it needs downwind beyond V^2/r. The radius that is sent is smaller by e.
- Its centre is wrong, in wind. v^2/r has the first harmonic 2 V w/r, at the angular rate W = V/r. It is turned by
  G(iW), which leaves e = (1 - G) (2 V w/r)/(G (Kx + i W Kv) - W^2), a complex amplitude: its argument is the angle by
  which the largest offset is before the point where the aircraft flies with the wind. An offset that is a first
  harmonic is a displaced circle. The centre that is sent is displaced the other way.
"""

from __future__ import annotations

from cmath import exp, phase
from dataclasses import replace
from math import atan, atan2, cos, degrees, hypot, pi, radians, sin, sqrt, tan
from typing import NamedTuple

from loiter.errors import LoiterError
from loiter.flight.autopilots.own_guidance import Guidance, guidance_of
from loiter.flight.guiding.settling import MeanPosition
from loiter.flight.missions.flown_radius import loiter_scaling
from loiter.geo.atmosphere import eas2tas_squared
from loiter.guidance.circle import circle_offset
from loiter.guidance.protocol import State
from loiter.guidance.vehicle import VehicleEstimates, clip
from loiter.planning.hold import hold
from loiter.planning.model import Aircraft, Orbit, sign_of, wind_from_velocity

# The largest shares of the radius by which it is corrected and by which the centre is displaced, and how far below 1 a
# turn ratio is noise, as any above 1 is: upwind, where banks are small, an error of a degree is 15 %.
LARGEST_SHARE, LARGEST_DISPLACEMENT, COORDINATED = 0.3, 0.05, 0.18

# That share for the mean, and how an aeroplane turns whose turn ratio is not below that: at the first ratio once its
# slip has settled, of which the second share settles over the third time, seconds. All as ArduPlane's simulated
# aeroplane flies circles of 130 to 198 m in 7 m/s of wind.
DOWNWIND_SHARE = 0.073
SETTLED_RATIO, SETTLING_SHARE, SETTLING_S = 0.98, 0.15, 5.0

# A smaller displacement of the centre, metres, is not worth a remark.
LEAST_REMARKED_M = 0.5

# The time, seconds, for which ArduPlane keeps the last bank: it suits the middle of that time.
KEPT_S = 3.0

# A course error at the end of that time counts as the offset to which it leads within this time, seconds. The turn rate
# is corrected by this share at most.
RECOVERY_S, LARGEST_CORRECTION = 2.0, 0.3


class TurnResponse(NamedTuple):
    """A turn rate over that of the bank, once it has settled, and the share of it that settles over `SETTLING_S`."""

    settled_ratio: float
    settling_share: float


def turn_response(turn_ratio: float) -> TurnResponse:
    """How ArduPlane turns whose turn ratio the law has identified; 1 where it has not."""
    if turn_ratio < 1.0 - COORDINATED:
        return TurnResponse(turn_ratio, 0.0)
    return TurnResponse(SETTLED_RATIO, SETTLING_SHARE)


class SentCircle(NamedTuple):
    """The circle to send: its centre and its radius, metres; `displaced_m` is how far its centre is from ours."""

    east_m: float
    north_m: float
    radius_m: float
    displaced_m: float = 0.0

    def remark(self, orbit: Orbit) -> str:
        """A sentence on a centre that differs from that of the orbit by more than a little; otherwise empty."""
        if self.displaced_m < LEAST_REMARKED_M:
            return ""
        bearing_deg = degrees(atan2(self.east_m - orbit.east_m, self.north_m - orbit.north_m)) % 360.0
        return (
            f"The circle is sent with its centre {self.displaced_m:.1f} m towards {bearing_deg:.0f} degrees, "
            f"for the wind, and a radius of {self.radius_m:g} m; it is flown as the one of {orbit.radius_m:g} m."
        )


def sent_circle(
    orbit: Orbit, altitude_m: float, parameters: dict[str, float], estimates: VehicleEstimates | None
) -> SentCircle:
    """The circle to send, with which a vehicle flies the orbit at an altitude above mean sea level.

    `parameters` are those of the vehicle, `estimates` those of the law, or None before it has flown. ArduPlane takes
    whole metres of radius.
    """
    scaling, radius_m = loiter_scaling(parameters), orbit.radius_m
    guidance = guidance_of(parameters)
    if guidance is None or estimates is None:
        sent_m = radius_m if scaling is None else scaling.sent_whole_m(radius_m, altitude_m)
        return SentCircle(orbit.east_m, orbit.north_m, sent_m)
    if scaling is None:
        sent_m, offset_m = radius_m, _px4_harmonic(radius_m, altitude_m, guidance, estimates)
    else:
        error_m = _acceleration_deficit(radius_m, estimates) / guidance.stiffness(0.0).real
        sent_m = scaling.sent_whole_m(radius_m - clip(error_m, LARGEST_SHARE * radius_m), altitude_m)
        offset_m = _first_harmonic(radius_m, guidance, estimates)
    displaced_m = min(abs(offset_m), LARGEST_DISPLACEMENT * radius_m)
    # The bearing from the centre at which the aircraft flies with the wind, and of the largest offset before it.
    side = sign_of(orbit.turn)
    downwind = atan2(estimates.wind_east_m_s, estimates.wind_north_m_s) - side * 0.5 * pi
    outside = downwind - side * phase(offset_m)
    return SentCircle(
        orbit.east_m - displaced_m * sin(outside), orbit.north_m - displaced_m * cos(outside), sent_m, displaced_m
    )


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


def _first_harmonic(radius_m: float, guidance: Guidance, estimates: VehicleEstimates) -> complex:
    """The complex amplitude of the offset of ArduPlane's own circle in wind, metres, about the downwind point."""
    rate, change = _wind_demand(radius_m, estimates)
    ratio, settling = turn_response(estimates.turn_ratio)
    turned = ratio * (1.0 - settling + settling / (1.0 + rate * SETTLING_S)) * _lateness(rate, estimates)
    return (1.0 - turned) * change / (turned * guidance.stiffness(rate) + rate * rate)


def _px4_harmonic(radius_m: float, altitude_m: float, guidance: Guidance, estimates: VehicleEstimates) -> complex:
    """The complex amplitude of the offset of PX4's own circle in wind, metres, about the downwind point."""
    rate, change = _wind_demand(radius_m, estimates)
    turned = _lateness(rate, estimates)
    wind = hypot(estimates.wind_east_m_s, estimates.wind_north_m_s)
    drift = guidance.course_gain * wind * (sqrt(eas2tas_squared(altitude_m)) - 1.0)
    return ((1.0 - turned) * change + 1j * turned * drift) / (turned * guidance.stiffness(rate) + rate * rate)


def _wind_demand(radius_m: float, estimates: VehicleEstimates) -> tuple[complex, float]:
    """The complex angular rate of a circle, 1/s, and the first harmonic of v^2/r, m/s^2."""
    wind = hypot(estimates.wind_east_m_s, estimates.wind_north_m_s)
    return 1j * estimates.airspeed_m_s / radius_m, 2.0 * estimates.airspeed_m_s * wind / radius_m


def _lateness(rate: complex, estimates: VehicleEstimates) -> complex:
    """The factor of a turn at a complex rate, 1/s, that is flown late by the delay and the roll."""
    return exp(-rate * (estimates.delay_s + estimates.roll.time_s))
