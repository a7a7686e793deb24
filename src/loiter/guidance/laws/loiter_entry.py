"""The law that flies the fastest entry: it keeps a plan until a better one is found, and a reserve of turn rate."""

from __future__ import annotations

from math import degrees, hypot, inf, nan
from typing import NamedTuple

from loiter.errors import instance, not_negative, positive
from loiter.guidance.identification.bank_history import delayed_deg
from loiter.guidance.identification.vehicle import (
    DeclaredVehicle,
    IdentifiedVehicle,
    Vehicle,
    VehicleEstimates,
)
from loiter.guidance.laws.clock import FIRST_CLOCK, advanced, checked
from loiter.guidance.laws.entry_planner import (
    PlannedEntry,
    RelativeState,
    TurnLimits,
    fastest_entry,
    widest_turn_m,
)
from loiter.guidance.laws.observer import (
    Estimate,
    Turning,
    estimate_after,
    estimate_at_present,
    estimate_with_bank,
    first_observer,
    is_usable,
    observed,
    restarted,
    roughness,
)
from loiter.guidance.laws.path_tracking import PathOffset, air_rate, course_rate
from loiter.guidance.laws.route import Route, controls_of
from loiter.guidance.protocol import Command, Phase, State, phase_of_control
from loiter.guidance.vehicle.limits import clip
from loiter.guidance.vehicle.rolling import INSTANT_ROLL, Roll, TurnOnset
from loiter.guidance.vehicle.turning import STILL, bank_at_rate, rate_at_bank
from loiter.kernel.words import Side, Word
from loiter.planning.feasibility import check_held, relative_wind
from loiter.planning.model import CALM, Aircraft, Orbit, Wind, radius_at_bank
from loiter.planning.sides import SIDES

# The values below were tuned in gusts, with 200 to 500 starts each: docs/guidance.md.
# Planned turns are wider than the tightest turn by this share; the difference is left to correct the last arc. It is up
# to twice as large until the vehicle has flown a tight turn, which may be wider than declared.
RESERVE = 0.1

# The reserve grows by this share for each radian that the aircraft could turn during the delay of its roll: the slower
# the roll, the farther an error of its estimate takes the aircraft off the last arc.
ROLL_RESERVE = 0.8

# The averaging time of measurements, and their dead time, seconds.
SMOOTHING_S, DELAY_S = 0.5, 0.1

# The gains of course and crosstrack corrections, to be divided by the response time: the delay of a change of bank plus
# the averaging time. A faster correction of crosstrack errors would need an intercept angle of several degrees.
GAIN, PLACE_GAIN = 4.0, 0.25

# In calm air the gain of course corrections falls to this share: only noise would be corrected. The air is rough where
# gusts change the course by this angle in a second, radians (root mean square).
CALM_GAIN, ROUGH_AIR = 0.75, 0.02

# On the circle it falls so far that course errors are corrected at this rate, 1/s, or at this multiple of that at which
# crosstrack errors are, but not below the last share. It rises with weaker gusts already. A vehicle that turns more
# quickly than its bank says where that changes would swing about the circle otherwise.
HOLD_RATE, HOLD_MULTIPLE, CALM_HOLD_GAIN, ROUGH_HOLD = 1.3, 4.0, 0.35, 0.015

# In heavy gusts it rises in proportion to them, from this angle on and up to this multiple.
HEAVY_GUSTS, HEAVY_GAIN = 0.04, 1.5

# On the circle crosstrack errors are corrected over an arc of 1/HOLD_GAIN radians, so that the intercept angle depends
# only on the ratio of the error to the radius.
HOLD_GAIN = 1.2

# Margins, turn radii over airspeed. A different plan replaces the present one if it is faster by the first margin, the
# same plan, made again from the present state, if it is slower by no more than the second. Sensor noise changes the
# least time by less than these margins, except where that time jumps; there the present plan is the fastest.
SWITCH_MARGIN, UPDATE_MARGIN = 0.25, 0.25

