"""The tests that belong to a file of the package, run on a copy in which that file is a mutant."""

import os
import re
import resource
import shutil
import signal
import subprocess
import sys
from contextlib import suppress
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).parents[2]
LEFT_OUT = (".git", ".venv", "__pycache__", ".hypothesis", ".*_cache", "build", "dist", "results")

# A test alone takes up to 15 s and a stage up to 100 s on a processor that does nothing else.
TEST_LIMIT_S = 60
STAGE_LIMIT_S = 300

# A mutant may ask for memory or write to disk without end.
MEMORY = 12 * 2**30
LARGEST_FILE = 2**30

PYTEST = ["-m", "pytest", "-x", "-q", "--tb=line", "-p", "no:cacheprovider", "--hypothesis-profile=ci"]
PYTEST += ["-o", "faulthandler_exit_on_timeout=true"]

# A plugin that takes a second to load, for the tests of the service alone.
WITHOUT_SCHEMAS = ["-p", "no:schemathesis"]

# Plans and arrays run the C that is generated from the kernel: without it a mutant of the kernel would change nothing.
TRANSLATED = "kernel/"
TRANSLATION = (["-m", "codegen"], ["hatch_build.py"])
GENERATED = ("native", "compiled", "web/static/kernel")

# What pytest says of the test that failed, and of a file that could not be imported, which has no colons.
FAILED = re.compile(r"^(?:FAILED|ERROR) (.+?::.+?)(?: - |$)", re.MULTILINE)


def tests(folder: str, names: str) -> list[str]:
    """The files of tests of these names in a folder."""
    return [f"tests/{folder}/test_{name}.py" for name in names.split()]


HEAVY = [
    "tests/kernel/test_wind_search.py::test_next_to_a_tie_the_sooner_direction_is_found",
]
LIMITS = "tests/batch/test_resume.py::test_limits_of_this_process_are_as_they_were"
WIND = (
    [
        *tests("kernel", "wind_search cell_bounds slots slot_folds"),
        *tests("planning", "hold wind arrival slot"),
        *(f"--deselect={test}" for test in HEAVY),
    ],
    [*tests("verify", "certificate_in_wind"), *tests("evidence", "wind_scan"), *HEAVY],
)

# The tests of a file: those of the first name here that its path begins with, in stages, fast ones first.
STAGES = {
    "kernel/wind/": WIND,
    "kernel/": (
        tests("kernel", "words statuses angles motion exact switching_curves extremals synthesis worst"),
        [*tests("kernel", "adjoint"), *tests("planning", "solve")],
        [
            "tests/compiled",
            "tests/paper",
            *tests("arrays", "still_air partition"),
            *tests("verify", "certificate"),
            *tests("evidence", "precision"),
        ],
    ),
    "compiled/": (["tests/compiled"], tests("arrays", "still_air wind")),
    "arrays/": (["tests/arrays"], [*tests("batch", "frames wind"), "docs/batch.md"]),
    "planning/": (
        ["tests/planning"],
        [
            *tests("cli", "plan wind"),
            *tests("verify", "certificate certificate_in_wind"),
            *tests("guidance", "loiter_entry"),
            *tests("plot", "picture"),
            "docs/wind.md",
            "README.md",
        ],
    ),
    "fences/": (["tests/fences"], [*tests("cli", "fence"), "docs/fences.md"]),
    "geo/": (
        ["tests/geo", *tests("cli", "places")],
        ["tests/io", *tests("mavlink", "watch"), "docs/maps.md"],
    ),
    "verify/": (
        tests("verify", "certificate_in_wind certificate bounds"),
        [*tests("cli", "certify"), "docs/theory.md", "docs/wind.md"],
    ),
    "evidence/proof/": (tests("evidence", "proof signs rounding"),),
    "evidence/": (
        tests("evidence", "precision wind_scan oracle_check"),
        [*tests("cli", "verify"), *tests("evidence", "reachability collocation")],
    ),
    "batch/": (
        tests("batch", "frames light csv files wind"),
        # A mutant may not write large files, which that test would notice.
        [*tests("cli", "batch"), "docs/batch.md", *tests("batch", "memory resume cluster"), f"--deselect={LIMITS}"],
    ),
    "guidance/": (
        ["tests/guidance", *(f"--ignore={test}" for test in tests("guidance", "loiter_entry jsbsim_aircraft"))],
        [
            *tests("guidance", "loiter_entry jsbsim_aircraft"),
            *tests("cli", "fly"),
            "docs/guidance.md",
            "docs/jsbsim.md",
        ],
    ),
    "io/": (["tests/io"], [*tests("cli", "places"), "docs/maps.md", "docs/mavlink.md", "tests/mavlink"]),
    "mavlink/": (["tests/mavlink"], [*tests("cli", "mavlink"), "docs/mavlink.md"]),
    "plot/": (["tests/plot"], tests("cli", "figures plan wind")),
    "web/": (tests("web", "api_problems api"), [*tests("web", "limits serve schema"), "docs/service.md"]),
    "cli/": (["tests/cli"], ["README.md", "docs"]),
    "": ([*tests("planning", "solve model"), "tests/cli", *tests("batch", "files")], ["README.md"]),
}


