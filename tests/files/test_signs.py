"""The sign table compared with the definition of MAVLink in pymavlink."""

import re
from math import inf, nan

import pytest
from hypothesis import given
from hypothesis import strategies as st
from pymavlink.dialects.v20 import all as mavlink

from loiter import Turn
from loiter.errors import InvalidArgument
from loiter.files import Autopilot, Frame, MavCommand
from loiter.files.missions.signs import (
    COMMANDS,
    RADIUS_PARAMETERS,
    circle,
    held_circle,
    radius_and_turn,
    signed_radius_m,
    with_circle,
)

DEFINITIONS = mavlink.enums["MAV_CMD"]
ONE_WAY = st.sampled_from([Turn.CW, Turn.CCW])
RADII = st.floats(1e-3, 1e6)


@pytest.mark.parametrize("command", MavCommand)
def test_commands_have_the_names_and_numbers_of_mavlink(command):
    assert DEFINITIONS[command].name == f"MAV_CMD_{command.name}"


@pytest.mark.parametrize(
    ("ours", "theirs"),
    [
        (Frame.ABOVE_SEA, "MAV_FRAME_GLOBAL"),
        (Frame.NOWHERE, "MAV_FRAME_MISSION"),
        (Frame.ABOVE_HOME, "MAV_FRAME_GLOBAL_RELATIVE_ALT"),
        (Frame.ABOVE_TERRAIN, "MAV_FRAME_GLOBAL_TERRAIN_ALT"),
        (Autopilot.ARDUPILOT, "MAV_AUTOPILOT_ARDUPILOTMEGA"),
        (Autopilot.PX4, "MAV_AUTOPILOT_PX4"),
    ],
)
def test_frames_and_autopilots_have_the_numbers_of_mavlink(ours, theirs):
    assert ours == getattr(mavlink, theirs)


@pytest.mark.parametrize("command", COMMANDS)
def test_radius_and_direction_stand_where_mavlink_says(command):
    """The definition's words: which parameter is the radius, whether its sign tells the direction, else which does."""
    texts = {number: text.lower() for number, text in DEFINITIONS[command].param.items()}
    (radius,) = [number for number, text in texts.items() if "radius" in text]
    place = COMMANDS[command]
    assert place.radius == radius
    by_sign = re.search(r"positive:? (loiter|orbit) clockwise", texts[radius])
    if place.direction is None:
        assert by_sign
        assert re.search(r"(else|negative:?)( orbit)? counter-clockwise", texts[radius])
        return
    assert not by_sign
    assert "positive values only" in texts[radius]
    (direction,) = [number for number, text in texts.items() if "0: clockwise, 1: counter clockwise" in text]
    assert place.direction == direction


def test_every_command_that_mavlink_gives_a_loiter_radius_with_a_sign_is_in_the_table():
    """Apart from figures of eight, whose sign tells another thing, and waypoints passed by and vehicles followed."""
    signed = {
        number
        for number, entry in DEFINITIONS.items()
        for text in entry.param.values()
        if "radius" in text.lower() and "positive" in text.lower() and "clockwise" in text.lower()
    }
    others = {mavlink.MAV_CMD_NAV_WAYPOINT, mavlink.MAV_CMD_NAV_FOLLOW, mavlink.MAV_CMD_DO_FIGURE_EIGHT}
    assert signed - others <= {command for command, place in COMMANDS.items() if place.direction is None}


@pytest.mark.parametrize(
    ("command", "turn", "expected"),
    [
        (MavCommand.NAV_LOITER_UNLIM, Turn.CW, (7.0, 7.0, 80.0, 7.0)),
        (MavCommand.NAV_LOITER_UNLIM, Turn.CCW, (7.0, 7.0, -80.0, 7.0)),
        (MavCommand.NAV_LOITER_TURNS, Turn.CCW, (7.0, 7.0, -80.0, 7.0)),
        (MavCommand.NAV_LOITER_TIME, Turn.CCW, (7.0, 7.0, -80.0, 7.0)),
        (MavCommand.NAV_LOITER_TO_ALT, Turn.CCW, (7.0, -80.0, 7.0, 7.0)),
        (MavCommand.DO_ORBIT, Turn.CCW, (-80.0, 7.0, 7.0, 7.0)),
        (MavCommand.DO_REPOSITION, Turn.CW, (7.0, 7.0, 80.0, 0.0)),
        (MavCommand.DO_REPOSITION, Turn.CCW, (7.0, 7.0, 80.0, 1.0)),
    ],
)
def test_circles_as_they_are_sent(command, turn, expected):
    assert with_circle(command, (7.0, 7.0, 7.0, 7.0), 80.0, turn) == expected


