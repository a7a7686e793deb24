"""Files that appear whole or not at all."""

import os
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from errno import EISDIR
from pathlib import Path
from typing import BinaryIO

from loiter.errors import InvalidArgument


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
