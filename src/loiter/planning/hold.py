"""Holding the circle in wind: bank, heading and ground speed at every azimuth (docs/wind.md, section 2)."""

from __future__ import annotations

from dataclasses import dataclass
from math import pi
from typing import TYPE_CHECKING, NamedTuple

from loiter.errors import InvalidArgument, number, positive
from loiter.kernel.wind.hold import hold_pose, hold_rate, phase_of
from loiter.planning.compass import heading_of, heading_vector, wrapped
from loiter.planning.flight import over_ground
from loiter.planning.model import (
    CALM,
    SIDES,
    Aircraft,
    Orbit,
    Turn,
    TurnName,
    Wind,
    check_held,
    radius_in_turns,
    relative_wind,
)

if TYPE_CHECKING:
    from numpy import float64
    from numpy.typing import NDArray

# A finer step round the circle would take seconds and add no information.
FINEST_DEG = 1e-3

# Phases (`kernel.wind.hold`) at which the aircraft heads into the relative wind, and away from it.
UPWIND, DOWNWIND = 0.0, pi


class HoldPoint(NamedTuple):
    """The state of flight that holds the circle at one azimuth. Angles in compass degrees, bank towards the centre."""

    azimuth_deg: float
    heading_deg: float
    track_deg: float
    ground_speed_m_s: float
    bank_deg: float


class Round(NamedTuple):
    """The points all round the circle: five float64 arrays of one length; azimuths from 0 to below 360."""

    azimuth_deg: NDArray[float64]
    heading_deg: NDArray[float64]
    track_deg: NDArray[float64]
    ground_speed_m_s: NDArray[float64]
    bank_deg: NDArray[float64]


@dataclass(frozen=True)
class Hold:
    """A circle held in a wind. An azimuth is the compass direction from the circle's centre, which may move.

    The bank is that of a coordinated, level turn, tan(bank) = airspeed times turn rate over g, always towards the
    centre. The turn rate is least where the aircraft heads into the relative wind, and largest where it heads downwind.
    """

    orbit: Orbit
    aircraft: Aircraft
    wind: Wind
    turn: Turn

    @property
    def least_bank_deg(self) -> float:
        """The least bank, where the aircraft heads into the wind."""
        return self._at(UPWIND).bank_deg

    @property
    def largest_bank_deg(self) -> float:
        """The largest bank, where the aircraft heads downwind."""
        return self._at(DOWNWIND).bank_deg

    @property
    def largest_bank_azimuth_deg(self) -> float:
        """The azimuth of the largest bank; an arbitrary one in still air, where the bank is the same everywhere."""
        return self._at(DOWNWIND).azimuth_deg

    def at(self, azimuth_deg: float) -> HoldPoint:
        """Heading, ground track, ground speed and bank at an azimuth."""
        east, north = heading_vector(number("azimuth_deg", azimuth_deg, "degrees"))
        phase = phase_of(east, north, SIDES[self.turn], *relative_wind(self.orbit, self.aircraft, self.wind))
        return self._at(phase)._replace(azimuth_deg=wrapped(azimuth_deg))

    def sample(self, step_deg: float = 1.0) -> Round:
        """The points every `step_deg` degrees of azimuth, from 0 to below 360.

        Raises `InvalidArgument` for a step below a thousandth of a degree.
        """
        import numpy as np

        step_deg = positive("step_deg", step_deg, "degrees")
        if step_deg < FINEST_DEG:
            raise InvalidArgument("step_deg", f"is {step_deg}: it must be at least {FINEST_DEG:g} degrees")
        return Round(*np.array([self.at(azimuth) for azimuth in np.arange(0.0, 360.0, step_deg).tolist()]).T)

    def _at(self, phase: float) -> HoldPoint:
        r, side = self.aircraft.turn_radius_m, SIDES[self.turn]
        scene = radius_in_turns(self.orbit, self.aircraft), *relative_wind(self.orbit, self.aircraft, self.wind)
        x, y, c, s, _ = hold_pose(phase, side, *scene)
        heading_deg = heading_of(c, s)
        track_deg, speed = over_ground(heading_deg, self.aircraft, self.wind)
        bank_deg = self.aircraft.bank_deg(r / hold_rate(phase, side, *scene))
        return HoldPoint(heading_of(x, y), heading_deg, track_deg, speed, bank_deg)


def hold(orbit: Orbit, aircraft: Aircraft, wind: Wind | None = None, *, turn: Turn | TurnName | None = None) -> Hold:
    """Heading, ground speed and bank needed to hold a circle. `turn` replaces the direction of the orbit.

    Raises `RadiusTooSmall` and `WindTooStrong` where the circle cannot be held, `InvalidArgument` for a turn that is
    neither cw nor ccw, and for a value of another class.

    >>> from loiter import Aircraft, Orbit, Wind, hold
    >>> h = hold(Orbit(0.0, 0.0, 120.0, "cw"), Aircraft(18.0, max_bank_deg=35.0), Wind(8.0, from_deg=250.0))
    >>> round(h.least_bank_deg, 1), round(h.largest_bank_deg, 1), round(h.largest_bank_azimuth_deg)
    (4.9, 29.9, 340)
    """
    wind = CALM if wind is None else wind
    air = relative_wind(orbit, aircraft, wind)
    turn = orbit.turn if turn is None else turn
    if turn not in (Turn.CW, Turn.CCW):
        raise InvalidArgument("turn", f"is {str(turn)!r}: a circle is held cw or ccw")
    check_held(orbit, aircraft, air, wind)
    return Hold(orbit, aircraft, wind, Turn(turn))
