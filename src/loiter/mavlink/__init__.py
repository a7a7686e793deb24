"""Vehicles over MAVLink: upload, download, watch and guide."""

from loiter.mavlink.connection.telemetry import WindSource
from loiter.mavlink.guiding.guide import guide
from loiter.mavlink.guiding.report import GuideReport, Stage
from loiter.mavlink.missions.exchange import MissionSummary, download, upload
from loiter.mavlink.missions.fences import download_fence
from loiter.mavlink.watching.watch import Report, watch

__all__ = [
    "GuideReport",
    "MissionSummary",
    "Report",
    "Stage",
    "WindSource",
    "download",
    "download_fence",
    "guide",
    "upload",
    "watch",
]
