"""The certificate in wind: it holds for plans, and fails for what is no optimum."""

import json
from dataclasses import replace
from math import cos, degrees, inf, pi, sin
from random import Random

import pytest
from hypothesis import given, settings

import loiter
from certificate.certificates import altered, at_windy_tie, certified, worst
from evidence.checks.wind_scan_check import random_problems
from loiter import Aircraft, Orbit, Pose, Wind, candidates, hold, plan, plan_all
from loiter.certificate import certify
from loiter.errors import InvalidArgument
from loiter.kernel.entry import Entry
from loiter.kernel.wind import wind_search
from loiter.kernel.wind.paths import first_path
from loiter.planning.problem import Problem, maneuver
from strategies import windy_scenes

settings.register_profile("certificate in wind", deadline=None, max_examples=12)
settings.load_profile("certificate in wind")

UAV, UNIT = Aircraft(18.0, max_bank_deg=35.0), Aircraft(1.0, min_turn_radius_m=1.0)
ORBIT, WIND = Orbit(0.0, 0.0, 120.0), Wind(8.0, 250.0)
SCENE = Pose(-400.0, 120.0, 90.0), ORBIT, UAV, WIND
NAMES = ["target", "course", "join", "turn", "motion", "turning", "slope", "norm", "multiplier", "sign", "hamiltonian"]
NAMES += ["transversality", "gradient", "bellman", "fastest"]


@given(windy_scenes())
def test_plans_have_valid_certificates(scene):
    for m in plan_all(*scene):
        certified(certify(m))


def test_no_false_alarm_where_a_corner_cancels_the_curvature_of_t_at_one_step():
    """The slopes of the two directions differ by 2.8e-4 there, as much as T bends over a step of 2^-9."""
    wind = Wind(0.004457004821594168, 270.0)
    for m in plan_all(Pose(-7.01787641882672, 0.0, 90.0), Orbit(0.0, 0.0, 2.0178677490703363), UNIT, wind):
        certificate = certified(certify(m))
        assert certificate.residual("gradient").note == "T has a corner: its one-sided derivatives"


def test_no_false_alarm_where_the_search_once_missed_a_minimum():
    """RSL was 1.2e-3 s later there, and the least times of neighbours were too: the gradient was off by 0.87."""
    wind = Wind(0.33061764489139006, 0.0)
    scene = Pose(-1.7496693192567783, 0.0, 180.0), Orbit(0.0, 0.0, 2.124651980275571, "ccw"), UNIT, wind
    assert not certified(certify(plan(*scene))).residual("gradient").skipped


@pytest.mark.parametrize("i", range(24, 60))
def test_next_to_ties_plans_have_valid_certificates(i):
    """Where lambda + p.w is next to 0, rounding of the end changes T by far more than rounding of T."""
    certified(certify(plan(*at_windy_tie(Random(f"0 ties in wind {i}")))))


def test_a_search_for_the_largest_residuals_finds_no_false_alarm():
    share, name, scene = worst(3, 8, 20, "gradient")
    assert share <= 1.0, (name, scene)


def test_plans_of_random_problems_have_valid_certificates_and_most_gradients_converge():
    """Random problems of the search: inside, near and far, circles of the least radius that can be held."""
    skipped = 0
    for problem in random_problems(30, 17):
        if problem.wind_east == problem.wind_north == 0.0:
            continue
        east, north, angle = problem.start
        velocity = -problem.wind_east, -problem.wind_north
        orbit = Orbit(0.0, 0.0, problem.radius, {1: "cw", -1: "ccw", 0: "either"}[int(problem.side)], *velocity)
        certificate = certified(certify(plan(Pose(east, north, 90.0 - degrees(angle)), orbit, UNIT)))
        assert [residual.name for residual in certificate.residuals] == NAMES
        skipped += certificate.residual("gradient").skipped
    assert skipped <= 3


def test_a_loser_is_an_extremal_that_is_not_the_fastest():
    best, *losers = candidates(*SCENE)
    assert losers
    for loser in losers:
        certificate = certify(loser)
        assert {residual.name for residual in certificate.failed} <= {"fastest", "gradient", "bellman"}
        assert certificate.residual("fastest").failed
        assert f"{best.word} {best.turn.value} is faster" in str(certificate)


def joined_at(phase, side):
    """The first path to another point of the circle: it arrives there, but is not the fastest."""
    pose, orbit, uav, wind = SCENE
    problem = Problem(pose, orbit, uav, wind)
    scene = problem.in_wind()
    inner = wind_search.scene_of(scene)
    way = first_path(phase, side, inner, inf)
    return maneuver(problem, Entry(side, *way[1:5]), 0.0)


@pytest.mark.parametrize("phase", [0.5, 2.0, 4.5])
def test_a_path_to_another_point_of_the_circle_is_not_transversal(phase):
    certificate = certify(joined_at(phase, 1))
    failed = {residual.name for residual in certificate.failed}
    assert failed >= {"transversality", "fastest"}
    assert not failed & {"target", "course", "join", "turn", "motion"}


@pytest.mark.parametrize(
    ("piece", "longer", "name"), [(0, 0.01, "target"), (1, 0.01, "target"), (2, 0.001, "target"), (2, -0.01, "course")]
)
def test_a_maneuver_that_ends_beside_the_circle_is_caught(piece, longer, name):
    assert certify(altered(plan(*SCENE), piece, longer)).residual(name).failed


