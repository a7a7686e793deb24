"""The first arrival in a slot: a point of the circle that moves round it with the hold (docs/slots.md).

The slot's pose is that of a vehicle which holds the circle. In the frame of the air its point moves at the speed 1
along its heading e, and the centre of its turn with the control `last` moves along e too, at the rate 1 - last h k,
where h k is the control that holds the circle. All derivatives are with respect to the angle held since the time 0, the
*width*.

- A word with a straight piece along q: length less time has the derivative -V (1 - q . e), V >= 0. It never rises, so
  that two values show whether there is a root between them.
- LRL and RLR: the middle arc m follows from the time, whatever the place, and the arrivals are the roots of a smooth
  function, |d|^2 - 8 (1 - cos m), long and short middle arcs alike. Each step is so short that a bound on the second
  derivative excludes a root within it.
"""

from math import atan2, exp, floor, inf, nan, pi, sin, sqrt
from typing import NamedTuple

from loiter.kernel.angles import TWO_PI, angle, arc_rotation, length
from loiter.kernel.entry import Entry, drop_short_pieces
from loiter.kernel.rounding import ROUNDING, rounding
from loiter.kernel.statuses import Status
from loiter.kernel.wind.fits import end_miss
from loiter.kernel.wind.held import time_held
from loiter.kernel.wind.hold import hold_pose
from loiter.kernel.wind.moving_target import (
    NO_PATH,
    Ends,
    Path,
    arc_time,
    first_of_same_turns,
    tangent,
    three_arcs,
)
from loiter.kernel.wind.paths import WindCandidate, WindScene
from loiter.kernel.wind.wind_search import WindEntry, WindProblem, entry_at, no_entry, scene_of, status_of
from loiter.kernel.words import code, encode

# Steps after which the search for one word gives up: a circle of 10,000 turn radii takes fewer.
MOST_STEPS = 100_000

# What a search for a word with a straight piece gives up with before anything is found: it is earlier than all others,
# so that these end too.
GAVE_UP = NO_PATH._replace(time=-inf)

# The ground speed changes by no more than a factor exp(GROWTH) within a step.
GROWTH = 0.5

# Next to a double root a step is at least this long, radians: there the function is within rounding of zero.
DOUBLE_ROOT = 1e-8

# The distance between the outer circles of LRL or RLR is known up to so many arc tolerances.
THREE_ARCS = 12.0

# Halvings, or better steps, that shrink a bracket to rounding.
ROOT_STEPS = 120

# Where the last arc or a straight piece vanishes at a root of the excess, it is known to the cube root of this times
# rounding: the excess of a last arc a is V a^3 / (6 k), k <= 1, and of the two words that meet there one has V >= 1.
EDGE = 1000.0

# Steps towards the slot while it is out of reach, and the time that remains when they end.
APPROACHES, NEAR = 200, 0.01

# Halvings of the angle that is held until the circle can be reached.
BEGIN_HALVINGS = 20


class Slot(NamedTuple):
    """A slot: the side on which the circle is held, and the phase (`hold`) of the slot at the time 0."""

    side: int
    phase: float


class SlotPose(NamedTuple):
    """The slot after an angle `width` of the circle: the time, and the point from the start, in the frame of the air.

    (c, s) is the heading there, `advance` the derivative of the time by the width, `turning` that of the size of the
    angle through which the heading has turned since the time 0, and `turned` this angle.
    """

    width: float
    time: float
    x: float
    y: float
    c: float
    s: float
    advance: float
    turning: float
    turned: float


class Bounds(NamedTuple):
    """Bounds within `step` of a width: on V, on its derivative and on the rate at which the heading turns."""

    step: float
    speed: float
    speed_change: float
    turning: float


class Bends(NamedTuple):
    """Bounds on the second derivative of |d|^2: it is at least -`down`, at most `up`, and no larger than `size`."""

    down: float
    up: float
    size: float


