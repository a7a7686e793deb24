"""Words that cannot be faster than two arcs next to the point where these join (docs/wind.md).

Two arcs are a *corner*: the third piece of LSR, LRL and RLR vanishes there. Let x be the phase from the corner on, and
let a word join there s before the time of the corner. Next to the corner s is nearly proportional to x, so that the
word would be faster on one side of it only. The length of its third piece is nearly a linear function of x and s. Where
it is negative on that side, the word does not exist there. Bounds on the second and third derivatives show how far from
the corner this holds.
"""

from math import acos, atan2, cos, inf, pi, sqrt
from typing import NamedTuple

from loiter.kernel.angles import TWO_PI, length
from loiter.kernel.wind.cell_bounds import Cell, Centres, cell_at, centres, lrl_rlr_margin, tangent_margin
from loiter.kernel.wind.moving_target import tangent, time_within
from loiter.kernel.wind.paths import WindScene
from loiter.kernel.words import encode, set_of

# A vector that is displaced by a share of its length turns by less than this times that share, up to two thirds.
TURNS = 1.2

# 4/3 (TURNS/2)^3.
CUBE = TURNS * TURNS * TURNS / 6.0

# The angle by which the other arc may change while one vanishes.
SWING = 0.5 * pi


class Corner(NamedTuple):
    """Two arcs that end on the circle: the phase of their end, the control of the first, and their durations."""

    phase: float
    u: int
    t1: float
    t2: float


NO_CORNER = Corner(0.0, 0, 0.0, 0.0)


def words_beside(corner: Corner, reach: float, words: int, side: int, scene: WindScene) -> int:
    """Those of a set of words that may be faster than two arcs within a distance of their point of joining."""
    cell, impossible = cell_at(corner.phase, reach, side, scene), 0
    u = corner.u
    lsr, lrl, rlr = set_of(encode(u, 0, -u)), set_of(encode(u, -u, u)), set_of(encode(-u, u, -u))
    if words & lsr and straight_vanishes(corner, cell):
        impossible |= lsr
    if words & lrl and arc_vanishes(u, -1, corner.t2, corner.t1, corner, cell):
        impossible |= lrl
    if words & rlr and arc_vanishes(-u, 1, corner.t1, corner.t2, corner, cell):
        impossible |= rlr
    return words & ~impossible


def straight_vanishes(corner: Corner, cell: Cell) -> bool:
    """Whether LSR (u = +1) or RSL is never faster than the two arcs inside the cell around their point of joining.

    Let v be the angle by which the line of centres has turned since the corner. With the straight piece in the
    direction that it has at the corner, the length would exceed the true one by v^3/3 at most. Where the circles touch,
    it would be less than the true one by that much at most.
    """
    _, u, t1, t2 = corner
    time, half, wind = t1 + t2, cell.half, cell.wind
    between = centres(u, -u, cell)
    x, y = between.x - cell.wx * time, between.y - cell.wy * time
    _, p1, p2 = tangent(u, x, y)
    slope, fall = p1 * between.dx + p2 * between.dy - u * cell.turning, 1.0 + cell.wx * p1 + cell.wy * p2
    steep, curvature = abs(slope), p1 * between.ddx + p2 * between.ddy - u * cell.turned_more
    # v is at most TURNS (|D'| x + |w| s)/2, and (a + b)^3 <= 4 (a^3 + b^3). For s up to `longest` the second cube is
    # less than a sixth of `fall` s.
    windy = CUBE * wind * wind * wind
    longest = 0.5 if 1.5 * windy <= fall else sqrt(fall / (6.0 * windy))
    change, cube = (cell.bend_change + cell.jerk) / 6.0, CUBE * between.fastest * between.fastest * between.fastest
    slack = (max(-0.5 * curvature, 0.0) + (cube + change) * half) * half
    latest = 1.2 * (steep + slack) / fall
    if steep <= slack or latest * half > longest or between.fastest * half > 0.5:
        return False
    # The least and the largest s over x, on the side where the word would be faster.
    moved = between.fastest + wind * latest
    change += 0.25 * CUBE * moved * moved * moved
    shortest = (steep - (max(0.5 * curvature, 0.0) + change * half) * half) / fall
    latest = min(latest, (steep + (max(-0.5 * curvature, 0.0) + change * half) * half) / fall)
    # How the square of the distance of the centres changes with x there: the circles must overlap.
    drift, apart = 2.0 * (x * cell.wx + y * cell.wy), 2.0 * (x * between.dx + y * between.dy)
    apart = max(drift * shortest, drift * latest) - (apart if slope > 0.0 else -apart)
    if shortest < 0.0 or apart + (2.0 * cell.bend + moved * moved) * half >= 0.0:
        return False
    return is_late_before(between, cell, longest, corner)


