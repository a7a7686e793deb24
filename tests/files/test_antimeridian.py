"""Cuts at the antimeridian: laws of lines and rings drawn by Hypothesis, and the edges by hand."""

from itertools import pairwise

import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st

from loiter.files.maps.antimeridian import cut_line, cut_ring

LATITUDES = st.floats(-80.0, 80.0)


def wrapped(longitude):
    return (longitude + 180.0) % 360.0 - 180.0


@given(st.floats(-180.0, 180.0), st.lists(st.tuples(st.floats(-100.0, 100.0), LATITUDES), min_size=1, max_size=12))
def test_parts_of_a_line_make_up_the_line(start, moves):
    east, line = start, [(start, 10.0)]
    for step, latitude in moves:
        east += step
        line.append((wrapped(east), latitude))
    parts = cut_line([p[0] for p in line], [p[1] for p in line])
    assert all(len(part) >= 2 and all(-180.0 <= x <= 180.0 for x, _ in part) for part in parts)
    # No part jumps, and together they are as wide as the line.
    width = sum(abs(b[0] - a[0]) for part in parts for a, b in pairwise(part))
    assert width == pytest.approx(sum(abs(step) for step, _ in moves), abs=1e-9)
    for before, after in pairwise(parts):
        assert {abs(before[-1][0]), abs(after[0][0])} == {180.0}
        assert before[-1][1] == after[0][1]


def test_the_last_longitude_before_the_antimeridian_stays_on_the_map():
    ((a, b),) = cut_line([179.99999999999997, 179.99999999999997], [0.0, 1.0])
    assert (abs(a[0]), a[1], abs(b[0]), b[1]) == pytest.approx((180.0, 0.0, 180.0, 1.0), abs=1e-13)
    assert max(abs(a[0]), abs(b[0])) <= 180.0


def test_a_line_that_does_not_cross_is_one_part():
    assert cut_line([179.0, 179.5, 178.0], [1.0, 2.0, 3.0]) == [[(179.0, 1.0), (179.5, 2.0), (178.0, 3.0)]]


def test_a_line_that_crosses_twice_is_three_parts():
    parts = cut_line([179.0, -179.0, 179.0], [0.0, 2.0, 4.0])
    assert parts == [
        [(179.0, 0.0), (180.0, 1.0)],
        [(-180.0, 1.0), (-179.0, 2.0), (-180.0, 3.0)],
        [(180.0, 3.0), (179.0, 4.0)],
    ]


@pytest.mark.parametrize("edge", [180.0, -180.0])
@pytest.mark.parametrize("side", [179.0, -179.0])
def test_a_line_that_touches_the_antimeridian_is_not_left_with_a_point(edge, side):
    parts = cut_line([side, edge, side], [0.0, 1.0, 2.0])
    assert all(len(set(part)) > 1 for part in parts)
    assert {x for part in parts for x, _ in part} == {side, 180.0 if side > 0.0 else -180.0}


@pytest.mark.parametrize("edge", [180.0, -180.0])
def test_a_line_along_the_antimeridian_stays_there(edge):
    (part,) = cut_line([edge, edge], [0.0, 1.0])
    assert [latitude for _, latitude in part] == [0.0, 1.0]
    assert {abs(x) for x, _ in part} == {180.0}


@given(st.floats(-180.0, 180.0), LATITUDES, st.floats(1e-7, 5.0), st.integers(3, 40), st.booleans())
def test_parts_of_a_ring_have_its_area_and_run_counter_clockwise(longitude, latitude, size, sides, clockwise):
    ring = shapely.Point(0.0, latitude).buffer(size, quad_segs=sides).exterior.coords[:: 1 if clockwise else -1]
    parts = cut_ring([wrapped(longitude + x) for x, _ in ring], [y for _, y in ring])
    # Longitudes near 180 have their last digit at 3e-14.
    coarse = 1e-12 * size + 1e-25
    assert sum(shapely.Polygon(part).area for part in parts) == pytest.approx(
        shapely.Polygon(ring).area, abs=16 * coarse, rel=1e-6
    )
    for part in parts:
        assert part[0] == part[-1]
        assert shapely.LinearRing(part).is_ccw
        assert all(-180.0 <= x <= 180.0 for x, _ in part)
