"""XML files written with the standard library, and the elements that several kinds of KML have."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Iterable, Mapping

# 1e-9 degrees are 0.1 mm.
DEGREES = ".9f"


def child(parent: ET.Element, tag: str, text: object = None, **attributes: str) -> ET.Element:
    """A new element at the end of `parent`."""
    element = ET.SubElement(parent, tag, attributes)
    if text is not None:
        element.text = str(text)
    return element


def root(tag: str, namespace: str, attributes: Mapping[str, str] | None = None) -> ET.Element:
    """A new outermost element."""
    return ET.Element(tag, {"xmlns": namespace, **(attributes or {})})


def document(element: ET.Element) -> bytes:
    """The file, indented, in UTF-8."""
    ET.indent(element)
    text: bytes = ET.tostring(element, encoding="UTF-8", xml_declaration=True)
    return text + b"\n"


def add_styles(parent: ET.Element, colours: Mapping[str, str]) -> None:
    """Add KML's styles of lines, by name and colour: aabbggrr."""
    for name, colour in colours.items():
        style = child(child(parent, "Style", id=name), "LineStyle")
        child(style, "color", colour)
        child(style, "width", "3")


def placemark(parent: ET.Element, title: str, style: str | None = None) -> ET.Element:
    """A new placemark of KML at the end of `parent`, without a geometry."""
    mark = child(parent, "Placemark")
    child(mark, "name", title)
    if style is not None:
        child(mark, "styleUrl", f"#{style}")
    return mark


def add_geometry(mark: ET.Element, kind: str, mode: str, positions: Iterable[str]) -> None:
    """Add a LineString or a Point to a placemark; `mode` is KML's altitudeMode."""
    shape = child(mark, kind)
    if kind == "LineString":
        child(shape, "tessellate", "1")
    child(shape, "altitudeMode", mode)
    child(shape, "coordinates", " ".join(positions))
