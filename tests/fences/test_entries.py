"""The first candidate that stays clear of a fence."""

import pytest

from loiter import Aircraft, Orbit, Pose, Wind, candidates
from loiter.errors import InvalidArgument
from loiter.fences import CircleZone, Fence, first_clear

POSE, UAV = Pose(-300.0, -50.0, 40.0), Aircraft(18.0, max_bank_deg=35.0)


@pytest.mark.parametrize("wind", [None, Wind(6.0, 250.0)])
def test_the_first_that_is_clear(wind):
    """A mast on the way of the fastest one: every faster candidate breaches the fence, and this one does not."""
    known = candidates(POSE, Orbit(0.0, 0.0, 100.0), UAV, wind)
    middle = known[0].sample(0.7 * known[0].duration_s)
    fence = Fence((CircleZone("mast", float(middle.east_m[1]), float(middle.north_m[1]), 4.0),))
    found = first_clear(fence, known, 2.0)
    assert found.maneuver in known[1:]
    assert found.check == fence.check(found.maneuver, 2.0)
    assert found.check.clear
    assert found.later_s == pytest.approx(found.maneuver.duration_s - known[0].duration_s)
    faster = [m for m in known if m.duration_s < found.maneuver.duration_s]
    assert not any(fence.check(m, 2.0).clear for m in faster)
    assert found.blocking == ("mast",)
    assert f"joins {found.later_s:.1f} s later: {found.maneuver.word}, " in found.sentence


def test_no_fence_in_the_way():
    known = candidates(POSE, Orbit(0.0, 0.0, 100.0), UAV)
    found = first_clear(Fence((CircleZone("far", 5000.0, 0.0, 9.0),)), known[::-1])
    # Two candidates are equally fast.
    assert found.maneuver in known[:2]
    assert (found.later_s, found.tried) == (0.0, 1)
    assert found.sentence == "The fastest entry is clear."


def test_another_that_is_as_fast():
    known = candidates(POSE, Orbit(0.0, 0.0, 100.0), UAV)
    late = known[0].sample(0.9 * known[0].duration_s)
    found = first_clear(Fence((CircleZone("mast", float(late.east_m[1]), float(late.north_m[1]), 4.0),)), known, 1.0)
    assert found.tried == 2
    assert found.sentence == f"The first candidate that is clear is as fast: {known[1]}"


def test_none_is_clear():
    """A mast on the circle itself blocks whatever joins it."""
    known = candidates(POSE, Orbit(0.0, 0.0, 100.0), UAV)
    found = first_clear(Fence((CircleZone("mast", 100.0, 0.0, 9.0),)), known)
    assert (found.maneuver, found.tried) == (None, len(known))
    blocked = f"'mast' blocks the {len(known)} candidates"
    assert found.sentence == f"No entry found: {blocked}, and no other path was searched."
    with pytest.raises(InvalidArgument, match="maneuvers has none to choose from"):
        first_clear(Fence((CircleZone("mast", 100.0, 0.0, 9.0),)), [])
