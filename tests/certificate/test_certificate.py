"""Certificates: every optimum has a valid one, no loser has, and what is altered is noticed."""

import json
import re
from collections import Counter
from dataclasses import replace
from math import cos, hypot, isfinite, pi, sin, sqrt
from pathlib import Path
from random import Random

import numpy as np
import pytest
from hypothesis import assume, example, given, settings
from hypothesis import strategies as st

import loiter
from certificate.certificates import altered, at_axis, at_curve, at_tie, certified, real, reduced, wrong_ones
from evidence.checks.oracle_check import random_problems as hard_problems
from golden.paper import EXAMPLES
from loiter import Aircraft, Orbit, Pose, Turn, candidates, plan, plan_all
from loiter.certificate import Certificate, certify, gradient
from loiter.certificate.accuracy import accuracy_of
from loiter.certificate.adjoints import trajectory_of
from loiter.certificate.conditions import IN_WIND
from loiter.certificate.least_times import least_times
from loiter.certificate.paper_conditions import IN_STILL_AIR
from loiter.errors import InvalidArgument
from loiter.planning.problem import problem_of
from strategies import coordinates, radii, scenes, turns

UNIT = Aircraft(1.0, min_turn_radius_m=1.0)
SQRT3 = sqrt(3.0)


def unit_scene(x, y, R=1.0, turn="either"):
    """The scene whose reduced state is (x, y): heading east."""
    return Pose(x, y, 90.0), Orbit(0.0, 0.0, R, turn), UNIT


@settings(max_examples=100, deadline=None)
@given(scenes())
def test_every_optimum_has_a_valid_certificate(scene):
    for m in plan_all(*scene):
        certified(certify(m))


@settings(max_examples=100, deadline=None)
@given(coordinates, coordinates, radii, turns)
@example(0.0, 0.0, 1.0, Turn.EITHER)
@example(0.0, 0.0, 2.0, Turn.CW)
@example(SQRT3, 0.0, 1.0, Turn.EITHER)
@example(-1e-9, 1e-9, 1.999999999, Turn.CW)  # a single arc of half a turn, past the centre: lambda is next to 0
@example(0.0, 1e-9, 1.999999999, Turn.EITHER)
@example(-1e-9, 1e-9, 1.0, Turn.CW)  # on the switching curve up to rounding: words with and without a first arc tie
@example(81.25983242970881, 7.697540725358905e-12, 29.659981505577424, Turn.EITHER)  # next to a corner of T
@example(2.999959496011636, -1.0153955282577547, 1.999999, Turn.EITHER)  # a first arc of rounding length
@example(-0.8595718916489227, 0.48898516353525234, 2.0, Turn.CCW)  # a last arc of the root of rounding
def test_every_optimum_of_the_reduced_plane_has_a_valid_certificate(x, y, R, turn):
    for m in plan_all(*unit_scene(x, y, R, turn)):
        certified(certify(m))


@pytest.mark.parametrize("i", [2199, 5808, 6825, 7728, 12723, 18018])
def test_no_false_alarm_at_a_corner_with_a_small_change_of_slope(i):
    """On a wide circle, where it meets the axis: the slopes of T differ by less than a thousandth."""
    gradient = certified(certify(plan(*at_curve(Random(f"0 curves {i}"))))).residual("gradient")
    assert gradient.skipped or gradient.note == "T has a corner: its one-sided derivatives"


@pytest.mark.parametrize("draw", [at_curve, at_axis, at_tie])
def test_next_to_boundaries_and_ties_plans_have_valid_certificates(draw):
    for i in range(100):
        certified(certify(plan(*draw(Random(f"1 {i}")))))


@pytest.mark.parametrize("draw", [real, reduced, at_curve, at_axis, at_tie])
def test_no_wrong_maneuver_is_accepted(draw):
    """Losers, durations moved by 1e-6, words exchanged."""
    found = Counter()
    for i in range(40):
        random = Random(f"2 {i}")
        for kind, maneuver in wrong_ones(random, draw(random)):
            found[kind] += 1
            assert not certify(maneuver).valid, (kind, maneuver)
    assert min(found[kind] for kind in ("loser", "duration", "word")) > 20


@pytest.mark.parametrize("seed", [7, 8])
def test_hard_places_have_valid_certificates(seed):
    for problem in hard_problems(150, seed):
        certified(certify(plan(problem.pose, problem.orbit, problem.aircraft)))


