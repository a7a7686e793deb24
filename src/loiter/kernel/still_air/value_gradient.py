"""The gradient of the least time in still air, by the adjoint: grad T = -psi/lambda (docs/theory.md, section 2).

A circle that is larger by dR has its target (0, side R) farther by side dR. The adjoint of the end is the gradient with
respect to the target, so dT/dR = side psi2(T)/lambda.
"""

from math import inf, nan
from typing import NamedTuple

from loiter.kernel.adjoint import adjoint, turn_adjoint
from loiter.kernel.entry import Entry
from loiter.kernel.words import ABSENT, controls


class ValueGradient(NamedTuple):
    """The derivatives of T with respect to the reduced state and the radius of the circle."""

    x: float
    y: float
    radius: float


def value_gradient(x: float, y: float, R: float, maneuver: Entry) -> ValueGradient:
    """The gradient of the time of an extremal from (x, y) onto the circle.

    nan for the empty word; infinite, and of no use, where lambda = 0: there T has a vertical tangent.
    """
    lam, psi1, psi2 = adjoint(x, y, R, maneuver)
    u1, u2, u3 = controls(maneuver.word)
    if u1 == ABSENT:
        return ValueGradient(nan, nan, nan)
    end1, end2 = turn_adjoint(psi1, psi2, u1, maneuver.t1)
    if u2 != ABSENT:
        end1, end2 = turn_adjoint(end1, end2, u2, maneuver.t2)
    if u3 != ABSENT:
        end1, end2 = turn_adjoint(end1, end2, u3, maneuver.t3)
    return ValueGradient(quotient(-psi1, lam), quotient(-psi2, lam), quotient(maneuver.side * end2, lam))


def quotient(a: float, lam: float) -> float:
    """A component over lambda; infinite where lambda is 0, a division that Python would refuse."""
    if lam != 0.0:
        return a / lam
    return inf if a > 0.0 else -inf if a < 0.0 else nan
