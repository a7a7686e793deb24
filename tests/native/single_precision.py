"""What single precision costs: `python -m native.single_precision kernel`, `wind`, `law FOLDER`, `flown`, `spread`.

`kernel` compares times and words in single precision with those in double, for the same states, against the distance
of the states from the circles where the word changes, and next to R = 1. `wind` does so for the search in wind. `law`
gives the measurements of flights that `guidance.recorded` has recorded to the law in single and in double precision.
`flown` flies both from the same starts, with varied aircraft in gusts of 5 %. `spread` flies the law in single
precision in a wind of a third of the airspeed, with searches that are spread over steps.
"""

import pickle
import sys
from functools import partial
from math import cos, inf, pi, sin
from pathlib import Path
from random import Random

import numpy as np

from compiled.windy import drawn
from guidance.recorded import LIMIT_DEG
from loiter import Aircraft, Wind
from loiter.guidance.protocol import State
from loiter.kernel.wind.wind_search import time_of
from loiter.lab.trials.campaign import campaign, outcome, trials
from loiter.lab.trials.settings import point_mass_setting, varied_setting
from loiter.lab.trials.varied import varied_trials
from native.onboard import OnboardLaw, library

RADII = (1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 5.0, 30.0)

# The tolerance in single precision, turn radii.
TOLERANCE = 1e-3


def beside(count, distance, radii, tolerance, seed=0):
    """States at this distance from a circle where the word changes, in or out of it, as single precision has them."""
    random, rows = Random(seed), []
    for _ in range(count):
        R, angle, off = random.choice(radii), random.uniform(-pi, pi), random.choice([-1.0, 1.0]) * distance
        kind = random.randrange(4)
        radius, centre = [(R + 1.0, -1.0), (R - 1.0, 1.0), (abs(R - 3.0), -1.0), (inf, 0.0)][kind]
        if radius == inf:
            x, y = random.uniform(-3.0 * R, 3.0 * R), off
        else:
            x, y = (radius + off) * cos(angle), centre + (radius + off) * sin(angle)
        rows.append((x, y, R, random.choice([1.0, -1.0, 0.0]), tolerance))
    return np.array(rows, np.float32).astype(float)


def differences(rows):
    """The median and the largest difference of the least times over size, without jumps; shares of jumps and words.

    A jump is a difference of more than half a turn; another word counts where the times differ by more than rounding.
    """
    single, double = library(True).optima(rows), library(False).optima(rows)
    solved = double[:, 0] == 0.0
    assert (single[solved, 0] == 0.0).all()
    size = 1.0 + np.abs(rows[solved, :3]).sum(axis=1)
    off = np.abs(single[solved, 3] - double[solved, 3]) / size
    jumps = np.abs(single[solved, 3] - double[solved, 3]) > 3.0
    words = (single[solved, 1:3] != double[solved, 1:3]).any(axis=1)
    smooth = off[~jumps]
    return np.median(smooth), smooth.max(), jumps.mean(), (words & ~jumps).mean()


def kernel(count=20_000):
    print(
        "| distance | R | tolerance | median | largest | another turn | another word |\n|---|---|---|---|---|---|---|"
    )
    cases = [(10.0**-k, RADII, tolerance) for tolerance in (0.0, 1e-5, 1e-4, TOLERANCE) for k in (1, 2, 3, 4, 5, 6, 7)]
    cases += [(1e-6, (1.0 + 10.0**-k,), tolerance) for tolerance in (0.0, TOLERANCE) for k in (2, 3, 4, 5, 6)]
    for distance, radii, tolerance in cases:
        median, largest, jumps, words = differences(beside(count, distance, radii, tolerance))
        shown = "1 to 30" if len(radii) > 1 else f"1 + {radii[0] - 1.0:.0e}"
        print(
            f"| {distance:.0e} | {shown} | {tolerance:g} | {median:.1e} | {largest:.1e} |"
            f" {100 * jumps:.2f} % | {100 * words:.2f} % |"
        )


def wind(count=1000):
    off, words, statuses = [], 0, 0
    for problem in (*drawn(count, 1), *drawn(count, 1, 0.95)):
        rounded = {name: float(np.float32(getattr(problem, name))) for name in ("x", "y", "R", "wx", "wy")}
        problem = problem._replace(**rounded)
        a, b = library(True).fastest(problem), library(False).fastest(problem)
        if b.status == 0 and a.status != 0:
            statuses += 1
        elif b.status == 0:
            off.append((time_of(a) - time_of(b)) / (1.0 + problem.R + time_of(b)))
            words += (a.side, a.word) != (b.side, b.word)
    off = np.array(off)
    print(f"{len(off)} scenes, {statuses} without an answer, {words} other words; median {np.median(np.abs(off)):.1e}")
    for limit in (1e-5, 1e-4, 1e-3, 1e-2):
        print(f"{100 * (np.abs(off) > limit).mean():.2f} % by more than {limit:g}")
    print(f"slower by {off.max():.2g}, faster by {-off.min():.2g} at most")


class DoubleLaw(OnboardLaw):
    single = False


# The numbers of a command that are compared.
COMPARED = "bank_deg", "time_to_join_s", "side", "phase"


def commands(kind, path):
    """What a law commands in a recorded flight: a row of `COMPARED` for each step."""
    (orbit, aircraft, told, others), dt, limit_step, rows, _ = pickle.loads(path.read_bytes())
    flown = kind.exact(orbit, aircraft, told) if "exact" in others else kind(orbit, aircraft, told, **others)
    states = [State(*row) for row in rows[:, :8].tolist()]
    before = states if limit_step < 0 else states[:limit_step]
    given = [*flown.steps(before, dt)]
    flown.set_limit(LIMIT_DEG)
    given += flown.steps(states[len(before) :], dt)
    return np.array([[getattr(one, name) for name in COMPARED] for one in given])


