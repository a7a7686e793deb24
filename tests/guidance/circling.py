"""A simple aircraft for the circle-following laws: exact flow of the commanded bank, and its settling time."""

from math import atan2, degrees, hypot, nan, pi, radians, tan

from loiter import Aircraft, Orbit, Pose, Turn
from loiter.guidance.protocol import State
from loiter.kernel.motion import fly
from loiter.lab.rivals.following import Follower
from loiter.planning.compass import heading_vector
from loiter.planning.model import STANDARD_GRAVITY_M_S2

STEP_S = 0.05

# The settling band: within 5 % of the radius and 5 degrees of the tangent, in the right direction.
NEAR, ALONG = 0.05, radians(5.0)


def state_of(time_s, east, north, c, s, uav, wind=(0.0, 0.0)):
    """The state of an aircraft that heads along (c, s)."""
    V = uav.airspeed_m_s
    return State(time_s, east, north, degrees(atan2(c, s)), 0.0, V * c + wind[0], V * s + wind[1], V)


def next_state(state: State, bank_deg: float, uav: Aircraft, wind=(0.0, 0.0)) -> State:
    """The state one step later."""
    V, rate = uav.airspeed_m_s, STANDARD_GRAVITY_M_S2 * tan(radians(bank_deg)) / uav.airspeed_m_s
    r = V / max(abs(rate), 1e-9)
    u = (rate < 0.0) - (rate > 0.0)
    x, y = state.east_m / r, state.north_m / r
    x, y, c, s = fly(x, y, *heading_vector(state.heading_deg), u, V * STEP_S / r)
    return state_of(state.time_s + STEP_S, x * r + wind[0] * STEP_S, y * r + wind[1] * STEP_S, c, s, uav, wind)


def is_in_band(state: State, orbit: Orbit, turn: Turn) -> bool:
    """Whether a state is within the settling band."""
    orbit = orbit.after(state.time_s)
    east, north = state.east_m - orbit.east_m, state.north_m - orbit.north_m
    d, side = hypot(east, north), 1.0 if turn == Turn.CW else -1.0
    ve, vn = state.velocity_east_m_s - orbit.velocity_east_m_s, state.velocity_north_m_s - orbit.velocity_north_m_s
    out, round_ = ve * east + vn * north, side * (ve * north - vn * east)
    return abs(d - orbit.radius_m) <= NEAR * orbit.radius_m and abs(atan2(out, round_)) <= ALONG


def settled_s(law: Follower, pose: Pose, uav: Aircraft, wind=(0.0, 0.0), limit_s=600.0) -> float:
    """The time at which a law settles on its circle for a full turn; nan if it does not settle within the limit."""
    state = state_of(0.0, pose.east_m, pose.north_m, *heading_vector(pose.heading_deg), uav, wind)
    since = nan
    while state.time_s < limit_s:
        command = law.step(state, STEP_S)
        assert abs(command.bank_deg) <= uav.bank_deg(uav.turn_radius_m)
        state = next_state(state, command.bank_deg, uav, wind)
        if not is_in_band(state, law.orbit, law.turn):
            since = nan
        elif since != since:
            since = state.time_s
        # A full turn over the ground takes at most this time, at the speed against the wind.
        elif state.time_s - since > 2.0 * pi * law.orbit.radius_m / (uav.airspeed_m_s - hypot(*wind)):
            return since
    return nan
