"""`loiter figures`: the paper's figures, drawn from the code, with their captions."""

from pathlib import Path
from typing import Annotated, Literal

from cyclopts import Parameter
from rich.table import Table

from loiter.cli import report
from loiter.errors import InvalidArgument
from loiter.plot import files
from loiter.writing import write_whole


def figures(
    *,
    out: Annotated[Path, Parameter(metavar="DIR", help="Folder for the files; made where it is missing.")],
    format_: Annotated[
        Literal["png", "svg", "pdf"], Parameter(name="--format", help="Format of the pictures.")
    ] = "png",
) -> None:
    """Draw the seven figures of the paper from the code, and write their captions beside them."""
    from loiter.plot.figures import FIGURES

    # Everything is drawn before anything is written.
    pictures = {f"fig{number}.{format_}": (number, caption, draw()) for number, caption, draw in FIGURES}
    make_folder(out)
    rows = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0))
    rows.add_column("file", no_wrap=True)
    rows.add_column("shows")
    for name, (_, caption, figure) in pictures.items():
        files.save_figure("out", out / name, figure)
        rows.add_row(name, caption.partition(". ")[0])
    captions = "\n".join(f"![Fig. {n}]({name})\n\nFig. {n}. {text}\n" for name, (n, text, _) in pictures.items())
    write_whole("out", out / "captions.md", lambda file: file.write(captions.encode()))
    rows.add_row("captions.md", "What each of them shows")
    report.write(rows)


def make_folder(out: Path) -> None:
    """Make the folder and those above it where they are missing."""
    try:
        out.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise InvalidArgument("out", f"is {str(out)!r}: no folder can be made there, {error.strerror}") from error
