"""A leg beside the collocation in three dimensions; `python -m planning.leg_collocation 50` takes many."""

from dataclasses import replace

import pytest

from loiter import Aircraft, Leg, Orbit, Pose, plan_leg
from planning.leg_collocation import RESOLUTION, collocated_s

UAV = Aircraft(18.0, max_bank_deg=35.0, climb_rate_m_s=2.5)
LEG = Leg(Pose(-400.0, 120.0, 90.0, altitude_m=100.0), Orbit(0.0, 0.0, 120.0, "cw"), (600.0, 0.0), altitude_m=260.0)


def test_no_path_is_sooner_and_one_is_as_soon():
    """By the climb at its rate; and a plan that holds a turn too many is later."""
    plan = plan_leg(LEG, UAV)
    found = collocated_s(LEG, UAV)
    assert found == pytest.approx(plan.duration_s, rel=RESOLUTION)
    late = plan_leg(replace(LEG, turns=plan.held_deg / 360.0 + 1.0), UAV)
    assert found < late.duration_s - 30.0
    # A slower climb takes longer, and the program knows it.
    assert collocated_s(LEG, replace(UAV, climb_rate_m_s=2.0)) > found + 15.0
