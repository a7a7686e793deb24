"""Pictures on disk: PNG, SVG or PDF, written whole or not at all."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path

from loiter.errors import InvalidArgument
from loiter.planning.model import Maneuver

FORMATS = (".png", ".svg", ".pdf")


def check_format(path: Path) -> None:
    """Raise `InvalidArgument` unless the ending of `path` names a format that `save` writes."""
    if path.suffix.lower() not in FORMATS:
        raise InvalidArgument("plot", f"is {str(path)!r}: the file name must end in {', '.join(FORMATS)}")


def save(path: str | Path, best: Sequence[Maneuver], others: Sequence[Maneuver] = ()) -> None:
    """Write the picture of `picture.draw` to `path`, in the format of its ending: .png, .svg or .pdf.

    The file appears whole or not at all; an older one stays until then. Raises `InvalidArgument` for another ending and
    a file that cannot be written.
    """
    path = Path(path)
    check_format(path)
    from loiter.plot.picture import draw

    figure = draw(best, others)
    part = path.with_name(f".{os.getpid()}.part")
    try:
        try:
            with part.open("xb") as file:
                figure.savefig(file, format=path.suffix[1:].lower(), dpi=150)
            part.replace(path)
        finally:
            part.unlink(missing_ok=True)
    except OSError as error:
        raise InvalidArgument("plot", f"is {str(path)!r}: it cannot be written, {error.strerror or error}") from error
