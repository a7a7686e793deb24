"""The fastest way onto a circle that the air drifts past: constant wind, or a circle that moves (docs/wind.md).

All is relative to the circle: the vehicle is at (x, y) from its centre, heads along (c, s) and moves with (c, s) + w.
R is the circle's radius; R >= (1 + |w|)^2 lets the vehicle hold it all round. Azimuths along the circle are counted
in the direction of the hold from where it heads against the wind, so that both sides are one case.
"""

from math import atan2, cos, hypot, inf, isfinite, pi, sin, sqrt

from loiter.kernel.angles import TWO_PI
from loiter.kernel.codes import Side, Status
from loiter.kernel.intercept import NO_WAY, Ends, Way, alike, alternating, interception, opposite
from loiter.kernel.motion import fly
from loiter.kernel.synthesis import REACH, ROUNDING, flown, rounding

# Start, heading, radius, wind, slack: x, y, c, s, R, wx, wy, slack.
Scene = tuple[float, float, float, float, float, float, float, float]

# A point of joining: position, heading, ground speed.
Join = tuple[float, float, float, float, float]

# What is found: azimuth, side, way.
Found = tuple[float, int, Way]

# The maneuver: side held, word, three durations, angle of the point of joining as seen from the centre, and by how much
# the maneuver misses it when flown.
Joined = tuple[int, int, float, float, float, float, float]

# Points of joining tried at first, all round.
JOINS = 32

# The search ends when nothing can be faster than its answer by more than this share of R.
PROVEN = 1.0 / 1024.0

# A bisection of doubles is done after 53 steps and some; every other step bisects.
SETTLING_STEPS = 120

# Where two arcs are the fastest, what is found between, before or after them is the root of its rounding, some 1e-5 long.
SHORT = 1e-3

# Newton's method squares an error of 1e-3 to rounding in four steps.
ARC_STEPS = 8

SAME = 10.0


def tightest_held(wx: float, wy: float) -> float:
    """The least R that can be held: th' = g^2/(R c) <= 1 is hardest downwind, where g = 1 + |w|, c = 1."""
    return (1.0 + hypot(wx, wy)) ** 2


def status_of(x: float, y: float, R: float, wx: float, wy: float) -> Status:
    """`Status.OK`, or why there is nothing to solve."""
    if not (isfinite(x) and isfinite(y) and isfinite(R) and isfinite(wx) and isfinite(wy)):
        return Status.NOT_FINITE
    if hypot(wx, wy) >= 1.0:
        return Status.WIND_TOO_STRONG
    if R < tightest_held(wx, wy) * (1.0 - ROUNDING):
        return Status.RADIUS_TOO_SMALL
    if abs(x) > REACH or abs(y) > REACH or R > REACH:
        return Status.OUT_OF_RANGE
    return Status.OK


def join(azimuth: float, side: int, scene: Scene) -> Join:
    """Where and how the circle is joined: heading and wind add up to a velocity along the circle."""
    _, _, _, _, R, wx, wy, _ = scene
    wind = hypot(wx, wy)
    dx, dy = (wx / wind, wy / wind) if wind > 0.0 else (1.0, 0.0)
    # The direction of the hold turns left for side -1; at azimuth 0 it is against the wind.
    a, b = -cos(azimuth), side * sin(azimuth)
    tx, ty = a * dx - b * dy, a * dy + b * dx
    nx, ny = -side * ty, side * tx
    out = wx * nx + wy * ny
    c = sqrt((1.0 - out) * (1.0 + out))
    return R * nx, R * ny, c * tx - out * nx, c * ty - out * ny, c + wx * tx + wy * ty


def way_to(azimuth: float, side: int, scene: Scene, until: float) -> Way:
    """The first way to a point of joining, where it takes no longer than `until`: the best of the six words."""
    x, y, c0, s0, _, wx, wy, slack = scene
    px, py, c, s, _ = join(azimuth, side, scene)
    dx, dy = px - x, py - y
    if interception(dx, dy, wx, wy) > until + slack:
        return NO_WAY
    ends = (c0, s0, c, s, wx, wy, slack)
    best = NO_WAY
    for u in (1, -1):
        across, along = dx - u * (s - s0), dy + u * (c - c0)
        best = sooner(best, alike(u, across, along, ends), until)
        best = sooner(best, alternating(u, across, along, ends, min(until, best[0])), until)
        across, along = dx + u * (s + s0), dy - u * (c + c0)
        best = sooner(best, opposite(u, across, along, ends, min(until, best[0])), until)
    return best


