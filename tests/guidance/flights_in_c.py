"""Flights of the law in closed loop by machine code, a hundred times as fast as those of `trials.flight`.

The law is its C, generated from the same Python; the point mass, its sensors and its downlink are written a second time
in `flights_in_c.c`, and draw the same random numbers. The flights are the same to nine digits, which
`test_flights_in_c` checks.
"""

import subprocess
from ctypes import CDLL, POINTER, Structure, byref, c_bool, c_double, c_int64
from functools import cache
from math import inf
from pathlib import Path
from tempfile import mkdtemp
from typing import NamedTuple

import numpy as np

from codegen.files import LARGE, LAW_ARITHMETIC
from codegen.unit import Unit
from guidance.test_law_in_c import in_c
from loiter.guidance.circle import Band
from loiter.guidance.entry import law_step
from loiter.guidance.entry.loiter_entry import LoiterEntry
from loiter.guidance.estimation import identification_step
from loiter.guidance.vehicle import Roll, constant_turn
from loiter.lab.simulators.gusts import BLOCK, _gust_step, scale_length_m
from loiter.lab.simulators.point_mass import ALTITUDE_M
from loiter.lab.simulators.roll_dynamics import damping, rise_time
from loiter.lab.trials.flight import LIMIT_S, STEP_S
from loiter.lab.trials.settling import DIRECTIONS
from loiter.planning.compass import heading_vector
from native.library import COMPILER, FLAGS

SOURCE = Path(__file__).with_name("flights_in_c.c")

# What the C calls.
ROOTS = (
    law_step.first_memory,
    law_step.advance,
    identification_step.settings_of,
    identification_step.begin_identification,
    identification_step.advance_identification,
    constant_turn,
)


def structure(name, **fields):
    """A structure of numbers in C; each field with its type."""
    return type(name, (Structure,), {"_fields_": list(fields.items())})


def numbers(names):
    """Fields of the type double."""
    return dict.fromkeys(names.split(), c_double)


RollKind = structure(
    "RollKind", order=c_int64, **numbers("time_s rate_deg_s slew_deg_s dead_time_s damping frequency start_deg")
)
Scene = structure(
    "Scene",
    **numbers("east_m north_m heading_east heading_north V turn_ratio wind_east_m_s wind_north_m_s limit_deg"),
    roll=RollKind,
    **numbers("position_m heading_deg bank_deg velocity_m_s airspeed_m_s delay_s heading_bias_deg bank_bias_deg"),
    **numbers("gust_m_s gust_along gust_y gust_slope"),
    gust_step=c_double * 9,
    **numbers("rate_hz jitter loss outage_s outage_period_s radius_m"),
    direction=c_int64,
    **numbers("band course_deg step_s limit_s"),
    knows_roll=c_bool,
    lag_s=c_double,
)
Flown = structure("Flown", **numbers("settled_s joined_s turned_deg"), steps=c_int64)

COLUMNS = "time_s east_m north_m heading_deg bank_deg velocity_east_m_s velocity_north_m_s command_deg modelled_deg"


class FlightInC(NamedTuple):
    """A flight: `settled_s`, `joined_s` and `turned_deg` as in `Flight`, and its steps, arrays by name, if wanted."""

    settled_s: float
    joined_s: float
    turned_deg: float
    track: dict


@cache
def library():
    """The law and the vehicle, compiled once."""
    folder = Path(mkdtemp())
    (folder / "law.h").write_text(Unit("law.h", LAW_ARITHMETIC._replace(large=LARGE), ROOTS).text(), "utf-8")
    command = [COMPILER, *FLAGS, f"-I{folder}", str(SOURCE), "-o", str(folder / "flights.so"), "-lm"]
    subprocess.run(command, check=True)
    return CDLL(str(folder / "flights.so"))


