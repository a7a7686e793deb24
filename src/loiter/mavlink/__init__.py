"""Missions over a MAVLink connection: sent, read back, watched."""

from loiter.mavlink.missions.exchange import Summary, download, upload
from loiter.mavlink.watching.telemetry import WindSource
from loiter.mavlink.watching.watch import Report, watch

__all__ = ["Report", "Summary", "WindSource", "download", "upload", "watch"]
