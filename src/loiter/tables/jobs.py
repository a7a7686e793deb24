"""A batch job from the request to the summary: divided into parts, resumed, solved and completed.

Dask's `map_partitions` plans data frames (`tables.frames`) but not files: it neither resumes from finished parts nor
joins them in order.
"""

from __future__ import annotations

import json
import re
import time
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import contextmanager, nullcontext, suppress
from dataclasses import asdict, dataclass, replace
from hashlib import sha256
from pathlib import Path
from threading import Event
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq

from loiter.errors import InvalidArgument, Unfinished, check_installed
from loiter.lazy import LazyModule
from loiter.tables import cluster, files, parts
from loiter.tables.columns import MADE, STATUSES, Columns, SharedValues, columns, may_take_long, number_columns
from loiter.tables.files import FILE_ERRORS, SUCCESS, TEMPORARY, Place, Source, Target, create, reason
from loiter.tables.parts import Counts, Part, Table
from loiter.version import __version__
from loiter.writing import check_writable, write_content

if TYPE_CHECKING:
    from loiter.tables import csv_files
    from loiter.tables.csv_files import Rejected
else:
    csv_files = LazyModule("loiter.tables.csv_files")

# The rows of a part and of a batch. A job that is stopped loses only the parts in progress. A batch is some 10 MB, and
# large enough that the overhead of a call does not matter. In wind a row takes a thousand times as long.
PART_ROWS, BATCH_ROWS = 1 << 20, 1 << 16
PART_ROWS_IN_WIND, BATCH_ROWS_IN_WIND = 1 << 16, 1 << 12

# Hexadecimal digits of the digest of a job in the names of its files.
DIGITS = 8
PART = re.compile(rf"part-(\d+)-([0-9a-f]{{{DIGITS}}})\.parquet")

# The files of a working folder: unfinished ones, parts, CSV files as Parquet and what is known of their lines. The last
# one says that those before it are there, so that it is written last and deleted first.
SCRATCH = re.compile(rf"\..*|(part-\d+|input|rejects)-([0-9a-f]{{{DIGITS}}})(-\d+)?\.(parquet|json)")


class JobProgress(NamedTuple):
    """The progress of a job: the rows done, of `total` (None while a CSV file is converted), or a note."""

    rows: int
    total: int | None
    note: str = ""


@dataclass(frozen=True)
class JobSummary:
    """The result of a job.

    `statuses` has the number of rows of each status that occurs, including "ok", and that of malformed lines, which are
    not among the `rows` of the output. `resumed_parts` of the `parts` were finished by an earlier run; `solved_rows`
    were solved by this one, which took `seconds`. `first_malformed` says which line of a CSV file is the first that is
    malformed, and what is wrong with it; "" if there is none.
    """

    rows: int
    statuses: dict[str, int]
    parts: int
    resumed_parts: int
    solved_rows: int
    seconds: float
    first_malformed: str = ""


ReportProgress = Callable[[JobProgress], object]


@dataclass(frozen=True)
class Job:
    """A job to do: its files, the columns of the input and their meaning.

    `tables` are the Parquet files to read; CSV files, where `is_text`, become such files first. `versions` are
    those of the files of the input. A run resumes from the parts of an earlier one with the same `digest`.
    """

    source: Source
    target: Target
    schema: pa.Schema
    columns: Columns
    versions: list[tuple[str, int, str]]
    tables: tuple[Table, ...] = ()
    is_text: bool = False
    digest: str = ""

    @property
    def row_limits(self) -> tuple[int, int]:
        """The number of rows of a part and of a batch."""
        if may_take_long(self.columns):
            return PART_ROWS_IN_WIND, BATCH_ROWS_IN_WIND
        return PART_ROWS, BATCH_ROWS

    def parts(self) -> list[Part]:
        """The parts of the job; the names of their files sort in the order of the rows."""
        part_rows, batch_rows = self.row_limits
        divided = parts.divide(self.tables, part_rows)
        names = [part_name(number, len(divided), self.digest) for number in range(len(divided))]
        return [
            Part(self.target.parts.below(name), self.target.work, rows, batch_rows, self.schema, self.columns)
            for name, rows in zip(names, divided, strict=True)
        ]


