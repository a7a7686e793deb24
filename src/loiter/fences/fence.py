"""Fences, and whether a maneuver or a leg stays clear of one, and otherwise where and when it enters which zone."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

from loiter.errors import InvalidArgument, instance, not_negative
from loiter.fences.model import CircleZone, Zone, Zones
from loiter.fences.pieces import FlownPath, flown_path, time_in_hold
from loiter.fences.search import TOUCH_M, PlaceInPath, approach, first_entry, least_distance
from loiter.geo.frame import LocalFrame, degrees_of
from loiter.planning.leg import LegPlan
from loiter.planning.maneuver import Maneuver, decimals_of
from loiter.planning.model import Orbit, Pose

# What `loiter guide` may be beside its path while it counts as on it (docs/autopilots.md): 5 % of the radius, and 5 m
# at least. This is the default margin.
MARGIN_SHARE, LEAST_MARGIN_M = 0.05, 5.0


def default_margin_m(orbit: Orbit) -> float:
    """The default margin for a circle, metres: how far beside its path a vehicle may be that `loiter guide` flies."""
    instance("orbit", orbit, Orbit)
    return max(LEAST_MARGIN_M, MARGIN_SHARE * orbit.radius_m)


def checked_margin_m(orbit: Orbit, margin_m: float | None) -> float:
    """The margin, metres: the default where it is absent; raises `InvalidArgument` for one that is negative."""
    return default_margin_m(orbit) if margin_m is None else not_negative("margin_m", margin_m, "metres")


class Breach(NamedTuple):
    """A zone that a path enters, or to which it comes closer than the margin.

    `clearance_m` is the least distance from the zone, metres; where the path `enters` the zone it is how deep it goes,
    negative. The place (metres) and the time (seconds) are those of the first entry, or of the closest approach where
    only the margin is not kept. `holding` says whether that is on the circle, after joining.
    """

    zone: Zone
    clearance_m: float
    east_m: float
    north_m: float
    time_s: float
    holding: bool

    @property
    def enters(self) -> bool:
        """Whether the path enters or touches the zone itself."""
        return self.clearance_m <= TOUCH_M


class FenceCheck(NamedTuple):
    """The answer of `Fence.check`: the margin, the least clearance and its zone, place and time, and every breach.

    Metres and seconds; `clearance_m` is negative inside a zone. Breaches are in the order of their times.
    """

    margin_m: float
    closest: Breach
    breaches: tuple[Breach, ...]
    decimals: int = 1

    @property
    def clear(self) -> bool:
        """Whether the path and the hold stay farther from every zone than the margin."""
        return not self.breaches

    @property
    def clearance_m(self) -> float:
        """The least distance from any zone, metres; negative where one is entered."""
        return self.closest.clearance_m

    def sentence(self, frame: LocalFrame | None = None) -> str:
        """The answer in a sentence; with a frame places are in degrees."""
        return _clear_sentence(self, frame) if self.clear else _breach_sentence(self, frame)

    def to_dict(self, frame: LocalFrame | None = None) -> dict[str, object]:
        """The answer as plain values for JSON; with a frame its places have latitude and longitude too."""
        return {
            "clear": self.clear,
            "margin_m": self.margin_m,
            "closest": _values(self.closest, frame),
            "breaches": [_values(breach, frame) for breach in self.breaches],
        }


@dataclass(frozen=True)
class Fence(Zones):
    """Zones in local metres: the aircraft must be inside every inclusion zone and outside every other one.

    That is the rule of PX4 since version 1.15, and of ArduPilot unless its FENCE_OPTIONS unite the inclusion zones.
    Raises `InvalidArgument` for a fence without zones, and for inclusion zones that have no common point.

    >>> from loiter import Aircraft, Orbit, Pose, plan
    >>> from loiter.fences import CircleZone, Fence
    >>> m = plan(Pose(-400.0, 120.0, 90.0), Orbit(0.0, 0.0, 80.0), Aircraft(18.0, max_bank_deg=35.0))
    >>> print(Fence((CircleZone("mast", -150.0, 90.0, 60.0),)).check(m, margin_m=0.0).sentence())
    The plan enters the zone 'mast' in 11.4 s, at 203 m west, 62 m north, by up to 17.7 m.
    """

    def check(self, maneuver: Maneuver | LegPlan, margin_m: float | None = None) -> FenceCheck:
        """Whether a maneuver or a leg, and its hold, stay farther from every zone than a margin: `fences.check`."""
        flown, maneuver = maneuver, maneuver.entry if isinstance(maneuver, LegPlan) else maneuver
        instance("maneuver", maneuver, Maneuver)
        margin_m = (
            default_margin_m(maneuver.orbit) if margin_m is None else not_negative("margin_m", margin_m, "metres")
        )
        path = flown_path(flown)
        _check_start(self, maneuver.start)
        approaches: list[tuple[Zone, PlaceInPath]] = []
        for zones, closest in zip(_by_kind(self), approach(self, path.pieces, margin_m), strict=True):
            places = zip(closest.distance.tolist(), closest.piece.tolist(), closest.time_s.tolist(), strict=True)
            approaches += [(zone, PlaceInPath(*place)) for zone, place in zip(zones, places, strict=True)]
        zone, nearest = min(approaches, key=lambda each: each[1].distance)
        breaches = [
            _breach(zone, near, path, maneuver) for zone, near in approaches if near.distance <= margin_m + TOUCH_M
        ]
        ordered = tuple(sorted(breaches, key=lambda breach: breach.time_s))
        least = min(ordered, key=lambda breach: breach.clearance_m, default=None)
        closest_one = least or _at(zone, nearest.distance, nearest, path, maneuver)
        return FenceCheck(margin_m, closest_one, ordered, decimals_of(maneuver.orbit))


def check(fence: Fence, maneuver: Maneuver | LegPlan, margin_m: float | None = None) -> FenceCheck:
    """Whether a maneuver and its hold stay farther from every zone of a fence than a margin, metres.

    Of a leg the way out is checked too. The margin is that of `default_margin_m` if it is absent. What comes within a
    micrometre of the margin does not keep it. A circle that moves is checked as a disc, for the longest that one round
    can take. Raises `InvalidArgument` for a margin that is negative or not finite, and for a start outside an inclusion
    zone or inside another one.
    """
    instance("fence", fence, Fence)
    return fence.check(maneuver, margin_m)


def zones_on_circle(fence: Zones, maneuver: Maneuver, margin_m: float) -> tuple[str, ...]:
    """The names of the zones to which the circle of a hold, wherever it is joined, is closer than a margin."""
    path = flown_path(maneuver)
    hold = path.pieces.take([path.hold])
    sides = fence.signed_distances(float(hold.x[0]), float(hold.y[0]))
    names = []
    for zones, closest, side in zip(_by_kind(fence), approach(fence, hold, margin_m), sides, strict=True):
        near = (closest.distance <= margin_m + TOUCH_M) | (side < 0.0)
        names += [zone.name for zone, is_near in zip(zones, near, strict=True) if is_near]
    return tuple(names)


def _check_start(fence: Zones, start: Pose) -> None:
    """Raise `InvalidArgument` for a start on the wrong side of a zone; one that touches it is a breach."""
    for zones, distances in zip(_by_kind(fence), fence.signed_distances(start.east_m, start.north_m), strict=True):
        for zone, distance_m in zip(zones, distances.tolist(), strict=True):
            if distance_m < -TOUCH_M:
                raise InvalidArgument("pose", _wrong_side(zone))


def _by_kind(fence: Zones) -> tuple[Sequence[Zone], Sequence[Zone]]:
    """The polygons and the circles."""
    return fence.polygons, fence.circle_zones


def _wrong_side(zone: Zone) -> str:
    if zone.inclusion:
        return f"is outside the inclusion zone {zone.name!r}: a plan must begin inside"
    return f"is inside the zone {zone.name!r}: a plan must begin outside"


def _breach(zone: Zone, near: PlaceInPath, path: FlownPath, maneuver: Maneuver) -> Breach:
    """A zone that is entered, searched for where and how deep, or that is too close."""
    if near.distance > TOUCH_M:
        return _at(zone, near.distance, near, path, maneuver)
    entry = first_entry(path.pieces, zone)
    deepest = near if isinstance(zone, CircleZone) else least_distance(path.pieces, zone)
    # What only just touches may do so between the places that the search for the entry looks at.
    place = entry if entry.distance <= TOUCH_M else deepest
    return _at(zone, deepest.distance, place, path, maneuver)


def _at(zone: Zone, clearance_m: float, place: PlaceInPath, path: FlownPath, maneuver: Maneuver) -> Breach:
    """The place and the time of a point of the path."""
    pieces = path.pieces
    x, y = pieces.take(place.piece).position(place.time_s)
    holding = place.piece == path.hold
    time_s = float(pieces.start_s[place.piece]) + place.time_s
    if holding and not maneuver.orbit.moves:
        flown_rad = float(place.time_s * pieces.speed[place.piece] / pieces.radius[place.piece])
        time_s = path.hold_s + time_in_hold(maneuver, flown_rad)
    return Breach(zone, clearance_m, float(x), float(y), time_s, holding)


def _clear_sentence(found: FenceCheck, frame: LocalFrame | None) -> str:
    near = found.closest
    where = f"at {_place(near, frame, found.decimals)}"
    return (
        f"The plan and its hold stay clear of the fence, {near.clearance_m:.{found.decimals}f} m from "
        f"{_named(near.zone)} at least, {where}."
    )


def _breach_sentence(found: FenceCheck, frame: LocalFrame | None) -> str:
    first, *others = found.breaches
    d = found.decimals
    where = f"{'on the circle, ' if first.holding else ''}in {first.time_s:.{d}f} s, at {_place(first, frame, d)}"
    more = f"; {_and_others(others)}" if others else ""
    if not first.enters:
        near = f"comes within {first.clearance_m:.{d}f} m of {_named(first.zone)} {where}"
        return f"The plan {near}, less than the margin of {found.margin_m:g} m{more}."
    does = "leaves" if first.zone.inclusion else "enters"
    depth = (
        f"by up to {max(0.0, -first.clearance_m):.{d}f} m" if first.clearance_m < -TOUCH_M else "where it touches it"
    )
    return f"The plan {does} {_named(first.zone)} {where}, {depth}{more}."


def _and_others(others: Sequence[Breach]) -> str:
    names = " and ".join(repr(breach.zone.name) for breach in others)
    return f"later also {names}"


def _named(zone: Zone) -> str:
    return f"the {'inclusion zone' if zone.inclusion else 'zone'} {zone.name!r}"


def _place(breach: Breach, frame: LocalFrame | None, decimals: int) -> str:
    """A place as text: "120 m east, 30 m south", or in degrees."""
    if frame is not None:
        place = frame.place(Pose(breach.east_m, breach.north_m, 0.0))
        return degrees_of(place.latitude_deg, place.longitude_deg)
    d = decimals - 1
    east, north = ("east" if breach.east_m >= 0.0 else "west"), ("north" if breach.north_m >= 0.0 else "south")
    return f"{abs(breach.east_m):.{d}f} m {east}, {abs(breach.north_m):.{d}f} m {north}"


def _values(breach: Breach, frame: LocalFrame | None) -> dict[str, object]:
    values: dict[str, object] = {
        "zone": breach.zone.name,
        "inclusion": breach.zone.inclusion,
        "clearance_m": breach.clearance_m,
        "enters": breach.enters,
        "time_s": breach.time_s,
        "holding": breach.holding,
        "east_m": breach.east_m,
        "north_m": breach.north_m,
    }
    if frame is None:
        return values
    place = frame.place(Pose(breach.east_m, breach.north_m, 0.0))
    return values | {"latitude_deg": place.latitude_deg, "longitude_deg": place.longitude_deg}
