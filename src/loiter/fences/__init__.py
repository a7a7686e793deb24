"""Fences: zones to stay in or out of, and whether a maneuver and its hold do."""

from loiter.fences.clear_entry import ClearEntry, clear_entry, first_clear
from loiter.fences.fence import Breach, Fence, FenceCheck, check, default_margin_m
from loiter.fences.model import CircleZone, PolygonZone
from loiter.fences.places import PlacedCircle, PlacedFence, PlacedPolygon

__all__ = [
    "Breach",
    "CircleZone",
    "ClearEntry",
    "Fence",
    "FenceCheck",
    "PlacedCircle",
    "PlacedFence",
    "PlacedPolygon",
    "PolygonZone",
    "check",
    "clear_entry",
    "default_margin_m",
    "first_clear",
]