@given(st.sampled_from(list(COMMANDS)), st.tuples(*[st.floats(-1e3, 1e3)] * 4), RADII, ONE_WAY)
def test_what_is_put_in_is_read_back(command, params, radius_m, turn):
    assert circle(command, with_circle(command, params, radius_m, turn)) == (radius_m, turn)


@given(RADII, ONE_WAY)
def test_a_sign_is_read_back_and_the_other_way_round_is_the_other_sign(radius_m, turn):
    assert radius_and_turn(signed_radius_m(radius_m, turn)) == (radius_m, turn)
    assert signed_radius_m(radius_m, turn.other) == -signed_radius_m(radius_m, turn)


def test_the_parameters_of_both_autopilots_are_there():
    assert {"WP_LOITER_RAD": Autopilot.ARDUPILOT, "NAV_LOITER_RAD": Autopilot.PX4} == RADIUS_PARAMETERS


@pytest.mark.parametrize("direction", [0.0, nan])
def test_a_reposition_without_a_direction_is_clockwise(direction):
    assert circle(MavCommand.DO_REPOSITION, (-1.0, 1.0, 80.0, direction)) == (80.0, Turn.CW)


@pytest.mark.parametrize("autopilot", [None, *Autopilot])
@pytest.mark.parametrize(
    ("command", "params"),
    [
        (MavCommand.NAV_LOITER_UNLIM, (0.0, 0.0, 1.0, 0.0)),
        (MavCommand.NAV_LOITER_TURNS, (2.0, 0.0, 1.0, 0.0)),
        (MavCommand.NAV_LOITER_TIME, (60.0, 0.0, 1.0, 0.0)),
        (MavCommand.NAV_LOITER_TO_ALT, (0.0, 1.0, 0.0, 0.0)),
    ],
)
def test_a_radius_of_a_metre_is_that_of_the_autopilot(command, params, autopilot):
    """ArduPlane returns 1 or -1 for every NAV_LOITER_TIME, and flies WP_LOITER_RAD for all radii of up to a metre:
    counter-clockwise if the sign says so, otherwise in the direction of that parameter (Plane::update_loiter)."""
    place = COMMANDS[command].radius - 1

    def held(radius_m):
        return held_circle(command, (*params[:place], radius_m, *params[place + 1 :]), autopilot)

    for radius_m in (0.5, 1.0):
        assert held(radius_m) == (None, None)
        assert held(-radius_m) == (None, Turn.CCW)
    stored = (command, autopilot) != (MavCommand.NAV_LOITER_TIME, Autopilot.ARDUPILOT)
    assert held(80.0) == ((80.0, Turn.CW) if stored else (None, None))
    assert held(-80.0) == (80.0 if stored else None, Turn.CCW)
    assert held(0.0) == held(nan) == (None, None)


@pytest.mark.parametrize("radius_m", [0.0, -0.0, nan, inf])
@pytest.mark.parametrize("command", COMMANDS)
def test_no_radius_is_no_circle(command, radius_m):
    with pytest.raises(
        InvalidArgument, match=r"^radius is .*: it describes no circle, the autopilot uses its own radius$"
    ):
        circle(command, (radius_m,) * 4)


def test_a_reposition_takes_no_negative_radius():
    with pytest.raises(InvalidArgument, match=r"^radius is -80: the command DO_REPOSITION takes no negative one$"):
        circle(MavCommand.DO_REPOSITION, (-1.0, 1.0, -80.0, 0.0))


@pytest.mark.parametrize("command", [MavCommand.NAV_WAYPOINT, 22, 0])
def test_other_commands_fly_no_circle(command):
    sentence = rf"^command is {int(command)}: it flies no circle; NAV_LOITER_UNLIM, .* do$"
    with pytest.raises(InvalidArgument, match=sentence):
        circle(command, (0.0,) * 4)
    with pytest.raises(InvalidArgument, match=sentence):
        with_circle(command, (0.0,) * 4, 80.0, Turn.CW)


@pytest.mark.parametrize("radius_m", [0.0, -80.0, nan, inf, "80", None])
def test_a_circle_to_send_has_a_positive_radius(radius_m):
    with pytest.raises(InvalidArgument, match=r"^radius_m is .*: it must be a positive, finite number of metres$"):
        signed_radius_m(radius_m, Turn.CW)


@pytest.mark.parametrize("turn", [Turn.EITHER, "up", None])
def test_a_circle_to_send_has_one_direction(turn):
    with pytest.raises(InvalidArgument, match=r"^turn is '.*': a circle is held cw or ccw$"):
        signed_radius_m(80.0, turn)
