"""Legs and fences in tables: each row as a single plan, and what is wrong with the others."""

import csv
import subprocess
import sys
from dataclasses import replace
from math import isnan, nan

import numpy as np
import pandas as pd
import pytest

import loiter
from loiter import Aircraft, Orbit, Pose, Turn, plan, plan_leg
from loiter.errors import InvalidArgument
from loiter.fences import CircleZone, Fence, PlacedCircle, PlacedFence, clear_entry
from loiter.geo import LocalFrame
from planning.legs import random_leg

UAV = Aircraft(18.0, max_bank_deg=35.0, climb_rate_m_s=2.5, descent_rate_m_s=3.0)
ORBIT, MAST = Orbit(0.0, 0.0, 80.0), CircleZone("mast", -150.0, 90.0, 60.0)
COLUMNS = {"east_m": [-400.0, -400.0, 300.0], "north_m": [120.0, 120.0, 50.0], "heading_deg": [90.0, 45.0, 270.0]}


@pytest.mark.parametrize("windy", [False, True])
def test_each_row_is_its_leg(windy):
    random = np.random.default_rng(8)
    legs = [random_leg(random, windy) for _ in range(25)]
    frame = pd.DataFrame([row_of(leg, uav, wind) for leg, uav, wind in legs])
    table = loiter.tables.plan(frame)
    assert (table["status"] == "ok").all()
    for (leg, uav, wind), (_, row) in zip(legs, table.iterrows(), strict=True):
        p = plan_leg(leg, uav, wind)
        assert (row["word"], row["turn"]) == (p.entry.word, p.turn.value)
        assert row["duration_s"] == pytest.approx(p.entry.duration_s)
        assert row[["held_s", "held_deg", "exit_s", "arrival_s"]].tolist() == pytest.approx(
            [p.held_s, p.held_deg, p.exit_s, p.duration_s]
        )
        assert row[["join_east_m", "join_north_m"]].tolist() == pytest.approx(
            [p.entry.join.east_m, p.entry.join.north_m]
        )
        assert row[["duration_1_s", "duration_2_s", "duration_3_s"]].sum() == pytest.approx(p.entry.duration_s)


def row_of(leg, uav, wind):
    """A leg as a row; without an altitude at the exit that of the start."""
    altitude_m = leg.pose.altitude_m if leg.altitude_m is None else leg.altitude_m
    return {
        "east_m": leg.pose.east_m,
        "north_m": leg.pose.north_m,
        "heading_deg": leg.pose.heading_deg,
        "altitude_m": leg.pose.altitude_m,
        "orbit_east_m": leg.orbit.east_m,
        "orbit_north_m": leg.orbit.north_m,
        "orbit_radius_m": leg.orbit.radius_m,
        "turn": leg.orbit.turn.value,
        "airspeed_m_s": uav.airspeed_m_s,
        "max_bank_deg": uav.max_bank_deg,
        "climb_rate_m_s": uav.climb_rate_m_s,
        "descent_rate_m_s": uav.descent_rate_m_s,
        "wind_speed_m_s": wind.speed_m_s,
        "wind_from_deg": wind.from_deg,
        "exit_east_m": leg.exit_to[0],
        "exit_north_m": leg.exit_to[1],
        "hold_s": leg.hold_s,
        "turns": leg.turns,
        "exit_altitude_m": altitude_m,
    }


WRONG = {
    "a point in the circle": {"exit_east_m": 10.0},
    "no point": {"exit_north_m": nan},
    "a hold below zero": {"hold_s": -1.0},
    "no hold": {"hold_s": nan},
    "turns below zero": {"turns": -1.0},
    "no altitude at the start": {"altitude_m": nan},
    "no altitude at the exit": {"exit_altitude_m": nan},
    "a climb without a rate": {"exit_altitude_m": 900.0},
    "a circle that moves": {"orbit_velocity_east_m_s": 1.0},
}


@pytest.mark.parametrize("wrong", WRONG)
def test_a_wrong_leg_has_a_status_and_leaves_the_others(wrong):
    good = dict.fromkeys(("east_m", "heading_deg", "exit_north_m", "hold_s", "turns"), 0.0) | {
        "north_m": 200.0, "altitude_m": 100.0, "exit_altitude_m": 50.0, "exit_east_m": 500.0,
        "orbit_velocity_east_m_s": 0.0, "orbit_velocity_north_m_s": 0.0,
    }  # fmt: skip
    table = loiter.tables.plan(
        pd.DataFrame([good, good | WRONG[wrong]]), orbit=ORBIT, aircraft=replace(UAV, climb_rate_m_s=None)
    )
    assert table["status"].tolist() == ["ok", "bad_leg"]
    assert table["arrival_s"].isna().tolist() == [False, True]
    assert table["duration_s"].isna().tolist() == [False, True]
    assert table["turn"].tolist()[1] == ""


@pytest.mark.parametrize("margin_m", [None, 12.0])
def test_each_row_is_checked_against_the_fence(margin_m):
    fence = Fence((MAST,))
    frame = pd.DataFrame(COLUMNS)
    table = loiter.tables.plan(frame, orbit=ORBIT, aircraft=UAV, fence=fence, margin_m=margin_m)
    entered = 0
    for values, (_, row) in zip(zip(*COLUMNS.values(), strict=True), table.iterrows(), strict=True):
        m = plan(Pose(*values), ORBIT, UAV)
        check, clear = (
            fence.check(m, margin_m),
            clear_entry(fence, Pose(*values), ORBIT, UAV, margin_m=margin_m).maneuver,
        )
        assert row["duration_s"] == pytest.approx(m.duration_s)
        assert row["clearance_m"] == pytest.approx(check.clearance_m)
        assert row["clear_duration_s"] == pytest.approx(clear.duration_s)
        assert row["zone"] == ("" if check.clear else "mast")
        assert isnan(row["zone_s"]) if check.clear else row["zone_s"] == pytest.approx(check.breaches[0].time_s)
        entered += not check.clear
    assert 0 < entered < 3