class Excess(NamedTuple):
    """Length less time of a word with a straight piece, less whole turns, in [-pi, pi], and its derivative.

    `apart` is the square of the distance of the outer circles' centres less 4, and `apart_slope` its derivative: LSR
    and RSL exist where it is not negative.
    """

    value: float
    slope: float
    apart: float
    apart_slope: float


class Middle(NamedTuple):
    """The function whose roots are the arrivals of LRL or RLR, and its derivative.

    With it the middle arc and the vector between the centres of the outer arcs.
    """

    value: float
    slope: float
    arc: float
    dx: float
    dy: float


def slot_pose(width: float, slot: Slot, scene: WindScene) -> SlotPose:
    """The slot after an angle of the circle."""
    wx, wy = scene.wx, scene.wy
    phase = slot.phase + width
    px, py, c, s, g = hold_pose(phase, slot.side, scene.R, wx, wy)
    time = time_held(phase, width, scene.R, wx, wy)
    crab = g - (wx * (c + wx) + wy * (s + wy)) / g
    turned = width - (crab_angle(phase, wx, wy) - crab_angle(slot.phase, wx, wy))
    return SlotPose(
        width, time, px - wx * time - scene.x, py - wy * time - scene.y, c, s, scene.R / g, g / crab, turned
    )


def crab_angle(phase: float, wx: float, wy: float) -> float:
    """The angle between the heading and the track of a hold at a phase, zero against the wind."""
    across = length(wx, wy) * sin(phase)
    return atan2(across, sqrt((1.0 - across) * (1.0 + across)))


def centre_speed(last: int, pose: SlotPose, slot: Slot) -> float:
    """V, the derivative of the way of the centre of the last arc."""
    return max(pose.advance + last * slot.side * pose.turning, 0.0)


def bounds_at(last: int, pose: SlotPose, slot: Slot, scene: WindScene) -> Bounds:
    """The bounds next to a width."""
    wind = length(scene.wx, scene.wy)
    twist = wind / sqrt((1.0 - wind) * (1.0 + wind))
    step, advance = 1.0, pose.advance
    if wind > 0.0:
        step, advance = min(GROWTH / twist, 1.0), advance * exp(min(GROWTH, twist))
    speed = max(advance + (1.0 + wind if last == slot.side else wind - 1.0), 0.0)
    return Bounds(step, speed, twist * (advance + 1.0), 1.0 + wind)


def begin_width(slot: Slot, scene: WindScene) -> float:
    """A width before which the slot is out of reach."""
    x, y, R, wx, wy = scene.x, scene.y, scene.R, scene.wx, scene.wy
    square = x * x + y * y - R * R
    if square <= 0.0:
        return 0.0
    # The circle is out of reach while |q + w t| > t + R.
    spare, half = (1.0 - wx * wx) - wy * wy, R - (x * wx + y * wy)
    root = sqrt(half * half + spare * square)
    time = square / (root + half) if half > 0.0 else (root - half) / spare
    if wx == 0.0 and wy == 0.0:
        return time / R
    wind = length(wx, wy)
    least, most = (1.0 - wind) * time / R, (1.0 + wind) * time / R
    for _ in range(BEGIN_HALVINGS):
        middle = 0.5 * (least + most)
        if time_held(slot.phase + middle, middle, R, wx, wy) < time:
            least = middle
        else:
            most = middle
    return least


def first_within_reach(slot: Slot, scene: WindScene) -> SlotPose:
    """The slot at a width before which it is out of reach: further away than the time."""
    pose = slot_pose(begin_width(slot, scene), slot, scene)
    for _ in range(APPROACHES):
        gap = length(pose.x, pose.y) - pose.time
        if gap <= NEAR:
            break
        limits = bounds_at(0, pose, slot, scene)
        # The distance falls at most as fast as the time grows: the slot flies at the speed 1 through the air.
        advance = limits.speed + 1.0
        pose = slot_pose(pose.width + min(0.5 * gap / advance, limits.step), slot, scene)
    return pose


