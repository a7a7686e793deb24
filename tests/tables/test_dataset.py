"""Datasets: folders of Parquet files, as inputs and as outputs, and patterns of file names."""

import gzip
import os
import re
from pathlib import Path

import dask.dataframe as dd
import duckdb
import pandas as pd
import polars as pl
import pyarrow as pa
import pyarrow.parquet as pq
import pytest

import loiter
from loiter.cli.app import main
from loiter.errors import InvalidArgument, Unfinished
from loiter.tables import jobs, parts
from loiter.tables.files import SUCCESS
from tables.making import GIVEN, OPTIONS, change_after_each_part, poses, read, small_parts, stopping, write

# Dask calls pandas in a way that pandas 3.1 wants to end.
pytestmark = pytest.mark.filterwarnings("ignore:The inplace keyword")


@pytest.fixture(autouse=True)
def _small_parts(tmp_path, monkeypatch):
    small_parts(monkeypatch)
    monkeypatch.chdir(tmp_path)


@pytest.fixture
def expected():
    """The rows that each output must have, of a table of ten parts in in.parquet."""
    write(poses(1000), Path("in.parquet"), 100)
    loiter.tables.run("in.parquet", "expected.parquet", **GIVEN)
    return read(Path("expected.parquet"))


def run(source="in.parquet", target="out/", **options):
    return loiter.tables.run(source, target, **GIVEN, **options)


def rows_of(place="out"):
    """The rows of a dataset in the order of the names of its files."""
    return [row for path in sorted(Path(place).glob("*.parquet")) for row in read(path)]


def names(place="out"):
    return sorted(path.name for path in Path(place).iterdir())


def contents(place="out"):
    return {path.name: path.read_bytes() for path in Path(place).iterdir()}


def test_a_dataset_has_the_rows_of_a_file(expected):
    summary = run()
    assert (summary.rows, summary.parts, summary.statuses) == (1000, 10, {"ok": 1000})
    assert rows_of() == expected
    [success, *found] = names()
    assert success == SUCCESS
    assert [name[:10] for name in found] == [f"part-{i:05}" for i in range(10)]
    assert names(".") == ["expected.parquet", "in.parquet", "out"]


def numbers(table):
    return sorted(float(value) for value in table)


READERS = {
    "duckdb": lambda: duckdb.sql("SELECT duration_s FROM 'out/*.parquet'").fetchnumpy()["duration_s"],
    "polars": lambda: pl.read_parquet("out")["duration_s"].to_list(),
    "polars lazy": lambda: pl.scan_parquet("out/").select("duration_s").collect()["duration_s"].to_list(),
    "pandas": lambda: pd.read_parquet("out")["duration_s"].tolist(),
    "dask": lambda: dd.read_parquet("out")["duration_s"].compute().tolist(),
    "pyarrow": lambda: pq.read_table("out")["duration_s"].to_pylist(),
}


@pytest.mark.parametrize("reader", READERS.values(), ids=READERS)
def test_others_read_it(expected, reader):
    run()
    assert numbers(reader()) == numbers(row["duration_s"] for row in expected)


@pytest.mark.parametrize("kind", [".csv", ".csv.gz", ".parquet"])
def test_others_read_the_joined_file(expected, kind):
    # The parts of a compressed file are gzip members one after another.
    run(target=f"out{kind}")
    table = f"out{kind}"
    durations = numbers(row["duration_s"] for row in expected)
    assert numbers(duckdb.sql(f"SELECT duration_s FROM '{table}'").fetchnumpy()["duration_s"]) == durations
    by_polars = pl.read_parquet(table) if kind == ".parquet" else pl.read_csv(table)
    assert numbers(by_polars["duration_s"].to_list()) == durations
    by_pandas = pd.read_parquet(table) if kind == ".parquet" else pd.read_csv(table)
    assert numbers(by_pandas["duration_s"]) == durations
    by_dask = dd.read_parquet(table) if kind == ".parquet" else dd.read_csv(table, blocksize=None)
    assert numbers(by_dask["duration_s"].compute()) == durations
    if kind == ".csv.gz":
        text = gzip.decompress(Path(table).read_bytes())
        run(target="plain.csv")
        assert text == Path("plain.csv").read_bytes()


def written(place, count=10, rows=100):
    """A dataset as Dask writes it: part.0.parquet ... part.9.parquet, part.10.parquet."""
    table = poses(count * rows)
    for i in range(count):
        write(table.slice(i * rows, rows), Path(place) / f"part.{i}.parquet")
    return table


def test_a_dataset_may_be_the_input():
    Path("data").mkdir()
    written("data", 12, 50)
    for name in ("_SUCCESS", "_metadata", ".part.0.parquet.crc"):
        Path("data", name).touch()
    summary = run("data", "out.parquet")
    # Two files make a part; the order of the files is that of their numbers.
    assert (summary.rows, summary.parts) == (600, 6)
    assert [row["id"] for row in read(Path("out.parquet"))] == list(range(600))


