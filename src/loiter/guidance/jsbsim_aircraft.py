"""`loiter.guidance.simulators.jsbsim_aircraft` under its former name, which earlier documentation gave."""

from loiter.guidance.simulators.jsbsim_aircraft import JsbsimAircraft, identified_roll

__all__ = ["JsbsimAircraft", "identified_roll"]
