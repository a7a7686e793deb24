"""`loiter.min_time` compared with a Hamilton-Jacobi reachability map, which shares no code with the kernel."""

from functools import cache
from itertools import pairwise

import numpy as np
import pytest

from evidence.checks import reachability_check as module
from evidence.checks.reachability import distances, reach
from evidence.checks.reachability_check import compare_with_reachability, reachability_difference
from loiter import Turn, min_time
from loiter.errors import InvalidArgument

# Cells of the coarse grid of the pair that the tests use: 0.1 turn radii between nodes of the finer one at R = 1.
CELLS = 40

# The error is of order 5/6, kinks being smeared by a scheme of order 5: halving the spacing leaves 2^(-5/6) = 0.56.
# On grids as coarse as these the order is still nearer to 1/2, the least that theory knows of: 2^(-1/2) = 0.71.
HALVED = 2.0**-0.5


@pytest.fixture(scope="module", autouse=True)
def _maps_are_computed_once():
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(module, "reach", cache(reach))
        yield


# The paper's problem and wider circles; the program's own maps are these and three more, finer.
@pytest.mark.parametrize(("radius", "turn"), [(1.0, Turn.EITHER), (2.5, Turn.CW), (4.0, Turn.CW)])
def test_every_node_of_the_map_lies_between_its_bounds(radius, turn):
    result = reachability_difference(radius, turn, CELLS)
    assert result.passed
    assert result.nodes > 1000
    # The bounds say something: half of the nodes and more have them within a quarter turn of each other.
    assert result.beside_jumps < 0.5 * result.nodes


def test_the_error_falls_with_the_spacing():
    results = list(compare_with_reachability([CELLS // 2, CELLS], [(1.0, Turn.CW)]))
    assert len(results) == 2
    assert all(r.passed for r in results)
    for coarse, fine in pairwise(results):
        assert fine.error < HALVED * coarse.error
        assert fine.difference < HALVED * coarse.difference


def test_the_grid_s_own_error_covers_what_is_known_exactly():
    """From the axis left of the peel-off, T = -x - X + acos(1/(1+R)); with less time it comes that much less close."""
    R = 1.0
    found = module.reach(R, (1, -1), CELLS)
    half = float(found.x[-1])
    times = np.linspace(0.0, 4.0, 9)
    V = distances(R, (1, -1), half, 2 * CELLS, times)
    far = int(np.flatnonzero(found.x <= -1.9)[-1])
    T = -found.x[far] - np.sqrt(R * (R + 2.0)) + np.arccos(1.0 / (1.0 + R))
    late = times > T
    assert late.any()
    assert np.abs(V[late, far, CELLS]).max() <= found.error


def test_the_map_of_either_direction_has_the_symmetry_of_the_problem():
    found = module.reach(1.0, (1, -1), CELLS)
    time = found.time
    assert np.array_equal(np.isinf(time), np.isinf(time[:, ::-1]))
    # Rounding may move a node to the next instant.
    both = np.isfinite(time)
    assert np.abs(time - time[:, ::-1])[both].max() <= found.step * (1.0 + 1e-6)


def slower(x, y, radius, turn, *tolerance):
    return min_time(x, y, radius, turn, *tolerance) + 1.0


def faster(x, y, radius, turn, *tolerance):
    return 0.9 * min_time(x, y, radius, turn, *tolerance)


def the_other_direction(x, y, radius, turn, *tolerance):
    return min_time(x, y, radius, turn.other, *tolerance)


def either_direction(x, y, radius, turn, *tolerance):
    return min_time(x, y, radius, "either", *tolerance)


def another_circle(x, y, radius, turn, *tolerance):
    return min_time(x, y, radius + 0.5, turn, *tolerance)


def test_a_wrong_map_is_caught(monkeypatch):
    assert reachability_difference(1.0, Turn.CW, CELLS).passed
    for wrong in (slower, faster, the_other_direction, either_direction, another_circle):
        monkeypatch.setattr(module, "min_time", wrong)
        assert not reachability_difference(1.0, Turn.CW, CELLS).passed, wrong


def test_too_few_cells_are_refused_at_once():
    with pytest.raises(InvalidArgument, match="cells is 5"):
        compare_with_reachability([40, 5])
