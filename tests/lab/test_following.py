"""Properties of all circle-following laws: mirror symmetry, settling, lost data, refused arguments."""

from itertools import count
from math import inf, isfinite, nan

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from guidance.circling import next_state, settled_s, state_of
from guidance.mirrors import FOLLOWERS, mirrored_command, mirrored_orbit, mirrored_state, states
from loiter import Aircraft, Orbit, Pose, Turn, Wind, plan
from loiter.errors import InvalidArgument, RadiusTooSmall, WindTooStrong
from loiter.guidance.protocol import Phase, State
from loiter.lab.rivals.l1 import L1
from loiter.lab.rivals.tangent import Tangent
from loiter.lab.rivals.vector_field import VectorField
from loiter.planning.compass import heading_vector
from strategies import poses

UAV = Aircraft(20.0, max_bank_deg=45.0)


def at(east, north, heading_deg):
    return state_of(0.0, east, north, *heading_vector(heading_deg), UAV)


@pytest.mark.parametrize("name", FOLLOWERS)
@given(states(UAV), st.sampled_from([Turn.CW, Turn.CCW]))
def test_a_mirrored_state_gets_the_mirrored_command(name, state, turn):
    orbit = Orbit(120.0, -50.0, 130.0, turn)
    command = FOLLOWERS[name](orbit, UAV).step(state, 0.1)
    mirrored = FOLLOWERS[name](mirrored_orbit(orbit), UAV).step(mirrored_state(state), 0.1)
    assert mirrored == pytest.approx(mirrored_command(command), abs=1e-6, nan_ok=True)


@pytest.mark.parametrize("name", FOLLOWERS)
@pytest.mark.parametrize("wind", [Wind(0.0, 0.0), Wind(6.0, from_deg=250.0)], ids=["still air", "wind"])
@settings(max_examples=12, deadline=None)
@given(poses.filter(lambda pose: max(abs(pose.east_m), abs(pose.north_m)) < 900.0), st.sampled_from(list(Turn)))
def test_it_settles(name, wind, pose, turn):
    orbit = Orbit(0.0, 0.0, 150.0, turn)
    law = FOLLOWERS[name](orbit, UAV, wind)
    settled = settled_s(law, pose, UAV, wind.velocity_m_s)
    assert isfinite(settled)
    # None is faster than the fastest entry, except for the width of the band: 5 degrees of the circle and 7.5 m.
    assert settled >= plan(pose, Orbit(0.0, 0.0, 150.0, law.turn), UAV, wind).duration_s - 8.0


@pytest.mark.parametrize("name", FOLLOWERS)
def test_it_settles_about_a_moving_circle(name):
    # The centre moves east at 5 m/s, and the law knows its velocity.
    orbit = Orbit(0.0, 0.0, 150.0, "cw", velocity_east_m_s=5.0)
    assert isfinite(settled_s(FOLLOWERS[name](orbit, UAV), Pose(-500.0, 100.0, 200.0), UAV))


@pytest.mark.parametrize("name", FOLLOWERS)
@pytest.mark.parametrize("field", State._fields)
def test_without_data_the_last_bank_is_kept(name, field):
    law = FOLLOWERS[name](Orbit(0.0, 0.0, 100.0), UAV)
    good = at(-300.0, 40.0, 20.0)
    blind = law.step(good._replace(**{field: nan}), 0.1)
    assert (blind.bank_deg, blind.phase) == (0.0, Phase.NO_DATA)
    command = law.step(good, 0.1)
    later = next_state(good, command.bank_deg, UAV)
    blind = law.step(later._replace(**{field: nan}), 0.1)
    assert (blind.bank_deg, blind.phase) == (command.bank_deg, Phase.NO_DATA)
    assert law.step(later, 0.1).phase != Phase.NO_DATA


