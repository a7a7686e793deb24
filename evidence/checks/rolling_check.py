"""What an aircraft with a limited roll rate can reach, between two bounds, beside the plan."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise
from math import atan, cos, hypot, inf, log, radians, sin, tan
from typing import NamedTuple

import numpy as np

from evidence.checks.oracle import Circle, Planar
from evidence.checks.oracle_check import CheckProblem, start_about
from evidence.checks.rolling import BankProfile, Rolling, RollingPath, SettlingBand, Word, fastest_roll
from evidence.checks.rolling_lower import lower_bound
from loiter.errors import InvalidArgument
from loiter.guidance.circle import Band
from loiter.guidance.vehicle import Roll
from loiter.lab.trials.campaign import trials
from loiter.planning.maneuver import Maneuver
from loiter.planning.model import CONTROLS, Aircraft, Turn
from loiter.planning.solve import candidates

AIRCRAFT = Aircraft(22.0, max_bank_deg=45.0)

# Roll rates of small aircraft, degrees per second: from sluggish to agile.
RATES_DEG_S = (45.0, 60.0, 90.0, 150.0)

# This many of the fastest candidates are tried as first guesses; fewer if they lead to within this many turn radii over
# airspeed of the lower bound.
GUESSES, FEW_GUESSES, NEAR = 6, 2, 0.01

# A path may miss by this many turn radii, or radians, when it is flown by another integrator, and exceed the limits of
# its roll by this: what the rule of order six leaves on its intervals. Times are compared to as many seconds.
MISS = 1e-6

# Simpson's weights on an interval of length 1, and the rate of the bank below which the heading is that at its mean.
SIMPSON = np.array([1.0, *[4.0, 2.0] * 31, 4.0, 1.0]) / (3.0 * 64.0)
EVEN = 1e-6


@dataclass(frozen=True)
class RollingBound:
    """The least time of one entry between two bounds, seconds: `at_least_s` is proved, in `reached_s` it can be flown.

    `planned_s` is the duration of the plan, which banks at once, and `path` the one that can be flown. `missed` is by
    how much it misses the circle, its tangent, the bank of the hold or the limits of its roll when it is flown by
    another integrator: turn radii, radians.
    """

    problem: CheckProblem
    rate_deg_s: float
    planned_s: float
    at_least_s: float
    reached_s: float
    missed: float
    path: RollingPath

    @property
    def later_s(self) -> float:
        """By how much the path takes longer than the plan."""
        return self.reached_s - self.planned_s

    @property
    def gap_s(self) -> float:
        """By how much the bounds differ."""
        return self.reached_s - self.at_least_s

    @property
    def passed(self) -> bool:
        """Whether the path can be flown, and takes no less time than was proved, nor that less than the plan."""
        return self.missed <= MISS and self.gap_s >= -MISS and self.at_least_s >= self.planned_s - MISS


def compare_with_rolling(cases: int, seed: int) -> Iterator[RollingBound]:
    """Bound the least time of `cases` random entries at each roll rate, one by one; wings level at the start.

    Raises at the call, not at the first result: `InvalidArgument` for fewer than one case.
    """
    if cases < 1:
        raise InvalidArgument("cases", f"is {cases}: it must be at least 1")
    entries = [trial.ideal for trial in trials(cases, seed, AIRCRAFT)]
    return (bound for entry in entries for bound in _bounds(entry))


def _bounds(entry: Maneuver) -> Iterator[RollingBound]:
    """The bounds of one entry at each roll rate: a path of a slower roll is one of a quicker roll too."""
    slower: RollingPath | None = None
    for rate in RATES_DEG_S:
        bound = rolling_bound(entry, rate, slower)
        slower = bound.path
        yield bound


def rolling_bound(entry: Maneuver, rate_deg_s: float, known: RollingPath | None = None) -> RollingBound:
    """The bounds of one entry in still air, at one roll rate; `known` is a path that can be flown."""
    start, circle, roll, unit_s = scaled(entry, Roll(0.0, rate_deg_s))
    words, least = guesses(entry), lower_bound(start, circle, roll)
    paths = [known] if known else []
    for count in (FEW_GUESSES, GUESSES):
        if min((path.time for path in paths), default=inf) > least + NEAR:
            paths.append(fastest_roll(start, circle, roll, words[:count]))
    path = min(paths, key=lambda path: path.time)
    place = f"{rate_deg_s:g} deg/s"
    problem = CheckProblem(place, entry.start, entry.orbit, entry.aircraft)
    return RollingBound(
        problem=problem,
        rate_deg_s=rate_deg_s,
        planned_s=entry.duration_s,
        at_least_s=unit_s * least,
        reached_s=unit_s * path.time,
        missed=missed(start, circle, roll, path),
        path=path,
    )


def settling_bound_s(entry: Maneuver, roll: Roll, band: Band) -> float:
    """The least time found, seconds, in which an aircraft with a roll response is in a band for good.

    In still air, in the direction of the entry, wings level at the start.
    """
    start, circle, rolling, unit_s = scaled(entry, roll)
    inside = SettlingBand(band.radial * circle.radius, radians(band.course_deg))
    return unit_s * fastest_roll(start, circle, rolling, guesses(entry), inside).time


class ScaledEntry(NamedTuple):
    """An entry in turn radii and turn radii over airspeed: the start, the circle in its direction, and the roll.

    `unit_s` is a turn radius over the airspeed, seconds.
    """

    start: Planar
    circle: Circle
    roll: Rolling
    unit_s: float


def scaled(entry: Maneuver, roll: Roll) -> ScaledEntry:
    """An entry, flown with a roll response."""
    orbit, r = entry.orbit, entry.aircraft.turn_radius_m
    unit_s = r / entry.aircraft.airspeed_m_s
    rolling = Rolling(radians(entry.aircraft.bank_deg(r)), radians(roll.rate_deg_s) * unit_s, roll.time_s / unit_s)
    circle = Circle(orbit.radius_m / r, entry.turn == Turn.CW)
    return ScaledEntry(start_about(entry.start, orbit, r), circle, rolling, unit_s)


def guesses(entry: Maneuver) -> list[Word]:
    """The fastest candidates of an entry with its direction."""
    found = candidates(entry.start, entry.orbit, entry.aircraft)
    same = [m for m in found if m.turn == entry.turn][:GUESSES]
    r = entry.aircraft.turn_radius_m
    return [[(CONTROLS[segment.letter], segment.length_m / r) for segment in m.segments] for m in same]


def missed(start: Planar, circle: Circle, roll: Rolling, path: RollingPath) -> float:
    """The largest fault of a path that joins, flown by `flown_end`."""
    banks, lengths = path.profile
    east, north, angle = flown_end(start, roll, path.profile)
    side = -1.0 if circle.clockwise else 1.0
    outward, along = east * cos(angle) + north * sin(angle), side * (east * sin(angle) - north * cos(angle))
    hold = side * atan(tan(roll.limit) / circle.radius)
    beyond = [abs(b - a) - roll.rate * h for (a, b), h in zip(pairwise(banks), lengths, strict=True)]
    steep = [abs(bank) - roll.limit for bank in banks]
    off = hypot(east, north) - circle.radius
    return max(
        abs(off), abs(outward), abs(along - circle.radius), abs(banks[0]), abs(banks[-1] - hold), *beyond, *steep
    )


def flown_end(start: Planar, roll: Rolling, profile: BankProfile) -> Planar:
    """Where a path ends: headings in closed form, the integral of a tangent; positions by Simpson's rule."""
    here, most = start, tan(roll.limit)
    for (before, after), length in zip(pairwise(profile.banks), profile.lengths, strict=True):
        times = np.linspace(0.0, length, SIMPSON.size)
        banks, rate = np.linspace(before, after, SIMPSON.size), (after - before) / length if length else 0.0
        # Where the bank hardly changes the difference of the logarithms would lose its digits.
        is_even = abs(rate) < EVEN
        turned = (
            np.tan(0.5 * (before + banks)) * times if is_even else (log(cos(before)) - np.log(np.cos(banks))) / rate
        )
        angles, step = here.angle + turned / most, length * SIMPSON
        east, north = here.east + step @ np.cos(angles), here.north + step @ np.sin(angles)
        here = Planar(float(east), float(north), float(angles[-1]))
    return here