# Circles on which two words meet: centre (0, sign), radius R + step.
MEETING = st.tuples(st.sampled_from([1.0, -1.0]), st.sampled_from([1.0, -1.0]))


@settings(max_examples=100, deadline=None)
@given(MEETING, st.floats(0.0, 2.0 * pi), radii, turns, st.sampled_from([0.0, 1e-15, -1e-13, 1e-11, -1e-9, 1e-6]))
def test_next_to_where_words_meet_too(circle, azimuth, R, turn, off):
    """The last circles, (25) and its likes: words tie there smoothly, T jumps, pieces vanish."""
    sign, step = circle
    x, y = (R + step + off) * cos(azimuth), (R + step + off) * sin(azimuth) - sign
    for m in plan_all(*unit_scene(x, y, R, turn)):
        certified(certify(m))


@settings(max_examples=100, deadline=None)
@given(scenes())
def test_no_loser_has_a_valid_certificate(scene):
    best = plan(*scene)
    for m in candidates(*scene):
        certificate = certify(m)
        late = m.duration_s - best.duration_s > certificate.tie_s
        assert certificate.residual("fastest").failed == late
        assert not (late and certificate.valid)
        if late:
            assert "is faster" in certificate.residual("fastest").note
            assert certificate.runner_up is None
            assert certificate.margin_s is None


def test_the_papers_admissible_control_breaks_the_maximum_principle():
    losers = candidates(*unit_scene(-0.53, 0.31))
    certificate = certify(next(m for m in losers if m.word == "RL"))
    assert {r.name for r in certificate.failed} == {"sign", "hamiltonian", "psi1", "gradient", "fastest"}
    assert "NOT VALID, FAILED: " in str(certificate)
    assert "FAILED (LRL cw is faster)" in str(certificate)


@pytest.mark.parametrize(("x", "y"), [(0.8, -2.6), (-1.4, -1.6), (1.0, -2.6)])
def test_a_last_arc_beyond_pi_3_is_an_optimum_of_one_direction_alone(x, y):
    """Section 3: it crosses the axis, so for *either* its reflection is as fast and no extremal."""
    alone = plan(*unit_scene(x, y, turn="cw"))
    assert alone.segments[-1].duration_s > pi / 3 + 1.0
    certificate = certified(certify(alone))
    with pytest.raises(InvalidArgument, match="residual is 'axis': this certificate has target"):
        certificate.residual("axis")
    free = certify(replace(alone, orbit=replace(alone.orbit, turn=Turn.EITHER)))
    assert {r.name for r in free.failed} == {"axis", "last arc", "gradient", "fastest"}


@settings(max_examples=100, deadline=None)
@given(scenes(), st.integers(0, 2), st.sampled_from([1e-6, -1e-6]))
def test_an_altered_duration_is_noticed(scene, which, by):
    m = plan(*scene)
    assume(which < len(m.segments) and m.segments[which].duration_s > 1e-6)
    certificate = certify(altered(m, which, by))
    r, V = m.aircraft.turn_radius_m, m.aircraft.airspeed_m_s
    assume(abs(by) * V / r * _reach(m, which) > certificate.residual("target").bound)
    assert certificate.residual("target").failed


def _reach(m, which):
    """How far, in turn radii, the end moves for a turn radius over airspeed more of a piece: its speed in (7)."""
    start, orbit, r = m.segments[which].start, m.orbit, m.aircraft.turn_radius_m
    piece = m.segments[which]
    if piece.letter == "S":
        return 1.0
    east, north = (start.east_m - orbit.east_m) / r, (start.north_m - orbit.north_m) / r
    heading = start.heading_deg * pi / 180.0
    x, y = east * sin(heading) + north * cos(heading), north * sin(heading) - east * cos(heading)
    return 0.5 * hypot(x, y + (1.0 if piece.letter == "L" else -1.0))


@pytest.mark.parametrize("which", [0, 1, 2])
def test_an_altered_duration_fails_at_the_target(which):
    certificate = certify(altered(plan(*unit_scene(4.0, 4.0)), which, 1e-6))
    assert certificate.residual("target").failed
    assert certificate.residual("target").value > 1e-7
    assert not certificate.residual("join").failed  # the pose was left as it was


def test_an_altered_last_arc_breaks_the_condition_at_the_target():
    certificate = certify(altered(plan(*unit_scene(4.0, 4.0)), 2, 1e-6))
    assert certificate.residual("transversality").failed
    assert certificate.residual("last arc").value == pytest.approx(1e-6, rel=1e-6)


