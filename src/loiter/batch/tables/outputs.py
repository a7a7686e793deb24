"""The three kinds of output, each written a table at a time by one that appends; the same rows give the same bytes."""

from __future__ import annotations

import gzip
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager, suppress
from pathlib import Path
from typing import Any, BinaryIO

import pyarrow as pa
import pyarrow.compute as pc
import pyarrow.parquet as pq

from loiter.batch.answers import plain
from loiter.batch.tables.columns import ADDED, carried, is_text, values_type
from loiter.batch.tables.files import Kind, opened
from loiter.errors import InvalidArgument

Write = Callable[[pa.Table], None]

# Of gzip: a fifth of the time of the usual 6, for a fourteenth more bytes.
LEVEL = 1

# A column that its input's writer brought below this share of its plain size profits from a dictionary.
PROFIT = 0.5

_WIDTHS = {"BOOLEAN": 1, "INT32": 4, "FLOAT": 4, "INT64": 8, "DOUBLE": 8, "INT96": 12}


def output_schema(schema: pa.Schema) -> pa.Schema:
    """The columns of the output for an input of this schema, with the input's types."""
    kept = [schema.field(name) for name in carried(schema.names)]
    return pa.schema([*kept, *ADDED], metadata=schema.metadata)


def part_schema(schema: pa.Schema) -> pa.Schema:
    """The same where it is passed on: an Arrow file holds one dictionary a column, which an input may not."""
    kept = [pa.field(field.name, values_type(field.type)) for field in output_schema(schema)]
    return pa.schema([*kept[: -len(ADDED)], *ADDED])


def check(kind: Kind, schema: pa.Schema) -> None:
    """Raise `InvalidArgument` where a column cannot be written to a file of this kind."""
    for field in schema:
        if kind != ".parquet" and not _is_printable(field.type):
            raise InvalidArgument("target", f"cannot hold the column {field.name} of {field.type}: Parquet can")


def dictionary_columns(schema: pa.Schema, source: Path) -> list[str]:
    """The columns that a dictionary makes smaller: text, and what it made smaller in the Parquet file at `source`."""
    columns = [field.name for field in schema if is_text(values_type(field.type))]
    with opened(source) as file:
        if file.metadata.num_row_groups:
            group = file.metadata.row_group(0)
            chunks = [group.column(i) for i in range(group.num_columns)]
            columns += [chunk.path_in_schema for chunk in chunks if _profits(chunk)]
    return [name for name in dict.fromkeys(columns) if name in schema.names]


def output(kind: Kind, path: Path, schema: pa.Schema, dictionaries: list[str]) -> AbstractContextManager[Write]:
    """A file of this kind, opened for the whole of the job; what comes out of the context appends a table to it."""
    if kind == ".parquet":
        return _parquet(path, schema, dictionaries)
    return _csv(path, schema) if kind == ".csv" else _csv_gz(path, schema)


@contextmanager
def _parquet(path: Path, schema: pa.Schema, dictionaries: list[str]) -> Iterator[Write]:
    # Random doubles as they are: a dictionary of them would take as long as all the rest, and grow them.
    writer = pq.ParquetWriter(path, schema, compression="snappy", use_dictionary=dictionaries)
    try:
        yield lambda table: writer.write_table(table.cast(schema))
        writer.close()
    finally:
        _abandon(writer)


def _abandon(writer: Any) -> None:
    """Close what is still open after an error, which may fail again; the file is thrown away."""
    with suppress(OSError, pa.ArrowException):
        writer.close()
    writer.is_open = False


@contextmanager
def _csv(path: Path, schema: pa.Schema) -> Iterator[Write]:
    with path.open("wb") as file:
        yield _writer(file, schema)


@contextmanager
def _csv_gz(path: Path, schema: pa.Schema) -> Iterator[Write]:
    # Neither a name nor a time, so that the same rows give the same bytes.
    with path.open("wb") as file, gzip.GzipFile("", "wb", LEVEL, file, mtime=0) as packed:
        yield _writer(packed, schema)


def _writer(file: BinaryIO | gzip.GzipFile, schema: pa.Schema) -> Write:
    names = pa.array(schema.names)
    file.write((",".join(_quoted(names).to_pylist()) + "\n").encode())

    def write(table: pa.Table) -> None:
        for batch in table.to_batches():
            file.write(lines(batch))

    return write


def lines(batch: pa.RecordBatch) -> pa.Buffer:
    """A line of text for each row; an empty field for null and nan, quotes only where a value needs them."""
    fields = [_as_text(column) for column in batch.columns]
    rows = pc.binary_join_element_wise(*fields, ",", null_handling="replace", null_replacement="")
    text = pc.binary_join_element_wise(rows, "", "\n")
    # The lines lie one after another in the array's buffer of values.
    return text.buffers()[2]


def _as_text(column: pa.Array) -> pa.Array:
    column = plain(column)
    if pa.types.is_floating(column.type):
        column = pc.if_else(pc.is_nan(column), None, column)
    return _quoted(column.cast(pa.string())) if is_text(column.type) else column.cast(pa.string())


def _quoted(column: pa.Array) -> pa.Array:
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


def _profits(chunk: Any) -> bool:
    """Whether the dictionary that a column chunk was written with made it smaller."""
    width = _WIDTHS.get(chunk.physical_type)
    if width is None or not any("DICTIONARY" in encoding for encoding in chunk.encodings):
        return False
    return bool(chunk.total_uncompressed_size < PROFIT * width * chunk.num_values)
