"""What the picture shows, read back from the artists on its axes."""

import re
from dataclasses import replace
from functools import cache
from itertools import pairwise
from math import cos, hypot, radians, sin

import numpy as np
import pytest
from matplotlib.colors import same_color, to_rgb
from matplotlib.text import Annotation

from loiter import Aircraft, Orbit, Pose, Wind, candidates, plan, plan_all
from loiter.geo import LocalFrame
from loiter.plot.picture import draw
from planning.flying import fly

UAV, UNIT = Aircraft(18.0, max_bank_deg=35.0), Aircraft(1.0, min_turn_radius_m=1.0)
FAR = Pose(-400.0, 120.0, 90.0), Orbit(0.0, 0.0, 80.0), UAV
LRL = Pose(-0.53, 0.31, 90.0), Orbit(0.0, 0.0, 1.0), UNIT
ON_CIRCLE = Pose(80.0, 0.0, 180.0), Orbit(0.0, 0.0, 80.0), UAV
SCENES = {
    "far": FAR,
    "three turns": LRL,
    "four optima": (Pose(3.0, 0.0, 90.0), Orbit(0.0, 0.0, 1.0), UNIT),
    "on the circle": ON_CIRCLE,
    "at the centre": (Pose(0.0, 0.0, 180.0), Orbit(0.0, 0.0, 80.0), UAV),
    "away from the origin": (Pose(400300.0, 5200120.0, -20.0), Orbit(400000.0, 5200000.0, 120.0), UAV),
    "one way": (Pose(10.0, -20.0, 45.0), Orbit(0.0, 0.0, 80.0, "ccw"), UAV),
}
each_scene = pytest.mark.parametrize("scene", SCENES.values(), ids=SCENES)


def fresh(scene, everything=False):
    """The axes with the first optimum, or each, over the other extremals; and those drawn as best and as others."""
    best = plan_all(*scene)[: None if everything else 1]
    others = [m for m in candidates(*scene) if m not in best]
    return draw(best, others).axes[0], best, others


# For those who only look: whoever changes the size of a figure needs a fresh one.
drawn = cache(fresh)


def artists(axes, gid):
    return [artist for artist in axes.get_children() if artist.get_gid() == gid]


def segment_lines(axes):
    return [line for line in axes.lines if (line.get_gid() or "").startswith("segment")]


def points(line):
    return np.column_stack(line.get_data())


def size(scene):
    pose, orbit, _ = scene
    return max(1.0, orbit.radius_m, abs(orbit.east_m), abs(orbit.north_m), abs(pose.east_m), abs(pose.north_m))


def place(pose):
    return pytest.approx([pose.east_m, pose.north_m], abs=1e-9)


def legend(axes):
    """Each label of the legend, and its line."""
    found = axes.get_legend()
    return {text.get_text(): line for text, line in zip(found.get_texts(), found.get_lines(), strict=True)}


def test_the_scenes_show_every_kind_of_answer():
    assert {len(plan_all(*scene)) for scene in SCENES.values()} == {1, 2, 4}
    assert {plan_all(*scene)[0].word for scene in SCENES.values()} >= {"RSL", "LRL", ""}


# Axes


@each_scene
def test_a_metre_east_is_as_long_as_a_metre_north(scene):
    axes, _, _ = drawn(scene)
    axes.figure.draw_without_rendering()
    (east, _), (_, north) = np.diff(axes.transData.transform([[0, 0], [1, 0], [1, 1]]), axis=0)
    assert east == pytest.approx(north, rel=5e-3)  # nearer than this, matplotlib leaves the limits alone
    assert axes.get_aspect() == 1.0


def test_the_labels_name_direction_and_unit():
    axes, _, _ = drawn(FAR)
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("east (m)", "north (m)")


@each_scene
def test_ticks_show_coordinates_without_an_offset(scene):
    axes, _, _ = drawn(scene)
    axes.figure.draw_without_rendering()
    assert [axis.get_offset_text().get_text() for axis in (axes.xaxis, axes.yaxis)] == ["", ""]


