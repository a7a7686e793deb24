"""Certificates by the hundred thousand: `python -m certificate.certificates`.

Plans at random and next to boundaries and ties, in still air and in wind: each must have a valid certificate. Wrong
maneuvers, made from such plans: none may have one. `--worst` searches instead for the plan in wind whose residuals come
closest to their bounds, by optimisation. A scene is drawn from the seed and its number alone, so that each can be drawn
again: `--first` and `--count` select a part of a run.
"""

from __future__ import annotations

import argparse
import sys
from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import replace
from math import atan2, cos, degrees, hypot, pi, radians, sin
from random import Random
from typing import NamedTuple

import numpy as np

from kernel.worst import drawn as worst_drawn
from kernel.worst import states as worst_states
from loiter import Aircraft, Maneuver, Orbit, Pose, Turn, Wind, candidates, plan
from loiter.certificate import Certificate, certify
from loiter.kernel.entry import WIND_TIE_TOLERANCE, Entry
from loiter.kernel.rounding import rounding
from loiter.kernel.words import Word
from loiter.planning.model import CONTROLS
from loiter.planning.problem import maneuver as scaled
from loiter.planning.problem import problem_of

UNIT = Aircraft(1.0, min_turn_radius_m=1.0)
TURNS = tuple(Turn)
SPECIAL_RADII = (1.0, 2.0, 3.0, 4.0)


class Scene(NamedTuple):
    """The arguments of `plan`."""

    pose: Pose
    orbit: Orbit
    aircraft: Aircraft
    wind: Wind | None = None


# Scenes at random


def real(random: Random) -> Scene:
    """A scene in metres and degrees, anywhere."""
    uav = Aircraft(random.uniform(8.0, 40.0), max_bank_deg=random.uniform(15.0, 60.0))
    place = [random.uniform(-3000.0, 3000.0) for _ in range(4)]
    radius = uav.turn_radius_m * random.choice((1.0, random.uniform(1.0, 8.0)))
    heading = random.choice((random.uniform(-360.0, 720.0), 90.0 * random.randrange(-1, 4)))
    return Scene(Pose(*place[:2], heading), Orbit(*place[2:], radius, random.choice(TURNS)), uav)


def reduced(random: Random) -> Scene:
    """A unit aircraft with any reduced state, from inside the circle to far outside it."""
    R = radius(random)
    size = random.choice((1.0, R + 2.0, 3.0 * R + 3.0, 100.0))
    return unit_scene(random.uniform(-size, size), random.uniform(-size, size), R, random.choice(TURNS))


def windy(random: Random) -> Scene:
    """A scene in metres and degrees in wind, about a circle that may move."""
    pose, orbit, uav, _ = real(random)
    velocity = random.choice(((0.0, 0.0), (random.uniform(-15.0, 15.0), random.uniform(-15.0, 15.0))))
    share, towards = random.uniform(0.0, 0.6), random.uniform(0.0, 2.0 * pi)
    past = share * uav.airspeed_m_s
    east, north = velocity[0] + past * sin(towards), velocity[1] + past * cos(towards)
    tightest = uav.turn_radius_m * (1.0 + share) ** 2 * (1.0 + 1e-9)
    wide = tightest * random.choice((1.0, random.uniform(1.0, 4.0)))
    return Scene(
        pose,
        Orbit(orbit.east_m, orbit.north_m, wide, orbit.turn, *velocity),
        uav,
        Wind(hypot(east, north), degrees(atan2(-east, -north))),
    )


def unit_windy(random: Random) -> Scene:
    """A unit aircraft in wind, inside, near or far from the circle; heading, wind and place may be along the axes."""
    speed = random.choice((random.uniform(0.0, 0.6), random.uniform(0.0, 0.95), 10.0 ** random.uniform(-6.0, -1.0)))
    R = (1.0 + speed) ** 2 * (1.0 + 1e-9) * random.choice((1.0, random.uniform(1.0, 2.5)))
    distance, azimuth = R * random.choice((random.random() ** 0.5, 3.0 * random.random(), 20.0 * random.random())), 0.0
    azimuth = random.choice((random.uniform(0.0, 2.0 * pi), 0.5 * pi * random.randrange(4)))
    heading, come = (random.choice((random.uniform(0.0, 360.0), 90.0 * random.randrange(4))) for _ in range(2))
    place = (distance * round(cos(azimuth), 15), distance * round(sin(azimuth), 15))
    return Scene(Pose(*place, heading), Orbit(0.0, 0.0, R, random.choice(TURNS)), UNIT, Wind(speed, come))


