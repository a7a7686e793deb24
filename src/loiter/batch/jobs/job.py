"""A batch job from the request to the summary: checked, resumed, run."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager, nullcontext
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any, NamedTuple

import pyarrow as pa

from loiter.batch.jobs import cluster, folder
from loiter.batch.jobs.parts import Job, append_part, is_whole
from loiter.batch.jobs.runner import Executors, RowCounter, run_parts, thread_executors
from loiter.batch.tables import files, ingest, outputs
from loiter.batch.tables.columns import STATUSES, Columns, SharedValues, columns, may_drift
from loiter.errors import InvalidArgument, Unfinished
from loiter.version import __version__


class JobProgress(NamedTuple):
    """The progress of a job: the rows done, of `total` (None while a CSV file is converted), or a note.

    A row that is solved but not yet written counts half.
    """

    rows: int
    total: int | None
    note: str = ""


@dataclass(frozen=True, slots=True)
class JobSummary:
    """The result of a job.

    `statuses` has the number of rows of each status that occurs, including "ok". `resumed_parts` of the `parts` were
    finished by an earlier run; `solved_rows` were solved by this one, which took `seconds`.
    """

    rows: int
    statuses: dict[str, int]
    parts: int
    resumed_parts: int
    solved_rows: int
    seconds: float


# The former names, which stay public.
Progress = JobProgress
Summary = JobSummary

ReportProgress = Callable[[JobProgress], object]


class JobRequest(NamedTuple):
    """A job to do: its files and their kinds, the schema of the input and the meaning of its columns."""

    source: Path
    target: Path
    source_kind: files.Kind
    target_kind: files.Kind
    schema: pa.Schema
    columns: Columns


def check_request(source: Path, target: Path, options: SharedValues, tolerance_m: float) -> JobRequest:
    """The job to do, checked as far as possible before any work; raises `InvalidArgument`."""
    source_kind, target_kind = files.kind("source", source), files.kind("target", target)
    is_text = source_kind != ".parquet"
    schema = ingest.csv_schema("source", source) if is_text else files.parquet_schema("source", source)
    meaning = columns("source", schema, options, tolerance_m, text=is_text)
    outputs.check_columns(target_kind, outputs.output_schema(schema))
    if target.is_dir():
        raise InvalidArgument("target", f"is {str(target)!r}: that is a folder")
    if target.exists() and target.samefile(source):
        raise InvalidArgument("target", f"is {str(target)!r}: that is the input")
    return JobRequest(source, target, source_kind, target_kind, schema, meaning)


def run_request(request: JobRequest, workers: int, scheduler: str | None, report: ReportProgress) -> JobSummary:
    """Run the job, resuming it if possible, and move the output to its place."""
    started = time.monotonic()
    with _client(scheduler) as client, folder.locked_folder(request.target) as here, _report_finished_parts(here):
        description = _description(request)
        is_same_job = folder.resume(here, description)
        # Absolute paths, since workers of a cluster have other working directories.
        table = request.source.absolute() if request.source_kind == ".parquet" else here / folder.INGESTED
        part_rows, batch_rows = _sizes(request)
        schema = outputs.part_schema(request.schema)
        job = Job(table, here, request.columns, schema, folder.digest(description), batch_rows)
        if client is not None:
            cluster.check_workers(client, job, request.source)
        if not table.exists():
            _convert_csv(request, table, report)
        parts = files.parts_of(table, part_rows, cut=may_drift(request.columns))
        # The folder is listed, since network file systems may cache the fact that a name did not exist.
        whole = {path for path in folder.finished_parts(here) if is_whole(path)}
        finished = {part.number for part in parts if folder.part_path(here, part.number) in whole}
        _report_start(is_same_job, here, len(finished), len(parts), report)
        counter = RowCounter(sum(part.rows for part in parts if part.number in finished))
        total, earlier, resumed = sum(part.rows for part in parts), counter.rows, len(finished)
        in_wind = may_drift(request.columns)
        executors = _executors(client, workers, counter, append_only=resumed == len(parts), in_wind=in_wind)
        counts = _write_output(
            request, job, parts, finished, executors, counter, lambda: report(JobProgress(counter.rows // 2, total))
        )
        if _description(request) != description:
            raise InvalidArgument("source", f"is {str(request.source)!r}: it changed while it was read")
        folder.finish(here, request.target, workers)
    seconds = time.monotonic() - started
    return JobSummary(total, counts, len(parts), resumed, total - earlier, seconds)


def _client(scheduler: str | None) -> AbstractContextManager[Any]:
    return nullcontext() if scheduler is None else cluster.open_client(scheduler)


def _executors(
    client: Any, workers: int, counter: RowCounter, *, append_only: bool, in_wind: bool
) -> AbstractContextManager[Executors]:
    if client is not None:
        return cluster.cluster_executors(client, counter)
    return thread_executors(workers, counter, append_only=append_only, in_wind=in_wind)


def _sizes(request: JobRequest) -> tuple[int, int]:
    """The number of rows of a part and of a batch."""
    if may_drift(request.columns):
        return files.PART_ROWS_IN_WIND, files.BATCH_ROWS_IN_WIND
    return files.PART_ROWS, files.BATCH_ROWS


def _description(request: JobRequest) -> dict[str, Any]:
    """The description of a job: a run resumes from the parts of an earlier run with an equal description."""
    stat, (part_rows, batch_rows) = request.source.stat(), _sizes(request)
    return {
        "program": __version__,
        "source": str(request.source.resolve()),
        "size": stat.st_size,
        "mtime_ns": stat.st_mtime_ns,
        "schema": [f"{field.name}: {field.type}" for field in request.schema],
        "columns": asdict(request.columns),
        "part_rows": part_rows,
        "batch_rows": batch_rows,
    }


def _convert_csv(request: JobRequest, table: Path, report: ReportProgress) -> None:
    """Convert the CSV file to a Parquet file."""
    counter = RowCounter()

    def count_rows(rows: int) -> None:
        counter.count(rows)
        report(JobProgress(counter.rows, None))

    ingest.ingest("source", request.source, request.schema, table, count_rows)


def _report_start(is_same_job: bool | None, here: Path, finished: int, parts: int, report: ReportProgress) -> None:
    if finished:
        report(JobProgress(0, None, f"resuming from {finished} of {parts} parts"))
    elif is_same_job is False:
        note = f"starting over: the parts in {here.name} belong to a job with another input, option or program"
        report(JobProgress(0, None, note))


def _write_output(
    request: JobRequest,
    job: Job,
    parts: list[files.Part],
    finished: set[int],
    executors_context: AbstractContextManager[Executors],
    counter: RowCounter,
    on_poll: Callable[[], object],
) -> dict[str, int]:
    """Solve the remaining parts and write the output; returns the number of rows of each status that occurs."""
    dictionaries = outputs.dictionary_columns(request.schema, job.table)
    schema = outputs.output_schema(request.schema)
    path = job.folder / folder.OUTPUT
    with (
        outputs.open_output(request.target_kind, path, schema, dictionaries) as write,
        executors_context as executors,
    ):
        counts = run_parts(
            job,
            parts,
            finished,
            executors,
            lambda part: append_part(job, part, write, counter.count_or_stop),
            on_poll,
        )
    return {name: count for code, name in enumerate(STATUSES) if (count := sum(int(c[code]) for c in counts))}


@contextmanager
def _report_finished_parts(here: Path) -> Iterator[None]:
    """If the job stops with an error, add a sentence about the finished parts."""
    try:
        yield
    except (OSError, pa.ArrowException) as error:
        raise Unfinished(f"the job stopped: {files.reason(error)}; {_finished_parts(here)}") from error
    except KeyboardInterrupt:
        raise KeyboardInterrupt(f"interrupted; {_finished_parts(here)}") from None


def _finished_parts(here: Path) -> str:
    count = len(folder.finished_parts(here))
    if not count:
        return "no part was finished"
    parts = "1 finished part stays" if count == 1 else f"{count} finished parts stay"
    return f"{parts} in {here}, and the same command resumes from there"
