"""
A circle that moves
===================

A ship moves at 6 m/s towards the south-east. The circle about it is drawn where it is joined; dashed: at the start.
"""

from loiter import Aircraft, Orbit, Pose, plan
from loiter.plot import draw

uav = Aircraft(airspeed_m_s=18.0, max_bank_deg=35.0)
ship = Orbit(0.0, 0.0, radius_m=120.0, velocity_east_m_s=4.2, velocity_north_m_s=-4.2)
figure = draw(plan(Pose(-400.0, 120.0, 350.0), ship, uav))
