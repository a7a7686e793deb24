"""A batch job from the request to the summary: resumed, run, completed.

Dask's `map_partitions` plans data frames (`batch.frames`) but not files: it neither resumes from finished parts nor
joins them in order.
"""

from __future__ import annotations

import json
import time
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import AbstractContextManager, contextmanager, nullcontext
from dataclasses import dataclass
from functools import partial
from pathlib import PurePosixPath
from shutil import copyfileobj
from typing import TYPE_CHECKING, Any, NamedTuple, TypeVar

import pyarrow as pa

from loiter.batch.jobs import cluster, folder
from loiter.batch.jobs.folder import Target
from loiter.batch.jobs.parts import Job, append_part, counts_of
from loiter.batch.jobs.request import JobRequest, describe, row_limits, versions_of
from loiter.batch.jobs.runner import Executors, RowCounter, run_parts, thread_executors
from loiter.batch.tables import files, ingest, outputs, storage
from loiter.batch.tables.columns import STATUSES, may_drift
from loiter.batch.tables.ingest import Ingested
from loiter.batch.tables.outputs import Append, open_joined
from loiter.batch.tables.storage import Folder
from loiter.errors import InvalidArgument, Unfinished
from loiter.writing import write_whole

if TYPE_CHECKING:
    from loiter.batch.tables.outputs import Counts

Result = TypeVar("Result")


class JobProgress(NamedTuple):
    """The progress of a job: the rows done, of `total` (None while a CSV file is converted), or a note.

    A row that is solved but not yet appended to the output file counts half.
    """

    rows: int
    total: int | None
    note: str = ""


@dataclass(frozen=True)
class JobSummary:
    """The result of a job.

    `statuses` has the number of rows of each status that occurs, including "ok". `resumed_parts` of the `parts` were
    finished by an earlier run; `solved_rows` were solved by this one, which took `seconds`. `first_malformed` says
    which line of a CSV file is the first that is malformed, and what is wrong with it; "" if there is none.
    """

    rows: int
    statuses: dict[str, int]
    parts: int
    resumed_parts: int
    solved_rows: int
    seconds: float
    first_malformed: str = ""


ReportProgress = Callable[[JobProgress], object]


def run_request(request: JobRequest, workers: int, scheduler: str | None, report: ReportProgress) -> JobSummary:
    """Run the job, resuming it if possible, and say that the output is complete."""
    started = time.monotonic()
    target, description = request.target, describe(request)
    with _client(scheduler) as client, _report_finished_parts(target):
        # Also before anything is created: a folder that is refused stays as it was.
        folder.check_dataset(target, folder.digest(description))
        with folder.locked_folder(target) as work:
            is_same_job = folder.resume(target, description)
            if client is not None:
                cluster.check_workers(client, target, folder.digest(description), request.source, request.versions[0])
            ingested = None if request.source.kind == ".parquet" else _convert_csv(request, report)
            job, parts = _divide(request, description, ingested)
            finished = _finished(job, parts)
            _report_replaced(target, report)
            complete = len(finished) == len(parts) and folder.is_complete(target)
            _report_start(is_same_job, work, len(finished), len(parts), report, complete=complete)
            if len(finished) < len(parts):
                folder.declare_unfinished(target)
            counts = _solve_and_write(request, job, parts, finished, _executors(client, workers), report)
            folder.finish(target)
    resumed_rows = sum(part.rows for part in parts if part.number in finished)
    total, seconds = sum(part.rows for part in parts), time.monotonic() - started
    first_malformed = "" if ingested is None else ingested.first_malformed
    return JobSummary(total, counts, len(parts), len(finished), total - resumed_rows, seconds, first_malformed)


def _client(scheduler: str | None) -> AbstractContextManager[Any]:
    return nullcontext() if scheduler is None else cluster.open_client(scheduler)


def _executors(client: Any, workers: int) -> Callable[..., AbstractContextManager[Executors]]:
    return partial(thread_executors, workers) if client is None else partial(cluster.cluster_executors, client)


def _divide(
    request: JobRequest, description: dict[str, Any], ingested: Ingested | None
) -> tuple[Job, list[files.Part]]:
    """The job and its parts; `ingested` is what is known of CSV files, which have become one Parquet file."""
    target, tables, sizes, schema = request.target, request.source.files, request.sizes, request.schema
    names = schema.names
    if ingested is not None:
        converted = target.work.place(folder.INGESTED)
        tables, sizes = (converted,), [files.read_footer(converted).sizes]
        names = [*names, ingest.MARK.name]
        if target.kind == ".parquet":
            # Text stays as it is where the output is text.
            schema = pa.schema(zip(schema.names, map(pa.type_for_alias, ingested.types), strict=True))
    part_rows, batch_rows = row_limits(request)
    parts = files.parts_of(sizes, part_rows, cut=may_drift(request.columns))
    job = Job(
        tables=tuple(tables),
        names=tuple(names),
        work=target.work,
        parts=target.parts,
        kind=target.kind,
        columns=request.columns,
        schema=outputs.output_schema(schema, request.columns),
        dictionaries=tuple(outputs.dictionary_columns(schema, tables[0])),
        digest=folder.digest(description),
        count=len(parts),
        batch_rows=batch_rows,
    )
    return job, parts


