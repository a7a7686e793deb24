"""Fences in local metres: a CSV table of corners and circles, for scenes without latitudes and longitudes."""

from __future__ import annotations

import csv
from collections.abc import Sequence
from itertools import groupby
from pathlib import Path
from typing import TYPE_CHECKING

from loiter.errors import file_path
from loiter.files.reading import Source, shown
from loiter.lazy import LazyModule

if TYPE_CHECKING:
    from loiter import fences
    from loiter.fences import model
else:
    fences, model = LazyModule("loiter.fences"), LazyModule("loiter.fences.model")

COLUMNS = ("zone", "rule", "east_m", "north_m", "radius_m")

# What a rule says: whether the zone is one to stay inside.
RULES = {"in": True, "out": False}


def read_fence_table(path: str | Path, argument: str = "fence") -> fences.Fence:
    """The fence in a CSV table with the columns zone, rule, east_m, north_m and radius_m.

    A row with a radius is a circle. Rows without one that follow each other with one name are the corners of a polygon.
    The rule is "in" for zones to stay inside, "out" for others. Raises `InvalidArgument`, for the argument named, which
    names the file and the line in it, for another table and for a file that cannot be read, and like `Fence`.
    """
    source = Source(argument, Path(file_path("path", path)))
    header, *lines = [*csv.reader(source.text().splitlines())] or [[]]
    if tuple(word.strip() for word in header) != COLUMNS:
        raise source.fault(f"its first line is {shown(','.join(header))}: it must be {','.join(COLUMNS)}")
    rows = [(f"line {number}", [word.strip() for word in line]) for number, line in enumerate(lines, start=2) if line]
    for where, row in rows:
        if len(row) != len(COLUMNS):
            raise source.fault(
                f"{where} has {len(row)} values: it must have {len(COLUMNS)}, the last of them may be empty"
            )
        if row[1] not in RULES:
            raise source.fault(f"{where}: the rule is {shown(row[1])}: it must be in or out")
    # A circle is a zone of its own; corners are one as long as name and rule stay the same.
    groups = [[*group] for _, group in groupby(rows, key=lambda each: (*each[1][:2], each[0] if each[1][4] else ""))]
    if not groups:
        raise source.fault("it has no fence")
    return fences.Fence(tuple(_zone(source, group) for group in groups))


def _zone(source: Source, rows: Sequence[tuple[str, list[str]]]) -> model.Zone:
    """The zone of a row with a radius, or of the rows of its corners."""
    (where, (name, rule, _, _, radius)), *_ = rows
    places = [
        tuple(source.number(f"{at}: {column}", text) for column, text in zip(COLUMNS[2:4], row[2:4], strict=True))
        for at, row in rows
    ]
    if radius:
        ((east_m, north_m),) = places
        return fences.CircleZone(name, east_m, north_m, source.number(f"{where}: radius_m", radius), RULES[rule])
    return fences.PolygonZone(name, tuple((east_m, north_m) for east_m, north_m in places), RULES[rule])
