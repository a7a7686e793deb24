"""The folder of a job beside its output: the lock, the description of the job, and the finished parts."""

from __future__ import annotations

import fcntl
import json
import os
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager, suppress
from hashlib import sha256
from pathlib import Path
from typing import Any

from loiter.errors import InvalidArgument
from loiter.writing import write_whole

DESCRIPTION = "job.json"
INGESTED = "input.parquet"
LOCK = "lock"
OUTPUT = "output.tmp"

# The files that a job writes to its folder. No other files are deleted.
_UNFINISHED = ("*.tmp", ".*.part")
_FINISHED = ("part-*.arrow", INGESTED)


def folder_of(target: Path) -> Path:
    """The folder OUT.parts beside OUT, on the same file system, so that the output can be renamed to OUT."""
    return target.absolute().with_name(f"{target.name}.parts")


def part_path(folder: Path, number: int) -> Path:
    """The path of a finished part."""
    return folder / f"part-{number:05}.arrow"


@contextmanager
def locked_folder(target: Path) -> Iterator[Path]:
    """The folder of the job that writes `target`, created and locked; removed afterwards if it has no finished parts.

    Raises `InvalidArgument` if it cannot be created, and if another process has locked it.
    """
    folder = folder_of(target)
    try:
        lock = _lock(folder)
    except BlockingIOError as error:
        raise InvalidArgument("target", f"is {str(target)!r}: another loiter batch is writing it") from error
    except OSError as error:
        problem = f"is {str(target)!r}: its working folder {folder.name} cannot be created, {error.strerror}"
        raise InvalidArgument("target", problem) from error
    try:
        _delete(folder, _UNFINISHED)
        yield folder
    finally:
        _delete(folder, _UNFINISHED)
        if not any(_matching(folder, _FINISHED)):
            _remove(folder)
        os.close(lock)


def _lock(folder: Path) -> int:
    """Create a folder if it does not exist, and lock it; returns the file descriptor of the lock."""
    while True:
        folder.mkdir(exist_ok=True)
        with suppress(FileNotFoundError):
            lock = os.open(folder / LOCK, os.O_RDWR | os.O_CREAT | os.O_CLOEXEC, 0o666)
            try:
                fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
                # A process that had locked the folder may have removed the file when it ended.
                if os.path.samestat(os.fstat(lock), (folder / LOCK).stat()):
                    return lock
            except OSError:
                os.close(lock)
                raise
            os.close(lock)


def resume(folder: Path, description: dict[str, Any]) -> bool | None:
    """Prepare the folder for a job with a description: keep the parts of the same job, delete those of another.

    Returns True for parts of the same job, False for deleted parts of another one, None if there were none.
    """
    has_parts = any(_matching(folder, _FINISHED))
    if has_parts and _read_description(folder) == description:
        return True
    _delete(folder, _FINISHED)
    write_whole("target", folder / DESCRIPTION, lambda file: file.write(_description_bytes(description)))
    return False if has_parts else None


def digest(description: dict[str, Any]) -> str:
    """A digest of the description of a job, which identifies it."""
    return sha256(_description_bytes(description)).hexdigest()


def belongs_to(folder: Path, job_digest: str) -> bool:
    """Whether the folder still belongs to the job with this digest."""
    try:
        return sha256((folder / DESCRIPTION).read_bytes()).hexdigest() == job_digest
    except FileNotFoundError:
        return False


def finish(folder: Path, target: Path, workers: int) -> None:
    """Move the output to its place and delete the finished parts, with several threads, since large files take time."""
    (folder / OUTPUT).replace(target)
    with ThreadPoolExecutor(workers) as pool:
        list(pool.map(Path.unlink, list(_matching(folder, _FINISHED))))


def finished_parts(folder: Path) -> list[Path]:
    """The files of the finished parts."""
    return sorted(folder.glob("part-*.arrow"))


def _description_bytes(description: dict[str, Any]) -> bytes:
    return (json.dumps(description, indent=1, sort_keys=True) + "\n").encode()


def _read_description(folder: Path) -> Any:
    try:
        return json.loads((folder / DESCRIPTION).read_bytes())
    except (OSError, ValueError):
        return None


def _matching(folder: Path, patterns: tuple[str, ...]) -> Iterator[Path]:
    for pattern in patterns:
        yield from folder.glob(pattern)


def _delete(folder: Path, patterns: tuple[str, ...]) -> None:
    for path in list(_matching(folder, patterns)):
        path.unlink(missing_ok=True)


def _remove(folder: Path) -> None:
    """Remove the folder, unless it has files that no job wrote."""
    _delete(folder, (DESCRIPTION, LOCK))
    with suppress(OSError):
        folder.rmdir()
