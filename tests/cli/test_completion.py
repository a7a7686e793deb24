"""`loiter completion`: what a shell offers after the Tab key."""

import shlex
import shutil
import subprocess

import pytest

from loiter.cli.app import main

COMMANDS = [
    "plan",
    "leg",
    "fleet",
    "batch",
    "fly",
    "upload",
    "watch",
    "guide",
    "guide-fleet",
    "synthesis",
    "figures",
    "serve",
    "completion",
]
LIMITS = ["--turn", "--turn-radius", "--turn-rate"]

# What bash does for Tab: the function that `complete` registered, given the words so far.
PRESS_TAB = """
registered=($(complete -p loiter))
COMP_WORDS=({words}) COMP_CWORD={last}
"${{registered[2]}}" loiter
printf '%s\\n' "${{COMPREPLY[@]}}"
"""


# A line, and what may follow it in a folder that holds demo.png.
OFFERED = {
    "loiter ": COMMANDS,
    "loiter pl": ["plan"],
    "loiter plan --tu": LIMITS,
    "loiter plan --turn ": ["cw", "ccw", "either"],
    "loiter plan --turn c": ["cw", "ccw"],
    "loiter plan --pose -400 120 90 --orbit 0 0 80 --tu": LIMITS,
    "loiter plan --pose -400 120 90 --turn e": ["either"],
    "loiter plan --plot de": ["demo.png"],
    "loiter plan --no-such": [],
    "loiter completion ": ["bash", "zsh", "fish"],
}


def tab(line):
    """The lines of bash that press Tab after a line."""
    words = line.split(" ")
    return PRESS_TAB.format(words=" ".join(shlex.quote(word) for word in words), last=len(words) - 1)


@pytest.mark.parametrize("shell", ["bash", "zsh", "fish"])
def test_each_script_names_what_can_follow_and_is_read_by_its_shell(shell, capsys, tmp_path):
    assert main(["completion", shell]) == 0
    script = capsys.readouterr().out
    assert [word for word in [*COMMANDS, "turn-radius", "plot", "either"] if word not in script] == []
    if shutil.which(shell):
        subprocess.run([shell, "-n"], input=script, text=True, check=True)
    if shell == "bash" and shutil.which("bash"):
        (tmp_path / "demo.png").touch()
        pressed = script + "echo ';;'\n".join(map(tab, OFFERED))
        done = subprocess.run(["bash", "--norc"], input=pressed, capture_output=True, text=True, cwd=tmp_path)
        assert (done.returncode, done.stderr) == (0, "")
        found = [sorted(words.split()) for words in done.stdout.split(";;")]
        assert dict(zip(OFFERED, found, strict=True)) == {line: sorted(words) for line, words in OFFERED.items()}


@pytest.mark.parametrize("arguments", [["tcsh"], []])
def test_another_shell_is_refused_in_one_sentence(refusal, arguments):
    line = refusal(["completion", *arguments])
    assert all(word in line for word in arguments)