def step_without_zero(value: float, slope: float, bend: float) -> float:
    """How far a function cannot come down to zero that has this value and derivative, if its second is >= -`bend`."""
    if bend <= 0.0 and slope >= 0.0:
        return inf
    return 2.0 * value / (sqrt(slope * slope + 2.0 * bend * value) - slope)


def less_whole_turns(excess: float) -> float:
    """An angle less whole turns, in [-pi, pi]."""
    return excess - TWO_PI * floor(excess / TWO_PI + 0.5)


def excess_at(u: int, last: int, pose: SlotPose, slot: Slot, scene: WindScene) -> Excess:
    """The excess of the word with the first control u, a straight piece and the control `last`."""
    c0, s0, c, s = scene.c, scene.s, pose.c, pose.s
    dx, dy = pose.x - last * s + u * s0, pose.y + last * c - u * c0
    speed = centre_speed(last, pose, slot)
    along = dx * c + dy * s
    if u == last:
        straight = length(dx, dy)
        arcs = angle(arc_rotation(u, c0, s0, c, s))
        ahead = along / straight if straight > 0.0 else 1.0
        return Excess(less_whole_turns(straight + arcs - pose.time), -speed * (1.0 - ahead), 1.0, 0.0)
    apart, apart_slope = dx * dx + dy * dy - 4.0, 2.0 * speed * along
    if apart <= -2.0:
        return Excess(nan, 0.0, apart, apart_slope)
    straight, q1, q2 = tangent(u, dx, dy)
    across1, along1 = arc_rotation(u, c0, s0, q1, q2)
    across2, along2 = arc_rotation(last, q1, q2, c, s)
    arcs = atan2(across1 * along2 + along1 * across2, along1 * along2 - across1 * across2)
    ahead = min(q1 * c + q2 * s, 1.0)
    return Excess(less_whole_turns(straight + arcs - pose.time), -speed * (1.0 - ahead), apart, apart_slope)


def bends_of_square(u: int, distance: float, limits: Bounds, scene: WindScene) -> Bends:
    """Bounds on the second derivative of |d|^2 where |d| is at most `distance`."""
    general, rise = (
        2.0 * (limits.speed * limits.turning + limits.speed_change) * distance,
        2.0 * limits.speed * limits.speed,
    )
    if limits.speed_change > 0.0:
        return Bends(general, general + rise, inf)
    # In still air the last centre moves round the circle's: the square is a constant and a cosine.
    return Bends(general, general + rise, 2.0 * limits.speed * length(scene.x - u * scene.s, scene.y + u * scene.c))


def step_of_excess(
    u: int, last: int, excess: Excess, limits: Bounds, scene: WindScene, length_tolerance: float
) -> float:
    """A step within which the excess falls by at most half a turn, and LSR and RSL neither begin nor cease to exist."""
    step = limits.step
    if limits.speed > 0.0:
        step = min(step, 0.5 * pi / limits.speed)
    if u == last:
        return step
    distance = sqrt(max(excess.apart + 4.0, 0.0)) + limits.speed * step
    bends = bends_of_square(u, distance, limits, scene)
    low, high = min(bends.down, bends.size), min(bends.up, bends.size)
    if abs(excess.apart) <= length_tolerance:
        return min(step, max(abs(excess.apart_slope) / high if high > 0.0 else step, DOUBLE_ROOT))
    if excess.apart > 0.0:
        return min(step, step_without_zero(excess.apart, excess.apart_slope, low))
    return min(step, step_without_zero(-excess.apart, -excess.apart_slope, high))


