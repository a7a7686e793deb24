"""`loiter batch`: refusals before any work, the closing summary, help."""

import json
import sys
from pathlib import Path

import pyarrow as pa
import pytest

from loiter.cli.app import main
from loiter.tables.columns import STATUSES
from tables.making import OPTIONS, poses, read, scenes, write

SCRIPT = Path(sys.executable).with_name("loiter")
OPTION = {"orbit": ["--orbit", "0", "0", "80"], "airspeed": ["--airspeed", "18"], "bank": ["--bank", "35"]}


def without(name):
    """The usual options but one."""
    return [word for option, words in OPTION.items() if option != name for word in words]


def column(name, values):
    return lambda table: table.append_column(name, pa.array(values))


def retyped(name, type_):
    return lambda table: table.set_column(table.column_names.index(name), name, pa.nulls(5, type_))


def dropped(name):
    return lambda table: table.drop_columns([name])


def same(table):
    return table


HINTS = {
    "capital": ("East_m,north_m,heading_deg\n1,2,3\n", "map east_m='East_m'"),
    "short": ("east_m,north_m,heading\n1,2,3\n", "map heading_deg='heading'"),
}


@pytest.mark.parametrize(("text", "hint"), HINTS.values(), ids=HINTS)
def test_a_header_that_is_nearly_right_gets_a_hint(tmp_path, capsys, text, hint):
    (tmp_path / "in.csv").write_text(text)
    assert main(["batch", str(tmp_path / "in.csv"), str(tmp_path / "out.csv"), *OPTIONS]) == 2
    assert hint in capsys.readouterr().err
    assert not (tmp_path / "out.csv").exists()


def test_only_a_csv_file_is_asked_for_its_header(tmp_path, capsys):
    write(pa.table({"a": [1.0], "b": [1.0], "c": [1.0]}), tmp_path / "in.parquet")
    assert main(["batch", str(tmp_path / "in.parquet"), str(tmp_path / "out.csv"), *OPTIONS]) == 2
    assert capsys.readouterr().err.endswith("its columns are a, b, c\n")


