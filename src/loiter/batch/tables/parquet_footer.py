"""The footer of a Parquet file that consists of the row groups of others, byte for byte, one after another.

pyarrow cannot copy encoded row groups from file to file, and encoding them again is what takes the time. The footer of
each file is a structure of the Thrift compact protocol (parquet.thrift of the Parquet format, 2.11), in which only the
offsets of the pages and three totals change. The structure is read and written here without regard to its meaning, and
a footer is refused unless writing it again gives the same bytes.
"""

from __future__ import annotations

import struct
from collections.abc import Sequence
from typing import Any, NamedTuple

# Types of the Thrift compact protocol.
_TRUE, _FALSE, _BYTE, _I16, _I32, _I64, _DOUBLE, _BINARY, _LIST, _STRUCT = 1, 2, 3, 4, 5, 6, 7, 8, 9, 12

# Numbers of fields in parquet.thrift.
_FILE_ROWS, _FILE_GROUPS, _FILE_KEY_VALUES = 3, 4, 5
_GROUP_COLUMNS, _GROUP_OFFSET, _GROUP_ORDINAL = 1, 5, 7
_CHUNK_META = 3
_CHUNK_OFFSETS = (2, 4, 6)
_META_OFFSETS = (9, 10, 11, 14)

# Row groups beyond the range of their 16-bit ordinal have none; it is optional.
_ORDINALS = 1 << 15


class Value(NamedTuple):
    """A value with its type; that of a structure is a dict of values by field number, that of a list a `Items`."""

    type: int
    value: Any


class Items(NamedTuple):
    """The elements of a list, all of one type."""

    type: int
    values: list[Any]


def joined_footer(footers: Sequence[bytes], shifts: Sequence[int]) -> bytes:
    """The footer of the files with these footers, joined; the pages of each file have moved by its shift, in bytes.

    Raises `ValueError` if a footer is not understood.
    """
    files = [_checked(footer) for footer in footers]
    groups: list[dict[int, Value]] = []
    for file, shift in zip(files, shifts, strict=True):
        for group in file[_FILE_GROUPS].value.values:
            _move(group, shift)
            _number(group, len(groups))
            groups.append(group)
    first = files[0]
    first[_FILE_ROWS] = Value(_I64, sum(file[_FILE_ROWS].value for file in files))
    first[_FILE_GROUPS] = Value(_LIST, Items(_STRUCT, groups))
    return encode(first)


def _checked(footer: bytes) -> dict[int, Value]:
    fields = decode(footer)
    if encode(fields) != footer:
        raise ValueError("the footer of a part was written in an unknown way")
    return fields


def _move(group: dict[int, Value], shift: int) -> None:
    """Add `shift` to the offsets of a row group."""
    _shift(group, (_GROUP_OFFSET,), shift)
    for chunk in group[_GROUP_COLUMNS].value.values:
        _shift(chunk, _CHUNK_OFFSETS, shift)
        _shift(chunk[_CHUNK_META].value, _META_OFFSETS, shift)


def _shift(fields: dict[int, Value], numbers: Sequence[int], shift: int) -> None:
    for number in numbers:
        # The offset 0 stands for none.
        if number in fields and fields[number].value:
            fields[number] = Value(_I64, fields[number].value + shift)


def _number(group: dict[int, Value], ordinal: int) -> None:
    if ordinal < _ORDINALS and _GROUP_ORDINAL in group:
        group[_GROUP_ORDINAL] = Value(_I16, ordinal)
    else:
        group.pop(_GROUP_ORDINAL, None)


def decode(content: bytes) -> dict[int, Value]:
    """The fields of the structure that bytes of the Thrift compact protocol encode; raises `ValueError`."""
    try:
        fields, end = _read_struct(content, 0)
    except (IndexError, struct.error) as error:
        raise ValueError("a structure of the Thrift protocol ends too early") from error
    if end != len(content):
        raise ValueError("a structure of the Thrift protocol ends before its bytes")
    return fields


def encode(fields: dict[int, Value]) -> bytes:
    """The bytes of a structure in the Thrift compact protocol."""
    out = bytearray()
    _write_struct(out, fields)
    return bytes(out)


def _read_struct(content: bytes, at: int) -> tuple[dict[int, Value], int]:
    fields: dict[int, Value] = {}
    number = 0
    while header := content[at]:
        delta, type_ = header >> 4, header & 15
        number, at = (number + delta, at + 1) if delta else _read_signed(content, at + 1)
        value, at = (None, at) if type_ in (_TRUE, _FALSE) else _read(content, at, type_)
        fields[number] = Value(type_, value)
    return fields, at + 1


def _read(content: bytes, at: int, type_: int) -> tuple[Any, int]:
    match type_:
        case 4 | 5 | 6:
            return _read_signed(content, at)
        case 8:
            size, at = _read_unsigned(content, at)
            return content[at : at + size], at + size
        case 9:
            return _read_list(content, at)
        case 12:
            return _read_struct(content, at)
        case 1 | 2 | 3:
            return content[at], at + 1
        case 7:
            return struct.unpack_from("<d", content, at), at + 8
    raise ValueError(f"type {type_} of the Thrift protocol does not occur in Parquet")


def _read_list(content: bytes, at: int) -> tuple[Items, int]:
    size, type_ = content[at] >> 4, content[at] & 15
    size, at = _read_unsigned(content, at + 1) if size == 15 else (size, at + 1)
    values = []
    for _ in range(size):
        value, at = _read(content, at, type_)
        values.append(value)
    return Items(type_, values), at


def _read_unsigned(content: bytes, at: int) -> tuple[int, int]:
    """A number of seven bits per byte, the lowest first."""
    value = bits = 0
    while (byte := content[at]) & 128:
        value |= (byte & 127) << bits
        bits, at = bits + 7, at + 1
    return value | byte << bits, at + 1


def _read_signed(content: bytes, at: int) -> tuple[int, int]:
    value, at = _read_unsigned(content, at)
    return value >> 1 ^ -(value & 1), at


def _write_struct(out: bytearray, fields: dict[int, Value]) -> None:
    last = 0
    for number, (type_, value) in fields.items():
        if 0 < number - last < 16:
            out.append(number - last << 4 | type_)
        else:
            out.append(type_)
            _write_signed(out, number)
        last = number
        if type_ not in (_TRUE, _FALSE):
            _write(out, type_, value)
    out.append(0)


def _write(out: bytearray, type_: int, value: Any) -> None:
    match type_:
        case 4 | 5 | 6:
            _write_signed(out, value)
        case 8:
            _write_unsigned(out, len(value))
            out += value
        case 9:
            _write_list(out, value)
        case 12:
            _write_struct(out, value)
        case 7:
            out += struct.pack("<d", *value)
        case _:
            out.append(value)


def _write_list(out: bytearray, items: Items) -> None:
    size = len(items.values)
    out.append(min(size, 15) << 4 | items.type)
    if size >= 15:
        _write_unsigned(out, size)
    for value in items.values:
        _write(out, items.type, value)


def _write_unsigned(out: bytearray, value: int) -> None:
    while value > 127:
        out.append(value & 127 | 128)
        value >>= 7
    out.append(value)


def _write_signed(out: bytearray, value: int) -> None:
    _write_unsigned(out, value << 1 if value >= 0 else (-value << 1) - 1)
