"""A problem, and the place on Earth of its local coordinates."""

from __future__ import annotations

from typing import NamedTuple

from loiter.geo.frame import LocalFrame
from loiter.planning.problem import Problem


class PlacedProblem(NamedTuple):
    """A problem in local metres, and their frame, which is None where no place was given in degrees."""

    problem: Problem
    frame: LocalFrame | None