@each_scene
def test_everything_lies_within_the_axes(scene):
    axes, _, _ = drawn(scene)
    (west, east), (south, north) = axes.get_xlim(), axes.get_ylim()
    orbit = scene[1]
    corners = [(orbit.east_m - orbit.radius_m, orbit.north_m - orbit.radius_m)]
    corners += [(orbit.east_m + orbit.radius_m, orbit.north_m + orbit.radius_m)]
    shown = np.vstack([corners, *(points(line) for line in axes.lines)])
    assert west < shown[:, 0].min() <= shown[:, 0].max() < east
    assert south < shown[:, 1].min() <= shown[:, 1].max() < north


@each_scene
def test_the_title_says_word_direction_and_time(scene):
    axes, [best], _ = drawn(scene)
    title = axes.get_title()
    assert best.word in title
    assert best.turn.described in title
    assert ("through the air" in title) == (bool(best.segments) and (best.wind.speed_m_s > 0.0 or best.orbit.moves))
    assert (f"{best.duration_s:.4g} s" if best.segments else "on the circle already") in title


# The path


@pytest.mark.parametrize("everything", [False, True])
@each_scene
def test_each_segment_is_drawn_from_its_start_to_its_end(scene, everything):
    axes, best, _ = drawn(scene, everything)
    segments = [segment for maneuver in best for segment in maneuver.segments]
    lines = segment_lines(axes)
    assert [line.get_gid() for line in lines] == [f"segment {segment.letter}" for segment in segments]
    for line, segment in zip(lines, segments, strict=True):
        ends = [(pose.east_m, pose.north_m) for pose in (segment.start, segment.end)]
        assert points(line)[[0, -1]] == pytest.approx(np.array(ends), abs=1e-9 * size(scene))


@pytest.mark.parametrize("everything", [False, True])
@each_scene
def test_a_turn_is_drawn_on_its_arc_and_a_straight_piece_on_its_line(scene, everything):
    axes, best, _ = drawn(scene, everything)
    radius = scene[2].turn_radius_m
    segments = [segment for maneuver in best for segment in maneuver.segments]
    for line, segment in zip(segment_lines(axes), segments, strict=True):
        heading = radians(segment.start.heading_deg)
        ahead, left = np.array([sin(heading), cos(heading)]), np.array([-cos(heading), sin(heading)])
        away = points(line) - [segment.start.east_m, segment.start.north_m]
        if segment.letter == "S":
            assert away @ left == pytest.approx(0.0, abs=1e-9 * size(scene))
            assert np.all(np.diff(away @ ahead) > 0.0)
        else:
            centre = left * (radius if segment.letter == "L" else -radius)
            assert np.hypot(*(away - centre).T) == pytest.approx(radius, abs=1e-9 * size(scene))


def test_a_turn_looks_round():
    axes, _, _ = drawn(LRL)
    for line in segment_lines(axes):
        chords = np.hypot(*np.diff(points(line), axis=0).T)
        assert chords.max() < 0.1 * UNIT.turn_radius_m


def test_each_letter_has_its_colour_and_the_legend_tells_it():
    axes, _, _ = drawn(FAR, everything=True)
    labels = legend(axes)
    names = {"L": "left turn", "S": "straight", "R": "right turn"}
    for line in segment_lines(axes):
        assert same_color(line.get_color(), labels[names[line.get_gid()[-1]]].get_color())
    assert len({to_rgb(line.get_color()) for line in segment_lines(axes)}) == 3


def track_size(line):
    return np.ptp(points(line), axis=0).max()


@each_scene
def test_an_arrow_on_each_segment_but_the_shortest_points_the_way_flown(scene):
    axes, _, _ = drawn(scene)
    shown = np.vstack([points(line) for line in axes.lines])
    lines = [line for line in segment_lines(axes) if track_size(line) > 0.05 * np.ptp(shown, axis=0).max()]
    arrows = [arrow for arrow in axes.texts if (arrow.get_gid() or "").startswith("arrow")]
    assert len(lines) <= len(arrows) <= len(segment_lines(axes))
    for line in lines:
        [arrow] = [arrow for arrow in arrows if np.hypot(*(points(line) - arrow.xy).T).min() < 1e-9 * size(scene)]
        tail, head = np.array(arrow.xyann), np.array(arrow.xy)
        nearest = int(np.argmin(np.hypot(*(points(line) - head).T)))
        before, after = points(line)[max(nearest - 1, 0)], points(line)[min(nearest + 1, len(points(line)) - 1)]
        assert (head - tail) @ (after - before) > 0.0