def radius(random: Random) -> float:
    """R: special values, a little more, or anything."""
    special = random.choice(SPECIAL_RADII)
    near = max(1.0, special + random.choice((-1.0, 1.0)) * 10.0 ** random.uniform(-15.0, -1.0))
    return random.choice((special, near, random.uniform(1.0, 5.0), 10.0 ** random.uniform(0.0, 2.0)))


def unit_scene(x: float, y: float, R: float, turn: Turn) -> Scene:
    """The scene whose reduced state is (x, y): heading east."""
    return Scene(Pose(x, y, 90.0), Orbit(0.0, 0.0, R, turn), UNIT)


# Scenes next to boundaries and ties


def at_curve(random: Random) -> Scene:
    """Next to one of the circles and corners where words meet, at a distance from 1e-17 to 1."""
    numbers = np.random.default_rng(random.getrandbits(64))
    s = worst_states(worst_drawn(numbers, 1))
    return unit_scene(float(s.x[0]), float(s.y[0]), float(s.radius[0]), Turn(str(s.turn[0])))


def at_axis(random: Random) -> Scene:
    """Next to the axis y = 0, or on it."""
    R, off = (
        radius(random),
        random.choice((0.0, 10.0 ** random.uniform(-17.0, -1.0), -(10.0 ** random.uniform(-17.0, -1.0)))),
    )
    return unit_scene(random.uniform(-3.0, 3.0) * R, off, R, random.choice(TURNS))


def at_tie(random: Random) -> Scene:
    """Next to where the answer changes, found by bisection, in still air."""
    return bisected(random, reduced)


def at_windy_tie(random: Random) -> Scene:
    """Next to where the answer changes, found by bisection, in wind."""
    return bisected(random, unit_windy)


def bisected(random: Random, draw: Callable[[Random], Scene]) -> Scene:
    """A scene between two whose answers have different words, at a distance of 1e-16 to 0.1 from where they change."""
    scene = draw(random)
    for _ in range(20):
        step = [random.gauss(0.0, 1.0) * random.choice((0.03, 0.3, 1.0)) for _ in range(3)]
        word = answer(scene)
        if answer(displaced(scene, step, 1.0)) != word:
            break
    else:
        return scene
    low, high = 0.0, 1.0
    for _ in range(30 if scene.wind else 50):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if answer(displaced(scene, step, middle)) == word else (low, middle)
    off = random.choice((0.0, 10.0 ** random.uniform(-16.0, -1.0)))
    return displaced(scene, step, random.choice((low - off, high + off)))


def displaced(scene: Scene, step: list[float], share: float) -> Scene:
    """A scene whose start is displaced and turned by a share of a step, in turn radii and radians."""
    east, north, turned = (share * component for component in step)
    r, pose = scene.aircraft.turn_radius_m, scene.pose
    # In still air the reduced state is what matters: headings stay cardinal.
    heading = pose.heading_deg + (degrees(turned) if scene.wind else 0.0)
    return scene._replace(pose=Pose(pose.east_m + r * east, pose.north_m + r * north, heading))


def answer(scene: Scene) -> tuple[str, Turn]:
    """The word and the direction of the fastest maneuver."""
    m = plan(*scene)
    return m.word, m.turn


PLANS: dict[str, Callable[[Random], Scene]] = {"real": real, "reduced": reduced}
PLANS_IN_WIND = {"windy": windy, "unit windy": unit_windy}
BOUNDARIES = {"curves": at_curve, "axis": at_axis, "ties": at_tie}
BOUNDARIES_IN_WIND = {"ties in wind": at_windy_tie}


def altered(m: Maneuver, which: int, by_s: float) -> Maneuver:
    """The maneuver with a duration that is longer by some seconds, but not its poses."""
    segments = list(m.segments)
    segments[which] = replace(segments[which], duration_s=max(segments[which].duration_s + by_s, 0.0))
    return replace(m, segments=tuple(segments))


