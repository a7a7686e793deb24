"""Write maneuvers as files for maps, ground stations and autopilots; read missions and parameter files."""

from loiter.io.files import FORMATS, check_format, read_mission, save
from loiter.io.mission import mission
from loiter.io.missions.altitudes import MEAN_SEA_LEVEL, AltitudeDatum, AltitudeReference
from loiter.io.missions.items import Autopilot, Command, Frame, MavCommand, Mission, MissionItem
from loiter.io.missions.parameters import Preset, read_parameters

__all__ = [
    "FORMATS",
    "MEAN_SEA_LEVEL",
    "AltitudeDatum",
    "AltitudeReference",
    "Autopilot",
    "Command",
    "Frame",
    "MavCommand",
    "Mission",
    "MissionItem",
    "Preset",
    "check_format",
    "mission",
    "read_mission",
    "read_parameters",
    "save",
]
