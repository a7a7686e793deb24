"""Columns of states in SI: row by row what `plan` gives, and a status where it gives none."""

from math import inf, nan

import numpy as np
import pytest

from loiter import Aircraft, Orbit, Pose, Wind, plan
from loiter.arrays.entries import BLOCK, UNKNOWN, States, entries
from loiter.errors import LoiterError
from loiter.kernel.statuses import Status
from loiter.kernel.words import Side, Word
from loiter.planning.model import SIDES, TURN_LIMITS

LIMITS = {"max_bank_deg": (20.0, 50.0), "min_turn_radius_m": (20.0, 60.0), "max_turn_rate_deg_s": (15.0, 40.0)}
# A local origin beside the circle, and coordinates of a map projection.
ORIGINS = {"local": (0.0, 0.0), "projected": (500_000.0, 5_800_000.0)}


def drawn(count, origin=(0.0, 0.0), limit="max_bank_deg", seed=1):
    """Random rows, every quantity of each its own."""
    random = np.random.default_rng(seed)
    centre = np.asarray(origin)[:, None] + random.uniform(-50.0, 50.0, (2, count))
    far = random.choice([100.0, 400.0, 3000.0], count)
    position = centre + random.uniform(-1.0, 1.0, (2, count)) * far
    heading = np.where(
        random.random(count) < 0.1, random.integers(-8, 8, count) * 90.0, random.uniform(-720, 720, count)
    )
    # Neither the centre nor the circle itself is rare.
    position[:, ::17] = centre[:, ::17]
    airspeed, radius = random.uniform(10.0, 25.0, count), random.uniform(60.0, 300.0, count)
    side = random.choice([Side.CW, Side.CCW, Side.EITHER], count).astype(np.int8)
    return States(*position, heading, *centre, radius, side, airspeed, random.uniform(*LIMITS[limit], count), limit)


def row(states, i):
    """One row as `plan` takes it."""
    one = States(*(v[i].item() if isinstance(v, np.ndarray) else v for v in states))
    turn = {int(side): turn for turn, side in SIDES.items()}[one.side]
    aircraft = Aircraft(one.airspeed_m_s, **{one.limit: one.turn_limit})
    velocity = one.orbit_velocity_east_m_s, one.orbit_velocity_north_m_s
    wind = Wind(one.wind_speed_m_s, one.wind_from_deg)
    return Pose(*one[:3]), Orbit(*one[3:6], turn, *velocity), aircraft, wind, one.tolerance_m


def assert_planned(states, rows):
    """The rows are solved as `plan` solves them."""
    found = entries(states)
    for i in rows:
        pose, orbit, aircraft, wind, tolerance = row(states, i)
        try:
            expected = plan(pose, orbit, aircraft, wind, tolerance_m=tolerance)
        except LoiterError:
            assert found.status[i] != Status.OK
            continue
        assert found.status[i] == Status.OK
        assert Word(found.word[i]).letters == expected.word, (i, pose, orbit, aircraft)
        assert found.side[i] == SIDES[expected.turn]
        assert found.duration_s[i] == pytest.approx(expected.duration_s, rel=1e-9, abs=1e-12)
        pieces = [found.duration_1_s[i], found.duration_2_s[i], found.duration_3_s[i]]
        flown = [segment.duration_s for segment in expected.segments]
        assert pieces == pytest.approx(flown + [0.0] * (3 - len(flown)), rel=1e-9, abs=1e-9)
        size = sum(map(abs, (pose.east_m, pose.north_m, orbit.east_m, orbit.north_m, orbit.radius_m)))
        # The joint lies on the circle; that of a maneuver where it ends, which is off by what the tolerance lets pass.
        join, off = expected.join, 1e-9 * size + tolerance
        assert found.join_east_m[i] == pytest.approx(join.east_m, rel=0.0, abs=off)
        assert found.join_north_m[i] == pytest.approx(join.north_m, rel=0.0, abs=off)
        assert (found.join_heading_deg[i] - join.heading_deg + 180.0) % 360.0 == pytest.approx(180.0, abs=1e-7)
        assert 0.0 <= found.join_heading_deg[i] < 360.0


@pytest.mark.parametrize("origin", ORIGINS.values(), ids=ORIGINS)
@pytest.mark.parametrize("limit", TURN_LIMITS)
def test_every_row_of_its_own_is_solved_as_plan_solves_it(origin, limit):
    assert_planned(drawn(500, origin, limit), range(500))