# The interval between searches for another plan, seconds.
SEARCH_INTERVAL_S = 0.1

# In wind a new plan counts as the same one if it differs only by a first turn back to the path that is no longer than
# `LONGEST_BEND`, turn radii. It is not adopted before the crosstrack error or the change of the time to join exceeds
# `DEVIATION`, turn radii: each adds such a turn.
DEVIATION, LONGEST_BEND = 0.1, 0.1

# Beyond this crosstrack error, turn radii, or course error, radians, the aircraft is lost: any new plan is accepted.
LOST_OFFSET, LOST_COURSE = 0.5, 1.0

# A flight that begins on the circle, within half of the reserve and this angle, radians, holds it at once.
ON_COURSE = 0.09
NO_TIMES = 0.0, 0.0, 0.0

# Without a usable measurement the last command is kept for the first time, seconds. Until the next measurement arrives
# the last one is extrapolated, but no longer than for the second; older ones are not averaged with new ones.
BLIND_S, EXTRAPOLATED_S = 1.0, 3.0

# Where the bank overshoots its limit, less than that is commanded, but at least this multiple of the circle's bank.
LEAST_LIMIT = 1.2

# The delays of changes of bank are computed again when the time constant or the rate of the roll changes by this share.
ROLL_CHANGED = 0.01

# A piece with less than this left, seconds, is complete but for rounding.
ROUNDING_S = 1e-9

# The gain of course corrections is reduced by this share of the delay: a part of it is not predicted exactly.
DELAY_SHARE = 1.0

# The wind is planned as estimated, not as declared, where they differ by the first share of the airspeed, until they
# differ by less than the second.
WIND_DIFFERS, WIND_KEPT = 0.1, 0.05

# An estimated wind below this share of the airspeed is planned as none: plans in still air can be made anew all the
# time, and make up for the drift.
NEGLIGIBLE_WIND = 0.03

# On the circle the mean crosstrack error is driven to zero by a correction of the rate of turn, at this share of the
# gain at which it would begin to oscillate, up to the second share of the circle's rate of turn, and only while the
# error is less than the third, in radii.
TRIM_GAIN, LARGEST_TRIM, TRIMMED_OFFSET = 0.12, 0.15, 0.05


class ResponsePoint(NamedTuple):
    """The predicted state in which a command takes effect, and its offset from the route.

    The next piece begins `early_s` seconds before the current one ends.
    """

    state: RelativeState
    offset: PathOffset
    early_s: float


