"""The generated JavaScript beside the Python it comes from, with the same arithmetic: the same bits, the same steps."""

from random import Random

import pytest

from compiled.windy import drawn
from native import states
from native.javascript import KERNEL, Portable, counting, differing
from native.javascript_table import main
from native.library import needs_compiler
from native.test_kernel import scenes


@pytest.fixture(scope="module")
def portable():
    return Portable()


@pytest.fixture(scope="module")
def counted(tmp_path_factory):
    """The module, which counts calls."""
    path = tmp_path_factory.mktemp("kernel") / "kernel.mjs"
    path.write_text(counting(KERNEL.read_text("utf-8")), "utf-8")
    return path


@pytest.mark.parametrize(
    "rows", [states.drawn(4000, 0), states.drawn(2000, 1, nearest=-17.0), states.SPECIAL[::7]], ids=len
)
def test_a_state_in_still_air_has_the_same_bits(portable, rows):
    assert differing("inStillAir", portable.in_still_air, rows) == []


def test_the_candidates_in_still_air_have_the_same_bits(portable):
    rows = [*states.drawn(300, 2), *states.SPECIAL[::300]]
    assert differing("rankedInStillAir", portable.ranked_in_still_air, rows) == []


def test_the_search_in_wind_has_the_same_bits_after_the_same_steps(portable, counted):
    assert differing("inWind", portable.in_wind, scenes(), counted) == []


def test_the_candidates_in_wind_have_the_same_bits(portable):
    assert differing("rankedInWind", portable.ranked_in_wind, drawn(16, 3)) == []


def beside(count):
    """States near the circle, with a control and a time."""
    random = Random(6)
    return [
        (random.uniform(-4, 4), random.uniform(-4, 4), random.choice([1.0, 1.5, 2.5]), u, random.uniform(-10, 10))
        for u in (-1, 0, 1) * (count // 3)
    ]


def test_curves_paths_and_holds_have_the_same_bits(portable):
    assert differing("around", portable.around, beside(600)) == []


@needs_compiler
def test_the_c_with_the_same_functions_has_the_same_bits(capsys):
    """And with those of the C library a time differs by three units in the last place at most."""
    assert main(3000, 100, stride=21) == 0
    rows = [line.split("|") for line in capsys.readouterr().out.splitlines() if line.startswith(("| still", "| wind"))]
    assert len(rows) == 9
    assert all(float(differs) <= 4 for _, name, _, _, differs, *_ in rows if "on the circle" not in name)
