"""The kinds of files with tables, and Parquet files divided into parts and batches."""

from __future__ import annotations

import errno
import os
from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack, contextmanager
from pathlib import PurePosixPath
from typing import Literal, NamedTuple

import pyarrow as pa
import pyarrow.parquet as pq

from loiter.batch.tables import storage
from loiter.batch.tables.columns import values_type
from loiter.errors import InvalidArgument

Kind = Literal[".parquet", ".csv", ".csv.gz"]
KINDS: tuple[Kind, ...] = (".parquet", ".csv", ".csv.gz")

# What is said about other endings.
ENDINGS = {
    "source": "the file name must end in .parquet, .csv or .csv.gz",
    "target": "the name must end in .parquet, .csv or .csv.gz, or in / for a folder of Parquet files",
}

# Footers of the files of a dataset that are read at the same time.
FOOTERS_AT_A_TIME = 16

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


class RowGroups(NamedTuple):
    """The row groups `first` to `last` - 1 of the file with index `file`."""

    file: int
    first: int
    last: int


class Part(NamedTuple):
    """The part `number` of a table: `rows` rows of consecutive row groups, after `skip` rows."""

    number: int
    groups: tuple[RowGroups, ...]
    rows: int
    skip: int = 0


class Footer(NamedTuple):
    """What the footer of a Parquet file says: its columns, and the number of rows of each row group."""

    schema: pa.Schema
    sizes: list[int]


def kind_of(name: str) -> Kind | None:
    """The kind of a file by the ending of its name; None for an unknown ending."""
    return next((kind for kind in KINDS if name.lower().endswith(kind) and len(name) > len(kind)), None)


def kind(argument: str, place: str) -> Kind:
    """The kind of the file at a place; raises `InvalidArgument` for an unknown ending."""
    found = kind_of(PurePosixPath(place).name)
    if found is None:
        raise InvalidArgument(argument, f"is {place!r}: {ENDINGS[argument]}")
    return found


def reason(error: BaseException) -> str:
    """The reason in words why a file could not be read or written."""
    number = getattr(error, "errno", None)
    if number:
        return os.strerror(number)
    first_line, _, _ = str(error).strip().partition("\n")
    # Stores may say only which file they do not have.
    if isinstance(error, FileNotFoundError) and " " not in first_line:
        return os.strerror(errno.ENOENT)
    return first_line.rstrip(".")


def unreadable(argument: str, place: str, error: Exception) -> InvalidArgument:
    """The error to raise for a file that cannot be read."""
    return InvalidArgument(argument, f"is {place!r}: it cannot be read, {reason(error)}")


@contextmanager
def open_parquet(place: str) -> Iterator[pq.ParquetFile]:
    """An open Parquet file whose columns are read in pieces."""
    size = storage.REQUEST_BYTES if storage.is_url(place) else READ_BYTES
    # pyarrow opens a local file itself, and then reads it without Python.
    with ExitStack() as stack:
        source = stack.enter_context(storage.open_place(place)) if storage.is_url(place) else place
        yield stack.enter_context(pq.ParquetFile(source, buffer_size=size, pre_buffer=False))


def read_footers(argument: str, places: Sequence[str], shown: Callable[[str], str]) -> list[Footer]:
    """The footers of Parquet files; raises `InvalidArgument` if one cannot be read. `shown` is its name in errors."""

    def read(place: str) -> Footer:
        try:
            return read_footer(place)
        except (OSError, pa.ArrowException) as error:
            raise unreadable(argument, shown(place), error) from error

    # Several at a time, since a store takes long to answer.
    with ThreadPoolExecutor(min(FOOTERS_AT_A_TIME, len(places))) as pool:
        return list(pool.map(read, places))


def read_footer(place: str) -> Footer:
    """The footer of a Parquet file; raises `OSError` or `ArrowException` if it cannot be read."""
    with open_parquet(place) as file:
        sizes = [file.metadata.row_group(i).num_rows for i in range(file.metadata.num_row_groups)]
        return Footer(file.schema_arrow, sizes)


def common_schema(argument: str, places: Sequence[str], schemas: Sequence[pa.Schema]) -> pa.Schema:
    """The columns of all files, in the order of the first; a column that has only nulls in some files may lack a type.

    Raises `InvalidArgument` if a file has other columns or other types than the first.
    """
    if len(schemas) == 1:
        return schemas[0]
    fields = {field.name: field for field in schemas[0]}
    for place, schema in zip(places, schemas, strict=True):
        if sorted(schema.names) != sorted(schemas[0].names):
            odd = min({*schema.names} ^ {*schemas[0].names}, default="twice the same one")
            raise InvalidArgument(argument, f"has files with different columns: {place} and the first differ in {odd}")
        for field in schema:
            known = fields[field.name]
            if pa.types.is_null(known.type):
                fields[field.name] = field
            elif not pa.types.is_null(field.type) and values_type(field.type) != values_type(known.type):
                types = f"{known.type} in the first, {field.type} in {place}"
                raise InvalidArgument(argument, f"has files with different types of the column {field.name}: {types}")
    return pa.schema([fields[name] for name in schemas[0].names], schemas[0].metadata)


def parts_of(sizes: Sequence[Sequence[int]], rows: int, *, cut: bool = False) -> list[Part]:
    """The parts of a table, at least one: consecutive row groups with up to `rows` rows.

    `sizes` are the numbers of rows of the row groups of each file. A larger row group is a part of its own, or with
    `cut` several parts, each of which reads the row group.
    """
    parts: list[Part] = []
    for file, file_sizes in enumerate(sizes):
        for i, size in enumerate(file_sizes):
            if parts and parts[-1].rows + size <= rows:
                part = parts.pop()
                parts.append(part._replace(groups=_extended(part.groups, file, i), rows=part.rows + size))
            else:
                step = rows if cut else max(size, 1)
                for skip in range(0, max(size, 1), step):
                    groups = (RowGroups(file, i, i + 1),)
                    parts.append(Part(len(parts), groups, min(step, size - skip), skip))
    # A table without rows has a part, which says what its columns are.
    return parts or [Part(0, (), 0)]


def _extended(groups: tuple[RowGroups, ...], file: int, index: int) -> tuple[RowGroups, ...]:
    *before, last = groups
    if last.file == file:
        return (*before, last._replace(last=index + 1))
    return (*groups, RowGroups(file, index, index + 1))


def batches(places: Sequence[str], part: Part, rows: int) -> Iterator[pa.RecordBatch]:
    """The rows of a part, in order, up to `rows` at a time; raises `OSError` if they cannot be read."""
    return _rows_of_part(part, (batch for groups in part.groups for batch in _group_batches(places, groups, rows)))


def _group_batches(places: Sequence[str], groups: RowGroups, rows: int) -> Iterator[pa.RecordBatch]:
    place = places[groups.file]
    try:
        with open_parquet(place) as file:
            yield from file.iter_batches(rows, row_groups=range(groups.first, groups.last), use_threads=False)
    except (OSError, pa.ArrowException) as error:
        raise OSError(f"{place} cannot be read, {reason(error)}") from error


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
