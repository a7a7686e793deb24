"""Tables in wind and of circles that move: the rows of `plan`, from columns and from options."""

from pathlib import Path

import dask
import dask.dataframe as dd
import numpy as np
import pyarrow as pa
import pytest
from pandas.testing import assert_frame_equal

import loiter
from loiter import Aircraft, Orbit, Pose, Wind, plan
from loiter.errors import InvalidArgument
from loiter.planning.model import CALM
from loiter.tables import jobs
from loiter.tables.columns import VELOCITY, WIND
from tables.making import ADDED, poses, read, scenes, stopping, write

ORBIT, UAV, BREEZE = Orbit(10.0, -20.0, 150.0), Aircraft(18.0, max_bank_deg=35.0), Wind(6.0, 250.0)


def windy(rows, seed=7):
    """Random scenes in a wind of their own each, most of their circles moving, a third of them passed by no air."""
    random = np.random.default_rng(seed)
    table = scenes(rows, seed=seed)
    speed, towards = random.uniform(0.0, 4.0, rows), random.uniform(0.0, 2 * np.pi, rows)
    velocity = random.uniform(-2.0, 2.0, (2, rows))
    velocity[:, ::3] = 0.0
    speed[::6] = 0.0
    # With the air.
    velocity[:, 3::6] = speed[3::6] * np.sin(towards[3::6]), speed[3::6] * np.cos(towards[3::6])
    return added(table, WIND, (speed, np.degrees(towards) + 180.0), VELOCITY, velocity)


def added(table, *names_and_columns):
    """The table with further columns: names, their values, names, values."""
    for names, columns in zip(names_and_columns[::2], names_and_columns[1::2], strict=True):
        for name, column in zip(names, columns, strict=True):
            table = table.append_column(name, pa.array(column))
    return table


def number(one, name):
    return float("nan" if one[name] in ("", None) else one[name])


def assert_planned(one, turn="either", orbit=None, aircraft=None, wind=None):
    """The row holds what `plan` gives for it; what is not given is in its columns."""
    if orbit is None:
        velocity = [number(one, name) for name in VELOCITY] if VELOCITY[0] in one else []
        orbit = Orbit(*(number(one, f"orbit_{name}") for name in ("east_m", "north_m", "radius_m")), turn, *velocity)
    aircraft = aircraft or Aircraft(number(one, "airspeed_m_s"), number(one, "max_bank_deg"))
    wind = wind or (Wind(*(number(one, name) for name in WIND)) if WIND[0] in one else CALM)
    m = plan(Pose(*(number(one, name) for name in ("east_m", "north_m", "heading_deg"))), orbit, aircraft, wind)
    assert (one["word"] or "", one["turn"], one["status"]) == (m.word, m.turn.value, "ok")
    assert number(one, "duration_s") == pytest.approx(m.duration_s, rel=1e-9, abs=1e-9)
    joined = number(one, "join_east_m"), number(one, "join_north_m")
    assert joined == pytest.approx((m.join.east_m, m.join.north_m), abs=1e-6)
    assert number(one, "join_heading_deg") == pytest.approx(m.join.heading_deg, abs=1e-6)
    pieces = [segment.duration_s for segment in m.segments]
    found = [number(one, f"duration_{i}_s") for i in (1, 2, 3)]
    assert found == pytest.approx(pieces + [0.0] * (3 - len(pieces)), abs=1e-7)


@pytest.mark.parametrize(("source", "target"), [("in.parquet", "out.parquet"), ("in.csv", "out.csv")])
def test_wind_and_velocity_may_be_columns(tmp_path, source, target):
    table = windy(90)
    summary = loiter.tables.run(write(table, tmp_path / source), tmp_path / target)
    assert summary.statuses == {"ok": 90}
    rows = read(tmp_path / target)
    assert list(rows[0]) == [name for name in table.column_names if name != "turn"] + ADDED
    for one, turn in zip(rows, table.column("turn").to_pylist(), strict=True):
        assert_planned(one, turn)


