"""Conversion of a CSV file to a Parquet file of text, which can be divided into parts; the rows keep their order."""

from __future__ import annotations

import csv
import gzip
import zlib
from collections import deque
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import IO, Any, cast

import numpy as np
import pyarrow as pa
import pyarrow.compute as pc
import pyarrow.csv

from loiter.batch.tables.files import BATCH_ROWS, unreadable
from loiter.batch.tables.lines import RepairedLines
from loiter.batch.tables.outputs import open_output
from loiter.batch.tables.views import from_numpy

# The last column of the Parquet file: 1 if the line was malformed. No header of a CSV file has this name.
MARK = pa.field("\nmalformed\n", pa.int8())

# Bytes of text read at a time; no line may be longer.
BLOCK_BYTES = 1 << 22


def csv_schema(argument: str, path: Path) -> pa.Schema:
    """The columns of a CSV file, all of them text; raises `InvalidArgument` if it has no header."""
    try:
        # Bytes that are not UTF-8 are allowed here: later they make only their own line malformed.
        with _text_file(path) as file:
            names = next((record for record in csv.reader(file) if record), None)
        if names is None:
            raise ValueError("it has no header")
        return pa.schema([(name.encode().decode(), pa.string()) for name in names])
    except (OSError, EOFError, ValueError, csv.Error, zlib.error) as error:
        raise unreadable(argument, path, error) from error


def ingest(argument: str, path: Path, schema: pa.Schema, out: Path, count_rows: Callable[[int], None]) -> None:
    """Convert the CSV file at `path` to a Parquet file at `out`, which appears whole.

    A line that is not UTF-8, or that has more or fewer fields than the header, becomes a row of nulls marked as
    malformed. `count_rows` is called with the number of rows of each batch. Raises `InvalidArgument` if the file cannot
    be read.
    """
    malformed = MalformedLines(schema.append(MARK))
    unfinished = out.with_name(f"{out.name}.tmp")
    batches = _batches(argument, path, schema, malformed)
    rows = malformed.merge_into(_as_text(batch, malformed.schema) for batch in batches)
    with open_output(".parquet", unfinished, malformed.schema, []) as write:
        for table in _tables(rows):
            write(table)
            count_rows(table.num_rows)
    unfinished.replace(out)


@dataclass(slots=True)
class Run:
    """Consecutive malformed lines: the row number of the first, and their number."""

    first: int
    count: int = 1


class MalformedLines:
    """The malformed lines that are not yet merged with the good ones, as runs, since there may be many."""

    def __init__(self, schema: pa.Schema) -> None:
        self.schema = schema
        self.runs: deque[Run] = deque()

    def add(self, line: Any) -> str:
        """Store the place of a line that pyarrow cannot split, and skip it; pyarrow counts the header as line 1."""
        row = line.number - 2
        last = self.runs[-1] if self.runs else None
        if last is not None and last.first + last.count == row:
            last.count += 1
        else:
            self.runs.append(Run(row))
        return "skip"

    def merge_into(self, batches: Iterable[pa.RecordBatch]) -> Iterator[pa.RecordBatch]:
        """The rows of `batches` with a row of nulls for each malformed line.

        pyarrow parses lines before it returns their batch. A run is merged once the present batch has a good row after
        it: the run is then complete, and the result does not depend on how far ahead pyarrow has parsed.
        """
        row = 0
        for batch in batches:
            begin = 0
            while self.runs and self.runs[0].first - row < batch.num_rows - begin:
                run = self.runs.popleft()
                yield batch.slice(begin, run.first - row)
                yield from self._nulls(run.count)
                begin, row = begin + run.first - row, run.first + run.count
            yield batch.slice(begin)
            row += batch.num_rows - begin
        for run in self.runs:
            yield from self._nulls(run.count)

    def _nulls(self, count: int) -> Iterator[pa.RecordBatch]:
        """`count` rows of nulls, marked as malformed, in batches."""
        for begin in range(0, count, BATCH_ROWS):
            rows = min(BATCH_ROWS, count - begin)
            columns = [pa.nulls(rows, field.type) for field in list(self.schema)[:-1]]
            yield pa.RecordBatch.from_arrays([*columns, from_numpy(np.ones(rows, dtype=np.int8))], schema=self.schema)


def _is_packed(path: Path) -> bool:
    return path.name.lower().endswith(".gz")


def _text_file(path: Path) -> IO[str]:
    options: dict[str, Any] = {"encoding": "utf-8-sig", "errors": "surrogateescape", "newline": ""}
    return cast("IO[str]", gzip.open(path, "rt", **options) if _is_packed(path) else path.open(**options))


def _reader(path: Path, schema: pa.Schema, malformed: Callable[[Any], str]) -> Any:
    stream = pa.input_stream(path, compression="gzip" if _is_packed(path) else None)
    return pyarrow.csv.open_csv(
        pa.PythonFile(RepairedLines(stream, len(schema)), "r"),
        read_options=pyarrow.csv.ReadOptions(use_threads=False, block_size=BLOCK_BYTES),
        parse_options=pyarrow.csv.ParseOptions(newlines_in_values=True, invalid_row_handler=malformed),
        # Bytes instead of text, so that a value that is not UTF-8 makes only its own line malformed.
        convert_options=pyarrow.csv.ConvertOptions(column_types=dict.fromkeys(schema.names, pa.binary())),
    )


def _batches(argument: str, path: Path, schema: pa.Schema, malformed: MalformedLines) -> Iterator[pa.RecordBatch]:
    try:
        with _reader(path, schema, malformed.add) as reader:
            yield from reader
    except (OSError, pa.ArrowInvalid) as error:
        raise unreadable(argument, path, error) from error


def _as_text(batch: pa.RecordBatch, schema: pa.Schema) -> pa.RecordBatch:
    """A batch of bytes as text, with the mark; a row with a value that is not UTF-8 is all nulls, and marked."""
    bad = np.zeros(batch.num_rows, dtype=bool)
    for column in batch.columns:
        bad |= _undecodable(column)
    columns = [pc.if_else(pa.array(bad), None, c) if bad.any() else c for c in batch.columns]
    mark = from_numpy(bad.astype(np.int8))
    return pa.RecordBatch.from_arrays([*(c.cast(pa.string()) for c in columns), mark], schema=schema)


def _undecodable(column: pa.Array) -> Any:
    """Whether each value of a column of bytes is not UTF-8; False if all are."""
    try:
        column.cast(pa.string())
    except pa.ArrowInvalid:
        return np.array([not _is_utf8(value) for value in column.to_pylist()])
    return False


def _is_utf8(value: bytes) -> bool:
    try:
        value.decode()
    except UnicodeDecodeError:
        return False
    return True


def _tables(batches: Iterable[pa.RecordBatch]) -> Iterator[pa.Table]:
    """The rows of batches as tables of `BATCH_ROWS` rows or somewhat more."""
    waiting: list[pa.RecordBatch] = []
    rows = 0
    for batch in batches:
        waiting.append(batch)
        rows += batch.num_rows
        if rows >= BATCH_ROWS:
            yield pa.Table.from_batches(waiting).combine_chunks()
            waiting, rows = [], 0
    if waiting:
        yield pa.Table.from_batches(waiting).combine_chunks()
