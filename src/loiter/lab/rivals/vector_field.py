"""Vector-field following of a circle.

D. R. Nelson, D. B. Barber, T. W. McLain and R. W. Beard, "Vector Field Path Following for Miniature Air Vehicles", IEEE
Transactions on Robotics 23(3), 2007, and, with the distance divided by the radius, R. W. Beard and T. W. McLain, "Small
Unmanned Aircraft: Theory and Practice", 2012, chapter 10. At the distance d from the centre and the azimuth phi the
desired course is phi + pi/2 + atan(k (d - R)/R) clockwise, phi - pi/2 - atan(k (d - R)/R) counter-clockwise: tangent on
the circle, towards the centre far away. The law commands a course rate: the rate at which the desired course changes
along the flight, less kappa sat(error/epsilon), a sliding mode with a boundary layer.

Let psi be the angle from the outward direction to the velocity, positive in the direction of holding. Then
d' = V cos psi, phi' = V sin psi/d and the desired psi is pi/2 + atan(k (d - R)/R). This gives the rate of the desired
course in `commanded_course_rate`.
"""

from __future__ import annotations

from math import atan, atan2, cos, pi, radians, remainder, sqrt
from typing import NamedTuple

from loiter.errors import positive
from loiter.guidance.circle import AT_CENTRE_M, CircleOffset, circle_offset
from loiter.guidance.protocol import State
from loiter.guidance.vehicle import clip
from loiter.lab.rivals.following import Demand, Follower, demand_phase
from loiter.planning.model import Aircraft, Orbit, Wind

# The default roll time constant for which the gains are advised, seconds.
ROLL_TIME_S = 0.5

# Away from the circle the course rate of the field stays within this share of the limit.
FIELD_SHARE = 0.9

# The value in the authors' own programs. With a larger k the field is nearly straight towards the centre, with a corner
# at the circle.
LARGEST_K = 10.0

# The least cosine of the crab angle that is used: at larger angles bank hardly turns the course.
LEAST_CRAB_COS = 0.5


class FieldGains(NamedTuple):
    """k of the field; kappa, radians per second, and the boundary layer epsilon, radians, of the sliding mode."""

    k: float
    kappa: float
    epsilon: float


def field_rate(distance: float, k: float) -> float:
    """The rate at which the desired course turns, at a distance in radii, for a speed of one radius per unit of time.

    It is positive in the direction of holding.
    """
    slope = k * (distance - 1.0)
    # cos(psi) = -slope/sqrt(1 + slope^2), sin(psi) = 1/sqrt(1 + slope^2).
    return (1.0 / distance - k * slope / (1.0 + slope * slope)) / sqrt(1.0 + slope * slope)


def largest_k(tightest: float) -> float:
    """The largest k whose field, outside the circle, demands at most `FIELD_SHARE` of the aircraft's turn rate.

    `tightest` is the circle's radius in turn radii. Outside, the field turns against the direction of holding, most
    strongly where k (d - R)/R is about 0.7.
    """
    slopes = [0.05 * i for i in range(1, 61)]
    k = LARGEST_K
    while k > 0.1 and min(field_rate(1.0 + slope / k, k) for slope in slopes) < -FIELD_SHARE * tightest:
        k *= 0.98
    return k


def advised_gains(orbit: Orbit, aircraft: Aircraft, roll_time_s: float = ROLL_TIME_S) -> FieldGains:
    """The advised gains: k as large as the turn rate allows, the sliding mode as stiff as the roll lag allows.

    The publication requires that the aircraft can turn as fast as the field: `largest_k`. Within the boundary layer the
    course error decays with the gain kappa/epsilon. With a roll time constant tau, kappa/epsilon = 1/(3 tau) has the
    damping sqrt(3)/2; a search for the shortest settling time found about 1/(2 tau). kappa is the largest turn rate.
    """
    kappa = aircraft.airspeed_m_s / aircraft.turn_radius_m
    return FieldGains(largest_k(orbit.radius_m / aircraft.turn_radius_m), kappa, kappa * 3.0 * roll_time_s)


def commanded_course_rate(offset: CircleOffset, side: int, gains: FieldGains) -> float:
    """The commanded course rate, radians per second, positive to the right."""
    slope = gains.k * offset.outside_m / offset.radius_m
    forward = side * offset.clockwise_m_s
    desired = forward / max(offset.distance_m, AT_CENTRE_M) + gains.k * offset.outward_m_s / offset.radius_m / (
        1.0 + slope * slope
    )
    error = remainder(atan2(forward, offset.outward_m_s) - 0.5 * pi - atan(slope), 2.0 * pi)
    return side * (desired - gains.kappa * clip(error / gains.epsilon, 1.0))


class VectorField(Follower):
    """Vector-field following of a circle. In wind it uses the velocity and the course over the ground.

    The default `gains` are those of `advised_gains`. Raises the same as `Follower`, and `InvalidArgument` for a gain
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
        offset = circle_offset(state, self.orbit)
        rate = commanded_course_rate(offset, self._side, self.gains)
        course = atan2(state.velocity_east_m_s, state.velocity_north_m_s)
        crab = max(cos(course - radians(state.heading_deg)), LEAST_CRAB_COS)
        # V chi' = g tan(bank) cos(crab) with the ground speed V: the coordinated turn in wind (Beard and McLain).
        right = offset.speed_m_s * rate / crab
        return Demand(right, demand_phase(right, offset, self._side))
