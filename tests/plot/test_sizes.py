"""The size and the resolution of pictures, in files as they are written."""

import re
import warnings
from xml.etree import ElementTree

import numpy as np
import pytest
from matplotlib.figure import Figure
from matplotlib.text import Text
from PIL import Image

import loiter
from loiter import Aircraft, Orbit, Pose, Wind, candidates, plan
from loiter.cli.app import main
from loiter.errors import InvalidArgument
from loiter.plot import draw
from loiter.plot.files import save
from loiter.plot.sizes import LEAST_POINTS, PictureFormat, _balanced, resize

SCENE = (Pose(-400.0, 120.0, 90.0), Orbit(0.0, 0.0, 80.0), Aircraft(18.0, max_bank_deg=35.0))
BEST, *OTHERS = candidates(*SCENE)
PLAN = "plan --pose -400 120 90 --orbit 0 0 80 --airspeed 18 --bank 35"


def pixels(path):
    with Image.open(path) as image:
        return image.size, image.info.get("dpi")


@pytest.mark.parametrize(
    ("options", "size", "dpi"),
    [
        ("", (1200, 960), 150),
        ("--dpi 300", (2400, 1920), 300),
        ("--size 84 70", (496, 413), 150),
        ("--size 84,70 --dpi 600", (1984, 1653), 600),
        ("--size 8.4cm 4in --dpi 300", (992, 1200), 300),
    ],
)
def test_a_png_has_the_pixels_that_were_asked_for(tmp_path, options, size, dpi):
    path = tmp_path / "entry.png"
    assert main([*PLAN.split(), "--plot", str(path), *options.split()]) == 0
    found, found_dpi = pixels(path)
    assert found == pytest.approx(size, abs=1)
    assert found_dpi == pytest.approx((dpi, dpi), rel=1e-3)


def test_every_file_of_a_command_has_the_size(tmp_path):
    png, svg, pdf = (tmp_path / f"entry.{ending}" for ending in ("png", "svg", "pdf"))
    plots = [word for path in (png, svg, pdf) for word in ("--plot", str(path))]
    assert main([*PLAN.split(), *plots, "--size", "100", "120", "--dpi", "254", "--certify"]) == 0
    for name in ("entry", "entry-certificate"):
        assert pixels(tmp_path / f"{name}.png")[0] == pytest.approx((1000, 1200), abs=1)
        root = ElementTree.parse(tmp_path / f"{name}.svg").getroot()
        sides_mm = [float(root.get(side).removesuffix("pt")) / 72.0 * 25.4 for side in ("width", "height")]
        assert sides_mm == pytest.approx([100.0, 120.0], abs=0.01)
        box = re.search(rb"/MediaBox \[ 0 0 ([\d.]+) ([\d.]+) \]", (tmp_path / f"{name}.pdf").read_bytes())
        assert [float(side) / 72.0 * 25.4 for side in box.groups()] == pytest.approx([100.0, 120.0], abs=0.01)


@pytest.mark.parametrize(
    "command",
    [
        "fly --sim kinematic --pose -300 120 90 --orbit 0 0 80 --airspeed 18 --bank 35 --compare",
        "synthesis --cells 40",
    ],
)
def test_other_commands_have_the_same_options(tmp_path, command):
    path = tmp_path / "a.png"
    assert main([*command.split(), "--plot", str(path), "--size", "100", "120", "--dpi", "254"]) == 0
    assert pixels(path)[0] == pytest.approx((1000, 1200), abs=1)


def test_the_regions_of_a_map_have_the_resolution_in_a_pdf_too(tmp_path):
    sizes = []
    for dpi in ("100", "400"):
        path = tmp_path / f"{dpi}.pdf"
        assert main(["synthesis", "--cells", "100", "--plot", str(path), "--dpi", dpi]) == 0
        sizes.append(max(int(width) for width in re.findall(rb"/Width (\d+)", path.read_bytes())))
    assert sizes[1] == pytest.approx(4 * sizes[0], rel=0.02)


def points(figure):
    figure.draw_without_rendering()
    return [text.get_fontsize() for text in figure.findobj(Text) if text.get_text() and text.get_visible()]


def hidden_share(figure):
    """The share of the vertices of the entry that the legend covers."""
    figure.draw_without_rendering()
    (axes,) = figure.axes
    (legend,) = [*figure.legends, *filter(None, [axes.get_legend()])]
    box = legend.get_window_extent()
    segments = [line for line in axes.get_lines() if str(line.get_gid()).startswith("segment")]
    places = np.concatenate([axes.transData.transform(line.get_xydata()) for line in segments])
    inside = (places > [box.x0, box.y0]) & (places < [box.x1, box.y1])
    return np.mean(np.all(inside, axis=1))


@pytest.mark.parametrize("size_mm", [(84.0, 84.0), (84.0, 70.0), (174.0, 120.0), (80.0, 60.0)])
def test_a_narrow_picture_stays_legible(size_mm):
    with warnings.catch_warnings():
        warnings.simplefilter("error")  # matplotlib warns where the axes have no room
        figure = draw(BEST, OTHERS, size_mm=size_mm)
        sizes = points(figure)
    assert min(sizes) >= LEAST_POINTS
    assert max(sizes) <= 12.0
    assert hidden_share(figure) == 0.0
    assert figure.get_size_inches() * 25.4 == pytest.approx(size_mm)


