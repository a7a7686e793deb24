"""Where tables lie: in files on this machine, or behind URLs such as s3://bucket/states.parquet.

A place is a path or a URL, as text. Files are written whole or not at all: on this machine under a temporary name,
which is renamed after fsync(2); behind a URL by one upload, which the store shows only once it is complete.
fsspec's transactions are not used: they rename local files without fsync, and show all parts at the end at once.
"""

from __future__ import annotations

import errno
import os
import re
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from secrets import token_hex
from tempfile import TemporaryFile
from typing import Any

from loiter.errors import InvalidArgument, MissingPackage

# The schemes of URLs, whose uploads appear whole or not at all, and the packages that fsspec needs for them.
PACKAGES = {"s3": "s3fs", "gs": "gcsfs", "gcs": "gcsfs", "az": "adlfs", "abfs": "adlfs", "memory": "fsspec"}

# Bytes read at a time from a file behind a URL: each read is a request.
REQUEST_BYTES = 1 << 23

# What stores call the version of an object, in the order of preference.
_VERSIONS = ("ETag", "etag", "md5Hash", "mtime", "LastModified", "last_modified", "updated", "created")

# fsync(2) says so where a file system does not have it.
_NO_FSYNC = {errno.EINVAL, errno.ENOTSUP, errno.ENOSYS}


def is_url(place: str) -> bool:
    """Whether a place is a URL."""
    return re.match(r"[A-Za-z][A-Za-z0-9+.-]*://", place) is not None


def check_place(argument: str, place: str) -> None:
    """Raise `InvalidArgument` for a URL with an unknown scheme, and `MissingPackage` without the package for it."""
    if not is_url(place):
        return
    scheme, _, _ = place.partition("://")
    if scheme not in PACKAGES:
        known = ", ".join(f"{name}://" for name in PACKAGES)
        raise InvalidArgument(argument, f"is {place!r}: a URL must begin with one of {known}")
    try:
        with os_errors():
            filesystem(place)
    except ImportError as error:
        package = PACKAGES[scheme]
        raise MissingPackage(f"tables behind {scheme}:// need {package}: pip install {package} brings it") from error
    except OSError as error:
        raise InvalidArgument(argument, f"is {place!r}: {error}") from error


def filesystem(url: str) -> tuple[Any, str]:
    """The fsspec file system of a URL, and the path in it."""
    # Imported here, since only URLs need it.
    from fsspec.core import url_to_fs

    store, path = url_to_fs(url)
    # Others write files that an older list of names does not have.
    store.invalidate_cache()
    return store, path


def open_place(place: str) -> Any:
    """A file opened for reading bytes at any position."""
    if not is_url(place):
        return Path(place).open("rb")
    with os_errors():
        store, path = filesystem(place)
        # Columns of a Parquet file lie far apart: reading ahead would read much that is not used.
        return store.open(path, "rb", cache_type="none")


def version_of(place: str) -> list[Any]:
    """The size of a file in bytes, and a value that changes when the file is written again."""
    if not is_url(place):
        stat = Path(place).stat()
        return [stat.st_size, stat.st_mtime_ns]
    with os_errors():
        store, path = filesystem(place)
        info = store.info(path)
    return [info.get("size"), next((str(info[name]) for name in _VERSIONS if name in info), None)]


def exists(place: str) -> bool:
    """Whether there is a file at a place; raises `OSError`."""
    try:
        version_of(place)
    except FileNotFoundError:
        return False
    return True


def is_same_file(one: str, other: str) -> bool:
    """Whether two places are the same file, which exists."""
    if is_url(one) or is_url(other):
        return one == other
    return Path(one).exists() and Path(one).samefile(other)


def resolve(place: str) -> str:
    """The place without links and relative parts."""
    return place if is_url(place) else str(Path(place).resolve())


@contextmanager
def os_errors() -> Iterator[None]:
    """Raise `OSError` instead of the errors of the libraries of the stores."""
    try:
        yield
    except (OSError, ImportError):
        raise
    except Exception as error:
        raise OSError(f"{type(error).__name__}: {error}") from error