def is_late_before(between: Centres, cell: Cell, longest: float, corner: Corner) -> bool:
    """Whether LSR or RSL joins nowhere in the cell more than `longest` before the time of the corner.

    And whether its arcs remain shorter than a turn.
    """
    _, u, t1, t2 = corner
    time, change, wind = t1 + t2, between.change, cell.wind
    enter, _ = time_within(between.x, between.y, cell.wx, cell.wy, 2.0 + 2.0 * change)
    apart = change + wind * longest
    arc = max(t1, t2 + cell.fastest_turning * cell.half) + acos(2.0 / (2.0 + apart)) + 0.5 * TURNS * apart
    if enter > 0.0 and enter >= time - longest:
        # The centres come closer until then: the arcs change in one sense.
        _, p1, p2 = tangent(u, between.x - cell.wx * time, between.y - cell.wy * time)
        _, q1, q2 = tangent(u, between.x, between.y)
        return arc + max(u * atan2(p1 * q2 - p2 * q1, p1 * q1 + p2 * q2), 0.0) < TWO_PI
    if arc >= TWO_PI or change >= 2.0:
        return False
    inner_enter, inner_leave = time_within(between.x, between.y, cell.wx, cell.wy, 2.0 - change)
    if inner_enter == inf or inner_leave < time - longest or (enter == 0.0 and inner_enter > 0.0):
        return False
    if inner_enter == 0.0:
        return True
    touching = inner_enter - enter
    return tangent_margin(u, between, cell, (0.0, enter), 0.0, touching) >= (1.0 + wind) * touching


def arc_vanishes(u: int, first: int, middle: float, other: float, corner: Corner, cell: Cell) -> bool:
    """Whether LRL (u = +1) or RLR is never faster than the two arcs inside the cell around their point of joining.

    `first` is +1 where its first arc vanishes, -1 where its last does; `middle` and `other` are the durations of the
    remaining arcs.
    """
    time, half, wind = corner.t1 + corner.t2, cell.half, cell.wind
    between = centres(u, u, cell)
    x, y = between.x - cell.wx * time, between.y - cell.wy * time
    distance, along = length(x, y), cos(0.5 * middle)
    if distance == 0.0:
        return False
    x, y = x / distance, y / distance
    slope = -along * u * cell.turning - x * between.dx - y * between.dy
    fall, steep = -along - x * cell.wx - y * cell.wy, abs(slope)
    if fall <= 0.0:
        return lrl_rlr_margin(u, cell, time, inf) >= 0.0
    if steep == 0.0:
        return False
    latest = 2.0 * steep / fall
    rate, nearest = between.fastest + wind * latest, distance - between.change - wind * latest * half
    turning = cell.fastest_turning
    sweep = 0.5 * (turning + latest) * half
    if nearest <= 0.0 or not sweep < middle < TWO_PI - sweep:
        return False
    bend = 0.25 * (turning + latest) * (turning + latest) + cell.twist + cell.bend + rate * rate / nearest
    spare = 0.5 * bend * half
    swing = (turning + rate / nearest + 0.25 * latest) * half
    if spare > steep or swing > SWING or other + swing >= TWO_PI:
        return False
    # How the arc that vanishes changes along x, on the side where the word would be faster.
    turned = u * (x * between.dy - y * between.dx) / distance
    drift = -u * (x * cell.wy - y * cell.wx) / distance
    growth = first * turned - 0.25 * u * cell.turning + (u * cell.turning if first < 0 else 0.0)
    sooner = first * drift + 0.25
    sign = 1.0 if slope > 0.0 else -1.0
    longer = -sign * growth - min(sooner * (steep - spare), sooner * (steep + spare)) / fall
    if longer + 0.5 * (cell.twist + cell.bend / nearest + rate * rate / (nearest * nearest)) * half >= 0.0:
        return False
    return lrl_rlr_margin(u, cell, time, time - 2.0 * middle) >= 0.0
