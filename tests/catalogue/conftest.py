"""Jobs small enough for a test: a stone on a panel of 24 x 18 mm."""

import pytest
import trimesh

from relieffab.catalogue.entries import entries
from relieffab.catalogue.listing import wanted

FLAGS = {"resolution": "96x72", "size": "40x30mm", "margin": "3mm", "depth": "1.5mm", "up": "z"}


def write_stones(folder, names):
    folder.mkdir(parents=True, exist_ok=True)
    for k, name in enumerate(names):
        stone = trimesh.creation.icosphere(subdivisions=2)
        stone.vertices *= [3, 2, 1 + 0.1 * k]
        stone.export(folder / name)


@pytest.fixture
def stones(tmp_path):
    """Eight entries, and where they may go."""
    write_stones(tmp_path / "stones", [f"stone-{k}.ply" for k in range(8)])
    jobs = wanted([str(tmp_path / "stones")], tmp_path / "out")
    return entries(jobs, FLAGS, {}, "relief"), tmp_path / "out"
