"""Items sent and read back: they are unchanged, except for what an autopilot must round."""

from math import copysign, inf, nan
from struct import pack, unpack

import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from pymavlink.dialects.v20 import ardupilotmega as mavlink

from loiter import Turn
from loiter.files.missions import references
from loiter.files.missions.items import Autopilot, Frame, MavCommand, Mission, MissionItem
from loiter.files.missions.signs import circle, with_circle
from loiter.flight.link.link import Vehicle
from loiter.flight.missions import stored_items
from loiter.flight.missions.stored_items import decode, differences, encode, from_message, is_same, to_message

PX4, PLANE, OTHER = (Vehicle(1, 1, code) for code in (Autopilot.PX4, Autopilot.ARDUPILOT, 0))
HOME = (47.0, 8.0, 400.0)
singles = st.floats(width=32, allow_infinity=False, min_value=-(2.0**100), max_value=2.0**100)
frames = st.sampled_from([Frame.ABOVE_SEA, Frame.ABOVE_HOME, Frame.ABOVE_TERRAIN])
# Commands that have a place, and no number of another item.
others = {*references.NUMBERS, *stored_items._UNPLACED_BY_PX4, *stored_items._NUMBERS_IN_PLACE}
commands = st.one_of(st.integers(0, 65535), st.sampled_from(list(MavCommand))).filter(lambda c: c not in others)
latitudes = st.integers(-900000000, 900000000).map(lambda x: x / 1e7)
longitudes = st.integers(-1800000000, 1800000000).map(lambda x: x / 1e7)
altitudes = st.floats(-1000.0, 50000.0, width=32)
items = st.builds(
    MissionItem, commands, frames, st.tuples(*[singles] * 4), latitudes, longitudes, altitudes, st.booleans()
)


def through(item, vehicle):
    """An item packed, parsed by pymavlink and read."""
    mav = mavlink.MAVLink(None, 250, 190)
    return from_message(mav.decode(bytearray(to_message(item, 3, vehicle).pack(mav))))


def single(value):
    return unpack("<f", pack("<f", value))[0]


@given(item=items, vehicle=st.sampled_from([PX4, PLANE, OTHER]))
def test_an_item_comes_back_as_it_went(item, vehicle):
    sent = encode(Mission((item,), HOME), vehicle)
    back = [through(each, vehicle) for each in sent]
    assert repr(back) == repr(sent)
    assert differences(sent, back, vehicle) == ([], [])
    assert is_same(back, sent, vehicle)
    assert repr(decode(back, vehicle).items) == repr((item._replace(frame=int(item.frame), command=int(item.command)),))


@given(lon=st.floats(-360.0, 360.0))
@example(lon=181.0)
@example(lon=-359.5)
def test_longitudes_are_counted_from_0_or_from_180(lon):
    (sent,) = encode(Mission((MissionItem(16, 0, (0.0,) * 4, 1.0, lon, 5.0),), HOME), OTHER)
    assert abs(sent.y) <= 1800000000
    assert (sent.y / 1e7 - lon + 180.0) % 360.0 == pytest.approx(180.0, abs=1e-6)


@given(z=altitudes)
def test_an_altitude_that_ardupilot_cuts_to_centimetres_is_expected_and_another_is_not(z):
    home, sent = encode(Mission((MissionItem(17, 0, (0.0,) * 4, 47.0, 8.0, z),), HOME), PLANE)
    kept = single(int(single(sent.z * 100.0)) * single(0.01))
    wrong, cut = differences([home, sent], [home, sent._replace(z=kept)], PLANE)
    assert wrong == []
    assert len(cut) == (kept != sent.z)
    # The same from a vehicle of another kind is not what was sent.
    assert bool(differences([home, sent], [home, sent._replace(z=kept)], OTHER)[0]) == bool(cut)
    assert differences([home, sent], [home, sent._replace(z=kept + 0.25)], PLANE)[0]


# What ArduPilot gives back of a NAV_LOITER_TURNS, by the comments of AP_Mission::mavlink_int_to_mission_cmd (pull
# request 20735): the radius in a byte, as it is up to 255 m, above that a tenth of it; 0 < N < 1 turns times 256.
RADII = {
    1.0: 1.0,
    80.7: 80.0,
    254.9: 254.0,
    255.0: 255.0,
    255.5: 250.0,
    256.0: 250.0,
    259.9: 250.0,
    260.0: 260.0,
    300.0: 300.0,
    301.0: 300.0,
    379.9: 370.0,
    380.0: 380.0,
    382.0: 380.0,
    383.0: 380.0,
    1234.0: 1230.0,
    2550.0: 2550.0,
    2559.0: 2550.0,
    2560.0: 2550.0,
    5000.0: 2550.0,
}
TURNS = {0.0: 0.0, 0.25: 0.25, 0.3: 76.0 / 256.0, 1.0: 1.0, 1.5: 1.0, 255.0: 255.0, 300.0: 255.0}


