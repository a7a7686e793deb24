"""Real autopilots in simulation, where the user has one: started by a command, on the ground, spoken to, ended.

LOITER_ARDUPLANE is a command that starts ArduPlane's simulator, which listens on TCP port 5760 of loopback, for
instance `arduplane --model plane --home 47,8,584,0 --defaults plane.parm` with whole paths; LOITER_PX4 one that starts
PX4's with a plane, whose port for ground stations is UDP 18570. LOITER_ARDUPLANE_LINK and LOITER_PX4_LINK are
connections in place of these.
"""

import os
import shlex
import subprocess
import time
from contextlib import closing, contextmanager

import pytest

from loiter import Aircraft, Orbit, plan
from loiter.errors import LinkFailed
from loiter.files import mission
from loiter.flight import download, upload, watch
from loiter.geo import LocalFrame

COMMANDS = {name: os.environ.get(f"LOITER_{name}") for name in ("ARDUPLANE", "PX4")}
LINKS = {
    name: os.environ.get(f"LOITER_{name}_LINK", usual)
    for name, usual in (("ARDUPLANE", "tcp:127.0.0.1:5760"), ("PX4", "udpout:127.0.0.1:18570"))
}

# Seconds for a simulator to start, and to be ended.
STARTS_S, ENDS_S = 60.0, 10.0


def real(name):
    """A parameter that is skipped where there is no such simulator."""
    reason = f"LOITER_{name} is not set: a command that starts a simulator"
    return pytest.param(name, marks=pytest.mark.skipif(not COMMANDS[name], reason=reason))


@contextmanager
def started(name, folder):
    """A simulator while it runs: its connection. Its standard input stays open, as ArduPlane's needs it to."""
    pipe, own = subprocess.PIPE, folder / "own"
    own.mkdir()
    with (folder / "output").open("w") as log:
        process = subprocess.Popen(shlex.split(COMMANDS[name]), cwd=own, stdin=pipe, stdout=log, stderr=log)
    try:
        answered(LINKS[name])
        yield LINKS[name]
    finally:
        process.terminate()
        try:
            process.wait(ENDS_S)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()
        process.stdin.close()


def answered(connection):
    """Wait until a simulator gives its mission."""
    end = time.monotonic() + STARTS_S
    while True:
        try:
            return download(connection, timeout_s=5.0)
        except LinkFailed:
            if time.monotonic() > end:
                raise
            time.sleep(1.0)


@pytest.mark.parametrize("name", [real("ARDUPLANE"), real("PX4")])
def test_a_real_autopilot_keeps_the_mission_and_is_not_flying(name, tmp_path, real_time):
    frame = LocalFrame(47.0, 8.0)
    entry = plan(frame.pose(47.004, 7.996, 100.0), Orbit(0.0, 0.0, 80.0), Aircraft(18.0, max_bank_deg=35.0))
    with started(name, tmp_path) as connection:
        for along_path in (True, False):
            new = mission(entry, frame, 700.0, along_path=along_path)
            summary = upload(new, connection)
            assert (summary.items, summary.cut) == (len(new.items), ())
            back = download(connection).items
            assert [(item.command, item.params) for item in back] == [(item.command, item.params) for item in new.items]
        with pytest.raises(LinkFailed, match=r"is not in the air: the mission is not started; it has the mission"):
            upload(new, connection, start=True)
        with closing(watch(connection, Orbit(0.0, 0.0, 80.0), frame, Aircraft(18.0, max_bank_deg=35.0))) as reports:
            end = time.monotonic() + STARTS_S
            while not (report := next(reports)).problem.startswith("not flying"):
                assert time.monotonic() < end, report
