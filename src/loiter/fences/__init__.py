"""Fences: zones to stay in or out of, and whether a maneuver and its hold do."""

from loiter.fences.clear_entry import clear_entry
from loiter.fences.entries import ClearEntry, first_clear
from loiter.fences.fence import Fence, check
from loiter.fences.fence_check import Breach, FenceCheck, default_margin_m
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
