"""Six degrees of freedom: trim, hold, bank, wind, turbulence; the Aerosonde compared with its published equations."""

import subprocess
import sys
from functools import partial
from math import atan2, cos, degrees, hypot, inf, nan, pi, radians, sin, sqrt, tan

import numpy as np
import pytest

from loiter import Pose, Wind
from loiter.errors import InvalidArgument, MissingPackage
from loiter.guidance.protocol import Command, Phase
from loiter.lab.simulators.airframes import AEROSONDE, AIRFRAMES, J3CUB
from loiter.lab.simulators.jsbsim_aircraft import JsbsimAircraft, identified_roll, trimmed_model
from loiter.lab.simulators.sensors import Noise
from loiter.lab.trials import campaign
from loiter.planning.model import STANDARD_GRAVITY_M_S2, Turn

START = Pose(1000.0, -500.0, 40.0)
both = pytest.mark.parametrize("airframe", AIRFRAMES.values(), ids=list(AIRFRAMES))


def banked(bank_deg):
    return Command(nan, bank_deg, Phase.RIGHT, nan, Turn.CW, Phase.HOLD, nan)


def course_deg(state):
    return degrees(atan2(state.velocity_east_m_s, state.velocity_north_m_s))


def states(simulator, bank_deg, time_s, step_s=0.05):
    """The state and the altitude after each step of a flight under a commanded bank."""
    for _ in range(round(time_s / step_s)):
        simulator.advance(banked(bank_deg), step_s)
        yield simulator.true_state(), simulator.altitude_m


@both
@pytest.mark.parametrize("wind", [Wind(0.0, 0.0), Wind(8.0, from_deg=250.0)], ids=["still air", "wind"])
def test_it_starts_trimmed_and_flies_straight(airframe, wind):
    simulator, V = JsbsimAircraft(START, airframe, wind), airframe.aircraft.airspeed_m_s
    first = simulator.true_state()
    assert first[:5] == pytest.approx((0.0, 1000.0, -500.0, 40.0, 0.0), abs=0.05)
    velocity = np.array([V * sin(radians(40.0)), V * cos(radians(40.0))]) + wind.velocity_m_s
    assert first[5:] == pytest.approx((*velocity, V), abs=1e-6)
    for state, altitude in states(simulator, 0.0, 20.0):
        assert altitude == pytest.approx(airframe.altitude_m, abs=0.1)
        assert state.airspeed_m_s == pytest.approx(V, abs=0.02)
        place = np.array([1000.0, -500.0]) + velocity * state.time_s
        # At zero bank the torque of the propeller turns the aircraft by 0.01 degrees a second.
        assert state.heading_deg == pytest.approx(40.0, abs=0.4)
        assert (state.east_m, state.north_m) == pytest.approx(tuple(place), abs=2.0)


@both
def test_it_holds_altitude_and_airspeed_and_follows_the_bank(airframe):
    simulator, V = JsbsimAircraft(START, airframe), airframe.aircraft.airspeed_m_s
    limit = airframe.aircraft.max_bank_deg
    for bank in (limit, -limit, 0.0):
        for i, (state, altitude) in enumerate(states(simulator, bank, 15.0)):
            assert altitude == pytest.approx(airframe.altitude_m, abs=1.0)
            assert state.airspeed_m_s == pytest.approx(V, abs=0.5)
            if i >= 120:
                # Six seconds after the command.
                assert state.bank_deg == pytest.approx(bank, abs=1.0)


@both
def test_a_banked_turn_is_coordinated(airframe):
    # The course turns at g tan(bank)/V, except for the side force of the rudder that removes the slip (about 1 %),
    # gravity at the equator (0.3 %), and the bank of the nose, which is a little smaller than that of the lift.
    simulator, bank = JsbsimAircraft(START, airframe), airframe.aircraft.max_bank_deg
    *_, (before, _) = states(simulator, bank, 10.0)
    turned_deg = coordinated_deg = 0.0
    for state, _ in states(simulator, bank, 20.0):
        turned_deg += (course_deg(state) - course_deg(before)) % 360.0
        rate = STANDARD_GRAVITY_M_S2 * tan(radians(state.bank_deg)) / state.airspeed_m_s
        coordinated_deg += degrees(rate) * 0.05
        before = state
        # The nose is up by the angle of attack, about 4 degrees. In a bank it therefore points into the turn.
        assert -3.0 < (course_deg(state) - state.heading_deg + 180.0) % 360.0 - 180.0 < 0.6
    assert turned_deg == pytest.approx(coordinated_deg, rel=0.025)


@both
def test_a_bank_beyond_the_limit_is_not_flown(airframe):
    simulator = JsbsimAircraft(START, airframe)
    assert max(state.bank_deg for state, _ in states(simulator, 80.0, 8.0)) < airframe.aircraft.max_bank_deg + 1.5


