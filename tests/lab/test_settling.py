"""Settling and joining, for constructed flights."""

from math import cos, degrees, pi, sin

import pytest
from hypothesis import given
from hypothesis import strategies as st

from loiter import Orbit, Turn
from loiter.errors import InvalidArgument
from loiter.guidance.circle import Band
from loiter.guidance.protocol import State
from loiter.lab.trials.settling import COUNTED_DEG, SettlingMonitor

STEP = 0.01


def state(t, azimuth, distance=100.0, course_off=0.0, sense=1, moving=(0.0, 0.0)):
    """At a compass azimuth from the centre, `course_off` radians outside the tangent clockwise (sense 1) or the other
    way, at 20 m/s."""
    course = azimuth + sense * (pi / 2 - course_off)
    east, north = 20.0 * sin(course) + moving[0], 20.0 * cos(course) + moving[1]
    place = distance * sin(azimuth) + moving[0] * t, distance * cos(azimuth) + moving[1] * t
    return State(t, *place, degrees(course), 0.0, east, north, 20.0)


def settled_after(states, turn="either", band=Band(), velocity=(0.0, 0.0)):  # noqa: B008
    """The monitor after the last state, or once it has settled."""
    monitor = SettlingMonitor(Orbit(0.0, 0.0, 100.0, turn, *velocity), band)
    for each in states:
        monitor.update(each)
        if monitor.settled:
            break
    return monitor


def turns(n, begin_s=0.0, **how):
    """n turns round the circle, a thousand states each, from an azimuth of 1."""
    sense = how.get("sense", 1)
    return [state(begin_s + STEP * i, 1.0 + sense * 2.0 * pi * i / 1000, **how) for i in range(round(1000 * n) + 1)]


@given(st.floats(-4.9, 4.9), st.floats(-4.9, 4.9), st.sampled_from([1, -1]))
def test_a_full_turn_in_the_band_settles(off_m, off_deg, sense):
    monitor = settled_after(turns(1.01, distance=100.0 + off_m, course_off=off_deg * pi / 180, sense=sense))
    assert monitor.settled
    assert monitor.entered_s == monitor.joined_s == 0.0


@pytest.mark.parametrize("how", [{"distance": 105.2}, {"distance": 94.8}, {"course_off": 0.09}, {"course_off": -0.09}])
def test_outside_the_band_nothing_settles(how):
    assert not settled_after(turns(3, **how)).settled
    assert settled_after(turns(3, **how), band=Band(0.1, 10.0)).settled


def test_less_than_a_turn_is_not_enough():
    assert not settled_after(turns(0.99)).settled


def test_only_the_direction_of_the_orbit_counts():
    assert settled_after(turns(1.1), turn="cw").settled
    assert not settled_after(turns(1.1), turn="ccw").settled
    assert not settled_after(turns(1.1, sense=-1), turn=Turn.CW).settled


def test_an_aircraft_that_leaves_the_band_starts_again():
    half = turns(0.5)
    out = [state(half[-1].time_s + STEP * i, 1.0 + pi, 107.0) for i in range(1, 50)]
    again = turns(1.1, out[-1].time_s + STEP)
    monitor = settled_after(half + out + again)
    assert monitor.settled
    assert monitor.entered_s == pytest.approx(again[0].time_s)
    # 107 m is within twice the band: the aircraft had joined and stayed near the circle.
    assert monitor.joined_s == 0.0
    far = [each._replace(east_m=each.east_m * 1.1, north_m=each.north_m * 1.1) for each in out]
    assert settled_after(half + far + again).joined_s == monitor.entered_s


def test_leaving_the_circle_after_a_full_turn_does_not_change_the_joining():
    first = turns(0.3)
    about = turns(1.01, first[-1].time_s + STEP, distance=107.0)
    out = turns(0.2, about[-1].time_s + STEP, distance=125.0)
    again = turns(1.1, out[-1].time_s + STEP)
    monitor = settled_after(first + about + out + again)
    assert monitor.settled
    assert monitor.joined_s == 0.0
    assert monitor.entered_s == pytest.approx(again[0].time_s)


def loop(begin_s, azimuth):
    """From the circle a turn to the left of 30 m, and back onto it: 200 states."""
    states = []
    for i in range(1, 200):
        left, h = azimuth - 2.0 * pi * i / 200, azimuth + pi / 2 - 2.0 * pi * i / 200
        place = 130.0 * sin(azimuth) - 30.0 * sin(left), 130.0 * cos(azimuth) - 30.0 * cos(left)
        states.append(State(begin_s + STEP * i, *place, degrees(h), 0.0, 20.0 * sin(h), 20.0 * cos(h), 20.0))
    return states


def test_turns_off_the_circle_are_counted_and_those_on_it_are_not():
    half = turns(0.5)
    assert settled_after(half).turned_deg == 0.0
    round_again = loop(half[-1].time_s, 1.0 + pi)
    late = settled_after(half + round_again + turns(1.1, round_again[-1].time_s + STEP))
    # The wide band is left at 10 degrees of tangent, which turns the other way 30 m/100 m as quickly.
    turned_deg = 360.0 - 2.0 * 10.0 / 1.3
    assert turned_deg - 1.9 - COUNTED_DEG < late.turned_deg < turned_deg + 1.9
    blown = [state(half[-1].time_s + STEP * i, 1.0 + pi + 0.006 * i, 125.0) for i in range(1, 101)]
    off = settled_after(half + blown + turns(1.1, blown[-1].time_s + STEP))
    assert degrees(0.6) - COUNTED_DEG < off.turned_deg <= degrees(0.6)


def test_small_turns_in_gusts_are_not_counted():
    there = [state(STEP * i, 1.0, 400.0) for i in range(1885)]
    swaying = [s._replace(heading_deg=90.0 + 4.5 * sin(i / 20)) for i, s in enumerate(there)]
    assert settled_after(swaying).turned_deg == 0.0
    # To the left by 90 degrees and back again, with small turns: two turns.
    weaving = [s._replace(heading_deg=s.heading_deg - 45.0 + 45.0 * cos(i / 300)) for i, s in enumerate(swaying)]
    assert settled_after(weaving).turned_deg == pytest.approx(180.0, abs=20.0)


def test_the_band_moves_with_the_circle():
    velocity = (3.0, -2.0)
    assert settled_after(turns(1.1, moving=velocity), velocity=velocity).settled
    assert not settled_after(turns(1.1, moving=velocity)).settled


@pytest.mark.parametrize("band", [(0.0, 5.0), (0.05, -1.0), (float("nan"), 5.0)])
def test_a_band_must_have_a_width(band):
    with pytest.raises(InvalidArgument, match=r"^(radial|course_deg) is "):
        Band(*band)
