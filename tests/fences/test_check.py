"""Checks of fences against figures that are known: tangents, vertices, edges, and what cannot be checked."""

from math import hypot, pi, sqrt

import pytest

from fences.flying import UAV, held, path
from loiter import Orbit, Pose, Wind, plan
from loiter.errors import InvalidArgument
from loiter.fences import CircleZone, Fence, PolygonZone, default_margin_m
from loiter.fences.fence import LEAST_MARGIN_M

EAST = Pose(0.0, 0.0, 90.0)
# To rounding; a search for what touches or is entered is exact to a micrometre.
EXACT, SEARCHED = 1e-9, 1.1e-6


def square(size, east=0.0, north=0.0, inclusion=False):
    s = size / 2.0
    corners = ((east - s, north - s), (east + s, north - s), (east + s, north + s), (east - s, north + s))
    return PolygonZone("square", corners, inclusion)


def checked(maneuver, *zones, margin=0.0):
    return Fence(zones).check(maneuver, margin)


# Straight pieces


@pytest.mark.parametrize(
    ("zone", "clearance"),
    [
        (square(20.0, 100.0, 40.0), 30.0),
        (PolygonZone("tip", ((100.0, 7.0), (110.0, 30.0), (90.0, 30.0))), 7.0),
        (PolygonZone("before the start", ((-3.0, 4.0), (-20.0, 4.0), (-20.0, 20.0))), 5.0),
        (PolygonZone("after the end", ((203.0, 4.0), (220.0, 4.0), (220.0, 20.0))), 5.0),
        (PolygonZone("beside", ((-50.0, 12.0), (250.0, 12.0), (250.0, 30.0), (-50.0, 30.0))), 12.0),
        (CircleZone("circle", 100.0, 50.0, 30.0), 20.0),
        (CircleZone("behind", -3.0, 4.0, 2.0), 3.0),
        (CircleZone("round it", 100.0, 0.0, 130.0, True), None),
    ],
)
def test_a_straight_piece(zone, clearance):
    found = checked(path(EAST, ("S", 10.0)), zone)
    if clearance is None:
        assert found.breaches[0].holding, "the circle is far away"
        return
    assert found.clearance_m == pytest.approx(clearance, abs=EXACT)
    assert found.clear


@pytest.mark.parametrize(
    ("zone", "place", "depth"),
    [
        (square(20.0, 100.0, 0.0), (90.0, 0.0), 10.0),
        (PolygonZone("vertex touched", ((100.0, 0.0), (110.0, 30.0), (90.0, 30.0))), (100.0, 0.0), 0.0),
        (PolygonZone("edge touched", ((100.0, 0.0), (120.0, 0.0), (110.0, 30.0))), (100.0, 0.0), 0.0),
        (
            PolygonZone("through two vertices", ((100.0, 0.0), (110.0, -10.0), (120.0, 0.0), (110.0, 10.0))),
            (100.0, 0.0),
            sqrt(50.0),
        ),
        (CircleZone("touched", 100.0, 30.0, 30.0), (100.0, 0.0), 0.0),
        (CircleZone("through its middle", 100.0, 0.0, 30.0), (70.0, 0.0), 30.0),
        (CircleZone("end on its edge", 230.0, 0.0, 30.0), (200.0, 0.0), 0.0),
    ],
)
def test_a_straight_piece_that_enters(zone, place, depth):
    found = checked(path(EAST, ("S", 10.0)), zone)
    (breach,) = found.breaches
    assert breach.enters
    # A touch is found to the square root of the resolution along the path.
    along = SEARCHED if depth else 2.0 * sqrt(2.0 * 30.0 * SEARCHED)
    assert (breach.east_m, breach.north_m) == pytest.approx(place, abs=along)
    assert breach.time_s == pytest.approx(place[0] / 20.0, abs=along)
    assert -breach.clearance_m == pytest.approx(depth, abs=SEARCHED)


