"""Tracking of the plan: feedforward of the path's turn rate, and damped corrections of course and crosstrack errors.

Offsets and rates are in any units that fit each other: metres and seconds, or those of the kernel. Angles are radians,
counter-clockwise.
"""

from __future__ import annotations

from loiter.guidance.entry.limits import Limits, Settings
from loiter.guidance.entry.plan import HEAVY_GUSTS, Planning
from loiter.guidance.entry.route import PathOffset, is_holding, path_velocity
from loiter.guidance.estimation.observer import Observer, Sensing, along_roughness, roughness
from loiter.guidance.vehicle import VehicleEstimates, bank_at_rate, clip
from loiter.kernel.angles import length
from loiter.kernel.words import ABSENT

# The steepest intercept angle onto a path, radians: a vehicle far off turns towards the path, not all the way round.
STEEPEST_INTERCEPT = 0.6

# The gains of course and crosstrack corrections, to be divided by the response time: the delay of a change of bank plus
# the averaging time. A faster correction of crosstrack errors would need an intercept angle of several degrees.
GAIN, PLACE_GAIN = 4.0, 0.25

# In calm air the gain of course corrections falls to this share: only noise would be corrected. The air is rough where
# gusts change the course by this angle in a second, radians (root mean square).
CALM_GAIN, ROUGH_AIR = 0.75, 0.02

# On the circle it falls so far that course errors are corrected at this rate, 1/s, or at this multiple of that at which
# crosstrack errors are, but not below the last share. It rises with the square of the gusts, to the whole where they
# change the course by `ROUGH_HOLD` in a second. A vehicle that turns more quickly than its bank says where that changes
# would swing about the circle otherwise.
HOLD_RATE, HOLD_MULTIPLE, CALM_HOLD_GAIN, ROUGH_HOLD = 1.3, 6.0, 0.35, 0.02

# In heavy gusts it rises in proportion to them, up to this multiple.
HEAVY_GAIN = 1.5

# On the circle crosstrack errors are corrected over an arc of 1/HOLD_GAIN radians, so that the intercept angle depends
# only on the ratio of the error to the radius.
HOLD_GAIN = 1.2

# There the part of a crosstrack error beyond this, radii, counts twice in calm air, so that the aircraft returns more
# steeply; in rough air, as for `ROUGH_HOLD`, it counts once.
STEEP_OFFSET = 0.035

# On the circle the mean crosstrack error is driven to zero by a correction of the rate of turn: at this share of the
# gain of course corrections, but no more than the second number, 1/s, which suits gusts. It is at most the third share
# of the circle's rate of turn, and changes only while the error is less than the fourth, in radii.
TRIM_GAIN, LARGEST_TRIM_GAIN, LARGEST_TRIM, TRIMMED_OFFSET = 0.25, 0.4, 0.15, 0.05


def target_bank(
    trim: float,
    settings: Settings,
    limits: Limits,
    sensing: Sensing,
    planning: Planning,
    known: VehicleEstimates,
    dt: float,
) -> tuple[float, float]:
    """The bank that follows the route, and the trim; on a turn before the last piece it is the bank limit.

    Such a turn is planned again before it ends, unless the path is given; flying it as wide as planned would only cost
    time.
    """
    route, observer, u = planning.plan.route, sensing.observer, planning.plan.route.current.u
    if u != 0 and route.second.u != ABSENT and planning.path.total == 0:
        return -u * limits.limit_deg, trim
    state, offset, _ = planning.response
    vx, vy = path_velocity(route, state)
    speed, R, V, holding = length(vx, vy), settings.radius_m, limits.turns.airspeed_m_s, is_holding(route)
    response_s = limits.lag_s + observer.smoothing_s
    gain = corrections_gain(settings, known, observer, response_s, V / R, holding)
    bandwidth = 1.0 / (response_s + gain * dt)
    place_gain = HOLD_GAIN * speed / R if holding else PLACE_GAIN * bandwidth
    followed = steep_offset(offset, R, along_roughness(observer)) if holding else offset
    course = course_rate(followed, gain * bandwidth, place_gain, speed)
    if holding:
        trim = next_trim(settings, trim, offset.crosstrack, gain * bandwidth, V, dt)
        course -= trim
    rate = -air_rate(course, vx, vy, state.hx, state.hy)
    # At the present airspeed, which differs from the mean one where an autopilot holds it less exactly.
    return bank_at_rate(rate / known.turn_ratio, length(state.hx, state.hy)), trim


