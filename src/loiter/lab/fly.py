"""`loiter fly`: guidance laws in closed loop, from one start or from many."""

from __future__ import annotations

import csv
import io
import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

from cyclopts import Group, Parameter
from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

import loiter
from loiter.cli.fences import CheckedFence, FenceFile, FenceOptions, check_fence
from loiter.cli.numbers import whole
from loiter.cli.options import (
    AircraftOptions,
    BandedSlotOptions,
    Files,
    Json,
    Metres,  # noqa: F401  # the type of an inherited option is looked up here
    OrbitOptions,
    PictureOptions,
    StartOptions,
    Whole,
    WindOptions,
    scene,
)
from loiter.cli.output import Output
from loiter.cli.scenes import place_scene, read_slot
from loiter.errors import InvalidArgument, clause
from loiter.lab.replay import replay as show_log
from loiter.planning.model import Aircraft
from loiter.planning.problem import Problem
from loiter.planning.slot import Slot
from loiter.writing import check_writable

if TYPE_CHECKING:
    from loiter.guidance.circle import Band
    from loiter.guidance.protocol import Law
    from loiter.lab.report import Conditions
    from loiter.lab.simulators.airframes import Airframe
    from loiter.lab.trials.campaign import Outcome, Trial
    from loiter.lab.trials.flight import Flight
    from loiter.lab.trials.settings import Setting
    from loiter.planning.maneuver import Maneuver

SimulatorName = Literal["kinematic", "point", "varied", "jsbsim"]
LawName = Literal["optimal", "l1", "vector-field", "tangent"]

# The defaults of --airframe and --gust, used only if the options have an effect.
AIRFRAME, GUST = "aerosonde", 0.05

simulation = Group("Simulation", sort_key=0)


FlyJson = Annotated[
    Json,
    Parameter(help="Print one JSON object: the fastest entry and each law's flight, or summaries of many flights."),
]
Save = Annotated[
    Files, Parameter(help="Write a .csv: each step of one flight, or a row for each of many; may be repeated.")
]


Replay = Annotated[
    Path | None,
    Parameter(
        group=simulation,
        metavar="LOG",
        help="Instead of a simulation: the .csv log of loiter guide; --plot draws it.",
    ),
]


@Parameter(name="*")
@dataclass(frozen=True)
class FlownFenceOptions(FenceOptions):
    """A fence that a simulated flight stays clear of."""

    fence: FenceFile = None
    """The optimal law stays clear of a fence: that of a file, as for loiter plan. Lines say how far each law stayed from it."""


