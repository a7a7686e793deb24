"""Before a guided flight: everything that must be known, and the choice of aircraft, circle and altitude."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from math import degrees, isfinite
from time import monotonic
from typing import Literal, NamedTuple, TypeAlias

from loiter.errors import InvalidArgument, LinkFailed, clause
from loiter.fences import ClearEntry, Fence, PlacedFence
from loiter.fences.fence import checked_margin_m
from loiter.flight.autopilots.readiness import refusal
from loiter.flight.autopilots.settings import AutopilotSettings, Need, autopilot_settings, missing
from loiter.flight.autopilots.steering import LOCAL_POSITION, LOCAL_POSITION_S
from loiter.flight.guiding.contact import Contact
from loiter.flight.guiding.measurements import AirspeedSource
from loiter.flight.guiding.monitor import LEAST_HEIGHT_M, LEAST_HZ
from loiter.flight.link.dead_reckoning import GroundMotion, motion_after
from loiter.flight.link.link import not_found
from loiter.flight.missions.fences import receive_fence
from loiter.geo import LocalFrame
from loiter.geo.atmosphere import eas2tas_squared
from loiter.guidance.entry.fenced_entry import SearchProblem, begin_search
from loiter.guidance.entry.limits import NEGLIGIBLE_WIND
from loiter.guidance.entry.slot_entry import BAND
from loiter.guidance.protocol import State
from loiter.planning.compass import wrapped
from loiter.planning.model import (
    CALM,
    Aircraft,
    Orbit,
    Pose,
    RelativeWind,
    Turn,
    Wind,
    check_held,
    is_holdable,
    relative_velocity,
)
from loiter.planning.slot import Slot
from loiter.planning.solve import plan

# Seconds to listen for other vehicles and stations: heartbeats come once a second.
OTHERS_S = 1.1

# Seconds for everything that is needed to arrive, and for PX4's version, without which the flight begins too.
PREPARE_S, VERSION_S = 8.0, 1.5

# Seconds for searches for an entry that stays clear of a fence: the vehicle flies on meanwhile.
LONGEST_SEARCH_S = 30.0

# What is said of the time for that.
AGAIN = (
    "After the answer an entry is searched for from where the vehicle will be by then: until that is found, "
    f"for up to {LONGEST_SEARCH_S:g} s, nothing is commanded."
)

# The circle counts as impossible to hold in the wind if one that is wider by this factor is: an estimate has errors,
# and an aircraft that drifts outside a little is not in danger.
WIND_SLACK = 1.15

# The share by which the measured airspeed may differ from the declared one before the plan uses the measured one.
AIRSPEED_SHARE = 0.15


# The fence that the vehicle has.
OwnFence: TypeAlias = Literal["vehicle"]


class Assignment(NamedTuple):
    """The slot of one vehicle of a fleet, whose times are Unix times, and the circle with the direction of all."""

    orbit: Orbit
    slot: Slot


class GuideRequest(NamedTuple):
    """The arguments of `guide`: the circle and its frame, the aircraft and the wind if they are given, the options.

    The times of the slot are Unix times. `assign` takes the place of `confirm` for a vehicle of a fleet: it is called
    with what the flight would begin with, the last state and its age, seconds, until it returns the slot.
    """

    orbit: Orbit
    frame: LocalFrame
    airspeed_m_s: float | None = None
    max_bank_deg: float | None = None
    wind: Wind | None = None
    altitude_m: float | None = None
    keep: bool = False
    dry_run: bool = False
    accept_fly_away: bool = False
    confirm: Callable[[], bool] | None = None
    fence: PlacedFence | OwnFence | None = None
    margin_m: float | None = None
    slot: Slot | None = None
    slot_band: float = BAND
    assign: Callable[[FlightSetup, State, float], Assignment | None] | None = None


class FlightSetup(NamedTuple):
    """What a flight begins with; the orbit has a direction, `notices` are sentences for the user."""

    orbit: Orbit
    aircraft: Aircraft
    settings: AutopilotSettings
    altitude_m: float
    state: State
    wind: Wind | None
    notices: tuple[str, ...]


def prepare(contact: Contact, request: GuideRequest, timeout_s: float, *, only_vehicle: bool) -> FlightSetup:
    """Wait until everything that is needed has arrived, and choose aircraft, altitude and direction.

    `only_vehicle` is whether a second vehicle is refused. Raises `LinkFailed` where something does not arrive, and for
    a vehicle that must not be guided; `InvalidArgument` where the options do not suit it.
    """
    _await_data(contact, min(timeout_s, PREPARE_S))
    if only_vehicle and contact.link.others:
        vehicles = {contact.link.vehicle, *contact.link.others}
        raise LinkFailed(not_found("the connection", None, vehicles, 0.0))
    if problem := refusal(contact.telemetry.last("HEARTBEAT"), contact.telemetry.last("EXTENDED_SYS_STATE")):
        raise LinkFailed(f"{contact.name} cannot be guided: {problem}")
    if contact.link.rivals:
        raise LinkFailed(f"{contact.name} cannot be guided: another program guides it already")
    settings = autopilot_settings(contact.autopilot, contact.parameters.known)
    if contact.flies_px4 and settings.flies_away and not (request.accept_fly_away or request.dry_run):
        raise InvalidArgument("accept_fly_away", _fly_away_problem(settings))
    contact.fence = _local_fence(contact, request, timeout_s)
    chosen = choose(contact, request, settings)
    return chosen if contact.fence is None else _fenced(contact, contact.fence, request, chosen)


def choose(contact: Contact, request: GuideRequest, settings: AutopilotSettings) -> FlightSetup:
    """Choose aircraft, altitude and direction, for the present state; raises like `prepare`."""
    bank_deg = _bank_limit_deg(request, settings)
    airspeed, notices = _airspeed(contact, request, settings)
    contact.measurements.declared_m_s = airspeed
    aircraft = Aircraft(airspeed, max_bank_deg=bank_deg)
    altitude_m = _circle_altitude_m(contact, request)
    state, orbit = contact.state(), request.orbit
    assert state is not None  # it was waited for
    wind = request.wind or _holdable_wind(orbit, aircraft, contact.likely_wind(airspeed))
    start = Pose(state.east_m, state.north_m, wrapped(state.heading_deg))
    if orbit.turn == Turn.EITHER:
        orbit = replace(orbit, turn=plan(start, orbit, aircraft, wind).turn)
    return FlightSetup(orbit, aircraft, settings, altitude_m, state, wind, notices)


def _local_fence(contact: Contact, request: GuideRequest, timeout_s: float) -> Fence | None:
    """The fence of the request, which may be that of the vehicle, in the metres of its frame; None without one."""
    placed = request.fence
    if placed == "vehicle":
        placed = receive_fence(contact.link, timeout_s)
        if placed is None:
            raise LinkFailed(f"{contact.name} has no fence to be checked")
    return None if placed is None else placed.local(request.frame)


def _fenced(contact: Contact, fence: Fence, request: GuideRequest, chosen: FlightSetup) -> FlightSetup:
    """What a flight begins with, in the direction of the fastest entry found that stays clear of the fence.

    Raises `LinkFailed` where none is found.
    """
    state = chosen.state
    wind = CALM if chosen.wind is None else chosen.wind
    if wind.speed_m_s < NEGLIGIBLE_WIND * chosen.aircraft.airspeed_m_s:
        wind = CALM  # the law plans as in still air too
    start, scene = Pose(state.east_m, state.north_m, wrapped(state.heading_deg)), (chosen.aircraft, wind)
    margin_m = checked_margin_m(request.orbit, request.margin_m)
    try:
        search = Search(
            contact, SearchProblem(fence, start, request.orbit, *scene, margin_m), monotonic() + LONGEST_SEARCH_S
        )
        while not search.ended(monotonic()):
            contact.request_in_flight(contact.listen())
        found = search.found
        refused = fence.check(plan(start, request.orbit, *scene), margin_m)
    except InvalidArgument as error:
        raise LinkFailed(f"{contact.name} cannot be guided: its {error}") from error
    if found.maneuver is None or found.check is None:
        reasons = [clause(sentence) for sentence in (refused.sentence(request.frame), found.sentence)]
        raise LinkFailed(f"{contact.name} cannot be guided: {'; '.join(reasons)}")
    more = () if found.is_fastest else (found.sentence,)
    orbit = replace(chosen.orbit, turn=found.maneuver.turn)
    said = found.check.sentence(request.frame), *more, AGAIN
    return chosen._replace(orbit=orbit, notices=(*chosen.notices, *said))


class Search:
    """A search for a clear entry until a time, during which messages must be received: the vehicle flies on."""

    def __init__(self, contact: Contact, problem: SearchProblem, until: float) -> None:
        self._name, self._answer, self._until = contact.name, begin_search(problem), until

    def ended(self, now: float) -> bool:
        """Whether there is an answer; raises `LinkFailed` where it takes too long."""
        if not self._answer.ready() and now > self._until:
            late = f"no entry that stays clear of the fence was found in {LONGEST_SEARCH_S:g} s"
            raise LinkFailed(f"{self._name} cannot be guided: {late}")
        return self._answer.ready()

    @property
    def found(self) -> ClearEntry:
        """The answer; raises the errors of `clear_entry`."""
        return self._answer.get()


def pose_ahead(contact: Contact, state: State, after_s: float, wind: Wind | None) -> Pose:
    """Where the vehicle will be some seconds after a state, if it keeps its rate of turn."""
    rate = contact.telemetry.yaw_rate
    here = GroundMotion(state.east_m, state.north_m, state.velocity_east_m_s, state.velocity_north_m_s)
    there = motion_after(here, rate, after_s, CALM if wind is None else wind)
    return Pose(there.east_m, there.north_m, wrapped(state.heading_deg + degrees(rate * after_s)))


def _holdable_wind(orbit: Orbit, aircraft: Aircraft, wind: Wind | None) -> Wind | None:
    """An estimated wind if the circle can be held in it, and None if it just cannot: the law then finds it out itself.

    Raises `LoiterError` as `check_in_wind` does.
    """
    return wind if wind is not None and check_in_wind(orbit, aircraft, wind.velocity_m_s) else None


def check_in_wind(orbit: Orbit, aircraft: Aircraft, wind: tuple[float, float]) -> bool:
    """Raise `LoiterError` if a circle that is wider by `WIND_SLACK` cannot be held either in an estimated wind.

    Returns whether the circle itself can be held. The wind is a velocity, east and north, metres per second.
    """
    air = RelativeWind(*relative_velocity(wind, (0.0, 0.0), aircraft.airspeed_m_s))
    can_be_held = is_holdable(orbit, aircraft, air)
    if not can_be_held and not is_holdable(replace(orbit, radius_m=WIND_SLACK * orbit.radius_m), aircraft, air):
        # Raises: its sentence is about the circle itself.
        check_held(orbit, aircraft, air)
    return can_be_held


def _fly_away_problem(settings: AutopilotSettings) -> str:
    """What is wrong with PX4's action when setpoints stop, and what to do."""
    lost = "is needed: if this program or the link dies, PX4 does not stay here but follows COM_OBL_RC_ACT"
    return f"{lost}, {settings.loss_action}; set that parameter to 5 (hold) or 3 (return) instead"


