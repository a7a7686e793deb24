"""Tables as files: the rows of `plan`, in any format, from any writer."""

import gzip
from dataclasses import replace
from pathlib import Path

import numpy as np
import pandas as pd
import pyarrow as pa
import pyarrow.parquet as pq
import pytest

import loiter
from loiter import Aircraft, Orbit, Pose, Turn, plan
from loiter.planning.model import TURN_LIMITS
from loiter.tables import jobs, parts
from tables.making import ADDED, GIVEN, ORBIT, UAV, poses, read, scenes, write


def assert_planned(rows, limit="max_bank_deg", **shared):
    """Each row holds what `plan` gives for it; a column that it lacks is in `shared`."""
    for one in rows:
        known = {**one, **shared}
        orbit = Orbit(known["orbit_east_m"], known["orbit_north_m"], known["orbit_radius_m"], known["asked"])
        aircraft = Aircraft(known["airspeed_m_s"], **{limit: known[limit]})
        m = plan(Pose(one["east_m"], one["north_m"], one["heading_deg"]), orbit, aircraft)
        assert (one["word"], one["turn"], one["status"]) == (m.word, m.turn.value, "ok")
        assert one["duration_s"] == pytest.approx(m.duration_s, rel=1e-9)
        assert (one["join_east_m"], one["join_north_m"]) == pytest.approx((m.join.east_m, m.join.north_m), abs=1e-6)
        pieces = [one[f"duration_{i}_s"] for i in (1, 2, 3)]
        assert pieces[: len(m.segments)] == pytest.approx([s.duration_s for s in m.segments], abs=1e-9)
        assert pieces[len(m.segments) :] == [0.0] * (3 - len(m.segments))


@pytest.mark.parametrize("limit", TURN_LIMITS)
def test_every_quantity_may_be_a_column(tmp_path, limit):
    table = scenes(300, limit)
    summary = loiter.tables.run(write(table, tmp_path / "in.parquet"), tmp_path / "out.parquet")
    assert (summary.rows, summary.statuses, summary.parts, summary.resumed_parts) == (300, {"ok": 300}, 1, 0)
    rows = read(tmp_path / "out.parquet")
    asked = table.column("turn").to_pylist()
    for one, turn in zip(rows, asked, strict=True):
        assert_planned([one], limit, asked=turn)
    assert list(rows[0]) == [name for name in table.column_names if name != "turn"] + ADDED
    assert [one["id"] for one in rows] == list(range(300))


@pytest.mark.parametrize("turn", [None, *Turn])
def test_every_quantity_may_be_given(tmp_path, turn):
    loiter.tables.run(write(poses(300), tmp_path / "in.parquet"), tmp_path / "out.parquet", turn=turn, **GIVEN)
    rows = read(tmp_path / "out.parquet")
    shared = {"orbit_east_m": 0.0, "orbit_north_m": 0.0, "orbit_radius_m": 80.0, "airspeed_m_s": 18.0}
    assert_planned(rows, **shared, max_bank_deg=35.0, asked=turn or Turn.EITHER)


@pytest.mark.parametrize("given", ["orbit", "airspeed_m_s", "max_bank_deg", "turn"])
def test_each_quantity_may_be_given_beside_columns_for_the_others(tmp_path, given):
    table = scenes(100)
    columns = [n for n in table.column_names if n.startswith("orbit")] if given == "orbit" else [given]
    write(table.drop_columns(columns), tmp_path / "in.parquet")
    values = {"orbit": {"orbit": ORBIT}, "turn": {"turn": "ccw"}, "airspeed_m_s": {"aircraft": {"airspeed_m_s": 14}}}
    option = values.get(given, {"aircraft": {"max_bank_deg": 40.0}})
    loiter.tables.run(tmp_path / "in.parquet", tmp_path / "out.parquet", **option)
    asked = ["ccw"] * 100 if given == "turn" else table.column("turn").to_pylist()
    shared = {
        "orbit_east_m": 0.0,
        "orbit_north_m": 0.0,
        "orbit_radius_m": 80.0,
        "airspeed_m_s": 14.0,
        "max_bank_deg": 40.0,
    }
    for one, turn in zip(read(tmp_path / "out.parquet"), asked, strict=True):
        assert_planned([one], asked=turn, **{name: value for name, value in shared.items() if name in columns})


