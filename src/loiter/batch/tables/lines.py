"""The text of a CSV file without unclosed quotes, which would make one field of all the lines that follow."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterator
from itertools import chain
from typing import Any

import numpy as np

# Bytes of text processed at a time.
CHUNK_BYTES = 1 << 22

# The largest number of lines of a quoted field; a quote that is not closed within them counts as unclosed.
QUOTED_LINES = 100


class RepairedLines(io.RawIOBase):
    """The bytes of a stream as a readable stream, in which each line with an unclosed quote is made malformed."""

    def __init__(self, stream: Any, fields: int) -> None:
        self._chunks = repaired_lines(stream, fields)
        self._left = memoryview(b"")

    def readable(self) -> bool:
        """Whether the stream can be read: True."""
        return True

    def readinto(self, buffer: Any) -> int:
        """Fill `buffer` and return the number of bytes, which is less than its length only at the end.

        A block that consisted of blank lines alone would look like an empty file to pyarrow.
        """
        count = 0
        while count < len(buffer) and self._load():
            taken = min(len(buffer) - count, len(self._left))
            buffer[count : count + taken] = self._left[:taken]
            self._left = self._left[taken:]
            count += taken
        return count

    def _load(self) -> bool:
        """Load the next chunk if none is loaded; returns whether there are bytes left."""
        while not self._left:
            chunk = next(self._chunks, None)
            if chunk is None:
                return False
            self._left = memoryview(chunk)
        return True


def repaired_lines(stream: Any, fields: int) -> Iterator[bytes]:
    """The bytes of `stream` in whole lines; a line with an unclosed quote is replaced by one of `fields` + 1 fields.

    A last line without a line end gets one, since pyarrow treats a header without a line end as an empty file.
    """
    rest, end = b"", b""
    while chunk := stream.read(CHUNK_BYTES):
        rest += chunk
        end = end or _line_end(rest)
        if end:
            whole = rest.rfind(end) + 1
            repaired, open_quote = _repair(rest[:whole], end, fields, last=False)
            rest = open_quote + rest[whole:]
            yield repaired
    if rest:
        end = end or (b"\r" if rest.endswith(b"\r") else b"\n")
        repaired, _ = _repair(rest, end, fields, last=True)
        yield repaired + (b"" if rest.endswith(end) else end)


def _line_end(text: bytes) -> bytes:
    """The line end of a text, or b"" if no line has ended; a final carriage return may be half of a line end."""
    if b"\n" in text:
        return b"\n"
    return b"\r" if b"\r" in text[:-1] else b""


def _repair(text: bytes, end: bytes, fields: int, *, last: bool) -> tuple[bytes, bytes]:
    """The repaired lines, and the rest from the first line whose quote may be closed later; if `last`, no rest."""
    unbalanced = _unbalanced_lines(text, end)
    if not unbalanced:
        return text, b""
    lines = text.split(end)
    done = 0
    for i in unbalanced:
        if i < done:
            continue
        record, used = _record(lines[i : i + QUOTED_LINES])
        if record is None and not last and i + QUOTED_LINES > len(lines):
            return end.join([*lines[:i], b""]), end.join(lines[i:])
        if record is None or (used > 1 and record != fields):
            lines[i] = b"," * fields
            used = 1
        done = i + used
    return end.join(lines), b""


def _unbalanced_lines(text: bytes, end: bytes) -> list[int]:
    """The numbers of the lines with an odd number of quotes: only these can open a quote without closing it."""
    if b'"' not in text:
        return []
    characters = np.frombuffer(text, dtype=np.uint8)
    quotes, ends = np.flatnonzero(characters == ord('"')), np.flatnonzero(characters == ord(end))
    odd: list[int] = np.flatnonzero(np.bincount(np.searchsorted(ends, quotes)) % 2).tolist()
    return odd


def _record(lines: list[bytes]) -> tuple[int | None, int]:
    """Number of fields (None if it does not end) and number of lines of the record that begins with the first line."""
    # An additional line shows whether the last one leaves a quote open. latin-1 decodes any bytes.
    reader = csv.reader(chain((line.decode("latin-1") + "\n" for line in lines), ["\n"]))
    try:
        fields = len(next(reader))
    except csv.Error:
        return None, 1
    return (None if reader.line_num > len(lines) else fields), reader.line_num