@both
def test_it_rolls_as_its_airframe_says(airframe):
    roll = identified_roll(airframe)
    assert (roll.time_s, roll.rate_deg_s) == pytest.approx((airframe.roll.time_s, airframe.roll.rate_deg_s), rel=0.02)
    # This model predicts the bank in a step from level and in a reversal, rms and at worst.
    simulator, bank = JsbsimAircraft(START, airframe), 0.0
    limit = airframe.aircraft.max_bank_deg
    for command in (limit, -limit):
        missed = []
        for state, _ in states(simulator, command, 6.0, 0.02):
            bank = airframe.roll.bank_after(bank, command, 0.02)
            missed.append(bank - state.bank_deg)
        assert np.sqrt(np.mean(np.square(missed))) < 1.5
        assert np.max(np.abs(missed)) < 3.0


@both
def test_positions_agree_with_integrated_velocities(airframe):
    # Circling in wind. The trapezoidal rule does not use JSBSim's model of the earth.
    simulator = JsbsimAircraft(START, airframe, Wind(8.0, from_deg=250.0))
    before = simulator.true_state()
    east, north = before.east_m, before.north_m
    for state, _ in states(simulator, 20.0, 60.0):
        east += 0.5 * (before.velocity_east_m_s + state.velocity_east_m_s) * 0.05
        north += 0.5 * (before.velocity_north_m_s + state.velocity_north_m_s) * 0.05
        assert hypot(east - state.east_m, north - state.north_m) < 0.005
        before = state


def test_the_step_does_not_matter():
    # Steps are divided into equal parts of at most 1/120 s, so that 0.1 s and 1/400 s give the same flight.
    ends = []
    for step_s in (0.1, 1.0 / 400.0):
        simulator = JsbsimAircraft(START, AEROSONDE)
        *_, (state, _) = states(simulator, 25.0, 5.0, step_s)
        ends.append(state)
    assert ends[0] == pytest.approx(ends[1], abs=0.15)


@pytest.mark.parametrize("dt", [nan, inf, -0.05])
def test_a_step_must_be_finite_and_not_negative(dt):
    simulator = JsbsimAircraft(START, J3CUB)
    before = simulator.true_state()
    with pytest.raises(InvalidArgument, match=r"^dt is"):
        simulator.advance(banked(20.0), dt)
    assert simulator.true_state() == before


@both
def test_turbulence_has_the_given_strength(airframe):
    # The velocity of the air along the nose: the ground velocity less the airspeed, in nearly level flight. Gusts last
    # about 10 s, so that 400 s determine their strength to about a fifth.
    gust, V = 0.05, airframe.aircraft.airspeed_m_s
    simulator = JsbsimAircraft(START, airframe, gust=gust, seed=1)
    along = []
    for state, _ in states(simulator, 0.0, 400.0, 0.5):
        course = radians(state.heading_deg)
        along.append(
            state.velocity_east_m_s * sin(course) + state.velocity_north_m_s * cos(course) - state.airspeed_m_s
        )
    assert np.std(along) == pytest.approx(gust * V, rel=0.4)


@both
def test_it_stays_in_the_air_in_turbulence(airframe):
    # 5 % of the airspeed, turning left and right for a minute. A downdraught can exceed the Cub's rate of climb.
    simulator, limit = JsbsimAircraft(START, airframe, gust=0.05, seed=3), airframe.aircraft.max_bank_deg
    for bank in (limit, -limit, 0.0, -limit, limit, 0.0):
        for state, altitude in states(simulator, bank, 10.0, 0.1):
            assert abs(altitude - airframe.altitude_m) < 40.0
            assert abs(state.airspeed_m_s / airframe.aircraft.airspeed_m_s - 1.0) < 0.3
            assert abs(state.bank_deg) < limit + 5.0


def test_the_same_seed_gives_the_same_flight():
    def end(seed):
        simulator = JsbsimAircraft(START, AEROSONDE, seed=seed, gust=0.05, noise=Noise())
        for _ in states(simulator, 20.0, 5.0):
            pass
        return simulator.true_state(), simulator.measured_state()

    first, again, other = end(1), end(1), end(2)
    assert first == again
    assert hypot(first[0].east_m - other[0].east_m, first[0].north_m - other[0].north_m) > 0.01


def test_sensors_have_noise_and_delay():
    simulator = JsbsimAircraft(START, AEROSONDE, noise=Noise(delay_s=0.1))
    exact = JsbsimAircraft(START, AEROSONDE)
    assert exact.measured_state() == exact.true_state()
    for state, _ in states(simulator, 0.0, 1.0):
        measured = simulator.measured_state()
        assert measured.time_s == pytest.approx(state.time_s - 0.1)
        assert 0.0 < hypot(measured.east_m - state.east_m, measured.north_m - state.north_m) < 10.0


def test_jsbsim_prints_nothing(capfd):
    simulator = JsbsimAircraft(START, J3CUB)
    for _ in states(simulator, 20.0, 1.0):
        pass
    assert capfd.readouterr() == ("", "")


def test_without_jsbsim(monkeypatch):
    monkeypatch.setitem(sys.modules, "jsbsim", None)
    with pytest.raises(MissingPackage, match=r"six degrees of freedom need JSBSim.*pip install \"loiter\[sim\]\""):
        JsbsimAircraft(START, AEROSONDE)


