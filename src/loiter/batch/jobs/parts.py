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
from loiter.batch.tables.joined import Append
from loiter.batch.tables.storage import Folder

if TYPE_CHECKING:
    from numpy.typing import NDArray

# Called with the number of rows that have been processed.
CountRows = Callable[[int], None]

# Larger than any array of a batch; glibc adapts its threshold to blocks of up to 32 MiB.
KEPT_BYTES = 1 << 24


@dataclass(frozen=True, slots=True)
class Job:
    """The data that solving a part needs, on this or another machine.

    `tables` are the places of the Parquet files to read, and `names` their columns; `parts` is the folder of the parts,
    whose files are of a kind, with the columns of `schema`, some of them encoded with dictionaries. `work` is the
    working folder; `digest` identifies the job, which has `count` parts. `batch_rows` are solved at a time.
    """

    tables: tuple[str, ...]
    names: tuple[str, ...]
    work: Folder
    parts: Folder
    kind: files.Kind
    columns: Columns
    schema: pa.Schema
    dictionaries: tuple[str, ...]
    digest: str
    count: int
    batch_rows: int = BATCH_ROWS

    def name(self, part: Part) -> str:
        """The name of the file of a part."""
        return part_name(part.number, self.count, self.digest, self.kind)


def solve_part(job: Job, part: Part, count_rows: CountRows = lambda rows: None) -> None:
    """Solve the rows of a part and write them to its file, which appears whole and always has the same bytes.

    `count_rows` is called with the number of rows of each batch.
    """
    keep_memory()
    # The job may have ended before its worker, and the folder may now belong to another job.
    with (
        job.parts.create(job.name(part), job.work, lambda: belongs_to(job.work, job.digest)) as path,
        outputs.open_part(job.kind, path, job.schema, job.dictionaries) as write,
    ):
        for batch in files.batches(job.tables, part, job.batch_rows):
            write(solve_batch(batch.select(job.names), job.columns))
            count_rows(batch.num_rows)


def keep_memory() -> None:
    """Make the C library reuse the memory of freed arrays for those of the next batch.

    By default glibc returns large blocks to the operating system, so that every page of the next blocks causes a page
    fault: a quarter of the time of a job. After a block has been freed, glibc keeps all blocks that are smaller
    (mallopt(3), M_MMAP_THRESHOLD). The block freed here is never written to, so it costs nothing.
    """
    np.empty(KEPT_BYTES, dtype=np.uint8)


def is_whole(job: Job, part: Part) -> bool:
    """Whether the file of a part is complete; without fsync(2) its end may be missing after a power failure."""
    try:
        return _has_rows(part, outputs.status_counts(job.kind, job.parts.place(job.name(part))))
    except (OSError, pa.ArrowException):
        return False


def append_part(job: Job, part: Part, append: Append, count_rows: CountRows) -> NDArray[np.int64]:
    """Append a finished part to the output; returns the number of rows of each status, by its code.

    `count_rows` is called with the number of rows. Raises `OSError` if the part is not whole.
    """
    place = job.parts.place(job.name(part))
    counts = outputs.status_counts(job.kind, place)
    if not _has_rows(part, counts):
        raise OSError(f"{place} has {counts.sum()} rows instead of {part.rows}")
    append(place)
    count_rows(part.rows)
    return counts


def _has_rows(part: Part, counts: NDArray[np.int64]) -> bool:
    return int(counts.sum()) == part.rows
