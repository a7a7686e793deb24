"""A job as it was asked for: checked, taken up where it was left, carried through, summed up."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager, nullcontext
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Any, NamedTuple

import pyarrow as pa

from loiter.arrays.wind import COMPILED_FROM
from loiter.batch.jobs import cluster, folder
from loiter.batch.jobs.parts import Job, append_part, is_whole
from loiter.batch.jobs.runner import Crew, Meter, local_crew, work
from loiter.batch.tables import files, ingest, outputs
from loiter.batch.tables.columns import STATUSES, Columns, Shared, columns, drifting
from loiter.errors import InvalidArgument, Unfinished
from loiter.version import __version__


class Progress(NamedTuple):
    """How far a job is: rows done, of `total`, which is None while a CSV file is read in; and at times a note.

    A row that is solved and not yet written counts half.
    """

    rows: int
    total: int | None
    note: str = ""


@dataclass(frozen=True, slots=True)
class Summary:
    """What became of a job.

    `statuses` counts the rows of each status that occurs, "ok" among them. Of `parts` an earlier run had finished
    `resumed_parts`; `solved_rows` is what was left for this one, which took `seconds`.
    """

    rows: int
    statuses: dict[str, int]
    parts: int
    resumed_parts: int
    solved_rows: int
    seconds: float


Tell = Callable[[Progress], object]


class Request(NamedTuple):
    """A job before anything is done: its files, what they are, and what the input's columns mean."""

    source: Path
    target: Path
    source_kind: files.Kind
    target_kind: files.Kind
    schema: pa.Schema
    columns: Columns


def request(source: Path, target: Path, options: Shared, tolerance_m: float) -> Request:
    """The job, checked as far as it can be before any work; raises `InvalidArgument`."""
    source_kind, target_kind = files.kind("source", source), files.kind("target", target)
    is_text = source_kind != ".parquet"
    schema = ingest.csv_schema("source", source) if is_text else files.parquet_schema("source", source)
    meaning = columns("source", schema, options, tolerance_m, text=is_text)
    outputs.check(target_kind, outputs.output_schema(schema))
    if target.is_dir():
        raise InvalidArgument("target", f"is {str(target)!r}: that is a folder")
    if target.exists() and target.samefile(source):
        raise InvalidArgument("target", f"is {str(target)!r}: that is the input")
    return Request(source, target, source_kind, target_kind, schema, meaning)


