"""The packages for tables are imported only when a table is planned."""

import json
import subprocess
import sys

import pytest

from tables.making import scenes, write

HEAVY = {"pyarrow", "dask", "distributed", "pandas"}


def loaded_by(code):
    code += "\nimport json, sys\nprint(json.dumps(list(sys.modules)))"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    return HEAVY & set(json.loads(done.stdout.splitlines()[-1]))


@pytest.mark.parametrize(
    "code",
    [
        "import loiter\nloiter.tables.run",
        "from loiter.cli.app import main\nmain(['--help'])",
        "import loiter.tables.command",
    ],
)
def test_naming_it_loads_nothing_heavy(code):
    assert loaded_by(code) == set()


def test_a_parquet_file_needs_neither_dask_nor_pandas(tmp_path):
    source = write(scenes(20), tmp_path / "in.parquet")
    code = f"import loiter\nloiter.tables.run({str(source)!r}, {str(tmp_path / 'out.parquet')!r})"
    assert loaded_by(code) == {"pyarrow"}
