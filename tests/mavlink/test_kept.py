"""What autopilots keep of each command, parameter by parameter, and the frames in which PX4 answers."""

import pytest

from loiter.io.missions.items import Autopilot, Frame, MavCommand, Mission, MissionItem
from loiter.mavlink.connection.link import Vehicle
from loiter.mavlink.missions.stored_items import decode, differences, encode

PX4, PLANE = Vehicle(1, 1, Autopilot.PX4), Vehicle(1, 1, Autopilot.ARDUPILOT)
HOME = (47.0, 8.0, 400.0)

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
