"""The page's engine beside the library: the same scenes answered by both, and in what the answers differ.

`python -m page.engine 10000` compares that many scenes and counts the differences; with a second
number it begins after that many scenes.
"""

import json
import random
import re
import subprocess
import sys
from collections import Counter
from math import cos, hypot, isclose, sin, tau
from pathlib import Path

from benchmarks.browsing import NODE
from loiter.errors import InvalidArgument, LoiterError, NotConverged, OutOfRange, RadiusTooSmall, WindTooStrong
from loiter.fences import CircleZone, Fence, PolygonZone
from loiter.files.document import PlacedProblem
from loiter.files.formats import FILE_FORMATS, SaveArguments, file_content
from loiter.files.missions.altitudes import AltitudeDatum, AltitudeReference
from loiter.files.missions.items import AUTOPILOTS
from loiter.geo import LocalFrame
from loiter.page.answers import fences, plans
from loiter.page.answers.files import check_points
from loiter.page.answers.refusals import SCENE_FIELDS, SceneField
from loiter.page.answers.tracks import lap
from loiter.planning.model import CALM, Aircraft, Orbit, Pose, Turn, Wind
from loiter.planning.problem import Problem
from loiter.planning.solve import all_fastest
from page.browsing import SOURCE

ENGINE, ASKED = SOURCE / "kernel" / "engine.js", Path(__file__).with_name("engine.js")
FORMATS = [known.endings[0].removeprefix(".") for known in FILE_FORMATS if known.media_type]

# What the page calls an error.
KINDS = {
    RadiusTooSmall: "radius-too-small",
    WindTooStrong: "wind-too-strong",
    OutOfRange: "out-of-range",
    NotConverged: "not-converged",
    InvalidArgument: "invalid-argument",
    LoiterError: "refused",
}

# Times agree to this share of 1 s and themselves. In wind T is as flat at its minimum as a parabola, so the place of
# joining is known to the square root of its rounding: this share of the coordinates.
CLOSE, FLAT = 1e-9, 1e-6
NUMBER = re.compile(r"-?\d+\.?\d*(?:[eE][-+]?\d+)?")

# In the first scenes of each so many, in still air and in wind, a clear entry is searched for, which takes a second.
SEARCHED, OF_SCENES = 2, 12

LIMITS = {"max_bank_deg": 35.0, "min_turn_radius_m": 45.0, "max_turn_rate_deg_s": 20.0}


def drawn(count, seed):
    """Scenes of every kind, each with the altitude of a mission: a dict of JSON."""
    chance = random.Random(seed)
    return [_scene(chance, ("still", "wind", "moving", "infeasible", "tie", "spoilt")[i % 6]) for i in range(count)]


def _scene(chance, kind):
    limit = chance.choice(list(LIMITS))
    away = 10.0 ** chance.uniform(0.5, 3.3)
    scene = {
        "pose": {
            "east_m": round(chance.uniform(-away, away), 3),
            "north_m": round(chance.uniform(-away, away), 3),
            "heading_deg": round(chance.uniform(-360.0, 720.0), 2),
        },
        "orbit": {
            "east_m": 0.0,
            "north_m": 0.0,
            "radius_m": round(chance.uniform(110.0, 400.0), 2),
            "turn": chance.choice(["either", "cw", "ccw"]),
            "velocity_east_m_s": 0.0,
            "velocity_north_m_s": 0.0,
        },
        "aircraft": {"airspeed_m_s": 18.0, limit: LIMITS[limit]},
        "wind": None,
        "tolerance_m": chance.choice([0.0, 0.0, 1.0]),
        "origin": {
            "latitude_deg": round(chance.uniform(-80.0, 80.0), 4),
            "longitude_deg": chance.choice([8.23, 179.999]),
        },
        "altitude_m": 600.0,
        "altitude_reference": chance.choice(["msl", "home", "ground"]),
        "home_altitude_m": chance.choice([None, 450.0]),
    }
    if kind in ("wind", "infeasible"):
        scene["wind"] = {
            "speed_m_s": round(chance.uniform(0.5, 7.0), 2),
            "from_deg": round(chance.uniform(0.0, 360.0), 1),
        }
    if kind == "moving":
        scene["orbit"] |= {"velocity_east_m_s": round(chance.uniform(-5.0, 5.0), 2), "velocity_north_m_s": 2.5}
    if kind == "infeasible":
        scene["orbit"]["radius_m"] = round(chance.uniform(5.0, 60.0), 1)
        scene["wind"]["speed_m_s"] = round(chance.uniform(0.0, 40.0), 1)
    if kind == "tie":
        scene["pose"] |= {"north_m": 0.0, "heading_deg": chance.choice([90.0, 270.0])}
        scene["orbit"]["turn"] = "either"
    if kind == "spoilt":
        part, name = chance.choice(
            [
                ("pose", "east_m"),
                ("orbit", "radius_m"),
                ("aircraft", "airspeed_m_s"),
                ("aircraft", limit),
                ("origin", "latitude_deg"),
            ]
        )
        scene[part][name] = chance.choice([0.0, -3.5, 95.0, 1e17, 123456.789])
    return scene