def test_in_a_narrow_picture_the_title_stands_above_the_wind_and_the_legend_is_whole():
    windy = plan(*SCENE, Wind(3.0, 250.0))
    figure = draw(windy, candidates(*SCENE, Wind(3.0, 250.0))[1:], size_mm=(84.0, 84.0))
    figure.draw_without_rendering()
    (axes,), (legend,) = figure.axes, figure.legends
    title = axes.title.get_window_extent()
    labels = [text for text in axes.texts if text.get_text()]
    assert {text.get_gid() for text in labels} == {"wind label", "north"}
    assert not any(text.get_window_extent().overlaps(title) for text in labels)
    assert 0.0 <= legend.get_window_extent().x0 < legend.get_window_extent().x1 <= figure.bbox.width
    assert title.y1 <= figure.bbox.height


def test_a_wide_picture_keeps_its_text():
    assert set(points(draw(BEST, OTHERS, size_mm=(400.0, 300.0)))) == set(points(draw(BEST, OTHERS)))


def test_a_figure_of_any_kind_is_resized():
    figure = loiter.plot.certificate.draw(loiter.verify.certify(plan(*SCENE)))
    resize(figure, 84.0, 90.0)
    assert min(points(figure)) >= LEAST_POINTS


def test_the_figure_knows_its_resolution():
    assert draw(BEST, dpi=300).get_dpi() == 300.0
    assert draw(BEST).get_dpi() == Figure().get_dpi()


def test_save_takes_size_and_resolution(tmp_path):
    save(tmp_path / "a.png", [BEST], size_mm=(127.0, 101.6), dpi=100)
    assert pixels(tmp_path / "a.png")[0] == (500, 400)


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        ({"size_mm": (0.0, 70.0)}, r"^size_mm width is 0: it must be from 80 to 1189 millimetres$"),
        ({"size_mm": (84.0, 30.0)}, r"^size_mm height is 30: it must be from 60 to 1189 millimetres$"),
        ({"size_mm": (84.0, float("nan"))}, r"^size_mm height is nan: it must be a finite number of millimetres$"),
        ({"size_mm": (84.0,)}, r"^size_mm is \(84\.0,\): it must be a width and a height, millimetres$"),
        ({"size_mm": 84.0}, r"^size_mm is 84\.0: it must be a width and a height, millimetres$"),
        ({"dpi": 20}, r"^dpi is 20: it must be from 30 to 1200 dots per inch$"),
        ({"dpi": "high"}, r"^dpi is 'high': it must be a finite number of dots per inch$"),
        (
            {"size_mm": (1189.0, 841.0), "dpi": 600},
            r"^dpi is 600: with a size of 1189 x 841 mm a picture would have 558 ",
        ),
    ],
)
def test_what_cannot_be_drawn_is_refused(arguments, sentence):
    with pytest.raises(InvalidArgument, match=sentence):
        PictureFormat(**arguments)
    with pytest.raises(InvalidArgument, match=sentence):
        draw(BEST, **arguments)


def test_arrows_shrink_with_the_text():
    """Annotations would give their arrows the old size again when they are drawn."""
    figure = draw(BEST, OTHERS)
    full = arrow_sizes(figure)
    resize(figure, 84.0, 84.0)
    assert arrow_sizes(figure) == pytest.approx([0.7 * size for size in full])


def arrow_sizes(figure):
    figure.draw_without_rendering()
    return [text.arrow_patch.get_mutation_scale() for text in figure.axes[0].texts if text.arrow_patch is not None]


@pytest.mark.parametrize("size_mm", [(84.0, 84.0), (174.0, 60.0)])
def test_a_narrow_legend_leaves_the_axes_even_if_it_is_short(size_mm):
    on_circle = plan(Pose(80.0, 0.0, 180.0), *SCENE[1:])
    figure = draw(on_circle, size_mm=size_mm)
    figure.draw_without_rendering()
    (axes,), (legend,) = figure.axes, figure.legends
    box = legend.get_window_extent()
    assert axes.get_legend() is None
    assert not box.overlaps(axes.bbox)
    assert figure.bbox.x0 <= box.x0 < box.x1 <= figure.bbox.x1
    assert (box.x0 > axes.bbox.x1) == (size_mm[0] > 2.0 * size_mm[1])


def test_a_title_breaks_into_lines_of_like_length():
    assert _balanced("Laws optimal, l1, vector-field and tangent in closed loop", 50) == [
        "Laws optimal, l1, vector-field",
        "and tangent in closed loop",
    ]
    assert _balanced("one line", 50) == ["one line"]
    assert _balanced("", 50) == []
    assert _balanced("of an-unbroken-word", 10) == ["of an-", "unbroken-", "word"]
    assert max(map(len, _balanced("of anunbrokenword", 10))) <= 10