def first_with_straight(
    u: int, last: int, begin: SlotPose, slot: Slot, scene: WindScene, until: float
) -> WindCandidate:
    """The first arrival by the word with these outer controls and a straight piece; `NO_PATH` for none by `until`."""
    pose, none = begin, WindCandidate(0.0, slot.side, NO_PATH)
    length_tolerance = 4.0 * scene.arc_tolerance
    excess = excess_at(u, last, pose, slot, scene)
    if bounds_at(last, pose, slot, scene).speed <= ROUNDING:
        # The last arc is on the circle itself: the vehicle would have been in the slot before.
        return none
    if abs(excess.value) <= length_tolerance and excess.apart >= -length_tolerance:
        path = path_with_straight(u, last, pose, scene)
        if path.time < inf:
            return WindCandidate(slot.phase + pose.width, slot.side, path)
    for _ in range(MOST_STEPS):
        if pose.time > until:
            return none
        limits = bounds_at(last, pose, slot, scene)
        step = step_of_excess(u, last, excess, limits, scene, length_tolerance)
        ahead = slot_pose(pose.width + step, slot, scene)
        excess_ahead = excess_at(u, last, ahead, slot, scene)
        exists = excess.apart >= -length_tolerance and excess_ahead.apart >= -length_tolerance
        if exists and excess.value >= 0.0 > excess_ahead.value and excess.value - excess_ahead.value <= pi + 1.0:
            found = arrival_at_root(u, last, pose, ahead, slot, scene, length_tolerance)
            if found.path.time < inf:
                return found
        pose, excess = ahead, excess_ahead
    return WindCandidate(0.0, slot.side, GAVE_UP if until == inf else NO_PATH)


def arrival_at_root(
    u: int, last: int, a: SlotPose, b: SlotPose, slot: Slot, scene: WindScene, length_tolerance: float
) -> WindCandidate:
    """The arrival at the root of the excess between two poses; `NO_PATH` where an arc falls short of zero there.

    Where words meet in a path without this arc, rounding must not make it fall short in all of them.
    """
    root = root_of_excess(u, last, a, b, slot, scene, 0.0)
    pieces = pieces_with_straight(u, last, root, scene)
    path = with_turns(pieces, root)
    if path.time < inf:
        return WindCandidate(slot.phase + root.width, slot.side, path)
    short = min(TWO_PI - max(pieces.t1, pieces.t3), pieces.t2)
    if short * short * short > EDGE * length_tolerance:
        return WindCandidate(0.0, slot.side, NO_PATH)
    # All poses between these two are roots up to rounding.
    for level in (length_tolerance, -length_tolerance):
        end = root_of_excess(u, last, a, b, slot, scene, level)
        if path_with_straight(u, last, end, scene).time < inf:
            return arrival_at_edge(u, last, end, root, slot, scene)
    return WindCandidate(0.0, slot.side, NO_PATH)


def arrival_at_edge(
    u: int, last: int, inside: SlotPose, outside: SlotPose, slot: Slot, scene: WindScene
) -> WindCandidate:
    """The arrival where a word ceases to exist, between a pose to which it has a path and one to which it has none.

    An arc vanishes there, so that two words meet.
    """
    width, path, beyond = inside.width, path_with_straight(u, last, inside, scene), outside.width
    for _ in range(ROOT_STEPS):
        middle = 0.5 * (width + beyond)
        if middle in (width, beyond):
            break
        nearer = path_with_straight(u, last, slot_pose(middle, slot, scene), scene)
        if nearer.time < inf:
            width, path = middle, nearer
        else:
            beyond = middle
    return WindCandidate(slot.phase + width, slot.side, path)


def root_of_excess(u: int, last: int, a: SlotPose, b: SlotPose, slot: Slot, scene: WindScene, level: float) -> SlotPose:
    """The slot where the excess has a value, between a pose where it is not less and one where it is."""
    least, most = a.width, b.width
    width, best, best_value = 0.5 * (least + most), a, inf
    for i in range(ROOT_STEPS):
        pose = slot_pose(width, slot, scene)
        excess = excess_at(u, last, pose, slot, scene)
        value = excess.value - level
        if abs(value) < best_value:
            best, best_value = pose, abs(value)
        if value >= 0.0:
            least = width
        else:
            most = width
        newton = width - value / excess.slope if excess.slope < 0.0 else least
        # Every third step bisects, since Newton's method is slow at a triple root.
        is_newton = i % 3 != 2 and least < newton < most
        following = newton if is_newton else 0.5 * (least + most)
        if value == 0.0 or following in (width, least, most):
            break
        width = following
    return best


