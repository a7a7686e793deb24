"""`loiter fly`: guidance laws in closed loop, once or from many starts."""

from __future__ import annotations

import csv
import io
import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

from cyclopts import Group, Parameter
from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn
from rich.table import Table

import loiter
from loiter.cli import report
from loiter.cli.numbers import whole
from loiter.cli.options import AircraftOptions, OrbitOptions, StartOptions, WindOptions, output, placed
from loiter.errors import InvalidArgument
from loiter.planning.model import Aircraft
from loiter.plot import files
from loiter.writing import check_writable, write_whole

if TYPE_CHECKING:
    from loiter.guidance.trials.campaign import Outcome, Trial
    from loiter.guidance.trials.flight import Flight
    from loiter.guidance.trials.settings import Setting

Sim = Literal["kinematic", "point", "jsbsim"]
Law = Literal["optimal", "l1", "vector-field", "tangent"]

# What flies where the options leave it open.
AIRFRAME, GUST = "aerosonde", 0.05

simulation = Group("Simulation", sort_key=0)


def fly(
    *,
    sim: Annotated[
        Sim,
        Parameter(
            group=simulation,
            help="kinematic: the vehicle of the theory, exactly. point: with roll, gusts, noise and delay. jsbsim: six degrees of freedom.",
        ),
    ] = "point",
    law: Annotated[Law, Parameter(group=simulation, help="The guidance law.")] = "optimal",
    compare: Annotated[
        bool, Parameter(group=simulation, help="Fly all laws from the same start, in the same air.")
    ] = False,
    airframe: Annotated[
        Literal["aerosonde", "j3cub"] | None,
        Parameter(
            group=simulation,
            help="What jsbsim flies, with an airspeed and a bank limit of its own; the Aerosonde if absent.",
        ),
    ] = None,
    gust: Annotated[
        float | None,
        Parameter(
            group=simulation,
            metavar="SHARE",
            help="Dryden gusts: their standard deviation over the airspeed, 0.05 if absent. From 0.1 on, settled means within 10 % of the radius and 10 degrees, else 5 and 5.",
        ),
    ] = None,
    runs: Annotated[
        int | None,
        Parameter(
            group=simulation,
            metavar="N",
            converter=whole,
            help="Fly from N random starts within 6 radii of circles of 1.2 to 4 times the tightest that can be held, instead of from --pose.",
        ),
    ] = None,
    seed: Annotated[
        int, Parameter(group=simulation, metavar="N", converter=whole, help="The same seed gives the same flights.")
    ] = 0,
    workers: Annotated[
        int | None,
        Parameter(group=simulation, metavar="N", converter=whole, help="Processes; as many as cores if absent."),
    ] = None,
    start: StartOptions = StartOptions(),
    circle: OrbitOptions = OrbitOptions(),
    uav: AircraftOptions = AircraftOptions(),
    air: WindOptions = WindOptions(),
    plot: Annotated[
        Path | None,
        Parameter(group=output, metavar="FILE", help="Draw one flight, or its comparison: .png, .svg or .pdf."),
    ] = None,
    save: Annotated[
        Path | None,
        Parameter(
            group=output, metavar="FILE", help="Write a .csv: each step of one flight, or a row for each of many."
        ),
    ] = None,
) -> None:
    """Fly the fastest entry in closed loop, beside the laws that autopilots use today."""
    from loiter.guidance.trials import campaign

    _check_use(sim, airframe, gust, runs, workers)
    _check_files(plot, save, runs)
    flown, share = airframe or AIRFRAME, GUST if gust is None else gust
    names: list[str] = list(campaign.LAWS) if compare else [law]
    if runs is None:
        pose, orbit, _ = placed(start, circle, uav.preset())
        trial = campaign.Trial(loiter.plan(pose, orbit, _aircraft(sim, flown, uav), air.moving_air), seed)
        _fly_once(trial, _setting(sim, flown, share), names, plot, save)
        return
    if (start, circle) != (StartOptions(), OrbitOptions()):
        raise InvalidArgument("runs", "asks for random starts and circles: --pose and --orbit are of no use")
    starts = campaign.trials(runs, seed, _aircraft(sim, flown, uav), air.moving_air)
    _fly_many(starts, _setting(sim, flown, share), names, workers, save)