def situations(single, double):
    """Whether both laws do the same, by what that is, or different things: a row of truths for each name."""
    same = single[:, 3] == double[:, 3]
    phases = {"turns": (-1, 1), "straight": (0,), "holds": (2,), "no data": (3,)}
    found = {name: same & np.isin(single[:, 3], codes) for name, codes in phases.items()}
    return found | {"another phase": ~same, "another direction": single[:, 2] != double[:, 2]}


def law(folder, first=0, last=None):
    paths = sorted(Path(folder).iterdir())[first:last]
    flights = [tuple(commands(kind, path) for kind in (OnboardLaw, DoubleLaw)) for path in paths]
    single, double = (np.concatenate(rows) for rows in zip(*flights, strict=True))
    bank, join = np.abs(single[:, :2] - double[:, :2]).T
    largest = np.array([np.abs(a[:, 0] - b[:, 0]).max() for a, b in flights])
    print(f"{len(flights)} flights, {len(bank)} steps")
    print(f"bank: median {np.median(bank):.1e} deg, largest {bank.max():.3g} deg")
    found = situations(single, double)
    for limit in (0.01, 0.1, 1.0, 10.0):
        far = bank > limit
        steps, some = 100 * far.mean(), 100 * (largest > limit).mean()
        shares = ", ".join(f"{name} {100 * each[far].mean():.1f} %" for name, each in found.items())
        lengths = np.concatenate([runs(np.abs(a[:, 0] - b[:, 0]) > limit) for a, b in flights])
        print(f"beyond {limit} deg: {steps:.3f} % of steps, {some:.1f} % of flights; {shares};", end=" ")
        print(f"in a row {np.median(lengths):g} steps (median), {np.quantile(lengths, 0.9):g} (90 %)")
    print(f"time to join: median {np.nanmedian(join):.1e} s, 99.9 % within {np.nanquantile(join, 0.999):.3g} s")


def runs(far):
    """The numbers of steps in a row that are far."""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], far, [False]]).astype(int)))
    return edges[1::2] - edges[::2]


def flown(count=100, seed=0):
    """Later than the law in double precision, from the same starts with the same noise, in steps of 50 ms."""
    setting, late_s, went_round = varied_setting(0.05), [], np.zeros(2, int)
    settled = np.zeros(2, int)
    for i, trial in enumerate(varied_trials(count, seed)):
        pair = [
            outcome(i, trial, partial(law_of, kind), setting.simulator, setting.band, 0.05)
            for kind in (OnboardLaw, DoubleLaw)
        ]
        settled += [one.settled for one in pair]
        went_round += [one.round_again for one in pair]
        late_s.append([one.settled_s - one.ideal_s for one in pair])
        if (i + 1) % 25 == 0 or i + 1 == count:
            single, double = np.array(late_s).T
            print(f"{i + 1} flights; settled {settled}, go-arounds {went_round} (single and double precision)")
            for name, late in (("single", single), ("double", double), ("single later than double", single - double)):
                shares = np.nanquantile(late, [0.05, 0.5, 0.9, 0.95])
                print(f"  {name}: 5 % {shares[0]:.2f}, median {shares[1]:.2f}, 90 % {shares[2]:.2f},", end=" ")
                print(f"95 % {shares[3]:.2f}, largest {np.nanmax(late):.2f}, mean {np.nanmean(late):.3f} s", flush=True)


def law_of(kind, trial):
    return kind(trial.ideal.orbit, trial.declared)


class By2(OnboardLaw):
    search_steps = 2


class By5(OnboardLaw):
    search_steps = 5


class By10(OnboardLaw):
    search_steps = 10


class By20(OnboardLaw):
    search_steps = 20


def law_in_wind(kind, trial):
    return kind(trial.ideal.orbit, trial.known_aircraft, trial.known_wind)


def spread(count=100):
    aircraft, setting = Aircraft(18.0, max_bank_deg=35.0), point_mass_setting(0.05)
    laws = {str(kind.search_steps): partial(law_in_wind, kind) for kind in (OnboardLaw, By2, By5, By10, By20)}
    starts = trials(count, 0, aircraft, Wind(6.0, 250.0))
    done = campaign(laws, setting.simulator, starts, band=setting.band, workers=1)
    whole_s = np.array([one.settled_s for one in done["0"]])
    print("| search_steps | settled | go-arounds | later than the plan: median | 90 % |", end="")
    print(" than whole searches: median | 90 % | largest |")
    print("|" + "---|" * 8)
    for name, outcomes in done.items():
        settled_s, ideal_s = (np.array([getattr(one, each) for one in outcomes]) for each in ("settled_s", "ideal_s"))
        late_s, more_s = settled_s - ideal_s, settled_s - whole_s
        found = [
            np.nanmedian(late_s),
            np.nanquantile(late_s, 0.9),
            np.nanmedian(more_s),
            np.nanquantile(more_s, 0.9),
            np.nanmax(more_s),
        ]
        counts = sum(one.settled for one in outcomes), sum(one.round_again for one in outcomes)
        print(
            f"| {name} | {counts[0]} of {count} | {counts[1]} | " + " | ".join(f"{each:.2f} s" for each in found) + " |"
        )


if __name__ == "__main__":
    action, *others = sys.argv[1:]
    if action == "law":
        law(others[0], *map(int, others[1:]))
    else:
        {"kernel": kernel, "wind": wind, "flown": flown, "spread": spread}[action](*map(int, others))
