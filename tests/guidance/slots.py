"""Fleets flown in closed loop, each aircraft into its slot, in gusts, beside a published formation law.

`python -m guidance.slots 100` flies 100 fleets of 5 from random starts and prints as it goes, `100 1000` those of the
seeds from 1000 on; `100 1000 5 0` plans their slots without a reserve, which is a percentage. `100 1000 5 8 25` flies
them in a steady wind of 25 % of the airspeed, from a random direction, without the published law, which knows no wind.
"""

from __future__ import annotations

import sys
from dataclasses import replace
from math import tau
from typing import NamedTuple

import numpy as np

from guidance import slot_flights_in_c
from guidance.formation import phase_along
from loiter import Aircraft, Orbit, Pose, Wind
from loiter.fleets import fleet
from loiter.fleets.planning import FleetPlan, fleet_period_s, slot_tracks
from loiter.guidance.entry.slot_entry import BAND, SlotEntry
from loiter.planning.model import sign_of

UAV, STEP_S, GUST = Aircraft(18.0, max_bank_deg=35.0), 0.05, 0.05

# An aircraft is in its slot within these, of the radius and degrees; the radius may differ by the band of the law too.
NEAR, PHASE_DEG = BAND + 0.05, 5.0

# A flight ends so many turns after the plan of the last aircraft; the published law takes longer.
TURNS, RIVAL_TURNS = 3.0, 8.0

# Slots are those of a plan with this reserve; the published law flies no circle below this share of the tightest turn.
RESERVE, LEAST_TURN = 0.08, 1.02


class Scene(NamedTuple):
    """A fleet with its plan, the side of the hold, and the time of the last aircraft in the plan without a reserve."""

    poses: list[Pose]
    orbit: Orbit
    plan: FleetPlan
    side: int
    ideal_s: float
    wind: Wind


def scene(seed, count=5, reserve=RESERVE, wind_share=0.0):
    """Random starts within 6 radii of a circle of 1.5 to 4 turn radii; in wind, of the tightest that can be held."""
    random = np.random.default_rng([seed, count])
    r = UAV.turn_radius_m * random.uniform(1.5, 4.0) * (1.0 + wind_share) ** 2
    places = random.uniform(1.0, 6.0, count) * r * np.exp(1j * random.uniform(0.0, tau, count))
    headings = random.uniform(0.0, 360.0, count)
    poses = [Pose(p.real, p.imag, h) for p, h in zip(places.tolist(), headings.tolist(), strict=True)]
    orbit, wind = Orbit(0.0, 0.0, r), Wind(wind_share * UAV.airspeed_m_s, random.uniform(0.0, 360.0))
    ideal = fleet(poses, orbit, UAV, wind)
    plan = fleet(poses, orbit, UAV, wind, reserve=reserve) if reserve > 0.0 else ideal
    return Scene(poses, replace(orbit, turn=plan.turn), plan, sign_of(plan.turn), ideal.duration_s, wind)


def turn_s(given):
    """The time of a turn."""
    return fleet_period_s(given.plan)


def fly_into_slots(given, seed, gust=GUST):
    """The places of all aircraft, east + 1j north: (n, steps)."""
    steps = int((given.plan.duration_s + TURNS * turn_s(given)) / STEP_S)
    flown = enumerate(zip(given.poses, given.plan.slots, strict=True))
    return np.array(
        [
            slot_flights_in_c.fly_into_slot(
                pose,
                SlotEntry(given.orbit, UAV, given.wind, slot=slot),
                UAV,
                given.wind,
                1000 * seed + i,
                gust=gust,
                steps=steps,
                step_s=STEP_S,
            )
            for i, (pose, slot) in flown
        ]
    )


