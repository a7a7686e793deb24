"""Paths of a given length between two poses: two arcs of radius 1 and a middle piece of any curvature (docs/slots.md).

A path leaves its first circle, of control `first`, where the left normal of the heading is n. The circle that touches
the path there and the last circle has the curvature

    k = 2 (z - first + last) / (2 first z - |d|^2),    z = d . n,

where d leads from the centre of the last circle to that of the first. So n, one angle, gives the whole path. Along such
a family the length has no other extremes than those with a straight middle piece or with |k| = 1: between them it is
monotone, so that bisection finds every path of a given length.
"""

from collections.abc import Callable, Iterator
from itertools import pairwise
from math import acos, asin, atan2, ceil, cos, floor, inf, nan, pi, sin, sqrt
from typing import NamedTuple

from loiter.kernel.angles import TWO_PI, angle, arc_rotation, length
from loiter.kernel.rounding import ROUNDING
from loiter.kernel.wind.moving_target import interception, tangent, time_within
from loiter.kernel.wind.paths import WindScene
from loiter.kernel.wind.slots import Slot, SlotPose, excess_at, less_whole_turns

# Halvings that shrink an interval of angles to rounding.
HALVINGS = 70

# The arcs at the end of an interval are those next to it: this share of its width inside.
BESIDE = 1e-7

# Lengths that differ by less than this share count as one.
SAME_LENGTH = 1e-9

# The span of times in which crossings are sought at once, and the most of them that are tried: some 25 are needed in a
# wind of 0.9999 of the airspeed, for times of up to 10^6.
WINDOW, MOST_WINDOWS = 8.0, 200

OUTER_CONTROLS = ((1, 1), (-1, -1), (1, -1), (-1, 1))


class Ends(NamedTuple):
    """The poses in the frame of the air: the heading (c0, s0) at the start, the end (x, y) from there, (c, s)."""

    c0: float
    s0: float
    x: float
    y: float
    c: float
    s: float


class ThreeArcs(NamedTuple):
    """A path: the outer controls, the curvature of the middle piece, and the durations of the three pieces."""

    first: int
    curvature: float
    last: int
    t1: float
    t2: float
    t3: float

    @property
    def length(self) -> float:
        """The length of the path, and its duration."""
        return self.t1 + self.t2 + self.t3

    @property
    def turning(self) -> float:
        """The sum of the angles of its arcs."""
        return self.t1 + abs(self.curvature) * self.t2 + self.t3


class Family(NamedTuple):
    """The paths with two outer controls between two poses. d is `distance` long in the direction `azimuth`."""

    first: int
    last: int
    ends: Ends
    distance: float
    azimuth: float


class Stretch(NamedTuple):
    """Paths of a family between two angles, `shorter` and `longer`, along which the length is monotone."""

    family: Family
    shorter: float
    longer: float
    shortest: ThreeArcs
    longest: ThreeArcs


def families(ends: Ends) -> Iterator[Family]:
    """The families between two poses, those of LSR and RSL where their circles touch, up to rounding, or are apart."""
    length_tolerance = ROUNDING * (1.0 + abs(ends.x) + abs(ends.y))
    for first, last in OUTER_CONTROLS:
        dx = -first * ends.s0 - (ends.x - last * ends.s)
        dy = first * ends.c0 - (ends.y + last * ends.c)
        distance = length(dx, dy)
        if first == last or distance >= 2.0 - length_tolerance:
            yield Family(first, last, ends, distance, atan2(dy, dx))


def beside_axis(first: int, alpha: float) -> float:
    """1 - `first` cos(alpha), without cancellation."""
    half = sin(0.5 * alpha) if first > 0 else cos(0.5 * alpha)
    return 2.0 * half * half


def curvature_at(family: Family, alpha: float) -> float:
    """The curvature of the middle piece."""
    first, last, _, distance, _ = family
    if first == last:
        return 2.0 * cos(alpha) / ((2.0 * first * cos(alpha) - distance) or -inf)
    spare, beside = distance - 2.0, beside_axis(first, alpha)
    # Both vanish at |d| = 2 on the axis: the outer circles touch there, and any circle is between them.
    return -2.0 * first * (spare - distance * beside) / ((distance * (spare + 2.0 * beside)) or inf)


