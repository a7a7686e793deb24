"""A job to do: its files and the meaning of their columns, checked as far as possible before any work."""

from __future__ import annotations

from dataclasses import asdict
from pathlib import Path
from typing import Any, NamedTuple

import pyarrow as pa

from loiter.batch.jobs import folder
from loiter.batch.jobs.folder import Target
from loiter.batch.tables import files, ingest, outputs, storage
from loiter.batch.tables.columns import Columns, SharedValues, columns, may_take_long
from loiter.batch.tables.sources import Source, find_source
from loiter.errors import InvalidArgument
from loiter.version import __version__
from loiter.writing import check_writable


class JobRequest(NamedTuple):
    """A job to do: its files, the schema of the input and the meaning of its columns.

    `versions` are those of the files of the input, and `sizes` the numbers of rows of their row groups, by file.
    `rejects` is where the malformed lines of CSV files are to be written, if anywhere.
    """

    source: Source
    target: Target
    versions: list[list[Any]]
    sizes: list[list[int]]
    schema: pa.Schema
    columns: Columns
    rejects: Path | None = None


def check_request(source: str, target: str, options: SharedValues, rejects: Path | None = None) -> JobRequest:
    """The job to do, checked as far as possible before any work; raises `InvalidArgument`."""
    found, output = find_source("source", source), folder.find_target("target", target)
    versions, sizes = versions_of(found), []
    is_text = found.kind != ".parquet"
    if rejects is not None:
        if not is_text:
            raise InvalidArgument("rejects", "is for CSV files: a Parquet file has no malformed lines")
        check_writable("rejects", rejects)
    if is_text:
        schema = ingest.csv_schema("source", found)
    else:
        footers = files.read_footers("source", found.files, found.shown)
        schema = files.common_schema("source", found.files, [footer.schema for footer in footers])
        sizes = [footer.sizes for footer in footers]
    meaning = columns("source", schema, options, text=is_text)
    outputs.check_columns(output.kind, outputs.output_schema(schema, meaning))
    _check_apart(found, output)
    if rejects is not None:
        _check_rejects_apart(rejects, found, output)
    return JobRequest(found, output, versions, sizes, schema, meaning, rejects)


def versions_of(source: Source) -> list[list[Any]]:
    """The size and the version of each file of the input."""
    versions = []
    for place in source.files:
        try:
            versions.append(storage.version_of(place))
        except OSError as error:
            raise files.unreadable("source", source.shown(place), error) from error
    return versions


def _check_apart(source: Source, target: Target) -> None:
    """Raise `InvalidArgument` if the output is a file of the input, or lies in the folder of the input."""
    place = target.folder.place(target.name).rstrip("/")
    if any(storage.is_same_file(place, file) for file in source.files):
        problem = "that is the input" if len(source.files) == 1 else "that is a file of the input"
    elif source.folder is not None and f"{place}/".startswith(f"{source.folder}/"):
        problem = "that is in the folder of the input"
    else:
        return
    raise InvalidArgument("target", f"is {target.text!r}: {problem}")


def _check_rejects_apart(rejects: Path, source: Source, target: Target) -> None:
    others = {storage.resolve(place) for place in (*source.files, target.folder.place(target.name).rstrip("/"))}
    if storage.resolve(str(rejects)) in others:
        raise InvalidArgument("rejects", f"is {str(rejects)!r}: that is the input or the output")


def row_limits(request: JobRequest) -> tuple[int, int]:
    """The number of rows of a part and of a batch."""
    if may_take_long(request.columns):
        return files.PART_ROWS_IN_WIND, files.BATCH_ROWS_IN_WIND
    return files.PART_ROWS, files.BATCH_ROWS


def describe(request: JobRequest) -> dict[str, Any]:
    """The description of a job: a run resumes from the parts of an earlier run with an equal description."""
    part_rows, batch_rows = row_limits(request)
    return {
        "program": __version__,
        "files": [
            {"file": storage.resolve(file), "size": size, "version": version}
            for file, (size, version) in zip(request.source.files, request.versions, strict=True)
        ],
        "output": request.target.kind,
        "schema": [f"{field.name}: {field.type}" for field in request.schema],
        "columns": asdict(request.columns),
        "part_rows": part_rows,
        "batch_rows": batch_rows,
    }
