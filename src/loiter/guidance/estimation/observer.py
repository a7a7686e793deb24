"""State estimation for the law: measurements smoothed without lag, and extrapolated to the present.

Stamps are checked first: a single one may be wrong, and a clock may restart. Measurements are old when they arrive: the
modelled bank over the last seconds says what they do not show yet.
"""

from __future__ import annotations

from math import cos, degrees, exp, inf, nan, sin, sqrt
from typing import Annotated, NamedTuple

from loiter.guidance.protocol import State
from loiter.guidance.vehicle import PlanarPose, VehicleModel, constant_turn, rate_at_bank, remove_bias
from loiter.kernel.angles import length
from loiter.planning.compass import heading_vector

# A stamp is accepted at once unless it is later by more than this, seconds, than the last one plus the time that has
# passed since. So a law that was not called for an hour continues at once.
LARGEST_GAP_S = 3600.0

# A clock that has jumped back, or further ahead, is accepted once its stamps have advanced by this, seconds. No single
# step between them may be larger: two stamps alone do not confirm a clock.
CONFIRMATION_S = 1.0


class Clock(NamedTuple):
    """The time stamp of the last accepted measurement, `time_s`, -inf before the first.

    `since_s` is the time that has passed since then, summed over the steps. `gap_s` is the time between the last two
    accepted measurements, and `jump_s` how far the clock jumped between them: 0 unless a new clock was accepted.
    `first_s` and `latest_s` are stamps of another clock, which is not accepted yet; nan where there is none.
    """

    time_s: float
    since_s: float
    gap_s: float
    jump_s: float
    first_s: float
    latest_s: float


FIRST_CLOCK = Clock(-inf, 0.0, inf, 0.0, nan, nan)


def advance_clock(clock: Clock, dt: float) -> Clock:
    """The clock `dt` seconds later."""
    time_s, since_s, gap_s, jump_s, first_s, latest_s = clock
    return Clock(time_s, since_s + dt, gap_s, jump_s, first_s, latest_s)


def check_stamp(clock: Clock, time_s: float) -> tuple[Clock, bool]:
    """The clock after a measurement at `time_s`, and whether that is a new one.

    It may be one by this clock, or by another that is confirmed by now.
    """
    ahead_s = time_s - clock.time_s
    if 0.0 < ahead_s <= clock.since_s + LARGEST_GAP_S or clock.time_s == -inf:
        return Clock(time_s, 0.0, ahead_s, 0.0, nan, nan), True
    # A stamp that does not fit the earlier ones of the other clock starts the count again.
    fits = clock.first_s <= time_s <= clock.latest_s + CONFIRMATION_S
    first_s, latest_s = (clock.first_s, max(clock.latest_s, time_s)) if fits else (time_s, time_s)
    if latest_s - first_s >= CONFIRMATION_S:
        return Clock(time_s, 0.0, clock.since_s, ahead_s - clock.since_s, nan, nan), True
    return Clock(clock.time_s, clock.since_s, clock.gap_s, clock.jump_s, first_s, latest_s), False


# The history covers at least this time, seconds, in this many entries.
COVERED_S, ENTRIES = 2.0, 128


class BankEntry(NamedTuple):
    """The end of a step, the bank then, and the integral of the bank up to then: seconds and degrees."""

    end_s: float
    bank_deg: float
    integral: float


class BankHistory(NamedTuple):
    """The last steps in a ring of fixed length, oldest first; unused entries end at -inf.

    Between the ends of steps the bank is interpolated.
    """

    entries: Annotated[tuple[BankEntry, ...], ENTRIES]


def constant_history(bank_deg: float) -> BankHistory:
    """The history of a bank that has always been this."""
    unused = (BankEntry(-inf, bank_deg, 0.0),) * ENTRIES
    return BankHistory((*unused[:-1], BankEntry(0.0, bank_deg, 0.0)))


