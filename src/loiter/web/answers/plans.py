"""What the service answers, as plain values: the library's answers with what a page draws."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from loiter.geo.placed import PlacedProblem
from loiter.io.document import answer, described
from loiter.planning.maneuver import Maneuver
from loiter.planning.solve import all_fastest, best_and_others, best_each_way, extremals
from loiter.verify.certificate import Instant, certify
from loiter.web.answers.texts import command, instruction, python
from loiter.web.answers.tracks import track

# Chords of a sine over a hundredth of a turn depart from it by 0.05 % of its height.
STEPS = 100


def plan(placed: PlacedProblem) -> dict[str, Any]:
    """`models.Plan`: the document of `loiter plan --json`, with tracks and texts."""
    return _document(placed, *best_and_others(placed.problem))


def fastest(placed: PlacedProblem) -> dict[str, Any]:
    """`models.Plan` with one alternative only, the best in the other direction: fast enough while one drags in wind."""
    return _document(placed, *best_each_way(placed.problem))


def _document(placed: PlacedProblem, best: Sequence[Maneuver], others: Sequence[Maneuver]) -> dict[str, Any]:
    first, *_ = best
    document: dict[str, Any] = answer(best, others, placed.frame)
    for described_maneuver, maneuver in zip([document, *document["alternatives"]], [*best, *others], strict=True):
        described_maneuver["track"] = track(maneuver)
    start_x, start_y = (document["track"][axis][0] for axis in "xy")
    return document | {
        "optimal": len(best),
        "other_turn_later_s": _other_turn_later_s(first, [*best, *others]),
        "instruction": instruction(first),
        "command": command(placed.problem),
        "python": python(placed.problem),
        "reduced": {"x": start_x, "y": start_y, "radius": placed.problem.radius},
    }


def every(placed: PlacedProblem) -> dict[str, Any]:
    """`models.Candidates`."""
    found = extremals(placed.problem)
    least_s = min(m.duration_s for m in found)
    return {
        "candidates": [
            described(m, placed.frame) | {"track": track(m), "later_s": m.duration_s - least_s} for m in found
        ]
    }


def proof(placed: PlacedProblem) -> dict[str, Any]:
    """`models.Proof`: the certificate of `loiter plan --certify --json`, and the curves of its picture."""
    first, *_ = all_fastest(placed.problem)
    certificate = certify(first, tolerance_m=placed.problem.tolerance_m)
    instants = [instant for piece in certificate.history(STEPS) for instant in piece]
    series = {name: [getattr(instant, name) for instant in instants] for name in Instant._fields}
    switches = [switch.time_s for switch in certificate.switches]
    return {"certificate": certificate.to_dict(), "series": series | {"switches_s": switches}}


def _other_turn_later_s(first: Maneuver, known: Sequence[Maneuver]) -> float | None:
    other = next((m for m in known if m.turn != first.turn), None)
    return None if other is None else other.duration_s - first.duration_s
