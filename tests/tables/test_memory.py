"""Memory does not grow with the rows."""

import subprocess
import sys
from pathlib import Path

import pytest

from tables.making import OPTIONS, poses, write

pytestmark = pytest.mark.skipif(not Path("/proc/self/status").exists(), reason="tells the peak as Linux does")

# The peak of a process of its own, in bytes; getrusage would tell that of the process that started it.
PEAK = """
import sys
from pathlib import Path
from loiter.tables import csv_files, jobs, parts
from loiter.cli.app import main
csv_files.MEMORY = "128MB"
jobs.PART_ROWS = parts.ROW_GROUP_ROWS = 1 << 16
assert main(sys.argv[1:]) == 0
[peak] = [line.split()[1] for line in Path("/proc/self/status").read_text().splitlines() if line.startswith("VmHWM")]
print(int(peak) * 1024)
"""


def peak(*arguments):
    command = [sys.executable, "-c", PEAK, *map(str, arguments)]
    return int(subprocess.run(command, stdout=subprocess.PIPE, text=True, check=True).stdout)


# Were all rows held, it would be 200 MB more; what the C library keeps for later varies by some tens.
@pytest.mark.parametrize(
    ("source", "target", "few", "many", "more"),
    [("in.parquet", "out.parquet", 4, 32, 100e6), ("in.csv", "out.csv", 4, 16, 150e6)],
)
def test_many_parts_take_no_more_memory_than_few(tmp_path, source, target, few, many, more):
    peaks = []
    for count in (few, many):
        write(poses(count << 16), tmp_path / source, 1 << 16)
        peaks.append(peak("batch", tmp_path / source, tmp_path / target, *OPTIONS, "--workers", "2"))
    assert peaks[1] - peaks[0] < more, peaks


def test_one_huge_row_group_takes_no_more_either(tmp_path):
    peaks = []
    for rows in (1 << 17, 1 << 21):
        write(poses(rows), tmp_path / "in.parquet", rows)
        peaks.append(peak("batch", tmp_path / "in.parquet", tmp_path / "out.parquet", *OPTIONS, "--workers", "1"))
    assert peaks[1] - peaks[0] < 100e6, peaks