def test_mirrored_scenes_have_mirrored_entries(tmp_path):
    table = scenes(300)
    mirror = {name: pa.array(-table.column(name).to_numpy()) for name in ("east_m", "heading_deg", "orbit_east_m")}
    mirror["turn"] = pa.array([Turn(turn).other.value for turn in table.column("turn").to_pylist()])
    mirrored = pa.table({name: mirror.get(name, table.column(name)) for name in table.column_names})
    for name, one in {"one": table, "other": mirrored}.items():
        loiter.tables.run(write(one, tmp_path / f"{name}.parquet"), tmp_path / f"{name}-out.parquet")
    swap = str.maketrans("LR", "RL")
    for here, there in zip(read(tmp_path / "one-out.parquet"), read(tmp_path / "other-out.parquet"), strict=True):
        assert (here["word"].translate(swap), Turn(here["turn"]).other) == (there["word"], there["turn"])
        assert here["duration_s"] == pytest.approx(there["duration_s"], rel=1e-12)
        assert (here["join_east_m"], here["join_north_m"]) == pytest.approx(
            (-there["join_east_m"], there["join_north_m"]), abs=1e-9
        )


def test_an_orbits_own_turn_counts(tmp_path):
    write(poses(50), tmp_path / "in.parquet")
    loiter.tables.run(tmp_path / "in.parquet", tmp_path / "out.parquet", orbit=replace(ORBIT, turn="cw"), aircraft=UAV)
    assert {one["turn"] for one in read(tmp_path / "out.parquet")} == {"cw"}


KINDS = [".parquet", ".csv", ".csv.gz"]


@pytest.mark.parametrize("source", KINDS)
@pytest.mark.parametrize("target", KINDS)
def test_any_kind_becomes_any_kind(tmp_path, source, target):
    table = poses(500)
    write(table, tmp_path / "in.parquet")
    write(table, tmp_path / "in.csv")
    (tmp_path / "in.csv.gz").write_bytes(gzip.compress((tmp_path / "in.csv").read_bytes()))
    loiter.tables.run(tmp_path / "in.parquet", tmp_path / "expected.parquet", **GIVEN)
    loiter.tables.run(tmp_path / f"in{source}", tmp_path / f"out{target}", **GIVEN)
    expected, rows = read(tmp_path / "expected.parquet"), read(tmp_path / f"out{target}")
    numbers = [name for name in expected[0] if name not in ("word", "turn", "status")]
    assert [list(one) for one in rows] == [list(one) for one in expected]
    for one, other in zip(rows, expected, strict=True):
        # What is written as text is read back to the last bit.
        assert [float(one[name]) for name in numbers] == [other[name] for name in numbers]
        assert [one["word"] or "", one["turn"], one["status"]] == [other["word"], other["turn"], "ok"]
    if target == ".parquet":
        types = pq.read_schema(tmp_path / "out.parquet")
        assert types.field("id").type == pa.int64()
        assert all(pa.types.is_dictionary(types.field(name).type) for name in ("word", "turn", "status"))


def test_the_same_rows_give_the_same_bytes(tmp_path):
    write(poses(1000), tmp_path / "in.parquet", 100)
    for kind in [*KINDS, "/"]:
        contents = []
        for workers in (1, 3):
            out = f"{tmp_path}/out{workers}{kind}"
            loiter.tables.run(tmp_path / "in.parquet", out, workers=workers, **GIVEN)
            contents.append(
                [path.read_bytes() for path in sorted(Path(out).rglob("*") if kind == "/" else [Path(out)])]
            )
        assert contents[0] == contents[1]


