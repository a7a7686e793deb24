"""Damaged files raise nothing but a sentence; more of them with `python tests/mutating.py 10000`."""

import pytest

from mutating import KINDS, outcomes


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("seed", [2, 3])
def test_damaged_files_are_read_or_refused_in_a_sentence(tmp_path, kind, seed):
    counts = outcomes(kind, 1000, seed, tmp_path)
    assert counts["read"] + counts["refused"] == 1000
    # The mutations are neither harmless nor all fatal in the first byte.
    assert counts["read"] > 30
    assert counts["refused"] > 500
