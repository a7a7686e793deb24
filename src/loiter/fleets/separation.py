"""The least distances of aircraft over time, by branch and bound: statements about whole paths, not about samples.

Aircraft of one kind fly in the same air, so two of them approach one another at most at the sum of their airspeeds,
2 V, and their distance vector has an acceleration of at most 2 V^2/r: each turns with the radius r at least, on its
path and round the circle. Between the times a and b that vector differs from its chord, run through at constant speed,
by no more than 2 V^2/r (b - a)^2 / 8 (`loiter.fences.search`), and the least distance of a chord has a closed form.
Parts whose bound is above what is known are dropped, the others are split.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from math import ceil
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy import float64
from numpy.typing import NDArray

from loiter.errors import OutOfRange
from loiter.planning.model import Aircraft

# A search begins with so many parts while an aircraft flies a turn radius. Bounds of turns are within 1/400 of the
# radius of the chords then, and each split divides that by SPLIT^2.
PARTS_PER_RADIUS, SPLIT, MOST_LEVELS = 10, 12, 16

# The longest flights whose distances are searched, turn radii: a hundred aircraft need 1.6 GB of memory then.
MOST_RADII = 1e5

# A least distance is known to this share of the turn radius, a twentieth of a millimetre of 50 m: two splits reach it
# where a distance stays the same.
RESOLUTION = 1e-6

# The places of an aircraft at times, seconds: east + 1j north, metres.
Track: TypeAlias = Callable[[NDArray[float64]], Any]


class Least(NamedTuple):
    """No more than the least distance, metres, by `RESOLUTION` at most, and when about that is attained, seconds."""

    distance_m: float
    time_s: float


def least_distances(
    tracks: Sequence[Track], until_s: NDArray[float64], aircraft: Aircraft, wanted_m: float
) -> tuple[NDArray[float64], NDArray[float64]]:
    """No more than the least distances of all pairs, metres, `inf` to itself, and when they are attained, seconds.

    They are those from the time 0 to the later one of two times `until_s`, lower by up to `RESOLUTION` turn radii. A
    pair that neither is closer than `wanted_m` nor the closest to one of the two may have any larger distance.
    """
    least, when_s = sampled_distances(tracks, until_s, aircraft)
    nearest = least.min(axis=1)
    # Between two samples a distance falls by half of what two aircraft can approach one another meanwhile.
    below = least - aircraft.turn_radius_m / PARTS_PER_RADIUS
    for i, j in np.argwhere(np.triu(below < np.maximum(wanted_m, np.maximum(nearest[:, None], nearest)), 1)):
        found = least_distance(_apart(tracks[i], tracks[j]), max(until_s[i], until_s[j]), aircraft)
        least[i, j] = least[j, i] = found.distance_m
        when_s[i, j] = when_s[j, i] = found.time_s
    return least, when_s


def sampled_distances(
    tracks: Sequence[Track], until_s: NDArray[float64], aircraft: Aircraft
) -> tuple[NDArray[float64], NDArray[float64]]:
    """The least distances of all pairs at sampled times, metres, `inf` to itself, and when, seconds."""
    times_s = sample_times(until_s.max(), aircraft)
    places = np.array([track(times_s) for track in tracks])
    least, when_s = np.full((len(places), len(places)), np.inf), np.zeros((len(places), len(places)))
    for i, place in enumerate(places):
        distances = np.abs(places - place)
        least[i], when_s[i] = distances.min(axis=1), times_s[distances.argmin(axis=1)]
        least[i, i] = np.inf
    return least, when_s


def sample_times(until_s: float, aircraft: Aircraft) -> NDArray[float64]:
    """Times from 0 to `until_s` at which a search begins, seconds."""
    radii = until_s * aircraft.airspeed_m_s / aircraft.turn_radius_m
    if radii > MOST_RADII:
        raise OutOfRange(f"the flights are {radii:g} turn radii long: distances are found along {MOST_RADII:g} at most")
    return np.linspace(0.0, until_s, ceil(radii * PARTS_PER_RADIUS) + 1)


def least_distance(apart: Track, until_s: float, aircraft: Aircraft) -> Least:
    """The least length of a distance vector from the time 0 to `until_s`."""
    acceleration = 2.0 * aircraft.airspeed_m_s**2 / aircraft.turn_radius_m
    times = sample_times(until_s, aircraft)[None]
    best, below_m, drop_m = Least(np.inf, 0.0), np.inf, RESOLUTION * aircraft.turn_radius_m
    for level in range(MOST_LEVELS):
        places = apart(times.ravel()).reshape(times.shape)
        best = _closer(best, times, places)
        a, b = times[:, :-1].ravel(), times[:, 1:].ravel()
        at_s, chord_m = _nearest(a, b, places[:, :-1].ravel(), places[:, 1:].ravel())
        lower_m = chord_m - acceleration * (b - a) ** 2 / 8.0
        best = _closer(best, at_s, apart(at_s))
        split = (lower_m < best.distance_m - drop_m) & (level < MOST_LEVELS - 1)
        below_m = min(below_m, float(lower_m[~split].min(initial=np.inf)))
        if not split.any():
            break
        times = a[split, None] + np.arange(SPLIT + 1) / SPLIT * (b - a)[split, None]
    return Least(max(min(below_m, best.distance_m), 0.0), best.time_s)


def _apart(one: Track, other: Track) -> Track:
    return lambda times_s: other(times_s) - one(times_s)


def _closer(best: Least, times_s: NDArray[float64], apart: Any) -> Least:
    """The least of a known distance and those at some times."""
    distances = np.abs(apart)
    i = int(distances.argmin())
    return min(best, Least(float(distances.ravel()[i]), float(times_s.ravel()[i])))


def _nearest(
    a: NDArray[float64], b: NDArray[float64], start: Any, end: Any
) -> tuple[NDArray[float64], NDArray[float64]]:
    """When chords are nearest to the origin, and how near."""
    chord = end - start
    with np.errstate(invalid="ignore", divide="ignore"):
        share = np.clip(np.nan_to_num(-(start * chord.conjugate()).real / np.abs(chord) ** 2), 0.0, 1.0)
    return a + share * (b - a), np.abs(start + share * chord)
