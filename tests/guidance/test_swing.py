"""An aircraft whose course turns twice as fast as its bank says near 0.8 Hz, as ArduPlane's simulated one does.

Its bank and course answer as measured there: a dead time of 0.18 s, a second-order roll, and a resonance of the slip,
so that the course is ahead of the bank where it swings, and the heading hardly moves.
"""

from math import cos, degrees, hypot, pi, radians, sin, tan

import numpy as np
import pytest

from loiter import Aircraft, Orbit
from loiter.guidance.entry.loiter_entry import LoiterEntry
from loiter.guidance.estimation.observer import (
    CALM_ALONG,
    TURN_CHANGE,
    AirMotion,
    along_roughness,
    average_air,
    first_air,
    first_observer,
    observe,
    restart_gusts,
    roughness,
)
from loiter.guidance.protocol import Phase, State
from loiter.guidance.vehicle import Roll
from loiter.planning.model import STANDARD_GRAVITY_M_S2

STEP_S, AIRSPEED_M_S = 0.025, 23.5


class SwingingAircraft:
    """Level flight at `AIRSPEED_M_S` in still air, with exact measurements."""

    FREQUENCY, DAMPING, OF_COURSE, OF_HEADING = 2.0 * pi * 0.82, 0.35, 1.1, 0.6
    ROLL_FREQUENCY, ROLL_DAMPING, DEAD_STEPS, SUBSTEPS = 7.0, 0.45, 7, 8

    def __init__(self, east_m, north_m, heading_deg):
        self.time_s, self.east_m, self.north_m = 0.0, east_m, north_m
        self.course = self.heading = radians(heading_deg)
        self.bank_deg = self.roll_rate = self.slip = self.slip_rate = 0.0
        self.commands = [0.0] * self.DEAD_STEPS

    def state(self):
        V, course = AIRSPEED_M_S, self.course
        heading_deg = degrees(self.heading) % 360.0
        return State(
            self.time_s, self.east_m, self.north_m, heading_deg, self.bank_deg, V * sin(course), V * cos(course), V
        )

    def advance(self, command_deg):
        self.commands.append(command_deg)
        wanted_deg, dt = self.commands.pop(0), STEP_S / self.SUBSTEPS
        for _ in range(self.SUBSTEPS):
            w = self.ROLL_FREQUENCY
            self.roll_rate += dt * (w * w * (wanted_deg - self.bank_deg) - 2.0 * self.ROLL_DAMPING * w * self.roll_rate)
            self.bank_deg += dt * self.roll_rate
            rate = STANDARD_GRAVITY_M_S2 * tan(radians(self.bank_deg)) / AIRSPEED_M_S
            w, damping = self.FREQUENCY, 2.0 * self.DAMPING * self.FREQUENCY
            self.slip_rate += dt * (rate - w * w * self.slip - damping * self.slip_rate)
            self.slip += dt * self.slip_rate
            resonance = damping * self.slip_rate
            self.course += dt * (rate + self.OF_COURSE * resonance)
            self.heading += dt * (rate - self.OF_HEADING * resonance)
            self.east_m += dt * AIRSPEED_M_S * sin(self.course)
            self.north_m += dt * AIRSPEED_M_S * cos(self.course)
        self.time_s += STEP_S


@pytest.mark.parametrize("start", [(60.0, -90.0, 20.0), (-260.0, 130.0, 80.0)])
def test_the_circle_is_held_without_a_swing(start):
    """Turns before the circle look like gusts, and a gain for gusts made the bank swing by 2 to 4 degrees."""
    orbit, aircraft = Orbit(0.0, 0.0, 120.0), SwingingAircraft(*start)
    law = LoiterEntry(orbit, Aircraft(AIRSPEED_M_S, max_bank_deg=44.5), roll=Roll(0.125, 90.0))
    joined_s, banks, outside = None, [], []
    while joined_s is None or aircraft.time_s < joined_s + 10.0:
        command = law.step(aircraft.state(), STEP_S)
        if joined_s is None and command.phase == Phase.HOLD:
            joined_s = aircraft.time_s
            assert law._memory.sensing.observer.air.along == CALM_ALONG
        if joined_s is not None and aircraft.time_s > joined_s + 3.0:
            banks.append(aircraft.bank_deg)
            outside.append(hypot(aircraft.east_m, aircraft.north_m) - orbit.radius_m)
        aircraft.advance(command.bank_deg)
        assert aircraft.time_s < 60.0
    assert np.std(banks) < 1.5
    assert max(map(abs, outside)) < 0.03 * orbit.radius_m


def rough(along_m_s, across_m_s, swing_deg=0.0):
    """What both measures of gusts say after 20 s of gusts that change like random walks, in a straight flight east.

    The amounts are the changes in a second (root mean square); the course swings by the slip, in degrees, at 0.8 Hz.
    """
    V, random = 20.0, np.random.default_rng(3)
    gusts, observer = np.zeros(2), restart_gusts(first_observer(0.5))
    for i in range(800):
        gusts += random.standard_normal(2) * (along_m_s, across_m_s) * np.sqrt(STEP_S)
        slip = radians(swing_deg) * sin(2.0 * pi * 0.8 * i * STEP_S)
        state = State(i * STEP_S, V * i * STEP_S, 0.0, 90.0, 0.0, V * cos(slip) + gusts[0], V * sin(slip) + gusts[1], V)
        observer = observe(observer, state, 0.0, 0.5)
    return roughness(observer) * V, along_roughness(observer) * V


def test_gusts_along_the_flight_count():
    both, along = rough(0.6, 0.6)
    assert both == pytest.approx(0.6, rel=0.3)
    assert along == pytest.approx(0.6, rel=0.4)


def test_a_swing_of_the_slip_is_no_gust_along_the_flight():
    both, along = rough(0.0, 0.0, swing_deg=2.0)
    assert both > 0.4
    assert along < 0.05


def test_a_difference_over_which_the_turn_rate_changes_counts_half():
    air = first_air()
    for _ in range(80):
        air = average_air(air, 1.0, 2.0, STEP_S, 0.5)
    turning = average_air(air, 1.0, 2.0, STEP_S, 0.5, AirMotion(1.0, 0.0, TURN_CHANGE))
    assert turning.along.known_s - air.along.known_s == pytest.approx(0.5 * STEP_S)
