"""Pictures of maneuvers. Only this package imports matplotlib."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from loiter.geo import LocalFrame
from loiter.planning.maneuver import Maneuver

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = ["draw"]


def draw(
    best: Maneuver | Sequence[Maneuver], others: Sequence[Maneuver] = (), *, frame: LocalFrame | None = None
) -> Figure:
    """A matplotlib figure of a maneuver, or of several from one start, seen from above, in metres.

    The segments of `best` are coloured, `others`, such as slower ones of `loiter.candidates`, are faint; with a frame
    the axes name its origin on Earth. Raises `InvalidArgument` for something that is no maneuver, and for none.

    >>> from loiter import Aircraft, Orbit, Pose, plan
    >>> m = plan(Pose(-400.0, 120.0, 90.0), Orbit(0.0, 0.0, 80.0), Aircraft(18.0, max_bank_deg=35.0))
    >>> loiter.plot.draw(m).axes[0].get_xlabel()
    'east (m)'
    """
    from loiter.errors import InvalidArgument, instance
    from loiter.plot import picture

    maneuvers = [best] if isinstance(best, Maneuver) else list(best)
    for maneuver in (*maneuvers, *others):
        instance("maneuver", maneuver, Maneuver)
    if not maneuvers:
        raise InvalidArgument("maneuver", "is missing: there is none to draw")
    return picture.draw(maneuvers, others, frame=frame)