class Outcome(NamedTuple):
    """What became of a mutant, and the test that noticed it."""

    verdict: str
    test: str = ""


class Copy:
    """A copy of the project to try mutants in; the compiled kernels stay with it."""

    def __init__(self, folder: Path) -> None:
        self.root, self.cache = folder / "project", folder / "cache"
        shutil.copytree(ROOT, self.root, ignore=shutil.ignore_patterns(*LEFT_OUT))
        self._sound: set[str] = set()

    def outcome(self, file: str, source: str) -> Outcome:
        """What the tests say of a file with another source; a kernel that cannot be translated is killed, too.

        Raises RuntimeError where the test that fails does so without the mutant too.
        """
        place = self.root / "src" / "loiter" / file
        kept = place.read_text("utf-8")
        place.write_text(source, "utf-8")
        try:
            outcome = self._translate() if file.startswith(TRANSLATED) else Outcome("survived")
            for stage in stages(file):
                if outcome.verdict != "survived":
                    break
                outcome = self._run(stage)
        finally:
            place.write_text(kept, "utf-8")
            if file.startswith(TRANSLATED):
                self._restore_translation()
        self._check(outcome.test)
        return outcome

    def _translate(self) -> Outcome:
        """Translate the kernel of the copy and build it."""
        for command in TRANSLATION:
            done = subprocess.run(
                [sys.executable, *command], cwd=self.root, env=self._environment(), capture_output=True
            )
            if done.returncode:
                return Outcome("killed")
        return Outcome("survived")

    def _restore_translation(self) -> None:
        for folder in GENERATED:
            package = Path("src", "loiter", folder)
            shutil.copytree(ROOT / package, self.root / package, dirs_exist_ok=True)

    def _check(self, test: str) -> None:
        """See that the test passes without the mutant, with all its parameters: a mutant may bring others."""
        test = test.partition("[")[0]
        if test and test not in self._sound:
            found = self._run([test])
            if found.verdict != "survived":
                raise RuntimeError(f"{test} fails without a mutant: {found.verdict}")
            self._sound.add(test)

    def _environment(self) -> dict[str, str]:
        paths = os.pathsep.join(str(self.root / folder) for folder in ("src", "tests", "."))
        return os.environ | {"PYTHONPATH": paths, "XDG_CACHE_HOME": str(self.cache), "PYTHONDONTWRITEBYTECODE": "1"}

    def _run(self, arguments: list[str]) -> Outcome:
        plugins = [] if any("tests/web" in one for one in arguments) else WITHOUT_SCHEMAS
        patience = max(1.0, os.getloadavg()[0] / len(os.sched_getaffinity(0)))
        limit = ["-o", f"faulthandler_timeout={TEST_LIMIT_S * patience:.0f}"]
        process = subprocess.Popen(
            [sys.executable, *PYTEST, *limit, *plugins, *arguments],
            cwd=self.root,
            env=self._environment(),
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            errors="replace",
            start_new_session=True,
        )
        limit_resources(process.pid)
        try:
            out, _ = process.communicate(timeout=STAGE_LIMIT_S * patience)
        except subprocess.TimeoutExpired:
            return Outcome("timed out")
        finally:
            with suppress(ProcessLookupError):
                os.killpg(process.pid, signal.SIGKILL)
            process.wait()
        if process.returncode == 0:
            return Outcome("survived")
        if "Timeout (" in out:
            return Outcome("timed out")
        found = FAILED.search(out)
        return Outcome("killed", found[1] if found else "")


def limit_resources(pid: int) -> None:
    """Limits of a process and of its later children; set from outside, since a process with threads may not fork."""
    resource.prlimit(pid, resource.RLIMIT_AS, (MEMORY, MEMORY))
    resource.prlimit(pid, resource.RLIMIT_FSIZE, (LARGEST_FILE, LARGEST_FILE))


def stages(file: str) -> list[list[str]]:
    """Arguments of pytest, stage by stage: first the file's own examples and tests, which need the fewest imports."""
    others = next(stage for start, stage in STAGES.items() if file.startswith(start))
    folder, stem = file.rpartition("/")[0], Path(file).stem
    examples, (own,) = f"src/loiter/{file}", tests(folder, stem)
    if (ROOT / own).exists():
        return [[examples, own], *others]
    return [[examples, *others[0]], *others[1:]]
