"""Where tables lie: files on this machine, or behind URLs such as s3://bucket/states.parquet, through `pyarrow.fs`.

Files appear whole or not at all: on this machine under a temporary name, which is renamed after fsync(2); behind a URL
by one upload of a local file, which the store shows only once it is complete.
"""

from __future__ import annotations

import errno
import os
import re
from collections.abc import Iterable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass, replace
from glob import has_magic
from pathlib import Path, PurePosixPath
from secrets import token_hex
from tempfile import TemporaryDirectory
from typing import Any

import pyarrow as pa
from pyarrow import fs

from loiter.errors import InvalidArgument, MissingPackage

KINDS = (".parquet", ".csv", ".csv.gz")

# The schemes of URLs whose uploads appear whole or not at all, and the packages that fsspec needs for those that
# Arrow does not have itself.
SCHEMES = {"s3": "", "gs": "", "gcs": "", "az": "adlfs", "abfs": "adlfs", "memory": ""}

# The folder in which Spark and this program keep what is needed only until a dataset is complete, and the empty file
# that says that it is.
TEMPORARY, SUCCESS = "_temporary", "_SUCCESS"

# What is said about endings that are not in `KINDS`.
ENDINGS = {
    "source": "the file name must end in .parquet, .csv or .csv.gz",
    "target": "the name must end in .parquet, .csv or .csv.gz, or in / for a folder of Parquet files",
}

# What fsync(2) says where a file system does not have it.
NO_FSYNC = {errno.EINVAL, errno.ENOTSUP, errno.ENOSYS}

# What the libraries raise where files cannot be read or written.
FILE_ERRORS = (OSError, ValueError, pa.ArrowException)


@dataclass(frozen=True)
class Place:
    """A file or a folder: its path in a file system, and the text that messages show."""

    store: fs.FileSystem
    path: str
    text: str

    @property
    def is_local(self) -> bool:
        """Whether it is on this machine, or on a network file system."""
        return isinstance(self.store, fs.LocalFileSystem)

    @property
    def info(self) -> fs.FileInfo:
        """Its kind, its size and the time when it was written."""
        return self.store.get_file_info(self.path)

    @property
    def modified(self) -> str:
        """When it was written."""
        if isinstance(self.store, fs.PyFileSystem):
            return str(self.store.handler.fs.modified(self.path))
        return str(self.info.mtime_ns)

    @property
    def exists(self) -> bool:
        """Whether there is a file or a folder."""
        return bool(self.info.type != fs.FileType.NotFound)

    @property
    def name(self) -> str:
        """The last part of its path."""
        return PurePosixPath(self.path).name

    def is_same(self, other: Place) -> bool:
        """Whether another place is the same file."""
        if self.is_local and other.is_local and self.exists and other.exists:
            return Path(self.path).samefile(other.path)
        return bool(self.store == other.store and self.path == other.path)

    def open(self) -> Any:
        """The file, opened for reading bytes at any position."""
        return self.store.open_input_file(self.path)

    def below(self, name: str) -> Place:
        """A file or a folder in this folder."""
        return replace(self, path=f"{self.path.rstrip('/')}/{name}", text=f"{self.text.rstrip('/')}/{name}")

    def beside(self, name: str) -> Place:
        """A file or a folder in the same folder."""
        folder, _, _ = self.path.rpartition("/")
        return replace(self, path=f"{folder}/{name}", text=self.text[: len(self.text) - len(self.name)] + name)

    def files(self, *, recursive: bool = False) -> list[str]:
        """The names of the files and folders in this folder, relative to it; none if it does not exist."""
        found = self.store.get_file_info(fs.FileSelector(self.path, allow_not_found=True, recursive=recursive))
        kept = [each for each in found if not recursive or each.is_file]
        return sorted(str(PurePosixPath(each.path).relative_to(PurePosixPath(self.path))) for each in kept)

    def create_folder(self) -> None:
        """Create a folder on this machine, in one that exists; stores have none."""
        if self.is_local:
            Path(self.path).mkdir(exist_ok=True)

    def delete_files(self, names: Iterable[str]) -> None:
        """Delete files of this folder, if they exist, the last name first."""
        for name in sorted(names, reverse=True):
            with suppress(FileNotFoundError):
                self.store.delete_file(self.below(name).path)

    def remove_if_empty(self) -> None:
        """Remove this folder if nothing is in it."""
        with suppress(OSError):
            if self.is_local:
                Path(self.path).rmdir()
            elif not self.files():
                self.store.delete_dir(self.path)


