"""Rows per second and peak memory of the process `loiter batch`, from 1e5 rows up, with one worker and with two."""

import shutil
import subprocess
import sys
from contextlib import suppress
from pathlib import Path
from tempfile import TemporaryDirectory
from time import perf_counter, sleep
from typing import NamedTuple

import numpy as np

ROW_GROUP = 1 << 20
OUTPUTS = {"dataset": "out/", "file": "out.parquet"}
SCENE = ["--orbit", "0", "0", "80", "--airspeed", "18", "--bank", "35"]


class Run(NamedTuple):
    """One run: the kind of output, rows, workers, seconds of the whole process, peak memory in MiB."""

    output: str
    rows: int
    workers: int
    seconds: float
    peak_mib: float


def measure(max_rows: int) -> list[Run]:
    """Runs of 1e5, 1e6 ... up to `max_rows` rows with one and two workers; they take some 200 bytes of disk per row."""
    runs = []
    with TemporaryDirectory(prefix="loiter-bench-") as folder:
        sizes = [10**k for k in range(5, 10) if 10**k <= max_rows]
        for rows in sizes:
            source = Path(folder) / f"{rows}.parquet"
            write_states(source, rows)
            runs += [run(source, output, rows, workers) for output in OUTPUTS for workers in (1, 2)]
            source.unlink()
    return runs


def write_states(path: Path, rows: int) -> None:
    """Write random starts within 10 radii of the circle, in row groups of a million."""
    import pyarrow as pa
    import pyarrow.parquet as pq

    rng = np.random.default_rng(rows)
    schema = pa.schema([(name, pa.float64()) for name in ("east_m", "north_m", "heading_deg")])
    with pq.ParquetWriter(path, schema, use_dictionary=False) as writer:
        for start in range(0, rows, ROW_GROUP):
            n = min(ROW_GROUP, rows - start)
            columns = rng.uniform(-800.0, 800.0, n), rng.uniform(-800.0, 800.0, n), rng.uniform(0.0, 360.0, n)
            writer.write_table(pa.table(list(columns), schema=schema))


def run(source: Path, output: str, rows: int, workers: int) -> Run:
    """Run the command in a separate process, with an output beside the input."""
    target = f"{source.parent}/{OUTPUTS[output]}"
    loiter = Path(sys.executable).with_name("loiter")
    command = [str(loiter), "batch", str(source), target, *SCENE, "--workers", str(workers)]
    begin = perf_counter()
    process = subprocess.Popen(command, stderr=subprocess.DEVNULL)
    peak = 0
    while process.poll() is None:
        peak = max(peak, peak_memory(process.pid))
        sleep(0.02)
    seconds = perf_counter() - begin
    if process.returncode:
        raise RuntimeError(f"{' '.join(command)} ended with {process.returncode}")
    shutil.rmtree(target) if Path(target).is_dir() else Path(target).unlink()
    return Run(output, rows, workers, seconds, peak / 1024.0)


def peak_memory(pid: int) -> int:
    """Peak memory of a process so far, KiB. (getrusage would include that of its parent.)"""
    with suppress(OSError):
        for line in Path(f"/proc/{pid}/status").read_text().splitlines():
            if line.startswith("VmHWM"):
                _, kib, _ = line.split()
                return int(kib)
    return 0
