"""The summary of a guided flight that is shown before the first command."""

from __future__ import annotations

from math import isnan

from loiter.flight.autopilots.modes import GUIDED
from loiter.flight.autopilots.settings import autopilot_settings
from loiter.flight.guiding.contact import Contact
from loiter.flight.guiding.preparation import FlightSetup

ARDUPLANE_LOSS = "ArduPlane keeps its bank for up to 3 s and then flies the fall-back circle"


def summary(contact: Contact, setup: FlightSetup, turn: str) -> tuple[str, ...]:
    """Sentences: what is taken over, which circle is flown, what follows a lost link, the fence, other stations.

    `turn` is the direction in words.
    """
    return (
        f"{_from_mode(contact)}; it is at {heights(contact.telemetry.fix().altitude_m, contact.home_altitude_m)}.",
        f"{_circle(contact, setup)}, {turn}.",
        f"If this program or the link dies, {loss_consequence(contact)}.",
        f"Fence: {setup.settings.fence}.",
        *_stations(contact),
    )


def heights(altitude_m: float, home_m: float) -> str:
    """An altitude above mean sea level with the height above home, metres: "684 m (100 m above home)"."""
    if isnan(home_m):
        return f"{altitude_m:.0f} m"
    height_m = altitude_m - home_m
    return f"{altitude_m:.0f} m ({abs(height_m):.0f} m {'above' if height_m >= 0.0 else 'below'} home)"


def loss_consequence(contact: Contact) -> str:
    """What a vehicle that is steered does when no more setpoints arrive."""
    if contact.flies_px4:
        settings = autopilot_settings(contact.autopilot, contact.parameters.known)
        return f"PX4 follows COM_OBL_RC_ACT: {settings.loss_action}"
    return ARDUPLANE_LOSS


def _from_mode(contact: Contact) -> str:
    if contact.monitor.modes.mode == GUIDED and not contact.flies_px4:
        return f"{contact.name} flies in GUIDED already: another station or program has commanded it"
    modes = "HOLD and then to OFFBOARD" if contact.flies_px4 else "GUIDED"
    return f"{contact.name} flies in {contact.monitor.modes.name}, and is commanded to change to {modes}"


def _circle(contact: Contact, setup: FlightSetup) -> str:
    altitude = heights(setup.altitude_m, contact.home_altitude_m)
    return f"The circle: radius {setup.orbit.radius_m:g} m at {altitude}"


def _stations(contact: Contact) -> list[str]:
    systems = " and ".join(str(system) for system in sorted(contact.link.ground_stations))
    return [f"A ground station may command the vehicle too: system {systems}."] if systems else []
