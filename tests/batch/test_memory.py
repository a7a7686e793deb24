"""Memory does not grow with the rows."""

import subprocess
import sys

import pytest

from batch.making import OPTIONS, poses, write

# The peak of a process of its own, in bytes.
PEAK = """
import resource, sys
from loiter.batch import parts, tables
from loiter.cli.app import main
tables.PART_ROWS = parts.PART_ROWS = 1 << 16
assert main(sys.argv[1:]) == 0
print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024)
"""


def peak(*arguments):
    done = subprocess.run(
        [sys.executable, "-c", PEAK, *map(str, arguments)], capture_output=True, text=True, check=True
    )
    return int(done.stdout)


@pytest.mark.parametrize(("source", "target", "parts"), [("in.parquet", "out.parquet", 16), ("in.csv", "out.csv", 4)])
def test_many_parts_take_no_more_memory_than_few(tmp_path, source, target, parts):
    peaks = []
    for count in (2, 2 * parts):
        place = tmp_path / str(count)
        place.mkdir()
        write(poses(count << 16), place / source, 1 << 16)
        peaks.append(peak("batch", place / source, place / target, *OPTIONS, "--workers", "2"))
    # A part is 6 MB; were they all held, it would be 180 MB more.
    assert peaks[1] - peaks[0] < 48e6, peaks


def test_one_huge_row_group_takes_no_more_either(tmp_path):
    peaks = []
    for rows in (1 << 17, 1 << 21):
        source = write(poses(rows), tmp_path / f"{rows}.parquet", rows)
        peaks.append(peak("batch", source, tmp_path / "out.parquet", *OPTIONS, "--workers", "1"))
    assert peaks[1] - peaks[0] < 48e6, peaks