def test_rows_that_no_air_passes_are_those_of_still_air(tmp_path):
    table = windy(300)
    calm = table.filter(pa.array(np.arange(300) % 6 == 0))
    loiter.tables.run(write(calm, tmp_path / "in.parquet"), tmp_path / "out.parquet")
    loiter.tables.run(
        write(calm.drop_columns([*WIND, *VELOCITY]), tmp_path / "bare.parquet"), tmp_path / "still.parquet"
    )
    for one, still in zip(read(tmp_path / "out.parquet"), read(tmp_path / "still.parquet"), strict=True):
        assert {name: one[name] for name in still} == still


@pytest.mark.parametrize(
    "given",
    [{"wind": BREEZE}, {"orbit": Orbit(10.0, -20.0, 150.0, "cw", 3.0, -1.0)}, {"orbit_velocity_m_s": (3.0, -1.0)}],
    ids=["wind", "orbit", "velocity"],
)
def test_wind_and_velocity_may_be_given(tmp_path, given):
    options = {"orbit": ORBIT, "aircraft": UAV} | given
    loiter.tables.run(write(poses(30), tmp_path / "in.parquet"), tmp_path / "out.parquet", **options)
    velocity = options.pop("orbit_velocity_m_s", None)
    if velocity is not None:
        options["orbit"] = Orbit(10.0, -20.0, 150.0, "either", *velocity)
    for one in read(tmp_path / "out.parquet"):
        assert_planned(one, **options)


def test_circles_of_columns_may_move_alike_in_a_wind_of_columns(tmp_path):
    table = windy(30).drop_columns(list(VELOCITY))
    loiter.tables.run(write(table, tmp_path / "in.parquet"), tmp_path / "out.parquet", orbit_velocity_m_s=(1, -0.5))
    for one, turn in zip(read(tmp_path / "out.parquet"), table.column("turn").to_pylist(), strict=True):
        assert_planned(one | dict(zip(VELOCITY, (1.0, -0.5), strict=True)), turn)


def test_a_circle_that_drifts_with_the_air_is_joined_where_it_is_then(tmp_path):
    table, wind = poses(50), Wind(6.0, 270.0)
    loiter.tables.run(
        write(table, tmp_path / "in.parquet"),
        tmp_path / "out.parquet",
        orbit=Orbit(10.0, -20.0, 150.0, velocity_east_m_s=6.0),
        aircraft=UAV,
        wind=wind,
    )
    loiter.tables.run(tmp_path / "in.parquet", tmp_path / "still.parquet", orbit=ORBIT, aircraft=UAV)
    for one, still in zip(read(tmp_path / "out.parquet"), read(tmp_path / "still.parquet"), strict=True):
        assert one["join_east_m"] == pytest.approx(still["join_east_m"] + 6.0 * one["duration_s"])
        assert {n: v for n, v in one.items() if n != "join_east_m"} == {
            n: v for n, v in still.items() if n != "join_east_m"
        }


def test_bad_rows_get_a_status_and_affect_no_others(tmp_path):
    lines = ["east_m,north_m,heading_deg,wind_speed_m_s,wind_from_deg,orbit_velocity_east_m_s,orbit_velocity_north_m_s"]
    pose, rest, good = "-400,120,90", "0,0", "-400,120,90,6,250,0,0"
    bad = {
        f"{pose},,250,{rest}": "bad_wind",
        f"{pose},6,x,{rest}": "bad_wind",
        f"{pose},-1,250,{rest}": "bad_wind",
        f"{pose},6,inf,{rest}": "bad_wind",
        f"{pose},6,250,nan,0": "bad_orbit",
        f"{pose},6,250,0,": "bad_orbit",
        f",120,90,6,250,{rest}": "bad_pose",
        f"{pose},18,250,{rest}": "wind_too_strong",
        f"{pose},0,0,30,0": "wind_too_strong",
        f"{pose},17,250,{rest}": "not_held",
        f"1e30,120,90,6,250,{rest}": "out_of_range",
    }
    for line in bad:
        lines += [line, good]
    (tmp_path / "in.csv").write_text("\n".join(lines))
    loiter.tables.run(tmp_path / "in.csv", tmp_path / "out.csv", orbit=ORBIT, aircraft=UAV)
    rows = read(tmp_path / "out.csv")
    assert [one["status"] for one in rows] == [s for status in bad.values() for s in (status, "ok")]
    assert all(not one[name] for one in rows[::2] for name in ADDED if name != "status")
    assert len({tuple(one.values()) for one in rows[1::2]}) == 1
    assert_planned(rows[1], orbit=ORBIT, aircraft=UAV)


