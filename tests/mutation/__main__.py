"""Mutation search: which small changes to the code no test notices.

python -m mutation --seed 1 --mutants 50 --results FILE [--files kernel/ io/missions/signs.py ...]

The seed decides which mutants, for the sources as they are. What has been tried is kept in the results file, a line of
JSON each: a later run goes on from there and tries what survived again. Mutants in equivalents.toml are not tried.
"""

import argparse
import json
import signal
import sys
import tempfile
import tomllib
from collections import Counter
from pathlib import Path
from time import monotonic

from mutation.mutants import Mutant, chosen
from mutation.running import ROOT, Copy

PACKAGE = ROOT / "src" / "loiter"
EQUIVALENTS = Path(__file__).with_name("equivalents.toml")

Key = tuple[str, str, str]


def main() -> int:
    """Try mutants and print the table; 1 where some survive."""
    parser = argparse.ArgumentParser(prog="python -m mutation", description=__doc__.partition("\n")[0])
    parser.add_argument("--seed", type=int, required=True)
    parser.add_argument("--mutants", type=int, default=50, metavar="N", help="how many (default 50)")
    parser.add_argument("--results", type=Path, required=True, metavar="FILE", help="what has been tried")
    parser.add_argument("--files", nargs="+", default=[""], metavar="START", help="paths below src/loiter begin so")
    options = parser.parse_args()
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(143))
    known, equivalents, rows = tried(options.results), listed(EQUIVALENTS), []
    with tempfile.TemporaryDirectory() as folder, options.results.open("a", encoding="utf-8") as results:
        copy = Copy(Path(folder))
        for mutant, _ in zip(chosen(PACKAGE, files(options.files), options.seed), range(options.mutants), strict=False):
            if key(mutant) in equivalents:
                row = described(mutant) | {"verdict": "equivalent"}
            elif known.get(key(mutant), {"verdict": "survived"})["verdict"] != "survived":
                row = known[key(mutant)]
            else:
                row = attempted(mutant, copy)
                print(json.dumps(row), file=results, flush=True)
            rows.append(row)
            print(f"{len(rows)}/{options.mutants} {row['verdict']} {row['file']}:{row['line']}", file=sys.stderr)
    print(table(rows))
    return int(any(row["verdict"] == "survived" for row in rows))


def files(starts: list[str]) -> list[str]:
    """The files of the package whose paths begin with one of these."""
    paths = (path.relative_to(PACKAGE).as_posix() for path in PACKAGE.rglob("*.py"))
    return [path for path in paths if path.startswith(tuple(starts))]


def key(mutant: Mutant) -> Key:
    """What tells one mutant from another, wherever in the file its line stands."""
    return mutant.file, mutant.before, mutant.after


def tried(path: Path) -> dict[Key, dict[str, object]]:
    """The rows of a results file by mutant, the latest of each."""
    lines = path.read_text("utf-8").splitlines() if path.exists() else []
    return {(row["file"], row["before"], row["after"]): row for row in map(json.loads, lines)}


def listed(path: Path) -> set[Key]:
    """The mutants that behave as the code does."""
    tables = tomllib.loads(path.read_text("utf-8"))["equivalent"]
    return {(one["file"], one["before"].strip(), one["after"].strip()) for one in tables}


def attempted(mutant: Mutant, copy: Copy) -> dict[str, object]:
    """A mutant's row after its tests."""
    begun = monotonic()
    outcome = copy.outcome(mutant.file, mutant.source)
    return described(mutant) | outcome._asdict() | {"seconds": round(monotonic() - begun, 1)}


def described(mutant: Mutant) -> dict[str, object]:
    """File, line and the change."""
    return {name: value for name, value in mutant._asdict().items() if name != "source"}


def table(rows: list[dict[str, object]]) -> str:
    """How many of each verdict in each folder, then every mutant with its change, by verdict."""
    verdicts = ("killed", "survived", "timed out", "equivalent")
    counts = Counter((row["file"].partition("/")[0], row["verdict"]) for row in rows)
    lines = [f"{'':12}" + "".join(f"{verdict:>12}" for verdict in verdicts)]
    lines += [
        f"{folder:12}" + "".join(f"{counts[folder, verdict]:12}" for verdict in verdicts)
        for folder in sorted({folder for folder, _ in counts})
    ]
    return "\n".join([*lines, *map(entry, sorted(rows, key=lambda row: row["verdict"]))])


def entry(row: dict[str, object]) -> str:
    """A mutant with its change and the test that noticed it."""
    changes = [
        f"    {sign} {line}" for sign, side in (("-", "before"), ("+", "after")) for line in row[side].split("\n")
    ]
    return "\n".join([f"{row['verdict']}: {row['file']}:{row['line']} {row.get('test', '')}".rstrip(), *changes])


if __name__ == "__main__":
    sys.exit(main())