def last_normal(first: int, last: int, distance: float, alpha: float) -> float:
    """The angle from d to the normal where the last arc begins, if `alpha` is that to the one where the first ends."""
    if first == last:
        return pi - alpha
    spare, beside = distance - 2.0, beside_axis(first, alpha)
    along = first * ((distance * distance + 4.0) * beside - spare * spare)
    return atan2(spare * (distance + 2.0) * sin(alpha), along)


def path_at(family: Family, alpha: float) -> ThreeArcs:
    """The path that leaves the first circle where the normal is at the angle `alpha` from d."""
    first, last, ends, distance, azimuth = family
    c1, s1 = cos(alpha), sin(alpha)
    beta = last_normal(first, last, distance, alpha)
    c3, s3 = cos(beta), sin(beta)
    # From the end of the first arc to the beginning of the last one, in the frame of d.
    chord_x, chord_y = first * c1 - last * c3 - distance, first * s1 - last * s3
    ahead, left = chord_x * s1 - chord_y * c1, chord_x * c1 + chord_y * s1
    chord, half = length(chord_x, chord_y), atan2(abs(left), ahead)
    t2 = inf if left == 0.0 > ahead else chord if left == 0.0 else chord * chord * half / abs(left)
    # From the direction of d to the normals at the ends.
    t1 = first * (alpha + azimuth - atan2(ends.c0, -ends.s0))
    t3 = last * (atan2(ends.c, -ends.s) - azimuth - beta)
    return ThreeArcs(first, curvature_at(family, alpha), last, t1 % TWO_PI, t2, t3 % TWO_PI)


def without_first_arc(family: Family) -> float:
    """The angle of the path whose first arc vanishes."""
    return atan2(family.ends.c0, -family.ends.s0) - family.azimuth


def without_last_arc(family: Family) -> float:
    """The angle of the path whose last arc vanishes: that of the reversed path whose first arc does."""
    first, last, ends, distance, azimuth = family
    return last_normal(last, first, distance, atan2(ends.c, -ends.s) - azimuth - pi) + pi


def breaks(family: Family) -> list[float]:
    """The angles between which the length is monotone and no arc vanishes, from one end of the family to the other."""
    first, last, _, distance, _ = family
    axis = 0.0 if first > 0 else pi
    straight, tightest = 0.5 * pi, acos(min(0.25 * distance, 1.0))
    if first != last:
        straight, tightest = 2.0 * asin(sqrt(0.5 * (distance - 2.0) / distance)), 0.0
    # Nearer the axis than `tightest` the middle circle is too tight.
    low, high = axis + tightest, axis + TWO_PI - tightest
    inside = [axis + straight, axis - straight, without_first_arc(family), without_last_arc(family)]
    turned = sorted(low + (a - low) % TWO_PI for a in inside)
    return [low, *(a for a in turned if low < a < high), high]


def at_end(family: Family, alpha: float, inside: float) -> ThreeArcs:
    """The path at the end of an interval, its arcs continued from a path inside."""
    path, near = path_at(family, alpha), path_at(family, alpha + BESIDE * (inside - alpha))
    t1 = near.t1 + less_whole_turns(path.t1 - near.t1)
    t3 = near.t3 + less_whole_turns(path.t3 - near.t3)
    t2 = inf if near.t2 > 1.0 / BESIDE else path.t2
    return path._replace(t1=max(t1, 0.0), t2=t2, t3=max(t3, 0.0))


def stretches(ends: Ends) -> Iterator[Stretch]:
    """All paths between two poses without whole turns more, each stretch with its shortest and its longest."""
    for family in families(ends):
        spare = family.distance if family.first == family.last else family.distance - 2.0
        touching = spare <= ROUNDING * (1.0 + abs(ends.x) + abs(ends.y))
        if touching:
            arcs = on_one_circle(family) if family.first == family.last else on_touching_circles(family)
            yield Stretch(family, 0.0, 0.0, arcs, arcs)
        # Between opposite circles that touch nothing is longer than the two arcs by less than a gap.
        if spare <= 0.0 or (touching and family.first != family.last):
            continue
        for a, b in pairwise(breaks(family)):
            middle = 0.5 * (a + b)
            if b - a <= ROUNDING:
                continue
            one, other = at_end(family, a, middle), at_end(family, b, middle)
            if one.length <= other.length:
                yield Stretch(family, a, b, one, other)
            else:
                yield Stretch(family, b, a, other, one)