def part_name(number: int, count: int, digest: str) -> str:
    """The name of a finished part, which says to which job it belongs."""
    return f"part-{number:0{max(5, len(str(count - 1)))}}-{digest[:DIGITS]}.parquet"


def check_job(source: str, target: str, options: SharedValues, rejects: Path | None = None) -> Job:
    """The job to do, checked as far as possible before any work; raises `InvalidArgument`."""
    found, output = files.find_source("source", source), files.find_target("target", target)
    tables = tuple[Table, ...]()
    if {found.kind, output.kind} != {".parquet"}:
        check_installed("duckdb", "CSV files need", "duckdb", "tables")
    if found.kind == ".parquet":
        if rejects is not None:
            raise InvalidArgument("rejects", "is for CSV files: a Parquet file has no malformed lines")
        schema, tables = _read_footers(found.files)
    else:
        schema = pa.schema([(name, pa.string()) for name in csv_files.read_header("source", found).names])
    is_text = found.kind != ".parquet"
    meaning = columns("source", schema, options, text=is_text)
    _check_apart(found, output, rejects)
    job = Job(found, output, schema, meaning, found.versions(), tables, is_text)
    described = [__version__, job.versions, output.kind, str(schema), asdict(meaning), job.row_limits]
    return replace(job, digest=sha256(json.dumps(described, default=repr).encode()).hexdigest()[:DIGITS])


def _read_footers(places: Sequence[Place]) -> tuple[pa.Schema, tuple[Table, ...]]:
    """The columns of Parquet files, and their row groups; a column without a type is null in its file."""
    schemas, tables = [], []
    for place in places:
        try:
            with place.open() as file, pq.ParquetFile(file) as table:
                schemas.append(table.schema_arrow)
                found = table.metadata
                tables.append(Table(place, tuple(found.row_group(i).num_rows for i in range(found.num_row_groups))))
        except FILE_ERRORS as error:
            raise files.unreadable("source", place, error) from error
    for place, schema in zip(places, schemas, strict=True):
        odd = {*schema.names} ^ {*schemas[0].names}
        if odd:
            problem = f"has files with different columns: {place.text} and the first differ in {min(odd)}"
            raise InvalidArgument("source", problem)
    try:
        return schemas[0] if len(schemas) == 1 else pa.unify_schemas(schemas), tuple(tables)
    except pa.ArrowException as error:
        raise InvalidArgument("source", f"has files with different types: {reason(error)}") from error


def _check_apart(source: Source, target: Target, rejects: Path | None) -> None:
    """Raise `InvalidArgument` if an output is a file of the input, or lies in the folder of the input."""
    place = target.place
    if any(place.is_same(file) for file in source.files):
        problem = "that is the input" if len(source.files) == 1 else "that is a file of the input"
        raise InvalidArgument("target", f"is {place.text!r}: {problem}")
    if source.folder is not None and f"{place.path}/".startswith(f"{source.folder.path.rstrip('/')}/"):
        raise InvalidArgument("target", f"is {place.text!r}: that is in the folder of the input")
    if rejects is not None:
        here = files.locate("rejects", str(rejects))
        if any(here.is_same(other) for other in (*source.files, place)):
            raise InvalidArgument("rejects", f"is {here.text!r}: that is the input or the output")
        check_writable("rejects", rejects)


def run_job(job: Job, workers: int, scheduler: str | None, rejects: Path | None, report: ReportProgress) -> JobSummary:
    """Run the job, resuming it if possible, and say that the output is complete."""
    started, target, rejected = time.monotonic(), job.target, list["Rejected"]()
    _check_dataset(target, job.digest)
    client_context = nullcontext() if scheduler is None else cluster.open_client(scheduler)
    with client_context as client, _work_folder(target):
        if client is not None:
            cluster.check_workers(client, target, job.source)
        is_other = _delete_others(target, job.digest)
        if job.is_text:
            report(JobProgress(0, None))
            rejected = _convert_csv(job, workers)
            if rejects is not None:
                write_content("rejects", rejects, csv_files.rejected_table(rejected))
            job = _with_tables(job)
        all_parts, present = job.parts(), set(target.parts.files())
        found = {i: parts.finished_counts(part) for i, part in enumerate(all_parts) if part.place.name in present}
        finished = {i: counts for i, counts in found.items() if counts is not None}
        for note in _notes(target, len(finished), len(all_parts), is_other=is_other):
            report(JobProgress(0, None, note))
        counts = _solve_parts(job, all_parts, finished, client, workers, report)
        _finish(target)
    statuses = {name: int(count) for name, count in zip(STATUSES, counts, strict=True) if count}
    statuses |= {"malformed": len(rejected)} if rejected else {}
    rows, resumed_rows = int(counts.sum()), int(sum(map(np.sum, finished.values())))
    first = "line {1} of {0} {2}".format(*rejected[0]) if rejected else ""
    seconds = time.monotonic() - started
    return JobSummary(rows, statuses, len(all_parts), len(finished), rows - resumed_rows, seconds, first)


