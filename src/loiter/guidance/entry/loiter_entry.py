"""The law that flies the fastest entry: it keeps a plan until a better one is found, and a reserve of turn rate."""

from __future__ import annotations

from loiter.errors import InvalidArgument, instance, positive
from loiter.guidance.entry import law_step
from loiter.guidance.entry.law_step import DELAY_S, HOLD, LONGEST_STEP_S, NO_DATA, SMOOTHING_S
from loiter.guidance.entry.limits import NEGLIGIBLE_WIND, RESERVE, Settings
from loiter.guidance.entry.tracking import GAIN
from loiter.guidance.estimation import identification_step
from loiter.guidance.estimation.observer import COVERED_S
from loiter.guidance.estimation.turn_fits import EXPECTED_TURN_RATIO
from loiter.guidance.estimation.wind_fit import DECLARED_WIND_S
from loiter.guidance.protocol import PHASES, Command, Phase, State
from loiter.guidance.settings import setting
from loiter.guidance.vehicle import INSTANT_ROLL, Roll, VehicleEstimates, VehicleModel, fly_as_declared
from loiter.planning.model import CALM, Aircraft, Orbit, Turn, Wind, check_held, relative_wind, sign_of

# The names of the codes of a step.
NAMED_PHASES = {**PHASES, HOLD: Phase.HOLD, NO_DATA: Phase.NO_DATA}
NAMED_TURNS = {sign_of(turn): turn for turn in Turn}


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

    Raises `RadiusTooSmall` and `WindTooStrong` where the circle cannot be held, `InvalidArgument` for numbers below 0
    or above 1000.
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
        wind_east_m_s, wind_north_m_s = air.velocity_m_s
        limit_deg, delay_s = aircraft.bank_deg(aircraft.turn_radius_m), setting("delay_s", delay_s, "seconds")
        self._settings = Settings(
            east_m=orbit.east_m,
            north_m=orbit.north_m,
            radius_m=orbit.radius_m,
            side=sign_of(orbit.turn),
            velocity_east_m_s=orbit.velocity_east_m_s,
            velocity_north_m_s=orbit.velocity_north_m_s,
            wind_east_m_s=wind_east_m_s,
            wind_north_m_s=wind_north_m_s,
            limit_deg=limit_deg,
            command_limit_deg=limit_deg,
            gain=setting("gain", positive("gain", gain, "units"), "units"),
            reserve=setting("reserve", reserve, "one"),
            smoothing_s=setting("smoothing_s", smoothing_s, "seconds"),
            negligible_wind=NEGLIGIBLE_WIND if identify else 0.0,
            covered_s=max(COVERED_S, delay_s),
            search_steps=0,
        )
        turn_ratio = EXPECTED_TURN_RATIO if identify else 1.0
        declared = VehicleEstimates(
            roll=roll.values,
            delay_s=delay_s,
            turn_ratio=turn_ratio,
            quick_turn_ratio=turn_ratio,
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
        self._identifies = identify
        wind_known_s = 0.0 if wind is None else DECLARED_WIND_S
        self._declared = identification_step.settings_of(declared, limit_deg, wind_known_s)
        self._identification = identification_step.first_identification(self._declared)
        self._vehicle = VehicleModel(0, 0.0, 0.0, declared)
        self._memory = law_step.first_memory(self._settings, self._vehicle)

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
        return law_step.crosstrack_m(self._settings, self._memory)

    @property
    def command_limit_deg(self) -> float:
        """The limit of commanded banks, degrees."""
        return self._settings.command_limit_deg

    @command_limit_deg.setter
    def command_limit_deg(self, limit_deg: float) -> None:
        self._settings = self._settings._replace(command_limit_deg=limit_deg)

    def step(self, state: State, dt: float) -> Command:
        """The command for the next `dt` seconds, from a measured state.

        Raises `InvalidArgument` where `dt` is not above 0 and at most 3600; the law is then unchanged.
        """
        dt = positive("dt", dt, "seconds")
        if dt > LONGEST_STEP_S:
            raise InvalidArgument("dt", f"is {dt:g}: it must be at most {LONGEST_STEP_S:g} seconds")
        instance("state", state, State)
        self._vehicle = self._vehicle_at(state)
        self._memory = self._advance(state, dt)
        rate, bank_deg, phase, join_s, side, next_phase, next_s = self._memory.command
        return Command(rate, bank_deg, NAMED_PHASES[phase], join_s, NAMED_TURNS[side], NAMED_PHASES[next_phase], next_s)

    def _advance(self, state: State, dt: float) -> law_step.Memory:
        """The memory with the command for the next `dt` seconds."""
        return law_step.advance(self._memory, self._settings, self._vehicle, state, dt)

    def _vehicle_at(self, state: State) -> VehicleModel:
        """What is known of the vehicle at a measurement, after the last command."""
        command_deg, step_s = self._memory.command.bank_deg, self._memory.step_s
        if not self._identifies:
            return fly_as_declared(self._vehicle, command_deg, step_s)
        self._identification, vehicle = identification_step.identify(
            self._declared, self._identification, state, command_deg, step_s
        )
        return vehicle
