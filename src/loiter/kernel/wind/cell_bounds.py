"""Lower bounds for a whole arc of the circle: which words cannot join inside it before a given time (docs/wind.md).

A *cell* is the arc of phases within `half` of its middle. The margin of a word is negative unless no path of that word
joins inside the cell before a given time. It is the length of the word to the place where the point of joining is at
that time, less the time, or a similar function: so no equation has to be solved. A lower bound for the whole cell
follows from its value and derivative in the middle, and from a bound on its second derivative.

Where the margin is negative because an arc has been continued below zero, `..._needs_turn` shows that this is so
throughout the cell: such a path does not exist, and the same word takes a whole turn longer.
"""

from math import acos, atan2, cos, inf, pi, sin, sqrt
from typing import NamedTuple

from loiter.kernel.angles import TWO_PI, angle, arc_rotation, length
from loiter.kernel.wind.hold import hold_pose
from loiter.kernel.wind.moving_target import (
    Ends,
    Interval,
    interception,
    lsr_rsl_root,
    middle_arc,
    tangent,
    three_arcs,
    time_within,
)
from loiter.kernel.wind.paths import WindScene
from loiter.kernel.words import encode, set_of

# Tangents to h that `has_no_middle` tries.
TANGENTS = 8


class Cell(NamedTuple):
    """An arc of the circle, and what all words share: derivatives are with respect to the phase.

    `half` is half its width; (px, py) the point in its middle, from the start, and (c, s) the heading there; (tx, ty)
    the derivative of the point, and (nx, ny) its second derivative; `turning` and `turned_more` those of the angle of
    the heading. `fastest_turning`, `twist` and `jerk` bound the first three derivatives of that angle, `bend` and
    `bend_change` the second and the third derivative of the centre of the last arc. (c0, s0) is the heading at the
    start, (wx, wy) the wind, `wind` its size.
    """

    half: float
    px: float
    py: float
    c: float
    s: float
    tx: float
    ty: float
    nx: float
    ny: float
    turning: float
    turned_more: float
    bend: float
    bend_change: float
    twist: float
    jerk: float
    fastest_turning: float
    wind: float
    c0: float
    s0: float
    wx: float
    wy: float


class Centres(NamedTuple):
    """The vector from the centre of the first arc to that of the last at time 0 and two derivatives by the phase.

    `change` bounds how much the vector differs from that inside the cell, `fastest` its derivative.
    """

    x: float
    y: float
    dx: float
    dy: float
    ddx: float
    ddy: float
    change: float
    fastest: float


def words_inside(phase: float, half: float, words: int, side: int, scene: WindScene, time: float) -> int:
    """Those of a set of words that may join before a time inside the cell with this middle and half width."""
    cell, impossible = cell_at(phase, half, side, scene), 0
    if is_out_of_reach(cell, scene.R, time):
        return 0
    for u in (1, -1):
        lsl, lsr, lrl = set_of(encode(u, 0, u)), set_of(encode(u, 0, -u)), set_of(encode(u, -u, u))
        if words & lsl and lsl_rsr_margin(u, cell, time) >= 0.0:
            impossible |= lsl
        if words & lsr and lsr_rsl_margin(u, cell, time) >= 0.0:
            impossible |= lsr
        if words & lrl and lrl_rlr_margin(u, cell, time, inf) >= 0.0:
            impossible |= lrl
    return words & ~impossible


def cell_at(phase: float, half: float, side: int, scene: WindScene) -> Cell:
    """The cell around a phase."""
    x, y, c0, s0, R, wx, wy, _ = scene
    px, py, c, s, g = hold_pose(phase, side, R, wx, wy)
    wind, out = length(wx, wy), (wx * px + wy * py) / R
    crab = sqrt((1.0 - out) * (1.0 + out))
    # The heading turns by g/crab, from 1 - |w| upwind to 1 + |w| downwind; that changes most across the wind.
    turning, twist = g / crab, wind / sqrt((1.0 - wind) * (1.0 + wind))
    fastest_turning = min(1.0 + wind, turning + twist * half)
    bend = R + fastest_turning * fastest_turning + twist
    tx, ty = R * (c + wx) / g, R * (s + wy) / g
    still = (1.0 - wind) * (1.0 + wind)
    turned_more = side * out * still / (crab * crab * crab)
    jerk = twist * (1.0 + 2.0 * wind * wind) / still
    bend_change = R + jerk + 3.0 * fastest_turning * twist + fastest_turning * fastest_turning * fastest_turning
    return Cell(
        half,
        px - x,
        py - y,
        c,
        s,
        tx,
        ty,
        -px,
        -py,
        -side * turning,
        turned_more,
        bend,
        bend_change,
        twist,
        jerk,
        fastest_turning,
        wind,
        c0,
        s0,
        wx,
        wy,
    )