def record_bank(history: BankHistory, bank_deg: float, dt: float, covered_s: float = COVERED_S) -> BankHistory:
    """The history with another step of `dt` seconds and the bank at its end; it covers at least `covered_s`.

    Once the ring is full, steps that are so short that it would not cover that time are joined: two entries that follow
    each other then last longer than twice that time divided by their number.
    """
    entries, dt = history.entries, min(dt, covered_s)
    last = entries[-1]
    entry = BankEntry(last.end_s + dt, bank_deg, last.integral + dt * 0.5 * (last.bank_deg + bank_deg))
    if entry.end_s - entries[-2].end_s > 2.0 * covered_s / ENTRIES or entries[0].end_s == -inf:
        return BankHistory((*entries[1:], entry))
    return BankHistory((*entries[:-1], entry))


def index_at(history: BankHistory, time_s: float) -> int:
    """The index of the first entry that ends at a time or later."""
    entries, low, high = history.entries, 0, ENTRIES - 1
    while low < high:
        middle = (low + high) >> 1
        if entries[middle].end_s < time_s:
            low = middle + 1
        else:
            high = middle
    return low


def bank_within(history: BankHistory, index: int, time_s: float) -> float:
    """The bank at a time within an entry, between those at its ends; before the first entry it was constant."""
    entry = history.entries[index]
    if index == 0:
        return entry.bank_deg
    before = history.entries[index - 1]
    if before.end_s == -inf or entry.end_s <= before.end_s:
        return entry.bank_deg
    return entry.bank_deg - (entry.end_s - time_s) / (entry.end_s - before.end_s) * (entry.bank_deg - before.bank_deg)


def present_deg(history: BankHistory) -> float:
    """The bank at the end of the last step."""
    return history.entries[-1].bank_deg


def delayed_deg(history: BankHistory, delay_s: float) -> float:
    """The bank `delay_s` seconds ago."""
    if delay_s <= 0.0:
        return present_deg(history)
    then_s = history.entries[-1].end_s - delay_s
    return bank_within(history, index_at(history, then_s), then_s)


def mean_deg(history: BankHistory, delay_s: float) -> float:
    """The mean bank over the last `delay_s` seconds."""
    if delay_s <= 0.0:
        return present_deg(history)
    last = history.entries[-1]
    then_s = last.end_s - delay_s
    index = index_at(history, then_s)
    first, bank_deg = history.entries[index], bank_within(history, index, then_s)
    return (last.integral - first.integral + (first.end_s - then_s) * 0.5 * (bank_deg + first.bank_deg)) / delay_s


# Until the next measurement arrives the last one is extrapolated, but no longer than this, seconds; older ones are not
# averaged with new ones.
EXTRAPOLATED_S = 3.0

# How fast the velocity of the air changes is measured from its differences over this time, seconds, averaged over the
# second time.
GUST_LAG_S, GUST_AVERAGE_S = 1.0, 10.0

# What is assumed until then, as if it had been measured for the last time, seconds: gusts of about 10 % of the
# airspeed, as the mean square change of each component in a second, and noise of 0.4 m/s; (m/s)^2.
FIRST_GUST, FIRST_NOISE, ASSUMED_S = 0.6, 0.16, 1.0

# On the circle gusts are measured anew, as if none had been measured for the first time, seconds. Differences over
# which the turn rate changes by the second, radians per second, count half: the slip changes with it, like a gust.
CALM_S, TURN_CHANGE = 3.0, 0.1

# In calm air, where gusts turn the course by less than `CALM_COURSE` in a second, radians, only noise is left: averages
# take longer, up to this multiple. They have at least this many measurements; of their mean interval each is this
# share, and a longer one, seconds, counts as that.
CALM_COURSE, CALM_MULTIPLE, LEAST_COUNT, INTERVAL_SHARE, LONGEST_INTERVAL_S = 0.02, 1.6, 5.0, 0.05, 0.3

# Bounds of a plausible measurement: the largest value in metres, degrees or metres per second, the least airspeed.
LARGEST_VALUE, LEAST_AIRSPEED_M_S = 1e9, 0.1