# Arcs: half a turn to the left of radius 50 m, from the origin heading east, about (0, 50).

HALF_S = pi * 50.0 / 20.0


@pytest.mark.parametrize(
    ("zone", "clearance"),
    [
        (CircleZone("outside", 80.0, 50.0, 10.0), 20.0),
        (CircleZone("in the middle", 0.0, 50.0, 10.0), 40.0),
        (CircleZone("where the other half would be", -80.0, 50.0, 10.0), hypot(80.0, 50.0) - 10.0),
        (PolygonZone("edge beside", ((57.0, 0.0), (70.0, 0.0), (70.0, 100.0), (57.0, 100.0))), 7.0),
        (PolygonZone("vertex beside", ((54.0, 50.0), (90.0, 20.0), (90.0, 80.0))), 4.0),
        (
            PolygonZone("chord crossed", ((-20.0, 45.0), (20.0, 45.0), (20.0, 55.0), (-20.0, 55.0))),
            50.0 - hypot(20.0, 5.0),
        ),
    ],
)
def test_an_arc(zone, clearance):
    found = checked(path(EAST, ("L", HALF_S)), zone)
    assert found.clear
    assert found.clearance_m == pytest.approx(clearance, abs=EXACT)


@pytest.mark.parametrize(
    ("zone", "place", "depth"),
    [
        (CircleZone("touched from outside", 80.0, 50.0, 30.0), (50.0, 50.0), 0.0),
        (CircleZone("touched from inside", 20.0, 50.0, 30.0), (50.0, 50.0), 0.0),
        (PolygonZone("edge touched", ((50.0, 0.0), (70.0, 0.0), (70.0, 100.0), (50.0, 100.0))), (50.0, 50.0), 0.0),
        (PolygonZone("vertex touched", ((30.0, 10.0), (90.0, -20.0), (90.0, 20.0))), (30.0, 10.0), None),
        (
            PolygonZone("edge passed", ((47.0, 0.0), (70.0, 0.0), (70.0, 100.0), (47.0, 100.0))),
            (47.0, 50.0 - sqrt(50.0**2 - 47.0**2)),
            3.0,
        ),
    ],
)
def test_an_arc_that_enters(zone, place, depth):
    found = checked(path(EAST, ("L", HALF_S)), zone)
    (breach,) = found.breaches
    # An entry is where the path comes within a micrometre; it crosses that edge at 20 degrees, 1/sin of which is 2.9.
    along = 3.0 * SEARCHED if depth else 2.0 * sqrt(2.0 * 30.0 * SEARCHED)
    assert hypot(breach.east_m - place[0], breach.north_m - place[1]) <= along
    if depth is not None:
        assert -breach.clearance_m == pytest.approx(depth, abs=SEARCHED)


# The hold


@pytest.mark.parametrize("wind", [Wind(0.0, 0.0), Wind(6.0, 200.0)])
@pytest.mark.parametrize(
    ("zone", "clearance"),
    [
        (square(300.0, inclusion=True), 50.0),
        (square(200.0, inclusion=True), 0.0),
        (square(301.0, 51.0, inclusion=True), None),
        (CircleZone("inside the ring", 10.0, 20.0, 30.0), 100.0 - 30.0 - hypot(10.0, 20.0)),
        (CircleZone("the ring itself", 0.0, 0.0, 100.0, True), 0.0),
        (CircleZone("beside", 150.0, 0.0, 20.0), 30.0),
        (square(30.0), 100.0 - 15.0 * sqrt(2.0)),
    ],
)
def test_the_hold_is_a_whole_circle(zone, clearance, wind):
    found = checked(held(0.0, 0.0, 100.0, wind), zone)
    if clearance is None:
        assert [breach.holding for breach in found.breaches] == [True]
        assert found.clearance_m == pytest.approx(-0.5, abs=SEARCHED)
        return
    assert found.clear == (clearance > 0.0)
    assert found.clearance_m == pytest.approx(clearance, abs=SEARCHED)


