"""Plans and certificates, with the tracks that the page draws."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from loiter.certificate.entry_certificate import Instant, certify
from loiter.certificate.slot_certificate import certify_slot
from loiter.files.document import PlacedProblem, answer
from loiter.page.answers.texts import command, instruction, python
from loiter.page.answers.tracks import track
from loiter.planning.maneuver import Maneuver
from loiter.planning.problem import Problem
from loiter.planning.slot import Slot
from loiter.planning.solve import all_fastest, arrivals, best_and_others, best_and_others_in_slot

# Steps of a curve over a segment; over a hundredth of a turn the chord of a sine is off by 0.05 % of its amplitude.
STEPS = 100


def plan(placed: PlacedProblem, slot: Slot | None = None) -> dict[str, Any]:
    """The document of `loiter plan --json`, with tracks and texts."""
    problem = placed.problem
    best, others = best_and_others(problem) if slot is None else best_and_others_in_slot(problem, slot)
    first, *_ = maneuvers = [*best, *others]
    document: dict[str, Any] = answer(best, others, placed.frame)
    for entry, maneuver in zip([document, *document["alternatives"]], maneuvers, strict=True):
        entry["track"] = track(maneuver)
    (start_x, *_), (start_y, *_) = (document["track"][axis] for axis in "xy")
    return document | {
        "optimal": len(best),
        "other_turn_later_s": _other_turn_later_s(maneuvers),
        "instruction": instruction(first),
        "command": command(problem, slot),
        "python": python(problem, slot),
        "reduced": {"x": start_x, "y": start_y, "radius": problem.radius},
    }


def first_maneuver(problem: Problem, slot: Slot | None = None) -> Maneuver:
    """The first maneuver of `plan`."""
    first, *_ = all_fastest(problem) if slot is None else arrivals(problem, slot)
    return first


def _other_turn_later_s(maneuvers: Sequence[Maneuver]) -> float | None:
    """Seconds by which the best maneuver of the other direction joins later than the first; None without one."""
    first, *others = maneuvers
    other = next((m for m in others if m.turn != first.turn), None)
    return None if other is None else other.duration_s - first.duration_s


def certificate(placed: PlacedProblem, slot: Slot | None = None) -> dict[str, Any]:
    """The certificate of `loiter plan --certify --json`, and the curves of its picture."""
    first, tolerance_m = first_maneuver(placed.problem, slot), placed.problem.tolerance_m
    checked = certify(first, tolerance_m=tolerance_m) if slot is None else certify_slot(first, slot)
    instants = [instant for piece in checked.history(STEPS) for instant in piece]
    series = {name: [getattr(instant, name) for instant in instants] for name in Instant._fields}
    switches = [switch.time_s for switch in checked.switches]
    return {"certificate": checked.to_dict(), "series": series | {"switches_s": switches}}
