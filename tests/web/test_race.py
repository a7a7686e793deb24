"""The race of guidance laws: flown as `loiter.lab.trials` flies them, and by the page's engine as by Python."""

import json

import pytest

import loiter
from loiter.lab.simulators.kinematic import Kinematic
from loiter.lab.trials.flight import fly
from loiter.planning.problem import Problem
from loiter.web.answers.race import STEP, laws, race
from web.browsing import in_module

UAV = loiter.Aircraft(18.0, max_bank_deg=35.0)
SCENES = {
    "still air": ((-400.0, 120.0, 90.0), (0.0, 0.0, 80.0), UAV, (0.0, 0.0)),
    "wind": ((90.0, 60.0, 100.0), (0.0, 0.0, 130.0, "ccw"), UAV, (8.0, 250.0)),
    "moving circle": ((500.0, -300.0, 10.0), (0.0, 0.0, 120.0, "either", 3.0, -1.0), UAV, (2.0, 90.0)),
    "the paper's scale": ((4.0, 4.0, 90.0), (0.0, 0.0, 1.5), loiter.Aircraft(1.0, min_turn_radius_m=1.0), (0.0, 0.0)),
}

# Laws are continuous but for their choices; after a flight of a thousand steps rounding is still far below this.
CLOSE = 1e-6


def problem_of(name):
    pose, orbit, aircraft, wind = SCENES[name]
    return Problem(loiter.Pose(*pose), loiter.Orbit(*orbit), aircraft, loiter.Wind(*wind))


@pytest.mark.parametrize("name", SCENES)
def test_each_law_joins_when_its_trial_says(name):
    problem = problem_of(name)
    dt = STEP * problem.aircraft.turn_radius_m / problem.aircraft.airspeed_m_s
    least = loiter.plan(problem.pose, problem.orbit, problem.aircraft, problem.wind).duration_s
    flown = race(problem)
    assert [one["law"] for one in flown] == ["L1", "vector field", "tangent point"]
    for one, law in zip(flown, laws(problem).values(), strict=True):
        simulator = Kinematic(problem.pose, problem.aircraft, problem.wind)
        trial = fly(law, simulator, problem.orbit, step_s=dt, limit_s=dt * 6000)
        assert one["joined_s"] == (trial.joined_s if trial.settled else None)
        # The band is entered up to 5 % of the radius before the circle itself.
        band_s = 0.05 * problem.orbit.radius_m / (problem.aircraft.airspeed_m_s - problem.wind.speed_m_s)
        assert one["joined_s"] is None or one["joined_s"] > least - band_s - dt
        assert len({len(column) for column in one["track"].values()}) == 1


def test_the_page_flies_the_same_race():
    asked = []
    for name in SCENES:
        pose, orbit, aircraft, wind = SCENES[name]
        velocity = (*orbit[4:], 0.0, 0.0)[:2]
        asked.append(
            {
                "pose": dict(zip(("east_m", "north_m", "heading_deg"), pose, strict=True)),
                "orbit": {
                    "east_m": orbit[0],
                    "north_m": orbit[1],
                    "radius_m": orbit[2],
                    "turn": (*orbit[3:4], "either")[0],
                    "velocity_east_m_s": velocity[0],
                    "velocity_north_m_s": velocity[1],
                },
                "aircraft": {name: value for name, value in vars(aircraft).items() if value is not None},
                "wind": {"speed_m_s": wind[0], "from_deg": wind[1]},
            }
        )
    found = in_module("kernel/engine.js", f"{json.dumps(asked)}.map(module.race)")
    for name, flown in zip(SCENES, found, strict=True):
        for page, library in zip(flown, race(problem_of(name)), strict=True):
            assert (page["law"], page["joined_s"]) == (library["law"], pytest.approx(library["joined_s"], abs=CLOSE))
            for column, values in library["track"].items():
                assert page["track"][column] == pytest.approx(values, abs=CLOSE, rel=CLOSE), (name, page["law"], column)
