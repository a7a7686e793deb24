"""What notebooks and programs show of a maneuver: a line, a drawing, plain values, a data frame, a figure."""

import json
import subprocess
import sys
import xml.etree.ElementTree as ET
from itertools import pairwise

import numpy as np
import pytest

import loiter
from loiter import Aircraft, Orbit, Pose, Wind, plan
from loiter.errors import InvalidArgument, MissingPackage
from loiter.files.document import maneuver_values
from loiter.planning import drawing

UAV = Aircraft(18.0, max_bank_deg=35.0)
POSE = Pose(-400.0, 120.0, 90.0)
STILL = plan(POSE, Orbit(0.0, 0.0, 80.0), UAV)
WINDY = plan(POSE, Orbit(0.0, 0.0, 120.0, velocity_east_m_s=3.0), UAV, Wind(5.0, from_deg=200.0))
TINY = plan(Pose(3.0, 0.0, 90.0), Orbit(0.0, 0.0, 1.5), Aircraft(1.0, min_turn_radius_m=1.0))
ON = plan(Pose(0.0, 80.0, 90.0), Orbit(0.0, 0.0, 80.0, "cw"), UAV)
ALL = [STILL, WINDY, TINY, ON]
SVG = "{http://www.w3.org/2000/svg}"


def test_a_maneuver_is_a_line_of_text():
    assert str(STILL) == "RSL, clockwise: joins in 19.8 s after 355.9 m"
    assert str(WINDY).endswith(" m through the air")
    assert str(ON) == "On the circle already, clockwise: nothing to fly."
    assert str(TINY).startswith(f"{TINY.word}, {TINY.turn.described}: joins in {TINY.duration_s:.3f} s")
    assert repr(STILL).startswith("Maneuver(start=Pose(")


def points(text):
    return np.array([[float(value) for value in pair.split(",")] for pair in text.split()])


@pytest.mark.parametrize("maneuver", ALL, ids=str)
def test_the_drawing_is_whole_and_inside_its_frame(maneuver):
    svg = ET.fromstring(maneuver._repr_svg_())
    width, height = float(svg.get("width")), float(svg.get("height"))
    lines = svg.findall(f"{SVG}polyline")
    assert [line.get("stroke") for line in lines] == [drawing.COLOURS[letter] for letter in maneuver.word]
    tracks = [points(line.get("points")) for line in lines]
    for track in tracks:
        assert (track >= 0.0).all()
        assert (track <= [width, height]).all()
    for before, after in pairwise(tracks):
        np.testing.assert_allclose(before[-1], after[0], atol=0.11)
    ring, *dots = svg.findall(f"{SVG}circle")
    centre, radius = np.array([float(ring.get("cx")), float(ring.get("cy"))]), float(ring.get("r"))
    assert (centre - radius >= 0.0).all()
    assert (centre + radius <= [width, height]).all()
    assert [dot.get("fill") for dot in dots] == ["white"] * max(len(lines) - 1, 0) + ["black"]
    if tracks:
        assert np.hypot(*(tracks[-1][-1] - centre)) == pytest.approx(radius, abs=0.3)
    assert svg.find(f"{SVG}title").text == str(maneuver)


@pytest.mark.parametrize("turn", ["cw", "ccw"])
def test_the_arrows_show_the_direction(turn):
    """On the north-eastern quarter a clockwise aircraft flies south-east, 135 degrees."""
    svg = ET.fromstring(plan(POSE, Orbit(0.0, 0.0, 80.0, turn), UAV)._repr_svg_())
    north_east, *_, aircraft = svg.findall(f"{SVG}polygon")
    assert north_east.get("transform").endswith("rotate(135.0)" if turn == "cw" else "rotate(-45.0)")
    assert aircraft.get("transform").endswith("rotate(90.0)")


def test_the_html_has_the_drawing_and_a_caption():
    html = ET.fromstring(STILL._repr_html_())
    assert [child.tag for child in html] == [f"{SVG}svg", "figcaption"]
    assert html.find("figcaption").text == str(STILL)


def test_a_drawing_needs_neither_matplotlib_nor_pandas():
    code = """if 1:
        import sys
        from loiter import Aircraft, Orbit, Pose, plan
        plan(Pose(-400.0, 120.0, 90.0), Orbit(0.0, 0.0, 80.0), Aircraft(18.0, max_bank_deg=35.0))._repr_html_()
        print([name for name in ("matplotlib", "pandas") if name in sys.modules])"""
    assert subprocess.run([sys.executable, "-c", code], capture_output=True, text=True).stdout == "[]\n"


@pytest.mark.parametrize("maneuver", ALL, ids=str)
def test_the_dictionary_is_that_of_the_command_line(maneuver):
    values = maneuver.to_dict()
    assert values == maneuver_values(maneuver)
    assert json.loads(json.dumps(values, allow_nan=False)) == values
    assert (values["word"], values["turn"]) == (maneuver.word, maneuver.turn)


def test_the_data_frame_has_the_samples():
    assert WINDY.to_dataframe().equals(WINDY.to_dataframe(0.1))
    frame, samples = WINDY.to_dataframe(0.5), WINDY.sample(0.5)
    assert list(frame.columns) == list(samples._fields)
    np.testing.assert_array_equal(frame.to_numpy().T, np.array(samples))


def test_without_pandas_a_sentence_says_so(monkeypatch):
    monkeypatch.setitem(sys.modules, "pandas", None)
    with pytest.raises(MissingPackage, match="a data frame needs pandas: pip install pandas"):
        STILL.to_dataframe(0.5)


@pytest.mark.parametrize("step", [0.0, -1.0, float("nan")])
def test_a_data_frame_needs_a_step(step):
    with pytest.raises(InvalidArgument, match="step_s is"):
        STILL.to_dataframe(step)


def test_a_maneuver_can_be_drawn():
    figure = loiter.plot.draw(STILL)
    shown = {artist.get_gid() for artist in figure.axes[0].get_children()}
    assert {"segment R", "segment S", "segment L", "circle", "start", "join"} <= shown
    several = loiter.plot.draw(loiter.plan_all(POSE, STILL.orbit, UAV), loiter.candidates(POSE, STILL.orbit, UAV)[1:])
    assert "slower cw" in {artist.get_gid() for artist in several.axes[0].get_children()}


@pytest.mark.parametrize(
    ("what", "sentence"),
    [((), "maneuver is missing: there is none to draw"), ([POSE], "it must be a loiter.Maneuver")],
)
def test_what_is_no_maneuver_is_not_drawn(what, sentence):
    with pytest.raises(InvalidArgument, match=sentence):
        loiter.plot.draw(what)
