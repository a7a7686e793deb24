"""The kinds of output: their columns, and parts in the encoding of each kind; the same rows give the same bytes.

`pyarrow.dataset.write_dataset` writes Parquet, too, but it names and divides its files as its threads happen to run,
does not wait for the disk, and cannot leave out the parts that an earlier run has finished.
"""

from __future__ import annotations

import gzip
from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack, contextmanager, suppress
from os import SEEK_END
from struct import Struct
from typing import TYPE_CHECKING, Any, BinaryIO

import numpy as np
import pyarrow as pa
import pyarrow.compute as pc
import pyarrow.parquet as pq

from loiter.batch.answers import without_dictionary
from loiter.batch.tables.columns import STATUSES, Columns, carried_columns, is_text, values_type
from loiter.batch.tables.files import Kind, open_parquet
from loiter.batch.tables.storage import open_place, written_behind
from loiter.batch.tables.views import to_numpy
from loiter.errors import InvalidArgument

if TYPE_CHECKING:
    from numpy.typing import NDArray

    # The number of rows of each status, by its code.
    Counts = NDArray[np.int64]

# Called with a batch of answers.
Write = Callable[[pa.RecordBatch], None]

# Called with the place of a part.
Append = Callable[[str], None]

# Rows of a row group: at a hundred bytes each, what a worker keeps in memory.
ROW_GROUP_ROWS = 1 << 18

# The level of gzip: a fifth of the time of the usual 6, for a fourteenth more bytes.
LEVEL = 1

# A column gets a dictionary if its dictionary in the input reduced its size below this share of the plain size.
DICTIONARY_SHARE = 0.5

# Bytes of CSV files copied at a time.
_COPY_BYTES = 1 << 23

# The end of a part of a CSV file, which is not copied: a mark, and the number of rows of each status.
CSV_MAGIC = b"loiter 1"
_TRAILER = Struct(f"<8s{len(STATUSES)}q")

_WIDTHS = {"BOOLEAN": 1, "INT32": 4, "FLOAT": 4, "INT64": 8, "DOUBLE": 8, "INT96": 12}


def output_schema(schema: pa.Schema, meaning: Columns) -> pa.Schema:
    """The columns of the output for an input with a schema, with the types of the input."""
    kept = [schema.field(name) for name in carried_columns(schema.names)]
    return pa.schema([*kept, *meaning.added], metadata=schema.metadata)


def check_columns(kind: Kind, schema: pa.Schema) -> None:
    """Raise `InvalidArgument` if a column cannot be written to a file of a kind."""
    for field in schema:
        if kind != ".parquet" and not _is_printable(field.type):
            raise InvalidArgument("target", f"cannot hold the column {field.name} of {field.type}: Parquet can")


def dictionary_columns(schema: pa.Schema, source: str) -> list[str]:
    """The columns that a dictionary makes smaller: text, and those that it made smaller in the file at `source`."""
    columns = [field.name for field in schema if is_text(values_type(field.type))]
    with open_parquet(source) as file:
        if file.metadata.num_row_groups:
            group = file.metadata.row_group(0)
            chunks = [group.column(i) for i in range(group.num_columns)]
            columns += [chunk.path_in_schema for chunk in chunks if _is_shrunk(chunk)]
    names = set(schema.names)
    return [name for name in dict.fromkeys(columns) if name in names]


@contextmanager
def open_part(kind: Kind, path: str, schema: pa.Schema, dictionaries: Sequence[str]) -> Iterator[Write]:
    """A context whose value appends a batch of answers to the part at `path`; the same rows give the same bytes."""
    with ExitStack() as stack:
        if kind == ".parquet":
            write_table = stack.enter_context(open_parquet_output(path, schema, dictionaries))
        else:
            file = stack.enter_context(open(path, "wb"))  # noqa: PTH123
            write_lines = stack.enter_context(_csv_part(file, kind))
        begin_to_write = stack.enter_context(written_behind(path))

        def write(batch: pa.RecordBatch) -> None:
            if kind == ".parquet":
                write_table(pa.Table.from_batches([batch]))
            else:
                write_lines(batch)
            begin_to_write()

        yield write


@contextmanager
def open_parquet_output(
    path: str, schema: pa.Schema, dictionaries: Sequence[str]
) -> Iterator[Callable[[pa.Table], None]]:
    """A context whose value appends a table to the Parquet file at `path`, in row groups of some 260,000 rows."""
    # A dictionary of arbitrary doubles would take as long as all the other work, and enlarge the file.
    writer = pq.ParquetWriter(path, schema, compression="snappy", use_dictionary=list(dictionaries))
    waiting: list[pa.Table] = []

    def flush() -> None:
        if waiting:
            writer.write_table(pa.concat_tables(waiting))
            waiting.clear()

    def write(table: pa.Table) -> None:
        waiting.append(table.cast(schema))
        if sum(table.num_rows for table in waiting) >= ROW_GROUP_ROWS:
            flush()

    try:
        yield write
        flush()
        writer.close()
    finally:
        _abandon(writer)


def _abandon(writer: Any) -> None:
    """Close a writer that is open after an error. Closing may fail again, and the file is deleted."""
    with suppress(OSError, pa.ArrowException):
        writer.close()
    writer.is_open = False