def fence_of(chance, scene, *, search):
    """A fence for a scene, as the page has it; now and then one that the library refuses. None for half of them."""
    if chance.random() < 0.5:
        return None
    orbit, pose = scene["orbit"], scene["pose"]
    reach = 2.0 * abs(orbit["radius_m"]) + hypot(pose["east_m"], pose["north_m"])
    zones = [_zone(chance, f"zone {i + 1}", pose, abs(orbit["radius_m"]), reach) for i in range(chance.randint(1, 3))]
    if chance.random() < 0.3:
        corners = [[-1.5 * reach, -1.5 * reach], [1.5 * reach, -1.4 * reach], [reach, 1.3 * reach], [-reach, reach]]
        zones.append({"name": "field", "corners": corners, "inclusion": True})
    return {"zones": zones, "margin_m": chance.choice([None, 0.0, 12.5]), "search": search}


def _zone(chance, name, pose, radius_m, reach):
    """A circle or a polygon to stay out of, half of them about the straight line to the circle."""
    share = chance.choice([0.0, chance.uniform(0.4, 0.8)])
    spread, size = reach * chance.uniform(0.1, 1.0 - share), reach * chance.uniform(0.02, 0.2)
    east = share * pose["east_m"] + chance.uniform(-spread, spread)
    north = share * pose["north_m"] + chance.uniform(-spread, spread)
    apart, least = hypot(east, north), radius_m + size + chance.uniform(20.0, 60.0)
    if apart < least and chance.random() < 0.8:
        # Off the circle, which otherwise is blocked itself.
        east, north = east * least / apart, north * least / apart
    if chance.random() < 0.5:
        return {"name": name, "east_m": east, "north_m": north, "radius_m": size, "inclusion": False}
    angles = sorted(chance.uniform(0.0, tau) for _ in range(chance.randint(3, 6)))
    corners = [[east + size * cos(a) * chance.uniform(0.4, 1.0), north + size * sin(a)] for a in angles]
    return {"name": name, "corners": corners, "inclusion": False}


def fence_values(fence):
    """The library's fence and the margin of a fence of the page."""
    zones = [
        PolygonZone(zone["name"], [tuple(corner) for corner in zone["corners"]], zone["inclusion"])
        if "corners" in zone
        else CircleZone(**zone)
        for zone in fence["zones"]
    ]
    return Fence(tuple(zones)), fence["margin_m"]


