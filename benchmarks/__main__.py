"""Run all benchmarks, print the table, and write it and the plot to benchmarks/results."""

import argparse
from pathlib import Path

from benchmarks import report, states, tables
from loiter.plot.files import save_figure

RESULTS = Path(__file__).parent / "results"


def main() -> None:
    parser = argparse.ArgumentParser(prog="python -m benchmarks", description=__doc__)
    parser.add_argument("--rows", type=float, default=1e8, metavar="N", help="largest table, 0 for none (default 1e8)")
    max_rows = int(parser.parse_args().rows)
    rows, runs = states.measure(), tables.measure(max_rows)
    RESULTS.mkdir(exist_ok=True)
    text = report.table(rows, runs)
    (RESULTS / "table.md").write_text(text)
    save_figure(RESULTS / "plot.png", report.draw(rows, runs))
    print(text)
    print(f"written: {RESULTS / 'table.md'}, {RESULTS / 'plot.png'}")


if __name__ == "__main__":
    main()
