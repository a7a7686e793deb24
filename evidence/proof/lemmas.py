"""The lemmas of proof.md as checks, and all of them checked one after the other.

Each check raises `NotProved`, or says how many cases and boxes it took. Identities are checked in exact algebra, on the
kernel's own functions, inequalities in ball arithmetic.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from time import perf_counter
from typing import NamedTuple

from evidence.proof import arrivals, rlr, rounding, switching
from evidence.proof.answers import maneuvers, turns
from evidence.proof.balls import Certainty
from evidence.proof.selection import coinciding, compared_words
from evidence.proof.sign_proofs import NotProved


class Lemma(NamedTuple):
    """A lemma of proof.md: its section, what it says, and its check."""

    section: str
    statement: str
    check: Callable[[], Certainty]


LEMMAS = (
    Lemma("lemma 1", "every word but LRL ends at (0, R), and exists where the text says", arrivals.arrivals),
    Lemma("lemma 3", "R = 2: no straight piece through the centre", arrivals.straight_at_two),
    Lemma("lemma 4", "switching points of LRL and RLR, and their radii along the curve", switching.switching_points),
    Lemma("lemma 5", "the kernel's LRL is the extremal, and exists where the text says", switching.kernel_lrl),
    Lemma("lemma 6", "the sum of cosines that bounds the time of RL", switching.rl_bound),
    Lemma("lemma 7 a", "the tail of RLR lasts 3 pi - 3 alpha + omega", rlr.rlr_tail),
    Lemma("lemma 7 b", "the derivatives of E, from which E > 0 follows", rlr.rlr_excess),
    Lemma("lemma 7 c", "RL is faster than the tail of RLR, on boxes", rlr.rlr_slower),
    Lemma("lemma 7 d", "the pieces of RSR for q > 2, and X - atan X < pi", rlr.rsr_faster),
    Lemma("theorem 2 a", "where two rows of the table meet, their words are one path", coinciding.coinciding),
    Lemma("theorem 2 b", "the words that `fastest` compares are those of the text", compared_words.selection),
    Lemma("theorem 2 c", "the time of a word is the sum of its pieces, each turn below 2 pi", turns.times_of_turns),
    Lemma(
        "theorem 2 d", "`arc_tolerance` leaves out arcs, and widens circles, by no more than it says", turns.tolerances
    ),
    Lemma("theorem 2 e", "the list of all extremals has each word once", maneuvers.all_extremals),
    Lemma("theorem 2 f", "words are encoded, mirrored and shortened without loss", maneuvers.all_words),
    Lemma(
        "theorem 2 g",
        "the maneuver has the pieces of the word, without those that are short",
        maneuvers.flown_entries,
    ),
    Lemma("theorem 2 h", "the sides, the tolerances and the faster of two maneuvers", maneuvers.optima),
    Lemma("theorem 2 i", "states that are solved, the feedback law, and the motion itself", maneuvers.laws),
    Lemma("section 9", "rounding errors of first order are added where digits would be lost", turns.rounding_errors),
)


def _of_word(region: rounding.Region) -> Lemma:
    statement = f"{region.word}: T is off by at most {region.limit:g} units"
    return Lemma("theorem 4", statement, lambda: rounding.bound(region).certainty)


# Theorem 4, for `python -m evidence prove --rounding`.
ROUNDING = (
    Lemma("theorem 4", "the lengths of rotations in closed form", rounding.lengths),
    Lemma("theorem 4", "the sum of three angles is off by at most 40 x 2^-52", rounding.sum_of_angles),
    *map(_of_word, rounding.regions()),
)


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
    """Check every lemma."""
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