@pytest.mark.parametrize("origin", ORIGINS.values(), ids=ORIGINS)
@pytest.mark.parametrize("side", Side)
def test_what_all_rows_share_is_one_number(origin, side):
    own = drawn(400, origin)
    shared = own._replace(
        orbit_east_m=origin[0],
        orbit_north_m=origin[1],
        orbit_radius_m=80.0,
        side=side,
        airspeed_m_s=18.0,
        turn_limit=35.0,
    )
    assert_planned(shared, range(400))


def test_rows_beyond_the_first_block_are_solved_too():
    states = drawn(2 * BLOCK + 100)
    found = entries(states)
    late = States(*(v[2 * BLOCK :] if isinstance(v, np.ndarray) else v for v in states))
    for there, here in zip(found, entries(late), strict=True):
        assert there[2 * BLOCK :] == pytest.approx(here, nan_ok=True)


def blown(states, seed=3):
    """The same rows in winds of up to 40 m/s, seldom strong, about circles that move, a quarter of them calm."""
    random, count = np.random.default_rng(seed), len(states.east_m)
    speed, velocity = random.uniform(0.0, 1.0, count) ** 3 * 40.0, random.normal(0.0, 2.0, (2, count))
    speed[::4], velocity[:, ::4] = 0.0, 0.0
    return States(*states[:11], speed, random.uniform(-360.0, 720.0, count), *velocity)


@pytest.mark.parametrize("origin", ORIGINS.values(), ids=ORIGINS)
def test_rows_in_wind_are_solved_as_plan_solves_them(origin):
    assert_planned(blown(drawn(100, origin, seed=4)), range(100))


def test_a_wind_and_a_velocity_that_all_rows_share_are_numbers():
    shared = {"wind_speed_m_s": 5.0, "wind_from_deg": 250.0, "orbit_velocity_east_m_s": -1.0}
    assert_planned(drawn(40)._replace(**shared), range(40))
    # One aircraft and one circle too.
    one = {"orbit_east_m": 5.0, "orbit_north_m": 0.0, "orbit_radius_m": 200.0, "side": 0, "airspeed_m_s": 18.0}
    assert_planned(drawn(40)._replace(turn_limit=35.0, **one, **shared), range(40))


def test_where_no_air_passes_the_circle_the_bytes_are_those_of_still_air():
    states, zero = drawn(300), np.zeros(300)
    still = entries(states)
    calm = entries(states._replace(wind_speed_m_s=zero, wind_from_deg=zero + 77.0, orbit_velocity_east_m_s=zero))
    for one, other in zip(still, calm, strict=True):
        assert one.tobytes() == other.tobytes()
    drifts = entries(states._replace(wind_speed_m_s=5.0, wind_from_deg=270.0, orbit_velocity_east_m_s=5.0))
    assert drifts.join_east_m == pytest.approx(still.join_east_m + 5.0 * still.duration_s, nan_ok=True)
    assert drifts.duration_s.tobytes() == still.duration_s.tobytes()


def test_a_row_in_wind_that_no_maneuver_is_found_for_says_so(monkeypatch):
    code, none = np.zeros(1, dtype=np.int8), np.full(1, nan)
    lost = none, code, np.full((1, 3), nan), code + np.int8(Status.NOT_CONVERGED), code, none, none
    monkeypatch.setattr("loiter.arrays.entries.ufuncs.solve_in_wind", lambda *columns: lost)
    found = entries(drawn(2)._replace(wind_speed_m_s=np.array([0.0, 3.0])))
    assert found.status.tolist() == [Status.OK, Status.NOT_CONVERGED]
    assert np.isnan(found.join_heading_deg).tolist() == [False, True]


@pytest.mark.parametrize("tolerance", [0.0, 0.5])
@pytest.mark.parametrize("wind", [(0.0, 0.0), (4.0, 90.0)])
def test_the_tolerance_is_that_of_plan(tolerance, wind):
    # On the circle the right way round, but for some centimetres.
    beside = np.array([-0.1, -0.05, 0.0, 0.05, 0.1])
    shared = (0.0, 0.0, 80.0, Side.CW, 18.0, 35.0, "max_bank_deg", tolerance, *wind)
    states = States(np.zeros(5), 80.0 + beside, np.full(5, 90.0), *shared)
    assert_planned(states, range(5))
    assert (entries(states).word == Word.EMPTY).sum() == (5 if tolerance else 1)


def test_no_rows_give_no_entries():
    none = np.empty(0)
    assert [
        len(column) for column in entries(States(none, none, none, 0.0, 0.0, 80.0, 0, 18.0, 35.0, "max_bank_deg"))
    ] == [0] * 10


