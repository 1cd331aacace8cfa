"""The parts of a solid that is larger than a print bed, as files."""

from pathlib import Path
from typing import Any

from relieffab.job.settings import Job
from relieffab.panel.export import write_stl
from relieffab.panel.model import Panel
from relieffab.panel.tiles import split
from relieffab.panel.tongues import layout, tongue_height


def check(job: Job) -> None:
    """Refuse a bed or a slab that gives no parts, before any work is done.

    Raises
    ------
    InputError
        If the bed is too small, or the slab too thin for tongues.
    """
    if job.bed is not None and layout(job.size, job.bed, job.clearance) != (1, 1):
        tongue_height(job.thickness, job.thickness - job.depth, job.clearance)


def write(solid: Panel, name: str, job: Job, folder: Path) -> dict[str, Any]:
    """Split a solid for the job's bed and write its parts as NAME-A1.stl and so on.

    Returns
    -------
    dict
        `tiles`: what each part is and where it lies, none if the solid fits the
        bed; and nothing at all where there is no bed.
    """
    if job.bed is None:
        return {}
    tiles = split(solid, job.bed, job.clearance)
    if len(tiles) == 1:
        return {"tiles": []}
    listed = []
    for tile in tiles:
        file = f"{name}-{tile.name}.stl"
        write_stl(tile, folder / file)
        size = tile.vertices.max(axis=0) - tile.vertices.min(axis=0)
        listed.append(
            {
                "file": file,
                "place_mm": list(tile.place),
                "size_mm": size.tolist(),
                "triangles": len(tile.faces),
                "watertight": tile.watertight,
                "volume_mm3": tile.volume_mm3,
            }
        )
    return {"tiles": listed}