def of_the_page(scenes, fences=None, formats=FORMATS):
    """The answers of the page's engine, in Node."""
    asked = json.dumps(
        [[scene, formats, fence] for scene, fence in zip(scenes, fences or [None] * len(scenes), strict=True)]
    )
    done = subprocess.run([NODE, ASKED, ENGINE], input=asked, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def placed(scene):
    """The problem and the frame of a scene; raises the library's errors."""
    orbit = Orbit(**scene["orbit"] | {"turn": Turn(scene["orbit"].get("turn", "either"))})
    wind = Wind(**scene["wind"]) if scene["wind"] else CALM
    problem = Problem(Pose(**scene["pose"]), orbit, Aircraft(**scene["aircraft"]), wind, scene.get("tolerance_m", 0.0))
    return PlacedProblem(problem, LocalFrame(**scene["origin"]) if scene.get("origin") else None)


def file_of(name, scene, maneuver, *, along_path=False):
    """What `loiter plan --save` writes of a maneuver, missions with `--along-path` where that is given."""
    check_points(maneuver, 1.0)
    arguments = SaveArguments(
        maneuver=maneuver,
        frame=placed(scene).frame,
        altitude_m=scene["altitude_m"],
        datum=AltitudeDatum(AltitudeReference(scene["altitude_reference"]), scene["home_altitude_m"]),
        spacing_m=None,
        chord_error_m=1.0,
        autopilot=AUTOPILOTS["ardupilot"],
        along_path=along_path and name in ("plan", "waypoints"),
    )
    return file_content(Path(f"entry.{name}"), arguments).decode()


def of_the_library(scene, fence=None):
    """The answers of the library to a scene, and those to a fence."""
    of_fence = {}
    if fence:
        check = answered(lambda: fences.fence_check(placed(scene), *fence_values(fence)))
        of_fence = {"check": check}
        if fence["search"] and check.get("clear") is False:
            of_fence["clear"] = answered(lambda: fences.clear_plan(placed(scene), *fence_values(fence)))
    return of_fence | {
        "plan": answered(lambda: plans.plan(placed(scene))),
        "certificate": answered(lambda: plans.certificate(placed(scene))),
        "lap": answered(lambda: lap(all_fastest(placed(scene).problem)[0])),
        "files": {
            name: answered(lambda name=name: file_of(name, scene, all_fastest(placed(scene).problem)[0]))
            for name in FORMATS
        },
    }


def refusal(error):
    """An error of the library as the page has it."""
    sentence, path = str(error), ""
    if isinstance(error, InvalidArgument):
        name = error.argument
        # "zone 'mast'" is no path of a scene.
        plain = SceneField(name, "") if "'" in name else SceneField(name.replace(" ", "."), name.replace(" ", "/"))
        field = SCENE_FIELDS.get(name, plain)
        sentence, path = f"{field.name} {error.problem}", field.path
    kind = next(KINDS[cls] for cls in type(error).__mro__ if cls in KINDS)
    radius = error.fitted_radius_m if isinstance(error, RadiusTooSmall) else None
    return {"sentence": sentence, "kind": kind, "places": [path] if path else [], "fitted_radius_m": radius}


def answered(answer):
    try:
        found = answer()
    except LoiterError as error:
        return {"refusal": refusal(error)}
    return found if isinstance(found, str) else json.loads(json.dumps(found))


def difference(page, library, close, size=1.0):
    """Where two JSON values differ, numbers by more than a share of themselves or of `size`; None if nowhere."""
    if isinstance(library, bool) or library is None or isinstance(library, str):
        return None if page == library else f"{page!r} instead of {library!r}"
    if isinstance(library, int | float):
        alike = page is not None and isclose(page, library, rel_tol=close, abs_tol=close * size)
        return None if alike else f"{page} instead of {library}"
    keys = library if isinstance(library, dict) else range(len(library))
    if len(page) != len(library):
        return f"{len(page)} instead of {len(library)} parts"
    found = ((key, difference(page[key], library[key], close, size)) for key in keys)
    return next((f"{key}: {what}" for key, what in found if what is not None), None)


def difference_of_files(page, library, size):
    """How the text of a file differs: "" if nowhere, "digits" in the last digits of numbers, else in what."""
    if not isinstance(library, str) or not isinstance(page, str):
        return difference(page, library, CLOSE) or ""
    whole = re.sub(r"(\d)\.0\b", r"\1", library)
    if page in (library, whole):
        return ""
    if NUMBER.sub("#", page) != NUMBER.sub("#", library):
        return "text"
    pairs = zip(map(float, NUMBER.findall(page)), map(float, NUMBER.findall(library)), strict=True)
    return "digits" if all(isclose(a, b, rel_tol=FLAT, abs_tol=FLAT * size) for a, b in pairs) else "numbers"


def verdicts(proof):
    """What a certificate says, without its residuals, which are rounding."""
    certificate = proof["certificate"]
    names = ("valid", "proved_optimal", "basis", "word", "turn", "choice", "runner_up")
    return {name: certificate[name] for name in names} | {
        "verdicts": [one["verdict"] for one in certificate["residuals"]]
    }


def differences(scene, page, fence=None):
    """All differences of an answer of the page from the library's, by name."""
    library = of_the_library(scene, fence)
    found = Counter()
    a, b = page["plan"], library["plan"]
    size = max(abs(scene["pose"]["east_m"]), abs(scene["pose"]["north_m"]), scene["orbit"]["radius_m"], 1.0)
    if "refusal" in a or "refusal" in b:
        what = difference(a, b, CLOSE)
        return Counter({f"refusal: {what}": 1} if what else {})
    if abs(a["duration_s"] - b["duration_s"]) > CLOSE * (1.0 + b["duration_s"]):
        found[f"time: {a['duration_s']} instead of {b['duration_s']}"] += 1
    if (a["word"], a["turn"]) != (b["word"], b["turn"]):
        # Words that tie: the other one is among the optimal ones of both.
        found["a tie, in another order"] += 1
        return found
    if what := difference(a, b, FLAT, size):
        found["plan: " + what.partition(" instead")[0][:60]] += 1
    if what := difference(verdicts(page["certificate"]), verdicts(library["certificate"]), CLOSE):
        found["certificate: " + what[:90]] += 1
    if what := difference(page["lap"], library["lap"], FLAT, size):
        found["lap: " + what[:60]] += 1
    if fence:
        found += fence_differences(page, library, size)
    for name in FORMATS:
        if what := difference_of_files(page["files"][name], library["files"][name], size):
            found[f"{name}: {what[:80]}"] += 1
    return found


def fence_differences(page, library, size):
    """How the answers to a fence differ, by name. The string pulled taut, which the page has not, is left out."""
    found, a, b = Counter(), page["check"], library["check"]
    if "refusal" in a or "refusal" in b:
        sentences = [str(one.get("refusal", {}).get("sentence")) for one in (a, b)]
        # Where an outline crosses itself is said for the first such place that each finds.
        if len({sentence.partition(" at ")[0] for sentence in sentences}) > 1:
            found[f"refusal of the fence: {sentences[0][:60]!r} instead of {sentences[1][:60]!r}"] += 1
        return found
    if a["clear"] and b["clear"]:
        # The place of joining is one of the entry, and one of the hold before and after a round: they are as near.
        for one in (a, b):
            one["closest"] = {k: one["closest"][k] for k in ("zone", "clearance_m", "east_m", "north_m")}
    found["plans that are clear" if b["clear"] else "plans that are blocked"] += 1
    if what := difference(a, b, FLAT, size):
        found["check: " + what[:90]] += 1
    if "clear" in library:
        entries = [one["clear"]["maneuver"] for one in (page, library)]
        found["clear entries" if entries[1] else "no clear entry"] += 1
        times = [None if one is None else one["duration_s"] for one in entries]
        if what := difference(*times, 1e-6):
            found[f"clear entry: {what}"] += 1
    return found


def main(count, first=0):
    """Compare the scenes from `first` to `count`, some hundred at a time, and print what differs how often."""
    found = Counter()
    for start in range(first, count, 200):
        scenes = drawn(min(200, count - start), seed=start)
        chance = random.Random(start)
        fences_drawn = [fence_of(chance, scene, search=i % OF_SCENES < SEARCHED) for i, scene in enumerate(scenes)]
        answers = zip(scenes, of_the_page(scenes, fences_drawn), fences_drawn, strict=True)
        for scene, page, fence in answers:
            found += differences(scene, page, fence)
        print(f"{start + len(scenes)} scenes: {dict(found.most_common())}", flush=True)


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