@Parameter(name="*", group=simulation)
@dataclass(frozen=True)
class SimulationOptions:
    """The simulator, the laws and the number of flights."""

    sim: SimulatorName = "point"
    """kinematic: the exact vehicle of the theory. point: with roll response, gusts, noise and delay. varied: with --runs, another aircraft in each, drawn at random, of which the law knows only airspeed and bank limit. jsbsim: six degrees of freedom."""
    law: LawName = "optimal"
    """The guidance law. optimal: the fastest entry, planned anew from each measured state. l1: that of ArduPlane. vector-field: a field of headings that leads onto the circle. tangent: Dubins' path to the nearest tangent point."""
    compare: bool = False
    """Fly all laws from the same start, in the same air."""
    airframe: Literal["aerosonde", "j3cub"] | None = None
    """The airframe for jsbsim, with its own airspeed and bank limit; the Aerosonde if absent."""
    gust: Annotated[float | None, Parameter(metavar="SHARE")] = None
    """Dryden gusts: their standard deviation over the airspeed, 0.05 if absent. Settled means within 5 % of the radius and 5 degrees; from a share of 0.1 on, 10 % and 10 degrees."""
    runs: Whole = None
    """Fly from N random starts instead of --pose: within 6 radii of circles with 1.2 to 4 times the smallest radius that can be held."""
    seed: Annotated[int, Parameter(metavar="N", converter=whole)] = 0
    """Seed of random starts, gusts and noise: the same seed gives the same flights."""
    workers: Whole = None
    """Processes; the number of cores if absent."""

    @property
    def laws(self) -> list[str]:
        """The names of the laws to fly."""
        from loiter.lab.trials.campaign import LAWS

        return list(LAWS) if self.compare else [self.law]

    def fenced_law(self, trial: Trial, fenced: CheckedFence) -> Law:
        """The optimal law that stays clear of a fence; for the point mass alone."""
        from loiter.guidance.entry.fenced_entry import FencedEntry

        if self.sim != "point":
            raise InvalidArgument("fence", f"goes with --sim point, not with --sim {self.sim}")
        known = trial.orbit, trial.known_aircraft, trial.known_wind
        return FencedEntry(*known, fence=fenced.fence, margin_m=fenced.check.margin_m)

    def check(self) -> None:
        """Raise `InvalidArgument` for an option that would have no effect."""
        if self.sim == "kinematic" and self.gust is not None:
            raise InvalidArgument("gust", "has no effect with --sim kinematic: this vehicle flies in calm air")
        if self.sim != "jsbsim" and self.airframe is not None:
            raise InvalidArgument("airframe", f"has no effect with --sim {self.sim}: only jsbsim flies airframes")
        if self.sim == "varied" and self.runs is None:
            raise InvalidArgument("runs", "is needed with --sim varied, which flies another aircraft in each run")
        if self.runs is None and self.workers is not None:
            raise InvalidArgument("workers", "has no effect without --runs: there is only one start")

    def setting(self) -> Setting:
        """The simulator with its laws and its settling band."""
        from loiter.lab.trials import settings

        gust = GUST if self.gust is None else self.gust
        if self.sim == "kinematic":
            return settings.kinematic_setting()
        if self.sim == "varied":
            return settings.varied_setting(gust)
        if self.sim == "point":
            return settings.point_mass_setting(gust)
        return settings.jsbsim_setting(self._airframe(), gust)

    @property
    def conditions(self) -> Conditions:
        """The simulator, airframe, gusts and seed of the flights."""
        from loiter.lab.report import Conditions

        airframe = (self.airframe or AIRFRAME) if self.sim == "jsbsim" else None
        if self.sim == "kinematic":
            # Its flights are all the same; only the random starts of --runs differ.
            return Conditions(self.sim, airframe, None, None if self.runs is None else self.seed)
        return Conditions(self.sim, airframe, GUST if self.gust is None else self.gust, self.seed)

    def trials(self, uav: AircraftOptions, air: WindOptions) -> Sequence[Trial]:
        """The random starts of --runs; with --sim varied each has its own aircraft and wind."""
        from loiter.lab.trials import campaign, varied

        assert self.runs is not None  # only --runs flies random starts
        runs = self.runs
        if self.sim != "varied":
            return campaign.trials(runs, self.seed, self.aircraft(uav), air.moving_air)
        if given := [*uav.names_given, *(["--wind"] if air.wind is not None else [])]:
            raise InvalidArgument("sim", f"varied draws aircraft and wind at random: {given[0]} has no effect")
        return varied.varied_trials(runs, self.seed)

    def aircraft(self, uav: AircraftOptions) -> Aircraft:
        """The aircraft of the options, or that of the airframe, which has its own airspeed and bank limit."""
        if self.sim != "jsbsim":
            return uav.aircraft
        if given := uav.names_given:
            raise InvalidArgument("sim", f"jsbsim flies an airframe with its own limits: {given[0]} has no effect")
        return self._airframe().aircraft

    def _airframe(self) -> Airframe:
        from loiter.lab.simulators.airframes import AIRFRAMES

        return AIRFRAMES[self.airframe or AIRFRAME]


@Parameter(name="*", group=scene)
@dataclass(frozen=True)
class FlownSlotOptions(BandedSlotOptions):
    """A slot that the law enters and keeps."""

    def slot_for(self, simulated: SimulationOptions) -> Slot | None:
        """The slot; None without one. Raises `InvalidArgument` where the options do not fit together."""
        if self.slot is None:
            self.check_absent("no --slot")
            return None
        if simulated.laws != ["optimal"]:
            raise InvalidArgument("slot", "is for the law optimal alone: the others keep no slot")
        return read_slot(self.slot, 0.0 if self.slot_at is None else self.slot_at)

    def check_absent(self, where: str) -> None:
        """Raise `InvalidArgument` for an option that has no effect."""
        for name, value in (("slot", self.slot), ("slot_at_s", self.slot_at), ("slot_band", self.slot_band)):
            if value is not None:
                raise InvalidArgument(name, f"has no effect with {where}")

    @property
    def band(self) -> float:
        """The band of the hold."""
        from loiter.guidance.entry.slot_entry import BAND

        return BAND if self.slot_band is None else self.slot_band

    @property
    def settling_band(self) -> Band:
        """What counts as on the circle: the band of the hold more than elsewhere, and courses in and out of it."""
        from loiter.guidance.circle import Band
        from loiter.lab.trials.settings import HEAVY_GUST_BAND, STANDARD_BAND

        return Band(STANDARD_BAND.radial + self.band, HEAVY_GUST_BAND.course_deg)

    def law(self, trial: Trial, slot: Slot) -> Law:
        """The law for the start of a trial, in the direction of its plan."""
        from loiter.guidance.entry.slot_entry import SlotEntry

        return SlotEntry(trial.orbit, trial.known_aircraft, trial.known_wind, slot=slot, band=self.band)


