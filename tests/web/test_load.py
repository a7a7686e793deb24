"""Many at once: every answer arrives, is the right one, and memory does not grow with their number."""

import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).parents[2]


def test_of_mixed_requests_from_50_clients_none_is_lost():
    command = [sys.executable, "-m", "benchmarks.service", "--requests", "1000", "--clients", "50"]
    done = subprocess.run(command, capture_output=True, text=True, cwd=ROOT)
    assert (done.returncode, done.stderr) == (0, ""), done.stdout
    assert "lost or wrong: 0" in done.stdout
    before, after = map(int, re.search(r"memory: (\d+) kB before, (\d+) kB after", done.stdout).groups())
    # Not 20 kB a request; an answer has that.
    assert after - before < 1000 * 20
