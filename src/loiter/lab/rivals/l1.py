"""The L1 loiter law: flown by ArduPilot, and for years by PX4.

S. Park, J. Deyst and J. P. How, "A New Nonlinear Guidance Logic for Trajectory Tracking", AIAA 2004-4900, steers
towards a point of the path at the distance L1 ahead, with the lateral acceleration 2 V^2 sin(eta)/L1. The autopilots'
form (ArduPilot, AP_L1_Control, `update_loiter`; PX4, ECL_L1_Pos_Controller, `navigate_loiter`) tunes that loop by a
period and a damping: outside the circle it steers towards the centre, and switches to a proportional-derivative law
about the circle where both demand the same acceleration.
"""

from __future__ import annotations

from math import atan2, cos, pi, radians, sin

from loiter.errors import positive
from loiter.guidance.circle import CircleOffset, circle_offset
from loiter.guidance.protocol import State
from loiter.guidance.vehicle import clip
from loiter.lab.rivals.following import Demand, Follower, demand_phase
from loiter.planning.compass import heading_vector
from loiter.planning.model import Aircraft, Orbit, Wind

# ArduPilot's NAVL1_PERIOD, seconds, and NAVL1_DAMPING.
PERIOD_S, DAMPING = 17.0, 0.75

# The shortest period of ArduPilot's guide, for very agile aircraft.
SHORTEST_PERIOD_S = 10.0

# The loop of period T, with w = 2 pi/T and a roll time constant tau, is stable for w tau < 2 damping, and reaches the
# chosen damping for w tau << 1. A search over T for three aircraft found the fastest settling near this value of w tau
# (docs/jsbsim.md).
FREQUENCY_TIMES_LAG = 0.2

# The least ground speed that ArduPilot uses, metres per second.
LEAST_SPEED_M_S = 1.0

# An aircraft flies away from the centre if its course is within 18 degrees and its heading within 60 degrees of the
# direction outward. Meanwhile the law keeps the side to which it turns.
AWAY_ANGLE, AWAY_HEADING_COS = 0.9 * pi, cos(radians(60.0))


def advised_period_s(roll_time_s: float) -> float:
    """The advised period, seconds, for a roll time constant.

    ArduPilot's guide advises 17 to 20 for most aircraft, 10 for very agile ones, more for slow ones. This is the
    shortest period at which the roll lag does not reduce the damping, but at least the shortest of that guide.
    """
    return max(SHORTEST_PERIOD_S, 2.0 * pi * roll_time_s / FREQUENCY_TIMES_LAG)


def centre_angle(offset: CircleOffset) -> float:
    """The angle nu from the velocity to the centre, radians, positive where the centre is on the right."""
    return atan2(offset.clockwise_m_s, -offset.outward_m_s)


def capture_demand(offset: CircleOffset, nu: float, period_s: float, damping: float) -> float:
    """Acceleration to the right, towards the centre: K V^2 sin(nu)/L1, K = 4 damping^2, L1 = damping T V/pi."""
    speed = max(offset.speed_m_s, LEAST_SPEED_M_S)
    return 4.0 * damping * damping * speed * speed / (damping * period_s * speed / pi) * sin(clip(nu, 0.5 * pi))


def circle_demand(offset: CircleOffset, side: int, period_s: float, damping: float) -> float:
    """Acceleration to the right that follows a circle clockwise (side +1) or counter-clockwise (-1).

    The centripetal acceleration, plus a proportional-derivative correction of the distance from the circle with the
    gains w^2 and 2 damping w, w = 2 pi/T.
    """
    omega = 2.0 * pi / period_s
    forward = side * offset.clockwise_m_s
    correction = omega * omega * offset.outside_m + 2.0 * damping * omega * offset.outward_m_s
    if offset.outward_m_s > 0.0 and forward < 0.0:
        # The aircraft flies outward in the wrong direction: the correction must not turn it further out.
        correction = max(correction, 0.0)
    return side * (correction + forward * forward / max(0.5 * offset.radius_m, offset.distance_m))


class L1(Follower):
    """The L1 loiter law with ArduPilot's gains. In wind it uses the velocity over the ground.

    `period_s` and `damping` are NAVL1_PERIOD and NAVL1_DAMPING, which ArduPilot's guide says to tune to the aircraft:
    `advised_period_s`. Raises the same as `Follower`, and `InvalidArgument` for values that are not positive.
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
        offset, side = circle_offset(state, self.orbit), self._side
        self._nu = self._steady_angle(centre_angle(offset), offset, state)
        capture = capture_demand(offset, self._nu, self.period_s, self.damping)
        circle = circle_demand(offset, side, self.period_s, self.damping)
        right = capture if offset.outside_m > 0.0 and side * capture < side * circle else circle
        return Demand(right, demand_phase(right, offset, side))

    def _steady_angle(self, nu: float, offset: CircleOffset, state: State) -> float:
        """nu, or its last value if its sign has changed while the aircraft flies away from the centre."""
        east, north = heading_vector(state.heading_deg)
        away = east * offset.out_east + north * offset.out_north > AWAY_HEADING_COS
        return self._nu if away and min(abs(nu), abs(self._nu)) > AWAY_ANGLE and nu * self._nu < 0.0 else nu
