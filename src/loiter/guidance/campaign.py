"""Former import path of `loiter.guidance.trials.campaign`, given in earlier documentation."""

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
