"""The tables of docs/performance.md: what the benchmarks write, they read, and the picture shows."""

from pathlib import Path

import pytest

from benchmarks.report import draw, read, table
from benchmarks.tables import Run
from benchmarks.timing import Row

DOCUMENT = Path(__file__).parents[2] / "docs" / "performance.md"
ROWS = [
    Row("R = 1, either, |x|, |y| < 4", "plain formulas, Numba", 52.2e-9, 1.0, 4.4e-15, 2.6e-16),
    Row("R = 1, either, |x|, |y| < 4", "loiter.min_time", 13.2e-9, 0.253, 1.8e-15, 2.3e-16),
    Row("wind", "one scene, |w| < 0.6", 54.4e-6, 1.0 / 5443.0, 1e-13, 1e-14),
]
RUNS = [Run("dataset", 10_000_000, 1, 4.7, 209.0), Run("dataset", 10_000_000, 2, 2.8, 264.0)]


def test_what_is_written_is_read():
    rows, runs = read(table(ROWS, RUNS))
    assert [row[:2] for row in rows] == [row[:2] for row in ROWS]
    for found, row in zip(rows, ROWS, strict=True):
        assert found[2:] == pytest.approx(row[2:], rel=1e-3)
    assert runs == RUNS


def test_the_picture_shows_the_tables_of_the_document():
    rows, runs = read(DOCUMENT.read_text("utf-8"))
    accuracy, speed = draw(rows, runs).axes
    shown = {line.get_gid(): (line.get_xdata()[0], line.get_ydata()[0]) for line in accuracy.get_lines()}
    assert shown["CasADi, IPOPT"] == (0.804, 2.7e-9)
    assert set(shown) >= {"loiter.min_time", "plain formulas, NumPy", "OMPL, 360 headings each way"}
    curves = {line.get_gid(): line for line in speed.get_lines()}
    assert set(curves) == {f"{run.output} {run.workers}" for run in runs}
    for run in runs:
        assert 1e-6 * run.rows / run.seconds in curves[f"{run.output} {run.workers}"].get_ydata()
    assert all(axes.get_xlabel() and axes.get_ylabel() and axes.get_title() for axes in (accuracy, speed))


def test_without_tables_there_is_one_panel():
    assert len(draw(ROWS, []).axes) == 1