# The largest plausible time stamp, seconds: 32,000 years, where a double still resolves a tenth of a millisecond.
LATEST_S = 1e12


class Turning(NamedTuple):
    """How a vehicle turns: its turn rate divided by that of a coordinated turn, and how far it flies beside its nose.

    In a turn the direction of flight is ahead of the heading by `lead_s` times the turn rate: the vehicle slips, or its
    velocity is measured later than its attitude (then the lead is negative).
    """

    ratio: float
    lead_s: float


COORDINATED = Turning(1.0, 0.0)


def turn_rate_at(turning: Turning, bank_deg: float, airspeed_m_s: float) -> float:
    """The turn rate at a bank, radians per second, positive to the left."""
    return -turning.ratio * rate_at_bank(bank_deg, airspeed_m_s)


class Estimate(NamedTuple):
    """The estimated motion: pose, airspeed, turn rate through the air, bank, and the velocity of the air.

    The pose has the direction of flight through the air. The turn rate is in radians per second, positive to the left;
    bank is positive to the right. `turning` relates bank, turn rate and the heading of the nose. Before the first
    measurement the airspeed is 0.
    """

    time_s: float
    pose: PlanarPose
    airspeed_m_s: float
    turn_rate: float
    bank_deg: float
    air_east_m_s: float
    air_north_m_s: float
    turning: Turning


NO_ESTIMATE = Estimate(-inf, PlanarPose(0.0, 0.0, 1.0, 0.0), 0.0, 0.0, 0.0, 0.0, 0.0, COORDINATED)


def estimate_after(estimate: Estimate, time_s: float) -> Estimate:
    """The estimate `time_s` seconds later, with constant bank in a constant wind."""
    then_s, pose, V, turn_rate, bank_deg, east, north, turning = estimate
    pose = constant_turn(pose, V, turn_rate, time_s, (east, north))
    return Estimate(then_s + time_s, pose, V, turn_rate, bank_deg, east, north, turning)


def estimate_with_bank(estimate: Estimate, bank_deg: float) -> Estimate:
    """The estimate with another bank, which also changes the direction of flight if the vehicle slips."""
    time_s, pose, V, last_rate, _, east, north, turning = estimate
    turn_rate = turn_rate_at(turning, bank_deg, V)
    pose = _rotated(pose, turning.lead_s * (turn_rate - last_rate))
    return Estimate(time_s, pose, V, turn_rate, bank_deg, east, north, turning)


def estimate_at_present(estimate: Estimate, history: BankHistory, delay_s: float) -> Estimate:
    """The estimate extrapolated over the measurement delay, with the banks modelled since then."""
    time_s, pose, V, last_rate, bank_deg, east, north, turning = estimate
    error_deg = bank_deg - delayed_deg(history, delay_s)
    mean_rate = turn_rate_at(turning, mean_deg(history, delay_s) + error_deg, V)
    now_deg = present_deg(history) + error_deg
    present_rate = turn_rate_at(turning, now_deg, V)
    # The slip changes with the turn rate, and with it the direction of flight.
    pose = _rotated(pose, turning.lead_s * (mean_rate - last_rate))
    pose = constant_turn(pose, V, mean_rate, delay_s, (east, north))
    pose = _rotated(pose, turning.lead_s * (present_rate - mean_rate))
    return Estimate(time_s + delay_s, pose, V, present_rate, now_deg, east, north, turning)


def is_plausible(state: State) -> bool:
    """Whether the time of a measurement is within `LATEST_S`, and all other numbers together within `LARGEST_VALUE`."""
    time_s, east, north, heading, bank, velocity_east, velocity_north, airspeed = state
    position, angles = abs(east) + abs(north), abs(heading) + abs(bank)
    size = position + angles + abs(velocity_east) + abs(velocity_north) + abs(airspeed)
    # Neither comparison holds for nan.
    return abs(time_s) < LATEST_S and size < LARGEST_VALUE


