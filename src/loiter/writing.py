"""Files that appear whole or not at all."""

import os
from collections.abc import Callable
from pathlib import Path
from typing import BinaryIO

from loiter.errors import InvalidArgument


def write_whole(argument: str, path: Path, write: Callable[[BinaryIO], object]) -> None:
    """Let `write` fill a file beside `path`, then put it in its place; an older file stays until then.

    Raises `InvalidArgument` for `argument`, the name of the option that gave the path, where it cannot be written.
    """
    # Drawn, so that threads which write into one folder do not take each other's file for their own.
    part = path.with_name(f".{os.urandom(8).hex()}.part")
    try:
        try:
            with part.open("xb") as file:
                write(file)
            part.replace(path)
        finally:
            part.unlink(missing_ok=True)
    except OSError as error:
        raise InvalidArgument(argument, f"is {str(path)!r}: it cannot be written, {error.strerror or error}") from error
