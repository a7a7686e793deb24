"""Write maneuvers as files for maps, ground stations and autopilots; read missions and parameter files."""

from loiter.io.fence_table import read_fence_table
from loiter.io.files import FORMATS, check_format, read_mission, save
from loiter.io.legs import save_leg
from loiter.io.missions.altitudes import MEAN_SEA_LEVEL, AltitudeDatum, AltitudeReference
from loiter.io.missions.fences import read_fence
from loiter.io.missions.items import Autopilot, Frame, MavCommand, Mission, MissionItem
from loiter.io.missions.legs import leg_mission
from loiter.io.missions.mission import mission
from loiter.io.missions.parameters import Preset, read_parameters
from loiter.io.missions.site import MissionCircle, Site, read_site

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
