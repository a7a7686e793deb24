"""The steady wind and errors of heading and airspeed, fitted to measurements, and whether the wind has changed."""

from __future__ import annotations

from math import degrees, exp, sqrt
from typing import NamedTuple

from loiter.guidance.protocol import State
from loiter.kernel.angles import length
from loiter.planning.compass import heading_vector

# The wind is the average of the air's velocity over the first time, seconds, at most. A declared wind counts as if it
# had been averaged over the second; without one the average begins with the first measurement.
WIND_MEMORY_S, DECLARED_WIND_S = 60.0, 30.0

# The wind has changed where the velocity of the air, averaged over the first time, seconds, differs from the estimated
# wind for the second time by more than the first share of the airspeed, and by more than the last multiple of what is
# usual. That is the root mean square difference over the third time, which begins with the second share. The average at
# the end of the second time is the change: at first the aircraft flies beside its nose, until it has turned into the
# new wind.
SWIFT_S, CHANGED_S, USUAL_S, CHANGED_SHARE, USUAL_SHARE, USUAL_MULTIPLE = 0.3, 1.5, 20.0, 0.2, 0.05, 2.5

# The heading bias, radians, and the share of the airspeed that is not measured count, before they show, as if they had
# been found to be 0, or what they were when the wind changed, with the first two standard deviations, from an air
# velocity with errors of the third, airspeeds, that are correlated over the fourth, seconds.
HEADING_BIAS_SPREAD, AIRSPEED_SPREAD, AIR_ERROR, AIR_ERROR_S = 0.06, 0.04, 0.05, 4.0


class WindChange(NamedTuple):
    """Whether the velocity of the air differs from the estimated wind, longer and more than gusts do.

    `since_s` is for how long that has been so, seconds. `swift_east_m_s` and `swift_north_m_s` are the difference
    averaged over `SWIFT_S`, and `usual_square` is the mean square that is usual, in airspeeds.
    """

    since_s: float
    swift_east_m_s: float
    swift_north_m_s: float
    usual_square: float


NO_CHANGE = WindChange(0.0, 0.0, 0.0, USUAL_SHARE * USUAL_SHARE)


def add_difference(
    change: WindChange, east_m_s: float, north_m_s: float, airspeed_m_s: float, dt: float
) -> tuple[WindChange, bool]:
    """The change with a difference, `dt` seconds after the last, and whether the wind has changed."""
    since_s, swift_east, swift_north, usual_square = change
    share = 1.0 - exp(-dt / SWIFT_S)
    swift_east, swift_north = (
        swift_east + share * (east_m_s - swift_east),
        swift_north + share * (north_m_s - swift_north),
    )
    off = length(swift_east, swift_north) / airspeed_m_s
    if off <= max(CHANGED_SHARE, USUAL_MULTIPLE * sqrt(usual_square)):
        usual_square += (1.0 - exp(-dt / USUAL_S)) * (off * off - usual_square)
        return WindChange(0.0, swift_east, swift_north, usual_square), False
    since_s += dt
    has_changed = since_s >= CHANGED_S
    return WindChange(0.0 if has_changed else since_s, swift_east, swift_north, usual_square), has_changed


class AirErrors(NamedTuple):
    """What measured headings exceed the true ones by, radians, and true airspeeds the measured ones, as a share."""

    heading: float
    airspeed: float


NO_ERRORS = AirErrors(0.0, 0.0)


class AirMeans(NamedTuple):
    """The means of the air's velocity, of the airspeed to the right of the heading, and of their products.

    `right` is the scalar product of both, `along` that with the airspeed along the heading.
    """

    east_m_s: float
    north_m_s: float
    right_east_m_s: float
    right_north_m_s: float
    right: float
    along: float
    square: float


class WindFit(NamedTuple):
    """The steady wind and the errors of heading and airspeed, which look like a wind that turns with the aircraft.

    The velocity over the ground less the airspeed along the heading is w + a h - b n, with the wind w, the measured
    airspeed h along the heading and n to its right, the error a of the airspeed and b of the heading. Least squares
    over up to `WIND_MEMORY_S`: while the heading is constant all of it counts as wind. `known_s` is for how long the
    means are known, and `expected` the errors that count before they show.
    """

    east_m_s: float
    north_m_s: float
    errors: AirErrors
    expected: AirErrors
    known_s: float
    means: AirMeans
    change: WindChange