def carry_out(asked: Request, workers: int, scheduler: str | None, tell: Tell) -> Summary:
    """Do the job, or what is left of it, and put the output in its place."""
    started = time.monotonic()
    with _connection(scheduler) as client, folder.held(asked.target) as here, _kept(here):
        description = _description(asked)
        known = folder.resumed(here, description)
        # Absolute paths, since workers of a cluster stand elsewhere.
        table = asked.source.absolute() if asked.source_kind == ".parquet" else here / folder.INGESTED
        part_rows, batch_rows = _sizes(asked)
        schema = outputs.part_schema(asked.schema)
        job = Job(table, here, asked.columns, schema, folder.digest(description), batch_rows)
        if client is not None:
            cluster.check_workers(client, job, asked.source)
        if not table.exists():
            _read_in(asked, table, tell)
        parts = files.parts_of(table, part_rows, cut=drifting(asked.columns))
        # Files that are there, not names that are asked for: a network's file system remembers what it did not find.
        whole = {path for path in folder.finished_parts(here) if is_whole(path)}
        finished = {part.number for part in parts if folder.part_path(here, part.number) in whole}
        _tell_of_earlier(known, here, len(finished), len(parts), tell)
        meter = Meter(sum(part.rows for part in parts if part.number in finished))
        total, earlier, resumed = sum(part.rows for part in parts), meter.rows, len(finished)
        job = replace(job, compiled=drifting(asked.columns) and total >= COMPILED_FROM)
        crew = _crew(client, workers, meter, idle=resumed == len(parts), compiled=job.compiled)
        counts = _written(asked, job, parts, finished, crew, meter, lambda: tell(Progress(meter.rows // 2, total)))
        if _description(asked) != description:
            raise InvalidArgument("source", f"is {str(asked.source)!r}: it changed while it was read")
        folder.finish(here, asked.target, workers)
    seconds = time.monotonic() - started
    return Summary(total, counts, len(parts), resumed, total - earlier, seconds)


def _connection(scheduler: str | None) -> AbstractContextManager[Any]:
    return nullcontext() if scheduler is None else cluster.connected(scheduler)


def _crew(client: Any, workers: int, meter: Meter, *, idle: bool, compiled: bool) -> AbstractContextManager[Crew]:
    if client is not None:
        return cluster.cluster_crew(client, meter)
    return local_crew(workers, meter, idle=idle, compiled=compiled)


def _sizes(asked: Request) -> tuple[int, int]:
    """How many rows a part and a batch have."""
    if drifting(asked.columns):
        return files.PART_ROWS_IN_WIND, files.BATCH_ROWS_IN_WIND
    return files.PART_ROWS, files.BATCH_ROWS


def _description(asked: Request) -> dict[str, Any]:
    """What must be the same for one run of a job to go on from another's parts."""
    stat, (part_rows, batch_rows) = asked.source.stat(), _sizes(asked)
    return {
        "program": __version__,
        "source": str(asked.source.resolve()),
        "size": stat.st_size,
        "mtime_ns": stat.st_mtime_ns,
        "schema": [f"{field.name}: {field.type}" for field in asked.schema],
        "columns": asdict(asked.columns),
        "part_rows": part_rows,
        "batch_rows": batch_rows,
    }


def _read_in(asked: Request, table: Path, tell: Tell) -> None:
    """Make a CSV file a Parquet file."""
    meter = Meter()

    def tick(rows: int) -> None:
        meter.count(rows)
        tell(Progress(meter.rows, None))

    ingest.ingest("source", asked.source, asked.schema, table, tick)


def _tell_of_earlier(known: bool | None, here: Path, finished: int, parts: int, tell: Tell) -> None:
    if finished:
        tell(Progress(0, None, f"going on from {finished} of {parts} parts"))
    elif known is False:
        tell(Progress(0, None, f"starting over: the parts in {here.name} were of another input, option or program"))


def _written(
    asked: Request,
    job: Job,
    parts: list[files.Part],
    finished: set[int],
    crew: AbstractContextManager[Crew],
    meter: Meter,
    look: Callable[[], object],
) -> dict[str, int]:
    """Solve what is to be solved and write the output; gives the number of rows of each status that occurs."""
    dictionaries = outputs.dictionary_columns(asked.schema, job.table)
    schema = outputs.output_schema(asked.schema)
    path = job.folder / folder.OUTPUT
    with outputs.output(asked.target_kind, path, schema, dictionaries) as write, crew as hands:
        counts = work(job, parts, finished, hands, lambda part: append_part(job, part, write, meter.tick), look)
    return {name: count for code, name in enumerate(STATUSES) if (count := sum(int(c[code]) for c in counts))}


@contextmanager
def _kept(here: Path) -> Iterator[None]:
    """Say of a job that stops half way what is kept of it."""
    try:
        yield
    except (OSError, pa.ArrowException) as error:
        raise Unfinished(f"the job stopped: {files.reason(error)}; {_what_is_kept(here)}") from error
    except KeyboardInterrupt:
        raise KeyboardInterrupt(f"interrupted; {_what_is_kept(here)}") from None


def _what_is_kept(here: Path) -> str:
    count = len(folder.finished_parts(here))
    if not count:
        return "no part was finished"
    parts = "1 part that is" if count == 1 else f"{count} parts that are"
    return f"{parts} finished stay{'s' * (count == 1)} in {here}, and the same command goes on from there"
