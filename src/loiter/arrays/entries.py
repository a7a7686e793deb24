"""The fastest entries for columns of states in SI: the answers of `plan`, or status codes where there is no answer."""

from __future__ import annotations

from functools import cache, reduce
from math import inf, nan
from operator import and_
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from loiter.arrays.application import empty_results
from loiter.arrays.reduction import heading_vectors
from loiter.compiled import solver, ufuncs
from loiter.errors import OutOfRange
from loiter.kernel import motion
from loiter.kernel.rebinding import Function, rebound
from loiter.kernel.rounding import REACH
from loiter.kernel.statuses import Status
from loiter.kernel.wind.wind_search import WindEntry, WindProblem, no_entry, status_of, time_of
from loiter.kernel.words import Side, Word
from loiter.planning.compass import heading_after
from loiter.planning.model import (
    CONTROLS,
    TURNS,
    RelativeWind,
    directions,
    position_after,
    radius_at_bank,
    radius_at_rate,
    relative_velocity,
    sign_of,
    wind_velocity,
)
from loiter.planning.slot import Slot, phase_at_start

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    Floats = NDArray[np.float64]
    Codes = NDArray[np.int8]

# Rows solved at a time: about ten columns of them fit into the cache of a core (1 MiB), and calls cost little.
BLOCK = 8192

# A code that is no `Side`, for an unknown turn.
UNKNOWN = 2


class States(NamedTuple):
    """Rows to solve: float64 arrays of one length n or, except for the pose, one number that all rows share.

    `side` holds `loiter.kernel.words.Side` codes (int8), `UNKNOWN` among them. `limit` names the kind of `turn_limit`:
    "max_bank_deg", "min_turn_radius_m" or "max_turn_rate_deg_s". The position of the circle is that at the start. The
    caller has checked the values that all rows share. With `slot_phase_deg` each row enters a slot.
    """

    east_m: Floats
    north_m: Floats
    heading_deg: Floats
    orbit_east_m: Floats | float
    orbit_north_m: Floats | float
    orbit_radius_m: Floats | float
    side: Codes | int
    airspeed_m_s: Floats | float
    turn_limit: Floats | float
    limit: str
    tolerance_m: float = 0.0
    wind_speed_m_s: Floats | float = 0.0
    wind_from_deg: Floats | float = 0.0
    orbit_velocity_east_m_s: Floats | float = 0.0
    orbit_velocity_north_m_s: Floats | float = 0.0
    slot_phase_deg: Floats | float | None = None
    slot_at_s: Floats | float = 0.0


class Entries(NamedTuple):
    """The fastest entries, arrays of length n: nan and codes 0 where `status`, a `Status`, is not `OK`.

    `word` holds `Word`, `side` `Side` codes (int8). The point of joining lies on the circle at the time of joining; its
    heading is in [0, 360). A piece that is not flown lasts 0 s.
    """

    duration_s: Floats
    word: Codes
    side: Codes
    join_east_m: Floats
    join_north_m: Floats
    join_heading_deg: Floats
    duration_1_s: Floats
    duration_2_s: Floats
    duration_3_s: Floats
    status: Codes


def entries(states: States) -> Entries:
    """The fastest entry of each row, as `plan` returns it."""
    n = len(states.east_m)
    found = empty_results(Entries, (n,))
    with np.errstate(all="ignore"):
        if states.slot_phase_deg is not None:
            _solve(states, slice(None), _in_slots, found)
            return found
        for start in range(0, n, BLOCK):
            _solve(states, slice(start, start + BLOCK), _in_still_air, found)
        windy = _windy(states)
        if windy.size:
            _solve(states, windy, _in_wind, found)
    return found


def _solve(states: States, rows: Any, solve: Callable[[States], Entries], found: Entries) -> None:
    """Solve some rows, a slice or row numbers, and store their entries."""
    some: list[Any] = [value[rows] if isinstance(value, np.ndarray) else value for value in states]
    columns: Any = zip(found, solve(States(*some)), strict=True)
    for column, values in columns:
        column[rows] = values


# The control u of each piece by the code of the word; 0 past the last.
_CONTROLS = np.zeros((3, 64))
for _word in Word:
    for _piece, _letter in enumerate(_word.letters):
        _CONTROLS[_piece, _word] = CONTROLS[_letter]


