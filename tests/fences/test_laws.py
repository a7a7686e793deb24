"""Laws of the check: rotation, translation, mirror and scale, margins, more zones, paths flown backwards."""

from math import cos, radians, sin

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from fences.scenes import scene
from loiter import Aircraft, Orbit, Pose, Turn, Wind
from loiter.errors import InvalidArgument
from loiter.fences import CircleZone, Fence, PolygonZone
from loiter.fences.pieces import Pieces, flown_path
from loiter.fences.search import TOUCH_M, approach
from loiter.planning.flight import flown_from
from loiter.planning.maneuver import Maneuver
from loiter.planning.model import CONTROLS, Segment

seeds = st.integers(0, 2**32 - 1)
# Checks of fences that are entered search to a micrometre; turning a scene moves it by some rounding more.
SAME_M = 2.0 * TOUCH_M


class Similarity:
    """A map of the plane: scaled, mirrored east to west if asked, turned clockwise, moved."""

    def __init__(self, turned_deg=0.0, moved=(0.0, 0.0), mirrored=False, scale=1.0):
        self.turned_deg, self.moved, self.mirrored, self.scale = turned_deg, moved, mirrored, scale

    def place(self, east, north):
        east = -east if self.mirrored else east
        c, s = cos(radians(self.turned_deg)), sin(radians(self.turned_deg))
        return self.scale * (c * east + s * north) + self.moved[0], self.scale * (c * north - s * east) + self.moved[1]

    def heading(self, deg):
        return (-deg if self.mirrored else deg) + self.turned_deg

    def zone(self, zone):
        if isinstance(zone, CircleZone):
            return CircleZone(
                zone.name, *self.place(zone.east_m, zone.north_m), self.scale * zone.radius_m, zone.inclusion
            )
        return PolygonZone(zone.name, tuple(self.place(*corner) for corner in zone.corners), zone.inclusion)

    def maneuver(self, m):
        """Lengths and speeds are scaled alike, so that times stay."""
        uav = Aircraft(self.scale * m.aircraft.airspeed_m_s, min_turn_radius_m=self.scale * m.aircraft.turn_radius_m)
        wind = Wind(self.scale * m.wind.speed_m_s, self.heading(m.wind.from_deg))
        turn = m.turn.other if self.mirrored else Turn(m.turn)
        pose = start = Pose(*self.place(m.start.east_m, m.start.north_m), self.heading(m.start.heading_deg))
        segments = []
        for s in m.segments:
            letter = {"L": "R", "R": "L", "S": "S"}[s.letter] if self.mirrored else s.letter
            end = flown_from(pose, CONTROLS[letter], self.scale * s.length_m, uav, wind)
            segments.append(Segment(letter, s.start_s, s.duration_s, self.scale * s.length_m, 0.0, pose, end))
            pose = end
        orbit = Orbit(*self.place(m.orbit.east_m, m.orbit.north_m), self.scale * m.orbit.radius_m, turn)
        return Maneuver(start, orbit, uav, turn, tuple(segments), 0.0, wind)


similarities = st.builds(
    Similarity,
    st.floats(0.0, 360.0),
    st.tuples(st.floats(-1e4, 1e4), st.floats(-1e4, 1e4)),
    st.booleans(),
    st.floats(0.5, 2.0),
)


@settings(max_examples=60, deadline=None)
@given(seeds, similarities)
def test_a_scene_that_is_moved_has_the_same_answer(seed, similarity):
    maneuver, fence, margin = scene(np.random.default_rng(seed))
    before = fence.check(maneuver, margin)
    moved = Fence(tuple(map(similarity.zone, fence.zones)))
    after = moved.check(similarity.maneuver(maneuver), similarity.scale * margin)
    assert after.clearance_m == pytest.approx(similarity.scale * before.clearance_m, abs=SAME_M)
    # A zone that is closer to the margin than rounding may be on either side of it.
    assume(all(abs(breach.clearance_m - margin) > 1e-5 for breach in (*before.breaches, before.closest)))
    assert {b.zone.name for b in after.breaches} == {b.zone.name for b in before.breaches}
    for one, other in zip(before.breaches, after.breaches, strict=True):
        if abs(one.clearance_m) > 1e-3 and one.zone.name == other.zone.name:
            assert other.time_s == pytest.approx(one.time_s, abs=1e-3)


@settings(max_examples=60, deadline=None)
@given(seeds, st.floats(0.0, 30.0), st.floats(0.0, 30.0))
def test_a_larger_margin_is_never_easier_to_keep(seed, one, other):
    maneuver, fence, _ = scene(np.random.default_rng(seed))
    small, large = sorted((one, other))
    at_small, at_large = fence.check(maneuver, small), fence.check(maneuver, large)
    assert at_small.clear or not at_large.clear
    assert {b.zone.name for b in at_small.breaches} <= {b.zone.name for b in at_large.breaches}


@settings(max_examples=60, deadline=None)
@given(seeds)
def test_another_zone_never_makes_a_path_clear(seed):
    rng = np.random.default_rng(seed)
    maneuver, fence, margin = scene(rng)
    _, others, _ = scene(rng)
    before = fence.check(maneuver, margin)
    try:
        after = Fence((*fence.zones, *others.zones)).check(maneuver, margin)
    except InvalidArgument:
        return  # the start, or the inclusion zones, do not suit each other
    assert after.clearance_m <= before.clearance_m + SAME_M
    assert before.clear or not after.clear


@settings(max_examples=60, deadline=None)
@given(seeds)
def test_a_path_that_is_flown_backwards_is_as_far_away(seed):
    maneuver, fence, margin = scene(np.random.default_rng(seed))
    path = flown_path(maneuver).pieces
    x, y = path.position(path.duration_s)
    angle = path.u * path.speed * path.duration_s / path.radius
    c, s = path.c * np.cos(angle) - path.s * np.sin(angle), path.s * np.cos(angle) + path.c * np.sin(angle)
    back = Pieces(
        path.start_s, path.duration_s, x, y, -c, -s, -path.u, path.radius, path.speed, -path.wx, -path.wy, path.widen
    )
    for there, here in zip(approach(fence, path, margin), approach(fence, back, margin), strict=True):
        near = np.minimum(there.distance, here.distance)
        decided = (near <= margin) & (near > TOUCH_M)
        assert there.distance[decided] == pytest.approx(here.distance[decided], abs=SAME_M)
        assert ((there.distance <= TOUCH_M) == (here.distance <= TOUCH_M)).all()
        assert there.distance.min(initial=np.inf) == pytest.approx(here.distance.min(initial=np.inf), abs=SAME_M)
