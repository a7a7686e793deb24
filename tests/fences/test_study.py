"""A hundred random scenes of the study, and wrong checkers that it refuses."""

import inspect
import textwrap
from collections import deque
from itertools import starmap

import numpy as np
import pytest

from fences.scenes import scene
from fences.study import compare
from loiter.errors import LoiterError
from loiter.fences import distances, fence, model, pieces, search

SCENES, TRIED = 100, 90


def test_dense_samples_find_the_same():
    rng = np.random.default_rng(20261125)
    rows = [compare(*scene(rng)) for _ in range(SCENES)]
    assert min(sum(row.clear for row in rows), sum(not row.clear for row in rows)) > 20
    assert sum(row.windy for row in rows) > 20


# Wrong checkers: a place in the source, and what stands there instead.
MUTANTS = {
    "the vertex is forgotten": (distances, "arc_edge_points", "vx / r,", "-vx / r,"),
    "the vertex beside a line is forgotten": (
        distances,
        "chord_edge_points",
        "c.distance, d.distance",
        "c.distance + 9.0, d.distance + 9.0",
    ),
    "the whole circle for the arc": (distances, "arc_edge_points", "share <= 1.0", "share < np.inf"),
    "crossings are forgotten": (
        distances,
        "crossing_share",
        "np.where(crosses, along, -1.0)",
        "np.where(crosses, -1.0, -1.0)",
    ),
    "the bound of a trochoid is too tight": (search, "Chords.of", "/ 8.0", "/ 80.0"),
    "the wind is forgotten": (pieces, "Pieces.position", "self.wx * time_s", "0.0"),
    "the margin has the wrong sign": (
        fence,
        "Fence.check",
        "near.distance <= margin_m + TOUCH_M",
        "near.distance <= -margin_m + TOUCH_M",
    ),
    "the hold is forgotten": (
        pieces,
        "flown_path",
        "Pieces(*np.array(rows, float).T)",
        "Pieces(*np.array(rows[:-1] or rows, float).T)",
    ),
    "the nearest point of an inclusion circle": (
        search,
        "_note_arcs_to_circles",
        "largest.distance) - ",
        "least.distance) - ",
    ),
    "the depth ends at once": (
        search,
        "_from_polygon",
        "found.from_b).min(axis=1)",
        "found.from_b).min(axis=1) * 0.0",
    ),
    "the last touch for the first": (distances, "first_within", "np.inf).min", "-np.inf).max"),
    "crossings of circles are forgotten": (distances, "arc_circle_points", "<= 1.0", "< 0.0"),
    "lines touch circles nearest": (
        distances,
        "chord_circle_points",
        "radius**2 - across",
        "0.0 * across",
    ),
    "the deepest place for the entry": (
        fence,
        "_breach",
        "first_entry(path.pieces, zone)",
        "least_distance(path.pieces, zone)",
    ),
}


def replace(monkeypatch, module, name, old, new):
    """Put a changed copy of a function in the place of the function, wherever it was imported."""
    owner = module
    *outer, last = name.split(".")
    for part in outer:
        owner = getattr(owner, part)
    source = textwrap.dedent(
        inspect.getsource(inspect.getattr_static(owner, last) if not outer else getattr(owner, last))
    )
    assert source.count(old) >= 1, f"{name} has no {old!r}"
    scope = dict(vars(module))
    exec("from __future__ import annotations\n" + source.replace(old, new), scope)
    changed, before = scope[last], getattr(owner, last)
    monkeypatch.setattr(owner, last, changed)
    for other in (fence, distances, model, pieces, search):
        if getattr(other, last, None) is before:
            monkeypatch.setattr(other, last, scope[last])


@pytest.fixture(scope="module")
def scenes():
    rng = np.random.default_rng(7)
    return [scene(rng) for _ in range(TRIED)]


@pytest.mark.parametrize("mutant", MUTANTS)
def test_a_wrong_checker_is_refused(mutant, scenes, monkeypatch):
    replace(monkeypatch, *MUTANTS[mutant])
    refused(scenes)


def test_arcs_taken_for_their_chords_are_refused(scenes, monkeypatch):
    monkeypatch.setattr(pieces.Pieces, "acceleration", property(lambda self: 0.0 * self.u))
    monkeypatch.setattr(pieces.Pieces, "bent", property(lambda self: self.u > 2.0))
    refused(scenes)


def refused(scenes):
    """Fences remember nothing of earlier checks but their edges."""
    with pytest.raises((AssertionError, LoiterError, ValueError, RuntimeWarning)):
        deque(starmap(compare, scenes), maxlen=0)
