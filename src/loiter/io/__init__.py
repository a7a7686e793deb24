"""A maneuver as files for maps, ground stations and autopilots; parameter files of autopilots read."""

from loiter.io.items import Autopilot, Command, Frame, Mission, MissionItem
from loiter.io.mission import mission

__all__ = ["Autopilot", "Command", "Frame", "Mission", "MissionItem", "mission"]
