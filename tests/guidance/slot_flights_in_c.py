"""Flights into slots by machine code: `SlotEntry`, and the law of `formation`, with the vehicle of `flights_in_c`.

They are the same as in Python, which `test_slot_entry` checks.
"""

import subprocess
from ctypes import CDLL, POINTER, byref, c_double, c_int64
from functools import cache
from pathlib import Path
from tempfile import mkdtemp

import numpy as np

from codegen.files import LARGE, LAW_ARITHMETIC, LAW_REPLACED
from codegen.kinds import kind_of_type
from codegen.unit import Unit
from guidance.flights_in_c import ROOTS, Scene, drawn, roll_kind, vehicle_fields
from guidance.test_law_in_c import in_c, structure
from loiter.guidance.entry import slot_step
from loiter.guidance.vehicle import Roll
from loiter.kernel.wind import slots
from loiter.lab.simulators.sensors import Noise
from loiter.planning.model import CALM
from native.library import COMPILER, FLAGS

SOURCE = Path(__file__).with_name("slot_flights_in_c.c")


@cache
def library():
    """The laws and the vehicle, compiled once."""
    folder = Path(mkdtemp())
    arithmetic = LAW_ARITHMETIC._replace(large=LARGE, replaced=LAW_REPLACED | {"first_in_slot": slots.first_in_slot})
    roots = *ROOTS, slot_step.first_slot_memory, slot_step.advance_in_slot
    (folder / "law.h").write_text(Unit("law.h", arithmetic, roots).text(), "utf-8")
    output = folder / "slot_flights.so"
    command = [COMPILER, *FLAGS, f"-I{folder}", f"-I{SOURCE.parent}", str(SOURCE), "-o", str(output), "-lm"]
    subprocess.run(command, check=True)
    return CDLL(str(output))


def vehicle(pose, aircraft, wind, seed, gust, steps, step_s):
    """The scene of a `PointMass` with a seed, and the random numbers that it draws: of sensors and air."""
    air, sensors = (np.random.default_rng(each) for each in np.random.SeedSequence(seed).spawn(2))
    fields = vehicle_fields(pose, aircraft, wind, Noise(), gust, air, step_s)
    scene = Scene(**fields, turn_ratio=1.0, roll=roll_kind(Roll(), 0.0)[0])
    # Two measurements are made in a step while none is old enough.
    return scene, drawn(sensors, 2 * steps + 2, 7), drawn(air, steps, 3)


def fly_into_slot(pose, law, aircraft, wind, seed, *, gust, steps, step_s):
    """The places, east + 1j north, after each step of a `SlotEntry`."""
    scene, normals, gusts = vehicle(pose, aircraft, wind, seed, gust, steps, step_s)
    places, slot = np.empty((steps, 2)), structure(kind_of_type(slot_step.SlotSettings, ""))
    library().fly_into_slot(
        byref(scene),
        byref(in_c(law._settings)),
        byref(in_c(law._slot, slot)),
        byref(in_c(law._declared.declared)),
        c_double(law._declared.wind_known_s),
        _address(normals),
        _address(gusts),
        c_int64(steps),
        _address(places),
    )
    return places[:, 0] + 1j * places[:, 1]


def fly_formation(poses, orbit, side, aircraft, seeds, *, least_m, gust, steps, step_s):
    """The places of aircraft (rows) by the law of `formation`, which are in the order of their phases."""
    flown = [vehicle(pose, aircraft, CALM, seed, gust, steps, step_s) for pose, seed in zip(poses, seeds, strict=True)]
    scenes = (Scene * len(flown))(*(scene for scene, _, _ in flown))
    normals, gusts = np.array([each[1] for each in flown]), np.array([each[2] for each in flown])
    places = np.empty((steps, len(flown), 2))
    library().fly_formation(
        scenes,
        c_int64(len(flown)),
        *map(c_double, (side, orbit.radius_m, least_m)),
        _address(normals),
        c_int64(normals[0].size),
        _address(gusts),
        c_int64(gusts[0].size),
        c_int64(steps),
        _address(places),
    )
    return (places[..., 0] + 1j * places[..., 1]).T


def _address(numbers):
    return numbers.ctypes.data_as(POINTER(c_double))