def on_one_circle(family: Family) -> ThreeArcs:
    """The single arc between poses on one circle."""
    first, ends = family.first, family.ends
    arc = angle(arc_rotation(first, ends.c0, ends.s0, ends.c, ends.s))
    return ThreeArcs(first, float(first), first, arc, 0.0, 0.0)


def on_touching_circles(family: Family) -> ThreeArcs:
    """The two arcs between poses on circles that touch."""
    first, last, ends, _, azimuth = family
    # Opposite arcs meet where both normals point along d, or against it.
    nx, ny = first * cos(azimuth), first * sin(azimuth)
    t1 = angle(arc_rotation(first, -ends.s0, ends.c0, nx, ny))
    return ThreeArcs(first, 0.0, last, t1, 0.0, angle(arc_rotation(last, nx, ny, -ends.s, ends.c)))


def turns_more(stretch: Stretch, wanted: float, length_tolerance: float) -> int:
    """The least number of whole turns with which a stretch has a path of a length; -1 where it has none."""
    short = wanted - stretch.longest.length - length_tolerance
    turns = ceil(short / TWO_PI) if short > 0.0 else 0
    return turns if wanted - TWO_PI * turns >= stretch.shortest.length - length_tolerance else -1


def is_reachable(ends: Ends, wanted: float) -> bool:
    """Whether there is a path of a length."""
    return any(turns_more(stretch, wanted, 0.0) >= 0 for stretch in stretches(ends))


def path_of_length(ends: Ends, wanted: float, length_tolerance: float) -> ThreeArcs | None:
    """The path of a length that turns least; None where there is none, up to `length_tolerance`."""
    found = []
    for stretch in stretches(ends):
        turns = turns_more(stretch, wanted, length_tolerance)
        if turns >= 0:
            rest = wanted - TWO_PI * turns
            path = path_within(stretch, rest, length_tolerance)
            # Next to two arcs that touch up to rounding the length jumps.
            if abs(path.length - rest) <= SAME_LENGTH * (1.0 + wanted):
                path = with_length(path, ends, rest)
                found.append(path._replace(t1=path.t1 + TWO_PI * turns))
    # Between opposite circles that nearly touch a rounding of the angle may move the end much further.
    exact = [path for path in found if is_exact(path, ends, wanted, length_tolerance)]
    if not exact:
        at_edge = paths_at_edge(ends, wanted)
        exact = [path for path in at_edge if is_exact(path, ends, wanted, length_tolerance)]
    return min(exact or found, key=lambda path: path.turning, default=None)


def is_exact(path: ThreeArcs, ends: Ends, wanted: float, length_tolerance: float) -> bool:
    """Whether a path ends at the pose and has a length, to about half of what `certify_arrival` allows."""
    rounded = ROUNDING * (1.0 + abs(ends.x) + abs(ends.y) + wanted)
    in_time = abs(path.length - wanted) <= 0.5 * ROUNDING * (1.0 + wanted)
    return (
        in_time
        and abs(path.curvature) <= 1.0 + 0.5 * ROUNDING
        and miss_of(path, ends) <= 2.0 * max(length_tolerance, rounded)
    )


def miss_of(path: ThreeArcs, ends: Ends) -> float:
    """How far a path ends from the pose: the greater of the distances of the places and of the headings."""
    x, y, c, s = 0.0, 0.0, ends.c0, ends.s0
    for k, t in ((float(path.first), path.t1), (path.curvature, path.t2), (float(path.last), path.t3)):
        half = 0.5 * k * t
        chord = t * sin(half) / half if half != 0.0 else t
        c, s = c * cos(half) - s * sin(half), s * cos(half) + c * sin(half)
        x, y = x + chord * c, y + chord * s
        c, s = c * cos(half) - s * sin(half), s * cos(half) + c * sin(half)
    return max(length(x - ends.x, y - ends.y), length(c - ends.c, s - ends.s))


