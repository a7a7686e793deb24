"""The picture of flights: what is drawn is what was flown."""

import numpy as np
import pytest

from loiter import Aircraft, Orbit, Pose, Wind, plan
from loiter.lab.picture import draw
from loiter.lab.trials import settings
from loiter.lab.trials.campaign import Trial
from loiter.lab.trials.flight import fly

TRIAL = Trial(plan(Pose(-300.0, 120.0, 90.0), Orbit(0.0, 0.0, 80.0), Aircraft(18.0, max_bank_deg=35.0)), 1)


@pytest.fixture(scope="module")
def flights():
    setting = settings.kinematic_setting()
    return {
        name: fly(setting.laws[name](TRIAL), setting.simulator(TRIAL), TRIAL.ideal.orbit) for name in ("optimal", "l1")
    }


def line(axes, gid):
    [found] = [artist for artist in axes.get_lines() if artist.get_gid() == gid]
    return found.get_xdata(), found.get_ydata()


def test_tracks_bank_and_time_to_join_are_those_of_the_flights(flights):
    tracks, bank, join = draw(TRIAL.ideal, flights).axes
    for name, flight in flights.items():
        assert np.array_equal(line(tracks, f"track {name}"), [flight.track.east_m, flight.track.north_m])
        time_s = flight.track.time_s - flight.track.time_s[0]
        assert np.array_equal(line(bank, f"bank {name}"), [time_s, flight.track.bank_deg])
        [east], [north] = line(tracks, f"settled {name}")
        assert np.hypot(east, north) == pytest.approx(80.0, rel=0.05)
    track = flights["optimal"].track
    assert np.array_equal(line(join, "join optimal"), [track.elapsed_s, track.time_to_join_s], equal_nan=True)


def test_laws_that_predict_no_time_to_join_are_named(flights):
    """Such a law reports 0 on the circle, which is no countdown."""
    _, _, join = draw(TRIAL.ideal, flights).axes
    assert [line.get_gid() for line in join.get_lines()] == ["join optimal"]
    assert [text.get_text() for text in join.texts] == ["not predicted by l1"]
    _, _, join = draw(TRIAL.ideal, {"optimal": flights["optimal"]}).axes
    assert not join.texts


def test_the_legend_has_a_dot_for_each_law_that_settled(flights):
    legend = draw(TRIAL.ideal, flights).axes[0].get_legend()
    labels = [text.get_text() for text in legend.get_texts()]
    laws = [f"{name}: settled in {flight.settled_s:.1f} s (dot)" for name, flight in flights.items()]
    assert labels == ["fastest entry", "holding circle", *laws]
    assert [handle.get_marker() for handle in legend.legend_handles] == ["None", "None", "o", "o"]


def test_an_arrow_on_each_track_and_four_on_the_circle_point_the_way_flown(flights):
    axes = draw(TRIAL.ideal, flights).axes[0]
    for name, flight in flights.items():
        [arrow] = [text for text in axes.texts if text.get_gid() == f"direction {name}"]
        east, north = np.array(arrow.xy) - np.array(arrow.xyann)
        i = np.argmin(np.hypot(flight.track.east_m - arrow.xy[0], flight.track.north_m - arrow.xy[1]))
        assert 0.0 < flight.track.elapsed_s[i] < flight.joined_s
        assert east * flight.track.velocity_east_m_s[i] + north * flight.track.velocity_north_m_s[i] > 0.0
    assert len([text for text in axes.texts if text.get_gid() == f"held {TRIAL.ideal.turn}"]) == 4
    [start] = [mark for mark in axes.get_lines() if mark.get_gid() == "start"]
    assert np.allclose(start.get_xydata(), [[-300.0, 120.0]])


