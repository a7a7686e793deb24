"""The working folder of a job: the lock, the description of the job, and what is needed only until the job ends.

It is OUT.parts beside the file OUT, or OUT/_temporary in the dataset OUT/. The finished parts of a file lie in the
working folder, those of a dataset in OUT/ itself.
"""

from __future__ import annotations

import fcntl
import json
import os
import re
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from hashlib import sha256
from pathlib import Path
from typing import Any, NamedTuple

from loiter.batch.tables import files, sources, storage
from loiter.batch.tables.sources import SUCCESS, TEMPORARY
from loiter.batch.tables.storage import Folder, synchronise
from loiter.errors import InvalidArgument

DESCRIPTION = "job.json"
INGESTED = "input.parquet"
# What is known of the CSV files that it is made from, and their malformed lines.
INFERRED, REJECTED = "input.json", "rejected.csv"
LOCK = "lock"

# Hexadecimal digits of the digest of a job in the names of its parts.
_DIGITS = 8

_PART = re.compile(rf"part-(\d+)-([0-9a-f]{{{_DIGITS}}})\.parquet")


class Target(NamedTuple):
    """An output as it was given: the file `name` in a folder, or without a name the dataset in the folder itself."""

    text: str
    folder: Folder
    name: str
    kind: files.Kind

    @property
    def is_dataset(self) -> bool:
        """Whether the output is a folder of Parquet files."""
        return not self.name

    @property
    def work(self) -> Folder:
        """The working folder, on the same file system as the output, so that files can be renamed."""
        return self.folder.subfolder(TEMPORARY if self.is_dataset else f"{self.name}.parts")

    @property
    def parts(self) -> Folder:
        """The folder of the finished parts."""
        return self.folder if self.is_dataset else self.work


def find_target(argument: str, text: str) -> Target:
    """The output `text`: a dataset if it ends in a slash or is a folder, otherwise a file; raises `InvalidArgument`."""
    storage.check_place(argument, text)
    try:
        with storage.os_errors():
            is_folder = sources.is_folder(text)
    except OSError as error:
        raise InvalidArgument(argument, f"is {text!r}: it cannot be written, {files.reason(error)}") from error
    # Spark and Dask name folders, too, entries.parquet.
    if text.endswith("/") or (is_folder and files.kind_of(text) in (None, ".parquet")):
        return Target(text, storage.folder_at(text), "", ".parquet")
    kind = files.kind(argument, text)
    if is_folder:
        raise InvalidArgument(argument, f"is {text!r}: that is a folder")
    folder, name = storage.split(text)
    return Target(text, folder, name, kind)


def part_name(number: int, count: int, digest: str) -> str:
    """The name of a finished part, which says to which job it belongs; the names sort in the order of the rows."""
    return f"part-{number:0{max(5, len(str(count - 1)))}}-{digest[:_DIGITS]}.parquet"


@contextmanager
def locked_folder(target: Target) -> Iterator[Folder]:
    """The working folder of a job, created and locked; removed afterwards if no part is finished.

    Raises `InvalidArgument` if it cannot be created, and if another process has locked it. There are no locks behind
    a URL: two processes would write the same files.
    """
    work = target.work
    if work.path is None:
        try:
            yield work
        finally:
            # A store that does not answer any more has been reported.
            with suppress(OSError):
                _clean_up(target)
        return
    was_there = target.is_dataset and work.path.parent.exists()
    lock = _lock_or_refuse(target, work.path)
    try:
        _delete_unfinished(work)
        yield work
    finally:
        _delete_unfinished(work)
        _clean_up(target)
        if target.is_dataset and not was_there:
            with suppress(OSError):
                work.path.parent.rmdir()
        os.close(lock)


def _lock_or_refuse(target: Target, work: Path) -> int:
    try:
        return _lock(target, work)
    except BlockingIOError as error:
        raise InvalidArgument("target", f"is {target.text!r}: another loiter batch is writing it") from error
    except OSError as error:
        problem = f"is {target.text!r}: its working folder {work.name} cannot be created, {error.strerror}"
        raise InvalidArgument("target", problem) from error