class LoiterEntry:
    """A guidance law that flies the fastest entry onto `orbit`, in noise and gusts, and holds the circle.

    `orbit` gives the circle at `State.time_s` = 0; a circle that moves keeps its velocity. The law identifies the
    vehicle while it flies, from the commands that it gives and the measurements: the roll response, the delay of
    measurements, the ratio of turn rates, the biases of heading and bank, the steady wind and the airspeed. `wind`,
    `roll` and `delay_s` are first guesses; without `wind` it is taken from the first measurements. With `identify`
    False the vehicle is as declared. `reserve` is the share by which planned turns are wider than the tightest (up to
    twice that until one was flown, and more where the roll is slow), `smoothing_s` the shortest averaging time of
    measurements, `gain` the gain of course corrections.
    `command_limit_deg`, which may be set at any time, limits the commanded banks further, but not the turns that are
    planned. Call `step` 10 to 400 times a second.

    The law keeps one plan, with its direction and its word, until another is faster by a margin or the aircraft is
    lost, so that noise causes neither switching between plans nor a go-around. docs/guidance.md describes the method
    and its performance.

    Measurements may come less often than steps: a step then gets the last one again, and the law extrapolates it, for
    three seconds at most. Where a measurement is not finite, or earlier than the last one, or where no new one has come
    for three seconds, the phase is `NO_DATA`: the last command is kept until a second after the last measurement; then
    the wings are levelled or, on the circle, the bank of the circle is kept. The first good measurement ends this
    phase. A clock that jumps back, or more than an hour ahead, is accepted when its stamps have advanced by a second;
    the position of a moving circle is then taken from the new clock.

    Raises `RadiusTooSmall` and `WindTooStrong` where the circle cannot be held, `InvalidArgument` for numbers below 0.
    """

    def __init__(
        self,
        orbit: Orbit,
        aircraft: Aircraft,
        wind: Wind | None = None,
        *,
        roll: Roll = Roll(),  # noqa: B008 (frozen)
        delay_s: float = DELAY_S,
        reserve: float = RESERVE,
        smoothing_s: float = SMOOTHING_S,
        gain: float = GAIN,
        identify: bool = True,
    ) -> None:
        air = CALM if wind is None else wind
        instance("roll", roll, Roll)
        check_held(orbit, aircraft, relative_wind(orbit, aircraft, air), air)
        self._orbit, self._declared_wind = orbit, air.velocity_m_s
        # The bank limit, as declared, and at present: lower where the bank overshoots it.
        self._declared_limit_deg = self._limit_deg = self.command_limit_deg = aircraft.bank_deg(aircraft.turn_radius_m)
        self._gain, self._reserve = positive("gain", gain, "units"), not_negative("reserve", reserve, "one")
        smoothing_s = not_negative("smoothing_s", smoothing_s, "seconds")
        delay_s = not_negative("delay_s", delay_s, "seconds")
        wind_east_m_s, wind_north_m_s = air.velocity_m_s
        declared = VehicleEstimates(
            roll=roll,
            delay_s=delay_s,
            turn_ratio=1.0,
            quick_turn_ratio=1.0,
            course_lead_s=0.0,
            wind_east_m_s=wind_east_m_s,
            wind_north_m_s=wind_north_m_s,
            airspeed_m_s=aircraft.airspeed_m_s,
            turn_airspeed_m_s=aircraft.airspeed_m_s,
            overshoot_deg=0.0,
            turns_unknown=0.0,
            heading_bias_deg=0.0,
            bank_bias_deg=0.0,
        )
        self._vehicle: Vehicle = DeclaredVehicle(declared)
        if identify:
            self._vehicle = IdentifiedVehicle(declared, self._limit_deg, wind_declared=wind is not None)
        self._side = SIDES[orbit.turn]
        self._observer, self._shortest_s = first_observer(smoothing_s), smoothing_s
        self._route: Route | None = None
        # The predicted time of joining, seconds, and its value at the beginning of the present plan.
        self._join_time_s = self._planned_join_time_s = inf
        self._clock, self._last_search_s = FIRST_CLOCK, -inf
        # Whether the wind differs so much from the declared one that the estimated one is planned with.
        self._wind_differs, self._negligible_wind = False, NEGLIGIBLE_WIND if identify else 0.0
        # The correction of the rate of turn that cancels a steady crosstrack error on the circle, radians per second.
        self._trim = 0.0
        # The last estimate of the present state, the time since then, and how far its bank was from the modelled one.
        self._present: Estimate | None = None
        self._elapsed_s = self._bias_deg = 0.0
        self._last_command = Command(0.0, 0.0, Phase.NO_DATA, nan, orbit.turn, Phase.NO_DATA, nan)
        # The roll response for which the onsets of changes of bank were computed, and these onsets.
        self._roll, self._onsets = roll, dict[tuple[int, int], TurnOnset]()
        self._reversal_m = 0.0
        self._update_limits()

    @classmethod
    def exact(cls, orbit: Orbit, aircraft: Aircraft, wind: Wind | None = None) -> LoiterEntry:
        """The law of the theory: no reserve, instant bank, no smoothing, no dead time, no identification."""
        return cls(orbit, aircraft, wind, roll=INSTANT_ROLL, delay_s=0.0, reserve=0.0, smoothing_s=0.0, identify=False)

    @property
    def estimates(self) -> VehicleEstimates:
        """What the law believes of the vehicle at present."""
        return self._vehicle.estimates

    @property
    def crosstrack_m(self) -> float:
        """The crosstrack error, metres, positive to the left of the path; nan before there is a plan."""
        if self._route is None or self._present is None:
            return nan
        return self._route.offset(self._relative_state(self._present)).crosstrack

    def step(self, state: State, dt: float) -> Command:
        """The command for the next `dt` seconds, from a measured state.

        Raises `InvalidArgument` where `dt` is not positive and finite; the law is then unchanged.
        """
        dt = positive("dt", dt, "seconds")
        instance("state", state, State)
        estimate = self._present_estimate(state)
        if estimate is None:
            return self._command_without_data(dt)
        if self._route is None:
            self._first_search(estimate)
        if self._route is None:
            return self._command_without_data(dt)
        response = self._advance(self._route, estimate)
        if self._reconsider(self._route, response):
            response = self._advance(self._route, estimate)
        self._last_command = self._follow(self._route, response, estimate, dt)
        return self._last_command

    def _present_estimate(self, state: State) -> Estimate | None:
        """The estimate of the present state; None where there is no usable measurement.

        Telemetry may be slower than the steps: until the next measurement, but no longer than `EXTRAPOLATED_S`, the
        last estimate is extrapolated with the modelled bank.
        """
        if not is_usable(state):
            return None
        history = self._vehicle.history
        if state.time_s == self._clock.time_s:
            if self._present is None or self._clock.since_s > EXTRAPOLATED_S:
                return None
            bank_deg = history.current_deg + self._bias_deg
            self._present = estimate_after(estimate_with_bank(self._present, bank_deg), self._elapsed_s)
        else:
            self._clock, is_new = checked(self._clock, state.time_s)
            if not is_new:
                return None
            self._present = self._estimate(state)
            self._bias_deg = self._present.bank_deg - self._vehicle.history.current_deg
        self._elapsed_s = 0.0
        return self._present

    def _estimate(self, state: State) -> Estimate:
        """The estimate of the present state from a new measurement."""
        if self._clock.jump_s != 0.0:
            self._shift_clock(self._clock.jump_s)
        if self._clock.jump_s != 0.0 or self._clock.gap_s > EXTRAPOLATED_S:
            self._observer = restarted(self._observer)
        if self._vehicle.measure(state):
            self._update_limits()
        known, history = self._vehicle.estimates, self._vehicle.history
        turning = Turning(known.turn_ratio, known.course_lead_s)
        bank_deg = delayed_deg(history, known.delay_s)
        self._observer = observed(self._observer, known.unbiased(state), bank_deg, self._shortest_s, turning)
        return estimate_at_present(self._observer.estimate, history, known.delay_s)

    def _update_limits(self) -> None:
        """Set what follows from the estimates of the vehicle: the wind, turn radii, banks and the response time."""
        known = self._vehicle.estimates
        self._wind = self._planned_wind(known)
        V, R = known.airspeed_m_s, self._orbit.radius_m
        widest_m = widest_turn_m(V, R, self._wind)
        limit_deg = self._present_limit_deg(widest_m)
        if _differs(known.roll, self._roll) or limit_deg != self._limit_deg:
            self._roll, self._limit_deg, self._onsets = known.roll, limit_deg, {}
        tightest_m = radius_at_bank(known.turn_airspeed_m_s, limit_deg) / known.turn_ratio
        turned = self._lead_s(0.0, self._limit_deg) * V / tightest_m
        reserve = self._reserve * (1.0 + known.turns_unknown + ROLL_RESERVE * turned)
        self._limits = TurnLimits(V, tightest_m, min(tightest_m * (1.0 + reserve), widest_m))
        self._hold_deg = self._bank_deg(V / R)
        self._planned_deg = self._bank_deg(V / self._limits.planned_m)
        self._reversal_m = self._reversal_width_m(known)
        self._lag_s = self._lead_s(0.0, self._limit_deg) + DELAY_SHARE * known.delay_s

    def _present_limit_deg(self, widest_m: float) -> float:
        """The bank limit, lowered by what the bank overshoots it, but not below what turns of `widest_m` need."""
        known, declared_deg = self._vehicle.estimates, self._declared_limit_deg
        if known.overshoot_deg == 0.0:
            return declared_deg
        least_deg = LEAST_LIMIT * self._bank_deg(known.airspeed_m_s / widest_m)
        return max(declared_deg - known.overshoot_deg, min(least_deg, declared_deg))

    def _reversal_width_m(self, known: VehicleEstimates) -> float:
        """How far an aircraft is displaced towards the circle while it rolls from an opposite planned turn onto it."""
        begin_deg, end_deg = (clip(each, self._limit_deg) for each in (-self._planned_deg, self._hold_deg))
        onset, V = self._onset(begin_deg, end_deg), known.airspeed_m_s
        return 0.5 * onset.variance_s2 * V * V * (1.0 / self._limits.planned_m + 1.0 / self._orbit.radius_m)

    def _planned_wind(self, known: VehicleEstimates) -> tuple[float, float]:
        """The velocity of the air past the circle to plan with, metres per second.

        It is the declared one, unless the wind is found to differ from that by more than gusts do.
        """
        (east, north), circle = self._declared_wind, self._orbit
        differs = hypot(known.wind_east_m_s - east, known.wind_north_m_s - north) / known.airspeed_m_s
        self._wind_differs = differs > (WIND_KEPT if self._wind_differs else WIND_DIFFERS)
        if self._wind_differs:
            east, north = known.wind_east_m_s, known.wind_north_m_s
        relative = east - circle.velocity_east_m_s, north - circle.velocity_north_m_s
        negligible = hypot(*relative) < self._negligible_wind * known.airspeed_m_s
        return STILL if negligible else relative

    def _bank_deg(self, rate: float) -> float:
        """The bank at which the vehicle turns at a rate, radians per second; degrees with the sign of the rate."""
        known = self._vehicle.estimates
        return bank_at_rate(rate / known.turn_ratio, known.airspeed_m_s)

    def _turn_rate_deg_s(self, bank_deg: float) -> float:
        """The rate at which the vehicle turns at a bank: the inverse of `_bank_deg`, but in degrees per second."""
        known = self._vehicle.estimates
        return degrees(known.turn_ratio * rate_at_bank(bank_deg, known.airspeed_m_s))

    def _shift_clock(self, jump_s: float) -> None:
        """Convert all stored times to a clock that has jumped by `jump_s`."""
        self._join_time_s, self._planned_join_time_s = self._join_time_s + jump_s, self._planned_join_time_s + jump_s
        self._last_search_s += jump_s
        if self._route is not None:
            self._route.shift_clock(jump_s)

    def _command_without_data(self, dt: float) -> Command:
        """The safe command while there is no usable measurement."""
        bank_deg, route = self._last_command.bank_deg, self._route
        if self._clock.since_s > BLIND_S:
            bank_deg = self._piece_bank_deg(route, None) if route and route.is_holding else 0.0
        # The limit may be lower now than when the last command was given.
        bank_deg = clip(bank_deg, self.command_limit_deg)
        self._record(bank_deg, dt)
        turn = self._last_command.turn
        return Command(self._turn_rate_deg_s(bank_deg), bank_deg, Phase.NO_DATA, nan, turn, Phase.NO_DATA, nan)

    def _relative_state(self, estimate: Estimate) -> RelativeState:
        """The aircraft relative to the circle."""
        (x, y, c, s), V = estimate.pose, estimate.airspeed_m_s
        orbit = self._orbit.after(estimate.time_s)
        return RelativeState(
            estimate.time_s,
            x - orbit.east_m,
            y - orbit.north_m,
            V * c + estimate.air_east_m_s - orbit.velocity_east_m_s,
            V * s + estimate.air_north_m_s - orbit.velocity_north_m_s,
            V * c,
            V * s,
        )

    def _advance(self, route: Route, estimate: Estimate) -> ResponsePoint:
        """Drop the pieces that are complete when a command takes effect; return the predicted state then.

        A change of bank takes effect with a delay; from then on the aircraft turns like one that banks instantly.
        """
        while True:
            lead_s = self._lead_s(estimate.bank_deg, self._piece_bank_deg(route, route.control))
            state = self._relative_state(estimate_after(estimate, lead_s))
            remaining_s = route.update_remaining(state)
            if route.is_holding:
                return ResponsePoint(state, route.offset(state), 0.0)
            early_s = self._early_s(route, estimate.bank_deg, lead_s)
            if remaining_s > early_s + ROUNDING_S:
                self._join_time_s = state.time_s + route.time_to_join_s
                return ResponsePoint(state, route.offset(state), early_s)
            route.drop_piece()

    def _early_s(self, route: Route, bank_deg: float, lead_s: float) -> float:
        """How long before its end the current piece must end, since the next bank takes effect with a delay."""
        early_s = self._lead_s(bank_deg, self._piece_bank_deg(route, route.next_control)) - lead_s
        between_s = route.straight_between_s
        if between_s is not None:
            # A straight line between opposite turns may be shorter than the reversal, which then begins before its end.
            reversal_s = self._lead_s(bank_deg, self._piece_bank_deg(route, route.last_control)) - lead_s
            early_s = max(early_s, reversal_s - 0.5 * between_s)
        return max(early_s, 0.0)

    def _lead_s(self, bank_deg: float, target_deg: float) -> float:
        """The delay of a change of bank."""
        return self._onset(bank_deg, target_deg).lead_s

    def _onset(self, bank_deg: float, target_deg: float) -> TurnOnset:
        """`Roll.onset`, computed for whole half degrees, and kept until the roll response is another."""
        change = round(2.0 * bank_deg), round(2.0 * target_deg)
        onset = self._onsets.get(change)
        if onset is None:
            onset = self._roll.onset(0.5 * change[0], 0.5 * change[1], self._limit_deg)
            self._onsets[change] = onset
        return onset

    def _piece_bank_deg(self, route: Route, control: int | None) -> float:
        """The planned bank, positive to the right, of a piece with this control, or of the circle if it is None."""
        bank_deg = route.side * self._hold_deg if control is None else -control * self._planned_deg
        return clip(bank_deg, self._limit_deg)

    def _reconsider(self, route: Route, response: ResponsePoint) -> bool:
        """Search for another plan if that is due; return whether one was adopted."""
        offset, r = response.offset, self._limits.planned_m
        if (
            abs(offset.crosstrack) > LOST_OFFSET * r
            or abs(offset.course_error) > LOST_COURSE
            or self._in_other_wind(route)
        ):
            return self._search(response.state)
        if route.is_holding:
            return False
        later_m = abs(self._join_time_s - self._planned_join_time_s) * self._limits.airspeed_m_s
        deviates = max(abs(offset.crosstrack), later_m) > DEVIATION * r
        return self._search(response.state, route, update=deviates or self._wind == STILL)

    def _in_other_wind(self, route: Route) -> bool:
        """Whether a plan was made for a wind that differs so much from the present one that it means nothing."""
        (east, north), (planned_east, planned_north) = self._wind, route.entry.wind
        off = hypot(east - planned_east, north - planned_north)
        return not route.is_holding and off > WIND_DIFFERS * self._limits.airspeed_m_s

    def _first_search(self, estimate: Estimate) -> None:
        """Adopt the fastest entry from where a command takes effect, which depends on the bank and the first turn."""
        if self._begin_on_circle(estimate):
            return
        lead_s = self._lead_s(estimate.bank_deg, 0.0)
        entry = self._fastest_entry(self._relative_state(estimate_after(estimate, lead_s)))
        if entry is None:
            return
        first = next(iter(controls_of(entry.word)), None)
        bank_deg = -first * self._limit_deg if first is not None else entry.side * self._hold_deg
        self._search(self._relative_state(estimate_after(estimate, self._lead_s(estimate.bank_deg, bank_deg))))

    def _begin_on_circle(self, estimate: Estimate) -> bool:
        """Hold the circle at once if the flight begins on it; return whether it does."""
        state, limits = self._relative_state(estimate), self._limits
        for side in (self._side,) if self._side else (Side.CW, Side.CCW):
            entry = PlannedEntry(side, Word.EMPTY, NO_TIMES, limits.planned_m, limits.airspeed_m_s, self._wind)
            route = Route(state, entry, self._orbit.radius_m)
            offset = route.offset(state)
            if (
                abs(offset.crosstrack) < 0.5 * self._reserve * self._orbit.radius_m
                and abs(offset.course_error) < ON_COURSE
            ):
                self._route, self._join_time_s = route, state.time_s
                self._planned_join_time_s = state.time_s
                return True
        return False

    def _search(self, state: RelativeState, route: Route | None = None, *, update: bool = True) -> bool:
        """Adopt the fastest entry from a state if it is better than `route`; return whether it was adopted.

        With `update` the same plan from the present state counts as better.
        """
        if self._clock.time_s - self._last_search_s < SEARCH_INTERVAL_S - ROUNDING_S:
            return False
        self._last_search_s = self._clock.time_s
        entry = self._fastest_entry(state)
        if entry is None or not (route is None or _is_better(entry, route, self._limits, update=update)):
            return False
        self._route = Route(state, entry, self._orbit.radius_m)
        self._join_time_s = self._planned_join_time_s = state.time_s + entry.duration_s
        return True

    def _fastest_entry(self, state: RelativeState) -> PlannedEntry | None:
        """The fastest entry from a state, onto a circle that is wider by `_reversal_m` if its last turn is opposite."""
        reverses = self._route is None or _reverses(self._route.entry)
        for assumed in (reverses, not reverses):
            radius_m = self._orbit.radius_m + (self._reversal_m if assumed else 0.0)
            entry = fastest_entry(state, self._limits, radius_m, self._side, self._wind)
            if entry is None or _reverses(entry) == assumed:
                break
        return entry

    def _follow(self, route: Route, response: ResponsePoint, present: Estimate, dt: float) -> Command:
        """The command that follows the route, with the times that the law reports, counted from the present."""
        target_deg = clip(self._target_bank_deg(route, response, dt), self._limit_deg)
        demand_deg = self._vehicle.estimates.roll.demand_deg(present.bank_deg, target_deg, self._limit_deg)
        bank_deg = clip(demand_deg, self.command_limit_deg)
        self._record(bank_deg, dt)
        return Command(
            self._turn_rate_deg_s(bank_deg),
            bank_deg,
            phase_of_control(route.control),
            max(self._join_time_s - present.time_s, 0.0),
            route.turn,
            phase_of_control(route.next_control),
            inf if route.is_holding else route.remaining_s - response.early_s,
        )

    def _target_bank_deg(self, route: Route, response: ResponsePoint, dt: float) -> float:
        """The bank that follows the route; on a turn before the last piece it is the bank limit.

        Such a turn is planned again before it ends; flying it as wide as planned would only cost time.
        """
        if route.control and route.next_control is not None:
            return -route.control * self._limit_deg
        state, offset, _ = response
        vx, vy = route.velocity(state)
        speed, turn_rate = hypot(vx, vy), self._limits.airspeed_m_s / self._orbit.radius_m
        gain = self._holding_gain(turn_rate) if route.is_holding else self._joining_gain()
        bandwidth = 1.0 / (self._lag_s + self._observer.smoothing_s + gain * dt)
        place_gain = HOLD_GAIN * speed / self._orbit.radius_m if route.is_holding else PLACE_GAIN * bandwidth
        course = course_rate(offset, gain * bandwidth, place_gain, speed)
        if route.is_holding:
            course -= self._trimmed(offset.crosstrack, gain * bandwidth, turn_rate, dt)
        rate = -air_rate(course, vx, vy, state.hx, state.hy)
        # At the present airspeed, which differs from the mean one where an autopilot holds it less exactly.
        return bank_at_rate(rate / self._vehicle.estimates.turn_ratio, hypot(state.hx, state.hy))

    def _joining_gain(self) -> float:
        """The gain of course corrections in the present air, before the circle is joined."""
        rough = roughness(self._observer)
        return self._gain_at(rough, max(min(rough / ROUGH_AIR, 1.0), CALM_GAIN))

    def _holding_gain(self, turn_rate: float) -> float:
        """The same on the circle, which turns at a rate, radians per second."""
        rough = roughness(self._observer, slip=1.0)
        response_s = self._lag_s + self._observer.smoothing_s
        calm_rate = max(HOLD_RATE, HOLD_MULTIPLE * HOLD_GAIN * turn_rate)
        calm_share = max(min(calm_rate * response_s / self._gain, CALM_GAIN), CALM_HOLD_GAIN)
        return self._gain_at(rough, max(min(rough / ROUGH_HOLD, 1.0), calm_share))

    def _gain_at(self, rough: float, share: float) -> float:
        """A share of the gain, more in heavy gusts, less where quick turns are quicker than the bank says."""
        known = self._vehicle.estimates
        lively = max(known.quick_turn_ratio / known.turn_ratio, 1.0)
        return self._gain * max(share, min(rough / HEAVY_GUSTS, HEAVY_GAIN)) / lively

    def _trimmed(self, crosstrack_m: float, course_gain: float, turn_rate: float, dt: float) -> float:
        """The correction of the rate of turn on the circle after another step, radians per second."""
        if abs(crosstrack_m) < TRIMMED_OFFSET * self._orbit.radius_m:
            place_gain = HOLD_GAIN * turn_rate
            integral_gain = TRIM_GAIN * place_gain * place_gain * course_gain / self._limits.airspeed_m_s
            self._trim = clip(self._trim + integral_gain * crosstrack_m * dt, LARGEST_TRIM * turn_rate)
        return self._trim

    def _record(self, bank_deg: float, dt: float) -> None:
        """Record a command, and advance the clock."""
        self._clock = advanced(self._clock, dt)
        self._elapsed_s += dt
        self._vehicle.record(bank_deg, dt)


