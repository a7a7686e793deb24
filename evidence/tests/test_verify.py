"""`make verify`: the comparison with independent methods, as a command."""

import json
import re

import pytest

import loiter
from evidence.__main__ import program
from evidence.checks import oracle_check, rolling_check, wind_scan_check
from evidence.checks.oracle_check import PLACES
from evidence.checks.rolling import BankProfile, RollingPath
from loiter import Orbit, Pose
from loiter.cli.app import main


@pytest.fixture
def refusal(capsys):
    """Runs the program with arguments that must be refused; gives its one sentence."""

    def run(arguments):
        assert main(arguments, program) == 2
        return capsys.readouterr().err.removesuffix("\n")

    return run


EIGHT = ["verify", "--witness", "search", "--states", "8", "--seed", "1"]


def rows(text):
    """The table without its headings: place, then the cells."""
    lines = [re.split(r"\s{2,}", line.strip()) for line in text.splitlines()]
    return {line[0]: line[1:] for line in lines if line[0] in {*PLACES, "all"}}


def slowest(pose, orbit, aircraft):
    return loiter.candidates(pose, orbit, aircraft)[-1]


def test_plans_stand_the_comparison(capsys):
    assert main(EIGHT, program) == 0
    out, err = capsys.readouterr()
    table = rows(out)
    assert set(table) == {*PLACES, "all"}
    assert [cells[0] for cells in table.values()] == ["2", "2", "2", "2", "8"]
    assert {cells[-1] for cells in table.values()} == {"0"}
    assert "search" in err


def test_the_same_seed_prints_the_same_table(capsys):
    first, second = (main(EIGHT, program) or capsys.readouterr().out for _ in range(2))
    assert first == second


def test_the_seed_chooses_the_scenes(monkeypatch):
    drawn = []
    monkeypatch.setattr(oracle_check, "plan", lambda *scene: drawn.append(scene) or loiter.plan(*scene))
    main(EIGHT, program)
    first = {pose for pose, *_ in drawn}
    drawn.clear()
    main([*EIGHT[:-1], "2"], program)
    assert len(drawn) >= 8
    assert not first & {pose for pose, *_ in drawn}


def test_a_slow_plan_fails_the_check(capsys, monkeypatch):
    monkeypatch.setattr(oracle_check, "plan", slowest)
    assert main(EIGHT, program) == 1
    _, later, _, beyond = rows(capsys.readouterr().out)["all"]
    assert float(later) > 1e-3
    assert int(beyond) > 0


@pytest.mark.parametrize("states", ["0", "-1"])
def test_no_states_is_a_bad_request(refusal, states):
    assert refusal(["verify", "--states", states]) == f"loiter: --states is {states}: it must be at least 1"


def test_the_digits_are_compared_alone(capsys):
    assert main(["verify", "--witness", "digits", "--states", "16"], program) == 0
    out = capsys.readouterr().out
    assert out.startswith("digits: agrees\n")
    assert "share of allowed" in out
    assert "switching curve" in out


def test_an_unknown_method_is_refused(refusal):
    assert "--witness" in refusal(["verify", "--witness", "oracle"])


def rolling_bounds(monkeypatch, later_s):
    """The command gets bounds of one case at each rate, which are this much later than the plan."""
    scene = Pose(-400.0, 120.0, 90.0), Orbit(0.0, 0.0, 120.0), rolling_check.AIRCRAFT

    def bounds(cases, seed):
        assert (cases, seed) == (1, 3)
        for rate in rolling_check.RATES_DEG_S:
            problem = oracle_check.CheckProblem(f"{rate:g} deg/s", *scene)
            yield rolling_check.RollingBound(
                problem=problem,
                rate_deg_s=rate,
                planned_s=20.0,
                at_least_s=20.0,
                reached_s=20.0 + later_s,
                missed=0.0,
                path=RollingPath(8.0, BankProfile((), ())),
            )

    monkeypatch.setattr(rolling_check, "compare_with_rolling", bounds)


def test_what_a_rolling_aircraft_can_reach_is_a_row_for_each_roll_rate(capsys, monkeypatch):
    rolling_bounds(monkeypatch, 0.5)
    assert main(["verify", "--witness", "rolling", "--cases", "1", "--seed", "3"], program) == 0
    first, *rows = [line for line in capsys.readouterr().out.splitlines() if line]
    assert first == "rolling: agrees"
    assert [row.split()[:3] for row in rows[1:5]] == [[rate, "deg/s", "1"] for rate in ("45", "60", "90", "150")]


def test_a_path_that_is_sooner_than_the_plan_is_reported(capsys, monkeypatch):
    rolling_bounds(monkeypatch, -0.01)
    assert main(["verify", "--witness", "rolling", "--cases", "1", "--seed", "3"], program) == 1
    assert capsys.readouterr().out.startswith("rolling: DISAGREES")


def test_the_search_in_wind_runs_when_it_is_named(capsys):
    assert main(["verify", "--witness", "wind", "--states", "6", "--seed", "2"], program) == 0
    first, *rows = [line for line in capsys.readouterr().out.splitlines() if line]
    assert first == "wind: agrees"
    assert [row.split()[:2] for row in rows[1:5]] == [["inside", "2"], ["near", "2"], ["far", "2"], ["all", "6"]]
    assert [row.split()[4] for row in rows[1:5]] == ["0"] * 4


def test_a_plan_in_wind_that_is_late_is_reported(capsys, monkeypatch):
    late = wind_scan_check.ScanDifference(next(wind_scan_check.random_problems(1, 0)), 1.0, 1e-3, 0.0, 0.0)
    monkeypatch.setattr(wind_scan_check, "compare_with_scan", lambda states, seed: iter([late] * states))
    assert main(["verify", "--witness", "wind"], program) == 1
    out = capsys.readouterr().out
    assert out.startswith("wind: DISAGREES")
    assert re.search(r"^inside +20 +1\.0e-03 +0\.0e\+00 +20 ", out, re.MULTILINE)


def test_the_results_as_json(capsys):
    assert main(["verify", "--witness", "digits", "--states", "8", "--json"], program) == 0
    document = json.loads(capsys.readouterr().out)
    [method] = document["methods"]
    assert (document["agrees"], method["method"], method["agrees"]) == (True, "digits", True)
    assert method["rows"][-1]["next_to"] == "all"
    assert method["rows"][-1]["states"] == 8
    # Some circles are as wide as 1e6 turn radii, on which 1e-13 R/30 is allowed.
    assert method["rows"][-1]["beyond"] == 0
    assert 0.0 <= method["rows"][-1]["largest_error"] < 1e-13 * 1e6 / 30.0
    assert 0.0 <= method["rows"][-1]["share_of_allowed"] <= 1.0
