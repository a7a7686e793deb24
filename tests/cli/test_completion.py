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
    "land",
    "batch",
    "fly",
    "upload",
    "watch",
    "guide",
    "synthesis",
    "figures",
    "verify",
    "prove",
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


@pytest.fixture
def script(capsys):
    def printed(shell):
        assert main(["completion", shell]) == 0
        return capsys.readouterr().out

    return printed


@pytest.fixture
def tab(script, tmp_path):
    """What bash offers for a line, in a folder that holds demo.png."""
    (tmp_path / "demo.png").touch()

    def press(line):
        words = line.split(" ")
        typed = " ".join(shlex.quote(word) for word in words)
        press_tab = PRESS_TAB.format(words=typed, last=len(words) - 1)
        done = subprocess.run(
            ["bash", "--norc"], input=script("bash") + press_tab, capture_output=True, text=True, cwd=tmp_path
        )
        assert (done.returncode, done.stderr) == (0, "")
        return sorted(done.stdout.split())

    return press


@pytest.mark.skipif(shutil.which("bash") is None, reason="needs bash")
@pytest.mark.parametrize(
    ("line", "offered"),
    [
        ("loiter ", COMMANDS),
        ("loiter pl", ["plan"]),
        ("loiter plan --tu", LIMITS),
        ("loiter plan --turn ", ["cw", "ccw", "either"]),
        ("loiter plan --turn c", ["cw", "ccw"]),
        ("loiter plan --pose -400 120 90 --orbit 0 0 80 --tu", LIMITS),
        ("loiter plan --pose -400 120 90 --turn e", ["either"]),
        ("loiter plan --plot de", ["demo.png"]),
        ("loiter plan --no-such", []),
        ("loiter verify --s", ["--states", "--seed"]),
        ("loiter completion ", ["bash", "zsh", "fish"]),
    ],
)
def test_bash_offers_what_can_follow(tab, line, offered):
    assert tab(line) == sorted(offered)


@pytest.mark.parametrize("shell", ["bash", "zsh", "fish"])
def test_each_script_names_commands_options_and_choices(script, shell):
    text = script(shell)
    assert [word for word in [*COMMANDS, "turn-radius", "plot", "either"] if word not in text] == []


@pytest.mark.parametrize("shell", [shell for shell in ("bash", "zsh", "fish") if shutil.which(shell)])
def test_each_script_is_read_by_its_shell(script, shell):
    subprocess.run([shell, "-n"], input=script(shell), text=True, check=True)


@pytest.mark.parametrize("arguments", [["tcsh"], []])
def test_another_shell_is_refused_in_one_sentence(capsys, arguments):
    assert main(["completion", *arguments]) == 2
    out, err = capsys.readouterr()
    assert out == ""
    [line] = err.splitlines()
    assert all(word in line for word in arguments)
