"""Bad requests: one sentence on standard error, exit status 2, nothing on standard output, no file."""

import subprocess
import sys
from pathlib import Path

import pytest

from loiter.cli.app import main
from loiter.cli.commands import plan as planning

SCRIPT = Path(sys.executable).with_name("loiter")
GOOD = {"--pose": "-400 120 90", "--orbit": "0 0 80", "--airspeed": "18", "--bank": "35"}


def plan(**changes):
    """The arguments of a good plan with some options changed, added, or, where None, left out."""
    options = GOOD | {"--" + name.replace("_", "-"): value for name, value in changes.items()}
    return ["plan", *(word for name, value in options.items() if value is not None for word in (name, *value.split()))]


NOT_POSITIVE = ["nan", "inf", "-inf", "0", "-0.0", "-5"]

BAD_VALUES = [
    *((plan(airspeed=value), ["--airspeed", str(float(value))]) for value in NOT_POSITIVE),
    *((plan(bank=value), ["--bank", str(float(value))]) for value in [*NOT_POSITIVE, "90", "120"]),
    *((plan(bank=None, turn_radius=value), ["--turn-radius", str(float(value))]) for value in NOT_POSITIVE),
    *((plan(bank=None, turn_rate=value), ["--turn-rate", str(float(value))]) for value in NOT_POSITIVE),
    *((plan(orbit=f"0 0 {value}"), ["--orbit", "RADIUS", str(float(value))]) for value in NOT_POSITIVE),
    *((plan(tolerance=value), ["--tolerance", str(float(value))]) for value in ["nan", "inf", "-1"]),
    *(
        (plan(pose=None, pose_lla="47 8 90", orbit=None, orbit_lla=f"47 8 {r}"), ["--orbit-lla RADIUS", str(float(r))])
        for r in NOT_POSITIVE
    ),
    (plan(pose="nan 120 90"), ["--pose", "EAST", "nan"]),
    (plan(pose="-400 inf 90"), ["--pose", "NORTH", "inf"]),
    (plan(pose="-400 120 -inf"), ["--pose", "HEADING", "-inf"]),
    (plan(orbit="nan 0 80"), ["--orbit", "EAST", "nan"]),
    (plan(orbit="0 -inf 80"), ["--orbit", "NORTH", "-inf"]),
    *((plan(wind=f"{value} 250"), ["--wind", "SPEED", str(float(value))]) for value in ["nan", "inf", "-inf", "-5"]),
    *((plan(wind=f"5 {value}"), ["--wind", "FROM", str(float(value))]) for value in ["nan", "inf"]),
    (plan(orbit_velocity="nan 0"), ["--orbit-velocity", "EAST", "nan"]),
    (plan(orbit_velocity="0 -inf"), ["--orbit-velocity", "NORTH", "-inf"]),
    (plan(turn="left"), ["--turn", "left", "either", "cw", "ccw"]),
    (plan(plot="entry.gif"), ["--plot", "entry.gif", ".png", ".svg", ".pdf"]),
    (plan(plot="entry"), ["--plot", "entry"]),
    (plan(plot="max_bank_deg.gif"), ["--plot", "max_bank_deg.gif"]),
]
NOT_NUMBERS = [
    (plan(airspeed="fast"), ["--airspeed", "fast"]),
    (plan(bank="35grad"), ["--bank", "35grad"]),
    (plan(pose="here 120 90"), ["--pose", "here"]),
    (plan(orbit="0 0 wide"), ["--orbit", "wide"]),
    (plan(wind="8 west"), ["--wind", "west"]),
    (plan(tolerance="some"), ["--tolerance", "some"]),
]
BAD_SHAPES = [
    (plan(pose=None), ["--pose"]),
    (plan(orbit=None), ["--orbit"]),
    (plan(airspeed=None), ["--airspeed"]),
    (["plan"], ["--pose"]),
    (plan(pose="-400 120"), ["--pose", "3", "2"]),
    (plan(pose="-400 120 90 7"), ["7"]),
    (plan(orbit="0 0"), ["--orbit", "3", "2"]),
    (plan(wind="8"), ["--wind", "2", "SPEED FROM"]),
    (plan(orbit_velocity="8"), ["--orbit-velocity", "2", "EAST NORTH"]),
    (plan(plot=""), ["--plot"]),
    (plan(bank=None), ["--bank", "--turn-radius", "--turn-rate", "none"]),
    (plan(turn_radius="50"), ["--bank and --turn-radius"]),
    (plan(turn_rate="20", turn_radius="50"), ["--bank and --turn-radius and --turn-rate"]),
    ([*plan(), "--airspeed", "19"], ["--airspeed is given twice"]),
    (["fly", "--law", "l1", "--law", "optimal"], ["--law is given twice: it takes one law, and --compare flies all"]),
    ([*plan(), "--wind", "1"], ["--wind needs 2 numbers, SPEED FROM, or one like 250/15kn: 1 was given"]),
    ([*plan(), "--json", "--json"], ["--json is given twice"]),
    (plan(speed="18"), ["--speed"]),
    ([*plan(), "--quiet"], ["--quiet"]),
    ([*plan(), "extra"], ["extra"]),
    (["hover"], ["hover", "plan", "guide"]),
    (["plna"], ["plna", "plan"]),
    (["--nope"], ["--nope"]),
]
IMPOSSIBLE = [
    (plan(orbit="0 0 40"), ["orbit radius 40 m", "47.18 m at 18 m/s", "needs 39.56 deg"]),
    (plan(orbit="0 0 40", bank=None, turn_radius="50"), ["orbit radius 40 m", "50 m", "needs 39.56 deg of bank"]),
    (plan(orbit="0 0 40", bank=None, turn_rate="20"), ["orbit radius 40 m", "25.78 deg/s", "39.56 deg of bank"]),
    (plan(wind="8 250"), ["orbit radius 80 m", "a wind of 8 m/s at 18 m/s", "98.45 m", "40.75 deg"]),
    (plan(orbit_velocity="3 4", orbit="0 0 60"), ["air that passes the circle at 5 m/s", "77.04 m", "41.96 deg"]),
    (plan(wind="8 250", airspeed="40kn"), ["a wind of 8 m/s at 20.58 m/s and"]),
    (plan(wind="45kn 250", airspeed="40kn"), ["an aircraft of 20.58 m/s can hold no circle"]),
    (plan(wind="20 250"), ["wind of 20 m/s", "18 m/s", "airspeed must be above 20 m/s"]),
    (plan(wind="2 250", pose="1e30 0 0"), ["too large", "1e+30 m"]),
    (plan(pose="1e30 0 0"), ["too large", "1e+30 m"]),
    (plan(orbit="0 0 1e30"), ["too large", "1e+30 m"]),
    (plan(pose="1e308 0 0", orbit="-1e308 0 80"), ["too large"]),
    (plan(airspeed="1e200"), ["airspeed"]),
    (plan(airspeed="1e-308", bank=None, turn_radius="50"), ["airspeed", "1e-308"]),
]
UNWRITABLE = [
    (plan(plot="missing/entry.png"), ["--plot", "missing/entry.png", "No such file or directory"]),
    (plan(plot="folder.png"), ["--plot", "folder.png", "Is a directory"]),
    ([*plan(plot="folder.png"), "--json"], ["--plot", "folder.png", "Is a directory"]),
    (plan(plot="tolerance_m/entry.png"), ["--plot", "tolerance_m/entry.png"]),
]
ALL = [*BAD_VALUES, *NOT_NUMBERS, *BAD_SHAPES, *IMPOSSIBLE, *UNWRITABLE]


