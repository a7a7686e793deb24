"""The steady wind and the heading bias, fitted to measurements, and whether the wind has changed."""

from __future__ import annotations

from math import degrees, exp, radians, sqrt
from typing import NamedTuple

from loiter.guidance.protocol import State
from loiter.kernel.angles import length
from loiter.planning.compass import heading_vector

# The wind is the average of the air's velocity over the first time, seconds, at most. A declared wind counts as if it
# had been averaged over the second; without one the average begins with the first measurement.
WIND_MEMORY_S, DECLARED_WIND_S = 60.0, 30.0

# The wind has changed where the velocity of the air, averaged over the first time, seconds, differs from the estimated
# wind for the second time by more than the first share of the airspeed, and by more than the last multiple of what is
# usual. That is the root mean square difference over the third time, which begins with the second share.
SWIFT_S, CHANGED_S, USUAL_S, CHANGED_SHARE, USUAL_SHARE, USUAL_MULTIPLE = 0.3, 1.5, 20.0, 0.2, 0.05, 2.5

# The heading bias counts, before it shows, as if it had been measured to be 0 with the first standard deviation,
# radians, from an air velocity with errors of the second, airspeeds, that are correlated over the third, seconds.
HEADING_BIAS_SPREAD, AIR_ERROR, AIR_ERROR_S = 0.06, 0.05, 4.0


class WindChange(NamedTuple):
    """Whether the velocity of the air differs from the estimated wind, longer and more than gusts do.

    `since_s` is for how long that has been so, seconds, `mean_east_m_s` and `mean_north_m_s` the mean difference since
    then. `swift_east_m_s` and `swift_north_m_s` are the difference averaged over `SWIFT_S`, and `usual_square` is the
    mean square that is usual, in airspeeds.
    """

    since_s: float
    mean_east_m_s: float
    mean_north_m_s: float
    swift_east_m_s: float
    swift_north_m_s: float
    usual_square: float


NO_CHANGE = WindChange(0.0, 0.0, 0.0, 0.0, 0.0, USUAL_SHARE * USUAL_SHARE)


def add_difference(
    change: WindChange, east_m_s: float, north_m_s: float, airspeed_m_s: float, dt: float
) -> tuple[WindChange, bool]:
    """The change with a difference, `dt` seconds after the last, and whether the wind has changed."""
    since_s, mean_east, mean_north, swift_east, swift_north, usual_square = change
    share = 1.0 - exp(-dt / SWIFT_S)
    swift_east, swift_north = (
        swift_east + share * (east_m_s - swift_east),
        swift_north + share * (north_m_s - swift_north),
    )
    off = length(swift_east, swift_north) / airspeed_m_s
    if off <= max(CHANGED_SHARE, USUAL_MULTIPLE * sqrt(usual_square)):
        usual_square += (1.0 - exp(-dt / USUAL_S)) * (off * off - usual_square)
        return WindChange(0.0, mean_east, mean_north, swift_east, swift_north, usual_square), False
    since_s += dt
    share = min(dt / since_s, 1.0)
    mean_east, mean_north = mean_east + share * (east_m_s - mean_east), mean_north + share * (north_m_s - mean_north)
    if since_s < CHANGED_S:
        return WindChange(since_s, mean_east, mean_north, swift_east, swift_north, usual_square), False
    return WindChange(0.0, mean_east, mean_north, 0.0, 0.0, usual_square), True


class AirMeans(NamedTuple):
    """The means of the air's velocity, of the airspeed to the right of the heading, and of their products."""

    east_m_s: float
    north_m_s: float
    right_east_m_s: float
    right_north_m_s: float
    product: float
    square: float


class WindFit(NamedTuple):
    """The steady wind and the heading bias: an airspeed along wrong headings looks like a wind that turns with them.

    The velocity over the ground less the airspeed along the heading is w - b n, with the wind w, the bias b to the
    right and n, the airspeed to the right of the heading. Least squares over up to `WIND_MEMORY_S`: while n is constant
    all of it counts as wind, and the bias is 0. `known_s` is for how long the means are known.
    """

    east_m_s: float
    north_m_s: float
    heading_bias_deg: float
    known_s: float
    means: AirMeans
    change: WindChange


def first_wind(east_m_s: float, north_m_s: float, known_s: float) -> WindFit:
    """The fit before a measurement."""
    return WindFit(east_m_s, north_m_s, 0.0, known_s, AirMeans(east_m_s, north_m_s, 0.0, 0.0, 0.0, 0.0), NO_CHANGE)


def is_changing(wind: WindFit) -> bool:
    """Whether the last measurements differ from the wind as if it had changed."""
    return wind.change.since_s > 0.0


def add_air_velocity(wind: WindFit, state: State, off: float, removed_deg: float, dt: float) -> WindFit:
    """The fit with a state whose heading was corrected by `removed_deg`; the flight is `off` radians to its right."""
    dt, V = max(dt, 1e-3), state.airspeed_m_s
    c, s = heading_vector(state.heading_deg + removed_deg + degrees(off))
    right_east, right_north = V * s, -V * c
    east, north = state.velocity_east_m_s - V * c, state.velocity_north_m_s - V * s
    wind_east, wind_north, bias_deg, known_s, means, change = wind
    if known_s > 0.0:
        bias = radians(bias_deg)
        off_east, off_north = east + bias * right_east - wind_east, north + bias * right_north - wind_north
        change, has_changed = add_difference(change, off_east, off_north, V, dt)
        if has_changed:
            means, known_s = shift_means(means, change.mean_east_m_s, change.mean_north_m_s), CHANGED_S
        if change.since_s > 0.0:
            return WindFit(wind_east, wind_north, bias_deg, known_s, means, change)
    known_s = min(known_s + dt, WIND_MEMORY_S)
    means = update_means(
        means,
        AirMeans(east, north, right_east, right_north, right_east * east + right_north * north, V * V),
        min(dt / known_s, 1.0),
    )
    prior = AIR_ERROR * V / HEADING_BIAS_SPREAD
    bias = heading_bias(means, prior * prior * AIR_ERROR_S / known_s)
    wind_east, wind_north = means.east_m_s + bias * means.right_east_m_s, means.north_m_s + bias * means.right_north_m_s
    return WindFit(wind_east, wind_north, degrees(bias), known_s, means, change)


def update_means(means: AirMeans, now: AirMeans, share: float) -> AirMeans:
    """The means, corrected by a share of their differences from the present values."""
    return AirMeans(
        means.east_m_s + share * (now.east_m_s - means.east_m_s),
        means.north_m_s + share * (now.north_m_s - means.north_m_s),
        means.right_east_m_s + share * (now.right_east_m_s - means.right_east_m_s),
        means.right_north_m_s + share * (now.right_north_m_s - means.right_north_m_s),
        means.product + share * (now.product - means.product),
        means.square + share * (now.square - means.square),
    )


def heading_bias(means: AirMeans, prior: float) -> float:
    """The heading bias, radians, by least squares; `prior` is how much a bias of 0 weighs, in (m/s)^2."""
    east, north, right_east, right_north, product, square = means
    spread = square - right_east * right_east - right_north * right_north
    return -(product - east * right_east - north * right_north) / (spread + prior)


def shift_means(means: AirMeans, east_m_s: float, north_m_s: float) -> AirMeans:
    """The means as if the wind had always been as it is after a change by this velocity."""
    east, north, right_east, right_north, product, square = means
    product += east_m_s * right_east + north_m_s * right_north
    return AirMeans(east + east_m_s, north + north_m_s, right_east, right_north, product, square)
