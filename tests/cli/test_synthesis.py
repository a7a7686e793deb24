"""`loiter synthesis`: table, picture, arrays, refusals."""

import numpy as np
import pytest

from loiter.cli.app import main


@pytest.fixture(autouse=True)
def _in_a_folder_of_its_own(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


def test_the_table_lists_the_curves(capsys):
    assert main(["synthesis", "--cells", "60"]) == 0
    rows = [" ".join(line.split()) for line in capsys.readouterr().out.splitlines()]
    assert rows[0] == "between and curve points T rises by"
    assert any(row.startswith("LRL RL T jumps") and row.endswith("3.142 to 3.142") for row in rows)
    assert any(row.startswith("LRL RL switching curve") for row in rows)


def test_the_table_of_a_wider_circle_has_no_column_of_jumps(capsys):
    assert main(["synthesis", "--cells", "60", "--radius", "1.5"]) == 0
    first, *rows = [" ".join(line.split()) for line in capsys.readouterr().out.splitlines()]
    assert first == "between and curve points"
    assert any(row.startswith("LRL RL switching curve") for row in rows)


def test_arrays_hold_the_map_and_the_curves(tmp_path):
    assert main(["synthesis", "--radius", "1.5", "--turn", "cw", "--cells", "50", "--save", "map.npz"]) == 0
    with np.load(tmp_path / "map.npz") as arrays:
        assert arrays["time"].shape == arrays["word"].shape == arrays["side"].shape == (50, 50)
        assert (float(arrays["radius"]), str(arrays["turn"])) == (1.5, "cw")
        assert arrays["switch LRL RL"].shape[1] == 2


@pytest.mark.parametrize("show", ["words", "time", "worth"])
def test_a_picture_is_written(tmp_path, show):
    assert main(["synthesis", "--turn", "ccw", "--cells", "40", "--show", show, "--plot", "map.png"]) == 0
    assert (tmp_path / "map.png").read_bytes().startswith(b"\x89PNG")


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        ("--radius 0.5", "--radius is 0.5: it must be at least 1 (turn radii) and at most 1e+09"),
        ("--radius nan", "--radius is nan: it must be at least 1 (turn radii) and at most 1e+09"),
        (
            "--show worth",
            "--show is 'worth': it compares a free choice of direction with one direction, so give --turn cw or ccw",
        ),
        ("--cells 1000000", "--cells is 1000000: it must be a whole number, at least 8 and at most 4000"),
        ("--radius 1e17", "--radius is 1e+17: it must be at least 1 (turn radii) and at most 1e+09"),
        ("--reach 0", "--reach is 0.0: it must be a positive, finite number of turn radii"),
        ("--cells 3", "--cells is 3: it must be a whole number, at least 8 and at most 4000"),
        ("--cells 40.5", "--cells is '40.5': it must be a whole number"),
        ("--save map.mat", "--save is 'map.mat': the file name must end in .npz"),
        ("--save no/map.npz --cells 20", "--save is 'no/map.npz': it cannot be written, No such file or directory"),
        ("--plot map.bmp", "--plot is 'map.bmp': the file name must end in .png, .svg, .pdf"),
    ],
)
def test_refusals_are_one_sentence_and_leave_no_file(capsys, tmp_path, arguments, sentence):
    assert main(["synthesis", *arguments.split()]) == 2
    captured = capsys.readouterr()
    assert (captured.out, captured.err) == ("", f"loiter: {sentence}\n")
    assert list(tmp_path.iterdir()) == []