def stored_turns(turns, radius, turn=Turn.CW):
    """A NAV_LOITER_TURNS on its way to ArduPilot, home before it."""
    params = with_circle(18, (turns, 0.0, 0.0, 1.0), radius, turn)
    return encode(Mission((MissionItem(18, 0, params, 47.0, 8.0, 500.0),), HOME), PLANE)


@pytest.mark.parametrize("turn", [Turn.CW, Turn.CCW])
@pytest.mark.parametrize("radius", RADII)
def test_ardupilot_packs_the_radius_of_turns_into_a_byte(radius, turn):
    home, sent = stored_turns(3.0, radius, turn)
    kept = copysign(RADII[radius], sent.params[2])
    assert differences([home, sent], [home, sent._replace(params=(3.0, 0.0, kept, 1.0))], PLANE) == (
        [],
        [] if RADII[radius] == radius else [f"item 1 has {kept:.9g} for parameter 3, not {sent.params[2]:.9g}"],
    )
    # What is a metre, or a step of ten, beside that is a fault.
    for off in (-10.0, -1.0, 1.0, 10.0):
        if kept + off != sent.params[2]:
            wrong, _ = differences([home, sent], [home, sent._replace(params=(3.0, 0.0, kept + off, 1.0))], PLANE)
            assert [sentence.partition(" for ")[0] for sentence in wrong] == [f"item 1 has {kept + off:.9g}"]


@pytest.mark.parametrize("turns", TURNS)
def test_ardupilot_packs_the_number_of_turns_into_a_byte(turns):
    home, sent = stored_turns(turns, 80.0)
    kept = sent._replace(params=(TURNS[turns], *sent.params[1:]))
    wrong, cut = differences([home, sent], [home, kept], PLANE)
    assert wrong == []
    assert len(cut) == (single(turns) != TURNS[turns])
    assert differences([home, sent], [home, kept._replace(params=(TURNS[turns] + 1.0, *sent.params[1:]))], PLANE)[0]


@pytest.mark.parametrize("turn", [Turn.CW, Turn.CCW])
def test_px4_answers_with_twin_frames_and_what_it_uses(turn):
    params = with_circle(17, (0.0, 0.0, 0.0, -90.0), 80.5, turn)
    sent = encode(Mission((MissionItem(17, Frame.ABOVE_HOME, params, 47.0, 8.0, 50.0),), HOME), PX4)
    stored = [sent[0]._replace(frame=6, params=(0.0, 0.0, sent[0].params[2], single(269.99998)))]
    assert differences(sent, stored, PX4) == ([], ["item 1 has 269.999969 for parameter 4, not -90"])
    assert circle(17, decode(stored, PX4).items[0].params) == (80.5, turn)
    assert decode(stored, PX4).items[0].frame == Frame.ABOVE_HOME
    assert differences(sent, [stored[0]._replace(frame=5)], PX4)[0] == ["item 1 has 0 for frame, not 3"]


def test_the_home_of_ardupilot_is_its_own_and_is_not_compared():
    sent = encode(Mission((MissionItem(16, 0, (0.0,) * 4, 47.0, 8.0, 5.0),), HOME), PLANE)
    assert (sent[0].command, sent[0].x, sent[0].y, sent[0].z) == (16, 470000000, 80000000, 400.0)
    assert differences(sent, [sent[0]._replace(x=0, y=0, z=0.0), sent[1]], PLANE) == ([], [])
    assert len(encode(Mission((MissionItem(16, 0, (0.0,) * 4, 47.0, 8.0, 5.0),), (nan, nan, nan)), PX4)) == 1


def test_nan_is_nan_and_not_a_number():
    sent = encode(Mission((MissionItem(16, 0, (0.0, 0.0, 0.0, nan), 47.0, 8.0, 5.0),), HOME), OTHER)
    assert differences(sent, sent, OTHER) == ([], [])
    for other in (0.0, inf):
        assert differences(sent, [sent[0]._replace(params=(0.0, 0.0, 0.0, other))], OTHER)[0]