def _await_data(contact: Contact, timeout_s: float) -> None:
    """Request and receive until nothing is lacking, and at least for `OTHERS_S` seconds."""
    now = contact.began
    while (lacking := _missing_data(contact, now)) or now < contact.began + OTHERS_S:
        if contact.measurements.is_far:
            raise LinkFailed(f"{contact.name} {_far(contact)}")
        if silent := contact.monitor.silent(now):
            raise LinkFailed(silent)
        if lacking and now - contact.began > timeout_s:
            raise LinkFailed(f"{contact.name} {lacking}{contact.texts.quoted}")
        contact.request_all(now)
        now = contact.listen()


def _missing_data(contact: Contact, now: float) -> str:
    """What has not arrived yet, in words; empty if nothing is missing."""
    m, telemetry = contact.measurements, contact.telemetry
    if telemetry.last("HEARTBEAT") is None:
        return "sends no heartbeat"
    if telemetry.last("EXTENDED_SYS_STATE") is None:
        return "does not report whether it is in the air (EXTENDED_SYS_STATE)"
    if unknown := missing(contact.autopilot, contact.parameters.known):
        return f"does not report its parameter {unknown[0]}"
    if not contact.parameters.done and missing(contact.autopilot, contact.parameters.known, Need.WANTED):
        return "does not report its parameters"
    if contact.state() is None:
        return "sends no position and attitude"
    if m.rate_hz(now) < LEAST_HZ:
        return f"sends {m.rate_hz(now):.1f} measurements a second, and {LEAST_HZ:.0f} are needed"
    if contact.flies_px4 and telemetry.recent(LOCAL_POSITION, now, LOCAL_POSITION_S) is None:
        return f"sends no local position ({LOCAL_POSITION})"
    if contact.flies_px4 and not contact.version and now < contact.began + VERSION_S:
        return "does not report its version"
    return "" if contact.streams.settled else "does not answer requests for streams"


