"""The table and the plot of the results."""

import os
import platform
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from benchmarks.states import Row
from benchmarks.tables import Run


def table(rows: Sequence[Row], runs: Sequence[Run]) -> str:
    """All results, as Markdown."""
    lines = [f"Measured on {processor()}, {os.cpu_count()} cores, Python {platform.python_version()}.", ""]
    for task in dict.fromkeys(row.task for row in rows):
        lines += [
            f"## {task}",
            "",
            "| | a state | of the first | largest error of T | mean error |",
            "|---|---:|---:|---:|---:|",
        ]
        for row in rows:
            if row.task == task:
                errors = f"{error(row.largest)} | {error(row.mean)}"
                name = row.contender.replace("|", "\\|")
                lines.append(f"| {name} | {duration(row.seconds)} | {share(row.ratio)} | {errors} |")
        lines.append("")
    return "\n".join(lines + (_batch(runs) if runs else []))


def _batch(runs: Sequence[Run]) -> list[str]:
    lines = ["## loiter batch, Parquet to Parquet", ""]
    lines += ["| rows | output | workers | seconds | rows/s | of one worker | peak memory |"]
    lines += ["|---:|---|---:|---:|---:|---:|---:|"]
    alone = {(run.output, run.rows): run.seconds for run in runs if run.workers == 1}
    for run in runs:
        speed, ratio = run.rows / run.seconds, run.seconds / alone[run.output, run.rows]
        cells = (
            f"{run.rows:,}",
            run.output,
            run.workers,
            f"{run.seconds:.1f}",
            f"{speed:,.0f}",
            f"{ratio:.2f}",
            f"{run.peak_mib:.0f} MiB",
        )
        lines.append("| " + " | ".join(map(str, cells)) + " |")
    return [*lines, ""]


def processor() -> str:
    """The name of the processor, where the system gives it; otherwise the architecture."""
    fields = (line.partition(":") for line in _cpuinfo())
    return next((value.strip() for name, _, value in fields if name.startswith("model name")), platform.machine())


def _cpuinfo() -> list[str]:
    try:
        return Path("/proc/cpuinfo").read_text().splitlines()
    except OSError:
        return []


def duration(seconds: float) -> str:
    """Seconds with three digits, in the unit that fits."""
    for unit, size in (("s", 1.0), ("ms", 1e-3), ("µs", 1e-6)):
        if seconds >= size:
            return f"{seconds / size:.3g} {unit}"
    return f"{seconds * 1e9:.3g} ns"


def share(ratio: float) -> str:
    """A ratio to the first line of its table."""
    return f"{ratio:.3g}" if ratio >= 1e-3 else f"1/{1.0 / ratio:,.0f}"


def error(value: float) -> str:
    """An error of T; empty for nan."""
    return "" if value != value else f"{value:.1e}"


def draw(rows: Sequence[Row], runs: Sequence[Run], path: Path) -> None:
    """Plot the accuracy over seconds per state, and the rows per second over rows."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(11.0, 4.6), layout="constrained")
    left, right = figure.subplots(1, 2)
    _draw_accuracy(left, rows)
    _draw_speed(right, runs)
    figure.savefig(path, dpi=150)


def _draw_accuracy(axes: Any, rows: Sequence[Row]) -> None:
    hidden = ("control", "solve", "threads")
    shown = {
        row.contender: row
        for row in rows
        if row.task.startswith("R = 1") and "< 40" not in row.task and not any(word in row.contender for word in hidden)
    }
    for name, row in shown.items():
        ours = name.startswith("loiter")
        axes.loglog(row.seconds, max(row.mean, 1e-17), "o" if ours else "s", color="C0" if ours else "0.5")
        # The points of the three exact methods are close together: their labels are at different heights.
        height = 20 if ours else -11 if "NumPy" in name else 5
        place = {"xytext": (0 if ours else 6, height), "textcoords": "offset points", "fontsize": 8}
        axes.annotate(name, (row.seconds, max(row.mean, 1e-17)), **place)
    axes.set(xlabel="seconds a state", ylabel="mean error of T", title="R = 1, either way")
    left, right = axes.get_xlim()
    axes.set_xlim(left, right * 100.0)
    axes.grid(alpha=0.3)


def _draw_speed(axes: Any, runs: Sequence[Run]) -> None:
    for output, workers in sorted({(run.output, run.workers) for run in runs}):
        here = [run for run in runs if (run.output, run.workers) == (output, workers)]
        label = f"{output}, {workers} worker" + ("s" if workers > 1 else "")
        axes.loglog([run.rows for run in here], [run.rows / run.seconds for run in here], "o-", label=label)
    axes.set(xlabel="rows", ylabel="rows a second", title="loiter batch, Parquet to Parquet")
    axes.grid(alpha=0.3)
    if runs:
        axes.legend(frameon=False)
