"""The parts of a certificate: the conditions that were checked, and the other extremals for the same start."""

from __future__ import annotations

from dataclasses import dataclass

from loiter.planning.model import Turn


@dataclass(frozen=True)
class Residual:
    """One condition: name, equation, violation, and the largest violation of a correct maneuver.

    `value` and `bound` are None where the condition could not be checked; `note` then says why.
    """

    name: str
    equation: str
    value: float | None
    bound: float | None
    note: str = ""

    @property
    def skipped(self) -> bool:
        """Whether the condition could not be checked."""
        return self.value is None

    @property
    def failed(self) -> bool:
        """Whether the condition is violated beyond its bound."""
        return self.value is not None and self.bound is not None and not self.value <= self.bound

    @property
    def verdict(self) -> str:
        """The verdict in a word: "holds", "FAILED" or "skipped"."""
        return "skipped" if self.skipped else "FAILED" if self.failed else "holds"


@dataclass(frozen=True)
class Candidate:
    """Another extremal for the same start; `later_s` (seconds) is negative where it joins sooner."""

    word: str
    turn: Turn
    duration_s: float
    later_s: float
