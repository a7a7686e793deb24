"""An airframe in six degrees of freedom, flown by JSBSim with the inner loops of this package.

JSBSim simulates flight above the rotating earth. Flights start above 0 N 0 E, and east and north are measured in the
plane tangent to the ellipsoid there. So close to the equator the meridians are parallel, and a circle of a few
kilometres is accurate to better than a millimetre.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache
from math import ceil, nan, sqrt
from typing import Any

import numpy as np

from loiter import errors
from loiter.errors import LoiterError, not_negative
from loiter.guidance.protocol import Command, Phase, State
from loiter.guidance.vehicle import Roll, clip
from loiter.lab.simulators.airframes import Airframe
from loiter.lab.simulators.gusts import FOOT_M
from loiter.lab.simulators.inner_loops import InnerLoops, LoopInputs, Surfaces
from loiter.lab.simulators.sensors import Noise, Sensors
from loiter.planning.compass import heading_vector, wrapped
from loiter.planning.model import CALM, Pose, Turn, Wind

# The longest step of JSBSim and of the inner loops, seconds.
STEP_S = 1.0 / 120.0

# For JSBSim's `FGWinds`: Dryden spectra of MIL-F-8785C, and a severity: below 1000 feet its only effect is that 0 turns
# turbulence off.
MILSPEC, SEVERITY = 3, 1

# The step of a roll identification and the time allowed for each change of bank, seconds.
IDENTIFY_S, SETTLE_S = 0.02, 6.0

# The properties that the inner loops measure, in the order of `LoopInputs`, with their units.
INPUT_PROPERTIES = (
    ("attitude/phi-rad", 1.0),
    ("attitude/theta-rad", 1.0),
    ("velocities/p-rad_sec", 1.0),
    ("velocities/q-rad_sec", 1.0),
    ("velocities/r-rad_sec", 1.0),
    ("aero/beta-rad", 1.0),
    ("position/h-sl-ft", FOOT_M),
    ("velocities/h-dot-fps", FOOT_M),
    ("velocities/vtrue-fps", FOOT_M),
)
SURFACE_PROPERTIES = ("fcs/aileron-cmd-norm", "fcs/elevator-cmd-norm", "fcs/rudder-cmd-norm", "fcs/throttle-cmd-norm")


class JsbsimAircraft:
    """A simulator: an airframe of JSBSim with inner loops and sensors, in wind and turbulence.

    It begins at `start`, trimmed in level flight at the airspeed and altitude of the airframe; `start` and all states
    are in local metres east and north. `gust` is the standard deviation of the horizontal turbulence over the airspeed
    (Dryden spectra; the vertical turbulence is a little weaker). The J-3 Cub can lose control at 15 %. `noise` is the
    noise of the sensors; without it they are exact. The same seed gives the same flight. Raises `MissingPackage` where
    JSBSim is not installed, `InvalidArgument` for a gust that is negative or not finite, `LoiterError` where JSBSim
    cannot load or trim the airframe.
    """

    def __init__(
        self,
        start: Pose,
        airframe: Airframe,
        wind: Wind | None = None,
        *,
        seed: int = 0,
        gust: float = 0.0,
        noise: Noise | None = None,
    ) -> None:
        not_negative("gust", gust, "shares of the airspeed")
        self._start, self._time_s, self._step_s = start, 0.0, 0.0
        check_installed()
        with _quiet():
            self._fdm, trim = trimmed_model(airframe)
            _start_flight(self._fdm, airframe, start.heading_deg, CALM if wind is None else wind)
            _set_turbulence(self._fdm, airframe, gust, seed)
        self._loops = InnerLoops(airframe.gains, trim, airframe.altitude_m, airframe.aircraft.airspeed_m_s)
        self._limit_deg = airframe.aircraft.bank_deg(airframe.aircraft.turn_radius_m)
        node = self._fdm.get_property_manager().get_node
        self._input_readers = [(node(name).get_double_value, unit) for name, unit in INPUT_PROPERTIES]
        self._surface_setters = [node(name).set_double_value for name in SURFACE_PROPERTIES]
        self._sensors = None
        if noise is not None:
            self._sensors = Sensors(self.true_state(), noise, np.random.default_rng(seed))

    @property
    def altitude_m(self) -> float:
        """The altitude above sea level, metres."""
        return float(self._fdm["position/h-sl-ft"] * FOOT_M)

    def true_state(self) -> State:
        """The true state."""
        fdm = self._fdm
        return State(
            self._time_s,
            self._start.east_m + fdm["position/from-start-neu-e-ft"] * FOOT_M,
            self._start.north_m + fdm["position/from-start-neu-n-ft"] * FOOT_M,
            wrapped(fdm["attitude/psi-deg"]),
            fdm["attitude/phi-deg"],
            fdm["velocities/v-east-fps"] * FOOT_M,
            fdm["velocities/v-north-fps"] * FOOT_M,
            fdm["velocities/vtrue-fps"] * FOOT_M,
        )

    def measured_state(self) -> State:
        """The latest measured state; the true one without sensor noise."""
        return self.true_state() if self._sensors is None else self._sensors.latest

    def advance(self, command: Command, dt: float) -> None:
        """Fly `dt` seconds under a commanded bank, in equal steps of at most `STEP_S`.

        Raises `InvalidArgument` for a `dt` below 0.
        """
        not_negative("dt", dt, "seconds")
        steps = max(ceil(dt / STEP_S - 1e-9), 1)
        if dt / steps != self._step_s:
            self._step_s = dt / steps
            self._fdm.set_dt(self._step_s)
        bank_deg = clip(command.bank_deg, self._limit_deg)
        for _ in range(steps):
            measured = LoopInputs(*[read() * unit for read, unit in self._input_readers])
            surfaces = self._loops.step(measured, bank_deg, self._step_s)
            for set_share, share in zip(self._surface_setters, surfaces, strict=True):
                set_share(share)
            self._fdm.run()
        self._time_s += dt
        if self._sensors is not None:
            self._sensors.measure(self.true_state())


def identified_roll(airframe: Airframe) -> Roll:
    """The roll response of an airframe in still air, identified from a reversal from one bank limit to the other.

    The rate is the largest mean rate over a tenth of a second. The time constant is that of the `Roll` with the same
    integral of the missing bank over time, D^2/(2 p) + p time^2/2 for a change of D at the rate p (`Roll.lead_s`).
    Raises the same as `JsbsimAircraft`.
    """
    limit_deg = airframe.aircraft.bank_deg(airframe.aircraft.turn_radius_m)
    simulator = JsbsimAircraft(Pose(0.0, 0.0, 0.0), airframe)
    _banks(simulator, limit_deg)
    before = simulator.true_state().bank_deg
    banks = [before, *_banks(simulator, -limit_deg)]
    *_, end = banks
    change = before - end
    stride = round(0.1 / IDENTIFY_S)
    rate = max(a - b for a, b in zip(banks, banks[stride:], strict=False)) / (stride * IDENTIFY_S)
    missing = sum(bank - end for bank in banks[1:]) * IDENTIFY_S
    return Roll(sqrt(max(2.0 * (missing - 0.5 * change * change / rate) / rate, 0.0)), rate)


def _banks(simulator: JsbsimAircraft, bank_deg: float) -> list[float]:
    """The banks at intervals of `IDENTIFY_S` while a bank is commanded for `SETTLE_S`."""
    command = Command(nan, bank_deg, Phase.NO_DATA, nan, Turn.EITHER, Phase.NO_DATA, nan)
    banks = []
    for _ in range(round(SETTLE_S / IDENTIFY_S)):
        simulator.advance(command, IDENTIFY_S)
        banks.append(simulator.true_state().bank_deg)
    return banks


def check_installed() -> None:
    """Raise `MissingPackage` where JSBSim is not installed."""
    errors.check_installed("jsbsim", "six degrees of freedom need", "JSBSim", "sim")


def trimmed_model(airframe: Airframe) -> tuple[Any, Surfaces]:
    """An `FGFDMExec` with the airframe trimmed in still air, heading north, and its trimmed surfaces and throttle.

    Raises `LoiterError` where JSBSim cannot load or trim it.
    """
    import jsbsim

    fdm = jsbsim.FGFDMExec(None)
    fdm.set_debug_level(0)
    if not airframe.load(fdm):
        raise LoiterError(f"JSBSim cannot load the airframe {airframe.model}")
    fdm.set_dt(STEP_S)
    for name, value in (
        ("ic/lat-geod-deg", 0.0),
        ("ic/long-gc-deg", 0.0),
        ("ic/h-sl-ft", airframe.altitude_m / FOOT_M),
        ("ic/psi-true-deg", 0.0),
        ("ic/gamma-deg", 0.0),
        ("ic/vt-fps", airframe.aircraft.airspeed_m_s / FOOT_M),
        ("fcs/mixture-cmd-norm", 1.0),
    ):
        fdm[name] = value
    fdm.run_ic()
    fdm["propulsion/set-running"] = -1
    try:
        fdm.do_trim(1)
    except jsbsim.TrimFailureError as error:
        raise LoiterError(f"JSBSim cannot trim the airframe {airframe.model}") from error
    # JSBSim trims the pitch with the trim tab. The inner loops use the elevator instead, with the same effect.
    aileron, elevator, rudder, throttle = (fdm[name] for name in SURFACE_PROPERTIES)
    trim = Surfaces(aileron, elevator + fdm["fcs/pitch-trim-cmd-norm"], rudder, throttle)
    fdm["fcs/pitch-trim-cmd-norm"], fdm["fcs/elevator-cmd-norm"] = 0.0, trim.elevator
    return fdm, trim


def _start_flight(fdm: Any, airframe: Airframe, heading_deg: float, wind: Wind) -> None:
    """Restart the simulation in the trimmed attitude, on a heading, in a wind."""
    V, (east, north) = airframe.aircraft.airspeed_m_s, heading_vector(heading_deg)
    wind_east, wind_north = wind.velocity_m_s
    pitch, bank = fdm["attitude/theta-deg"], fdm["attitude/phi-deg"]
    for name, value in (
        # JSBSim keeps a wind direction only while the wind has a speed. It is the direction that the wind blows to.
        ("ic/vw-mag-fps", 1.0),
        ("ic/vw-dir-deg", wind.from_deg + 180.0),
        ("ic/vw-mag-fps", wind.speed_m_s / FOOT_M),
        ("ic/phi-deg", bank),
        ("ic/theta-deg", pitch),
        ("ic/psi-true-deg", wrapped(heading_deg)),
        ("ic/vn-fps", (V * north + wind_north) / FOOT_M),
        ("ic/ve-fps", (V * east + wind_east) / FOOT_M),
        ("ic/vd-fps", 0.0),
    ):
        fdm[name] = value
    fdm.run_ic()


def _set_turbulence(fdm: Any, airframe: Airframe, gust: float, seed: int) -> None:
    """Set the turbulence of MIL-F-8785C below 1000 feet, which JSBSim derives from the wind speed at 20 feet.

    The standard deviation of the vertical turbulence is 0.1 times that speed; that of the horizontal turbulence is the
    vertical one divided by (0.177 + 0.000823 h)^0.4 at h feet.
    """
    vertical_m_s = gust * airframe.aircraft.airspeed_m_s * (0.177 + 0.000823 * airframe.altitude_m / FOOT_M) ** 0.4
    fdm["atmosphere/randomseed"] = seed
    fdm["atmosphere/turb-type"] = MILSPEC if gust > 0.0 else 0
    fdm["atmosphere/turbulence/milspec/severity"] = SEVERITY if gust > 0.0 else 0
    fdm["atmosphere/turbulence/milspec/windspeed_at_20ft_AGL-fps"] = 10.0 * vertical_m_s / FOOT_M


@cache
def _silence() -> Any:
    """A logger that discards all messages: JSBSim's own prints a banner."""
    import jsbsim

    class Silence(jsbsim.FGLogger):
        def set_level(self, level: Any) -> None: ...
        def file_location(self, filename: str, line: int) -> None: ...
        def message(self, message: str) -> None: ...
        def format(self, format: Any) -> None: ...
        def flush(self) -> None: ...

    return Silence()


@contextmanager
def _quiet() -> Iterator[None]:
    """Suppress JSBSim's messages on this thread within the context."""
    import jsbsim

    previous = jsbsim.get_logger()
    jsbsim.set_logger(_silence())
    try:
        yield
    finally:
        jsbsim.set_logger(previous)
