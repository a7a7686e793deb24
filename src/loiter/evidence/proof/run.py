"""All lemmas of docs/proof.md, checked one after the other."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from time import perf_counter
from typing import NamedTuple

from loiter.evidence.proof.algebra import flint
from loiter.evidence.proof.balls import Certainty
from loiter.evidence.proof.lemmas import LEMMAS, Lemma
from loiter.evidence.proof.sign_proofs import NotProved


class Finding(NamedTuple):
    """The result of one lemma: what it took, in cases and seconds, or why it is not certain."""

    lemma: Lemma
    certainty: Certainty
    seconds: float
    failure: str

    @property
    def verdict(self) -> str:
        """The verdict: certain, or not."""
        return "NOT CERTAIN" if self.failure else "certain"


def prove(lemmas: Sequence[Lemma] = LEMMAS) -> Iterator[Finding]:
    """Check every lemma.

    Raises `MissingPackage` at the call, not at the first result, where python-flint is not installed.
    """
    flint()
    return map(check, lemmas)


def check(lemma: Lemma) -> Finding:
    """The finding of one lemma."""
    started, failure, certainty = perf_counter(), "", Certainty(0, 0)
    try:
        certainty = lemma.check()
    except NotProved as reason:
        failure = str(reason)
    except Exception as error:  # noqa: BLE001
        # A formula that the arithmetic cannot evaluate has not been checked.
        failure = f"{type(error).__name__}: {error}"
    return Finding(lemma, certainty, perf_counter() - started, failure)