def _check_dataset(target: Target, digest: str) -> None:
    """Raise `InvalidArgument` if the folder of a dataset has files that are not of the job with this digest."""
    names = target.place.files() if target.is_dataset else []
    others = [name for name in names if name not in (TEMPORARY, SUCCESS) and name[0] != "." and digest not in name]
    if not others:
        return
    number = "a file" if len(others) == 1 else f"{len(others)} files, such as"
    problem = f"it has {number} {others[0]}, which this job did not write"
    if all(PART.fullmatch(name) for name in others):
        problem = f"it has parts of a job with another input, option or program, such as {others[0]}"
    raise InvalidArgument("target", f"is {target.place.text!r}: {problem}; empty it or choose another folder")


@contextmanager
def _work_folder(target: Target) -> Iterator[None]:
    """A context in which the working folder exists; afterwards it is removed, unless a job can resume from it.

    Errors get a sentence about the finished parts.
    """
    was_there = target.place.exists
    try:
        target.parts.create_folder()
        target.work.create_folder()
    except OSError as error:
        problem = f"is {target.place.text!r}: its working folder {target.work.name} cannot be created, {reason(error)}"
        raise InvalidArgument("target", problem) from error
    try:
        yield
    except FILE_ERRORS as error:
        if isinstance(error, InvalidArgument):
            raise
        raise Unfinished(f"the job stopped: {reason(error)}; {_finished_parts(target)}") from error
    except KeyboardInterrupt:
        raise KeyboardInterrupt(f"interrupted; {_finished_parts(target)}") from None
    finally:
        # A store that does not answer any more has been reported.
        with suppress(*FILE_ERRORS):
            _clean_up(target)
            if target.is_dataset and not was_there:
                target.place.remove_if_empty()


def _clean_up(target: Target) -> None:
    """Delete the working folder, unless a job can resume from it; unfinished files may be those of another process."""
    names = [name for name in target.work.files() if SCRATCH.fullmatch(name) and name[0] != "."]
    is_complete = target.is_dataset and SUCCESS in target.place.files()
    # The folder of a job that can resume stays, since it says that a dataset is not complete.
    if is_complete or not (_count_parts(target) or any(name.startswith("rejects") for name in names)):
        target.work.delete_files(names)
        target.work.remove_if_empty()


def _count_parts(target: Target) -> int:
    return sum(PART.fullmatch(name) is not None for name in target.parts.files())


def _finished_parts(target: Target) -> str:
    try:
        count = _count_parts(target)
    except FILE_ERRORS:
        return "the same command resumes from the finished parts"
    if not count:
        return "no part was finished"
    kept = "1 finished part stays" if count == 1 else f"{count} finished parts stay"
    return f"{kept} in {target.parts.text}, and the same command resumes from there"


def _delete_others(target: Target, digest: str) -> bool:
    """Delete the finished files that another job left in the working folder; returns whether there were any."""
    found = [name for name in target.work.files() if SCRATCH.fullmatch(name) and name[0] != "."]
    others = [name for name in found if digest not in name]
    target.work.delete_files(others)
    return bool(others)


def _made_tables(job: Job) -> list[Place]:
    """The Parquet files that CSV files become."""
    return [job.target.work.below(f"input-{job.digest}-{i:05}.parquet") for i in range(len(job.source.files))]


