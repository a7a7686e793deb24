"""Rows of tables that are planned one at a time: legs, and checks against a fence.

What needs more than the entries of `arrays.entries` is planned as single plans are, for the rows that have an entry.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from math import nan
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from loiter.arrays.entries import Entries
from loiter.errors import LoiterError, OutOfRange
from loiter.files.columns import (
    AIRSPEED,
    ALTITUDE,
    EXIT,
    EXIT_ALTITUDE,
    HEADING,
    HOLD,
    LOCAL,
    ORBIT,
    RATES,
    TURNS,
    VELOCITY,
    WIND,
)
from loiter.geo import LocalFrame
from loiter.kernel.statuses import Status
from loiter.kernel.words import Side, encode
from loiter.planning.leg import Leg, LegPlan, plan_leg
from loiter.planning.model import CONTROLS, SIDES, Aircraft, Orbit, Pose, Wind
from loiter.planning.model import TURNS as DIRECTIONS
from loiter.planning.solve import plan
from loiter.tables.columns import STATUSES, TOLERANCE

if TYPE_CHECKING:
    from loiter.fences import Fence
    from loiter.planning.maneuver import Maneuver
    from loiter.tables.columns import Columns

BAD_LEG, BAD_FENCE = (STATUSES.index(name) for name in ("bad_leg", "bad_fence"))


class Row(NamedTuple):
    """A row as the arguments of a single plan."""

    number: int
    pose: Pose
    orbit: Orbit
    aircraft: Aircraft
    wind: Wind
    needs: dict[str, float]


def planned_rows(
    found: Entries, numbers: dict[str, Any], sides: Any, origin: tuple[Any, Any] | None, columns: Columns
) -> tuple[Entries, dict[str, Any]]:
    """The entries of rows with those of their legs in their place, and the other added columns of legs and fences.

    `numbers` are those of the plane, `sides` the sides asked for, and `origin` has the places of the plane's origins.
    """
    size = found.duration_s.size
    entries = Entries(*(np.array(np.broadcast_to(column, size)) for column in found))
    added: dict[str, Any] = {name: np.full(size, nan) for name in columns.more if name != "zone"}
    zones = [""] * size
    fences = Fences(columns, origin)
    for row in _rows(entries, numbers, sides, columns):
        try:
            flown = _leg(row, entries, added) if columns.has_legs else _entry(row, columns)
        except OutOfRange:
            _refuse(row.number, entries, added, Status.OUT_OF_RANGE)
            continue
        except LoiterError:
            _refuse(row.number, entries, added, BAD_LEG)
            continue
        if columns.fence is not None:
            try:
                zones[row.number] = _checked(row, flown, fences.at(row.number), columns.margin_m, added)
            except LoiterError:
                _refuse(row.number, entries, added, BAD_FENCE)
    return entries, added | {"zone": zones}


def word_code(word: str) -> int:
    """The code of a word in letters; 0 for none."""
    return encode(*(CONTROLS[letter] for letter in word)) if word else 0


def _refuse(number: int, entries: Entries, added: dict[str, Any], status: int) -> None:
    """Give a row a status and no values."""
    for column in entries:
        column[number] = nan if column.dtype == np.float64 else 0
    for column in added.values():
        column[number] = nan
    entries.status[number] = status


class Fences:
    """The fence of each row in its plane."""

    def __init__(self, columns: Columns, origin: tuple[Any, Any] | None) -> None:
        self._fence, self._origin = columns.fence, origin
        self._place: tuple[float, float] | None = None
        self._local: Fence | None = None

    def at(self, number: int) -> Fence:
        """The fence in the plane of a row; raises `OutOfRange` where it is too far away."""
        from loiter.fences import Fence

        if isinstance(self._fence, Fence):
            return self._fence
        assert self._fence is not None
        assert self._origin is not None
        latitude, longitude = (float(v[number] if np.ndim(v) else v) for v in self._origin)
        if self._local is None or self._place != (latitude, longitude):
            self._place, self._local = (latitude, longitude), self._fence.local(LocalFrame(latitude, longitude))
        return self._local


def _rows(entries: Entries, numbers: dict[str, Any], sides: Any, columns: Columns) -> Iterator[Row]:
    """The rows that have an entry."""
    size = entries.duration_s.size
    needed = (*LOCAL, HEADING, *ORBIT, AIRSPEED, columns.limit, *WIND, *VELOCITY, *columns.leg_names)
    values = {name: np.broadcast_to(numbers[name], size) for name in needed}
    turns = np.broadcast_to(sides, size)
    for i in np.flatnonzero(entries.status == Status.OK).tolist():
        v = {name: float(column[i]) for name, column in values.items()}
        needs = {name: v[name] for name in columns.leg_names}
        (east_m, north_m), (x, y, radius_m), velocity = (
            [v[name] for name in names] for names in (LOCAL, ORBIT, VELOCITY)
        )
        pose = Pose(east_m, north_m, v[HEADING])
        orbit = Orbit(x, y, radius_m, DIRECTIONS[Side(turns[i])], *velocity)
        limits = {columns.limit: v[columns.limit]}
        speed_m_s, from_deg = (v[name] for name in WIND)
        yield Row(i, pose, orbit, Aircraft(v[AIRSPEED], **limits), Wind(speed_m_s, from_deg), needs)


def _entry(row: Row, columns: Columns) -> Maneuver:
    return plan(row.pose, row.orbit, row.aircraft, row.wind, tolerance_m=columns.shared[TOLERANCE])


def _leg(row: Row, entries: Entries, added: dict[str, Any]) -> LegPlan:
    """The leg of a row, noted in its columns."""
    needs = row.needs
    aircraft = replace(row.aircraft, **{name: needs[name] for name in RATES if name in needs})
    pose = replace(row.pose, altitude_m=needs.get(ALTITUDE))
    exit_to = needs[EXIT[0]], needs[EXIT[1]]
    leg = Leg(pose, row.orbit, exit_to, needs.get(HOLD, 0.0), needs.get(TURNS, 0.0), needs.get(EXIT_ALTITUDE))
    planned, i = plan_leg(leg, aircraft, row.wind), row.number
    entry = planned.entry
    entries.duration_s[i], entries.side[i] = entry.duration_s, int(SIDES[entry.turn])
    entries.word[i] = word_code(entry.word)
    entries.join_east_m[i], entries.join_north_m[i] = entry.join.east_m, entry.join.north_m
    entries.join_heading_deg[i] = entry.join.heading_deg
    durations = [segment.duration_s for segment in entry.segments] + [0.0] * 3
    entries.duration_1_s[i], entries.duration_2_s[i], entries.duration_3_s[i] = durations[:3]
    added["held_s"][i], added["held_deg"][i] = planned.held_s, planned.held_deg
    added["exit_s"][i], added["arrival_s"][i] = planned.exit_s, planned.duration_s
    return planned


def _checked(row: Row, flown: Maneuver | LegPlan, fence: Fence, margin_m: float | None, added: dict[str, Any]) -> str:
    """The zone that a row breaches first, "" for none; its columns of the fence are noted."""
    check, i = fence.check(flown, margin_m), row.number
    added["clearance_m"][i] = check.clearance_m
    first = check.breaches[0] if check.breaches else None
    if first is not None:
        added["zone_s"][i] = first.time_s
    if "clear_duration_s" in added:
        added["clear_duration_s"][i] = flown.duration_s if first is None else _clear_s(row, fence, margin_m)
    return "" if first is None else first.zone.name


def _clear_s(row: Row, fence: Fence, margin_m: float | None) -> float:
    """The time of the fastest clear entry found; nan for none."""
    from loiter.fences.clear_entry import fastest_clear

    found = fastest_clear(fence, row.pose, row.orbit, row.aircraft, row.wind, margin_m).maneuver
    return nan if found is None else found.duration_s