def test_the_hold_is_entered_after_the_time_to_fly_there():
    """From the easternmost point counter-clockwise to the northernmost one: a quarter of the circle."""
    bar = PolygonZone("bar", ((0.0, 90.0), (10.0, 90.0), (10.0, 110.0), (0.0, 110.0)))
    (breach,) = checked(held(0.0, 0.0, 100.0), bar).breaches
    # It enters through the edge at 10 m east.
    assert breach.time_s == pytest.approx((pi / 2.0 - 0.1001674211615598) * 100.0 / 20.0, abs=1e-6)
    assert breach.holding


def test_the_hold_in_wind_takes_its_time():
    """A quarter against a wind from the north, integrated in small steps."""
    bar = PolygonZone("bar", ((-10.0, 90.0), (0.0, 90.0), (0.0, 110.0), (-10.0, 110.0)))
    (breach,) = checked(held(0.0, 0.0, 100.0, Wind(6.0, 0.0)), bar).breaches
    from math import cos, sin

    n = 20_000
    angles = [(k + 0.5) * pi / 2.0 / n for k in range(n)]
    # The wind blows to the south: along the tangent (-sin, cos) it is -6 cos, across it -6 sin.
    speeds = [sqrt(20.0**2 - (6.0 * sin(a)) ** 2) - 6.0 * cos(a) for a in angles]
    assert breach.time_s == pytest.approx(sum(100.0 * pi / 2.0 / n / speed for speed in speeds), abs=1e-6)


def test_a_moving_circle_is_a_disc():
    """It moves north by 5 m/s for one round, 2 pi 100 m at 15 m/s at least, from where it is joined."""
    orbit = Orbit(0.0, 0.0, 100.0, "ccw", 0.0, 5.0)
    m = plan(Pose(100.0, 0.0, 0.0), orbit, UAV)
    end_m = m.orbit_at_join.north_m + 5.0 * 2.0 * pi * 100.0 / 15.0
    for gap, clear in ((1e-3, True), (-1e-3, False)):
        beyond = CircleZone("ahead", 0.0, end_m + 130.0 + gap, 30.0)
        found = checked(m, beyond)
        assert found.clear == clear
        assert found.clearance_m == pytest.approx(gap, abs=SEARCHED)


# Wind: a trochoid whose clearance is known


def test_a_trochoid_over_the_ground():
    """A whole turn to the left at 20 m/s in a wind from the west of 10 m/s is farthest south at its beginning, where it
    heads east, and farthest north half a turn later, 100 m north."""
    round_s = 2.0 * pi * 50.0 / 20.0
    m = path(EAST, ("L", round_s), wind=Wind(10.0, 270.0))
    for north, clearance in ((107.0, 7.0), (100.0, 0.0)):
        beam = PolygonZone("beam", ((-500.0, north), (900.0, north), (900.0, north + 9.0), (-500.0, north + 9.0)))
        found = checked(m, beam)
        assert found.clearance_m == pytest.approx(clearance, abs=2.0 * SEARCHED)
        assert found.clear == (clearance > 0.0)


# Margins


def test_what_is_nearer_than_the_margin_is_a_breach():
    m, mast = path(EAST, ("S", 10.0)), CircleZone("mast", 100.0, 50.0, 30.0)
    assert checked(m, mast, margin=19.9).clear
    near = checked(m, mast, margin=20.0)
    assert not near.clear
    (breach,) = near.breaches
    assert not breach.enters
    assert (breach.east_m, breach.time_s) == pytest.approx((100.0, 5.0), abs=EXACT)
    assert near.sentence() == (
        "The plan comes within 20.0 m of the zone 'mast' in 5.0 s, at 100 m east, 0 m north, "
        "less than the margin of 20 m."
    )


