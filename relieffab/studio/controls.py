"""What the page offers of the settings: in groups, with words and ranges for people."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

from relieffab import profiles
from relieffab.fittings import LEVELS, PLACES
from relieffab.job.table import TABLE
from relieffab.layers.lines.names import NAMES as LINE_KINDS
from relieffab.layers.view import VIEWS
from relieffab.relief.names import NAMES as METHODS
from relieffab.relief.names import PARTS


@dataclass(frozen=True)
class Range:
    """A slider's ends and step, and the unit its values are written with.

    It is reversed where less of the setting is more of what its label says.
    """

    low: float
    high: float
    step: float
    unit: str = "mm"
    reverse: bool = False


Choices = tuple[str, ...]

# Group by group in the page's order: label, and a slider or a choice; else text.
_GROUPS: dict[str, dict[str, tuple[str, Range | Choices | None]]] = {
    "Relief": {
        "depth": ("Depth", Range(0.5, 12, 0.1)),
        "line_depth": ("Line weight", Range(0, 2, 0.05)),
        "line_width": ("Line width", Range(0.2, 3, 0.05)),
        "line_detail": ("Line density", Range(0.4, 8, 0.1, reverse=True)),
        "form_length": ("Form length", Range(0.5, 12, 0.1)),
    },
    "View": {
        "view": ("Seen from", tuple(VIEWS)),
        "azimuth": ("Azimuth", Range(-180, 180, 1, "deg")),
        "elevation": ("Elevation", Range(-90, 90, 1, "deg")),
        "roll": ("Roll", Range(-180, 180, 1, "deg")),
        "perspective": ("Perspective", Range(0, 90, 1, "deg")),
        "up": ("Up axis", ("", "y", "z")),
    },
    "Lines": {
        "line_kinds": ("Kinds of line", None),
        "line_length": ("Shortest line", Range(0, 15, 0.1)),
        "line_spread": ("Spread", Range(-1, 1, 0.05)),
        "line_profile": ("Groove", ("rounded", "cutter")),
    },
    "Surface": {
        "carve": ("Carve", PARTS),
        "method": ("Method", METHODS),
        "wall_angle": ("Wall angle", Range(30, 90, 1, "deg")),
        "reachable": ("Only what the cutter reaches", ("no", "yes")),
    },
    "Panel": {
        "size": ("Size", None),
        "thickness": ("Thickness", Range(3, 50, 0.5)),
        "margin": ("Margin", Range(0, 40, 0.5)),
        "outline": ("Outline", ("rectangle", "round", "arched")),
        "corner": ("Corner radius", Range(0, 40, 0.5)),
        "frame": ("Frame", Range(2, 30, 0.5)),
        "frame_height": ("Frame height", Range(-6, 10, 0.5)),
        "frame_edge": ("Frame edge", None),
        "holes": ("Holes", None),
        "hole": ("Hole diameter", Range(1, 12, 0.1)),
        "countersink": ("Countersink", Range(2, 20, 0.1)),
        "keyholes": ("Keyholes", None),
        "resolution": ("Resolution", ("512x384", "1024x768", "2048x1536", "4096x3072")),
    },
    "Cutting": {
        "machine": ("Machine", ("machines",)),
        "material": ("Material", ("materials",)),
        "rough": ("Roughing cutter", ("cutters",)),
        "finish": ("Finishing cutter", ("cutters",)),
        "lines": ("Cutter for lines", ("cutters",)),
        "scallop": ("Ridges between rows", Range(0.002, 0.1, 0.002)),
        "stepover": ("Stepover", Range(0.05, 2, 0.05)),
        "rows": ("Rows", ("along", "across", "both")),
        "milling": ("Milling", ("either", "climb", "conventional")),
    },
    "Programs": {
        "units": ("Units", ("mm", "in")),
        "work_zero": ("Work zero", tuple(PLACES)),
        "work_zero_z": ("Work zero's height", tuple(LEVELS)),
        "positions": ("Larger than the machine", ("", "index", "turn")),
        "overlap": ("Overlap", Range(1, 20, 0.5)),
        "plate": ("Touch plate", Range(0, 30, 0.1)),
        "cutter_change": ("Cutter change", ("files", "pause")),
    },
    "Files": {
        "formats": ("Files of the panel", None),
        "mesh_tolerance": ("Largest error", Range(0.005, 0.2, 0.005)),
        "solid": ("Solid", ("panel", "plaque", "mould")),
        "draft": ("Draft", Range(0, 20, 0.5, "deg")),
        "bed": ("Printer's bed", None),
        "clearance": ("Clearance", Range(0, 1, 0.05)),
        "texture": ("Pictures in", ("stone", "wood")),
        "light": ("Light of the pictures", None),
    },
}
OFFERED = tuple(name for group in _GROUPS.values() for name in group)
"""Settings that the page may choose."""


def controls() -> list[dict[str, Any]]:
    """List what the page offers, in its order."""
    return list(_controls())


def _controls() -> Iterator[dict[str, Any]]:
    for group, entries in _GROUPS.items():
        for name, (label, form) in entries.items():
            setting = TABLE[name]
            control = {
                "name": name,
                "label": label,
                "group": group,
                "help": setting.help,
                "default": setting.default,
            }
            if isinstance(form, Range):
                ends = {"min": form.low, "max": form.high, "step": form.step}
                way = {"unit": form.unit, "reverse": form.reverse}
                yield {**control, "kind": "range", **ends, **way}
            elif form is None:
                known = {"choices": list(LINE_KINDS)} if name == "line_kinds" else {}
                yield {**control, "kind": "text", **known}
            else:
                yield {**control, "kind": "choice", "choices": _choices(form)}


def _choices(form: Choices) -> list[str]:
    if form in (("machines",), ("materials",), ("cutters",)):
        return list(profiles.names(form[0]))  # type: ignore[arg-type]
    return list(form)


def listed() -> dict[str, list[dict[str, str]]]:
    """Name machines, materials and cutters, each with its words for people."""
    reads: dict[str, Callable[[str], Any]] = {
        "machines": profiles.machine,
        "materials": profiles.material,
        "cutters": profiles.cutter,
    }
    return {
        kind: [
            {"name": name, "about": read(name).title}
            for name in profiles.names(kind)  # type: ignore[arg-type]
        ]
        for kind, read in reads.items()
    }
