"""The text of a CSV file with stray quotes defused: one that is never closed would swallow the lines that follow."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterator
from itertools import chain
from typing import Any

import numpy as np

# Bytes of text looked at a time.
CHUNK_BYTES = 1 << 22

# Lines that a quoted field may run over; a quote that is not closed within them is a stray one.
QUOTED_LINES = 100


class Mended(io.RawIOBase):
    """A stream of bytes for a reader: `stream` with each line that opens a quote in vain made a malformed one."""

    def __init__(self, stream: Any, fields: int) -> None:
        self._chunks = mended(stream, fields)
        self._left = memoryview(b"")

    def readable(self) -> bool:
        """Whether it can be read."""
        return True

    def readinto(self, buffer: Any) -> int:
        """Fill `buffer`, a part of it only at the end: pyarrow takes a block of blank lines alone for an empty file."""
        count = 0
        while count < len(buffer) and self._more():
            taken = min(len(buffer) - count, len(self._left))
            buffer[count : count + taken] = self._left[:taken]
            self._left = self._left[taken:]
            count += taken
        return count

    def _more(self) -> bool:
        """Whether there are bytes left, which then are at hand."""
        while not self._left:
            chunk = next(self._chunks, None)
            if chunk is None:
                return False
            self._left = memoryview(chunk)
        return True


def mended(stream: Any, fields: int) -> Iterator[bytes]:
    """The bytes of `stream`, whole lines at a time; a line with a stray quote becomes one of `fields` + 1 fields.

    A last line without an end gets one: pyarrow takes a header that no line end follows for an empty file.
    """
    rest, end = b"", b""
    while chunk := stream.read(CHUNK_BYTES):
        rest += chunk
        end = end or _line_end(rest)
        if end:
            whole = rest.rfind(end) + 1
            kept, waiting = _mended(rest[:whole], end, fields, last=False)
            rest = waiting + rest[whole:]
            yield kept
    if rest:
        end = end or (b"\r" if rest.endswith(b"\r") else b"\n")
        yield _mended(rest, end, fields, last=True)[0] + (b"" if rest.endswith(end) else end)


def _line_end(text: bytes) -> bytes:
    """What lines end with, or b"" where none has ended yet. A carriage return at the end of the text may be a half."""
    if b"\n" in text:
        return b"\n"
    return b"\r" if b"\r" in text[:-1] else b""


def _mended(text: bytes, end: bytes, fields: int, *, last: bool) -> tuple[bytes, bytes]:
    """Whole lines mended, and those that must wait for more, as a quote is still open; none where they are the last."""
    odd = _odd(text, end)
    if not odd:
        return text, b""
    lines = text.split(end)
    done = 0
    for i in odd:
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


def _odd(text: bytes, end: bytes) -> list[int]:
    """The numbers of the lines with an odd number of quotes: others open none that they do not close."""
    if b'"' not in text:
        return []
    characters = np.frombuffer(text, dtype=np.uint8)
    quotes, ends = np.flatnonzero(characters == ord('"')), np.flatnonzero(characters == ord(end))
    odd: list[int] = np.flatnonzero(np.bincount(np.searchsorted(ends, quotes)) % 2).tolist()
    return odd


def _record(lines: list[bytes]) -> tuple[int | None, int]:
    """The number of fields of the record that begins with the first line, None where it does not end; its lines."""
    # One more line shows whether the last one left a quote open. As single bytes, whatever the text's encoding.
    reader = csv.reader(chain((line.decode("latin-1") + "\n" for line in lines), ["\n"]))
    try:
        fields = len(next(reader))
    except csv.Error:
        return None, 1
    return (None if reader.line_num > len(lines) else fields), reader.line_num
