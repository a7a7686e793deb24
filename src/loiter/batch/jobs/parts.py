"""One part of a job: solved into a file of its own, and read back to be appended to the output."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from secrets import token_hex
from typing import TYPE_CHECKING

import numpy as np
import pyarrow as pa

from loiter.batch.answers import answered
from loiter.batch.jobs.folder import belongs, part_path
from loiter.batch.tables.columns import STATUSES, Columns
from loiter.batch.tables.files import BATCH_ROWS, PART_ROWS, Part, batches
from loiter.batch.tables.views import numbers

if TYPE_CHECKING:
    from numpy.typing import NDArray

Tick = Callable[[int], None]

# Larger than any array of a batch; glibc learns from blocks of up to 32 MiB.
KEPT_BYTES = 1 << 24


@dataclass(frozen=True, slots=True)
class Job:
    """What every part needs to know, here or on another machine.

    `table` is the Parquet file that is read, `folder` where the parts go, `schema` that of the parts; `digest` tells
    the job from others. `batch_rows` are solved at a time; `compiled` is that of `entries`, the same for every part.
    """

    table: Path
    folder: Path
    columns: Columns
    schema: pa.Schema
    digest: str
    batch_rows: int = BATCH_ROWS
    compiled: bool = False


def solve_part(job: Job, part: Part, tick: Tick = lambda rows: None) -> None:
    """Solve the rows of a part into its file, which appears whole; `tick` hears of the rows of each batch.

    Whoever solves it, and however often, writes the same bytes.
    """
    keep_memory()
    path = part_path(job.folder, part.number)
    # Two workers may have the same part in hand, where one of them is taken for lost.
    unfinished = path.with_name(f"{path.name}.{token_hex(4)}.tmp")
    try:
        with pa.OSFile(str(unfinished), "wb") as sink, pa.ipc.new_file(sink, job.schema) as writer:
            for batch in batches(job.table, part, job.batch_rows):
                writer.write_batch(answered(batch, job.columns, job.compiled))
                tick(batch.num_rows)
        # A worker may outlive its job, and its folder be another's by now.
        if belongs(job.folder, job.digest):
            unfinished.replace(path)
    finally:
        unfinished.unlink(missing_ok=True)


def keep_memory() -> None:
    """Let the C library keep what arrays of a batch leave behind for those of the next.

    glibc hands large blocks back to the system when they are freed, and every page of the next ones then costs a fault:
    a quarter of the time of a whole job. It keeps blocks smaller than one that it was given back (mallopt(3),
    M_MMAP_THRESHOLD). This one is never touched, so it costs nothing.
    """
    np.empty(KEPT_BYTES, dtype=np.uint8)


def is_whole(path: Path) -> bool:
    """Whether a part's file has its end; one may lack it after a power failure."""
    try:
        with pa.memory_map(str(path)) as source:
            pa.ipc.open_file(source)
    except (OSError, pa.ArrowInvalid):
        return False
    return True


def tables(path: Path) -> Iterator[pa.Table]:
    """A part's rows as tables of up to `PART_ROWS` rows, each mapped on its own so that no more is in memory."""
    at, more = 0, True
    while more:
        with pa.memory_map(str(path)) as source:
            reader = pa.ipc.open_file(source)
            found: list[pa.RecordBatch] = []
            while at < reader.num_record_batches and sum(b.num_rows for b in found) < PART_ROWS:
                found.append(reader.get_batch(at))
                at += 1
            more = at < reader.num_record_batches
            yield pa.Table.from_batches(found, reader.schema)


def append_part(job: Job, part: Part, write: Callable[[pa.Table], None], tick: Tick) -> NDArray[np.int64]:
    """Append the rows of a finished part to the output; gives the number of rows of each status, by its code.

    `tick` hears of the rows of each table.
    """
    counts = np.zeros(len(STATUSES), dtype=np.int64)
    for table in tables(part_path(job.folder, part.number)):
        write(table)
        for status in table.column("status").chunks:
            counts += np.bincount(numbers(status.indices), minlength=len(STATUSES))
        tick(table.num_rows)
    return counts
