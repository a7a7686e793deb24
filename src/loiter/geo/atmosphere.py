"""The density of the air at an altitude, and true airspeed from indicated airspeed.

The model is the troposphere of the International Standard Atmosphere (ISO 2533:1975; ICAO Doc 7488): the temperature
falls linearly with altitude, and the pressure follows from the hydrostatic equation. Altitudes are pressure altitudes,
in metres.
"""

from __future__ import annotations

from math import pow, sqrt

from loiter.errors import InvalidArgument, number, positive
from loiter.planning.model import STANDARD_GRAVITY_M_S2

SEA_LEVEL_K = 288.15
LAPSE_K_PER_M = 0.0065
ZERO_CELSIUS_K = 273.15
GAS_CONSTANT = 287.05287  # J/(kg K), of dry air

# g / (R L): the hydrostatic equation in air that cools linearly.
PRESSURE_EXPONENT = STANDARD_GRAVITY_M_S2 / (GAS_CONSTANT * LAPSE_K_PER_M)

# From below the Dead Sea to the tropopause, above which the temperature is constant.
LOWEST_M, HIGHEST_M = -500.0, 11_000.0


def density_ratio(altitude_m: float, temperature_c: float | None = None) -> float:
    """The density of the air over that of the standard atmosphere at sea level.

    `temperature_c` is the outside air temperature, degrees Celsius; by default that of the standard atmosphere. Raises
    `InvalidArgument` for an altitude outside -500 to 11,000 m and a temperature that is not above absolute zero.

    >>> round(density_ratio(2000.0), 4), round(density_ratio(2000.0, temperature_c=30.0), 4)
    (0.8216, 0.7457)
    """
    altitude = number("altitude_m", altitude_m, "metres")
    if not LOWEST_M <= altitude <= HIGHEST_M:
        raise InvalidArgument("altitude_m", f"is {altitude_m:g}: it must be between {LOWEST_M:g} and {HIGHEST_M:g} m")
    standard = SEA_LEVEL_K - LAPSE_K_PER_M * altitude
    pressure_ratio = pow(standard / SEA_LEVEL_K, PRESSURE_EXPONENT)
    return pressure_ratio * SEA_LEVEL_K / (standard if temperature_c is None else _kelvin(temperature_c))


def true_airspeed(indicated_airspeed_m_s: float, altitude_m: float, temperature_c: float | None = None) -> float:
    """The true airspeed, metres per second: V / sqrt(density ratio).

    Indicated airspeed is taken as equivalent airspeed, as autopilots do: below a third of the speed of sound they
    differ by less than 1 %. Raises the errors of `density_ratio`, and `InvalidArgument` for an airspeed that is not
    positive.

    >>> round(true_airspeed(18.0, 2000.0), 2)
    19.86
    """
    indicated = positive("indicated_airspeed_m_s", indicated_airspeed_m_s, "metres per second")
    return indicated / sqrt(density_ratio(altitude_m, temperature_c))


def eas2tas_squared(altitude_m: float) -> float:
    """The square of true over equivalent airspeed in standard air, the inverse of the density ratio.

    Altitudes beyond those of `density_ratio` count as the nearest of these.
    """
    return 1.0 / density_ratio(min(max(altitude_m, LOWEST_M), HIGHEST_M))


def density_altitude_m(altitude_m: float, temperature_c: float | None = None) -> float:
    """The altitude, metres, at which the standard atmosphere has this density; the altitude itself in standard air."""
    ratio = density_ratio(altitude_m, temperature_c)
    return SEA_LEVEL_K / LAPSE_K_PER_M * (1.0 - pow(ratio, 1.0 / (PRESSURE_EXPONENT - 1.0)))


def _kelvin(temperature_c: float) -> float:
    kelvin = number("temperature_c", temperature_c, "degrees Celsius") + ZERO_CELSIUS_K
    if kelvin <= 0.0:
        raise InvalidArgument(
            "temperature_c", f"is {temperature_c:g}: it must be above {-ZERO_CELSIUS_K} degrees Celsius"
        )
    return kelvin