def steep_offset(offset: PathOffset, radius_m: float, rough: float) -> PathOffset:
    """The offset from the circle to correct, in air of this roughness: a large crosstrack error counts for more."""
    beyond_m = offset.crosstrack - clip(offset.crosstrack, STEEP_OFFSET * radius_m)
    calm = max(1.0 - rough / ROUGH_HOLD, 0.0)
    return offset._replace(crosstrack=offset.crosstrack + calm * beyond_m)


def corrections_gain(
    settings: Settings, known: VehicleEstimates, observer: Observer, response_s: float, turn_rate: float, holding: bool
) -> float:
    """The gain of course corrections in the present air; on the circle, which turns at `turn_rate`, it is smaller.

    It is larger in heavy gusts, and smaller where quick turns are quicker than the bank says.
    """
    gain = settings.gain
    if holding:
        rough = along_roughness(observer)
        calm_rate = max(HOLD_RATE, HOLD_MULTIPLE * HOLD_GAIN * turn_rate)
        calm_share = max(min(calm_rate * response_s / gain, CALM_GAIN), CALM_HOLD_GAIN)
        share = max(min((rough / ROUGH_HOLD) * (rough / ROUGH_HOLD), 1.0), calm_share)
    else:
        rough = roughness(observer)
        share = max(min(rough / ROUGH_AIR, 1.0), CALM_GAIN)
    lively = max(known.quick_turn_ratio / known.turn_ratio, 1.0)
    return gain * max(share, min(rough / HEAVY_GUSTS, HEAVY_GAIN)) / lively


def next_trim(settings: Settings, trim: float, crosstrack: float, course_gain: float, V: float, dt: float) -> float:
    """The correction of the rate of turn on the circle after another step, radians per second."""
    R, turn_rate = settings.radius_m, V / settings.radius_m
    if abs(crosstrack) >= TRIMMED_OFFSET * R:
        return trim
    place_gain = HOLD_GAIN * turn_rate
    integral_gain = min(TRIM_GAIN * course_gain, LARGEST_TRIM_GAIN) * place_gain * place_gain / V
    return clip(trim + integral_gain * crosstrack * dt, LARGEST_TRIM * turn_rate)


def course_rate(offset: PathOffset, course_gain: float, place_gain: float, speed: float) -> float:
    """The rate at which the course should turn to reach a path and stay on it.

    With the crosstrack error e, the course error b and small angles, e' = speed b, and b is driven towards
    -`place_gain` e/speed with the gain `course_gain`: e'' + course_gain (e' + place_gain e) = 0. There is no overshoot
    if `course_gain` is at least four times `place_gain`.
    """
    intercept = clip(-place_gain * offset.crosstrack / speed, STEEPEST_INTERCEPT)
    return offset.path_rate - course_gain * (offset.course_error - intercept)


def air_rate(rate: float, vx: float, vy: float, hx: float, hy: float) -> float:
    """The turn rate through the air, for the heading (hx, hy), that turns the velocity (vx, vy) at `rate`.

    A turn at the rate w with the airspeed a accelerates the vehicle by a w across its heading. The component
    a w cos(crab) turns a velocity of the size v at the rate a w cos(crab)/v. On the circle this is equation (3) of
    docs/wind.md, `hold.hold_rate`.
    """
    return rate * (vx * vx + vy * vy) / (hx * vx + hy * vy)
