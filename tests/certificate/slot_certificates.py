"""Certificates of entries into slots by the hundred: `python -m certificate.slot_certificates 300`.

Plans at random, in still air and in wind, must have a valid certificate; `folds` takes slots next to jumps of the time.
Wrong maneuvers and wrong slots, made from such plans, must have none: a later root (another word that meets the slot,
or the first that still does after the answer), another word, a slot a millionth of a radian or of a turn radius
further, and a piece that is longer or shorter by a millionth. A last number is the seed.
"""

import sys
from collections import Counter
from collections.abc import Iterator
from dataclasses import replace
from math import degrees, inf
from random import Random

import numpy as np

from kernel.slots import fold_scenes, random_scenes
from loiter import Aircraft, Orbit, Pose, Slot, Turn, Wind, plan
from loiter.certificate import certify_slot
from loiter.certificate.slot_check import resolution
from loiter.kernel.entry import Entry
from loiter.kernel.wind import slots
from loiter.kernel.wind.slots import arrival_of
from loiter.kernel.wind.wind_search import entry_of, scene_of
from loiter.kernel.words import Word
from loiter.planning.maneuver import Maneuver
from loiter.planning.model import sign_of, wind_from_velocity
from loiter.planning.problem import Problem, problem_of
from loiter.planning.problem import maneuver as scaled
from loiter.planning.slot import phase_at_start

UAV = Aircraft(18.0, min_turn_radius_m=50.0)
MILLIONTH = 1e-6


def scene(scenes, i) -> tuple[Problem, Slot]:
    """A scene of the kernel's check in metres, and its slot."""
    r, V = UAV.turn_radius_m, UAV.airspeed_m_s
    q, w = complex(scenes.place[i]) * r, complex(scenes.wind[i]) * V
    turn = Turn.CCW if scenes.way[i] > 0.0 else Turn.CW
    wind = wind_from_velocity(w.real, w.imag) if w else Wind(0.0, 0.0)
    orbit = Orbit(0.0, 0.0, float(scenes.R[i]) * r * (1.0 + 1e-12), turn)
    pose = Pose(q.real, q.imag, 90.0 - degrees(scenes.heading[i]))
    return Problem(pose, orbit, UAV, wind), Slot(90.0 - degrees(scenes.azimuth[i]))


def later_roots(problem: Problem, slot: Slot) -> Iterator[Maneuver]:
    """The first arrival of each word: the answer, and later ones."""
    given, side = problem.in_wind(), sign_of(problem.orbit.turn)
    air, moving = scene_of(given), slots.Slot(side, phase_at_start(slot, given, problem.time_unit_s))
    begin = slots.first_within_reach(moving, air)
    until = 60.0 + 2.0 * begin.time
    found = [slots.first_with_straight(u, v, begin, moving, air, until) for u in (1, -1) for v in (1, -1)]
    found += [slots.first_of_three_arcs(u, h, begin, moving, air, until) for u in (1, -1) for h in (0, 1)]
    for one in found:
        if one.path.time < inf:
            yield scaled(problem, entry_of(arrival_of(one, air)), 0.0)


def wrong_ones(random: Random, problem: Problem, slot: Slot) -> Iterator[tuple[str, Maneuver, Slot]]:
    """Maneuvers that are not the first arrival in a slot, or not in it, and what is wrong with each."""
    best = plan(problem.pose, problem.orbit, problem.aircraft, problem.wind, slot=slot)
    unit_s = problem_of(best).time_unit_s
    for other in later_roots(problem, slot):
        if other.duration_s - best.duration_s > 2.0 * resolution(other.duration_s / unit_s) * unit_s:
            yield "later root", other, slot
    if not best.segments:
        return
    durations = [segment.duration_s / unit_s for segment in best.segments]
    words = [word for word in Word if len(word.letters) == len(best.word) and word.letters != best.word]
    side = sign_of(best.turn)
    yield "word", scaled(problem, Entry(side, int(random.choice(words)), *[*durations, 0.0, 0.0][:3]), 0.0), slot
    yield "phase", best, replace(slot, phase_deg=slot.phase_deg + random.choice((1, -1)) * degrees(MILLIONTH))
    i, sign = random.randrange(len(durations)), random.choice((1, -1))
    changed = [max(t + sign * MILLIONTH * (i == j), 0.0) for j, t in enumerate(durations)]
    # At R = 1 a last arc on the circle itself stays in the slot.
    yield "duration", scaled(problem, Entry(side, int(Word[best.word]), *[*changed, 0.0, 0.0][:3]), 0.0), slot


def stays_in_slot(maneuver: Maneuver) -> bool:
    """Whether the last arc is nearly on the circle itself, so that a longer one is later in the slot."""
    *_, last = maneuver.segments
    turns_with = last.letter == ("L" if maneuver.turn is Turn.CCW else "R")
    return turns_with and problem_of(maneuver).radius < 1.2


def compare(n: int, windy: bool, folds: bool, seed: int) -> int:
    """Certify n plans and the wrong ones made from them; print the counts and return how many are judged wrongly."""
    random, drawn = Random(seed), (fold_scenes if folds else random_scenes)
    scenes = drawn(np.random.default_rng(seed), n, windy)
    tally: Counter[str] = Counter()
    for i in range(len(scenes.R)):
        problem, slot = scene(scenes, i)
        certificate = certify_slot(plan(problem.pose, problem.orbit, UAV, problem.wind, slot=slot), slot)
        tally["valid" if certificate.valid else "FALSE ALARM"] += 1
        tally["partly by samples"] += bool(certificate.residual("first").note)
        if not certificate.valid:
            print(f"FALSE ALARM seed {seed} scene {i}: {certificate.failed}", flush=True)
        for kind, wrong, where in wrong_ones(random, problem, slot):
            if kind == "duration" and stays_in_slot(wrong):
                continue
            accepted = certify_slot(wrong, where).valid
            tally[f"{kind} {'ACCEPTED' if accepted else 'refused'}"] += 1
            if accepted:
                print(f"ACCEPTED seed {seed} scene {i} {kind}: {wrong.word} {wrong.duration_s}", flush=True)
    print(f"{n} slots: {dict(tally)}", flush=True)
    return tally["FALSE ALARM"] + sum(count for name, count in tally.items() if "ACCEPTED" in name)


if __name__ == "__main__":
    seed = int(sys.argv[-1]) if sys.argv[2:] and sys.argv[-1].isdigit() else 1
    sys.exit(compare(int(sys.argv[1]), "wind" in sys.argv, "folds" in sys.argv, seed) > 0)
