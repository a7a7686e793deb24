"""The law that flies the fastest entry: a plan kept while it is good, followed with a reserve of turn rate."""

from __future__ import annotations

from math import degrees, hypot, inf, nan

from loiter.errors import not_negative, positive
from loiter.guidance.holding import air_rate, course_rate, forward
from loiter.guidance.observer import Observer, Seen, usable
from loiter.guidance.protocol import Command, Phase, State
from loiter.guidance.rolling import AT_ONCE, Roll
from loiter.guidance.route import Route, View, controls_of, unit
from loiter.guidance.turning import bank_at_rate, rate_at_bank
from loiter.kernel import drift, motion
from loiter.kernel.codes import Side, Status
from loiter.kernel.hold import tightest_held
from loiter.kernel.synthesis import Flown, duration, held_radius, optimum, solvable
from loiter.planning.held import SIDES, air_past, check_held
from loiter.planning.model import CALM, Aircraft, Orbit, Wind
from loiter.planning.scaling import TURNS

# The figures below were tuned in gusts, 200 to 500 starts each: docs/guidance.md.
# How much wider than the aircraft can turn the plan turns, as a share; what is left corrects.
RESERVE = 0.015

# How long measurements are averaged, and how old one may be when it is told, seconds.
SMOOTHING_S, DELAY_S = 0.5, 0.1

# On the way into a turn its rate, g tan(bank)/V, lags the bank by a share of the time constant of the roll, as tan is
# convex: 0.12 for 35 deg from level. The rest makes up for how wide the roll carries the aircraft.
TURN_LAG = 0.2

# Course errors are corrected so many times as quickly as the aircraft banks and its sensors are averaged, and errors of
# place a fraction as quickly: a course steep enough to be quicker would leave the circle's tangent by degrees.
GAIN, PLACE_GAIN = 4.0, 0.25

# In turn radii over airspeed: how much sooner another plan must be to be taken, and how much later may be what is the
# same plan from here. The noise of a sensor moves T by less, but at a jump, where the plan that is kept is the soonest.
SOONER, LATER = 0.25, 0.25

# How often another plan is looked for, seconds; in wind, where it takes milliseconds, only where the last one slipped.
STILL_S, WINDY_S = 0.2, 1.0

# How far off its path or its time, in turn radii, a plan in wind has slipped.
SLIPPED = 0.1

# How far off its path, in turn radii and radians, a vehicle is lost: the plan is made anew, whatever it costs.
LOST, ASTRAY = 0.5, 1.0

# Without data the last command is kept so long, seconds; older measurements are not averaged with new ones.
BLIND_S = 1.0

# A piece shorter than this, seconds, is over: rounding.
OVER_S = 1e-9

PHASES = {1: Phase.LEFT, 0: Phase.STRAIGHT, -1: Phase.RIGHT}