def is_usable(state: State) -> bool:
    """Whether a measurement is plausible and of an aircraft in flight, faster than `LEAST_AIRSPEED_M_S`."""
    return is_plausible(state) and state.airspeed_m_s > LEAST_AIRSPEED_M_S


# The ring of the last measurements. Where it would not cover the lag, those that follow each other sooner than this,
# seconds, are left out.
SAMPLES = 64
SAMPLE_GAP_S = GUST_LAG_S / (SAMPLES - 2)


class AirSample(NamedTuple):
    """A measured velocity of the air, and the turn rate then; seconds, metres and radians per second."""

    time_s: float
    east_m_s: float
    north_m_s: float
    turn_rate: float


class Difference(NamedTuple):
    """The mean time between measurements, and the mean square difference of each component."""

    time_s: float
    square: float


class AlongFlight(NamedTuple):
    """The mean square differences along the flight of neighbours and over `GUST_LAG_S`, and for how long measured."""

    near_square: float
    far_square: float
    known_s: float


CALM_ALONG = AlongFlight(0.0, 0.0, CALM_S)


class AirMotion(NamedTuple):
    """The direction of flight (c, s), a unit vector, and the turn rate, radians per second."""

    c: float
    s: float
    turn_rate: float


STRAIGHT_ON = AirMotion(1.0, 0.0, 0.0)


class AirAverage(NamedTuple):
    """The velocity of the air, averaged over the time that suits its gusts and the noise of the measurements.

    The air is taken as a random walk, the noise as white. The mean square difference of measurements a time t apart is
    then 2 noise + gust t. From that of neighbours, `near`, and that over `GUST_LAG_S`, `far`, both are known, and the
    best average is that of the Kalman filter: exponential over sqrt(noise dt/gust) seconds, dt apart.

    `recent` is a ring of the last measurements, oldest first, of which `lag_index` is `GUST_LAG_S` old, or the first.
    `known_s` is for how long both means are known. `along` is what has been measured on the circle of the component
    along the flight, which no slip touches.
    """

    east_m_s: float
    north_m_s: float
    known_s: float
    near: Difference
    far: Difference
    along: AlongFlight
    recent: Annotated[tuple[AirSample, ...], SAMPLES]
    lag_index: int


def first_air() -> AirAverage:
    """The average before the first measurement."""
    near = Difference(0.02, 2.0 * FIRST_NOISE)
    far = Difference(GUST_LAG_S, 2.0 * FIRST_NOISE + FIRST_GUST * GUST_LAG_S)
    recent = (AirSample(0.0, 0.0, 0.0, 0.0),) * SAMPLES
    return AirAverage(0.0, 0.0, ASSUMED_S, near, far, CALM_ALONG, recent, SAMPLES - 2)


def restart_air(air: AirAverage, east_m_s: float, north_m_s: float) -> AirAverage:
    """The average restarted from a velocity; what is known of gusts and noise stays."""
    sample = AirSample(air.recent[-1].time_s, east_m_s, north_m_s, 0.0)
    recent = (sample,) * SAMPLES
    return AirAverage(east_m_s, north_m_s, air.known_s, air.near, air.far, air.along, recent, SAMPLES - 2)


def average_air(
    air: AirAverage, east_m_s: float, north_m_s: float, dt: float, longest_s: float, motion: AirMotion = STRAIGHT_ON
) -> AirAverage:
    """The average, over `longest_s` at most, including a velocity measured `dt` seconds after the last."""
    east, north, known_s, near, far, along, recent, lag_index = air
    now_s, known_s = recent[-1].time_s + dt, min(known_s + dt, GUST_AVERAGE_S)
    while lag_index < SAMPLES - 1 and now_s - recent[lag_index + 1].time_s >= GUST_LAG_S:
        lag_index += 1
    sample, weight = AirSample(now_s, east_m_s, north_m_s, motion.turn_rate), 1.0 - exp(-dt / known_s)
    along = _along(along, recent[-1], recent[lag_index], sample, motion, dt)
    near, far = _mean(near, recent[-1], sample, weight), _mean(far, recent[lag_index], sample, weight)
    if lag_index == 0 and recent[-1].time_s - recent[-2].time_s < SAMPLE_GAP_S:
        recent = (*recent[:-1], sample)
    else:
        recent, lag_index = (*recent[1:], sample), max(lag_index - 1, 0)
    averaging_s = _averaging_s(near, far, longest_s)
    share = 1.0 - exp(-dt / averaging_s) if averaging_s > 0.0 else 1.0
    east, north = east + share * (east_m_s - east), north + share * (north_m_s - north)
    return AirAverage(east, north, known_s, near, far, along, recent, lag_index)


