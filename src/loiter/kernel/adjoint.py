"""The adjoint of an extremal in closed form: the multiplier lambda, psi(t) and the switching function phi(t).

psi is fixed by a place where phi = 0 (docs/theory.md, section 2):

- with a straight piece, lambda = 1 and psi = (1, 0) there;
- with a switch between L and R, psi is parallel to the state at the last of them. That state is found backwards from
  the target, where it is exact, so psi1(T) (1 + u side R) = lambda, the condition at the target, holds by construction
  and everything before the last switch is there to be checked;
- a single arc has no such place and many psi: any with psi1(T) (1 + u side R) = lambda >= max psi1 over the arc. The
  choice is the limit of the words next to it: the arc counts as the last piece of a straight entry where it crosses the
  axis on the way, psi = (1, 0), lambda = 1 there; otherwise as that of the switch at its start, psi parallel to the
  start. On the axis the two agree.

Nothing is mirrored: `side` is +1 for the target (0, R), -1 for (0, -R), and L, R, u are as flown.
"""

from math import hypot, nan

from loiter.kernel.angles import angle
from loiter.kernel.extremals import onto_axis
from loiter.kernel.motion import flow, fly
from loiter.kernel.synthesis import rounding
from loiter.kernel.words import ABSENT, controls

Adjoint = tuple[float, float, float]


def turned(psi1: float, psi2: float, u: int, t: float) -> tuple[float, float]:
    """Exact flow of the dual system (12) for a time t, backwards where t < 0."""
    # psi is the constant adjoint of the position as seen along the course, so it turns as the course does not.
    _, _, psi1, psi2 = fly(0.0, 0.0, psi1, psi2, -u, t)
    return psi1, psi2


def switching_function(x: float, y: float, psi1: float, psi2: float) -> float:
    """Phi = psi1 y - psi2 x, (15)."""
    return psi1 * y - psi2 * x


def at_switch(x: float, y: float, u: int, R: float) -> Adjoint:
    """Lambda and psi where phi = 0 at the state (x, y) and the control u follows.

    psi is parallel to (x, y); of the two signs psi1 = lambda >= 0 asks for one and phi' = -psi2 of the sign of u for
    one. They agree on an optimum; the larger component decides, so that rounding of the smaller does not. At the centre
    any psi will do: (1, 0), that of the straight piece.
    """
    r = hypot(x, y)
    if r <= rounding(x, y, R):
        return 1.0, 1.0, 0.0
    backwards = x < 0.0 if abs(x) > abs(y) else u * y > 0.0
    if backwards:
        r = -r
    return x / r, x / r, y / r


def of_arc(x: float, y: float, R: float, side: int, u: int, t: float) -> Adjoint:
    """Lambda and psi at the start (x, y) of a single arc of duration t onto the circle, as chosen above."""
    to_axis, c = onto_axis(x, u * y, -1.0 * u * side, 0.0)
    if c >= 0.0 and angle(to_axis) < t:
        psi1, psi2 = turned(1.0, 0.0, u, -angle(to_axis))
        return 1.0, psi1, psi2
    lam, psi1, psi2 = at_switch(x, y, u, R)
    # Past half a turn of the small circle lambda would be negative; there lambda = 0 is as near as psi can come.
    return (0.0, 0.0, -1.0 * u) if lam < 0.0 else (lam, psi1, psi2)


def of_switch(R: float, side: int, word: int, t1: float, t2: float, t3: float) -> Adjoint:
    """Lambda and psi at the start of a word of arcs, from the last switch between L and R."""
    first, second, third = controls(word)
    if third == ABSENT:
        x, y = flow(0.0, side * R, second, -t2)
        lam, psi1, psi2 = at_switch(x, y, second, R)
    else:
        x, y = flow(0.0, side * R, third, -t3)
        lam, psi1, psi2 = at_switch(x, y, third, R)
        psi1, psi2 = turned(psi1, psi2, second, -t2)
    psi1, psi2 = turned(psi1, psi2, first, -t1)
    return lam, psi1, psi2


def adjoint(x: float, y: float, R: float, side: int, word: int, t1: float, t2: float, t3: float) -> Adjoint:
    """Lambda and psi at the start of an extremal from (x, y) onto the circle of the given side; |psi| = 1.

    nan for the empty word, which has nothing to decide. A word that is no extremal gets a psi too: that which it would
    need at its last switch; it then breaks one of (13)-(16).
    """
    first, second, _ = controls(word)
    if first == ABSENT:
        return nan, nan, nan
    if second == ABSENT:
        return of_arc(x, y, R, side, first, t1)
    if first == 0:
        return 1.0, 1.0, 0.0
    if second == 0:
        psi1, psi2 = turned(1.0, 0.0, first, -t1)
        return 1.0, psi1, psi2
    return of_switch(R, side, word, t1, t2, t3)


def followed(
    x: float, y: float, psi1: float, psi2: float, word: int, t1: float, t2: float, t3: float, t: float
) -> tuple[float, float, float, float]:
    """State and adjoint x, y, psi1, psi2 after a time t of a word flown from (x, y) with psi, or at its end."""
    for u, duration in zip(controls(word), (t1, t2, t3)):
        if u != ABSENT:
            step = min(duration, t)
            x, y = flow(x, y, u, step)
            psi1, psi2 = turned(psi1, psi2, u, step)
            t -= step
    return x, y, psi1, psi2
