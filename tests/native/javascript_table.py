"""The kernel in JavaScript beside the same C: `python -m native.javascript_table`.

Compares 1,000,000 states in still air and 20,000 scenes in wind (or as many as are given) with the C that is generated
from the same Python with the same sine, cosine and arctangent, bit for bit; and writes as a table how much they differ
from the C with those of the C library, which is Python to the last bit.
"""

import sys
import tempfile
from math import ulp
from pathlib import Path

from codegen.arithmetic import DOUBLE
from codegen.files import SINGLE
from codegen.javascript import PORTABLE
from codegen.unit import Unit
from compiled.windy import PLACES
from compiled.windy import drawn as drawn_in_wind
from loiter.kernel.wind.wind_search import WindProblem
from native import states
from native.javascript import KERNEL, answers, counting
from native.library import build
from native.library import counting as counting_in_c

# Distances from boundaries in still air, as powers of ten.
BANDS = ((-17.0, -14.0), (-14.0, -12.0), (-12.0, -9.0), (-9.0, -5.0))

# Rows that one run of Node takes.
AT_ONCE = 50_000


def library(arithmetic, folder):
    """The C with an arithmetic, which counts calls."""
    path = Path(folder)
    path.mkdir()
    return build(path, lambda _: counting_in_c(Unit("kernel.h", arithmetic, SINGLE).text()))


def portable_library(folder):
    """The C with the arithmetic of the JavaScript."""
    return library(DOUBLE._replace(replaced=PORTABLE.replaced), folder)


class Difference:
    """How answers differ from those with the functions of the C library."""

    def __init__(self):
        self.count = self.same = self.decided = 0
        self.ulps = self.decided_ulps = 0.0

    def add(self, one, other, time, other_time):
        """Count an answer: decisions, numbers, and the whole time of each."""
        self.count += 1
        self.same += repr(one) == repr(other)
        ulps = abs(time - other_time) / ulp(max(other_time, 1.0))
        if one[:2] != other[:2]:
            self.decided += 1
            self.decided_ulps = max(self.decided_ulps, ulps)
        else:
            self.ulps = max(self.ulps, ulps)

    def row(self, name):
        """A row of the table."""
        decided = f"{self.decided} | {self.decided_ulps:.0f}" if self.decided else "0 | "
        return f"| {name} | {self.count:,} | {self.same / self.count:.0%} | {self.ulps:.0f} | {decided} |"


def still_air(rows, portable, exact, difference):
    """How many states differ from the C with the same arithmetic."""
    wrong = 0
    for i in range(0, len(rows), AT_ONCE):
        part = rows[i : i + AT_ONCE]
        for row, found in zip(part, answers("inStillAir", part), strict=True):
            status, entry, miss = portable.optimum(*row)
            mine = [float(status), *map(float, entry), miss] if entry else [float(status)]
            wrong += repr(found[: len(mine)]) != repr(mine)
            if entry:
                _, other, _ = exact.optimum(*row)
                difference.add(entry, other, sum(entry[2:]), sum(other[2:]))
    return wrong


def in_wind(problems, portable, exact, difference, folder):
    """How many scenes differ from the C with the same arithmetic, in an answer or in a count of calls."""
    wrong, counted = 0, Path(folder) / "counted.mjs"
    counted.write_text(counting(KERNEL.read_text("utf-8")), "utf-8")
    for problem, found in zip(problems, answers("inWind", problems, counted), strict=True):
        before = portable.calls()
        entry = portable.fastest(WindProblem(*problem))
        calls = [after - earlier for after, earlier in zip(portable.calls(), before, strict=True)]
        wrong += repr(found) != repr([*map(float, entry), *map(float, calls)])
        other = exact.fastest(problem)
        if entry.status == other.status == 0:
            difference.add(entry[1:], other[1:], sum(entry[3:6]), sum(other[3:6]))
    return wrong


def main(count=1_000_000, scenes=20_000, stride=1):
    """Compare, and write the table, with every so many of the special states; the number of wrong answers."""
    wrong, rows = 0, ["| states | compared | same bits | T differs by, ulps | other word or side | there by |"]
    rows.append("|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        portable, exact = portable_library(f"{folder}/portable"), library(DOUBLE, f"{folder}/exact")
        for seed, (nearest, farthest) in enumerate(BANDS):
            difference = Difference()
            drawn = states.drawn(count // len(BANDS), seed, nearest, farthest)
            wrong += still_air(drawn, portable, exact, difference)
            rows.append(difference.row(f"still air, 1e{nearest:.0f} to 1e{farthest:.0f} from boundaries"))
        difference = Difference()
        wrong += still_air(states.SPECIAL[::stride], portable, exact, difference)
        rows.append(difference.row("still air, special numbers"))
        for windiest in (0.6, 0.95):
            problems = drawn_in_wind(scenes // 2, 11, windiest)
            on_circle = problems[PLACES.index("on the circle") :: len(PLACES)]
            elsewhere = [problem for i, problem in enumerate(problems) if PLACES[i % len(PLACES)] != "on the circle"]
            for place, chosen in (("", elsewhere), (", on the circle or 1e-16 to 1e-8 beside it", on_circle)):
                difference = Difference()
                wrong += in_wind(chosen, portable, exact, difference, folder)
                rows.append(difference.row(f"wind up to {windiest}{place}"))
    print("\n".join(rows))
    print(f"{wrong} answers with other bits than C with the same functions")
    return wrong


if __name__ == "__main__":
    sys.exit(main(*map(int, sys.argv[1:])) != 0)
