"""What the tests of the commands share."""

import json
import shlex

import pytest

from loiter.cli.app import main


@pytest.fixture
def shown(capsys, monkeypatch):
    """Runs `loiter` with arguments, which must succeed; gives what it prints."""
    monkeypatch.setenv("COLUMNS", "100")

    def run(arguments):
        status = main(shlex.split(arguments))
        out, err = capsys.readouterr()
        assert (status, err) == (0, "")
        return out

    return run


@pytest.fixture
def planned(shown):
    return lambda options: json.loads(shown(f"plan {options} --json"))