def _setting(sim: Sim, airframe: str, gust: float) -> Setting:
    """How the simulator is flown."""
    from loiter.guidance.trials import settings

    if sim == "kinematic":
        return settings.theory()
    if sim == "point":
        return settings.rolling(gust)
    from loiter.guidance.simulators.airframes import AIRFRAMES

    return settings.flying(AIRFRAMES[airframe], gust)


def _aircraft(sim: Sim, airframe: str, uav: AircraftOptions) -> Aircraft:
    """The aircraft of the options, or that of the airframe, which has an airspeed and a limit of its own."""
    if sim != "jsbsim":
        return uav.aircraft(uav.preset())
    if uav != AircraftOptions():
        raise InvalidArgument("airframe", "has an airspeed and a bank limit of its own: options for them are of no use")
    from loiter.guidance.simulators.airframes import AIRFRAMES

    return AIRFRAMES[airframe].aircraft


def _check_use(sim: Sim, airframe: str | None, gust: float | None, runs: int | None, workers: int | None) -> None:
    """Refuse an option that would change nothing."""
    if sim == "kinematic" and gust is not None:
        raise InvalidArgument("gust", "is of no use with --sim kinematic: the vehicle of the theory flies in calm air")
    if sim != "jsbsim" and airframe is not None:
        raise InvalidArgument("airframe", f"is of no use with --sim {sim}: jsbsim flies airframes")
    if runs is None and workers is not None:
        raise InvalidArgument("workers", "share the flights of --runs: there is one flight")


def _check_files(plot: Path | None, save: Path | None, runs: int | None) -> None:
    """Refuse what cannot be written before anything flies."""
    if plot is not None:
        files.check_format(plot)
        if runs is not None:
            raise InvalidArgument("plot", "draws one flight, not the many of --runs")
        check_writable("plot", plot)
    if save is not None:
        if save.suffix.lower() != ".csv":
            raise InvalidArgument("save", f"is {str(save)!r}: the file name must end in .csv")
        check_writable("save", save)


def _fly_once(trial: Trial, setting: Setting, names: Sequence[str], plot: Path | None, save: Path | None) -> None:
    """One start: the time line of the first law, and a row for each."""
    from loiter.guidance.trials.flight import fly as flown

    flights = {
        name: flown(
            setting.laws[name](trial),
            setting.simulator(trial),
            trial.ideal.orbit,
            band=setting.band,
            exact_switches=setting.exact_switches,
        )
        for name in names
    }
    if plot is not None:
        from loiter.plot.flown import draw

        files.save_figure("plot", plot, draw(trial.ideal, flights))
    if save is not None:
        _save(save, _steps(flights))
    first = flights[names[0]]
    report.write(f"Fastest entry: {report.headline(trial.ideal)}", *_time_line(first), _flights_table(trial, flights))


def _time_line(flight: Flight) -> Iterator[str]:
    """When each phase began, and when the aircraft settled."""
    before, start_s = None, flight.track.time_s[0]
    for time_s, phase, bank in zip(flight.track.time_s, flight.phases, flight.track.bank_deg, strict=False):
        if phase != before:
            yield f"{time_s - start_s:6.1f} s  {phase}, bank {round(bank)} deg"
        before = phase
    yield (
        f"{flight.settled_s:6.1f} s  settled: the full turn within the band begins"
        if flight.settled
        else "Not settled."
    )


