"""Theorem 2 of proof.md: the words that `extremals.fastest` compares are those of the text, at every state.

`fastest` is run for every combination of signs of the quantities by which it decides (`signs.py`). For each combination
that no relation excludes, the words that it compares are held against those of the text.
"""

from __future__ import annotations

import operator
from collections.abc import Callable, Iterable, Iterator
from math import inf
from types import SimpleNamespace
from typing import Any, NamedTuple

import flint

from evidence.proof.answers.turns import StandIn
from evidence.proof.arrivals import CASES, Case
from evidence.proof.balls import Certainty
from evidence.proof.exact_paths import Point, without_tolerance
from evidence.proof.identities import quantities, require
from evidence.proof.selection.signs import Quantity, Signs, Table, Unknown, every_case, possible_signs
from evidence.proof.sign_proofs import ANY, NEVER_NEGATIVE, NEVER_POSITIVE, Impossible, NotProved
from loiter.kernel.rebinding import rebinding
from loiter.kernel.still_air import extremals as kernel
from loiter.kernel.words import Word

# A word, and for RL and LR on which side of the axis x = 0 the arcs meet: -1 left, 1 right, 0 for other words.
Described = tuple[int, int]


def of(word: Word, side: int = 0) -> Described:
    """A word with its side."""
    return int(word), side


ARC_L, ARC_R, LRL = of(Word.L), of(Word.R), of(Word.LRL)
LSL, RSL, LSR, RSR = of(Word.LSL), of(Word.RSL), of(Word.LSR), of(Word.RSR)
RL_LEFT, RL_RIGHT, LR_LEFT, LR_RIGHT = of(Word.RL, -1), of(Word.RL, 1), of(Word.LR, -1), of(Word.LR, 1)


# The quantities by which words are selected, by their names.
Named = SimpleNamespace


def named(x: Any, y: Any, R: Any, turn: Any) -> Named:
    """The quantities at a state, written without the kernel: `Quantities`, and D and h, those of `lrl`.

    `turn` is the cross product of the rotation of LRL's first arc: it is not negative up to half a turn.
    """
    q = quantities(Point(x, y), R)
    h, d = 0.5 * (R * (R + 2.0) + q.left), 0.25 * (R * (R + 2.0) - q.left)
    return Named(x=x, y=y, R=R, **q._asdict(), h=h, D=h * h - 3.0 * d * d, turn=turn)


# Each sum is 0 at every state: checked on polynomials. What follows is in proof.md, section 8.
RELATIONS = (
    "(R+1) - (R-1) - 2",
    "(R-1) - (R-2) - 1",
    "outer - fold + 8 (R-1)",
    "outer - from_left + 4 (R-1) + 4",
    "fold - left + (R-2) (R-3) - (R-2)",
    "inner - onto_right - 4 (R-1) - 4",
    "far - onto_right + 4 (R-1) + 12",
    # rm^2 is not negative.
    "inner - x x - (y-1) (y-1) + (R-1) (R-1)",
    # rm <= rp + 2: never both rp < R - 1 and rm > R + 1; rm >= 2 - rp: never both rp = 3 - R and rm < R - 1, R < 3.
    (
        "from_left - x x - 1/16 from_left from_left + 1/8 from_left onto_right - 1/16 onto_right onto_right"
        " + 1/2 from_left (R-1) - 1/2 onto_right (R-1)"
    ),
    "1/2 fold (R-1) - 1/2 inner (R-3) - x x - 1/16 fold fold + 1/8 fold inner - 1/16 inner inner",
    # LRL on the circle rp = 3 - R: D is a square, and h < 6 up to R = 1 + sqrt 3.
    "D - wave wave - fold (R-1) (R-1) - 3 fold (R-1) - 3 fold - 1/16 fold fold",
    "(h-6) - (R-2) (R-1) - (R-2) + 2 - 1/2 fold",
    # h is positive, so that `lrl` never divides by 0.
    "h - 1/2 x x - 1/2 (y+1) (y+1) - 1/2 (R-1) (R-1) - 2 (R-1) - 1",
    # With these there are fewer combinations.
    "(R-2) - (R-3) - 1",
    "from_left - fold + 4 (R-2)",
    "inner - right + (R-2) (R-1) + (R-2)",
    "onto_right - right + (R-1) (R-1) + 4 (R-1) + 3",
    "from_left - left + (R-2) (R-1) + (R-2)",
    "left - right - 4 y",
    "outer - onto_right - 4 y",
    "from_left - inner - 4 y",
)


# Quantities that have another name in `RELATIONS`, or that only differ by a number from one that decides.
OTHERS = "R", "tall", "wide"


