"""Files that others could have damaged: `python tests/mutating.py 10000` reads so many of each kind."""

import json
import random
import sys
import tempfile
from collections import Counter
from pathlib import Path

from loiter.errors import LoiterError
from loiter.files import Autopilot, Frame, Mission, MissionItem, read_mission, read_parameters
from loiter.files.missions.qgcplan import qgcplan
from loiter.files.missions.wpl import wpl

# What to put in the place of something else.
ODD = [
    b"\x00",
    b"\xff\xfe",
    b"\xef\xbb\xbf",
    "\u0664\u0667\u2028\U0001f6e9".encode(),
    b"1e999",
    b"-1e-999",
    b"nan",
    b"-Infinity",
    b"9" * 400,
    b"9" * 5000,
    b"0x1F",
    b"1_000",
    b"''",
    b'"',
    b"null",
    b"true",
    b"[" * 3000,
    b'{"a":' * 3000,
    b"\t\t",
    b"\r",
    b"# ",
    b",",
    b"-",
    b"",
]

ITEMS = (
    MissionItem(22, Frame.ABOVE_HOME, (15.0, 0.0, 0.0, 0.0), 47.0, 8.0, 50.0),
    MissionItem(16, Frame.ABOVE_SEA, (0.0, 0.0, 0.0, 0.0), 47.001, 8.002, 600.0),
    MissionItem(177, Frame.NOWHERE, (1.0, 2.0, 0.0, 0.0), 0.0, 0.0, 0.0),
    MissionItem(17, Frame.ABOVE_TERRAIN, (0.0, 0.0, -80.0, 0.0), 47.0, 8.0, 100.0),
)
FLOWN = Mission(ITEMS, (47.0, 8.0, 500.0))
PLAN = qgcplan(FLOWN, Autopilot.PX4, 18.0)
MISSIONS = [PLAN, json.dumps(json.loads(PLAN)).encode(), wpl(FLOWN)]

ARDUPLANE = b"# Plane\nAIRSPEED_CRUISE,22.5\nACRO_LOCKING,0\nROLL_LIMIT_DEG,45\nWP_LOITER_RAD,-80\nWP_RADIUS,90\n"
MAVPROXY = b"LIM_ROLL_CD     4500.000000\nTRIM_ARSPD_CM   1800.000000 # 18 m/s\nWP_LOITER_RAD\t60\n"
PX4 = (
    b"# Onboard parameters for Vehicle 1\n#\n# Stack: PX4 Pro\n# Vehicle-Id Component-Id Name Value Type\n"
    b"1\t1\tFW_AIRSPD_TRIM\t15.000000000000000000\t9\n1\t1\tFW_R_LIM\t50.0\t9\n1\t1\tNAV_LOITER_RAD\t80.0\t9\n"
)
PARAMETERS = [ARDUPLANE, MAVPROXY, PX4]

KINDS = {"missions": (MISSIONS, read_mission), "parameters": (PARAMETERS, read_parameters)}


def mutated(content, rng):
    """A file after one to three accidents."""
    for _ in range(rng.randint(1, 3)):
        content = rng.choice([flipped, cut, overwritten, swapped, replaced, repeated])(content, rng)
    return content


def flipped(content, rng):
    """Some bits turned over."""
    damaged = bytearray(content)
    for _ in range(rng.randint(1, 8) if damaged else 0):
        damaged[rng.randrange(len(damaged))] ^= 1 << rng.randrange(8)
    return bytes(damaged)


def cut(content, rng):
    """Something missing: the end, or a piece."""
    first, last = sorted(rng.choices(range(len(content) + 1), k=2))
    return content[:first] if rng.random() < 0.5 else content[:first] + content[last:]


def overwritten(content, rng):
    """Something odd put in."""
    at = rng.randint(0, len(content))
    return content[:at] + rng.choice(ODD) + content[at + rng.choice([0, 0, 1, 5]) :]


def swapped(content, rng):
    """Two lines exchanged."""
    lines = content.split(b"\n")
    a, b = rng.choices(range(len(lines)), k=2)
    lines[a], lines[b] = lines[b], lines[a]
    return b"\n".join(lines)


def replaced(content, rng):
    """A number, a name or a mark of punctuation, everywhere or once, for something odd."""
    words = content.replace(b",", b" ").replace(b":", b" ").split() or [b""]
    word = rng.choice(words)
    return content.replace(word, rng.choice(ODD), rng.choice([1, -1])) if word else content


def repeated(content, rng):
    """A line twice or a hundred times."""
    lines = content.split(b"\n")
    at = rng.randrange(len(lines))
    return b"\n".join([*lines[:at], *[lines[at]] * rng.choice([2, 100]), *lines[at + 1 :]])


def outcomes(kind, count, seed, folder):
    """How many damaged files were read and how many refused. Raises what is raised besides `LoiterError`."""
    originals, read = KINDS[kind]
    rng, path, counts = random.Random(seed), Path(folder) / "damaged", Counter()
    for _ in range(count):
        # A new file each time: some file systems flush one that is written over.
        path.unlink(missing_ok=True)
        path.write_bytes(mutated(rng.choice(originals), rng))
        sentence = refusal(read, path)
        counts["refused" if sentence else "read"] += 1
        assert "\n" not in sentence
        assert len(sentence) < len(str(path)) + 300
    return counts


def refusal(read, path):
    """What is said of a file; nothing where it is read."""
    try:
        read(path)
    except LoiterError as error:
        return str(error)
    return ""


if __name__ == "__main__":
    number = int(sys.argv[1]) if len(sys.argv) > 1 else 10_000
    with tempfile.TemporaryDirectory() as scratch:
        for name in KINDS:
            print(name, dict(outcomes(name, number, seed=1, folder=scratch)))
