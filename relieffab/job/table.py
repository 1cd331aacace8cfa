"""The one table of settings: names, how each is read, and what it is by default."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from relieffab import units
from relieffab.fittings import LEVELS, PLACES
from relieffab.job import readers
from relieffab.layers.image.names import NAMES as PICTURES
from relieffab.layers.lines.names import NAMES, USUAL
from relieffab.panel import formats
from relieffab.relief.names import ALL, PARTS, SUNKEN
from relieffab.relief.names import NAMES as METHODS
from relieffab.relief.style.names import GROUNDS, NONE, PLAIN, STYLES
from relieffab.template.pages import PAPERS


@dataclass(frozen=True)
class Setting:
    """One thing a job can be told.

    Parameters
    ----------
    name : str
        The same on the command line, in job files, in RELIEFFAB_* and in `Job`.
    read : callable
        From what a person types to the value; raises InputError.
    default : str
        As a person would type it; empty where nothing is a choice, too.
    help : str
    """

    name: str
    read: Callable[[Any], Any]
    default: str
    help: str


SETTINGS = (
    Setting("model", str, "", "a mesh, a picture, an SVG or a font"),
    Setting("text", str, "", "what a font writes; \\n parts lines"),
    Setting(
        "image",
        readers.one_of(*PICTURES),
        "",
        "what a picture shows, told by its values if not given: " + ", ".join(PICTURES),
    ),
    Setting(
        "image_depth",
        readers.positive,
        "",
        "of a depth map, farthest to nearest on the panel; half the figure's shorter side",
    ),
    Setting("mask", str, "", "picture of a picture's figure, which is white"),
    Setting("depth_map", str, "", "depth map that goes with a normal map, of the same figure"),
    Setting("size", readers.size, "120x90mm", "panel, width x height"),
    Setting("thickness", readers.positive, "12mm", "of the stock"),
    Setting("outline", readers.outline, "rectangle", "of the panel: rectangle, round or arched"),
    Setting("corner", readers.not_negative, "0mm", "radius of the outline's corners"),
    Setting("frame", readers.positive, "", "width of a frame along the outline"),
    Setting("frame_height", readers.signed, "2mm", "of the frame over the face; sunk if negative"),
    Setting("frame_edge", readers.edge, "", "of the frame: chamfer 1mm or fillet 1mm"),
    Setting("holes", readers.places, "", "through the stock, X x Y each: 10x80mm, 110x80mm"),
    Setting("hole", readers.positive, "4mm", "diameter of the holes"),
    Setting("countersink", readers.positive, "", "diameter of the holes at their top"),
    Setting(
        "keyholes", readers.places, "", "in the back, where the screw comes to rest, X x Y each"
    ),
    Setting("round", readers.positive, "", "diameter of a column that the panel is wrapped round"),
    Setting("bore", readers.positive, "", "diameter of the column's bore: a ring"),
    Setting("floor", readers.positive, "", "height at which the bore begins: a cup"),
    Setting("curved", readers.positive, "", "radius of a board's face that is curved along X"),
    Setting("depth", readers.positive, "3mm", "of the relief at its deepest"),
    Setting("method", readers.method, SUNKEN, "of making the relief: " + ", ".join(METHODS)),
    Setting("carve", readers.part, ALL, "what is carved: " + ", ".join(PARTS)),
    Setting("resolution", readers.resolution, "1024x768", "pixels across and down"),
    Setting("margin", readers.not_negative, "6mm", "flat border round the figure"),
    Setting("view", readers.view, "front", "front, back, left, right, top or bottom"),
    Setting("azimuth", units.angle, "", "where the viewer stands, 0 is the front, 90 the right"),
    Setting("elevation", units.angle, "", "how far above the model the viewer stands"),
    Setting("roll", units.angle, "0deg", "turn of the picture, counter-clockwise"),
    Setting("perspective", units.angle, "0deg", "angle of view the model fills; 0 is orthographic"),
    Setting("up", readers.up, "", "the model's axis that points up, y or z; guessed if not given"),
    Setting("form_length", readers.positive, "", "wider forms follow depth, finer ones shading"),
    Setting(
        "line_kinds",
        readers.line_kinds,
        ",".join(USUAL),
        "lines drawn, with commas; also " + ", ".join(n for n in NAMES if n not in USUAL),
    ),
    Setting("line_width", readers.positive, "0.6mm", "of a drawn line at full strength"),
    Setting(
        "line_depth",
        readers.not_negative,
        "",
        "of a drawn line; a sixteenth of the depth, at most 0.4mm",
    ),
    Setting(
        "line_profile",
        readers.one_of("rounded", "cutter"),
        "rounded",
        "of a drawn line: rounded, or the shape of the cutter for lines",
    ),
    Setting("line_detail", readers.not_negative, "1.8mm", "finer forms give no lines"),
    Setting(
        "line_length",
        readers.not_negative,
        "3mm",
        "shorter lines are left out; half of it for contours, a third for creases",
    ),
    Setting(
        "line_spread", readers.signed, "0mm", "dilates the line image, or erodes it if negative"
    ),
    Setting(
        "wall_angle",
        units.angle,
        "80deg",
        "of the figure's edge against the face; 90deg for a free one",
    ),
    Setting(
        "style",
        readers.one_of(*STYLES),
        NONE,
        "marks of a chisel that the figure keeps: " + ", ".join(STYLES),
    ),
    Setting("mark_spacing", readers.positive, "", "of the marks; the chisel's own if not given"),
    Setting("mark_depth", readers.positive, "", "of the marks; the chisel's own if not given"),
    Setting("mark_direction", readers.mark_direction, "form", "of the marks: form, or an angle"),
    Setting("mark_cutter", str, "", "that cuts the marks; the chisel's own if not given"),
    Setting("ground", readers.one_of(*GROUNDS), PLAIN, "around the figure: " + ", ".join(GROUNDS)),
    Setting("machine", str, "3018-prover", "see `relieffab machines`"),
    Setting("material", str, "softwood", "see `relieffab machines`"),
    Setting("rough", str, "flat-3.175", "roughing cutter"),
    Setting("finish", str, "tapered-ball-1", "finishing cutter"),
    Setting("lines", str, "tapered-ball-0.5", "cutter for lines and what finishing leaves"),
    Setting(
        "stepover", readers.positive, "", "between finishing rows; from the scallop if not given"
    ),
    Setting(
        "scallop", readers.positive, "0.01mm", "height of the ridges between rows, on slopes too"
    ),
    Setting("rows", readers.rows, "along", "of finishing: along X, across, both, or an angle"),
    Setting(
        "milling",
        readers.one_of("either", "climb", "conventional"),
        "either",
        "way of cutting: either, climb or conventional",
    ),
    Setting(
        "reachable",
        readers.one_of("no", "yes"),
        "no",
        "yes: solve again without the forms that the finest cutter cannot reach, to within 0.02 mm",
    ),
    Setting("units", readers.one_of("mm", "in"), "mm", "of the programs: mm or in"),
    Setting(
        "work_zero", readers.one_of(*PLACES), "near-left", "on the stock: " + ", ".join(PLACES)
    ),
    Setting(
        "work_zero_z",
        readers.one_of(*LEVELS),
        "top",
        "work zero's height: top or bottom of the stock",
    ),
    Setting(
        "positions",
        readers.one_of("index", "turn"),
        "",
        "of a panel larger than the machine: index (moved along) or turn (turned half round)",
    ),
    Setting("overlap", readers.positive, "5mm", "of what is cut at neighbouring positions"),
    Setting(
        "plate", readers.not_negative, "", "thickness of a touch plate: also writes a probe of Z"
    ),
    Setting(
        "cutter_change",
        readers.one_of("files", "pause"),
        "files",
        "files: one program a cutter; pause: one program that stops for each (M6)",
    ),
    Setting("mesh_tolerance", readers.positive, "0.02mm", "largest error of the panel's triangles"),
    Setting(
        "light",
        readers.light,
        "315,32.5",
        "of the pictures: degrees clockwise from the panel's far side, and above it",
    ),
    Setting("texture", readers.texture, "stone", "of the pictures: stone or wood"),
    Setting(
        "solid",
        readers.one_of("panel", "plaque", "mould"),
        "panel",
        "panel, plaque (the figure raised from a ground) or mould (that casts the panel)",
    ),
    Setting("draft", units.angle, "3deg", "of a mould's walls, and the least that the relief has"),
    Setting("bed", readers.size, "", "of a printer, X x Y: a larger solid comes in parts, too"),
    Setting("clearance", readers.not_negative, "0.2mm", "between the tongues and notches of parts"),
    Setting(
        "formats",
        readers.file_formats,
        ",".join(formats.USUAL),
        "files of the panel, with commas: " + ", ".join(formats.FORMATS),
    ),
    Setting("paper", readers.paper, "a4", "of the template's pages: " + ", ".join(PAPERS)),
)
TABLE = {setting.name: setting for setting in SETTINGS}