def _convert_csv(request: JobRequest, report: ReportProgress) -> Ingested:
    """Convert the CSV files to a Parquet file in the working folder, unless an earlier run has done it.

    Their malformed lines are written where they are wanted.
    """
    work = request.target.work
    if not {folder.INGESTED, folder.INFERRED, folder.REJECTED} <= set(work.names()):
        _ingest(request, report)
    if request.rejects is not None:
        with storage.open_place(work.place(folder.REJECTED)) as file:
            write_whole("rejects", request.rejects, partial(copyfileobj, file))
    return Ingested(**json.loads(work.read(folder.INFERRED)))


def _ingest(request: JobRequest, report: ReportProgress) -> None:
    work, counter = request.target.work, RowCounter()

    def count_rows(rows: int) -> None:
        counter.count(rows)
        report(JobProgress(counter.rows, None))

    with work.create(folder.INGESTED, work) as path:
        with work.create(folder.REJECTED, work) as rejected:
            found = ingest.ingest("source", request.source, request.schema, path, rejected, count_rows)
        work.write(folder.INFERRED, json.dumps(found._asdict()).encode(), work)


def _finished(job: Job, parts: list[files.Part]) -> dict[int, Counts]:
    """The rows of each status for each part that an earlier run has finished, by its number."""
    present = set(job.parts.names())
    candidates = [part for part in parts if job.name(part) in present]

    def counts(part: files.Part) -> Counts | None:
        # Where the file system has no fsync(2), the end of a part may be missing after a power failure.
        try:
            return counts_of(job, part)
        except OSError:
            return None

    return {number: found for number, found in _for_each(candidates, counts).items() if found is not None}


def _for_each(parts: list[files.Part], function: Callable[[files.Part], Result]) -> dict[int, Result]:
    """The results of a function for parts, by their numbers, several at a time, since a store takes long to answer."""
    with ThreadPoolExecutor(files.FOOTERS_AT_A_TIME) as pool:
        return dict(zip((part.number for part in parts), pool.map(function, parts), strict=True))


def _report_replaced(target: Target, report: ReportProgress) -> None:
    if not target.is_dataset and storage.exists(target.folder.place(target.name)):
        report(JobProgress(0, None, f"{target.text} exists: it will be replaced once all rows are solved"))


def _report_start(
    is_same_job: bool | None, work: Folder, finished: int, parts: int, report: ReportProgress, *, complete: bool
) -> None:
    if complete:
        report(JobProgress(0, None, "already complete: nothing to do"))
    elif finished:
        report(JobProgress(0, None, f"resuming from {finished} of {parts} parts"))
    elif is_same_job is False:
        name = PurePosixPath(work.place("")).name
        note = f"starting over: the parts in {name} belong to a job with another input, option or program"
        report(JobProgress(0, None, note))


def _solve_and_write(
    request: JobRequest,
    job: Job,
    parts: list[files.Part],
    finished: dict[int, Counts],
    open_executors: Callable[..., AbstractContextManager[Executors]],
    report: ReportProgress,
) -> dict[str, int]:
    """Solve the remaining parts and complete the output; returns the number of rows of each status that occurs."""
    total = sum(part.rows for part in parts)
    counter = RowCounter(sum(part.rows for part in parts if part.number in finished))
    with _open_output(request, job) as append:
        # A row of a file is counted when it is solved, and when it is appended.
        times_counted = 1 if append is None else 2
        appended = None
        if append is not None:
            appended = partial(append_part, job, append=append, count_rows=counter.count_or_stop)
        with open_executors(counter) as executors:
            counts = run_parts(
                job,
                parts,
                finished,
                executors,
                appended,
                lambda: report(JobProgress(counter.rows // times_counted, total)),
            )
        if versions_of(request.source) != request.versions:
            raise InvalidArgument("source", f"is {request.source.text!r}: it changed while it was read")
    return _by_status(job, parts, counts)


def _by_status(job: Job, parts: list[files.Part], counts: dict[int, Counts | None]) -> dict[str, int]:
    """The number of rows of each status that occurs; parts whose rows were not counted here are read."""
    unknown = [part for part in parts if counts[part.number] is None]
    known = [found for found in (counts | _for_each(unknown, partial(counts_of, job))).values() if found is not None]
    return {name: count for code, name in enumerate(STATUSES) if (count := sum(int(c[code]) for c in known))}


@contextmanager
def _open_output(request: JobRequest, job: Job) -> Iterator[Append | None]:
    """A context whose value appends a part to the output file; None for a dataset, whose parts are not appended."""
    target = request.target
    if target.is_dataset:
        yield None
        return
    with (
        target.folder.create(target.name, target.work) as path,
        open_joined(target.kind, path, job.schema, job.dictionaries) as append,
    ):
        yield append


@contextmanager
def _report_finished_parts(target: Target) -> Iterator[None]:
    """If the job stops with an error, add a sentence about the finished parts."""
    try:
        yield
    except (OSError, pa.ArrowException) as error:
        raise Unfinished(f"the job stopped: {files.reason(error)}; {_finished_parts(target)}") from error
    except KeyboardInterrupt:
        raise KeyboardInterrupt(f"interrupted; {_finished_parts(target)}") from None


def _finished_parts(target: Target) -> str:
    try:
        count = len(folder.finished_parts(target))
    except OSError:
        return "the same command resumes from the finished parts"
    if not count:
        return "no part was finished"
    place = target.parts.place("").rstrip("/")
    parts = "1 finished part stays" if count == 1 else f"{count} finished parts stay"
    return f"{parts} in {place}, and the same command resumes from there"
