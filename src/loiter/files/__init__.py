"""Write maneuvers as files for maps, ground stations and autopilots; read missions and parameter files."""

from loiter.files.fence_table import read_fence_table
from loiter.files.formats import FORMATS, check_format, read_mission, save
from loiter.files.legs import save_leg
from loiter.files.missions.altitudes import MEAN_SEA_LEVEL, AltitudeDatum, AltitudeReference
from loiter.files.missions.fences import read_fence
from loiter.files.missions.items import Autopilot, Frame, MavCommand, Mission, MissionItem
from loiter.files.missions.legs import leg_mission
from loiter.files.missions.mission import mission
from loiter.files.missions.parameters import Preset, read_parameters
from loiter.files.missions.site import MissionCircle, Site, read_site

__all__ = [
    "FORMATS",
    "MEAN_SEA_LEVEL",
    "AltitudeDatum",
    "AltitudeReference",
    "Autopilot",
    "Frame",
    "MavCommand",
    "Mission",
    "MissionCircle",
    "MissionItem",
    "Preset",
    "Site",
    "check_format",
    "leg_mission",
    "mission",
    "read_fence",
    "read_fence_table",
    "read_mission",
    "read_parameters",
    "read_site",
    "save",
    "save_leg",
]
