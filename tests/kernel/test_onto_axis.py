"""Turns onto the axis that lack next to nothing to a full turn."""

from math import pi, sqrt

import pytest

from loiter.kernel.angles import angle
from loiter.kernel.motion import flow
from loiter.kernel.still_air.extremals import onto_axis


@pytest.mark.parametrize("end", [-1.0, 1.0])
@pytest.mark.parametrize("c", [0.1, 0.5, 1.0, 5.0])
def test_a_turn_that_lacks_no_more_than_the_tolerance_is_none(c, end):
    """What it lacks is an arc of the circle that it turns on, of radius sqrt(c^2 + 1) about (0, -1)."""
    lacks = 1e-6
    x, y = flow(end * c, 0.0, 1, lacks)
    arc = lacks * sqrt(c * c + 1.0)
    assert angle(onto_axis(x, y, end, 1.01 * arc)[0]) == 0.0
    assert angle(onto_axis(x, y, end, 0.99 * arc)[0]) == pytest.approx(2.0 * pi - lacks, abs=1e-12)
