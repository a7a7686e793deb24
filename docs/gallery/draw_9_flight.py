"""
A flight in gusts
=================

The guidance law, and the law of ArduPlane, from one start, in gusts of 5 % of the airspeed; below, the bank and the
reported time to join.
"""

from loiter import Aircraft, Orbit, Pose, plan
from loiter.guidance import LoiterEntry
from loiter.lab.picture import draw
from loiter.lab.rivals.l1 import L1
from loiter.lab.simulators.point_mass import PointMass
from loiter.lab.trials.flight import fly

uav, orbit = Aircraft(airspeed_m_s=18.0, max_bank_deg=35.0), Orbit(0.0, 0.0, radius_m=80.0, turn="cw")
start = Pose(east_m=-300.0, north_m=-150.0, heading_deg=30.0)
laws = {"optimal": LoiterEntry(orbit, uav), "l1": L1(orbit, uav, period_s=15.0)}
flights = {name: fly(law, PointMass(start, uav, seed=1), orbit) for name, law in laws.items()}
figure = draw(plan(start, orbit, uav), flights, conditions="point mass, gusts 0.05 of the airspeed, seed 1")
