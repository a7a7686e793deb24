"""Logs of guided flights as Parquet files: made from the CSV file that is written in flight, and read as columns."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pyarrow as pa
import pyarrow.csv as pv
import pyarrow.parquet as pq

from loiter.batch.tables.files import unreadable


def to_parquet(source: Path, target: Path, texts: set[str]) -> None:
    """Convert a CSV file with a header to a Parquet file; `texts` are its columns of text, the others are numbers."""
    with source.open(encoding="utf-8") as file:
        names = file.readline().rstrip("\n").split(",")
    types = {name: pa.string() if name in texts else pa.float64() for name in names}
    # A last line that is incomplete, of a flight that was killed, is left out.
    options = pv.ParseOptions(invalid_row_handler=lambda row: "skip")
    pq.write_table(
        pv.read_csv(source, parse_options=options, convert_options=pv.ConvertOptions(column_types=types)), target
    )


def read_parquet(path: Path) -> dict[str, list[Any]]:
    """The columns of a Parquet file by name; raises `InvalidArgument` if it cannot be read."""
    try:
        table = pq.read_table(path)
    except (OSError, pa.ArrowException) as error:
        raise unreadable("replay", str(path), error) from error
    return {name: table.column(name).to_pylist() for name in table.column_names}
