"""The synthesis of the reduced plane as JSON, kept for those who ask again."""

from __future__ import annotations

import json
from functools import lru_cache

import numpy as np

from loiter.arrays.partition import boundaries, lines, partition
from loiter.kernel.words import Word

# The page draws no more; a map of 400 cells is some 0.5 MB.
MOST_CELLS = 400

# Along a side, where the request does not say.
FIRST_CELLS = 160

# Maps kept: some 16 MB at the most.
KEPT = 32

# Where no word wins, as at coordinates beyond what doubles tell apart.
NONE = -1


@lru_cache(KEPT)
def synthesis(radius: float, turn: str, reach: float | None, cells: int) -> bytes:
    """`models.Synthesis`, encoded; raises as `arrays.partition.partition`."""
    regions = partition(radius, turn, reach=reach, cells=cells)
    solved = np.isfinite(regions.time)
    codes = np.unique(regions.word[solved])
    index = np.where(solved, np.searchsorted(codes, regions.word), NONE)
    document = {
        "radius": regions.radius,
        "turn": regions.turn.value,
        "x": regions.x.tolist(),
        "y": regions.y.tolist(),
        "words": [Word(code).letters for code in codes.tolist()],
        "region": index.tolist(),
        "curves": [
            {"kind": curve.kind, "words": curve.words, "x": line[:, 0].tolist(), "y": line[:, 1].tolist()}
            for curve in boundaries(regions)
            for line in lines(regions, curve)
        ],
    }
    return json.dumps(document, allow_nan=False, separators=(",", ":")).encode()