def test_a_table_in_many_parts_keeps_its_order(tmp_path, monkeypatch):
    monkeypatch.setattr(jobs, "PART_ROWS", 250)
    monkeypatch.setattr(jobs, "BATCH_ROWS", 90)
    table = poses(2000)
    write(table, tmp_path / "in.parquet", 100)
    told = []
    summary = loiter.tables.run(
        tmp_path / "in.parquet", tmp_path / "out.parquet", workers=4, progress=told.append, **GIVEN
    )
    assert (summary.rows, summary.parts, summary.solved_rows) == (2000, 8, 2000)
    rows = read(tmp_path / "out.parquet")
    assert [one["id"] for one in rows] == list(range(2000))
    assert [one["east_m"] for one in rows] == table.column("east_m").to_pylist()
    assert told[-1].rows <= told[-1].total == 2000


def test_a_huge_row_group_is_cut(tmp_path, monkeypatch):
    for name, value in {"PART_ROWS": 100, "BATCH_ROWS": 30}.items():
        monkeypatch.setattr(jobs, name, value)
    monkeypatch.setattr(parts, "ROW_GROUP_ROWS", 100)
    table = poses(1000)
    with pq.ParquetWriter(tmp_path / "in.parquet", table.schema) as writer:
        for rows in (table.slice(0, 20), table.slice(20, 900), table.slice(920)):
            writer.write_table(rows)
    loiter.tables.run(tmp_path / "in.parquet", tmp_path / "out.parquet", **GIVEN)
    assert [one["id"] for one in read(tmp_path / "out.parquet")] == list(range(1000))
    # Written in row groups of the usual size all the same.
    assert pq.read_metadata(tmp_path / "out.parquet").num_row_groups > 5


@pytest.mark.parametrize("kind", KINDS)
def test_a_table_without_rows_becomes_one(tmp_path, kind):
    empty = poses(0)
    write(empty, tmp_path / "in.parquet")
    (tmp_path / "in.csv").write_text("id,east_m,north_m,heading_deg\n")
    (tmp_path / "in.csv.gz").write_bytes(gzip.compress((tmp_path / "in.csv").read_bytes()))
    for target in KINDS:
        summary = loiter.tables.run(tmp_path / f"in{kind}", tmp_path / f"out{target}", **GIVEN)
        assert (summary.rows, summary.statuses) == (0, {})
        assert read(tmp_path / f"out{target}") == []
    assert pq.read_schema(tmp_path / "out.parquet").names == [*empty.column_names, *ADDED]