def centres(first: int, last: int, cell: Cell) -> Centres:
    """The centres of the first and the last arc of a word with these controls."""
    x, y = cell.px - last * cell.s + first * cell.s0, cell.py + last * cell.c - first * cell.c0
    turning, c, s = cell.turning, cell.c, cell.s
    dx, dy = cell.tx - last * turning * c, cell.ty - last * turning * s
    ddx = cell.nx - last * (cell.turned_more * c - turning * turning * s)
    ddy = cell.ny - last * (cell.turned_more * s + turning * turning * c)
    rate = length(dx, dy)
    change = (rate + 0.5 * cell.bend * cell.half) * cell.half
    return Centres(x, y, dx, dy, ddx, ddy, change, rate + cell.bend * cell.half)


def least_inside(value: float, slope: float, bend: float, half: float) -> float:
    """A lower bound, inside a cell, on a function whose second derivative is at least -`bend`."""
    return value - (abs(slope) + 0.5 * bend * half) * half


def least_inside_curved(value: float, slope: float, curvature: float, change: float, half: float) -> float:
    """A lower bound, inside a cell, on a function whose third derivative is at most `change` in size."""
    steep = abs(slope)
    least = value - (steep - (0.5 * curvature - change * half / 6.0) * half) * half
    square = curvature * curvature - 2.0 * steep * change
    if curvature > 0.0 and square > 0.0:
        lowest = 2.0 * steep / (curvature + sqrt(square))
        if lowest < half:
            least = min(least, value - (steep - (0.5 * curvature - change * lowest / 6.0) * lowest) * lowest)
    return least


def distance_curvature(p1: float, p2: float, distance: float, between: Centres) -> float:
    """The second derivative of the length of LSL (or LSR, with `distance` its straight piece) but for that of the arcs.

    The straight piece has the direction p.
    """
    across = p1 * between.dy - p2 * between.dx
    return p1 * between.ddx + p2 * between.ddy + across * across / distance


def distance_curvature_change(nearest: float, touching: float, between: Centres, cell: Cell) -> float:
    """A bound on the derivative of `distance_curvature` inside a cell, where the straight piece is at least `nearest`.

    `touching` is 2 for LSR, where the direction of the straight piece changes its length too, otherwise 0.
    """
    swing = between.fastest / nearest
    return cell.bend_change + (3.0 * cell.bend + (3.0 * between.fastest + touching * swing) * swing) * swing


def is_out_of_reach(cell: Cell, radius: float, time: float) -> bool:
    """Whether no vehicle, however fast it turns, reaches the cell before the time."""
    return length(cell.px - cell.wx * time, cell.py - cell.wy * time) >= time + radius * cell.half


def lowest_turn(turn: float, change: float) -> float:
    """An angle in [0, 2 pi), or one turn less where a change by as much as `change` may bring it back to zero."""
    return turn - TWO_PI if turn + change >= TWO_PI else turn


def lsl_rsr_margin(u: int, cell: Cell, time: float) -> float:
    """The margin of LSL (u = +1) or RSR: the length of the word less the time."""
    between, turned = centres(u, u, cell), cell.fastest_turning * cell.half
    x, y = between.x - cell.wx * time, between.y - cell.wy * time
    arcs = lowest_turn(angle(arc_rotation(u, cell.c0, cell.s0, cell.c, cell.s)), turned)
    distance = length(x, y)
    nearer = (x * between.dx + y * between.dy) / distance if distance > 0.0 else between.change / cell.half
    slope, bend, value = nearer + u * cell.turning, cell.bend + cell.twist, distance + arcs - time
    margin = least_inside(value, slope, bend, cell.half)
    if margin < 0.0 < distance - between.change:
        curvature = distance_curvature(x / distance, y / distance, distance, between) + u * cell.turned_more
        change = distance_curvature_change(distance - between.change, 0.0, between, cell) + cell.jerk
        margin = max(margin, least_inside_curved(value, slope, curvature, change, cell.half))
    if margin < 0.0 and lsl_rsr_needs_turn(u, arcs, between, turned, cell):
        return margin + TWO_PI
    return margin


