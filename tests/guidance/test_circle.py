"""An aircraft relative to a circle, and the band that counts as on it."""

from math import cos, degrees, pi, radians, sin

import pytest

from loiter import Orbit
from loiter.guidance.circle import Band, circle_offset
from loiter.guidance.protocol import State

CIRCLE = Orbit(30.0, -20.0, 80.0, "cw")


def near_circle(azimuth_deg, distance_m, right_deg, side, orbit=CIRCLE, time_s=0.0):
    """A state at 18 m/s that flies to the right of the tangent by an angle."""
    a, o = radians(azimuth_deg), orbit.after(time_s)
    course = a + side * pi / 2.0 + radians(right_deg)
    velocity = o.velocity_east_m_s + 18.0 * sin(course), o.velocity_north_m_s + 18.0 * cos(course)
    place = o.east_m + distance_m * sin(a), o.north_m + distance_m * cos(a)
    return State(time_s, *place, degrees(course), 20.0, *velocity, 18.0)


@pytest.mark.parametrize("orbit", [CIRCLE, Orbit(0.0, 0.0, 80.0, velocity_east_m_s=3.0, velocity_north_m_s=-2.0)])
@pytest.mark.parametrize("side", [1, -1])
@pytest.mark.parametrize(("azimuth_deg", "distance_m", "right_deg"), [(30.0, 84.0, 3.0), (-120.0, 76.0, -2.0)])
def test_the_offset_from_a_circle(orbit, side, azimuth_deg, distance_m, right_deg):
    offset = circle_offset(near_circle(azimuth_deg, distance_m, right_deg, side, orbit, time_s=7.0), orbit)
    seen = offset.outside_m, offset.azimuth_deg, offset.course_error_deg(side), offset.speed_m_s
    assert seen == pytest.approx((distance_m - 80.0, azimuth_deg, right_deg, 18.0))
    # Right of a clockwise tangent is inward.
    assert offset.outward_m_s == pytest.approx(-side * 18.0 * sin(radians(right_deg)))


def test_at_the_centre_the_heading_is_outward():
    offset = circle_offset(near_circle(0.0, 0.0, 0.0, 1), CIRCLE)
    assert (offset.outside_m, offset.out_east, offset.outward_m_s) == pytest.approx((-80.0, 1.0, 18.0))


@pytest.mark.parametrize(
    ("distance_m", "right_deg", "side", "factor", "on"),
    [
        (83.9, 4.9, 1, 1.0, True),
        (76.1, -4.9, -1, 1.0, True),
        (84.1, 0.0, 1, 1.0, False),
        (75.9, 0.0, 1, 1.0, False),
        (80.0, 5.1, 1, 1.0, False),
        (80.0, -5.1, -1, 1.0, False),
        (87.9, 9.9, 1, 2.0, True),
        (80.0, 180.0, 1, 1.0, False),
    ],
)
def test_the_band_has_a_share_of_the_radius_and_an_angle(distance_m, right_deg, side, factor, on):
    offset = circle_offset(near_circle(50.0, distance_m, right_deg, side), CIRCLE)
    assert Band().has(offset, side, factor) == on
    assert not Band().has(offset, -side, factor) or right_deg == 180.0