def test_a_segment_shorter_than_its_arrow_has_none():
    axes = draw(plan_all(*FAR)[:1]).axes[0]
    first, *_ = segment_lines(axes)
    assert track_size(first) < 480.0 / 30.0
    axes.figure.draw_without_rendering()
    assert shown_arrows(axes) == ["arrow S", "arrow L"]


def shown_arrows(axes):
    """The gids of the arrows on segments that are long enough for one."""
    return [gid for arrow in axes.texts if (gid := arrow.get_gid() or "").startswith("arrow") and arrow.is_shown]


def test_in_a_narrow_picture_a_last_turn_shorter_than_three_marks_has_no_arrow(monkeypatch):
    """There the arrow would lie below the circles of the switch and of the join."""
    figure = draw([plan(Pose(-560.0, 30.0, 90.0), Orbit(0.0, 0.0, 80.0), UAV)])
    [axes] = figure.axes
    figure.draw_without_rendering()
    assert "arrow L" in shown_arrows(axes)
    figure.set_size_inches(3.3, 2.4)
    figure.draw_without_rendering()
    assert shown_arrows(axes) == ["arrow S"]
    drawn_gids = []
    monkeypatch.setattr(Annotation, "draw", lambda self, renderer: drawn_gids.append(self.get_gid()))
    figure.draw_without_rendering()
    assert "arrow S" in drawn_gids
    assert "arrow L" not in drawn_gids


def test_what_is_slower_is_not_drawn_as_the_best():
    extremals = candidates(*FAR)
    figure = draw(extremals)
    [axes] = figure.axes
    best = plan_all(*FAR)
    assert len(extremals) > len(best)
    assert axes.get_title() == draw(best).axes[0].get_title()
    assert len(segment_lines(axes)) == sum(len(maneuver.segments) for maneuver in best)
    assert artists(axes, "slower cw")
    assert draw(extremals[::-1]).axes[0].get_title().count(" or ") == len(best) - 1


# Marks


@each_scene
def test_switches_and_join_are_marked(scene):
    axes, [best], _ = drawn(scene)
    switches = artists(axes, "switch")
    assert len(switches) == max(len(best.segments) - 1, 0)
    for mark, segment in zip(switches, best.segments[1:], strict=True):
        assert points(mark)[0] == place(segment.start)
    [join] = artists(axes, "join")
    assert points(join)[0] == place(best.join)


@each_scene
def test_the_start_is_marked_by_a_dart_along_the_heading(scene):
    axes, _, _ = drawn(scene)
    pose = scene[0]
    [start] = artists(axes, "start")
    assert points(start)[0] == place(pose)
    outline = np.asarray(start.get_marker())
    nose = outline[np.argmax(np.hypot(*outline.T))]
    heading = radians(pose.heading_deg)
    assert nose / np.hypot(*nose) == pytest.approx([sin(heading), cos(heading)], abs=1e-12)


@each_scene
def test_the_circle_is_drawn_where_it_is(scene):
    axes, _, _ = drawn(scene)
    orbit = scene[1]
    [circle], [centre] = artists(axes, "circle"), artists(axes, "centre")
    assert circle.get_center() == (orbit.east_m, orbit.north_m)
    assert circle.get_radius() == orbit.radius_m
    assert not circle.get_fill()
    assert points(centre).tolist() == [[orbit.east_m, orbit.north_m]]


def circle_arrows(axes, orbit):
    """Each black arrow's tail and head, from the centre of the circle."""
    centre = np.array([orbit.east_m, orbit.north_m])
    held = [arrow for arrow in axes.texts if (arrow.get_gid() or "").startswith("held")]
    return [(np.array(arrow.xyann) - centre, np.array(arrow.xy) - centre) for arrow in held]


@pytest.mark.parametrize("everything", [False, True])
@each_scene
def test_arrows_on_the_circle_point_the_way_it_is_held(scene, everything):
    axes, best, _ = drawn(scene, everything)
    senses = []
    for tail, head in circle_arrows(axes, scene[1]):
        assert [hypot(*tail), hypot(*head)] == pytest.approx([scene[1].radius_m] * 2, abs=1e-9 * size(scene))
        senses.append("cw" if tail[0] * head[1] - tail[1] * head[0] < 0.0 else "ccw")
    assert set(senses) == {maneuver.turn.value for maneuver in best}


