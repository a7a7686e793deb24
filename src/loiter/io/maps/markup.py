"""XML files written with the standard library."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Mapping

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
