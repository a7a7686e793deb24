"""Reports of a guided flight."""

from __future__ import annotations

from enum import StrEnum
from math import nan
from typing import NamedTuple

from loiter.flight.guiding.measurements import AirspeedSource
from loiter.guidance.protocol import Phase, State
from loiter.guidance.vehicle import VehicleEstimates
from loiter.planning.model import Turn


class Stage(StrEnum):
    """The stages of a guided flight. When it is `READY`, nothing has been commanded yet."""

    READY = "ready"
    FALL_BACK = "fall-back circle"
    JOINING = "joining"
    HOLDING = "holding"
    HANDING_OVER = "handing over"
    HANDED_OVER = "handed over"
    SHOWING = "dry run"


class GuideReport(NamedTuple):
    """A guided vehicle at an instant.

    `time_s` counts from the call of `guide`. `state` is the last measured state, in the local metres of the frame,
    `altitude_m` its altitude above mean sea level, `height_m` its height above home. `phase` is the present action of
    the law, `time_to_join_s` the seconds until the circle is joined, `turn` the direction in which it is held.
    `command_deg` is the commanded bank, positive to the right. `crosstrack_m` is the distance from the planned path,
    positive to its left, `outside_m` the distance from the circle, positive outside. `rate_hz` and `age_s` are the rate
    of measurements and the age of the last one. `estimates` are those of the law: roll response, delay, ratio of turn
    rates and wind. `slot_ahead_deg` is how far the slot is ahead of the vehicle on the circle, degrees. Unknown values
    are nan or None. `notices` are sentences that are reported once.
    """

    time_s: float
    stage: Stage
    state: State | None = None
    altitude_m: float = nan
    height_m: float = nan
    airspeed_source: AirspeedSource = AirspeedSource.MEASURED
    phase: Phase = Phase.NO_DATA
    time_to_join_s: float = nan
    turn: Turn = Turn.EITHER
    command_deg: float = nan
    crosstrack_m: float = nan
    outside_m: float = nan
    rate_hz: float = 0.0
    age_s: float = nan
    estimates: VehicleEstimates | None = None
    slot_ahead_deg: float = nan
    notices: tuple[str, ...] = ()
