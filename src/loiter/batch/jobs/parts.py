"""One part of a job: solved into a file of its own, by the worker that solves it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import pyarrow as pa

from loiter.batch.answers import solve_batch
from loiter.batch.jobs.folder import belongs_to, part_name
from loiter.batch.tables import files, outputs
from loiter.batch.tables.columns import Columns
from loiter.batch.tables.files import BATCH_ROWS, Part
from loiter.batch.tables.storage import Folder

if TYPE_CHECKING:
    from loiter.batch.tables.outputs import Counts, Write

# Called with the number of rows that have been processed.
CountRows = Callable[[int], None]

# Larger than any array of a batch; glibc adapts its threshold to blocks of up to 32 MiB.
KEPT_BYTES = 1 << 24


@dataclass(frozen=True)
class Job:
    """The data that solving a part needs, on this or another machine.

    `tables` are the places of the Parquet files to read, and `names` their columns; `parts` is the folder of the parts,
    which have the columns of `schema`. `work` is the working folder; `digest` identifies the job, which has `count`
    parts. `batch_rows` are solved at a time.
    """

    tables: tuple[str, ...]
    names: tuple[str, ...]
    work: Folder
    parts: Folder
    columns: Columns
    schema: pa.Schema
    digest: str
    count: int
    batch_rows: int = BATCH_ROWS

    def name(self, part: Part) -> str:
        """The name of the file of a part."""
        return part_name(part.number, self.count, self.digest)


def solve_part(job: Job, part: Part, count_rows: CountRows = lambda rows: None) -> Counts:
    """Solve the rows of a part and write them to its file, which appears whole and always has the same bytes.

    Returns the number of rows of each status, by its code. `count_rows` is called with the number of rows of each
    batch.
    """
    keep_memory()
    counts = outputs.no_rows()
    # The job may have ended before its worker, and the folder may now belong to another job.
    with (
        job.parts.create(job.name(part), job.work, lambda: belongs_to(job.work, job.digest)) as path,
        outputs.open_parquet_output(path, job.schema) as write,
    ):
        for batch in files.batches(job.tables, part, job.batch_rows):
            solved = solve_batch(batch.select(job.names), job.columns, job.schema)
            write(solved)
            counts += outputs.count_statuses(solved.column("status"))
            count_rows(batch.num_rows)
    return counts


def keep_memory() -> None:
    """Make the C library reuse the memory of freed arrays for those of the next batch.

    By default glibc returns large blocks to the operating system, so that every page of the next blocks causes a page
    fault: a quarter of the time of a job. After a block has been freed, glibc keeps all blocks that are smaller
    (mallopt(3), M_MMAP_THRESHOLD). The block freed here is never written to, so it costs nothing.
    """
    np.empty(KEPT_BYTES, dtype=np.uint8)


def counts_of(job: Job, part: Part) -> Counts:
    """The number of rows of each status, by its code, in a finished part; raises `OSError` if the part is not whole."""
    place = job.parts.place(job.name(part))
    try:
        counts = outputs.status_counts(place)
    except pa.ArrowException as error:
        raise OSError(f"{place} cannot be read, {files.reason(error)}") from error
    if int(counts.sum()) != part.rows:
        raise OSError(f"{place} has {counts.sum()} rows instead of {part.rows}")
    return counts


def append_part(job: Job, part: Part, write: Write, count_rows: CountRows) -> None:
    """Write the rows of a finished part to the output; `count_rows` is called with the number of rows of each batch."""
    with files.open_parquet(job.parts.place(job.name(part))) as file:
        for batch in file.iter_batches(BATCH_ROWS, use_threads=False):
            write(batch)
            count_rows(batch.num_rows)
