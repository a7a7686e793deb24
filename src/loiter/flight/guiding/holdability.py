"""Whether a vehicle in flight can hold its circle in the wind that it meets, from what the law has identified.

On a circle of radius r the turn is fastest downwind, where V + w over the ground needs the lateral acceleration
(V + w)^2/r, and the bank limit gives k g tan(limit), with the turn ratio k: their equality is the tightest circle. One
that is tighter than that by a few per cent is left by little, since the vehicle is downwind for a few seconds only.
"""

from __future__ import annotations

from math import atan, degrees, hypot, isnan, nan, radians, tan
from typing import NamedTuple

from loiter.guidance.vehicle import VehicleEstimates
from loiter.kernel.wind.hold import tightest_radius
from loiter.planning.model import radius_at_bank

# A circle is given up once the excess of the tightest radius over its own, as a share of it and beyond the first share,
# has added up to the second number, seconds: after 8 s at 5.5 %, after 4 s at 8 %, after 2 s at 13 %. A larger excess
# counts as that, since one estimate may be wrong. It is forgotten where the circle can be held. A circle that is too
# tight by 5 % is left by 2 m in each turn, at 23 to 25 m/s in 12 m/s of wind, and by 5 m at 8 %.
TOLERATED, GIVEN_UP_S, LARGEST = 0.03, 0.2, 0.13

# The estimates of the first seconds do not count: they still are the first guesses, and a gust may be in them.
FIRST_S = 5.0

# A turn ratio below the first is not believed in still air: for some seconds after a reversal it is lower than later,
# once the slip has settled. On a circle in wind the bank changes all the time and the slip never settles: the bound is
# lower by the second for a wind as fast as the aircraft. A ratio above 1 makes no circle possible.
LEAST_RATIO, UNSETTLED = 0.9, 0.2

# What is not known before the aircraft is downwind is forecast: there its bank grows, and it slips as much as it has at
# its worst, in still air too, within the bound for the present wind. That is forgotten over this time, seconds. Its
# airspeed exceeds that of tight turns by what the latter exceeds its mean, by this share at most: in turbulence more
# than that is chance.
SLIP_MEMORY_S, LARGEST_RISE = 120.0, 0.02

# A warning is given where the tightest circle by that forecast has been wider than the circle for the first time,
# seconds. The circle is given up where it has been wider by this share for the second time, if the aircraft slips: its
# least ratio is below the fourth number; and if the wind is more than the last share of the airspeed.
WARNED_S, FORECAST_S, TOO_TIGHT, SLIPS, WINDY = 2.0, 2.8, 0.02, 0.93, 0.2


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
        V = self.airspeed_m_s
        wider = tightest_radius(self.east_m_s / V, self.north_m_s / V)
        return wider * radius_at_bank(V, self.limit_deg) / self.turn_ratio

    def excess(self, radius_m: float) -> float:
        """By which share of the radius of a circle the tightest one is wider."""
        return self.radius_m / radius_m - 1.0

    def problem(self, radius_m: float) -> str:
        """Why a circle that is too tight cannot be held, and which could be."""
        V, w = self.airspeed_m_s, self.wind_m_s
        if w >= V:
            return f"in a wind of {w:.1f} m/s an aircraft of {V:.1f} m/s can hold no circle"
        bank_deg = degrees(atan(self.radius_m / radius_m * tan(radians(self.limit_deg))))
        return (
            f"in a wind of {w:.1f} m/s, at {V:.1f} m/s and {self.limit_deg:g} degrees of bank, the tightest circle has "
            f"a radius of {self.radius_m:.0f} m; one of {radius_m:g} m needs {bank_deg:.0f} degrees"
        )


class HoldabilityWatch:
    """How long and by how much the circle has been tighter than the tightest one.

    `warning` says that it may be, downwind, by a forecast; empty as long as it is not.
    """

    def __init__(self, radius_m: float, limit_deg: float) -> None:
        self._radius_m, self._limit_deg = radius_m, limit_deg
        self._began = self._last = nan
        self._sum_s = self._warned_s = self._refused_s = 0.0
        self._least_ratio = 1.0
        self.warning = ""

    def problem(self, estimates: VehicleEstimates, now: float) -> str:
        """Process estimates; returns why the circle cannot be held, empty if it can or this is not certain yet."""
        if isnan(self._began):
            self._began = self._last = now
        dt, self._last = now - self._last, now
        if now < self._began + FIRST_S:
            return ""
        wind, V = (estimates.wind_east_m_s, estimates.wind_north_m_s), estimates.turn_airspeed_m_s
        bound, k = LEAST_RATIO - UNSETTLED * min(hypot(*wind) / V, 1.0), estimates.turn_ratio
        self._least_ratio = min(k, self._least_ratio + (k - self._least_ratio) * dt / SLIP_MEMORY_S)
        tightest = Tightest(*wind, V, min(max(k, bound), 1.0), self._limit_deg)
        slipping = tightest._replace(turn_ratio=max(self._least_ratio, bound))
        downwind = self._forecast(slipping, estimates.airspeed_m_s, dt)
        excess = LARGEST if hypot(*wind) >= V else min(tightest.excess(self._radius_m), LARGEST)
        self._sum_s = max(self._sum_s + (excess - TOLERATED) * dt, 0.0)
        if excess > TOLERATED and self._sum_s >= GIVEN_UP_S:
            return tightest.problem(self._radius_m)
        return downwind.problem(self._radius_m) if self._refused_s >= FORECAST_S else ""

    def _forecast(self, slipping: Tightest, airspeed_m_s: float, dt: float) -> Tightest:
        """The forecast for where the aircraft is downwind, from the tightest circle with the least ratio.

        Updates the warning. `airspeed_m_s` is the mean airspeed.
        """
        V = slipping.airspeed_m_s
        rise_m_s = min(max(V - airspeed_m_s, 0.0), LARGEST_RISE * airspeed_m_s)
        downwind = slipping._replace(airspeed_m_s=airspeed_m_s + 2.0 * rise_m_s)
        excess = downwind.excess(self._radius_m) if slipping.wind_m_s < V else 0.0
        self._warned_s = self._warned_s + dt if excess > 0.0 else 0.0
        is_refused = excess > TOO_TIGHT and slipping.turn_ratio < SLIPS and slipping.wind_m_s > WINDY * V
        self._refused_s = self._refused_s + dt if is_refused else 0.0
        if self._warned_s >= WARNED_S:
            self.warning = f"The circle may not be held downwind: {downwind.problem(self._radius_m)}."
        return downwind
