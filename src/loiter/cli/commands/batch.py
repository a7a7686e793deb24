"""`loiter batch`: the entries for a table of states."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import asdict
from typing import TYPE_CHECKING, Annotated

from cyclopts import Group, Parameter
from rich.console import Console
from rich.progress import BarColumn, ProgressColumn, Task, TextColumn, TimeRemainingColumn
from rich.progress import Progress as Bar
from rich.table import Column
from rich.text import Text

import loiter
from loiter.cli.fences import BatchFenceOptions
from loiter.cli.numbers import check_declination, column_mapping, whole
from loiter.cli.options import (
    CIRCLE_DEGREES,
    CIRCLE_METRES,
    TOLERANCE_HELP,
    TURN_HELP,
    VELOCITY,
    WIND_HELP,
    Airspeed,
    Bank,
    ClimbRate,
    DeclinationDegrees,
    DescentRate,
    Json,
    SlotBearing,
    SlotTime,
    Tolerance,
    TurnChoice,
    TurnRadius,
    TurnRate,
    WindChoice,
    column_map,
    moving_air,
)
from loiter.cli.report import print_json
from loiter.cli.scenes import slot_of
from loiter.errors import InvalidArgument
from loiter.geo import LocalFrame
from loiter.planning.model import Orbit, Turn, circle_radius_m

if TYPE_CHECKING:
    from loiter.batch import JobProgress, JobSummary

shared = Group("Values that replace columns of the table", sort_key=1)
work = Group("Work", sort_key=2)


def batch(
    source: Annotated[
        str,
        Parameter(
            name="IN", help="The table to read: .parquet, .csv or .csv.gz, a folder of such files, a pattern, or a URL."
        ),
    ],
    target: Annotated[
        str,
        Parameter(
            name="OUT",
            help="The table to write: OUT/ for a folder of Parquet files, which is fastest, .parquet, .csv or .csv.gz, or a URL.",
        ),
    ],
    /,
    *,
    orbit: Annotated[
        tuple[float, float, float] | None,
        CIRCLE_METRES,
        Parameter(group=shared, help="The circle: its centre and its radius, metres."),
    ] = None,
    orbit_lla: Annotated[
        tuple[float, float, float] | None,
        CIRCLE_DEGREES,
        Parameter(
            group=shared,
            help="Instead, where the table has latitudes and longitudes: its centre in WGS84 degrees, and its radius.",
        ),
    ] = None,
    turn: Annotated[
        TurnChoice,
        Parameter(group=shared, help=f"Direction in which the circle is held, {TURN_HELP} either."),
    ] = None,
    airspeed: Annotated[Airspeed, Parameter(group=shared)] = None,
    bank: Annotated[
        Bank,
        Parameter(
            group=shared,
            help="Largest bank, degrees. One of --bank, --turn-radius and --turn-rate is needed, unless it is a column.",
        ),
    ] = None,
    turn_radius: Annotated[TurnRadius, Parameter(group=shared)] = None,
    turn_rate: Annotated[TurnRate, Parameter(group=shared)] = None,
    wind: Annotated[WindChoice, Parameter(group=shared, help=f"{WIND_HELP}; still air if absent.")] = None,
    declination: Annotated[DeclinationDegrees, Parameter(group=shared)] = None,
    climb_rate: Annotated[ClimbRate, Parameter(group=shared)] = None,
    descent_rate: Annotated[DescentRate, Parameter(group=shared)] = None,
    orbit_velocity: Annotated[
        tuple[float, float] | None,
        VELOCITY,
        Parameter(group=shared, help="Velocity of the circle over the ground, metres per second; at rest if absent."),
    ] = None,
    slot: Annotated[
        SlotBearing,
        Parameter(
            group=shared,
            help="Enter the slot that is at this bearing from the centre, as in loiter plan; without it, or a column slot_phase_deg, entries are free.",
        ),
    ] = None,
    slot_at: Annotated[SlotTime, Parameter(group=shared)] = None,
    map_: Annotated[list[str] | None, column_map(shared)] = None,
    fence: BatchFenceOptions = BatchFenceOptions(),
    tolerance: Annotated[Tolerance, Parameter(group=work, help=f"{TOLERANCE_HELP}, as in loiter plan.")] = 0.0,
    workers: Annotated[
        int | None,
        Parameter(
            group=work,
            metavar="N",
            converter=whole,
            help="Number of threads that solve; the number of cores if absent.",
        ),
    ] = None,
    scheduler: Annotated[
        str | None,
        Parameter(
            group=work,
            metavar="tcp://HOST:PORT",
            help="Use the Dask cluster with this scheduler; its workers must see IN and OUT at the same places.",
        ),
    ] = None,
    rejects: Annotated[
        str | None,
        Parameter(
            group=work,
            metavar="FILE",
            help="Write the malformed lines of CSV files to this CSV file, with file, line number, problem and text.",
        ),
    ] = None,
    json: Annotated[
        Json, Parameter(group=work, help="Print one JSON object at the end: the numbers of rows, and of each status.")
    ] = False,
) -> None:
    """Plan the fastest entry of every row of a table."""
    check_declination(declination, *((wind or ())[-1:]))
    limits = {"max_bank_deg": bank, "min_turn_radius_m": turn_radius, "max_turn_rate_deg_s": turn_rate}
    rates = {"climb_rate_m_s": climb_rate, "descent_rate_m_s": descent_rate}
    given = {name: value for name, value in {"airspeed_m_s": airspeed, **limits, **rates}.items() if value is not None}
    circle, origin = _circle(orbit, orbit_lla)
    with _named_interrupt(), shown_progress() as report:
        summary = loiter.batch.run(
            source,
            target,
            orbit=circle,
            turn=None if turn is None else Turn(turn),
            aircraft=given,
            wind=moving_air(wind, declination),
            orbit_velocity_m_s=orbit_velocity,
            origin=origin,
            columns=column_mapping(map_ or []),
            tolerance_m=tolerance,
            fence=fence.read(None),
            margin_m=fence.margin,
            slot=slot_of(slot, slot_at),
            workers=workers,
            scheduler=scheduler,
            rejects=rejects,
            progress=report,
        )
    if json:
        print_json(asdict(summary) | {"files": [target]})
    else:
        sys.stderr.write(summary_lines(summary, rejects))


def _circle(
    orbit: tuple[float, float, float] | None, orbit_lla: tuple[float, float, float] | None
) -> tuple[Orbit | None, LocalFrame | None]:
    """The circle, and the local frame about its centre if it is in degrees."""
    if orbit_lla is None:
        return (None if orbit is None else Orbit(*orbit)), None
    if orbit is not None:
        raise InvalidArgument("orbit", "and --orbit-lla are given: one of them is needed")
    lat, lon, radius = orbit_lla
    return Orbit(0.0, 0.0, circle_radius_m("origin radius_m", radius)), LocalFrame(lat, lon)


@contextmanager
def _named_interrupt() -> Iterator[None]:
    """A context in which an interrupt gets a sentence, unless it has one."""
    try:
        yield
    except KeyboardInterrupt as interrupt:
        raise KeyboardInterrupt(str(interrupt) or "interrupted") from None


@contextmanager
def shown_progress() -> Iterator[Callable[[JobProgress], None]]:
    """A context whose value shows progress on standard error: notes always, and a bar on a terminal."""
    console = Console(stderr=True, highlight=False)
    # The bar takes the width that is left.
    columns = (
        TextColumn("{task.description}"),
        BarColumn(bar_width=None),
        Rows(table_column=Column(no_wrap=True)),
        TimeRemainingColumn(),
    )
    with Bar(*columns, console=console, expand=True, disable=not console.is_terminal) as bar:
        task = bar.add_task("", total=None)

        def report(progress: JobProgress) -> None:
            if progress.note:
                console.print(progress.note, soft_wrap=True)
            phase = "solving" if progress.total else "reading"
            bar.update(task, completed=progress.rows, total=progress.total, description=phase)

        yield report


class Rows(ProgressColumn):
    """The number of rows done, and their rate."""

    def render(self, task: Task) -> Text:
        """The text of the column: "1,310,720 of 10,000,000 rows, 812,000 rows/s"."""
        whole = f" of {task.total:,.0f}" if task.total else ""
        speed = f", {float(f'{task.speed:.3g}'):,.0f} rows/s" if task.speed else ""
        return Text(f"{task.completed:,.0f}{whole} rows{speed}")


def summary_lines(summary: JobSummary, rejects: str | None = None) -> str:
    """The closing lines: the number of rows and their rate, the bad rows by status, and the first malformed line."""
    seconds, solved = summary.seconds, summary.solved_rows
    in_this_run = "" if solved == summary.rows else f", {solved:,} of them in this run,"
    rate = f"{in_this_run} in {seconds:.1f} s: {solved / seconds:,.0f} rows/s"
    lines = [f"{summary.rows:,} rows{rate if solved or not summary.rows else ', all of them solved before'}"]
    from loiter.batch.tables.columns import MESSAGES

    for status, message in MESSAGES.items():
        count = summary.statuses.get(status, 0)
        if count and status != "ok":
            lines.append(f"{count:,} {status}: {message}")
    if summary.first_malformed:
        where = f"{rejects} has the malformed lines" if rejects else "--rejects FILE keeps the malformed lines"
        lines.append(f"{summary.first_malformed}; {where}")
    return "\n".join(lines) + "\n"
