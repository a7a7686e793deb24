"""What single precision costs: `python -m native.single_precision kernel`, `wind`, `law FOLDER`, `flown`, `spread`.

`kernel` compares times and words in single precision with those in double, for the same states, against the distance
of the states from the circles where the word changes, and next to R = 1. `wind` does so for the search in wind. `law`
gives the measurements of flights that `guidance.recorded` has recorded to the law in single and in double precision.
`flown` flies both from the same starts, with varied aircraft in gusts of 5 %. `spread` flies the law in single
precision in a wind of a third of the airspeed, with searches that are spread over steps. In the folder `tests`.
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
from loiter.guidance.trials.campaign import campaign, trials
from loiter.guidance.trials.settings import point_mass_setting, varied_setting
from loiter.guidance.trials.summary import summary
from loiter.guidance.trials.varied import varied_trials
from loiter.kernel.wind.wind_search import time_of
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


def replayed(path):
    """The banks that both laws command in a recorded flight, and what both say of the time to join."""
    (orbit, aircraft, told, others), dt, limit_step, rows, _ = pickle.loads(path.read_bytes())
    if "exact" in others:
        return None
    laws = [kind(orbit, aircraft, told, **others) for kind in (OnboardLaw, DoubleLaw)]
    found = []
    for step, state in enumerate(State(*row) for row in rows[:, :8].tolist()):
        if step == limit_step:
            for law in laws:
                law.set_limit(LIMIT_DEG)
        commands = [law.step(state, dt) for law in laws]
        found.append([value for one in commands for value in (one.bank_deg, one.time_to_join_s)])
    return np.array(found)


def law(folder, first=0, last=None):
    flights = [found for path in sorted(Path(folder).iterdir())[first:last] if (found := replayed(path)) is not None]
    rows = np.concatenate(flights)
    bank, join = np.abs(rows[:, 0] - rows[:, 2]), np.abs(rows[:, 1] - rows[:, 3])
    largest = np.array([np.abs(each[:, 0] - each[:, 2]).max() for each in flights])
    print(f"{len(flights)} flights, {len(rows)} steps")
    print(f"bank: median {np.median(bank):.1e} deg, largest {bank.max():.3g} deg")
    for limit in (0.01, 0.1, 1.0, 10.0):
        steps, some = 100 * (bank > limit).mean(), 100 * (largest > limit).mean()
        print(f"beyond {limit} deg: {steps:.3f} % of steps, {some:.1f} % of flights")
    print(f"time to join: median {np.nanmedian(join):.1e} s, 99.9 % within {np.nanquantile(join, 0.999):.3g} s")


def flown(count=100):
    setting = varied_setting(0.05)
    laws = {str(kind.single): partial(law_of, kind) for kind in (OnboardLaw, DoubleLaw)}
    done = campaign(laws, setting.simulator, varied_trials(count, 0), band=setting.band, workers=1)
    for name, outcomes in done.items():
        found = summary(outcomes)
        print(f"single precision {name}: {found.settled} of {found.flights} settled, go-arounds {found.round_again}")
        print(f"median ratio {found.median_ratio:.4f}, 90 % {found.ninth_decile_ratio:.4f}")
        print(f"rate of the bank {found.bank_rate_deg_s:.2f} deg/s")


def law_of(kind, trial):
    return kind(trial.ideal.orbit, trial.declared)


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
    laws = {str(kind.search_steps): partial(law_in_wind, kind) for kind in (OnboardLaw, By5, By10, By20)}
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
