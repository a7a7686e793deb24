"""Tables to plan, how to read what came of them, and jobs that are disturbed."""

import os
import subprocess
import sys
from contextlib import contextmanager
from pathlib import Path

import numpy as np
import pyarrow as pa
import pyarrow.csv
import pyarrow.parquet as pq
import pytest

from loiter import Aircraft, Orbit
from loiter.tables import jobs, parts

UAV = Aircraft(18.0, max_bank_deg=35.0)
ORBIT = Orbit(0.0, 0.0, 80.0)
GIVEN = {"orbit": ORBIT, "aircraft": UAV}
OPTIONS = ["--orbit", "0", "0", "80", "--airspeed", "18", "--bank", "35"]
# Of children, which find these modules too.
ENVIRONMENT = os.environ | {
    "PYTHONPATH": os.pathsep.join([str(Path(__file__).parents[1]), os.environ.get("PYTHONPATH", "")])
}
ADDED = [
    "duration_s",
    "word",
    "turn",
    "join_east_m",
    "join_north_m",
    "join_heading_deg",
    "duration_1_s",
    "duration_2_s",
    "duration_3_s",
    "status",
]


def poses(rows, seed=1):
    """A table of random poses with an id."""
    random = np.random.default_rng(seed)
    east, north = random.uniform(-400.0, 400.0, (2, rows))
    return pa.table(
        {"id": np.arange(rows), "east_m": east, "north_m": north, "heading_deg": random.uniform(0, 360, rows)}
    )


def scenes(rows, limit="max_bank_deg", seed=2):
    """Random poses with a circle, a turn and an aircraft for each."""
    random = np.random.default_rng(seed)
    low, high = {"max_bank_deg": (25.0, 50.0), "min_turn_radius_m": (20.0, 50.0), "max_turn_rate_deg_s": (20.0, 40.0)}[
        limit
    ]
    columns = {
        "orbit_east_m": random.uniform(-50.0, 50.0, rows),
        "orbit_north_m": random.uniform(-50.0, 50.0, rows),
        "orbit_radius_m": random.uniform(60.0, 200.0, rows),
        "turn": random.choice(["cw", "ccw", "either"], rows),
        "airspeed_m_s": random.uniform(10.0, 16.0, rows),
        limit: random.uniform(low, high, rows),
    }
    table = poses(rows, seed)
    for name, column in columns.items():
        table = table.append_column(name, pa.array(column))
    return table


def write(table, path, row_group_size=None):
    """Write a table to a Parquet or CSV file; gives the path."""
    if path.suffix == ".parquet":
        pq.write_table(table, path, row_group_size=row_group_size)
    else:
        pyarrow.csv.write_csv(table, path)
    return path


def read(path):
    """A table, whatever the kind of its file, as a list of rows; columns of CSV files are text."""
    if path.suffix == ".parquet":
        return pq.read_table(path).to_pylist()
    names = pyarrow.csv.read_csv(path).schema.names
    types = pyarrow.csv.ConvertOptions(column_types=dict.fromkeys(names, pa.string()))
    return pyarrow.csv.read_csv(
        path, convert_options=types, parse_options=pyarrow.csv.ParseOptions(newlines_in_values=True)
    ).to_pylist()


def small_parts(monkeypatch, part_rows=100, group_rows=60, batch_rows=40):
    """Make parts, row groups and batches so small that a table of some hundred rows has many."""
    monkeypatch.setattr(jobs, "PART_ROWS", part_rows)
    monkeypatch.setattr(parts, "ROW_GROUP_ROWS", group_rows)
    monkeypatch.setattr(jobs, "BATCH_ROWS", batch_rows)


def killing(*arguments):
    """Run killing.py; a failure shows its output, and the seed among its arguments."""
    command = [sys.executable, Path(__file__).with_name("killing.py"), *map(str, arguments)]
    done = subprocess.run(command, capture_output=True, text=True)
    assert done.returncode == 0, (command, done.stdout, done.stderr)


@contextmanager
def stopping(count, error):
    """Inside it a job raises an error after some parts."""
    solve, done = parts.solve_part, []

    def solve_part(part, *stopped):
        if len(done) == count:
            raise error
        done.append(part)
        return solve(part, *stopped)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("loiter.tables.parts.solve_part", solve_part)
        yield


def change_after_each_part(monkeypatch, path):
    """Let the time stamp of a file change whenever a part is solved."""
    solve = parts.solve_part

    def solve_part(part, *stopped):
        os.utime(path, (1, 1))
        return solve(part, *stopped)

    monkeypatch.setattr("loiter.tables.parts.solve_part", solve_part)