def paths_at_edge(ends: Ends, wanted: float) -> Iterator[ThreeArcs]:
    """The paths of a length, and with the heading at their end, that may be at the edge of what is reachable.

    A pose that is beyond the edge by rounding has a path in no family, as a first or last arc falls short of zero, or
    the outer circles overlap, or are too far apart: what is left are two pieces, or three arcs of 1. Only those count
    that end at the pose.
    """
    turned = atan2(ends.c0 * ends.s - ends.s0 * ends.c, ends.c0 * ends.c + ends.s0 * ends.s)
    for first in (1, -1):
        arc = first * turned
        yield from arc_and_straight(ends, wanted, first, arc % TWO_PI)
        for last in within(0.5 * (wanted - arc), pi, wanted):
            yield ThreeArcs(first, 0.0, -first, wanted - last, 0.0, last)
        for middle in within(0.5 * (wanted - arc), pi, wanted):
            dx, dy = ends.x - first * (ends.s - ends.s0), ends.y + first * (ends.c - ends.c0)
            azimuth = atan2(ends.c0 * dy - ends.s0 * dx, ends.c0 * dx + ends.s0 * dy)
            for t1 in within(first * azimuth + 0.5 * middle, TWO_PI, wanted - middle):
                yield ThreeArcs(first, -float(first), first, t1, middle, wanted - middle - t1)


def arc_and_straight(ends: Ends, wanted: float, first: int, arc: float) -> Iterator[ThreeArcs]:
    """The arc and the straight piece of a length, in either order; `arc` is that without whole turns."""
    for c, s, arc_is_first in ((ends.c, ends.s, True), (ends.c0, ends.s0, False)):
        # The arc is from the start to (s - s0, c0 - c), or the other way round.
        dx, dy = ends.x - first * (ends.s - ends.s0), ends.y + first * (ends.c - ends.c0)
        turns = floor((wanted - arc - dx * c - dy * s) / TWO_PI + 0.5)
        t = max(0.0, min(arc + TWO_PI * turns, wanted))
        if arc_is_first:
            yield ThreeArcs(first, 0.0, first, t, wanted - t, 0.0)
        else:
            yield ThreeArcs(first, 0.0, first, 0.0, wanted - t, t)


def within(angle_at: float, period: float, most: float) -> list[float]:
    """The angles a period apart in the first turn, none beyond 0 or `most`: those beyond by less count as these."""
    least = angle_at - period * floor(angle_at / period)
    return [max(0.0, min(least + period * i, most)) for i in range(-1, 1 + int(TWO_PI / period + 0.5))]


def path_within(stretch: Stretch, wanted: float, length_tolerance: float) -> ThreeArcs:
    """The path of a stretch with a length; its shortest or longest one where that has it, up to `length_tolerance`.

    Next to a straight middle piece the length is stationary: a rounding of it would bend that piece visibly.
    """
    if wanted <= stretch.shortest.length + length_tolerance:
        return stretch.shortest
    if wanted >= stretch.longest.length - length_tolerance:
        return stretch.longest
    low, high = stretch.shorter, stretch.longer
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        if path_at(stretch.family, middle).length < wanted:
            low = middle
        else:
            high = middle
    return path_at(stretch.family, low)


def with_length(path: ThreeArcs, ends: Ends, wanted: float) -> ThreeArcs:
    """The path with exactly a length that it nearly has, and with exactly the heading at its end.

    A rounding of the angle that gives a path changes the length t of a long middle arc by some roundings of t^2 over
    its chord, and its curvature by a rounding, that is the angle turned by one of t. An arc of the length missing that
    turns by the angle missing has the same chord to roundings of t.
    """
    first, k, last, t1, t2, t3 = path
    turned = atan2(ends.c0 * ends.s - ends.s0 * ends.c, ends.c0 * ends.c + ends.s0 * ends.s)
    missing = less_whole_turns(turned - first * t1 - k * t2 - last * t3)
    # Half of what `certify_arrival` allows: conversions to seconds and back, and sums, round too.
    tolerance, middle = 0.5 * ROUNDING, wanted - t1 - t3
    exact = abs(path.length - wanted) <= tolerance * (1.0 + wanted) and abs(missing) <= tolerance
    if exact or middle <= 0.0:
        return path
    return path._replace(curvature=max(-1.0, min((k * t2 + missing) / middle, 1.0)), t2=middle)


class Arrival(NamedTuple):
    """A pose that moves through the air with -w and keeps its heading: where it is at the time 0, and w."""

    ends: Ends
    wx: float
    wy: float

    def at(self, time: float) -> Ends:
        """The pose at a time."""
        return self.ends._replace(x=self.ends.x - self.wx * time, y=self.ends.y - self.wy * time)