def test_the_margin_is_that_of_guide_by_default():
    assert default_margin_m(Orbit(0.0, 0.0, 80.0)) == LEAST_MARGIN_M
    assert default_margin_m(Orbit(0.0, 0.0, 200.0)) == 10.0
    assert checked(held(0.0, 0.0, 200.0), square(419.9, inclusion=True), margin=None).margin_m == 10.0
    assert not checked(held(0.0, 0.0, 200.0), square(419.9, inclusion=True), margin=None).clear


def test_breaches_are_in_the_order_of_their_times():
    zones = [CircleZone(name, east, 0.0, 5.0) for name, east in (("far", 150.0), ("near", 50.0), ("clear", -90.0))]
    found = checked(path(EAST, ("S", 10.0)), *zones)
    assert [breach.zone.name for breach in found.breaches] == ["near", "far"]
    assert found.sentence() == (
        "The plan enters the zone 'near' in 2.2 s, at 45 m east, 0 m north, by up to 5.0 m; later also 'far'."
    )


# What cannot be used


@pytest.mark.parametrize(
    ("make", "problem"),
    [
        (lambda: Fence(()), "fence has no zones"),
        (lambda: PolygonZone("a", ((0, 0), (9, 0))), "zone 'a' has 2 different corners: a polygon needs 3"),
        (
            lambda: PolygonZone("a", ((0, 0), (9, 0), (0, 0), (9, 0))),
            "crosses or touches itself|has corners on one line",
        ),
        (
            lambda: PolygonZone("a", ((0, 0), (9, 9), (9, 0), (0, 9))),
            "zone 'a' crosses or touches itself at 4.5 m east",
        ),
        (lambda: PolygonZone("a", ((0, 0), (9, 0), (18, 0))), "zone 'a' has corners on one line: it has no area"),
        (lambda: PolygonZone("a", ((0, 0), (9, 0), (float("nan"), 4))), "zone 'a' corner is nan"),
        (lambda: PolygonZone("a", ((0, 0), (9, 0), (1, 2, 3))), "zone 'a' has a corner that is not two numbers"),
        (lambda: CircleZone("a", 0.0, 0.0, 0.0), "zone 'a' radius_m is 0"),
        (lambda: CircleZone("a", float("inf"), 0.0, 1.0), "zone 'a' east_m is inf"),
        (
            lambda: Fence((square(9.0, inclusion=True), CircleZone("far", 99.0, 0.0, 9.0, True))),
            "fence has the inclusion zones 'square' and 'far' with no common point to fly in",
        ),
        (lambda: Fence((1,)), "fence has 1: a zone is a CircleZone or a PolygonZone"),
        (
            lambda: checked(path(EAST, ("S", 1.0)), square(9.0)),
            "pose is inside the zone 'square': a plan must begin outside",
        ),
        (lambda: checked(path(EAST, ("S", 1.0)), CircleZone("a", 1.0, 0.0, 2.0)), "pose is inside the zone 'a'"),
        (
            lambda: checked(path(EAST, ("S", 1.0)), square(9.0, 99.0, inclusion=True)),
            "pose is outside the inclusion zone",
        ),
        (
            lambda: checked(path(EAST, ("S", 1.0)), CircleZone("a", 9.0, 0.0, 2.0, True)),
            "pose is outside the inclusion",
        ),
        (lambda: checked(path(EAST, ("S", 1.0)), square(9.0, 99.0), margin=-1.0), "margin_m is -1"),
    ],
)
def test_bad_input_is_one_sentence(make, problem):
    with pytest.raises(InvalidArgument, match=problem):
        make()


def test_a_closed_outline_and_doubled_corners_are_one_polygon():
    plain = ((0.0, 0.0), (9.0, 0.0), (0.0, 9.0))
    assert PolygonZone("a", (*plain, plain[0])) == PolygonZone("a", plain)
    assert PolygonZone("a", (plain[0], *plain, plain[0])) == PolygonZone("a", plain)