def lsl_rsr_needs_turn(u: int, arcs: float, between: Centres, turned: float, cell: Cell) -> bool:
    """Whether two arcs that add up to `arcs` are too few throughout the cell: the first alone would be longer."""
    wx, wy = cell.wx, cell.wy
    x, y = between.x - wx * arcs, between.y - wy * arcs
    straight = interception(x, y, wx, wy)
    x, y = x - wx * straight, y - wy * straight
    distance = length(x, y)
    if distance == 0.0:
        return False
    rate = slowest_fall(x / distance, y / distance, cell)
    # How far the centres move relative to each other, since the time changes too.
    shift = between.change + cell.wind * (between.change + turned) / rate
    first, swing = angle(arc_rotation(u, cell.c0, cell.s0, x, y)), 0.5 * pi * shift / distance
    known = shift < distance and cell.wind * swing <= rate
    if known and first - swing <= arcs + turned:
        # The rate is known better now.
        shift = between.change + cell.wind * (between.change + turned) / (2.0 * rate - cell.wind * swing)
        swing = 0.5 * pi * shift / distance
    return known and first - swing > arcs + turned and first + swing < TWO_PI


def slowest_fall(p1: float, p2: float, cell: Cell) -> float:
    """Half the rate at which the length of a word, less the time, falls with the time.

    Its straight piece has the direction p. The rate is no less while the direction changes by no more than this over
    |w|.
    """
    return 0.5 * (1.0 + cell.wx * p1 + cell.wy * p2)


def lsr_rsl_margin(u: int, cell: Cell, time: float) -> float:
    """The margin of LSR (u = +1) or RSL: the length of the word less the time, where the arcs do not overlap."""
    between = centres(u, -u, cell)
    wx, wy, change = cell.wx, cell.wy, between.change
    enter, leave = time_within(between.x, between.y, wx, wy, 2.0 + 2.0 * change)
    if enter >= time:
        return tangent_margin(u, between, cell, (0.0, time), 0.0, 0.0)
    margin = inf
    inner_enter, inner_leave = inf, inf
    if change < 2.0:
        inner_enter, inner_leave = time_within(between.x, between.y, wx, wy, 2.0 - change)
    if inner_enter > 0.0:
        # The first arc and the last may touch between these times.
        touching = min(inner_enter, leave, time) - enter
        if enter == 0.0:
            return -inf
        margin = tangent_margin(u, between, cell, (0.0, enter), 0.0, touching)
        margin -= (1.0 + cell.wind) * touching
    if leave <= time:
        touching = leave - (inner_leave if inner_enter < inf else enter)
        last = tangent_margin(u, between, cell, (leave, time), touching, 0.0)
        margin = min(margin, last)
    elif inner_leave < time or inner_enter == inf:
        return -inf
    return margin


def most_turned(touching: float, between: Centres, cell: Cell) -> float:
    """The angle by which the straight piece of LSR or RSL turns at most while the arcs may touch."""
    moved = 0.5 * (cell.wind) * touching
    return acos(2.0 / (2.0 + 3.0 * between.change)) + (0.5 * pi * moved if moved < 1.0 else pi)


def tangent_margin(u: int, between: Centres, cell: Cell, interval: Interval, before: float, after: float) -> float:
    """The margin of LSR or RSL at the end of an interval, throughout which the centres are further apart than 2.

    `before` is how long before the interval the arcs may touch, `after` how long after it.
    """
    begin, time = interval
    x, y = between.x - cell.wx * time, between.y - cell.wy * time
    straight, p1, p2 = tangent(u, x, y)
    nearest = length(x, y) - between.change
    if nearest <= 2.0:
        return -inf
    # The direction of the straight piece turns by less than this inside the cell, and by `earlier` during the interval.
    swing = between.change / sqrt(nearest * nearest - 4.0)
    if before + after > 0.0:
        swing += most_turned(before + after, between, cell)
    _, q1, q2 = tangent(u, between.x - cell.wx * begin, between.y - cell.wy * begin)
    earlier = u * atan2(p1 * q2 - p2 * q1, p1 * q1 + p2 * q2)
    turned = cell.fastest_turning * cell.half
    first, last = angle(arc_rotation(u, cell.c0, cell.s0, p1, p2)), angle(arc_rotation(u, cell.c, cell.s, p1, p2))
    slope = p1 * between.dx + p2 * between.dy - u * cell.turning
    middle = straight + first + last - time
    value = least_inside(middle, slope, cell.bend + cell.twist, cell.half)
    if value < 0.0:
        curvature = distance_curvature(p1, p2, straight, between) - u * cell.turned_more
        change = distance_curvature_change(sqrt(nearest * nearest - 4.0), 2.0, between, cell) + cell.jerk
        value = max(value, least_inside_curved(middle, slope, curvature, change, cell.half))
    lowest = lowest_turn(first, swing + max(earlier, 0.0)) + lowest_turn(last, swing + max(earlier, 0.0) + turned)
    value += lowest - first - last
    # The arcs at the beginning of the interval, without those turns that either arc may lose.
    arcs = lowest + 2.0 * earlier
    for _ in range(3):
        if value >= 0.0:
            return value
        if not lsr_rsl_needs_turn(u, between, cell, arcs, interval, before):
            return value
        value, arcs = value + TWO_PI, arcs + TWO_PI
    return value


