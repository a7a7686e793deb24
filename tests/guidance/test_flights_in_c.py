"""Flights by machine code, which the campaigns count: those of the law and the simulators in Python."""

import numpy as np
import pytest

from guidance.biased_trials import biased_trials
from guidance.flights_in_c import COLUMNS, fly_in_c
from loiter.guidance.entry.loiter_entry import LoiterEntry
from loiter.lab.trials.flight import STEP_S, fly
from loiter.lab.trials.varied import varied_point_mass, varied_trials
from native.library import needs_compiler

pytestmark = needs_compiler

# Rolls of both orders, outages, measurements at 3 to 20 a second; gusts, wind and banks at the start.
FLIGHTS = [(biased_trials(20, 101)[i], 0.0) for i in (3, 6, 19)] + [(varied_trials(3, 17)[2], 0.05)]


@pytest.mark.parametrize(("trial", "gust"), FLIGHTS)
def test_a_flight_in_c_is_the_flight_in_python(trial, gust):
    law, limit_s = LoiterEntry(trial.ideal.orbit, trial.declared, trial.known_wind), 40.0
    python = fly(law, varied_point_mass(trial, gust), trial.ideal.orbit, limit_s=limit_s)
    c = fly_in_c(trial, gust, limit_s=limit_s, track=True)
    assert c.settled_s == pytest.approx(python.settled_s, abs=1e-9, nan_ok=True)
    assert c.joined_s == pytest.approx(python.joined_s, abs=1e-9, nan_ok=True)
    assert c.turned_deg == pytest.approx(python.turned_deg, abs=1e-9)
    for name in COLUMNS.split()[:7]:
        # The last row of Python's track is the state after the last command.
        assert c.track[name] == pytest.approx(getattr(python.track, name)[:-1], abs=1e-9), name
    assert c.track["command_deg"] == pytest.approx(python.track.commanded_bank_deg[:-1], abs=1e-9)


@pytest.mark.parametrize("i", [6, 7])
def test_a_law_that_knows_the_roll_knows_each_bank_before_it_is_flown(i):
    """The bank that it models is that of the aircraft a dead time later, but for the part of a step."""
    trial = biased_trials(20, 101)[i]
    flown = fly_in_c(trial, limit_s=20.0, knows_roll=True, track=True).track
    ahead = round(getattr(trial.response, "dead_time_s", 0.0) / STEP_S)
    true, modelled = flown["bank_deg"][ahead:], flown["modelled_deg"][: len(flown["bank_deg"]) - ahead]
    assert max(np.abs(true)) > 20.0
    assert modelled == pytest.approx(true, abs=0.51 * STEP_S * trial.response.rate_deg_s + 1e-9)