def sooner(a: Way, b: Way, until: float) -> Way:
    """The sooner of two ways, the first where they tie or the second comes too late."""
    return b if b[0] < a[0] and b[0] <= until else a


def hold_rate(azimuth: float, side: int, scene: Scene) -> float:
    """The size of the rate of turn that holds the circle at an azimuth: g^2/(R c), (3) of docs/wind.md."""
    _, _, _, _, R, wx, wy, _ = scene
    _, _, c, s, g = join(azimuth, side, scene)
    # The cosine of the crab angle, the ground speed less the wind along it.
    return g * g / (R * (g - (wx * (c + wx) + wy * (s + wy)) / g))


def slope(way: Way, azimuth: float, side: int, scene: Scene) -> float:
    """By how much the way takes longer if the circle is joined later by a unit of the time that the hold takes.

    It vanishes where the adjoint is transversal to the circle, (5) of docs/wind.md, and is at most 1.
    """
    _, _, _, _, _, wx, wy, _ = scene
    _, _, c, s, _ = join(azimuth, side, scene)
    _, word, _, _, _, lam, p1, p2 = way
    along, drift = p1 * c + p2 * s, p1 * wx + p2 * wy
    rate = side * ((word >> 4) - 2) * hold_rate(azimuth, side, scene)
    return (along + drift - rate * (lam - along)) / (lam + drift)


def held_for(azimuth: float, width: float, side: int, scene: Scene) -> float:
    """A bound on the time that the hold takes from `azimuth` - `width`, not before the headwind, to `azimuth`.

    The ground speed rises from the headwind to the tailwind and falls again: it is least at an end.
    """
    return scene[4] * width / min(join(azimuth - width, side, scene)[4], join(azimuth, side, scene)[4])


def settled(found: Found, width: float, scene: Scene) -> Found:
    """The least time next to what is found, where the slope changes its sign or the time jumps.

    Between the best so far and `other`, towards which the time falls from it, there is a local minimum.
    """
    here, side, way = found
    _, _, _, _, _, _, _, slack = scene
    rise = slope(way, here, side, scene)
    other, other_word, other_rise = here + (width if rise < 0.0 else -width), 0, 0.0
    for step in range(SETTLING_STEPS):
        middle = 0.5 * (here + other)
        if step & 1 and other_word == way[1] and rise * other_rise < 0.0:
            middle = here + (other - here) * (rise / (rise - other_rise))
        if middle in (here, other) or rise == 0.0:
            break
        tried = way_to(middle, side, scene, way[0] + width * scene[4])
        tried_rise = slope(tried, middle, side, scene) if tried[0] < inf else 0.0
        if tried[0] > way[0] + slack:
            other, other_word, other_rise = middle, tried[1], tried_rise
        else:
            if rise * tried_rise < 0.0:
                other, other_word, other_rise = here, way[1], rise
            here, way, rise = middle, tried, tried_rise
    return here, side, way


def probed(azimuth: float, width: float, side: int, scene: Scene, best: Found) -> tuple[float, Found]:
    """A lower bound on the time into the cell of a width that ends at an azimuth, and the better of `best` and its end.

    Whoever joins within the cell can follow the circle to its end: no way into it is sooner than the first way to its
    end, less the time that the hold takes through it.
    """
    within = held_for(azimuth, width, side, scene)
    way = way_to(azimuth, side, scene, best[2][0] + within)
    return way[0], (azimuth, side, way) if way[0] < best[2][0] else best


def searched(side: int, scene: Scene, best: Found) -> Found:
    """The better of `best` and the fastest way onto the circle held on one side, by branch and bound."""
    width, allowed = TWO_PI / JOINS, PROVEN * scene[4]
    cells = [(inf, 0.0)]
    cells.pop()
    before = best[2][0]
    for i in range(JOINS):
        time, best = probed(width * (i + 1.0), width, side, scene, best)
        cells.append((width * (i + 1.0), time))
    while len(cells) > 0:
        if best[2][0] < before:
            best = settled(best, width, scene)
            before = best[2][0]
        halves = [(inf, 0.0)]
        halves.pop()
        for end, time in cells:
            within = held_for(end, width, side, scene)
            if time - within < before and within > allowed:
                halves.append((end, time))
                time, best = probed(end - 0.5 * width, 0.5 * width, side, scene, best)
                halves.append((end - 0.5 * width, time))
        cells, width = halves, 0.5 * width
    return best


def letters(word: int) -> tuple[int, int, int]:
    """The controls of a word of three letters."""
    return (word & 3) - 2, (word >> 2 & 3) - 2, (word >> 4) - 2


