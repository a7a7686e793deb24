"""Fences in plan views: the zones that must not be flown in are hatched, and where a path breaches them is marked."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import PathPatch
from matplotlib.path import Path

from loiter.fences import Breach, CircleZone, Fence
from loiter.fences.model import Zone
from loiter.plot.marks import Box, Floats

ZONE_COLOUR, BREACH_COLOUR = "#882255", "#cc0000"

# The lines of a legend for what `draw_fence` draws.
FENCE_STYLES: dict[str, dict[str, Any]] = {
    "stay out": {"color": ZONE_COLOUR, "linewidth": 1.4},
    "stay in": {"color": ZONE_COLOUR, "linewidth": 1.4, "linestyle": "--"},
    "breach of the fence": {"color": BREACH_COLOUR, "linestyle": "none", "marker": "X", "markersize": 9},
}

# Corners of the outline that stands for a circle.
CIRCLE_CORNERS = 180


def draw_fence(axes: Axes, fence: Fence | None, breaches: Sequence[Breach], whole: Box) -> None:
    """Draw zones and breaches; what of a fence is farther from the plan than its size does not enlarge the view."""
    if fence is None:
        return
    near = whole.widened(whole.size)
    for zone in fence.zones:
        corners = _outline(zone)
        _draw_zone(axes, zone, corners)
        inside = (corners >= (near.west, near.south)).all(axis=1) & (corners <= (near.east, near.north)).all(axis=1)
        axes.update_datalim(corners[inside])
    for breach in breaches:
        style = FENCE_STYLES["breach of the fence"]
        axes.plot([breach.east_m], [breach.north_m], **style, zorder=6, gid="breach of the fence")


def _draw_zone(axes: Axes, zone: Zone, corners: Floats) -> None:
    """Hatch the inside of a zone to stay out of; of one to stay in draw the edge alone, dashed."""
    name = "stay in" if zone.inclusion else "stay out"
    hatch: dict[str, Any] = {} if zone.inclusion else {"hatch": "///"}
    patch = PathPatch(Path(corners, closed=True), fill=False, zorder=1.05, gid=name, **FENCE_STYLES[name], **hatch)
    # `add_patch` would let the whole zone enlarge the view.
    axes.add_artist(patch)


def _outline(zone: Zone) -> Floats:
    """The corners of a zone, the first one again at the end: (n, 2)."""
    if isinstance(zone, CircleZone):
        angles = np.linspace(0.0, 2.0 * np.pi, CIRCLE_CORNERS + 1)
        east, north = zone.east_m + zone.radius_m * np.cos(angles), zone.north_m + zone.radius_m * np.sin(angles)
        return np.column_stack([east, north])
    return np.array([*zone.corners, zone.corners[0]])