GOOD = {
    "east_m": 90.0,
    "north_m": 60.0,
    "heading_deg": 100.0,
    "orbit_east_m": 0.0,
    "orbit_north_m": 0.0,
    "orbit_radius_m": 80.0,
    "side": 0,
    "airspeed_m_s": 18.0,
    "turn_limit": 35.0,
    "wind_speed_m_s": 0.0,
    "wind_from_deg": 0.0,
    "orbit_velocity_east_m_s": 0.0,
    "orbit_velocity_north_m_s": 0.0,
}
VELOCITY = ("orbit_velocity_east_m_s", "orbit_velocity_north_m_s")
BAD = [
    *(({"wind_speed_m_s": value}, Status.BAD_WIND) for value in (nan, inf, -1.0)),
    *(({"wind_from_deg": value}, Status.BAD_WIND) for value in (nan, -inf)),
    *(({name: value}, Status.BAD_ORBIT) for name in VELOCITY for value in (nan, inf)),
    *(({"wind_speed_m_s": value}, Status.WIND_TOO_STRONG) for value in (18.0, 30.0)),
    ({"orbit_velocity_north_m_s": -30.0}, Status.WIND_TOO_STRONG),
    ({"wind_speed_m_s": 1e300, "orbit_velocity_east_m_s": 1e300}, Status.WIND_TOO_STRONG),
    ({"wind_speed_m_s": 8.0}, Status.NOT_HELD),
    ({"wind_speed_m_s": 8.0, "orbit_radius_m": 40.0}, Status.RADIUS_TOO_SMALL),
    ({"wind_speed_m_s": 3.0, "east_m": 1e30}, Status.OUT_OF_RANGE),
    ({"wind_speed_m_s": 3.0, "heading_deg": nan}, Status.BAD_POSE),
    ({"wind_speed_m_s": 3.0, "side": UNKNOWN}, Status.BAD_TURN),
    ({"wind_speed_m_s": 3.0, "airspeed_m_s": nan}, Status.BAD_AIRCRAFT),
    *(({name: value}, Status.BAD_POSE) for name in ("east_m", "north_m", "heading_deg") for value in (nan, inf, -inf)),
    *(({name: value}, Status.BAD_ORBIT) for name in ("orbit_east_m", "orbit_north_m") for value in (nan, inf)),
    *(({"orbit_radius_m": value}, Status.BAD_ORBIT) for value in (nan, inf, 0.0, -80.0)),
    *(({"airspeed_m_s": value}, Status.BAD_AIRCRAFT) for value in (nan, inf, 0.0, -18.0, 1e200, 1e-200)),
    *(({"turn_limit": value}, Status.BAD_AIRCRAFT) for value in (nan, inf, 0.0, -35.0, 90.0, 120.0, 200.0, 395.0)),
    ({"side": UNKNOWN}, Status.BAD_TURN),
    ({"orbit_radius_m": 40.0}, Status.RADIUS_TOO_SMALL),
    ({"east_m": 1e30}, Status.OUT_OF_RANGE),
    ({"orbit_radius_m": 1e30}, Status.OUT_OF_RANGE),
    ({"east_m": 1e308, "orbit_east_m": -1e308}, Status.OUT_OF_RANGE),
    ({"airspeed_m_s": nan, "side": UNKNOWN, "east_m": nan}, Status.BAD_AIRCRAFT),
]


@pytest.mark.parametrize(("changes", "status"), BAD, ids=[str(changes) for changes, _ in BAD])
def test_a_bad_row_gets_its_status_and_spoils_no_neighbour(changes, status):
    columns = {name: np.array([value, changes.get(name, value), value]) for name, value in GOOD.items()}
    found = entries(States(**columns | {"side": columns["side"].astype(np.int8)}, limit="max_bank_deg"))
    assert found.status.tolist() == [Status.OK, status, Status.OK]
    for name, column in found._asdict().items():
        assert column[0] == column[2]
        if name in ("word", "side"):
            assert column[1] == 0
        elif name != "status":
            assert np.isnan(column[1])


def test_an_aircraft_so_slow_that_its_times_are_not_numbers_is_out_of_range():
    one = np.ones(1)
    states = States(one, one, one, 0.0, 0.0, 80.0, 0, 1e-308, 50.0, "min_turn_radius_m")
    assert entries(states).status.tolist() == [Status.OUT_OF_RANGE]
