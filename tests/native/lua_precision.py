"""What Lua with numbers of 32 bits costs: `python -m native.lua_precision LUA kernel`.

LUA is an interpreter of Lua 5.3 that was compiled with -DLUA_32BITS, as ArduPilot's is. `kernel` compares times and
words with those of Lua in double precision, for the states of `native.single_precision`. `law FOLDER` gives the
measurements of flights that `guidance.recorded` has recorded to the law of the applet in both, and in still air to the
C in single precision too. Flights whose clock jumps are left out: the applet's does not. `flown` flies both from the
same starts, with the same noise.
"""

import pickle
import subprocess
import sys
from functools import partial
from math import nan
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
from lupa.lua53 import LuaRuntime

from codegen.lua import LUA, LUA_32BITS
from codegen.onboard.lua_files import law as law_chunk
from loiter import Aircraft, Turn, Wind
from loiter.guidance.protocol import Command, Phase, State
from loiter.lab.trials.campaign import outcome, trials
from loiter.lab.trials.settings import point_mass_setting
from native.onboard import OnboardLaw
from native.single_precision import RADII, TOLERANCE, beside, library
from native.test_applet import SOLVERS

DRIVER = Path(__file__).with_suffix(".lua")

# Kinds of flights that `guidance.recorded` records: with another law, and with clocks that jump.
LEFT_OUT = (5, 6, 8, 9)


def text_of(arithmetic):
    """The law of the applet as a chunk that returns it, for an arithmetic."""
    return f"local law, begin_in_wind, advance_in_wind = {{}}\n{law_chunk(arithmetic).body()}\n{SOLVERS}"


def in_double(action, source="", target=""):
    runtime = LuaRuntime(unpack_returned_tuples=True)
    driver = runtime.eval("load")(DRIVER.read_text("utf-8"))
    return driver(runtime.execute(text_of(LUA)), action, str(source), str(target))


def single_command(lua, folder, action, source, target):
    """The command that runs the driver with numbers of 32 bits."""
    (folder / "law.lua").write_text(text_of(LUA_32BITS), "utf-8")
    return [lua, "-e", f'loadfile("{DRIVER}")(dofile("{folder / "law.lua"}"), "{action}", "{source}", "{target}")']


def both(lua, action, lines):
    """The rows of numbers that Lua answers, with numbers of 32 bits and in double precision."""
    with TemporaryDirectory() as name:
        source, single, double = (Path(name) / each for each in ("source", "single", "double"))
        source.write_text("".join(f"{line}\n" for line in lines), "utf-8")
        subprocess.run(single_command(lua, Path(name), action, source, single), check=True)
        in_double(action, source, double)
        return np.loadtxt(single, ndmin=2), np.loadtxt(double, ndmin=2)


def written(values):
    """Numbers of single precision as text that both read without rounding."""
    return " ".join("nan" if value != value else float(np.float32(value)).hex() for value in values)


def kernel(lua, count=3_000):
    print(
        "| distance | R | tolerance | median | largest | another turn | another word |\n|---|---|---|---|---|---|---|"
    )
    cases = [(10.0**-k, RADII, tolerance) for tolerance in (0.0, TOLERANCE) for k in (1, 2, 3, 4, 5, 6, 7)]
    cases += [(1e-6, (1.0 + 10.0**-k,), tolerance) for tolerance in (0.0, TOLERANCE) for k in (2, 3, 4, 5, 6)]
    for distance, radii, tolerance in cases:
        rows = beside(count, distance, radii, tolerance)
        rows = rows[library(False).optima(rows)[:, 0] == 0.0]
        single, double = both(lua, "kernel", map(written, rows))
        off = np.abs(single[:, 2] - double[:, 2])
        jumps = off > 3.0
        words = (single[:, :2] != double[:, :2]).any(axis=1)
        smooth = (off / (1.0 + np.abs(rows[:, :3]).sum(axis=1)))[~jumps]
        shown = "1 to 30" if len(radii) > 1 else f"1 + {radii[0] - 1.0:.0e}"
        print(
            f"| {distance:.0e} | {shown} | {tolerance:g} | {np.median(smooth):.1e} | {smooth.max():.1e} |"
            f" {100 * jumps.mean():.2f} % | {100 * (words & ~jumps).mean():.2f} % |"
        )


def in_lua(value):
    """A named tuple of numbers as text of Lua."""
    if hasattr(value, "_fields"):
        return "{" + ", ".join(f"{name} = {in_lua(each)}" for name, each in value._asdict().items()) + "}"
    return str(value).lower() if isinstance(value, (bool, int)) else float(np.float32(value)).hex()


