"""The law that flies the fastest entry: a plan kept while it is good, followed with a reserve of turn rate."""

from __future__ import annotations

from math import degrees, hypot, inf, nan

from loiter.errors import not_negative, positive
from loiter.guidance.laws.clock import Clock
from loiter.guidance.laws.holding import air_rate, course_rate, forward
from loiter.guidance.laws.observer import Observer, Recent, Seen, usable
from loiter.guidance.laws.route import Route, View, controls_of, unit
from loiter.guidance.protocol import PHASES, Command, Phase, State
from loiter.guidance.vehicle.limits import clipped
from loiter.guidance.vehicle.rolling import AT_ONCE, Roll
from loiter.guidance.vehicle.turning import bank_at_rate, rate_at_bank
from loiter.kernel import motion, wind_search
from loiter.kernel.codes import Side, Status
from loiter.kernel.hold import tightest_radius
from loiter.kernel.synthesis import Entry, duration, is_solvable, optimum, rounded_radius
from loiter.kernel.wind_search import WindProblem
from loiter.planning.feasibility import check_held, relative_wind
from loiter.planning.model import CALM, Aircraft, Orbit, Wind
from loiter.planning.sides import SIDES, TURNS

# The figures below were tuned in gusts, 200 to 500 starts each: docs/guidance.md.
# How much wider than the aircraft can turn the plan turns, as a share; what is left corrects the last arc.
RESERVE = 0.1

# How long measurements are averaged, and how old one may be when it is told, seconds.
SMOOTHING_S, DELAY_S = 0.5, 0.1

# Turns are begun early by so many time constants of the roll. 0.12 make up for the rate, g tan(bank)/V, that lags the
# bank on the way into 35 deg; the rest is for gusts: begun late a turn ends inside the circle, begun early it is wider.
TURN_LAG = 0.6

# Course errors are corrected so many times as quickly as the aircraft banks and its sensors are averaged, and errors of
# place a fraction as quickly: a course steep enough to be quicker would leave the circle's tangent by degrees.
GAIN, PLACE_GAIN = 4.0, 0.25

# On the circle errors of place are corrected over 1/HOLD_GAIN radians of it: a share of the radius beside it asks for
# the same course beside its tangent, however large it is.
HOLD_GAIN = 0.8

# In turn radii over airspeed: how much sooner another plan must be to be taken, and how much later may be what is the
# same plan from here. The noise of a sensor moves T by less, but at a jump, where the plan that is kept is the soonest.
SOONER, LATER = 0.25, 0.25

# How often another plan is looked for, seconds; in wind, where it takes milliseconds, only where the last one slipped.
STILL_S, WINDY_S = 0.1, 1.0

# How far off its path or its time, in turn radii, a plan in wind has slipped; and how long the bend may be, back to the
# path, with which another begins that is the same way.
SLIPPED, BEND = 0.1, 0.1

# How far off its path, in turn radii and radians, a vehicle is lost: the plan is made anew, whatever it costs.
LOST, ASTRAY = 0.5, 1.0

# Without data the last command is kept so long, seconds; older measurements are not averaged with new ones.
BLIND_S = 1.0

# A piece shorter than this, seconds, is over: rounding.
OVER_S = 1e-9


