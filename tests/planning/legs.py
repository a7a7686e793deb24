"""Legs enumerated independently: points of joining, directions and turns, with OMPL's distances or a scan in wind.

`python -m planning.legs 5000` compares random legs in still
air with the plan, and prints by how much the enumeration was sooner at most and later in the median; `wind` as a second
argument takes legs in wind.
"""

import sys
from cmath import exp, phase, rect
from math import acos, asin, cos, sqrt, tau

import numpy as np

from evidence.checks.oracle import Circle, Search, from_compass
from evidence.checks.wind_scan import DriftingCircle, first_times
from loiter import Aircraft, Leg, Orbit, Pose, Turn, Wind, plan_leg

# Points of joining per turn; between two of them the plan may be sooner than the enumeration, never later.
JOINS = 360

# Of the time: OMPL takes arcs of up to 1e-6 turn radii short of a full turn for none; the scan's roots are straight
# lines between two times.
SOONER = {"ompl": 1e-5, "scan": 1e-4}

# Seconds (of flight of a turn radius) between two times of the scan.
STEP = 0.01


def random_leg(random, windy=False):
    """A leg, its aircraft and wind."""
    uav = Aircraft(
        random.uniform(10.0, 30.0), max_bank_deg=random.uniform(20.0, 55.0), climb_rate_m_s=2.0, descent_rate_m_s=3.0
    )
    w = random.uniform(0.02, 0.6) if windy else 0.0
    radius = uav.turn_radius_m * (1.0 + w) ** 2 * (1.0 + random.choice([0.0, random.exponential(1.0)]) + 1e-9)
    span = radius * random.choice([1.0, 2.0, 6.0])
    pose = Pose(*random.uniform(-span, span, 2), random.uniform(0.0, 360.0), altitude_m=100.0)
    orbit = Orbit(*random.uniform(-50.0, 50.0, 2), radius, random.choice(list(Turn)))
    out = rect(radius * random.uniform(1.0, 6.0), random.uniform(0.0, tau)) + complex(orbit.east_m, orbit.north_m)
    needs = {}
    if random.random() < 0.5:
        needs["hold_s"] = random.uniform(0.0, 90.0)
    if random.random() < 0.3:
        needs["turns"] = float(random.integers(1, 4))
    if random.random() < 0.5:
        needs["altitude_m"] = 100.0 + random.uniform(-200.0, 200.0)
    wind = Wind(w * uav.airspeed_m_s, random.uniform(0.0, 360.0))
    return Leg(pose, orbit, (out.real, out.imag), **needs), uav, wind


def enumerated_s(leg, uav, wind, joins=JOINS):
    """The least time at the point flown to, among points of joining round the circle, seconds."""
    ways = [Turn.CW, Turn.CCW] if leg.orbit.turn is Turn.EITHER else [leg.orbit.turn]
    return min(one_way_s(leg, uav, wind, turn is Turn.CW, joins) for turn in ways)


def one_way_s(leg, uav, wind, clockwise, joins):
    r, v = uav.turn_radius_m, uav.airspeed_m_s
    way, R = -1 if clockwise else 1, leg.orbit.radius_m / r
    w = complex(*wind.velocity_m_s) / v
    target = complex(leg.exit_to[0] - leg.orbit.east_m, leg.exit_to[1] - leg.orbit.north_m) / r
    exit_azimuth = phase(target) - way * acos(min(R / abs(target), 1.0))
    start = from_compass(
        (leg.pose.east_m - leg.orbit.east_m) / r, (leg.pose.north_m - leg.orbit.north_m) / r, leg.pose.heading_deg
    )
    climb_s = climb_time(leg, uav)
    # Angles held: enough for the turns, the hold and the altitude, and a turn more.
    angles, held = hold_times(
        exit_azimuth, way, w, np.arange(0.0, angle_enough(leg, climb_s, R, abs(w), v / r), tau / joins), R
    )
    enough = (angles >= tau * leg.turns - 1e-9) & (held * r / v >= leg.hold_s)
    angles, held = angles[enough], held[enough]
    times = join_times(start, R, clockwise, w, exit_azimuth - way * angles)
    total_s = (times + held) * r / v
    late = total_s >= climb_s
    straight = sqrt(max(abs(target) ** 2 - R * R, 0.0)) / ground_speed(exit_azimuth, way, w)
    return float(total_s[late].min()) + straight * r / v


def climb_time(leg, uav):
    if leg.altitude_m is None:
        return 0.0
    climb = leg.altitude_m - leg.pose.altitude_m
    return climb / uav.climb_rate_m_s if climb > 0.0 else -climb / uav.descent_rate_m_s


def angle_enough(leg, climb_s, R, w, per_s):
    fastest = (1.0 + w) / R * per_s
    return max(leg.hold_s * fastest, tau * leg.turns, climb_s * fastest) + tau


def ground_speed(azimuth, way, w):
    """Of a hold at an azimuth, by the wind triangle, over the airspeed."""
    track = exp(1j * azimuth) * way * 1j
    across = (w * track.conjugate()).imag
    return cos(asin(across)) + (w * track.conjugate()).real


def hold_times(last, way, w, angles, R):
    """The angles and the times that they are held, before the azimuth `last`, by Simpson's rule."""
    half = np.linspace(0.0, angles[-1], 8 * (len(angles) - 1) + 1)
    track = np.exp(1j * (last - way * half)) * way * 1j
    across, along = (w * track.conjugate()).imag, (w * track.conjugate()).real
    slowness = R / (np.sqrt(1.0 - across**2) + along)
    h = half[1] - half[0]
    pairs = h / 3.0 * (slowness[:-2:2] + 4.0 * slowness[1:-1:2] + slowness[2::2])
    return angles, np.concatenate([[0.0], np.cumsum(pairs)])[::4]


def join_times(start, R, clockwise, w, azimuths):
    """The first time at each azimuth."""
    turn = azimuths[:JOINS] if len(azimuths) > JOINS else azimuths
    if w == 0.0:
        search, circle = Search(1.0), Circle(R, clockwise)
        origin, goal = search.state(start), search.space.allocState()
        found = []
        for azimuth in turn:
            search.place(goal, circle.join(azimuth))
            found.append(search.space.distance(origin, goal))
        found = np.array(found)
    else:
        circle = DriftingCircle(R, clockwise, w.real, w.imag)
        found = np.concatenate([first_times(start, circle, np.array([azimuth]), STEP) for azimuth in turn])
    return np.resize(found, len(azimuths))


def main(legs, windy):
    random, method = np.random.default_rng(11), "scan" if windy else "ompl"
    sooner, later = [], []
    for _ in range(legs):
        leg, uav, wind = random_leg(random, windy)
        planned = plan_leg(leg, uav, wind).duration_s
        other = enumerated_s(leg, uav, wind)
        sooner.append((planned - other) / planned)
        later.append(other - planned)
        if sooner[-1] > SOONER[method]:
            print(f"sooner by {planned - other:.3g} s of {planned:.4g}: {leg}, {uav}, {wind}")
    soonest, median_s = max(sooner), np.median(later)
    print(f"{legs} legs: the enumeration is sooner by {soonest:.2g} of the time at most, later by {median_s:.2g} s")
    return sum(share > SOONER[method] for share in sooner)


if __name__ == "__main__":
    sys.exit(main(int(sys.argv[1]), "wind" in sys.argv[2:]) > 0)
