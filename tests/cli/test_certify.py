"""`loiter plan --certify`: text, JSON, picture."""

import json
import shlex

import pytest

from loiter.certificate import accuracy as module
from loiter.cli.app import main

UNIT = "--orbit 0 0 1 --airspeed 1 --turn-radius 1"
EXAMPLE_1 = f"plan --pose 4 4 90 {UNIT} --certify"
EXAMPLE_2 = f"plan --pose -0.53 0.31 90 {UNIT} --certify"


@pytest.fixture
def ran(capsys):
    def run(arguments):
        status = main(shlex.split(arguments))
        captured = capsys.readouterr()
        return status, captured.out, captured.err

    return run


def test_the_certificate_follows_the_table(ran):
    status, out, err = ran(EXAMPLE_2)
    assert (status, err) == (0, "")
    table, _, certificate = out.partition("\n\n")
    assert "Peel off" in table
    assert certificate.startswith("Certificate of LRL, clockwise: valid.\n")
    assert "|phi| + psi1 = lambda (14)" in certificate


def test_without_the_flag_there_is_none(ran):
    assert "Certificate" not in ran(EXAMPLE_2.replace("--certify", ""))[1]
    assert "certificate" not in json.loads(ran(EXAMPLE_2.replace("--certify", "--json"))[1])


def test_all_shows_one_for_each(ran):
    out = ran(f"{EXAMPLE_1} --all")[1]
    assert [line for line in out.splitlines() if line.startswith("Certificate")] == [
        "Certificate of RSL, clockwise: valid.",
        "Certificate of RSR, counter-clockwise: valid.",
    ]


def test_json_has_the_key_and_keeps_the_rest(ran):
    with_it, without = (
        json.loads(ran(f"{line} --json")[1]) for line in (EXAMPLE_1, EXAMPLE_1.replace("--certify", ""))
    )
    certificate = with_it.pop("certificate")
    assert with_it == without
    assert certificate["valid"] is True
    assert certificate["lambda"] == 1.0
    assert {residual["name"] for residual in certificate["residuals"]} >= {
        "target",
        "adjoint",
        "hamiltonian",
        "fastest",
    }


@pytest.mark.parametrize("name", ["entry.png", "an entry.v2.svg", "entry.PDF"])
def test_the_picture_is_saved_beside_that_of_the_plan(ran, tmp_path, monkeypatch, name):
    monkeypatch.chdir(tmp_path)
    assert ran(f"{EXAMPLE_2} --plot '{name}'")[0] == 0
    stem, ending = name.rsplit(".", 1)
    assert {path.name for path in tmp_path.iterdir()} == {name, f"{stem}-certificate.{ending}"}
    assert all(path.stat().st_size > 1000 for path in tmp_path.iterdir())


def test_the_tolerance_of_the_plan_is_that_of_the_certificate(ran):
    beyond = "plan --pose -65.9 25 90 --orbit 0 0 50 --turn cw --airspeed 18 --turn-radius 50 --certify --tolerance 0.5"
    status, out, _ = ran(beyond)
    assert status == 0
    assert "Certificate of L, clockwise: valid." in out


def test_a_failed_condition_is_printed_and_sets_the_exit_status(ran, monkeypatch):
    monkeypatch.setattr(module, "ROUNDING", -1.0)  # a bound that no value meets
    status, out, _ = ran(EXAMPLE_2)
    assert status == 1
    assert "NOT VALID" in out
    assert "FAILED" in out


def test_the_tolerance_is_that_of_the_certificate_in_wind_too(ran):
    beside = "plan --pose 122 0 198 --orbit 0 0 120 --turn cw --airspeed 18 --bank 35 --wind 8 250 --certify --json"
    _, strict, _ = ran(beside)
    status, lenient, _ = ran(f"{beside} --tolerance 5")
    assert status == 0
    assert json.loads(strict)["miss_m"] < 1e-9
    assert 1.9 < json.loads(lenient)["miss_m"] <= 5.0
