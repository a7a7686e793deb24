"""Former import path of `loiter.guidance.simulators.jsbsim_aircraft`, given in earlier documentation."""

from loiter.guidance.simulators.jsbsim_aircraft import JsbsimAircraft, identified_roll

__all__ = ["JsbsimAircraft", "identified_roll"]
