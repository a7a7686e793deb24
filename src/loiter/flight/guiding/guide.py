"""Guiding a vehicle in flight onto its circle: the public generator, its arguments and its stages."""

from __future__ import annotations

import gc
from collections.abc import Callable, Generator, Iterator
from contextlib import contextmanager
from pathlib import Path
from time import monotonic
from typing import NamedTuple

from loiter.errors import InvalidArgument, LinkFailed, file_path, instance, not_negative, number, positive, share
from loiter.fences import PlacedFence
from loiter.flight.guiding.contact import Contact
from loiter.flight.guiding.flight import GuidedFlight, GuidingStopped
from loiter.flight.guiding.monitor import StopReason
from loiter.flight.guiding.preparation import GuideRequest, OwnFence
from loiter.flight.guiding.report import GuideReport
from loiter.flight.guiding.step_log import check_log, step_log
from loiter.flight.link.link import TIMEOUT_S, check_target, open_link
from loiter.geo import LocalFrame
from loiter.guidance.entry.slot_entry import BAND
from loiter.planning.model import Orbit, Turn, Wind
from loiter.planning.slot import Slot

INTERRUPTED = StopReason("guiding was interrupted")
OUTPUT_CLOSED = StopReason("standard output was closed")

# Seconds for which a lost vehicle is awaited.
RESUME_S = 60.0


def guide(
    connection: str,
    orbit: Orbit,
    frame: LocalFrame,
    *,
    airspeed_m_s: float | None = None,
    max_bank_deg: float | None = None,
    wind: Wind | None = None,
    system: int | None = None,
    component: int = 1,
    period_s: float = 1.0,
    timeout_s: float = TIMEOUT_S,
    altitude_m: float | None = None,
    keep: bool = False,
    dry_run: bool = False,
    accept_fly_away: bool = False,
    confirm: Callable[[], bool] | None = None,
    resume: bool = False,
    log: str | Path | None = None,
    fence: PlacedFence | OwnFence | None = None,
    margin_m: float | None = None,
    slot: Slot | None = None,
    slot_band: float = BAND,
) -> Generator[GuideReport, None, None]:
    """Guide a vehicle in flight onto a circle by bank commands, and hand it over to its own hold of that circle.

    Yields a report every `period_s` seconds; the flight goes on only while the next one is requested. `connection`,
    `system` and `component` are those of `upload`; `orbit` is a circle at rest in the local metres of `frame`. The
    true airspeed, metres per second, and the largest bank, degrees, are those of the autopilot's parameters unless they
    are given. `wind` is a first guess; without it that is the wind which the vehicle reports. `altitude_m` is the
    altitude above mean sea level at which the circle is held, by default the present one; the vehicle and the circle
    must be at least 30 m above home.

    The vehicle must be in flight: it is neither armed nor made to take off or land. The first report, whose stage is
    `READY`, comes before the first command; its notices are a summary of what will happen. `confirm`, if it is given,
    is then called many times a second, and must return at once: the first command is sent when it returns True. PX4 is
    refused if it would neither circle nor come home when the link dies, unless `accept_fly_away` is true. First it is
    commanded to hold the circle by its own guidance, the fall-back circle. Then its bank is commanded: ArduPlane by
    SET_ATTITUDE_TARGET in GUIDED, PX4 by SET_POSITION_TARGET_LOCAL_NED in OFFBOARD; the autopilot holds altitude and
    airspeed. When it has held the circle for some seconds, it is handed over: it confirms that it holds the circle by
    its own guidance, and nothing more is sent. With `keep` the circle is flown until the generator is closed. With
    `dry_run` nothing is commanded: reports show what would be. `log` is a .csv file for every step.

    With `resume` a lost link does not end the flight at once: nothing is sent, and if within a minute the vehicle is
    heard again, still in ArduPlane's GUIDED and on its way to the circle, guiding begins anew. PX4 has then left
    OFFBOARD, as a pilot may have wanted.

    `fence` is a fence, or "vehicle" for the one that the vehicle has: the fastest entry found that stays farther from
    it than `margin_m` metres (`loiter.fences.clear_entry`) is flown, and a flight without any is refused before the
    first command. So is one in which the vehicle would fly through a zone to each fall-back circle that it could be
    commanded to. Guiding stops where the vehicle enters a zone in flight.

    With `slot` the vehicle enters that slot and keeps it until the generator is closed, by a radius that differs from
    that of the circle by a share of `slot_band` at most. The times of the slot are Unix times, seconds, by the clock of
    this computer, and it moves as an aircraft of `airspeed_m_s` holds the circle in `wind`, in still air if that is
    not given: several vehicles need the same values. The circle needs a direction.

    docs/autopilots.md lists what ends the flight early, and what the vehicle does then: at once it is commanded back to
    the fall-back circle, if the link is alive and neither the pilot nor a failsafe has changed its mode. `LinkFailed`
    then says why. It is also raised if the vehicle is not found, is not fit to be guided, or refuses a command;
    `InvalidArgument` and `MissingPackage` are raised immediately. A generator that is closed, or in which
    KeyboardInterrupt is raised, commands the fall-back circle first.
    """
    check_target(connection, system, component, timeout_s)
    period_s = positive("period_s", period_s, "seconds")
    path = None if log is None else Path(file_path("log", log))
    check_log(path)
    request = GuideRequest(
        orbit=orbit,
        frame=frame,
        airspeed_m_s=airspeed_m_s,
        max_bank_deg=max_bank_deg,
        wind=wind,
        altitude_m=altitude_m,
        keep=keep or slot is not None,
        dry_run=dry_run,
        accept_fly_away=accept_fly_away,
        confirm=confirm,
        fence=fence,
        margin_m=margin_m,
        slot=slot,
        slot_band=slot_band,
    )
    target = Target(connection, system, component, timeout_s)
    return guide_request(target, checked_request(request), period_s, path, resume=resume)


