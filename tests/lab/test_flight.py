"""Flights and their measures, with a law of constant bank that is correct from the start."""

from math import isnan, nan, pi

import numpy as np
import pytest

from guidance.flights import UAV
from loiter import Orbit, Pose
from loiter.errors import InvalidArgument
from loiter.guidance.protocol import Command, Phase
from loiter.lab.simulators.kinematic import Kinematic
from loiter.lab.trials.flight import fly
from loiter.planning.model import Turn

ORBIT = Orbit(0.0, 0.0, 90.0)
ON_IT = Pose(0.0, 90.0, 90.0)


class OneRate:
    """Turns at a constant rate; its time to join falls correctly except for one jump of half a second."""

    def __init__(self, rate_deg_s, events=()):
        self.rate_deg_s, self.events, self.steps = rate_deg_s, list(events), []

    def step(self, state, dt):
        self.steps.append(state.time_s)
        to_join = 5.0 - state.time_s + (0.5 if state.time_s > 1.05 else 0.0)
        phase = Phase.HOLD if state.time_s >= 2.0 - 1e-9 else Phase.RIGHT
        ahead = [event - state.time_s for event in self.events if event > state.time_s + 1e-12]
        return Command(self.rate_deg_s, 20.0, phase, to_join, Turn.CW, Phase.HOLD, ahead[0] if ahead else nan)


def circling_flight(**how):
    return fly(OneRate(np.degrees(18.0 / 90.0)), Kinematic(ON_IT, UAV), ORBIT, **how)


def test_a_flight_on_the_circle_settles_at_once():
    flight = circling_flight()
    assert flight.settled
    assert flight.settled_s == flight.joined_s == flight.distance_m == flight.turned_deg == 0.0
    assert flight.overshoot_m < 1e-9
    # A full turn, up to the last step.
    assert flight.track.time_s[-1] == pytest.approx(2.0 * pi * 90.0 / 18.0, abs=0.021)
    assert len(flight.phases) == flight.track.time_s.size - 1
    # The bank changes once, in the first step, to the bank of the circle.
    bank, last_s = flight.track.bank_deg[-1], flight.track.time_s[-1]
    assert flight.bank_rate_deg_s == pytest.approx((bank**2 / 0.02 / last_s) ** 0.5)


def test_the_time_to_join_is_compared_with_the_clock():
    # 19 steps of 0.1 s up to the hold at 2 s, one of them off by half a second.
    assert circling_flight().join_error_s == pytest.approx(0.5 / 19.0**0.5, rel=1e-6)


def test_a_flight_that_does_not_settle_stops_at_the_limit():
    flight = fly(OneRate(0.0), Kinematic(ON_IT, UAV), ORBIT, limit_s=3.0, step_s=0.5)
    assert not flight.settled
    assert isnan(flight.settled_s)
    assert isnan(flight.joined_s)
    assert flight.track.time_s == pytest.approx(np.arange(0.0, 3.01, 0.5))
    assert flight.distance_m == pytest.approx(3.0 * 18.0)


def test_a_step_ends_with_its_phase():
    law = OneRate(0.0, events=[0.25, 0.3])
    fly(law, Kinematic(ON_IT, UAV), ORBIT, limit_s=0.5, step_s=0.1, exact_switches=True)
    assert law.steps == pytest.approx([0.0, 0.1, 0.2, 0.25, 0.3, 0.4])


@pytest.mark.parametrize("how", [{"step_s": 0.0}, {"limit_s": -1.0}, {"step_s": nan}])
def test_times_are_positive(how):
    with pytest.raises(InvalidArgument, match=r"^(step|limit)_s is "):
        circling_flight(**how)