def test_an_altered_end_and_an_altered_turn_are_noticed():
    m = plan(*unit_scene(4.0, 4.0))
    end = replace(m.join, east_m=m.join.east_m + 1e-6)
    moved = replace(m, segments=(*m.segments[:2], replace(m.segments[2], end=end)))
    assert [r.name for r in certify(moved).failed] == ["join"]
    assert certify(replace(m, turn=m.turn.other)).residual("target").failed
    asked = replace(m, orbit=replace(m.orbit, turn=m.turn.other))
    assert certify(asked).residual("turn").failed


def test_example_1():
    first, second = map(certify, plan_all(*unit_scene(4.0, 4.0)))
    tau1, straight, _ = EXAMPLES[0].durations
    for certificate in (first, second):
        assert certificate.valid
        assert certificate.lam == 1.0
        assert [s.time_s for s in certificate.switches] == pytest.approx([tau1, tau1 + straight], abs=1e-12)
        assert [(s.x, s.y) for s in certificate.switches] == [
            pytest.approx((-sqrt(24.0), 0.0), abs=1e-14),
            pytest.approx((-SQRT3, 0.0), abs=1e-14),
        ]
        assert [(s.psi1, s.psi2) for s in certificate.switches] == [pytest.approx((1.0, 0.0), abs=1e-15)] * 2
    assert [(t.word, t.turn) for t in first.ties] == [("RSR", Turn.CCW)]
    assert (first.runner_up.word, first.margin_s) == ("LSL", pytest.approx(2.920590092689, abs=1e-12))


def test_example_2():
    certificate = certify(plan(*unit_scene(-0.53, 0.31)))
    a, b = certificate.switches
    assert (a.letters, a.x, a.y) == ("LR", pytest.approx(0.291365, abs=5e-7), pytest.approx(0.382789, abs=5e-7))
    assert (b.letters, b.x, b.y) == ("RL", pytest.approx(-0.672517, abs=5e-7), pytest.approx(0.883539, abs=5e-7))
    # psi is parallel to the switching points and psi1 = lambda at both.
    assert certificate.lam == pytest.approx(0.672517 / hypot(0.672517, 0.883539), abs=1e-6)
    assert (a.psi1, b.psi1) == (pytest.approx(certificate.lam, abs=1e-14),) * 2
    assert a.psi2 == pytest.approx(-b.psi2, abs=1e-14)
    assert (certificate.runner_up.word, certificate.margin_s) == (
        "RL",
        pytest.approx(6.025185252835342 - 5.377867042802649, abs=1e-12),
    )
    assert certificate.ties == ()
    assert not any(r.skipped for r in certificate.residuals)


@pytest.mark.parametrize(("x", "count"), [(-3.0, 2), (-SQRT3, 2), (-1.0, 2), (0.0, 2), (1.0, 2), (SQRT3, 4), (3.0, 4)])
def test_on_the_axis_each_of_the_ties_is_certified(x, count):
    """y = 0: where first arcs tie T has a corner, and the gradient of each lies between its one-sided derivatives."""
    certificates = [certify(m) for m in plan_all(*unit_scene(x, 0.0))]
    assert [c.valid for c in certificates] == [True] * count
    assert all(len(c.ties) == count - 1 for c in certificates)
    if x == -3.0:
        # Both sides of the axis fly straight at once, and T is smooth.
        assert all(c.residual("gradient").value < 1e-9 for c in certificates)
        return
    if x == -SQRT3:
        # T jumps beside the last arc.
        assert all("skipped (T has a corner or a jump here" in str(c) for c in certificates)
        return
    for c in certificates:
        assert c.residual("bellman").value < 1e-5
        if len(c.maneuver.segments) == 1:
            assert c.residual("gradient").skipped
            continue
        assert c.residual("gradient").value < c.residual("gradient").bound < 1e-5
        assert "holds (T has a corner: its one-sided derivatives)" in str(c)


def test_at_a_corner_a_wrong_psi_is_noticed():
    """A psi that is turned has a gradient outside the one-sided derivatives."""
    m = plan(*unit_scene(1.0, 0.0))
    right = trajectory_of(m, problem_of(m))
    wrong = replace(right, pieces=tuple(piece._replace(p=piece.p * (0.6 + 0.8j)) for piece in right.pieces))
    for trajectory, failed in ((right, False), (wrong, True)):
        times, accuracy = least_times(trajectory), accuracy_of(trajectory, ())
        residual, _ = gradient.corner_residuals(IN_STILL_AIR.gradient, trajectory, accuracy, times)
        assert residual.failed == failed