def _in_still_air(s: States) -> Entries:
    """The entries of rows in still air relative to the circle; rows in wind get values that are overwritten later."""
    r = _turn_radius(s)
    refused = _refused_statuses(s, r)
    east, north = s.east_m - s.orbit_east_m, s.north_m - s.orbit_north_m
    # The formula is plain arithmetic, so it takes arrays.
    reduced: Any = motion.reduce(east / r, north / r, *heading_vectors()(s.heading_deg))
    x, y = reduced
    R = s.orbit_radius_m / r
    if np.any(refused):
        x = np.where(refused, nan, x)
    tolerance = s.tolerance_m / r if s.tolerance_m else 0.0
    time, word, durations, status, side, _ = ufuncs.solve(x, y, R, s.side, tolerance, np.empty(3))
    if status.any():
        status = _final_statuses(s, status, refused)
    seconds = r / s.airspeed_m_s
    time_s, (first_s, second_s, third_s) = time * seconds, durations.T * seconds
    heading = _joining_heading(s, word, durations)
    c, v = heading_vectors()(heading)
    # On a clockwise circle the centre is to the right: the aircraft joins one radius to the left of it, along (-v, c).
    left = side * s.orbit_radius_m
    east, north = _centre_after(s, time_s)
    return Entries(
        time_s,
        word,
        side,
        east - left * v,
        north + left * c,
        heading,
        first_s,
        second_s,
        third_s,
        status,
    )


def _in_wind(s: States) -> Entries:
    """The entries of rows in wind relative to the circle."""
    r = _turn_radius(s)
    refused = _refused_statuses(s, r)
    solution = ufuncs.solve_in_wind(*_wind_problems(s, r, refused), s.tolerance_m / r, np.empty(3))
    return _entries_in_wind(s, r, refused, solution)


def _wind_problems(s: States, r: Any, refused: Any) -> tuple[Any, ...]:
    """The fields of `WindProblem` of rows, but for the tolerance; those of refused rows are nan."""
    x, y = (s.east_m - s.orbit_east_m) / r, (s.north_m - s.orbit_north_m) / r
    (c, v), (wx, wy) = heading_vectors()(s.heading_deg), _relative_wind(s)
    return np.where(refused, nan, x), y, c, v, s.orbit_radius_m / r, s.side, wx, wy


def _in_slots(s: States) -> Entries:
    """The entries of rows into slots, in still air and in wind."""
    r = _turn_radius(s)
    refused = _refused_statuses(s, r)
    phase: Any = s.slot_phase_deg
    rows = np.broadcast_arrays(*_wind_problems(s, r, refused), 0.0, phase, s.slot_at_s, r / s.airspeed_m_s)
    found = [
        _first_in_slot(WindProblem(*numbers), phase_deg, at_s, unit_s)
        for *numbers, phase_deg, at_s, unit_s in zip(*(column.tolist() for column in rows), strict=True)
    ]
    status, side, word, t1, t2, t3, azimuth, miss = np.array(found, dtype=np.float64).reshape(-1, 8).T
    word_codes, statuses, sides = (column.astype(np.int8) for column in (word, status, side))
    solution = t1 + t2 + t3, word_codes, np.stack([t1, t2, t3], axis=-1), statuses, sides, azimuth, miss
    return _entries_in_wind(s, r, refused, solution)


def _first_in_slot(given: WindProblem, phase_deg: float, at_s: float, unit_s: float) -> WindEntry:
    """The fastest entry of one row into its slot, as `plan` finds it; a status where there is none.

    `unit_s` is a turn radius over the airspeed.
    """
    status = status_of(given)
    if status != Status.OK:
        return no_entry(status)
    found = []
    for turn in directions(TURNS[Side(given.side)]):
        held = given._replace(side=sign_of(turn))
        try:
            found.append(solver.first_in_slot(held, phase_at_start(Slot(phase_deg, at_s), held, unit_s)))
        except OutOfRange:
            return no_entry(Status.BAD_SLOT)
    failed = [entry for entry in found if entry.status != Status.OK]
    return failed[0] if failed else min(found, key=time_of)


def _entries_in_wind(s: States, r: Any, refused: Any, solution: tuple[Any, ...]) -> Entries:
    """The entries in SI of the kernel's solution for rows in wind."""
    time, word, durations, status, side, azimuth, _ = solution
    seconds = r / s.airspeed_m_s
    time_s, (first_s, second_s, third_s) = time * seconds, durations.T * seconds
    east, north = _centre_after(s, time_s)
    return Entries(
        time_s,
        word,
        side,
        east + s.orbit_radius_m * np.cos(azimuth),
        north + s.orbit_radius_m * np.sin(azimuth),
        _joining_heading(s, word, durations),
        first_s,
        second_s,
        third_s,
        _final_statuses(s, status, refused),
    )


