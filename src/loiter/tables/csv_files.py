"""CSV files, which DuckDB reads and writes: they are converted to Parquet, and their malformed lines are listed.

DuckDB lists the lines that are no records, which pyarrow and Polars do not do for all kinds of them.
"""

from __future__ import annotations

import csv
import gzip
import io
import os
import re
from collections import deque
from collections.abc import Iterable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from shutil import copyfileobj
from tempfile import TemporaryDirectory
from typing import Any, NamedTuple

import duckdb
import pyarrow as pa

from loiter.errors import InvalidArgument
from loiter.tables.columns import MADE, values_type
from loiter.tables.files import FILE_ERRORS, Place, Source, local_copy, unreadable

# What separates the fields; the header says which.
SEPARATORS = ",;\t|"

# The characters that are kept of a malformed line.
SHOWN = 100_000

OPEN_QUOTE = "UNQUOTED VALUE"
PROBLEMS = {
    "MISSING COLUMNS": "has fewer fields than the header",
    "TOO MANY COLUMNS": "has more fields than the header",
    OPEN_QUOTE: "has a quote that is not closed, or text after it",
    "INVALID ENCODING": "is not UTF-8",
    "LINE SIZE OVER MAXIMUM": "is too long",
}

# A quote that is never closed swallows the lines after it. The file is read again without its line, this many times.
ATTEMPTS = 20

# The memory of DuckDB, and its most threads: each has blocks of 32 MB, so that more would need more memory.
MEMORY, MOST_THREADS = "512MB", 4

# The level of gzip: a fifth of the time of the usual 6, for a fourteenth more bytes.
LEVEL = 1

NUMBERS = ("TINYINT", "SMALLINT", "INTEGER", "BIGINT", "HUGEINT", "FLOAT", "DOUBLE")

_ERRORS = (*FILE_ERRORS, EOFError, csv.Error)


class Header(NamedTuple):
    """The names of the columns of a CSV file, what separates them, and the number of blank lines before them."""

    names: list[str]
    separator: str
    skip: int = 0


class Rejected(NamedTuple):
    """A malformed line: its file, its number there, from 1, what is wrong with it, and its text."""

    file: str
    line: int
    problem: str
    text: str


class _Found(NamedTuple):
    """A malformed line where DuckDB found it, counted in bytes from 0."""

    position: int
    error: str
    text: str

    @property
    def swallows(self) -> bool:
        """Whether it has a quote that goes on in the next line."""
        return self.error == OPEN_QUOTE and any(end in self.text for end in "\r\n")


def read_header(argument: str, source: Source) -> Header:
    """The columns of CSV files; raises `InvalidArgument` if they differ or if there is no header."""
    first, *others = [_header(argument, place) for place in source.files]
    for place, other in zip(source.files[1:], others, strict=True):
        if other.names != first.names:
            raise InvalidArgument(argument, f"is {source.text!r}: {place.text} has another header than the first file")
    return first


def _header(argument: str, place: Place) -> Header:
    try:
        # Bytes that are not UTF-8 are allowed here, since they are reported below.
        with _open(place) as file, io.TextIOWrapper(file, "utf-8-sig", "surrogateescape", "") as text:
            skip, line = next((found for found in enumerate(text) if found[1].strip()), (0, ""))
    except _ERRORS as error:
        raise unreadable(argument, place, error) from error
    separator = max(SEPARATORS, key=line.count)
    problem = _encoding_problem(line) if line else "it has no header"
    if problem:
        raise InvalidArgument(argument, f"is {place.text!r}: it cannot be read, {problem}")
    return Header(next(csv.reader([line.rstrip("\r\n")], delimiter=separator)), separator, skip)


def _encoding_problem(header: str) -> str:
    """What is wrong with the encoding of a header, read with bytes that are not UTF-8 as surrogates; "" if nothing."""
    if header.startswith(("\udcff\udcfe", "\udcfe\udcff")) or "\0" in header:
        return "it is UTF-16: write it as UTF-8, for example with iconv -f UTF-16 -t UTF-8"
    try:
        header.encode()
    except UnicodeEncodeError as error:
        cause = f"its header is not UTF-8: it has the byte 0x{ord(header[error.start]) & 0xFF:02x}"
        return f"{cause}; if it is Windows-1252, iconv -f WINDOWS-1252 -t UTF-8 converts it"
    return ""


