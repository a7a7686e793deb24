"""One part of a job: solved into a file of its own, and appended to the output."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from secrets import token_hex
from typing import TYPE_CHECKING

import numpy as np
import pyarrow as pa

from loiter.batch.answers import solve_batch
from loiter.batch.jobs.folder import belongs_to, part_path
from loiter.batch.tables import files
from loiter.batch.tables.columns import STATUSES, Columns
from loiter.batch.tables.files import BATCH_ROWS, PART_ROWS, Part
from loiter.batch.tables.views import to_numpy

if TYPE_CHECKING:
    from numpy.typing import NDArray

# Called with the number of rows that have been processed.
CountRows = Callable[[int], None]

# Larger than any array of a batch; glibc adapts its threshold to blocks of up to 32 MiB.
KEPT_BYTES = 1 << 24


@dataclass(frozen=True, slots=True)
class Job:
    """The data that solving a part needs, on this or another machine.

    `table` is the Parquet file to read, `folder` the folder of the parts, `schema` their schema; `digest` identifies
    the job. `batch_rows` are solved at a time.
    """

    table: Path
    folder: Path
    columns: Columns
    schema: pa.Schema
    digest: str
    batch_rows: int = BATCH_ROWS


def solve_part(job: Job, part: Part, count_rows: CountRows = lambda rows: None) -> None:
    """Solve the rows of a part and write them to its file, which appears whole and always has the same bytes.

    `count_rows` is called with the number of rows of each batch.
    """
    keep_memory()
    path = part_path(job.folder, part.number)
    # Two workers may solve the same part, if the scheduler wrongly counts one of them as lost.
    unfinished = path.with_name(f"{path.name}.{token_hex(4)}.tmp")
    try:
        with pa.OSFile(str(unfinished), "wb") as sink, pa.ipc.new_file(sink, job.schema) as writer:
            for batch in files.batches(job.table, part, job.batch_rows):
                writer.write_batch(solve_batch(batch, job.columns))
                count_rows(batch.num_rows)
        # The job may have ended before its worker, and the folder may now belong to another job.
        if belongs_to(job.folder, job.digest):
            unfinished.replace(path)
    finally:
        unfinished.unlink(missing_ok=True)


def keep_memory() -> None:
    """Make the C library reuse the memory of freed arrays for those of the next batch.

    By default glibc returns large blocks to the operating system, so that every page of the next blocks causes a page
    fault: a quarter of the time of a job. After a block has been freed, glibc keeps all blocks that are smaller
    (mallopt(3), M_MMAP_THRESHOLD). The block freed here is never written to, so it costs nothing.
    """
    np.empty(KEPT_BYTES, dtype=np.uint8)


def is_whole(path: Path) -> bool:
    """Whether the file of a part is complete; after a power failure its end may be missing."""
    try:
        with pa.memory_map(str(path)) as source:
            pa.ipc.open_file(source)
    except (OSError, pa.ArrowInvalid):
        return False
    return True


def tables(path: Path) -> Iterator[pa.Table]:
    """The rows of a part as tables of up to `PART_ROWS` rows; only one of them is mapped into memory at a time."""
    index, more = 0, True
    while more:
        with pa.memory_map(str(path)) as source:
            reader = pa.ipc.open_file(source)
            batches: list[pa.RecordBatch] = []
            while index < reader.num_record_batches and sum(b.num_rows for b in batches) < PART_ROWS:
                batches.append(reader.get_batch(index))
                index += 1
            more = index < reader.num_record_batches
            yield pa.Table.from_batches(batches, reader.schema)


def append_part(job: Job, part: Part, write: Callable[[pa.Table], None], count_rows: CountRows) -> NDArray[np.int64]:
    """Append the rows of a finished part to the output; returns the number of rows of each status, by its code.

    `count_rows` is called with the number of rows of each table.
    """
    counts = np.zeros(len(STATUSES), dtype=np.int64)
    for table in tables(part_path(job.folder, part.number)):
        write(table)
        for status in table.column("status").chunks:
            counts += np.bincount(to_numpy(status.indices), minlength=len(STATUSES))
        count_rows(table.num_rows)
    return counts