def _lock(target: Target, work: Path) -> int:
    """Create the working folder if it does not exist, and lock it; returns the file descriptor of the lock."""
    while True:
        _create(work.parent if target.is_dataset else work)
        # A process that had locked the folder may remove it when it ends.
        with suppress(FileNotFoundError):
            _create(work)
            lock = os.open(work / LOCK, os.O_RDWR | os.O_CREAT | os.O_CLOEXEC, 0o666)
            try:
                fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
                if os.path.samestat(os.fstat(lock), (work / LOCK).stat()):
                    return lock
            except OSError:
                os.close(lock)
                raise
            os.close(lock)


def _create(path: Path) -> None:
    """Create a folder on the disk, if it does not exist."""
    try:
        path.mkdir()
    except FileExistsError:
        if not path.is_dir():
            raise
    else:
        synchronise(path.parent)


def check_dataset(target: Target, digest: str) -> None:
    """Raise `InvalidArgument` if the folder of a dataset has files that are not of the job with this digest."""
    if not target.is_dataset:
        return
    others = [name for name in target.folder.names() if not _is_expected(name, digest)]
    if not others:
        return
    number = "a file" if len(others) == 1 else f"{len(others)} files, such as"
    if all(_PART.fullmatch(name) for name in others):
        problem = f"it has parts of a job with another input, option or program, such as {others[0]}"
    else:
        problem = f"it has {number} {others[0]}, which this job did not write"
    raise InvalidArgument("target", f"is {target.text!r}: {problem}; empty it or choose another folder")


def _is_expected(name: str, digest: str) -> bool:
    # Readers ignore names that begin with a dot.
    return name in (TEMPORARY, SUCCESS) or name.startswith(".") or _is_part(name, digest)


def _is_scratch(name: str) -> bool:
    """Whether a file of the working folder is needed only until the output is complete."""
    return name in (INGESTED, INFERRED, REJECTED) or _PART.fullmatch(name) is not None


def _is_part(name: str, digest: str) -> bool:
    match = _PART.fullmatch(name)
    return match is not None and match[2] == digest[:_DIGITS]


def resume(target: Target, description: dict[str, Any]) -> bool | None:
    """Prepare the working folder for a job with a description: keep what the same job left, delete what another did.

    Returns True for parts of the same job, False for deleted parts of another one, None if there were none. Raises
    `InvalidArgument` instead of deleting parts of a dataset.
    """
    work, identity = target.work, digest(description)
    check_dataset(target, identity)
    left = [name for name in work.names() if _is_scratch(name)]
    if belongs_to(work, identity):
        return True if left else None
    work.delete(left)
    work.write(DESCRIPTION, _description_bytes(description), work)
    return False if left else None


def digest(description: dict[str, Any]) -> str:
    """A digest of the description of a job, which identifies it."""
    return sha256(_description_bytes(description)).hexdigest()


def belongs_to(work: Folder, job_digest: str) -> bool:
    """Whether the working folder still belongs to the job with this digest."""
    try:
        return sha256(work.read(DESCRIPTION)).hexdigest() == job_digest
    except OSError:
        return False


def declare_unfinished(target: Target) -> None:
    """Delete the file that says that the dataset is complete, before parts of it are written again."""
    if target.is_dataset:
        target.folder.delete([SUCCESS])


def is_complete(target: Target) -> bool:
    """Whether the target is a dataset that says that all its parts are there."""
    return target.is_dataset and SUCCESS in target.folder.names()


def finish(target: Target) -> None:
    """Say that the dataset is complete, or delete the parts of a file; the working folder is removed afterwards."""
    if target.is_dataset:
        target.folder.write(SUCCESS, b"", target.work)
    target.work.delete([name for name in target.work.names() if _is_scratch(name)])


def finished_parts(target: Target) -> list[str]:
    """The names of the finished parts."""
    return [name for name in target.parts.names() if _PART.fullmatch(name)]


def _description_bytes(description: dict[str, Any]) -> bytes:
    return (json.dumps(description, indent=1, sort_keys=True) + "\n").encode()


def _delete_unfinished(work: Folder) -> None:
    work.delete(name for name in work.names() if name.endswith(".tmp"))


def _clean_up(target: Target) -> None:
    """Remove the working folder, unless a job can resume from it, and unless it has files that no job wrote."""
    work = target.work
    if INGESTED in work.names() or (finished_parts(target) and not is_complete(target)):
        return
    work.delete([DESCRIPTION, LOCK])
    if work.path is not None:
        with suppress(OSError):
            work.path.rmdir()
