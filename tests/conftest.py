"""What the tests of commands share."""

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
def refusal(capsys):
    """Runs `loiter` with arguments, a text or a list, which must be refused; gives its one sentence."""

    def run(arguments):
        status = main(shlex.split(arguments) if isinstance(arguments, str) else arguments)
        out, err = capsys.readouterr()
        assert (status, out, err.count("\n")) == (2, "", 1), err
        return err.removesuffix("\n")

    return run


@pytest.fixture
def planned(shown):
    return lambda options: json.loads(shown(f"plan {options} --json"))


@pytest.fixture
def quick(monkeypatch):
    """Vehicles are waited for a tenth as long as real ones."""
    from flight.vehicle import shorten_waits

    shorten_waits(monkeypatch)
