"""Words of array functions as text."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from loiter.arrays.arguments import is_lazy
from loiter.kernel.words import Word

if TYPE_CHECKING:
    from numpy.typing import NDArray

# The letters of each code; codes that are no word have none.
_LETTERS = np.array([Word(code).letters if code in tuple(Word) else "" for code in range(max(Word) + 1)])


def word_letters(codes: Any) -> NDArray[np.str_]:
    """The letters of word codes, "RSL", in their shape; "" for the empty word. Lazy arrays give lazy arrays."""
    if is_lazy(codes):
        lazy: NDArray[np.str_] = codes.map_blocks(_letters_of, dtype=_LETTERS.dtype)
        return lazy
    return _letters_of(codes)


def _letters_of(codes: Any) -> NDArray[np.str_]:
    letters: NDArray[np.str_] = _LETTERS[np.asarray(codes)]
    return letters
