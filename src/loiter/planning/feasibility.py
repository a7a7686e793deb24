"""Feasibility: whether an aircraft can hold a circle in the wind, and the error message where it cannot."""

from math import hypot
from typing import NamedTuple

from loiter.errors import RadiusTooSmall, WindTooStrong, instance
from loiter.kernel.rounding import ROUNDING
from loiter.kernel.statuses import Status
from loiter.kernel.wind import wind_search
from loiter.kernel.wind.hold import tightest_radius
from loiter.kernel.wind.wind_search import WindProblem
from loiter.kernel.words import Side
from loiter.planning.model import Aircraft, Orbit, Wind
from loiter.planning.units import KNOT


class RelativeWind(NamedTuple):
    """The velocity of the air relative to the circle, divided by the airspeed: east and north, numbers or arrays."""

    x: float
    y: float

    @property
    def still(self) -> bool:
        """Whether the circle meets still air."""
        return (self.x == 0.0) & (self.y == 0.0)


def relative_wind(orbit: Orbit, aircraft: Aircraft, wind: Wind) -> RelativeWind:
    """The velocity of the air relative to the circle, divided by the airspeed; zero where only rounding remains.

    Raises `InvalidArgument` for a value of another class: every function that takes these three begins here.
    """
    for name, value, kind in (("orbit", orbit, Orbit), ("aircraft", aircraft, Aircraft), ("wind", wind, Wind)):
        instance(name, value, kind)
    circle = orbit.velocity_east_m_s, orbit.velocity_north_m_s
    return RelativeWind(*relative_velocity(wind.velocity_m_s, circle, aircraft.airspeed_m_s))


def relative_velocity(air: tuple[float, float], circle: tuple[float, float], airspeed: float) -> tuple[float, float]:
    """The velocity of the air less that of the circle, divided by the airspeed. No branches: it accepts arrays."""
    wx, wy = air[0] - circle[0], air[1] - circle[1]
    passes = hypot(wx, wy) > ROUNDING * (hypot(*air) + hypot(*circle))
    # Adding 0.0 turns -0.0 into 0.0.
    return wx * passes / airspeed + 0.0, wy * passes / airspeed + 0.0


def radius_in_turns(orbit: Orbit, aircraft: Aircraft) -> float:
    """R, the radius of the circle in turn radii of the aircraft."""
    return orbit.radius_m / aircraft.turn_radius_m


def check_held(orbit: Orbit, aircraft: Aircraft, air: RelativeWind, wind: Wind | None = None) -> None:
    """Raise `WindTooStrong` or `RadiusTooSmall` if the aircraft cannot hold the circle at every azimuth.

    `air` is the wind relative to the circle, from `relative_wind`; `wind` is that wind as the user gave it, if it was
    given: the error says so where its speed and its direction seem to be swapped.
    """
    status = _status(orbit, aircraft, air)
    if status == Status.WIND_TOO_STRONG:
        V, speed = aircraft.airspeed_m_s, hypot(*air) * aircraft.airspeed_m_s
        raise WindTooStrong(
            f"in {_air(orbit, speed)} an aircraft of {V:.4g} m/s can hold no circle: "
            f"its airspeed must be above {speed:.4g} m/s{_swapped_hint(orbit, aircraft, wind)}"
        )
    if status in (Status.NOT_HELD, Status.RADIUS_TOO_SMALL):
        tightest = tightest_radius(*air)
        sentence = too_tight(orbit, aircraft) if air.still else _not_held(orbit, aircraft, air, tightest)
        raise RadiusTooSmall(sentence, tightest * aircraft.turn_radius_m)


def is_holdable(orbit: Orbit, aircraft: Aircraft, air: RelativeWind) -> bool:
    """Whether the aircraft can hold the circle at every azimuth; `air` is that of `check_held`."""
    return _status(orbit, aircraft, air) not in (Status.WIND_TOO_STRONG, Status.NOT_HELD, Status.RADIUS_TOO_SMALL)


