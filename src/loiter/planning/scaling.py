"""Conversion of the kernel's answers to SI: multiplication by turn radius and airspeed."""

from __future__ import annotations

from loiter.kernel.entry import Entry
from loiter.kernel.words import Side, Word
from loiter.planning.flight import flown_from
from loiter.planning.maneuver import Maneuver
from loiter.planning.model import CONTROLS, Aircraft, Pose, Segment, Wind
from loiter.planning.problem import Problem
from loiter.planning.sides import TURNS


def maneuver(problem: Problem, entry: Entry, miss: float) -> Maneuver:
    """The kernel's answer to a problem, in SI; `miss` is its distance from the tangent point, in turn radii."""
    aircraft, wind = problem.aircraft, problem.wind
    segments: list[Segment] = []
    here, now = problem.pose, 0.0
    for letter, t in zip(Word(entry.word).letters, entry[2:], strict=False):
        r = aircraft.turn_radius_m
        segments.append(segment(here, now, letter, t * r, aircraft, wind, r))
        here, now = segments[-1].end, now + segments[-1].duration_s
    miss_m = miss * aircraft.turn_radius_m
    return Maneuver(problem.pose, problem.orbit, aircraft, TURNS[Side(entry.side)], tuple(segments), miss_m, wind)


def segment(
    start: Pose, start_s: float, letter: str, length_m: float, aircraft: Aircraft, wind: Wind, radius_m: float
) -> Segment:
    """A piece of a maneuver from a pose, flown with a radius, metres."""
    u = CONTROLS[letter]
    end = flown_from(start, u, length_m, aircraft, wind, radius_m)
    return Segment(letter, start_s, length_m / aircraft.airspeed_m_s, length_m, u / radius_m, start, end)