def table_of(context: Any) -> Table:
    """The quantities by which the kernel and the text may decide, and the relations between them."""
    x, y, R, turn = context.gens()
    # `named` also takes doubles such as 0.5, which a polynomial by itself does not.
    q = named(*(Quantity(Signs(Table()), variable) for variable in (x, y, R, turn)))
    deciding = {name: quantity.polynomial for name, quantity in vars(q).items() if name not in OTHERS}
    deciding |= {"(h-6)": q.h.polynomial - 6, "(R+1)": R + 1, "(R-1)": R - 1, "(R-2)": R - 2, "(R-3)": R - 3}
    # D on the circle rp = 3 - R is the square of `wave`.
    auxiliary = {"wave": (R - 1) * (R - 1) - 3, "(y-1)": y - 1, "(y+1)": y + 1}
    return Table(deciding, auxiliary, RELATIONS, {"(R-1)": (0, 1)})


def selection() -> Certainty:
    """Theorem 2: `fastest` compares the words of the text, or words that are the same path, at every state.

    Once where `arc_tolerance` is that of rounding alone, and once where a user's adds the single arcs.
    """
    cases = taking_the_faster()
    for exactly in (True, False):
        context = flint.fmpq_mpoly_ctx.get(("x", "y", "R", "turn"), flint.Ordering.lex)
        signs = Signs(table_of(context))
        q = named(*(Quantity(signs, variable) for variable in context.gens()))
        fastest = recording_fastest(q, exactly)

        def run(q: Named = q, fastest: Any = fastest, exactly: bool = exactly, signs: Signs = signs) -> None:
            check_selection(q, compared_words(fastest), exactly, signs)

        cases += every_case(signs, run)
    return Certainty(cases, 0)


def taking_the_faster() -> int:
    """`faster_of` takes another extremal where its time is less, with that time; the number of cases."""
    context = flint.fmpq_mpoly_ctx.get(("least", "time"), flint.Ordering.lex)
    signs = Signs(Table({"time - least": context.gen(1) - context.gen(0)}))
    least, time = (Quantity(signs, variable) for variable in context.gens())
    faster = rebinding({"duration": StandIn("duration", ("other",), time)})(kernel.faster_of)

    def run() -> None:
        taken = faster(least, "best", "other")
        right = (time, "other") if time < least else (least, "best")
        require(all(map(operator.is_, taken, right)), "`faster_of` does not take the faster of two")

    return every_case(signs, run)


def check_selection(q: Named, found: set[Described], exactly: bool, signs: Signs) -> None:
    """Raise `NotProved` where `fastest` leaves out a word of the text, or takes an arc that ends beside the target.

    All states with the signs chosen in this run are checked at once.
    """
    # Lemma 1 is about the other words, wherever they reach the target, and lemma 5 about LRL.
    require(LRL not in found or lrl_exists(q), f"LRL ends beside the target: signs {signs.chosen}")
    require(ARC_L not in found or q.outer == 0.0, f"L ends beside the target: signs {signs.chosen}")
    require(ARC_R not in found or (q.inner == 0.0 and q.R > 1.0), f"R ends beside the target: signs {signs.chosen}")
    if not exactly:
        # Within `arc_tolerance` a single arc may also be faster than the words of which it is the limit.
        require((q.outer == 0.0) == (ARC_L in found), f"L does not compete: signs {signs.chosen}")
        require((q.inner == 0.0 and q.R > 1.0) == (ARC_R in found), f"R does not compete: signs {signs.chosen}")
    if exactly and q.R == 1.0 and q.y >= 0.0:
        require(len(found) == 1, f"times are compared at R = 1: {found}, signs {signs.chosen}")
        required = set(words_at_turn_radius(q))
    else:
        required = set(words_that_can_win(q))
    represented = with_same_paths(found, q)
    missing = required - represented
    require(not missing, f"the selection leaves out {missing}: signs {signs.chosen}")
    if q.R > 1.0 and is_left_out(q):
        # Section 6 (a): T is the time of RL.
        require(RL_LEFT in represented, f"RL is left out on the circle rp = 3 - R: signs {signs.chosen}")


def words_at_turn_radius(q: Named) -> Iterator[Described]:
    """The words of section 6 (d), R = 1 and y >= 0: LRL or L with a first arc of at most half a turn, otherwise R."""
    if q.outer == 0.0:
        # On the last circle LRL is L, whose first arc has the cross product -x, up to a factor: see `coinciding`.
        if (q.turn >= 0.0) != (q.x <= 0.0):
            raise Impossible
        if q.x <= 0.0:
            yield ARC_L
            return
    elif lrl_exists(q) and q.turn >= 0.0:
        yield LRL
        return
    yield from words_to_the_right(q)


