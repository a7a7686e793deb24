"""The optimal synthesis of the reduced plane as JSON, cached."""

from __future__ import annotations

import json
from functools import lru_cache

import numpy as np

from loiter.arrays.partition import boundaries, lines, partition
from loiter.kernel.words import Word

# Cells along a side, as many as the page can show; the JSON of 400 by 400 cells has some 0.5 MB.
MAX_CELLS = 400

# Cells along a side where the request does not give them.
DEFAULT_CELLS = 160

# Maps in the cache: some 16 MB at most.
CACHED_MAPS = 32

# The index of a cell without a fastest word, for example where coordinates are too large for double precision.
NO_WORD = -1


@lru_cache(CACHED_MAPS)
def synthesis(radius: float, turn: str, reach: float | None, cells: int) -> bytes:
    """`models.Synthesis` as encoded JSON; arguments and errors as for `arrays.partition.partition`."""
    regions = partition(radius, turn, reach=reach, cells=cells)
    solved = np.isfinite(regions.time)
    codes = np.unique(regions.word[solved])
    index = np.where(solved, np.searchsorted(codes, regions.word), NO_WORD)
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
