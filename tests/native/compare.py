"""The generated C beside the Python it comes from, on as many states and scenes as one likes: the same bits.

`python -m native.compare --states 1000000 --scenes 20000`; the tests try some thousands.
"""

import argparse
import sys
import tempfile
from pathlib import Path

from compiled.windy import drawn
from native import states
from native.library import build, counting
from native.test_kernel import check_in_wind, check_still_air


def main() -> int:
    """Compare maneuvers, misses and least times in still air, and maneuvers and steps of the search in wind."""
    parser = argparse.ArgumentParser(prog="python -m native.compare", description=__doc__.partition("\n")[0])
    parser.add_argument("--states", type=int, default=1_000_000, help="states in still air (default 1,000,000)")
    parser.add_argument("--scenes", type=int, default=20_000, help="scenes in wind (default 20,000)")
    parser.add_argument("--seed", type=int, default=0)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        library = build(Path(folder), counting)
        check_still_air(library, states.drawn(options.states, options.seed))
        print(f"{options.states:,} states in still air: the same bits")
        check_in_wind(library, drawn(options.scenes // 2, options.seed))
        check_in_wind(library, drawn(options.scenes - options.scenes // 2, options.seed + 1, 0.95))
        print(f"{options.scenes:,} scenes in wind: the same bits after the same steps")
    return 0


if __name__ == "__main__":
    sys.exit(main())