@each_scene
def test_the_scale_bar_is_as_long_as_it_says_and_hides_nothing(scene):
    axes, _, _ = fresh(scene)
    figure = axes.figure
    figure.draw_without_rendering()
    [bar] = artists(axes, "scale")
    number, unit = bar.label.get_text().split()
    assert bar.bar.get_linewidth() == 0.0
    assert bar.bar.get_width() == pytest.approx(float(number) * {"m": 1.0, "km": 1000.0}[unit], rel=1e-9)
    west, east = axes.get_xlim()
    assert 0.04 < bar.bar.get_width() / (east - west) <= 0.2
    assert bar.bar.get_window_extent().height * 72.0 / figure.dpi == pytest.approx(2.5, rel=0.02)
    box = bar.get_window_extent()
    assert 0.0 <= box.y0 < box.y1 < axes.bbox.y0
    assert axes.xaxis.label.get_window_extent().x1 < box.x0 < box.x1 <= figure.bbox.x1
    ticks = [label.get_window_extent() for label in axes.get_xticklabels() if label.get_text()]
    assert not any(box.overlaps(tick) for tick in ticks)


@pytest.mark.parametrize("scene", [FAR, ON_CIRCLE], ids=["two lines", "one line"])
def test_the_north_arrow_points_north_and_is_whole(scene):
    """Also where the title, which gives the arrow its room, has one line only."""
    axes, _, _ = fresh(scene)
    figure = axes.figure
    figure.draw_without_rendering()
    [north] = artists(axes, "north")
    assert north.get_text() == "N"
    assert north.xy[0] == north.xyann[0]
    assert north.xy[1] > north.xyann[1]
    box, arrow = north.get_window_extent(), north.arrow_patch.get_window_extent()
    assert axes.bbox.y1 < box.y0 < arrow.y0 < arrow.y1 <= box.y1 <= figure.bbox.y1
    assert box.x1 <= figure.bbox.x1
    assert not box.overlaps(axes.title.get_window_extent())


def test_the_axes_say_where_on_earth_they_begin():
    assert draw(plan_all(*FAR)).axes[0].get_xlabel() == "east (m)"
    placed = draw(plan_all(*FAR), frame=LocalFrame(-33.5, 179.25)).axes[0]
    assert placed.get_xlabel() == "east of 33.500000 S 179.250000 E (m)"


def test_arrows_of_both_directions_stand_apart():
    axes, _, _ = drawn(FAR, everything=True)
    heads = [head for _, head in circle_arrows(axes, FAR[1])]
    gaps = [hypot(*(a - b)) for i, a in enumerate(heads) for b in heads[:i]]
    assert min(gaps) > 0.1 * FAR[1].radius_m


# The losers


def soonest(others):
    """The soonest of each direction of holding, the sooner first."""
    flown = sorted((m for m in others if m.segments), key=lambda m: m.duration_s)
    return [next(m for m in flown if m.turn == turn) for turn in dict.fromkeys(m.turn for m in flown)]


def bands(axes):
    return [line for line in axes.lines if (line.get_gid() or "").startswith("slower")]


@each_scene
def test_the_soonest_loser_of_each_direction_is_a_band_from_the_start_below_the_path(scene):
    axes, [best], others = drawn(scene)
    losers = soonest(others)
    assert len(bands(axes)) == len(losers) > 0
    for line, other in zip(bands(axes), losers, strict=True):
        assert points(line)[0] == place(best.start)
        assert points(line)[-1] == pytest.approx([other.join.east_m, other.join.north_m], abs=1e-9 * size(scene))
        # Wider than the path above it, so that it is seen where both are the same.
        assert all(line.get_linewidth() > bold.get_linewidth() + 1.0 for bold in segment_lines(axes))
        assert all(line.get_zorder() < bold.get_zorder() for bold in segment_lines(axes))


@each_scene
def test_the_slower_loser_is_wider_paler_and_below(scene):
    """So it is seen, too, where both are the same."""
    axes, _, _ = drawn(scene)
    for sooner, later in pairwise(bands(axes)):
        assert later.get_linewidth() > sooner.get_linewidth() + 2.0
        assert later.get_zorder() < sooner.get_zorder()
        assert min(to_rgb(later.get_color())) > max(to_rgb(sooner.get_color())) + 0.1


