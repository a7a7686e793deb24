"""Words as integers."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from loiter.kernel.words import ABSENT, ALL_WORDS, WITH_STRAIGHT, Word, controls, encode, mirrored, rest, set_of

SWAP = str.maketrans("LR", "RL")
LETTERS = {-1: "R", 0: "S", 1: "L"}
some_controls = st.lists(st.sampled_from([-1, 0, 1]), max_size=3)


def filled(pieces):
    return (*pieces, *[ABSENT] * (3 - len(pieces)))


@given(some_controls)
def test_a_word_gives_back_its_controls(pieces):
    code = encode(*filled(pieces))
    assert controls(code) == filled(pieces)
    assert controls(rest(code)) == filled(pieces[1:])
    assert 0 <= code < 64
    assert (code == Word.EMPTY) == (not pieces)


@pytest.mark.parametrize("word", Word)
def test_letters_are_those_of_the_controls(word):
    assert "".join(LETTERS[u] for u in controls(word) if u != ABSENT) == word.letters


@pytest.mark.parametrize(("word", "code"), [("L", 3), ("R", 1), ("SL", 14), ("RSL", 57), ("LSR", 27), ("LRL", 55)])
def test_codes_in_tables_and_arrays_stay_what_they_are(word, code):
    assert Word[word] == code


@pytest.mark.parametrize("word", Word)
def test_mirroring_swaps_left_and_right(word):
    assert Word(mirrored(word)).letters == word.letters.translate(SWAP)
    assert mirrored(mirrored(word)) == word


def test_a_set_of_words_has_a_bit_for_each():
    words = [Word.LSL, Word.RSR, Word.LSR, Word.RSL, Word.LRL, Word.RLR]
    assert [set_of(word) for word in words] == [1, 2, 4, 8, 16, 32]
    assert sum(map(set_of, words)) == ALL_WORDS
    assert sum(set_of(word) for word in words if "S" in word.letters) == WITH_STRAIGHT
