"""What the page offers of the settings: in groups, with words and ranges for people."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

from relieffab import profiles
from relieffab.fittings import LEVELS, PLACES
from relieffab.job import seen
from relieffab.job.seen import OF_MESHES
from relieffab.job.table import TABLE
from relieffab.layers.image.names import DEPTH, DEPTH_FAR, DRAWING
from relieffab.layers.image.names import NAMES as PICTURES
from relieffab.layers.lines.names import NAMES as LINE_KINDS
from relieffab.layers.view import VIEWS
from relieffab.relief.names import NAMES as METHODS
from relieffab.relief.names import PARTS
from relieffab.relief.style.names import GROUNDS, STYLES


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
FILE = "file"
"""A setting that names a file, which the page sends."""

# Group by group in the page's order: label, and a slider or a choice; else text.
_GROUPS: dict[str, dict[str, tuple[str, Range | Choices | str | None]]] = {
    "Relief": {
        "depth": ("Depth", Range(0.5, 12, 0.1)),
        "line_depth": ("Line weight", Range(0, 2, 0.05)),
        "line_width": ("Line width", Range(0.2, 3, 0.05)),
        "line_detail": ("Line density", Range(0.4, 8, 0.1, reverse=True)),
        "form_length": ("Form length", Range(0.5, 12, 0.1)),
    },
    "Picture": {
        "image": ("It shows", ("", *PICTURES)),
        "image_depth": ("The map's depth", Range(1, 60, 0.5)),
        "mask": ("Mask", FILE),
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
    "Marks": {
        "style": ("Chisel", STYLES),
        "mark_spacing": ("Spacing", Range(0.3, 4, 0.05)),
        "mark_depth": ("Depth of the marks", Range(0.02, 1, 0.01)),
        "mark_direction": ("Direction", Range(-90, 90, 1, "deg")),
        "ground": ("Ground", GROUNDS),
        "mark_cutter": ("Cutter for marks", ("", "cutters")),
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
        "round": ("Round: its diameter", Range(10, 200, 1)),
        "bore": ("Bore", Range(5, 190, 1)),
        "floor": ("Floor under the bore", Range(1, 50, 0.5)),
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
OF_PICTURES = tuple(name for name in seen.OF_PICTURES if name in OFFERED)


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
            elif form == FILE:
                yield {**control, "kind": FILE}
            elif form is None:
                known = {"choices": list(LINE_KINDS)} if name == "line_kinds" else {}
                yield {**control, "kind": "text", **known}
            else:
                yield {**control, "kind": "choice", "choices": _choices(form)}


def _choices(form: Choices | str) -> list[str]:
    kinds = ("machines", "materials", "cutters")
    listed = [profiles.names(one) if one in kinds else (one,) for one in form]  # type: ignore[arg-type]
    return [one for names in listed for one in names]


_TURNED = "Only a mesh can be turned: this is carved as it lies."
_PICTURES = "Of pictures alone."
_MAPS = "Only a depth map is as deep as one says."
_NO_FIGURE = "A drawing is all ink: there is no figure to be told apart."
_AS_DRAWN = "Its lines are carved as they are drawn."
_LEVEL = "It is level: there is no form to be solved for."
_NO_AREAS = "It has no areas, and so no walls."
_ROUND = "A round stock has none of these."
_FLAT_ONLY = (
    *("thickness", "outline", "corner", "frame", "frame_height", "frame_edge"),
    *("holes", "hole", "countersink", "keyholes", "positions", "overlap"),
    *("solid", "draft", "bed", "clearance"),
)


def idle(kind: str, *, bent: bool = False) -> dict[str, str]:
    """Say which settings have nothing to say of a model and its stock, and why.

    Parameters
    ----------
    kind : str
        'mesh', 'svg', or what a picture shows.
    bent : bool
        Whether the stock is round.
    """
    return _idle_of(kind) | (dict.fromkeys(_FLAT_ONLY, _ROUND) if bent else {})


def _idle_of(kind: str) -> dict[str, str]:
    if kind == "mesh":
        return dict.fromkeys(OF_PICTURES, _PICTURES)
    found = dict.fromkeys(OF_MESHES, _TURNED)
    if kind == "svg":
        found |= dict.fromkeys(OF_PICTURES, _PICTURES)
    elif kind not in (DEPTH, DEPTH_FAR):
        found["image_depth"] = _MAPS
    if kind in ("svg", DRAWING):
        found |= dict.fromkeys(("line_kinds", "line_detail", "line_length"), _AS_DRAWN)
        found |= dict.fromkeys(("form_length", "method", "reachable"), _LEVEL)
    if kind == DRAWING:
        found |= {"mask": _NO_FIGURE, "line_width": _AS_DRAWN, "wall_angle": _NO_AREAS}
    return found


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
