"""The law that enters a slot and keeps it: in calm air as planned, in gusts within its band."""

from dataclasses import replace
from math import hypot, radians, tau

import numpy as np
import pytest

from guidance import slot_flights_in_c
from guidance.formation import bank_deg, phase_along, radius_m
from guidance.slots import GUST, LEAST_TURN, STEP_S, UAV, Result, _first, fly_into_slots, in_slots, scene
from loiter import Aircraft, Orbit, Pose, Slot, Turn, Wind, plan
from loiter.errors import InvalidArgument
from loiter.guidance.entry.slot_entry import SlotEntry
from loiter.guidance.entry.slot_step import SlotSettings, closing_s, phase_behind, slot_direction
from loiter.guidance.protocol import Command, Phase
from loiter.lab.simulators.point_mass import PointMass
from loiter.lab.simulators.sensors import Noise
from native.library import needs_compiler

ORBIT = Orbit(0.0, 0.0, 120.0, Turn.CCW)
POSE = Pose(-400.0, 120.0, 90.0)


@pytest.mark.parametrize("wind", [None, Wind(6.0, 250.0)])
@pytest.mark.parametrize("turn", [Turn.CW, Turn.CCW])
def test_the_slot_of_the_law_is_that_of_the_plan(wind, turn):
    orbit = replace(ORBIT, turn=turn)
    for at_s in (-100.0, 7.0):
        planned = plan(POSE, orbit, UAV, wind, slot=Slot(30.0, at_s))
        law = SlotEntry(orbit, UAV, wind, slot=Slot(30.0, at_s))
        assert law.phase_error_deg(planned.duration_s, planned.join.east_m, planned.join.north_m) == pytest.approx(
            0.0, abs=1e-6
        )


def test_the_error_of_phase_is_positive_behind():
    slot = SlotSettings(1, 0.0, 100.0, 20.0, 0.0, 0.0, 0.1)
    for time_s in (0.0, 3.0, 400.0):
        x, y = slot_direction(slot, time_s)
        ahead = time_s + 1.0
        later = slot_direction(slot, ahead)
        assert phase_behind(slot, x, y, ahead) == pytest.approx(0.2, abs=1e-9)
        assert phase_behind(slot, *later, time_s) == pytest.approx(-0.2, abs=1e-9)
    assert closing_s(slot, 0.25) == pytest.approx(0.2 * 100.0 / (0.1 * 20.0))
    assert closing_s(slot, -0.01) == 0.0


def flight(pose, orbit, slot, wind=None, gust=0.0, seed=1, time_s=90.0, flown=UAV, **options):
    """The errors of phase, the distances from the centre and the phases of a law in a simulation."""
    law, noise = SlotEntry(orbit, UAV, wind, slot=slot, **options), Noise()
    simulator = PointMass(pose, flown, wind, seed=seed, gust=gust, noise=noise)
    rows = []
    for _ in range(round(time_s / STEP_S)):
        command = law.step(simulator.measured_state(), STEP_S)
        simulator.advance(command, STEP_S)
        s = simulator.true_state()
        rows.append(
            (s.time_s, law.phase_error_deg(s.time_s, s.east_m, s.north_m), hypot(s.east_m, s.north_m), command.phase)
        )
    return rows


@pytest.mark.parametrize(
    ("bearing", "wind"),
    [(200.0, None), (80.0, None), (320.0, None), (200.0, Wind(5.0, 250.0)), (60.0, Wind(5.0, 20.0))],
)
def test_the_slot_is_entered_on_time_in_calm_air(bearing, wind):
    slot = Slot(bearing)
    ideal_s = plan(POSE, ORBIT, UAV, wind, slot=slot).duration_s
    rows = flight(POSE, ORBIT, slot, wind, time_s=ideal_s + 20.0)
    after = [row for row in rows if row[0] > ideal_s + 3.0]
    assert max(abs(row[1]) for row in after) < 5.0
    assert max(abs(row[2] / 120.0 - 1.0) for row in after) < 0.1
    assert after[0][3] == Phase.HOLD


def test_a_slot_that_was_missed_is_closed_up_to_within_the_band():
    """On the circle already, 25 degrees behind the slot: inside the circle the phase catches up, no path is flown."""
    start, slot = Pose(120.0, 0.0, 0.0), Slot(65.0)
    rows = flight(start, ORBIT, slot, time_s=60.0, band=0.1)
    assert {row[3] for row in rows} == {Phase.HOLD}
    assert 20.0 < rows[0][1] < 27.0
    assert abs(rows[-1][1]) < 3.0
    assert min(row[2] for row in rows) > 0.88 * 120.0


def test_a_faster_aircraft_holds_the_slot_on_a_wider_circle():
    """With a correction by the error of phase alone it would stay 4 degrees ahead."""
    rows = flight(Pose(120.0, 0.0, 0.0), ORBIT, Slot(90.0), time_s=50.0, flown=Aircraft(19.4, max_bank_deg=35.0))
    assert abs(rows[-1][1]) < 1.5
    assert rows[-1][2] == pytest.approx(120.0 * 19.4 / 18.0, rel=0.02)