# The words of lemma 1, as `fastest` records them.
WORDS = {name: of(Word[name.partition(",")[0]], int(sum(case.crossing))) for name, case in CASES.items()}

# The words whose first arc crosses the axis where y >= 0: section 6 (b).
CROSSING_THE_AXIS = LSL, RSR, RL_RIGHT, LR_LEFT


def words_to_the_right(q: Named) -> Iterator[Described]:
    """The words that can win and begin with R, for y >= 0."""
    for name in ("RL, left crossing", "RSL"):
        if exists(CASES[name], q) and is_extremal(CASES[name], q):
            yield WORDS[name]


def words_that_can_win(q: Named) -> Iterator[Described]:
    """The words that exist by lemmas 1 and 5, less those that the text excludes.

    Excluded are crossings at which the switching function would have the wrong sign (`is_extremal`), and what section 6
    (a) and (b) leave out. This is the table of docs/theory.md, section 4.
    """
    for name, case in CASES.items():
        word = WORDS[name]
        if not exists(case, q) or not is_extremal(case, q):
            continue
        crosses = word in CROSSING_THE_AXIS and q.y >= 0.0
        if not crosses and not (word == LR_RIGHT and is_left_out(q)):
            yield word
    if q.inner == 0.0 and q.R > 1.0:
        yield ARC_R
    if q.outer == 0.0:
        yield ARC_L
    if lrl_exists(q):
        yield LRL


def lrl_exists(q: Named) -> bool:
    """Whether LRL exists, by lemma 5."""
    return bool(q.R <= 3.0 and q.fold <= 0.0 and q.D >= 0.0 and q.h < 6.0)


def exists(case: Case, q: Named) -> bool:
    """Whether a word exists, by lemma 1."""
    return all(sign_of(getattr(q, condition.quantity)) in condition.possible for condition in case.conditions)


def is_extremal(case: Case, q: Named) -> bool:
    """Whether the switching function can change as the controls do at the crossing (x1, y1) of two arcs.

    That is x1 y1 <= 0 for RL and x1 y1 >= 0 for LR, where 4 y1 is -`onto_right` or `from_left`, by lemma 1.
    """
    if not case.crossing:
        return True
    above = -sign_of(q.onto_right) if case.centre > 0.0 else sign_of(q.from_left)
    return case.centre * case.crossing[0] * above <= 0.0


def sign_of(quantity: Any) -> int:
    """The sign of a quantity."""
    return 0 if quantity == 0.0 else 1 if quantity > 0.0 else -1


def is_left_out(q: Named) -> bool:
    """Section 6 (a): LR on the circle rp = 3 - R, where LRL does not exist, is not needed."""
    return q.R <= 3.0 and q.fold == 0.0 and not q.h < 6.0


def with_same_paths(words: Iterable[Described], q: Named) -> set[Described]:
    """Words, and those that are the same path at this state, or take no less: `coinciding` checks that they do."""
    found = set(words)
    # On each circle: words that are one path, and words that take no less than these.
    circles = (
        (q.outer, {ARC_L, LR_RIGHT, LRL}, {LSL}),
        (q.inner, {ARC_R, RL_LEFT}, {RSR}),
        (q.onto_right, {RSL, RL_LEFT}, {RL_RIGHT}),
        (q.from_left, {LSR, LR_RIGHT}, {LR_LEFT}),
        (q.fold, {LRL, LR_RIGHT, LR_LEFT}, set[Described]()),
    )
    size = 0
    while size < len(found):
        size = len(found)
        for quantity, same, slower in circles:
            if found & same and not same | slower <= found and quantity == 0.0:
                found |= same | slower
    return found