def _mean(mean: Difference, before: AirSample, now: AirSample, weight: float) -> Difference:
    """A mean with the difference of two measurements."""
    time_s, square = mean
    east, north = now.east_m_s - before.east_m_s, now.north_m_s - before.north_m_s
    return Difference(
        time_s + weight * (now.time_s - before.time_s - time_s),
        square + weight * (0.5 * (east * east + north * north) - square),
    )


def _along(
    along: AlongFlight, last: AirSample, before: AirSample, now: AirSample, motion: AirMotion, dt: float
) -> AlongFlight:
    """The means along the flight with a measurement, the last one, and the one `GUST_LAG_S` before."""
    near_square, far_square, known_s = along
    change = (now.turn_rate - before.turn_rate) / TURN_CHANGE
    counted_s = dt / (1.0 + change * change)
    known_s = min(known_s + counted_s, GUST_AVERAGE_S)
    weight = counted_s / known_s
    near = motion.c * (now.east_m_s - last.east_m_s) + motion.s * (now.north_m_s - last.north_m_s)
    far = motion.c * (now.east_m_s - before.east_m_s) + motion.s * (now.north_m_s - before.north_m_s)
    return AlongFlight(
        near_square + weight * (near * near - near_square), far_square + weight * (far * far - far_square), known_s
    )


def gust(near: Difference, far: Difference) -> float:
    """The mean square change of each component of the air's velocity in a second, (m/s)^2."""
    return max(far.square - near.square, 0.0) / max(far.time_s - near.time_s, 0.1)


def _averaging_s(near: Difference, far: Difference, longest_s: float) -> float:
    """The averaging time that suits gusts and noise, `longest_s` at most."""
    change = gust(near, far)
    noise = max(near.square - change * near.time_s, 0.0) / 2.0
    if noise * near.time_s >= change * longest_s * longest_s:
        return longest_s
    return sqrt(noise * near.time_s / change)


class Observer(NamedTuple):
    """Measurements smoothed by dead reckoning: a step extrapolates the last estimate and corrects it by a small share.

    Position and heading are thus averages over about `smoothing_s` seconds that do not lag in a turn: a time that is
    given, and longer in calm air and where measurements are rare, `interval_s` apart on average. The velocity of the
    air, which is the measured velocity less the airspeed along the heading, is averaged over a shorter time
    (`AirAverage`). A smoothing time of 0 disables smoothing.
    """

    smoothing_s: float
    interval_s: float
    air: AirAverage
    estimate: Estimate


def first_observer(smoothing_s: float) -> Observer:
    """The observer before the first measurement."""
    return Observer(smoothing_s, 0.0, first_air(), NO_ESTIMATE)


def restart(observer: Observer) -> Observer:
    """The observer that starts again from the next measurement."""
    return Observer(observer.smoothing_s, observer.interval_s, observer.air, NO_ESTIMATE)


def restart_gusts(observer: Observer) -> Observer:
    """The observer that measures the gusts along the flight anew."""
    return observer._replace(air=observer.air._replace(along=CALM_ALONG))


def roughness(observer: Observer) -> float:
    """The root mean square change of course that gusts cause in a second, radians."""
    return course_change(observer, observer.air.near, observer.air.far)


def along_roughness(observer: Observer) -> float:
    """The same by gusts along the flight since `restart_gusts`: a slip that changes with the bank does not count."""
    near, far, along = observer.air.near, observer.air.far, observer.air.along
    return course_change(observer, Difference(near.time_s, along.near_square), Difference(far.time_s, along.far_square))