def checked_request(request: GuideRequest) -> GuideRequest:
    """The request, checked; raises `InvalidArgument` for what cannot be guided."""
    r = request
    for name, value, kind in (("orbit", r.orbit, Orbit), ("frame", r.frame, LocalFrame)):
        instance(name, value, kind)
    if r.wind is not None:
        instance("wind", r.wind, Wind)
    share("slot_band", r.slot_band)
    if r.slot is not None:
        instance("slot", r.slot, Slot)
        _check_slot(r)
    if r.orbit.moves:
        raise InvalidArgument("orbit", "moves: an autopilot holds only circles at rest")
    if r.fence is not None and r.fence != "vehicle":
        instance("fence", r.fence, PlacedFence)
    V, bank_deg, altitude_m, margin_m = r.airspeed_m_s, r.max_bank_deg, r.altitude_m, r.margin_m
    return r._replace(
        airspeed_m_s=None if V is None else positive("airspeed_m_s", V, "metres per second"),
        max_bank_deg=None if bank_deg is None else positive("max_bank_deg", bank_deg, "degrees"),
        altitude_m=None if altitude_m is None else number("altitude_m", altitude_m, "metres"),
        margin_m=None if margin_m is None else not_negative("margin_m", margin_m, "metres"),
    )


def _check_slot(request: GuideRequest) -> None:
    """Raise `InvalidArgument` for a slot without what defines its motion, and for one with a fence."""
    if request.orbit.turn == Turn.EITHER:
        raise InvalidArgument("turn", "is needed with a slot, which moves cw or ccw")
    if request.airspeed_m_s is None:
        raise InvalidArgument("airspeed_m_s", "is needed with a slot, which moves with it")
    if request.fence is not None:
        raise InvalidArgument("fence", "does not go with a slot")


class Target(NamedTuple):
    """The connection to a vehicle, as `guide` takes it."""

    connection: str
    system: int | None
    component: int
    timeout_s: float


def guide_request(
    target: Target, request: GuideRequest, period_s: float, log: Path | None, *, resume: bool
) -> Generator[GuideReport, None, None]:
    """The flight of a request whose arguments are checked; otherwise like `guide`."""
    with open_link(*target, listen_s=0.0) as link:
        began = monotonic()
        flight = GuidedFlight(Contact(link, target.connection, request.frame), request, period_s, began)
        with step_log(log, lambda: flight.orbit) as flight.record, _without_garbage_collection():
            try:
                while True:
                    try:
                        yield from flight.stages(target.timeout_s, only_vehicle=target.system is None)
                        return
                    except GuidingStopped as stopped:
                        if not (resume and stopped.stop.lost and flight.vehicle_returns(RESUME_S)):
                            raise
                    contact = Contact(link, target.connection, request.frame)
                    again, record = flight.request_again(), flight.record
                    flight = GuidedFlight(contact, again, period_s, began)
                    flight.record, flight.resumed = record, True
            except GuidingStopped as stopped:
                raise LinkFailed(_end(flight, stopped.stop)) from None
            except LinkFailed as failure:
                raise LinkFailed(_end(flight, StopReason(str(failure), ours=False))) from failure
            except KeyboardInterrupt:
                raise KeyboardInterrupt(_end(flight, INTERRUPTED)) from None
            except BrokenPipeError:
                # The caller has thrown it.
                raise LinkFailed(_end(flight, OUTPUT_CLOSED)) from None
            except BaseException:
                _end(flight, INTERRUPTED)
                raise


def _end(flight: GuidedFlight, stop: StopReason) -> str:
    """The sentence of the end of a flight; one more interrupt, as by a second Ctrl-C, does not cut it short."""
    try:
        return flight.stop(stop)
    except KeyboardInterrupt:
        return flight.stop(stop)


@contextmanager
def _without_garbage_collection() -> Iterator[None]:
    """Garbage is not collected meanwhile: a collection of all generations takes tens of milliseconds."""
    enabled = gc.isenabled()
    gc.collect()
    gc.freeze()
    gc.disable()
    try:
        yield
    finally:
        gc.unfreeze()
        if enabled:
            gc.enable()
