"""The inner loops alone: trim, mirror symmetry, stops, priority of speed. In flight: `test_jsbsim_aircraft`."""

from math import radians

import pytest
from hypothesis import given
from hypothesis import strategies as st

from loiter.lab.simulators.airframes import AIRFRAMES
from loiter.lab.simulators.inner_loops import InnerLoops, LoopInputs, Surfaces

both = pytest.mark.parametrize("airframe", AIRFRAMES.values(), ids=list(AIRFRAMES))
TRIM = Surfaces(0.0, -0.2, 0.0, 0.6)
DT = 1.0 / 120.0


def level(airframe, **changes):
    inputs = LoopInputs(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, airframe.altitude_m, 0.0, airframe.aircraft.airspeed_m_s)
    return inputs._replace(**changes)


def loops(airframe):
    return InnerLoops(airframe.gains, TRIM, airframe.altitude_m, airframe.aircraft.airspeed_m_s)


@both
def test_trimmed_flight_keeps_its_trim(airframe):
    assert loops(airframe).step(level(airframe), 0.0, DT) == pytest.approx(TRIM)


@both
@given(st.floats(-1.0, 1.0), st.floats(-0.3, 0.3), *[st.floats(-0.5, 0.5)] * 4, st.floats(-35.0, 35.0))
def test_a_mirrored_flight_gets_mirrored_surfaces(airframe, bank, pitch, p, q, r, slip, command):
    inputs = level(airframe, bank=bank, pitch=pitch, roll_rate=p, pitch_rate=q, yaw_rate=r, slip=slip)
    mirrored = inputs._replace(bank=-bank, roll_rate=-p, yaw_rate=-r, slip=-slip)
    a, b = loops(airframe), loops(airframe)
    for _ in range(3):
        seen, other = a.step(inputs, command, DT), b.step(mirrored, -command, DT)
        assert other == pytest.approx(seen._replace(aileron=-seen.aileron, rudder=-seen.rudder), abs=1e-12)
        assert all(abs(share) <= 1.0 for share in seen)
        assert seen.throttle >= 0.0


@both
def test_integrals_are_frozen_at_a_stop(airframe):
    # Errors of pitch rate, roll rate and airspeed that the controls cannot correct: 60 s have the same effect as 20 s.
    wrong = level(airframe, pitch_rate=-1.0, roll_rate=2.0, airspeed=0.6 * airframe.aircraft.airspeed_m_s)

    def released(time_s):
        stuck = loops(airframe)
        for _ in range(round(time_s / DT)):
            held = stuck.step(wrong, 0.0, DT)
        assert (held.aileron, held.elevator, held.throttle) == (-1.0, -1.0, 1.0)
        return stuck.step(level(airframe), 0.0, DT)

    assert released(60.0) == pytest.approx(released(20.0), abs=0.02)


@both
def test_speed_has_priority_over_altitude(airframe):
    V = airframe.aircraft.airspeed_m_s
    low = level(airframe, altitude=airframe.altitude_m - 50.0)
    climbs = loops(airframe).step(low, 0.0, DT)
    dives = loops(airframe).step(low._replace(airspeed=0.8 * V), 0.0, DT)
    # A positive elevator deflection pitches down.
    assert climbs.elevator < TRIM.elevator < dives.elevator
    assert dives.throttle > climbs.throttle


@both
def test_a_bank_needs_aileron_lift_and_power(airframe):
    turning = level(airframe, bank=radians(30.0))
    held = loops(airframe).step(turning, 30.0, DT)
    assert held.elevator < TRIM.elevator
    assert held.throttle > TRIM.throttle
    assert loops(airframe).step(level(airframe), 30.0, DT).aileron > 0.3