def test_from_far_away_a_panel_enlarges_the_circle():
    ideal = plan(Pose(-4000.0, 120.0, 90.0), TRIAL.ideal.orbit, TRIAL.ideal.aircraft)
    setting, far = settings.kinematic_setting(), Trial(ideal, 1)
    flight = fly(setting.laws["optimal"](far), setting.simulator(far), ideal.orbit)
    figure = draw(ideal, {"optimal": flight})
    tracks, circle, _, _ = figure.axes
    (west, east), (south, north) = circle.get_xlim(), circle.get_ylim()
    assert west < -80.0 < 80.0 < east < 200.0
    assert south < -80.0 < 80.0 < north < 200.0
    for axes, expected in ((tracks, []), (circle, ["settled optimal"])):
        assert [mark.get_gid() for mark in axes.get_lines() if str(mark.get_gid()).startswith("settled")] == expected
    assert figure.get_suptitle().startswith("Law optimal in closed loop\n")
    assert tracks.get_legend().legend_handles[-1].get_marker() == "o"


def test_a_start_on_the_circle_has_no_fastest_entry_in_the_legend():
    ideal = plan(Pose(80.0, 0.0, 180.0), Orbit(0.0, 0.0, 80.0), TRIAL.ideal.aircraft)
    setting, on_circle = settings.kinematic_setting(), Trial(ideal, 1)
    flight = fly(setting.laws["optimal"](on_circle), setting.simulator(on_circle), ideal.orbit)
    axes = draw(ideal, {"optimal": flight}).axes[0]
    assert not [artist for artist in axes.get_lines() if artist.get_gid() == "ideal"]
    assert axes.get_legend().get_texts()[0].get_text() == "holding circle"


def test_the_fastest_entry_lies_beneath(flights):
    east, north = line(draw(TRIAL.ideal, flights).axes[0], "ideal")
    assert (east[0], north[0]) == (-300.0, 120.0)
    assert (east[-1], north[-1]) == pytest.approx((TRIAL.ideal.join.east_m, TRIAL.ideal.join.north_m))


def test_who_has_not_settled_is_said_so():
    setting = settings.kinematic_setting()
    short = fly(setting.laws["l1"](TRIAL), setting.simulator(TRIAL), TRIAL.ideal.orbit, limit_s=1.0)
    axes = draw(TRIAL.ideal, {"l1": short}).axes[0]
    assert [text.get_text() for text in axes.get_legend().get_texts()] == [
        "fastest entry",
        "holding circle",
        "l1: not settled",
    ]
    assert not [artist for artist in axes.get_lines() if artist.get_gid() == "settled l1"]


def test_the_title_says_what_was_flown_and_the_axis_where_the_bank_is_positive(flights):
    tracks, bank, _ = draw(TRIAL.ideal, flights).axes
    circle = f"onto a circle of 80 m, {TRIAL.ideal.turn.described}, at 18 m/s"
    assert tracks.get_title() == f"Laws optimal and l1 in closed loop\n{circle}"
    assert "right +" in bank.get_ylabel()
    simulator = "simulator point, gusts 0.05 of the airspeed, seed 0"
    assert draw(TRIAL.ideal, flights, conditions=simulator).axes[0].get_title().endswith(f"m/s\n{simulator}")
    one = draw(TRIAL.ideal, {"l1": flights["l1"]}).axes[0]
    assert one.get_title().startswith("Law l1 in closed loop\n")


def test_the_wind_is_in_the_title(flights):
    ideal = plan(TRIAL.ideal.start, TRIAL.ideal.orbit, TRIAL.ideal.aircraft, Wind(4.0, from_deg=250.0))
    assert draw(ideal, flights).axes[0].get_title().endswith("at 18 m/s, wind 4 m/s from 250 deg")
    assert "right +" in draw(ideal, flights).axes[1].get_ylabel()


def test_a_right_turn_has_positive_bank(flights):
    track = flights["optimal"].track
    right = np.argmax(track.bank_deg)
    assert track.bank_deg[right] > 20.0
    assert np.diff(np.unwrap(track.heading_deg, period=360.0))[right - 1] > 0.0
