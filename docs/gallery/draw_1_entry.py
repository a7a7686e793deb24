"""
The fastest entry, and the slower candidates
============================================

Where the aircraft heads for the centre, both directions of holding tie. Grey: the slower extremals.
"""

from loiter import Aircraft, Orbit, Pose, candidates, plan_all
from loiter.plot import draw

uav, orbit = Aircraft(airspeed_m_s=18.0, max_bank_deg=35.0), Orbit(0.0, 0.0, radius_m=80.0)
start = Pose(east_m=-400.0, north_m=120.0, heading_deg=90.0)
best = plan_all(start, orbit, uav)
slower = candidates(start, orbit, uav)[len(best) :]
figure = draw(best, slower)
