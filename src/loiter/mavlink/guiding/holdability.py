"""Whether a vehicle in flight can hold its circle in the wind that it meets, from what the law has identified.

On a circle of radius r the turn is fastest downwind, where V + w over the ground needs the lateral acceleration
(V + w)^2/r, and the bank limit gives k g tan(limit), with the turn ratio k: their equality is the tightest circle. One
that is tighter than that by a few per cent is left by little, since the vehicle is downwind for a few seconds only.
"""

from __future__ import annotations

from collections import deque
from math import atan, degrees, hypot, radians, tan
from typing import NamedTuple

from loiter.guidance.estimation.vehicle import VehicleEstimates
from loiter.planning.model import radius_at_bank

# Estimates are averaged over this time, seconds: one of them may be wrong.
MEAN_S = 2.0

# A circle counts as impossible to hold if the tightest one is wider by this factor. One that is tighter than the
# tightest by 8 % is left by 4 to 5 m in each turn, at 23 to 25 m/s in 12 m/s of wind, and by 2 m at 5 %. It also covers
# an error of 1 m/s in the wind.
TOO_TIGHT = 1.08

# A turn ratio below this is not believed here: for some seconds after a reversal it is lower than later. One above 1
# makes no circle possible.
LEAST_RATIO = 0.9


class Tightest(NamedTuple):
    """The wind and the true airspeed, metres per second, the turn ratio, and the bank limit, degrees."""

    east_m_s: float
    north_m_s: float
    airspeed_m_s: float
    turn_ratio: float
    limit_deg: float

    @property
    def wind_m_s(self) -> float:
        """The speed of the wind."""
        return hypot(self.east_m_s, self.north_m_s)

    @property
    def radius_m(self) -> float:
        """The radius of the tightest circle that can be held."""
        return radius_at_bank(self.airspeed_m_s + self.wind_m_s, self.limit_deg) / self.turn_ratio

    def problem(self, radius_m: float) -> str:
        """Why a circle cannot be held, and which could be; empty if it can, or hardly not."""
        V, w = self.airspeed_m_s, self.wind_m_s
        if w >= V:
            return f"in a wind of {w:.1f} m/s an aircraft of {V:.1f} m/s can hold no circle"
        if self.radius_m <= TOO_TIGHT * radius_m:
            return ""
        bank_deg = degrees(atan(self.radius_m / radius_m * tan(radians(self.limit_deg))))
        return (
            f"in a wind of {w:.1f} m/s, at {V:.1f} m/s and {self.limit_deg:g} degrees of bank, the tightest circle has "
            f"a radius of {self.radius_m:.0f} m; one of {radius_m:g} m needs {bank_deg:.0f} degrees"
        )


class HoldabilityWatch:
    """The mean of the estimates over the last `MEAN_S` seconds, and what is wrong with the circle in that wind."""

    def __init__(self, radius_m: float, limit_deg: float) -> None:
        self._radius_m, self._limit_deg = radius_m, limit_deg
        self._values: deque[tuple[float, Tightest]] = deque()

    def problem(self, estimates: VehicleEstimates, now: float) -> str:
        """Process estimates; returns why the circle cannot be held, empty if it can or is watched for a short time."""
        k = min(max(estimates.turn_ratio, LEAST_RATIO), 1.0)
        wind, V = (estimates.wind_east_m_s, estimates.wind_north_m_s), estimates.turn_airspeed_m_s
        self._values.append((now, Tightest(*wind, V, k, self._limit_deg)))
        if now - self._values[0][0] < MEAN_S:
            return ""
        while now - self._values[0][0] > MEAN_S:
            self._values.popleft()
        values = [value for _, value in self._values]
        mean = Tightest(*(sum(column) / len(values) for column in zip(*values, strict=True)))
        # The mean still contains what was believed before: what is needed is that of the last estimates.
        return values[-1].problem(self._radius_m) if mean.problem(self._radius_m) else ""
