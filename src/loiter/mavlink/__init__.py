"""Vehicles over MAVLink: upload, download and watch."""

from loiter.mavlink.missions.exchange import MissionSummary, Summary, download, upload
from loiter.mavlink.watching.telemetry import WindSource
from loiter.mavlink.watching.watch import Report, watch

__all__ = ["MissionSummary", "Report", "Summary", "WindSource", "download", "upload", "watch"]