def test_the_closing_lines_name_the_first_malformed_line(tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    Path("in.csv").write_text("id,east_m,north_m,heading_deg\na,90,60,100\n\nb,90\nc\n")
    assert main(["batch", "in.csv", "out.csv", *OPTIONS]) == 0
    first = "line 4 of in.csv has fewer fields than the header"
    assert capsys.readouterr().err.endswith(f"{first}; --rejects FILE keeps the malformed lines\n")
    assert main(["batch", "in.csv", "out.csv", *OPTIONS, "--rejects", "rejects.csv"]) == 0
    assert capsys.readouterr().err.endswith(f"{first}; rejects.csv has the malformed lines\n")
    assert Path("rejects.csv").read_text().splitlines() == [
        "file,line,problem,text",
        'in.csv,4,has fewer fields than the header,"b,90"',
        "in.csv,5,has fewer fields than the header,c",
    ]


def test_a_header_that_is_far_from_right_is_shown(tmp_path, capsys):
    (tmp_path / "in.csv").write_text("a,b,c\n1,2,3\n")
    assert main(["batch", str(tmp_path / "in.csv"), str(tmp_path / "out.csv"), *OPTIONS]) == 2
    assert capsys.readouterr().err.endswith("its columns are a, b, c: is the first line a header?\n")


ZERO = [0.0] * 5
TABLES = {
    "missing column": (dropped("heading_deg"), OPTIONS, ["IN", "no column heading_deg"]),
    "text for numbers": (retyped("east_m", pa.string()), OPTIONS, ["IN", "column east_m of string", "numbers"]),
    "dates for numbers": (retyped("north_m", pa.timestamp("s")), OPTIONS, ["column north_m of timestamp", "numbers"]),
    "numbers for text": (column("turn", [1] * 5), OPTIONS, ["IN", "column turn of int64", "text"]),
    "name of the output": (column("duration_s", ZERO), OPTIONS, ["IN", "column duration_s", "rename"]),
    "status already": (column("status", ["ok"] * 5), OPTIONS, ["IN", "column status"]),
    "name twice": (column("id", ZERO), OPTIONS, ["IN", "two columns named 'id'"]),
    "part of an orbit": (column("orbit_east_m", ZERO), without("orbit"), ["orbit_east_m but no orbit_north_m and no"]),
    "radius alone": (
        column("orbit_radius_m", ZERO),
        without("orbit"),
        ["but no orbit_east_m and no orbit_north_m: add both, 0 for a circle at the origin"],
    ),
    "no orbit": (same, without("orbit"), ["--orbit is needed", "no column orbit_east_m"]),
    "no airspeed": (same, without("airspeed"), ["--airspeed is needed", "no column airspeed_m_s"]),
    "no limit": (same, without("bank"), ["--bank or another turn limit is needed", "min_turn_radius_m"]),
    "two limits": (
        lambda t: column("max_bank_deg", ZERO)(column("min_turn_radius_m", ZERO)(t)),
        without("bank"),
        ["IN has the columns max_bank_deg and min_turn_radius_m"],
    ),
    "orbit twice": (column("orbit_east_m", ZERO), OPTIONS, ["--orbit is given, and by", "orbit_east_m"]),
    "turn twice": (column("turn", ["cw"] * 5), [*OPTIONS, "--turn", "cw"], ["--turn is given, and by", "column turn"]),
    "airspeed twice": (column("airspeed_m_s", ZERO), OPTIONS, ["--airspeed is given, and by"]),
    "limit twice": (column("max_bank_deg", ZERO), OPTIONS, ["--bank is given, and", "max_bank_deg"]),
    "another limit": (column("max_turn_rate_deg_s", ZERO), OPTIONS, ["--bank is given, and", "max_turn_rate_deg_s"]),
    "wind twice": (
        lambda t: column("wind_speed_m_s", ZERO)(column("wind_from_deg", ZERO)(t)),
        [*OPTIONS, "--wind", "5", "270"],
        ["--wind is given, and by the table's column wind_speed_m_s too"],
    ),
    "half a wind": (column("wind_from_deg", ZERO), OPTIONS, ["IN has a column wind_from_deg but no wind_speed_m_s"]),
    "text for wind": (
        lambda t: column("wind_speed_m_s", ["5"] * 5)(column("wind_from_deg", ZERO)(t)),
        OPTIONS,
        ["IN", "column wind_speed_m_s of string", "numbers"],
    ),
    "velocity twice": (
        lambda t: column("orbit_velocity_east_m_s", ZERO)(column("orbit_velocity_north_m_s", ZERO)(t)),
        [*OPTIONS, "--orbit-velocity", "0", "0"],
        ["--orbit-velocity is given, and by the table's column orbit_velocity_east_m_s too"],
    ),
    "half a velocity": (column("orbit_velocity_east_m_s", ZERO), OPTIONS, ["IN has", "no orbit_velocity_north_m_s"]),
}
VALUES = {
    "wind speed": ([*OPTIONS, "--wind", "-1", "270"], ["--wind SPEED is -1.0"]),
    "wind of one": ([*OPTIONS, "--wind", "5"], ["--wind needs 2 numbers, SPEED FROM"]),
    "velocity": ([*OPTIONS, "--orbit-velocity", "1", "inf"], ["--orbit-velocity NORTH is inf"]),
    "bank": ([*without("bank"), "--bank", "90"], ["--bank is 90.0", "between 0 and 90"]),
    "airspeed": ([*without("airspeed"), "--airspeed", "-1"], ["--airspeed is -1.0"]),
    "radius": ([*without("orbit"), "--orbit", "0", "0", "0"], ["--orbit RADIUS is 0.0"]),
    "centre": ([*without("orbit"), "--orbit", "nan", "0", "80"], ["--orbit EAST is nan"]),
    "orbit of two": ([*without("orbit"), "--orbit", "0", "80"], ["--orbit"]),
    "two options": ([*OPTIONS, "--turn-rate", "20"], ["--bank and --turn-rate"]),
    "turn": ([*OPTIONS, "--turn", "left"], ["--turn", "left"]),
    "tolerance": ([*OPTIONS, "--tolerance", "-1"], ["--tolerance is -1.0"]),
    "no workers": ([*OPTIONS, "--workers", "0"], ["--workers is 0", "at least 1"]),
    "half a worker": ([*OPTIONS, "--workers", "1.5"], ["--workers is '1.5'", "whole number"]),
    "workers of both kinds": (
        [*OPTIONS, "--workers", "2", "--scheduler", "tcp://127.0.0.1:1"],
        ["--workers and a scheduler are given"],
    ),
    "no address": ([*OPTIONS, "--scheduler", "somewhere"], ["--scheduler is 'somewhere'", "tcp://"]),
    "no such option": ([*OPTIONS, "--speed", "3"], ["--speed"]),
    "one word too many": ([*OPTIONS, "more"], ["more"]),
}
FILES = {
    "unknown input": ("in.txt", "out.parquet", ["IN is 'in.txt'", ".parquet, .csv or .csv.gz"]),
    "unknown output": ("in.parquet", "out.xlsx", ["OUT is 'out.xlsx'", ".parquet, .csv or .csv.gz"]),
    "no name": ("in.parquet", ".csv", ["OUT is '.csv'"]),
    "no input": ("no.parquet", "out.parquet", ["IN is 'no.parquet'", "No such file or directory"]),
    "no folder to read": ("nosuch/", "out.parquet", ["IN is 'nosuch/'", "there is no such folder"]),
    "no bucket's folder": ("memory://camp/nosuch/", "out.parquet", ["IN is 'memory://camp/nosuch/'", "no such folder"]),
    "no csv": ("no.csv", "out.parquet", ["IN is 'no.csv'", "No such file or directory"]),
    "no csv.gz": ("no.csv.gz", "out.parquet", ["IN is 'no.csv.gz'", "No such file or directory"]),
    "a folder": ("folder.parquet", "out.parquet", ["IN is 'folder.parquet'", "it cannot be read"]),
    "a folder of csv": ("folder.csv", "out.parquet", ["IN is 'folder.csv'", "it cannot be read"]),
    "not parquet": ("in.csv.parquet", "out.parquet", ["IN is 'in.csv.parquet'", "it cannot be read"]),
    "empty": ("empty.csv", "out.parquet", ["IN is 'empty.csv'", "it cannot be read"]),
    "in place": ("in.parquet", "in.parquet", ["OUT is 'in.parquet'", "that is the input"]),
    "in place by a link": ("in.parquet", "link.parquet", ["OUT is 'link.parquet'", "that is the input"]),
    "in place by another way": ("in.parquet", "folder.csv/../in.parquet", ["that is the input"]),
    "onto a folder": ("in.parquet", "folder.csv", ["OUT is 'folder.csv'", "a folder"]),
    "no folder": ("in.parquet", "no/out.parquet", ["OUT is 'no/out.parquet'", "No such file or directory"]),
    "below a file": ("in.parquet", "empty.csv/out.parquet", ["OUT is", "Not a directory"]),
    "parts are a file": ("in.parquet", "taken.csv", ["OUT is 'taken.csv'", "taken.csv.parts", "File exists"]),
}


@pytest.fixture
def refused(capsys, tmp_path, monkeypatch):
    """Runs a request that must be refused in a folder that must stay as it is; gives the sentence."""
    monkeypatch.chdir(tmp_path)

    def run(*arguments):
        before = sorted((str(p), p.is_dir() or p.read_bytes()) for p in tmp_path.rglob("*"))
        status = main(["batch", *arguments])
        out, err = capsys.readouterr()
        assert (status, out) == (2, "")
        assert sorted((str(p), p.is_dir() or p.read_bytes()) for p in tmp_path.rglob("*")) == before
        [line] = err.splitlines()
        assert line.startswith("loiter: ")
        jargon = ["airspeed_m_s is", "max_bank_deg is", "source", "target", "Traceback", "Error"]
        assert [word for word in jargon if word in line] == []
        return line

    return run


@pytest.mark.parametrize(("change", "options", "named"), TABLES.values(), ids=TABLES)
def test_a_table_that_does_not_fit_is_refused(refused, change, options, named):
    write(change(poses(5)), Path("in.parquet"))
    line = refused("in.parquet", "out.parquet", *options)
    assert [word for word in named if word not in line] == [], line


@pytest.mark.parametrize(("options", "named"), VALUES.values(), ids=VALUES)
def test_a_bad_option_is_refused(refused, options, named):
    write(poses(5), Path("in.parquet"))
    line = refused("in.parquet", "out.parquet", *options)
    assert [word for word in named if word not in line] == [], line


@pytest.mark.parametrize(("source", "target", "named"), FILES.values(), ids=FILES)
def test_a_file_that_cannot_be_used_is_refused(refused, source, target, named):
    write(poses(5), Path("in.parquet"))
    Path("link.parquet").symlink_to("in.parquet")
    Path("in.csv.parquet").write_text("east_m,north_m,heading_deg\n0,0,0\n")
    for name in ("empty.csv", "taken.csv.parts"):
        Path(name).touch()
    for name in ("folder.parquet", "folder.csv"):
        Path(name).mkdir()
    line = refused(source, target, *OPTIONS)
    assert [word for word in named if word not in line] == [], line


@pytest.mark.parametrize("arguments", [[], ["in.parquet"]])
def test_both_files_are_needed(refused, arguments):
    assert ("OUT" if arguments else "IN") in refused(*arguments)


def test_a_csv_table_is_checked_by_its_header(refused):
    Path("in.csv").write_text("east_m,north_m\n0,0\n")
    assert "IN has no column heading_deg" in refused("in.csv", "out.csv", *OPTIONS)
    Path("in.csv").write_text("east_m,north_m,heading_deg,east_m\n0,0,0,0\n")
    assert "IN has two columns named 'east_m'" in refused("in.csv", "out.csv", *OPTIONS)


def test_a_missing_package_is_reported(refused, monkeypatch):
    write(poses(5), Path("in.parquet"))
    monkeypatch.setitem(sys.modules, "distributed", None)
    line = refused("in.parquet", "out.parquet", *OPTIONS, "--scheduler", "tcp://127.0.0.1:1")
    assert line.startswith('loiter: tables need distributed: pip install "loiter[tables]" brings it')
    assert line.endswith('(in a checkout: pip install ".[tables]")')
    monkeypatch.setitem(sys.modules, "pyarrow", None)
    assert "tables need pyarrow" in refused("in.parquet", "out.parquet", *OPTIONS)


def test_the_summary_counts_what_is_bad(capsys, tmp_path):
    table = scenes(1200).to_pandas()
    table.loc[:2, "heading_deg"] = float("nan")
    table.loc[3:4, "turn"] = "left"
    table.loc[5:5, "orbit_radius_m"] = 10.0
    table.to_parquet(tmp_path / "in.parquet")
    assert main(["batch", str(tmp_path / "in.parquet"), str(tmp_path / "out.parquet")]) == 0
    out, err = capsys.readouterr()
    first, *bad = err.splitlines()
    assert out == ""
    assert first.startswith("1,200 rows in ")
    assert first.endswith(" rows/s")
    assert bad == [
        "1 radius_too_small: the circle is tighter than the minimum turn radius",
        "2 bad_turn: the turn must be cw, ccw or either",
        "3 bad_pose: the position and the heading must be finite numbers, and latitudes within 90 degrees",
    ]
    assert sum(row["status"] == "ok" for row in read(tmp_path / "out.parquet")) == 1194
    assert sorted(path.name for path in tmp_path.iterdir()) == ["in.parquet", "out.parquet"]


def test_the_last_line_says_that_every_row_failed(capsys, tmp_path):
    (tmp_path / "in.csv").write_text("east_m,north_m,heading_deg\n1,2,north\n1,2,\n1,2\n")
    assert main(["batch", str(tmp_path / "in.csv"), str(tmp_path / "out.csv"), *OPTIONS]) == 0
    assert capsys.readouterr().err.splitlines()[-1] == "no row was solved: all 2 rows failed"
    (tmp_path / "in.csv").write_text("east_m,north_m,heading_deg\n")
    assert main(["batch", str(tmp_path / "in.csv"), str(tmp_path / "out.csv"), *OPTIONS]) == 0
    assert "no row was solved" not in capsys.readouterr().err


def test_wind_and_velocity_are_those_of_loiter_plan(capsys, tmp_path):
    source, options = write(poses(3), tmp_path / "in.parquet"), ["--orbit", "0", "0", "120", *OPTIONS[4:]]
    air = ["--wind", "6", "250", "--orbit-velocity", "2", "-1"]
    assert main(["batch", str(source), str(tmp_path / "out.parquet"), *options, *air]) == 0
    for row in read(tmp_path / "out.parquet"):
        pose = [str(row[name]) for name in ("east_m", "north_m", "heading_deg")]
        capsys.readouterr()
        assert main(["plan", "--json", "--pose", *pose, *options, *air]) == 0
        planned = json.loads(capsys.readouterr().out)
        assert (row["word"], row["turn"]) == (planned["word"], planned["turn"])
        assert row["duration_s"] == pytest.approx(planned["duration_s"])


def test_a_complete_dataset_is_not_solved_again(capsys, tmp_path):
    write(poses(5), tmp_path / "in.parquet")
    job = ["batch", str(tmp_path / "in.parquet"), f"{tmp_path / 'out'}/", *OPTIONS]
    assert main(job) == 0
    assert capsys.readouterr().err.startswith("5 rows in ")
    assert main(job) == 0
    assert capsys.readouterr().err == "already complete: nothing to do\n5 rows, all of them solved before\n"
    # Its parts are all there, but nothing says so.
    (tmp_path / "out" / "_SUCCESS").unlink()
    assert main(job) == 0
    assert capsys.readouterr().err == "resuming from 1 of 1 parts\n5 rows, all of them solved before\n"


def test_the_document_has_every_status():
    text = Path("docs/batch.md").read_text(encoding="utf-8")
    assert [name for name in STATUSES if name != "ok" and f"\n| `{name}` | " not in text] == []


def test_an_interrupt_before_the_job_gets_a_sentence(capsys, monkeypatch):
    def interrupted(*_, **__):
        raise KeyboardInterrupt

    monkeypatch.setattr("loiter.tables.run", interrupted)
    assert main(["batch", "in.parquet", "out.parquet", *OPTIONS]) == 130
    assert capsys.readouterr() == ("", "loiter: interrupted\n")
