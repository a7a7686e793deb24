"""Vehicles over MAVLink: upload, download, watch, guide, and streams of path setpoints."""

from loiter.mavlink.connection.telemetry import WindSource
from loiter.mavlink.guiding.guide import guide
from loiter.mavlink.guiding.path_stream import PathReport, Setpoint, stream_path
from loiter.mavlink.guiding.report import GuideReport, Stage
from loiter.mavlink.missions.exchange import MissionSummary, download, upload
from loiter.mavlink.missions.fences import download_fence
from loiter.mavlink.watching.watch import Report, watch

__all__ = [
    "GuideReport",
    "MissionSummary",
    "PathReport",
    "Report",
    "Setpoint",
    "Stage",
    "WindSource",
    "download",
    "download_fence",
    "guide",
    "stream_path",
    "upload",
    "watch",
]
