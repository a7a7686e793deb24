"""`loiter synthesis`: the optimal synthesis of the reduced plane, as a table, a picture and arrays."""

from pathlib import Path
from typing import Annotated, Any, Literal

import numpy as np
from cyclopts import Parameter
from rich.table import Table

from loiter.arrays.partition import BOUNDARIES, Boundary, Partition, boundaries, partition
from loiter.cli import report
from loiter.cli.numbers import turn_name, whole
from loiter.cli.options import Files, Json, PictureOptions
from loiter.cli.output import Output
from loiter.errors import InvalidArgument
from loiter.planning.model import TurnName
from loiter.writing import write_whole


def synthesis(
    *,
    radius: Annotated[float, Parameter(metavar="TURN_RADII", help="Radius of the circle, at least 1.")] = 1.0,
    turn: Annotated[
        TurnName, Parameter(converter=turn_name, help="Direction of flight around the circle, seen from above.")
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
    json: Annotated[Json, Parameter(help="Print one JSON object: the map's settings, and its curves.")] = False,
    pictures: PictureOptions = PictureOptions(),
    save: Annotated[Files, Parameter(help="Write the map and the curves as arrays: .npz; may be repeated.")] = (),
) -> None:
    """Map the optimal synthesis of the reduced plane: the fastest word in each region, and the curves between them."""
    output = Output(json, pictures, save)
    output.check(_check_format)
    if show == "worth" and turn == "either":
        raise InvalidArgument(
            "show",
            "is 'worth': it compares a free choice of direction with one direction, so give --turn cw or ccw",
        )
    regions = partition(radius, turn, reach=reach, cells=cells)
    curves = boundaries(regions)
    if pictures.plot:
        from loiter.plot.synthesis import draw

        output.draw(draw(regions, curves, show))
    for path in save:
        write_arrays(path, regions, curves)
    output.show(document(regions, curves), table(curves))


def _check_format(path: Path) -> None:
    if path.suffix.lower() != ".npz":
        raise InvalidArgument("save", f"is {str(path)!r}: the file name must end in .npz")


def table(curves: tuple[Boundary, ...]) -> Table:
    """A table with a row for each curve between two regions."""
    rows = report.new_table()
    rows.add_column("between")
    rows.add_column("and")
    rows.add_column("curve")
    # T jumps at R = 1 only.
    jumps = any(curve.kind == "jump" for curve in curves)
    for heading in ("points", "T rises by") if jumps else ("points",):
        rows.add_column(heading, justify="right")
    for curve in curves:
        rise = f"{curve.rise.min():.3f} to {curve.rise.max():.3f}" if curve.kind == "jump" else ""
        rows.add_row(*curve.words, BOUNDARIES[curve.kind], str(len(curve.points)), *[rise] * jumps)
    return rows


def document(regions: Partition, curves: tuple[Boundary, ...]) -> dict[str, object]:
    """The settings of a map and its curves as plain values; `rise` is by how much T jumps, at least and at most."""
    return {
        "radius": float(regions.radius),
        "turn": str(regions.turn),
        "reach": float(regions.x.max() + 0.5 * (regions.x[1] - regions.x[0])),
        "cells": int(regions.x.size),
        "curves": [
            {
                "words": list(curve.words),
                "kind": curve.kind,
                "points": len(curve.points),
                "rise": [float(curve.rise.min()), float(curve.rise.max())] if curve.kind == "jump" else None,
            }
            for curve in curves
        ],
    }


def write_arrays(path: Path, regions: Partition, curves: tuple[Boundary, ...]) -> None:
    """Write a partition and its curves as named arrays; the name of a curve is its kind and its words: "tie LRL RL"."""
    arrays: dict[str, Any] = {name: np.asarray(value) for name, value in regions._asdict().items()}
    for curve in curves:
        name = " ".join((curve.kind, *curve.words))
        arrays |= {name: curve.points, f"{name} rise": curve.rise}
    write_whole("save", path, lambda file: np.savez_compressed(file, **arrays))
