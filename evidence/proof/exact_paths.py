"""Paths in exact algebra: the kernel's rotations flown from a start, with expressions in place of numbers."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, NamedTuple

from evidence.proof.algebra import Expression, Field
from evidence.proof.sign_proofs import POSITIVE, NotProved
from loiter.kernel.rebinding import Function, rebinding
from loiter.kernel.still_air import extremals as kernel
from loiter.kernel.words import controls


class Point(NamedTuple):
    """A point of the reduced plane."""

    x: Expression
    y: Expression


def without_tolerance(rotated: Any, radius2: Any, arc_tolerance: Any) -> Any:
    """What `angles.snap_full_turn` does where `arc_tolerance` is 0: nothing."""
    return rotated


def exact(
    field: Field,
    *functions: Function,
    known: Iterable[Expression] = (),
    snap: Function = without_tolerance,
) -> list[Function]:
    """Kernel functions that take expressions; `known` are roots that the field does not find by itself."""
    copied = rebinding(field.names(known) | {"snap_full_turn": snap})
    return [copied(function) for function in functions]


def start_at(field: Field, x: Expression, y: Expression, R: Expression) -> kernel.Start:
    """The kernel's start at expressions, with an `arc_tolerance` of 0."""
    (function,) = exact(field, kernel.start_at)
    arc_tolerance = field.constant(0.0)
    start: kernel.Start = function(x, y, R, arc_tolerance)
    if any(a is not b for a, b in zip(start[:4], (x, y, R, arc_tolerance), strict=True)):  # type: ignore[comparison-overlap]
        raise NotProved("`start_at` has another state, radius or `arc_tolerance`")
    return start


class Snapped(tuple):  # type: ignore[type-arg]
    """A rotation that `snap_full_turn` has got."""


class SnappedArcs:
    """In place of `snap_full_turn`: the rotation, squared radius and `arc_tolerance` that it got, and no change."""

    def __init__(self) -> None:
        self.arcs: list[tuple[Snapped, Any, Any]] = []

    def __call__(self, rotated: Any, radius2: Any, arc_tolerance: Any) -> Snapped:
        """The rotation itself; what was given is kept."""
        self.arcs.append((Snapped(rotated), radius2, arc_tolerance))
        return self.arcs[-1][0]

    def check(self, name: str, arc_tolerance: object, *expected: tuple[Any, Expression]) -> None:
        """Raise `NotProved` where it did not get exactly the expected arcs, with their squared radii."""
        same = len(expected) == len(self.arcs) and all(
            any(
                arc is rotated and given is arc_tolerance and (radius2 - found).is_zero
                for arc, found, given in self.arcs
            )
            for rotated, radius2 in expected
        )
        if not same:
            raise NotProved(f"{name}: `arc_tolerance` is another")


def squared(point: Point, centre: float) -> Expression:
    """The squared distance of a point from (0, centre)."""
    return point.x * point.x + (point.y - centre) * (point.y - centre)


def turned(point: Point, u: int, rotation: Any, known: Iterable[Expression]) -> Point:
    """The point at the end of an arc of control u: turned about (0, -u), clockwise for u = +1."""
    field = point.x.field
    cross, dot = field.of(rotation[0]), field.of(rotation[1])
    size = field.sqrt(cross * cross + dot * dot, known)
    sine, cosine = u * cross / size, dot / size
    x, y = point.x, point.y + u
    return Point(x * cosine + y * sine, y * cosine - x * sine - u)


def flown(start: Point, extremal: kernel.Extremal, known: Iterable[Expression] = ()) -> tuple[Point, ...]:
    """The ends of the three pieces of an extremal; `known` are roots that the field does not find by itself."""
    first, second, third = (int(u) for u in controls(int(extremal.word)))
    known = tuple(known)
    a = turned(start, first, extremal.first, known)
    if second == 0:
        b = Point(a.x + extremal.straight, a.y)
        return a, b, turned(b, third, extremal.last, known)
    if second not in (-1, 1):
        return a, a, a
    b = turned(a, second, extremal.middle, known)
    return a, b, turned(b, third, extremal.last, known) if third in (-1, 1) else b


def is_rotation(rotation: Any, cosine: Expression, sine: Expression) -> bool:
    """Whether a rotation is that by the angle of (cosine, sine), on the whole region."""
    field = cosine.field
    cross, dot = field.of(rotation[0]), field.of(rotation[1])
    return (cross * cosine - dot * sine).is_zero and (cross * sine + dot * cosine).signs == POSITIVE
