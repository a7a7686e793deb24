"""`loiter batch` as a whole process: rows a second and peak memory from 1e5 rows up, one worker against two."""

import os
import subprocess
import sys
from pathlib import Path
from tempfile import TemporaryDirectory
from time import perf_counter
from typing import NamedTuple

import numpy as np

ROW_GROUP = 1 << 20
SCENE = ["--orbit", "0", "0", "80", "--airspeed", "18", "--bank", "35"]


class Run(NamedTuple):
    """One run: rows, workers, seconds of the whole process, peak memory in MiB."""

    rows: int
    workers: int
    seconds: float
    peak_mib: float


def measure(most: int) -> list[Run]:
    """1e5, 1e6 ... up to `most` rows, with one worker and with two; the largest needs some 200 bytes of disk a row."""
    runs = []
    with TemporaryDirectory(prefix="loiter-bench-") as folder:
        sizes = [10**k for k in range(5, 10) if 10**k <= most]
        for rows in sizes:
            source = Path(folder) / f"{rows}.parquet"
            write_states(source, rows)
            runs += [run(source, Path(folder) / "out.parquet", rows, workers) for workers in (1, 2)]
            source.unlink()
    return runs


def write_states(path: Path, rows: int) -> None:
    """Random starts within 10 radii of the circle, in row groups of a million."""
    import pyarrow as pa
    import pyarrow.parquet as pq

    rng = np.random.default_rng(rows)
    schema = pa.schema([(name, pa.float64()) for name in ("east_m", "north_m", "heading_deg")])
    with pq.ParquetWriter(path, schema, use_dictionary=False) as writer:
        for start in range(0, rows, ROW_GROUP):
            n = min(ROW_GROUP, rows - start)
            columns = rng.uniform(-800.0, 800.0, n), rng.uniform(-800.0, 800.0, n), rng.uniform(0.0, 360.0, n)
            writer.write_table(pa.table(list(columns), schema=schema))


def run(source: Path, target: Path, rows: int, workers: int) -> Run:
    """One run of the command in a process of its own."""
    loiter = Path(sys.executable).with_name("loiter")
    command = [str(loiter), "batch", str(source), str(target), *SCENE, "--workers", str(workers)]
    begin = perf_counter()
    process = subprocess.Popen(command, stderr=subprocess.DEVNULL)
    _, status, usage = os.wait4(process.pid, 0)
    seconds = perf_counter() - begin
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode:
        raise RuntimeError(f"{' '.join(command)} ended with {process.returncode}")
    target.unlink()
    return Run(rows, workers, seconds, usage.ru_maxrss / 1024.0)
