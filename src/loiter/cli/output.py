"""What a command prints and writes: JSON or lines, pictures, and files, whose names are checked before any work."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import Any, NamedTuple

from rich.console import RenderableType

from loiter.cli import report
from loiter.cli.options import PictureOptions
from loiter.cli.sentences import argument_names
from loiter.plot import files
from loiter.writing import write_content


class Output(NamedTuple):
    """Whether to print JSON, and the pictures and files to write."""

    json: bool
    pictures: PictureOptions
    save: Sequence[Path] = ()

    def check(self, check_format: Callable[[Path], object]) -> None:
        """Raise `InvalidArgument` for pictures and, as `check_format` does, for files that cannot be written."""
        self.pictures.check()
        with argument_names(path="save"):
            for path in self.save:
                check_format(path)

    def write(self, content: Callable[[Path], bytes]) -> None:
        """Write the files, once the contents of all are known."""
        for path, found in [(path, content(path)) for path in self.save]:
            write_content("save", path, found)

    def draw(self, figure: Any, paths: Iterable[Path] | None = None) -> None:
        """Write a figure of matplotlib to the files of --plot, or to others beside them."""
        with argument_names(path="plot"):
            files.save_pictures(self.pictures.plot if paths is None else paths, figure)

    def show(self, document: dict[str, object], *lines: RenderableType, beside: Sequence[Path] = ()) -> None:
        """Print the document or the lines, and the files that were written: `beside` are those without an option."""
        written = [*map(str, (*self.save, *self.pictures.plot, *beside))]
        if self.json:
            report.print_json(document | ({"files": written} if written else {}))
            return
        *first, last = written or [""]
        names = f"{', '.join(first)} and {last}" if first else last
        report.write(*lines, *([f"Wrote {names}."] if names else []))