def test_the_order_of_the_losers_does_not_matter():
    best, *others = candidates(*LRL)
    assert list(legend(draw([best], others).axes[0])) == list(legend(draw([best], others[::-1]).axes[0]))


@each_scene
def test_each_loser_is_labelled_with_its_cost_in_its_own_style(scene):
    axes, [best], others = drawn(scene)
    labels = legend(axes)
    for line, other in zip(bands(axes), soonest(others), strict=True):
        cost = other.duration_s - best.duration_s
        entry = labels[f"{other.word} {other.turn.value}: {'as fast' if cost < 1e-9 else f'{cost:.3g} s later'}"]
        assert (entry.get_color(), entry.get_linewidth()) == (line.get_color(), line.get_linewidth())


def test_numbers_are_written_in_full():
    far, soon = draw(plan_all(Pose(80000.0, 0.0, 90.0), FAR[1], UAV)), candidates(*FAR)
    assert re.search(r"joins in \d{4} s, 8\d{4} m$", far.get_suptitle())
    slow = replace(soon[-1], segments=tuple(replace(s, duration_s=1000.0 * s.duration_s) for s in soon[-1].segments))
    assert any(re.search(r"(cw|ccw): \d{5} s later", label) for label in legend(draw(soon[:1], [slow]).axes[0]))


@each_scene
def test_the_aircraft_hides_no_path(scene):
    axes, _, _ = drawn(scene)
    [start] = artists(axes, "start")
    assert all(start.get_zorder() < line.get_zorder() for line in segment_lines(axes))


def test_without_others_no_loser_is_drawn_or_labelled():
    best = plan_all(*FAR)
    axes = draw(best).axes[0]
    assert bands(axes) == []
    assert set(legend(axes)) == {"right turn", "straight", "left turn", "holding circle", "switch", "join"}


# The legend

LABELS = {
    "right turn": "segment R",
    "straight": "segment S",
    "left turn": "segment L",
    "holding circle": "circle",
    "circle at the start": "circle at the start",
    "switch": "switch",
    "join": "join",
}


def drawn_labels(figure):
    """The labels of the kinds of artists that are drawn on any panel."""
    gids = {artist.get_gid() for axes in figure.axes for artist in axes.get_children()}
    return {label for label, gid in LABELS.items() if gid in gids}


@pytest.mark.parametrize("everything", [False, True])
@each_scene
def test_the_legend_lists_what_is_drawn(scene, everything):
    axes, best, _ = drawn(scene, everything)
    listed = {label for label in legend(axes) if not re.search(r" (cw|ccw): ", label)}
    assert listed == drawn_labels(axes.figure)
    assert ("switch" in listed) == any(len(maneuver.segments) > 1 for maneuver in best)


# Long entries

LONG = {
    "100 radii": (Pose(-8000.0, 1500.0, 300.0), Orbit(0.0, 0.0, 80.0), UAV),
    "a large circle": (Pose(-3000.0, 1000.0, 90.0), Orbit(0.0, 0.0, 1500.0), UAV),
    "in wind": (Pose(6000.0, 0.0, 90.0), Orbit(0.0, 0.0, 120.0), UAV, Wind(5.0, 200.0)),
    "a circle that moves": (Pose(-6000.0, 1200.0, 350.0), Orbit(0.0, 0.0, 120.0, "either", 4.2, -4.2), UAV),
}
each_long_scene = pytest.mark.parametrize("scene", LONG.values(), ids=LONG)


@each_scene
def test_a_short_entry_has_one_panel(scene):
    axes, _, _ = drawn(scene)
    assert axes.figure.axes == [axes]