def lsr_rsl_needs_turn(u: int, between: Centres, cell: Cell, arcs: float, interval: Interval, before: float) -> bool:
    """Whether LSR or RSL has an arc below zero throughout the cell if its two arcs last `arcs` at the beginning.

    Or whether it is shorter than the time from the beginning on, and `before` that, so that it is never equal to it.
    """
    begin, end = interval
    turned = cell.fastest_turning * cell.half
    straight, _, _ = tangent(u, between.x - cell.wx * begin, between.y - cell.wy * begin)
    if straight + arcs + between.change + turned + (1.0 + cell.wind) * before < begin:
        return True
    ends = Ends(cell.c0, cell.s0, cell.c, cell.s, cell.wx, cell.wy, 0.0)
    time = lsr_rsl_root(u, between.x, between.y, ends, arcs, interval)
    if not begin < time < end:
        return False
    x, y = between.x - cell.wx * time, between.y - cell.wy * time
    straight, p1, p2 = tangent(u, x, y)
    rate = slowest_fall(p1, p2, cell)
    later = (between.change + turned) / rate
    moved = between.change + cell.wind * later
    nearest = length(x, y) - moved
    if nearest <= 2.0 or time - later <= begin:
        return False
    swing = moved / sqrt(nearest * nearest - 4.0)
    if cell.wind * swing > rate:
        return False
    t1, t3 = angle(arc_rotation(u, cell.c0, cell.s0, p1, p2)), angle(arc_rotation(u, cell.c, cell.s, p1, p2))
    first, last = min(t1, TWO_PI - t1), min(t3, TWO_PI - t3)
    return t1 + straight + t3 - time > pi and first > swing and last > swing + turned


def lrl_rlr_margin(u: int, cell: Cell, time: float, known: float) -> float:
    """The margin of LRL (u = +1) or RLR: what is left between its outer arcs once the middle one lasts long enough.

    Paths whose T less twice the middle arc is `known`, within half a turn, are left out.
    """
    between, turned = centres(u, u, cell), cell.fastest_turning * cell.half
    enter, _ = time_within(between.x, between.y, cell.wx, cell.wy, 4.0 + between.change)
    if enter >= time:
        return inf
    arcs = lowest_turn(angle(arc_rotation(u, cell.c0, cell.s0, cell.c, cell.s)), turned)
    shortest = 2.0 * acos(cell.wind)
    for turns in (-1.0, 0.0, 1.0, 2.0):
        outside = arcs + TWO_PI * turns
        if abs(outside - known) < pi:
            continue
        late = max(outside - turned + 2.0 * shortest, -outside - turned, shortest) - time
        if late < 0.0:
            late = middle_margin(u, between, cell, outside, time)
        if late < 0.0 and not (
            has_no_middle(between, cell, outside, time) or lrl_rlr_needs_turn(u, between, cell, outside)
        ):
            return late
    return inf


