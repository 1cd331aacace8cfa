"""A mesh or a CAD solid, laid on its broadest side and drawn."""

from pathlib import Path
from types import SimpleNamespace

import numpy as np

from relieffab.job.show.lit import Lit
from relieffab.job.show.shown import Shown
from relieffab.layers.mesh import Mesh, make_mesh, read_mesh
from relieffab.layers.view import View, guess_up, named_view
from relieffab.panel.step import read_step
from relieffab.picture import solid_picture

PIXELS = 900  # of the shading, along the longest side
STEP = (".step", ".stp")


def show_solid(path: Path, lit: Lit) -> Shown:
    """Draw a solid as it lies on a table, seen from its broadest side."""
    if path.suffix.lower() in STEP:
        mesh = make_mesh(*read_step(path), name=path.name, usual_up="z")
    else:
        mesh = read_mesh(path)
    view = broadside(mesh)
    turned = mesh.vertices @ view.rotation.T
    size = np.ptp(turned, axis=0)
    lying = SimpleNamespace(vertices=turned, faces=mesh.faces)
    image, method = solid_picture(
        lying, float(size.max()) / PIXELS, light=lit.light, texture=lit.texture
    )
    facts = {
        "size": [round(float(side), 4) for side in np.ptp(mesh.vertices, axis=0)],
        "vertices": len(mesh.vertices),
        "triangles": len(mesh.faces),
        "drawn": method,
    }
    return Shown("solid", facts, image, notes=mesh.notes)


def broadside(mesh: Mesh) -> View:
    """Find the view along a mesh's shortest extent, upright."""
    up = guess_up(mesh)
    thin = "xyz"[int(np.argmin(np.ptp(mesh.vertices, axis=0)))]
    return named_view("top" if thin == up else "right" if thin == "x" else "front", up=up)
