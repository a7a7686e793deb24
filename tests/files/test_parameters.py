"""Parameter files as Mission Planner, MAVProxy and QGroundControl write them."""

import pytest
from hypothesis import given
from hypothesis import strategies as st
from pymavlink import mavparm

from loiter import Turn
from loiter.errors import InvalidArgument
from loiter.files import Autopilot, Preset, read_parameters

ARDUPLANE = """\
#NOTE: 21.03.2026 12:00:00 Frame : Plane
ACRO_LOCKING,0
AIRSPEED_CRUISE,22.5
AIRSPEED_MAX,30
ROLL_LIMIT_DEG,45
WP_LOITER_RAD,-80
WP_RADIUS,90
"""

# From before ArduPlane 4.5.
OLD_ARDUPLANE = """\
# saved by hand
LIM_ROLL_CD     4500.000000
TRIM_ARSPD_CM   1800   # 18 m/s
WP_LOITER_RAD\t60
"""

PX4 = """\
# Onboard parameters for Vehicle 1
#
# Stack: PX4 Pro
# Vehicle: Fixed Wing
# Version: 1.16.0
#
# Vehicle-Id Component-Id Name Value Type
1\t1\tFW_AIRSPD_MAX\t20.000000000000000000\t9
1\t1\tFW_AIRSPD_TRIM\t15.000000000000000000\t9
1\t1\tFW_R_LIM\t50.000000000000000000\t9
1\t1\tNAV_DLL_ACT\t2\t6
1\t1\tNAV_LOITER_RAD\t80.000000000000000000\t9
"""


def read(tmp_path, text, name="uav.param"):
    path = tmp_path / name
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    return read_parameters(path)


@pytest.mark.parametrize("name", ["uav.param", "uav.parm", "uav.params", "uav.txt", "uav"])
@pytest.mark.parametrize(
    ("text", "expected"),
    [
        (ARDUPLANE, Preset(Autopilot.ARDUPILOT, 22.5, 45.0, 80.0, Turn.CCW)),
        (OLD_ARDUPLANE, Preset(Autopilot.ARDUPILOT, 18.0, 45.0, 60.0, Turn.CW)),
        (PX4, Preset(Autopilot.PX4, 15.0, 50.0, 80.0, Turn.CW)),
        (PX4.replace("\t", "    "), Preset(Autopilot.PX4, 15.0, 50.0, 80.0, Turn.CW)),
        (ARDUPLANE.replace(",", "="), Preset(Autopilot.ARDUPILOT, 22.5, 45.0, 80.0, Turn.CCW)),
        (ARDUPLANE.replace(",", " = "), Preset(Autopilot.ARDUPILOT, 22.5, 45.0, 80.0, Turn.CCW)),
        (ARDUPLANE.replace("\n", " @READONLY\n"), Preset(Autopilot.ARDUPILOT, 22.5, 45.0, 80.0, Turn.CCW)),
        (PX4.replace("RAD\t80", "RAD\t-80"), Preset(Autopilot.PX4, 15.0, 50.0, 80.0, Turn.CCW)),
    ],
)
def test_formats_are_distinguished_by_their_content(tmp_path, text, expected, name):
    assert read(tmp_path, text, name) == expected


def test_the_values_of_other_parameters_do_not_matter(tmp_path):
    others = "SERIAL_MASK,0x1F\nOTHER,nan\nOTHER,1\nSIM_GPS1_BYTELOSS,0\nPTCH_LIMIT_MAX_DEG 20 25\nOTHER\n"
    assert read(tmp_path, others + ARDUPLANE) == read(tmp_path, ARDUPLANE)


