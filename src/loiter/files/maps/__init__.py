"""Maneuvers as files for maps: GeoJSON, KML, GPX and CSV."""
