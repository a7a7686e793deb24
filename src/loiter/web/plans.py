"""What the service answers, as plain values: the library's answers with what a page draws."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from loiter.io.document import answer, described
from loiter.planning.maneuver import Maneuver
from loiter.planning.solve import candidates, compared
from loiter.web.models import Asked
from loiter.web.texts import command, instruction, python
from loiter.web.tracks import track


def plan(asked: Asked) -> dict[str, Any]:
    """`models.Plan`: what `loiter plan --json` prints, and the rest."""
    best, others = compared(*asked[:4], tolerance_m=asked.tolerance_m)
    first = best[0]
    document: dict[str, Any] = answer(best, others, asked.frame)
    for told, maneuver in zip([document, *document["alternatives"]], [*best, *others], strict=True):
        told["track"] = track(maneuver)
    return document | {
        "optimal": len(best),
        "other_turn_later_s": _other_turn_later_s(first, [*best, *others]),
        "instruction": instruction(first),
        "command": command(asked),
        "python": python(asked),
        "reduced": {
            "x": document["track"]["x"][0],
            "y": document["track"]["y"][0],
            "radius": asked.orbit.radius_m / asked.aircraft.turn_radius_m,
        },
    }


def every(asked: Asked) -> dict[str, Any]:
    """`models.Candidates`."""
    found = candidates(*asked[:4], tolerance_m=asked.tolerance_m)
    return {
        "candidates": [
            described(m, asked.frame) | {"track": track(m), "later_s": m.duration_s - found[0].duration_s}
            for m in found
        ]
    }


def _other_turn_later_s(first: Maneuver, known: Sequence[Maneuver]) -> float | None:
    other = next((m for m in known if m.turn != first.turn), None)
    return None if other is None else other.duration_s - first.duration_s
