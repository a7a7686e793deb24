"""The page's engine beside the library for scenes with a slot.

`python -m page.slots 1000` compares that many scenes and counts the differences.
"""

import random
import sys
from collections import Counter

from loiter.page.answers import plans
from loiter.page.answers.tracks import lap
from loiter.planning.slot import Slot
from page.engine import (
    CLOSE,
    FLAT,
    FORMATS,
    NUMBER,
    answered,
    difference,
    difference_of_files,
    drawn,
    file_of,
    of_the_page,
    placed,
    verdicts,
)

# The place of a slot at the join, and the end of the path, which are found by different ways.
MEETS_M = 1e-6


def slot_of(chance):
    """A slot as the page has it; now and then one that is too far in time."""
    at_s = chance.choice([0.0, 0.0, chance.uniform(-100.0, 100.0), 1e9])
    return {"phase_deg": round(chance.uniform(-360.0, 720.0), 2), "at_s": round(at_s, 2)}


def drawn_with_slots(count, seed, *, certified):
    """Scenes of every kind, each with a slot; the first `certified` of them have their certificates compared."""
    chance = random.Random(seed)
    return [
        scene
        | {
            "slot": slot_of(chance),
            "tolerance_m": chance.choice([0.0] * 7 + [1.0]),
            "uncertified": i >= certified,
        }
        for i, scene in enumerate(drawn(count, seed))
    ]


def of_the_library(scene):
    """The library's plan, certificate, lap and files of a scene with a slot."""
    slot = Slot(**scene["slot"])
    return {
        "plan": answered(lambda: plans.plan(placed(scene), slot)),
        "certificate": None if scene["uncertified"] else answered(lambda: plans.certificate(placed(scene), slot)),
        "lap": answered(lambda: lap(_entry(scene))),
        "files": {
            name: answered(lambda name=name: file_of(name, scene, _entry(scene), along_path=True)) for name in FORMATS
        },
    }


def _entry(scene):
    return plans.first_maneuver(placed(scene).problem, Slot(**scene["slot"]))


def of_certificate(proof):
    """What a certificate says: its verdicts, the time before which it excludes arrivals, and what samples decide."""
    found = proof["certificate"]
    notes = [NUMBER.sub("#", one["note"]) for one in found["residuals"]]
    return verdicts(proof) | {"before_s": found.get("no_arrival_before_s"), "notes": notes}


def differences(scene, page):
    """In what the page's answers to a scene with a slot differ from the library's, and how it ends, by name."""
    library, found = of_the_library(scene), Counter()
    a, b = page["plan"], library["plan"]
    if "refusal" in a or "refusal" in b:
        what = difference(a, b, CLOSE)
        return Counter([f"refusal: {what}" if what else "refused by both"])
    found["slots in wind" if scene["wind"] or scene["orbit"]["velocity_north_m_s"] else "slots in still air"] += 1
    if abs(a["duration_s"] - b["duration_s"]) > CLOSE * (1.0 + b["duration_s"]):
        found[f"time: {a['duration_s']} instead of {b['duration_s']}"] += 1
    size = max(abs(scene["pose"]["east_m"]), abs(scene["pose"]["north_m"]), scene["orbit"]["radius_m"], 1.0)
    if what := difference(a, b, FLAT, size):
        found[f"plan: {what[:90]}"] += 1
    if what := difference(page["lap"], library["lap"], FLAT, size):
        found[f"lap: {what[:90]}"] += 1
    if not scene["uncertified"]:
        what = difference(of_certificate(page["certificate"]), of_certificate(library["certificate"]), FLAT)
        found[f"certificate: {what[:90]}" if what else "certificates"] += 1
    miss_m = max(abs(page["slotPose"][name] - b["join"][name]) for name in ("east_m", "north_m"))
    if miss_m > MEETS_M * (1.0 + size):
        found[f"the slot is {miss_m:g} m from the join"] += 1
    for name in FORMATS:
        what = difference_of_files(page["files"][name], library["files"][name], size)
        if what not in ("", "digits"):
            found[f"{name}: {what[:80]}"] += 1
    return found


def main(count):
    """Compare so many scenes, and print what differs how often."""
    found = Counter()
    for start in range(0, count, 200):
        scenes = drawn_with_slots(min(200, count - start), seed=start, certified=40)
        for scene, page in zip(scenes, of_the_page(scenes), strict=True):
            found += differences(scene, page)
        print(f"{start + len(scenes)} scenes: {dict(found.most_common())}", flush=True)


if __name__ == "__main__":
    main(int(sys.argv[1]))