@each_long_scene
def test_a_second_panel_enlarges_the_last_turn_of_a_long_entry(scene):
    axes, [best], _ = fresh(scene)
    figure = axes.figure
    figure.draw_without_rendering()
    _, detail = figure.axes
    *_, last = best.segments
    *_, turn = segment_lines(detail)
    pixels = detail.transData.transform(points(turn))
    assert np.all((pixels > detail.bbox.min) & (pixels < detail.bbox.max))
    [join] = artists(detail, "join")
    assert points(join)[0] == place(best.join)
    # A turn radius is larger than the mark of the join.
    pixels_per_metre = detail.bbox.width / np.diff(detail.get_xlim())[0]
    assert UAV.turn_radius_m * pixels_per_metre > join.get_markersize() * figure.dpi / 72.0
    assert len([arrow for arrow in detail.texts if arrow.get_gid() == f"held {best.turn}"]) == 4
    assert f"arrow {last.letter}" in [arrow.get_gid() for arrow in detail.texts]


@each_long_scene
def test_the_second_panel_says_what_it_enlarges_and_its_numbers_are_apart_from_the_lines(scene):
    axes, [best], _ = drawn(scene)
    figure, detail = axes.figure, axes.figure.axes[1]
    starts = np.array([[segment.start.east_m, segment.start.north_m] for segment in best.segments])
    box = np.array([detail.get_xlim(), detail.get_ylim()])
    whole = bool(np.all((starts >= box[:, 0]) & (starts <= box[:, 1])))
    assert detail.get_title() == ("the path, enlarged" if whole else "the last turn, enlarged")
    figure.draw_without_rendering()
    numbers = [label.get_window_extent() for label in detail.get_yticklabels() if label.get_text()]
    assert numbers
    assert all(number.x0 > detail.bbox.x1 for number in numbers)


def test_a_wide_scene_with_a_second_panel_has_a_low_picture():
    heights = {name: drawn(scene)[0].figure.get_figheight() for name, scene in LONG.items()}
    assert heights["100 radii"] < 0.7 * heights["a large circle"]


@each_long_scene
def test_the_overview_frames_what_is_enlarged_and_leaves_its_marks_out(scene):
    axes, [best], _ = drawn(scene)
    detail = axes.figure.axes[1]
    axes.figure.draw_without_rendering()
    [frame] = artists(axes, "frame")
    corners = frame.get_bbox().get_points()
    assert corners[:, 0] == pytest.approx(detail.get_xlim())
    assert corners[:, 1] == pytest.approx(detail.get_ylim())
    assert artists(axes, "join") == []
    assert not [arrow for arrow in axes.texts if (arrow.get_gid() or "").startswith("held")]
    ends = [points(line)[[0, -1]] for line in segment_lines(axes)]
    assert ends[0][0] == place(best.start)
    assert ends[-1][-1] == place(best.join)
    lines = [line for line in axes.figure.artists if line.get_gid() == "connection"]
    assert len(lines) == 2


@each_long_scene
def test_a_long_entry_has_title_and_legend_once(scene):
    axes, [best], _ = drawn(scene)
    detail = axes.figure.axes[1]
    assert axes.figure.get_suptitle().startswith(f"{best.word} {best.turn.described}\njoins in ")
    assert axes.get_title() == ""
    assert detail.get_legend() is None
    listed = {label for label in legend(axes) if not re.search(r" (cw|ccw): ", label)}
    assert listed == drawn_labels(axes.figure) >= {"join", "switch", "holding circle"}


def test_a_long_entry_is_drawn_without_a_warning(caplog):
    axes, _, _ = drawn(LONG["100 radii"])
    axes.figure.draw_without_rendering()
    assert not caplog.records


# The ends of what can be drawn


def test_on_the_circle_already_only_start_circle_and_join_are_drawn():
    axes, [best], _ = drawn(ON_CIRCLE)
    assert best.segments == ()
    assert segment_lines(axes) == []
    [join], [start] = artists(axes, "join"), artists(axes, "start")
    assert points(join).tolist() == points(start).tolist() == [[80.0, 0.0]]
    assert "nan" not in axes.get_title()


def test_two_directions_that_both_count_as_joined_can_be_drawn():
    """A tolerance as large as the circle: each answer is to fly nothing."""
    best = plan_all(Pose(0.0, 0.0, 0.0), Orbit(0.0, 0.0, 80.0), UAV, tolerance_m=1000.0)
    assert [m.segments for m in best] == [(), ()]
    assert len(artists(draw(best[:1], best[1:]).axes[0], "join")) == 1


# Wind, and circles that move

