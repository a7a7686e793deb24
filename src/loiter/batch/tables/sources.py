"""The files of an input: one file, a folder of files, or those that match a pattern such as states-*.csv.

`pyarrow.dataset` would find them, too, but orders them as text (part.10 before part.2), and reads unfinished datasets.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from glob import glob, has_magic
from pathlib import Path, PurePosixPath
from typing import NamedTuple

from loiter.batch.tables import files, storage
from loiter.batch.tables.files import Kind
from loiter.errors import InvalidArgument

# The folder in which Spark and this program keep what is needed only until a dataset is complete.
TEMPORARY = "_temporary"

# The empty file that says, as in datasets of Spark, that a dataset is complete.
SUCCESS = "_SUCCESS"


class Source(NamedTuple):
    """An input as it was given, the places of its files in order, and their kind; `folder` if it is one."""

    text: str
    files: tuple[str, ...]
    kind: Kind
    folder: str | None = None

    def shown(self, place: str) -> str:
        """The name of one of the files in errors: the input as it was given, if it is the only file."""
        return self.text if len(self.files) == 1 else place


def find_source(argument: str, text: str) -> Source:
    """The files of the input `text`; raises `InvalidArgument` if there are none, or if they cannot be one table."""
    storage.check_place(argument, text)
    try:
        with storage.os_errors():
            found, folder = _places(text)
    except OSError as error:
        raise files.unreadable(argument, text, error) from error
    if folder is None and found == [_absolute(text)] and text.endswith("/"):
        raise InvalidArgument(argument, f"is {text!r}: there is no such folder, or there is nothing in it")
    if folder is None and found == [_absolute(text)]:
        return Source(text, tuple(found), files.kind(argument, text))
    if not found:
        problem = "it cannot be read, there is no file in it" if folder else "no file matches"
        raise InvalidArgument(argument, f"is {text!r}: {problem}")
    return Source(text, tuple(found), _common_kind(argument, text, found), folder)


def is_folder(place: str) -> bool:
    """Whether a place is a folder; raises `OSError`."""
    if not storage.is_url(place):
        return Path(place).is_dir()
    store, path = storage.filesystem(place)
    return bool(store.isdir(path))


def _places(text: str) -> tuple[list[str], str | None]:
    """The files, in order, and the folder, if the input is one."""
    if is_folder(text):
        folder = _absolute(text).rstrip("/")
        return _natural_order(_files_of(folder)), folder
    if has_magic(text) and not _exists(text):
        matches = [place for match in _matches(text) for place in (_files_of(match) if is_folder(match) else [match])]
        return _natural_order(matches), None
    return [_absolute(text)], None


def _absolute(text: str) -> str:
    # Absolute paths, since workers of a cluster have other working directories.
    return text if storage.is_url(text) else str(Path(text).absolute())


def _exists(text: str) -> bool:
    return not storage.is_url(text) and Path(text).exists()


def _matches(pattern: str) -> list[str]:
    if not storage.is_url(pattern):
        return [_absolute(match) for match in glob(pattern, recursive=True)]  # noqa: PTH207
    store, path = storage.filesystem(pattern)
    return [store.unstrip_protocol(match) for match in store.glob(path)]


def _files_of(folder: str) -> Iterator[str]:
    """The files in a folder and its subfolders, without those that readers of datasets ignore."""
    found = _names_below(folder)
    for name in found:
        *parents, last = PurePosixPath(name).parts
        if TEMPORARY in parents and SUCCESS not in found:
            raise OSError(f"the dataset is not finished: it has a folder {TEMPORARY}")
        for parent in parents:
            if "=" in parent:
                raise OSError(f"it has a folder {parent}, and columns in the names of folders are not read")
        if not any(part.startswith(("_", ".")) for part in (*parents, last)):
            yield f"{folder}/{name}"


def _names_below(folder: str) -> list[str]:
    """The paths of all files below a folder, relative to it."""
    if not storage.is_url(folder):
        return [path.relative_to(folder).as_posix() for path in Path(folder).rglob("*") if path.is_file()]
    store, path = storage.filesystem(folder)
    root = path.rstrip("/") + "/"
    return [found.removeprefix(root) for found in store.find(path) if found.startswith(root)]


def _natural_order(places: Iterable[str]) -> list[str]:
    """Places sorted by name, with numbers by value: part.2.parquet comes before part.10.parquet, as Dask numbers it."""
    return sorted(set(places), key=lambda place: (_pieces(place), place))


def _pieces(place: str) -> list[tuple[int, str]]:
    pieces = re.split(r"(\d+)", place)
    return [(int(piece), "") if i % 2 else (0, piece) for i, piece in enumerate(pieces)]


def _common_kind(argument: str, text: str, places: list[str]) -> Kind:
    kinds: dict[Kind, str] = {}
    for place in places:
        name = PurePosixPath(place).name
        kind = files.kind_of(name)
        if kind is None:
            raise InvalidArgument(argument, f"is {text!r}: {name} is not .parquet, .csv or .csv.gz")
        kinds.setdefault(kind, name)
    if len(kinds) > 1:
        first, second, *_ = kinds.values()
        raise InvalidArgument(argument, f"is {text!r}: {first} and {second} are files of different kinds")
    [kind] = kinds
    return kind
