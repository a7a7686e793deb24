"""Flights in closed loop as text and as JSON: `loiter fly`."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import fields, replace
from itertools import groupby
from math import isfinite, isnan
from operator import itemgetter
from statistics import median
from typing import TYPE_CHECKING, Any, NamedTuple

from rich.table import Table

from loiter.cli import report
from loiter.files.document import maneuver_values
from loiter.lab.trials.summary import CampaignSummary, summary

if TYPE_CHECKING:
    from loiter.guidance.entry.slot_entry import SlotEntry
    from loiter.lab.trials.campaign import Outcome, Trial
    from loiter.lab.trials.flight import Flight


# The law that plans its phases, as --law names it.
PLANNED_LAW = "optimal"

# The simulators of --sim.
SIMULATORS = {
    "kinematic": "the vehicle of the theory, which banks at once, in calm air",
    "point": "a point mass with roll response, noise and delay",
    "varied": "point masses drawn at random, of which the law knows airspeed and bank limit alone",
    "jsbsim": "six degrees of freedom in JSBSim, with noise and delay",
}


class Conditions(NamedTuple):
    """How flights were simulated: with the same values and the same scene they can be repeated.

    `gust` is the standard deviation of the gusts over the airspeed. None stands for what has no effect.
    """

    sim: str
    airframe: str | None
    gust: float | None
    seed: int | None

    @property
    def line(self) -> str:
        """One line: "Flown with --sim point --gust 0.05 --seed 0: a point mass with roll response, ..."."""
        options = " ".join(f"--{name} {_plain(value)}" for name, value in self._given)
        return f"Flown with {options}: {SIMULATORS[self.sim]}."

    @property
    def title(self) -> str:
        """The same in a few words, for a picture: "simulator point, gusts 0.05 of the airspeed, seed 0"."""
        words = {
            "sim": "simulator {}",
            "airframe": "airframe {}",
            "gust": "gusts {} of the airspeed",
            "seed": "seed {}",
        }
        return ", ".join(words[name].format(_plain(value)) for name, value in self._given)

    @property
    def _given(self) -> list[tuple[str, str | float | int]]:
        return [(name, value) for name, value in self._asdict().items() if value is not None]


def _plain(value: str | float | int) -> str:
    return f"{value:g}" if isinstance(value, float) else str(value)


class PhaseFlown(NamedTuple):
    """The time at which a phase begins, and the bank commanded during it, the median, degrees, positive to the right.

    The first command of a phase would be no help: to leave a turn quickly, the law commands the opposite bank.
    """

    time_s: float
    phase: str
    commanded_bank_deg: float


def phases_flown(flight: Flight) -> Iterator[PhaseFlown]:
    """The phases in the order flown."""
    steps = zip(flight.phases, flight.track.elapsed_s.tolist(), flight.track.commanded_bank_deg.tolist(), strict=False)
    for phase, run in groupby(steps, key=itemgetter(0)):
        _, times_s, banks_deg = zip(*run, strict=True)
        yield PhaseFlown(times_s[0], phase.value, median(banks_deg))


def time_line(name: str, flight: Flight) -> Iterator[str]:
    """The time at which each phase begins, then when the aircraft joined and settled.

    Only the law `optimal` plans its phases; what the others do changes at almost every step, and is not listed.
    """
    if name == PLANNED_LAW:
        for time_s, phase, bank in phases_flown(flight):
            yield f"{time_s:6.1f} s  {phase}, commanded bank {round(bank)} deg"
    else:
        yield f"{name} plans no phases: --save FILE.csv writes every step."
    if flight.settled:
        yield f"{flight.joined_s:6.1f} s  joined: within the band, and from then on within twice the band"
    yield (
        f"{flight.settled_s:6.1f} s  settled: start of a full turn within the band"
        if flight.settled
        else "Not settled."
    )


# An aircraft is in its slot within this error of phase, degrees, and then stays within twice that.
PHASE_DEG = 5.0


class SlotKept(NamedTuple):
    """When an aircraft on its circle was within 5 degrees of its slot for good, and the largest error since then.

    "For good" is within 10 degrees until the end of the flight.

    Seconds and degrees, None where it never was.
    """

    joined_s: float | None
    largest_deg: float | None

    @property
    def line(self) -> str:
        """One line."""
        if self.joined_s is None:
            return "Not in its slot."
        return f"{self.joined_s:6.1f} s  in its slot; from then on within {self.largest_deg:.1f} degrees of it"


def slot_kept(law: SlotEntry, flight: Flight) -> SlotKept:
    """How an aircraft kept its slot."""
    track = flight.track
    places = zip(track.time_s.tolist(), track.east_m.tolist(), track.north_m.tolist(), strict=True)
    errors = [abs(law.phase_error_deg(*place)) for place in places]
    if not flight.settled:
        return SlotKept(None, None)
    since = next((len(errors) - i for i, error in enumerate(reversed(errors)) if error > 2.0 * PHASE_DEG), 0)
    since = max(since, int((track.elapsed_s < flight.joined_s).sum()))
    first = next((i for i in range(since, len(errors)) if errors[i] <= PHASE_DEG), None)
    if first is None:
        return SlotKept(None, None)
    return SlotKept(float(track.elapsed_s[first]), max(errors[first:]))


def flights_table(trial: Trial, flights: Mapping[str, Flight]) -> Table:
    """A table with a row for each law."""
    rows = _table("law", "joined", "settled", "of the fastest", "overshoot", "bank activity", "distance")
    for name, flight in flights.items():
        ratio = _ratio(trial, flight)
        rows.add_row(
            name,
            f"{flight.joined_s:.1f} s" if flight.settled else "never",
            f"{flight.settled_s:.1f} s" if flight.settled else "never",
            f"{ratio:.2f}" if ratio is not None else "",
            f"{flight.overshoot_m:.1f} m",
            f"{flight.bank_rate_deg_s:.1f} deg/s",
            f"{flight.distance_m:.0f} m",
        )
    return rows


def flights_document(trial: Trial, flights: Mapping[str, Flight]) -> dict[str, object]:
    """The fastest entry, and the flight of each law, as plain values."""
    return {"fastest": maneuver_values(trial.ideal), "laws": [_flight(trial, *item) for item in flights.items()]}


def _flight(trial: Trial, name: str, flight: Flight) -> dict[str, object]:
    return {
        "law": name,
        "joined_s": report.json_value(flight.joined_s),
        "settled_s": report.json_value(flight.settled_s),
        "of_the_fastest": _ratio(trial, flight),
        "overshoot_m": flight.overshoot_m,
        "bank_rate_deg_s": flight.bank_rate_deg_s,
        "distance_m": flight.distance_m,
        "phases": [phase._asdict() for phase in phases_flown(flight)],
    }


def kept_sentence(least_m: float, margin_m: float) -> str:
    """How far a flight stayed from a fence."""
    if least_m < 0.0:
        return f"enters a zone of the fence by up to {-least_m:.1f} m."
    return f"stays {least_m:.1f} m from the fence at least; the margin of plans is {margin_m:g} m."


def campaign_table(outcomes: Mapping[str, Sequence[Outcome]]) -> Table:
    """A row for each law: its settling times relative to the fastest entries, and how often the first law is sooner."""
    names = ["law", "settled", "round again", "of the fastest", "90 %", "late", "99 %", "overshoot", "bank activity"]
    rows = _table(*names, *([f"{next(iter(outcomes))} is sooner"] * (len(outcomes) > 1)))
    for name, s in _summaries(outcomes).items():
        rows.add_row(
            name,
            f"{s.settled} of {s.flights}",
            f"{s.round_again}",
            _or_never(s.median_ratio, ".3f"),
            _or_never(s.ninth_decile_ratio, ".2f"),
            _or_never(s.median_late_s, ".2f", " s"),
            _or_never(s.percentile_99_late_s, ".1f", " s"),
            f"{s.median_overshoot_m:.1f} m",
            f"{s.bank_rate_deg_s:.1f} deg/s",
            *([f"{s.sooner:.1%}" if isfinite(s.sooner) else ""] * (len(outcomes) > 1)),
        )
    return rows


def _or_never(value: float, decimals: str, unit: str = "") -> str:
    """A figure as text: "never" where so many flights did not settle that it is infinite, empty for nan."""
    if isnan(value):
        return ""
    return f"{value:{decimals}}{unit}" if isfinite(value) else "never"


def campaign_document(outcomes: Mapping[str, Sequence[Outcome]]) -> dict[str, object]:
    """The fields of `CampaignSummary` for each law, with `sooner` as the share in which the first law is sooner."""
    return {"laws": [{"law": name, **_fields(s)} for name, s in _summaries(outcomes).items()]}


def _summaries(outcomes: Mapping[str, Sequence[Outcome]]) -> dict[str, CampaignSummary]:
    """The summary of each law; `sooner` is how often the first law settled sooner than it, nan for the first."""
    first, *_ = outcomes
    summaries = {}
    for name, flown in outcomes.items():
        compared = summary(outcomes[first], flown).sooner if name != first else float("nan")
        summaries[name] = replace(summary(flown), sooner=compared)
    return summaries


def _fields(s: CampaignSummary) -> dict[str, Any]:
    return {field.name: report.json_value(getattr(s, field.name)) for field in fields(s)}


def _ratio(trial: Trial, flight: Flight) -> float | None:
    """The settling time over the duration of the fastest entry; None where one of them is missing or 0."""
    ideal_s = trial.ideal.duration_s
    return flight.settled_s / ideal_s if flight.settled and ideal_s > 0.0 else None


def _table(*names: str) -> Table:
    rows = report.new_table()
    for name in names:
        rows.add_column(name, justify="left" if name == "law" else "right")
    return rows
