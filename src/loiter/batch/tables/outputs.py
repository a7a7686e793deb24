"""The three kinds of output files, to which tables are appended; the same rows give the same bytes."""

from __future__ import annotations

import gzip
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager, suppress
from pathlib import Path
from typing import Any, BinaryIO

import pyarrow as pa
import pyarrow.compute as pc
import pyarrow.parquet as pq

from loiter.batch.answers import without_dictionary
from loiter.batch.tables.columns import ADDED, carried_columns, is_text, values_type
from loiter.batch.tables.files import Kind, open_parquet
from loiter.errors import InvalidArgument

Write = Callable[[pa.Table], None]

# The level of gzip: a fifth of the time of the usual 6, for a fourteenth more bytes.
LEVEL = 1

# A column gets a dictionary if its dictionary in the input reduced its size below this share of the plain size.
DICTIONARY_SHARE = 0.5

_WIDTHS = {"BOOLEAN": 1, "INT32": 4, "FLOAT": 4, "INT64": 8, "DOUBLE": 8, "INT96": 12}


def output_schema(schema: pa.Schema) -> pa.Schema:
    """The columns of the output for an input with a schema, with the types of the input."""
    kept = [schema.field(name) for name in carried_columns(schema.names)]
    return pa.schema([*kept, *ADDED], metadata=schema.metadata)


def part_schema(schema: pa.Schema) -> pa.Schema:
    """The columns of a part, without dictionaries: an Arrow file can have only one per column, the input several."""
    kept = [pa.field(field.name, values_type(field.type)) for field in output_schema(schema)]
    return pa.schema([*kept[: -len(ADDED)], *ADDED])


def check_columns(kind: Kind, schema: pa.Schema) -> None:
    """Raise `InvalidArgument` if a column cannot be written to a file of a kind."""
    for field in schema:
        if kind != ".parquet" and not _is_printable(field.type):
            raise InvalidArgument("target", f"cannot hold the column {field.name} of {field.type}: Parquet can")


def dictionary_columns(schema: pa.Schema, source: Path) -> list[str]:
    """The columns that a dictionary makes smaller: text, and those that it made smaller in the file at `source`."""
    columns = [field.name for field in schema if is_text(values_type(field.type))]
    with open_parquet(source) as file:
        if file.metadata.num_row_groups:
            group = file.metadata.row_group(0)
            chunks = [group.column(i) for i in range(group.num_columns)]
            columns += [chunk.path_in_schema for chunk in chunks if _is_shrunk(chunk)]
    return [name for name in dict.fromkeys(columns) if name in schema.names]


def open_output(kind: Kind, path: Path, schema: pa.Schema, dictionaries: list[str]) -> AbstractContextManager[Write]:
    """A context with an open file of a kind; its value is a function that appends a table to the file."""
    if kind == ".parquet":
        return _parquet(path, schema, dictionaries)
    return _csv(path, schema) if kind == ".csv" else _csv_gz(path, schema)


@contextmanager
def _parquet(path: Path, schema: pa.Schema, dictionaries: list[str]) -> Iterator[Write]:
    # A dictionary of arbitrary doubles would take as long as all the other work, and enlarge the file.
    writer = pq.ParquetWriter(path, schema, compression="snappy", use_dictionary=dictionaries)
    try:
        yield lambda table: writer.write_table(table.cast(schema))
        writer.close()
    finally:
        _abandon(writer)


def _abandon(writer: Any) -> None:
    """Close a writer that is open after an error. Closing may fail again, and the file is deleted."""
    with suppress(OSError, pa.ArrowException):
        writer.close()
    writer.is_open = False


@contextmanager
def _csv(path: Path, schema: pa.Schema) -> Iterator[Write]:
    with path.open("wb") as file:
        yield _writer(file, schema)


@contextmanager
def _csv_gz(path: Path, schema: pa.Schema) -> Iterator[Write]:
    # Without name and time, so that the same rows give the same bytes.
    with path.open("wb") as file, gzip.GzipFile("", "wb", LEVEL, file, mtime=0) as compressed:
        yield _writer(compressed, schema)


def _writer(file: BinaryIO | gzip.GzipFile, schema: pa.Schema) -> Write:
    names = pa.array(schema.names)
    file.write((",".join(_quote(names).to_pylist()) + "\n").encode())

    def write(table: pa.Table) -> None:
        for batch in table.to_batches():
            file.write(csv_lines(batch))

    return write


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
