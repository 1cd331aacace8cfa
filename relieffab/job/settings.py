"""A job's settings: one table of names, how each is read, and what it is by default."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, Literal

from relieffab import units
from relieffab.errors import InputError, suggest
from relieffab.layers.lines.names import NAMES, USUAL, chosen
from relieffab.panel import formats
from relieffab.relief.names import ALL, PARTS, SUNKEN, known, part
from relieffab.relief.names import NAMES as METHODS
from relieffab.stock import LEVELS, PLACES
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


LONGEST = 1e5  # mm


def _positive(text: Any) -> float:
    value = units.length(text)
    if not 0 < value < LONGEST:
        raise InputError(
            "the length is out of range", expected="more than 0, under 100 m", found=str(text)
        )
    return value


def _not_negative(text: Any) -> float:
    value = units.length(text)
    if not 0 <= value < LONGEST:
        raise InputError(
            "the length is out of range", expected="0 or more, under 100 m", found=str(text)
        )
    return value


def _signed(text: Any) -> float:
    value = units.length(text)
    if not -LONGEST < value < LONGEST:
        raise InputError("the length is out of range", expected="under 100 m", found=str(text))
    return value


def _kinds(text: Any) -> tuple[str, ...]:
    return chosen(str(text).replace(",", " ").split())


def _formats(text: Any) -> tuple[str, ...]:
    return formats.chosen(str(text).lower().replace(",", " ").split())


def _size(text: Any) -> tuple[float, ...]:
    values = units.lengths(str(text))
    if len(values) != 2:
        raise InputError(
            "the size is not two lengths", expected="width x height, as 120x90mm", found=str(text)
        )
    if not all(0 < value < LONGEST for value in values):
        raise InputError(
            "the size is out of range", expected="more than 0, under 100 m", found=str(text)
        )
    return values


def _resolution(text: Any) -> tuple[int, int]:
    parts = str(text).lower().split("x")
    if len(parts) != 2 or not all(p.strip().isdigit() for p in parts):
        raise InputError(
            "the resolution is not two counts of pixels", expected="1024x768", found=str(text)
        )
    width, height = (int(p) for p in parts)
    if not (16 <= width <= 16384 and 16 <= height <= 16384):
        raise InputError(
            "the resolution is out of range",
            expected="16 to 16384 pixels each way",
            found=str(text),
        )
    return width, height


def _view(text: Any) -> str:
    from relieffab.layers.view import VIEWS

    if text not in VIEWS:
        raise InputError(
            "there is no view of that name", found=str(text), hint=suggest(str(text), VIEWS)
        )
    return str(text)


def _method(text: Any) -> str:
    return known(str(text))


def _part(text: Any) -> str:
    return part(str(text))


def _rows(text: Any) -> tuple[float, bool]:
    """Angle of the rows, and whether others cross them."""
    named = {"along": (0.0, False), "across": (90.0, False), "both": (0.0, True)}
    if str(text) in named:
        return named[str(text)]
    try:
        return units.angle(text), False
    except InputError as fault:
        raise InputError(
            "the rows' way is not known",
            expected=f"{', '.join(named)}, or an angle as 30deg",
            found=str(text),
        ) from fault


def _one_of(*words: str) -> Callable[[Any], str]:
    def read(text: Any) -> str:
        if text not in words:
            raise InputError(
                "there is no such choice", expected=" or ".join(words), found=str(text)
            )
        return str(text)

    return read


def _up(text: Any) -> str:
    if text not in ("y", "z"):
        raise InputError("the up axis is not known", expected="y or z", found=repr(text))
    return str(text)


def _paper(text: Any) -> str:
    return _one_of(*PAPERS)(str(text).lower())


SETTINGS = (
    Setting("model", str, "", "model file: STL, OBJ, PLY, OFF, GLB or 3MF"),
    Setting("size", _size, "120x90mm", "panel, width x height"),
    Setting("thickness", _positive, "12mm", "of the stock"),
    Setting("depth", _positive, "3mm", "of the relief at its deepest"),
    Setting("method", _method, SUNKEN, "of making the relief: " + ", ".join(METHODS)),
    Setting("carve", _part, ALL, "what is carved: " + ", ".join(PARTS)),
    Setting("resolution", _resolution, "1024x768", "pixels across and down"),
    Setting("margin", _not_negative, "6mm", "flat border round the figure"),
    Setting("view", _view, "front", "front, back, left, right, top or bottom"),
    Setting("azimuth", units.angle, "", "where the viewer stands, 0 is the front, 90 the right"),
    Setting("elevation", units.angle, "", "how far above the model the viewer stands"),
    Setting("roll", units.angle, "0deg", "turn of the picture, counter-clockwise"),
    Setting("perspective", units.angle, "0deg", "angle of view the model fills; 0 is orthographic"),
    Setting("up", _up, "", "the model's axis that points up, y or z; guessed if not given"),
    Setting("form_length", _positive, "", "wider forms follow depth, finer ones shading"),
    Setting(
        "line_kinds",
        _kinds,
        ",".join(USUAL),
        "lines drawn, with commas; also " + ", ".join(n for n in NAMES if n not in USUAL),
    ),
    Setting("line_width", _positive, "0.6mm", "of a drawn line at full strength"),
    Setting(
        "line_depth", _not_negative, "", "of a drawn line; a sixteenth of the depth, at most 0.4mm"
    ),
    Setting(
        "line_profile",
        _one_of("rounded", "cutter"),
        "rounded",
        "of a drawn line: rounded, or the shape of the cutter for lines",
    ),
    Setting("line_detail", _not_negative, "1.8mm", "finer forms give no lines"),
    Setting(
        "line_length",
        _not_negative,
        "3mm",
        "shorter lines are left out; half of it for contours, a third for creases",
    ),
    Setting("line_spread", _signed, "0mm", "dilates the line image, or erodes it if negative"),
    Setting(
        "wall_angle",
        units.angle,
        "80deg",
        "of the figure's edge against the face; 90deg for a free one",
    ),
    Setting("machine", str, "3018-prover", "see `relieffab machines`"),
    Setting("material", str, "softwood", "see `relieffab machines`"),
    Setting("rough", str, "flat-3.175", "roughing cutter"),
    Setting("finish", str, "tapered-ball-1", "finishing cutter"),
    Setting("lines", str, "tapered-ball-0.5", "cutter for lines and what finishing leaves"),
    Setting("stepover", _positive, "", "between finishing rows; from the scallop if not given"),
    Setting("scallop", _positive, "0.01mm", "height of the ridges between rows, on slopes too"),
    Setting("rows", _rows, "along", "of finishing: along X, across, both, or an angle"),
    Setting("milling", _one_of("either", "climb", "conventional"), "either", "way of cutting"),
    Setting(
        "reachable",
        _one_of("no", "yes"),
        "no",
        "yes: solve again without the forms that the finest cutter cannot reach",
    ),
    Setting("units", _one_of("mm", "in"), "mm", "of the programs: mm or in"),
    Setting("work_zero", _one_of(*PLACES), "near-left", "on the stock: " + ", ".join(PLACES)),
    Setting(
        "work_zero_z", _one_of(*LEVELS), "top", "work zero's height: top or bottom of the stock"
    ),
    Setting("plate", _not_negative, "", "thickness of a touch plate: also writes a probe of Z"),
    Setting(
        "cutter_change",
        _one_of("files", "pause"),
        "files",
        "files: one program a cutter; pause: one program that stops for each (M6)",
    ),
    Setting("mesh_tolerance", _positive, "0.02mm", "largest error of the panel's triangles"),
    Setting(
        "solid",
        _one_of("panel", "plaque", "mould"),
        "panel",
        "panel, plaque (the figure raised from a ground) or mould (that casts the panel)",
    ),
    Setting("draft", units.angle, "3deg", "of a mould's walls, and the least that the relief has"),
    Setting("bed", _size, "", "of a printer, X x Y: a larger solid comes in parts, too"),
    Setting("clearance", _not_negative, "0.2mm", "between the tongues and notches of parts"),
    Setting(
        "formats",
        _formats,
        ",".join(formats.USUAL),
        "files of the panel, with commas: " + ", ".join(formats.FORMATS),
    ),
    Setting("paper", _paper, "a4", "of the template's pages: " + ", ".join(PAPERS)),
)
TABLE = {setting.name: setting for setting in SETTINGS}


@dataclass(frozen=True)
class Job:
    """What is to be made; lengths in mm, angles in degrees, profiles by name.

    Fields are the settings of `SETTINGS`, which says what each means.
    """

    model: str | None
    size: tuple[float, float]
    thickness: float
    depth: float
    method: str
    carve: str
    resolution: tuple[int, int]
    margin: float
    view: str
    azimuth: float | None
    elevation: float | None
    roll: float
    perspective: float
    up: str | None
    form_length: float | None
    line_kinds: tuple[str, ...]
    line_width: float
    line_depth: float | None
    line_profile: str
    line_detail: float
    line_length: float
    line_spread: float
    wall_angle: float
    machine: str
    material: str
    rough: str
    finish: str
    lines: str
    stepover: float | None
    scallop: float
    rows: tuple[float, bool]
    milling: str
    reachable: str
    units: Literal["mm", "in"]
    work_zero: str
    work_zero_z: str
    plate: float | None
    cutter_change: str
    mesh_tolerance: float
    solid: str
    draft: float
    bed: tuple[float, float] | None
    clearance: float
    formats: tuple[str, ...]
    paper: str

    def __post_init__(self) -> None:
        if self.depth >= self.thickness:
            raise InputError(
                "the relief would go through the stock",
                expected=f"depth under the thickness, {self.thickness:g} mm",
                found=f"{self.depth:g} mm",
                where="depth",
                hint="a thicker stock (--thickness) or a shallower relief (--depth)",
            )
        if 2 * self.margin >= min(self.size):
            raise InputError(
                "the margin leaves no room for the figure",
                expected=f"under {min(self.size) / 2:g} mm",
                found=f"{self.margin:g} mm",
                where="margin",
            )


@dataclass(frozen=True)
class Chosen:
    """A setting's value and who chose it.

    Parameters
    ----------
    text : str
        As it was typed; empty for none.
    value : object
    origin : str
        'flag', 'RELIEFFAB_SIZE', a file's name, or 'default'.
    """

    text: str
    value: Any
    origin: str


def resolve(sources: list[tuple[str, Mapping[str, Any]]]) -> dict[str, Chosen]:
    """Choose each setting from the first source that has it.

    Parameters
    ----------
    sources : list of (origin, mapping)
        Strongest first; values as typed.

    Returns
    -------
    dict of Chosen
        Every setting, defaults included.

    Raises
    ------
    InputError
        If a source has an unknown key or a value that cannot be read.
    """
    for origin, values in sources:
        for name in values:
            if name not in TABLE:
                raise InputError(
                    f"there is no setting {name!r}", where=origin, hint=suggest(name, TABLE)
                )
    chosen = {}
    for setting in SETTINGS:
        found = [
            (origin, values[setting.name]) for origin, values in sources if setting.name in values
        ]
        origin, text = found[0] if found else ("default", setting.default)
        chosen[setting.name] = Chosen(str(text), _read(setting, text, origin), origin)
    return chosen


def _read(setting: Setting, text: Any, origin: str) -> Any:
    if text == "" and setting.default == "":
        return None
    if isinstance(text, bool) or not isinstance(text, (str, int, float)):
        raise InputError(
            f"{setting.name} cannot be {text!r}",
            expected=f"a value such as {setting.default or setting.help}",
            where=origin,
        )
    try:
        return setting.read(text)
    except InputError as fault:
        raise InputError(f"{setting.name}: {fault}", where=origin) from fault


def job_of(chosen: Mapping[str, Chosen]) -> Job:
    """Build the job from resolved settings."""
    return Job(**{name: choice.value for name, choice in chosen.items()})


def default_job(**values: Any) -> Job:
    """Return a job of default settings but for those given, as typed or as values.

    Examples
    --------
    >>> default_job(size="8in x 4in").size
    (203.2, 101.6)
    """
    return job_of(resolve([("call", values)]))