def recording_fastest(q: Named, exactly: bool) -> Callable[[], tuple[Any, Any]]:
    """The kernel's `fastest` on quantities, with the extremals that it has compared in place of times."""
    copied = rebinding(NUMBERS)
    start = copied(kernel.start_at)(q.x, q.y, q.R, 0.0)
    arc_tolerance = object()

    def given_start(word: Callable[..., kernel.Extremal]) -> Callable[..., kernel.Extremal]:
        """A word, which must get the start, and whose side must be -1 or 1."""
        # Lemma 1 is not about LRL: no number whose root it takes may be negative.
        described = rebinding(NUMBERS | {"sqrt": never_negative_root})(word) if word is kernel.lrl else copied(word)

        def checked(given: kernel.Start, *branch: float) -> kernel.Extremal:
            require(given is start, f"`{word.__name__}` gets another start")
            require(branch in ((), (-1.0,), (1.0,)), f"`{word.__name__}` gets a side that is no sign")
            extremal: kernel.Extremal = described(given, *branch)
            return extremal._replace(first=(q.turn, extremal.first[1])) if word is kernel.lrl else extremal

        return checked

    words = kernel.l, kernel.r, kernel.lsl, kernel.rsl, kernel.lsr, kernel.rsr, kernel.rl, kernel.lr, kernel.lrl
    names: dict[str, object] = {
        "start_at": StandIn("start_at", (q.x, q.y, q.R, arc_tolerance), start),
        **{word.__name__: given_start(word) for word in words},
        "duration": lambda extremal: LeastTime((extremal,)),
        "faster_of": faster_of,
    }
    if not exactly:
        names["reaches"] = may_reach
    fastest = rebinding(NUMBERS | names)(kernel.fastest)
    return lambda: fastest(q.x, q.y, q.R, arc_tolerance, exactly)


def compared_words(fastest: Callable[[], tuple[Any, Any]]) -> set[Described]:
    """The words that the kernel's `fastest` compares, as far as they reach the target."""
    least, best = fastest()
    check_same(least, best)
    return {described(extremal) for extremal in least.extremals if extremal.straight is not inf}


def may_reach(extremal: kernel.Extremal) -> bool:
    """`reaches` within `arc_tolerance`, where a single arc beside its circle reaches the target too.

    There it may be slower than the words of which it is the limit, and must not replace them.
    """
    return extremal.word in (Word.L, Word.R) or kernel.reaches(extremal)


class LeastTime(NamedTuple):
    """What stands for the least time of some extremals."""

    extremals: tuple[kernel.Extremal, ...]


class Fastest(NamedTuple):
    """What stands for the fastest of some extremals."""

    extremals: tuple[kernel.Extremal, ...]


def check_same(least: object, best: object) -> None:
    """Raise `NotProved` unless one is the least time and the other the fastest of the same extremals."""
    require(isinstance(least, LeastTime), "what is called the least time is none")
    require(isinstance(best, (Fastest, kernel.Extremal)), "what is called the fastest extremal is none")
    of_least, of_best = getattr(least, "extremals", ()), getattr(best, "extremals", (best,))
    same = [*map(id, of_least)] == [*map(id, of_best)]
    require(same, "the least time is not that of the words that were compared")


def faster_of(least: LeastTime, best: Fastest | kernel.Extremal, other: kernel.Extremal) -> tuple[LeastTime, Fastest]:
    """What stands for the kernel's `faster_of`: it adds an extremal to those that have been compared."""
    check_same(least, best)
    require(isinstance(other, kernel.Extremal), "what is compared is no extremal")
    compared = *least.extremals, other
    return LeastTime(compared), Fastest(compared)


def larger(*numbers: object) -> Unknown:
    """The largest of some numbers, which is not negative where one of them is not."""
    # Numbers such as 0.0 come last in the kernel.
    never_negative = any(possible_signs(number) <= NEVER_NEGATIVE for number in reversed(numbers))
    return Unknown(lambda: NEVER_NEGATIVE if never_negative else ANY)


def root(number: object) -> Unknown:
    """A root. Lemma 1 checks those of polynomials; others must be of numbers that are never negative."""
    never_negative = isinstance(number, Quantity) or possible_signs(number) <= NEVER_NEGATIVE
    require(never_negative, "a root of a number that may be negative")
    return Unknown(lambda: NEVER_NEGATIVE)


def never_negative_root(number: object) -> Unknown:
    """A root of a number that must be known not to be negative."""
    require(possible_signs(number) <= NEVER_NEGATIVE, "a root of a number that may be negative")
    return Unknown(lambda: NEVER_NEGATIVE)


# What replaces the kernel's globals. Both branches of `onto_axis` compute the same rotation: lemma 1 checks each.
NUMBERS = {
    "sqrt": root,
    "max": larger,
    "TINY": 0.0,
    "SMALLEST_SCALE": inf,
    "snap_full_turn": without_tolerance,
}


def described(extremal: kernel.Extremal) -> Described:
    """A word, and on which side of the axis x = 0 the arcs of RL and LR meet, 0 for other words."""
    word = int(extremal.word)
    if word not in (Word.RL, Word.LR):
        return word, 0
    cross: Any = extremal.middle[0]
    right = NEVER_NEGATIVE if word == Word.LR else NEVER_POSITIVE
    possible = possible_signs(cross)
    if not (possible <= NEVER_NEGATIVE or possible <= NEVER_POSITIVE):
        raise NotProved("the side of a crossing is not known")
    return word, 1 if possible <= right else -1
