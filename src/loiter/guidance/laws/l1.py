"""The L1 loiter law: what ArduPilot flies, and PX4 flew for years.

S. Park, J. Deyst and J. P. How, "A New Nonlinear Guidance Logic for Trajectory Tracking", AIAA 2004-4900, steers at a
point of the path a distance L1 ahead by the lateral acceleration 2 V^2 sin(eta)/L1. The autopilots' form (ArduPilot,
AP_L1_Control, `update_loiter`; PX4, ECL_L1_Pos_Controller, `navigate_loiter`) sets that loop by a period and a damping:
outside the circle it steers at the centre, and goes over to a proportional and derivative law about the circle where
the two ask for the same.
"""

from __future__ import annotations

from math import atan2, cos, pi, radians, sin

from loiter.errors import positive
from loiter.guidance.laws.following import Around, Demand, Follower, phase_of
from loiter.guidance.protocol import State
from loiter.guidance.vehicle.limits import clipped
from loiter.planning.compass import heading_vector
from loiter.planning.model import Aircraft, Orbit, Wind

# ArduPilot's NAVL1_PERIOD, seconds, and NAVL1_DAMPING.
PERIOD_S, DAMPING = 17.0, 0.75

# ArduPilot's guide: the least period, for very agile aircraft.
SHORTEST_PERIOD_S = 10.0

# The loop of period T, 2 pi/T = w, with a roll lag tau: stable for w tau < 2 damping, damped as set for w tau << 1.
# Near this w tau it settles soonest, by a search over T for three aircraft (docs/jsbsim.md).
LAG_BY_FREQUENCY = 0.2

# ArduPilot's ground speed is no less than this, metres per second.
LEAST_SPEED_M_S = 1.0

# Flying away from the centre (course within 18 degrees of it, heading within 60), the side chosen is kept.
AWAY, OUTWARD = 0.9 * pi, cos(radians(60.0))


def advised_period_s(roll_time_s: float) -> float:
    """The period to fly with, seconds, for a roll time constant.

    ArduPilot's guide says 17 to 20 for most aircraft, 10 for very agile ones, more for slow ones: here as short as
    the lag of the bank lets the loop keep its damping, but no shorter than that guide goes.
    """
    return max(SHORTEST_PERIOD_S, 2.0 * pi * roll_time_s / LAG_BY_FREQUENCY)


def centre_angle(seen: Around) -> float:
    """The angle nu from the velocity to the centre, positive where the centre is on the right, radians."""
    return atan2(seen.clockwise_m_s, -seen.outward_m_s)


def capture_demand(seen: Around, nu: float, period_s: float, damping: float) -> float:
    """Acceleration to the right that steers at the centre: K V^2 sin(nu)/L1, K = 4 damping^2, L1 = damping T V/pi."""
    speed = max(seen.speed_m_s, LEAST_SPEED_M_S)
    return 4.0 * damping * damping * speed * speed / (damping * period_s * speed / pi) * sin(clipped(nu, 0.5 * pi))


def circle_demand(seen: Around, side: int, radius_m: float, period_s: float, damping: float) -> float:
    """Acceleration to the right that follows a circle clockwise (side +1) or counter-clockwise (-1).

    Centripetal, and proportional and derivative on the distance from the circle with w = 2 pi/T: w^2 and 2 damping w.
    """
    omega = 2.0 * pi / period_s
    forward = side * seen.clockwise_m_s
    correction = omega * omega * (seen.distance_m - radius_m) + 2.0 * damping * omega * seen.outward_m_s
    if seen.outward_m_s > 0.0 and forward < 0.0:
        # Flying away and the wrong way round: it must not turn further out.
        correction = max(correction, 0.0)
    return side * (correction + forward * forward / max(0.5 * radius_m, seen.distance_m))


class L1(Follower):
    """The L1 loiter law with ArduPilot's gains; over the ground in wind, with the velocity over the ground.

    `period_s` and `damping` are NAVL1_PERIOD and NAVL1_DAMPING, which its guide says to set to the aircraft:
    `advised_period_s`. Raises as `Follower`, and `InvalidArgument` for what is not positive.
    """

    def __init__(
        self,
        orbit: Orbit,
        aircraft: Aircraft,
        wind: Wind | None = None,
        *,
        period_s: float = PERIOD_S,
        damping: float = DAMPING,
    ) -> None:
        super().__init__(orbit, aircraft, wind)
        self.period_s, self.damping = positive("period_s", period_s, "seconds"), positive("damping", damping, "one")
        self._nu = 0.0

    def _demand(self, state: State) -> Demand:
        seen, side, R = self._around(state), self._side, self.orbit.radius_m
        self._nu = self._decided(centre_angle(seen), seen, state)
        capture = capture_demand(seen, self._nu, self.period_s, self.damping)
        circle = circle_demand(seen, side, R, self.period_s, self.damping)
        right = capture if seen.distance_m > R and side * capture < side * circle else circle
        return Demand(right, phase_of(right, seen, side, R))

    def _decided(self, nu: float, seen: Around, state: State) -> float:
        """nu, or the last one where it changed its side while the aircraft flies away from the centre."""
        east, north = heading_vector(state.heading_deg)
        away = east * seen.out_east + north * seen.out_north > OUTWARD
        return self._nu if away and min(abs(nu), abs(self._nu)) > AWAY and nu * self._nu < 0.0 else nu
