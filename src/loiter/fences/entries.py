"""The fastest of given maneuvers that stays clear of a fence."""

from __future__ import annotations

from collections.abc import Sequence
from math import inf, nan
from typing import NamedTuple

from loiter.errors import InvalidArgument, instance
from loiter.fences.fence import Fence
from loiter.fences.fence_check import FenceCheck
from loiter.planning.maneuver import Maneuver

# Differences below this, seconds, are printed as none.
SAME_TIME_S = 0.05


class ClearEntry(NamedTuple):
    """The answer of `first_clear` and of `clear_entry`.

    `maneuver` is the fastest that stays clear, `check` its check, and `later_s` how much later than the fastest of all
    it joins, seconds; None, None and nan where none is clear. `tried` counts the candidates that were checked, and
    `blocking` names the zones that the others breach first. No clear entry takes less than `least_s` seconds; where
    that is infinite there is none. `searched` says whether other paths than candidates were searched for.
    """

    maneuver: Maneuver | None
    check: FenceCheck | None
    later_s: float
    tried: int
    blocking: tuple[str, ...]
    least_s: float = 0.0
    searched: bool = False

    @property
    def is_fastest(self) -> bool:
        """Whether the fastest entry is clear itself."""
        return self.maneuver is not None and self.tried == 1 and not self.searched

    @property
    def sentence(self) -> str:
        """The answer in a sentence."""
        if self.maneuver is None:
            return self._refusal
        if self.is_fastest:
            return "The fastest entry is clear."
        later = f"joins {self.later_s:.1f} s later" if self.later_s >= SAME_TIME_S else "is as fast"
        what = "The fastest clear entry found" if self.searched else "The first candidate that is clear"
        return f"{what} {later}: {self.maneuver}"

    @property
    def _refusal(self) -> str:
        zones = " and ".join(map(repr, self.blocking))
        if self.least_s == inf:
            return f"No entry is clear: {zones} blocks the circle itself, or every way to it."
        if self.searched:
            return f"No entry found: {zones} blocks here."
        return f"No entry found: of the {self.tried} candidates none is clear, {zones} blocks here."


def first_clear(fence: Fence, maneuvers: Sequence[Maneuver], margin_m: float | None = None) -> ClearEntry:
    """The fastest of some maneuvers from one start, such as `loiter.candidates`, that stays clear of a fence.

    The margin, metres, is that of `Fence.check`, and so are the errors; none to choose from is an `InvalidArgument`.
    Other entries than these are not tried: that none of them is clear does not say that there is none. `least_s` is
    the time of the fastest of them.
    """
    instance("fence", fence, Fence)
    ordered = sorted(maneuvers, key=lambda maneuver: maneuver.duration_s)
    if not ordered:
        raise InvalidArgument("maneuvers", "has none to choose from")
    blocking: dict[str, None] = {}
    for tried, maneuver in enumerate(ordered, start=1):
        found = fence.check(maneuver, margin_m)
        if found.clear:
            later_s = maneuver.duration_s - ordered[0].duration_s
            return ClearEntry(maneuver, found, later_s, tried, tuple(blocking), ordered[0].duration_s)
        blocking[found.breaches[0].zone.name] = None
    return ClearEntry(None, None, nan, len(ordered), tuple(blocking), ordered[0].duration_s)