@pytest.mark.parametrize("y", [0.1, 0.5, 0.9, -0.3, -0.9])
@pytest.mark.parametrize("turn", ["cw", "either"])
def test_a_single_arc(y, turn):
    """(27) and its continuation beyond the axis, where *either* has a tie."""
    m = plan_all(*unit_scene(-sqrt(3.0 - 2.0 * y - y * y), y, turn=turn))
    arc = certified(next(c for c in map(certify, m) if c.maneuver.word == "L"))
    assert "a single arc has many psi" in arc.choice
    if turn == "cw" or y > 0.0:
        assert arc.residual("gradient").skipped
    else:
        # With the twin as fast T is smooth here, and its gradient picks this psi out of the many.
        assert not arc.residual("gradient").skipped
        assert arc.residual("gradient").value < 1e-9
    assert (arc.lam == 1.0) == (y < 0.0)
    assert len(arc.ties) == (1 if y < 0.0 and turn == "either" else 0)


@pytest.mark.parametrize("R", [1.0, 2.5])
@pytest.mark.parametrize("turn", ["cw", "ccw"])
def test_a_start_on_the_circle_has_the_target_to_check(R, turn):
    certificate = certified(certify(plan(*unit_scene(0.0, R if turn == "cw" else -R, R, turn))))
    assert (certificate.lam, certificate.psi, certificate.switches) == (None, None, ())
    assert [r.name for r in certificate.residuals] == ["target", "join", "turn", "fastest"]
    assert "nothing to decide" in str(certificate)
    assert list(certificate.history()) == []
    beside = replace(certificate.maneuver, start=replace(certificate.maneuver.start, east_m=1e-6))
    assert certify(beside).residual("target").failed


def test_a_plan_with_a_tolerance_needs_it_for_its_certificate():
    """A start 0.2 m beyond the last arc: planned with a tolerance, certified with it, refused without."""
    uav = Aircraft(18.0, min_turn_radius_m=50.0)
    pose = Pose(-50.0 * sqrt(1.75) + 0.2, 25.0, 90.0)
    m = plan(pose, Orbit(0.0, 0.0, 50.0, Turn.CW), uav, tolerance_m=0.5)
    assert certify(m, tolerance_m=0.5).valid
    strict = certify(m)
    assert strict.residual("target").failed
    assert strict.residual("target").value * 50.0 == pytest.approx(m.miss_m, rel=1e-9)


@settings(max_examples=100, deadline=None)
@given(scenes(), st.floats(0.0, 5.0))
def test_optima_with_a_tolerance_are_valid(scene, tolerance):
    certified(certify(plan(*scene, tolerance_m=tolerance), tolerance_m=tolerance))


@settings(max_examples=50, deadline=None)
@given(scenes())
def test_history_agrees_with_the_switches_and_the_signs(scene):
    certificate = certify(plan(*scene))
    pieces = list(certificate.history(20))
    assert [piece[0].time_s for piece in pieces[1:]] == pytest.approx([s.time_s for s in certificate.switches])
    for piece in pieces:
        assert len(piece) == 21
        for instant in piece:
            assert instant.u * instant.phi >= -certificate.residual("sign").bound
            assert instant.psi1 <= certificate.lam + certificate.residual("psi1").bound


@settings(max_examples=50, deadline=None)
@given(scenes())
def test_json_is_plain_and_finite(scene):
    for m in candidates(*scene):
        certificate = certify(m)
        answer = json.loads(json.dumps(certificate.to_dict(), allow_nan=False))
        assert answer["valid"] == certificate.valid
        assert [r["name"] for r in answer["residuals"]] == [r.name for r in certificate.residuals]
        assert {r["verdict"] for r in answer["residuals"]} <= {"holds", "FAILED", "skipped"}
        assert len(answer["candidates"]) == len(certificate.others)


def test_json_of_a_scene_at_the_end_of_doubles_is_finite_too():
    certificate = certify(plan(Pose(1e17, 0.0, 33.0), Orbit(0.0, 0.0, 80.0), Aircraft(18.0, min_turn_radius_m=50.0)))
    json.dumps(certificate.to_dict(), allow_nan=False)
    assert all(r.value is None or isfinite(r.value) for r in certificate.residuals)


