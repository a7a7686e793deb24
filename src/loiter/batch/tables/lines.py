"""The text of a CSV file without lines that pyarrow cannot skip: those with unclosed quotes, and those too long.

pyarrow's handler of invalid rows is not called for these: an unclosed quote swallows the following lines or the rest of
the file, and a line longer than a block ends the whole table with an error.
"""

from __future__ import annotations

import csv
import io
from array import array
from bisect import bisect_right
from collections.abc import Iterator
from itertools import chain
from typing import Any, NamedTuple

import numpy as np

# Bytes of text processed at a time.
CHUNK_BYTES = 1 << 22

# The largest number of lines of a quoted field; a quote that is not closed within them counts as unclosed.
QUOTED_LINES = 100


# The first byte of a line that stands in place of another one; in text it is a control character, which nobody writes.
REPLACED = b"\x1f"


# Characters that are kept of a malformed line.
SHOWN = 100_000


class MalformedLine(NamedTuple):
    """A line that is no row: what is wrong with it, and its text."""

    problem: str
    text: str


class SourceLines:
    """What pyarrow does not see of a file: where its records begin, and the lines that others replace."""

    def __init__(self) -> None:
        # The numbers of the lines, from 1, in which no record begins: they are blank, or within a quoted field.
        self._others = array("q")
        self._count = 0
        self._replaced: dict[bytes, MalformedLine] = {}

    def add(self, text: bytes, end: bytes, continuations: list[int]) -> None:
        """Count the lines of a text; `continuations` are those within quoted fields, from 0."""
        ends = np.flatnonzero(np.frombuffer(text, dtype=np.uint8) == ord(end))
        lengths = np.diff(ends, prepend=-1) - 1
        blank = lengths == 0
        if end == b"\n":
            blank |= (lengths == 1) & (np.frombuffer(text, dtype=np.uint8)[ends - 1] == ord("\r"))
        others = np.union1d(np.flatnonzero(blank), np.array(continuations, dtype=np.int64))
        self._others.extend((self._count + 1 + others).tolist())
        self._count += len(ends) + (not text.endswith(end))

    def replace(self, line: bytes, problem: str, fields: int) -> bytes:
        """The malformed line, of `fields` + 1 fields, that stands in place of a line."""
        name = REPLACED + b"%d" % len(self._replaced)
        text = line.decode("utf-8", "backslashreplace").rstrip("\r")
        self._replaced[name] = MalformedLine(problem, text if len(text) <= SHOWN else f"{text[:SHOWN]} ...")
        return name + b"," * fields

    def take_replaced(self, text: str) -> MalformedLine | None:
        """The line that a line of text stands for, which is then forgotten; None if it stands for itself."""
        name, _, _ = text.encode("utf-8", "replace").partition(b",")
        return self._replaced.pop(name, None)

    def number_of(self, record: int) -> int:
        """The number of the line, from 1, in which a record begins; record 0 is the header."""
        # Each line in which no record begins and that lies before it moves it on by one.
        number = record + 1
        while (moved := record + 1 + bisect_right(self._others, number)) != number:
            number = moved
        return number


class RepairedLines(io.RawIOBase):
    """The bytes of a stream as a readable stream, in which each line that pyarrow cannot skip is made malformed.

    `fields` is the number of fields of the header, `longest` that of the bytes of the longest line. `source` tells
    what the stream had instead.
    """

    def __init__(self, stream: Any, fields: int, longest: int) -> None:
        self.source = SourceLines()
        self._chunks = repaired_lines(stream, fields, longest, self.source)
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


def repaired_lines(stream: Any, fields: int, longest: int, source: SourceLines) -> Iterator[bytes]:
    """The bytes of `stream` in whole lines; a line with an unclosed quote, or too long, is replaced by a malformed one.

    A last line without a line end gets one, since pyarrow treats a header without a line end as an empty file.
    """
    repair = Repair(fields, longest, source)
    rest, end = b"", b""
    while chunk := stream.read(CHUNK_BYTES):
        rest += chunk
        end = end or _line_end(rest)
        whole = rest.rfind(end) + 1 if end else 0
        if whole:
            repaired, open_quote = repair.lines(rest[:whole], end, last=False)
            rest = open_quote + rest[whole:]
            yield repaired
        elif len(rest) > longest:
            # The rest of a line that is too long is not kept.
            rest = rest[: longest + 1]
    if rest:
        end = end or (b"\r" if rest.endswith(b"\r") else b"\n")
        repaired, _ = repair.lines(rest, end, last=True)
        yield repaired + (b"" if rest.endswith(end) else end)


def _line_end(text: bytes) -> bytes:
    """The line end of a text, or b"" if no line has ended; a final carriage return may be half of a line end."""
    if b"\n" in text:
        return b"\n"
    return b"\r" if b"\r" in text[:-1] else b""


class Repair(NamedTuple):
    """How lines are repaired: `repaired_lines` explains the values."""

    fields: int
    longest: int
    source: SourceLines

    def lines(self, text: bytes, end: bytes, *, last: bool) -> tuple[bytes, bytes]:
        """The repaired lines, and the rest from the first line whose quote may be closed later; if `last`, no rest."""
        suspects = _suspect_lines(text, end, self.longest)
        if not suspects:
            self.source.add(text, end, [])
            return text, b""
        original, repaired = text.split(end), text.split(end)
        done, continuations = 0, list[int]()
        for i in suspects:
            if i < done:
                continue
            fields, used = _record(original[i : i + QUOTED_LINES])
            size = sum(map(len, original[i : i + used])) + used
            if fields is None and not last and i + QUOTED_LINES > len(original) and size <= self.longest:
                self.source.add(end.join([*original[:i], b""]), end, continuations)
                return end.join([*repaired[:i], b""]), end.join(original[i:])
            problem = self._problem(fields, used, len(original[i]), size)
            if problem:
                repaired[i], used = self.source.replace(original[i], problem, self.fields), 1
            continuations += range(i + 1, i + used)
            done = i + used
        self.source.add(text, end, continuations)
        return end.join(repaired), b""

    def _problem(self, fields: int | None, used: int, first: int, size: int) -> str:
        """What is wrong with a record of so many fields, lines and bytes, `first` of these in its first line.

        The result is "" where pyarrow can judge it.
        """
        if first > self.longest:
            return f"is longer than {self.longest:,} bytes"
        is_open = fields is None or (used > 1 and (fields != self.fields or size > self.longest))
        return "has a quote that is never closed" if is_open else ""


def _suspect_lines(text: bytes, end: bytes, longest: int) -> list[int]:
    """The numbers of the lines that are too long, or have an odd number of quotes: only these can leave one open."""
    if b'"' not in text and len(text) <= longest:
        return []
    characters = np.frombuffer(text, dtype=np.uint8)
    quotes, ends = np.flatnonzero(characters == ord('"')), np.flatnonzero(characters == ord(end))
    odd = np.flatnonzero(np.bincount(np.searchsorted(ends, quotes)) % 2)
    long = np.flatnonzero(np.diff(ends, prepend=-1, append=len(text)) > longest)
    suspects: list[int] = np.union1d(odd, long).tolist()
    return suspects


def _record(lines: list[bytes]) -> tuple[int | None, int]:
    """Number of fields (None if it does not end) and number of lines of the record that begins with the first line."""
    # An additional line shows whether the last one leaves a quote open. latin-1 decodes any bytes.
    reader = csv.reader(chain((line.decode("latin-1") + "\n" for line in lines), ["\n"]))
    try:
        fields = len(next(reader))
    except csv.Error:
        return None, 1
    return (None if reader.line_num > len(lines) else fields), reader.line_num