def vanishing(way: Way) -> tuple[int, int, float, float]:
    """The two arcs that remain of a word of which one piece is `SHORT`, and their durations; controls 0 for none."""
    _, word, t1, t2, t3, _, _, _ = way
    first, middle, last = letters(word)
    if middle == 0:
        return (first, last, t1, t3) if t2 <= SHORT and first != last else (0, 0, 0.0, 0.0)
    if t1 <= SHORT:
        return middle, last, t2, t3
    return (first, middle, t1, t2) if t3 <= SHORT else (0, 0, 0.0, 0.0)


def two_arcs(
    first: int, second: int, t1: float, t2: float, azimuth: float, side: int, scene: Scene
) -> tuple[float, float, float]:
    """Newton's method for two arcs that meet the circle: their durations, and the azimuth.

    Joining later by s along the hold and flying the second arc for s longer moves both ends alike, if the headings are:
    so the position fixes t1 and t2 - s, and the heading s.
    """
    x, y, c, s, R, wx, wy, slack = scene
    for _ in range(ARC_STEPS):
        x1, y1, c1, s1 = fly(x, y, c, s, first, t1)
        x2, y2, c2, s2 = fly(x1, y1, c1, s1, second, t2)
        px, py, ce, se, g = join(azimuth, side, scene)
        rx, ry = px - x2 - wx * (t1 + t2), py - y2 - wy * (t1 + t2)
        # The end's velocity by t1, with the second arc turning about its start, and by t2.
        ax, ay = c1 + wx - first * (y2 - y1), s1 + wy + first * (x2 - x1)
        bx, by = c2 + wx, s2 + wy
        across, bend = ax * by - ay * bx, second + side * hold_rate(azimuth, side, scene)
        if across == 0.0 or bend == 0.0:
            break
        d1, d2 = (rx * by - ry * bx) / across, (ax * ry - ay * rx) / across
        later = (atan2(c2 * se - s2 * ce, c2 * ce + s2 * se) - first * d1 - second * d2) / bend
        t1, t2, azimuth = t1 + d1, t2 + d2 + later, azimuth + later * g / R
        if abs(d1) + abs(d2) + abs(later) <= slack:
            break
    return t1, t2, azimuth


def exact(found: Found, scene: Scene) -> tuple[int, float, float, float, float]:
    """Word, durations and azimuth of what is found; two arcs, where it is they to `SHORT` and they are no slower."""
    azimuth, side, way = found
    first, second, t1, t2 = vanishing(way)
    if first != 0:
        t1, t2, there = two_arcs(first, second, t1, t2, azimuth, side, scene)
        error = scene[7] + missed(way[1], way[2], way[3], way[4], azimuth, side, scene)
        if min(t1, t2) >= 0.0 and t1 + t2 <= way[0] + SAME * error:
            return 10 + first + 4 * second, t1, t2, 0.0, there
    return way[1], way[2], way[3], way[4], azimuth


def held_already(side: int, scene: Scene) -> bool:
    """Whether the vehicle is on the circle and flies along it, up to rounding."""
    return False


def missed(word: int, t1: float, t2: float, t3: float, azimuth: float, side: int, scene: Scene) -> float:
    """By how much the end of a maneuver misses the point of joining when flown: in position and, times 1, in heading."""
    x, y, c, s, _, wx, wy, _ = scene
    for t in (t1, t2, t3):
        if word:
            x, y, c, s = fly(x, y, c, s, (word & 3) - 2, t)
            x, y, word = x + wx * t, y + wy * t, word >> 2
    px, py, ce, se, _ = join(azimuth, side, scene)
    return hypot(hypot(px - x, py - y), hypot(ce - c, se - s))


def fastest(x: float, y: float, c: float, s: float, R: float, side: int, wx: float, wy: float) -> Joined:
    """The fastest maneuver onto the circle; call it where `status_of` is OK."""
    dust = rounding(x, y, R)
    scene = (x, y, c, s, R, wx, wy, dust / 3.0)
    best = (0.0, 0, NO_WAY)
    for one in (1, -1):
        if side != -one:
            best = searched(one, scene, best)
    held = best[1]
    word, t1, t2, t3, azimuth = exact(best, scene)
    word, t1, t2, t3 = flown(word, t1, t2, t3, dust)
    px, py, _, _, _ = join(azimuth, held, scene)
    return held, word, t1, t2, t3, atan2(py, px), missed(word, t1, t2, t3, azimuth, held, scene)