@pytest.mark.parametrize("pattern", ["data-*.parquet", "data-[01].parquet", "*/data-?.parquet", "s*/"])
def test_a_pattern_may_be_the_input(pattern):
    Path("sub").mkdir()
    table = poses(200)
    for place in (".", "sub"):
        for i in range(2):
            write(table.slice(100 * i, 100), Path(place) / f"data-{i}.parquet")
    run(pattern, "out.parquet")
    assert [row["id"] for row in read(Path("out.parquet"))] == list(range(200))


@pytest.mark.parametrize("kind", [".csv", ".csv.gz"])
def test_csv_files_may_be_a_dataset_too(kind):
    table = poses(300)
    for i in range(3):
        write(table.slice(100 * i, 100), Path("part.csv"))
        text = Path("part.csv").read_bytes() + b"1,2\n" * (i == 1)
        Path(f"data-{i}{kind}").write_bytes(gzip.compress(text) if kind == ".csv.gz" else text)
    summary = run(f"data-*{kind}", "out/")
    assert summary.statuses == {"ok": 300, "malformed": 1}
    ids = [row["id"] for row in rows_of()]
    assert ids == list(range(300))
    assert names() == [SUCCESS, *(path.name for path in sorted(Path("out").glob("*.parquet")))]


def test_a_file_whose_name_looks_like_a_pattern_is_a_file(expected):
    Path("in.parquet").rename("in[1].parquet")
    run("in[1].parquet", "out.parquet")
    assert read(Path("out.parquet")) == expected


def other_types():
    table = poses(5)
    write(table.set_column(0, "id", pa.array(["a"] * 5)), Path("data/z.parquet"))


INPUTS = {
    "other columns": (
        lambda: write(poses(5).append_column("more", pa.array([1] * 5)), Path("data/z.parquet")),
        "data",
        "z.parquet and the first differ in more",
    ),
    "other types": (
        other_types,
        "data",
        "has files with different types: Unable to merge: Field id has incompatible types: int64 vs string",
    ),
    "another kind": (lambda: Path("data/notes.txt").touch(), "data", "notes.txt is not .parquet, .csv or .csv.gz"),
    "two kinds": (lambda: write(poses(5), Path("data/z.csv")), "data", "are files of different kinds"),
    "unfinished": (
        lambda: [Path("data/_temporary").mkdir(), Path("data/_temporary/job.json").touch()],
        "data/",
        "the dataset is not finished: it has a folder _temporary",
    ),
    "hive": (
        lambda: [Path("data/turn=cw").mkdir(), written("data/turn=cw", 1)],
        "data",
        "it has a folder turn=cw, and columns in the names of folders are not read",
    ),
    "damaged": (lambda: Path("data/z.parquet").write_bytes(b"PAR1 no"), "data", "z.parquet': it cannot be read"),
    "empty": (lambda: Path("empty").mkdir(), "empty", "there is no file in it"),
    "no match": (lambda: None, "no-*.parquet", "is 'no-*.parquet': no file matches"),
}


@pytest.mark.parametrize(("prepare", "source", "sentence"), INPUTS.values(), ids=INPUTS)
def test_files_that_are_not_one_table_are_refused(prepare, source, sentence):
    Path("data").mkdir()
    written("data", 2)
    prepare()
    with pytest.raises(InvalidArgument) as caught:
        run(source)
    assert sentence in str(caught.value)
    assert not Path("out").exists()


def test_headers_of_csv_files_must_agree():
    Path("a.csv").write_text("east_m,north_m,heading_deg\n0,0,0\n")
    Path("b.csv").write_text("east_m,heading_deg,north_m\n0,0,0\n")
    with pytest.raises(InvalidArgument, match=r"b\.csv has another header than the first file"):
        run("*.csv")


def test_a_stopped_job_resumes_from_its_parts(expected, capsys):
    with stopping(4, OSError(5, "")):
        assert main(["batch", "in.parquet", "out/", *OPTIONS, "--workers", "1"]) == 2
    kept = "4 finished parts stay in out/, and the same command resumes from there"
    assert capsys.readouterr().err == f"loiter: the job stopped: Input/output error; {kept}\n"
    assert names()[0] == "_temporary"
    assert len(names()) == 5
    times = {path.name: path.stat().st_mtime_ns for path in Path("out").glob("*.parquet")}
    summary = run()
    assert (summary.resumed_parts, summary.solved_rows) == (4, 600)
    assert {name: Path("out", name).stat().st_mtime_ns for name in times} == times
    assert rows_of() == expected


def test_a_finished_job_is_not_done_again(expected):
    run()
    before = {path: path.stat().st_mtime_ns for path in Path("out").glob("*.parquet")}
    summary = run()
    assert (summary.resumed_parts, summary.solved_rows, summary.statuses) == (10, 0, {"ok": 1000})
    assert {path: path.stat().st_mtime_ns for path in Path("out").glob("*.parquet")} == before


