"""A wind that changes in flight: how soon the law knows it, and what is not taken for a change."""

from math import cos, degrees, exp, hypot, pi, sin

import numpy as np
import pytest

from loiter import Aircraft, Orbit, Pose, Wind
from loiter.guidance.entry.loiter_entry import LoiterEntry
from loiter.guidance.estimation.identification_step import advance_identification, first_identification, settings_of
from loiter.guidance.estimation.wind_fit import CHANGED_S, NO_CHANGE, add_difference
from loiter.guidance.protocol import State
from loiter.guidance.vehicle import Roll, rate_at_bank
from loiter.lab.simulators.point_mass import PointMass
from loiter.lab.simulators.sensors import Noise
from loiter.lab.trials.flight import fly
from loiter.planning.compass import heading_vector

UAV, STEP_S = Aircraft(22.0, max_bank_deg=45.0), 0.02
NOISE, SLIPPING = Noise(0.5, 0.5, 0.5, 0.2, 0.2, 0.24), Aircraft(22.5, max_bank_deg=44.5)


def flown(orbit, start, change_s, velocity, seed):
    """The wind that the law believes 3 s after a change, and the distances from the circle from 5 s after joining."""
    vehicle = PointMass(start, UAV, seed=seed, roll=Roll(0.3, 90.0), gust=0.02, noise=NOISE)
    law, believed, outside, joined_s = LoiterEntry(orbit, UAV), None, [], None
    for k in range(round(90.0 / STEP_S)):
        now_s = k * STEP_S
        if now_s >= change_s:
            vehicle._wind = velocity
        command = law.step(vehicle.measured_state(), STEP_S)
        vehicle.advance(command, STEP_S)
        if believed is None and now_s >= change_s + 3.0:
            believed = law.estimates.wind_east_m_s, law.estimates.wind_north_m_s
        joined_s = now_s if joined_s is None and command.time_to_join_s == 0.0 else joined_s
        if joined_s is not None and now_s > joined_s + 5.0:
            state = vehicle.true_state()
            outside.append(abs(hypot(state.east_m, state.north_m) - orbit.radius_m))
    return believed, outside


@pytest.mark.parametrize("seed", range(6))
@pytest.mark.parametrize("change_s", [3.0, 40.0])
def test_a_wind_that_changes_is_known_after_three_seconds(seed, change_s):
    random = np.random.default_rng(seed)
    distance, azimuth, heading = random.uniform((300.0, -pi, 0.0), (1200.0, pi, 360.0))
    towards = random.uniform(-pi, pi)
    velocity = 12.0 * sin(towards), 12.0 * cos(towards)
    start = Pose(distance * sin(azimuth), distance * cos(azimuth), heading)
    believed, outside = flown(Orbit(0.0, 0.0, 250.0, "cw"), start, change_s, velocity, seed)
    assert hypot(believed[0] - velocity[0], believed[1] - velocity[1]) < 1.3
    if change_s < 10.0:
        # Before the circle is reached nothing is lost; a change on the circle moves any aircraft off it.
        assert max(outside) < 5.0


@pytest.mark.parametrize("seed", range(3))
def test_an_airspeed_that_is_measured_too_low_is_no_wind_once_a_circle_was_flown(seed):
    """ArduPlane's in warm air is: as a wind it would turn with the aircraft, by 1.7 m/s in half a turn.

    The wind is the mean velocity of the air since the step, with its gusts.
    """
    random = np.random.default_rng(seed)
    towards = random.uniform(-pi, pi)
    velocity, orbit = (12.0 * sin(towards), 12.0 * cos(towards)), Orbit(0.0, 0.0, 250.0, "cw")
    start = Pose(*random.uniform(-300.0, 300.0, 2), random.uniform(0.0, 360.0))
    vehicle = PointMass(start, UAV, seed=seed, roll=Roll(0.3, 90.0), gust=0.02, noise=NOISE)
    law, air, off, change_s = LoiterEntry(orbit, UAV), [], [], 60.0
    for k in range(round((change_s + 30.0) / STEP_S)):
        now_s = k * STEP_S
        if now_s >= change_s:
            vehicle._wind = velocity
        state = vehicle.measured_state()
        command = law.step(state._replace(airspeed_m_s=0.96 * state.airspeed_m_s), STEP_S)
        vehicle.advance(command, STEP_S)
        if now_s >= change_s:
            air.append(vehicle._air_velocity())
        if now_s >= change_s + 3.0:
            east, north = np.mean(air, axis=0)
            off.append(hypot(law.estimates.wind_east_m_s - east, law.estimates.wind_north_m_s - north))
    assert max(off) < 0.8


