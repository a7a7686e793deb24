"""The airframes that fly in six degrees of freedom, each with the properties that a guidance law needs."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

from loiter.guidance.vehicle import Roll
from loiter.lab.simulators.inner_loops import Gains
from loiter.planning.model import Aircraft

MODELS = Path(__file__).parent / "models"


@dataclass(frozen=True)
class Airframe:
    """An airframe of JSBSim: its model, its flight condition, its roll response and the gains of its inner loops.

    `folder` holds the model, in a subfolder of the same name; None for a model of JSBSim's own. `aircraft` has the true
    airspeed and the bank limit, `roll` the response to a commanded bank as identified in the simulation
    (`jsbsim_aircraft.identified_roll`); a law needs both. `altitude_m` is above sea level, which is also ground level.
    """

    model: str
    folder: Path | None
    aircraft: Aircraft
    altitude_m: float
    roll: Roll
    gains: Gains

    def load(self, fdm: Any) -> bool:
        """Load the model into an `FGFDMExec`."""
        if self.folder is None:
            return bool(fdm.load_model(self.model))
        engines = self.folder / self.model / "Engines"
        return bool(fdm.load_model_with_paths(self.model, str(self.folder), str(engines), str(self.folder)))


# The Piper J-3 Cub from JSBSim's package, 439 kg, at 30 m/s: a little below cruise, well above the stall (17 m/s).
J3CUB = Airframe(
    "J3Cub",
    None,
    Aircraft(30.0, max_bank_deg=30.0),
    250.0,
    Roll(0.77, 25.8),
    Gains(
        bank=1.5,
        roll_rate_deg_s=25.0,
        aileron_per_roll=0.87,
        aileron=0.5,
        aileron_integral=0.5,
        rudder_yaw=0.5,
        rudder_slip=2.0,
        climb=0.3,
        climb_rate=0.9,
        elevator=1.5,
        elevator_integral=2.0,
        elevator_load=1.3,
        throttle=0.15,
        throttle_integral=0.02,
        throttle_load=0.15,
    ),
)

# The Aerosonde UAV of Beard and McLain, 11 kg, at 25 m/s as in their examples.
AEROSONDE = Airframe(
    "aerosonde",
    MODELS,
    Aircraft(25.0, max_bank_deg=35.0),
    100.0,
    Roll(0.39, 63.4),
    Gains(
        bank=2.5,
        roll_rate_deg_s=60.0,
        aileron_per_roll=0.332,
        aileron=0.4,
        aileron_integral=0.2,
        rudder_yaw=0.3,
        rudder_slip=1.0,
        climb=0.4,
        climb_rate=1.2,
        elevator=0.6,
        elevator_integral=1.5,
        elevator_load=0.6,
        throttle=0.1,
        throttle_integral=0.02,
        throttle_load=0.02,
    ),
)

AIRFRAMES = {"j3cub": J3CUB, "aerosonde": AEROSONDE}