def certified(certificate: Certificate) -> Certificate:
    """The certificate, which must be valid."""
    assert certificate.valid, f"\n{certificate}"
    return certificate


# Wrong maneuvers


def wrong_ones(random: Random, scene: Scene) -> Iterator[tuple[str, Maneuver]]:
    """One loser, one maneuver with a duration moved by 1e-6, and one of another word, as far as they are wrong.

    A maneuver is wrong if it ends off the circle by more than rounding, or takes longer than the optimum by more than a
    tie.
    """
    best, *losers = candidates(*scene)
    made: list[tuple[str, Maneuver]] = [("loser", random.choice(losers))] if losers else []
    if best.segments:
        i, by = random.randrange(len(best.segments)), random.choice((-1e-6, 1e-6)) * problem_of(best).time_unit_s
        made.append(("duration", altered(best, i, by)))
        made.append(("word", exchanged(random, best)))
    for name, maneuver in made:
        if is_wrong(maneuver, best):
            yield name, maneuver


def exchanged(random: Random, best: Maneuver) -> Maneuver:
    """The maneuver with its letters mirrored, or replaced by those of another word of as many pieces."""
    problem = problem_of(best)
    unit = problem.time_unit_s
    known = [word for word in Word if len(word.letters) == len(best.word) and word.letters != best.word]
    durations = [segment.duration_s / unit for segment in best.segments]
    word = random.choice(known)
    side = 1 if best.turn == Turn.CW else -1
    return scaled(problem, Entry(side, int(word), *[*durations, 0.0, 0.0][:3]), 0.0)


def is_wrong(maneuver: Maneuver, best: Maneuver) -> bool:
    """Whether a maneuver ends off the circle, or is slower than another, by more than rounding."""
    unit = problem_of(maneuver).time_unit_s
    q, e, w, R = flown(maneuver)
    size = sum(map(abs, (maneuver.start.east_m, maneuver.start.north_m, maneuver.orbit.east_m, maneuver.orbit.north_m)))
    length = rounding(abs(q), size / maneuver.aircraft.turn_radius_m, R) + 1e-15 * maneuver.duration_s / unit
    side = 1.0 if maneuver.turn == Turn.CW else -1.0
    off = max(abs(abs(q) - R), abs((q.conjugate() * (e + w)).real) / R, side * (q.conjugate() * (e + w)).imag)
    allowed = WIND_TIE_TOLERANCE * (1.0 + R + best.duration_s / unit) if w else 0.0
    late = (maneuver.duration_s - best.duration_s) / unit
    return off > 8.0 * length or late > 4.0 * length + 2.0 * allowed


def flown(maneuver: Maneuver) -> tuple[complex, complex, complex, float]:
    """Position and heading at the end, relative to the circle, the velocity of the air past it, and R: recomputed."""
    r, V, start, orbit = maneuver.aircraft.turn_radius_m, maneuver.aircraft.airspeed_m_s, maneuver.start, maneuver.orbit
    q = complex(start.east_m - orbit.east_m, start.north_m - orbit.north_m) / r
    angle = radians(90.0 - start.heading_deg)
    east, north = maneuver.wind.velocity_m_s
    w = complex(east - orbit.velocity_east_m_s, north - orbit.velocity_north_m_s) / V
    for segment in maneuver.segments:
        u, t = CONTROLS[segment.letter], segment.duration_s * V / r
        e = complex(cos(angle + 0.5 * u * t), sin(angle + 0.5 * u * t))
        q += e * (2.0 * sin(0.5 * t) if u else t) + w * t
        angle += u * t
    return q, complex(cos(angle), sin(angle)), w, orbit.radius_m / r


# Runs

Check = Callable[[str, int, Random, "Scene", Counter[str]], None]


def run(kinds: dict[str, Callable[[Random], Scene]], seed: int, first: int, count: int, check: Check) -> None:
    """Check `count` scenes of the kinds in turn."""
    names = list(kinds)
    tally: Counter[str] = Counter()
    for i in range(first, first + count):
        name = names[i % len(names)]
        random = Random(f"{seed} {name} {i}")
        check(name, i, random, kinds[name](random), tally)
        if (i - first + 1) % 5000 == 0:
            print(f"{i - first + 1}: {dict(tally)}", file=sys.stderr, flush=True)
    print(f"{count} scenes of {', '.join(names)}: {dict(tally)}", flush=True)