def test_an_aircraft_that_turns_into_a_new_wind_turns_as_its_bank_says():
    """After a step of the wind the nose turns into it within a second, by up to a third of a radian."""
    V, ratio, bank_deg, dt = 22.0, 0.9, 30.0, 0.1
    declared = LoiterEntry(Orbit(0.0, 0.0, 250.0), Aircraft(V, max_bank_deg=45.0)).estimates
    settings, heading_deg, time_s = settings_of(declared, 45.0, 0.0), 0.0, 0.0
    memory = first_identification(settings)
    rate_deg_s = ratio * degrees(rate_at_bank(bank_deg, V))
    for wind_m_s in 400 * (0.0,) + 60 * (12.0,):
        heading_deg += rate_deg_s * dt
        nose_deg = heading_deg + 20.0 * (1.0 - exp(-max(time_s - 40.0, 0.0) / 0.4))
        c, s = heading_vector(nose_deg)
        state = State(time_s, 0.0, 0.0, nose_deg % 360.0, bank_deg, V * c, V * s + wind_m_s, V)
        memory = advance_identification(memory, settings, state, bank_deg, dt)
        time_s += dt
        if wind_m_s == 0.0:
            before = memory.estimates.turn_ratio
    assert before == pytest.approx(ratio, abs=0.02)
    assert memory.estimates.turn_ratio == pytest.approx(before, abs=0.03)


def changes(differences):
    """The memory after differences, 0.1 s apart, and for each whether the wind has changed."""
    change, found = NO_CHANGE, []
    for east, north in differences:
        change, has_changed = add_difference(change, east, north, 22.0, 0.1)
        found.append(has_changed)
    return change, found


def test_a_gust_is_no_change_of_the_wind():
    gust = range(200, 200 + round(0.8 * CHANGED_S / 0.1))
    change, found = changes([(9.0 if k in gust else 0.5, 0.0) for k in range(400)])
    assert not any(found)
    assert change.since_s == 0.0


def test_a_change_is_what_differs_once_the_aircraft_flies_along_its_nose_again():
    """In the first half second after a step of the wind it slips, and what differs is not the change of the wind."""
    differences = [(0.5, 0.0)] * 100 + [(3.0, 9.0)] * 5 + [(8.0, -4.0)] * 100
    _, found = changes(differences)
    steps = found.index(True) - 99
    assert CHANGED_S <= 0.1 * steps <= CHANGED_S + 0.5
    change, _ = changes(differences[: 100 + steps])
    assert (change.swift_east_m_s, change.swift_north_m_s) == pytest.approx((8.0, -4.0), abs=0.5)


def test_in_constant_gusts_a_change_must_be_larger():
    """Where differences of 0.2 airspeeds are usual, one of 0.3 is no change."""
    random = np.random.default_rng(4)
    _, found = changes([*(0.2 * 22.0 * random.normal(size=(3000, 2))), *[(0.3 * 22.0, 0.0)] * 10])
    assert sum(found[:3000]) <= 2
    assert not any(found[3000:])


@pytest.mark.parametrize(
    ("start", "radius_m", "settles_s"),
    [(Pose(0.0, 0.0, 60.0), 110.0, 10.4), (Pose(-20.0, 10.0, 330.0), 90.0, 11.5)],
)
def test_a_breath_of_wind_costs_no_time(start, radius_m, settles_s):
    """In wind plans are made anew only where they deviate; with 0.4 m/s of it these took 4 s longer."""
    orbit, wind = Orbit(0.0, 0.0, radius_m, "cw"), Wind(0.4, 200.0)
    vehicle = PointMass(start, SLIPPING, wind, seed=0, roll=Roll(0.1, 90.0), gust=0.0, noise=NOISE, turn_ratio=0.88)
    assert fly(LoiterEntry(orbit, SLIPPING, wind), vehicle, orbit).settled_s == pytest.approx(settles_s, abs=0.7)