def test_a_certificate_is_frozen_and_reads_as_a_table():
    certificate = loiter.certificate.certify(plan(*unit_scene(-0.53, 0.31)))
    assert isinstance(certificate, Certificate)
    with pytest.raises(AttributeError):
        certificate.lam = 0.0
    lines = str(certificate).splitlines()
    assert lines[0] == "Certificate of LRL, clockwise: valid."
    assert lines[1] == "Optimal, up to rounding, by theorem 1 of evidence/docs/proof.md."
    assert lines[2].startswith(
        "In doubles: it ends within 1.3e-12 m of the point of joining, and takes at most 6.5e-13 s"
    )
    assert lines[3] == "lambda = 0.605670, psi = (0.058455, 0.998290) at the start."
    assert sum(line.endswith("holds") for line in lines) == len(certificate.residuals)
    assert "The adjoint psi is unique: the condition phi = 0 at a switch determines it." in lines
    assert lines[-2] == (
        "Numbers in parentheses: equations of the paper, listed in evidence/docs/paper.md; lengths in turn radii. "
        "docs/certificate.md explains each row."
    )
    assert lines[-1] == (
        "Theorem 1: in each direction the optimum is one of nine words; "
        "of the 5 extremals with these words none is faster; the runner-up RL cw takes 0.647 s more."
    )


def test_every_equation_of_a_certificate_is_in_the_document_that_it_names():
    listed = set(
        re.findall(r"^\| \((\d+)\) \|", Path("evidence/docs/paper.md").read_text(encoding="utf-8"), re.MULTILINE)
    )
    certificate = loiter.certificate.certify(plan(*unit_scene(-0.53, 0.31)))
    named = {number for r in certificate.residuals for number in re.findall(r"\((\d+)\)", r.equation)}
    assert named
    assert named <= listed


@pytest.mark.parametrize(("formulation", "number"), [(IN_STILL_AIR, 21), (IN_WIND, 15)], ids=["still air", "wind"])
def test_the_document_has_a_row_for_each_condition(formulation, number):
    text = Path("docs/certificate.md").read_text(encoding="utf-8").replace("\\|", "|")
    still, wind = text.partition("## Slots")[0].split("## Wind")
    rows = [(c.name, c.equation) for c in (*formulation.arrival, *formulation.motion, *formulation.further)]
    rows += [*formulation.maximum_principle.items(), *formulation.gradient._asdict().items()]
    rows += [("fastest", "T is the least of all candidates")]
    section = (still if formulation is IN_STILL_AIR else wind).splitlines()
    lines = [line for line in section if line.startswith("| ") and not line.startswith("| row")]
    assert len({name for name, _ in rows}) == len(lines) == number
    absent = [
        row for row in rows if not any(line.startswith(f"| {row[0]} |") and f"`{row[1]}`" in line for line in lines)
    ]
    assert absent == []


def test_the_text_of_a_certificate_that_proves_nothing_compares_only():
    in_wind = str(certify(plan(*unit_scene(2.0, -1.0, 3.5, "cw"), loiter.Wind(0.2, 90.0)))).splitlines()
    assert "Numbers in parentheses: equations in docs/wind.md" in in_wind[-2]
    assert re.match(r"Compared with \d+ other extremals?", in_wind[-1])


@pytest.mark.parametrize(
    ("change", "problem"),
    [
        ({"turn": Turn.EITHER}, "maneuver holds the circle 'either': it must be cw or ccw"),
        ({"segments": "SS"}, "maneuver has the word 'SS': it must be one of R, L, SR"),
        ({"segments": "LRLR"}, "maneuver has the word 'LRLR': it must be one of"),
        ({"segments": -1.0}, "maneuver has durations"),
        ({"segments": float("nan")}, "they must be zero or positive, finite seconds"),
    ],
)
def test_an_impossible_maneuver_is_refused_in_a_sentence(change, problem):
    m = plan(*unit_scene(4.0, 4.0))
    value = change.get("segments")
    if isinstance(value, str):
        change = {"segments": tuple(replace(m.segments[0], letter=letter) for letter in value)}
    elif isinstance(value, float):
        change = {"segments": (replace(m.segments[0], duration_s=value),)}
    with pytest.raises(InvalidArgument, match=problem):
        certify(replace(m, **change))