class LoiterEntry:
    """A guidance law that flies the fastest entry onto `orbit`, in noise and gusts, and holds the circle.

    `wind` is the steady wind, `orbit` where it is at `State.time_s` = 0; a circle that moves keeps its velocity.
    `roll` is how the aircraft banks, `delay_s` how old its measurements are; they are flown on by what was commanded
    since. `reserve` is the share by which planned turns are wider than the tightest, `smoothing_s` how long
    measurements are averaged, `gain` how hard courses are corrected. Call `step` 10 to 400 times a second.

    One plan is kept, with its direction and its word, until another is sooner by a margin or the aircraft is lost, so
    that noise makes it neither dither nor go round again. docs/guidance.md tells how it works and how well.

    Where a measurement is not finite, or no later than the last one, the phase is `NO_DATA`: the last command is kept
    for a second; then the wings are levelled, or, on the circle, its bank is kept. One good measurement ends that. A
    clock that jumps back, or more than an hour ahead, is taken for the new one when its stamps have advanced by a
    second; a circle that moves is then where it is by the new clock.

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
        check_held(orbit, aircraft, wind)
        self._orbit, self._roll, self._wind = orbit, roll, relative_wind(orbit, aircraft, wind)
        self._still = self._wind.still
        self._gain, self._recent = positive("gain", gain, "units"), Recent(not_negative("delay_s", delay_s, "seconds"))
        self._V, self._side = aircraft.airspeed_m_s, SIDES[orbit.turn]
        tightest_m, widest_m = aircraft.turn_radius_m, orbit.radius_m / tightest_radius(*self._wind)
        # As wide as the reserve asks for and the circle allows.
        wide_m = tightest_m * (1.0 + not_negative("reserve", reserve, "one"))
        self._r = max(tightest_m, min(wide_m, widest_m))
        self._R, self._unit_s = rounded_radius(orbit.radius_m / self._r), self._r / self._V
        # What the reserve can make up for beside the last arc counts as on it.
        self._tolerance = 0.5 * (self._r / tightest_m - 1.0)
        self._limit_deg, self._hold_deg = aircraft.bank_deg(tightest_m), aircraft.bank_deg(orbit.radius_m)
        self._planned_deg = aircraft.bank_deg(self._r)
        self._observer = Observer(not_negative("smoothing_s", smoothing_s, "seconds"))
        self._slowness_s = self._lead_s(0.0, self._limit_deg) + smoothing_s
        self._route: Route | None = None
        # When the circle will be joined, by the clock of a view, and what the plan in force promised.
        self._joins = self._promised = inf
        self._clock, self._sought_s = Clock(), -inf
        self._last = Command(0.0, 0.0, Phase.NO_DATA, nan, orbit.turn, Phase.NO_DATA, nan)

    @classmethod
    def exact(cls, orbit: Orbit, aircraft: Aircraft, wind: Wind | None = None) -> LoiterEntry:
        """The law of the theory: no reserve, bank at once, measurements as they are."""
        return cls(orbit, aircraft, wind, roll=AT_ONCE, delay_s=0.0, reserve=0.0, smoothing_s=0.0)

    def step(self, state: State, dt: float) -> Command:
        """The command for the next `dt` seconds, from what was measured.

        Raises `InvalidArgument` where `dt` is not positive and finite; the law then is as it was.
        """
        dt = positive("dt", dt, "seconds")
        if not usable(state) or not self._clock.believes(state.time_s):
            return self._without_data(dt)
        seen = self._seen(state)
        if self._route is None:
            self._seek(self._view(seen.ahead(self._lead_s(0.0, self._limit_deg))))
        if self._route is None:
            return self._without_data(dt)
        view, early_s = self._advanced(self._route, seen)
        if self._reconsidered(self._route, view):
            view, early_s = self._advanced(self._route, seen)
        self._last = self._followed(self._route, view, early_s, dt)
        return self._last

    def _seen(self, state: State) -> Seen:
        """What a measurement makes of the state of the aircraft."""
        if self._clock.jump_s != 0.0:
            self._shift(self._clock.jump_s)
        if self._clock.jump_s != 0.0 or self._clock.gap_s > BLIND_S:
            self._observer.forget()
        return self._observer.see(state, self._recent.then_deg).brought(self._recent)

    def _shift(self, jump_s: float) -> None:
        """Tell by a clock that has jumped what was told by the one before."""
        jump = jump_s / self._unit_s
        self._joins, self._promised, self._sought_s = self._joins + jump, self._promised + jump, self._sought_s + jump_s
        if self._route is not None:
            self._route.shift(jump)

    def _without_data(self, dt: float) -> Command:
        """What is safe while nothing is known."""
        bank_deg = self._last.bank_deg
        if self._clock.since_s > BLIND_S:
            bank_deg = self._route.side * self._hold_deg if self._route is not None and self._route.holds else 0.0
        self._bank_to(bank_deg, dt)
        rate_deg_s = degrees(rate_at_bank(bank_deg, self._V))
        return Command(rate_deg_s, bank_deg, Phase.NO_DATA, nan, self._last.turn, Phase.NO_DATA, nan)

    def _view(self, seen: Seen) -> View:
        """The aircraft as the circle sees it."""
        (x, y, c, s), V, r, o = seen.place, self._V, self._r, self._orbit
        hx, hy = seen.airspeed_m_s * c / V, seen.airspeed_m_s * s / V
        return View(
            seen.time_s / self._unit_s,
            (x - o.east_m - o.velocity_east_m_s * seen.time_s) / r,
            (y - o.north_m - o.velocity_north_m_s * seen.time_s) / r,
            hx + (seen.air_east_m_s - o.velocity_east_m_s) / V,
            hy + (seen.air_north_m_s - o.velocity_north_m_s) / V,
            hx,
            hy,
        )

    def _advanced(self, route: Route, seen: Seen) -> tuple[View, float]:
        """From where a command changes the way, and how early the next piece must be begun, seconds.

        A change of bank takes effect late; from there on the aircraft turns as one that banks at once. Pieces that are
        over by then are dropped.
        """
        while True:
            lead_s = self._lead_s(seen.bank_deg, self._target_deg(route, 0))
            view = self._view(seen.ahead(lead_s))
            left = route.follow(view)
            if route.holds:
                return view, 0.0
            # The hold is not hurried: what is turned beyond brings the course to the circle sooner.
            lag_s = TURN_LAG * self._roll.time_s if len(route.controls) > 1 else 0.0
            early_s = max(self._lead_s(seen.bank_deg, self._target_deg(route, 1)) + lag_s - lead_s, 0.0)
            if left * self._unit_s > early_s + OVER_S:
                self._joins = view.clock + route.rest
                return view, early_s
            route.drop()

    def _lead_s(self, bank_deg: float, target_deg: float) -> float:
        return self._roll.lead_s(bank_deg, target_deg, self._limit_deg)

    def _target_deg(self, route: Route, i: int) -> float:
        """The bank, positive to the right, of the piece that comes i-th, or of the circle."""
        controls = route.controls
        return -controls[i] * self._planned_deg if i < len(controls) else route.side * self._hold_deg

    def _reconsidered(self, route: Route, view: View) -> bool:
        """Whether another plan was worth taking, and was taken."""
        beside = route.beside(view)
        lost = abs(beside.left) > LOST or abs(beside.course) > ASTRAY
        slipped = max(abs(beside.left), abs(self._joins - self._promised)) > SLIPPED
        wanted = lost or (not route.holds and (self._still or slipped))
        return wanted and self._seek(view, None if lost else route)

    def _seek(self, view: View, route: Route | None = None) -> bool:
        """Take the fastest way from a view, in place of a route only if it is worth it; whether it was taken."""
        if self._clock.time_s - self._sought_s < (STILL_S if self._still else WINDY_S) - OVER_S:
            return False
        self._sought_s = self._clock.time_s
        scale = self._scale(view)
        found = self._fastest(view, scale)
        if found is None or not (route is None or _worth(found, route, 0.0 if self._still else BEND)):
            return False
        self._route = Route(view, found, self._R, self._wind, scale)
        self._joins = self._promised = view.clock + duration(found)
        return True

    def _scale(self, view: View) -> float:
        """How much wider turns are for a gust along the way: as wide as the speed is large, as the rate is the same.

        But no wider than the circle, which then is as tight as turns are.
        """
        if not self._still:
            return 1.0
        return min(hypot(*forward(view.vx, view.vy, view.hx, view.hy)), self._R)

    def _fastest(self, view: View, scale: float) -> Entry | None:
        """The kernel's answer for a view, if it has one; the course through the air of the plan is its heading."""
        (wx, wy), R = self._wind, self._R
        c, s = unit(*forward(view.vx - wx, view.vy - wy, view.hx, view.hy))
        if self._still:
            scene = *motion.reduce(view.x / scale, view.y / scale, c, s), rounded_radius(R / scale)
            return optimum(*scene, self._side, self._tolerance) if is_solvable(*scene, self._tolerance) else None
        found = wind_search.fastest(WindProblem(view.x, view.y, c, s, R, self._side, wx, wy))
        return wind_search.entry_of(found) if found.status == Status.OK else None

    def _followed(self, route: Route, view: View, early_s: float, dt: float) -> Command:
        """The command that follows the route, and what there is to tell of it."""
        target_deg = clipped(self._wanted_deg(route, view, dt), self._limit_deg)
        bank_deg = self._roll.demand_deg(self._recent.now_deg, target_deg, self._limit_deg)
        self._bank_to(bank_deg, dt)
        return Command(
            degrees(rate_at_bank(bank_deg, self._V)),
            bank_deg,
            PHASES[route.controls[0]] if route.controls else Phase.HOLD,
            max(self._joins * self._unit_s - self._clock.time_s - self._recent.delay_s, 0.0),
            TURNS[Side(route.side)],
            PHASES[route.controls[1]] if len(route.controls) > 1 else Phase.HOLD,
            route.left * self._unit_s - early_s if route.controls else inf,
        )

    def _wanted_deg(self, route: Route, view: View, dt: float) -> float:
        """The bank that follows the route; on a turn before its last piece all the bank there is.

        Such a turn is planned anew before it is over: nothing is gained by flying it as wide as planned.
        """
        if len(route.controls) > 1 and route.controls[0] != 0:
            return -route.controls[0] * self._limit_deg
        vx, vy = route.velocity(view)
        quickness = self._unit_s / (self._slowness_s + self._gain * dt)
        place_gain = HOLD_GAIN / self._R if route.holds else PLACE_GAIN * quickness
        course = course_rate(route.beside(view), self._gain * quickness, place_gain, hypot(vx, vy) / route.scale)
        return bank_at_rate(-air_rate(course, vx, vy, view.hx, view.hy) / self._unit_s, self._V)

    def _bank_to(self, bank_deg: float, dt: float) -> None:
        """Reckon what a command does to the bank in a step, and let its time pass."""
        self._clock.let(dt)
        self._recent.keep(self._roll.after(self._recent.now_deg, bank_deg, dt), dt)


def _worth(found: Entry, route: Route, bend: float) -> bool:
    """Whether a way is worth leaving a route for: the same one from here, or one that is sooner by a margin.

    It is the same whatever it begins with that is no longer than `bend`.
    """
    controls = controls_of(found.word)
    first = max(len(controls) - len(route.controls), 0)
    same = (
        found.side == route.side
        and controls[first:] == route.controls
        and sum((found.t1, found.t2, found.t3)[:first]) <= bend
    )
    return duration(found) < route.rest + (LATER if same else -SOONER)
