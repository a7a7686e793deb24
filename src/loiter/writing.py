"""Files that appear whole or not at all, and the formats of files."""

import os
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from errno import EISDIR
from pathlib import Path
from typing import BinaryIO, Literal, NamedTuple

from loiter.errors import InvalidArgument


class Format(NamedTuple):
    """A format of output files: the endings of their names, and what the front ends say about it.

    Maps and missions need places on Earth, missions an altitude too. The page offers formats that have a
    `media_type`. `content` makes the content of a file from its ending and its arguments; None for pictures.
    """

    endings: tuple[str, ...]
    kind: Literal["map", "table", "mission", "picture"]
    media_type: str
    name: str
    use: str
    content: Callable[..., bytes] | None = None

    def __str__(self) -> str:
        return f"{' or '.join(self.endings)} ({self.use})"


def file_format(path: Path, formats: Sequence[Format]) -> Format:
    """The format that the ending of `path` names; raises `InvalidArgument` for another ending."""
    found = next((known for known in formats if path.suffix.lower() in known.endings), None)
    if found is None:
        endings = ", ".join(ending for known in formats for ending in known.endings)
        raise InvalidArgument("path", f"is {str(path)!r}: the file name must end in {endings}")
    return found


def write_whole(argument: str, path: Path, write: Callable[[BinaryIO], object]) -> None:
    """Write a temporary file with `write`, then rename it to `path`; an older file stays until then.

    Raises `InvalidArgument` for `argument`, the name of the option that gave the path, where it cannot be written.
    """
    with _beside(argument, path) as part:
        with part.open("xb") as file:
            write(file)
        part.replace(path)


def write_content(argument: str, path: Path, content: bytes) -> None:
    """Write a file with this content; errors as for `write_whole`."""
    write_whole(argument, path, lambda file: file.write(content))


def check_writable(argument: str, path: Path) -> None:
    """Raise the error of `write_whole` where `path` cannot be written; for a check before long work."""
    with _beside(argument, path) as part:
        part.open("xb").close()
        if path.is_dir():
            raise IsADirectoryError(EISDIR, os.strerror(EISDIR))


@contextmanager
def _beside(argument: str, path: Path) -> Iterator[Path]:
    """The name of a temporary file beside `path`, which is deleted afterwards."""
    # A random name, so that threads that write into the same folder use different files.
    part = path.with_name(f".{os.urandom(8).hex()}.part")
    try:
        try:
            yield part
        finally:
            part.unlink(missing_ok=True)
    except OSError as error:
        raise InvalidArgument(argument, f"is {str(path)!r}: it cannot be written, {error.strerror or error}") from error
