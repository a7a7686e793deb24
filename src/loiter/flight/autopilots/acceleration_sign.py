"""The sign with which PX4 flies lateral accelerations of offboard setpoints, found from the response of the bank.

PX4 turned away from the acceleration until its pull request 27582 (June 2026): the version tells the sign of releases,
the response that of every vehicle. Two models of the bank, one for each sign, are compared with the measured bank.
Banks are limited until then, unless a release tells the sign.
"""

from __future__ import annotations

from collections import deque
from math import inf

from loiter.guidance.vehicle import Roll

# The first version, major and minor, whose releases turn towards the acceleration.
MENDED = (1, 18)

# The lowest byte of the version of a release (FIRMWARE_VERSION_TYPE_OFFICIAL).
RELEASE = 255

# Until the response has shown the sign of what is no release, commands are limited to this bank, degrees.
CAUTIOUS_DEG = 20.0

# The assumed dead time of the response, and the averaging time of the models' errors, seconds.
DEAD_TIME_S, AVERAGE_S = 0.15, 0.25

# The sign is decided once the models have differed by this, degrees, and the error of one has been below that of the
# other by this factor, for this time, seconds.
LEAST_DIFFERENCE_DEG, CLEARLY, DECIDE_S = 8.0, 3.0, 0.2

# Errors below this, degrees, count as this: noise and gusts.
NOISE_DEG = 1.0


def sign_of_version(flight_sw_version: int) -> int:
    """The sign of a version in AUTOPILOT_VERSION: 1 if PX4 turns towards the acceleration, -1 if away from it."""
    return 1 if (flight_sw_version >> 24 & 255, flight_sw_version >> 16 & 255) >= MENDED else -1


def is_release(flight_sw_version: int) -> bool:
    """Whether a version in AUTOPILOT_VERSION is that of a release: what is built between releases may have any sign."""
    return flight_sw_version & 255 == RELEASE


class AccelerationSign:
    """The sign of accelerations: `sign` is the present one, `confirmed` whether the response has shown it.

    `known` is whether it is believed before that. `flips` counts how often the response contradicted it.
    """

    def __init__(self, sign: int, roll: Roll, *, known: bool = False) -> None:
        self.sign, self.confirmed, self.flips = sign, False, 0
        self._known = known
        self._roll = roll
        # The banks that each sign predicts, and their averaged errors.
        self._banks: dict[int, float] = {}
        self._errors = {1: 0.0, -1: 0.0}
        self._sent: deque[tuple[float, float]] = deque()
        self._time = 0.0
        self._since: tuple[int, float] | None = None

    @property
    def limit_deg(self) -> float:
        """The largest bank to command, degrees: no limit where the sign is known, or once it is confirmed."""
        return inf if self._known or self.confirmed else CAUTIOUS_DEG

    def update(self, bank_deg: float, command_deg: float, now: float) -> None:
        """Process a measured bank and the command that is sent with the present sign."""
        if self.confirmed:
            return
        dt = now - self._time if self._banks else 0.0
        self._time = now
        self._sent.append((now, self.sign * command_deg))
        target_deg = self._delayed_deg(now)
        for sign in self._errors:
            modelled = self._banks.get(sign, bank_deg)
            if target_deg is not None and dt > 0.0:
                modelled = self._roll.bank_after(modelled, sign * target_deg, dt)
            self._banks[sign] = modelled
            share = min(dt / AVERAGE_S, 1.0)
            self._errors[sign] += share * (abs(bank_deg - modelled) - self._errors[sign])
        self._decide(now)

    def _delayed_deg(self, now: float) -> float | None:
        """The command that the vehicle follows now, with the sign in which it was sent; None before the first."""
        while len(self._sent) > 1 and self._sent[1][0] <= now - DEAD_TIME_S:
            self._sent.popleft()
        time, command_deg = self._sent[0]
        return command_deg if time <= now - DEAD_TIME_S else None

    def _decide(self, now: float) -> None:
        likely = min(self._errors, key=lambda sign: self._errors[sign])
        differ = abs(self._banks[1] - self._banks[-1]) >= LEAST_DIFFERENCE_DEG
        clear = self._errors[-likely] >= CLEARLY * max(self._errors[likely], NOISE_DEG)
        if not (differ and clear):
            self._since = None
        elif self._since is None or self._since[0] != likely:
            self._since = likely, now
        elif now - self._since[1] >= DECIDE_S:
            self.confirmed = True
            self.flips += likely != self.sign
            self.sign = likely