def fitted_radius_m(orbit: Orbit, aircraft: Aircraft, wind: Wind) -> float:
    """The radius of the circle, metres, or the least one that the aircraft can hold in the wind if that is larger.

    Raises `WindTooStrong` where it can hold none.
    """
    air = relative_wind(orbit, aircraft, wind)
    if _status(orbit, aircraft, air) in (Status.NOT_HELD, Status.RADIUS_TOO_SMALL):
        return tightest_radius(*air) * aircraft.turn_radius_m
    check_held(orbit, aircraft, air, wind)
    return orbit.radius_m


def _status(orbit: Orbit, aircraft: Aircraft, air: RelativeWind) -> int:
    """Whether the circle can be held: the status of a start at its centre."""
    R = radius_in_turns(orbit, aircraft)
    return wind_search.status_of(WindProblem(0.0, 0.0, 1.0, 0.0, R, Side.EITHER, *air))


def too_tight(orbit: Orbit, aircraft: Aircraft) -> str:
    """The error message for a circle that is tighter than the turn radius."""
    r, V, needed = aircraft.turn_radius_m, aircraft.airspeed_m_s, aircraft.bank_deg(orbit.radius_m)
    if aircraft.max_bank_deg is not None:
        limit, need = f" and {aircraft.max_bank_deg:.4g} deg of bank", f"{needed:.4g} deg"
    elif aircraft.max_turn_rate_deg_s is not None:
        rate = aircraft.max_turn_rate_deg_s * r / orbit.radius_m
        limit, need = f" and {aircraft.max_turn_rate_deg_s:.4g} deg/s", f"{rate:.4g} deg/s ({needed:.4g} deg of bank)"
    else:
        limit, need = "", f"{needed:.4g} deg of bank"
    return (
        f"orbit radius {orbit.radius_m:g} m is tighter than the aircraft can turn: "
        f"{r:.4g} m at {V:.4g} m/s{limit}; it needs {need}"
    )


def _swapped_hint(orbit: Orbit, aircraft: Aircraft, wind: Wind | None) -> str:
    """The likely meaning of a wind whose direction comes first, as in weather reports; empty where it has none."""
    if wind is None or not 0.0 < wind.from_deg < wind.speed_m_s <= 360.0:
        return ""
    speed, from_deg = wind.from_deg, wind.speed_m_s
    for unit, size in {"m/s": 1.0, "knots": KNOT}.items():
        if hypot(*relative_wind(orbit, aircraft, Wind(speed * size, from_deg))) < 1.0:
            return (
                f"; for a wind of {speed:.4g} {unit} from {from_deg:g} degrees the speed comes first "
                "(weather reports have the direction first, and knots)"
            )
    return ""


def _air(orbit: Orbit, speed: float) -> str:
    return f"air that passes the circle at {speed:.4g} m/s" if orbit.moves else f"a wind of {speed:.4g} m/s"


def _not_held(orbit: Orbit, aircraft: Aircraft, air: RelativeWind, tightest: float) -> str:
    """The error message for a circle that is too tight to be held in the wind: below `tightest` turn radii."""
    r, V = aircraft.turn_radius_m, aircraft.airspeed_m_s
    bank = f"{aircraft.bank_deg(orbit.radius_m / tightest):.4g} deg"
    if aircraft.max_bank_deg is not None:
        limit, need = f"{aircraft.max_bank_deg:.4g} deg of bank", bank
    elif aircraft.max_turn_rate_deg_s is not None:
        rate = aircraft.max_turn_rate_deg_s * r * tightest / orbit.radius_m
        limit, need = f"{aircraft.max_turn_rate_deg_s:.4g} deg/s", f"{rate:.4g} deg/s ({bank} of bank)"
    else:
        limit, need = f"a turn radius of {r:.4g} m", f"a turn radius of {orbit.radius_m / tightest:.4g} m"
    return (
        f"orbit radius {orbit.radius_m:g} m cannot be held in {_air(orbit, hypot(*air) * V)} "
        f"at {V:.4g} m/s and {limit}: it needs {tightest * r:.4g} m, or {need}"
    )