def fly_formation(given, seed, gust=GUST):
    """The same by the published law, whose order round the circle is that of the phases at the start."""
    begin = [phase_along(pose.east_m, pose.north_m, given.side) % tau for pose in given.poses]
    order = np.argsort(begin).tolist()
    return slot_flights_in_c.fly_formation(
        [given.poses[i] for i in order],
        given.orbit,
        given.side,
        UAV,
        [1000 * seed + i for i in order],
        least_m=LEAST_TURN * UAV.turn_radius_m,
        gust=gust,
        steps=int((given.plan.duration_s + RIVAL_TURNS * turn_s(given)) / STEP_S),
        step_s=STEP_S,
    )


class Result(NamedTuple):
    """When all are in their slots, then within twice the limits for a turn, and within the limits; seconds or nan."""

    joined_s: float
    settled_s: float


def in_slots(given, tracks):
    """Each aircraft beside its own slot."""
    times_s = STEP_S * np.arange(1, tracks.shape[1] + 1)
    return _result(given, tracks, np.angle(tracks / slot_tracks(given.plan, times_s)))


def in_formation(given, tracks):
    """All aircraft at equal intervals, wherever that is, in the order of the rows."""
    n = len(tracks)
    phases = -given.side * np.angle(tracks) - tau / n * np.arange(n)[:, None]
    mean = np.angle(np.exp(1j * phases).sum(axis=0))
    return _result(given, tracks, np.angle(np.exp(1j * (phases - mean))))


def in_order(given, tracks):
    """The tracks in the order of the slots round the circle, along the hold."""
    order = np.argsort([-slot.at_s % turn_s(given) for slot in given.plan.slots])
    return tracks[order]


def _result(given, tracks, errors):
    off = np.maximum(
        np.abs(np.degrees(errors)) / PHASE_DEG, np.abs(np.abs(tracks) / given.orbit.radius_m - 1.0) / NEAR
    ).max(axis=0)
    return Result(_first(off, 1.0, 2.0, given), _first(off, 1.0, 1.0, given))


def _first(off, entered, kept, given):
    """The first time within `entered` from which on all stay within `kept` for a turn."""
    turn = int(turn_s(given) / STEP_S)
    outside = np.flatnonzero(off > kept)
    for i in np.flatnonzero(off <= entered):
        k = np.searchsorted(outside, i)
        following = outside[k] if k < len(outside) else len(off)
        if following - i >= turn:
            return STEP_S * float(i + 1)
    return float("nan")


def main(count, first=0, size=5, reserve_percent=100.0 * RESERVE, wind_percent=0.0):
    """Print the results of fleets and of the published law from the same starts, and a table."""
    rows = []
    for seed in range(first, first + count):
        given = scene(seed, size, 0.01 * reserve_percent, 0.01 * wind_percent)
        tracks = fly_into_slots(given, seed)
        results = (in_slots(given, tracks),)
        if wind_percent == 0.0:
            results += in_formation(given, in_order(given, tracks)), in_formation(given, fly_formation(given, seed))
        rows.append([each / given.ideal_s for result in results for each in result])
        text = ", ".join(f"{value:.2f}" for value in rows[-1])
        print(f"{seed}: R {given.orbit.radius_m:.0f}, plan {given.ideal_s:.1f} s; over it: {text}", flush=True)
        if len(rows) % 10 == 0 or len(rows) == count:
            _print_table(rows)


def _print_table(rows):
    names = {"own slot": 0, "equal intervals": 2, "rival, equal intervals": 4}
    for name, i in list(names.items())[: len(rows[0]) // 2]:
        for what, j in (("in, then within twice", i), ("within for a turn", i + 1)):
            column = np.array([row[j] for row in rows])
            known = np.nan_to_num(column, nan=np.inf)
            low, high = np.median(known), np.quantile(known, 0.9, method="higher")
            settled = f"{np.isfinite(column).sum()} of {len(column)}"
            print(f"{name}, {what}: {settled}, median {low:.3f}, 90 % {high:.2f}", flush=True)


if __name__ == "__main__":
    main(*map(int, sys.argv[1:4]), *map(float, sys.argv[4:]))