def is_in_time(arrival: Arrival, time: float) -> bool:
    """Whether the pose can be reached at a time."""
    return is_reachable(arrival.at(time), time)


def next_time(arrival: Arrival, time: float) -> float:
    """The first time after an impossible one at which the pose can be reached; inf where none is found.

    Between two times at which a word has exactly that length, either all or none are possible.
    """
    begin = max(time, interception(arrival.ends.x, arrival.ends.y, arrival.wx, arrival.wy) * (1.0 - ROUNDING))
    for _ in range(MOST_WINDOWS):
        crossings = [begin, *crossing_times(arrival, begin, begin + WINDOW), begin + WINDOW]
        for before, after in pairwise(crossings):
            if is_in_time(arrival, 0.5 * (before + after)):
                return before
        begin, ahead = begin + WINDOW, WINDOW
        while ahead < inf and has_no_crossing(arrival, begin, begin + ahead):
            begin, ahead = begin + ahead, 2.0 * ahead
    return inf


def last_time(arrival: Arrival, time: float) -> float:
    """The last time before an impossible one at which the pose can be reached; nan for none."""
    least = interception(arrival.ends.x, arrival.ends.y, arrival.wx, arrival.wy)
    end = time
    for _ in range(MOST_WINDOWS):
        if end <= least:
            break
        begin = max(end - WINDOW, 0.0)
        crossings = [begin, *crossing_times(arrival, begin, end), end]
        for after, before in pairwise(reversed(crossings)):
            if is_in_time(arrival, 0.5 * (before + after)):
                return after
        end, back = begin, WINDOW
        while end - back > least and has_no_crossing(arrival, end - back, end):
            end, back = end - back, 2.0 * back
    return nan


def has_no_crossing(arrival: Arrival, begin: float, end: float) -> bool:
    """Whether it is certain that no word has exactly that length, and LSR and RSL neither begin nor end, in between.

    In wind that is nearly as fast as the aircraft the length less the time of a word hardly changes for long. It is a
    convex function of the time (`falls_at`): within an interval it falls fastest where that begins.
    """
    ends, wx, wy = arrival
    for first, last in OUTER_CONTROLS:
        dx, dy = ends.x - last * ends.s + first * ends.s0, ends.y + last * ends.c - first * ends.c0
        enter, leave = time_within(dx, dy, wx, wy, 4.0 if first == last else 2.0)
        # Three arcs exist within four radii, LSR and RSL beyond two: next to these nothing is certain.
        if enter <= end and begin <= leave and (first == last or not enter < begin <= end < leave):
            return False
        is_there = first == last or end < enter or leave < begin
        fall = falls_at(arrival, first, last, begin) * (end - begin) if is_there else 0.0
        # Whole turns more are another root.
        if is_there and fall >= excess_of(arrival, first, last, begin) % TWO_PI:
            return False
    return True


def possible_times(arrival: Arrival, begin: float, end: float) -> list[tuple[float, float]]:
    """The spans of times within an interval at which the pose can be reached, in order."""
    spans: list[tuple[float, float]] = []
    while begin < end:
        until = min(begin + WINDOW, end)
        for before, after in pairwise([begin, *crossing_times(arrival, begin, until), until]):
            if after > before and is_in_time(arrival, 0.5 * (before + after)):
                joined = bool(spans) and spans[-1][1] == before
                spans[-1:] = [(spans[-1][0], after)] if joined else [*spans[-1:], (before, after)]
        begin = until
    return spans


def crossing_times(arrival: Arrival, begin: float, end: float) -> list[float]:
    """The times in an interval, in order, at which a word has exactly that length, or LSR or RSL begins or ends."""
    found: list[float] = []
    for first, last in OUTER_CONTROLS:
        found += straight_crossings(arrival, first, last, begin, end)
    for first in (1, -1):
        for halves in (0, 1):
            found += arc_crossings(arrival, first, halves, begin, end)
    return sorted(found)