def fly(
    *,
    replay: Replay = None,
    simulated: SimulationOptions = SimulationOptions(),
    slotted: FlownSlotOptions = FlownSlotOptions(),
    start: StartOptions = StartOptions(),
    circle: OrbitOptions = OrbitOptions(),
    uav: AircraftOptions = AircraftOptions(),
    air: WindOptions = WindOptions(),
    fence: FlownFenceOptions = FlownFenceOptions(),
    json: FlyJson = False,
    pictures: PictureOptions = PictureOptions(),
    save: Save = (),
) -> None:
    """Simulate flights of the fastest entry in closed loop, compared with the laws that autopilots use today."""
    from loiter.lab.trials import campaign

    wanted = Output(json, pictures, save)
    if replay is not None:
        _replay(replay, (simulated, slotted, start, circle, uav, air, fence), wanted)
        return
    simulated.check()
    _check_files(wanted, simulated.runs)
    if simulated.runs is None:
        pose, orbit, frame = place_scene(start, circle, air, uav.preset)
        aimed = slotted.slot_for(simulated)
        if aimed and fence.fence is not None:
            raise InvalidArgument("fence", "does not go with --slot")
        if aimed:
            circle.check_unfenced("with --slot")
        ideal = loiter.plan(pose, orbit, simulated.aircraft(uav), air.moving_air, slot=aimed)
        fenced = None if aimed else check_fence(fence, circle.site, ideal, frame)
        _fly_once(campaign.Trial(ideal, simulated.seed), simulated, wanted, slotted, aimed, fenced)
        return
    slotted.check_absent("--runs")
    if fence != FlownFenceOptions():
        raise InvalidArgument("fence", "goes with --pose-lla and --orbit-lla, not with the random starts of --runs")
    if (start, circle) != (StartOptions(), OrbitOptions()):
        raise InvalidArgument("runs", "selects random starts and circles: --pose and --orbit have no effect")
    air.check_declination()
    _fly_many(simulated.trials(uav, air), simulated, wanted)


def _replay(log: Path, others: tuple[object, ...], wanted: Output) -> None:
    """Replay a log; `others` are the options that have no effect with it."""
    if wanted.save or any(option != type(option)() for option in others):
        raise InvalidArgument("replay", "shows a flight that was flown: it takes no options but --plot and --json")
    _check_files(wanted, None)
    show_log(log, wanted)


def _check_files(wanted: Output, runs: int | None) -> None:
    """Raise `InvalidArgument` before anything flies if a file could not be written."""
    wanted.check(_check_table)
    for path in wanted.pictures.plot:
        if runs is not None:
            raise InvalidArgument("plot", "draws one flight, not the many of --runs")
        check_writable("plot", path)


def _check_table(path: Path) -> None:
    if path.suffix.lower() != ".csv":
        raise InvalidArgument("save", f"is {str(path)!r}: the file name must end in .csv")
    check_writable("save", path)