def _far(contact: Contact) -> str:
    """That the vehicle is out of the reach of the circle's frame."""
    swapped = ": are the circle's latitude and longitude swapped?" if contact.measurements.swapped else ""
    return f"is more than 100 km from the circle{swapped}"


def _circle_altitude_m(contact: Contact, request: GuideRequest) -> float:
    """The altitude of the circle above mean sea level, metres: the present one unless it is given.

    Raises `LinkFailed` for a vehicle that is too low, and `InvalidArgument` for a circle that is.
    """
    height_m, present_m = contact.telemetry.height_m, contact.telemetry.fix().altitude_m
    if height_m < LEAST_HEIGHT_M:
        height = f"it is {height_m:.0f} m above home"
        raise LinkFailed(f"{contact.name} cannot be guided: {height}, and must be at least {LEAST_HEIGHT_M:g} m above")
    home_m, altitude_m = contact.home_altitude_m, request.altitude_m
    if altitude_m is None:
        return present_m
    if altitude_m >= home_m + LEAST_HEIGHT_M:
        return altitude_m
    side, off_m = ("above" if altitude_m >= home_m else "below"), abs(altitude_m - home_m)
    problem = f"is {altitude_m:g}: {off_m:.0f} m {side} home, which is {home_m:.0f} m above mean sea level"
    # A number that is nearer to the present height above home than to the present altitude is probably meant as one.
    if altitude_m >= LEAST_HEIGHT_M and abs(altitude_m - height_m) < abs(altitude_m - present_m):
        proposal = f"was {altitude_m:g} m above home meant? That is {altitude_m + home_m:.0f}"
    else:
        proposal = f"the lowest circle is {LEAST_HEIGHT_M:g} m above home, at {LEAST_HEIGHT_M + home_m:.0f}"
    raise InvalidArgument("altitude_m", f"{problem}; {proposal}")