def test_jsbsim_is_loaded_when_it_flies():
    program = "import sys, loiter.lab.simulators.jsbsim_aircraft; sys.exit('jsbsim' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", program], check=False).returncode == 0


def test_a_bad_gust_is_refused():
    with pytest.raises(InvalidArgument, match="gust is -1"):
        JsbsimAircraft(START, AEROSONDE, gust=-1.0)


# Beard and McLain's equations of motion in SI, from their tables: an oracle independent of the XML file.
M, JX, JZ, JXZ, S, B, C = 11.0, 0.8244, 1.759, 0.1204, 0.55, 2.8956, 0.18994


def test_the_aerosonde_trims_as_its_publication_says():
    fdm, trim = trimmed_model(AEROSONDE)
    rho, V = fdm["atmosphere/rho-slugs_ft3"] * 515.378819, 25.0
    alpha, elevator = fdm["aero/alpha-rad"], fdm["fcs/elevator-pos-rad"]
    q = 0.5 * rho * V * V * S
    # (4.9)-(4.11): far from the stall the lift is linear, to the 1e-8 of the blending function (4.10).
    lift = q * (0.23 + 5.61 * alpha + 0.13 * elevator)
    drag = q * (0.043 + (0.23 + 5.61 * alpha) ** 2 / (pi * 0.9 * B * B / S) + 0.0135 * elevator)
    # The motor's and the propeller's torque agree at the speed W of a quadratic (their supplement on propulsion).
    D, K, R, i0, volts = 0.508, 60.0 / (2.0 * pi * 145.0), 0.042, 1.5, 44.4 * trim.throttle
    a = rho * D**5 * 0.005230 / (4.0 * pi * pi)
    b = rho * D**4 * 0.004970 * V / (2.0 * pi) + K * K / R
    c = rho * D**3 * -0.01664 * V * V - K * volts / R + K * i0
    W = (-b + sqrt(b * b - 4.0 * a * c)) / (2.0 * a)
    J = 2.0 * pi * V / (W * D)
    thrust = rho * (W / (2.0 * pi)) ** 2 * D**4 * (0.09357 - 0.06044 * J - 0.1079 * J * J)
    weight = M * 9.80665
    # Level flight; gravity at the equator, where JSBSim flies, is 0.3 % less, and the turning earth carries 0.3 % more.
    assert lift + thrust * sin(alpha) == pytest.approx(weight, rel=0.008)
    assert thrust * cos(alpha) == pytest.approx(drag, rel=1e-3)
    assert 0.0135 - 2.74 * alpha - 0.99 * elevator == pytest.approx(0.0, abs=1e-5)
    # The aileron carries the propeller's torque.
    torque = K * ((volts - K * W) / R - i0)
    aileron, rudder = fdm["fcs/left-aileron-pos-rad"], fdm["fcs/rudder-pos-rad"]
    assert q * B * (0.17 * aileron + 0.0024 * rudder) == pytest.approx(torque, rel=1e-3)


@pytest.mark.parametrize(("surface", "roll", "yaw"), [("aileron", 0.17, -0.011), ("rudder", 0.0024, -0.069)])
def test_the_aerosonde_answers_its_surfaces_as_its_publication_says(surface, roll, yaw):
    # (3.17) with (5.1): the inertia couples roll and yaw, p' = G3 l + G4 n, r' = G4 l + G8 n.
    fdm, trim = trimmed_model(AEROSONDE)
    q = 0.5 * fdm["atmosphere/rho-slugs_ft3"] * 515.378819 * 25.0**2 * S * B
    G = JX * JZ - JXZ * JXZ

    def rates(share):
        fdm[f"fcs/{surface}-cmd-norm"] = getattr(trim, surface) + share
        fdm.run()
        return np.array([fdm["accelerations/pdot-rad_sec2"], fdm["accelerations/rdot-rad_sec2"]])

    still, moved = rates(0.0), rates(0.01)
    l, n = q * roll * 0.01 * 0.5236, q * yaw * 0.01 * 0.5236
    assert moved - still == pytest.approx(np.array([JZ * l + JXZ * n, JXZ * l + JX * n]) / G, rel=0.02)


@both
@pytest.mark.parametrize("law", ["optimal", "l1", "vector-field", "tangent"])
def test_laws_settle_in_six_degrees_of_freedom(airframe, law):
    # docs/jsbsim.md flies a hundred starts; here is one.
    (trial,) = campaign.trials(1, 5, airframe.aircraft)
    make_law = partial(campaign.LAWS[law], roll=airframe.roll)
    flown = campaign.outcome(0, trial, make_law, lambda trial: JsbsimAircraft(trial.ideal.start, airframe))
    assert flown.settled
    # No sooner than the fastest, but for the bounds that count as settled.
    assert trial.ideal.duration_s - 2.0 < flown.settled_s < 1.5 * trial.ideal.duration_s
