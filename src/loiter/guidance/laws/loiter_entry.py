"""The law that flies the fastest entry: it keeps a plan until a better one is found, and a reserve of turn rate."""

from __future__ import annotations

from math import degrees, hypot, inf, nan
from typing import NamedTuple

from loiter.compiled import wind_solver
from loiter.errors import not_negative, positive
from loiter.guidance.laws.clock import Clock
from loiter.guidance.laws.observer import BankHistory, Estimate, Observer, is_usable
from loiter.guidance.laws.path_tracking import air_rate, course_rate, flight_velocity
from loiter.guidance.laws.route import RelativeState, Route, controls_of, unit
from loiter.guidance.protocol import Command, Phase, State, phase_of_control
from loiter.guidance.vehicle.limits import clip
from loiter.guidance.vehicle.rolling import INSTANT_ROLL, Roll
from loiter.guidance.vehicle.turning import bank_at_rate, rate_at_bank
from loiter.kernel import motion, wind_search
from loiter.kernel.hold import tightest_radius
from loiter.kernel.statuses import Status
from loiter.kernel.synthesis import Entry, duration, is_solvable, optimum, rounded_radius
from loiter.kernel.wind_search import WindProblem
from loiter.kernel.words import Side
from loiter.planning.feasibility import check_held, relative_wind
from loiter.planning.model import CALM, Aircraft, Orbit, Wind
from loiter.planning.sides import SIDES, TURNS

# The values below were tuned in gusts, with 200 to 500 starts each: docs/guidance.md.
# Planned turns are wider than the tightest turn by this share; the difference is left to correct the last arc.
RESERVE = 0.1

# The averaging time of measurements, and their dead time, seconds.
SMOOTHING_S, DELAY_S = 0.5, 0.1

# Turns begin early by this many roll time constants. 0.12 of them compensate the lag of the turn rate, g tan(bank)/V,
# behind the bank while that grows to 35 deg. The rest allows for gusts: a turn begun late ends inside the circle, a
# turn begun early can be flown wider.
TURN_LAG = 0.6

# The gains of course and crosstrack corrections, to be divided by the response time: the delay of a change of bank plus
# the averaging time. A faster correction of crosstrack errors would need an intercept angle of several degrees.
GAIN, PLACE_GAIN = 4.0, 0.25

# On the circle crosstrack errors are corrected over an arc of 1/HOLD_GAIN radians, so that the intercept angle depends
# only on the ratio of the error to the radius.
HOLD_GAIN = 0.8

# Margins, turn radii over airspeed. A different plan replaces the present one if it is faster by the first margin, the
# same plan, made again from the present state, if it is slower by no more than the second. Sensor noise changes the
# least time by less than these margins, except where that time jumps; there the present plan is the fastest.
SWITCH_MARGIN, UPDATE_MARGIN = 0.25, 0.25

# The interval between searches for another plan, seconds. In wind, where a search takes milliseconds, the aircraft must
# also have deviated from the last plan.
STILL_AIR_INTERVAL_S, WIND_INTERVAL_S = 0.1, 1.0

# In wind the aircraft has deviated from a plan if the crosstrack error or the change of the time to join exceeds this,
# in turn radii. A new plan counts as the same one if it differs only by a first turn back to the path, no longer than
# `LONGEST_BEND`.
DEVIATION, LONGEST_BEND = 0.1, 0.1

# Beyond this crosstrack error, turn radii, or course error, radians, the aircraft is lost: any new plan is accepted.
LOST_OFFSET, LOST_COURSE = 0.5, 1.0

# Without data the last command is kept for this time, seconds. Older measurements are not averaged with new ones.
BLIND_S = 1.0

# A piece with less than this left, seconds, is complete but for rounding.
ROUNDING_S = 1e-9


class ResponsePoint(NamedTuple):
    """The predicted state in which a command takes effect, and how early the next piece must begin, seconds."""

    state: RelativeState
    early_s: float


