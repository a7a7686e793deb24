"""Fences on the page: whether the plan stays clear, and the fastest clear entry that is found."""

from __future__ import annotations

from math import inf
from typing import Any

from loiter.errors import InvalidArgument
from loiter.fences.clear_entry import ClearEntry, fastest_clear
from loiter.fences.fence import Fence, check
from loiter.files.document import PlacedProblem, maneuver_values
from loiter.page.answers.plans import first_maneuver
from loiter.page.answers.texts import instruction
from loiter.page.answers.tracks import lap, track
from loiter.planning.maneuver import Maneuver
from loiter.planning.slot import Slot


def fence_check(
    placed: PlacedProblem, fence: Fence, margin_m: float | None, slot: Slot | None = None
) -> dict[str, Any]:
    """Whether the first optimal maneuver and its hold stay clear: `FenceCheck.to_dict`, with its sentence."""
    found = check(fence, first_maneuver(placed.problem, slot), margin_m)
    return found.to_dict() | {"sentence": found.sentence()}


def clear_plan(placed: PlacedProblem, fence: Fence, margin_m: float | None) -> dict[str, Any]:
    """The fastest clear entry that is found, with its track, a lap after it, and what the pilot does.

    Without one `maneuver` is None, and `blocking` names the zones. No clear entry takes less than `least_s` seconds;
    None where it is known that there is none.
    """
    found = _search(placed, fence, margin_m)
    best = found.maneuver
    answer = {
        "sentence": found.sentence,
        "least_s": None if found.least_s == inf else found.least_s,
        "blocking": list(found.blocking),
        "later_s": None,
        "instruction": None,
        "lap": None,
        "maneuver": None,
    }
    if best is None:
        return answer
    values = maneuver_values(best, placed.frame) | {"track": track(best)}
    return answer | {
        "later_s": found.later_s, "instruction": instruction(best), "lap": lap(best), "maneuver": values
    }  # fmt: skip


def clear_maneuver(placed: PlacedProblem, fence: Fence, margin_m: float | None) -> Maneuver:
    """The fastest clear entry that is found, for files; raises `InvalidArgument` where none is."""
    found = _search(placed, fence, margin_m)
    if found.maneuver is None:
        raise InvalidArgument("fence", f"lets no plan through that a file could have: {found.sentence}")
    return found.maneuver


def _search(placed: PlacedProblem, fence: Fence, margin_m: float | None) -> ClearEntry:
    problem = placed.problem
    return fastest_clear(fence, problem.pose, problem.orbit, problem.aircraft, problem.wind, margin_m)