def test_a_start_in_a_zone_has_a_status():
    table = loiter.tables.plan(
        pd.DataFrame(COLUMNS), orbit=ORBIT, aircraft=UAV, fence=Fence((CircleZone("m", 300.0, 50.0, 9.0),))
    )
    assert table["status"].tolist() == ["ok", "ok", "bad_fence"]
    assert isnan(table["duration_s"][2])


def test_on_earth_the_exit_and_the_fence_are_in_degrees():
    frame = LocalFrame(47.1, 8.23)
    pose, point, zone = (frame.place(Pose(*place, 90.0)) for place in ((-400.0, 120.0), (600.0, 0.0), (-150.0, 90.0)))
    fence = PlacedFence((PlacedCircle("mast", zone.latitude_deg, zone.longitude_deg, 60.0),))
    row = {
        "latitude_deg": pose.latitude_deg, "longitude_deg": pose.longitude_deg, "heading_deg": pose.heading_deg,
        "exit_latitude_deg": point.latitude_deg, "exit_longitude_deg": point.longitude_deg, "hold_s": 30.0,
    }  # fmt: skip
    shared = {"aircraft": UAV, "fence": fence, "margin_m": 5.0}
    one = loiter.tables.plan(pd.DataFrame([row]), orbit=ORBIT, origin=frame, **shared)
    own = {"orbit_latitude_deg": 47.1, "orbit_longitude_deg": 8.23, "orbit_radius_m": 80.0}
    other = loiter.tables.plan(pd.DataFrame([row | own]), **shared)
    p = plan_leg(loiter.Leg(Pose(-400.0, 120.0, 90.0), ORBIT, (600.0, 0.0), hold_s=30.0), UAV)
    check = fence.local(frame).check(p, 5.0)
    for table in (one, other):
        assert table["arrival_s"][0] == pytest.approx(p.duration_s, abs=1e-6)
        assert table["clearance_m"][0] == pytest.approx(check.clearance_m, abs=1e-5)
        assert table["zone"][0] == "mast"


def test_units_of_mapped_columns():
    frame = pd.DataFrame(
        {**COLUMNS, "X [km]": [0.6] * 3, "exit_north_m": [0.0] * 3, "wait_min": [1.0] * 3, "n": [2] * 3}
    )
    mapped = {"exit_east_m": "X [km]", "hold_s": "wait_min", "turns": "n"}
    table = loiter.tables.plan(frame, orbit=ORBIT, aircraft=UAV, columns=mapped)
    leg = loiter.Leg(Pose(-400.0, 120.0, 90.0), ORBIT, (600.0, 0.0), hold_s=60.0, turns=2.0)
    assert table["arrival_s"][0] == pytest.approx(plan_leg(leg, UAV).duration_s)


@pytest.mark.parametrize(
    ("changes", "sentence"),
    [
        ({"margin_m": 5.0}, "margin_m has no effect without a fence"),
        ({"fence": "here"}, r"fence is 'here': it must be a loiter\.fences\.Fence"),
        ({"fence": PlacedFence((PlacedCircle("m", 47.0, 8.0, 9.0),))}, "fence is in degrees, and the positions of"),
        ({"fence": Fence((MAST,)), "margin_m": -1.0}, "margin_m is -1.0"),
    ],
)
def test_wrong_fences(changes, sentence):
    with pytest.raises(InvalidArgument, match=sentence):
        loiter.tables.plan(pd.DataFrame(COLUMNS), orbit=ORBIT, aircraft=UAV, **changes)


def test_half_a_point_and_two_rates_are_refused():
    half = pd.DataFrame({**COLUMNS, "exit_east_m": [600.0] * 3})
    with pytest.raises(InvalidArgument, match="has a column exit_east_m but no exit_north_m"):
        loiter.tables.plan(half, orbit=ORBIT, aircraft=UAV)
    both = pd.DataFrame({**COLUMNS, "exit_east_m": [600.0] * 3, "exit_north_m": [0.0] * 3, "climb_rate_m_s": [1.0] * 3})
    with pytest.raises(InvalidArgument, match="aircraft climb_rate_m_s is given, and by the table's column"):
        loiter.tables.plan(both, orbit=ORBIT, aircraft=UAV)
    # Of a table without a point such a column is just carried.
    assert "climb_rate_m_s" in loiter.tables.plan(
        both.drop(columns=["exit_east_m", "exit_north_m"]), orbit=ORBIT, aircraft=UAV
    )


def test_the_command_reads_a_fence_and_writes_legs(tmp_path):
    rows = (
        "id,east_m,north_m,heading_deg,exit_east_m,exit_north_m,hold_s\na,-400,120,90,600,0,30\nb,-400,120,90,20,0,30\n"
    )
    (tmp_path / "legs.csv").write_text(rows)
    (tmp_path / "fence.csv").write_text("zone,rule,east_m,north_m,radius_m\nmast,out,-150,90,60\n")
    options = ["--orbit", "0", "0", "80", "--airspeed", "18", "--bank", "35", "--fence", "fence.csv", "--margin", "5"]
    command = [sys.executable, "-m", "loiter", "batch", "legs.csv", "out.csv", *options]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=True)
    assert "1 bad_leg: a leg needs a circle that stands still" in done.stderr
    first, second = csv.DictReader((tmp_path / "out.csv").read_text().splitlines())
    assert (first["zone"], first["status"], second["status"]) == ("mast", "ok", "bad_leg")
    assert float(first["held_s"]) == pytest.approx(30.0)
    assert Turn(first["turn"])
