"""Tables with slots: each row is that of `plan`, from columns and from options, and errors stand in their rows."""

from math import nan

import numpy as np
import pandas as pd
import pytest

import loiter
from loiter import Aircraft, Orbit, Pose, Slot, Wind, plan
from loiter.cli.app import main
from loiter.errors import InvalidArgument
from loiter.fences import CircleZone, Fence

ORBIT, UAV, WIND = Orbit(10.0, -20.0, 150.0), Aircraft(18.0, max_bank_deg=35.0), Wind(6.0, 250.0)

FENCE = Fence((CircleZone("mast", 0.0, 300.0, 5.0),))


def frame(rows, seed=3):
    """Random poses, each with a slot of its own."""
    random = np.random.default_rng(seed)
    east, north = random.uniform(-600.0, 600.0, (2, rows))
    heading, phase = random.uniform(0.0, 360.0, (2, rows))
    at_s, turn = random.uniform(-200.0, 200.0, rows), random.choice(["cw", "ccw", "either"], rows)
    columns = {"east_m": east, "north_m": north, "heading_deg": heading, "turn": turn}
    return pd.DataFrame(columns | {"slot_phase_deg": phase, "slot_at_s": at_s})


def assert_planned(one, given, wind, slot, turn):
    m = plan(
        Pose(given.east_m, given.north_m, given.heading_deg), Orbit(10.0, -20.0, 150.0, turn), UAV, wind, slot=slot
    )
    assert (one.word, one.turn, one.status) == (m.word, m.turn.value, "ok")
    assert one.duration_s == pytest.approx(m.duration_s, rel=1e-9)
    assert (one.join_east_m, one.join_north_m) == pytest.approx((m.join.east_m, m.join.north_m), abs=1e-6)
    assert one.join_heading_deg == pytest.approx(m.join.heading_deg, abs=1e-6)
    pieces = [segment.duration_s for segment in m.segments]
    found = [one.duration_1_s, one.duration_2_s, one.duration_3_s]
    assert found == pytest.approx(pieces + [0.0] * (3 - len(pieces)), abs=1e-7)


@pytest.mark.parametrize("wind", [None, WIND])
def test_each_row_enters_its_own_slot(wind):
    table = frame(40)
    planned = loiter.tables.plan(table, orbit=ORBIT, aircraft=UAV, wind=wind)
    for one, given in zip(planned.itertuples(), table.itertuples(), strict=True):
        assert_planned(one, given, wind, Slot(given.slot_phase_deg, given.slot_at_s), given.turn)


def test_rows_in_wind_and_in_still_air_stand_in_one_table():
    table = frame(20).assign(wind_speed_m_s=[0.0, 6.0] * 10, wind_from_deg=250.0)
    planned = loiter.tables.plan(table, orbit=ORBIT, aircraft=UAV)
    for one, given in zip(planned.itertuples(), table.itertuples(), strict=True):
        wind = Wind(given.wind_speed_m_s, 250.0)
        assert_planned(one, given, wind, Slot(given.slot_phase_deg, given.slot_at_s), given.turn)


def test_a_slot_for_all_rows_is_an_option():
    table = frame(10).drop(columns=["slot_phase_deg", "slot_at_s"])
    planned = loiter.tables.plan(table, orbit=ORBIT, aircraft=UAV, slot=Slot(40.0, 5.0))
    for one, given in zip(planned.itertuples(), table.itertuples(), strict=True):
        assert_planned(one, given, None, Slot(40.0, 5.0), given.turn)


def test_a_bearing_alone_is_that_at_the_start_and_may_have_another_unit():
    table = frame(5).drop(columns=["slot_at_s"])
    radians = table.assign(**{"slot (rad)": np.radians(table.slot_phase_deg)}).drop(columns=["slot_phase_deg"])
    columns = {"slot_phase_deg": "slot (rad)"}
    planned = loiter.tables.plan(radians, orbit=ORBIT, aircraft=UAV, columns=columns)
    for one, given in zip(planned.itertuples(), table.itertuples(), strict=True):
        assert_planned(one, given, None, Slot(given.slot_phase_deg), given.turn)


def test_what_is_wrong_stands_in_its_row():
    table = frame(6)
    table.loc[0, "slot_phase_deg"], table.loc[1, "slot_at_s"], table.loc[2, "slot_at_s"] = nan, np.inf, 1e9
    table.loc[3, "east_m"], table["orbit_radius_m"] = nan, [150.0] * 4 + [20.0, 150.0]
    table["orbit_east_m"], table["orbit_north_m"] = 10.0, -20.0
    planned = loiter.tables.plan(table, aircraft=UAV)
    expected = ["bad_slot", "bad_slot", "bad_slot", "bad_pose", "radius_too_small", "ok"]
    assert planned["status"].tolist() == expected
    assert np.isnan(planned["duration_s"]).tolist() == [True] * 5 + [False]
    assert planned["turn"].tolist()[:5] == [""] * 5


@pytest.mark.parametrize(
    ("drop", "options", "words"),
    [
        ([], {"slot": Slot(3.0)}, "slot is given, and by the table's column slot_phase_deg too"),
        (["slot_phase_deg"], {}, "has a column slot_at_s but no slot_phase_deg"),
        (["slot_phase_deg"], {"slot": Slot(3.0)}, "slot is given, and by the table's column slot_at_s too"),
        ([], {"tolerance_m": 1.0}, "tolerance_m must be 0 with slots"),
        ([], {"fence": FENCE}, "slot cannot be combined with a fence"),
        (["slot_phase_deg", "slot_at_s"], {"slot": 3.0}, "slot is 3.0: it must be a loiter.Slot"),
    ],
)
def test_what_does_not_fit_is_said(drop, options, words):
    with pytest.raises(InvalidArgument, match=words):
        loiter.tables.plan(frame(2).drop(columns=drop), orbit=ORBIT, aircraft=UAV, **options)


def test_the_command_takes_columns_and_options(tmp_path, capsys):
    table, options = frame(30), ["--orbit", "10", "-20", "150", "--airspeed", "18", "--bank", "35"]
    table.to_csv(tmp_path / "in.csv", index=False)
    assert main(["batch", str(tmp_path / "in.csv"), str(tmp_path / "out.parquet"), *options]) == 0
    planned = loiter.tables.plan(table, orbit=ORBIT, aircraft=UAV)
    found = pd.read_parquet(tmp_path / "out.parquet")
    assert found["duration_s"].tolist() == planned["duration_s"].tolist()
    free = table.drop(columns=["slot_phase_deg", "slot_at_s"])
    free.to_csv(tmp_path / "free.csv", index=False)
    line = ["batch", str(tmp_path / "free.csv"), str(tmp_path / "one.csv"), *options]
    assert main([*line, "--slot", "40", "--slot-at", "5"]) == 0
    planned = loiter.tables.plan(free, orbit=ORBIT, aircraft=UAV, slot=Slot(40.0, 5.0))
    assert pd.read_csv(tmp_path / "one.csv")["duration_s"].tolist() == planned["duration_s"].tolist()
    assert main([*line, "--slot-at", "5"]) == 2
    assert "--slot-at needs --slot" in capsys.readouterr().err