WINDY = {
    "wind": (Pose(-400.0, 120.0, 90.0), Orbit(0.0, 0.0, 120.0), UAV, Wind(8.0, 250.0)),
    "a circle that moves": (Pose(-400.0, 120.0, 90.0), Orbit(0.0, 0.0, 120.0, "either", 5.0, -3.0), UAV, None),
    "both": (Pose(30.0, 20.0, 200.0), Orbit(0.0, 0.0, 160.0, "cw", -4.0, 2.0), UAV, Wind(6.0, 20.0)),
}
each_windy_scene = pytest.mark.parametrize("scene", WINDY.values(), ids=WINDY)


@each_windy_scene
def test_in_wind_the_ground_track_is_drawn(scene):
    axes, [best], _ = drawn(scene)
    east, north = (0.0, 0.0) if scene[3] is None else scene[3].velocity_m_s
    for line, segment in zip(segment_lines(axes), best.segments, strict=True):
        end = fly(segment.start, [segment], UAV.airspeed_m_s, (east, north))
        assert points(line)[0] == place(segment.start)
        assert points(line)[-1] == pytest.approx(end[:2], abs=1e-9)
        half = replace(segment, duration_s=segment.duration_s / 2.0)
        middle = fly(segment.start, [half], UAV.airspeed_m_s, (east, north))[:2]
        chord = np.hypot(*np.diff(points(line), axis=0).T).max()
        assert np.hypot(*(points(line) - middle).T).min() <= 0.51 * chord


@each_windy_scene
def test_the_circle_is_drawn_where_it_is_joined_and_faint_where_it_was(scene):
    axes, [best], _ = drawn(scene)
    [circle], before = artists(axes, "circle"), artists(axes, "circle at the start")
    [join] = artists(axes, "join")
    centre = np.array(circle.get_center())
    assert hypot(*(points(join)[0] - centre)) == pytest.approx(scene[1].radius_m, abs=1e-9)
    orbit = scene[1]
    moved = np.array([orbit.velocity_east_m_s, orbit.velocity_north_m_s]) * best.duration_s
    assert centre == pytest.approx(moved, abs=1e-9)
    assert [artist.get_center() for artist in before] == ([(0.0, 0.0)] if orbit.moves else [])
    [mark] = artists(axes, "centre")
    assert points(mark)[0] == pytest.approx(centre)
    assert ("circle at the start" in legend(axes)) == orbit.moves
    ways = artists(axes, "way of the centre")
    assert [points(way)[-1].tolist() for way in ways] == ([centre.tolist()] if orbit.moves else [])


@each_windy_scene
def test_the_wind_arrow_points_where_the_air_goes(scene):
    axes, _, _ = drawn(scene)
    arrows, labels = artists(axes, "wind"), artists(axes, "wind label")
    wind = scene[3]
    assert len(arrows) == len(labels) == (wind is not None)
    for arrow, label in zip(arrows, labels, strict=True):
        pointed = np.array(arrow.xy) - np.array(arrow.xyann)
        assert pointed / hypot(*pointed) == pytest.approx(np.array(wind.velocity_m_s) / wind.speed_m_s)
        assert label.get_text() == f"wind {wind.speed_m_s:g} m/s\nfrom {wind.from_deg:g} deg"


def test_lengths_in_the_least_wind_are_those_through_the_air():
    pose, orbit, uav, _ = WINDY["wind"]
    assert draw([plan(pose, orbit, uav, Wind(0.1, 250.0))]).axes[0].get_title().endswith(" m through the air")


@pytest.mark.parametrize("from_deg", [0.0, 90.0, 180.0, 270.0])
def test_the_wind_arrow_is_not_cut_off_and_hides_nothing(from_deg):
    pose, orbit, uav, _ = WINDY["wind"]
    figure = draw(plan_all(pose, orbit, uav, Wind(8.0, from_deg)))
    figure.draw_without_rendering()
    axes = figure.axes[0]
    for artist in (*artists(axes, "wind"), *artists(axes, "wind label")):
        box = artist.get_window_extent()
        assert figure.bbox.y0 <= box.y0
        assert figure.bbox.x0 <= box.x0
        assert box.y1 <= figure.bbox.y1
        assert box.y0 >= axes.bbox.y1 - 1.0
        assert not box.overlaps(axes.title.get_window_extent())
