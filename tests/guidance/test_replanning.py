"""When the law adopts a new plan in flight, in still air."""

import pytest

from guidance.circling import state_of
from loiter import Aircraft, Orbit, Pose, plan
from loiter.guidance.entry.loiter_entry import LoiterEntry
from loiter.guidance.protocol import Phase
from loiter.planning.compass import heading_vector

UAV, ORBIT = Aircraft(18.0, max_bank_deg=35.0), Orbit(0.0, 0.0, 80.0, "cw")


def stepped(law, time_s, pose):
    return law.step(state_of(time_s, pose.east_m, pose.north_m, *heading_vector(pose.heading_deg), UAV), 0.1)


@pytest.mark.parametrize("off_m", [-0.5, 0.5])
def test_in_still_air_the_same_plan_is_updated_from_the_present_state(off_m):
    """On the first turn: the switch moves with the measured position, even where that makes the plan no faster."""
    start = Pose(-400.0, 120.0, 200.0)
    law, first = LoiterEntry.exact(ORBIT, UAV), plan(start, ORBIT, UAV).segments[0]
    command = stepped(law, 0.0, start)
    assert command.next_in_s == pytest.approx(first.duration_s)
    there = plan(start, ORBIT, UAV).sample(step_s=1.0)
    found = Pose(there.east_m[1] + off_m, there.north_m[1], there.heading_deg[1])
    command = stepped(law, 1.0, found)
    anew = plan(found, ORBIT, UAV)
    assert command.phase == {"L": Phase.LEFT, "R": Phase.RIGHT}[first.letter]
    assert command.next_in_s == pytest.approx(anew.segments[0].duration_s, abs=1e-9)
    assert command.time_to_join_s == pytest.approx(anew.duration_s, abs=1e-9)
