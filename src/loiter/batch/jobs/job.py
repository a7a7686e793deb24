"""A batch job from the request to the summary: resumed, run, completed.

Dask's `map_partitions` plans data frames (`batch.frames`) but not files: it neither resumes from finished parts nor
joins them in order.
"""

from __future__ import annotations

import json
import time
from collections.abc import Callable, Iterator
from concurrent.futures import FIRST_EXCEPTION, Future, ThreadPoolExecutor, wait
from contextlib import contextmanager, nullcontext
from dataclasses import dataclass
from functools import partial
from pathlib import PurePosixPath
from shutil import copyfileobj
from threading import Lock
from typing import TYPE_CHECKING, Any, NamedTuple

import pyarrow as pa

from loiter.batch.jobs import cluster, folder
from loiter.batch.jobs.folder import Target
from loiter.batch.jobs.parts import Job, append_part, counts_of, solve_part
from loiter.batch.jobs.request import JobRequest, describe, row_limits, versions_of
from loiter.batch.tables import files, ingest, outputs, storage
from loiter.batch.tables.columns import STATUSES, may_take_long
from loiter.batch.tables.ingest import Ingested
from loiter.batch.tables.storage import Folder
from loiter.errors import InvalidArgument, Unfinished
from loiter.writing import write_whole

if TYPE_CHECKING:
    from loiter.batch.tables.outputs import Counts, Write


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

# Seconds between two checks of the progress.
POLL_S = 0.1


class JobStopped(Exception):
    """The job was stopped: its threads must end."""


class RowCounter:
    """The number of rows done, counted by several threads: each row when it is solved and when it is appended.

    When `stopped` is set, the next call of `count_or_stop` ends its thread.
    """

    def __init__(self, rows: int = 0) -> None:
        self.rows = rows
        self.stopped = False
        self._lock = Lock()

    def count_or_stop(self, rows: int) -> None:
        """Count rows; raises `JobStopped` if the job was stopped."""
        if self.stopped:
            raise JobStopped
        with self._lock:
            self.rows += rows


def run_request(request: JobRequest, workers: int, scheduler: str | None, report: ReportProgress) -> JobSummary:
    """Run the job, resuming it if possible, and say that the output is complete."""
    started = time.monotonic()
    target, description = request.target, describe(request)
    identity = folder.digest(description)
    client_context = nullcontext() if scheduler is None else cluster.open_client(scheduler)
    with client_context as client, _report_finished_parts(target):
        # Also before anything is created: a folder that is refused stays as it was.
        folder.check_dataset(target, identity)
        with folder.locked_folder(target) as work:
            is_same_job = folder.resume(target, description)
            if client is not None:
                cluster.check_workers(client, target, identity, request.source, request.versions[0])
            ingested = None if request.source.kind == ".parquet" else _convert_csv(request, report)
            job, parts = _divide(request, identity, ingested)
            finished = _finished(job, parts)
            for note in _notes(target, work, len(finished), len(parts), is_same_job=is_same_job):
                report(JobProgress(0, None, note))
            if len(finished) < len(parts):
                folder.declare_unfinished(target)
            counts = _solve_and_write(request, job, parts, finished, client, workers, report)
            folder.finish(target)
    resumed_rows = sum(part.rows for part in parts if part.number in finished)
    total, seconds = sum(part.rows for part in parts), time.monotonic() - started
    first_malformed = "" if ingested is None else ingested.first_malformed
    return JobSummary(total, counts, len(parts), len(finished), total - resumed_rows, seconds, first_malformed)


