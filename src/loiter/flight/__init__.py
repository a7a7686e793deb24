"""Vehicles over MAVLink: upload, download, watch and guide."""

from typing import TYPE_CHECKING

from loiter.lazy import lazy_names

if TYPE_CHECKING:
    from loiter.flight.guiding.guide import guide
    from loiter.flight.guiding.report import GuideReport, Stage
    from loiter.flight.link.telemetry import WindSource
    from loiter.flight.missions.exchange import MissionSummary, download, upload
    from loiter.flight.missions.fences import download_fence
    from loiter.flight.watching.watch import Report, watch

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

__getattr__ = lazy_names(
    __name__,
    {
        "GuideReport": "guiding.report",
        "MissionSummary": "missions.exchange",
        "Report": "watching.watch",
        "Stage": "guiding.report",
        "WindSource": "link.telemetry",
        "download": "missions.exchange",
        "download_fence": "missions.fences",
        "guide": "guiding.guide",
        "upload": "missions.exchange",
        "watch": "watching.watch",
    },
)