@contextmanager
def _open(place: Place) -> Iterator[Any]:
    """A CSV file opened for reading its bytes, uncompressed."""
    with place.open() as file:
        yield gzip.GzipFile(fileobj=file) if place.name.lower().endswith(".gz") else file


@contextmanager
def connection(workers: int) -> Iterator[Any]:
    """A DuckDB of this process, in bounded memory, which keeps the order of rows; its errors become `OSError`."""
    threads = min(workers, MOST_THREADS)
    with TemporaryDirectory() as folder:
        config: dict[str, str | bool | int | float | list[str]] = {
            "memory_limit": MEMORY,
            "threads": threads,
            "temp_directory": folder,
            "autoinstall_known_extensions": False,
        }
        with duckdb.connect(config=config) as database:
            database.execute("SET enable_progress_bar = false")
            try:
                yield database
            except duckdb.Error as error:
                raise _os_error(str(error)) from error


def _os_error(message: str) -> OSError:
    """The error for a message of DuckDB, which may begin with its kind, and may name an error of the system."""
    number = re.search(r"errno\W+(\d+)", message)
    if number is not None:
        return OSError(int(number[1]), os.strerror(int(number[1])))
    first, _, _ = message.partition("\n")
    if "state machine" in first:
        return OSError("its lines have different ends")
    return OSError(re.sub(r"^[\w ]+ Error: ", "", first))


def column_types(source: Source, workers: int) -> dict[str, str]:
    """The types of the columns as DuckDB infers them from all lines; text where files differ or have stray quotes."""
    types: dict[str, str] = {}
    for place in source.files:
        header = _header("source", place)
        with local_copy(place) as path, connection(workers) as database:
            found = dict.fromkeys(header.names, "VARCHAR")
            # Where the quotes of a file do not match, DuckDB infers nothing.
            with suppress(duckdb.InvalidInputException):
                rows = database.execute(f"DESCRIBE SELECT * FROM {_table(path, header, None)}").fetchall()
                found = {name: row[1] for name, row in zip(header.names, rows, strict=True)}
        types = {name: type_ if types.get(name, type_) == type_ else "VARCHAR" for name, type_ in found.items()}
    return types


def convert(
    argument: str,
    place: Place,
    types: dict[str, str],
    quantities: Iterable[str],
    out: str,
    workers: int,
) -> list[Rejected]:
    """Convert a CSV file to a Parquet file at `out`; returns its malformed lines, which are left out.

    `quantities` are the columns that must hold numbers; for each that is text, a column of its numbers is added, null
    where the text is no number. Raises `InvalidArgument` if the file cannot be read.
    """
    rejected, header = list[Rejected](), _header(argument, place)
    query = f"COPY (SELECT {_columns(header, types, quantities)} FROM {{}}) TO {_quoted(out)} (FORMAT parquet)"
    try:
        with local_copy(place) as path, TemporaryDirectory() as folder:
            for attempt in range(ATTEMPTS):
                with connection(workers) as database:
                    database.execute(query.format(_table(path, header, types)))
                    found = _found(database)
                swallowing = [each for each in found if each.swallows]
                rejected += _numbered(place.text, path, swallowing or found)
                if not swallowing:
                    return sorted(rejected)
                copy = f"{folder}/{attempt}.csv"
                _copy_without(path, copy, {each.position for each in swallowing})
                path = copy
    except _ERRORS as error:
        # An error of the system stops the job; the same command goes on.
        if getattr(error, "errno", None):
            raise
        raise unreadable(argument, place, error) from error
    problem = f"the quote in line {rejected[-1].line} is not closed, and neither are others"
    raise InvalidArgument(argument, f"is {place.text!r}: it cannot be read, {problem}")


def _found(database: Any) -> list[_Found]:
    """The malformed lines of the last file that was read, in order."""
    rows = database.execute(f"""
        SELECT line_byte_position - 1, left(any_value(csv_line), {SHOWN + 100}),
            CASE WHEN bool_or(error_type = '{OPEN_QUOTE}') THEN '{OPEN_QUOTE}'
            ELSE coalesce(arg_min(error_type::VARCHAR, column_idx), any_value(error_type::VARCHAR)) END
        FROM reject_errors GROUP BY line_byte_position ORDER BY line_byte_position
    """)
    found = []
    for position, text, error in rows.fetchall():
        # It may begin with the blank lines before it.
        begin = text.lstrip("\r\n")
        found.append(_Found(position + len(text) - len(begin), error, begin.rstrip("\r\n")))
    return found