def replayed(lua, path):
    """Bank and time to join of a recorded flight, in Lua of 32 bits, in double, and in the C of single precision."""
    (orbit, aircraft, told, others), dt, _, rows, _ = pickle.loads(path.read_bytes())
    law = OnboardLaw(orbit, aircraft, told, **{**others, "identify": False})
    states = [State(*row) for row in rows[:, :8].tolist()]
    lines = [*beginning(law, dt), *(measured(law, state) for state in states)]
    commands = [(command.bank_deg, command.time_to_join_s) for command in law.steps(states, dt)]
    known = law.relative_vehicle().estimates
    is_still = known.wind_east_m_s == known.wind_north_m_s == 0.0
    return *both(lua, "law", lines), np.array(commands) if is_still else None


def beginning(law, dt):
    """The lines that begin a flight in Lua."""
    return f"return {in_lua(law.relative_settings())}, {in_lua(law.relative_vehicle())}", float(dt).hex()


def measured(law, state):
    """The line of a measurement."""
    given = law.measurement(state)
    return written([state.time_s, *(getattr(given, name) for name in State._fields[1:])])


class LuaLaw(OnboardLaw):
    """The law of the applet as it is flown: in double precision in this process, with 32 bits in one of its own."""

    def __init__(self, lua, trial):
        super().__init__(trial.ideal.orbit, trial.known_aircraft, trial.known_wind, identify=False)
        begin = beginning(self, STEP_S)
        if lua is None:
            self.answer = in_double("flight")(*begin)
            return
        self.folder = TemporaryDirectory()
        command = single_command(lua, Path(self.folder.name), "law", "/dev/stdin", "/dev/stdout")
        self.process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, bufsize=1)
        self.process.stdin.write("".join(f"{line}\n" for line in begin))
        self.answer = self.asked

    def asked(self, line):
        self.process.stdin.write(f"{line}\n")
        return map(float, self.process.stdout.readline().split())

    def step(self, state, dt):
        bank_deg, join_s = self.answer(measured(self, state))
        return Command(nan, bank_deg, Phase.HOLD, join_s, Turn.EITHER, Phase.HOLD, nan)


# Seconds between two steps of the applet, and the wind in which every other flight is flown.
STEP_S, WIND = 0.05, Wind(6.0, 250.0)


def flown(lua, count=24):
    """Later than in double precision, from the same starts."""
    aircraft, setting, late_s = Aircraft(18.0, max_bank_deg=35.0), point_mass_setting(0.05), []
    pairs = zip(trials(int(count), 0, aircraft), trials(int(count), 0, aircraft, WIND), strict=True)
    for i, trial in enumerate(pair[k % 2] for k, pair in enumerate(pairs)):
        done = [
            outcome(i, trial, partial(LuaLaw, kind), setting.simulator, setting.band, STEP_S) for kind in (lua, None)
        ]
        late_s.append([one.settled_s - one.ideal_s for one in done])
        print(f"{i}: {late_s[-1][0]:.2f} s, in double precision {late_s[-1][1]:.2f} s", flush=True)
    off = np.diff(np.array(late_s)[:, ::-1], axis=1)
    settled = np.isfinite(late_s).sum(axis=0)
    print(f"{settled} settled; later than in double precision: median {np.nanmedian(off):.2f}", end=" ")
    print(f"s, 90 % {np.nanquantile(off, 0.9):.2f}, largest {np.nanmax(off):.2f}, least {np.nanmin(off):.2f}")


def compare(title, pairs):
    bank = np.concatenate([np.abs(a[:, 0] - b[:, 0]) for a, b in pairs])
    join = np.concatenate([np.abs(a[:, 1] - b[:, 1]) for a, b in pairs])
    shares = ", ".join(f"{100 * (bank > limit).mean():.3f} % beyond {limit:g}" for limit in (0.01, 0.1, 1.0, 10.0))
    print(
        f"{title}: {len(pairs)} flights, {len(bank)} steps; bank: median {np.median(bank):.1e} deg, {shares}, ", end=""
    )
    print(f"largest {bank.max():.3g}; time to join: 99.9 % within {np.nanquantile(join, 0.999):.3g} s")


def law(lua, folder, first=0, last=None):
    paths = [path for path in sorted(Path(folder).iterdir()) if int(path.stem) % 10 not in LEFT_OUT]
    done = [replayed(lua, path) for path in paths[int(first) : None if last is None else int(last)]]
    compare("32 bits and double", [(single, double) for single, double, _ in done])
    compare("32 bits and C in still air", [(single, c) for single, _, c in done if c is not None])


if __name__ == "__main__":
    interpreter, action, *others = sys.argv[1:]
    {"kernel": kernel, "law": law, "flown": flown}[action](interpreter, *others)
