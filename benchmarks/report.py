"""The table and the plot of the results.

`python -m benchmarks.report docs/performance.md docs/performance.png` draws the plot of the tables in a document.
"""

import os
import platform
import re
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from benchmarks.tables import Run
from benchmarks.timing import Row
from loiter.plot.files import save_figure
from loiter.plot.picture import COLOURS


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


def read(text: str) -> tuple[list[Row], list[Run]]:
    """The results in a document with the tables of `table`; numbers have as many digits as there."""
    rows: list[Row] = []
    runs: list[Run] = []
    task, in_batch = "", False
    for line in text.splitlines():
        if line.startswith("## "):
            task, in_batch = line.removeprefix("## "), "loiter batch" in line
        if not line.startswith("|"):
            continue
        cells = [cell.strip().replace("\\|", "|") for cell in re.split(r"(?<!\\)\|", line.strip().strip("|"))]
        if in_batch and len(cells) == 7 and cells[0].replace(",", "").isdigit():
            number, output, workers, seconds, _, _, peak = cells
            size = int(number.replace(",", ""))
            runs.append(Run(output, size, int(workers), float(seconds), float(peak.removesuffix(" MiB"))))
        elif not in_batch and len(cells) == 5 and cells[0] and not cells[0].startswith("---"):
            contender, seconds, ratio, largest, mean = cells
            rows.append(Row(task, contender, _seconds(seconds), _ratio(ratio), *map(_error, (largest, mean))))
    return rows, runs


def _seconds(text: str) -> float:
    number, unit = text.split()
    return float(number) * {"s": 1.0, "ms": 1e-3, "µs": 1e-6, "ns": 1e-9}[unit]


def _ratio(text: str) -> float:
    return 1.0 / float(text.removeprefix("1/").replace(",", "")) if text.startswith("1/") else float(text)


def _error(text: str) -> float:
    return float(text) if text else float("nan")


# The colours of the other pictures.
OURS, OTHERS = COLOURS["S"], "#606060"
OUTPUT_COLOURS = {"dataset": COLOURS["L"], "file": COLOURS["R"]}
DASHES: dict[int, Any] = {1: (0, (4, 2)), 2: "-"}

# Offsets of labels, points: the exact methods are close together.
LABELS = {"plain formulas, Numba": (0, 12), "plain formulas, NumPy": (8, -3), "loiter.min_time": (-4, 24)}


def draw(rows: Sequence[Row], runs: Sequence[Run]) -> Figure:
    """Plot the accuracy over the time per state and, where tables were measured, the rows per second over rows."""
    figure = Figure(figsize=(10.0, 4.4), layout="constrained")
    left, *right = figure.subplots(1, 2 if runs else 1, squeeze=False)[0]
    _draw_accuracy(left, rows)
    for axes in right:
        _draw_speed(axes, runs)
    for axes in (left, *right):
        axes.grid(color="#e6e6e6", linewidth=0.8)
        axes.set_axisbelow(True)
    return figure


def _draw_accuracy(axes: Axes, rows: Sequence[Row]) -> None:
    hidden = ("control", "solve", "threads")
    shown = {
        row.contender: row
        for row in rows
        if row.task.startswith("R = 1") and "< 40" not in row.task and not any(word in row.contender for word in hidden)
    }
    for name, row in shown.items():
        place = (row.seconds, max(row.mean, 1e-17))
        ours = name.startswith("loiter")
        style = {"marker": "o" if ours else "s", "color": OURS if ours else OTHERS, "markersize": 8 if ours else 6}
        axes.loglog(*place, linestyle="none", gid=name, **style)
        colour = OURS if ours else "black"
        offset = LABELS.get(name, (8, -3))
        axes.annotate(name, place, offset, textcoords="offset points", fontsize="small", color=colour)
    axes.set(xlabel="time per state (s)", ylabel="mean error of T (turn radii over airspeed)")
    axes.set_title("Accuracy and time: R = 1, either direction", fontsize="medium")
    axes.set_xlim(3e-9, 1e3)
    axes.set_ylim(1e-17, 1e1)


def _draw_speed(axes: Axes, runs: Sequence[Run]) -> None:
    for output, workers in sorted({(run.output, run.workers) for run in runs}):
        here = [run for run in runs if (run.output, run.workers) == (output, workers)]
        axes.semilogx(
            [run.rows for run in here],
            [1e-6 * run.rows / run.seconds for run in here],
            marker="o",
            color=OUTPUT_COLOURS[output],
            linestyle=DASHES.get(workers, "-"),
            label=f"{output}, {workers} worker" + ("s" if workers > 1 else ""),
            gid=f"{output} {workers}",
        )
    axes.set(xlabel="rows of the table", ylabel="rows per second (millions)")
    axes.set_title("loiter batch, Parquet to Parquet", fontsize="medium")
    axes.set_ylim(bottom=0.0)
    axes.legend(loc="best", fontsize="small", framealpha=0.9, handlelength=3.2)


if __name__ == "__main__":
    _, document, picture = sys.argv
    save_figure(Path(picture), draw(*read(Path(document).read_text("utf-8"))))