def path_with_straight(u: int, last: int, pose: SlotPose, scene: WindScene) -> Path:
    """The path of a word with a straight piece to the slot, with as many whole turns first as the time leaves."""
    return with_turns(pieces_with_straight(u, last, pose, scene), pose)


def pieces_with_straight(u: int, last: int, pose: SlotPose, scene: WindScene) -> Path:
    """The shortest path of a word with a straight piece to the slot."""
    c0, s0, c, s = scene.c, scene.s, pose.c, pose.s
    dx, dy = pose.x - last * s + u * s0, pose.y + last * c - u * c0
    if u == last:
        straight = length(dx, dy)
        q1, q2 = (dx / straight, dy / straight) if straight > 0.0 else (c0, s0)
    else:
        straight, q1, q2 = tangent(u, dx, dy)
    first = arc_time(arc_rotation(u, c0, s0, q1, q2), 1.0 + straight, scene.arc_tolerance)
    third = arc_time(arc_rotation(last, q1, q2, c, s), 1.0, scene.arc_tolerance)
    if u == last:
        arcs = arc_time(arc_rotation(u, c0, s0, c, s), 1.0, scene.arc_tolerance)
        if first + third > arcs + pi:
            first = first_of_same_turns(first, arcs, straight, scene.arc_tolerance)
            third = arcs - first if first <= arcs else third
    return Path(first + straight + third, encode(u, 0, last), first, straight, third, 1.0, q1, q2)


def with_turns(path: Path, pose: SlotPose) -> Path:
    """The path with whole turns added to its first arc, so that it takes the time of the slot; `NO_PATH` if longer."""
    turns = floor((pose.time - path.time) / TWO_PI + 0.5)
    if turns < 0.0:
        return NO_PATH
    return path._replace(time=path.time + TWO_PI * turns, t1=path.t1 + TWO_PI * turns)


def middle_at(u: int, half: float, pose: SlotPose, slot: Slot, scene: WindScene) -> Middle:
    """The function for LRL (u = +1) or RLR: `half`, plus half the time less the heading's turn, is the middle arc."""
    dx, dy = pose.x - u * (pose.s - scene.s), pose.y + u * (pose.c - scene.c)
    arc = half + 0.5 * (pose.time + u * slot.side * pose.turned)
    across = sin(0.5 * arc)
    value = dx * dx + dy * dy - 16.0 * across * across
    slope = centre_speed(u, pose, slot) * (2.0 * (dx * pose.c + dy * pose.s) - 4.0 * sin(arc))
    return Middle(value, slope, arc - TWO_PI * floor(arc / TWO_PI), dx, dy)


def first_of_three_arcs(
    u: int, halves: int, begin: SlotPose, slot: Slot, scene: WindScene, until: float
) -> WindCandidate:
    """The first arrival by LRL (u = +1) or RLR; `halves` 0 or 1 chooses between middle arcs half a turn apart."""
    none = WindCandidate(0.0, slot.side, NO_PATH)
    if bounds_at(u, begin, slot, scene).speed <= ROUNDING:
        return none
    origin, pose, length_tolerance = slot_pose(0.0, slot, scene), begin, THREE_ARCS * scene.arc_tolerance
    half = pi * halves - 0.5 * angle(arc_rotation(u, scene.c, scene.s, origin.c, origin.s))
    for _ in range(MOST_STEPS):
        if pose.time > until:
            return none
        middle = middle_at(u, half, pose, slot, scene)
        distance = length(middle.dx, middle.dy)
        limits = bounds_at(u, pose, slot, scene)
        limit = min(limits.step, 1.0 / limits.speed) if limits.speed > 0.0 else limits.step
        furthest = distance + limits.speed * limit
        bends, square = bends_of_square(u, furthest, limits, scene), 2.0 * limits.speed * limits.speed
        # To h'' the middle arc adds -2 V^2 cos(m) - 4 V' sin(m). |d|^2 adds 2 V^2 to its own, which `down` leaves out.
        low = min(bends.down + 4.0 * limits.speed_change, bends.size + square)
        high = min(bends.up + square + 4.0 * limits.speed_change, bends.size + square)
        spread = distance + 4.0 * sin(0.5 * middle.arc)
        if abs(middle.value) <= length_tolerance * (spread + length_tolerance):
            path = path_of_three_arcs(u, middle, pose, scene)
            if path.time < inf:
                return WindCandidate(slot.phase + pose.width, slot.side, path)
            step = max(abs(middle.slope) / high, DOUBLE_ROOT)
        elif middle.value > 0.0:
            step = step_without_zero(middle.value, middle.slope, low)
            if distance - 4.0 > limits.speed * limit:
                step, limit = max(step, (distance - 4.0) / limits.speed), limits.step
        else:
            step = step_without_zero(-middle.value, -middle.slope, high)
        pose = slot_pose(pose.width + min(step, limit), slot, scene)
    return none