def test_parquet_of_other_writers(tmp_path):
    rows = 400
    table = poses(rows)
    random = np.random.default_rng(5)
    turns = pa.array(random.choice(["cw", "ccw"], rows))
    columns = {
        "id": pa.array([f"track {i}" for i in range(rows)], pa.large_string()),
        "east_m": table.column("east_m").cast(pa.float32()),
        "north_m": table.column("north_m").cast(pa.int16(), safe=False),
        "heading_deg": table.column("heading_deg").cast(pa.int64(), safe=False).dictionary_encode(),
        "orbit_east_m": pa.array([0] * rows, pa.uint8()),
        "orbit_north_m": pa.array([0] * rows).cast(pa.decimal128(25, 2)),
        "orbit_radius_m": pa.array([80.0] * rows, pa.float32()).dictionary_encode(),
        "turn": turns.dictionary_encode(),
        "camera": pa.array(["a", "b", None, "c"] * (rows // 4)).dictionary_encode(),
        "seen": pa.array([None] * rows, pa.timestamp("us", "UTC")),
        "tags": pa.array([[1, 2], None] * (rows // 2)),
        "place": pa.array([{"x": 1.0, "y": None}] * rows, pa.struct({"x": pa.float64(), "y": pa.string()})),
        "price": pa.array(range(rows)).cast(pa.decimal128(25, 2)),
        "flag": pa.array([True, None] * (rows // 2)),
    }
    source = pa.table(columns).replace_schema_metadata({"made by": "somebody"})
    # Small row groups, whose dictionaries differ.
    pq.write_table(source, tmp_path / "in.parquet", row_group_size=30, compression="gzip", version="1.0")
    loiter.tables.run(tmp_path / "in.parquet", tmp_path / "out.parquet", aircraft=UAV)
    found = pq.read_table(tmp_path / "out.parquet")
    read_back = pq.read_table(tmp_path / "in.parquet")
    for name in source.column_names:
        if name != "turn":
            assert found.schema.field(name).type == read_back.schema.field(name).type
            assert found.column(name).to_pylist() == read_back.column(name).to_pylist()
    assert found.schema.metadata[b"made by"] == b"somebody"
    plain = [
        {name: float(v) if name.endswith(("_m", "deg")) else v for name, v in one.items()} for one in found.to_pylist()
    ]
    for one, asked in zip(plain, turns.to_pylist(), strict=True):
        assert_planned([one], asked=asked, airspeed_m_s=18.0, max_bank_deg=35.0)


def test_columns_of_few_values_have_a_dictionary_and_others_have_none(tmp_path):
    rows = 20_000
    few, many = pa.array(np.arange(rows) % 4.0), pa.array(np.arange(rows, dtype=float))
    pq.write_table(poses(rows).append_column("few", few).append_column("many", many), tmp_path / "in.parquet")
    loiter.tables.run(tmp_path / "in.parquet", tmp_path / "out.parquet", **GIVEN)
    group = pq.ParquetFile(tmp_path / "out.parquet").metadata.row_group(0)
    chunks = {chunk.path_in_schema: chunk for chunk in map(group.column, range(group.num_columns))}
    assert chunks["few"].total_uncompressed_size < rows
    assert "PLAIN" in chunks["many"].encodings
    assert chunks["many"].total_uncompressed_size < 8 * rows + 2 * parts.DICTIONARY_BYTES


@pytest.mark.parametrize("kind", [pd.Categorical, list])
def test_pandas_reads_back_its_index_and_its_categories(tmp_path, kind):
    frame = poses(20).to_pandas().set_index("id")
    frame["turn"] = kind(["cw", "ccw"] * 10)
    frame["camera"] = pd.Categorical(["a", "b"] * 10)
    frame.to_parquet(tmp_path / "in.parquet")
    loiter.tables.run(tmp_path / "in.parquet", tmp_path / "out.parquet", **GIVEN)
    found = pd.read_parquet(tmp_path / "out.parquet")
    assert found.index.equals(frame.index)
    assert found["camera"].tolist() == frame["camera"].tolist()
    assert found["turn"].tolist() == frame["turn"].tolist()


def test_nulls_and_nan_are_bad_rows(tmp_path):
    table = scenes(6)
    for i, name in enumerate(["heading_deg", "orbit_radius_m", "turn", "airspeed_m_s", "max_bank_deg"]):
        values = table.column(name).to_pylist()
        values[i] = None
        table = table.set_column(table.column_names.index(name), name, pa.array(values))
    write(table, tmp_path / "in.parquet")
    summary = loiter.tables.run(tmp_path / "in.parquet", tmp_path / "out.parquet")
    statuses = ["bad_pose", "bad_orbit", "bad_turn", "bad_aircraft", "bad_aircraft", "ok"]
    rows = read(tmp_path / "out.parquet")
    assert [one["status"] for one in rows] == statuses
    assert summary.statuses == {status: statuses.count(status) for status in statuses}
    for one in rows[:-1]:
        assert np.isnan([one[name] for name in ADDED if name not in ("word", "turn", "status")]).all()
        assert (one["word"], one["turn"]) == ("", "")


def test_a_column_of_nothing_but_nulls_is_all_bad_rows(tmp_path):
    table = poses(3).drop_columns(["heading_deg"]).append_column("heading_deg", pa.nulls(3))
    write(table.append_column("turn", pa.nulls(3)), tmp_path / "in.parquet")
    summary = loiter.tables.run(tmp_path / "in.parquet", tmp_path / "out.parquet", **GIVEN)
    assert summary.statuses == {"bad_turn": 3}


def test_integers_beyond_what_a_double_holds_are_rounded(tmp_path):
    table = pa.table({"east_m": [2**62 + 1], "north_m": [2**53 + 1], "heading_deg": [2**60 + 1]})
    write(table, tmp_path / "in.parquet")
    summary = loiter.tables.run(tmp_path / "in.parquet", tmp_path / "out.parquet", **GIVEN)
    assert summary.statuses == {"out_of_range": 1}
