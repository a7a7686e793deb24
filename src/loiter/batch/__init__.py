"""Tables of states in, tables of entries out: files of any size, pandas and Dask frames.

Needs what `pip install "loiter[cluster]"` brings.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Any

from loiter.errors import InvalidArgument, MissingPackage
from loiter.planning.model import Aircraft, Orbit, Turn, Wind

if TYPE_CHECKING:
    from loiter.batch.jobs.job import Progress as Progress
    from loiter.batch.jobs.job import Summary as Summary

__all__ = ["Progress", "Summary", "plan", "run"]


def run(
    source: str | os.PathLike[str],
    target: str | os.PathLike[str],
    *,
    orbit: Orbit | None = None,
    turn: Turn | str | None = None,
    aircraft: Aircraft | Mapping[str, float] | None = None,
    wind: Wind | None = None,
    orbit_velocity_m_s: tuple[float, float] | None = None,
    tolerance_m: float = 0.0,
    workers: int | None = None,
    scheduler: str | None = None,
    progress: Callable[[Progress], object] = lambda progress: None,
) -> Summary:
    """Plan the fastest entry of every row of a table; docs/batch.md says which columns it may have and which it gets.

    `source` and `target` end in .parquet, .csv or .csv.gz. `orbit`, `turn`, `aircraft` and `wind` stand for columns
    that the table does not have; `aircraft` may be a part of one, such as {"airspeed_m_s": 18.0} beside a column
    max_bank_deg. Circles move as `orbit` does, or those of columns with `orbit_velocity_m_s`, (east, north).
    `workers` threads work, as many as there are cores, or the Dask cluster with the scheduler at the address
    `scheduler`.
    `progress` hears every now and then how far the job is.

    The target appears whole or not at all. A job that was stopped goes on from its finished parts when it is asked for
    again. A bad row gets nan and a status and stops nothing.

    Raises `InvalidArgument` for what cannot be used, before any work; `Unfinished` where the work stops half way, as on
    a full disk; `MissingPackage`.
    """
    _need_packages("pyarrow", *(["dask", "distributed"] if scheduler is not None else []))
    if find_spec("fcntl") is None:
        raise MissingPackage("a batch job locks its files, as Linux and macOS can and this system cannot")
    from loiter.batch.jobs import job
    from loiter.batch.tables.columns import shared

    count, given = _workers(workers, scheduler), shared(orbit, turn, aircraft, wind, orbit_velocity_m_s)
    asked = job.request(Path(source), Path(target), given, tolerance_m)
    return job.carry_out(asked, count, scheduler, progress)


def plan(
    frame: Any,
    *,
    orbit: Orbit | None = None,
    aircraft: Aircraft | Mapping[str, float] | None = None,
    wind: Wind | None = None,
    turn: Turn | str | None = None,
    orbit_velocity_m_s: tuple[float, float] | None = None,
    tolerance_m: float = 0.0,
) -> Any:
    """The same for a pandas or a Dask data frame: a frame with the added columns, its index kept.

    A Dask frame stays lazy. Columns, options and errors as `run`; word, turn and status are categories.
    """
    _need_packages("pyarrow")
    from loiter.batch.frames import planned
    from loiter.batch.tables.columns import shared

    return planned(frame, shared(orbit, turn, aircraft, wind, orbit_velocity_m_s), tolerance_m)


def _workers(workers: int | None, scheduler: str | None) -> int:
    if workers is None:
        from loiter.arrays.threads import cores

        return cores()
    if isinstance(workers, bool) or not isinstance(workers, int) or workers < 1:
        raise InvalidArgument("workers", f"is {workers!r}: it must be a whole number, at least 1")
    if scheduler is not None:
        raise InvalidArgument("workers", "is given, and a scheduler too, whose workers do the work")
    return workers


def _need_packages(*names: str) -> None:
    for name in names:
        try:
            import_module(name)
        except ImportError as error:
            raise MissingPackage(f'tables need {name}: pip install "loiter[cluster]" brings it') from error


def __getattr__(name: str) -> Any:
    # What they are defined with needs pyarrow.
    if name in {"Progress", "Summary"}:
        return getattr(import_module("loiter.batch.jobs.job"), name)
    raise AttributeError(f"module 'loiter.batch' has no attribute {name!r}")