def _fly_once(
    trial: Trial,
    simulated: SimulationOptions,
    wanted: Output,
    slotted: FlownSlotOptions,
    aimed: Slot | None,
    fenced: CheckedFence | None,
) -> None:
    """Fly laws from one start: write the time line of the first law, and a table with a row for each.

    `aimed` is the slot of `slotted`, if it has one. With a fence the optimal law stays clear of it, and flights are compared with the clear entry.
    """
    from loiter.guidance.entry.slot_entry import SlotEntry
    from loiter.lab import report as shown
    from loiter.lab.trials.flight import fly as fly_law

    setting, conditions = simulated.setting(), simulated.conditions
    entry = "Fastest entry"
    if fenced is not None and (clear := _clear_entry(trial.ideal, fenced)) is not None:
        trial, entry = replace(trial, ideal=clear), "Clear entry"
    laws = {name: slotted.law(trial, aimed) if aimed else setting.laws[name](trial) for name in simulated.laws}
    if fenced is not None and "optimal" in laws:
        laws["optimal"] = simulated.fenced_law(trial, fenced)
    band = slotted.settling_band if aimed else setting.band
    flights = {
        name: fly_law(
            law, setting.simulator(trial), trial.ideal.orbit, band=band, exact_switches=setting.exact_switches
        )
        for name, law in laws.items()
    }
    if wanted.pictures.plot:
        from loiter.lab.picture import draw

        zones = None if fenced is None else fenced.fence
        figure = draw(trial.ideal, flights, conditions=conditions.title, fence=zones)
        wanted.draw(figure)
    wanted.write(lambda _: _table(_steps(flights)))
    first, *_ = flights
    lines = [f"{entry}: {trial.ideal}", conditions.line, *shown.time_line(first, flights[first])]
    document = shown.flights_document(trial, flights) | {"simulation": conditions._asdict()}
    if isinstance(law := laws[first], SlotEntry):
        kept = shown.slot_kept(law, flights[first])
        document |= {"slot": kept._asdict()}
        lines.append(kept.line)
    if fenced is not None:
        margin_m = fenced.check.margin_m
        least_m = {name: fenced.least_m(flight.track.east_m, flight.track.north_m) for name, flight in flights.items()}
        lines += [f"Law {name}: {shown.kept_sentence(least, margin_m)}" for name, least in least_m.items()]
        document |= {"fence": {"margin_m": margin_m, "clearance_m": least_m}}
    wanted.show(document, *lines, shown.flights_table(trial, flights))


def _clear_entry(ideal: Maneuver, fenced: CheckedFence) -> Maneuver | None:
    """The fastest clear entry found; None where the fastest entry is clear. Raises `InvalidArgument` without any."""
    found = fenced.clear_entry(Problem(ideal.start, ideal.orbit, ideal.aircraft, ideal.wind))
    if found is not None and found.maneuver is None:
        raise InvalidArgument("fence", f"leaves no way: {clause(found.sentence)}")
    return None if found is None else found.maneuver


def _steps(flights: Mapping[str, Flight]) -> Iterator[Sequence[object]]:
    """A header, and a row for each step of each flight."""
    from loiter.lab.trials.flight import FlightTrack

    yield ["law", *FlightTrack._fields, "phase"]
    for name, flight in flights.items():
        columns = [column.tolist() for column in flight.track]
        *_, last_phase = flight.phases
        for *row, phase in zip(*columns, (*flight.phases, last_phase), strict=True):
            yield [name, *row, phase.value]


def _fly_many(starts: Sequence[Trial], simulated: SimulationOptions, wanted: Output) -> None:
    """Fly laws from many starts, and write a table with a row for each law."""
    from loiter.lab import report as shown
    from loiter.lab.trials.campaign import campaign

    setting, conditions, workers = simulated.setting(), simulated.conditions, simulated.workers
    laws = {name: setting.laws[name] for name in simulated.laws}
    with _progress_bar() as progress:
        outcomes = campaign(laws, setting.simulator, starts, band=setting.band, workers=workers, progress=progress)
    wanted.write(lambda _: _table(_rows(starts, outcomes)))
    document = shown.campaign_document(outcomes) | {"simulation": conditions._asdict()}
    wanted.show(document, conditions.line, shown.campaign_table(outcomes))


def _rows(starts: Sequence[Trial], outcomes: Mapping[str, Sequence[Outcome]]) -> Iterator[Sequence[object]]:
    """A header, and a row for each flight with its start."""
    from loiter.lab.trials.campaign import Outcome

    yield ["law", "east_m", "north_m", "heading_deg", "radius_m", *Outcome._fields]
    for name, flown in outcomes.items():
        for trial, outcome in zip(starts, flown, strict=True):
            pose = trial.ideal.start
            yield [name, pose.east_m, pose.north_m, pose.heading_deg, trial.ideal.orbit.radius_m, *outcome]


def _table(rows: Iterator[Sequence[object]]) -> bytes:
    """Rows as CSV."""
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerows(rows)
    return text.getvalue().encode()


@contextmanager
def _progress_bar() -> Iterator[Callable[[int, int], None]]:
    """A progress bar on standard error, if that is a terminal."""
    columns = (TextColumn("flying"), BarColumn(), MofNCompleteColumn(), TimeRemainingColumn())
    with Progress(*columns, console=Console(stderr=True), transient=True, disable=not sys.stderr.isatty()) as bar:
        task = bar.add_task("", total=None)
        yield lambda done, of: bar.update(task, completed=done, total=of)