def _bank_limit_deg(request: GuideRequest, settings: AutopilotSettings) -> float:
    """The limit of commanded banks: the one requested, or just below that of the autopilot."""
    limit_deg = settings.bank_limit_deg
    if request.max_bank_deg is not None and request.max_bank_deg > limit_deg:
        given = f"is {request.max_bank_deg:g}"
        raise InvalidArgument("max_bank_deg", f"{given}: the autopilot banks no steeper than {limit_deg:g} degrees")
    return settings.guided_bank_deg if request.max_bank_deg is None else request.max_bank_deg


def _airspeed(contact: Contact, request: GuideRequest, settings: AutopilotSettings) -> tuple[float, tuple[str, ...]]:
    """The true airspeed to plan with, metres per second, and notices about it."""
    declared = request.airspeed_m_s
    if declared is None:
        declared = settings.airspeed_m_s * eas2tas_squared(contact.telemetry.fix().altitude_m) ** 0.5
    contact.measurements.declared_m_s = declared
    measured, source = contact.measurements.airspeed(contact.reported_wind(), monotonic())
    if source != AirspeedSource.MEASURED:
        return declared, (f"The vehicle reports no airspeed; the airspeed is {source}.",)
    if request.airspeed_m_s is None and isfinite(measured) and abs(measured - declared) > AIRSPEED_SHARE * declared:
        text = f"The vehicle flies at {measured:.1f} m/s, not at its cruise airspeed of {declared:.1f} m/s"
        # A change of mode ends an airspeed that was commanded; where the mode stays, that airspeed does too.
        if contact.is_commanded:
            return measured, (f"{text}: the plan is for {measured:.1f} m/s.",)
        return declared, (f"{text}, to which it will change: the plan is for that.",)
    return declared, ()