def course_change(observer: Observer, near: Difference, far: Difference) -> float:
    """The root mean square change of course in a second, radians, by gusts that show in these differences."""
    V = observer.estimate.airspeed_m_s
    return sqrt(gust(near, far)) / V if V > 0.0 else 0.0


def observe(
    observer: Observer, state: State, bank_deg: float, shortest_s: float, turning: Turning = COORDINATED
) -> Observer:
    """The observer after a usable measurement that is later than the last one.

    `bank_deg` is the bank that the roll model predicts for that time, `shortest_s` the shortest smoothing time.
    """
    smoothing_s, interval_s, air, last = observer
    if last.airspeed_m_s == 0.0 or shortest_s == 0.0:
        measured = _estimate_from(state, turning)
        air = restart_air(air, measured.air_east_m_s, measured.air_north_m_s)
        return Observer(smoothing_s, interval_s, air, measured)
    last_s, pose, V, last_rate, _, air_east, air_north, _ = last
    dt = state.time_s - last_s
    interval_s += (INTERVAL_SHARE if interval_s > 0.0 else 1.0) * (min(dt, LONGEST_INTERVAL_S) - interval_s)
    smoothing_s = _smoothing_s(roughness(observer), interval_s, shortest_s)
    share = 1.0 - exp(-dt / smoothing_s)
    V += share * (state.airspeed_m_s - V)
    bank_deg += share * (state.bank_deg - bank_deg)
    turn_rate = turn_rate_at(turning, bank_deg, V)
    pose = _rotated(pose, turning.lead_s * (turn_rate - last_rate))
    predicted = constant_turn(pose, V, turn_rate, dt, (air_east, air_north))
    pose = _blended(predicted, _flight_pose(state, turning), share)
    east, north = state.velocity_east_m_s - V * pose.c, state.velocity_north_m_s - V * pose.s
    air = average_air(air, east, north, dt, shortest_s, AirMotion(pose.c, pose.s, turn_rate))
    estimate = Estimate(state.time_s, pose, V, turn_rate, bank_deg, air.east_m_s, air.north_m_s, turning)
    return Observer(smoothing_s, interval_s, air, estimate)


def _smoothing_s(rough: float, interval_s: float, shortest_s: float) -> float:
    """The smoothing time for the present air and the interval of the measurements."""
    calm = 1.0 - min(rough / CALM_COURSE, 1.0)
    multiple = 1.0 + (CALM_MULTIPLE - 1.0) * calm
    return multiple * max(shortest_s, LEAST_COUNT * interval_s)


def _blended(pose: PlanarPose, measured: PlanarPose, share: float) -> PlanarPose:
    """A pose corrected by a share of its difference from the measured one."""
    x, y, c, s = pose
    c, s = c + share * (measured.c - c), s + share * (measured.s - s)
    size = length(c, s)
    return PlanarPose(x + share * (measured.x - x), y + share * (measured.y - y), c / size, s / size)


def _estimate_from(state: State, turning: Turning) -> Estimate:
    """The estimate from a single measurement."""
    V, pose = state.airspeed_m_s, _flight_pose(state, turning)
    turn_rate = turn_rate_at(turning, state.bank_deg, V)
    east, north = state.velocity_east_m_s - V * pose.c, state.velocity_north_m_s - V * pose.s
    return Estimate(state.time_s, pose, V, turn_rate, state.bank_deg, east, north, turning)


def _flight_pose(state: State, turning: Turning) -> PlanarPose:
    """The measured position, with the direction of flight through the air."""
    ahead_deg = degrees(turning.lead_s * turn_rate_at(turning, state.bank_deg, state.airspeed_m_s))
    return PlanarPose(state.east_m, state.north_m, *heading_vector(state.heading_deg - ahead_deg))


