"""Conversion of CSV files to a Parquet file of text, which can be divided into parts; the rows keep their order."""

from __future__ import annotations

import csv
import gzip
import io
import zlib
from collections import deque
from collections.abc import Callable, Iterable, Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from typing import IO, Any

import numpy as np
import pyarrow as pa
import pyarrow.compute as pc
import pyarrow.csv

from loiter.batch.tables.files import BATCH_ROWS, unreadable
from loiter.batch.tables.lines import RepairedLines
from loiter.batch.tables.outputs import open_parquet_output
from loiter.batch.tables.sources import Source
from loiter.batch.tables.storage import is_url, open_place
from loiter.batch.tables.views import from_numpy
from loiter.errors import InvalidArgument

# The last column of the Parquet file: 1 if the line was malformed. No header of a CSV file has this name.
MARK = pa.field("\nmalformed\n", pa.int8())

# Bytes of text read at a time; no line may be longer.
BLOCK_BYTES = 1 << 22


def csv_schema(argument: str, source: Source) -> pa.Schema:
    """The columns of CSV files, all of them text; raises `InvalidArgument` if they differ or if there is no header."""
    first, *others = [_header(argument, source, place) for place in source.files]
    for place, names in zip(source.files[1:], others, strict=True):
        if names != first:
            raise InvalidArgument(argument, f"is {source.text!r}: {place} has another header than the first file")
    return pa.schema([(name.encode().decode(), pa.string()) for name in first])


def _header(argument: str, source: Source, place: str) -> list[str]:
    try:
        # Bytes that are not UTF-8 are allowed here: later they make only their own line malformed.
        with _text_file(place) as file:
            names = next((record for record in csv.reader(file) if record), None)
        if names is None:
            raise ValueError("it has no header")
        # A header that is not UTF-8 is refused.
        "".join(names).encode()
    except (OSError, EOFError, ValueError, csv.Error, zlib.error) as error:
        raise unreadable(argument, source.shown(place), error) from error
    return names


def ingest(argument: str, source: Source, schema: pa.Schema, out: str, count_rows: Callable[[int], None]) -> None:
    """Convert CSV files to a Parquet file at `out`.

    A line that is not UTF-8, or that has more or fewer fields than the header, becomes a row of nulls marked as
    malformed. `count_rows` is called with the number of rows of each batch. Raises `InvalidArgument` if a file cannot
    be read.
    """
    marked = schema.append(MARK)
    with open_parquet_output(out, marked, []) as write:
        for place in source.files:
            # Line numbers begin anew in each file.
            malformed = MalformedLines(marked)
            batches = _batches(argument, source, place, schema, malformed)
            for table in _tables(malformed.merge_into(_as_text(batch, marked) for batch in batches)):
                write(table)
                count_rows(table.num_rows)


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


def _is_packed(place: str) -> bool:
    return place.lower().endswith(".gz")


@contextmanager
def _text_file(place: str) -> Iterator[IO[str]]:
    with open_place(place) as file, ExitStack() as stack:
        content = stack.enter_context(gzip.GzipFile(fileobj=file)) if _is_packed(place) else file
        yield stack.enter_context(io.TextIOWrapper(content, "utf-8-sig", "surrogateescape", ""))


@contextmanager
def _reader(place: str, schema: pa.Schema, malformed: Callable[[Any], str]) -> Iterator[Any]:
    with ExitStack() as stack:
        # pyarrow reads a local file without Python.
        file = stack.enter_context(open_place(place)) if is_url(place) else place
        stream = stack.enter_context(pa.input_stream(file, compression="gzip" if _is_packed(place) else None))
        yield stack.enter_context(
            pyarrow.csv.open_csv(
                pa.PythonFile(RepairedLines(stream, len(schema)), "r"),
                read_options=pyarrow.csv.ReadOptions(use_threads=False, block_size=BLOCK_BYTES),
                parse_options=pyarrow.csv.ParseOptions(newlines_in_values=True, invalid_row_handler=malformed),
                # Bytes instead of text, so that a value that is not UTF-8 makes only its own line malformed.
                convert_options=pyarrow.csv.ConvertOptions(column_types=dict.fromkeys(schema.names, pa.binary())),
            )
        )


def _batches(
    argument: str, source: Source, place: str, schema: pa.Schema, malformed: MalformedLines
) -> Iterator[pa.RecordBatch]:
    try:
        with _reader(place, schema, malformed.add) as reader:
            yield from reader
    except (OSError, pa.ArrowInvalid) as error:
        raise unreadable(argument, source.shown(place), error) from error


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