def _divide(request: JobRequest, identity: str, ingested: Ingested | None) -> tuple[Job, list[files.Part]]:
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
    parts = files.parts_of(sizes, part_rows, cut=may_take_long(request.columns))
    job = Job(
        tables=tuple(tables),
        names=tuple(names),
        work=target.work,
        parts=target.parts,
        columns=request.columns,
        schema=outputs.output_schema(schema, request.columns),
        digest=identity,
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
        counter.count_or_stop(rows)
        report(JobProgress(counter.rows, None))

    with work.create(folder.INGESTED, work) as path:
        with work.create(folder.REJECTED, work) as rejected:
            found = ingest.ingest("source", request.source, request.schema, path, rejected, count_rows)
        work.write(folder.INFERRED, json.dumps(found._asdict()).encode(), work)


def _finished(job: Job, parts: list[files.Part]) -> dict[int, Counts]:
    """The rows of each status for each part that an earlier run has finished, by its number."""
    present = set(job.parts.names())

    def counts(part: files.Part) -> Counts | None:
        # Where the file system has no fsync(2), the end of a part may be missing after a power failure.
        try:
            return counts_of(job, part) if job.name(part) in present else None
        except OSError:
            return None

    # Several at a time, since a store takes long to answer.
    with ThreadPoolExecutor(files.FOOTERS_AT_A_TIME) as pool:
        found = zip(parts, pool.map(counts, parts), strict=True)
        return {part.number: known for part, known in found if known is not None}


def _notes(target: Target, work: Folder, finished: int, parts: int, *, is_same_job: bool | None) -> Iterator[str]:
    """What is to be said before the work starts."""
    if not target.is_dataset and storage.exists(target.folder.place(target.name)):
        yield f"{target.text} exists: it will be replaced once all rows are solved"
    if finished == parts and folder.is_complete(target):
        yield "already complete: nothing to do"
    elif finished:
        yield f"resuming from {finished} of {parts} parts"
    elif is_same_job is False:
        name = PurePosixPath(work.at).name
        yield f"starting over: the parts in {name} belong to a job with another input, option or program"


def _solve_and_write(
    request: JobRequest,
    job: Job,
    parts: list[files.Part],
    finished: dict[int, Counts],
    client: Any,
    workers: int,
    report: ReportProgress,
) -> dict[str, int]:
    """Solve the remaining parts and complete the output; returns the number of rows of each status that occurs."""
    total, target = sum(part.rows for part in parts), request.target
    counter = RowCounter(sum(part.rows for part in parts if part.number in finished))
    # A row of a file is counted when it is solved, and when it is appended.
    times_counted = 1 if target.is_dataset else 2

    def show() -> None:
        report(JobProgress(counter.rows // times_counted, total))

    def append_rows(rows: int) -> None:
        counter.count_or_stop(rows)
        show()

    with _open_output(request, job) as write, _solver(job, counter, client, workers) as solve:
        solving = {part.number: solve(part) for part in parts if part.number not in finished}
        counts = dict(finished)
        for part in parts:
            if part.number in solving:
                counts[part.number] = _result(solving, part.number, show)
            if write is not None:
                append_part(job, part, write, append_rows)
        show()
        if versions_of(request.source) != request.versions:
            raise InvalidArgument("source", f"is {request.source.text!r}: it changed while it was read")
    sums = sum(counts.values(), outputs.no_rows())
    return {name: int(count) for name, count in zip(STATUSES, sums, strict=True) if count}


def _result(solving: dict[int, Future[Counts]], number: int, on_poll: Callable[[], object]) -> Counts:
    """The rows of each status of a part, once it is solved; raises the error of any part meanwhile."""
    while not solving[number].done():
        done, _ = wait(solving.values(), POLL_S, FIRST_EXCEPTION)
        for future in done:
            future.result()
        on_poll()
    return solving[number].result()


@contextmanager
def _solver(
    job: Job, counter: RowCounter, client: Any, workers: int
) -> Iterator[Callable[[files.Part], Future[Counts]]]:
    """A context whose value starts solving a part: in `workers` threads, or on a cluster."""
    if client is not None:
        with cluster.cluster_executor(client) as executor:
            yield lambda part: _count_when_solved(executor.submit(solve_part, job, part), part, counter)
        return
    pool = ThreadPoolExecutor(workers)
    try:
        yield lambda part: pool.submit(solve_part, job, part, counter.count_or_stop)
    except BaseException:
        counter.stopped = True
        raise
    finally:
        pool.shutdown(cancel_futures=True)


def _count_when_solved(solving: Future[Counts], part: files.Part, counter: RowCounter) -> Future[Counts]:
    solving.add_done_callback(lambda done: counter.count_or_stop(part.rows))
    return solving


@contextmanager
def _open_output(request: JobRequest, job: Job) -> Iterator[Write | None]:
    """A context whose value appends rows to the output file; None for a dataset, which consists of its parts."""
    target = request.target
    if target.is_dataset:
        yield None
        return
    with (
        target.folder.create(target.name, target.work) as path,
        outputs.open_output(target.kind, path, job.schema) as write,
    ):
        yield write


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
    parts = "1 finished part stays" if count == 1 else f"{count} finished parts stay"
    return f"{parts} in {target.parts.at}, and the same command resumes from there"
