"""Entries for tables of states: files of any size, pandas and Dask data frames.

Needs the packages that `pip install "loiter[tables]"` installs.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

from loiter.errors import InvalidArgument, MissingPackage, file_path
from loiter.geo import LocalFrame
from loiter.lazy import LazyModule
from loiter.planning.model import Aircraft, Orbit, Turn, TurnName, Wind
from loiter.planning.slot import Slot

if TYPE_CHECKING:
    from loiter import fences
    from loiter.tables import jobs as job
    from loiter.tables.jobs import JobProgress as JobProgress
    from loiter.tables.jobs import JobSummary as JobSummary
else:
    fences, job = LazyModule("loiter.fences"), LazyModule("loiter.tables.jobs")

# A data frame of pandas, Dask, Polars or Arrow.
AnyFrame = TypeVar("AnyFrame")

__all__ = ["JobProgress", "JobSummary", "plan", "run"]


def run(
    source: str | os.PathLike[str],
    target: str | os.PathLike[str],
    *,
    orbit: Orbit | None = None,
    turn: Turn | TurnName | None = None,
    aircraft: Aircraft | Mapping[str, float] | None = None,
    wind: Wind | None = None,
    orbit_velocity_m_s: tuple[float, float] | None = None,
    origin: LocalFrame | None = None,
    columns: Mapping[str, str] | None = None,
    tolerance_m: float = 0.0,
    fence: fences.Fence | fences.PlacedFence | None = None,
    margin_m: float | None = None,
    slot: Slot | None = None,
    workers: int | None = None,
    scheduler: str | None = None,
    rejects: str | os.PathLike[str] | None = None,
    progress: Callable[[job.JobProgress], object] = lambda progress: None,
) -> job.JobSummary:
    """Plan the fastest entry of every row of a table; docs/batch.md describes the columns of the input and the output.

    `source` is a file (.parquet, .csv, .csv.gz), a folder of files, a pattern such as "states-*.csv", or the URL of one
    of these (s3://, gs://, az://, memory://). `target` is a folder of Parquet files (its name ends in a slash, or it
    exists), which is fastest, a file, or the URL of one of these.
    `orbit`, `turn`, `aircraft` and `wind` replace columns that the table does not have; `aircraft` may be incomplete,
    such as {"airspeed_m_s": 18.0} with a column max_bank_deg.
    `orbit_velocity_m_s`, (east, north), is the velocity of circles that are given by columns. `columns` maps quantities
    to columns with other names or units: {"east_m": "X_East [ft]"}; docs/batch.md says how. Positions in degrees are
    columns `latitude_deg` and `longitude_deg`; `origin` is then the local frame of the metres of `orbit`, unless each
    row gives its circle in degrees, too.
    A table with columns of the point flown to, `exit_east_m` and `exit_north_m`, has legs: docs/batch.md. With a
    `fence`, in degrees where the table is, each row is checked against it by the margin `margin_m`, metres.
    With `slot`, or columns `slot_phase_deg` and `slot_at_s`, each row enters a slot (docs/slots.md).
    `workers` is the number of threads that solve, by default that of the cores; `scheduler` is the address of the
    scheduler of a Dask cluster that does this instead. `rejects` is a CSV file to write: the malformed lines of CSV
    files, with file, line number, problem and text. `progress` is called periodically.

    A file appears whole or not at all, and so does each part in a folder, where _SUCCESS says that all parts are there.
    A job that was stopped resumes from its finished parts when it is run again. A bad row gets nan and a status; the
    other rows are solved.

    Raises `InvalidArgument` before any work for files, columns and options that cannot be used, and for a folder with
    files of others; `Unfinished` if the work stops, for example because the disk is full; `MissingPackage`.
    """
    _need_packages("pyarrow", *(["dask", "distributed"] if scheduler is not None else []))
    from loiter.tables.columns import shared_values

    count, given = (
        _workers(workers, scheduler),
        shared_values(
            orbit, turn, aircraft, wind, orbit_velocity_m_s, origin, columns, tolerance_m, fence, margin_m, slot
        ),
    )
    kept = None if rejects is None else Path(file_path("rejects", rejects))
    checked = job.check_job(file_path("source", source), file_path("target", target), given, kept)
    return job.run_job(checked, count, scheduler, kept, progress)


def plan(
    frame: AnyFrame,
    *,
    orbit: Orbit | None = None,
    aircraft: Aircraft | Mapping[str, float] | None = None,
    wind: Wind | None = None,
    turn: Turn | TurnName | None = None,
    orbit_velocity_m_s: tuple[float, float] | None = None,
    origin: LocalFrame | None = None,
    columns: Mapping[str, str] | None = None,
    tolerance_m: float = 0.0,
    fence: fences.Fence | fences.PlacedFence | None = None,
    margin_m: float | None = None,
    slot: Slot | None = None,
) -> AnyFrame:
    """The fastest entries of the rows of a data frame of pandas, Dask, Polars or Arrow: the same with added columns.

    The frame has columns as docs/batch.md describes them: `east_m`, `north_m` in metres, `heading_deg` in degrees, and
    others in place of the arguments. The added columns are those of `run`: times in seconds, the point of joining in
    metres and degrees; word, turn and status are categories. A pandas frame keeps its index, and a Dask frame stays
    lazy. The arguments are those of `run`, `orbit_velocity_m_s` in metres per second, `tolerance_m` and `margin_m` in
    metres.

    A row that cannot be solved gets nan and a status. Raises `InvalidArgument` for something that is no data frame, for
    columns that are missing, given twice or of another type, and for arguments that cannot be used; `MissingPackage`.
    """
    _need_packages("pyarrow")
    from loiter.tables.columns import shared_values
    from loiter.tables.frames import plan_frame

    options = shared_values(
        orbit, turn, aircraft, wind, orbit_velocity_m_s, origin, columns, tolerance_m, fence, margin_m, slot
    )
    planned: AnyFrame = plan_frame(frame, options)
    return planned


def _workers(workers: int | None, scheduler: str | None) -> int:
    if workers is None:
        from loiter.arrays.application import cores

        return cores()
    if isinstance(workers, bool) or not isinstance(workers, int) or workers < 1:
        raise InvalidArgument("workers", f"is {workers!r}: it must be a whole number, at least 1")
    if scheduler is not None:
        raise InvalidArgument("workers", "and a scheduler are given: the scheduler's workers do the work")
    return workers


def _need_packages(*names: str) -> None:
    for name in names:
        try:
            import_module(name)
        except ImportError as error:
            raise MissingPackage.of_extra("tables need", name, "tables") from error


def __getattr__(name: str) -> Any:
    # The module of these classes needs pyarrow.
    if name in {"JobProgress", "JobSummary"}:
        return getattr(import_module("loiter.tables.jobs"), name)
    raise AttributeError(f"module 'loiter.tables' has no attribute {name!r}")
