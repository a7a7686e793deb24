"""`loiter fly --replay`: the log of a guided flight as a time line and a picture."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import groupby
from math import isnan, nan
from operator import itemgetter
from pathlib import Path
from statistics import median
from typing import Any, NamedTuple

from loiter.cli.output import Output
from loiter.cli.report import json_value
from loiter.errors import InvalidArgument
from loiter.files.flight_log import read_log


class StageFlown(NamedTuple):
    """The time at which a stage or phase of a guided flight begins, and the bank commanded during it, degrees.

    The bank is the median, as in `cli.flights.PhaseFlown`; nan if nothing was commanded.
    """

    time_s: float
    stage: str
    phase: str
    commanded_bank_deg: float


class Held(NamedTuple):
    """How far the vehicle was from the circle while it was held, metres: in the mean, positive outside, and at most."""

    mean_outside_m: float
    most_off_m: float


def replay(log: Path, wanted: Output) -> None:
    """Show the time line of a log, and draw it to the pictures of `wanted`."""
    columns: Mapping[str, Sequence[Any]] = read_log(log)
    if not columns["time_s"]:
        raise InvalidArgument("replay", f"is {str(log)!r}: it has no steps")
    if wanted.pictures.plot:
        from loiter.lab.log_picture import draw

        wanted.draw(draw(columns))
    stages, held = list(_stages_flown(columns)), _held(columns)
    document = {
        "steps": len(columns["time_s"]),
        "duration_s": columns["time_s"][-1] - columns["time_s"][0],
        "phases": [{name: json_value(value) for name, value in stage._asdict().items()} for stage in stages],
        "circle": None if held is None else held._asdict(),
    }
    wanted.show(document, *map(_line, stages), _summary(columns, held))


def _stages_flown(log: Mapping[str, Sequence[Any]]) -> Iterator[StageFlown]:
    """The stages and phases in the order flown."""
    steps = zip(log["stage"], log["phase"], log["time_s"], log["command_deg"], strict=True)
    for (stage, phase), run in groupby(steps, key=itemgetter(0, 1)):
        _, _, times_s, banks_deg = zip(*run, strict=True)
        commanded = [bank for bank in banks_deg if not isnan(bank)]
        yield StageFlown(times_s[0], stage, phase, median(commanded) if commanded else nan)


def _line(flown: StageFlown) -> str:
    bank = flown.commanded_bank_deg
    commanded = "no bank commanded" if isnan(bank) else f"commanded bank {round(bank)} deg"
    return f"{flown.time_s:6.1f} s  {flown.stage}: {flown.phase}, {commanded}"


def _held(log: Mapping[str, Sequence[Any]]) -> Held | None:
    """The distances from the circle while it was held; None if it was not reached."""
    outside_m = [
        outside
        for outside, stage in zip(log["outside_m"], log["stage"], strict=True)
        if stage == "holding" and not isnan(outside)
    ]
    return Held(sum(outside_m) / len(outside_m), max(map(abs, outside_m))) if outside_m else None


def _summary(log: Mapping[str, Sequence[Any]], held: Held | None) -> str:
    """The steps, and the mean distance from the circle while it was held."""
    time_s = log["time_s"][-1] - log["time_s"][0]
    steps = f"{len(log['time_s'])} steps in {time_s:.1f} s"
    if held is None:
        return f"{steps}; the circle was not reached."
    side = "outside" if held.mean_outside_m >= 0.0 else "inside"
    mean_m, most_m = abs(held.mean_outside_m), held.most_off_m
    return f"{steps}; on the circle {mean_m:.1f} m {side} in the mean, {most_m:.1f} m at most."
