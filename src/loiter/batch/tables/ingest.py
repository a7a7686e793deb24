"""Conversion of CSV files to a Parquet file of text, which can be divided into parts; the rows keep their order.

pyarrow parses blocks of lines that are all well formed. It can neither keep a row at the place of a malformed line, nor
say the number of that line, and an unclosed quote swallows the lines that follow; so a block in which a line may be
malformed, or a field may have several lines, is parsed here by Python's csv module, record by record.
"""

from __future__ import annotations

import csv
import gzip
import io
import zlib
from collections.abc import Callable, Generator, Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
import pyarrow as pa
import pyarrow.csv

from loiter.batch.tables.files import BATCH_ROWS, unreadable
from loiter.batch.tables.outputs import open_parquet_output
from loiter.batch.tables.sources import Source
from loiter.batch.tables.storage import open_place
from loiter.batch.tables.types import InferredTypes
from loiter.batch.tables.views import from_numpy, to_numpy
from loiter.errors import InvalidArgument

if TYPE_CHECKING:
    from numpy.typing import NDArray

# The last column of the Parquet file: 1 if the line was malformed. No header of a CSV file has this name.
MARK = pa.field("\nmalformed\n", pa.int8())

# Bytes of text read at a time.
BLOCK_BYTES = 1 << 21

# Bytes of the longest line.
LONGEST = 1 << 22

# The largest number of lines of a record; a quote that is not closed within them counts as unclosed.
QUOTED_LINES = 100

# Characters that are kept of a malformed line.
SHOWN = 100_000

# The columns of the file of rejected lines.
REJECTED_COLUMNS = ("file", "line", "problem", "text")

_UNREADABLE = (OSError, EOFError, ValueError, csv.Error, zlib.error, pa.ArrowException)


def csv_schema(argument: str, source: Source) -> pa.Schema:
    """The columns of CSV files, all of them text; raises `InvalidArgument` if they differ or if there is no header."""
    first, *others = [_header(argument, source, place).names for place in source.files]
    for place, names in zip(source.files[1:], others, strict=True):
        if names != first:
            raise InvalidArgument(argument, f"is {source.text!r}: {place} has another header than the first file")
    return pa.schema([(name, pa.string()) for name in first])


class _Header(NamedTuple):
    """The names of the columns, and the number of lines up to the end of the header."""

    names: list[str]
    lines: int


class _Kept:
    """The lines of a file, whose text is kept as far as it has been read."""

    def __init__(self, file: Iterator[str]) -> None:
        self.text = ""
        self._file = file

    def __iter__(self) -> Iterator[str]:
        for line in self._file:
            self.text += line
            yield line


def _header(argument: str, source: Source, place: str) -> _Header:
    try:
        # Bytes that are not UTF-8 are allowed here: later they make only their own line malformed.
        with _open_csv(place) as file, io.TextIOWrapper(file, "utf-8-sig", "surrogateescape", "") as text:
            lines = _Kept(text)
            names = next((record for record in csv.reader(lines) if record), None)
    except _UNREADABLE as error:
        raise unreadable(argument, source.shown(place), error) from error
    problem = "it has no header" if names is None else _encoding_problem("".join(names))
    if names is None or problem:
        raise InvalidArgument(argument, f"is {source.shown(place)!r}: it cannot be read, {problem}")
    read = lines.text.rstrip("\r\n")
    return _Header(names, 1 + (read.count("\n") or read.count("\r")))


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