@pytest.mark.parametrize("name", FOLLOWERS)
@pytest.mark.parametrize("field", State._fields)
@pytest.mark.parametrize("value", [1e300, -1e300])
def test_implausible_data_are_ignored(name, field, value):
    """With a moving circle held in either direction: an implausible state must not choose the direction."""
    orbit, good = Orbit(0.0, 0.0, 100.0, velocity_east_m_s=3.0), at(-300.0, 40.0, 20.0)
    law, twin = FOLLOWERS[name](orbit, UAV), FOLLOWERS[name](orbit, UAV)
    assert law.step(good._replace(**{field: value}), 0.1)[1:3] == (0.0, Phase.NO_DATA)
    command = law.step(good, 0.1)
    assert command == pytest.approx(twin.step(good, 0.1), nan_ok=True)
    assert law.step(good._replace(**{field: value}), 0.1).bank_deg == command.bank_deg


@pytest.mark.parametrize("name", FOLLOWERS)
@pytest.mark.parametrize("wrong_s", [1.7e9, -1.7e9])
@pytest.mark.parametrize("wind", [Wind(0.0, 0.0), Wind(6.0, from_deg=250.0)], ids=["still air", "wind"])
def test_one_wrong_time_stamp_costs_little(name, wrong_s, wind, monkeypatch):
    """With a moving circle, which is elsewhere by that clock: the law steers towards it for one step only."""
    orbit, start = Orbit(0.0, 0.0, 150.0, "cw", velocity_east_m_s=5.0), Pose(-500.0, 100.0, 200.0)
    usual_s = settled_s(FOLLOWERS[name](orbit, UAV, wind), start, UAV, wind.velocity_m_s)
    law, steps = FOLLOWERS[name](orbit, UAV, wind), count()
    step = law.step
    monkeypatch.setattr(law, "step", lambda s, dt: step(s._replace(time_s=wrong_s) if next(steps) == 30 else s, dt))
    assert settled_s(law, start, UAV, wind.velocity_m_s) < usual_s + 5.0


@pytest.mark.parametrize("name", FOLLOWERS)
@pytest.mark.parametrize("dt", [nan, inf, 0.0, -0.1])
def test_a_step_must_be_positive_and_finite(name, dt):
    law, twin = FOLLOWERS[name](Orbit(0.0, 0.0, 100.0), UAV), FOLLOWERS[name](Orbit(0.0, 0.0, 100.0), UAV)
    good = at(-300.0, 40.0, 20.0)
    with pytest.raises(InvalidArgument, match=r"^dt is"):
        law.step(good, dt)
    assert law.step(good, 0.1) == pytest.approx(twin.step(good, 0.1), nan_ok=True)


@pytest.mark.parametrize("name", FOLLOWERS)
def test_a_circle_that_cannot_be_held_is_refused(name):
    with pytest.raises(RadiusTooSmall, match="tighter than the aircraft can turn"):
        FOLLOWERS[name](Orbit(0.0, 0.0, 40.0), UAV)
    with pytest.raises(WindTooStrong):
        FOLLOWERS[name](Orbit(0.0, 0.0, 400.0), UAV, Wind(21.0, 0.0))


def test_the_chosen_direction_is_that_of_the_fastest_entry():
    pose = Pose(-400.0, 120.0, 90.0)
    for name in ("L1", "vector field"):
        law = FOLLOWERS[name](Orbit(0.0, 0.0, 100.0), UAV)
        turn = law.step(at(-400.0, 120.0, 90.0), 0.1).turn
        assert turn == plan(pose, law.orbit, UAV).turn


@pytest.mark.parametrize(
    ("law", "gains"),
    [
        (L1, {"period_s": 0.0}),
        (L1, {"damping": nan}),
        (Tangent, {"reserve": -0.1}),
        (Tangent, {"lead_s": nan}),
        (VectorField, {"gains": (1.0, 0.0, 1.0)}),
    ],
)
def test_gains_are_checked(law, gains):
    with pytest.raises(InvalidArgument, match=r"it must be"):
        law(Orbit(0.0, 0.0, 100.0), UAV, **gains)