def path_of_three_arcs(u: int, middle: Middle, pose: SlotPose, scene: WindScene) -> Path:
    """The path of LRL or RLR to the slot, with as many whole turns first as the time leaves."""
    ends = Ends(scene.c, scene.s, pose.c, pose.s, scene.wx, scene.wy, scene.arc_tolerance)
    path = with_turns(three_arcs(u, middle.arc, middle.dx, middle.dy, ends), pose)
    if path.time < inf:
        return path
    # An arc may fall short of zero by as much as counts as a root.
    ends = ends._replace(arc_tolerance=THREE_ARCS * scene.arc_tolerance)
    return with_turns(three_arcs(u, middle.arc, middle.dx, middle.dy, ends), pose)


def first_arrival(slot: Slot, scene: WindScene) -> WindCandidate:
    """The first arrival in a slot, the best of all words."""
    begin = first_within_reach(slot, scene)
    best = WindCandidate(slot.phase, slot.side, NO_PATH)
    # LSL or RSR that ends against the hold exists at all times and arrives within a turn or so; next to R = 1 others
    # may take forever.
    for last in (slot.side, -slot.side):
        for u in (last, -last):
            best = earlier(best, first_with_straight(u, last, begin, slot, scene, best.path.time))
    for u in (1, -1):
        for halves in (0, 1):
            best = earlier(best, first_of_three_arcs(u, halves, begin, slot, scene, best.path.time))
    return best


def earlier(a: WindCandidate, b: WindCandidate) -> WindCandidate:
    """The path that takes less time: a where they tie."""
    return b if b.path.time < a.path.time else a


def arrival_of(found: WindCandidate, scene: WindScene) -> WindEntry:
    """An arrival as the maneuver flown, with its status."""
    path, side = found.path, found.side
    word, t1, t2, t3 = drop_short_pieces(
        path.word, path.t1, path.t2, path.t3, rounding(scene.x, scene.y, scene.R), ROUNDING
    )
    entry = Entry(side, word, t1, t2, t3)
    miss = end_miss(entry, found.phase, scene)
    return entry_at(entry, found.phase, miss, scene)


def first_in_slot(problem: WindProblem, phase: float) -> WindEntry:
    """The first arrival in the slot that is at a phase at the time 0; nan, with a status, where there is none.

    The side of the problem must be 1 or -1. The slot is entered exactly.
    """
    status = status_of(problem)
    if status != Status.OK:
        return no_entry(status)
    scene, slot = scene_of(problem), Slot(problem.side, phase)
    nothing = Entry(slot.side, 0, 0.0, 0.0, 0.0)
    miss = end_miss(nothing, phase, scene)
    if miss <= 3.0 * scene.arc_tolerance:
        return entry_at(nothing, phase, miss, scene)
    found = first_arrival(slot, scene)
    if abs(found.path.time) == inf:
        return no_entry(code(Status.NOT_CONVERGED))
    return arrival_of(found, scene)