def _lines(path: str) -> Iterator[tuple[int, str]]:
    """The lines of a file, with bytes as characters, and the positions where they begin."""
    position = 0
    open_text = gzip.open if path.endswith(".gz") else open
    with open_text(path, "rt", encoding="latin-1", newline="") as file:
        for line in file:
            yield position, line
            position += len(line)


def _numbered(name: str, path: str, found: list[_Found]) -> Iterator[Rejected]:
    """Malformed lines with their numbers in the file, which messages call `name`."""
    waiting = deque(found)
    for number, (position, line) in enumerate(_lines(path) if found else [], 1):
        while waiting and waiting[0].position < position + len(line):
            each = waiting.popleft()
            text = each.text.splitlines()[0] if each.swallows else each.text
            shown = text if len(text) <= SHOWN else f"{text[:SHOWN]} ..."
            yield Rejected(name, number, PROBLEMS.get(each.error, each.error.lower()), shown)


def _copy_without(path: str, copy: str, positions: set[int]) -> None:
    """Copy a file with empty lines in place of those that begin at some positions."""
    with Path(copy).open("w", encoding="latin-1", newline="") as file:
        for position, line in _lines(path):
            file.write(line[len(line.rstrip("\r\n")) :] if position in positions else line)


def _columns(header: Header, types: dict[str, str], quantities: Iterable[str]) -> str:
    made = []
    for name in quantities:
        if types[name] not in NUMBERS:
            text = f"trim({_name(name)}::VARCHAR)"
            # Where semicolons separate fields, a comma may be that of a decimal number.
            text = f"replace({text}, ',', '.')" if header.separator == ";" else text
            made.append(f"try_cast({text} AS DOUBLE) AS {_name(MADE + name)}")
    return ", ".join(["*", *made])


def _table(path: str, header: Header, types: dict[str, str] | None) -> str:
    """The call that reads a CSV file; without types they are inferred from all lines."""
    names = ", ".join(map(_quoted, header.names))
    columns = f"names=[{names}], sample_size=-1"
    if types is not None:
        columns = (
            f"auto_detect=false, columns={{{', '.join(f'{_quoted(n)}: {_quoted(types[n])}' for n in header.names)}}}"
        )
    form = f"delim={_quoted(header.separator)}, quote='\"', escape='\"', header=true, skip={header.skip}"
    return f"read_csv({_quoted(path)}, {form}, store_rejects=true, rejects_limit=0, {columns})"


def _quoted(text: str) -> str:
    return "'" + text.replace("'", "''") + "'"


def _name(text: str) -> str:
    return '"' + text.replace('"', '""') + '"'


def rejected_table(lines: list[Rejected]) -> bytes:
    """The content of a CSV file of malformed lines: file, line, problem and text."""
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerows([Rejected._fields, *lines])
    return text.getvalue().encode()


def write_csv(path: str, schema: pa.Schema, batches: Iterable[pa.RecordBatch], *, packed: bool) -> None:
    """Write rows to a CSV file, compressed if `packed`: empty fields for null and nan, quotes where they are needed."""
    plain = pa.schema([(field.name, values_type(field.type)) for field in schema])
    rows = pa.RecordBatchReader.from_batches(plain, (batch.cast(plain) for batch in batches))
    columns = [
        f"nullif({_name(field.name)}, 'nan') AS {_name(field.name)}"
        if pa.types.is_floating(field.type)
        else _name(field.name)
        for field in plain
    ]
    # DuckDB's own compression takes four times as long.
    plain_path = f"{path}.csv" if packed else path
    with connection(1) as database:
        database.register("rows", rows)
        database.execute(f"COPY (SELECT {', '.join(columns)} FROM rows) TO {_quoted(plain_path)} (FORMAT csv, HEADER)")
    if packed:
        # Without name and time, so that the same rows give the same bytes.
        with (
            Path(plain_path).open("rb") as file,
            Path(path).open("wb") as out,
            gzip.GzipFile("", "wb", LEVEL, out, 0) as pack,
        ):
            copyfileobj(file, pack)
        Path(plain_path).unlink()
