"""The law that stays clear of a fence; the campaign is `python -m fences.closed_loop`."""

import pickle

import numpy as np
import pytest

from fences.sampling import clearance
from loiter import Aircraft, Orbit, Pose, Turn, Wind
from loiter.errors import InvalidArgument
from loiter.fences import CircleZone, Fence, PolygonZone, clear_entry
from loiter.fences.clear_entry import fastest_clear
from loiter.guidance.entry import fenced_entry
from loiter.guidance.entry.fenced_entry import FencedEntry, begin_search
from loiter.guidance.entry.loiter_entry import LoiterEntry
from loiter.guidance.vehicle import INSTANT_ROLL
from loiter.lab.simulators.kinematic import Kinematic
from loiter.lab.simulators.point_mass import PointMass
from loiter.lab.trials.flight import fly

UAV = Aircraft(18.0, max_bank_deg=35.0)
POSE, ORBIT = Pose(-450.0, 0.0, 90.0), Orbit(0.0, -200.0, 120.0, Turn.CW)
MAST = CircleZone("mast", -250.0, -75.0, 60.0)
FENCE = Fence((MAST,))
EXACT = {"roll": INSTANT_ROLL, "delay_s": 0.0, "reserve": 0.0, "smoothing_s": 0.0, "identify": False}


WALL = PolygonZone("wall", ((-260.0, -330.0), (-230.0, -330.0), (-230.0, 60.0), (-260.0, 60.0)))


def least_m(flight, zone=MAST):
    return float(clearance(zone, flight.track.east_m, flight.track.north_m).min())


@pytest.mark.parametrize("wind", [None, Wind(4.0, 200.0)])
def test_the_vehicle_of_the_theory_flies_the_clear_entry(wind):
    """It joins when that does, and keeps the margin along all its pieces, of which there are more than three."""
    fence = Fence((WALL,))
    found = clear_entry(fence, POSE, ORBIT, UAV, wind, 10.0).maneuver
    assert len(found.segments) > 3
    law = FencedEntry(ORBIT, UAV, wind, fence=fence, margin_m=10.0, **EXACT)
    flight = fly(law, Kinematic(POSE, UAV, wind), ORBIT, exact_switches=True)
    joined = next(t for t, phase in zip(flight.track.time_s, flight.phases, strict=False) if phase == "hold")
    assert joined == pytest.approx(found.duration_s, abs=0.05)
    assert least_m(flight, WALL) == pytest.approx(10.0, abs=0.1)
    assert least_m(fly(LoiterEntry.exact(ORBIT, UAV, wind), Kinematic(POSE, UAV, wind), ORBIT), WALL) < 0.0


def test_gusts_stay_within_the_margin():
    law = FencedEntry(ORBIT, UAV, fence=FENCE, margin_m=6.0)
    flight = fly(law, PointMass(POSE, UAV, seed=4), ORBIT)
    assert flight.settled
    assert law.problem == ""
    assert least_m(flight) > 2.0


def test_a_fence_that_is_not_in_the_way_changes_nothing():
    away = Fence((CircleZone("away", 0.0, 900.0, 50.0),))
    laws = FencedEntry(ORBIT, UAV, fence=away), LoiterEntry(ORBIT, UAV)
    tracks = [fly(law, PointMass(POSE, UAV, seed=4), ORBIT, limit_s=8.0).track for law in laws]
    assert np.array_equal(tracks[0].commanded_bank_deg, tracks[1].commanded_bank_deg)


def test_a_problem_is_said(monkeypatch):
    def problem(fence):
        law, mass = FencedEntry(ORBIT, UAV, fence=fence), PointMass(POSE, UAV, seed=4)
        for _ in range(30):
            mass.advance(law.step(mass.measured_state(), 0.02), 0.02)
        return law.problem

    on_circle = Fence((CircleZone("on it", 120.0, -200.0, 5.0),))
    assert problem(on_circle) == "No entry is clear: 'on it' blocks the circle itself, or every way to it."
    around = Fence((CircleZone("around", POSE.east_m, POSE.north_m, 9.0),))
    assert problem(around).startswith("its pose is inside the zone 'around'")
    monkeypatch.setattr(fenced_entry, "MOST_PIECES", 3)
    assert problem(FENCE).startswith("The fastest clear entry found joins ")


def test_errors_of_searches_come_from_other_processes():
    error = pickle.loads(pickle.dumps(InvalidArgument("pose", "is inside the zone")))
    assert (str(error), error.argument, error.problem) == ("pose is inside the zone", "pose", "is inside the zone")


def test_a_search_in_another_process_has_the_same_answer():
    problem = FencedEntry(ORBIT, UAV, fence=FENCE).problem_at(POSE, is_tight=False)
    assert begin_search(problem).get().sentence == fastest_clear(*problem).sentence


def test_an_entry_that_was_found_before_is_flown_from_the_beginning(monkeypatch):
    """No search is made for it, and the path is that of the entry although the aircraft begins 2 m beside it."""
    fence = Fence((WALL,))
    law = FencedEntry(ORBIT, UAV, fence=fence, margin_m=10.0)
    first = fastest_clear(*law.problem_at(POSE, is_tight=False)).maneuver
    assert law.begins_at(Pose(POSE.east_m, 2.0, 92.0), POSE)
    assert not law.begins_at(Pose(POSE.east_m, 0.0, 97.0), POSE)
    assert not law.begins_at(Pose(POSE.east_m, 8.0, 90.0), POSE)
    monkeypatch.setattr(fenced_entry, "fastest_clear", None)
    law = FencedEntry(ORBIT, UAV, fence=fence, margin_m=10.0, first=first)
    start = Pose(POSE.east_m, 2.0, 92.0)
    flight = fly(law, PointMass(start, UAV, seed=4, gust=0.0), ORBIT, limit_s=16.0)
    assert least_m(flight, WALL) > 5.0


def test_a_circle_that_moves_is_refused():
    with pytest.raises(InvalidArgument, match="moves: a fence is at rest"):
        FencedEntry(Orbit(0.0, 0.0, 120.0, velocity_east_m_s=1.0), UAV, fence=FENCE)
