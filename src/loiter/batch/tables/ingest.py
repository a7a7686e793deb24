"""Conversion of CSV files to a Parquet file of text, which can be divided into parts; the rows keep their order.

pyarrow splits the lines, and its handler of invalid rows finds most malformed ones; what is done here beside it keeps a
row for each malformed line at its place, and the number of the line in the file, neither of which pyarrow does.
"""

from __future__ import annotations

import csv
import gzip
import io
import zlib
from collections import deque
from collections.abc import Callable, Iterable, Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import IO, Any, NamedTuple

import numpy as np
import pyarrow as pa
import pyarrow.compute as pc
import pyarrow.csv

from loiter.batch.tables.files import BATCH_ROWS, unreadable
from loiter.batch.tables.lines import MalformedLine, RepairedLines, SourceLines
from loiter.batch.tables.outputs import open_parquet_output
from loiter.batch.tables.sources import Source
from loiter.batch.tables.storage import is_url, open_place
from loiter.batch.tables.types import InferredTypes
from loiter.batch.tables.views import from_numpy, to_numpy
from loiter.errors import InvalidArgument

# The last column of the Parquet file: 1 if the line was malformed. No header of a CSV file has this name.
MARK = pa.field("\nmalformed\n", pa.int8())

# Bytes of text read at a time; a longer line is malformed.
BLOCK_BYTES = 1 << 22

# Characters of malformed lines that are kept until their rows are written; the fields of further ones are null.
KEPT_CHARACTERS = 1 << 26

# The columns of the file of rejected lines.
REJECTED_COLUMNS = ("file", "line", "problem", "text")


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
    except (OSError, EOFError, ValueError, csv.Error, zlib.error) as error:
        raise unreadable(argument, source.shown(place), error) from error
    problem = "it has no header" if names is None else _encoding_problem("".join(names))
    if names is None or problem:
        raise InvalidArgument(argument, f"is {source.shown(place)!r}: it cannot be read, {problem}")
    return names


def _encoding_problem(header: str) -> str:
    """What is wrong with the encoding of a header, read with bytes that are not UTF-8 as surrogates; "" if nothing."""
    if header.startswith(("\udcff\udcfe", "\udcfe\udcff")) or "\0" in header:
        return "it is UTF-16: write it as UTF-8, for example with iconv -f UTF-16 -t UTF-8"
    try:
        header.encode()
    except UnicodeEncodeError as error:
        byte = ord(header[error.start]) & 0xFF
        cause = f"its header is not UTF-8: it has the byte 0x{byte:02x} after {header[: error.start][-20:]!r}"
        return f"{cause}; if it is Windows-1252, iconv -f WINDOWS-1252 -t UTF-8 converts it"
    return ""


class Ingested(NamedTuple):
    """What is known of CSV files: the names of the types that the columns seem to have, and the first malformed line.

    The line is described by file, line number and problem: "line 4 of states.csv has 3 fields"; "" if there is none.
    """

    types: list[str]
    first_malformed: str


def ingest(
    argument: str, source: Source, schema: pa.Schema, out: str, rejected: str, count_rows: Callable[[int], None]
) -> Ingested:
    """Convert CSV files to a Parquet file of text at `out`, and write their malformed lines to a CSV file `rejected`.

    A line that is not UTF-8, that has more or fewer fields than the header, a quote that is never closed, or more than
    `BLOCK_BYTES` bytes, becomes a row marked as malformed: it has the fields that can be told apart. `count_rows` is
    called with the number of rows of each batch. Raises `InvalidArgument` if a file cannot be read.
    """
    marked, inferred = schema.append(MARK), InferredTypes(len(schema))
    with open_parquet_output(out, marked, []) as write, _rejects(rejected) as reject:
        first = ""
        for place in source.files:
            # Line numbers begin anew in each file.
            malformed = MalformedLines(marked, source.shown(place), reject)
            for table in _tables(malformed.merge_into(_batches(argument, source, place, schema, malformed))):
                write(table)
                inferred.add(_well_formed(table))
                count_rows(table.num_rows)
            first = first or malformed.first
    return Ingested(list(map(str, inferred.types)), first)


def _well_formed(table: pa.Table) -> list[pa.Array]:
    """The columns of text of a table of one chunk, without the rows of malformed lines."""
    *columns, mark = (column.chunk(0) for column in table.columns)
    bad = to_numpy(mark)
    return [column.filter(pa.array(bad == 0)) for column in columns] if bad.any() else columns


# Called with the columns of `REJECTED_COLUMNS`.
Reject = Callable[[tuple[str, int, str, str]], object]


@contextmanager
def _rejects(path: str) -> Iterator[Reject]:
    with Path(path).open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(REJECTED_COLUMNS)
        yield writer.writerow


@dataclass
class Run:
    """Consecutive malformed lines: the row number of the first, their number, and the fields of the first of them."""

    first: int
    count: int
    fields: list[list[str]]


