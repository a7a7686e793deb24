"""`loiter batch`: the entries for a table of states."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING, Annotated

from cyclopts import Group, Parameter
from rich.console import Console
from rich.progress import BarColumn, ProgressColumn, Task, TextColumn, TimeRemainingColumn
from rich.progress import Progress as Bar
from rich.table import Column
from rich.text import Text

import loiter.tables
from loiter.cli.fences import BatchFenceOptions
from loiter.cli.numbers import check_declination, column_mapping
from loiter.cli.options import (
    EAST_NORTH_RADIUS,
    LAT_LON_RADIUS,
    VELOCITY,
    Angle,
    Bearing,
    Columns,
    Declination,
    Metres,
    Speed,
    Tolerance,
    TurnChoice,
    TurnRate,
    Whole,
    WindChoice,
    moving_air,
)
from loiter.cli.report import print_json
from loiter.cli.scenes import slot_of
from loiter.errors import InvalidArgument
from loiter.geo import LocalFrame
from loiter.planning.model import Orbit, Turn, circle_radius_m

if TYPE_CHECKING:
    from loiter.tables import JobProgress, JobSummary

shared_group = Group("Values that replace columns of the table", sort_key=1)
work_group = Group("Work", sort_key=2)


@Parameter(name="*", group=shared_group)
@dataclass(frozen=True)
class SharedOptions:
    """What is the same in all rows."""

    orbit: Annotated[tuple[float, float, float] | None, EAST_NORTH_RADIUS] = None
    """The circle: its centre and its radius, metres."""
    orbit_lla: Annotated[tuple[float, float, float] | None, LAT_LON_RADIUS] = None
    """Instead, where the table has latitudes and longitudes: its centre in WGS84 degrees, and its radius."""
    turn: TurnChoice = None
    """Direction in which the circle is held, seen from above: cw is clockwise, ccw counter-clockwise, either the faster one. If absent: either."""
    airspeed: Speed = None
    """True airspeed, metres per second, or with a unit: 35kn."""
    bank: Angle = None
    """Largest bank, degrees. One of --bank, --turn-radius and --turn-rate is needed, unless it is a column."""
    turn_radius: Metres = None
    """Smallest turn radius, metres."""
    turn_rate: TurnRate = None
    """Largest turn rate, degrees per second."""
    wind: WindChoice = None
    """Wind speed, metres per second, and the compass direction that the wind comes from; or as in weather reports, 250/15kn or 25015KT; still air if absent."""
    declination: Declination = None
    climb_rate: Speed = None
    """Rate at which it climbs."""
    descent_rate: Speed = None
    """Rate at which it descends."""
    orbit_velocity: Annotated[tuple[float, float] | None, VELOCITY] = None
    """Velocity of the circle over the ground, metres per second; at rest if absent."""
    slot: Bearing = None
    """Enter the slot that is at this bearing from the centre, as in loiter plan; without it, or a column slot_phase_deg, entries are free."""
    slot_at: Annotated[float | None, Parameter(metavar="SECONDS")] = None
    """The time from the start at which the slot is at that bearing; 0 if absent."""
    map_: Columns = None
    """The column of the table that holds a quantity, if it has another name or unit: east_m='X_East [ft]'; may be repeated. Its unit is at the end of its name, or added in brackets."""

    @property
    def aircraft(self) -> dict[str, float]:
        """The numbers of the aircraft that are given."""
        given = {
            "airspeed_m_s": self.airspeed,
            "max_bank_deg": self.bank,
            "min_turn_radius_m": self.turn_radius,
            "max_turn_rate_deg_s": self.turn_rate,
            "climb_rate_m_s": self.climb_rate,
            "descent_rate_m_s": self.descent_rate,
        }
        return {name: value for name, value in given.items() if value is not None}

    def circle(self) -> tuple[Orbit | None, LocalFrame | None]:
        """The circle, and the local frame about its centre if it is in degrees."""
        if self.orbit_lla is None:
            return (None if self.orbit is None else Orbit(*self.orbit)), None
        if self.orbit is not None:
            raise InvalidArgument("orbit", "and --orbit-lla are given: one of them is needed")
        lat, lon, radius = self.orbit_lla
        return Orbit(0.0, 0.0, circle_radius_m("origin radius_m", radius)), LocalFrame(lat, lon)


@Parameter(name="*", group=work_group)
@dataclass(frozen=True)
class WorkOptions:
    """How the rows are solved."""

    tolerance: Tolerance = 0.0
    """A start that is beyond the circle, or beyond the last arc onto it, by up to this many metres counts as on it, as in loiter plan."""
    workers: Whole = None
    """Number of threads that solve; the number of cores if absent."""
    scheduler: Annotated[str | None, Parameter(metavar="tcp://HOST:PORT")] = None
    """Use the Dask cluster with this scheduler; its workers must see IN and OUT at the same places."""
    rejects: Annotated[str | None, Parameter(metavar="FILE")] = None
    """Write the malformed lines of CSV files to this CSV file, with file, line number, problem and text."""
    json: bool = False
    """Print one JSON object at the end: the numbers of rows, and of each status."""


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
    shared: SharedOptions = SharedOptions(),
    fence: BatchFenceOptions = BatchFenceOptions(),
    work: WorkOptions = WorkOptions(),
) -> None:
    """Plan the fastest entry of every row of a table."""
    check_declination(shared.declination, *((shared.wind or ())[-1:]))
    circle, origin = shared.circle()
    with _named_interrupt(), shown_progress() as report:
        summary = loiter.tables.run(
            source,
            target,
            orbit=circle,
            turn=None if shared.turn is None else Turn(shared.turn),
            aircraft=shared.aircraft,
            wind=moving_air(shared.wind, shared.declination),
            orbit_velocity_m_s=shared.orbit_velocity,
            origin=origin,
            columns=column_mapping(shared.map_ or []),
            tolerance_m=work.tolerance,
            fence=fence.read(None),
            margin_m=fence.margin,
            slot=slot_of(shared.slot, shared.slot_at),
            workers=work.workers,
            scheduler=work.scheduler,
            rejects=work.rejects,
            progress=report,
        )
    if work.json:
        print_json(asdict(summary) | {"files": [target]})
    else:
        sys.stderr.write(summary_lines(summary, work.rejects))


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
    from loiter.tables.columns import MESSAGES

    for status, message in MESSAGES.items():
        count = summary.statuses.get(status, 0)
        if count and status != "ok":
            lines.append(f"{count:,} {status}: {message}")
    if summary.first_malformed:
        where = f"{rejects} has the malformed lines" if rejects else "--rejects FILE keeps the malformed lines"
        lines.append(f"{summary.first_malformed}; {where}")
    if summary.statuses and "ok" not in summary.statuses:
        lines.append(f"no row was solved: all {summary.rows:,} rows failed")
    return "\n".join(lines) + "\n"
