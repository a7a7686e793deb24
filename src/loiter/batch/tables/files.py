"""The kinds of files with tables, and Parquet files divided into parts and batches."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Literal, NamedTuple

import pyarrow as pa
import pyarrow.parquet as pq

from loiter.errors import InvalidArgument

Kind = Literal[".parquet", ".csv", ".csv.gz"]
KINDS: tuple[Kind, ...] = (".parquet", ".csv", ".csv.gz")

# A part consists of consecutive row groups with up to this many rows in all (the usual size of one), or of one larger
# row group. A job that is stopped loses only the parts in progress.
PART_ROWS = 1 << 20

# Rows read, solved and written at a time: some 10 MB, and large enough that the overhead of a call does not matter.
BATCH_ROWS = 1 << 16

# Bytes of a column read at a time, so that a row group need not be in memory whole.
READ_BYTES = 1 << 20


# The rows of a part and of a batch in wind, where a row takes a thousand times as long: half a minute a part.
PART_ROWS_IN_WIND = 1 << 16
BATCH_ROWS_IN_WIND = 1 << 12


class Part(NamedTuple):
    """The part `number` of a table: `rows` rows of the row groups `first` to `last` - 1, after `skip` rows."""

    number: int
    first: int
    last: int
    rows: int
    skip: int = 0


def kind(argument: str, path: Path) -> Kind:
    """The kind of a file by the ending of its name; raises `InvalidArgument` for an unknown ending."""
    for suffix in KINDS:
        if path.name.lower().endswith(suffix) and len(path.name) > len(suffix):
            return suffix
    raise InvalidArgument(argument, f"is {str(path)!r}: the file name must end in .parquet, .csv or .csv.gz")


def reason(error: BaseException) -> str:
    """The reason in words why a file could not be read or written."""
    number = getattr(error, "errno", None)
    if number:
        return os.strerror(number)
    first_line, _, _ = str(error).strip().partition("\n")
    return first_line.rstrip(".")


def unreadable(argument: str, path: Path, error: Exception) -> InvalidArgument:
    """The error to raise for a file that cannot be read."""
    return InvalidArgument(argument, f"is {str(path)!r}: it cannot be read, {reason(error)}")


def open_parquet(path: Path) -> pq.ParquetFile:
    """An open Parquet file whose columns are read in pieces."""
    return pq.ParquetFile(path, buffer_size=READ_BYTES, pre_buffer=False)


def parquet_schema(argument: str, path: Path) -> pa.Schema:
    """The schema of a Parquet file; raises `InvalidArgument` if it cannot be read as one."""
    try:
        with open_parquet(path) as file:
            return file.schema_arrow
    except (OSError, pa.ArrowException) as error:
        raise unreadable(argument, path, error) from error


def parts_of(path: Path, rows: int, *, cut: bool = False) -> list[Part]:
    """The parts of a Parquet file: consecutive row groups with up to `rows` rows.

    A larger row group is a part of its own, or with `cut` several parts, each of which reads the row group.
    """
    with open_parquet(path) as file:
        sizes = [file.metadata.row_group(i).num_rows for i in range(file.metadata.num_row_groups)]
    parts: list[Part] = []
    for i, size in enumerate(sizes):
        if parts and parts[-1].rows + size <= rows:
            part = parts.pop()
            parts.append(part._replace(last=i + 1, rows=part.rows + size))
        else:
            step = rows if cut else max(size, 1)
            for skip in range(0, max(size, 1), step):
                parts.append(Part(len(parts), i, i + 1, min(step, size - skip), skip))
    return parts


def batches(path: Path, part: Part, rows: int) -> Iterator[pa.RecordBatch]:
    """The rows of a part, in order, up to `rows` at a time; raises `OSError` if they cannot be read."""
    try:
        with open_parquet(path) as file:
            row_groups = range(part.first, part.last)
            yield from _rows_of_part(part, file.iter_batches(rows, row_groups=row_groups, use_threads=False))
    except (OSError, pa.ArrowException) as error:
        raise OSError(f"{path} cannot be read, {reason(error)}") from error


def _rows_of_part(part: Part, group_batches: Iterable[pa.RecordBatch]) -> Iterator[pa.RecordBatch]:
    """The rows of a part, from the batches of all its row groups."""
    skip, left = part.skip, part.rows
    for batch in group_batches:
        selected = batch.slice(min(skip, batch.num_rows), left)
        skip, left = max(skip - batch.num_rows, 0), left - selected.num_rows
        if selected.num_rows:
            yield selected
        if not left:
            return
