"""The folder beside the output where a job keeps what it has finished: its lock, its description, its files."""

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

# What a job writes here. Nothing else is ever deleted.
_UNFINISHED = ("*.tmp", ".*.part")
_FINISHED = ("part-*.arrow", INGESTED)


def folder_of(target: Path) -> Path:
    """OUT.parts, beside OUT: on the same file system, so that the output can be renamed into its place."""
    return target.absolute().with_name(f"{target.name}.parts")


def part_path(folder: Path, number: int) -> Path:
    """Where a finished part is."""
    return folder / f"part-{number:05}.arrow"


@contextmanager
def held(target: Path) -> Iterator[Path]:
    """The folder of the job that writes `target`, made and locked; gone afterwards where nothing in it is of use.

    Raises `InvalidArgument` where it cannot be made or another process holds it.
    """
    folder = folder_of(target)
    try:
        lock = _locked(folder)
    except BlockingIOError as error:
        raise InvalidArgument("target", f"is {str(target)!r}: another loiter batch is at work on it") from error
    except OSError as error:
        problem = f"is {str(target)!r}: its working folder {folder.name} cannot be made, {error.strerror}"
        raise InvalidArgument("target", problem) from error
    try:
        _delete(folder, _UNFINISHED)
        yield folder
    finally:
        _delete(folder, _UNFINISHED)
        if not any(_matching(folder, _FINISHED)):
            _remove(folder)
        os.close(lock)


def _locked(folder: Path) -> int:
    """The file descriptor of the lock of a folder, which is made where it is missing."""
    while True:
        folder.mkdir(exist_ok=True)
        with suppress(FileNotFoundError):
            lock = os.open(folder / LOCK, os.O_RDWR | os.O_CREAT | os.O_CLOEXEC, 0o666)
            try:
                fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
                # Who held it until now may have removed it when it was done.
                if os.path.samestat(os.fstat(lock), (folder / LOCK).stat()):
                    return lock
            except OSError:
                os.close(lock)
                raise
            os.close(lock)


def resumed(folder: Path, description: dict[str, Any]) -> bool | None:
    """Take up what the folder holds: True where it is of the same job, False where it was of another and is deleted.

    None where there was nothing.
    """
    there = any(_matching(folder, _FINISHED))
    if there and _read(folder) == description:
        return True
    _delete(folder, _FINISHED)
    write_whole("target", folder / DESCRIPTION, lambda file: file.write(_written(description)))
    return False if there else None


def digest(description: dict[str, Any]) -> str:
    """What tells one job from another."""
    return sha256(_written(description)).hexdigest()


def belongs(folder: Path, job: str) -> bool:
    """Whether the folder is still that of the job with this digest."""
    try:
        return sha256((folder / DESCRIPTION).read_bytes()).hexdigest() == job
    except FileNotFoundError:
        return False


def finish(folder: Path, target: Path, workers: int) -> None:
    """Put the output in its place, and remove what led to it, which for large files is work for several threads."""
    (folder / OUTPUT).replace(target)
    with ThreadPoolExecutor(workers) as pool:
        list(pool.map(Path.unlink, list(_matching(folder, _FINISHED))))


def finished_parts(folder: Path) -> list[Path]:
    """The files of the parts that are finished."""
    return sorted(folder.glob("part-*.arrow"))


def _written(description: dict[str, Any]) -> bytes:
    return (json.dumps(description, indent=1, sort_keys=True) + "\n").encode()


def _read(folder: Path) -> Any:
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
    """Remove the folder, where nobody else put a file into it."""
    _delete(folder, (DESCRIPTION, LOCK))
    with suppress(OSError):
        folder.rmdir()