def locate(argument: str, text: str) -> Place:
    """The file or folder that a path or a URL names; raises `InvalidArgument`, or `MissingPackage` for a store."""
    scheme = re.match(r"([A-Za-z][A-Za-z0-9+.-]*)://", text)
    if scheme is None:
        return Place(fs.LocalFileSystem(), str(Path(text).absolute()), text)
    if scheme[1] not in SCHEMES:
        known = ", ".join(f"{name}://" for name in SCHEMES)
        raise InvalidArgument(argument, f"is {text!r}: a URL must begin with one of {known}")
    try:
        return Place(*_store(text), text)
    except ImportError as error:
        package = SCHEMES[scheme[1]]
        raise MissingPackage(f"tables behind {scheme[1]}:// need {package}: pip install {package} brings it") from error
    except FILE_ERRORS as error:
        raise InvalidArgument(argument, f"is {text!r}: {reason(error)}") from error


def _store(url: str) -> tuple[fs.FileSystem, str]:
    """The file system of a URL, and the path in it: Arrow's own, or else that of fsspec."""
    if not url.startswith(("az://", "abfs://", "memory://")):
        # What is in a URL is literal, also a % or a blank, which Arrow would decode or refuse.
        scheme, _, path = url.partition("://")
        bucket, _, key = path.partition("/")
        # A quarter of an hour, the time for which Arrow tries again without an answer of Google, is too long.
        query = "?retry_limit_seconds=60" if scheme in ("gs", "gcs") else ""
        store, found = fs.FileSystem.from_uri(f"{scheme}://{bucket}{query}")
        return store, f"{found}/{key}".rstrip("/")
    from fsspec.core import url_to_fs

    store, path = url_to_fs(url)
    return fs.PyFileSystem(fs.FSSpecHandler(store)), path


def kind_of(name: str) -> str | None:
    """The ending of a name in `KINDS`; None for another one."""
    return next((kind for kind in KINDS if name.lower().endswith(kind) and len(name) > len(kind)), None)


def kind(argument: str, place: Place) -> str:
    """The ending of a file's name in `KINDS`; raises `InvalidArgument` for another one."""
    found = kind_of(place.name)
    if found is None:
        raise InvalidArgument(argument, f"is {place.text!r}: {ENDINGS[argument]}")
    return found


def reason(error: BaseException) -> str:
    """The reason in words why a file could not be read or written."""
    # Stores may say only which file they do not have.
    number = getattr(error, "errno", None) or (errno.ENOENT if isinstance(error, FileNotFoundError) else None)
    if number:
        return os.strerror(number)
    first_line, _, _ = str(error).strip().partition("\n")
    return first_line.rstrip(".") or type(error).__name__


def unreadable(argument: str, place: Place, error: BaseException) -> InvalidArgument:
    """The error to raise for a file that cannot be read."""
    return InvalidArgument(argument, f"is {place.text!r}: it cannot be read, {reason(error)}")


@contextmanager
def create(place: Place, work: Place) -> Iterator[str]:
    """A context whose value is a local path to write; the file appears at `place` when it ends without an error.

    `work` is a folder for temporary files on the same file system.
    """
    if not place.is_local:
        with TemporaryDirectory() as folder:
            local = f"{folder}/{place.name}"
            yield local
            fs.copy_files(local, place.path, fs.LocalFileSystem(), place.store)
            # Some uploads that fail raise no error.
            if place.info.size != Path(local).stat().st_size:
                raise OSError(f"{place.text} was not uploaded")
        return
    # A random name: two processes may write the same file.
    unfinished = Path(work.path, f".{token_hex(4)}-{place.name}")
    try:
        yield str(unfinished)
        _synchronise(unfinished)
        unfinished.replace(place.path)
        _synchronise(Path(place.path).parent)
    finally:
        unfinished.unlink(missing_ok=True)


def _synchronise(path: Path) -> None:
    """Wait until a file, or the list of the names in a folder, is on the disk, where the file system can say so."""
    handle = os.open(path, os.O_RDONLY)
    try:
        os.fsync(handle)
    except OSError as error:
        if error.errno not in NO_FSYNC:
            raise
    finally:
        os.close(handle)


@contextmanager
def local_copy(place: Place) -> Iterator[str]:
    """A context whose value is a local path of a file, without characters that make a pattern of it."""
    if place.is_local and not has_magic(place.path):
        yield place.path
        return
    with TemporaryDirectory() as folder:
        local = f"{folder}/table{kind_of(place.name)}"
        if place.is_local:
            Path(local).symlink_to(place.path)
        else:
            fs.copy_files(place.path, local, place.store, fs.LocalFileSystem())
        yield local


@dataclass(frozen=True)
class Source:
    """An input as it was given: its files in order, and their kind; `folder` if it is one."""

    text: str
    files: tuple[Place, ...]
    kind: str
    folder: Place | None = None

    def versions(self) -> list[tuple[str, int, str]]:
        """Path, size and time of each file."""
        return [(place.path, place.info.size, place.modified) for place in self.files]


