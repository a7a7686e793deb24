"""`loiter figures`: the figures of the paper, drawn by the code, with captions."""

from pathlib import Path
from typing import Annotated, Literal

from cyclopts import Parameter

from loiter.cli import report
from loiter.cli.sentences import argument_names
from loiter.errors import InvalidArgument
from loiter.plot import files
from loiter.writing import write_content


def figures(
    *,
    out: Annotated[Path, Parameter(metavar="DIR", help="Folder for the files; created if missing.")],
    format_: Annotated[
        Literal["png", "svg", "pdf"], Parameter(name="--format", help="Format of the pictures.")
    ] = "png",
) -> None:
    """Draw the seven figures of the paper, and write their captions to a file beside them."""
    from loiter.plot.figures import FIGURES

    # All pictures are drawn before the first is written, so that an error leaves no files.
    pictures = {f"fig{number}.{format_}": (number, caption, draw()) for number, caption, draw in FIGURES}
    make_folder(out)
    rows = report.new_table()
    rows.add_column("file", no_wrap=True)
    rows.add_column("shows")
    for name, (_, caption, figure) in pictures.items():
        with argument_names(path="out"):
            files.save_figure(out / name, figure)
        first_sentence, _, _ = caption.partition(". ")
        rows.add_row(name, first_sentence)
    captions = "\n".join(f"![Fig. {n}]({name})\n\nFig. {n}. {text}\n" for name, (n, text, _) in pictures.items())
    write_content("out", out / "captions.md", captions.encode())
    rows.add_row("captions.md", "What each figure shows")
    report.write(rows)


def make_folder(out: Path) -> None:
    """Create the folder and its parents where they are missing."""
    try:
        out.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise InvalidArgument("out", f"is {str(out)!r}: no folder can be created there, {error.strerror}") from error
