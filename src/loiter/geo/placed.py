"""A problem and where its local metres lie on the Earth."""

from __future__ import annotations

from typing import NamedTuple

from loiter.geo.frame import LocalFrame
from loiter.planning.problem import Problem


class PlacedProblem(NamedTuple):
    """A problem in local metres, and the frame of those metres; None where no place was given in degrees."""

    problem: Problem
    frame: LocalFrame | None