def test_a_part_that_was_damaged_or_deleted_is_done_again(expected):
    run()
    first, second, third, *_ = sorted(Path("out").glob("*.parquet"))
    first.unlink()
    os.truncate(second, 1000)
    os.truncate(third, 0)
    seen = []
    solve = parts.solve_part

    def solve_part(part, *stopped):
        seen.append(Path("out", SUCCESS).exists())
        return solve(part, *stopped)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("loiter.tables.parts.solve_part", solve_part)
        assert run().resumed_parts == 7
    assert seen == [False, False, False]
    assert rows_of() == expected
    assert names()[0] == SUCCESS


def another_option():
    return {"turn": "cw"}


def another_input():
    os.utime("in.parquet", (1, 1))
    return {}


@pytest.mark.parametrize("finished", [True, False])
@pytest.mark.parametrize("change", [another_option, another_input])
def test_parts_of_another_job_are_refused(expected, change, finished):
    if not finished:
        with stopping(4, OSError(5, "")), pytest.raises(Unfinished):
            run(workers=1)
    else:
        run()
    Path("out", SUCCESS).unlink(missing_ok=True)
    before = {path: path.is_dir() or path.read_bytes() for path in Path("out").rglob("*")}
    with pytest.raises(InvalidArgument, match="it has parts of a job with another input, option or program, such as"):
        run(**change())
    assert {path: path.is_dir() or path.read_bytes() for path in Path("out").rglob("*")} == before


@pytest.mark.parametrize("name", ["notes.txt", "part-00000.parquet", "_metadata", "sub"])
def test_files_of_others_are_refused(expected, name):
    Path("out").mkdir()
    Path("out", name).mkdir() if name == "sub" else Path("out", name).touch()
    sentence = f"out/' ?: it has a file {name}, which this job did not write; empty it or choose another folder"
    with pytest.raises(InvalidArgument, match=sentence):
        run()
    assert names() == [name]


def test_an_existing_empty_folder_needs_no_slash(expected):
    Path("out.parquet").mkdir()
    Path("out.parquet/.hidden").touch()
    run(target=Path("out.parquet"))
    assert rows_of("out.parquet") == expected


def test_a_job_that_cannot_begin_leaves_no_folder(expected):
    with pytest.raises(InvalidArgument, match="its working folder _temporary cannot be created, No such file"):
        run(target="missing/out/")
    with stopping(0, OSError(5, "")), pytest.raises(Unfinished, match="no part was finished"):
        run()
    assert names(".") == ["expected.parquet", "in.parquet"]


@pytest.mark.parametrize(("source", "target"), [("data", "data"), ("data", "data/out/"), ("data/", "data/out.parquet")])
def test_the_output_may_not_lie_in_the_input(source, target):
    Path("data").mkdir()
    written("data", 2)
    with pytest.raises(InvalidArgument, match="that is in the folder of the input"):
        run(source, target)


def test_the_output_may_not_be_a_file_of_the_input():
    Path("data").mkdir()
    written("data", 2)
    with pytest.raises(InvalidArgument, match="that is a file of the input"):
        run("data/*.parquet", "data/part.1.parquet")


def test_a_table_without_rows_becomes_a_part_without_rows():
    write(poses(0), Path("in.parquet"))
    assert run().rows == 0
    [path] = Path("out").glob("*.parquet")
    assert pq.read_schema(path).names == pq.read_table("out").column_names
    assert pl.read_parquet("out").shape[0] == 0


@pytest.mark.parametrize("target", ["out/", "out.parquet"])
def test_an_input_that_changes_meanwhile_is_reported(expected, monkeypatch, target):
    change_after_each_part(monkeypatch, "in.parquet")
    with pytest.raises(InvalidArgument, match="it changed while it was read"):
        run(target=target)
    assert not Path("out", SUCCESS).exists()
    assert not Path("out.parquet").exists()


def test_what_is_called_finished_is_on_the_disk(expected, monkeypatch):
    # The order of calls: the part is synchronised, then renamed, then the folder is synchronised.
    calls = []
    sync, replace = os.fsync, Path.replace

    def fsync(handle):
        calls.append(("fsync", re.sub(r"^\.\w+-", "", Path(f"/proc/self/fd/{handle}").readlink().name)[:4]))
        sync(handle)

    def renamed(path, target):
        calls.append(("rename", Path(target).name[:4]))
        return replace(path, target)

    monkeypatch.setattr(os, "fsync", fsync)
    monkeypatch.setattr(Path, "replace", renamed)
    run(workers=1)
    part = [("fsync", "part"), ("rename", "part"), ("fsync", "out")]
    assert calls == [*part * 10, ("fsync", "_SUC"), ("rename", "_SUC"), ("fsync", "out")]


def test_names_sort_in_the_order_of_the_rows():
    names = [jobs.part_name(number, 123_456, "0123456789") for number in (7, 99_999, 100_000)]
    assert names == sorted(names)
    assert jobs.part_name(7, 10, "0123456789") == "part-00007-01234567.parquet"