class LoiterEntry:
    """A guidance law that flies the fastest entry onto `orbit`, in noise and gusts, and holds the circle.

    `wind` is the steady wind, `orbit` where it is at `State.time_s` = 0; a circle that moves keeps its velocity.
    `roll` is how the aircraft banks, `delay_s` how old its measurements are; turns are begun that much early. `reserve`
    is the share by which planned turns are wider than the tightest, `smoothing_s` how long measurements are averaged,
    `gain` how hard courses are corrected. Call `step` 10 to 400 times a second.

    One plan is kept, with its direction and its word, until another is sooner by a margin or the aircraft is lost, so
    that noise makes it neither dither nor go round again. docs/guidance.md tells how it works and how well.

    Where a measurement is not finite, or no later than the last one, the phase is `NO_DATA`: the last command is kept
    for a second; then the wings are levelled, or, on the circle, its bank is kept. One good measurement ends that.

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
        self._orbit, self._roll, self._wind = orbit, roll, air_past(orbit, aircraft, wind)
        self._delay_s, self._gain = not_negative("delay_s", delay_s, "seconds"), positive("gain", gain, "units")
        self._V, self._side = aircraft.airspeed_m_s, SIDES[orbit.turn]
        tightest_m, widest_m = aircraft.turn_radius_m, orbit.radius_m / tightest_held(*self._wind)
        # As wide as the reserve asks for and the circle allows.
        wide_m = tightest_m * (1.0 + not_negative("reserve", reserve, "one"))
        self._r = max(tightest_m, min(wide_m, widest_m))
        self._R, self._unit_s = held_radius(orbit.radius_m / self._r), self._r / self._V
        # What the reserve can make up for beside the last arc counts as on it.
        self._limit = self._r / tightest_m
        self._tolerance = 0.5 * (self._limit - 1.0)
        self._limit_deg, self._hold_deg = aircraft.bank_deg(tightest_m), aircraft.bank_deg(orbit.radius_m)
        self._planned_deg = aircraft.bank_deg(self._r)
        self._slowness_s = self._lead_s(0.0, self._limit_deg) + smoothing_s
        self._observer = Observer(not_negative("smoothing_s", smoothing_s, "seconds"))
        self._route: Route | None = None
        # When the circle will be joined, by the clock of a view, and what the plan in force promised.
        self._joins = self._promised = inf
        self._told_s, self._sought_s = -inf, -inf
        self._blind_s = self._bank_deg = 0.0
        self._last = Command(0.0, 0.0, Phase.NO_DATA, nan, orbit.turn, Phase.NO_DATA, nan)

    @classmethod
    def exact(cls, orbit: Orbit, aircraft: Aircraft, wind: Wind | None = None) -> LoiterEntry:
        """The law of the theory: no reserve, bank at once, measurements as they are."""
        return cls(orbit, aircraft, wind, roll=AT_ONCE, delay_s=0.0, reserve=0.0, smoothing_s=0.0)

    def step(self, state: State, dt: float) -> Command:
        """The command for the next `dt` seconds, from what was measured."""
        if not usable(state) or state.time_s <= self._told_s:
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
        if state.time_s - self._told_s > BLIND_S:
            self._observer.forget()
        self._told_s, self._blind_s = state.time_s, 0.0
        return self._observer.see(state, self._bank_deg)

    def _without_data(self, dt: float) -> Command:
        """What is safe while nothing is known."""
        self._blind_s += dt
        bank_deg = self._last.bank_deg
        if self._blind_s > BLIND_S:
            bank_deg = self._route.side * self._hold_deg if self._route is not None and self._route.holds else 0.0
        self._bank_deg = self._roll.after(self._bank_deg, bank_deg, dt)
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
            delay_s = self._delay_s + TURN_LAG * self._roll.time_s if len(route.controls) > 1 else 0.0
            early_s = max(self._lead_s(seen.bank_deg, self._target_deg(route, 1)) + delay_s - lead_s, 0.0)
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
        beside, windy = route.beside(view), self._wind != (0.0, 0.0)
        lost = abs(beside.left) > LOST or abs(beside.course) > ASTRAY
        slipped = max(abs(beside.left), abs(self._joins - self._promised)) > SLIPPED
        wanted = lost or not (route.holds or (windy and not slipped))
        return wanted and self._seek(view, None if lost else route)

    def _seek(self, view: View, route: Route | None = None) -> bool:
        """Take the fastest way from a view, in place of a route only if it is worth it; whether it was taken."""
        if self._told_s - self._sought_s < (STILL_S if self._wind == (0.0, 0.0) else WINDY_S) - OVER_S:
            return False
        self._sought_s = self._told_s
        found = self._fastest(view)
        if found is None or not (route is None or _worth(found, route)):
            return False
        self._route = Route(view, found, self._R, self._wind)
        self._joins = self._promised = view.clock + duration(found)
        return True

    def _fastest(self, view: View) -> Flown | None:
        """The kernel's answer for a view, if it has one; the course through the air of the plan is its heading."""
        (wx, wy), R = self._wind, self._R
        c, s = unit(*forward(view.vx - wx, view.vy - wy, view.hx, view.hy))
        if wx == wy == 0.0:
            scene = *motion.reduce(view.x, view.y, c, s), R
            return optimum(*scene, self._side, self._tolerance) if solvable(*scene, self._tolerance) else None
        found = drift.fastest(view.x, view.y, c, s, R, self._side, wx, wy)
        return drift.flight(found) if found[0] == Status.OK else None

    def _followed(self, route: Route, view: View, early_s: float, dt: float) -> Command:
        """The command that follows the route, and what there is to tell of it."""
        vx, vy = route.velocity(view)
        quickness = self._unit_s / (self._slowness_s + self._gain * dt)
        course = course_rate(route.beside(view), self._gain * quickness, PLACE_GAIN * quickness, hypot(vx, vy))
        if self._wind == (0.0, 0.0) and len(route.controls) > 1:
            # In still air a turn that is flown tighter than planned is planned anew before it is over.
            course *= self._limit
        rate = -air_rate(course, vx, vy, view.hx, view.hy) / self._unit_s
        target_deg = min(max(bank_at_rate(rate, self._V), -self._limit_deg), self._limit_deg)
        bank_deg = self._roll.demand_deg(self._bank_deg, target_deg, self._limit_deg)
        self._bank_deg = self._roll.after(self._bank_deg, bank_deg, dt)
        return Command(
            degrees(rate_at_bank(bank_deg, self._V)),
            bank_deg,
            PHASES[route.controls[0]] if route.controls else Phase.HOLD,
            max(self._joins * self._unit_s - self._told_s, 0.0),
            TURNS[Side(route.side)],
            PHASES[route.controls[1]] if len(route.controls) > 1 else Phase.HOLD,
            route.left * self._unit_s - early_s if route.controls else inf,
        )


def _worth(found: Flown, route: Route) -> bool:
    """Whether a way is worth leaving a route for: the same one from here, or one that is sooner by a margin."""
    same = found[0] == route.side and controls_of(found[1]) == route.controls
    return duration(found) < route.rest + (LATER if same else -SOONER)