@needs_compiler
def test_a_fleet_settles_in_gusts():
    given = scene(3, 2)
    result = in_slots(given, fly_into_slots(given, 3))
    assert result.joined_s < 1.1 * given.ideal_s


@needs_compiler
def test_the_campaign_flies_the_law_of_python():
    """Into the slot and 20 s along it, where the machine code has to be in step with Python's random numbers too."""
    slot, steps, wind = Slot(320.0), 1000, Wind(4.5, 250.0)
    law = SlotEntry(ORBIT, UAV, wind, slot=slot)
    simulator = PointMass(POSE, UAV, wind, seed=4, gust=GUST, noise=Noise())
    python = []
    for _ in range(steps):
        simulator.advance(law.step(simulator.measured_state(), STEP_S), STEP_S)
        state = simulator.true_state()
        python.append(complex(state.east_m, state.north_m))
    again = SlotEntry(ORBIT, UAV, wind, slot=slot)
    c = slot_flights_in_c.fly_into_slot(POSE, again, UAV, wind, 4, gust=GUST, steps=steps, step_s=STEP_S)
    assert c == pytest.approx(np.array(python), abs=1e-6)


@needs_compiler
def test_the_campaign_flies_the_published_law_of_python():
    side, least_m, steps = -1, LEAST_TURN * UAV.turn_radius_m, 400
    poses = [Pose(300.0, 0.0, 20.0), Pose(-100.0, 400.0, 100.0), Pose(-300.0, -50.0, 300.0)]
    flown = [PointMass(pose, UAV, seed=i, gust=GUST, noise=Noise()) for i, pose in enumerate(poses)]
    python = []
    for _ in range(steps):
        states = [simulator.measured_state() for simulator in flown]
        phases = [phase_along(state.east_m, state.north_m, side) for state in states]
        for i, (simulator, state) in enumerate(zip(flown, states, strict=True)):
            bank = bank_deg(state, side, max(radius_m(phases, i, 60.0), least_m), UAV.bank_deg(UAV.turn_radius_m))
            simulator.advance(Command(0.0, bank, Phase.HOLD, 0.0, Turn.CCW, Phase.HOLD, 0.0), STEP_S)
        python.append([complex(s.east_m, s.north_m) for s in (simulator.true_state() for simulator in flown)])
    small, each = replace(ORBIT, radius_m=60.0), {"least_m": least_m, "gust": GUST, "steps": steps, "step_s": STEP_S}
    c = slot_flights_in_c.fly_formation(poses, small, side, UAV, range(3), **each)
    assert c == pytest.approx(np.array(python).T, abs=1e-6)


def test_the_measure_of_the_campaign_needs_the_slot_the_circle_and_a_whole_turn():
    given = scene(3, 2)
    R, side = given.orbit.radius_m, given.side
    steps = int((given.plan.duration_s + 1.5 * tau * R / UAV.airspeed_m_s) / STEP_S)
    times = STEP_S * np.arange(1, steps + 1)
    bearings = [
        radians(slot.phase_deg) + side * (times - slot.at_s) * UAV.airspeed_m_s / R for slot in given.plan.slots
    ]
    exact = np.array([R * (np.sin(b) + 1j * np.cos(b)) for b in bearings])
    assert in_slots(given, exact) == Result(STEP_S, STEP_S)
    for wrong in (exact * np.exp(0.12j), 1.3 * exact, exact[::-1]):
        assert all(map(np.isnan, in_slots(given, wrong)))
    assert np.isnan(_first(np.where(times < 10.0, 0.0, 3.0), 1.0, 2.0, given))


def test_the_rival_draws_phases_apart():
    """Who is too close behind the next one flies a wider circle, and so falls back; equal intervals change nothing."""
    apart = [0.0, tau / 3.0, 2.0 * tau / 3.0]
    assert [radius_m(apart, i, 80.0) for i in range(3)] == pytest.approx([80.0] * 3)
    assert radius_m([0.3, *apart[1:]], 0, 80.0) > 80.0 + 5.0
    assert radius_m([-0.3, *apart[1:]], 0, 80.0) < 80.0 - 5.0


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        ({"orbit": replace(ORBIT, turn=Turn.EITHER)}, "orbit turn is either: a slot moves"),
        ({"band": 1.0}, "band is 1.0: it must be at least 0 and below 1"),
        ({"slot": 20.0}, "slot is 20.0"),
    ],
)
def test_what_cannot_be_is_refused(arguments, sentence):
    given = {"orbit": ORBIT, "aircraft": UAV, "slot": Slot(20.0)} | arguments
    with pytest.raises(InvalidArgument, match=sentence.replace("(", r"\(")):
        SlotEntry(**given)