@dataclass(frozen=True)
class Folder:
    """A folder, or the objects behind a URL whose names begin with its own; its files appear whole or not at all.

    `at` is an absolute path or a URL.
    """

    at: str

    @property
    def path(self) -> Path | None:
        """The path of a folder on this machine, or on a network file system; None behind a URL."""
        return None if is_url(self.at) else Path(self.at)

    def place(self, name: str) -> str:
        """The place of a file of this folder."""
        return f"{self.at}{name}" if self.at.endswith("/") else f"{self.at}/{name}"

    def subfolder(self, name: str) -> Folder:
        """A folder in this one, which need not exist."""
        return Folder(self.place(name))

    def names(self) -> list[str]:
        """The sorted names of the files and folders in this folder; none if it does not exist."""
        try:
            if self.path is not None:
                # Listed, since network file systems may cache the fact that a name did not exist.
                return sorted(os.listdir(self.path))  # noqa: PTH208
            with os_errors():
                store, path = filesystem(self.at)
                found = store.ls(path, detail=False)
        except FileNotFoundError:
            return []
        # Some stores list the folder itself.
        return sorted({name.rstrip("/").rpartition("/")[2] for name in found if name.strip("/") != path.strip("/")})

    def read(self, name: str) -> bytes:
        """The content of a file; raises `OSError`."""
        with open_place(self.place(name)) as file:
            content: bytes = file.read()
        return content

    @contextmanager
    def create(self, name: str, work: Folder, is_wanted: Callable[[], bool] = lambda: True) -> Iterator[str]:
        """A context whose value is a local path to write; the file appears as `name` when it ends without error.

        `work` is for temporary files, on the same file system. If `is_wanted` then returns False, nothing appears.
        """
        if self.path is None:
            # Without a name, so that nothing is left of a killed process.
            with TemporaryFile() as file:
                local = f"/dev/fd/{file.fileno()}"
                yield local
                if is_wanted():
                    file.seek(0)
                    with os_errors():
                        store, path = filesystem(self.place(name))
                        store.put_file(local, path)
            return
        # A random name: two workers may write the same part, if a scheduler wrongly counts one of them as lost.
        unfinished = Path(work.place(f"{name}.{token_hex(4)}.tmp"))
        try:
            yield str(unfinished)
            synchronise(unfinished)
            if is_wanted():
                unfinished.replace(self.path / name)
                synchronise(self.path)
        finally:
            unfinished.unlink(missing_ok=True)

    def write(self, name: str, content: bytes, work: Folder) -> None:
        """Write a small file."""
        with self.create(name, work) as path:
            Path(path).write_bytes(content)

    def delete(self, names: Iterable[str]) -> None:
        """Delete files, if they exist."""
        for name in names:
            with suppress(FileNotFoundError), os_errors():
                if self.path is not None:
                    (self.path / name).unlink()
                else:
                    store, path = filesystem(self.place(name))
                    store.rm_file(path)


def folder_at(place: str) -> Folder:
    """The folder at a place."""
    if not is_url(place):
        return Folder(str(Path(place).absolute()))
    scheme, _, path = place.partition("://")
    return Folder(f"{scheme}://{path.rstrip('/')}")


def split(place: str) -> tuple[Folder, str]:
    """The folder and the name of a file."""
    if not is_url(place):
        path = Path(place).absolute()
        return Folder(str(path.parent)), path.name
    scheme, _, path_in_store = place.partition("://")
    parent, _, name = path_in_store.rpartition("/")
    return folder_at(f"{scheme}://{parent}"), name


def synchronise(path: Path) -> None:
    """Wait until a file, or the list of the names in a folder, is on the disk, where the file system can say so."""
    handle = os.open(path, os.O_RDONLY)
    try:
        os.fsync(handle)
    except OSError as error:
        if error.errno not in _NO_FSYNC:
            raise
    finally:
        os.close(handle)