def _convert_csv(job: Job, workers: int) -> list[Rejected]:
    """Convert CSV files to Parquet files, unless an earlier run has done it; returns their malformed lines."""
    work, found = job.target.work, list["Rejected"]()
    listed = work.below(f"rejects-{job.digest}.json")
    if listed.exists:
        with listed.open() as file:
            return [csv_files.Rejected(*each) for each in json.loads(file.read())]
    # Text stays as it is where the output is text.
    types = dict.fromkeys(job.schema.names, "VARCHAR")
    if job.target.kind == ".parquet":
        types = csv_files.column_types(job.source, workers)
    if job.columns.turn is None:
        types[job.columns.mapped["turn"].name] = "VARCHAR"
    quantities = [column.name for column in number_columns(job.columns).values()]
    for place, made in zip(job.source.files, _made_tables(job), strict=True):
        with create(made, work) as path:
            found += csv_files.convert("source", place, types, quantities, path, workers)
    with create(listed, work) as path:
        Path(path).write_text(json.dumps(found), encoding="utf-8")
    return found


def _with_tables(job: Job) -> Job:
    """The job with Parquet files in place of CSV files, and columns of numbers in place of those of text."""
    schema, tables = _read_footers(_made_tables(job))
    mapped = {
        quantity: replace(column, name=made) if (made := MADE + column.name) in schema.names else column
        for quantity, column in job.columns.mapped.items()
    }
    return replace(job, schema=schema, tables=tables, columns=replace(job.columns, mapped=mapped))


def _notes(target: Target, finished: int, count: int, *, is_other: bool) -> Iterator[str]:
    """What is to be said before the work starts."""
    if not target.is_dataset and target.place.exists:
        yield f"{target.place.text} exists: it will be replaced once all rows are solved"
    if finished == count and target.is_dataset and SUCCESS in target.place.files():
        yield "already complete: nothing to do"
    elif finished:
        yield f"resuming from {finished} of {count} parts"
    elif is_other:
        yield f"starting over: the parts in {target.work.name} belong to a job with another input, option or program"


def _solve_parts(
    job: Job,
    all_parts: list[Part],
    finished: dict[int, Counts],
    client: Any,
    workers: int,
    report: ReportProgress,
) -> Counts:
    """Solve the remaining parts and write the output file; returns the number of rows of each status, by its code."""
    target = job.target
    if target.is_dataset and len(finished) < len(all_parts):
        target.place.delete_files([SUCCESS])
    counts, total = np.zeros(len(STATUSES), np.int64), sum(part.rows.rows for part in all_parts)
    with _executor(client, workers) as submit:
        solving = {i: submit(part) for i, part in enumerate(all_parts) if i not in finished}

        def solved() -> Iterator[Part]:
            """The parts in order, each once it is solved."""
            for i, part in enumerate(all_parts):
                counts[:] += finished[i] if i in finished else solving[i].result()
                yield part
                report(JobProgress(int(counts.sum()), total))
            if job.source.versions() != job.versions:
                raise InvalidArgument("source", f"is {job.source.text!r}: it changed while it was read")

        if target.is_dataset:
            return [*solved()] and counts
        with create(target.place, target.work) as path:
            batches = (batch for part in solved() for batch in parts.read_batches(part.place))
            if target.kind == ".parquet":
                parts.write_parquet(path, all_parts[0].output, batches)
            else:
                csv_files.write_csv(path, all_parts[0].output, batches, packed=target.kind == ".csv.gz")
    return counts


@contextmanager
def _executor(client: Any, workers: int) -> Iterator[Callable[[Part], Future[Counts]]]:
    """A context whose value starts solving a part: in `workers` threads, or on a cluster."""
    if client is not None:
        with cluster.cluster_executor(client) as executor:
            yield lambda part: executor.submit(parts.solve_part, part)
        return
    stopped, pool = Event(), ThreadPoolExecutor(workers)
    try:
        yield lambda part: pool.submit(parts.solve_part, part, stopped)
    except BaseException:
        stopped.set()
        raise
    finally:
        pool.shutdown(cancel_futures=True)


def _finish(target: Target) -> None:
    """Say that a dataset is complete; delete what was needed only until then."""
    if target.is_dataset:
        with create(target.place.below(SUCCESS), target.work) as path:
            Path(path).touch()
    target.work.delete_files(name for name in target.work.files() if SCRATCH.fullmatch(name))
