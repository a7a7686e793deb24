"""Outputs: their columns, Parquet files, and CSV files; the same rows give the same bytes.

`pyarrow.dataset.write_dataset` writes Parquet, too, but it names and divides its files as its threads happen to run,
does not wait for the disk, and cannot leave out the parts that an earlier run has finished. `pyarrow.csv` writes nan as
text, and quotes all text or none.
"""

from __future__ import annotations

import gzip
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager, suppress
from typing import TYPE_CHECKING, Any

import numpy as np
import pyarrow as pa
import pyarrow.compute as pc
import pyarrow.parquet as pq

from loiter.batch.answers import without_dictionary
from loiter.batch.tables.columns import STATUSES, Columns, carried_columns, is_text, values_type
from loiter.batch.tables.files import Kind, open_parquet
from loiter.batch.tables.views import to_numpy
from loiter.errors import InvalidArgument

if TYPE_CHECKING:
    from numpy.typing import NDArray

    # The number of rows of each status, by its code.
    Counts = NDArray[np.int64]

# Called with a batch of answers.
Write = Callable[[pa.RecordBatch], None]

# Rows of a row group: at a hundred bytes each, what a worker keeps in memory.
ROW_GROUP_ROWS = 1 << 18

# Bytes of the dictionary of a column in a row group: one that would be larger is given up. A larger dictionary of
# arbitrary doubles would take as long as all the other work, and enlarge the file.
DICTIONARY_BYTES = 1 << 16

# The level of gzip: a fifth of the time of the usual 6, for a fourteenth more bytes.
LEVEL = 1


def output_schema(schema: pa.Schema, meaning: Columns) -> pa.Schema:
    """The columns of the output for an input with a schema, with the types of the input."""
    kept = [schema.field(name) for name in carried_columns(schema.names)]
    return pa.schema([*kept, *meaning.added], metadata=schema.metadata)


def check_columns(kind: Kind, schema: pa.Schema) -> None:
    """Raise `InvalidArgument` if a column cannot be written to a file of a kind."""
    for field in schema:
        if kind != ".parquet" and not _is_printable(field.type):
            raise InvalidArgument("target", f"cannot hold the column {field.name} of {field.type}: Parquet can")


@contextmanager
def open_output(kind: Kind, path: str, schema: pa.Schema) -> Iterator[Write]:
    """A context whose value appends a batch of answers to the file at `path`; the same rows give the same bytes."""
    if kind == ".parquet":
        with open_parquet_output(path, schema) as write_rows:
            yield write_rows
        return
    with ExitStack() as stack:
        file: Any = stack.enter_context(open(path, "wb"))  # noqa: PTH123
        if kind == ".csv.gz":
            # Without name and time, so that the same rows give the same bytes.
            file = stack.enter_context(gzip.GzipFile("", "wb", LEVEL, file, mtime=0))
        file.write(csv_header(schema))
        yield lambda batch: file.write(csv_lines(batch))


@contextmanager
def open_parquet_output(path: str, schema: pa.Schema) -> Iterator[Write]:
    """A context whose value appends a batch to the Parquet file at `path`, in row groups of some 260,000 rows."""
    writer = pq.ParquetWriter(path, schema, compression="snappy", dictionary_pagesize_limit=DICTIONARY_BYTES)
    waiting: list[pa.Table] = []

    def flush() -> None:
        if waiting:
            writer.write_table(pa.concat_tables(waiting))
            waiting.clear()

    def write(batch: pa.RecordBatch) -> None:
        waiting.append(pa.Table.from_batches([batch]).cast(schema))
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


def status_counts(place: str) -> Counts:
    """The number of rows of each status, by its code, in a part.

    Raises `OSError` or `ArrowException` if the part is not whole: after a power failure its end may be missing where
    the file system has no fsync(2).
    """
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
