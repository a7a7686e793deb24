"""Both simulators, compared with plans and with a differential equation solved in small steps."""

from functools import partial
from math import cos, hypot, pi, radians, sin, tan

import numpy as np
import pytest
from hypothesis import given, settings

from guidance.flights import UAV
from loiter import Pose, Wind, plan
from loiter.errors import InvalidArgument
from loiter.guidance.protocol import Command, Phase
from loiter.guidance.vehicle import INSTANT_ROLL, Roll, rate_at_bank
from loiter.lab.simulators.kinematic import Kinematic
from loiter.lab.simulators.point_mass import PointMass
from loiter.lab.simulators.sensors import EXACT
from loiter.planning.model import STANDARD_GRAVITY_M_S2, Turn
from strategies import windy_scenes

START, WIND = Pose(-50.0, 20.0, 30.0), Wind(5.0, 250.0)


def command(bank_deg=0.0, rate_deg_s=None):
    rate = np.degrees(rate_at_bank(bank_deg, 18.0)) if rate_deg_s is None else rate_deg_s
    return Command(rate, bank_deg, Phase.STRAIGHT, 0.0, Turn.CW, Phase.HOLD, 0.0)


@settings(max_examples=25, deadline=None)
@given(windy_scenes())
def test_the_kinematic_vehicle_flies_a_plan(scene):
    pose, orbit, uav, wind = scene
    m = plan(pose, orbit, uav, wind)
    vehicle = Kinematic(pose, uav, wind)
    for segment in m.segments:
        rate = np.degrees(-segment.curvature_per_m * uav.airspeed_m_s)
        for _ in range(3):
            vehicle.advance(command(rate_deg_s=rate), segment.duration_s / 3.0)
    end = vehicle.true_state()
    assert end.time_s == pytest.approx(m.duration_s)
    scale = 1e-9 * (1.0 + orbit.distance_m(pose) + orbit.radius_m)
    assert hypot(end.east_m - m.join.east_m, end.north_m - m.join.north_m) < scale
    assert cos(radians(end.heading_deg - m.join.heading_deg)) == pytest.approx(1.0)


def test_the_kinematic_vehicle_keeps_its_turn_limit():
    vehicle = Kinematic(START, UAV)
    vehicle.advance(command(rate_deg_s=1000.0), 1.0)
    assert vehicle.true_state().bank_deg == pytest.approx(35.0)
    assert vehicle.measured_state() == vehicle.true_state()


@pytest.mark.parametrize("dt", [float("nan"), float("inf"), -0.1])
@pytest.mark.parametrize("make", [Kinematic, partial(PointMass, seed=1)])
def test_a_step_must_be_finite_and_not_negative(make, dt):
    vehicle = make(START, UAV)
    before = vehicle.true_state()
    with pytest.raises(InvalidArgument, match=r"^dt is"):
        vehicle.advance(command(20.0), dt)
    assert vehicle.true_state() == before


def runge_kutta(bank_command, time_s, roll, wind, steps=20_000):
    """East, north, heading and bank of the point mass in a steady wind, from its differential equation."""
    e, n = wind.velocity_m_s

    def rates(z):
        roll_rate = np.clip((bank_command - z[3]) / roll.time_s, -roll.rate_deg_s, roll.rate_deg_s)
        turn_rate = STANDARD_GRAVITY_M_S2 * tan(radians(z[3])) / 18.0
        return np.array([18.0 * sin(z[2]) + e, 18.0 * cos(z[2]) + n, turn_rate, roll_rate])

    z, h = np.array([START.east_m, START.north_m, radians(START.heading_deg), 0.0]), time_s / steps
    for _ in range(steps):
        k1 = rates(z)
        k2 = rates(z + 0.5 * h * k1)
        z = z + h * k2
    return z


def test_the_point_mass_obeys_its_equations():
    mass = PointMass(START, UAV, WIND, seed=1, gust=0.0, noise=EXACT)
    for _ in range(250):
        mass.advance(command(30.0), 0.02)
    east, north, heading, bank = runge_kutta(30.0, 5.0, Roll(), WIND)
    end = mass.true_state()
    # The error of the simulator's step, 0.02 s, is of second order: about 0.02^2 of 90 m.
    assert hypot(end.east_m - east, end.north_m - north) < 0.01
    assert end.heading_deg == pytest.approx(np.degrees(heading), abs=0.01)
    assert end.bank_deg == pytest.approx(bank, abs=1e-4)


def test_a_steady_bank_is_a_circle():
    mass = PointMass(START, UAV, seed=1, gust=0.0, noise=EXACT, roll=INSTANT_ROLL)
    for _ in range(1000):
        mass.advance(command(35.0), 2.0 * pi * UAV.turn_radius_m / 18.0 / 1000)
    end = mass.true_state()
    assert hypot(end.east_m - START.east_m, end.north_m - START.north_m) < 1e-9
    mass.advance(command(80.0), 0.02)
    assert mass.true_state().bank_deg == 35.0


def fly(seed):
    mass = PointMass(START, UAV, WIND, seed=seed)
    for i in range(100):
        mass.advance(command(20.0 * (-1.0) ** (i // 40)), 0.02)
    return mass.true_state(), mass.measured_state()


def test_the_same_seed_is_the_same_flight():
    assert fly(3) == fly(3)
    true, measured = fly(3)
    assert fly(4)[0] != true
    assert measured != true


def test_gusts_carry_the_aircraft_and_leave_its_airspeed():
    mass = PointMass(Pose(0.0, 0.0, 0.0), UAV, seed=5, gust=0.15, noise=EXACT)
    before = mass.true_state()
    mass.advance(command(), 0.02)
    after = mass.true_state()
    moved = (after.east_m - before.east_m) / 0.02, (after.north_m - before.north_m) / 0.02
    assert moved == pytest.approx((before.velocity_east_m_s, before.velocity_north_m_s), abs=1e-9)
    assert hypot(before.velocity_east_m_s, before.velocity_north_m_s - 18.0) > 0.1
    assert after.airspeed_m_s == 18.0
