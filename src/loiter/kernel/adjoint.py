"""The adjoint of an extremal in closed form: the multiplier lambda, psi(t) and the switching function phi(t).

psi is determined by a point where phi = 0 (docs/theory.md, section 2):

- with a straight piece, lambda = 1 and psi = (1, 0) there;
- with a switch between L and R, psi is parallel to the state at the last such switch. That state is found backwards
  from the target, where it is exact. So psi1(T) (1 + u side R) = lambda, the condition at the target, holds by
  construction, and everything before the last switch remains to be checked;
- a single arc has no such point, and many psi are possible: any with psi1(T) (1 + u side R) = lambda >= max psi1 over
  the arc. The one chosen is the limit of those of the neighbouring words. An arc that crosses the axis on the way
  counts as the last piece after a straight one: lambda = 1 and psi = (1, 0) at the crossing. Otherwise it counts as the
  last piece after a switch at its start: psi is parallel to the start. For a start on the axis the two agree.

Nothing is mirrored: `side` is +1 for the target (0, R), -1 for (0, -R), and L, R, u are as flown.
"""

from math import nan
from typing import NamedTuple

from loiter.kernel.angles import angle, length
from loiter.kernel.entry import Entry
from loiter.kernel.motion import flow, fly
from loiter.kernel.rounding import rounding
from loiter.kernel.still_air.extremals import onto_axis
from loiter.kernel.words import ABSENT, controls


class Adjoint(NamedTuple):
    """The multiplier lambda and the adjoint psi of a state."""

    lam: float
    psi1: float
    psi2: float


def turn_adjoint(psi1: float, psi2: float, u: int, t: float) -> tuple[float, float]:
    """The adjoint psi after a time t (before, if t < 0) with control u: the exact flow of the dual system (12)."""
    # psi is the constant adjoint of the position in axes along the course, so it turns opposite to the course.
    _, _, psi1, psi2 = fly(0.0, 0.0, psi1, psi2, -u, t)
    return psi1, psi2


def switching_function(x: float, y: float, psi1: float, psi2: float) -> float:
    """Phi = psi1 y - psi2 x, (15)."""
    return psi1 * y - psi2 * x


def at_switch(x: float, y: float, u: int, R: float) -> Adjoint:
    """The adjoint at a state (x, y) where phi = 0 and the next control is u.

    psi is parallel to (x, y). Its sign follows from psi1 = lambda >= 0, and also from phi' = -psi2, which has the sign
    of u. The two agree on an optimum; the larger component of (x, y) decides, so that rounding of the smaller one has
    no effect. At the centre any psi is possible: (1, 0) is chosen, that of the straight piece.
    """
    r = length(x, y)
    if r <= rounding(x, y, R):
        return Adjoint(1.0, 1.0, 0.0)
    backwards = x < 0.0 if abs(x) > abs(y) else u * y > 0.0
    if backwards:
        r = -r
    return Adjoint(x / r, x / r, y / r)


def of_single_arc(x: float, y: float, R: float, maneuver: Entry) -> Adjoint:
    """The adjoint at the start (x, y) of a single arc onto the circle, chosen as described at the top."""
    u, _, _ = controls(maneuver.word)
    to_axis, c = onto_axis(x, u * y, -1.0 * u * maneuver.side, 0.0)
    if c >= 0.0 and angle(to_axis) < maneuver.t1:
        psi1, psi2 = turn_adjoint(1.0, 0.0, u, -angle(to_axis))
        return Adjoint(1.0, psi1, psi2)
    start = at_switch(x, y, u, R)
    # Past half a turn of the small circle lambda would be negative; there lambda = 0 is the nearest possible value.
    return Adjoint(0.0, 0.0, -1.0 * u) if start.lam < 0.0 else start


def of_arcs(R: float, maneuver: Entry) -> Adjoint:
    """The adjoint at the start of a word of two or three arcs, from the last switch between L and R."""
    side, word, t1, t2, t3 = maneuver
    first, second, third = controls(word)
    if third == ABSENT:
        x, y = flow(0.0, side * R, second, -t2)
        lam, psi1, psi2 = at_switch(x, y, second, R)
    else:
        x, y = flow(0.0, side * R, third, -t3)
        lam, psi1, psi2 = at_switch(x, y, third, R)
        psi1, psi2 = turn_adjoint(psi1, psi2, second, -t2)
    psi1, psi2 = turn_adjoint(psi1, psi2, first, -t1)
    return Adjoint(lam, psi1, psi2)


def adjoint(x: float, y: float, R: float, maneuver: Entry) -> Adjoint:
    """Lambda and psi at the start of an extremal from (x, y) onto the circle; |psi| = 1.

    nan for the empty word, which has no controls. A word that is not an extremal also gets a psi, the one that its last
    switch requires; it then violates one of (13)-(16).
    """
    first, second, _ = controls(maneuver.word)
    if first == ABSENT:
        return Adjoint(nan, nan, nan)
    if second == ABSENT:
        return of_single_arc(x, y, R, maneuver)
    if first == 0:
        return Adjoint(1.0, 1.0, 0.0)
    if second == 0:
        psi1, psi2 = turn_adjoint(1.0, 0.0, first, -maneuver.t1)
        return Adjoint(1.0, psi1, psi2)
    return of_arcs(R, maneuver)
