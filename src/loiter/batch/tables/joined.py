"""One file that consists of the parts of a job, copied byte for byte, one after another."""

from __future__ import annotations

import errno
import gzip
import os
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from typing import Any, BinaryIO

import pyarrow as pa
import pyarrow.parquet as pq

from loiter.batch.tables.files import Kind
from loiter.batch.tables.outputs import LEVEL, csv_header, csv_size
from loiter.batch.tables.parquet_footer import joined_footer
from loiter.batch.tables.storage import open_place, written_behind

# Called with the place of a part.
Append = Callable[[str], None]

MAGIC = b"PAR1"

# Bytes at the end of a Parquet file: the size of its footer, and the magic number.
_TAIL = 8

# Bytes copied at a time where the operating system cannot copy from file to file.
_COPY_BYTES = 1 << 23

# Errors of copy_file_range(2) where the two files do not allow it.
_NO_COPY = {errno.EXDEV, errno.ENOSYS, errno.EINVAL, errno.ENOTSUP, errno.EBADF, errno.EPERM}


@contextmanager
def open_joined(kind: Kind, path: str, schema: pa.Schema) -> Iterator[Append]:
    """A context whose value appends a part, in the encoding of its kind, to the file at `path`."""
    with ExitStack() as stack:
        file = stack.enter_context(open(path, "wb", buffering=0))  # noqa: PTH123
        append_bytes = stack.enter_context(_parquet(file)) if kind == ".parquet" else _csv(file, kind, schema)
        begin_to_write = stack.enter_context(written_behind(path))

        def append(place: str) -> None:
            append_bytes(place)
            begin_to_write()

        yield append


@contextmanager
def _parquet(file: BinaryIO) -> Iterator[Append]:
    footers: list[bytes] = []
    shifts: list[int] = []
    _write(file, MAGIC)

    def append(place: str) -> None:
        with open_place(place) as part:
            end, footer = _footer(part)
            shifts.append(file.tell() - len(MAGIC))
            footers.append(footer)
            copy(part, file, len(MAGIC), end - len(MAGIC))

    yield append
    footer = joined_footer(footers, shifts)
    _write(file, footer + len(footer).to_bytes(4, "little") + MAGIC)


def _footer(part: BinaryIO) -> tuple[int, bytes]:
    """The position and the bytes of the footer of a Parquet file."""
    size = part.seek(-_TAIL, os.SEEK_END) + _TAIL
    length = int.from_bytes(part.read(_TAIL)[:4], "little")
    begin = part.seek(size - _TAIL - length)
    return begin, part.read(length)


def _csv(file: BinaryIO, kind: Kind, schema: pa.Schema) -> Append:
    header = csv_header(schema)
    # A gzip file may consist of several, one after another. Without time, so that the same rows give the same bytes.
    _write(file, gzip.compress(header, LEVEL, mtime=0) if kind == ".csv.gz" else header)

    def append(place: str) -> None:
        with open_place(place) as part:
            copy(part, file, 0, csv_size(part))

    return append


def copy(source: Any, target: BinaryIO, begin: int, count: int) -> None:
    """Copy `count` bytes from position `begin` of a file to the end of another; raises `OSError`."""
    copied = _copy_range(source, target, begin, count)
    source.seek(begin + copied)
    while copied < count:
        content = source.read(min(_COPY_BYTES, count - copied))
        if not content:
            raise OSError("a part ends too early")
        _write(target, content)
        copied += len(content)


def _copy_range(source: Any, target: BinaryIO, begin: int, count: int) -> int:
    """The number of bytes that the operating system has copied itself, which may be 0."""
    copied = 0
    try:
        while copied < count:
            done = os.copy_file_range(source.fileno(), target.fileno(), count - copied, begin + copied)
            if not done:
                break
            copied += done
    # A file behind a URL has no number, and not all systems have the function.
    except AttributeError:
        pass
    except OSError as error:
        if error.errno is not None and error.errno not in _NO_COPY:
            raise
    return copied


def _write(file: BinaryIO, content: bytes) -> None:
    """Write all bytes to an unbuffered file."""
    left = memoryview(content)
    while left:
        left = left[file.write(left) :]


def check_joined(path: str, rows: int) -> None:
    """Raise `OSError` if pyarrow does not find `rows` rows in a joined Parquet file."""
    found = pq.read_metadata(path).num_rows
    if found != rows:
        raise OSError(f"the output has {found} rows instead of {rows}")
