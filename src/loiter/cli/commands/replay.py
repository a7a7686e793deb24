"""`loiter fly --replay`: the log of a guided flight as a time line and a picture."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from math import isnan
from pathlib import Path
from typing import Any

from loiter.cli import report
from loiter.errors import InvalidArgument, MissingPackage
from loiter.io.flight_log import check_columns, read_log
from loiter.plot import files


def replay(log: Path, plot: Path | None) -> None:
    """Print the time line of a log, and draw it if `plot` is a file."""
    columns = _read(log)
    if not columns["time_s"]:
        raise InvalidArgument("replay", f"is {str(log)!r}: it has no steps")
    if plot is not None:
        from loiter.plot.guided import draw

        files.save_figure("plot", plot, draw(columns))
    report.write(*_time_line(columns), _summary(columns))


def _read(path: Path) -> Mapping[str, Sequence[Any]]:
    if path.suffix.lower() != ".parquet":
        return read_log(path)
    try:
        from loiter.batch.tables.flight_logs import read_parquet
    except ImportError as error:
        raise MissingPackage(f'Parquet needs {error.name}: pip install "loiter[cluster]" brings it') from error
    columns = read_parquet(path)
    check_columns(path, list(columns))
    return columns


def _time_line(log: Mapping[str, Sequence[Any]]) -> Iterator[str]:
    """The time at which each stage and phase begins."""
    previous: tuple[str, str] | None = None
    for time_s, stage, phase, command in zip(
        log["time_s"], log["stage"], log["phase"], log["command_deg"], strict=True
    ):
        if (stage, phase) != previous:
            yield f"{time_s:6.1f} s  {stage}: {phase}, bank {command:.0f} deg commanded"
        previous = stage, phase


def _summary(log: Mapping[str, Sequence[Any]]) -> str:
    """The steps, and the mean distance from the circle while it was held."""
    held = [
        outside
        for outside, stage in zip(log["outside_m"], log["stage"], strict=True)
        if stage == "holding" and not isnan(outside)
    ]
    time_s = log["time_s"][-1] - log["time_s"][0]
    steps = f"{len(log['time_s'])} steps in {time_s:.1f} s"
    if not held:
        return f"{steps}; the circle was not reached."
    mean_m = sum(held) / len(held)
    side = "outside" if mean_m >= 0.0 else "inside"
    return f"{steps}; on the circle {abs(mean_m):.1f} m {side} in the mean, {max(map(abs, held)):.1f} m at most."