def first_wind(east_m_s: float, north_m_s: float, known_s: float) -> WindFit:
    """The fit before a measurement."""
    means = AirMeans(east_m_s, north_m_s, 0.0, 0.0, 0.0, 0.0, 0.0)
    return WindFit(east_m_s, north_m_s, NO_ERRORS, NO_ERRORS, known_s, means, NO_CHANGE)


def is_changing(wind: WindFit) -> bool:
    """Whether the last measurements differ from the wind as if it had changed."""
    return wind.change.since_s > 0.0


def add_air_velocity(wind: WindFit, state: State, off: float, removed_deg: float, dt: float) -> WindFit:
    """The fit with a state whose heading was corrected by `removed_deg`; the flight is `off` radians to its right."""
    dt, V = max(dt, 1e-3), state.airspeed_m_s
    c, s = heading_vector(state.heading_deg + removed_deg + degrees(off))
    right_east, right_north = V * s, -V * c
    east, north = state.velocity_east_m_s - V * c, state.velocity_north_m_s - V * s
    wind_east, wind_north, errors, expected, known_s, means, change = wind
    if known_s > 0.0:
        true_east, true_north = without_errors(errors, east, north, right_east, right_north)
        change, has_changed = add_difference(change, true_east - wind_east, true_north - wind_north, V, dt)
        if has_changed:
            means, known_s = shift_means(means, change.swift_east_m_s, change.swift_north_m_s), SWIFT_S
            expected, change = errors, WindChange(0.0, 0.0, 0.0, change.usual_square)
        if change.since_s > 0.0:
            return WindFit(wind_east, wind_north, errors, expected, known_s, means, change)
    known_s = min(known_s + dt, WIND_MEMORY_S)
    right, along = right_east * east + right_north * north, right_east * north - right_north * east
    means = update_means(
        means, AirMeans(east, north, right_east, right_north, right, along, V * V), min(dt / known_s, 1.0)
    )
    errors = air_errors(means, expected, AIR_ERROR * AIR_ERROR * V * V * AIR_ERROR_S / known_s)
    wind_east, wind_north = without_errors(
        errors, means.east_m_s, means.north_m_s, means.right_east_m_s, means.right_north_m_s
    )
    return WindFit(wind_east, wind_north, errors, expected, known_s, means, change)


def without_errors(
    errors: AirErrors, east_m_s: float, north_m_s: float, right_east_m_s: float, right_north_m_s: float
) -> tuple[float, float]:
    """The velocity of the air without the errors of heading and airspeed; `right` is the airspeed to the right."""
    return (
        east_m_s + errors.heading * right_east_m_s + errors.airspeed * right_north_m_s,
        north_m_s + errors.heading * right_north_m_s - errors.airspeed * right_east_m_s,
    )


def update_means(means: AirMeans, now: AirMeans, share: float) -> AirMeans:
    """The means, corrected by a share of their differences from the present values."""
    return AirMeans(
        means.east_m_s + share * (now.east_m_s - means.east_m_s),
        means.north_m_s + share * (now.north_m_s - means.north_m_s),
        means.right_east_m_s + share * (now.right_east_m_s - means.right_east_m_s),
        means.right_north_m_s + share * (now.right_north_m_s - means.right_north_m_s),
        means.right + share * (now.right - means.right),
        means.along + share * (now.along - means.along),
        means.square + share * (now.square - means.square),
    )


def air_errors(means: AirMeans, expected: AirErrors, variance: float) -> AirErrors:
    """The errors by least squares, where the mean velocity of the air has a variance, (m/s)^2."""
    east, north, right_east, right_north, right, along, square = means
    spread = square - right_east * right_east - right_north * right_north
    of_heading = variance / (HEADING_BIAS_SPREAD * HEADING_BIAS_SPREAD)
    of_airspeed = variance / (AIRSPEED_SPREAD * AIRSPEED_SPREAD)
    right, along = right - east * right_east - north * right_north, along - north * right_east + east * right_north
    return AirErrors(
        (of_heading * expected.heading - right) / (spread + of_heading),
        (of_airspeed * expected.airspeed + along) / (spread + of_airspeed),
    )


def shift_means(means: AirMeans, east_m_s: float, north_m_s: float) -> AirMeans:
    """The means as if the wind had always been as it is after a change by this velocity."""
    east, north, right_east, right_north, right, along, square = means
    right += east_m_s * right_east + north_m_s * right_north
    along += north_m_s * right_east - east_m_s * right_north
    return AirMeans(east + east_m_s, north + north_m_s, right_east, right_north, right, along, square)