def straight_crossings(arrival: Arrival, first: int, last: int, begin: float, end: float) -> list[float]:
    """Those of the word with these outer controls and a straight piece, whose length less the time falls."""
    ends, wx, wy = arrival

    def excess(time: float) -> float:
        return excess_of(arrival, first, last, time)

    within = [begin, end]
    if first != last:
        dx, dy = ends.x - last * ends.s + first * ends.s0, ends.y + last * ends.c - first * ends.c0
        within += [time for time in time_within(dx, dy, wx, wy, 2.0) if begin < time < end]
    found = sorted(within)[1:-1]
    for a, b in pairwise(sorted(within)):
        if first != last and apart_at(arrival, first, last, 0.5 * (a + b)) < 2.0:
            continue
        steps = ceil(2.0 * (b - a))
        times = [a + (b - a) * i / steps for i in range(steps + 1)]
        values = [excess(time) for time in times]
        for i in range(steps):
            if values[i] >= 0.0 > values[i + 1] > values[i] - pi:
                found.append(root_between(excess, times[i], times[i + 1]))
    return found


def excess_of(arrival: Arrival, first: int, last: int, time: float) -> float:
    """Length less time, less whole turns, of the word with these outer controls and a straight piece."""
    ends, wx, wy = arrival
    scene = WindScene(0.0, 0.0, ends.c0, ends.s0, 1.0, wx, wy, 0.0)
    x, y = ends.x - wx * time, ends.y - wy * time
    pose = SlotPose(time, time, x, y, ends.c, ends.s, 1.0, 0.0, 0.0)
    return excess_at(first, last, pose, Slot(1, 0.0), scene).value


def falls_at(arrival: Arrival, first: int, last: int, time: float) -> float:
    """How fast it falls: 1 + w . q, where q is the direction of the straight piece, which turns towards -w."""
    ends, wx, wy = arrival.at(time), arrival.wx, arrival.wy
    dx, dy = ends.x - last * ends.s + first * ends.s0, ends.y + last * ends.c - first * ends.c0
    if first == last:
        straight = length(dx, dy)
        return 1.0 + (wx * dx + wy * dy) / straight if straight > 0.0 else 2.0
    _, q1, q2 = tangent(first, dx, dy)
    return 1.0 + wx * q1 + wy * q2


def apart_at(arrival: Arrival, first: int, last: int, time: float) -> float:
    """The distance between the centres of the first and the last circle at a time."""
    c0, s0, x, y, c, s = arrival.at(time)
    return length(x - last * s + first * s0, y + last * c - first * c0)


def arc_crossings(arrival: Arrival, first: int, halves: int, begin: float, end: float) -> list[float]:
    """Those of LRL (`first` = 1) or RLR, with middle arcs half a turn apart for `halves` 0 and 1.

    They are roots of h = |d|^2 - 16 sin(m/2)^2, where m is the middle arc and h'' = 2 (w^2 - cos m).
    """
    ends, wx, wy = arrival
    dx, dy = ends.x - first * (ends.s - ends.s0), ends.y + first * (ends.c - ends.c0)
    half = pi * halves - 0.5 * angle(arc_rotation(first, ends.c0, ends.s0, ends.c, ends.s))

    def value(time: float) -> float:
        x, y, across = dx - wx * time, dy - wy * time, sin(0.5 * half + 0.25 * time)
        return x * x + y * y - 16.0 * across * across

    def slope(time: float) -> float:
        return -2.0 * (wx * (dx - wx * time) + wy * (dy - wy * time)) - 4.0 * sin(half + 0.5 * time)

    inflection = acos(wx * wx + wy * wy)
    first_turn = floor((half + 0.5 * begin) / TWO_PI)
    turns = range(first_turn - 1, first_turn + ceil(0.5 * (end - begin) / TWO_PI) + 2)
    bends = [2.0 * (m + TWO_PI * k - half) for m in (-inflection, inflection) for k in turns]
    splits = [begin, *sorted(time for time in bends if begin < time < end), end]
    for a, b in pairwise(tuple(splits)):
        if slope(a) * slope(b) < 0.0:
            splits.append(root_between(slope, a, b))
    return [
        root_between(value, a, b) for a, b in pairwise(sorted(splits)) if value(a) * value(b) <= 0.0 and value(b) != 0.0
    ]


def root_between(function: Callable[[float], float], a: float, b: float) -> float:
    """A root of a function between two places where its signs differ."""
    rises = function(a) < 0.0
    for _ in range(HALVINGS):
        middle = 0.5 * (a + b)
        if (function(middle) < 0.0) == rises:
            a = middle
        else:
            b = middle
    return b