def test_a_circle_tighter_than_the_turn_is_called_that_in_wind_too(tmp_path):
    write(poses(3), tmp_path / "in.parquet")
    given = {"orbit": Orbit(0.0, 0.0, 30.0), "aircraft": UAV, "wind": BREEZE}
    assert loiter.tables.run(tmp_path / "in.parquet", tmp_path / "out.csv", **given).statuses == {"radius_too_small": 3}


@pytest.mark.parametrize("lazy", [False, True])
def test_a_frame_gets_what_a_file_gets(tmp_path, lazy):
    table = windy(60)
    loiter.tables.run(write(table, tmp_path / "in.parquet"), tmp_path / "out.parquet")
    frame = table.to_pandas()
    planned = loiter.tables.plan(dd.from_pandas(frame, npartitions=3) if lazy else frame)
    if lazy:
        with dask.config.set(scheduler="threads"):
            planned = planned.compute()
    assert planned.to_dict("records") == read(tmp_path / "out.parquet")


def test_a_frame_takes_wind_and_velocity():
    frame = poses(10).to_pandas()
    by_orbit = loiter.tables.plan(frame, orbit=Orbit(0, 0, 150, "cw", 2.0, 1.0), aircraft=UAV, wind=BREEZE)
    alone = loiter.tables.plan(
        frame, orbit=Orbit(0, 0, 150), aircraft=UAV, wind=BREEZE, turn="cw", orbit_velocity_m_s=(2.0, 1.0)
    )
    assert_frame_equal(by_orbit, alone)


@pytest.mark.parametrize(
    ("columns", "given", "why"),
    [
        (VELOCITY, {"orbit": Orbit(0, 0, 150, "cw", 1.0)}, "^orbit_velocity_m_s is given, and by the table's column"),
        ((), {"orbit": Orbit(0, 0, 150, "cw", 1.0), "orbit_velocity_m_s": (1, 0)}, "is given, and by the orbit too"),
        ((), {"orbit_velocity_m_s": (1.0, float("nan"))}, "^orbit velocity_north_m_s is nan"),
    ],
)
def test_what_does_not_fit_is_refused(columns, given, why):
    frame = poses(3).to_pandas().assign(**dict.fromkeys(columns, 1.0))
    with pytest.raises(InvalidArgument, match=why):
        loiter.tables.plan(frame, **{"orbit": ORBIT, "aircraft": UAV} | given)


@pytest.fixture
def small(monkeypatch):
    """Parts of 20 rows in batches of 8."""
    monkeypatch.setattr(jobs, "PART_ROWS_IN_WIND", 20)
    monkeypatch.setattr(jobs, "BATCH_ROWS_IN_WIND", 8)


@pytest.mark.parametrize("row_groups", [None, 7, 50])
def test_parts_are_cut_whatever_the_row_groups(tmp_path, monkeypatch, small, row_groups):
    source = write(windy(70), tmp_path / "in.parquet", row_groups)
    given = {"workers": 2}
    assert loiter.tables.run(source, tmp_path / "out.parquet", **given).parts == 4
    monkeypatch.setattr(jobs, "PART_ROWS_IN_WIND", 1000)
    assert loiter.tables.run(source, tmp_path / "whole.parquet", **given).parts == 1
    assert read(tmp_path / "out.parquet") == read(tmp_path / "whole.parquet")


def test_another_wind_starts_the_job_over(tmp_path, monkeypatch, small):
    monkeypatch.chdir(tmp_path)
    source, notes = write(poses(60), Path("in.parquet")), []

    def run(wind):
        options = {"orbit": ORBIT, "aircraft": UAV, "wind": wind, "workers": 1}
        return loiter.tables.run(source, "out.parquet", progress=lambda p: notes.append(p.note), **options)

    def stopped():
        with stopping(1, OSError("no space")), pytest.raises(loiter.errors.Unfinished):
            run(BREEZE)

    stopped()
    assert run(Wind(6.0, 200.0)).resumed_parts == 0
    assert any("starting over" in note for note in notes)
    stopped()
    assert run(BREEZE).resumed_parts == 1
    for one in read(Path("out.parquet"))[:5]:
        assert_planned(one, orbit=ORBIT, aircraft=UAV, wind=BREEZE)
