"""`loiter synthesis`: the optimal synthesis of the reduced plane, as a table, a picture and arrays."""

from pathlib import Path
from typing import Annotated, Any, Literal

import numpy as np
from cyclopts import Parameter
from rich.table import Table

from loiter.arrays.partition import Boundary, Partition, boundaries, partition
from loiter.cli import report
from loiter.cli.numbers import any_case, whole
from loiter.errors import InvalidArgument
from loiter.planning.model import TurnName
from loiter.plot import files
from loiter.writing import write_whole

MEANINGS = {
    "jump": "T jumps",
    "same": "same first control",
    "straight": "straight flight",
    "switch": "switching curve",
    "tie": "two controls tie",
}


def synthesis(
    *,
    radius: Annotated[float, Parameter(metavar="TURN_RADII", help="Radius of the circle, at least 1.")] = 1.0,
    turn: Annotated[
        TurnName, Parameter(converter=any_case, help="Direction of flight around the circle, seen from above.")
    ] = "either",
    reach: Annotated[
        float | None,
        Parameter(
            metavar="TURN_RADII", help="Half the side of the map, which is centred on the circle; radius + 3 if absent."
        ),
    ] = None,
    cells: Annotated[int, Parameter(metavar="N", converter=whole, help="Grid points along a side.")] = 400,
    show: Annotated[
        Literal["words", "time", "worth"],
        Parameter(
            help="What the picture shows: the optimal word, the least time, or what a free choice of direction saves."
        ),
    ] = "words",
    plot: Annotated[Path | None, Parameter(metavar="FILE", help="Draw the map to a file: .png, .svg or .pdf.")] = None,
    save: Annotated[
        Path | None, Parameter(metavar="FILE", help="Write the map and the curves as arrays: .npz.")
    ] = None,
) -> None:
    """Map the optimal synthesis of the reduced plane: the fastest word in each region, and the curves between them."""
    _check_options(turn, show, plot, save)
    regions = partition(radius, turn, reach=reach, cells=cells)
    curves = boundaries(regions)
    if plot is not None:
        from loiter.plot.synthesis import draw

        files.save_figure("plot", plot, draw(regions, curves, show))
    if save is not None:
        write_arrays(save, regions, curves)
    report.write(table(curves))


def _check_options(turn: TurnName, show: str, plot: Path | None, save: Path | None) -> None:
    """Raise `InvalidArgument` for file names and options that cannot be used."""
    if plot is not None:
        files.check_format(plot)
    if save is not None and save.suffix.lower() != ".npz":
        raise InvalidArgument("save", f"is {str(save)!r}: the file name must end in .npz")
    if show == "worth" and turn == "either":
        raise InvalidArgument(
            "show",
            "is 'worth': it compares a free choice of direction with one direction, so give --turn cw or ccw",
        )


def table(curves: tuple[Boundary, ...]) -> Table:
    """A table with a row for each curve between two regions."""
    rows = report.new_table()
    rows.add_column("between")
    rows.add_column("and")
    rows.add_column("curve")
    for heading in ("points", "T rises by"):
        rows.add_column(heading, justify="right")
    for curve in curves:
        rise = f"{curve.rise.min():.3f} to {curve.rise.max():.3f}" if curve.kind == "jump" else ""
        rows.add_row(*curve.words, MEANINGS[curve.kind], str(len(curve.points)), rise)
    return rows


def write_arrays(path: Path, regions: Partition, curves: tuple[Boundary, ...]) -> None:
    """Write a partition and its curves as named arrays; the name of a curve is its kind and its words: "tie LRL RL"."""
    arrays: dict[str, Any] = {name: np.asarray(value) for name, value in regions._asdict().items()}
    for curve in curves:
        name = " ".join((curve.kind, *curve.words))
        arrays |= {name: curve.points, f"{name} rise": curve.rise}
    write_whole("save", path, lambda file: np.savez_compressed(file, **arrays))