def test_what_a_px4_sends_beside_its_parameters_does_no_harm(tmp_path):
    """QGroundControl and pymavlink save _HASH_CHECK, the hash of all parameters, as one of them; QGroundControl the
    parameters of a camera and of a gimbal too, whose names are whatever MAVLink allows."""
    hashed = PX4.replace("1\t1\tFW_AIRSPD_MAX", "1\t1\t_HASH_CHECK\t1294859293\t5\n1\t1\tFW_AIRSPD_MAX")
    assert read(tmp_path, hashed) == read(tmp_path, PX4)
    others = "1\t100\tcam-mode.0\t1\t6\n1\t154\t3AXIS_tilt\t-0.5\t9\n"
    assert read(tmp_path, hashed + others) == read(tmp_path, PX4)
    parameters = mavparm.MAVParmDict()
    for name, value in [("FW_R_LIM", 50.0), ("_HASH_CHECK", 1294859293.0), ("NAV_LOITER_RAD", 80.0)]:
        parameters[name] = value
    parameters.save(str(tmp_path / "saved.parm"))
    assert "_HASH_CHECK" in (tmp_path / "saved.parm").read_text()
    assert read_parameters(tmp_path / "saved.parm") == Preset(Autopilot.PX4, None, 50.0, 80.0, Turn.CW)


def test_what_is_not_in_the_file_is_none(tmp_path):
    assert read(tmp_path, "WP_LOITER_RAD,60") == Preset(Autopilot.ARDUPILOT, None, None, 60.0, Turn.CW)
    assert read(tmp_path, "FW_R_LIM 50") == Preset(Autopilot.PX4, max_bank_deg=50.0)
    assert read(tmp_path, "AIRSPEED_CRUISE,12") == Preset(Autopilot.ARDUPILOT, indicated_airspeed_m_s=12.0)


def test_qgroundcontrol_writes_ardupilots_parameters_too(tmp_path):
    text = "# Stack: ArduPilot\n1\t1\tTRIM_ARSPD_CM\t1800\t6\n1\t1\tWP_LOITER_RAD\t-100\t4\n"
    assert read(tmp_path, text) == Preset(Autopilot.ARDUPILOT, 18.0, None, 100.0, Turn.CCW)


def test_line_ends_of_windows_and_a_byte_order_mark_do_no_harm(tmp_path):
    assert read(tmp_path, ARDUPLANE.replace("\n", "\r\n").encode("utf-8-sig")) == read(tmp_path, ARDUPLANE)


def test_a_parameter_that_stands_twice_and_says_the_same_is_one(tmp_path):
    assert read(tmp_path, ARDUPLANE + "WP_LOITER_RAD,-80.0\nLIM_ROLL_CD,4500\n") == read(tmp_path, ARDUPLANE)


@given(
    cruise=st.floats(5.0, 60.0),
    bank=st.floats(5.0, 80.0),
    radius=st.integers(10, 2000),
    turn=st.sampled_from([Turn.CW, Turn.CCW]),
)
def test_what_pymavlink_writes_is_read(tmp_path_factory, cruise, bank, radius, turn):
    """With the six decimals that it writes, and with parameters of other components."""
    parameters = mavparm.MAVParmDict()
    for name, value in [
        ("AIRSPEED_CRUISE", cruise),
        ("ROLL_LIMIT_DEG", bank),
        ("WP_LOITER_RAD", radius if turn == Turn.CW else -radius),
        ("ZZ_OTHER", 1.0),
    ]:
        parameters[name] = value
    path = tmp_path_factory.mktemp("parameters") / "uav.parm"
    parameters.save(str(path))
    preset = read_parameters(path)
    assert preset.indicated_airspeed_m_s == pytest.approx(cruise, abs=1e-6)
    assert preset.max_bank_deg == pytest.approx(bank, abs=1e-6)
    assert (preset.loiter_radius_m, preset.turn, preset.autopilot) == (radius, turn, Autopilot.ARDUPILOT)