def _rotated(pose: PlanarPose, angle: float) -> PlanarPose:
    """A pose turned to the left by an angle, radians."""
    if angle == 0.0:
        return pose
    x, y, c, s = pose
    cosine, sine = cos(angle), sin(angle)
    return PlanarPose(x, y, c * cosine - s * sine, s * cosine + c * sine)


class Sensing(NamedTuple):
    """What is known of the present: the clock, the observer and the modelled bank.

    `command_deg` is the last command, or the bank before the first one. `present` is the last estimate of the present
    state, `elapsed_s` the time since then, and `model_error_deg` how far its bank was from the modelled one. `is_known`
    says whether the estimate is of this step.
    """

    clock: Clock
    observer: Observer
    history: BankHistory
    command_deg: float
    present: Estimate
    bank_rate_deg_s: float
    elapsed_s: float
    model_error_deg: float
    is_known: bool


def first_sensing(smoothing_s: float, bank_deg: float) -> Sensing:
    """What is known before the first measurement, at a bank."""
    return Sensing(
        clock=FIRST_CLOCK,
        observer=first_observer(smoothing_s),
        history=constant_history(bank_deg),
        command_deg=bank_deg,
        present=NO_ESTIMATE,
        bank_rate_deg_s=0.0,
        elapsed_s=0.0,
        model_error_deg=0.0,
        is_known=False,
    )


def sense(
    sensing: Sensing, vehicle: VehicleModel, measurement: State, step_s: float, smoothing_s: float, covered_s: float
) -> Sensing:
    """What is known at a measurement, `step_s` seconds after the last.

    `smoothing_s` is the shortest smoothing time, `covered_s` what the history of banks has to cover. Telemetry may be
    slower than the steps: until the next measurement, but no longer than `EXTRAPOLATED_S`, the last estimate is
    extrapolated with the modelled bank.
    """
    clock, observer, history, command_deg, present, _, elapsed_s, error_deg, _ = sensing
    rate_deg_s = vehicle.bank_rate_deg_s
    if step_s > 0.0:
        clock, elapsed_s = advance_clock(clock, step_s), elapsed_s + step_s
        history = record_bank(history, vehicle.bank_deg, step_s, covered_s)
    if not is_usable(measurement):
        return Sensing(clock, observer, history, command_deg, present, rate_deg_s, elapsed_s, error_deg, False)
    if measurement.time_s == clock.time_s:
        if present.airspeed_m_s == 0.0 or clock.since_s > EXTRAPOLATED_S:
            return Sensing(clock, observer, history, command_deg, present, rate_deg_s, elapsed_s, error_deg, False)
        present = estimate_after(estimate_with_bank(present, present_deg(history) + error_deg), elapsed_s)
        return Sensing(clock, observer, history, command_deg, present, rate_deg_s, 0.0, error_deg, True)
    is_first = clock.time_s == -inf
    clock, is_new = check_stamp(clock, measurement.time_s)
    if not is_new:
        return Sensing(clock, observer, history, command_deg, present, rate_deg_s, elapsed_s, error_deg, False)
    if is_first:
        history = constant_history(vehicle.bank_deg)
    if clock.jump_s != 0.0 or clock.gap_s > EXTRAPOLATED_S:
        observer = restart(observer)
    known = vehicle.estimates
    turning, bank_deg = Turning(known.turn_ratio, known.course_lead_s), delayed_deg(history, known.delay_s)
    observer = observe(observer, remove_bias(known, measurement), bank_deg, smoothing_s, turning)
    present = estimate_at_present(observer.estimate, history, known.delay_s)
    return Sensing(
        clock, observer, history, command_deg, present, rate_deg_s, 0.0, present.bank_deg - present_deg(history), True
    )


def measure_gusts_anew(sensing: Sensing) -> Sensing:
    """What is known, without the gusts: the turns before the circle look like gusts."""
    return sensing._replace(observer=restart_gusts(sensing.observer))


def with_command(sensing: Sensing, command_deg: float) -> Sensing:
    """What is known, with the command that the vehicle follows at present."""
    return sensing._replace(command_deg=command_deg)
