"""
An entry in wind
================

The turns are flown through the moving air, so they are trochoids over the ground. The arrow is the direction of the
wind.
"""

from loiter import Aircraft, Orbit, Pose, Wind, plan
from loiter.plot import draw

uav, orbit = Aircraft(airspeed_m_s=18.0, max_bank_deg=35.0), Orbit(0.0, 0.0, radius_m=120.0)
figure = draw(plan(Pose(-400.0, 120.0, 350.0), orbit, uav, Wind(speed_m_s=8.0, from_deg=250.0)))