class LoiterEntry:
    """A guidance law that flies the fastest entry onto `orbit`, in noise and gusts, and holds the circle.

    `wind` is the steady wind. `orbit` gives the circle at `State.time_s` = 0; a circle that moves keeps its velocity.
    `roll` is the roll response of the aircraft, `delay_s` the dead time of its measurements, which the law compensates
    from the commands given since. `reserve` is the share by which planned turns are wider than the tightest,
    `smoothing_s` the averaging time of measurements, `gain` the gain of course corrections. Call `step` 10 to 400 times
    a second.

    The law keeps one plan, with its direction and its word, until another is faster by a margin or the aircraft is
    lost, so that noise causes neither switching between plans nor a go-around. docs/guidance.md describes the method
    and its performance.

    Measurements may come less often than steps: a step then gets the last one again, and the law extrapolates it, for a
    second at most. Where a measurement is not finite, or earlier than the last one, or where no new one has come for a
    second, the phase is `NO_DATA`: the last command is kept until a second after the last measurement; then the wings
    are levelled or, on the circle, the bank of the circle is kept. The first good measurement ends this phase. A clock
    that jumps back, or more than an hour ahead, is accepted when its stamps have advanced by a second; the position of
    a moving circle is then taken from the new clock.

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
    ) -> None:
        wind = CALM if wind is None else wind
        self._orbit, self._roll, self._wind = orbit, roll, relative_wind(orbit, aircraft, wind)
        check_held(orbit, aircraft, self._wind)
        self._in_still_air = self._wind.still
        if not self._in_still_air:
            wind_solver.load()
        self._gain = positive("gain", gain, "units")
        self._history = BankHistory(not_negative("delay_s", delay_s, "seconds"))
        self._V, self._side = aircraft.airspeed_m_s, SIDES[orbit.turn]
        self._set_planned_turn(orbit, aircraft, not_negative("reserve", reserve, "one"))
        self._observer = Observer(not_negative("smoothing_s", smoothing_s, "seconds"))
        self._response_s = self._lead_s(0.0, self._limit_deg) + smoothing_s
        self._route: Route | None = None
        # The predicted time of joining in the units of a `RelativeState`, and its value at the beginning of the present
        # plan.
        self._join_time = self._planned_join_time = inf
        self._clock, self._last_search_s = Clock(), -inf
        # The last estimate of the present state, the time since then, and how far its bank was from the modelled one.
        self._present: Estimate | None = None
        self._elapsed_s = self._bias_deg = 0.0
        self._last_command = Command(0.0, 0.0, Phase.NO_DATA, nan, orbit.turn, Phase.NO_DATA, nan)

    def _set_planned_turn(self, orbit: Orbit, aircraft: Aircraft, reserve: float) -> None:
        """Set the planned turn radius, the units that follow from it, and the banks."""
        tightest_m, widest_m = aircraft.turn_radius_m, orbit.radius_m / tightest_radius(*self._wind)
        # Wider by the reserve, as far as the circle allows.
        self._r = max(tightest_m, min(tightest_m * (1.0 + reserve), widest_m))
        self._R, self._unit_s = rounded_radius(orbit.radius_m / self._r), self._r / self._V
        # A start beside the last arc counts as on it if half of the reserve can correct its distance.
        self._tolerance = 0.5 * (self._r / tightest_m - 1.0)
        self._limit_deg, self._hold_deg = aircraft.bank_deg(tightest_m), aircraft.bank_deg(orbit.radius_m)
        self._planned_deg = aircraft.bank_deg(self._r)

    @classmethod
    def exact(cls, orbit: Orbit, aircraft: Aircraft, wind: Wind | None = None) -> LoiterEntry:
        """The law of the theory: no reserve, instant bank, no smoothing, no dead time."""
        return cls(orbit, aircraft, wind, roll=INSTANT_ROLL, delay_s=0.0, reserve=0.0, smoothing_s=0.0)

    def step(self, state: State, dt: float) -> Command:
        """The command for the next `dt` seconds, from a measured state.

        Raises `InvalidArgument` where `dt` is not positive and finite; the law is then unchanged.
        """
        dt = positive("dt", dt, "seconds")
        estimate = self._present_estimate(state)
        if estimate is None:
            return self._command_without_data(dt)
        if self._route is None:
            self._search(self._relative_state(estimate.after(self._lead_s(0.0, self._limit_deg))))
        if self._route is None:
            return self._command_without_data(dt)
        response = self._advance(self._route, estimate)
        if self._reconsider(self._route, response.state):
            response = self._advance(self._route, estimate)
        self._last_command = self._follow(self._route, response, estimate.time_s, dt)
        return self._last_command

    def _present_estimate(self, state: State) -> Estimate | None:
        """The estimate of the present state; None where there is no usable measurement.

        Telemetry may be slower than the steps: until the next measurement, but no longer than `BLIND_S`, the last
        estimate is extrapolated with the modelled bank.
        """
        if not is_usable(state):
            return None
        if state.time_s == self._clock.time_s:
            if self._present is None or self._clock.since_s > BLIND_S:
                return None
            bank_deg = self._history.current_deg + self._bias_deg
            self._present = self._present.under_bank(bank_deg, self._elapsed_s)
        elif self._clock.accept(state.time_s):
            self._present = self._estimate(state)
            self._bias_deg = self._present.bank_deg - self._history.current_deg
        else:
            return None
        self._elapsed_s = 0.0
        return self._present

    def _estimate(self, state: State) -> Estimate:
        """The estimate of the present state from a new measurement."""
        if self._clock.jump_s != 0.0:
            self._shift_clock(self._clock.jump_s)
        if self._clock.jump_s != 0.0 or self._clock.gap_s > BLIND_S:
            self._observer.reset()
        return self._observer.update(state, self._history.delayed_deg).at_present(self._history)

    def _shift_clock(self, jump_s: float) -> None:
        """Convert all stored times to a clock that has jumped by `jump_s`."""
        jump = jump_s / self._unit_s
        self._join_time, self._planned_join_time = self._join_time + jump, self._planned_join_time + jump
        self._last_search_s += jump_s
        if self._route is not None:
            self._route.shift_clock(jump)

    def _command_without_data(self, dt: float) -> Command:
        """The safe command while there is no usable measurement."""
        bank_deg, route = self._last_command.bank_deg, self._route
        if self._clock.since_s > BLIND_S:
            bank_deg = route.side * self._hold_deg if route is not None and route.is_holding else 0.0
        self._record_bank(bank_deg, dt)
        rate_deg_s = degrees(rate_at_bank(bank_deg, self._V))
        return Command(rate_deg_s, bank_deg, Phase.NO_DATA, nan, self._last_command.turn, Phase.NO_DATA, nan)

    def _relative_state(self, estimate: Estimate) -> RelativeState:
        """The aircraft relative to the circle, in turn radii and airspeeds."""
        (x, y, c, s), V, r = estimate.pose, self._V, self._r
        orbit = self._orbit.after(estimate.time_s)
        hx, hy = estimate.airspeed_m_s * c / V, estimate.airspeed_m_s * s / V
        return RelativeState(
            estimate.time_s / self._unit_s,
            (x - orbit.east_m) / r,
            (y - orbit.north_m) / r,
            hx + (estimate.air_east_m_s - orbit.velocity_east_m_s) / V,
            hy + (estimate.air_north_m_s - orbit.velocity_north_m_s) / V,
            hx,
            hy,
        )

    def _advance(self, route: Route, estimate: Estimate) -> ResponsePoint:
        """Drop the pieces that are complete when a command takes effect; return the predicted state then.

        A change of bank takes effect with a delay; from then on the aircraft turns like one that banks instantly.
        """
        while True:
            lead_s = self._lead_s(estimate.bank_deg, self._piece_bank_deg(route, route.control))
            state = self._relative_state(estimate.after(lead_s))
            remaining = route.update_remaining(state)
            if route.is_holding:
                return ResponsePoint(state, 0.0)
            # The hold itself begins without `TURN_LAG`: continuing the last arc aligns the course with the circle
            # sooner.
            lag_s = TURN_LAG * self._roll.time_s if route.next_control is not None else 0.0
            next_bank_deg = self._piece_bank_deg(route, route.next_control)
            early_s = max(self._lead_s(estimate.bank_deg, next_bank_deg) + lag_s - lead_s, 0.0)
            if remaining * self._unit_s > early_s + ROUNDING_S:
                self._join_time = state.time + route.time_to_join
                return ResponsePoint(state, early_s)
            route.drop_piece()

    def _lead_s(self, bank_deg: float, target_deg: float) -> float:
        return self._roll.lead_s(bank_deg, target_deg, self._limit_deg)

    def _piece_bank_deg(self, route: Route, control: int | None) -> float:
        """The planned bank, positive to the right, of a piece with this control, or of the circle if it is None."""
        return route.side * self._hold_deg if control is None else -control * self._planned_deg

    def _reconsider(self, route: Route, state: RelativeState) -> bool:
        """Search for another plan if that is due; return whether one was adopted."""
        offset = route.offset(state)
        lost = abs(offset.crosstrack) > LOST_OFFSET or abs(offset.course_error) > LOST_COURSE
        deviated = max(abs(offset.crosstrack), abs(self._join_time - self._planned_join_time)) > DEVIATION
        due = lost or (not route.is_holding and (self._in_still_air or deviated))
        return due and self._search(state, None if lost else route)

    def _search(self, state: RelativeState, route: Route | None = None) -> bool:
        """Adopt the fastest entry from a state if it is better than `route`; return whether it was adopted."""
        interval_s = STILL_AIR_INTERVAL_S if self._in_still_air else WIND_INTERVAL_S
        if self._clock.time_s - self._last_search_s < interval_s - ROUNDING_S:
            return False
        self._last_search_s = self._clock.time_s
        scale = self._scale(state)
        entry = self._fastest_entry(state, scale)
        bend = 0.0 if self._in_still_air else LONGEST_BEND
        if entry is None or not (route is None or _is_better(entry, route, bend)):
            return False
        self._route = Route(state, entry, self._R, self._wind, scale)
        self._join_time = self._planned_join_time = state.time + duration(entry)
        return True

    def _scale(self, state: RelativeState) -> float:
        """The factor by which turns are wider in the present gust: at a given turn rate the radius grows with speed.

        It is at most R: the circle is then as tight as the turns.
        """
        if not self._in_still_air:
            return 1.0
        return min(hypot(*flight_velocity(state.vx, state.vy, state.hx, state.hy)), self._R)

    def _fastest_entry(self, state: RelativeState, scale: float) -> Entry | None:
        """The kernel's entry from a state, if any. It starts along the velocity relative to the steady wind."""
        (wx, wy), R = self._wind, self._R
        c, s = unit(*flight_velocity(state.vx - wx, state.vy - wy, state.hx, state.hy))
        if self._in_still_air:
            scene = *motion.reduce(state.x / scale, state.y / scale, c, s), rounded_radius(R / scale)
            return optimum(*scene, self._side, self._tolerance) if is_solvable(*scene, self._tolerance) else None
        found = wind_solver.fastest(WindProblem(state.x, state.y, c, s, R, self._side, wx, wy))
        return wind_search.entry_of(found) if found.status == Status.OK else None

    def _follow(self, route: Route, response: ResponsePoint, present_s: float, dt: float) -> Command:
        """The command that follows the route, with the times that the law reports, counted from the present."""
        target_deg = clip(self._target_bank_deg(route, response.state, dt), self._limit_deg)
        bank_deg = self._roll.demand_deg(self._history.current_deg, target_deg, self._limit_deg)
        self._record_bank(bank_deg, dt)
        return Command(
            degrees(rate_at_bank(bank_deg, self._V)),
            bank_deg,
            phase_of_control(route.control),
            max(self._join_time * self._unit_s - present_s, 0.0),
            TURNS[Side(route.side)],
            phase_of_control(route.next_control),
            inf if route.is_holding else route.remaining * self._unit_s - response.early_s,
        )

    def _target_bank_deg(self, route: Route, state: RelativeState, dt: float) -> float:
        """The bank that follows the route; on a turn before the last piece it is the bank limit.

        Such a turn is planned again before it ends; flying it as wide as planned would only cost time.
        """
        if route.control and route.next_control is not None:
            return -route.control * self._limit_deg
        vx, vy = route.velocity(state)
        bandwidth = self._unit_s / (self._response_s + self._gain * dt)
        place_gain = HOLD_GAIN / self._R if route.is_holding else PLACE_GAIN * bandwidth
        course = course_rate(route.offset(state), self._gain * bandwidth, place_gain, hypot(vx, vy) / route.scale)
        return bank_at_rate(-air_rate(course, vx, vy, state.hx, state.hy) / self._unit_s, self._V)

    def _record_bank(self, bank_deg: float, dt: float) -> None:
        """Record the modelled bank after a step under a command, and advance the clock."""
        self._clock.advance(dt)
        self._elapsed_s += dt
        self._history.record(self._roll.bank_after(self._history.current_deg, bank_deg, dt), dt)


def _is_better(entry: Entry, route: Route, bend: float) -> bool:
    """Whether an entry should replace a route: it is the same plan and not much slower, or it is faster by a margin.

    Additional pieces at its beginning do not make it a different plan if together they are no longer than `bend`.
    """
    controls = controls_of(entry.word)
    extra = max(len(controls) - len(route.controls), 0)
    same = (
        entry.side == route.side
        and controls[extra:] == route.controls
        and sum((entry.t1, entry.t2, entry.t3)[:extra]) <= bend
    )
    return duration(entry) < route.time_to_join + (UPDATE_MARGIN if same else -SWITCH_MARGIN)