def _flights_table(trial: Trial, flights: Mapping[str, Flight]) -> Table:
    rows = _table("law", "settled", "of the fastest", "overshoot", "bank activity", "distance")
    for name, flight in flights.items():
        ideal_s = trial.ideal.duration_s
        rows.add_row(
            name,
            f"{flight.settled_s:.1f} s" if flight.settled else "never",
            f"{flight.settled_s / ideal_s:.2f}" if flight.settled and ideal_s > 0.0 else "",
            f"{flight.overshoot_m:.1f} m",
            f"{flight.bank_rate_deg_s:.1f} deg/s",
            f"{flight.distance_m:.0f} m",
        )
    return rows


def _steps(flights: Mapping[str, Flight]) -> Iterator[Sequence[object]]:
    """A head, and a row for each step of each flight."""
    from loiter.guidance.trials.flight import Track

    yield ["law", *Track._fields, "phase"]
    for name, flight in flights.items():
        columns = [column.tolist() for column in flight.track]
        for *row, phase in zip(*columns, (*flight.phases, flight.phases[-1]), strict=True):
            yield [name, *row, phase.value]


def _fly_many(
    starts: Sequence[Trial], setting: Setting, names: Sequence[str], workers: int | None, save: Path | None
) -> None:
    """Many starts: a row for each law."""
    from loiter.guidance.trials.campaign import campaign

    laws = {name: setting.laws[name] for name in names}
    with _progress() as tell:
        outcomes = campaign(laws, setting.simulator, starts, band=setting.band, workers=workers, progress=tell)
    report.write(_campaign_table(outcomes))
    if save is not None:
        _save(save, _rows(starts, outcomes))


def _campaign_table(outcomes: Mapping[str, Sequence[Outcome]]) -> Table:
    """A row for each law: how its times to settle compare with the fastest entries, and the first law with it."""
    from loiter.guidance.trials.summary import summary

    first = next(iter(outcomes))
    names = ["law", "settled", "round again", "of the fastest", "90 %", "late", "99 %", "overshoot", "bank activity"]
    rows = _table(*names, *([f"{first} is sooner"] * (len(outcomes) > 1)))
    for name, flown in outcomes.items():
        s = summary(flown)
        rows.add_row(
            name,
            f"{s.settled} of {s.flights}",
            f"{s.round_again}",
            f"{s.median_ratio:.3f}",
            f"{s.ninth_decile_ratio:.2f}",
            f"{s.median_late_s:.2f} s",
            f"{s.percentile_99_late_s:.1f} s",
            f"{s.median_overshoot_m:.1f} m",
            f"{s.bank_rate_deg_s:.1f} deg/s",
            *([f"{summary(outcomes[first], flown).sooner:.1%}" if name != first else ""] * (len(outcomes) > 1)),
        )
    return rows


def _rows(starts: Sequence[Trial], outcomes: Mapping[str, Sequence[Outcome]]) -> Iterator[Sequence[object]]:
    """A head, and a row for each flight with its start."""
    from loiter.guidance.trials.campaign import Outcome

    yield ["law", "east_m", "north_m", "heading_deg", "radius_m", *Outcome._fields]
    for name, flown in outcomes.items():
        for trial, outcome in zip(starts, flown, strict=True):
            pose = trial.ideal.start
            yield [name, pose.east_m, pose.north_m, pose.heading_deg, trial.ideal.orbit.radius_m, *outcome]


def _table(*names: str) -> Table:
    rows = report.new_table()
    for name in names:
        rows.add_column(name, justify="left" if name == "law" else "right")
    return rows


def _save(path: Path, rows: Iterator[Sequence[object]]) -> None:
    """Rows as CSV, whole or not at all."""
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerows(rows)
    write_whole("save", path, lambda file: file.write(text.getvalue().encode()))


@contextmanager
def _progress() -> Iterator[Callable[[int, int], None]]:
    """A bar on standard error, where that is a terminal."""
    columns = (TextColumn("flying"), BarColumn(), MofNCompleteColumn(), TimeRemainingColumn())
    with Progress(*columns, console=Console(stderr=True), transient=True, disable=not sys.stderr.isatty()) as bar:
        task = bar.add_task("", total=None)
        yield lambda done, of: bar.update(task, completed=done, total=of)
