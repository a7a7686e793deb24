"""The L1 loiter law: the demands of its publications, by hand. Symmetry and settling: `test_following`."""

from math import atan, degrees, pi, radians, tan

import pytest

from guidance.circling import state_of
from loiter import Aircraft, Orbit
from loiter.guidance.protocol import Phase
from loiter.lab.rivals.l1 import L1, advised_period_s
from loiter.planning.compass import heading_vector
from loiter.planning.model import STANDARD_GRAVITY_M_S2

UAV = Aircraft(20.0, max_bank_deg=45.0)


def at(east, north, heading_deg):
    return state_of(0.0, east, north, *heading_vector(heading_deg), UAV)


# K V^2 sin(nu)/L1 with K = 4 damping^2 and L1 = damping T V/pi is 4 pi damping V sin(nu)/T: with V = 20 m/s, T = 15 s
# and damping 0.75 it is 4 pi sin(nu). w = 2 pi/15.
W = 2.0 * pi / 15.0
BY_HAND = {
    # 400 m west of the centre, which is 30 degrees to the right of the course.
    "capture": ("cw", -400.0, 0.0, 60.0, 4.0 * pi * 0.5, Phase.RIGHT),
    # ... 100 degrees to the left of it, which counts as 90.
    "capture, turned away": ("ccw", -400.0, 0.0, 190.0, -4.0 * pi, Phase.LEFT),
    # 10 m outside and along the circle: w^2 10 + V^2/110, less than 4 pi.
    "circle": ("cw", 0.0, 110.0, 90.0, W * W * 10.0 + 400.0 / 110.0, Phase.RIGHT),
    # 4 m inside, outbound by 0.5 m/s or so: held.
    "circle, inside": ("ccw", 0.0, 96.0, 270.0, W * W * 4.0 - 400.0 / 96.0, Phase.HOLD),
    # 50 m inside, outbound at 10 m/s and the wrong way round at 10 sqrt(3): w^2 (-50) + 1.5 w 10 < 0 counts as none,
    # and what is left is the square of that speed over half the radius.
    "circle, the wrong way": ("cw", 50.0, 0.0, 30.0, 300.0 / 50.0, Phase.RIGHT),
}


@pytest.mark.parametrize(("turn", "east", "north", "heading", "right", "phase"), BY_HAND.values(), ids=list(BY_HAND))
def test_it_demands_what_the_publications_say(turn, east, north, heading, right, phase):
    command = L1(Orbit(0.0, 0.0, 100.0, turn), UAV, period_s=15.0).step(at(east, north, heading), 0.1)
    bank = max(min(degrees(atan(right / STANDARD_GRAVITY_M_S2)), 45.0), -45.0)
    assert command.bank_deg == pytest.approx(bank, abs=1e-9)
    # The rate of a coordinated turn, g tan(bank)/V.
    assert radians(command.turn_rate_deg_s) == pytest.approx(STANDARD_GRAVITY_M_S2 * tan(radians(bank)) / 20.0)
    assert (command.phase, command.turn) == (phase, turn)


def test_it_keeps_its_side_while_it_flies_away():
    # ArduPilot's `_prevent_indecision`: within 18 degrees of straight away, first on one side, then on the other.
    law = L1(Orbit(0.0, 0.0, 100.0, "cw"), UAV)
    first = law.step(at(500.0, 0.0, 100.0), 0.1)
    assert first.bank_deg > 0.0
    assert law.step(at(500.0, 0.0, 80.0), 0.1).bank_deg == pytest.approx(first.bank_deg)
    assert L1(law.orbit, UAV).step(at(500.0, 0.0, 80.0), 0.1).bank_deg < 0.0
    assert law.step(at(500.0, 0.0, 70.0), 0.1).bank_deg < 0.0


def test_the_period_grows_with_the_lag():
    assert advised_period_s(0.2) == 10.0
    assert advised_period_s(1.5) == pytest.approx(15.0 * pi)
