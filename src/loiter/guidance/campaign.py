"""`loiter.guidance.trials.campaign` under its former name, which earlier documentation gave."""

from loiter.guidance.trials.campaign import (
    LAWS,
    Outcome,
    Trial,
    campaign,
    kinematic,
    l1,
    nearest_tangent,
    optimal,
    outcome,
    point_mass,
    trials,
    vector_field,
)

__all__ = [
    "LAWS",
    "Outcome",
    "Trial",
    "campaign",
    "kinematic",
    "l1",
    "nearest_tangent",
    "optimal",
    "outcome",
    "point_mass",
    "trials",
    "vector_field",
]
