"""A CSV file becomes a Parquet file of text, once, so that it can be cut into parts; its rows keep their places."""

from __future__ import annotations

import csv
import gzip
import zlib
from collections import deque
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path
from typing import IO, Any, cast

import numpy as np
import pyarrow as pa
import pyarrow.compute as pc
import pyarrow.csv

from loiter.batch.tables.files import BATCH_ROWS, unreadable
from loiter.batch.tables.lines import Mended
from loiter.batch.tables.outputs import output
from loiter.batch.tables.views import column

# The last column of the Parquet file: 1 where the line was malformed. A name that no header has.
MARK = pa.field("\nmalformed\n", pa.int8())

# Bytes of text read at a time; no line may be longer.
BLOCK_BYTES = 1 << 22


def csv_schema(argument: str, path: Path) -> pa.Schema:
    """The columns of a CSV file, all of them text; raises `InvalidArgument` where it has no header."""
    try:
        # Bytes that are not UTF-8 may follow later: they spoil their own line.
        with _text_file(path) as file:
            names = next((record for record in csv.reader(file) if record), None)
        if names is None:
            raise ValueError("it has no header")
        return pa.schema([(name.encode().decode(), pa.string()) for name in names])
    except (OSError, EOFError, ValueError, csv.Error, zlib.error) as error:
        raise unreadable(argument, path, error) from error


def ingest(argument: str, path: Path, schema: pa.Schema, out: Path, tick: Callable[[int], None]) -> None:
    """Write the CSV file at `path` to a Parquet file at `out`, which appears whole.

    A line of another number of fields than the header, or that is not UTF-8, becomes a row of nulls, marked so.
    `tick` hears the number of rows of each batch. Raises `InvalidArgument` where the file cannot be read.
    """
    malformed = Malformed(schema.append(MARK))
    unfinished = out.with_name(f"{out.name}.tmp")
    rows = malformed.woven(_text(batch, malformed.schema) for batch in _batches(argument, path, schema, malformed))
    with output(".parquet", unfinished, malformed.schema, []) as write:
        for table in _gathered(rows):
            write(table)
            tick(table.num_rows)
    unfinished.replace(out)


class Malformed:
    """Malformed lines not yet woven in among the good ones, as runs of neighbours: many of them may be one run."""

    def __init__(self, schema: pa.Schema) -> None:
        self.schema = schema
        self.runs: deque[list[int]] = deque()

    def add(self, line: Any) -> str:
        """Note a line that pyarrow cannot split, and let it go on; pyarrow counts the header as line 1."""
        place = line.number - 2
        if self.runs and sum(self.runs[-1]) == place:
            self.runs[-1][1] += 1
        else:
            self.runs.append([place, 1])
        return "skip"

    def woven(self, batches: Iterable[pa.RecordBatch]) -> Iterator[pa.RecordBatch]:
        """The rows of `batches` with rows of nulls where malformed lines stood.

        The parser is ahead of the batches. A run is taken when a good row of the batch at hand follows it: then it is
        whole, and the pieces do not depend on how far ahead the parser is.
        """
        place = 0
        for batch in batches:
            begin = 0
            while self.runs and self.runs[0][0] - place < batch.num_rows - begin:
                first, count = self.runs.popleft()
                yield batch.slice(begin, first - place)
                yield from self._nulls(count)
                begin, place = begin + first - place, first + count
            yield batch.slice(begin)
            place += batch.num_rows - begin
        for _, count in self.runs:
            yield from self._nulls(count)

    def _nulls(self, count: int) -> Iterator[pa.RecordBatch]:
        """`count` rows of nulls, marked, a batch at a time."""
        for begin in range(0, count, BATCH_ROWS):
            rows = min(BATCH_ROWS, count - begin)
            columns = [pa.nulls(rows, field.type) for field in list(self.schema)[:-1]]
            yield pa.RecordBatch.from_arrays([*columns, column(np.ones(rows, dtype=np.int8))], schema=self.schema)


def _is_packed(path: Path) -> bool:
    return path.name.lower().endswith(".gz")


def _text_file(path: Path) -> IO[str]:
    options: dict[str, Any] = {"encoding": "utf-8-sig", "errors": "surrogateescape", "newline": ""}
    return cast("IO[str]", gzip.open(path, "rt", **options) if _is_packed(path) else path.open(**options))


def _reader(path: Path, schema: pa.Schema, malformed: Callable[[Any], str]) -> Any:
    stream = pa.input_stream(path, compression="gzip" if _is_packed(path) else None)
    return pyarrow.csv.open_csv(
        pa.PythonFile(Mended(stream, len(schema)), "r"),
        read_options=pyarrow.csv.ReadOptions(use_threads=False, block_size=BLOCK_BYTES),
        parse_options=pyarrow.csv.ParseOptions(newlines_in_values=True, invalid_row_handler=malformed),
        # As bytes, so that one that is not UTF-8 spoils its own line alone.
        convert_options=pyarrow.csv.ConvertOptions(column_types=dict.fromkeys(schema.names, pa.binary())),
    )


def _batches(argument: str, path: Path, schema: pa.Schema, malformed: Malformed) -> Iterator[pa.RecordBatch]:
    try:
        with _reader(path, schema, malformed.add) as reader:
            yield from reader
    except (OSError, pa.ArrowInvalid) as error:
        raise unreadable(argument, path, error) from error


def _text(batch: pa.RecordBatch, schema: pa.Schema) -> pa.RecordBatch:
    """A batch of bytes as text, and the mark; a row with a value that is not UTF-8 is all nulls, and marked."""
    bad = np.zeros(batch.num_rows, dtype=bool)
    for of_bytes in batch.columns:
        bad |= _not_text(of_bytes)
    columns = [pc.if_else(pa.array(bad), None, c) if bad.any() else c for c in batch.columns]
    mark = column(bad.astype(np.int8))
    return pa.RecordBatch.from_arrays([*(c.cast(pa.string()) for c in columns), mark], schema=schema)


def _not_text(of_bytes: pa.Array) -> Any:
    try:
        of_bytes.cast(pa.string())
    except pa.ArrowInvalid:
        return np.array([not _decodes(value) for value in of_bytes.to_pylist()])
    return False


def _decodes(value: bytes) -> bool:
    try:
        value.decode()
    except UnicodeDecodeError:
        return False
    return True


def _gathered(batches: Iterable[pa.RecordBatch]) -> Iterator[pa.Table]:
    """Tables of `BATCH_ROWS` rows or somewhat more."""
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
