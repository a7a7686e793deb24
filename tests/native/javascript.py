"""The kernel in JavaScript, run by Node, and its Python with the same sine, cosine and arctangent."""

import re
import subprocess
from collections import Counter
from math import nan
from pathlib import Path
from types import FunctionType, SimpleNamespace

import numpy as np

from benchmarks.browsing import NODE
from codegen.files import PAGE
from codegen.javascript import PORTABLE
from loiter.kernel import adjoint, entry, motion
from loiter.kernel.entry import first_control
from loiter.kernel.rebinding import rebinding
from loiter.kernel.rounding import rounded_radius
from loiter.kernel.statuses import Status
from loiter.kernel.still_air import switching_curves, synthesis
from loiter.kernel.wind import hold, wind_search
from native.library import COUNTED

KERNEL = PAGE / "kernel.js"
RUN = Path(__file__).with_name("run.mjs")

# How many numbers a row of each function of answers.js has.
WIDTHS = {"inStillAir": 5, "rankedInStillAir": 5, "around": 5, "inWind": 9, "rankedInWind": 9}

NOT_SOLVED = [0.0, 0.0, *[nan] * 9]


def answers(name, rows, kernel=KERNEL):
    """What a function of answers.js gives for each row; and, if they are counted, the calls of `COUNTED`."""
    numbers = np.array(rows, dtype=float)
    assert numbers.shape[1] == WIDTHS[name]
    command = [NODE, RUN, kernel, name, str(WIDTHS[name])]
    done = subprocess.run(command, input=numbers.tobytes(), capture_output=True, check=True, timeout=600)
    found, at = np.frombuffer(done.stdout), 0
    while at < len(found):
        count = int(found[at])
        yield found[at + 1 : at + 1 + count].tolist()
        at += 1 + count


def counting(source):
    """The JavaScript of the kernel, with a counter in each function of `COUNTED`."""
    for i, name in enumerate(COUNTED):
        source, found = re.subn(rf"^(export function {name}\([^{{]*{{)$", rf"\1 calls[{i}]++;", source, flags=re.M)
        assert found == 1, name
    return f"export const calls = Array({len(COUNTED)}).fill(0);\n{source}"


def is_of(value, module):
    """Whether a value is a function of a module."""
    return isinstance(value, FunctionType) and value.__module__ == module.__name__


class Portable:
    """The functions of answers.js in Python, with the arithmetic of the JavaScript."""

    def __init__(self):
        self.calls = Counter()
        bound = rebinding(PORTABLE.replaced)
        self.synthesis, self.entry, self.adjoint, self.motion, self.hold, self.curves = (
            SimpleNamespace(**{name: bound(f) for name, f in vars(module).items() if is_of(f, module)})
            for module in (synthesis, entry, adjoint, motion, hold, switching_curves)
        )
        self.fastest = rebinding(PORTABLE.replaced, self._counted)(wind_search.fastest)
        self.ranked, self.optima = bound(wind_search.ranked), bound(wind_search.optima)

    def _counted(self, function):
        if function.__name__ not in COUNTED:
            return function

        def count(*arguments):
            self.calls[function.__name__] += 1
            return function(*arguments)

        return count

    def in_still_air(self, x, y, R, side, tolerance):
        """`inStillAir`."""
        status = synthesis.status_of(x, y, R, tolerance)
        if status != Status.OK:
            return [float(status), *NOT_SOLVED]
        R = rounded_radius(R)
        entry = self.synthesis.optimum(x, y, R, side, tolerance)
        least = self.synthesis.least_time(x, y, R, synthesis.side_or_near(y, side), tolerance)
        miss, control = self.entry.miss(x, y, R, entry), first_control(R, entry)
        return [0.0, *map(float, entry), miss, least, control, *self.adjoint.adjoint(x, y, R, entry)]

    def in_wind(self, *problem):
        """`inWind`."""
        self.calls.clear()
        entry = self.fastest(wind_search.WindProblem(*problem))
        return [*map(float, entry), *(float(self.calls[name]) for name in COUNTED)]

    def ranked_in_still_air(self, x, y, R, side, tolerance):
        """`rankedInStillAir`."""
        if synthesis.status_of(x, y, R, tolerance) != Status.OK:
            return []
        state = x, y, rounded_radius(R), side, tolerance
        found = [*self.synthesis.ranked(*state), *self.synthesis.optima(*state)]
        return [float(number) for entry in found for number in entry]

    def ranked_in_wind(self, *problem):
        """`rankedInWind`."""
        found = [*self.ranked(wind_search.WindProblem(*problem)), *self.optima(wind_search.WindProblem(*problem))]
        return [float(number) for entry in found for number in entry]

    def around(self, x, y, R, side, t):
        """`around`."""
        one = side or 1
        return [
            self.curves.switching_abscissa(y, R),
            self.curves.last_arc_abscissa(y),
            float(self.curves.region(x, abs(y))),
            *self.motion.fly(x, y, 0.6, 0.8, side, t),
            *self.motion.flow(x, y, side, t),
            *self.adjoint.turn_adjoint(x, y, side, t),
            *self.hold.hold_pose(t, one, R, 0.3 / R, -0.2),
            self.hold.hold_rate(t, one, R, 0.3 / R, -0.2),
            self.hold.phase_of(x, y, one, 0.3 / R, -0.2),
        ]


def differing(name, function, rows, kernel=KERNEL):
    """The rows for which a function of answers.js and one of `Portable` differ in a bit, or in a count of calls."""
    return [
        row for row, found in zip(rows, answers(name, rows, kernel), strict=True) if repr(found) != repr(function(*row))
    ]
