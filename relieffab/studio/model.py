"""Model: what a person has opened, light enough to be turned and tried."""

import json
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from relieffab.layers.coarser import coarser
from relieffab.layers.mesh import Mesh
from relieffab.layers.view import guess_up

SHOWN, TRIED = 150_000, 20_000
"""Triangles at most, of what the page turns and of what previews are made from."""


@dataclass(frozen=True, eq=False)
class Model:
    """A model that was read.

    Parameters
    ----------
    file : Path
        Whole, for the job.
    shown, tried : Mesh
        In fewer triangles, in the model's own units.
    triangles : int
        Of the whole.
    up : {'y', 'z'}
        As guessed from the whole.
    """

    file: Path
    shown: Mesh
    tried: Mesh
    triangles: int
    up: str

    kind = "mesh"

    @property
    def name(self) -> str:
        """Of its file."""
        return self.file.name

    @property
    def notes(self) -> tuple[str, ...]:
        """What was done to read it."""
        return self.shown.notes

    @property
    def about(self) -> str:
        """What it is, in a few words."""
        return f"{self.triangles:,} triangles"


def lightened(mesh: Mesh, file: Path) -> Model:
    """Make the lighter copies of a mesh."""
    shown = coarser(mesh, SHOWN)
    return Model(file, shown, coarser(shown, TRIED), len(mesh.faces), guess_up(mesh))


def save(model: Model, folder: Path) -> None:
    """Write a model for `load`."""
    for name, mesh in (("shown", model.shown), ("tried", model.tried)):
        np.save(folder / f"{name}-vertices.npy", mesh.vertices)
        np.save(folder / f"{name}-faces.npy", mesh.faces)
    facts = {
        "triangles": model.triangles,
        "up": model.up,
        "notes": model.shown.notes,
        "usual_up": model.shown.usual_up,
    }
    (folder / "model.json").write_text(json.dumps(facts), encoding="utf-8")


def load(folder: Path, file: Path) -> Model:
    """Read what `save` wrote; of a file it is told where that is now."""
    facts = json.loads((folder / "model.json").read_text(encoding="utf-8"))
    shown, tried = (
        Mesh(
            np.load(folder / f"{name}-vertices.npy", allow_pickle=False),
            np.load(folder / f"{name}-faces.npy", allow_pickle=False),
            file.name,
            tuple(facts["notes"]),
            facts["usual_up"],
        )
        for name in ("shown", "tried")
    )
    return Model(file, shown, tried, facts["triangles"], facts["up"])