def _windy(s: States) -> NDArray[np.intp]:
    """The numbers of the rows in wind relative to the circle."""
    if not any(np.ndim(v) or v for v in (s.wind_speed_m_s, s.orbit_velocity_east_m_s, s.orbit_velocity_north_m_s)):
        return np.empty(0, dtype=np.intp)
    return np.flatnonzero(np.broadcast_to(np.logical_not(_relative_wind(s).still), s.east_m.shape))


def _relative_wind(s: States) -> RelativeWind:
    """`relative_wind` of each row."""
    velocity = rebound(wind_velocity, {"heading_vector": heading_vectors()})
    air, circle = velocity(s.wind_speed_m_s, s.wind_from_deg), (s.orbit_velocity_east_m_s, s.orbit_velocity_north_m_s)
    return RelativeWind(*rebound(relative_velocity, {"hypot": np.hypot})(air, circle, s.airspeed_m_s))


def _joining_heading(s: States, word: Any, durations: Any) -> Any:
    turned = sum(u.take(word) * t for u, t in zip(_CONTROLS, durations.T, strict=True))
    return heading_after(s.heading_deg, turned)


def _centre_after(s: States, time_s: Any) -> tuple[Any, Any]:
    """The position of the circle's centre when it is joined."""
    if not any(np.ndim(v) or v for v in (s.orbit_velocity_east_m_s, s.orbit_velocity_north_m_s)):
        return s.orbit_east_m, s.orbit_north_m
    east_m = position_after(s.orbit_east_m, s.orbit_velocity_east_m_s, time_s)
    return east_m, position_after(s.orbit_north_m, s.orbit_velocity_north_m_s, time_s)


def _turn_radius(s: States) -> Any:
    return s.turn_limit if s.limit == "min_turn_radius_m" else _radius(s.limit)(s.airspeed_m_s, s.turn_limit)


@cache
def _radius(limit: str) -> Function:
    formula = {"max_bank_deg": radius_at_bank, "max_turn_rate_deg_s": radius_at_rate}[limit]
    return rebound(formula, {"tan": np.tan, "radians": np.radians})


def _refused_statuses(s: States, r: Any) -> Any:
    """The statuses of rows that are not solved, 0 elsewhere: an array, or 0 for all."""
    # Paths of up to REACH turn radii must be finite numbers of metres and seconds too.
    finite = _positive(REACH * r / s.airspeed_m_s) & np.less(REACH * r, inf)
    refused: Any = np.where(finite, 0, Status.OUT_OF_RANGE)
    if isinstance(s.side, np.ndarray):
        refused = np.where(s.side == UNKNOWN, Status.BAD_TURN, refused)
    circle = s.orbit_east_m, s.orbit_north_m, s.orbit_velocity_east_m_s, s.orbit_velocity_north_m_s
    if any(isinstance(v, np.ndarray) for v in (*circle, s.orbit_radius_m)):
        valid = reduce(and_, map(np.isfinite, circle)) & _positive(s.orbit_radius_m)
        refused = np.where(valid, refused, Status.BAD_ORBIT)
    if any(isinstance(v, np.ndarray) for v in (s.wind_speed_m_s, s.wind_from_deg)):
        valid = np.isfinite(s.wind_speed_m_s) & np.isfinite(s.wind_from_deg) & np.greater_equal(s.wind_speed_m_s, 0.0)
        refused = np.where(valid, refused, Status.BAD_WIND)
    if any(isinstance(v, np.ndarray) for v in (s.slot_phase_deg, s.slot_at_s)):
        known: Any = s.slot_phase_deg
        refused = np.where(np.isfinite(known) & np.isfinite(s.slot_at_s), refused, Status.BAD_SLOT)
    if any(isinstance(v, np.ndarray) for v in (s.airspeed_m_s, s.turn_limit)):
        below_90 = np.less(s.turn_limit, 90.0) if s.limit == "max_bank_deg" else True
        valid = _positive(s.airspeed_m_s) & _positive(s.turn_limit) & _positive(r) & below_90
        refused = np.where(valid, refused, Status.BAD_AIRCRAFT)
    return refused


def _positive(value: Any) -> Any:
    return np.greater(value, 0.0) & np.less(value, inf)


def _final_statuses(s: States, status: Any, refused: Any) -> Any:
    """The final statuses of the rows, from `refused` and the statuses of the kernel."""
    # Finite coordinates whose difference is infinite are out of range.
    finite = np.isfinite(s.east_m) & np.isfinite(s.north_m) & np.isfinite(s.heading_deg)
    why = np.where(finite, Status.OUT_OF_RANGE, Status.BAD_POSE)
    status = np.where(status == Status.NOT_FINITE, why, status)
    return np.where(refused, refused, status)
