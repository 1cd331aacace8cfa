"""A template as one SVG sheet, 1:1 in mm, a layer each kind of mark."""

from collections.abc import Iterable

from lxml import etree

from relieffab.template.marks import Line, Mark, Text, moved
from relieffab.template.model import BORDER, FOOT, Template, foot_marks, panel_marks

_INKSCAPE = "{http://www.inkscape.org/namespaces/inkscape}"
_SVG = "{http://www.w3.org/2000/svg}"
NARROWEST = 130.0  # mm that scale, key and title need


def to_svg(template: Template) -> str:
    """Write a template as one sheet with the panel's border, scale and key.

    Parameters
    ----------
    template : Template

    Returns
    -------
    str
    """
    across = max(template.size[0] + 2 * BORDER, NARROWEST)
    high = template.size[1] + 2 * BORDER + FOOT
    root = etree.Element(
        f"{_SVG}svg",
        nsmap={None: _SVG[1:-1], "inkscape": _INKSCAPE[1:-1]},
        width=f"{across:g}mm",
        height=f"{high:g}mm",
        viewBox=f"0 0 {across:g} {high:g}",
    )
    etree.SubElement(root, f"{_SVG}title").text = template.title
    etree.SubElement(root, f"{_SVG}rect", width="100%", height="100%", fill="white")
    left, low = (across - template.size[0]) / 2, BORDER + FOOT
    for name, marks in panel_marks(template).items():
        _layer(root, name, moved(marks, left, low), high)
    _layer(root, "scale", foot_marks(template, BORDER, 3.0), high)
    return etree.tostring(root, pretty_print=True, xml_declaration=True, encoding="UTF-8").decode()


def _layer(root: etree._Element, name: str, marks: Iterable[Mark], high: float) -> None:
    group = etree.SubElement(root, f"{_SVG}g", id=name.replace(" ", "-"))
    group.set(f"{_INKSCAPE}groupmode", "layer")
    group.set(f"{_INKSCAPE}label", name)
    for mark in marks:
        if isinstance(mark, Line):
            _line(group, mark, high)
        else:
            _text(group, mark, high)


def _line(group: etree._Element, line: Line, high: float) -> None:
    points = " ".join(f"{x:.3f},{high - y:.3f}" for x, y in line.points)
    path = etree.SubElement(group, f"{_SVG}path", d=f"M {points}" + (" Z" if line.closed else ""))
    for key, value in (
        ("fill", "none"),
        ("stroke", line.colour),
        ("stroke-width", f"{line.width:g}"),
        ("stroke-linecap", "round"),
        ("stroke-linejoin", "round"),
    ):
        path.set(key, value)


def _text(group: etree._Element, text: Text, high: float) -> None:
    x, y = f"{text.x:.3f}", f"{high - text.y:.3f}"
    element = etree.SubElement(group, f"{_SVG}text", x=x, y=y, fill=text.colour)
    element.text = text.words
    element.set("font-family", "Helvetica, Arial, sans-serif")
    element.set("font-size", f"{text.size:g}")
    element.set("text-anchor", text.anchor)
    if text.angle:
        element.set("transform", f"rotate({-text.angle:.2f} {x} {y})")