def _differs(roll: Roll, other: Roll) -> bool:
    """Whether two roll responses differ by more than `ROLL_CHANGED`."""
    time_differs = abs(roll.time_s - other.time_s) > ROLL_CHANGED * other.time_s
    return time_differs or abs(roll.rate_deg_s - other.rate_deg_s) > ROLL_CHANGED * other.rate_deg_s


def _reverses(entry: PlannedEntry) -> bool:
    """Whether the last turn of an entry is opposite to that of the circle."""
    controls = controls_of(entry.word)
    return bool(controls) and controls[-1] == entry.side


def _is_better(entry: PlannedEntry, route: Route, limits: TurnLimits, *, update: bool) -> bool:
    """Whether an entry should replace a route.

    Either `update` holds, and it is the same plan and not much slower; or it is faster by a margin.

    In wind additional pieces at its beginning, together no longer than `LONGEST_BEND`, do not make it a different plan.
    The duration of a route that was planned with tighter turns grows with their radius.
    """
    unit_s = limits.planned_m / limits.airspeed_m_s
    bend_s = 0.0 if entry.wind == (0.0, 0.0) else LONGEST_BEND * unit_s
    controls = controls_of(entry.word)
    extra = max(len(controls) - len(route.controls), 0)
    same = entry.side == route.side and controls[extra:] == route.controls and sum(entry.times_s[:extra]) <= bend_s
    if same and not update:
        return False
    widened = max(1.0, entry.turn_radius_m / route.entry.turn_radius_m) if same else 1.0
    margin_s = (UPDATE_MARGIN if same else -SWITCH_MARGIN) * unit_s
    return entry.duration_s < widened * route.time_to_join_s + margin_s