@pytest.fixture
def refused(capsys, tmp_path, monkeypatch):
    """Runs a request that must be refused, in a folder that must not change; returns the sentence."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "folder.png").mkdir()

    def run(arguments):
        status = main(arguments)
        out, err = capsys.readouterr()
        assert (status, out) == (2, "")
        assert [path.name for path in tmp_path.rglob("*")] == ["folder.png"]
        assert err.endswith("\n")
        [line] = err.splitlines()
        return line

    return run


def short(arguments):
    """The arguments without the good options, as a test id."""
    text = " ".join(arguments) + " "
    for name, value in GOOD.items():
        text = text.replace(f"{name} {value} ", "")
    return text.strip()


@pytest.mark.parametrize(("arguments", "named"), ALL, ids=[short(arguments) for arguments, _ in ALL])
def test_a_bad_request_is_refused_in_one_sentence_that_names_it(refused, arguments, named):
    sentence = refused(arguments)
    assert sentence.startswith("loiter: ")
    assert [word for word in named if word not in sentence] == [], sentence
    # Names of the command line, not of the library and of the parser.
    jargon = ["positional", "Token", "into float", "into int", "airspeed_m_s", "orbit radius_m", "Error"]
    assert [word for word in jargon if word in sentence and word not in named] == [], sentence


@pytest.mark.parametrize(
    "arguments", [plain for plain, _ in [*BAD_VALUES, *IMPOSSIBLE] if plain[0] == "plan"], ids=short
)
def test_a_refused_plan_leaves_no_picture(refused, arguments):
    extra = [] if "--plot" in arguments else ["--plot", "entry.png"]
    refused([*arguments, *extra, "--json"])


def test_the_installed_program_exits_with_2(tmp_path):
    done = subprocess.run([SCRIPT, *plan(airspeed="nan")], capture_output=True, text=True, cwd=tmp_path)
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr == "loiter: --airspeed is nan: it must be a positive, finite number of metres per second\n"


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="a device of Linux")
@pytest.mark.parametrize("output", [[], ["--json"]])
def test_a_full_disk_gets_one_sentence(output):
    with Path("/dev/full").open("w") as full:
        done = subprocess.run([SCRIPT, *plan(), *output], stdout=full, stderr=subprocess.PIPE, text=True)
    assert done.returncode == 2
    [line] = done.stderr.splitlines()
    assert "No space left on device" in line


@pytest.mark.parametrize("module", ["cyclopts", "loiter.cli.sentences", "loiter.cli.commands.plan"])
def test_an_interrupt_during_the_imports_ends_quietly(module):
    code = f"""
import os, signal, sys
class Interrupted:
    def find_spec(self, name, path=None, target=None):
        if name == {module!r}:
            os.kill(os.getpid(), signal.SIGINT)
sys.meta_path.insert(0, Interrupted())
signal.signal(signal.SIGINT, signal.default_int_handler)
from loiter.__main__ import main
sys.exit(main())
"""
    scene = ["--pose", "-400", "120", "90", "--orbit", "0", "0", "80", "--airspeed", "18", "--bank", "35"]
    done = subprocess.run([sys.executable, "-c", code, "plan", *scene], capture_output=True, text=True)
    assert (done.returncode, done.stdout, done.stderr) == (130, "", "")


def test_an_interrupt_ends_quietly(capsys, monkeypatch):
    def interrupted(*_, **__):
        raise KeyboardInterrupt

    monkeypatch.setattr(planning, "best_and_others", interrupted)
    assert main(plan()) == 130
    assert capsys.readouterr() == ("", "")