def check_plan(name: str, i: int, random: Random, scene: Scene, tally: Counter[str]) -> None:
    """The plan's certificate must be valid."""
    certificate = certify(plan(*scene))
    tally["valid" if certificate.valid else "FALSE ALARM"] += 1
    if certificate.pieces:
        tally["without gradient"] += certificate.residual("gradient").skipped
    if not certificate.valid:
        failed = [(r.name, r.value, r.bound) for r in certificate.failed]
        print(f"FALSE ALARM {name} {i}: {scene!r} {certificate.maneuver.word} {failed}", flush=True)


def check_wrong(name: str, i: int, random: Random, scene: Scene, tally: Counter[str]) -> None:
    """Wrong maneuvers must have none."""
    for kind, maneuver in wrong_ones(random, scene):
        accepted = certify(maneuver).valid
        tally[f"{kind} {'ACCEPTED' if accepted else 'refused'}"] += 1
        if accepted:
            durations = [segment.duration_s for segment in maneuver.segments]
            print(f"ACCEPTED {name} {i} {kind}: {scene!r} {maneuver.word} {durations}", flush=True)


# The worst scene in wind


def varied(random: Random, scene: Scene) -> Scene:
    """A scene in wind with each number moved a little, by amounts from coarse to fine, or not at all."""
    pose, orbit, uav, wind = scene
    x, y, heading = pose.east_m, pose.north_m, pose.heading_deg
    assert wind is not None

    def moved(value: float) -> float:
        return value + random.choice((0.0, 1.0)) * 10.0 ** random.uniform(-10.0, 0.0) * random.gauss(0.0, 1.0)

    speed = min(abs(moved(wind.speed_m_s)), 0.95)
    tightest = (1.0 + speed) ** 2 * (1.0 + 1e-9)
    return Scene(
        Pose(moved(x), moved(y), degrees(moved(radians(heading)))),
        replace(orbit, radius_m=max(moved(orbit.radius_m), tightest)),
        uav,
        Wind(speed, degrees(moved(radians(wind.from_deg)))),
    )


def worst(seed: int, generations: int, count: int, name: str) -> tuple[float, str, Scene]:
    """The largest residual over its bound, among scenes that are varied from the worst ones so far."""
    random, kept = Random(seed), list[tuple[float, str, Scene]]()
    for generation in range(generations):
        if generation % 4 == 0:
            tried = [random.choice((unit_windy, at_windy_tie))(random) for _ in range(count)]
        else:
            tried = [varied(random, kept[i % len(kept)][2]) for i in range(count)]
        for scene in tried:
            certificate = certify(plan(*scene))
            named = [r for r in certificate.residuals if name in ("", r.name) and r.value is not None and r.bound]
            share, which = max(((r.value / r.bound, r.name) for r in named), default=(0.0, ""))
            kept.append((share, which, scene))
        kept = sorted(kept, key=lambda one: -one[0])[: max(count // 10, 1)]
        print(f"generation {generation}: {kept[0]}", file=sys.stderr, flush=True)
    return kept[0]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("part", choices=("plans", "boundaries", "wrong", "worst"))
    parser.add_argument("--wind", action="store_true", help="scenes in wind")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--first", type=int, default=0, help="the number of the first scene")
    parser.add_argument("--count", type=int, default=1000)
    parser.add_argument("--generations", type=int, default=40, help="worst: each has --count scenes")
    parser.add_argument("--residual", default="", help="worst: of this condition alone")
    given = parser.parse_args()
    if given.part == "worst":
        print(worst(given.seed, given.generations, given.count, given.residual))
        return
    plans = PLANS_IN_WIND if given.wind else PLANS
    boundaries = BOUNDARIES_IN_WIND if given.wind else BOUNDARIES
    kinds = {"plans": plans, "boundaries": boundaries, "wrong": plans | boundaries}[given.part]
    run(kinds, given.seed, given.first, given.count, check_wrong if given.part == "wrong" else check_plan)


if __name__ == "__main__":
    main()
