"""What the service answers, as plain values: the library's answers with what a page draws."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from loiter.io.document import answer, maneuver_values
from loiter.planning.maneuver import Maneuver
from loiter.planning.scaling import radius_in_turns
from loiter.planning.solve import candidates, compared, each_way, plan_all
from loiter.verify.certificate import Instant, certify
from loiter.web.answers.texts import command, instruction, python
from loiter.web.answers.tracks import track
from loiter.web.models import Asked

# Chords of a sine over a hundredth of a turn depart from it by 0.05 % of its height.
STEPS = 100


def plan(asked: Asked) -> dict[str, Any]:
    """`models.Plan`: what `loiter plan --json` prints, and the rest."""
    return _told(asked, *compared(*asked[:4], tolerance_m=asked.tolerance_m))


def fastest(asked: Asked) -> dict[str, Any]:
    """`models.Plan`, of the alternatives only the best the other way round: what a drag in wind has time for."""
    return _told(asked, *each_way(*asked[:4], tolerance_m=asked.tolerance_m))


def _told(asked: Asked, best: Sequence[Maneuver], others: Sequence[Maneuver]) -> dict[str, Any]:
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
            "radius": radius_in_turns(asked.orbit, asked.aircraft),
        },
    }


def every(asked: Asked) -> dict[str, Any]:
    """`models.Candidates`."""
    found = candidates(*asked[:4], tolerance_m=asked.tolerance_m)
    return {
        "candidates": [
            maneuver_values(m, asked.frame) | {"track": track(m), "later_s": m.duration_s - found[0].duration_s}
            for m in found
        ]
    }


def proof(asked: Asked) -> dict[str, Any]:
    """`models.Proof`: what `loiter plan --certify --json` prints, and the curves of its picture."""
    first = plan_all(*asked[:4], tolerance_m=asked.tolerance_m)[0]
    certificate = certify(first, tolerance_m=asked.tolerance_m)
    instants = [instant for piece in certificate.history(STEPS) for instant in piece]
    series = {name: [getattr(instant, name) for instant in instants] for name in Instant._fields}
    switches = [switch.time_s for switch in certificate.switches]
    return {"certificate": certificate.to_dict(), "series": series | {"switches_s": switches}}


def _other_turn_later_s(first: Maneuver, known: Sequence[Maneuver]) -> float | None:
    other = next((m for m in known if m.turn != first.turn), None)
    return None if other is None else other.duration_s - first.duration_s
