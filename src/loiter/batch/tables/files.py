"""Tables as files: which kinds there are, and a Parquet file in parts and batches."""

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

# A part is a run of whole row groups up to this many rows, or one larger row group: what Parquet writers take for a
# row group by default. A job that is stopped loses no more than the parts under way.
PART_ROWS = 1 << 20

# Rows read, solved and written at a time: some 10 MB of them, and few enough calls.
BATCH_ROWS = 1 << 16

# Bytes of a column read at a time, so that a row group need not be held whole.
READ_BYTES = 1 << 20


# The same where the air passes the circle: a row takes a thousand times as long there, and a part half a minute.
PART_ROWS_IN_WIND = 1 << 16
BATCH_ROWS_IN_WIND = 1 << 12


class Part(NamedTuple):
    """`rows` rows of the row groups `first` to `last` - 1, past `skip` of them; `number` counts the parts."""

    number: int
    first: int
    last: int
    rows: int
    skip: int = 0


def kind(argument: str, path: Path) -> Kind:
    """The kind of a file by the end of its name; raises `InvalidArgument` for another."""
    for suffix in KINDS:
        if path.name.lower().endswith(suffix) and len(path.name) > len(suffix):
            return suffix
    raise InvalidArgument(argument, f"is {str(path)!r}: the file name must end in .parquet, .csv or .csv.gz")


def reason(error: BaseException) -> str:
    """Why a file could not be read or written, in some words."""
    number = getattr(error, "errno", None)
    return os.strerror(number) if number else str(error).strip().partition("\n")[0].rstrip(".")


def unreadable(argument: str, path: Path, error: Exception) -> InvalidArgument:
    """The error to raise for a file that cannot be read."""
    return InvalidArgument(argument, f"is {str(path)!r}: it cannot be read, {reason(error)}")


def opened(path: Path) -> pq.ParquetFile:
    """A Parquet file whose columns are read a piece at a time."""
    return pq.ParquetFile(path, buffer_size=READ_BYTES, pre_buffer=False)


def parquet_schema(argument: str, path: Path) -> pa.Schema:
    """The schema of a Parquet file; raises `InvalidArgument` where it is none."""
    try:
        with opened(path) as file:
            return file.schema_arrow
    except (OSError, pa.ArrowException) as error:
        raise unreadable(argument, path, error) from error


def parts_of(path: Path, rows: int, *, cut: bool = False) -> list[Part]:
    """A Parquet file as runs of whole row groups of up to `rows` rows.

    A larger row group is a part of its own, or several where row groups may be `cut`: each of them reads it.
    """
    with opened(path) as file:
        sizes = [file.metadata.row_group(i).num_rows for i in range(file.metadata.num_row_groups)]
    parts: list[Part] = []
    for i, size in enumerate(sizes):
        if parts and parts[-1].rows + size <= rows:
            parts[-1] = parts[-1]._replace(last=i + 1, rows=parts[-1].rows + size)
        else:
            step = rows if cut else max(size, 1)
            for skip in range(0, max(size, 1), step):
                parts.append(Part(len(parts), i, i + 1, min(step, size - skip), skip))
    return parts


def batches(path: Path, part: Part, rows: int) -> Iterator[pa.RecordBatch]:
    """The rows of a part, in order, up to `rows` at a time; raises `OSError` where they cannot be read."""
    try:
        with opened(path) as file:
            yield from _within(
                part, file.iter_batches(rows, row_groups=range(part.first, part.last), use_threads=False)
            )
    except (OSError, pa.ArrowException) as error:
        raise OSError(f"{path} cannot be read, {reason(error)}") from error


def _within(part: Part, of_groups: Iterable[pa.RecordBatch]) -> Iterator[pa.RecordBatch]:
    """What of the batches of its row groups belongs to a part."""
    skip, left = part.skip, part.rows
    for batch in of_groups:
        mine = batch.slice(min(skip, batch.num_rows), left)
        skip, left = max(skip - batch.num_rows, 0), left - mine.num_rows
        if mine.num_rows:
            yield mine
        if not left:
            return