# Vehicle, command, parameters sent, parameters kept: AP_Mission's bytes and bits, and what PX4 has a use for.
KEPT = [
    (PLANE, MavCommand.NAV_WAYPOINT, (7.5, 30.5, 41.75, 90.0), (0.0, 30.0, 41.0, 0.0)),
    (PLANE, MavCommand.NAV_WAYPOINT, (7.5, 300.5, 256.0, 90.0), (0.0, 255.0, 255.0, 0.0)),
    (PLANE, MavCommand.NAV_LOITER_UNLIM, (7.5, 3.5, -80.5, 90.0), (0.0, 0.0, -80.0, 0.0)),
    (PLANE, MavCommand.NAV_LOITER_TURNS, (2.5, 3.5, -80.5, 0.5), (2.0, 0.0, -80.0, 1.0)),
    (PLANE, MavCommand.NAV_LOITER_TURNS, (300.5, 3.5, 1234.0, -0.5), (255.0, 0.0, 1230.0, 0.0)),
    (PLANE, MavCommand.NAV_LOITER_TIME, (60.5, 3.5, -80.5, 0.5), (60.0, 0.0, -1.0, 1.0)),
    (PLANE, MavCommand.NAV_LOITER_TIME, (60.5, 3.5, 0.0, -0.5), (60.0, 0.0, 1.0, 0.0)),
    (PLANE, MavCommand.NAV_LOITER_TO_ALT, (0.5, -80.5, 3.5, 0.5), (0.0, -80.0, 0.0, 1.0)),
    (PX4, MavCommand.NAV_WAYPOINT, (7.5, 30.5, 41.75, -90.0), (7.5, 30.5, 0.0, 270.0)),
    (PX4, MavCommand.NAV_LOITER_UNLIM, (7.5, 3.5, -80.5, -90.0), (0.0, 0.0, -80.5, 270.0)),
    (PX4, MavCommand.NAV_LOITER_TIME, (60.5, 0.5, -80.5, 0.5), (60.5, 1.0, -80.5, 1.0)),
    (PX4, MavCommand.NAV_LOITER_TIME, (60.5, -0.5, 80.5, -0.5), (60.5, 0.0, 80.5, 0.0)),
    (PX4, MavCommand.NAV_LOITER_TO_ALT, (0.5, 80.5, 3.5, 0.5), (1.0, 80.5, 0.0, 1.0)),
    (PX4, MavCommand.NAV_LOITER_TO_ALT, (-0.5, 80.5, 3.5, -0.5), (0.0, 80.5, 0.0, 0.0)),
]


def sent_to(vehicle, command, params, frame=Frame.ABOVE_HOME):
    return encode(Mission((MissionItem(command, frame, params, 47.0, 8.0, 50.0),), HOME), vehicle)


@pytest.mark.parametrize(("vehicle", "command", "params", "kept"), KEPT)
def test_what_is_kept_is_expected_and_any_other_parameter_is_not(vehicle, command, params, kept):
    sent = sent_to(vehicle, command, params)
    back = [*sent[:-1], sent[-1]._replace(params=kept)]
    cut = [
        f"item 1 has {now:.9g} for parameter {i}, not {was:.9g}"
        for i, (was, now) in enumerate(zip(params, kept, strict=True), 1)
        if was != now
    ]
    assert differences(sent, back, vehicle) == ([], cut)
    for i in range(4):
        for off in (-0.25, 0.25):
            other = (*kept[:i], kept[i] + off, *kept[i + 1 :])
            (wrong,), _ = differences(sent, [*sent[:-1], sent[-1]._replace(params=other)], vehicle)
            assert wrong == f"item 1 has {other[i]:.9g} for parameter {i + 1}, not {params[i]:.9g}"


# MAV_FRAME: GLOBAL, GLOBAL_RELATIVE_ALT, GLOBAL_TERRAIN_ALT, and each with INT.
@pytest.mark.parametrize(("frame", "twin"), [(0, 5), (3, 6), (10, 11)])
def test_px4_answers_in_the_frame_whose_name_ends_in_int(frame, twin):
    sent = sent_to(PX4, MavCommand.NAV_WAYPOINT, (0.0, 0.0, 0.0, 0.0), Frame(frame))
    back = [sent[0]._replace(frame=twin)]
    assert differences(sent, back, PX4) == ([], [])
    (item,) = decode(back, PX4).items
    assert (item.frame, item.latitude_deg, item.longitude_deg) == (frame, 47.0, 8.0)


def test_items_without_a_place_keep_their_parameters_in_px4():
    sent = sent_to(PX4, MavCommand.NAV_LOITER_UNLIM, (7.5, 3.5, -80.5, -90.0), Frame.NOWHERE)
    kept = [sent[0]._replace(params=(0.0, 0.0, -80.5, 270.0))]
    assert len(differences(sent, kept, PX4)[0]) == 3
    assert differences(sent, sent, PX4) == ([], [])
