"""What a job is told: its settings, who chose each, and what they come to."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Literal

from relieffab.errors import InputError, suggest
from relieffab.fittings import Edge, Kind
from relieffab.job.table import SETTINGS, TABLE, Setting


@dataclass(frozen=True)
class Job:
    """What is to be made; lengths in mm, angles in degrees, profiles by name.

    Fields are the settings of `SETTINGS`, which says what each means.
    """

    model: str | None
    text: str | None
    image: str | None
    image_depth: float | None
    mask: str | None
    depth_map: str | None
    size: tuple[float, float]
    thickness: float
    outline: Kind
    corner: float
    frame: float | None
    frame_height: float
    frame_edge: Edge | None
    holes: tuple[tuple[float, float], ...] | None
    hole: float
    countersink: float | None
    keyholes: tuple[tuple[float, float], ...] | None
    round: float | None
    bore: float | None
    floor: float | None
    curved: float | None
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
    style: str
    mark_spacing: float | None
    mark_depth: float | None
    mark_direction: float | None
    mark_cutter: str | None
    ground: str
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
    positions: Literal["index", "turn"] | None
    overlap: float
    plate: float | None
    cutter_change: str
    mesh_tolerance: float
    light: tuple[float, float]
    texture: Literal["stone", "wood"]
    solid: str
    draft: float
    bed: tuple[float, float] | None
    clearance: float
    formats: tuple[str, ...]
    paper: str

    def __post_init__(self) -> None:
        if self.round is None and self.depth >= self.thickness:
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
    values = {name: choice.value for name, choice in chosen.items()}
    if values["round"] is not None:
        from relieffab.round import meant_width

        width, height = values["size"]
        values["size"] = (meant_width(width, values["round"]), height)
    return Job(**values)


def default_job(**values: Any) -> Job:
    """Return a job of default settings but for those given, as typed or as values.

    Examples
    --------
    >>> default_job(size="8in x 4in").size
    (203.2, 101.6)
    """
    return job_of(resolve([("call", values)]))
