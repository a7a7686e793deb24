"""Words, sides and statuses."""

import pytest

from loiter.kernel.codes import Status, Word
from loiter.kernel.synthesis import mirrored

SWAP = str.maketrans("LR", "RL")


@pytest.mark.parametrize("word", Word)
def test_a_code_spells_its_letters_in_base_four(word):
    digits = []
    code = int(word)
    while code:
        digits.append("?RSL"[code & 3])
        code >>= 2
    assert "".join(digits) == word.letters


@pytest.mark.parametrize("word", Word)
def test_mirroring_swaps_left_and_right(word):
    assert Word(mirrored(word)).letters == word.letters.translate(SWAP)


@pytest.mark.parametrize("status", Status)
def test_every_status_has_a_sentence_of_its_own(status):
    assert status.message
    assert len({other.message for other in Status}) == len(Status)
