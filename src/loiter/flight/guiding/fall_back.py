"""The circle to which a vehicle is commanded back: one to which its own guidance does not lead it through a fence.

An autopilot flies to a circle straight, through whatever is between. Where that is a zone, it is commanded to a circle
beside the vehicle instead, which it need only turn into. The way is that of ArduPlane's guidance; PX4's is much the
same.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace
from math import exp, hypot, inf, pi
from typing import NamedTuple

import numpy as np

from loiter.errors import LoiterError
from loiter.fences import Fence
from loiter.fences.model import Zone, signed_distance
from loiter.flight.autopilots.own_guidance import DEFAULT_DAMPING, Guidance
from loiter.flight.guiding.hand_over import SETTLING_S, turn_response
from loiter.guidance.circle import Band, circle_offset
from loiter.guidance.protocol import State
from loiter.guidance.vehicle import PlanarPose, bank_at_rate, clip, constant_turn, rate_at_bank
from loiter.planning.compass import heading_of, heading_vector
from loiter.planning.model import CALM, Aircraft, Orbit, Turn, Wind, check_held, relative_wind, sign_of

# Seconds between the places of a way, and the time constant of the bank.
STEP_S, ROLL_S = 0.2, 0.4

# The guidance of a vehicle that does not report its own: ArduPlane's defaults.
DEFAULT_GUIDANCE = Guidance(2.0 * pi / 17.0, DEFAULT_DAMPING)

# In this band a vehicle counts as on the circle.
BAND = Band()

# A way is flown for the time of the straight line to the circle and so many rounds more.
ROUNDS = 2.0

# The way to the circle should be farther from the fence than the margin by this share of the tightest turn, in case the
# autopilot flies it otherwise than the model. On the circle, and where no way keeps that, it must keep this share of
# the margin.
WAY_SHARE, CIRCLE_SHARE = 0.25, 0.5

# The radius of a circle beside the vehicle, in tightest turns.
BESIDE = 1.3


class OwnGuidance(NamedTuple):
    """A vehicle that flies by its own guidance: as an aircraft, in a wind, with the guidance of its parameters.

    `kept_s` is for how long it keeps its bank before, seconds, and `turn_ratio` that of the law.
    """

    aircraft: Aircraft
    wind: Wind | None
    guidance: Guidance | None
    kept_s: float = 0.0
    turn_ratio: float = 1.0


class OwnWay(NamedTuple):
    """The places on the way of a vehicle onto a circle and round it, metres, and whether it is on the circle there."""

    east_m: list[float]
    north_m: list[float]
    is_on_circle: list[bool]


def own_way(state: State, orbit: Orbit, own: OwnGuidance) -> OwnWay:
    """The way of a vehicle onto a circle, by its own guidance; raises `LoiterError` where it cannot hold the circle."""
    wind, guidance, aircraft = own.wind or CALM, own.guidance or DEFAULT_GUIDANCE, own.aircraft
    check_held(orbit, aircraft, relative_wind(orbit, aircraft, wind), wind)
    limit_deg, air = aircraft.bank_deg(aircraft.turn_radius_m), wind.velocity_m_s
    V, bank_deg, side = aircraft.airspeed_m_s, state.bank_deg, sign_of(orbit.turn)
    here = PlanarPose(state.east_m, state.north_m, *heading_vector(state.heading_deg))
    away_m = abs(circle_offset(state, orbit).outside_m)
    way, kept, settling = OwnWay([], [], []), exp(-STEP_S / ROLL_S), 1.0 - exp(-STEP_S / SETTLING_S)
    ratio, share = turn_response(own.turn_ratio)
    settled_rate = rate_at_bank(bank_deg, V)
    for k in range(round((own.kept_s + (away_m + ROUNDS * 2.0 * pi * orbit.radius_m) / V) / STEP_S)):
        velocity = V * here.c + air[0], V * here.s + air[1]
        now = State(k * STEP_S, here.x, here.y, heading_of(here.c, here.s), bank_deg, *velocity, V)
        way.east_m.append(here.x)
        way.north_m.append(here.y)
        way.is_on_circle.append(BAND.has(circle_offset(now, orbit), side))
        demand = guidance.loiter_demand(circle_offset(now, orbit), side)
        wanted_deg = clip(bank_at_rate(demand / V, V), limit_deg)
        if k * STEP_S >= own.kept_s:
            bank_deg = wanted_deg + kept * (bank_deg - wanted_deg)
        rate = rate_at_bank(bank_deg, V)
        settled_rate += settling * (rate - settled_rate)
        turned = ratio * ((1.0 - share) * rate + share * settled_rate)
        # Angles are counted counter-clockwise: a rate to the right is negative.
        here = constant_turn(here, V, -turned, STEP_S, air)
    return way


class Room(NamedTuple):
    """What the own way onto a circle leaves beyond what it should keep from a fence, and beyond the least, metres."""

    wanted_m: float
    least_m: float


def room(fence: Fence, margin_m: float, state: State, orbit: Orbit, own: OwnGuidance) -> Room:
    """The room of a vehicle on its way onto a circle; that of a circle that cannot be held is -inf."""
    try:
        way = own_way(state, orbit, own)
    except LoiterError:
        return Room(-inf, -inf)
    east, north = np.array(way.east_m), np.array(way.north_m)
    zones: list[Zone] = [*fence.polygons, *fence.circle_zones]
    nearest_m = np.min([signed_distance(zone, east, north) for zone in zones], axis=0)
    least_m, wanted_m = CIRCLE_SHARE * margin_m, margin_m + WAY_SHARE * own.aircraft.turn_radius_m
    wanted = nearest_m - np.where(way.is_on_circle, least_m, wanted_m)
    return Room(float(wanted.min()), float(nearest_m.min()) - least_m)


def circles_beside(state: State, orbit: Orbit, aircraft: Aircraft) -> Iterator[Orbit]:
    """The circles into which a vehicle can turn where it is, to either side: narrow ones, then wide ones."""
    vx, vy = state.velocity_east_m_s, state.velocity_north_m_s
    speed = hypot(vx, vy) or 1.0
    for radius_m in (BESIDE * aircraft.turn_radius_m, orbit.radius_m):
        for turn in (Turn.CW, Turn.CCW):
            # The centre is to the right of the course for a clockwise circle.
            right_m = sign_of(turn) * radius_m / speed
            yield replace(
                orbit,
                east_m=state.east_m + right_m * vy,
                north_m=state.north_m - right_m * vx,
                radius_m=radius_m,
                turn=turn,
            )


class FallBack(NamedTuple):
    """The circle to command, and whether the own way of the vehicle there is clear of the fence."""

    circle: Orbit
    is_clear: bool


def fall_back(
    fence: Fence, margin_m: float, circles: Iterable[Orbit], states: Iterable[State], own: OwnGuidance
) -> FallBack:
    """The first of some circles whose own way, from a state for each, is clear of a fence by what it should be.

    Without one it is that whose way stays farthest from the fence.
    """
    best: FallBack | None = None
    most_m = -inf
    for circle, state in zip(circles, states, strict=True):
        left = room(fence, margin_m, state, circle, own)
        if left.wanted_m >= 0.0:
            return FallBack(circle, True)
        if best is None or left.least_m > most_m:
            best, most_m = FallBack(circle, left.least_m >= 0.0), left.least_m
    assert best is not None  # there is one circle at least
    return best