@contextmanager
def _open_csv(place: str) -> Iterator[Any]:
    """A CSV file opened for reading its bytes, uncompressed."""
    with open_place(place) as file, ExitStack() as stack:
        packed = place.lower().endswith(".gz")
        yield stack.enter_context(gzip.GzipFile(fileobj=file)) if packed else file


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
    `LONGEST` bytes, becomes a row marked as malformed: it has the fields that can be told apart. `count_rows` is
    called with the number of rows of each batch. Raises `InvalidArgument` if a file cannot be read.
    """
    inferred, first = InferredTypes(len(schema)), ""
    # A field may be as long as a line; csv allows less.
    csv.field_size_limit(max(csv.field_size_limit(), LONGEST))
    with open_parquet_output(out, schema.append(MARK)) as write, Path(rejected).open("w", encoding="utf-8") as file:
        reject = csv.writer(file, lineterminator="\n")
        reject.writerow(REJECTED_COLUMNS)
        for place in source.files:
            for batch, malformed in _batches(argument, source, place, schema):
                write(batch)
                inferred.add(_well_formed(batch))
                count_rows(batch.num_rows)
                reject.writerows((source.shown(place), row.number, row.problem, row.text) for row in malformed)
                if malformed and not first:
                    first = f"line {malformed[0].number} of {source.shown(place)} {malformed[0].problem}"
    return Ingested(list(map(str, inferred.types)), first)


def _well_formed(batch: pa.RecordBatch) -> list[pa.Array]:
    """The columns of text of a batch, without the rows of malformed lines."""
    *columns, mark = batch.columns
    bad = to_numpy(mark)
    return [column.filter(pa.array(bad == 0)) for column in columns] if bad.any() else columns


class _Row(NamedTuple):
    """A record: its fields, and if its line is malformed, the number, the problem and the text of the line."""

    fields: list[str | None]
    number: int = 0
    problem: str = ""
    text: str = ""


def _batches(
    argument: str, source: Source, place: str, schema: pa.Schema
) -> Iterator[tuple[pa.RecordBatch, list[_Row]]]:
    """The rows of a file with their mark, in batches, each with its malformed lines."""
    header = _header(argument, source, place)
    try:
        with _open_csv(place) as file:
            yield from _parse(file, header.lines, schema)
    except _UNREADABLE as error:
        raise unreadable(argument, source.shown(place), error) from error


def _parse(file: Any, header_lines: int, schema: pa.Schema) -> Iterator[tuple[pa.RecordBatch, list[_Row]]]:
    text, number, end, at_end = b"", 1, b"", False
    while not at_end:
        chunk = file.read(BLOCK_BYTES)
        at_end = not chunk
        text += chunk
        end = end or _line_end(text, at_end=at_end)
        if at_end and text and not text.endswith(end):
            text += end
        whole = text.rfind(end) + 1 if end else 0
        # The rest of a line that is too long is not kept.
        block, text = text[:whole], text[whole:][: LONGEST + 1]
        if number == 1:
            if not end or block.count(end) < header_lines:
                text = block + text
                continue
            number += header_lines
            *_, block = block.split(end, header_lines)
        batch = _parse_block(block, end, schema)
        if batch is None:
            lines = block.split(end)[:-1]
            parsed = yield from _parse_lines(lines, number, end, schema, at_end=at_end)
            text = end.join([*lines[parsed:], text])
            number += parsed
        else:
            yield _marked(batch, np.zeros(batch.num_rows, dtype=np.int8)), []
            number += block.count(end)


def _line_end(text: bytes, *, at_end: bool) -> bytes:
    """The line end of a text, or b"" if no line has ended; a final carriage return may be half of a line end."""
    if b"\n" in text:
        return b"\n"
    if b"\r" in (text if at_end else text[:-1]):
        return b"\r"
    return b"\n" if at_end else b""


def _parse_block(block: bytes, end: bytes, schema: pa.Schema) -> pa.RecordBatch | None:
    """The rows of whole lines; None if one may be malformed, or have an open quote, and if there are none."""
    if not block or _has_odd_line(block, end):
        return None
    try:
        table = pyarrow.csv.read_csv(
            pa.BufferReader(block),
            pyarrow.csv.ReadOptions(use_threads=False, block_size=len(block), column_names=schema.names),
            convert_options=pyarrow.csv.ConvertOptions(column_types=schema),
        )
    except pa.ArrowInvalid:
        return None
    return next(iter(table.combine_chunks().to_batches()), None)


def _has_odd_line(block: bytes, end: bytes) -> bool:
    """Whether a line is too long, or has an odd number of quotes: only these can leave one open."""
    if len(block) > LONGEST and max(map(len, block.split(end))) > LONGEST:
        return True
    if b'"' not in block:
        return False
    characters = np.frombuffer(block, dtype=np.uint8)
    quotes, ends = np.flatnonzero(characters == ord('"')), np.flatnonzero(characters == ord(end))
    return bool((np.bincount(np.searchsorted(ends, quotes)) % 2).any())


def _parse_lines(
    lines: list[bytes], number: int, end: bytes, schema: pa.Schema, *, at_end: bool
) -> Generator[tuple[pa.RecordBatch, list[_Row]], None, int]:
    """The rows of lines, the first of which has a number; returns how many lines were parsed.

    Unless the file ends, the last `QUOTED_LINES` wait for the next lines, as long as they are not longer than one may
    be: a quote may be closed there.
    """
    parsed, size, rows = 0, sum(map(len, lines)), list[_Row]()
    while parsed < len(lines) and (at_end or len(lines) - parsed >= QUOTED_LINES or size > LONGEST):
        row, used = _record(lines[parsed : parsed + QUOTED_LINES], number + parsed, end, len(schema))
        size -= sum(map(len, lines[parsed : parsed + used]))
        parsed += used
        if row is not None:
            rows.append(row)
        if len(rows) == BATCH_ROWS:
            yield _of_rows(rows, schema)
            rows = []
    if rows:
        yield _of_rows(rows, schema)
    return parsed


def _record(lines: list[bytes], number: int, end: bytes, width: int) -> tuple[_Row | None, int]:
    """The record that begins with the first of some lines, and the number of its lines; None for a blank line."""
    first, *_ = lines
    if first in (b"", b"\r"):
        return None, 1
    fields, used = _fields(lines, end)
    problem = _problem(fields, lines[:used], width)
    if fields is not None and not problem:
        return _Row([*fields]), used
    known = [field if _is_utf8(field) else None for field in _separate(_decode(first[:SHOWN]))[:width]]
    text = first.rstrip(b"\r").decode("utf-8", "backslashreplace")
    shown = text if len(text) <= SHOWN else f"{text[:SHOWN]} ..."
    return _Row([*known, *[None] * (width - len(known))], number, problem, shown), 1


def _fields(lines: list[bytes], end: bytes) -> tuple[list[str] | None, int]:
    """The fields of the record that begins with the first of some lines, and the number of its lines.

    The fields are None if the record does not end with one of the lines; bytes that are not UTF-8 become surrogates.
    """
    if b'"' not in lines[0]:
        return _decode(lines[0]).split(","), 1
    # An additional line shows whether the last one leaves a quote open.
    reader = csv.reader(line.decode("utf-8", "surrogateescape") + end.decode() for line in [*lines, b""])
    try:
        fields = next(reader)
    except csv.Error:
        return None, 1
    return (None if reader.line_num > len(lines) else fields), reader.line_num


def _separate(line: str) -> list[str]:
    """The fields of a malformed line, as far as they can be told apart."""
    try:
        return next(csv.reader([line]), [])
    except csv.Error:
        return line.split(",")


def _decode(line: bytes) -> str:
    return line.rstrip(b"\r").decode("utf-8", "surrogateescape")


def _problem(fields: list[str] | None, lines: list[bytes], width: int) -> str:
    """What is wrong with a record of some lines; "" if nothing is."""
    if len(lines[0]) > LONGEST:
        return f"is longer than {LONGEST:,} bytes"
    if fields is None or (len(lines) > 1 and (len(fields) != width or sum(map(len, lines)) + len(lines) > LONGEST)):
        return "has a quote that is never closed"
    if len(fields) != width:
        return f"has {len(fields)} {'field' if len(fields) == 1 else 'fields'}, not {width} as the header"
    return "" if all(map(_is_utf8, fields)) else "is not UTF-8"


def _is_utf8(text: str) -> bool:
    try:
        text.encode()
    except UnicodeEncodeError:
        return False
    return True


def _of_rows(rows: list[_Row], schema: pa.Schema) -> tuple[pa.RecordBatch, list[_Row]]:
    """Rows with their mark, and those of them that are malformed."""
    columns = [pa.array(column, pa.string()) for column in zip(*(row.fields for row in rows), strict=True)]
    batch = pa.RecordBatch.from_arrays(columns, schema=schema)
    return _marked(batch, np.array([row.problem != "" for row in rows], dtype=np.int8)), [r for r in rows if r.problem]


def _marked(batch: pa.RecordBatch, mark: NDArray[np.int8]) -> pa.RecordBatch:
    return batch.append_column(MARK, from_numpy(mark))