@contextmanager
def _csv_part(file: BinaryIO, kind: Kind) -> Iterator[Write]:
    """A context that writes lines without a header, and then the number of rows of each status."""
    counts = no_rows()
    with ExitStack() as stack:
        lines: Any = file
        if kind == ".csv.gz":
            # Without name and time, so that the same rows give the same bytes.
            lines = stack.enter_context(gzip.GzipFile("", "wb", LEVEL, file, mtime=0))

        def write(batch: pa.RecordBatch) -> None:
            lines.write(csv_lines(batch))
            counts[:] += count_statuses(batch.column("status"))

        yield write
    file.write(_TRAILER.pack(CSV_MAGIC, *counts.tolist()))


@contextmanager
def open_joined(kind: Kind, path: str, schema: pa.Schema, dictionaries: Sequence[str]) -> Iterator[Append]:
    """A context whose value appends a part to the file at `path`: rows of Parquet written again, CSV lines copied."""
    with ExitStack() as stack:
        if kind == ".parquet":
            write_table = stack.enter_context(open_parquet_output(path, schema, dictionaries))
        else:
            file = stack.enter_context(open(path, "wb"))  # noqa: PTH123
            header = csv_header(schema)
            # A gzip file may consist of several. Without time, so that the same rows give the same bytes.
            file.write(gzip.compress(header, LEVEL, mtime=0) if kind == ".csv.gz" else header)
        begin_to_write = stack.enter_context(written_behind(path))

        def append(place: str) -> None:
            if kind == ".parquet":
                with open_parquet(place) as part:
                    for batch in part.iter_batches(ROW_GROUP_ROWS, use_threads=False):
                        write_table(pa.Table.from_batches([batch]))
            else:
                _copy_lines(place, file)
            begin_to_write()

        yield append


def _copy_lines(place: str, file: BinaryIO) -> None:
    with open_place(place) as part:
        left = csv_size(part)
        part.seek(0)
        while left:
            content = part.read(min(_COPY_BYTES, left))
            if not content:
                raise OSError("a part ends too early")
            file.write(content)
            left -= len(content)


def status_counts(kind: Kind, place: str) -> Counts:
    """The number of rows of each status, by its code, in a part.

    Raises `OSError` or `ArrowException` if the part is not whole: after a power failure its end may be missing where
    the file system has no fsync(2).
    """
    if kind != ".parquet":
        with open_place(place) as file:
            return _csv_counts(file)
    counts = no_rows()
    with open_parquet(place) as file:
        for batch in file.iter_batches(columns=["status"], use_threads=False):
            counts += count_statuses(batch.column(0))
    return counts


def no_rows() -> Counts:
    """No rows of any status."""
    return np.zeros(len(STATUSES), dtype=np.int64)


def count_statuses(status: pa.Array) -> Counts:
    """The number of rows of each status, by its code, in a column of statuses."""
    names = status.dictionary.to_pylist()
    counts = no_rows()
    found = np.bincount(to_numpy(status.indices), minlength=len(names))
    counts[[STATUSES.index(name) for name in names]] = found[: len(names)]
    return counts


def csv_size(part: BinaryIO) -> int:
    """The number of bytes of the lines in a part of a CSV file."""
    return part.seek(0, SEEK_END) - _TRAILER.size


def _csv_counts(part: BinaryIO) -> Counts:
    if csv_size(part) < 0:
        raise OSError("a part ends too early")
    part.seek(csv_size(part))
    magic, *counts = _TRAILER.unpack(part.read(_TRAILER.size))
    if magic != CSV_MAGIC:
        raise OSError("a part ends too early")
    return np.array(counts, dtype=np.int64)


def csv_header(schema: pa.Schema) -> bytes:
    """The first line of a CSV file."""
    return (",".join(_quote(pa.array(schema.names)).to_pylist()) + "\n").encode()


def csv_lines(batch: pa.RecordBatch) -> pa.Buffer:
    """A line of text for each row, with an empty field for null and nan, and quotes only if a value needs them."""
    fields = [_as_text(column) for column in batch.columns]
    rows = pc.binary_join_element_wise(*fields, ",", null_handling="replace", null_replacement="")
    text = pc.binary_join_element_wise(rows, "", "\n")
    # The buffers are validity, offsets and values; the values are the lines one after another.
    _, _, values = text.buffers()
    return values


def _as_text(column: pa.Array) -> pa.Array:
    column = without_dictionary(column)
    if pa.types.is_floating(column.type):
        column = pc.if_else(pc.is_nan(column), None, column)
    return _quote(column.cast(pa.string())) if is_text(column.type) else column.cast(pa.string())


def _quote(column: pa.Array) -> pa.Array:
    special = pc.match_substring_regex(column, '[",\r\n]')
    if not pc.any(special).as_py():
        return column
    doubled = pc.replace_substring(column, '"', '""')
    return pc.if_else(special, pc.binary_join_element_wise('"', doubled, '"', ""), column)


def _is_printable(type_: pa.DataType) -> bool:
    if pa.types.is_binary(values_type(type_)) or pa.types.is_large_binary(values_type(type_)):
        return False
    try:
        pa.nulls(0, values_type(type_)).cast(pa.string())
    except pa.ArrowNotImplementedError:
        return False
    return True


def _is_shrunk(chunk: Any) -> bool:
    """Whether a column chunk was written with a dictionary that made it smaller."""
    width = _WIDTHS.get(chunk.physical_type)
    if width is None or not any("DICTIONARY" in encoding for encoding in chunk.encodings):
        return False
    return bool(chunk.total_uncompressed_size < DICTIONARY_SHARE * width * chunk.num_values)
