"""What help ends with: examples of the command that was asked about, which the program understands."""

import shlex

import pytest

from cli.test_completion import COMMANDS
from loiter.cli.app import app, main
from loiter.cli.command import commands as listed


@pytest.fixture
def examples(capsys, monkeypatch):
    """The example commands that the help of a command shows."""
    monkeypatch.setenv("COLUMNS", "100")

    def shown(*command):
        assert main([*command, "--help"]) == 0
        _, _, end = capsys.readouterr().out.partition("\nExamples\n")
        text, _, statuses = end.partition("\n\nExit status\n")
        assert statuses.split()[:2] == ["0", "done"]
        return [" ".join(example.split()) for example in text.replace("\\\n", " ").splitlines()]

    return shown


def understood(example):
    """The command that an example runs, with its arguments bound."""
    program, *words = shlex.split(example.removeprefix('eval "$(').removesuffix(')"').partition(" > ")[0])
    assert program == "loiter"
    command, _, _ = app.parse_args(words, exit_on_error=False, print_error=False)
    return command.__name__.replace("_", "-")


@pytest.mark.parametrize("command", COMMANDS)
def test_each_command_has_examples_of_its_own(examples, command):
    shown = examples(command)
    assert shown
    assert [understood(example) for example in shown] == [command] * len(shown)


@pytest.mark.parametrize(
    ("command", "statuses"),
    [
        ((), ["0", "1", "2", "3", "130"]),
        (("plan",), ["0", "1", "2"]),
        (("guide",), ["0", "2", "3", "130"]),
    ],
)
def test_help_shows_the_exit_statuses_of_its_command(capsys, command, statuses):
    assert main([*command, "--help"]) == 0
    _, _, end = capsys.readouterr().out.partition("\nExit status\n")
    assert [line.split()[0] for line in end.splitlines() if line[2:3].isdigit()] == statuses


def test_upload_takes_a_file(capsys):
    assert main(["upload", "--help"]) == 0
    assert capsys.readouterr().out.startswith("Usage: loiter upload --connect LINK [OPTIONS] [FILE]")


def test_every_command_is_among_them():
    assert sorted(command.name for command in listed()) == sorted(COMMANDS)


def test_the_program_shows_how_to_begin(examples):
    assert {understood(example) for example in examples()} == {"plan", "completion"}


@pytest.mark.parametrize("command", COMMANDS)
def test_flags_have_no_default(command, capsys):
    assert main([command, "--help"]) == 0
    assert "False" not in capsys.readouterr().out


def test_defaults_are_written_as_on_the_command_line(capsys, monkeypatch):
    monkeypatch.setenv("COLUMNS", "200")
    assert main(["plan", "--help"]) == 0
    out = capsys.readouterr().out
    assert "[default: 0 0]" in out
    assert "[default: msl]" in " ".join(out.replace("│", " ").split())


@pytest.mark.parametrize(
    ("command", "others"),
    [("batch", ["vehicle", "guid"]), ("upload", ["guid"]), ("watch", ["guid"]), ("guide", ["batch"])],
)
def test_the_exit_statuses_of_a_command_do_not_mention_other_commands(capsys, command, others):
    main([command, "--help"])
    _, _, statuses = capsys.readouterr().out.partition("\nExit status\n")
    assert statuses
    assert not [word for word in others if word in statuses]
