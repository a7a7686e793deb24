"""What make needs of the machine: a Python new enough, and apt's locks, for which it waits."""

import os
import shutil
import subprocess
import sys
import time
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]

debian = pytest.mark.skipif(shutil.which("apt-get") is None, reason="needs apt-get")

# Holds a lock as apt does (fcntl), for some seconds.
HOLD = """
import fcntl, sys, time
with open(sys.argv[1], "w") as file:
    fcntl.lockf(file, fcntl.LOCK_EX)
    print(flush=True)
    time.sleep(float(sys.argv[2]))
"""

# As an interpreter of another version, as far as a recipe can tell.
OTHER_PYTHON = """#!/bin/sh
case "$1" in
  --version) echo "Python {version}" ;;
  -c) exec "{python}" -c "import sys; sys.version_info = ({tuple}); exec(sys.argv[1])" "$2" ;;
  *) echo "made by $1 $2 $3" ;;
esac
"""


@pytest.fixture
def make(tmp_path):
    """Runs make in a folder that has the Makefile and nothing else, as if no make had started these tests."""
    shutil.copy(ROOT / "Makefile", tmp_path)
    own = {name: value for name, value in os.environ.items() if name not in ("MAKEFLAGS", "MAKELEVEL", "MFLAGS")}

    def run(*arguments):
        return subprocess.run(["make", *arguments], cwd=tmp_path, env=own, capture_output=True, text=True, timeout=60)

    return run


def python_of(folder, version):
    path = folder / "other-python"
    path.write_text(OTHER_PYTHON.format(version=version, tuple=version.replace(".", ", "), python=sys.executable))
    path.chmod(0o755)
    return path


@pytest.mark.parametrize("version", ["3.9.2", "3.10.14", "2.7.18"])
def test_an_old_python_is_refused_in_a_sentence(make, tmp_path, version):
    other = python_of(tmp_path, version)
    done = make(".venv/bin/python", f"PYTHON={other}")
    sentence = f"Python 3.11 or newer is needed, and {other} is Python {version}: make PYTHON=FILE uses another"
    assert done.returncode == 2
    assert done.stderr.splitlines()[0] == sentence
    assert not (tmp_path / ".venv").exists()


def test_a_missing_python_is_told(make):
    done = make(".venv/bin/python", "PYTHON=no-such-python")
    assert done.stderr.splitlines()[0].startswith("Python 3.11 or newer is needed, and no-such-python is missing: ")


@pytest.mark.parametrize("version", ["3.11.0", "3.14.1"])
def test_a_new_python_will_do(make, tmp_path, version):
    done = make(".venv/bin/python", f"PYTHON={python_of(tmp_path, version)}")
    assert (done.returncode, done.stdout.splitlines()[-1]) == (0, "made by -m venv .venv")


def test_packages_are_installed_by_the_script_that_waits(make):
    assert (
        make("--dry-run", "--always-make", "/usr/bin/chromium-headless-shell").stdout
        == "requirements/apt-install chromium-headless-shell\n"
    )


def test_a_missing_compiler_is_installed_by_the_same_script(make):
    commands = make("--dry-run", "--always-make", ".venv/compiler.stamp").stdout
    assert "command -v cc >/dev/null || requirements/apt-install gcc libc6-dev\n" in commands
    assert "|| requirements/apt-install python3-dev\n" in commands


@pytest.fixture
def apt(tmp_path, monkeypatch):
    """Runs the script with an apt of its own: empty lists, and a package called `there` that is installed."""
    status = (
        "Package: there\nStatus: install ok installed\nMaintainer: x <x@localhost>\nArchitecture: all\nVersion: 1\n"
    )
    for folder in ("lists/partial", "cache/archives/partial", "dpkg", "bin", "etc"):
        (tmp_path / folder).mkdir(parents=True)
    (tmp_path / "dpkg/status").write_text(f"{status}Description: none\n\n")
    places = {
        "Dir::State": tmp_path,
        "Dir::State::Lists": tmp_path / "lists",
        "Dir::State::status": tmp_path / "dpkg/status",
        "Dir::Cache": tmp_path / "cache",
        "Dir::Etc::sourcelist": "/dev/null",
        "Dir::Etc::sourceparts": tmp_path / "etc",
        "Dir::Log": tmp_path,
    }
    (tmp_path / "apt.conf").write_text("".join(f'{name} "{place}";\n' for name, place in places.items()))
    monkeypatch.setenv("APT_CONFIG", str(tmp_path / "apt.conf"))
    # Who is not root needs no other's rights here.
    (tmp_path / "bin/sudo").write_text('#!/bin/sh\nexec "$@"\n')
    (tmp_path / "bin/sudo").chmod(0o755)
    monkeypatch.setenv("PATH", f"{tmp_path / 'bin'}:{os.environ['PATH']}")

    def run(package="there", wait_s=20):
        began = time.monotonic()
        done = subprocess.run(
            [ROOT / "requirements/apt-install", package],
            capture_output=True,
            text=True,
            timeout=60,
            env=os.environ | {"APT_WAIT_S": str(wait_s)},
        )
        return done, time.monotonic() - began

    return run


@pytest.fixture
def held():
    """Holds a file's lock for some seconds."""
    holders = []

    def hold(path, seconds):
        holder = subprocess.Popen([sys.executable, "-c", HOLD, path, str(seconds)], stdout=subprocess.PIPE)
        holders.append(holder)
        assert holder.stdout.readline() == b"\n"

    yield hold
    for holder in holders:
        holder.kill()
        holder.communicate()


LOCKS = ["lists/lock", "dpkg/lock-frontend", "dpkg/lock"]


@debian
def test_nothing_is_said_of_locks_that_are_free(apt):
    done, _ = apt()
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout.startswith("installing there with apt-get\n")
    assert "there is already the newest version" in done.stdout
    assert "waiting" not in done.stdout


@debian
@pytest.mark.parametrize("lock", LOCKS)
def test_it_waits_for_a_lock(apt, held, tmp_path, lock):
    held(tmp_path / lock, 4.0)
    done, seconds = apt()
    assert (done.returncode, done.stderr) == (0, "")
    assert seconds > 2.0
    assert done.stdout.count("waiting for the process that holds apt's lock, 20 s at most") == 1
    assert "there is already the newest version" in done.stdout


@debian
@pytest.mark.parametrize("lock", LOCKS)
def test_it_gives_up_in_a_sentence(apt, held, tmp_path, lock):
    held(tmp_path / lock, 30.0)
    done, seconds = apt(wait_s=2)
    assert (done.returncode, seconds < 20.0) == (1, True)
    assert done.stderr == "another process has held apt's lock for 2 s: run this again when it has ended\n"


@debian
def test_what_else_is_wrong_is_told_at_once(apt):
    done, _ = apt("no-such-package")
    assert (done.returncode, "waiting" in done.stdout) == (1, False)
    assert "Unable to locate package no-such-package" in done.stderr