class MalformedLines:
    """The malformed lines of a file that are not yet merged with the good ones, as runs, since there may be many."""

    def __init__(self, schema: pa.Schema, file: str, reject: Reject) -> None:
        self.schema = schema
        self.source = SourceLines()
        self.first = ""
        self._file, self._reject = file, reject
        self._runs: deque[Run] = deque()
        self._kept = 0

    def add(self, line: Any) -> str:
        """Store a line that pyarrow cannot split, and skip it; pyarrow counts the header as line 1."""
        row = line.number - 2
        malformed = self.source.take_replaced(line.text)
        if malformed is None:
            count = "1 field" if line.actual_columns == 1 else f"{line.actual_columns} fields"
            problem = f"has {count}, not {line.expected_columns} as the header"
            malformed = MalformedLine(problem, line.text)
        self._report(row, malformed)
        last = self._runs[-1] if self._runs else None
        if last is None or last.first + last.count != row:
            last = Run(row, 0, [])
            self._runs.append(last)
        self._kept += len(malformed.text)
        if self._kept <= KEPT_CHARACTERS and len(last.fields) == last.count:
            last.fields.append(_fields(malformed.text)[: len(self.schema) - 1])
        last.count += 1
        return "skip"

    def _report(self, row: int, malformed: MalformedLine) -> None:
        number = self.source.number_of(row + 1)
        self.first = self.first or f"line {number} of {self._file} {malformed.problem}"
        self._reject((self._file, number, malformed.problem, malformed.text))

    def merge_into(self, batches: Iterable[pa.RecordBatch]) -> Iterator[pa.RecordBatch]:
        """The rows of `batches`, of bytes, as text with the mark, with a row for each malformed line.

        pyarrow parses lines before it returns their batch. A run is merged once the present batch has a good row after
        it: the run is then complete, and the result does not depend on how far ahead pyarrow has parsed.
        """
        row = 0
        for batch in batches:
            begin = 0
            while self._runs and self._runs[0].first - row < batch.num_rows - begin:
                run = self._runs.popleft()
                yield self._as_text(batch.slice(begin, run.first - row), row)
                yield from self._rows(run)
                begin, row = begin + run.first - row, run.first + run.count
            yield self._as_text(batch.slice(begin), row)
            row += batch.num_rows - begin
        while self._runs:
            yield from self._rows(self._runs.popleft())

    def _rows(self, run: Run) -> Iterator[pa.RecordBatch]:
        """The rows of a run, marked as malformed, in batches."""
        self._kept = 0
        for begin in range(0, run.count, BATCH_ROWS):
            count = min(BATCH_ROWS, run.count - begin)
            known = run.fields[begin : begin + count]
            rows = [[*fields, *[None] * (len(self.schema) - 1 - len(fields))] for fields in known]
            rows += [[None] * (len(self.schema) - 1)] * (count - len(known))
            columns = [pa.array(column, pa.string()) for column in zip(*rows, strict=True)]
            mark = from_numpy(np.ones(count, dtype=np.int8))
            yield pa.RecordBatch.from_arrays([*columns, mark], schema=self.schema)

    def _as_text(self, batch: pa.RecordBatch, row: int) -> pa.RecordBatch:
        """A batch of bytes that begins with a row, as text, with the mark; a value that is not UTF-8 is null."""
        bad = np.zeros(batch.num_rows, dtype=bool)
        columns = []
        for column in batch.columns:
            undecodable = _undecodable(column)
            bad |= undecodable
            columns.append(pc.if_else(pa.array(undecodable), None, column) if np.any(undecodable) else column)
        for i in np.flatnonzero(bad).tolist():
            text = b",".join(column[i].as_py() for column in batch.columns).decode("utf-8", "backslashreplace")
            self._report(row + i, MalformedLine("is not UTF-8", text))
        mark = from_numpy(bad.astype(np.int8))
        return pa.RecordBatch.from_arrays([*(c.cast(pa.string()) for c in columns), mark], schema=self.schema)


def _fields(line: str) -> list[str]:
    """The fields of a line, as far as they can be told apart."""
    try:
        return next(csv.reader([line]), [])
    except csv.Error:
        return line.split(",")


def _is_packed(place: str) -> bool:
    return place.lower().endswith(".gz")


@contextmanager
def _text_file(place: str) -> Iterator[IO[str]]:
    with open_place(place) as file, ExitStack() as stack:
        content = stack.enter_context(gzip.GzipFile(fileobj=file)) if _is_packed(place) else file
        yield stack.enter_context(io.TextIOWrapper(content, "utf-8-sig", "surrogateescape", ""))


@contextmanager
def _reader(place: str, schema: pa.Schema, malformed: MalformedLines) -> Iterator[Any]:
    with ExitStack() as stack:
        # pyarrow reads a local file without Python.
        file = stack.enter_context(open_place(place)) if is_url(place) else place
        stream = stack.enter_context(pa.input_stream(file, compression="gzip" if _is_packed(place) else None))
        repaired = RepairedLines(stream, len(schema), BLOCK_BYTES)
        malformed.source = repaired.source
        yield stack.enter_context(
            pyarrow.csv.open_csv(
                pa.PythonFile(repaired, "r"),
                read_options=pyarrow.csv.ReadOptions(use_threads=False, block_size=BLOCK_BYTES),
                parse_options=pyarrow.csv.ParseOptions(newlines_in_values=True, invalid_row_handler=malformed.add),
                # Bytes instead of text, so that a value that is not UTF-8 makes only its own line malformed.
                convert_options=pyarrow.csv.ConvertOptions(column_types=dict.fromkeys(schema.names, pa.binary())),
            )
        )


def _batches(
    argument: str, source: Source, place: str, schema: pa.Schema, malformed: MalformedLines
) -> Iterator[pa.RecordBatch]:
    try:
        with _reader(place, schema, malformed) as reader:
            yield from reader
    except (OSError, pa.ArrowInvalid) as error:
        raise unreadable(argument, source.shown(place), error) from error


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
