"""What Hypothesis draws: reduced states, radii, sides, scenes in SI; and what rounding does to T."""

from math import atan2, cos, degrees, hypot, pi, sin, sqrt

from hypothesis import strategies as st

from loiter import Aircraft, Orbit, Pose, Turn, Wind
from loiter.kernel.rounding import rounding
from loiter.kernel.words import Side

coordinates = st.one_of(
    st.floats(-4.0, 4.0),
    st.floats(-60.0, 60.0),
    st.sampled_from([0.0, -0.0, 1.0, -1.0, 2.0, -3.0, sqrt(3.0), -sqrt(3.0), 1e-9, -1e-9]),
)
radii = st.one_of(st.floats(1.0, 30.0), st.sampled_from([1.0, 1.0 + 1e-6, 2.0 - 1e-9, 2.0, 2.0 + 1e-9, 3.0]))
sides = st.sampled_from(list(Side))
one_way = st.sampled_from([Side.CW, Side.CCW])
controls = st.sampled_from([-1, 0, 1])

metres = st.floats(-3000.0, 3000.0)
headings = st.one_of(st.floats(-360.0, 720.0), st.sampled_from([0.0, 90.0, 180.0, 270.0, -90.0]))
poses = st.builds(Pose, metres, metres, headings)
aircraft = st.builds(Aircraft, st.floats(8.0, 40.0), max_bank_deg=st.floats(15.0, 60.0))
turns = st.sampled_from(list(Turn))


@st.composite
def scenes(draw: st.DrawFn) -> tuple[Pose, Orbit, Aircraft]:
    """A pose, a circle that the aircraft can hold, and the aircraft."""
    uav = draw(aircraft)
    radius = uav.turn_radius_m * draw(st.floats(1.0, 8.0))
    return draw(poses), Orbit(draw(metres), draw(metres), radius, draw(turns)), uav


@st.composite
def windy_scenes(draw: st.DrawFn, windiest: float = 0.6) -> tuple[Pose, Orbit, Aircraft, Wind]:
    """A scene with a circle that may move, and a wind in which the aircraft can hold it."""
    pose, orbit, uav = draw(scenes())
    velocity = draw(st.one_of(st.just((0.0, 0.0)), st.tuples(st.floats(-15.0, 15.0), st.floats(-15.0, 15.0))))
    past, towards = draw(st.floats(1e-6, windiest)) * uav.airspeed_m_s, draw(st.floats(0.0, 2.0 * pi))
    east, north = velocity[0] + past * sin(towards), velocity[1] + past * cos(towards)
    wind = Wind(hypot(east, north), degrees(atan2(-east, -north)))
    radius = uav.turn_radius_m * (1.0 + past / uav.airspeed_m_s) ** 2 * draw(st.floats(1.0 + 1e-9, 4.0))
    orbit = Orbit(orbit.east_m, orbit.north_m, radius, orbit.turn, *velocity)
    return pose, orbit, uav, wind


def blur(x: float, y: float, R: float) -> float:
    """How far rounding of a state may move T, by theory.

    Switching points lie where circles cross, so next to a place where they touch T moves with the square root of a
    displacement e. For RL and LR that is the circle of radius R - 1 about (0, 1): q = rm^2 - (R - 1)^2 moves by
    2 (R - 1) e, x1 = sqrt(p q)/4 with p = 8 (R + 1) by 2 sqrt((R + 1)(R - 1) e), the angle by that over R - 1.
    Next to the centre of a first arc, (0, 1) or (0, -1), its angle moves by e over the distance from the centre.
    """
    e = rounding(x, y, R)
    touching = sqrt((R + 1.0) * e / (R - 1.0)) if R > 1.0 else 0.0
    turning = e / max(min(hypot(x, y - 1.0), hypot(x, y + 1.0)), e)
    return 4.0 * (sqrt(e) + touching + turning)


def times_of(entry):
    """The durations of the three pieces of an entry of the kernel."""
    return entry.t1, entry.t2, entry.t3
