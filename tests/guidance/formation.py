"""A published law for circular formations, as a rival, after the equations of the paper.

H. G. de Marina, Z. Sun, M. Bronz and G. Hattenberger, "Circular formation control of fixed-wing UAVs with constant
speeds", IROS 2017.

Each aircraft follows a vector field onto a circle of its own. With phi = |p|^2/r^2 - 1, n its gradient and t the
tangent in the direction of the hold, the field points along t - k_e phi n; the course turns with the field and is drawn
to it at the rate k_n. The radius is r = R + k sum(e), where e are the errors of the phases between an aircraft and its
two neighbours: who is ahead of its place flies a wider circle, and falls back. The gains are those of their
autopilot: k_e = k_n = 1, and k = 10 m at a radius of 80 m, which is R/8.
"""

from __future__ import annotations

from math import atan, atan2, cos, degrees, hypot, pi, remainder, sin, tau

K_E, K_N, K_RADIUS = 1.0, 1.0, 1.0 / 8.0
GRAVITY = 9.80665


def radius_m(phases, i, orbit_m):
    """The radius of aircraft i of a closed chain whose phases, along the hold, should be a whole turn over n apart."""
    n = len(phases)
    ahead = remainder(phases[(i + 1) % n] - phases[i] - tau / n, tau)
    behind = remainder(phases[i] - phases[i - 1] - tau / n, tau)
    return orbit_m + K_RADIUS * orbit_m * (behind - ahead)


def bank_deg(state, side, r, limit_deg):
    """The bank, positive to the right, that turns an aircraft along the field of the circle of radius r."""
    x, y, vx, vy = state.east_m, state.north_m, state.velocity_east_m_s, state.velocity_north_m_s

    def field(east, north):
        excess = (east * east + north * north) / (r * r) - 1.0
        return atan2(-side * east - K_E * excess * north, side * north - K_E * excess * east)

    # How fast the field turns along the flight, by a difference.
    h = 1e-4
    turning = remainder(field(x + h * vx, y + h * vy) - field(x - h * vx, y - h * vy), tau) / (2.0 * h)
    off = remainder(field(x, y) - atan2(vy, vx), tau)
    rate = turning + K_N * sin(off) if abs(off) < 0.5 * pi else turning + K_N * (1.0 if off > 0.0 else -1.0)
    speed = hypot(vx, vy)
    return max(min(degrees(atan(-rate * speed / GRAVITY)), limit_deg), -limit_deg)


def phase_along(east_m, north_m, side):
    """The angle along the direction of the hold, radians."""
    return -side * atan2(north_m, east_m)


def place(phase, side, r):
    """The place at a phase: the inverse of `phase_along`."""
    return r * cos(phase), -side * r * sin(phase)