def has_no_middle(between: Centres, cell: Cell, outside: float, time: float) -> bool:
    """Whether LRL or RLR with a given T less twice its middle arc exists nowhere in the cell before the time.

    In `moving_target.middle_arc`, h has a root at which it rises only if it is not positive somewhere between the two
    points of inflection. There it is convex: it lies above its tangents.
    """
    wx, wy = cell.wx, cell.wy
    wind = cell.wind
    turned = cell.fastest_turning * cell.half
    low = acos(wind * wind)
    high = min(TWO_PI - low, 0.5 * (time - outside + turned))
    # How far the centres move relative to each other inside the cell, for a given middle arc.
    shift = between.change + wind * turned
    needed = (8.0 + 3.0 * shift) * shift
    for _ in range(TANGENTS):
        if low > high:
            return True
        m = 0.5 * (low + high)
        x, y = between.x - wx * (outside + 2.0 * m), between.y - wy * (outside + 2.0 * m)
        across, along = sin(0.5 * m), cos(0.5 * m)
        spare = x * x + y * y - 16.0 * across * across - needed
        slope = -4.0 * (wx * x + wy * y) - 16.0 * across * along
        if spare <= 0.0:
            return False
        # By the tangent, h is large enough on the side to which it rises, and for some way to the other side.
        if slope > 0.0:
            high = m - spare / slope
        elif slope < 0.0:
            low = m - spare / slope
        else:
            return True
    return False


def lrl_rlr_needs_turn(u: int, between: Centres, cell: Cell, outside: float) -> bool:
    """Whether LRL or RLR with a given T less twice its middle arc has an arc below zero throughout the cell."""
    wx, wy = cell.wx, cell.wy
    wind, turned = cell.wind, cell.fastest_turning * cell.half
    middle = middle_arc(between.x - wx * outside, between.y - wy * outside, wx, wy, (0.0, inf))
    if middle == inf:
        return False
    time = outside + 2.0 * middle
    x, y = between.x - wx * time, between.y - wy * time
    distance = length(x, y)
    slope = -4.0 * (wx * x + wy * y) - 8.0 * sin(middle)
    shift = between.change + wind * turned
    # Near its root, h changes by up to `rise` inside the cell. Its second derivative is at most 16, so the root moves
    # by less than twice `rise` over the slope, as long as that does not exceed a sixteenth of the slope.
    rise = (2.0 * distance + 0.25 * wind * slope + shift) * shift
    if 32.0 * rise >= slope * slope or slope <= 0.0:
        return False
    longer = 2.0 * rise / slope
    moved = shift + 2.0 * wind * longer
    if moved >= distance:
        return False
    swing = 0.5 * pi * moved / distance + 0.5 * longer
    ends = Ends(cell.c0, cell.s0, cell.c, cell.s, wx, wy, 0.0)
    path = three_arcs(u, middle, x, y, ends)
    first, last = min(path.t1, TWO_PI - path.t1), min(path.t3, TWO_PI - path.t3)
    return path.time - time > pi and first > swing and last > swing + turned


def middle_margin(u: int, between: Centres, cell: Cell, outside: float, time: float) -> float:
    """The margin of LRL or RLR with a given T less twice its middle arc, of which the middle may last longer.

    A word that does not join before a later time does not join before this time either.
    """
    margin = middle_margin_at(u, between, cell, outside, time)
    if margin < 0.0:
        x, y = between.x - cell.wx * time, between.y - cell.wy * time
        distance = length(x, y)
        if distance > 0.0:
            growth = cos(0.25 * (time - outside)) + (x * cell.wx + y * cell.wy) / distance
            if growth > 0.0:
                later = growth / (0.25 + cell.wind * cell.wind / distance)
                margin = max(margin, middle_margin_at(u, between, cell, outside, time + later))
    return margin


def middle_margin_at(u: int, between: Centres, cell: Cell, outside: float, time: float) -> float:
    """What is left between the outer arcs of LRL or RLR at a time, with a given T less twice its middle arc."""
    x, y = between.x - cell.wx * time, between.y - cell.wy * time
    distance, half_middle = length(x, y), 0.25 * (time - outside)
    if half_middle <= 0.0 or half_middle >= pi or distance <= between.change:
        return -inf
    turning = cell.fastest_turning
    across, along, nearest = sin(half_middle), cos(half_middle), distance - between.change
    slope = along * u * cell.turning + (x * between.dx + y * between.dy) / distance
    bend = 0.25 * turning * turning + cell.twist + cell.bend + between.fastest * between.fastest / nearest
    value = 4.0 * across - distance
    margin = least_inside(value, slope, bend, cell.half)
    if margin < 0.0:
        curvature = -distance_curvature(x / distance, y / distance, distance, between)
        curvature -= 0.25 * across * cell.turning * cell.turning + along * u * cell.turned_more
        change = distance_curvature_change(nearest, 0.0, between, cell)
        change += (0.0625 * turning * turning + 0.75 * cell.twist) * turning + cell.jerk
        margin = max(margin, least_inside_curved(value, slope, curvature, change, cell.half))
    return margin