def test_a_wrong_join_is_caught():
    m = plan(*SCENE)
    end = replace(m.segments[-1], end=replace(m.join, east_m=m.join.east_m + 1e-6))
    assert certify(replace(m, segments=(*m.segments[:-1], end))).residual("join").failed


def test_the_wrong_direction_is_caught():
    m = plan(*SCENE)
    assert certify(replace(m, turn=m.turn.other)).residual("turn").failed
    assert certify(replace(m, orbit=replace(ORBIT, turn=m.turn.other))).residual("turn").failed


def test_the_maneuver_of_another_wind_is_caught():
    assert {"target", "join"} <= {r.name for r in certify(replace(plan(*SCENE), wind=Wind(8.1, 250.0))).failed}


@pytest.mark.parametrize("azimuth", [20.0, 200.0])
@pytest.mark.parametrize("turn", ["cw", "ccw"])
def test_a_start_on_the_circle_has_only_the_arrival_to_check(azimuth, turn):
    heading = hold(ORBIT, UAV, WIND, turn=turn).at(azimuth).heading_deg
    here = Pose(120.0 * sin(azimuth * pi / 180.0), 120.0 * cos(azimuth * pi / 180.0), heading)
    certificate = certified(certify(plan(here, ORBIT, UAV, WIND)))
    assert (certificate.lam, certificate.psi, certificate.pieces) == (None, None, ())
    assert "nothing to decide" in certificate.choice


@pytest.mark.parametrize("u", ["L", "R"])
@pytest.mark.parametrize("azimuth", [20.0, 200.0])
def test_a_single_arc_has_a_valid_certificate(u, azimuth):
    """Flown backwards from the circle: on the last arc already."""
    scene = Problem(SCENE[0], ORBIT, UAV, WIND).in_wind()
    point = hold(ORBIT, UAV, WIND, turn="cw").at(azimuth)
    angle, w, sign, t = (90.0 - point.heading_deg) * pi / 180.0, complex(scene.wx, scene.wy), {"L": 1, "R": -1}[u], 0.4
    out = (90.0 - azimuth) * pi / 180.0
    end, after = scene.R * complex(cos(out), sin(out)), complex(cos(angle), sin(angle))
    before = after * complex(cos(t), -sign * sin(t))
    q = (end - (after - before) / (1j * sign) - w * t) * UAV.turn_radius_m
    heading = 90.0 - degrees(angle - sign * t)
    certified(certify(plan(Pose(q.real, q.imag, heading), replace(ORBIT, turn="cw"), UAV, WIND)))


@given(windy_scenes())
def test_a_circle_that_drifts_with_the_air_has_the_certificate_of_still_air(scene):
    pose, orbit, uav, wind = scene
    east, north = wind.velocity_m_s
    drifting_along = replace(orbit, velocity_east_m_s=east, velocity_north_m_s=north)
    certificate = certified(certify(plan(pose, drifting_along, uav, wind)))
    assert certificate.residual("join").equation == "the last pose, reduced by (2), is the target"


def test_text_json_and_history():
    certificate = certify(plan(*SCENE))
    text, plain = str(certificate), json.loads(json.dumps(certificate.to_dict(), allow_nan=False))
    assert text.startswith("Certificate of RSL, clockwise: valid.")
    assert "the runner-up RSR ccw takes 0.46 s more" in text
    assert [switch["letters"] for switch in plain["switches"]] == ["RS", "SL"]
    assert (plain["valid"], plain["lambda"], plain["runner_up"]) == (True, 1.0, "RSR")
    for piece in certificate.history(20):
        for instant in piece:
            assert abs(abs(instant.phi) + instant.psi1 - certificate.lam) < 1e-9
            assert instant.u * instant.phi >= -1e-9


def test_an_impossible_maneuver_is_refused():
    m = plan(*SCENE)
    with pytest.raises(InvalidArgument, match="it must be cw or ccw"):
        certify(replace(m, turn=loiter.Turn.EITHER))
    with pytest.raises(InvalidArgument, match="has the word 'LLL'"):
        certify(replace(m, segments=tuple(replace(s, letter="L") for s in m.segments)))


@pytest.mark.parametrize("turn", ["cw", "ccw"])
@pytest.mark.parametrize("azimuth", [0.0, 70.0, 160.0, 250.0])
@pytest.mark.parametrize("outside", [-2.0, 2.0])
@pytest.mark.parametrize("turned", [0.0, 1.0, -20.0, 20.0])
def test_a_start_beside_the_circle_within_the_tolerance_is_certified(turn, azimuth, outside, turned):
    """Without a tolerance the same maneuver is refused: it ends beside the circle."""
    orbit, a = replace(ORBIT, turn=turn), azimuth * pi / 180.0
    heading = hold(orbit, UAV, WIND, turn=turn).at(azimuth).heading_deg + turned
    pose = Pose((120.0 + outside) * sin(a), (120.0 + outside) * cos(a), heading)
    for m in plan_all(pose, orbit, UAV, WIND, tolerance_m=5.0):
        certified(certify(m, tolerance_m=5.0))
        assert m.miss_m <= 5.0
        assert m.duration_s <= plan(pose, orbit, UAV, WIND).duration_s
        if m.miss_m > 1e-6:
            refused = {residual.name for residual in certify(m).failed}
            assert refused & {"target", "course"}
    assert turned in (-20.0, 20.0) or plan(pose, orbit, UAV, WIND, tolerance_m=5.0).word == ""
