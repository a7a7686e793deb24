"""Numbers of any size at the entries of the library: a finite plan, or a sentence of `loiter.errors`; no warning."""

from math import inf, isfinite, nan

import pytest
from hypothesis import given
from hypothesis import strategies as st

from loiter import (
    Aircraft,
    Leg,
    Orbit,
    Pose,
    Wind,
    candidates,
    hold,
    plan,
    plan_all,
    plan_leg,
)
from loiter.errors import InvalidArgument, LoiterError
from loiter.fences import CircleZone, Fence, PolygonZone

EXTREME = [
    0.0,
    5e-324,
    1e-320,
    1e-200,
    1e-50,
    1e-30,
    1e-9,
    1e-3,
    7500.0,
    1e6,
    1e9,
    1e15,
    1e30,
    1e50,
    1e100,
    1e200,
    1.7e308,
]
NUMBERS = st.one_of(st.sampled_from([*EXTREME, *(-x for x in EXTREME), inf, nan]), st.floats())


def scene(odd):
    """The values of a scene, of which those at some places are odd."""
    usual = [-400.0, 120.0, 90.0, 10.0, -20.0, 150.0, 2.0, -1.0, 18.0, 35.0, 4.0, 250.0, 600.0, 10.0, 30.0, 100.0]
    return [odd.get(i, value) for i, value in enumerate(usual)]


def check(maneuver):
    ends = [(s.duration_s, s.length_m, s.end.east_m, s.end.north_m, s.end.heading_deg) for s in maneuver.segments]
    assert all(map(isfinite, [maneuver.duration_s, maneuver.join.east_m, *(x for end in ends for x in end)]))


def plans(v, limit, moves, windy):
    """What is planned in a scene, one after another."""
    pose, uav = Pose(*v[:3]), Aircraft(v[8], **{limit: v[9]}, climb_rate_m_s=2.5, descent_rate_m_s=2.5)
    orbit, wind = Orbit(*v[3:6], "either", *(v[6:8] if moves else ())), Wind(*v[10:12]) if windy else None
    yield lambda: [plan(pose, orbit, uav, wind)]
    yield lambda: plan_all(pose, orbit, uav, wind)
    yield lambda: candidates(pose, orbit, uav, wind)
    yield lambda: [plan_leg(Leg(pose, orbit, (v[12], v[13]), hold_s=v[14]), uav, wind).entry]
    yield lambda: hold(orbit, uav, wind, turn="cw").at(v[2]) and []
    zones = CircleZone("a", v[12], v[13], v[5]), PolygonZone("b", ((v[12], v[0]), (v[4], v[13]), (v[15], v[14])))
    for zone in zones:
        yield lambda zone=zone: [m for m in [plan(pose, orbit, uav, wind)] if Fence((zone,)).check(m, 5.0)]


@given(
    st.dictionaries(st.integers(0, 15), NUMBERS, min_size=1, max_size=3),
    st.sampled_from(["max_bank_deg", "min_turn_radius_m", "max_turn_rate_deg_s"]),
    st.booleans(),
    st.booleans(),
)
def test_a_plan_is_finite_or_refused(odd, limit, moves, windy):
    try:
        made = list(plans(scene(odd), limit, moves, windy))
    except LoiterError:
        return
    for make in made:
        try:
            for maneuver in make():
                check(maneuver)
        except LoiterError as error:
            sentence = str(error)
            assert "nan" not in sentence.replace(" is nan", "")


@pytest.mark.parametrize("value", [1e51, 1e200, 1.7e308])
def test_sizes_beyond_those_that_are_computed_with_are_refused(value):
    """Shapely warned of an overflow in the area of such a fence."""
    with pytest.raises(InvalidArgument, match="this is too large"):
        PolygonZone("z", ((0.0, 0.0), (value, 0.0), (0.0, value)))
    with pytest.raises(InvalidArgument, match="this is too small"):
        Aircraft(18.0, min_turn_radius_m=1.0 / value)
