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
        segment = _segment(here, now, letter, t, aircraft, wind)
        segments.append(segment)
        here, now = segment.end, now + segment.duration_s
    miss_m = miss * aircraft.turn_radius_m
    return Maneuver(problem.pose, problem.orbit, aircraft, TURNS[Side(entry.side)], tuple(segments), miss_m, wind)


def _segment(start: Pose, start_s: float, letter: str, t: float, aircraft: Aircraft, wind: Wind) -> Segment:
    r, u = aircraft.turn_radius_m, CONTROLS[letter]
    length = t * r
    end = flown_from(start, u, length, aircraft, wind)
    return Segment(letter, start_s, length / aircraft.airspeed_m_s, length, u / r, start, end)