def find_source(argument: str, text: str) -> Source:
    """The files of the input `text`; raises `InvalidArgument` if there are none, or if they cannot be one table."""
    place = locate(argument, text)
    try:
        if place.info.type == fs.FileType.Directory:
            found = _files_below(place)
            if not found:
                raise OSError("there is no file in it")
            return Source(text, found, _common_kind(argument, text, found), place)
        if text.endswith("/") and not has_magic(text):
            raise InvalidArgument(argument, f"is {text!r}: there is no such folder, or there is nothing in it")
        if place.exists or not has_magic(text):
            found_kind = kind(argument, place)
            place.open().close()
            return Source(text, (place,), found_kind)
        found = _matches(place)
    except FILE_ERRORS as error:
        if isinstance(error, InvalidArgument):
            raise
        raise unreadable(argument, place, error) from error
    if not found:
        raise InvalidArgument(argument, f"is {text!r}: no file matches")
    return Source(text, found, _common_kind(argument, text, found))


def _matches(pattern: Place) -> tuple[Place, ...]:
    """The files, and the files of the folders, that match a pattern, in the order of their names."""
    from fsspec.implementations.arrow import ArrowFSWrapper

    found: list[Place] = []
    for path in ArrowFSWrapper(pattern.store).glob(pattern.path):
        place = replace(pattern, path=path, text=path)
        found += _files_below(place) if place.info.type == fs.FileType.Directory else [place]
    return _in_order(found)


def _files_below(folder: Place) -> tuple[Place, ...]:
    """The files in a folder and its subfolders, without those that readers of datasets ignore."""
    names = folder.files(recursive=True)
    for name in names:
        *parents, _ = PurePosixPath(name).parts
        if TEMPORARY in parents and SUCCESS not in names:
            raise OSError(f"the dataset is not finished: it has a folder {TEMPORARY}")
        if any("=" in parent for parent in parents):
            raise OSError(f"it has a folder {parents[0]}, and columns in the names of folders are not read")
    kept = [name for name in names if not any(part.startswith(("_", ".")) for part in PurePosixPath(name).parts)]
    return _in_order([folder.below(name) for name in kept])


def _in_order(places: list[Place]) -> tuple[Place, ...]:
    """Places by name, with numbers by value: part.2.parquet comes before part.10.parquet, as Dask numbers it."""

    def pieces(place: Place) -> list[tuple[int, str]]:
        split = re.split(r"(\d+)", place.path)
        return [(int(piece), "") if i % 2 else (0, piece) for i, piece in enumerate(split)]

    return tuple(sorted(places, key=pieces))


def _common_kind(argument: str, text: str, places: tuple[Place, ...]) -> str:
    kinds: dict[str | None, str] = {}
    for place in places:
        kinds.setdefault(kind_of(place.name), place.name)
    if None in kinds:
        raise InvalidArgument(argument, f"is {text!r}: {kinds[None]} is not .parquet, .csv or .csv.gz")
    if len(kinds) > 1:
        first, second, *_ = kinds.values()
        raise InvalidArgument(argument, f"is {text!r}: {first} and {second} are files of different kinds")
    [only] = kinds
    return str(only)


@dataclass(frozen=True)
class Target:
    """An output: a file of a kind, or a dataset, a folder of Parquet files.

    `work` holds what is needed only until the output is complete: OUT.parts beside the file OUT, or OUT/_temporary.
    """

    place: Place
    kind: str
    is_dataset: bool

    @property
    def work(self) -> Place:
        """The working folder, on the same file system, so that files can be renamed."""
        return self.place.below(TEMPORARY) if self.is_dataset else self.place.beside(f"{self.place.name}.parts")

    @property
    def parts(self) -> Place:
        """The folder of the finished parts."""
        return self.place if self.is_dataset else self.work


def find_target(argument: str, text: str) -> Target:
    """The output `text`: a dataset if it ends in a slash or is a folder, otherwise a file; raises `InvalidArgument`."""
    place = locate(argument, text)
    try:
        is_folder = place.info.type == fs.FileType.Directory
    except FILE_ERRORS as error:
        raise InvalidArgument(argument, f"is {text!r}: it cannot be written, {reason(error)}") from error
    # Spark and Dask name folders, too, entries.parquet.
    if text.endswith("/") or (is_folder and kind_of(place.name) in (None, ".parquet")):
        return Target(place, ".parquet", is_dataset=True)
    found = kind(argument, place)
    if is_folder:
        raise InvalidArgument(argument, f"is {text!r}: that is a folder")
    return Target(place, found, is_dataset=False)