@pytest.mark.parametrize("text", [ARDUPLANE, OLD_ARDUPLANE])
def test_pymavlink_reads_the_same_values(tmp_path, text):
    (tmp_path / "uav.parm").write_text(text)
    theirs = mavparm.MAVParmDict()
    theirs.load(str(tmp_path / "uav.parm"))
    mine = read_parameters(tmp_path / "uav.parm")
    assert mine.indicated_airspeed_m_s == theirs.get("AIRSPEED_CRUISE", theirs.get("TRIM_ARSPD_CM", 0.0) / 100.0)
    assert mine.max_bank_deg == theirs.get("ROLL_LIMIT_DEG", theirs.get("LIM_ROLL_CD", 0.0) / 100.0)
    assert mine.loiter_radius_m == abs(theirs["WP_LOITER_RAD"])


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("", "it has no parameters"),
        ("# nothing\n\n", "it has no parameters"),
        ("ACRO_LOCKING,0\n", "it has none of AIRSPEED_CRUISE, TRIM_ARSPD_CM, .*, NAV_LOITER_RAD"),
        ("WP_LOITER_RAD,80\nWP_LOITER_RAD,90\n", "line 2: WP_LOITER_RAD is '90', but '80' in line 1"),
        (
            "AIRSPEED_CRUISE,22\nTRIM_ARSPD_CM,1800\n",
            "line 2: TRIM_ARSPD_CM is '1800': that contradicts another parameter, which says 22",
        ),
        ("WP_LOITER_RAD,80\nFW_R_LIM,50\n", "line 2: FW_R_LIM is not of the autopilot of WP_LOITER_RAD"),
        ("WP_LOITER_RAD,0\n", "line 1: WP_LOITER_RAD is '0': it describes no circle"),
        ("AIRSPEED_CRUISE,0\n", "line 1: AIRSPEED_CRUISE is '0': it must be positive"),
        ("AIRSPEED_CRUISE,-3\n", "line 1: AIRSPEED_CRUISE is '-3': it must be positive"),
        ("LIM_ROLL_CD,9000\n", "line 1: LIM_ROLL_CD is '9000': the bank must be below 90 degrees"),
        ("ROLL_LIMIT_DEG,1e400\n", "line 1: ROLL_LIMIT_DEG is '1e400': it must be a finite number"),
        ("ROLL_LIMIT_DEG,nan\n", "line 1: ROLL_LIMIT_DEG is 'nan': it must be a finite number"),
        ("ROLL_LIMIT_DEG,４５\n", "line 1: ROLL_LIMIT_DEG is '４５': it must be a finite number"),
        ("ROLL_LIMIT_DEG 45 50\n", "line 1 is 'ROLL_LIMIT_DEG 45 50': it is not a parameter with a value"),
        ("ROLL_LIMIT_DEG\n", "line 1 is 'ROLL_LIMIT_DEG': it is not a parameter with a value"),
        ("roll_limit_deg,45\n", "line 1 is 'roll_limit_deg,45': it is not a parameter with a value"),
        ("1\t1\tTWO WORDS\t45\t9\n", r"line 1 is '1\\t1\\tTWO WORDS\\t45\\t9': it is not a parameter with a value"),
        ("__HASH_CHECK,45\n", "line 1 is '__HASH_CHECK,45': it is not a parameter with a value"),
        ("@include plane.parm\n", "line 1 is '@include plane.parm': it is not a parameter with a value"),
        (
            "1\t1\tFW_R_LIM\t50\t9\n1\t1\tFW_AIRSPD_TRIM\t15\n",
            r"line 2 is '1\\t1\\tFW_AIRSPD_TRIM\\t15': it is not a para",
        ),
        ("1\tx\tFW_R_LIM\t50\t9\n", r"line 1 is '1\\tx\\tFW_R_LIM\\t50\\t9': it is not a parameter with a value"),
        (
            "ROLL_LIMIT_DEG,45\n1\t1\tWP_LOITER_RAD\t50\t9\n",
            r"line 2 is '1\\t1\\tWP_LOITER_RAD.*: it is not a parameter",
        ),
        ("{}", "line 1 is '{}': it is not a parameter with a value"),
        ("\x00" * 500, r"line 1 is '(\\x00)+\.\.\.: it is not a parameter with a value"),
        (b"\xff\xfe", "it is not UTF-8 text, see byte 0"),
    ],
)
def test_what_cannot_be_meant_is_refused_in_a_sentence(tmp_path, text, sentence):
    with pytest.raises(InvalidArgument, match=rf"^parameters file '.*uav\.param': {sentence}") as refusal:
        read(tmp_path, text)
    assert refusal.value.argument == "parameters"
    assert "\n" not in str(refusal.value)


def test_a_file_that_is_not_there_is_refused(tmp_path):
    with pytest.raises(InvalidArgument, match=r"none\.param': it cannot be read, No such file or directory$"):
        read_parameters(tmp_path / "none.param")
