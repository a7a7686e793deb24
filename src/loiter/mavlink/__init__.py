"""Missions over a MAVLink connection: sent, read back, watched."""

from loiter.mavlink.missions import Summary, download, upload
from loiter.mavlink.telemetry import WindSource
from loiter.mavlink.watch import Report, watch

__all__ = ["Report", "Summary", "WindSource", "download", "upload", "watch"]
