"""
The certificate of an entry
===========================

Over time: the control u, the switching function phi, whose sign is that of u, and the adjoint psi.
"""

from loiter import Aircraft, Orbit, Pose, plan
from loiter.certificate import certify
from loiter.plot.certificate import draw

uav, orbit = Aircraft(airspeed_m_s=18.0, max_bank_deg=35.0), Orbit(0.0, 0.0, radius_m=80.0)
figure = draw(certify(plan(Pose(east_m=-400.0, north_m=120.0, heading_deg=90.0), orbit, uav)))
