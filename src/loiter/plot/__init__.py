"""Pictures of maneuvers. Only this package imports matplotlib."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING

from loiter.geo import LocalFrame
from loiter.lazy import LazyModule
from loiter.planning.maneuver import Maneuver

if TYPE_CHECKING:
    from matplotlib import figure as figures

    from loiter import fences
else:
    fences, figures = LazyModule("loiter.fences"), LazyModule("matplotlib.figure")

__all__ = ["draw"]


def draw(
    best: Maneuver | Sequence[Maneuver],
    others: Sequence[Maneuver] = (),
    *,
    frame: LocalFrame | None = None,
    fence: fences.Fence | None = None,
    breaches: Sequence[fences.Breach] = (),
) -> figures.Figure:
    """A matplotlib figure of a maneuver, or of several from one start, seen from above, in metres.

    The segments of `best` are coloured, if they are as fast as the fastest of them; slower ones count as `others`. Of
    `others`, such as the remaining ones of `loiter.candidates`, the soonest in each direction is a grey band below; the
    rest is not drawn: it would hide the path. If the turns are too small to see, a second panel enlarges the last one.
    With a frame the axes name its origin on Earth. Of a `fence` the zones to stay out of are hatched, those to stay in
    are dashed, and crosses mark its `breaches`, from `Fence.check`. For a paper set the figure's own size
    (`set_size_inches`) and matplotlib's styles. Raises `InvalidArgument` for something that is no maneuver, and for
    none.

    >>> from loiter import Aircraft, Orbit, Pose, plan
    >>> m = plan(Pose(-400.0, 120.0, 90.0), Orbit(0.0, 0.0, 80.0), Aircraft(18.0, max_bank_deg=35.0))
    >>> loiter.plot.draw(m).axes[0].get_xlabel()
    'east (m)'
    """
    from loiter.errors import InvalidArgument, instance
    from loiter.plot import picture

    maneuvers, slower = (list(given) if isinstance(given, Iterable) else [given] for given in (best, others))
    for maneuver in (*maneuvers, *slower):
        instance("maneuver", maneuver, Maneuver)
    if frame is not None:
        instance("frame", frame, LocalFrame)
    if fence is not None:
        instance("fence", fence, fences.Fence)
    if not maneuvers:
        raise InvalidArgument("maneuver", "is missing: there is none to draw")
    return picture.draw(maneuvers, slower, frame=frame, fence=fence, breaches=breaches)