@pytest.mark.parametrize(
    ("scene", "tolerance", "proved"),
    [
        (unit_scene(-0.53, 0.31), 0.0, True),
        (unit_scene(2.0, -1.0, 3.5, "cw"), 0.0, True),
        (unit_scene(2.0, -1.0, 3.5, "cw"), 0.01, False),
        ((*unit_scene(2.0, -1.0, 3.5, "cw"), loiter.Wind(0.2, 90.0)), 0.0, False),
    ],
    ids=["paper", "wider", "tolerance", "wind"],
)
def test_an_optimum_is_claimed_in_still_air_without_a_tolerance(scene, tolerance, proved):
    certificate = certified(certify(plan(*scene, tolerance_m=tolerance), tolerance_m=tolerance))
    assert (certificate.proved_optimal, certificate.to_dict()["proved_optimal"]) == (proved, proved)
    basis = "evidence/docs/proof.md, theorem 1, up to rounding" if proved else "necessary conditions only"
    assert (certificate.basis, certificate.to_dict()["basis"]) == (basis, basis)
    assert ("Optimal, up to rounding, by theorem 1 of evidence/docs/proof.md." in str(certificate)) == proved
    assert ("Not proved to be optimal: these conditions are necessary ones" in str(certificate)) == (not proved)


def test_no_optimum_is_claimed_for_a_loser():
    *_, slowest = candidates(*unit_scene(-0.53, 0.31))
    certificate = certify(slowest)
    assert not certificate.proved_optimal
    assert certificate.to_dict()["basis"] == "a condition is violated"
    assert "Optimal" not in str(certificate)


def test_an_unknown_name_is_an_attribute_error():
    with pytest.raises(AttributeError, match=r"module 'loiter\.certificate' has no attribute 'prove'"):
        loiter.certificate.prove  # noqa: B018


def test_a_lone_arc_begun_beside_its_circle_within_the_tolerance_is_certified():
    uav, orbit = Aircraft(18.0, min_turn_radius_m=50.0), Orbit(0.0, 0.0, 80.0)
    m = plan(Pose(-1.0, 19.5, 90.0), orbit, uav, tolerance_m=2.0)
    assert m.word == "R"
    assert certify(m, tolerance_m=2.0).valid
    assert not certify(m).valid


# T moves with the square root of a distance that is smaller than the steps of quotients.
SHORT_DISTANCES = [
    unit_scene(-2.585723342869779e-10, 0.9999999702117938, 3.0, "ccw"),
    unit_scene(-0.0002107650504010905, 1.2395558994017257e-11, 2.000000022210947, "ccw"),
    unit_scene(2.7076775057953914e-15, -6.385215330843237e-10, 1.9999999993614845, "either"),
    unit_scene(1.9274610397462332e-16, 1.8854538789337695e-10, 1.9999999998114553, "either"),
]

# The switch of LR is at the centre: its two crossings tie, 1e-8 apart, and psi is parallel to neither with any digit.
SWITCH_AT_CENTRE = [
    unit_scene(-0.8364341456335516, 1.5480674735414715, 1.9999999822320698, "ccw"),
    unit_scene(-0.05345256406721661, -1.998570408055446, 1.9999999817753102, "cw"),
    unit_scene(-0.9597789495221066, -0.719243221273141, 1.9999999996265796, "cw"),
]

# Far from the origin with a turn radius of a millimetre: coordinates are rounded to 1e-9 turn radii, and T is that of a
# tolerance as large.
ROUNDED_COORDINATES = (
    Pose(7320.156033591165, -0.005605404694551407, 90.0),
    Orbit(7320.156033591165, -0.0026054046945514077, 0.001, "cw"),
    Aircraft(1.0, min_turn_radius_m=0.001),
)


@pytest.mark.parametrize(
    ("scene", "fastest"),
    [*((scene, 1) for scene in [*SHORT_DISTANCES, ROUNDED_COORDINATES]), *((scene, 2) for scene in SWITCH_AT_CENTRE)],
)
def test_no_false_alarm_where_digits_are_lost(scene, fastest):
    for m in candidates(*scene)[:fastest]:
        certified(certify(m))


def test_the_gradient_is_checked_at_nearly_all_random_states():
    """What is skipped next to boundaries must stay rare elsewhere, or the check would mean nothing."""
    random = np.random.default_rng(5)
    scenes_of = [unit_scene(*random.uniform(-8.0, 8.0, 2), random.uniform(1.0, 4.0)) for _ in range(200)]
    skipped = [s for s in scenes_of if certify(plan(*s)).residual("gradient").value is None]
    assert len(skipped) <= 2
