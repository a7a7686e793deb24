"""Landings enumerated independently: places and sides of the circle, points of joining and turns, by OMPL's distances.

`python -m planning.landings 2000` compares random landings in
still air with the plan, and prints by how much the enumeration was sooner at most; `wind` as a second argument takes
the scan of `planning.legs` instead. The circles and altitudes are those of complex numbers here.
"""

import sys
from cmath import exp
from math import radians, tan

import numpy as np

from loiter import Aircraft, Landing, Leg, Orbit, Pose, Runway, Turn, Wind, plan_landing
from planning.legs import SOONER, climb_time, one_way_s

# Places per landing, from the nearest one on, and how far apart in turn radii.
PLACES, APART = 24, 0.37

# Points of joining per turn; the step of the scan asks for fewer.
JOINS = {"ompl": 360, "scan": 24}


def random_landing(random, windy=False):
    """A landing, its aircraft and wind."""
    uav = Aircraft(
        random.uniform(10.0, 30.0), max_bank_deg=random.uniform(20.0, 55.0), climb_rate_m_s=2.0, descent_rate_m_s=3.0
    )
    w = random.uniform(0.02, 0.5) if windy else 0.0
    r, slope = uav.turn_radius_m, random.uniform(1.0, 3.0)
    radius = r * (1.0 + w) ** 2 * random.uniform(1.0 + 1e-9, 3.0)
    final = r * random.uniform(1.0, 10.0)
    runway = Runway(
        *random.uniform(-50.0, 50.0, 2), random.uniform(0.0, 360.0), 200.0, slope, random.uniform(0.0, 20.0)
    )
    # About the final approach, near it or far away, often with little time to come down.
    span = r * random.choice([2.0, 5.0, 20.0])
    near = complex(runway.east_m, runway.north_m) - final * direction(runway)
    place = near + complex(*random.uniform(-span, span, 2))
    exit_m = runway.altitude_m + runway.threshold_height_m + final * tan(radians(slope))
    height = exit_m + 3.0 * random.choice([0.3, 1.0, 3.0]) * random.uniform(-10.0, 60.0)
    pose = Pose(place.real, place.imag, random.uniform(0.0, 360.0), altitude_m=height)
    landing = Landing(pose, runway, radius, final, random.choice(list(Turn)))
    return landing, uav, Wind(w * uav.airspeed_m_s, random.uniform(0.0, 360.0))


def direction(runway):
    """The direction of landing as a complex number, east and north."""
    return 1j * exp(-1j * radians(runway.heading_deg))


def enumerated_s(landing, uav, wind, method="ompl", places=PLACES):
    """The least time over the threshold among places, sides, points of joining and turns, seconds."""
    runway, forward = landing.runway, direction(landing.runway)
    turns = [Turn.CW, Turn.CCW] if landing.turn is Turn.EITHER else [landing.turn]
    times = []
    for place in range(places):
        distance = landing.final_m + place * APART * uav.turn_radius_m
        altitude = runway.altitude_m + runway.threshold_height_m + distance * tan(radians(runway.glide_slope_deg))
        out = complex(runway.east_m, runway.north_m) - distance * forward
        for turn in turns:
            centre = out + landing.radius_m * forward * (-1j if turn is Turn.CW else 1j)
            orbit = Orbit(centre.real, centre.imag, landing.radius_m, turn)
            leg = Leg(landing.pose, orbit, (runway.east_m, runway.north_m), altitude_m=altitude)
            if climb_time(leg, uav) < 1e4:
                times.append(one_way_s(leg, uav, wind, turn is Turn.CW, JOINS[method]))
    return min(times)


def main(landings, windy):
    random, method = np.random.default_rng(5), "scan" if windy else "ompl"
    worst, sooner = 0.0, 0
    for _ in range(landings):
        landing, uav, wind = random_landing(random, windy)
        plan = plan_landing(landing, uav, wind)
        other = enumerated_s(landing, uav, wind, method, PLACES if not windy else 3)
        by = plan.duration_s - other
        worst = max(worst, by / plan.duration_s)
        if by > SOONER[method] * plan.duration_s:
            sooner += 1
            print(f"sooner by {by:.3g} s of {plan.duration_s:.4g}: {landing}, {uav}, {wind}")
    print(f"{landings} landings: the enumeration is sooner in {sooner}, by {worst:.2g} of the time at most")
    return sooner


if __name__ == "__main__":
    sys.exit(main(int(sys.argv[1]), "wind" in sys.argv[2:]) > 0)
