"""Vector-field path following, on a circle.

D. R. Nelson, D. B. Barber, T. W. McLain and R. W. Beard, "Vector Field Path Following for Miniature Air Vehicles", IEEE
Transactions on Robotics 23(3), 2007, and, with the distance divided by the radius, R. W. Beard and T. W. McLain, "Small
Unmanned Aircraft: Theory and Practice", 2012, chapter 10. At the distance d from the centre and the azimuth phi the
course wanted is phi + pi/2 + atan(k (d - R)/R) clockwise, phi - pi/2 - atan(k (d - R)/R) counter-clockwise: along the
circle on it, towards the centre far away. The rate of the course is commanded: that of the course wanted, as the
aircraft moves, less kappa sat(error/epsilon), a sliding mode with a boundary layer.

With psi the angle of the velocity from the direction out, counted the way round, d' = V cos psi, phi' = V sin psi/d and
psi wanted = pi/2 + atan(k (d - R)/R), which gives the rate of the course wanted as in `course_rate`.
"""

from __future__ import annotations

from math import atan, atan2, cos, pi, radians, remainder, sqrt
from typing import NamedTuple

from loiter.errors import positive
from loiter.guidance.laws.following import AT_CENTRE_M, Around, Demand, Follower, phase_of
from loiter.guidance.protocol import State
from loiter.guidance.vehicle.limits import clipped
from loiter.planning.model import Aircraft, Orbit, Wind

# The roll time constant that the gains are for where none is given, seconds.
ROLL_TIME_S = 0.5

# On the field at large the rate of the course stays within this share of the limit.
FIELD_SHARE = 0.9

# k above this looks like a straight flight at the centre and a corner at the circle: it is what the authors' own
# programs take.
LARGEST_K = 10.0

# The course is not steered by the bank where heading and course are this far apart, or further: cosine.
LEAST_CRAB_COS = 0.5


class FieldGains(NamedTuple):
    """k of the field, and the sliding mode: kappa, radians per second, and the boundary layer epsilon, radians."""

    k: float
    kappa: float
    epsilon: float


def field_rate(distance: float, k: float) -> float:
    """The rate at which the course turns on the field, the way round, at a distance in radii; speed V/R is one."""
    slope = k * (distance - 1.0)
    # cos(psi) = -slope/sqrt(1 + slope^2), sin(psi) = 1/sqrt(1 + slope^2).
    return (1.0 / distance - k * slope / (1.0 + slope * slope)) / sqrt(1.0 + slope * slope)


def largest_k(tightest: float) -> float:
    """The largest k whose field, outside the circle, asks for no more than `FIELD_SHARE` of the tightest turn.

    `tightest` is the circle's radius in turn radii. The field turns away first, most where k (d - R)/R is about 0.7.
    """
    slopes = [0.05 * i for i in range(1, 61)]
    k = LARGEST_K
    while k > 0.1 and min(field_rate(1.0 + slope / k, k) for slope in slopes) < -FIELD_SHARE * tightest:
        k *= 0.98
    return k


def advised_gains(orbit: Orbit, aircraft: Aircraft, roll_time_s: float = ROLL_TIME_S) -> FieldGains:
    """The gains to fly with: k as large as the rate of turn allows, the sliding mode as stiff as the roll lag allows.

    The publication asks that the field stay within what the aircraft can turn: `largest_k`. Within the boundary layer
    the course follows at kappa/epsilon, which with a roll lag tau is damped as sqrt(3)/2 for kappa/epsilon = 1/(3 tau):
    soonest to settle by a search about 1/(2 tau). kappa is the largest rate of turn.
    """
    kappa = aircraft.airspeed_m_s / aircraft.turn_radius_m
    return FieldGains(largest_k(orbit.radius_m / aircraft.turn_radius_m), kappa, kappa * 3.0 * roll_time_s)


def course_rate(seen: Around, side: int, radius_m: float, gains: FieldGains) -> float:
    """The course rate to command, radians per second to the right."""
    slope = gains.k * (seen.distance_m - radius_m) / radius_m
    forward = side * seen.clockwise_m_s
    wanted = forward / max(seen.distance_m, AT_CENTRE_M) + gains.k * seen.outward_m_s / radius_m / (1.0 + slope * slope)
    error = remainder(atan2(forward, seen.outward_m_s) - 0.5 * pi - atan(slope), 2.0 * pi)
    return side * (wanted - gains.kappa * clipped(error / gains.epsilon, 1.0))


class VectorField(Follower):
    """Vector-field orbit following; over the ground in wind, with the course over the ground.

    `gains` are those of `advised_gains` where none are given. Raises as `Follower`, and `InvalidArgument` for a gain
    that is not positive.
    """

    def __init__(
        self, orbit: Orbit, aircraft: Aircraft, wind: Wind | None = None, *, gains: FieldGains | None = None
    ) -> None:
        super().__init__(orbit, aircraft, wind)
        self.gains = advised_gains(orbit, aircraft) if gains is None else gains
        for name, gain in zip(FieldGains._fields, self.gains, strict=True):
            positive(name, gain, "units")

    def _demand(self, state: State) -> Demand:
        seen = self._around(state)
        rate = course_rate(seen, self._side, self.orbit.radius_m, self.gains)
        course = atan2(state.velocity_east_m_s, state.velocity_north_m_s)
        crab = max(cos(course - radians(state.heading_deg)), LEAST_CRAB_COS)
        # V chi' = g tan(bank) cos(crab), V over the ground: the coordinated turn in wind (Beard and McLain).
        right = seen.speed_m_s * rate / crab
        return Demand(right, phase_of(right, seen, self._side, self.orbit.radius_m))
