"""A maneuver as files for maps, ground stations and autopilots; parameter files of autopilots read."""
