"""Runs the examples of Markdown files where only `loiter` is installed: `python tests/documents/examples.py README.md`.

The tests run them too, with Sybil; this script needs the standard library alone, for wheels in a bare Python.
"""

import doctest
import os
import re
import shlex
import subprocess
import sys
import tempfile
from pathlib import Path

BLOCK = re.compile(r"^```(python|console)\n(.*?)^```", re.MULTILINE | re.DOTALL)
ENVIRONMENT = {"COLUMNS": "100", "PYTHONUTF8": "1"}


def failed_commands(block):
    """The commands of a `console` block that fail or print something else than what follows them."""
    for example in block.removeprefix("$ ").split("\n$ "):
        command, _, expected = example.replace("\\\n", "").partition("\n")
        _, *arguments = shlex.split(command)
        done = subprocess.run(
            [sys.executable, "-c", "from loiter.cli.app import main; raise SystemExit(main())", *arguments],
            capture_output=True,
            encoding="utf-8",
            env=os.environ | ENVIRONMENT,
        )
        if (done.returncode, done.stdout.rstrip()) != (0, expected.rstrip()):
            yield f"{command}\nprinted (status {done.returncode}):\n{done.stdout}{done.stderr}"


def failures(path):
    """The number of examples of a file, and those that fail."""
    blocks = BLOCK.findall(path.read_text(encoding="utf-8"))
    failed = [text for kind, block in blocks if kind == "console" for text in failed_commands(block)]
    session = "".join(f"{block}\n" for kind, block in blocks if kind == "python")
    test = doctest.DocTestParser().get_doctest(session, {}, path.name, str(path), 0)
    report = []
    doctest.DocTestRunner(verbose=False).run(test, out=report.append)
    return len(test.examples) + sum(kind == "console" for kind, _ in blocks), failed + report


def main(names):
    paths = [Path(name).resolve() for name in names]
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        found = [failures(path) for path in paths]
        os.chdir(paths[0].parent)
    for _, failed in found:
        print("".join(failed), end="")
    print(f"{sum(number for number, _ in found)} examples, {sum(len(failed) for _, failed in found)} failed")
    return 1 if any(failed for _, failed in found) else 0


if __name__ == "__main__":
    raise SystemExit(main(sys.argv[1:]))