def drawn(random, steps, width):
    """Normal numbers in the order in which the simulators take them: each block from its end."""
    return np.ascontiguousarray(random.standard_normal((steps // BLOCK + 1, BLOCK, width))[:, ::-1])


def roll_kind(roll, start_deg):
    """The roll, and the lag of first order by which the law knows it: one of the same mean delay."""
    if isinstance(roll, Roll):
        return RollKind(1, roll.time_s, roll.rate_deg_s, roll.slew_deg_s, 0.0, 1.0, 1.0, start_deg), roll.time_s
    zeta = damping(roll.overshoot)
    frequency = rise_time(zeta) / roll.time_s
    kind = RollKind(2, roll.time_s, roll.rate_deg_s, inf, roll.dead_time_s, zeta, frequency, start_deg)
    return kind, 2.0 * zeta / frequency


def vehicle_fields(start, aircraft, wind, noise, gust, air, step_s):
    """Fields of a scene: its start, aircraft and wind, the noise of its sensors, and the gusts that `air` draws."""
    V, (along, y, slope) = aircraft.airspeed_m_s, air.standard_normal(3).tolist()
    east, north = heading_vector(start.heading_deg)
    wind_east_m_s, wind_north_m_s = wind.velocity_m_s
    return {
        "east_m": start.east_m,
        "north_m": start.north_m,
        "heading_east": east,
        "heading_north": north,
        "V": V,
        "wind_east_m_s": wind_east_m_s,
        "wind_north_m_s": wind_north_m_s,
        "limit_deg": aircraft.bank_deg(aircraft.turn_radius_m),
        **{name: getattr(noise, name) for name in noise.__dataclass_fields__},
        "gust_m_s": gust * V,
        "gust_along": along,
        "gust_y": 0.5 * y,
        "gust_slope": 0.5 * slope,
        "gust_step": (c_double * 9)(*_gust_step(step_s / (scale_length_m(ALTITUDE_M) / V))),
        "step_s": step_s,
    }


def fly_in_c(trial, gust=0.0, *, roll=Roll(), band=Band(), limit_s=LIMIT_S, knows_roll=False, track=False):  # noqa: B008
    """The flight of the law with the aircraft of a `VariedTrial`, as `fly` flies `varied_point_mass`.

    `roll` is declared. With `knows_roll` the law is given the bank that follows each of its commands, and the delay,
    from the first step; all else is identified.
    """
    m, uav, link = trial.ideal, trial.declared, trial.downlink
    law = LoiterEntry(m.orbit, uav, trial.known_wind, roll=roll)
    steps, turns = int(limit_s / STEP_S) + 2, DIRECTIONS[m.orbit.turn]
    air, sensors = (np.random.default_rng(seed) for seed in np.random.SeedSequence(trial.seed).spawn(2))
    kind, lag_s = roll_kind(trial.response, trial.start_bank_deg)
    scene = Scene(
        **vehicle_fields(m.start, uav, m.wind, trial.noise, gust, air, STEP_S),
        turn_ratio=trial.turn_ratio,
        roll=kind,
        **{name: getattr(link, name) for name in link.__dataclass_fields__},
        radius_m=m.orbit.radius_m,
        direction=turns[0] if len(turns) == 1 else 0,
        band=band.radial,
        course_deg=band.course_deg,
        limit_s=limit_s,
        knows_roll=knows_roll,
        lag_s=lag_s,
    )
    # Two measurements are made in a step while none is old enough, and two numbers are drawn for each that arrives.
    random = (
        drawn(sensors, 2 * steps, 7),
        drawn(air, steps if gust > 0.0 else 0, 3),
        np.random.default_rng(trial.seed).random(2 * steps + int(2.0 * limit_s * link.rate_hz)),
        np.random.default_rng((trial.seed, 1)).random(2 * int(limit_s / link.outage_period_s) + 4),
    )
    flown, names = Flown(), COLUMNS.split()
    rows = np.empty((steps if track else 0, len(names)))
    library().fly_scene(
        byref(scene),
        byref(in_c(law._settings)),
        byref(in_c(law._declared.declared)),
        c_double(law._declared.wind_known_s),
        *(numbers.ctypes.data_as(POINTER(c_double)) for numbers in random),
        byref(flown),
        rows.ctypes.data_as(POINTER(c_double)) if track else None,
    )
    columns = dict(zip(names, rows[: flown.steps].T, strict=True)) if track else {}
    return FlightInC(flown.settled_s, flown.joined_s, flown.turned_deg, columns)
