"""Pictures as files: PNG, SVG or PDF, each written atomically."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import IO, TYPE_CHECKING, Any

from loiter.geo import LocalFrame
from loiter.planning.maneuver import Maneuver
from loiter.writing import Format, file_format, write_whole

if TYPE_CHECKING:
    from matplotlib.figure import Figure

PICTURE_FORMATS = (
    Format((".png",), "picture", "image/png", "PNG", "picture"),
    Format((".svg",), "picture", "image/svg+xml", "SVG", "picture"),
    Format((".pdf",), "picture", "", "PDF", "picture"),
)
FORMATS = tuple(ending for known in PICTURE_FORMATS for ending in known.endings)

# Dots per inch of a .png.
DPI = 150.0

# Journals refuse matplotlib's default, Type 3 fonts; text in SVG stays text, which can be searched and edited. The salt
# makes the identifiers in an SVG the same each time.
SETTINGS: Any = {"pdf.fonttype": 42, "ps.fonttype": 42, "svg.fonttype": "none", "svg.hashsalt": "loiter"}

# Without the date, the same figure gives the same file.
METADATA: dict[str, dict[str, Any]] = {"svg": {"Date": None}, "pdf": {"CreationDate": None}}


def check_format(path: Path) -> None:
    """Raise `InvalidArgument` unless `path` ends in one of `FORMATS`."""
    file_format(path, PICTURE_FORMATS)


def save(
    path: str | Path,
    best: Sequence[Maneuver],
    others: Sequence[Maneuver] = (),
    *,
    frame: LocalFrame | None = None,
) -> None:
    """Write the picture of `plot.draw` to `path`, in the format of its ending: .png, .svg or .pdf.

    The file is replaced atomically. Raises `InvalidArgument` for another ending, and for a file that cannot be written.
    """
    path = Path(path)
    check_format(path)
    from loiter.plot.picture import draw

    save_pictures([path], draw(best, others, frame=frame))


def save_pictures(paths: Iterable[Path], figure: Figure) -> None:
    """Write a figure to files, each in the format of its ending."""
    for path in paths:
        save_figure(path, figure)


def save_figure(path: Path, figure: Figure) -> None:
    """Write a figure in the format of the ending of `path`."""
    ending = path.suffix.removeprefix(".").lower()
    write_whole("path", path, lambda file: write_figure(file, figure, ending))


def write_figure(file: IO[bytes], figure: Figure, ending: str) -> None:
    """Write a figure to an open file, as "png", "svg" or "pdf"; PDF embeds TrueType fonts, SVG keeps text as text."""
    import matplotlib as mpl

    with mpl.rc_context(SETTINGS):
        figure.savefig(file, format=ending, dpi=DPI, metadata=METADATA.get(ending))
